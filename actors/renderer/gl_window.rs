//! OpenGL in a window. The graphics library has one of its own; this one notices when the graphics
//! card loses everything, and under X11 goes by GLX first, whose software renderer hands pictures
//! to the server in shared memory.

use super::window::NoWindow;
use glutin::config::{Config, ConfigTemplateBuilder};
use glutin::context::{ContextAttributesBuilder, PossiblyCurrentContext, Robustness};
use glutin::display::{Display, DisplayApiPreference, DisplayFeatures, GetGlDisplay};
use glutin::error::ErrorKind;
use glutin::prelude::*;
use glutin::surface::{Surface, SurfaceAttributesBuilder, SwapInterval, WindowSurface};
use raw_window_handle::{HasRawDisplayHandle, HasRawWindowHandle, RawWindowHandle};
use std::cell::Cell;
use std::ffi::CString;
use std::num::NonZeroU32;
use std::sync::Arc;
use three_d::Context;
use three_d::context::HasContext;
use winit::dpi::PhysicalSize;
use winit::window::Window;

/// Bits of what tells how far something is away.
const DEPTH_BITS: u8 = 24;

/// Lower addresses are what some drivers say in place of none.
const FIRST_ADDRESS: usize = 4096;

/// glGetGraphicsResetStatus.
type ResetStatus = unsafe extern "system" fn() -> u32;

/// Why a picture is not in the window.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NotShown {
    /// Everything in the graphics card is gone; [`GlWindow::renew`] begins anew.
    #[error("the graphics card has lost everything")]
    Lost,
    /// Something else.
    #[error("{0}")]
    Other(String),
}

/// A window that can be drawn into, on the thread that made it.
pub struct GlWindow {
    context: Context,
    reset_status: Option<ResetStatus>,
    /// It was lost: the card tells so only once.
    is_lost: Cell<bool>,
    current: PossiblyCurrentContext,
    surface: Surface<WindowSurface>,
    config: Config,
    handle: RawWindowHandle,
}

impl std::ops::Deref for GlWindow {
    type Target = Context;

    fn deref(&self) -> &Context {
        &self.context
    }
}

fn failed(error: impl std::fmt::Display) -> NoWindow {
    NoWindow(format!("no OpenGL: {error}"))
}

impl GlWindow {
    /// OpenGL in this window, that waits for no screen and has no samples.
    ///
    /// # Errors
    /// [`NoWindow`] if this machine has none.
    pub fn new(window: &Window) -> Result<Self, NoWindow> {
        let handle = window.raw_window_handle();
        let mut failed = None;
        for preference in preferences(handle) {
            match Self::by(window, preference) {
                Ok(made) => return Ok(made),
                Err(error) => failed = failed.or(Some(error)),
            }
        }
        Err(failed.unwrap_or_else(|| NoWindow("no OpenGL".into())))
    }

    #[allow(unsafe_code)]
    fn by(window: &Window, preference: DisplayApiPreference) -> Result<Self, NoWindow> {
        let handle = window.raw_window_handle();
        // SAFETY: the handles are those of a window that outlives the display: the desk holds both,
        // and drops this first.
        let display = unsafe { Display::new(window.raw_display_handle(), preference) };
        let display = display.map_err(failed)?;
        let wanted = ConfigTemplateBuilder::new()
            .prefer_hardware_accelerated(None)
            .with_depth_size(DEPTH_BITS)
            .compatible_with_native_window(handle)
            .build();
        // SAFETY: as above.
        let config = unsafe { display.find_configs(wanted) }.map_err(failed)?.next();
        let config = config.ok_or_else(|| failed("no way to draw fits the window"))?;
        let [width, height] = sides(window.inner_size());
        let attributes =
            SurfaceAttributesBuilder::<WindowSurface>::new().build(handle, width, height);
        // SAFETY: as above.
        let surface =
            unsafe { display.create_window_surface(&config, &attributes) }.map_err(failed)?;
        let (current, context, reset_status) = begin(&config, &surface, handle)?;
        let is_lost = Cell::new(false);
        Ok(GlWindow { context, reset_status, is_lost, current, surface, config, handle })
    }

    /// Begins anew in the same window after everything was lost: nothing of what was made before
    /// may be drawn again.
    ///
    /// # Errors
    /// [`NoWindow`] if the graphics card is gone altogether.
    pub fn renew(&mut self) -> Result<(), NoWindow> {
        let (current, context, reset_status) = begin(&self.config, &self.surface, self.handle)?;
        (self.current, self.context, self.reset_status) = (current, context, reset_status);
        self.is_lost.set(false);
        Ok(())
    }

    /// The window has another size now.
    pub fn resize(&self, size: PhysicalSize<u32>) {
        let [width, height] = sides(size);
        self.surface.resize(&self.current, width, height);
    }

