//! Cutting a motion into more segments changes nothing but rounding.

use super::segment::{Course, Segment};
use super::{EventDriven, predict};
use crate::ball::{Ball, BallPlace, BallState};
use crate::events::FactSet;
use crate::ids::BallId;
use crate::physics::{Parameters, Solver};
use crate::table::Table;
use crate::units::Seconds;
use glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const R: f64 = 0.028575;

impl EventDriven {
    /// Starts the segments of all moving balls afresh.
    fn cut_all(&mut self, at: Seconds) {
        let moving: predict::Changed = (0..self.bodies.len())
            .filter(|index| {
                let body = &self.bodies[*index];
                body.in_play() && !body.is_still()
            })
            .collect();
        self.done = self.done.max(at);
        for index in &moving {
            let state = self.state_at(at, *index);
            if state.course != Course::Lasting {
                self.watch_rails(*index, at);
                self.close_segment(at, *index);
                self.turn_into(*index, state);
            }
        }
        self.predict(at, &moving);
    }
}

fn ball(id: u16, x: f64, y: f64, velocity: DVec3, spin: DVec3) -> (Ball, BallState) {
    let mut state = Segment::still(0.0, DVec3::new(x, y, R), DQuat::IDENTITY).state(
        BallId(id),
        BallPlace::OnTable,
        0.0,
    );
    state.velocity = velocity;
    state.angular_velocity = spin;
    (Ball::pool(BallId(id)), state)
}

/// Two to four balls, the first of them shot.
fn shot(random: &mut Pcg64) -> Vec<(Ball, BallState)> {
    let mut one = |size: f64| random.random_range(-size..size);
    let velocity = DVec3::new(one(6.0), one(6.0), 0.0);
    let spin = DVec3::new(one(100.0), one(100.0), one(100.0));
    let mut balls = vec![ball(0, -0.6 + one(0.2), one(0.5), velocity, spin)];
    for (id, x) in [(1, 0.1), (2, 0.5), (3, 0.9)] {
        balls.push(ball(id, x + one(0.1), one(0.5), DVec3::ZERO, DVec3::ZERO));
    }
    balls.truncate(2 + random.random_range(0..3));
    balls
}

#[test]
fn a_motion_cut_every_five_milliseconds_ends_where_it_ended() {
    let table = Table::preset("pool-9ft").expect("a shipped table");
    let mut random = Pcg64::seed_from_u64(9);
    for case in 0..30 {
        let balls = shot(&mut random);
        let mut whole = EventDriven::new(&table, balls, Parameters::pool()).expect("a world");
        let mut cut = whole.clone();
        let mut facts = Vec::new();
        whole.advance(30.0, FactSet::NONE, &mut facts).expect("no error");
        let mut facts = Vec::new();
        for tick in 1..=6000 {
            let at = 0.005 * f64::from(tick);
            cut.advance(at, FactSet::NONE, &mut facts).expect("no error");
            if !cut.is_still() {
                cut.cut_all(at);
            }
        }
        for (one, other) in whole.bodies.iter().zip(&cut.bodies) {
            let apart = one.sample(30.0).position.distance(other.sample(30.0).position);
            assert!(apart < 1e-9, "case {case}, ball {}: {apart} m", one.ball.id);
        }
    }
}
