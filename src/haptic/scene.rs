//! What the servo is told of the world: one plain value, handed over whole.
//!
//! It is `Copy` and has a fixed size, so that a latest-value slot can carry it without a lock or
//! an allocation, and a tick never sees half of a change (paper, section 3.3.1).

use super::anchor::Anchor;
use super::effect::EffectSet;
use super::settings::ReachSettings;
use crate::ball::{Ball, BallState};
use crate::cue::Aim;
use crate::ids::BallId;
use crate::physics::laws::Mover;
use crate::physics::{Contact, Parameters};
use crate::units::Seconds;
use glam::DVec3;

/// The pivot's place in the device frame, as a share of half the depth towards −z (paper, section
/// 3.3.3).
pub(super) const BALL_SHARE: f64 = 0.4;

/// Most balls that can be felt at a time: those of snooker.
pub const BALLS_MAX: usize = 22;

/// Everything that the servo renders from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HapticScene {
    /// Counts up with every scene that is handed over: the heartbeat of the world. A servo that
    /// sees the same number for too long fades its force out.
    pub serial: u64,
    /// Nothing is felt while this is false: the dead man's switch of whoever hands scenes over.
    pub live: bool,
    /// Time of the balls below [s].
    pub time_s: Seconds,
    /// The last [`StylusSample`](super::StylusSample) that physics had taken in at that time; balls
    /// that are older than a stroke do not undo it.
    pub sample_seen: u64,
    /// Forces that belong to no body: menus, camera, aids. In the device frame.
    pub effects: EffectSet,
    /// How the device reaches into the world; none: only effects are felt.
    pub reach: Option<Reach>,
    /// What holds the hand while it leads no cue; the effects above are its.
    pub anchor: Option<Anchor>,
    /// The balls in play; only the first `ball_count` count.
    pub balls: [HapticBall; BALLS_MAX],
    /// How many there are.
    pub ball_count: usize,
}

impl Default for HapticScene {
    fn default() -> Self {
        HapticScene {
            serial: 0,
            live: true,
            time_s: 0.0,
            sample_seen: 0,
            effects: EffectSet::default(),
            reach: None,
            anchor: None,
            balls: [HapticBall::NONE; BALLS_MAX],
            ball_count: 0,
        }
    }
}

impl HapticScene {
    /// The balls in play.
    pub fn balls(&self) -> &[HapticBall] {
        &self.balls[..self.ball_count.min(BALLS_MAX)]
    }

    /// Adds a ball. False if there is no room: then it is not felt.
    pub fn add(&mut self, ball: HapticBall) -> bool {
        let has_room = self.ball_count < BALLS_MAX;
        if has_room {
            self.balls[self.ball_count] = ball;
            self.ball_count += 1;
        }
        has_room
    }
}

/// A ball as the servo is told of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HapticBall {
    /// Its name.
    pub id: BallId,
    /// Centre [m].
    pub position: DVec3,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
    /// Radius [m].
    pub radius_m: f64,
    /// 1/m [1/kg]; zero for a ball that does not move.
    pub inverse_mass: f64,
    /// 1/I [1/(kg m²)].
    pub inverse_inertia: f64,
}

impl HapticBall {
    /// Fills an unused place.
    pub const NONE: HapticBall = HapticBall {
        id: BallId::CUE,
        position: DVec3::ZERO,
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        radius_m: 0.0,
        inverse_mass: 0.0,
        inverse_inertia: 0.0,
    };

    /// A ball in motion.
    pub fn of(ball: &Ball, state: &BallState) -> Self {
        let mover = Mover::new(ball, state.velocity, state.angular_velocity);
        HapticBall {
            id: ball.id,
            position: state.position,
            velocity: state.velocity,
            angular_velocity: state.angular_velocity,
            radius_m: ball.radius_m,
            inverse_mass: mover.inverse_mass,
            inverse_inertia: mover.inverse_inertia,
        }
    }
}

