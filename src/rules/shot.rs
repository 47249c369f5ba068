//! A shot as rules see it: what is left of all its facts.
//!
//! It only collects. That a thing is forbidden is for a game to say.

use crate::events::{Fact, FactKind, TouchedBy, Zone};
use crate::hash::StateHash;
use crate::ids::{BallId, PlayerId, PocketId, Rail};
use crate::units::Seconds;
use smallvec::SmallVec;

/// A ball that went down, where and when.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pocketed {
    /// When [s].
    pub time_s: Seconds,
    /// The ball.
    pub ball: BallId,
    /// Where.
    pub pocket: PocketId,
}

/// What the cue ball met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Met {
    /// A rail that it did not touch before.
    Rail(Rail),
    /// A ball.
    Ball(BallId),
}

/// A ball that the cue ball met before any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FirstContact {
    /// The ball.
    pub ball: BallId,
    /// It lay behind the head string.
    pub in_kitchen: bool,
}

/// What happened in one shot, from the cue ball's placing to rest. Start with the default, or with
/// [`Shot::of`] where the cue ball is not the one with the number 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shot {
    /// The ball that is struck.
    pub cue_ball: BallId,
    /// The last attempt to put the cue ball down before the stroke: the zone it was meant for, and
    /// whether it could be put there.
    pub placement: Option<(Zone, bool)>,
    /// How often a contact of the tip with the cue ball began.
    pub tips: u32,
    /// When the first of them did [s].
    pub struck_s: Option<Seconds>,
    /// The tip was still on the cue ball when that met another ball.
    pub push: bool,
    /// A ball was still moving or spinning when the cue ball was struck.
    pub moving: bool,
    /// Who struck, where that was not the player at the table.
    pub struck_by: Option<PlayerId>,
    /// When the cue ball first met a ball [s].
    pub first_contact_s: Option<Seconds>,
    /// The balls it met then. More than one if it met them at exactly the same time; no rule can
    /// tell which was first, so none depends on the order in which they were told.
    pub first_contacts: SmallVec<[FirstContact; 2]>,
    /// All meetings of two balls, in time order.
    pub contacts: SmallVec<[(BallId, BallId); 16]>,
    /// Balls driven to a rail, in time order: cushion contacts with `onset` only.
    pub rails: SmallVec<[(BallId, Rail); 16]>,
    /// When a ball was last driven to a rail, went down or left the table [s].
    pub last_driven_s: Option<Seconds>,
    /// What the cue ball met and when [s], in time order; at the same time, rails first.
    pub cue_met: SmallVec<[(Seconds, Met); 8]>,
    /// Object balls that went down, in time order; at the same time, the lower number first.
    pub pocketed: SmallVec<[Pocketed; 4]>,
    /// Object balls that left the table, in ascending order.
    pub off: SmallVec<[BallId; 2]>,
    /// The cue ball went down.
    pub cue_pocketed: bool,
    /// The cue ball left the table.
    pub cue_off: bool,
    /// Balls that something touched which may not, and what touched them.
    pub touched: SmallVec<[(BallId, TouchedBy); 2]>,
    /// When the cue ball first crossed the head string towards the foot [s].
    pub crossed_head_s: Option<Seconds>,
    /// Balls that lie against each other at the end.
    pub frozen: SmallVec<[(BallId, BallId); 2]>,
    /// Everything is at rest: the shot can be judged.
    pub settled: bool,
    /// Snooker: no ball on can be hit on both edges in a straight line.
    pub snookered: bool,
    /// Straight pool: the cue ball must give way to the next rack, and is then in hand.
    pub cue_in_rack: bool,
}

