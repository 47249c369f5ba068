//! Level of detail: what of a ball can be seen from here (paper, section 4.3.4).

use super::{Environment, PictureSettings};

/// How often an icosahedron's triangles are divided for 320, 1280 and 5120 triangles.
const LEVELS: [(u16, u32); 3] = [(320, 2), (1280, 3), (5120, 4)];
/// How far the middle of the flattest edge of these spheres lies under the sphere, in radii: a
/// chord of the angle `a` is 1 - cos(a / 2) away, and `a` halves with each division. The widest
/// edges of an icosahedron divided twice subtend 18.7°.
const SAGITTAS: [f32; 3] = [0.0133, 0.0034, 0.00085];
/// An outline may be off by so much [pixels].
const OUTLINE_PIXELS: f32 = 0.4;
/// Radius of a ball on the screen from which reflections begin to show, and are whole [pixels].
const REFLECTION_PIXELS: (f32, f32) = (6.0, 11.0);
/// The same of scratches, whose lines are some hundredths of a radius wide.
const SCRATCH_PIXELS: (f32, f32) = (26.0, 55.0);

/// The division of an icosahedron that has so many triangles, of those that there are.
fn sphere_level(triangles: u16) -> u32 {
    LEVELS.iter().find(|(count, _)| triangles <= *count).map_or(4, |(_, level)| *level)
}

/// How a ball is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallDetail {
    /// How often an icosahedron's triangles are divided.
    pub level: u32,
    /// How much of the reflections is there [0 to 1].
    pub reflection: f32,
    /// How much of the scratches is there [0 to 1].
    pub scratches: f32,
}

impl BallDetail {
    /// The detail of a ball whose radius is so long on the screen [pixels].
    pub fn of(radius_px: f32, settings: &PictureSettings) -> Self {
        let most = sphere_level(settings.triangles);
        let reflects = settings.environment != Environment::Off;
        if !settings.level_of_detail {
            let whole = |is_there: bool| if is_there { 1.0 } else { 0.0 };
            let (reflection, scratches) = (whole(reflects), whole(settings.normal_map));
            return BallDetail { level: most, reflection, scratches };
        }
        let is_round = |sagitta: f32| sagitta * radius_px <= OUTLINE_PIXELS;
        let enough = LEVELS.iter().zip(SAGITTAS).find(|(_, sagitta)| is_round(*sagitta));
        let share = |is_there: bool, range| if is_there { grown(radius_px, range) } else { 0.0 };
        BallDetail {
            level: enough.map_or(most, |((_, level), _)| most.min(*level)),
            reflection: share(reflects, REFLECTION_PIXELS),
            scratches: share(settings.normal_map, SCRATCH_PIXELS),
        }
    }
}

/// From 0 at the begin of a range to 1 at its end.
fn grown(x: f32, (from, to): (f32, f32)) -> f32 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}
