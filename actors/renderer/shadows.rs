//! The paper's two kinds of shadows: maps, in which each lamp looks at the table, and volumes, the
//! bodies of darkness behind balls and cue (section 4.3.3).
//!
//! Volumes are counted in a picture of their own, a channel for each lamp, and not in a stencil
//! buffer: so all lamps need one pass, and the scene is lit once.

use super::balls::{Balls, lamps};
use super::materials::{Facts, Shader, Told, program};
use hapticbillard::cue::{BUTT_RADIUS_M, CUE_LENGTH_M, CuePose, TIP_RADIUS_M};
use hapticbillard::renderer::{LAMP_HEIGHT_M, LAMPS, ROD_SHADOW_TRIANGLES, rod_shadow};
use three_d::*;

/// Size of a map [pixels].
const MAP: (u32, u32) = (1024, 512);
/// What a map sees: from so far above the cloth to so far below it [m].
const MAP_RANGE_M: (f32, f32) = (0.35, 0.15);
/// Corners of the circle that a ball is to a lamp.
const CORNERS: u32 = 24;

/// An eye that looks straight down: its picture is the cloth's plane, straightened.
pub struct DownEye {
    at: Vec3,
    projection: Mat4,
    size: (u32, u32),
    range_m: (f32, f32),
}

impl DownEye {
    /// A lamp that sees so much of the cloth's plane.
    fn of_lamp(at: Vec3, frame: Vec2) -> Self {
        let (near, far) = (at.z - MAP_RANGE_M.0, at.z + MAP_RANGE_M.1);
        let scale = near / at.z;
        let [left, right] = [-frame.x - at.x, frame.x - at.x].map(|x| x * scale);
        let [bottom, top] = [-frame.y - at.y, frame.y - at.y].map(|y| y * scale);
        let projection = frustum(left, right, bottom, top, near, far);
        DownEye { at, projection, size: MAP, range_m: (near, far) }
    }

    /// One from far above, to which the height of things makes no difference.
    pub fn from_above(frame: Vec2, size: (u32, u32)) -> Self {
        const HEIGHT_M: f32 = 4.0;
        let range_m = (HEIGHT_M - 1.0, HEIGHT_M + 2.0);
        let projection = ortho(-frame.x, frame.x, -frame.y, frame.y, range_m.0, range_m.1);
        DownEye { at: vec3(0.0, 0.0, HEIGHT_M), projection, size, range_m }
    }
}

impl Viewer for DownEye {
    fn position(&self) -> Vec3 {
        self.at
    }
    fn view(&self) -> Mat4 {
        Mat4::from_translation(-self.at)
    }
    fn projection(&self) -> Mat4 {
        self.projection
    }
    fn viewport(&self) -> Viewport {
        Viewport::new_at_origo(self.size.0, self.size.1)
    }
    fn z_near(&self) -> f32 {
        self.range_m.0
    }
    fn z_far(&self) -> f32 {
        self.range_m.1
    }
    fn color_mapping(&self) -> ColorMapping {
        ColorMapping::None
    }
    fn tone_mapping(&self) -> ToneMapping {
        ToneMapping::None
    }
}

/// The maps.
pub struct Maps {
    depth: DepthTexture2DArray,
    frame: Vec2,
}

impl Maps {
    /// Maps of everything within half a length and width of the middle [m].
    pub fn new(context: &Context, frame: Vec2) -> Self {
        let edge = Wrapping::ClampToEdge;
        let count = LAMPS.len() as u32;
        let depth = DepthTexture2DArray::new::<f32>(context, MAP.0, MAP.1, count, edge, edge);
        Maps { depth, frame }
    }

    /// Every lamp looks at balls and cue.
    pub fn draw(&self, balls: &Balls, cue: Option<&Mesh>, facts: Facts) -> Result<(), CoreError> {
        for (layer, at) in lamps().into_iter().enumerate() {
            let eye = DownEye::of_lamp(at, self.frame);
            let target = self.depth.as_depth_target(layer as u32);
            target.clear(ClearState::depth(1.0)).write::<CoreError>(|| {
                balls.draw_depth(eye.projection() * eye.view(), eye.viewport());
                if let Some(cue) = cue {
                    let told = Told { shader: Shader::Depth, tell: &|_| {}, facts };
                    cue.render_with_material(&told, &eye, &[]);
                }
                Ok(())
            })?;
        }
        Ok(())
    }

    /// Tells a shader where they are.
    pub fn tell(&self, program: &Program) {
        if program.requires_uniform("dark") {
            program.use_depth_texture_array("dark", &self.depth);
        }
        program.use_uniform_if_required("dark_frame", self.frame);
        let range = vec2(LAMP_HEIGHT_M - MAP_RANGE_M.0, LAMP_HEIGHT_M + MAP_RANGE_M.1);
        program.use_uniform_if_required("dark_range", range);
    }
}

/// The volumes, and how many lie before every pixel.
pub struct Volumes {
    context: Context,
    corners: VertexBuffer<Vec4>,
    triangles: ElementBuffer<u32>,
    balls: Program,
    rod: Program,
    rod_triangles: ElementBuffer<u32>,
    /// The counts and the depth of what is seen; none before the first picture.
    picture: Option<(Texture2D, DepthTexture2D)>,
}

