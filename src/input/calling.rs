//! What a person announces with the next stroke: proposed from the aim, changed by hand.

use super::{Action, sight};
use crate::events::{Call, CallKind, Turn};
use crate::ids::{BallId, PocketId};
use crate::physics::Snapshot;
use crate::table::Pocket;
use glam::{DVec2, DVec3};

/// A call as the picture shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct CallView {
    /// What is announced.
    pub call: Call,
    /// Where the called ball lies [m].
    pub ball_at: Option<DVec2>,
    /// Middle of the called pocket and its radius [m].
    pub pocket_at: Option<(DVec2, f64)>,
}

/// What the person wants to be announced.
#[derive(Debug, Clone, Default)]
pub(super) struct Calling {
    /// A kind of shot in place of a ball.
    kind: Option<CallKind>,
    /// Chosen by hand in place of what the aim proposes; forgotten when the aim goes to another
    /// ball.
    ball: Option<BallId>,
    pocket: Option<PocketId>,
    /// The ball that the aim proposes.
    aimed: Option<BallId>,
    /// What the referee was told last.
    said: Option<Call>,
}

/// The world as a call sees it.
pub(super) struct Sight<'a> {
    /// What is asked for.
    pub turn: &'a Turn,
    /// The table.
    pub table: &'a Snapshot,
    /// Its pockets.
    pub pockets: &'a [Pocket],
    /// Middle of the cue ball [m].
    pub centre: DVec3,
    /// Unit vector of the aim.
    pub direction: DVec2,
}

impl Calling {
    /// The aim has changed: what was chosen for another ball is forgotten.
    pub fn follow(&mut self, sight: &Sight<'_>) {
        let proposed = sight.proposed();
        if self.aimed != proposed {
            (self.ball, self.pocket, self.aimed) = (None, None, proposed);
        }
    }

    /// Changes the call, where this may be called.
    pub fn change(&mut self, action: Action, backwards: bool, sight: &Sight<'_>) {
        let calls = sight.turn.calls;
        match action {
            Action::Safety if calls.safety => self.toggle(CallKind::Safety),
            Action::PushOut if calls.push_out => self.toggle(CallKind::PushOut),
            Action::NextBall if calls.ball => self.next_ball(sight, backwards),
            Action::NextPocket if calls.ball && calls.pocket => {
                self.next_pocket(sight, backwards);
            }
            _ => {}
        }
    }

    /// Calls the pocket that is nearest to this point of the bed [m], where pockets are called.
    pub fn point_at(&mut self, at: DVec2, sight: &Sight<'_>) {
        let away = |pocket: &Pocket| pocket.centre.distance_squared(at);
        let nearest = sight.pockets.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        if sight.calls_pockets() {
            (self.kind, self.pocket) = (None, nearest.map(|pocket| pocket.id));
        }
    }

    fn toggle(&mut self, kind: CallKind) {
        self.kind = if self.kind == Some(kind) { None } else { Some(kind) };
    }

    /// Another ball than the aim proposes, or no kind of shot any more.
    fn next_ball(&mut self, sight: &Sight<'_>, backwards: bool) {
        let now = self.ball_of(sight);
        let balls: Vec<BallId> = sight.callable().map(|(ball, _)| ball).collect();
        self.kind = None;
        self.ball = next(&balls, now, backwards);
        self.pocket = None;
    }

    fn next_pocket(&mut self, sight: &Sight<'_>, backwards: bool) {
        let now = self.pocket_of(sight);
        let pockets: Vec<PocketId> = sight.pockets.iter().map(|pocket| pocket.id).collect();
        self.kind = None;
        self.pocket = next(&pockets, now, backwards);
    }

    fn ball_of(&self, sight: &Sight<'_>) -> Option<BallId> {
        self.ball.or_else(|| sight.proposed())
    }

    fn pocket_of(&self, sight: &Sight<'_>) -> Option<PocketId> {
        self.pocket.or_else(|| sight.pocket_for(self.ball_of(sight)?))
    }

    /// What would be announced if the stroke came now; none if nothing is, or nothing may be.
    pub fn call(&self, sight: &Sight<'_>) -> Option<Call> {
        let calls = sight.turn.calls;
        match self.kind {
            Some(CallKind::Safety) if calls.safety => Some(Call::Kind(CallKind::Safety)),
            Some(CallKind::PushOut) if calls.push_out => Some(Call::Kind(CallKind::PushOut)),
            _ if calls.ball => {
                let ball = self.ball_of(sight)?;
                let pocket = if calls.pocket { Some(self.pocket_of(sight)?) } else { None };
                Some(Call::Ball { ball, pocket })
            }
            _ => None,
        }
    }

    /// The same for the picture.
    pub fn view(&self, sight: &Sight<'_>) -> Option<CallView> {
        let call = self.call(sight)?;
        let (ball_at, pocket_at) = match &call {
            Call::Kind(_) => (None, None),
            Call::Ball { ball, pocket } => {
                let pocket = sight.pockets.iter().find(|other| Some(other.id) == *pocket);
                (sight.place_of(*ball), pocket.map(|pocket| (pocket.centre, pocket.radius_m)))
            }
        };
        Some(CallView { call, ball_at, pocket_at })
    }

    /// What is to be said before a stroke, if the referee does not know it.
    pub fn say(&mut self, sight: &Sight<'_>) -> Option<Call> {
        let call = self.call(sight);
        if call == self.said {
            return None;
        }
        self.said.clone_from(&call);
        Some(call.unwrap_or(Call::Kind(CallKind::Nothing)))
    }
}

impl Sight<'_> {
    /// Whether a pocket is announced with a stroke.
    pub fn calls_pockets(&self) -> bool {
        self.turn.calls.ball && self.turn.calls.pocket
    }

    /// The balls that may be called, and where they lie [m].
    fn callable(&self) -> impl Iterator<Item = (BallId, DVec2)> + '_ {
        let balls = self.table.on_table();
        balls
            .filter(|ball| self.turn.legal_first.contains(&ball.id))
            .map(|ball| (ball.id, ball.position.truncate()))
    }

    fn place_of(&self, ball: BallId) -> Option<DVec2> {
        self.callable().find(|(id, _)| *id == ball).map(|(_, place)| place)
    }

    /// The first of them that the line of aim meets.
    fn proposed(&self) -> Option<BallId> {
        let met = self.callable().filter_map(|(ball, place)| {
            Some((ball, sight::meets(self.centre, self.direction, place)?))
        });
        met.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(ball, _)| ball)
    }

    /// The pocket nearest to the way that this ball would take.
    fn pocket_for(&self, ball: BallId) -> Option<PocketId> {
        let place = self.place_of(ball)?;
        let from = self.centre.truncate();
        let met = sight::meets(self.centre, self.direction, place);
        let ghost = met.map_or(from, |way| from + self.direction * way);
        let heading = (place - ghost).normalize_or_zero();
        let along = |pocket: &Pocket| (pocket.target() - place).normalize_or_zero().dot(heading);
        let nearest = self.pockets.iter().max_by(|a, b| along(a).total_cmp(&along(b)));
        nearest.map(|pocket| pocket.id)
    }
}

/// The item after this one, or before it, round a list.
pub(super) fn next<T: Copy + PartialEq>(items: &[T], now: Option<T>, backwards: bool) -> Option<T> {
    let count = items.len();
    let at = items.iter().position(|item| Some(*item) == now);
    let step = if backwards { count.saturating_sub(1) } else { 1 };
    items.get(at.map_or(0, |at| (at + step) % count)).copied()
}
