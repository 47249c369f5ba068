//! The workspace of the device in the world: where it lies, how its edges turn it, and the stroke
//! stabiliser (paper, section 3.3.3).

use super::device::{Buttons, DeviceState};
use super::scene::{BALL_SHARE, Reach};
use super::settings::ReachSettings;
use crate::units::Seconds;
use glam::{DMat3, DVec3};

/// A line that the tip is held to while the front button is.
#[derive(Debug, Clone, Copy)]
struct Stroke {
    /// Where it began: of the tip [m, world], of the device [m].
    tip: DVec3,
    device: DVec3,
    /// Unit vectors along the shaft.
    direction: DVec3,
    device_direction: DVec3,
}

/// The workspace in the world.
#[derive(Debug, Clone)]
pub(super) struct Workspace {
    laid: Option<Reach>,
    azimuth_rad: f64,
    elevation_rad: f64,
    stroke: Option<Stroke>,
    was_down: bool,
    /// How far the tip still is from where the device is, after a stroke, and for how long.
    away: DVec3,
    away_s: Seconds,
}

/// Where the hand is in the world.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    /// Where the device would have the tip [m].
    pub target: DVec3,
    /// Unit vector along the shaft.
    pub direction: DVec3,
    /// From the device frame to the world, without scale.
    pub turn: DMat3,
    /// Where the origin of the device frame lies in the world [m].
    pub origin: DVec3,
    /// What the workspace turns about [m].
    pub pivot: DVec3,
    /// Metres of the world per metre of the device, along the shaft and across it.
    pub along: f64,
    /// See above.
    pub across: f64,
    /// The stabiliser holds.
    pub stabilised: bool,
    /// What the edges and the line of the stabiliser do to the device [N].
    pub force: DVec3,
    /// The workspace was laid anew.
    pub is_new: bool,
}

impl Placed {
    /// A way in the world as the device has it [m].
    pub fn in_device(&self, way: DVec3) -> DVec3 {
        let along = way.dot(self.direction);
        let across = way - self.direction * along;
        self.turn.transpose() * (across / self.across + self.direction * (along / self.along))
    }
}

impl Workspace {
    pub fn new() -> Self {
        Workspace {
            laid: None,
            azimuth_rad: 0.0,
            elevation_rad: 0.0,
            stroke: None,
            // What is down at first was pressed for something else.
            was_down: true,
            away: DVec3::ZERO,
            away_s: 0.0,
        }
    }

    /// The direction that it lies in, and how far that is lowered [rad].
    pub fn angles(&self) -> (f64, f64) {
        (self.azimuth_rad, self.elevation_rad)
    }

    /// Nothing is reached.
    pub fn leave(&mut self) {
        *self = Workspace::new();
    }

