//! The balls between two snapshots: where they are shown to the hand.
//!
//! A ball goes on with its last velocity. When a snapshot says otherwise the difference dies away
//! within [`BLEND_S`], so that no force jumps; a difference above [`SNAP_M`] is another ball's
//! place, and is taken over at once. A ball that the hand has just struck moves as the servo's own
//! solution says until a snapshot knows of the stroke.

use super::scene::{BALLS_MAX, HapticBall, HapticScene};
use crate::units::Seconds;
use glam::DVec3;

/// Longest time that a ball is carried on without news [s].
const AHEAD_MAX_S: Seconds = 0.008;
/// Time in which a difference dies away [s].
const BLEND_S: Seconds = 0.008;
/// A larger difference is taken over at once [m].
const SNAP_M: f64 = 0.005;
/// Longest time that the servo believes its own stroke without news of it [s].
const OWN_MAX_S: Seconds = 0.05;

/// A ball as it is shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shown {
    /// As the last snapshot, or the last stroke, said.
    pub ball: HapticBall,
    /// Where it is shown [m].
    pub centre: DVec3,
    /// Where it was shown a tick ago [m].
    pub before: DVec3,
    /// Time since `ball` held [s].
    age_s: Seconds,
    /// What is left of the last difference [m], and how long that lasts [s].
    rest: DVec3,
    rest_s: Seconds,
    /// Struck by the hand: by which sample, and how long ago [s].
    own: Option<(u64, Seconds)>,
}

impl Shown {
    fn new(ball: HapticBall) -> Self {
        Shown {
            centre: ball.position,
            before: ball.position,
            ball,
            age_s: 0.0,
            rest: DVec3::ZERO,
            rest_s: 0.0,
            own: None,
        }
    }

    fn predicted(&self) -> DVec3 {
        let limit_s = if self.own.is_some() { OWN_MAX_S } else { AHEAD_MAX_S };
        self.ball.position + self.ball.velocity * self.age_s.min(limit_s)
    }

    fn take(&mut self, ball: HapticBall, sample_seen: u64) {
        if let Some((sample, age_s)) = self.own {
            if sample_seen < sample && age_s < OWN_MAX_S {
                return;
            }
            self.own = None;
        }
        (self.ball, self.age_s) = (ball, 0.0);
        self.rest = self.centre - ball.position;
        if self.rest.length() > SNAP_M {
            self.rest = DVec3::ZERO;
        }
        self.rest_s = BLEND_S;
    }

    fn go_on(&mut self, dt: Seconds) {
        self.age_s += dt;
        if let Some((_, age_s)) = &mut self.own {
            *age_s += dt;
        }
        let left_s = (self.rest_s - dt).max(0.0);
        self.rest *= if self.rest_s > 0.0 { left_s / self.rest_s } else { 0.0 };
        self.rest_s = left_s;
        self.before = self.centre;
        self.centre = self.predicted() + self.rest;
    }
}

/// All balls.
#[derive(Debug, Clone)]
pub(super) struct World {
    balls: [Option<Shown>; BALLS_MAX],
    serial: Option<u64>,
}

impl World {
    pub fn new() -> Self {
        World { balls: [None; BALLS_MAX], serial: None }
    }

    /// The balls, each at its place.
    pub fn balls(&self) -> impl Iterator<Item = (usize, &Shown)> {
        self.balls.iter().enumerate().filter_map(|(i, ball)| Some((i, ball.as_ref()?)))
    }

    /// The ball at a place.
    pub fn ball(&self, index: usize) -> Option<&Shown> {
        self.balls.get(index)?.as_ref()
    }

    /// Carries all balls on by `dt`, and takes over what a new scene says.
    pub fn go_on(&mut self, scene: &HapticScene, dt: Seconds) {
        if self.serial.replace(scene.serial) != Some(scene.serial) {
            self.take(scene);
        }
        self.balls.iter_mut().flatten().for_each(|ball| ball.go_on(dt));
    }

    fn take(&mut self, scene: &HapticScene) {
        for (i, ball) in scene.balls().iter().enumerate() {
            if !ball_is_finite(ball) {
                self.balls[i] = None;
                continue;
            }
            // As a rule the same ball is at the same place; a ball that left moves the others up.
            let known = (i..BALLS_MAX)
                .find(|j| self.balls[*j].as_ref().is_some_and(|shown| shown.ball.id == ball.id));
            if let Some(known) = known {
                self.balls.swap(i, known);
            }
            match &mut self.balls[i] {
                Some(shown) if shown.ball.id == ball.id => shown.take(*ball, scene.sample_seen),
                place => *place = Some(Shown::new(*ball)),
            }
        }
        self.balls[scene.balls().len()..].fill(None);
    }

