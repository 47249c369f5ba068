//! The functions of the HD library that are used, as C declares them, and calls of them that
//! cannot be made wrongly.
//!
//! Names and numbers are those of OpenHaptics 3.0 to 3.4; units are the library's: mm, N.

#![allow(unsafe_code)]

use libloading::{Error, Library};
use std::ffi::{CStr, c_char, c_ulong, c_void};

/// `HHD`, which device.
pub type Handle = u32;
/// No device.
pub const INVALID_HANDLE: Handle = u32::MAX;
/// `HDSchedulerHandle`.
pub type Task = c_ulong;
/// `HDSchedulerCallback`; its answer is one of the two below.
pub type Callback = unsafe extern "system" fn(*mut c_void) -> u32;
/// The callback is not called again.
pub const CALLBACK_DONE: u32 = 0;
/// It is called at the next tick.
pub const CALLBACK_CONTINUE: u32 = 1;
/// The usual priority among callbacks.
pub const PRIORITY: u16 = 32_767;

/// `HDErrorInfo`, returned by value.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ErrorInfo {
    /// `errorCode`.
    pub code: u32,
    /// `internalErrorCode`.
    pub internal: i32,
    /// Which device.
    pub device: Handle,
}

/// What can be asked for and set.
pub mod parameter {
    pub const CURRENT_BUTTONS: u32 = 0x2000;
    pub const CURRENT_POSITION: u32 = 0x2050;
    pub const CURRENT_VELOCITY: u32 = 0x2051;
    pub const CURRENT_TRANSFORM: u32 = 0x2052;
    pub const VERSION: u32 = 0x2500;
    pub const MODEL: u32 = 0x2501;
    pub const DRIVER_VERSION: u32 = 0x2502;
    pub const VENDOR: u32 = 0x2503;
    pub const SERIAL: u32 = 0x2504;
    pub const USABLE_WORKSPACE: u32 = 0x2551;
    pub const INPUT_DOF: u32 = 0x2553;
    pub const CALIBRATION_STYLE: u32 = 0x2555;
    pub const UPDATE_RATE: u32 = 0x2600;
    pub const NOMINAL_MAX_STIFFNESS: u32 = 0x2602;
    pub const NOMINAL_MAX_FORCE: u32 = 0x2603;
    pub const NOMINAL_MAX_CONTINUOUS_FORCE: u32 = 0x2604;
    pub const MOTOR_TEMPERATURE: u32 = 0x2605;
    pub const NOMINAL_MAX_DAMPING: u32 = 0x2609;
    pub const CURRENT_FORCE: u32 = 0x2700;
}

/// What can be enabled.
pub mod capability {
    pub const FORCE_OUTPUT: u32 = 0x4000;
    pub const MAX_FORCE_CLAMPING: u32 = 0x4001;
    pub const FORCE_RAMPING: u32 = 0x4002;
}

/// How far a device is calibrated, and the ways to do it.
pub mod calibration {
    pub const OK: u32 = 0x5000;
    pub const NEEDS_UPDATE: u32 = 0x5001;
    pub const NEEDS_MANUAL_INPUT: u32 = 0x5002;
    pub const ENCODER_RESET: u32 = 1;
    pub const AUTO: u32 = 2;
    pub const INKWELL: u32 = 4;
}

/// More errors than this are not waiting in the library's stack.
const ERRORS_MAX: usize = 64;
/// No parameter has more values: a transform has these, and no device as many motors.
const VALUES_MAX: usize = 16;

macro_rules! functions {
    ($($name:ident $symbol:literal ($($argument:ty),*) $(-> $answer:ty)?;)*) => {
        /// Every function that is used, bound.
        pub struct Hd {
            $($name: unsafe extern "system" fn($($argument),*) $(-> $answer)?,)*
        }

        impl Hd {
            /// Finds them all in a library that stays loaded as long as the program runs.
            ///
            /// # Errors
            /// The name of the first that is missing, and what the system says.
            pub fn bind(library: &'static Library) -> Result<Self, (&'static str, Error)> {
                $(
                    // SAFETY: the type is that of the function of this name in `hd.h`.
                    let $name = unsafe { library.get($symbol) };
                    let $name = *$name.map_err(|error| ($symbol, error))?;
                )*
                Ok(Hd { $($name,)* })
            }
        }
    };
}

functions! {
    init_device "hdInitDevice" (*const c_char) -> Handle;
    disable_device "hdDisableDevice" (Handle);
    make_current "hdMakeCurrentDevice" (Handle);
    begin_frame "hdBeginFrame" (Handle);
    end_frame "hdEndFrame" (Handle);
    get_error "hdGetError" () -> ErrorInfo;
    enable "hdEnable" (u32);
    disable "hdDisable" (u32);
    get_integers "hdGetIntegerv" (u32, *mut i32);
    get_doubles "hdGetDoublev" (u32, *mut f64);
    get_string "hdGetString" (u32) -> *const c_char;
    set_doubles "hdSetDoublev" (u32, *const f64);
    check_calibration "hdCheckCalibration" () -> u32;
    update_calibration "hdUpdateCalibration" (u32);
    start_scheduler "hdStartScheduler" ();
    stop_scheduler "hdStopScheduler" ();
    set_rate "hdSetSchedulerRate" (c_ulong);
    schedule "hdScheduleAsynchronous" (Callback, *mut c_void, u16) -> Task;
    unschedule "hdUnschedule" (Task);
}