    /// A tick: turns the workspace, and says where the hand is. `tip` is where the tip was felt
    /// last, from which a stroke begins.
    pub fn place(
        &mut self,
        reach: &Reach,
        device: &DeviceState,
        tip: DVec3,
        settings: &ReachSettings,
        dt: Seconds,
    ) -> Placed {
        let is_new = self.laid.is_none_or(|laid| laid.serial != reach.serial);
        if is_new {
            *self = Workspace { was_down: self.was_down, ..Workspace::new() };
            (self.azimuth_rad, self.elevation_rad) = (reach.azimuth_rad, reach.elevation_rad);
        }
        // The pivot holds until it is laid anew; what else is asked for may change at any time.
        let pivot = self.laid.filter(|_| !is_new).map_or(reach.pivot, |laid| laid.pivot);
        self.laid = Some(Reach { pivot, ..*reach });

        let mut force = if reach.turns { edges(device.position, settings) } else { DVec3::ZERO };
        if reach.turns && self.stroke.is_none() {
            self.turn(device.position, settings, dt);
        }
        let turn = self.frame();
        let ball = DVec3::new(0.0, 0.0, -0.5 * BALL_SHARE * settings.box_m.z);
        let mapped = pivot + turn * (device.position - ball) * reach.scale;
        let pointing = (turn * device.pointing()).normalize_or(-turn.z_axis);

        let is_down = device.buttons.has(Buttons::FRONT);
        let was_down = std::mem::replace(&mut self.was_down, is_down);
        let is_pressed = is_down && !was_down;
        // A button that was pressed for something else begins no stroke.
        let is_held = is_down && reach.cue.is_some();
        if is_pressed && is_held {
            self.stroke = Some(Stroke {
                tip: if is_new { mapped } else { tip },
                device: device.position,
                direction: pointing,
                device_direction: device.pointing(),
            });
        }
        self.away_s = (self.away_s - dt).max(0.0);
        let placed = Placed {
            target: mapped + self.away * self.share_away(settings),
            direction: pointing,
            turn,
            origin: pivot - turn * ball * reach.scale,
            pivot,
            along: reach.scale,
            across: reach.scale,
            stabilised: false,
            force,
            is_new,
        };
        let Some(stroke) = self.stroke else { return placed };

        let moved = device.position - stroke.device;
        let along_m = moved.dot(stroke.device_direction);
        let along = reach.scale * reach.stroke_gain;
        let target = stroke.tip + stroke.direction * (along * along_m);
        if is_held {
            force += settings.line_stiffness_n_m * (stroke.device_direction * along_m - moved);
            let direction = stroke.direction;
            return Placed { target, direction, along, stabilised: true, force, ..placed };
        }
        // Let go: the tip goes back to the device.
        self.stroke = None;
        (self.away, self.away_s) = (target - mapped, settings.release_s);
        Placed { target, ..placed }
    }

    /// Smoothly from one to zero while the tip goes back.
    fn share_away(&self, settings: &ReachSettings) -> f64 {
        if self.away_s <= 0.0 {
            return 0.0;
        }
        let s = (self.away_s / settings.release_s).min(1.0);
        s * s * (3.0 - 2.0 * s)
    }

    /// Pushing the left or right edge turns the workspace about the vertical through the pivot,
    /// pushing the top raises the butt, pushing the bottom lowers it.
    fn turn(&mut self, position: DVec3, settings: &ReachSettings, dt: Seconds) {
        let half = 0.5 * settings.box_m - DVec3::splat(settings.edge_m);
        let rate = |x: f64, half: f64| {
            let beyond = (x.abs() - half).max(0.0) * settings.turn_rad_s_m;
            beyond.min(settings.turn_max_rad_s).copysign(x)
        };
        // To the right is clockwise from above.
        let turned = self.azimuth_rad - rate(position.x, half.x) * dt;
        self.azimuth_rad = libm::remainder(turned, std::f64::consts::TAU);
        self.elevation_rad = (self.elevation_rad + rate(position.y, half.y) * dt)
            .clamp(0.0, settings.elevation_max_rad);
    }

    /// From the device frame to the world: columns are the world's view of right, up and back.
    fn frame(&self) -> DMat3 {
        let (sin_a, cos_a) = libm::sincos(self.azimuth_rad);
        let (sin_e, cos_e) = libm::sincos(self.elevation_rad);
        let right = DVec3::new(sin_a, -cos_a, 0.0);
        let ahead = DVec3::new(cos_e * cos_a, cos_e * sin_a, -sin_e);
        DMat3::from_cols(right, right.cross(ahead), -ahead)
    }
}

/// Four planes at the edges that turn the workspace [N].
fn edges(position: DVec3, settings: &ReachSettings) -> DVec3 {
    let half = 0.5 * settings.box_m - DVec3::splat(settings.edge_m);
    let push =
        |x: f64, half: f64| -settings.edge_stiffness_n_m * (x.abs() - half).max(0.0).copysign(x);
    DVec3::new(push(position.x, half.x), push(position.y, half.y), 0.0)
}
