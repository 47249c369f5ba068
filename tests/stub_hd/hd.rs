//! A stand-in for the vendor's HD library: the functions that the game binds, in front of a device
//! that rests in the middle of its workspace, or where a test puts it, and of a script of faults.
//!
//! It is strict where the vendor's library is: frames are begun and ended once per tick, forces are
//! set inside of them, nothing works without a device. Own functions, `stub_..`, are for tests.
//!
//! Built with `--cfg lacks_one` it has no `hdUnschedule`.

#![allow(non_snake_case)]

mod script;

use std::ffi::{CStr, CString, c_char, c_ulong, c_void};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

type Callback = unsafe extern "system" fn(*mut c_void) -> u32;

const DEVICE: u32 = 0;
const NO_DEVICE: u32 = u32::MAX;
const FORCE_OUTPUT: u32 = 0x4000;
/// What a callback answers to be called again.
const CONTINUE: u32 = 1;

/// `HDErrorInfo`.
#[repr(C)]
pub struct ErrorInfo {
    code: u32,
    internal: i32,
    device: u32,
}

struct Task {
    id: c_ulong,
    callback: Callback,
    user: *mut c_void,
}

// SAFETY: whoever schedules a callback lets it run on another thread.
unsafe impl Send for Task {}

struct Stub {
    script: Option<String>,
    is_open: bool,
    is_in_frame: bool,
    frames_in_tick: u32,
    enabled: Vec<u32>,
    errors: Vec<u32>,
    rate_hz: u32,
    resets: u32,
    tick: u64,
    warm_until: u64,
    position_mm: [f64; 3],
    buttons: i32,
    /// Set in this frame, and what the last frame ended with.
    set_n: [f64; 3],
    given_n: [f64; 3],
    tasks: Vec<Task>,
    tasks_made: c_ulong,
    runs: bool,
    thread: Option<JoinHandle<()>>,
    /// Everything but what is done in every tick.
    log: Vec<String>,
}

static STUB: Mutex<Stub> = Mutex::new(Stub {
    script: None,
    is_open: false,
    is_in_frame: false,
    frames_in_tick: 0,
    enabled: Vec::new(),
    errors: Vec::new(),
    rate_hz: 0,
    resets: 0,
    tick: 0,
    warm_until: 0,
    position_mm: [0.0; 3],
    buttons: 0,
    set_n: [0.0; 3],
    given_n: [0.0; 3],
    tasks: Vec::new(),
    tasks_made: 0,
    runs: false,
    thread: None,
    log: Vec::new(),
});

fn stub() -> MutexGuard<'static, Stub> {
    STUB.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Stub {
    fn fail(&mut self, code: u32) {
        self.errors.push(code);
    }

    /// Whether there is a device; if not, that is an error.
    fn is_usable(&mut self) -> bool {
        if !self.is_open {
            self.fail(0x104);
        }
        self.is_open
    }

    fn note(&mut self, event: impl Into<String>) {
        let event = event.into();
        self.log.push(event);
    }
}

/// The scheduler's thread. It spins for the last moment, as real ones are punctual.
fn run() {
    let mut due = Instant::now();
    loop {
        let (pause, tasks) = {
            let mut stub = stub();
            let pause = stub.begin_tick();
            if !stub.runs {
                return;
            }
            let tasks: Vec<(c_ulong, Callback, usize)> = stub
                .tasks
                .iter()
                .map(|task| (task.id, task.callback, task.user as usize))
                .collect();
            (pause, tasks)
        };
        due = (due + pause).max(Instant::now());
        while let Some(left) = due.checked_duration_since(Instant::now()) {
            match left.checked_sub(Duration::from_micros(200)) {
                Some(sleep) => std::thread::sleep(sleep),
                None => std::hint::spin_loop(),
            }
            if left.is_zero() {
                break;
            }
        }
        for (id, callback, user) in tasks {
            // SAFETY: whoever scheduled it keeps it good until it is unscheduled.
            let answer = unsafe { callback(user as *mut c_void) };
            if answer != CONTINUE {
                let mut stub = stub();
                stub.tasks.retain(|task| task.id != id);
                stub.note("callback done");
            }
        }
    }
}

/// A text that lives for ever.
fn text(text: &'static CStr) -> *const c_char {
    text.as_ptr()
}

/// # Safety
/// `name` is null or a C string.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn hdInitDevice(name: *const c_char) -> u32 {
    let name = if name.is_null() {
        String::new()
    } else {
        // SAFETY: the caller's.
        unsafe { CStr::from_ptr(name) }.to_string_lossy().into_owned()
    };
    let mut stub = stub();
    stub.note(format!("init '{name}'"));
    let only = stub.argument("only").map(|(only, _)| only);
    let problem = match only {
        _ if stub.is_open => Some(0x301),
        _ if stub.has("no_init") => Some(0x302),
        Some(only) if only != name => Some(0x300),
        _ => None,
    };
    if let Some(code) = problem {
        stub.fail(code);
        return NO_DEVICE;
    }
    (stub.is_open, stub.tick, stub.rate_hz, stub.warm_until) = (true, 0, 500, 0);
    stub.enabled.clear();
    DEVICE
}

