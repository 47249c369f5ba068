//! What a picture shows of a haptic device: stylus or cue, what holds it back, force, workspace.
//!
//! The tool ends where the proxy is, outside of everything: that is what the hand feels. Where the
//! device would have the tip is a small ball that shines through, tied to the proxy: the depth.

use super::draw_list::{DrawList, Solid, SolidShape, StylusPose, held};
use crate::cue::CuePose;
use crate::haptic::{ReachSettings, ServoReport, WorkspacePose};
use glam::DVec3;

/// Length of the arrow [m of the device per N]: the greatest force of an Omni is 8 cm.
const ARROW_M_PER_N: f64 = 0.024;
/// A smaller force shows no arrow [N].
const ARROW_LEAST_N: f64 = 0.02;
/// Half the width of the arrow's shaft, of its head, and the head's length [m of the device].
const ARROW_M: [f64; 3] = [0.0016, 0.0042, 0.011];
/// Half the width of an edge of the workspace, of one that is pushed, and of other thin lines [m of
/// the device].
const LINE_M: [f64; 3] = [0.000_25, 0.000_6, 0.000_4];
/// A tip that is kept back by less than this touches nothing worth showing [m of the device].
const DEPTH_LEAST_M: f64 = 5e-5;

const EDGE: [f32; 4] = [0.85, 0.9, 1.0, 0.16];
const PUSHED: [f32; 4] = [1.0, 0.72, 0.3, 0.7];
const PLUMB: [f32; 4] = [0.85, 0.9, 1.0, 0.3];
const CONTACT: [f32; 4] = [1.0, 1.0, 1.0, 0.95];
const TIP: [f32; 4] = [0.16, 0.33, 0.47, 1.0];

/// What is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FeltTool {
    /// The stylus of the device: it only touches.
    Stylus,
    /// The cue that the game strikes with.
    Cue,
}

/// What does not change about a device in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeltLook {
    /// What is held.
    pub tool: FeltTool,
    /// The largest force [N].
    pub force_max_n: f64,
    /// The box from the middle to the planes that are felt at its edges [m, device].
    pub half_m: DVec3,
}

impl FeltLook {
    /// A device that renders `force_max_n` at most, in this workspace.
    pub fn new(tool: FeltTool, force_max_n: f64, reach: &ReachSettings) -> Self {
        let edge = DVec3::new(reach.edge_m, reach.edge_m, 0.0);
        FeltLook { tool, force_max_n, half_m: 0.5 * reach.box_m - edge }
    }
}

/// Green without force, over yellow to red at the largest one; sRGB.
pub fn force_colour(share: f64) -> [f32; 3] {
    let s = share.clamp(0.0, 1.0) as f32;
    let (low, middle, high) = ([0.36, 0.84, 0.42], [0.98, 0.82, 0.25], [0.95, 0.24, 0.16]);
    let mix = |a: [f32; 3], b: [f32; 3], t: f32| std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t);
    if s < 0.5 { mix(low, middle, 2.0 * s) } else { mix(middle, high, 2.0 * s - 1.0) }
}

impl DrawList {
    /// Adds what a tick of the servo was. A cue takes the place of the one that the world shows.
    pub fn show_felt(&mut self, report: &ServoReport, look: &FeltLook) {
        let Some(workspace) = &report.workspace else { return };
        let brush = Brush { report, workspace, look };
        brush.workspace(&mut self.solids);
        brush.tool(self);
        brush.contact(&mut self.solids);
        brush.force(&mut self.solids);
    }
}

struct Brush<'a> {
    report: &'a ServoReport,
    workspace: &'a WorkspacePose,
    look: &'a FeltLook,
}

