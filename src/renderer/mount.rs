//! The ball that the eye hangs on: it is drawn by a spring to where the eye should be, swings a
//! little when that stops, and does not go through walls, table and lamp (paper, section 2.2.1).

use crate::input::{CameraPose, HumanView, Room};
use crate::physics::Snapshot;
use crate::physics::spring::Damped;
use crate::units::Seconds;
use glam::DVec3;

/// The spring: 3 Hz, damped so that what overshoots is a twelfth of the way.
const OMEGA_RAD_S: f64 = 19.0;
const DAMPING_RATIO: f64 = 0.62;
/// What is left of a speed into a wall.
const RESTITUTION: f64 = 0.3;
/// The longest step [s]: fast eyes do not jump through a lamp.
const STEP_S: Seconds = 0.004;
/// The longest time that is caught up with [s]: whoever was away longer finds the eye in place.
const LONGEST_S: Seconds = 0.25;
/// What goes faster is no way but a jump [m/s]: the eye is drawn there, and not thrown.
const FASTEST_M_S: f64 = 12.0;
/// Nearer and slower than this [m, m/s] the eye is there: what rests is not drawn again.
const REST: (f64, f64) = (2e-5, 2e-4);

/// The mount of an eye.
#[derive(Debug, Clone, Default)]
pub struct Mount {
    hung: Option<Hung>,
    /// How far the ball that the eye goes with had gone when it was last seen [m], and from where.
    ridden: Option<(DVec3, DVec3)>,
}

#[derive(Debug, Clone, Copy)]
struct Hung {
    at: DVec3,
    velocity: DVec3,
    /// Where it should have been, the last time.
    wanted: DVec3,
}

impl Mount {
    /// The same view with an eye that goes with its ball, where that is in this world. A ball that
    /// falls leaves the eye where it fell.
    pub fn carry(&mut self, mut view: HumanView, world: &Snapshot) -> HumanView {
        let Some((ball, from)) = view.rides else {
            self.ridden = None;
            return view;
        };
        let seen = world.on_table().find(|one| one.id == ball);
        let by = seen.map(|ball| (ball.position - from).with_z(0.0));
        let last = self.ridden.filter(|(of, _)| *of == from).map(|(_, by)| by);
        let by = by.or(last).unwrap_or(DVec3::ZERO);
        self.ridden = Some((from, by));
        view.camera.eye += by;
        view.camera.target += by;
        view
    }

    /// The picture `dt` after the last one: the eye that should be at `wanted` hangs here.
    pub fn hang(&mut self, wanted: &CameraPose, room: &Room, dt: Seconds) -> CameraPose {
        let Some(mut hung) = self.hung.filter(|_| (0.0..=LONGEST_S).contains(&dt)) else {
            let at = room.outside(wanted.eye, wanted.eye);
            self.hung = Some(Hung { at, velocity: DVec3::ZERO, wanted: wanted.eye });
            return CameraPose { eye: at, ..*wanted };
        };
        let steps = (dt / STEP_S).ceil().max(1.0);
        let (h, way) = (dt / steps, (wanted.eye - hung.wanted) / dt.max(1e-9));
        let is_jump = !(way.length() < FASTEST_M_S);
        let (from, speed) = if is_jump { (wanted.eye, DVec3::ZERO) } else { (hung.wanted, way) };
        let count = if 0.0 < dt { steps as u32 } else { 0 };
        for left in (0..count).rev() {
            let anchor = from + speed * (dt - f64::from(left) * h);
            hung.step(anchor, speed, room, h);
        }
        hung.wanted = wanted.eye;
        let (off, slow) = REST;
        let is_still = speed == DVec3::ZERO && hung.velocity.length() < slow;
        if is_still && hung.at.distance(wanted.eye) < off {
            (hung.at, hung.velocity) = (wanted.eye, DVec3::ZERO);
        }
        self.hung = Some(hung);
        CameraPose { eye: hung.at, ..*wanted }
    }
}