#[unsafe(no_mangle)]
pub extern "system" fn hdDisableDevice(_: u32) {
    let mut stub = stub();
    if !stub.is_usable() {
        return;
    }
    stub.is_open = false;
    let [x, y, z] = stub.given_n;
    stub.note(format!("close, last force {x} {y} {z}"));
    if let Some(file) = std::env::var_os("STUB_HD_LOG") {
        // A test that awaits the file sees that it is missing.
        let _ = std::fs::write(file, stub.log.join("\n"));
    }
}

#[unsafe(no_mangle)]
pub extern "system" fn hdMakeCurrentDevice(_: u32) {
    stub().is_usable();
}

#[unsafe(no_mangle)]
pub extern "system" fn hdBeginFrame(_: u32) {
    let mut stub = stub();
    if !stub.is_usable() {
        return;
    }
    stub.frames_in_tick += 1;
    if stub.is_in_frame || stub.frames_in_tick > 1 {
        stub.note("a second frame in one tick");
        stub.fail(0x400);
    }
    stub.is_in_frame = true;
}

#[unsafe(no_mangle)]
pub extern "system" fn hdEndFrame(_: u32) {
    let mut stub = stub();
    if !stub.is_usable() {
        return;
    }
    if !stub.is_in_frame {
        stub.note("the end of no frame");
        stub.fail(0x401);
    }
    stub.is_in_frame = false;
    stub.given_n = stub.set_n;
}

#[unsafe(no_mangle)]
pub extern "system" fn hdGetError() -> ErrorInfo {
    ErrorInfo { code: stub().errors.pop().unwrap_or(0), internal: 0, device: DEVICE }
}

#[unsafe(no_mangle)]
pub extern "system" fn hdEnable(what: u32) {
    let mut stub = stub();
    if !stub.is_usable() {
        return;
    }
    stub.note(format!("enable {what:#x}"));
    if what == FORCE_OUTPUT && stub.has("no_force") {
        stub.fail(0x204);
    } else if !stub.enabled.contains(&what) {
        stub.enabled.push(what);
    }
}

#[unsafe(no_mangle)]
pub extern "system" fn hdDisable(what: u32) {
    let mut stub = stub();
    if stub.is_usable() {
        stub.note(format!("disable {what:#x}"));
        stub.enabled.retain(|enabled| *enabled != what);
    }
}

/// # Safety
/// `value` has room for one value.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn hdGetIntegerv(what: u32, value: *mut i32) {
    let mut stub = stub();
    if !stub.is_usable() {
        return;
    }
    let is_bare = stub.has("bare");
    let answer = match what {
        0x2000 => stub.buttons,
        0x2600 => i32::try_from(stub.rate_hz).unwrap_or(0),
        0x2553 if !is_bare => 6,
        0x2555 if stub.has("reset") => 1,
        0x2555 if stub.has("inkwell") => 4,
        0x2555 if !is_bare => 2,
        _ => return stub.fail(0x100),
    };
    // SAFETY: the caller's.
    unsafe { *value = answer };
}

/// # Safety
/// `values` has room for as many values as `what` has.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn hdGetDoublev(what: u32, values: *mut f64) {
    let mut stub = stub();
    if !stub.is_usable() {
        return;
    }
    let [x, y, z] = if stub.is_nan() { [f64::NAN; 3] } else { stub.position_mm };
    let is_bare = stub.has("bare");
    let answer: &[f64] = match what {
        0x2050 | 0x2051 | 0x2052 if !stub.is_in_frame => return stub.fail(0x402),
        0x2050 => &[x, y, z],
        0x2051 => &[0.0; 3],
        // A quarter turn to the left about y, column by column.
        0x2052 => &[0., 0., -1., 0., 0., 1., 0., 0., 1., 0., 0., 0., x, y, z, 1.],
        // Its middle lies 10 mm above the origin.
        0x2551 if !is_bare => &[-100.0, -60.0, -40.0, 100.0, 80.0, 40.0],
        0x2602 if !is_bare => &[0.4],
        0x2603 if !is_bare => &[2.5],
        0x2604 if !is_bare => &[0.7],
        0x2609 if !is_bare => &[0.003],
        0x2605 => {
            let warmth = if stub.tick < stub.warm_until { 0.9 } else { 0.1 };
            &[0.1, warmth, 0.1]
        }
        _ => return stub.fail(0x100),
    };
    // SAFETY: the caller's.
    unsafe { std::ptr::copy_nonoverlapping(answer.as_ptr(), values, answer.len()) };
}

