//! Pictures without a window: an OpenGL context of its own, through EGL without any surface.

use super::NoPicture;
use super::hud;
use super::painter::Painter;
use super::stage::Stage;
use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::{DrawList, Hud};
use hapticbillard::table::Table;
use khronos_egl as egl;
use std::sync::Arc;
use std::time::Instant;
use three_d::context::{HasContext, RENDERER};
use three_d::*;

/// EGL_PLATFORM_SURFACELESS_MESA.
const SURFACELESS: egl::Enum = 0x31DD;

type Egl = egl::DynamicInstance<egl::EGL1_5>;

fn failed(step: &str, reason: impl std::fmt::Display) -> NoPicture {
    NoPicture(format!(
        "cannot draw without a window: {step}: {reason}; \
         on Debian and Ubuntu: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri"
    ))
}

/// A context that belongs to this thread.
#[allow(unsafe_code)]
fn context() -> Result<Context, NoPicture> {
    // SAFETY: loads the system's EGL library, whose initialisers are those of a system library.
    // It is leaked, so nothing that is loaded from it can outlive it.
    let egl: &'static Egl = Box::leak(Box::new(
        unsafe { Egl::load_required() }.map_err(|error| failed("no EGL", error))?,
    ));
    // SAFETY: the default display is what the surfaceless platform asks for.
    let display =
        unsafe { egl.get_platform_display(SURFACELESS, egl::DEFAULT_DISPLAY, &[egl::ATTRIB_NONE]) }
            .map_err(|error| failed("EGL has no surfaceless display", error))?;
    egl.initialize(display).map_err(|error| failed("EGL does not start", error))?;
    egl.bind_api(egl::OPENGL_API).map_err(|error| failed("no OpenGL", error))?;
    let wanted =
        [egl::SURFACE_TYPE, egl::PBUFFER_BIT, egl::RENDERABLE_TYPE, egl::OPENGL_BIT, egl::NONE];
    let config = egl
        .choose_first_config(display, &wanted)
        .map_err(|error| failed("no EGL configuration", error))?
        .ok_or_else(|| failed("no EGL configuration", "none fits"))?;
    let version = [
        egl::CONTEXT_MAJOR_VERSION,
        3,
        egl::CONTEXT_MINOR_VERSION,
        3,
        egl::CONTEXT_OPENGL_PROFILE_MASK,
        egl::CONTEXT_OPENGL_CORE_PROFILE_BIT,
        egl::NONE,
    ];
    let own = egl
        .create_context(display, config, None, &version)
        .map_err(|error| failed("no OpenGL 3.3", error))?;
    egl.make_current(display, None, None, Some(own))
        .map_err(|error| failed("no OpenGL context", error))?;
    // SAFETY: the context is current on this thread, and the functions come from its own EGL.
    let gl = unsafe {
        context::Context::from_loader_function(|name| {
            egl.get_proc_address(name).map_or(std::ptr::null(), |function| function as *const _)
        })
    };
    Context::from_gl_context(Arc::new(gl)).map_err(|error| failed("OpenGL", error))
}

/// What draws, by its own name.
///
/// # Errors
/// [`NoPicture`] if this machine has no OpenGL.
#[allow(unsafe_code)]
pub fn card() -> Result<String, NoPicture> {
    let context = context()?;
    // SAFETY: the context was just made current on this thread; reading a string changes nothing.
    Ok(unsafe { context.get_parameter_string(RENDERER) })
}

/// Where pictures of a table are made without a window.
pub struct Studio {
    context: Context,
    stage: Stage,
    painter: Painter,
    gui: GUI,
    /// What pictures are drawn into, and its size.
    target: Option<(Texture2D, DepthTexture2D)>,
}