    /// Everything is there.
    ///
    /// # Errors
    /// [`NotShown::Lost`] if it is not, until it is [renewed](Self::renew).
    #[allow(unsafe_code)]
    pub fn check(&self) -> Result<(), NotShown> {
        // SAFETY: the function is one of this context's, which is current on this thread.
        if self.reset_status.is_some_and(|status| unsafe { status() } != 0) {
            self.is_lost.set(true);
        }
        if self.is_lost.get() { Err(NotShown::Lost) } else { Ok(()) }
    }

    /// What was drawn is seen.
    ///
    /// # Errors
    /// [`NotShown`] says why not.
    pub fn show(&self) -> Result<(), NotShown> {
        self.check()?;
        self.surface.swap_buffers(&self.current).map_err(|error| match error.error_kind() {
            ErrorKind::ContextLost => {
                self.is_lost.set(true);
                NotShown::Lost
            }
            _ => NotShown::Other(error.to_string()),
        })
    }
}

/// A context of its own that is current.
#[allow(unsafe_code)]
fn begin(
    config: &Config,
    surface: &Surface<WindowSurface>,
    handle: RawWindowHandle,
) -> Result<(PossiblyCurrentContext, Context, Option<ResetStatus>), NoWindow> {
    let display = config.display();
    let robust =
        ContextAttributesBuilder::new().with_robustness(Robustness::RobustLoseContextOnReset);
    let plain = ContextAttributesBuilder::new().build(Some(handle));
    let is_robust = display.supported_features().contains(DisplayFeatures::CONTEXT_ROBUSTNESS);
    // SAFETY: the handle is that of the window that the surface was made for.
    let robust = is_robust
        .then(|| unsafe { display.create_context(config, &robust.build(Some(handle))) }.ok())
        .flatten();
    let has_notice = robust.is_some();
    let context = match robust {
        Some(context) => context,
        // SAFETY: as above.
        None => unsafe { display.create_context(config, &plain) }.map_err(failed)?,
    };
    let current = context.make_current(surface).map_err(failed)?;
    // A screen is not waited for: the desk keeps time. What cannot be set is as it is.
    let _ = surface.set_swap_interval(&current, SwapInterval::DontWait);
    let address = |name: &str| {
        CString::new(name).map_or(std::ptr::null(), |name| display.get_proc_address(&name))
    };
    // SAFETY: the context is current on this thread, and the functions are its own.
    let gl = unsafe { three_d::context::Context::from_loader_function(address) };
    // Any name may have an address: only what the driver says it has is called.
    let (version, extensions) = (gl.version(), gl.supported_extensions());
    let has = |name: &str| extensions.contains(name);
    let name = if version.is_embedded {
        has("GL_KHR_robustness").then_some("glGetGraphicsResetStatusKHR")
    } else if has("GL_KHR_robustness") || (4, 5) <= (version.major, version.minor) {
        Some("glGetGraphicsResetStatus")
    } else {
        has("GL_ARB_robustness").then_some("glGetGraphicsResetStatusARB")
    };
    let status =
        name.filter(|_| has_notice).map(address).filter(|status| FIRST_ADDRESS < *status as usize);
    // SAFETY: the function of that name has that type (OpenGL 4.5, KHR_robustness, ARB_robustness).
    let status = status.map(|status| unsafe {
        std::mem::transmute::<*const std::ffi::c_void, ResetStatus>(status)
    });
    let gl = Context::from_gl_context(Arc::new(gl)).map_err(failed)?;
    Ok((current, gl, status))
}

fn sides(size: PhysicalSize<u32>) -> [NonZeroU32; 2] {
    [size.width, size.height].map(|side| NonZeroU32::new(side).unwrap_or(NonZeroU32::MIN))
}

/// Ways to OpenGL, the one that is tried first before.
#[cfg(target_os = "linux")]
fn preferences(_: RawWindowHandle) -> Vec<DisplayApiPreference> {
    let hook = Box::new(winit::platform::x11::register_xlib_error_hook);
    // The first goes on with EGL where there is no GLX at all, as under Wayland.
    vec![DisplayApiPreference::GlxThenEgl(hook), DisplayApiPreference::Egl]
}

/// The only way to OpenGL.
#[cfg(target_os = "windows")]
fn preferences(handle: RawWindowHandle) -> Vec<DisplayApiPreference> {
    vec![DisplayApiPreference::WglThenEgl(Some(handle))]
}

/// The only way to OpenGL.
#[cfg(target_os = "macos")]
fn preferences(_: RawWindowHandle) -> Vec<DisplayApiPreference> {
    vec![DisplayApiPreference::Cgl]
}
