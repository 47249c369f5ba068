//! A device that is open: found by its name, asked for its limits, calibrated. No force yet.

use super::NoOpenHaptics;
use super::access::hint;
use super::faults::{remedy, short};
use super::hd::{Handle, Hd, INVALID_HANDLE, calibration, parameter};
use super::library::Loaded;
use crate::haptic::rights::Refusal;
use glam::DVec3;
use hapticbillard::haptic::DeviceSpec;
use hapticbillard::haptic::openhaptics::{self, HdLimits, told};
use std::ffi::CString;

/// What the library calls its usual device, where it takes no null.
const USUAL_NAMES: [&str; 2] = ["Default PHANToM", "Default Device"];
/// The rate that is asked for [Hz].
const RATE_HZ: u32 = 1000;

/// An open device. Dropping it closes it.
pub struct Session {
    loaded: Loaded,
    device: Handle,
    /// What it is, in units.
    pub spec: DeviceSpec,
    /// The middle of its workspace, in the library's frame [m].
    pub centre_m: DVec3,
    /// How it is calibrated; none if it need not be.
    pub style: Option<u32>,
    /// Model, serial number and versions.
    pub about: String,
    /// That it does not run at the rate asked for.
    pub rate_refused: Option<Refusal>,
}

impl Session {
    /// Opens the device of this name, or the usual one.
    ///
    /// # Errors
    /// [`NoOpenHaptics::NoDevice`] with the library's reason for each name that was tried.
    pub fn open(loaded: Loaded, name: Option<&str>) -> Result<Self, NoOpenHaptics> {
        let hd = loaded.hd;
        let device = init(loaded, name)?;
        hd.make_current(device);
        let rate_refused = ask_for_rate(hd);
        let limits = limits(hd);
        let about = about(hd);
        // The library stays for good, and so do its devices' names.
        let model = Box::leak(told(&hd.text(parameter::MODEL)).into_boxed_str());
        let session = Session {
            loaded,
            device,
            spec: limits.spec(model),
            centre_m: limits.centre_m(),
            style: style(hd),
            about,
            rate_refused,
        };
        // What it does not know of itself is no error.
        hd.error();
        Ok(session)
    }

    /// The functions.
    pub fn hd(&self) -> &'static Hd {
        self.loaded.hd
    }

    /// The functions; what follows is about this device.
    pub fn current(&self) -> &'static Hd {
        self.loaded.hd.make_current(self.device);
        self.loaded.hd
    }

    /// The device.
    pub fn device(&self) -> Handle {
        self.device
    }

    /// The library that it was found in.
    pub fn library(&self) -> String {
        self.loaded.name.display().to_string()
    }

    /// Sets the encoders to zero where they must be before the loop begins. Other ways of
    /// calibration work while it runs.
    ///
    /// # Errors
    /// [`NoOpenHaptics::NotCalibrated`] if that does not help.
    pub fn calibrate(&self) -> Result<(), NoOpenHaptics> {
        let hd = self.current();
        if self.style != Some(calibration::ENCODER_RESET)
            || hd.check_calibration() == calibration::OK
        {
            return Ok(());
        }
        hd.update_calibration(calibration::ENCODER_RESET);
        match (hd.check_calibration(), hd.error()) {
            (calibration::OK, None) => Ok(()),
            (state, error) => {
                let reason = short(error.unwrap_or(state));
                Err(NoOpenHaptics::NotCalibrated { library: self.library(), reason })
            }
        }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let hd = self.current();
        hd.disable_device(self.device);
        hd.error();
    }
}

