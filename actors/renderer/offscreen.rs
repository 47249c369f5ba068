//! Pictures without a window: an OpenGL context of its own, through EGL without any surface.

use super::NoPicture;
use super::hud;
use super::stage::{BACKGROUND, Stage};
use hapticbillard::renderer::{DrawList, Hud};
use hapticbillard::table::Table;
use khronos_egl as egl;
use std::sync::Arc;
use std::time::{Duration, Instant};
use three_d::context::{HasContext, RENDERER};
use three_d::*;

/// EGL_PLATFORM_SURFACELESS_MESA.
const SURFACELESS: egl::Enum = 0x31DD;
/// Samples per pixel.
const SAMPLES: u32 = 4;

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

/// One picture, rows from the top, red, green, blue and opacity in each pixel; nothing is written
/// over it.
///
/// # Errors
/// [`NoPicture`] if this machine has no OpenGL.
pub fn pixels(table: &Table, list: &DrawList, size: (u32, u32)) -> Result<Vec<[u8; 4]>, NoPicture> {
    written(table, list, &Hud::default(), size)
}

/// How long one picture takes: the same picture so many times, each until it is done. The first
/// one, in which shaders are made, does not count.
///
/// # Errors
/// [`NoPicture`] if this machine has no OpenGL.
#[allow(unsafe_code)]
pub fn frame_times(
    table: &Table,
    list: &DrawList,
    (width, height): (u32, u32),
    count: usize,
) -> Result<Vec<Duration>, NoPicture> {
    let context = context()?;
    let mut stage = Stage::new(&context, table);
    let viewport = Viewport::new_at_origo(width, height);
    let texture = Texture2D::new_empty::<[u8; 4]>(
        &context,
        width,
        height,
        Interpolation::Nearest,
        Interpolation::Nearest,
        None,
        Wrapping::ClampToEdge,
        Wrapping::ClampToEdge,
    );
    let depth = DepthTexture2D::new::<f32>(
        &context,
        width,
        height,
        Wrapping::ClampToEdge,
        Wrapping::ClampToEdge,
    );
    let mut times = Vec::with_capacity(count);
    for _ in 0..=count {
        let begun = Instant::now();
        let target = RenderTarget::new(texture.as_color_target(None), depth.as_depth_target());
        let [r, g, b] = BACKGROUND;
        target.clear(ClearState::color_and_depth(r, g, b, 1.0, 1.0));
        target
            .write::<CoreError>(|| {
                stage.draw(list, viewport);
                Ok(())
            })
            .map_err(|error| failed("OpenGL", error))?;
        // SAFETY: the context is current on this thread; waiting changes nothing.
        unsafe { context.finish() };
        times.push(begun.elapsed());
    }
    times.remove(0);
    Ok(times)
}

/// The same with labels and display.
///
/// # Errors
/// [`NoPicture`] if this machine has no OpenGL.
pub fn written(
    table: &Table,
    list: &DrawList,
    hud: &Hud,
    (width, height): (u32, u32),
) -> Result<Vec<[u8; 4]>, NoPicture> {
    let context = context()?;
    let mut stage = Stage::new(&context, table);
    let viewport = Viewport::new_at_origo(width, height);
    let mut gui = GUI::new(&context);
    gui.update(&mut [], 0.0, viewport, 1.0, |ui| {
        let layer = egui::LayerId::background();
        hud::paint(&ui.ctx().layer_painter(layer), list, hud);
    });
    let target = RenderTargetMultisample::<[u8; 4], f32>::new(&context, width, height, SAMPLES);
    let [r, g, b] = BACKGROUND;
    target.clear(ClearState::color_and_depth(r, g, b, 1.0, 1.0));
    target
        .write::<CoreError>(|| {
            stage.draw(list, viewport);
            gui.render()
        })
        .map_err(|error| failed("OpenGL", error))?;
    let texture = target.resolve_color();
    Ok(texture.as_color_target(None).read())
}
