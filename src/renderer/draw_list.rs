//! The draw list: what is where in one picture, in `f32` as graphics cards want it.

use super::look::{BallLook, BallSet};
use crate::ball::{BallPlace, BallState, POOL_RADIUS_M};
use crate::cue::{CuePose, TIP_RADIUS_M};
use crate::ids::BallId;
use crate::input::{BallWay, CameraPose, HumanMode, HumanView};
use crate::physics::Snapshot;
use glam::{DQuat, DVec2, DVec3};

/// How far lines float above the cloth [m]: above the marks on it, and no eye sees a gap.
const LINE_LIFT_M: f64 = 0.0015;
/// Half the width of an aim line [m].
const LINE_HALF_WIDTH_M: f32 = 0.0016;
/// Radius of the ring round a called ball [m].
const CALLED_BALL_M: f64 = 1.35 * POOL_RADIUS_M;
/// How far the ring of a called pocket is from its edge [m].
const CALLED_POCKET_GAP_M: f64 = 0.012;
/// Radius of the ring round what is pointed at [m].
const POINTED_M: f64 = 0.022;
/// Height of such rings [m]: above the rails, so that they hide nothing of it.
const RING_HEIGHT_M: f64 = 0.045;
/// Half the width of their line [m].
const RING_HALF_WIDTH_M: f32 = 0.003;
/// How far the line of an object ball's way is drawn [m].
const OBJECT_WAY_M: f64 = 0.30;

/// The radii of the balls and of the tip, and how balls look; they do not change in a game.
#[derive(Debug, Clone)]
pub struct Radii {
    balls: Vec<(BallId, f64)>,
    tip_m: f64,
    set: BallSet,
    is_marked: bool,
}

impl Default for Radii {
    fn default() -> Self {
        Radii { balls: Vec::new(), tip_m: TIP_RADIUS_M, set: BallSet::Pool, is_marked: false }
    }
}

impl Radii {
    /// From ids and radii [m].
    pub fn new(radii: impl IntoIterator<Item = (BallId, f64)>) -> Self {
        let mut radii: Vec<_> = radii.into_iter().collect();
        radii.sort_by_key(|(id, _)| *id);
        Radii { balls: radii, ..Radii::default() }
    }

    /// The same with a tip of another radius [m].
    #[must_use]
    pub fn with_tip(self, tip_m: f64) -> Self {
        Radii { tip_m, ..self }
    }

    /// The same for the balls of another game.
    #[must_use]
    pub fn with_set(self, set: BallSet) -> Self {
        Radii { set, ..self }
    }

    /// Balls are told apart without their colours from now on, or by them.
    pub fn mark(&mut self, is_marked: bool) {
        self.is_marked = is_marked;
    }

    /// How a ball looks.
    pub fn look(&self, id: BallId) -> BallLook {
        if self.is_marked { self.set.marked_look(id) } else { self.set.look(id) }
    }

    /// The radius of a ball [m]; a pool ball's if nobody said.
    pub fn of(&self, id: BallId) -> f64 {
        let found = self.balls.binary_search_by_key(&id, |(known, _)| *known);
        found.map_or(POOL_RADIUS_M, |i| self.balls[i].1)
    }
}

/// A ball in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallInstance {
    /// Which.
    pub id: BallId,
    /// How it looks.
    pub look: BallLook,
    /// Its middle [m].
    pub position: [f32; 3],
    /// Its rotation as x, y, z, w of a unit quaternion.
    pub orientation: [f32; 4],
    /// Its radius [m].
    pub radius_m: f32,
}

/// A line on the cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// From here [m].
    pub from: [f32; 3],
    /// To here [m].
    pub to: [f32; 3],
    /// Half its width [m].
    pub half_width_m: f32,
    /// Red, green, blue in sRGB and opacity.
    pub colour: [f32; 4],
}

/// A see-through ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GhostBall {
    /// Its middle [m].
    pub position: [f32; 3],
    /// Its radius [m].
    pub radius_m: f32,
    /// Red, green, blue in sRGB and opacity.
    pub colour: [f32; 4],
}

/// What a [`Solid`] is, before it is laid between two points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolidShape {
    /// A ball about the first point.
    Ball,
    /// A round rod.
    Cylinder,
    /// A cone whose point is the second point.
    Cone,
}

/// A simple body that shows something which is not there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// What it is.
    pub shape: SolidShape,
    /// From here [m].
    pub from: [f32; 3],
    /// To here [m].
    pub to: [f32; 3],
    /// Half its width [m].
    pub radius_m: f32,
    /// Red, green, blue in sRGB and opacity.
    pub colour: [f32; 4],
    /// It shines through what lies before it.
    pub is_over: bool,
}