/// Adds one fact to the shot. Facts come in time order; those at the same time in any order.
pub fn watch(shot: &mut Shot, fact: &Fact) {
    let cue_ball = shot.cue_ball;
    match fact.kind {
        FactKind::BallPlaced { ball, zone, ok } if ball == cue_ball => {
            shot.placement = Some((zone, ok));
            if ok {
                (shot.cue_pocketed, shot.cue_off) = (false, false);
            }
        }
        // In training a hand brings a ball back, even while others roll. Elsewhere object balls
        // return by the rules' own command, which is no part of a shot.
        FactKind::BallPlaced { ball, ok, .. } => {
            shot.pocketed.retain(|pocketed| !ok || pocketed.ball != ball);
            shot.off.retain(|off| !ok || *off != ball);
        }
        FactKind::CueBallStruck { ball, push, moving, player, .. } if ball == cue_ball => {
            shot.tips = shot.tips.saturating_add(1);
            shot.struck_s.get_or_insert(fact.time_s);
            shot.push |= push;
            shot.moving |= moving;
            shot.struck_by = shot.struck_by.or(player);
        }
        // The tip may meet the cue ball and nothing else.
        FactKind::CueBallStruck { ball, .. } => shot.touched.push((ball, TouchedBy::Tip)),
        FactKind::BallsCollided { a, b, in_kitchen, .. } => {
            shot.contacts.push((a, b));
            if a == cue_ball || b == cue_ball {
                let other = if a == cue_ball { b } else { a };
                watch_cue_ball_contact(shot, fact.time_s, other, in_kitchen);
            }
        }
        FactKind::CushionHit { ball, rail, onset, .. } => {
            if onset {
                shot.rails.push((ball, rail));
                shot.drive(fact.time_s);
                if ball == cue_ball {
                    shot.meet(fact.time_s, Met::Rail(rail));
                }
            }
        }
        FactKind::HeadStringCrossed { ball } => {
            if ball == cue_ball {
                shot.crossed_head_s.get_or_insert(fact.time_s);
            }
        }
        FactKind::BallPocketed { ball, pocket, .. } => {
            shot.drive(fact.time_s);
            if ball == cue_ball {
                shot.cue_pocketed = true;
            } else {
                watch_pocketed(shot, Pocketed { time_s: fact.time_s, ball, pocket });
            }
        }
        FactKind::BallOffTable { ball } => {
            shot.drive(fact.time_s);
            if ball == cue_ball {
                shot.cue_off = true;
            } else if let Err(place) = shot.off.binary_search(&ball) {
                shot.off.insert(place, ball);
            }
        }
        FactKind::BallTouched { ball, by } => shot.touched.push((ball, by)),
        FactKind::BallsFrozen { a, b } => shot.frozen.push((a, b)),
        FactKind::Settled { snookered, cue_in_rack } => {
            shot.settled = true;
            shot.snookered = snookered;
            shot.cue_in_rack = cue_in_rack;
        }
    }
}

fn watch_cue_ball_contact(shot: &mut Shot, time_s: Seconds, other: BallId, in_kitchen: bool) {
    shot.meet(time_s, Met::Ball(other));
    let first_s = *shot.first_contact_s.get_or_insert(time_s);
    if first_s == time_s {
        shot.first_contacts.push(FirstContact { ball: other, in_kitchen });
    }
}

/// A ball is down once: what is told again changes nothing.
fn watch_pocketed(shot: &mut Shot, new: Pocketed) {
    if let Some(old) = shot.pocketed.iter_mut().find(|old| old.ball == new.ball) {
        // No order of facts at one time decides which pocket counts.
        if old.time_s == new.time_s {
            old.pocket = old.pocket.min(new.pocket);
        }
        return;
    }
    let place = shot.pocketed.partition_point(|old| {
        old.time_s.total_cmp(&new.time_s).then(old.ball.cmp(&new.ball)).is_lt()
    });
    shot.pocketed.insert(place, new);
}

impl Shot {
    /// A shot in which another ball than number 0 is struck.
    pub fn of(cue_ball: BallId) -> Self {
        Shot { cue_ball, ..Shot::default() }
    }

    /// The object balls that were driven to a rail, went down or left the table.
    pub fn driven(&self) -> SmallVec<[BallId; 16]> {
        let to_rails = self.rails.iter().map(|(ball, _)| *ball);
        let gone =
            self.pocketed.iter().map(|pocketed| pocketed.ball).chain(self.off.iter().copied());
        let mut balls: SmallVec<[BallId; 16]> =
            to_rails.chain(gone).filter(|ball| *ball != self.cue_ball).collect();
        balls.sort_unstable();
        balls.dedup();
        balls
    }

    /// The balls that lie against this one at the end, in ascending order.
    pub fn frozen_to(&self, ball: BallId) -> SmallVec<[BallId; 2]> {
        let other = |(a, b): &(BallId, BallId)| match (*a == ball, *b == ball) {
            (true, false) => Some(*b),
            (false, true) => Some(*a),
            _ => None,
        };
        let mut balls: SmallVec<[BallId; 2]> = self.frozen.iter().filter_map(other).collect();
        balls.sort_unstable();
        balls.dedup();
        balls
    }

