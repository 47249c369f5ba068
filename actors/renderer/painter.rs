//! One picture from a draw list: smaller than its window or not, with smooth edges or not, for one
//! eye or for two.

use super::materials::program;
use super::stage::{BACKGROUND, Stage};
use glam::DVec3;
use hapticbillard::cue::CuePose;
use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::{DrawList, GhostBall, Line, eyes};
use three_d::context::{HasContext, RENDERER};
use three_d::*;

/// Samples per pixel where edges are smooth.
const SAMPLES: u32 = 4;

/// What one eye sees, in pictures of its own.
struct Sight {
    colour: Texture2D,
    depth: DepthTexture2D,
    smooth: Option<RenderTargetMultisample<[u8; 4], f32>>,
}

impl Sight {
    fn new(context: &Context, (width, height): (u32, u32), is_smooth: bool) -> Self {
        let (edge, soft) = (Wrapping::ClampToEdge, Interpolation::Linear);
        Sight {
            colour: Texture2D::new_empty::<[u8; 4]>(
                context, width, height, soft, soft, None, edge, edge,
            ),
            depth: DepthTexture2D::new::<f32>(context, width, height, edge, edge),
            smooth: is_smooth
                .then(|| RenderTargetMultisample::new(context, width, height, SAMPLES)),
        }
    }

    fn fits(&self, (width, height): (u32, u32), is_smooth: bool) -> bool {
        (self.colour.width(), self.colour.height()) == (width, height)
            && self.smooth.is_some() == is_smooth
    }

    /// What `draw` draws, which may be all of it.
    fn draw(&self, is_all: bool, draw: impl FnOnce()) -> Result<(), CoreError> {
        let draw = || {
            draw();
            Ok::<(), CoreError>(())
        };
        match &self.smooth {
            Some(smooth) => {
                smooth.clear(cleared()).write(draw)?;
                smooth.resolve_color_to(&self.colour.as_color_target(None));
            }
            None => {
                let depth = self.depth.as_depth_target();
                let target = RenderTarget::new(self.colour.as_color_target(None), depth);
                if !is_all {
                    target.clear(cleared());
                }
                target.write(draw)?;
            }
        }
        Ok(())
    }
}

fn cleared() -> ClearState {
    let [r, g, b] = BACKGROUND;
    ClearState::color_and_depth(r, g, b, 1.0, 1.0)
}

/// A picture that is ready to be put into a window.
pub enum Ready {
    /// It is drawn there.
    Direct(Box<Camera>),
    /// It is drawn already, for so many eyes.
    Drawn(usize),
}

/// Draws pictures.
pub struct Painter {
    context: Context,
    one_eye: Program,
    two_eyes: Program,
    corners: VertexBuffer<Vec2>,
    sights: Vec<Sight>,
    is_software: bool,
}