/// Opens it, and says why not.
fn init(loaded: Loaded, name: Option<&str>) -> Result<Handle, NoOpenHaptics> {
    let hd = loaded.hd;
    hd.error();
    let names: Vec<Option<&str>> = match name {
        Some(name) => vec![Some(name)],
        None => std::iter::once(None).chain(USUAL_NAMES.into_iter().map(Some)).collect(),
    };
    let mut tried = Vec::new();
    let mut helps = None;
    for name in names {
        let shown = name.map_or("the default device".to_string(), |name| format!("\"{name}\""));
        let Ok(c_name) = name.map(CString::new).transpose() else {
            tried.push(format!("{shown}: no name"));
            continue;
        };
        let device = hd.init_device(c_name.as_deref());
        match (device, hd.error()) {
            (INVALID_HANDLE, None) => tried.push(format!("{shown}: no reason")),
            (INVALID_HANDLE, Some(code)) => {
                helps = helps.or(Some(code));
                tried.push(format!("{shown}: {}", short(code)));
            }
            (device, None) => return Ok(device),
            (device, Some(code)) => {
                hd.disable_device(device);
                hd.error();
                helps = helps.or(Some(code));
                tried.push(format!("{shown}: {}", short(code)));
            }
        }
    }
    let library = loaded.name.display().to_string();
    let remedy = helps.map_or("try the vendor's own diagnosis program", remedy);
    let remedy = format!("{remedy}; {}", hint());
    Err(NoOpenHaptics::NoDevice { library, tried: tried.join(", "), remedy })
}

/// Asks for 1 kHz; a refusal, with the rate that it runs at instead.
fn ask_for_rate(hd: &Hd) -> Option<Refusal> {
    hd.error();
    hd.set_rate(RATE_HZ);
    // Some drivers grumble and set it all the same.
    let error = hd.error();
    let rate = rate_hz(hd);
    (rate != f64::from(RATE_HZ)).then(|| Refusal {
        asked: format!("a rate of {RATE_HZ} Hz"),
        reason: error.map_or("the library gives no reason".to_string(), short),
        remedy: format!("the servo runs at {rate} Hz, with less stiffness"),
    })
}

fn rate_hz(hd: &Hd) -> f64 {
    let rate = f64::from(hd.integer(parameter::UPDATE_RATE));
    let is_known = hd.error().is_none();
    openhaptics::rate_hz(rate).filter(|_| is_known).unwrap_or(f64::from(RATE_HZ))
}

/// The best way to calibrate that the device knows.
fn style(hd: &Hd) -> Option<u32> {
    let styles = hd.integer(parameter::CALIBRATION_STYLE).unsigned_abs();
    let preferred = [calibration::AUTO, calibration::INKWELL, calibration::ENCODER_RESET];
    preferred.into_iter().find(|style| styles & style != 0)
}

fn about(hd: &Hd) -> String {
    let parts = [
        (parameter::VENDOR, ""),
        (parameter::MODEL, ""),
        (parameter::SERIAL, "serial number "),
        (parameter::DRIVER_VERSION, "driver "),
        (parameter::VERSION, "library "),
    ];
    let parts = parts.map(|(parameter, word)| (word, told(&hd.text(parameter))));
    let told = parts.iter().filter(|(_, text)| !text.is_empty());
    told.map(|(word, text)| format!("{word}{text}")).collect::<Vec<_>>().join(", ")
}

/// What the device says of itself.
fn limits(hd: &Hd) -> HdLimits {
    let [a, b, c, d, e, f, ..] = hd.doubles(parameter::USABLE_WORKSPACE);
    hd.error();
    let asked = |parameter| {
        let value = hd.doubles(parameter)[0];
        hd.error().is_none().then_some(value)
    };
    HdLimits {
        workspace_mm: [a, b, c, d, e, f],
        force_max_n: asked(parameter::NOMINAL_MAX_FORCE),
        force_continuous_n: asked(parameter::NOMINAL_MAX_CONTINUOUS_FORCE),
        stiffness_max_n_mm: asked(parameter::NOMINAL_MAX_STIFFNESS),
        damping_max_ns_mm: asked(parameter::NOMINAL_MAX_DAMPING),
        rate_hz: rate_hz(hd),
        input_dof: hd.integer(parameter::INPUT_DOF),
    }
}