impl Volumes {
    /// Gets the shaders ready.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let (corners, triangles) = cone();
        let count = include_str!("shaders/volume.frag");
        Ok(Volumes {
            context: context.clone(),
            corners: VertexBuffer::new_with_data(context, &corners),
            triangles: ElementBuffer::new_with_data(context, &triangles),
            balls: program(context, include_str!("shaders/volume.vert"), &[], &[count])?,
            rod: program(context, include_str!("shaders/rod_volume.vert"), &[], &[count])?,
            rod_triangles: ElementBuffer::new_with_data(context, &ROD_SHADOW_TRIANGLES),
            picture: None,
        })
    }

    /// Counts, for a picture of this camera; `scene` draws the depth of everything but the balls,
    /// and nothing below `lowest` [m] is to be darkened.
    pub fn draw(
        &mut self,
        balls: &Balls,
        cue: Option<&CuePose>,
        lowest: f32,
        camera: &Camera,
        scene: impl FnOnce(),
    ) -> Result<(), CoreError> {
        let Viewport { width, height, .. } = camera.viewport();
        let fits = |(counts, _): &(Texture2D, DepthTexture2D)| {
            (counts.width(), counts.height()) == (width, height)
        };
        if !self.picture.as_ref().is_some_and(fits) {
            self.picture = Some(picture(&self.context, width, height));
        }
        let Some((counts, depth)) = &self.picture else { return Ok(()) };
        let target = RenderTarget::new(counts.as_color_target(None), depth.as_depth_target());
        let view_projection = camera.projection() * camera.view();
        target.clear(ClearState::color_and_depth(0.0, 0.0, 0.0, 0.0, 1.0)).write(|| {
            scene();
            balls.draw_depth(view_projection, camera.viewport());
            self.count_balls(balls, lowest, camera, view_projection);
            if let Some(cue) = cue {
                self.count_rod(cue, lowest, camera, view_projection);
            }
            Ok(())
        })?;
        Ok(())
    }

    fn count_balls(&self, balls: &Balls, lowest: f32, camera: &Camera, view_projection: Mat4) {
        let of = |(number, at): (usize, Vec3)| {
            balls.places().iter().map(move |place| (*place, at.extend(number as f32)))
        };
        let (places, sources): (Vec<Vec4>, Vec<Vec4>) =
            lamps().into_iter().enumerate().flat_map(of).unzip();
        if places.is_empty() {
            return;
        }
        let place = InstanceBuffer::new_with_data(&self.context, &places);
        let source = InstanceBuffer::new_with_data(&self.context, &sources);
        self.balls.use_uniform("view_projection", view_projection);
        self.balls.use_uniform("lowest", lowest);
        self.balls.use_vertex_attribute("corner", &self.corners);
        self.balls.use_instance_attribute("place", &place);
        self.balls.use_instance_attribute("source", &source);
        let count = places.len() as u32;
        self.balls.draw_elements_instanced(counting(), camera.viewport(), &self.triangles, count);
    }

    fn count_rod(&self, cue: &CuePose, lowest: f32, camera: &Camera, view_projection: Mat4) {
        let butt = (cue.tip - cue.direction * CUE_LENGTH_M).as_vec3().to_array();
        let ends =
            [(cue.tip.as_vec3().to_array(), TIP_RADIUS_M as f32), (butt, BUTT_RADIUS_M as f32)];
        for (number, lamp) in LAMPS.into_iter().enumerate() {
            let Some(corners) = rod_shadow(lamp, ends, lowest) else { continue };
            let corners = corners.map(Vec3::from);
            let buffer = VertexBuffer::new_with_data(&self.context, &corners);
            self.rod.use_uniform("view_projection", view_projection);
            self.rod.use_uniform("lamp_number", number as f32);
            self.rod.use_vertex_attribute("position", &buffer);
            self.rod.draw_elements(counting(), camera.viewport(), &self.rod_triangles);
        }
    }

    /// Tells a shader of the counts, for a picture of this size.
    pub fn tell(&self, program: &Program, viewport: Viewport) {
        let Some((counts, _)) = &self.picture else { return };
        if program.requires_uniform("counted") {
            program.use_texture("counted", counts);
        }
        let pixel = vec2(1.0 / viewport.width.max(1) as f32, 1.0 / viewport.height.max(1) as f32);
        program.use_uniform_if_required("counted_pixel", pixel);
    }
}

/// What lies behind the scene counts, and nothing hides anything.
fn counting() -> RenderStates {
    RenderStates {
        write_mask: WriteMask { alpha: false, ..WriteMask::COLOR },
        depth_test: DepthTest::Greater,
        blend: Blend::ADD,
        cull: Cull::None,
    }
}

fn picture(context: &Context, width: u32, height: u32) -> (Texture2D, DepthTexture2D) {
    let edge = Wrapping::ClampToEdge;
    let near = Interpolation::Nearest;
    let counts =
        Texture2D::new_empty::<[f16; 4]>(context, width, height, near, near, None, edge, edge);
    (counts, DepthTexture2D::new::<f32>(context, width, height, edge, edge))
}

/// A cone of the shader's corners: cosine, sine, near 0 or far 1, axis 0 or rim 1.
fn cone() -> (Vec<Vec4>, Vec<u32>) {
    let mut corners = vec![vec4(0.0, 0.0, 0.0, 0.0), vec4(0.0, 0.0, 1.0, 0.0)];
    let mut triangles = Vec::new();
    for k in 0..CORNERS {
        // As large as the circle in the mean: the corners stand out as much as the edges cut off.
        let angle = std::f32::consts::TAU * k as f32 / CORNERS as f32;
        let out = 0.5 + 0.5 / (std::f32::consts::PI / CORNERS as f32).cos();
        corners.push(vec4(angle.cos() * out, angle.sin() * out, 0.0, 1.0));
        corners.push(vec4(angle.cos() * out, angle.sin() * out, 1.0, 1.0));
        let next = (k + 1) % CORNERS;
        let [a, b, c, d] = [2 + 2 * k, 2 + 2 * next, 3 + 2 * next, 3 + 2 * k];
        triangles.extend([0, b, a, 1, d, c, a, b, c, a, c, d]);
    }
    (corners, triangles)
}
