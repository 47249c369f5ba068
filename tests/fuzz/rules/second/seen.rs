//! Questions to the facts of one shot. Each looks through the whole list again; nothing is summed
//! up in between, so that what sums up in the program is checked with the rest.

use hapticbillard::events::{BallInHand, Fact, FactKind, Zone};
use hapticbillard::ids::{BallId, PlayerId, PocketId};
use std::collections::BTreeSet;

/// The facts of a shot, from the placing of the cue ball to rest.
#[derive(Clone, Copy)]
pub struct Seen<'a>(pub &'a [Fact]);

/// A first contact: the ball, and whether it lay behind the head string.
pub type Met = (BallId, bool);

impl Seen<'_> {
    fn kinds(&self) -> impl Iterator<Item = FactKind> {
        self.0.iter().map(|fact| fact.kind)
    }

    /// The ball went down.
    pub fn fell(&self, which: BallId) -> bool {
        self.kinds().any(|k| matches!(k, FactKind::BallPocketed { ball, .. } if ball == which))
    }

    /// The ball went down there.
    pub fn fell_into(&self, which: BallId, there: PocketId) -> bool {
        self.kinds().any(|kind| match kind {
            FactKind::BallPocketed { ball, pocket, .. } => ball == which && pocket == there,
            _ => false,
        })
    }

    /// The ball left the table.
    pub fn left(&self, which: BallId) -> bool {
        self.kinds().any(|k| matches!(k, FactKind::BallOffTable { ball } if ball == which))
    }

    /// Object balls that went down, the earliest first; of several at a time the lowest number.
    pub fn fallen(&self) -> Vec<BallId> {
        let down = |fact: &Fact| match fact.kind {
            FactKind::BallPocketed { ball, .. } if ball != BallId::CUE => Some((fact.time_s, ball)),
            _ => None,
        };
        let mut fallen: Vec<(f64, BallId)> = self.0.iter().filter_map(down).collect();
        fallen.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        fallen.into_iter().map(|(_, ball)| ball).collect()
    }

    /// An object ball left the table.
    pub fn lost_an_object_ball(&self) -> bool {
        self.kinds().any(|k| matches!(k, FactKind::BallOffTable { ball } if ball != BallId::CUE))
    }

    /// Object balls driven to a rail: an onset at a cushion, a pocket, or over the edge.
    pub fn object_balls_to_rails(&self) -> usize {
        let object = |ball: BallId| (ball != BallId::CUE).then_some(ball);
        let driven: BTreeSet<BallId> = self.kinds().filter_map(driven).filter_map(object).collect();
        driven.len()
    }

    /// When the cue ball first met a ball.
    pub fn first_contact_s(&self) -> Option<f64> {
        let with_cue = |fact: &&Fact| cue_meets(&fact.kind).is_some();
        self.0.iter().filter(with_cue).map(|fact| fact.time_s).reduce(f64::min)
    }

    /// What it met then; several where it met them at exactly the same time.
    pub fn first_met(&self) -> Vec<Met> {
        let first = self.first_contact_s();
        let is_first = |fact: &&Fact| Some(fact.time_s) == first;
        self.0.iter().filter(is_first).filter_map(|fact| cue_meets(&fact.kind)).collect()
    }

    /// A ball, whichever, was driven to a rail once the cue ball had met one.
    pub fn rail_after_contact(&self) -> bool {
        let Some(first) = self.first_contact_s() else { return false };
        self.0.iter().any(|fact| driven(fact.kind).is_some() && fact.time_s >= first)
    }

    /// The cue ball had crossed the head string by the first contact.
    pub fn crossed_in_time(&self) -> bool {
        let by = self.first_contact_s().unwrap_or(f64::INFINITY);
        let crossed = |kind| matches!(kind, FactKind::HeadStringCrossed { ball: BallId::CUE });
        self.0.iter().any(|fact| crossed(fact.kind) && fact.time_s <= by)
    }

    /// How often the tip met the cue ball.
    pub fn tips(&self) -> usize {
        let on_cue =
            |kind: &FactKind| matches!(kind, FactKind::CueBallStruck { ball: BallId::CUE, .. });
        self.kinds().filter(on_cue).count()
    }

    /// The tip pushed.
    pub fn pushed(&self) -> bool {
        self.kinds().any(|kind| match kind {
            FactKind::CueBallStruck { ball, push, .. } => ball == BallId::CUE && push,
            _ => false,
        })
    }

    /// A ball was still moving at the stroke.
    pub fn struck_too_soon(&self) -> bool {
        self.kinds().any(|kind| match kind {
            FactKind::CueBallStruck { ball, moving, .. } => ball == BallId::CUE && moving,
            _ => false,
        })
    }

    /// Somebody else than `player` struck.
    pub fn struck_by_other_than(&self, player: PlayerId) -> bool {
        self.kinds().any(|kind| match kind {
            FactKind::CueBallStruck { ball: BallId::CUE, player: Some(who), .. } => who != player,
            _ => false,
        })
    }

    /// A ball was touched: by anything, or by the tip where it is not the cue ball.
    pub fn touched(&self) -> bool {
        self.kinds().any(|kind| match kind {
            FactKind::BallTouched { .. } => true,
            FactKind::CueBallStruck { ball, .. } => ball != BallId::CUE,
            _ => false,
        })
    }

    /// How the cue ball was put down last: where, and whether it could be.
    pub fn placed(&self) -> Option<(Zone, bool)> {
        let place = |kind| match kind {
            FactKind::BallPlaced { ball: BallId::CUE, zone, ok } => Some((zone, ok)),
            _ => None,
        };
        self.kinds().filter_map(place).last()
    }
}

/// The ball that a fact drives to a rail; down and over the edge count as that.
fn driven(kind: FactKind) -> Option<BallId> {
    match kind {
        FactKind::CushionHit { ball, onset: true, .. }
        | FactKind::BallPocketed { ball, .. }
        | FactKind::BallOffTable { ball } => Some(ball),
        _ => None,
    }
}

/// What the cue ball meets in a fact.
fn cue_meets(kind: &FactKind) -> Option<Met> {
    match *kind {
        FactKind::BallsCollided { a: BallId::CUE, b, in_kitchen, .. } => Some((b, in_kitchen)),
        FactKind::BallsCollided { a, b: BallId::CUE, in_kitchen, .. } => Some((a, in_kitchen)),
        _ => None,
    }
}

/// The table of what decides a rule, "placement": it could be put down, and where it may lie.
pub fn may_lie(in_hand: BallInHand, (zone, ok): (Zone, bool)) -> bool {
    let is_inside = match in_hand {
        BallInHand::Anywhere => true,
        BallInHand::Kitchen => zone == Zone::Kitchen,
        BallInHand::None | BallInHand::D => false,
    };
    ok && is_inside
}