/// How the workspace of the device lies in the world (paper, section 3.3.3).
///
/// The device's point (0, 0, −0.4 · depth/2) lies on the pivot. From there −z of the device points
/// along the azimuth, lowered by the elevation; x to the right. The servo itself turns it while the
/// stylus pushes an edge, and tells where it is in its report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Counts up when the workspace is laid anew; the angles below hold from then on.
    pub serial: u32,
    /// What it turns about: the middle of the ball to be struck [m].
    pub pivot: DVec3,
    /// Horizontal direction of −z of the device, anticlockwise from +x [rad].
    pub azimuth_rad: f64,
    /// How far that direction is lowered [rad].
    pub elevation_rad: f64,
    /// Metres of the world per metre of the device.
    pub scale: f64,
    /// Further factor along the shaft during a stroke.
    pub stroke_gain: f64,
    /// Whether the edges turn it.
    pub turns: bool,
    /// Whether what the tip touches is felt.
    pub solid: bool,
    /// Radius of the sphere that stands for the tip [m].
    pub tip_radius_m: f64,
    /// The cue that can strike; none: everything is only touched.
    pub cue: Option<CueBody>,
}

impl Reach {
    /// Whether it can be reckoned with. One that cannot is not reached at all.
    pub(super) fn is_sound(&self) -> bool {
        let angles = self.azimuth_rad.is_finite() && self.elevation_rad.is_finite();
        let factors = [self.scale, self.stroke_gain, self.tip_radius_m];
        let cue = self.cue.is_none_or(|cue| {
            let CueBody { mass_kg, end_mass_kg, contact, coupling_rad_s } = cue;
            let Contact { restitution, friction } = contact;
            [mass_kg, end_mass_kg, coupling_rad_s].iter().all(|x| 0.0 < *x && x.is_finite())
                && restitution.is_finite()
                && friction.is_finite()
        });
        angles && cue && self.pivot.is_finite() && factors.iter().all(|x| 0.0 < *x && *x < 1e6)
    }

    /// The workspace behind a ball whose middle is at `pivot`, in the direction of `aim`.
    pub fn to_ball(
        serial: u32,
        pivot: DVec3,
        aim: &Aim,
        settings: &ReachSettings,
        parameters: &Parameters,
    ) -> Self {
        Reach {
            serial,
            pivot,
            azimuth_rad: aim.azimuth_rad,
            elevation_rad: aim.elevation_rad,
            scale: settings.scale,
            stroke_gain: settings.stroke_gain,
            turns: true,
            solid: true,
            tip_radius_m: parameters.tip_radius_m,
            cue: Some(CueBody::of(parameters)),
        }
    }

    /// The workspace round everything between `low` and `high` [m], seen along +x: its middle is
    /// theirs, and its scale such that a tip gets round them in height and width. Nothing can be
    /// struck.
    pub fn around(
        serial: u32,
        low: DVec3,
        high: DVec3,
        tip_radius_m: f64,
        settings: &ReachSettings,
    ) -> Self {
        // The device's width is the world's y, its height the world's z.
        let size = (high - low).max(DVec3::ZERO) + DVec3::splat(4.0 * tip_radius_m);
        let room = settings.box_m - DVec3::splat(2.0 * settings.edge_m);
        let scale = (size.y / room.x).max(size.z / room.y);
        let ahead_m = 0.5 * BALL_SHARE * settings.box_m.z * scale;
        Reach {
            serial,
            pivot: 0.5 * (low + high) + DVec3::X * ahead_m,
            azimuth_rad: 0.0,
            elevation_rad: 0.0,
            scale,
            stroke_gain: 1.0,
            turns: true,
            solid: true,
            tip_radius_m,
            cue: None,
        }
    }
}

/// The cue, as the law of the stroke sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CueBody {
    /// Mass along the shaft [kg].
    pub mass_kg: f64,
    /// Effective mass of the end across the shaft [kg].
    pub end_mass_kg: f64,
    /// Restitution and friction of the tip.
    pub contact: Contact,
    /// Rate at which the hand draws the cue back to its path after a contact [rad/s].
    pub coupling_rad_s: f64,
}

impl CueBody {
    /// The cue of these parameters.
    pub fn of(parameters: &Parameters) -> Self {
        CueBody {
            mass_kg: parameters.cue_mass_kg,
            end_mass_kg: parameters.cue_end_mass_kg,
            contact: parameters.tip,
            coupling_rad_s: parameters.cue_coupling_rad_s,
        }
    }
}