impl Solid {
    /// A body between two points [m].
    pub fn between(
        shape: SolidShape,
        from: DVec3,
        to: DVec3,
        radius_m: f32,
        colour: [f32; 4],
    ) -> Self {
        let [from, to] = [from, to].map(|point| point.as_vec3().to_array());
        Solid { shape, from, to, radius_m, colour, is_over: false }
    }

    /// A ball.
    pub fn ball(middle: DVec3, radius_m: f32, colour: [f32; 4]) -> Self {
        Solid::between(SolidShape::Ball, middle, middle, radius_m, colour)
    }

    /// The same, shining through.
    #[must_use]
    pub fn over(self) -> Self {
        Solid { is_over: true, ..self }
    }
}

/// A few letters at a place of the world, of one size wherever that is.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// Their middle [m].
    pub at: [f32; 3],
    /// What they say.
    pub text: String,
    /// Red, green, blue in sRGB.
    pub colour: [f32; 3],
    /// They stand out from others.
    pub is_bold: bool,
}

/// The stylus of a haptic device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StylusPose {
    /// The middle of its tip [m].
    pub tip: [f32; 3],
    /// Unit vector from its end to its tip.
    pub direction: [f32; 3],
    /// Metres of the world per metre of the stylus.
    pub scale: f32,
}

/// Everything that moves in one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawList {
    /// From where it is taken.
    pub camera: CameraPose,
    /// The balls, in ascending order of id.
    pub balls: Vec<BallInstance>,
    /// The cue.
    pub cue: Option<CuePose>,
    /// Lines of aim.
    pub lines: Vec<Line>,
    /// The cue ball where it would go.
    pub ghosts: Vec<GhostBall>,
    /// The stylus of a haptic device.
    pub stylus: Option<StylusPose>,
    /// What is drawn of forces and workspace, in this order.
    pub solids: Vec<Solid>,
    /// What is written on the table.
    pub labels: Vec<Label>,
}

impl DrawList {
    /// What a player sees of the world.
    pub fn new(world: &Snapshot, view: &HumanView, radii: &Radii) -> Self {
        // A ball that lay on the table when it was taken up is in the hand now.
        let in_hand = view.placing.map(|_| view.placing_ball);
        let balls = world
            .on_table()
            .filter(|ball| Some(ball.id) != in_hand)
            .map(|ball| instance(ball, radii))
            .collect();
        let mut list = DrawList {
            camera: view.camera,
            balls,
            cue: world.cue.map(|cue| held(cue, radii.tip_m)),
            lines: Vec::new(),
            ghosts: Vec::new(),
            stylus: None,
            solids: Vec::new(),
            labels: Vec::new(),
        };
        match view.mode {
            HumanMode::Aiming | HumanMode::Stroking => {
                list.show_aim(world, view, radii);
                list.show_ways(view, radii);
                list.show_call(view);
            }
            HumanMode::Placing => list.show_placing(view, radii),
            HumanMode::Pointing => {
                list.show_call(view);
                view.pointing.into_iter().for_each(|at| list.ring(at, POINTED_M));
            }
            HumanMode::HoldingStylus => list.show_call(view),
            HumanMode::Choosing | HumanMode::Watching | HumanMode::Paused => {}
        }
        list
    }

    fn show_aim(&mut self, world: &Snapshot, view: &HumanView, radii: &Radii) {
        let cue_ball = world.ball(view.cue_ball).filter(|ball| ball.place == BallPlace::OnTable);
        let (Some(cue_ball), Some(ghost)) = (cue_ball, view.ghost) else { return };
        let radius_m = radii.of(view.cue_ball);
        let way = (ghost - cue_ball.position).truncate();
        let length = way.length();
        let ahead = way.normalize_or_zero();
        // From the cue ball's edge to the ghost's.
        if 2.0 * radius_m < length {
            let from = cue_ball.position + (ahead * radius_m).extend(0.0);
            let to = ghost - (ahead * radius_m).extend(0.0);
            self.line(from, to, radius_m, [1.0, 1.0, 1.0, 0.55]);
        }
        let (position, radius) = (ghost.as_vec3().to_array(), radius_m as f32);
        let colour = [1.0, 1.0, 1.0, 0.34];
        self.ghosts.push(GhostBall { position, radius_m: radius, colour });
        if view.object_heading.length_squared() > 0.5 {
            // The object ball's middle lies a diameter ahead along its way.
            let object = ghost + (view.object_heading * 2.0 * radius_m).extend(0.0);
            let to = object + (view.object_heading * OBJECT_WAY_M).extend(0.0);
            let from = object + (view.object_heading * radius_m).extend(0.0);
            self.line(from, to, radius_m, [1.0, 0.86, 0.35, 0.6]);
        }
    }