impl Studio {
    /// Brings a table into the graphics card.
    ///
    /// # Errors
    /// [`NoPicture`] if this machine has no OpenGL.
    pub fn new(table: &Arc<Table>) -> Result<Self, NoPicture> {
        let context = context()?;
        let wrong = |error: CoreError| failed("OpenGL", error);
        Ok(Studio {
            stage: Stage::new(&context, table).map_err(wrong)?,
            painter: Painter::new(&context).map_err(wrong)?,
            gui: GUI::new(&context),
            target: None,
            context,
        })
    }

    /// What draws, by its own name.
    #[allow(unsafe_code)]
    pub fn card(&self) -> String {
        // SAFETY: the context is current on this thread; reading a string changes nothing.
        unsafe { self.context.get_parameter_string(RENDERER) }
    }

    /// One picture, rows from the top, red, green, blue and opacity in each pixel; nothing is
    /// written over it.
    ///
    /// # Errors
    /// [`NoPicture`] if the graphics card refuses.
    pub fn pixels(
        &mut self,
        list: &DrawList,
        settings: &PictureSettings,
        size: (u32, u32),
    ) -> Result<Vec<[u8; 4]>, NoPicture> {
        self.written(list, &Hud::default(), settings, size)
    }

    /// The same with labels and display.
    ///
    /// # Errors
    /// [`NoPicture`] if the graphics card refuses.
    pub fn written(
        &mut self,
        list: &DrawList,
        hud: &Hud,
        settings: &PictureSettings,
        size: (u32, u32),
    ) -> Result<Vec<[u8; 4]>, NoPicture> {
        self.draw(list, hud, settings, size)?;
        let (colour, _) = self.target(size);
        Ok(colour.as_color_target(None).read())
    }

    /// Draws a picture and waits until it is there, without reading it. Returns how long it took
    /// [s].
    ///
    /// # Errors
    /// [`NoPicture`] if the graphics card refuses.
    #[allow(unsafe_code)]
    pub fn timed(
        &mut self,
        list: &DrawList,
        settings: &PictureSettings,
        size: (u32, u32),
    ) -> Result<f64, NoPicture> {
        let begun = Instant::now();
        self.draw(list, &Hud::default(), settings, size)?;
        // SAFETY: the context is current on this thread; waiting for it changes nothing.
        unsafe { self.context.finish() };
        Ok(begun.elapsed().as_secs_f64())
    }

    fn target(&mut self, (width, height): (u32, u32)) -> &(Texture2D, DepthTexture2D) {
        let fits = |(colour, _): &(Texture2D, DepthTexture2D)| {
            (colour.width(), colour.height()) == (width, height)
        };
        let (edge, soft) = (Wrapping::ClampToEdge, Interpolation::Linear);
        let context = &self.context;
        let old = self.target.take().filter(fits);
        self.target.insert(old.unwrap_or_else(|| {
            (
                Texture2D::new_empty::<[u8; 4]>(
                    context, width, height, soft, soft, None, edge, edge,
                ),
                DepthTexture2D::new::<f32>(context, width, height, edge, edge),
            )
        }))
    }

    fn draw(
        &mut self,
        list: &DrawList,
        hud: &Hud,
        settings: &PictureSettings,
        size: (u32, u32),
    ) -> Result<(), NoPicture> {
        let wrong = |error: CoreError| failed("OpenGL", error);
        let viewport = Viewport::new_at_origo(size.0, size.1);
        let scale = f32::from(settings.hud_scale) / 100.0;
        self.gui.update(&mut [], 0.0, viewport, 1.0, |ui| {
            let layer = egui::LayerId::background();
            hud::paint(&ui.ctx().layer_painter(layer), list, hud, scale);
        });
        let ready = self.painter.prepare(&mut self.stage, list, settings, size).map_err(wrong)?;
        self.target(size);
        let Some((colour, depth)) = &self.target else { return Ok(()) };
        let target = RenderTarget::new(colour.as_color_target(None), depth.as_depth_target());
        let (stage, gui) = (&mut self.stage, &self.gui);
        self.painter.finish(ready, stage, list, settings, &target, || gui.render()).map_err(wrong)
    }
}
