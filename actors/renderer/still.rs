//! What stands still. While an eye rests, table and room are drawn once, and then lie under every
//! picture at the price of two looks per pixel: balls roll as smoothly as the machine can.

use super::materials::program;
use super::stage::BACKGROUND;
use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::{DrawList, Patch, patches};
use three_d::*;

/// As many eyes look at the same time.
const EYES: usize = 2;

/// What a picture of what stands still depends on.
#[derive(Clone, PartialEq)]
struct Sort {
    view_projection: Mat4,
    viewport: Viewport,
    settings: PictureSettings,
}

impl Sort {
    fn of(settings: &PictureSettings, camera: &Camera) -> Self {
        let view_projection = camera.projection() * camera.view();
        Sort { view_projection, viewport: camera.viewport(), settings: *settings }
    }
}

/// What one eye sees of it.
pub struct Still {
    sort: Sort,
    colours: Texture2D,
    depths: DepthTexture2D,
}

impl Still {
    fn new(context: &Context, sort: Sort) -> Self {
        let Viewport { width, height, .. } = sort.viewport;
        let (edge, plain) = (Wrapping::ClampToEdge, Interpolation::Nearest);
        Still {
            sort,
            colours: Texture2D::new_empty::<[u8; 4]>(
                context, width, height, plain, plain, None, edge, edge,
            ),
            depths: DepthTexture2D::new::<f32>(context, width, height, edge, edge),
        }
    }

    /// Keeps what `draw` draws.
    pub fn write(&self, draw: impl FnOnce()) -> Result<(), CoreError> {
        let [r, g, b] = BACKGROUND;
        let draw = || {
            draw();
            Ok::<(), CoreError>(())
        };
        RenderTarget::new(self.colours.as_color_target(None), self.depths.as_depth_target())
            .clear(ClearState::color_and_depth(r, g, b, 1.0, 1.0))
            .write(draw)?;
        Ok(())
    }
}

/// What stood still in the last pictures, an eye's each.
pub struct Stills {
    context: Context,
    colour: Program,
    depth: Program,
    /// Those of the whole picture, and of what moves in it.
    whole: VertexBuffer<Vec2>,
    corners: VertexBuffer<Vec2>,
    kept: Vec<Still>,
    /// Of the last pictures, the latest last.
    recent: Vec<Sort>,
}

impl Stills {
    /// Nothing was seen so far.
    ///
    /// # Errors
    /// The graphics card's compiler does not take a shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let place = include_str!("shaders/screen.vert");
        Ok(Stills {
            colour: program(context, place, &[], &[include_str!("shaders/still.frag")])?,
            depth: program(context, place, &[], &[include_str!("shaders/still_depth.frag")])?,
            whole: VertexBuffer::new_with_data(context, &corners(&[Patch::WHOLE])),
            corners: VertexBuffer::new(context),
            kept: Vec::new(),
            recent: Vec::new(),
            context: context.clone(),
        })
    }

    /// A picture will be drawn. What to draw what stands still into, to [`Self::keep`] it: if an
    /// eye rests there and that was not done yet.
    pub fn see(&mut self, settings: &PictureSettings, camera: &Camera) -> Option<Still> {
        let sort = Sort::of(settings, camera);
        let rests = self.recent.contains(&sort);
        self.recent.retain(|seen| *seen != sort);
        self.recent.push(sort.clone());
        if EYES < self.recent.len() {
            self.recent.remove(0);
        }
        if !rests || self.kept.iter().any(|still| still.sort == sort) {
            return None;
        }
        let has_gone = |still: &Still| !self.recent.contains(&still.sort);
        // The textures of an eye that has gone serve again.
        let place = self.kept.iter().position(has_gone);
        let old = place.map(|place| self.kept.swap_remove(place));
        Some(match old.filter(|old| old.sort.viewport == sort.viewport) {
            Some(old) => Still { sort, ..old },
            None => Still::new(&self.context, sort),
        })
    }

    /// Keeps it for the pictures that follow.
    pub fn keep(&mut self, still: Still) {
        self.kept.push(still);
    }

    /// Whether it was kept.
    pub fn has(&self, settings: &PictureSettings, camera: &Camera) -> bool {
        let sort = Sort::of(settings, camera);
        self.kept.iter().any(|still| still.sort == sort)
    }

    /// Puts what stands still into the target, if it was kept; whether it was. How far it is away
    /// is there only where something else of the list may be. `bed` is half of it [m].
    pub fn put(
        &mut self,
        list: &DrawList,
        bed: Vec2,
        settings: &PictureSettings,
        camera: &Camera,
    ) -> bool {
        let sort = Sort::of(settings, camera);
        let Some(still) = self.kept.iter().find(|still| still.sort == sort) else { return false };
        let states = |write_mask| RenderStates {
            depth_test: DepthTest::Always,
            write_mask,
            ..RenderStates::default()
        };
        let Viewport { width, height, .. } = sort.viewport;
        let matrix: [[f32; 4]; 4] = sort.view_projection.into();
        let matrix = glam::Mat4::from_cols_array_2d(&matrix);
        self.colour.use_texture("colours", &still.colours);
        self.colour.use_vertex_attribute("corner", &self.whole);
        self.colour.draw_arrays(states(WriteMask::COLOR), sort.viewport, self.whole.vertex_count());
        self.corners.fill(&corners(&patches(
            list,
            glam::Vec2::new(bed.x, bed.y),
            matrix,
            (width, height),
        )));
        if 0 < self.corners.vertex_count() {
            self.depth.use_depth_texture("depths", &still.depths);
            self.depth.use_vertex_attribute("corner", &self.corners);
            let states = states(WriteMask::DEPTH);
            self.depth.draw_arrays(states, sort.viewport, self.corners.vertex_count());
        }
        true
    }
}

/// Two triangles for each patch.
fn corners(patches: &[Patch]) -> Vec<Vec2> {
    let of = |Patch { least: [left, low], most: [right, high] }: &Patch| {
        [(left, low), (right, low), (left, high), (left, high), (right, low), (right, high)]
            .map(|(x, y)| vec2(*x, *y))
    };
    patches.iter().flat_map(of).collect()
}