impl Hung {
    /// One step towards an anchor that moves at this speed. The damper joins the ball to its
    /// anchor, so an anchor that moves evenly is followed without a lag.
    fn step(&mut self, anchor: DVec3, speed: DVec3, room: &Room, h: Seconds) {
        let spring = Damped { omega: OMEGA_RAD_S, sigma: DAMPING_RATIO * OMEGA_RAD_S };
        let came = self.velocity;
        let offset = self.at - (anchor - speed * h);
        let (offset, velocity) = spring.after(offset, self.velocity - speed, h);
        let (at, velocity) = (anchor + offset, velocity + speed);
        let free = room.outside(at, anchor);
        let out = free - at;
        self.at = free;
        self.velocity = velocity;
        if out != DVec3::ZERO {
            let normal = out.normalize();
            // It bounces as fast as it came, not as hard as it is drawn.
            let bounce = -RESTITUTION * came.dot(normal).min(0.0);
            self.velocity += normal * (bounce - velocity.dot(normal).min(0.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::{BallPlace, BallState};
    use crate::ids::BallId;
    use crate::table::Bed;

    const DT: Seconds = 1.0 / 60.0;

    fn at(eye: DVec3) -> CameraPose {
        CameraPose { eye, target: DVec3::ZERO, ..CameraPose::default() }
    }

    fn free() -> Room {
        Room::default()
    }

    #[test]
    fn an_eye_that_stops_swings_and_comes_to_rest() {
        let mut mount = Mount::default();
        let speed = 1.5;
        let mut way = 0.0;
        mount.hang(&at(DVec3::ZERO), &free(), DT);
        for _ in 0..120 {
            way += speed * DT;
            mount.hang(&at(DVec3::X * way), &free(), DT);
        }
        // Moving evenly it is where it is wanted.
        let hung = mount.hung.unwrap();
        assert!((hung.at.x - way).abs() < 1e-6 && (hung.velocity.x - speed).abs() < 1e-5);
        let mut farthest: f64 = 0.0;
        for _ in 0..90 {
            farthest = farthest.max(mount.hang(&at(DVec3::X * way), &free(), DT).eye.x - way);
        }
        // x'' = −ω² x − 2 ζ ω x' from x' = v: the greatest x is v/ω e^(−ζ φ/√(1−ζ²)), φ = acos ζ.
        let root = (1.0 - DAMPING_RATIO * DAMPING_RATIO).sqrt();
        let phi = libm::acos(DAMPING_RATIO);
        let most = speed / OMEGA_RAD_S * libm::exp(-DAMPING_RATIO * phi / root);
        assert!((farthest - most).abs() < 0.05 * most, "{farthest} {most}");
        let rest = mount.hang(&at(DVec3::X * way), &free(), DT);
        assert_eq!(rest.eye, DVec3::X * way, "to the bit: nothing is drawn again");
    }

    #[test]
    fn how_often_a_picture_is_drawn_changes_nothing() {
        let room = Room::round(Some(&Bed { length_m: 2.54, width_m: 1.27 }));
        let hang = |n: u32| {
            let mut mount = Mount::default();
            mount.hang(&at(DVec3::new(0.0, -1.5, 0.6)), &room, 0.0);
            let mut last = DVec3::ZERO;
            for k in 1..=n {
                let way = 0.4 * f64::from(k) / f64::from(n);
                let wanted = at(DVec3::new(way, -1.5, 0.6));
                last = mount.hang(&wanted, &room, 0.4 / f64::from(n)).eye;
            }
            last
        };
        assert!(hang(10).distance(hang(100)) < 1e-9, "{} {}", hang(10), hang(100));
    }

    #[test]
    fn it_stops_at_walls_and_at_the_table_however_hard_it_is_drawn() {
        let room = Room::round(Some(&Bed { length_m: 2.54, width_m: 1.27 }));
        let mut mount = Mount::default();
        for (k, eye) in [
            DVec3::new(-2.0, 0.0, 0.5),
            DVec3::new(-9.0, 1.0, 0.5),
            DVec3::new(0.3, 0.2, -0.4),
            DVec3::new(0.3, 0.2, 7.0),
            DVec3::new(3.0, -9.0, -2.0),
        ]
        .into_iter()
        .cycle()
        .take(20)
        .enumerate()
        {
            for dt in [0.005, 0.016, 0.07].into_iter().cycle().take(60 + k) {
                let hung = mount.hang(&at(eye), &room, dt).eye;
                assert!(
                    hung.is_finite() && room.outside(hung, eye).distance(hung) < 1e-9,
                    "{hung}"
                );
            }
        }
        // In front of a wall it comes to rest.
        for _ in 0..200 {
            mount.hang(&at(DVec3::new(-9.0, 0.0, 0.5)), &room, DT);
        }
        let hung = mount.hung.unwrap();
        assert!(hung.velocity.length() < 1e-3 && hung.at.x < -3.9, "{hung:?}");
    }

    #[test]
    fn an_eye_that_jumps_is_drawn_there_and_not_thrown() {
        let mut mount = Mount::default();
        mount.hang(&at(DVec3::ZERO), &free(), DT);
        let far = (0..120).map(|_| mount.hang(&at(DVec3::X * 2.0), &free(), DT).eye.x);
        let farthest = far.fold(0.0, f64::max);
        // The overshoot of a step response, e^(−πζ/√(1−ζ²)), of two metres.
        let zeta = DAMPING_RATIO / (1.0 - DAMPING_RATIO * DAMPING_RATIO).sqrt();
        let most = 2.0 * (1.0 + libm::exp(-std::f64::consts::PI * zeta));
        assert!(2.0 < farthest && farthest < most + 1e-3, "{farthest} {most}");
    }

    #[test]
    fn a_ball_that_falls_leaves_the_eye_where_it_fell() {
        let mut mount = Mount::default();
        let rides = Some((BallId::CUE, DVec3::ZERO));
        let view = HumanView { rides, camera: at(DVec3::Z), ..HumanView::default() };
        let world = |x: f64, place| {
            let ball = BallState { place, ..BallState::at_rest(BallId::CUE, DVec3::X * x) };
            Snapshot { balls: vec![ball], ..Snapshot::default() }
        };
        let mut eye = |x, place| mount.carry(view.clone(), &world(x, place)).camera.eye.x;
        assert_eq!(eye(0.7, BallPlace::OnTable), 0.7);
        assert_eq!(eye(9.0, BallPlace::OffTable), 0.7);
    }

    #[test]
    fn whoever_was_away_finds_it_in_place() {
        let mut mount = Mount::default();
        mount.hang(&at(DVec3::ZERO), &free(), DT);
        assert_eq!(mount.hang(&at(DVec3::ONE), &free(), 3.0).eye, DVec3::ONE);
        assert_eq!(mount.hang(&at(DVec3::NEG_ONE), &free(), f64::NAN).eye, DVec3::NEG_ONE);
        let mut mount = Mount::default();
        assert_eq!(mount.hang(&at(DVec3::X), &free(), DT).eye, DVec3::X);
    }
}