    /// The hand struck a ball in sample `sample`, `before_end_s` before the end of the tick: it is
    /// at `place` then and goes on like this.
    pub fn struck(
        &mut self,
        index: usize,
        sample: u64,
        before_end_s: Seconds,
        place: DVec3,
        velocity: DVec3,
        angular_velocity: DVec3,
    ) {
        let Some(Some(shown)) = self.balls.get_mut(index) else { return };
        shown.ball = HapticBall { position: place, velocity, angular_velocity, ..shown.ball };
        shown.age_s = before_end_s;
        shown.own = Some((sample, 0.0));
        (shown.rest, shown.rest_s) = (DVec3::ZERO, 0.0);
        shown.centre = shown.predicted();
    }
}

fn ball_is_finite(ball: &HapticBall) -> bool {
    let HapticBall { position, velocity, angular_velocity, radius_m, .. } = ball;
    position.is_finite()
        && velocity.is_finite()
        && angular_velocity.is_finite()
        && radius_m.is_finite()
        && ball.inverse_mass.is_finite()
        && ball.inverse_inertia.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::BallId;

    fn scene(serial: u64, balls: &[(u16, f64, f64)]) -> HapticScene {
        let mut scene = HapticScene { serial, ..HapticScene::default() };
        for (id, x, v) in balls {
            scene.add(HapticBall {
                id: BallId(*id),
                position: DVec3::X * *x,
                velocity: DVec3::X * *v,
                radius_m: 0.0286,
                ..HapticBall::NONE
            });
        }
        scene
    }

    #[test]
    fn a_rolling_ball_is_shown_without_a_jump_whatever_the_rate_of_snapshots() {
        // 2 m/s, news every 4 ms, each 1 ms late and a little off.
        let mut world = World::new();
        let mut last: Option<f64> = None;
        for tick in 0..400_u32 {
            let told = tick / 4 * 4;
            let wobble = if told % 8 == 0 { 1e-4 } else { -1e-4 };
            let x = 2.0 * (f64::from(told) - 1.0) * 0.001 + wobble;
            world.go_on(&scene(u64::from(told), &[(1, x, 2.0)]), 0.001);
            let now = world.ball(0).unwrap().centre.x;
            if let Some(last) = last {
                // 2 mm a tick, and at most a share of the wobble on top.
                assert!((now - last - 0.002).abs() < 0.000_1, "{tick}: {}", now - last);
            }
            last = Some(now);
        }
    }

    #[test]
    fn without_news_a_ball_stands_after_8_ms() {
        let mut world = World::new();
        for _ in 0..30 {
            world.go_on(&scene(7, &[(1, 0.0, 1.0)]), 0.001);
        }
        assert!((world.ball(0).unwrap().centre.x - 0.008).abs() < 1e-12);
    }

    #[test]
    fn a_ball_that_is_put_elsewhere_is_there_at_once_and_one_that_left_is_gone() {
        let mut world = World::new();
        world.go_on(&scene(1, &[(0, 0.0, 0.0), (1, 1.0, 0.0), (2, 2.0, 0.0)]), 0.001);
        world.go_on(&scene(2, &[(0, 0.5, 0.0), (2, 2.001, 0.0)]), 0.001);
        let shown: Vec<(u16, f64)> =
            world.balls().map(|(_, ball)| (ball.ball.id.0, ball.centre.x)).collect();
        assert_eq!(shown[0], (0, 0.5));
        assert_eq!(shown[1].0, 2);
        assert!(2.0 < shown[1].1 && shown[1].1 < 2.001);
        assert_eq!(shown.len(), 2);
    }

    #[test]
    fn a_snapshot_that_does_not_know_of_the_stroke_does_not_undo_it() {
        let mut world = World::new();
        world.go_on(&scene(1, &[(0, 0.0, 0.0)]), 0.001);
        world.struck(0, 5, 0.0005, DVec3::ZERO, DVec3::X, DVec3::ZERO);
        for serial in 2..12 {
            let scene = HapticScene { sample_seen: 4, ..scene(serial, &[(0, 0.0, 0.0)]) };
            world.go_on(&scene, 0.001);
        }
        assert!((world.ball(0).unwrap().centre.x - 0.0105).abs() < 1e-12);
        // One that knows is believed, without a jump.
        let knows = HapticScene { sample_seen: 5, ..scene(12, &[(0, 0.011, 1.0)]) };
        world.go_on(&knows, 0.001);
        let shown = world.ball(0).unwrap();
        assert!((shown.centre.x - shown.before.x - 0.001).abs() < 0.000_3);
    }
}