impl Brush<'_> {
    fn line(&self, from: DVec3, to: DVec3, half_width_m: f64, colour: [f32; 4]) -> Solid {
        let radius_m = (half_width_m * self.workspace.scale) as f32;
        Solid::between(SolidShape::Cylinder, from, to, radius_m, colour)
    }

    /// The twelve edges of the box; those of a face that is pushed stand out.
    fn workspace(&self, solids: &mut Vec<Solid>) {
        let (half, at) = (self.look.half_m, self.report.sample.device.position);
        let corner = |x: f64, y: f64, z: f64| self.workspace.to_world(half * DVec3::new(x, y, z));
        let is_pushed = |axis: usize, side: f64| axis < 2 && side * at[axis] > half[axis];
        let signs = [-1.0, 1.0];
        for axis in 0..3 {
            let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
            for (sign_b, sign_c) in signs.iter().flat_map(|b| signs.map(|c| (*b, c))) {
                let end = |sign: f64| {
                    let mut place = [0.0; 3];
                    (place[axis], place[b], place[c]) = (sign, sign_b, sign_c);
                    corner(place[0], place[1], place[2])
                };
                let stands_out = is_pushed(b, sign_b) || is_pushed(c, sign_c);
                let (width, colour) =
                    if stands_out { (LINE_M[1], PUSHED) } else { (LINE_M[0], EDGE) };
                solids.push(self.line(end(-1.0), end(1.0), width, colour));
            }
        }
    }

    /// Where the tool ends [m]: at a stroke the tip goes through to the ball.
    fn tip(&self) -> DVec3 {
        let sample = &self.report.sample;
        if sample.stabilised { sample.tip } else { self.report.proxy }
    }

    fn tool(&self, list: &mut DrawList) {
        let (tip, direction) = (self.tip(), self.report.sample.direction);
        if self.look.tool == FeltTool::Cue {
            let (velocity, solid) = (self.report.sample.velocity, self.report.sample.stabilised);
            let cue = CuePose { tip, direction, velocity, solid };
            list.cue = Some(held(cue, self.workspace.tip_radius_m));
            return;
        }
        let radius_m = self.workspace.tip_radius_m as f32;
        list.solids.push(Solid::ball(tip, radius_m, TIP));
        list.stylus = Some(StylusPose {
            tip: tip.as_vec3().to_array(),
            direction: direction.as_vec3().to_array(),
            scale: self.workspace.scale as f32,
        });
        // Where it is over the floor of the box.
        let down = self.workspace.turn.y_axis * self.workspace.scale;
        let height = (tip - self.workspace.origin).dot(self.workspace.turn.y_axis)
            / self.workspace.scale
            + self.look.half_m.y;
        if height > 0.0 {
            list.solids.push(self.line(tip, tip - down * height, LINE_M[2], PLUMB));
            list.solids.push(Solid::ball(tip - down * height, 0.4 * radius_m, PLUMB));
        }
    }

    /// The proxy's point of contact, and how deep the device would have the tip.
    fn contact(&self, solids: &mut Vec<Solid>) {
        let report = self.report;
        if report.sample.stabilised || report.depth_m < DEPTH_LEAST_M {
            return;
        }
        let radius_m = self.workspace.tip_radius_m;
        let into = (report.target - report.proxy).normalize_or_zero();
        let touched = report.proxy + into * radius_m;
        let [r, g, b] = self.colour();
        let tie = self.line(report.proxy, report.target, 2.0 * LINE_M[2], [r, g, b, 0.8]);
        solids.push(tie.over());
        let inside = [r, g, b, 0.6];
        solids.push(Solid::ball(report.target, 0.6 * radius_m as f32, inside).over());
        solids.push(Solid::ball(touched, 0.3 * radius_m as f32, CONTACT).over());
    }

    fn colour(&self) -> [f32; 3] {
        force_colour(self.report.force.0.length() / self.look.force_max_n)
    }

    /// An arrow as long as the force on the hand, from where it acts.
    fn force(&self, solids: &mut Vec<Solid>) {
        let (force, scale) = (self.report.force.0, self.workspace.scale);
        let newtons = force.length();
        if !(newtons > ARROW_LEAST_N) {
            return;
        }
        let way = self.workspace.turn * force / newtons;
        let length = ARROW_M_PER_N * newtons * scale;
        let head = (ARROW_M[2] * scale).min(0.6 * length);
        let from = self.tip();
        let (neck, end) = (from + way * (length - head), from + way * length);
        let [r, g, b] = self.colour();
        let colour = [r, g, b, 0.95];
        let (shaft_m, head_m) = ((ARROW_M[0] * scale) as f32, (ARROW_M[1] * scale) as f32);
        let shaft = Solid::between(SolidShape::Cylinder, from, neck, shaft_m, colour);
        let point = Solid::between(SolidShape::Cone, neck, end, head_m, colour);
        solids.extend([shaft.over(), point.over()]);
    }
}
