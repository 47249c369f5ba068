//! What the paper's player sees: positions on the bed, from above.

use crate::ball::{BallPlace, BallState};
use crate::ids::BallId;
use crate::physics::Snapshot;
use crate::table::{Bed, Pocket};
use glam::DVec2;

/// A ball as seen from above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenBall {
    /// Which.
    pub id: BallId,
    /// Where [m].
    pub position: DVec2,
}

/// The table as seen from above. It holds no velocities and leads to no simulation: whoever plans
/// with it can look at the table, not into the future (paper, section 5.4).
#[derive(Debug, Clone, PartialEq)]
pub struct TableView2d {
    /// The cue ball, if it lies on the table [m].
    pub cue_ball: Option<DVec2>,
    /// The object balls on the table, in ascending order of id.
    pub balls: Vec<SeenBall>,
    /// Radius of every ball [m].
    pub ball_radius_m: f64,
    /// The playing area.
    pub bed: Bed,
    /// The pockets.
    pub pockets: Vec<Pocket>,
}

impl TableView2d {
    /// Looks at the table from above.
    pub fn of(table: &Snapshot, bed: &Bed, pockets: &[Pocket], ball_radius_m: f64) -> Self {
        Self::with_cue_ball(table, BallId::CUE, bed, pockets, ball_radius_m)
    }

    /// The same where another ball can be the one that is struck, as in carom.
    pub fn with_cue_ball(
        table: &Snapshot,
        cue_ball: BallId,
        bed: &Bed,
        pockets: &[Pocket],
        ball_radius_m: f64,
    ) -> Self {
        Self::of_balls(&table.balls, cue_ball, bed, pockets, ball_radius_m)
    }

    /// The same of balls in ascending order of id, of which some may not lie on the table.
    pub(super) fn of_balls(
        balls: &[BallState],
        cue_ball: BallId,
        bed: &Bed,
        pockets: &[Pocket],
        ball_radius_m: f64,
    ) -> Self {
        let lying = balls.iter().filter(|ball| ball.place == BallPlace::OnTable);
        let seen = lying.map(|ball| SeenBall { id: ball.id, position: ball.position.truncate() });
        TableView2d {
            cue_ball: seen.clone().find(|ball| ball.id == cue_ball).map(|ball| ball.position),
            balls: seen.filter(|ball| ball.id != cue_ball).collect(),
            ball_radius_m,
            bed: *bed,
            pockets: pockets.to_vec(),
        }
    }

    /// Where an object ball lies [m].
    pub fn position(&self, id: BallId) -> Option<DVec2> {
        self.balls.iter().find(|ball| ball.id == id).map(|ball| ball.position)
    }

    /// Whether the cue ball could lie at `position` without touching anything.
    pub fn has_room(&self, position: DVec2) -> bool {
        /// Distance that a hand leaves between balls [m].
        const GAP_M: f64 = 0.001;
        self.has_room_for(position, GAP_M, &[])
    }

    /// Whether a ball at `position` has a gap of so much [m] to the cushions and to all object
    /// balls but those that are `ignored`.
    pub(super) fn has_room_for(&self, position: DVec2, gap_m: f64, ignored: &[BallId]) -> bool {
        let apart = 2.0 * self.ball_radius_m + gap_m;
        let mut others = self.balls.iter().filter(|ball| !ignored.contains(&ball.id));
        self.bed.holds(position, self.ball_radius_m + gap_m)
            && others.all(|ball| ball.position.distance(position) >= apart)
    }
}