    /// Where balls will go, and where they come to rest.
    fn show_ways(&mut self, view: &HumanView, radii: &Radii) {
        self.show_traces(&view.ways, view.cue_ball, radii);
    }

    /// Ways of balls, and where they come to rest; that of the cue ball is white.
    pub fn show_traces(&mut self, ways: &[BallWay], cue_ball: BallId, radii: &Radii) {
        for way in ways {
            let radius_m = radii.of(way.ball);
            let [r, g, b] = match way.ball == cue_ball {
                true => [1.0, 1.0, 1.0],
                false => radii.look(way.ball).colour.map(|channel| 0.25 + 0.75 * channel),
            };
            for pair in way.points.windows(2) {
                self.line(pair[0], pair[1], radius_m, [r, g, b, 0.75]);
            }
            if let Some(end) = way.points.last().filter(|_| way.rests) {
                let (position, radius_m) = (end.as_vec3().to_array(), radius_m as f32);
                self.ghosts.push(GhostBall { position, radius_m, colour: [r, g, b, 0.3] });
            }
        }
    }

    fn show_placing(&mut self, view: &HumanView, radii: &Radii) {
        let Some(at) = view.placing else { return };
        let radius_m = radii.of(view.placing_ball);
        let [r, g, b] = radii.look(view.placing_ball).colour;
        let colour = match (view.placing_allowed, view.placing_ball) {
            (false, _) => [0.95, 0.2, 0.15, 0.6],
            (true, BallId::CUE) => [1.0, 1.0, 0.96, 0.85],
            (true, _) => [r, g, b, 0.85],
        };
        let position = at.extend(radius_m).as_vec3().to_array();
        self.ghosts.push(GhostBall { position, radius_m: radius_m as f32, colour });
    }

    /// Rings round the called ball and its pocket.
    fn show_call(&mut self, view: &HumanView) {
        let Some(call) = &view.call else { return };
        if let Some(at) = call.ball_at {
            self.ring(at, CALLED_BALL_M);
        }
        if let Some((at, radius_m)) = call.pocket_at {
            self.ring(at, radius_m + CALLED_POCKET_GAP_M);
        }
    }

    /// A ring that floats above cloth and rails.
    fn ring(&mut self, middle: DVec2, radius_m: f64) {
        let corner = |k: u32| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / 32.0);
            let at = middle + DVec2::new(cos, sin) * radius_m;
            at.extend(RING_HEIGHT_M).as_vec3().to_array()
        };
        self.lines.extend((0..32).map(|k| Line {
            from: corner(k),
            to: corner(k + 1),
            half_width_m: RING_HALF_WIDTH_M,
            colour: [1.0, 0.8, 0.38, 0.9],
        }));
    }

    /// A line at the height of the cloth under balls of this radius.
    fn line(&mut self, from: DVec3, to: DVec3, radius_m: f64, colour: [f32; 4]) {
        let down = DVec3::Z * (radius_m - LINE_LIFT_M);
        self.lines.push(Line {
            from: (from - down).as_vec3().to_array(),
            to: (to - down).as_vec3().to_array(),
            half_width_m: LINE_HALF_WIDTH_M,
            colour,
        });
    }
}

/// A cue whose drawn tip, that of a pool cue, ends where the real one does.
pub(super) fn held(cue: CuePose, tip_m: f64) -> CuePose {
    CuePose { tip: cue.tip + cue.direction * (tip_m - TIP_RADIUS_M), ..cue }
}

fn instance(ball: &BallState, radii: &Radii) -> BallInstance {
    BallInstance {
        id: ball.id,
        look: radii.look(ball.id),
        position: ball.position.as_vec3().to_array(),
        orientation: (ball.orientation * tossed(ball.id)).as_quat().to_array(),
        radius_m: radii.of(ball.id) as f32,
    }
}

/// How a ball lay in the hand that racked it: nobody turns all numbers the same way.
fn tossed(id: BallId) -> DQuat {
    let golden = 2.399_963_229_728_653;
    let n = f64::from(id.0);
    // Each somewhere else round the vertical, and tilted by up to 50 degrees.
    DQuat::from_rotation_z(golden * n)
        * DQuat::from_rotation_y(0.87 * libm::sin(2.0 * golden * n))
        * DQuat::from_rotation_x(0.4 * libm::cos(3.0 * n))
}