    /// Where this object ball went down.
    pub fn pocket_of(&self, ball: BallId) -> Option<PocketId> {
        self.pocketed.iter().find(|pocketed| pocketed.ball == ball).map(|pocketed| pocketed.pocket)
    }

    /// Whether a ball was driven to a rail, went down or left the table when or after the cue ball
    /// first met a ball.
    pub fn is_driven_after_contact(&self) -> bool {
        matches!((self.first_contact_s, self.last_driven_s), (Some(met), Some(last)) if last >= met)
    }

    /// Whether the cue ball crossed the head string before it met a ball, or when it did.
    pub fn crossed_head_first(&self) -> bool {
        match (self.crossed_head_s, self.first_contact_s) {
            (Some(crossed), Some(met)) => crossed <= met,
            (crossed, _) => crossed.is_some(),
        }
    }

    fn drive(&mut self, time_s: Seconds) {
        self.last_driven_s = Some(self.last_driven_s.map_or(time_s, |last| last.max(time_s)));
    }

    fn meet(&mut self, time_s: Seconds, what: Met) {
        let place = self
            .cue_met
            .partition_point(|(time, met)| time.total_cmp(&time_s).then(met.cmp(&what)).is_le());
        self.cue_met.insert(place, (time_s, what));
    }

    /// Whether the cue ball is gone.
    pub fn cue_ball_is_gone(&self) -> bool {
        self.cue_pocketed || self.cue_off
    }

    /// Whether this object ball went down.
    pub fn has_pocketed(&self, ball: BallId) -> bool {
        self.pocketed.iter().any(|pocketed| pocketed.ball == ball)
    }

    /// The object balls that went down, in time order.
    pub fn pocketed_balls(&self) -> SmallVec<[BallId; 4]> {
        self.pocketed.iter().map(|pocketed| pocketed.ball).collect()
    }

    /// Adds everything that can still decide the verdict to `hash`.
    pub fn hash_into(&self, hash: &mut StateHash) {
        let (zone, ok) = self.placement.map_or((0, false), |(zone, ok)| (1 + zone as u64, ok));
        let flags = [
            ok,
            self.push,
            self.moving,
            self.first_contacts.iter().any(|met| met.in_kitchen),
            self.cue_pocketed,
            self.cue_off,
            self.settled,
            self.snookered,
            self.cue_in_rack,
        ];
        hash.u64(self.cue_ball.0.into());
        hash.u64(zone);
        flags.into_iter().for_each(|flag| hash.u64(flag.into()));
        hash.u64(self.tips.into());
        hash.u64(self.struck_by.map_or(0, |player| player.0.into()));
        hash.f64(self.first_contact_s.unwrap_or(-1.0));
        hash_list(
            hash,
            self.first_contacts
                .iter()
                .map(|met| u64::from(met.in_kitchen) << 16 | u64::from(met.ball.0)),
        );
        hash_list(hash, self.contacts.iter().map(|(a, b)| u64::from(a.0) << 16 | u64::from(b.0)));
        hash_list(hash, self.rails.iter().map(|(a, rail)| u64::from(a.0) << 16 | *rail as u64));
        hash.f64(self.last_driven_s.unwrap_or(-1.0));
        hash.f64(self.crossed_head_s.unwrap_or(-1.0));
        hash_list(
            hash,
            self.cue_met.iter().map(|(_, met)| match met {
                Met::Rail(rail) => 1 << 16 | *rail as u64,
                Met::Ball(ball) => u64::from(ball.0),
            }),
        );
        self.cue_met.iter().for_each(|(time_s, _)| hash.f64(*time_s));
        hash.f64(self.struck_s.unwrap_or(-1.0));
        hash_list(hash, self.frozen.iter().map(|(a, b)| u64::from(a.0) << 16 | u64::from(b.0)));
        hash_list(hash, self.pocketed.iter().map(|p| u64::from(p.ball.0) << 16 | p.pocket as u64));
        self.pocketed.iter().for_each(|pocketed| hash.f64(pocketed.time_s));
        hash_list(hash, self.off.iter().map(|ball| ball.0.into()));
        hash_list(hash, self.touched.iter().map(|(a, by)| u64::from(a.0) << 16 | *by as u64));
    }
}

/// Adds a list with its length, so that two lists in a row cannot be mistaken for others.
pub(super) fn hash_list(hash: &mut StateHash, items: impl ExactSizeIterator<Item = u64>) {
    hash.u64(items.len() as u64);
    items.for_each(|item| hash.u64(item));
}