#[unsafe(no_mangle)]
pub extern "system" fn hdGetString(what: u32) -> *const c_char {
    let mut stub = stub();
    if stub.has("bare") {
        stub.fail(0x100);
        return std::ptr::null();
    }
    match what {
        0x2500 => text(c"3.4.0"),
        0x2501 => text(c"Stub Omni"),
        0x2502 => text(c"2.1"),
        0x2503 => text(c"Nobody"),
        0x2504 => text(c"S-7"),
        _ => text(c""),
    }
}

/// # Safety
/// `values` has three values.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn hdSetDoublev(what: u32, values: *const f64) {
    let mut stub = stub();
    if !stub.is_usable() {
        return;
    }
    match what {
        0x2700 if stub.is_in_frame => {
            // SAFETY: the caller's.
            stub.set_n = unsafe { *values.cast::<[f64; 3]>() };
        }
        0x2700 => {
            stub.note("a force outside of a frame");
            stub.fail(0x402);
        }
        _ => stub.fail(0x100),
    }
}

#[unsafe(no_mangle)]
pub extern "system" fn hdCheckCalibration() -> u32 {
    stub().calibration()
}

#[unsafe(no_mangle)]
pub extern "system" fn hdUpdateCalibration(style: u32) {
    let mut stub = stub();
    stub.resets += 1;
    stub.note(format!("calibrate {style}"));
}

#[unsafe(no_mangle)]
pub extern "system" fn hdSetSchedulerRate(rate_hz: c_ulong) {
    let mut stub = stub();
    let asked = u32::try_from(rate_hz).unwrap_or(0);
    match stub.argument("rate").and_then(|(only, _)| only.parse().ok()) {
        Some(only) if only != asked => {
            stub.rate_hz = only;
            stub.fail(0x101);
        }
        _ => stub.rate_hz = asked,
    }
    if stub.has("grumble") {
        stub.fail(0x304);
    }
}

/// # Safety
/// `user` is what `callback` expects, until it is unscheduled.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn hdScheduleAsynchronous(
    callback: Callback,
    user: *mut c_void,
    _: u16,
) -> c_ulong {
    let mut stub = stub();
    if stub.has("no_callback") {
        stub.fail(0x501);
        return 0;
    }
    stub.note("schedule");
    stub.tasks_made += 1;
    let id = stub.tasks_made;
    stub.tasks.push(Task { id, callback, user });
    id
}

#[cfg_attr(not(lacks_one), unsafe(no_mangle))]
pub extern "system" fn hdUnschedule(task: c_ulong) {
    let mut stub = stub();
    stub.note("unschedule");
    stub.tasks.retain(|other| other.id != task);
}

#[unsafe(no_mangle)]
pub extern "system" fn hdStartScheduler() {
    let mut stub = stub();
    if stub.has("no_start") {
        return stub.fail(0x304);
    }
    stub.note("start");
    if !stub.runs && !stub.has("mute") {
        stub.runs = true;
        stub.thread = Some(std::thread::spawn(run));
    }
}

#[unsafe(no_mangle)]
pub extern "system" fn hdStopScheduler() {
    let thread = {
        let mut stub = stub();
        stub.note("stop");
        stub.runs = false;
        stub.thread.take()
    };
    if let Some(thread) = thread {
        // It panics nowhere that matters now.
        let _ = thread.join();
    }
}

/// Sets the script.
///
/// # Safety
/// `script` is a C string.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn stub_script(script: *const c_char) {
    // SAFETY: the caller's.
    let script = unsafe { CStr::from_ptr(script) }.to_string_lossy().into_owned();
    stub().script = Some(script);
}

/// Puts the stylus at a place [mm], with these buttons held.
#[unsafe(no_mangle)]
pub extern "system" fn stub_place(x: f64, y: f64, z: f64, buttons: i32) {
    let mut stub = stub();
    (stub.position_mm, stub.buttons) = ([x, y, z], buttons);
}

/// The force that the last frame ended with [N], and the ticks so far.
///
/// # Safety
/// There is room for three values and one.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn stub_given(force_n: *mut f64, ticks: *mut u64) {
    let stub = stub();
    // SAFETY: the caller's.
    unsafe {
        *force_n.cast::<[f64; 3]>() = stub.given_n;
        *ticks = stub.tick;
    }
}

/// Whether the motors get what they are given.
#[unsafe(no_mangle)]
pub extern "system" fn stub_pushes() -> u8 {
    u8::from(stub().enabled.contains(&FORCE_OUTPUT))
}

/// What was called so far, a line each; whoever asks keeps it.
#[unsafe(no_mangle)]
pub extern "system" fn stub_log() -> *const c_char {
    let log = CString::new(stub().log.join("\n")).unwrap_or_default();
    log.into_raw()
}