impl Painter {
    /// For windows and files of this context.
    ///
    /// # Errors
    /// The graphics card's compiler does not take a shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let compose = |eyes| {
            let (place, text) =
                (include_str!("shaders/screen.vert"), include_str!("shaders/compose.frag"));
            program(context, place, &[("EYES", eyes)], &[text])
        };
        Ok(Painter {
            one_eye: compose(1)?,
            two_eyes: compose(2)?,
            corners: VertexBuffer::new_with_data(
                context,
                &[vec2(-1.0, -1.0), vec2(3.0, -1.0), vec2(-1.0, 3.0)],
            ),
            sights: Vec::new(),
            is_software: is_software(context),
            context: context.clone(),
        })
    }

    /// Draws a picture that nobody sees, with one of everything in it: so that no shader is
    /// compiled and no texture computed in the middle of a game.
    ///
    /// # Errors
    /// The graphics card's compiler does not take a shader, or it gives no room.
    pub fn warm_up(
        &self,
        stage: &mut Stage,
        list: &DrawList,
        settings: &PictureSettings,
    ) -> Result<(), CoreError> {
        let near = list.camera.target.as_vec3().to_array();
        let far = [near[0] + 0.1, near[1], near[2]];
        let colour = [1.0; 4];
        let mut list = list.clone();
        let (tip, direction) = (list.camera.target, DVec3::X);
        list.cue = Some(CuePose { tip, velocity: DVec3::ZERO, direction, solid: false });
        list.lines.push(Line { from: near, to: far, half_width_m: 0.01, colour });
        list.ghosts.push(GhostBall { position: near, radius_m: 0.03, colour });
        let sight = Sight::new(&self.context, (64, 40), settings.smooth.is_on(self.is_software));
        let camera =
            stage.prepare(&list, &list.camera, settings, Viewport::new_at_origo(64, 40))?;
        sight.draw(false, || stage.draw(&list, settings, &camera))
    }

    /// Draws everything that needs pictures of its own, for a window of this size [pixels].
    ///
    /// # Errors
    /// The graphics card's compiler does not take a shader, or it gives no room.
    pub fn prepare(
        &mut self,
        stage: &mut Stage,
        list: &DrawList,
        settings: &PictureSettings,
        size: (u32, u32),
    ) -> Result<Ready, CoreError> {
        let is_smooth = settings.smooth.is_on(self.is_software);
        let drawn = settings.drawn_size(size);
        let viewport = Viewport::new_at_origo(drawn.0, drawn.1);
        let both = eyes(&list.camera, settings.stereo);
        if both.is_none() && !is_smooth && drawn == size {
            self.sights.clear();
            let camera = stage.prepare(list, &list.camera, settings, viewport)?;
            stage.rest(settings, &camera)?;
            return Ok(Ready::Direct(Box::new(camera)));
        }
        let poses = both.map_or_else(|| vec![list.camera], Vec::from);
        self.sights.retain(|sight| sight.fits(drawn, is_smooth));
        self.sights.truncate(poses.len());
        while self.sights.len() < poses.len() {
            self.sights.push(Sight::new(&self.context, drawn, is_smooth));
        }
        for (pose, sight) in poses.iter().zip(&self.sights) {
            let camera = stage.prepare(list, pose, settings, viewport)?;
            if !is_smooth {
                stage.rest(settings, &camera)?;
            }
            let is_all = stage.rests(settings, &camera);
            sight.draw(is_all, || stage.draw(list, settings, &camera))?;
        }
        Ok(Ready::Drawn(poses.len()))
    }

    /// Puts a picture into a target of this size, and what `write` writes over it.
    ///
    /// # Errors
    /// The graphics card refuses.
    pub fn finish(
        &self,
        ready: Ready,
        stage: &mut Stage,
        list: &DrawList,
        settings: &PictureSettings,
        target: &RenderTarget,
        write: impl FnOnce() -> Result<(), CoreError>,
    ) -> Result<(), CoreError> {
        // What every pixel of is drawn needs no ground.
        let is_all = match &ready {
            Ready::Direct(camera) => stage.rests(settings, camera),
            Ready::Drawn(_) => true,
        };
        if !is_all {
            target.clear(cleared());
        }
        target.write(|| {
            self.put(ready, stage, list, settings, target.viewport());
            write()
        })?;
        Ok(())
    }

    fn put(
        &self,
        ready: Ready,
        stage: &mut Stage,
        list: &DrawList,
        settings: &PictureSettings,
        viewport: Viewport,
    ) {
        let (program, sights) = match (ready, &self.sights[..]) {
            (Ready::Direct(camera), _) => return stage.draw(list, settings, &camera),
            (Ready::Drawn(2), [left, right, ..]) => (&self.two_eyes, [left, right]),
            (Ready::Drawn(_), [left, ..]) => (&self.one_eye, [left, left]),
            (Ready::Drawn(_), []) => return,
        };
        for (name, sight) in ["left", "right"].into_iter().zip(sights) {
            if program.requires_uniform(name) {
                program.use_texture(name, &sight.colour);
            }
        }
        let states = RenderStates {
            depth_test: DepthTest::Always,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        program.use_vertex_attribute("corner", &self.corners);
        program.draw_arrays(states, viewport, self.corners.vertex_count());
    }
}

/// Whether a processor draws.
#[allow(unsafe_code)]
pub fn is_software(context: &Context) -> bool {
    // SAFETY: the context is current on this thread; reading a string changes nothing.
    let name = unsafe { context.get_parameter_string(RENDERER) }.to_lowercase();
    ["llvmpipe", "softpipe", "swrast", "software"].iter().any(|word| name.contains(word))
}