// Every function takes plain values, and answers with an error in its stack where it does not like
// them: none of the calls below asks anything of its caller. The library stays loaded for good.
impl Hd {
    /// Opens the device of this name, or the usual one. [`INVALID_HANDLE`] if there is none.
    pub fn init_device(&self, name: Option<&CStr>) -> Handle {
        let name = name.map_or(std::ptr::null(), CStr::as_ptr);
        // SAFETY: null or a string that outlives the call.
        unsafe { (self.init_device)(name) }
    }

    /// Closes it.
    pub fn disable_device(&self, device: Handle) {
        // SAFETY: see above.
        unsafe { (self.disable_device)(device) }
    }

    /// What follows is about this device.
    pub fn make_current(&self, device: Handle) {
        // SAFETY: see above.
        unsafe { (self.make_current)(device) }
    }

    /// Reads the device; what follows is one moment.
    pub fn begin_frame(&self, device: Handle) {
        // SAFETY: see above.
        unsafe { (self.begin_frame)(device) }
    }

    /// Writes to the device.
    pub fn end_frame(&self, device: Handle) {
        // SAFETY: see above.
        unsafe { (self.end_frame)(device) }
    }

    /// Takes every error that waits, the newest first.
    pub fn errors(&self) -> impl Iterator<Item = u32> {
        // SAFETY: see above.
        let next = || match unsafe { (self.get_error)() }.code {
            0 => None,
            code => Some(code),
        };
        std::iter::from_fn(next).take(ERRORS_MAX)
    }

    /// Takes every error that waits; the newest is the answer.
    pub fn error(&self) -> Option<u32> {
        let mut errors = self.errors();
        let newest = errors.next();
        errors.for_each(drop);
        newest
    }

    /// Switches a capability on or off.
    pub fn switch(&self, capability: u32, on: bool) {
        let function = if on { self.enable } else { self.disable };
        // SAFETY: see above.
        unsafe { function(capability) }
    }

    /// The first of a parameter's whole numbers; 0 if the library has none.
    pub fn integer(&self, parameter: u32) -> i32 {
        let mut values = [0; VALUES_MAX];
        // SAFETY: no parameter has more values than these.
        unsafe { (self.get_integers)(parameter, values.as_mut_ptr()) };
        values[0]
    }

    /// A parameter's numbers; 0 where the library has none.
    pub fn doubles(&self, parameter: u32) -> [f64; VALUES_MAX] {
        let mut values = [0.0; VALUES_MAX];
        // SAFETY: no parameter has more values than these.
        unsafe { (self.get_doubles)(parameter, values.as_mut_ptr()) };
        values
    }

    /// Temperature of the warmest motor: 0 is cold, 1 too hot.
    pub fn temperature(&self) -> f64 {
        self.doubles(parameter::MOTOR_TEMPERATURE).into_iter().fold(0.0, f64::max)
    }

    /// A text; empty if the library has none.
    pub fn text(&self, parameter: u32) -> String {
        // SAFETY: see above.
        let text = unsafe { (self.get_string)(parameter) };
        if text.is_null() {
            return String::new();
        }
        // SAFETY: the library's strings end with a zero and live as long as it.
        let text = unsafe { CStr::from_ptr(text) };
        text.to_string_lossy().trim().to_string()
    }

    /// The force from the end of this frame on [N].
    pub fn set_force(&self, force_n: [f64; 3]) {
        // SAFETY: the parameter has three values.
        unsafe { (self.set_doubles)(parameter::CURRENT_FORCE, force_n.as_ptr()) };
    }

    /// How far the device is calibrated.
    pub fn check_calibration(&self) -> u32 {
        // SAFETY: see above.
        unsafe { (self.check_calibration)() }
    }

    /// Calibrates it.
    pub fn update_calibration(&self, style: u32) {
        // SAFETY: see above.
        unsafe { (self.update_calibration)(style) }
    }

    /// Asks for so many ticks per second.
    pub fn set_rate(&self, rate_hz: u32) {
        // SAFETY: see above.
        unsafe { (self.set_rate)(c_ulong::from(rate_hz)) }
    }

    /// The library's scheduler begins to call.
    pub fn start_scheduler(&self) {
        // SAFETY: see above.
        unsafe { (self.start_scheduler)() }
    }

    /// It calls no more when this returns.
    pub fn stop_scheduler(&self) {
        // SAFETY: see above.
        unsafe { (self.stop_scheduler)() }
    }

    /// From now on `callback` is called with `user` in every tick, on the library's thread.
    ///
    /// # Safety
    /// `user` is what the callback expects, until it has answered that it is done, or the scheduler
    /// has stopped.
    pub unsafe fn schedule(&self, callback: Callback, user: *mut c_void) -> Task {
        // SAFETY: the caller's.
        unsafe { (self.schedule)(callback, user, PRIORITY) }
    }

    /// It is called no more.
    pub fn unschedule(&self, task: Task) {
        // SAFETY: see above.
        unsafe { (self.unschedule)(task) }
    }
}
