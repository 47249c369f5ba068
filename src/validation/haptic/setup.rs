//! What haptic cases say beyond numbers.

use crate::haptic::TransientSettings;
use crate::haptic::simulated::{DELAY_MAX, HandModel};
use crate::validation::error::{CatalogueError, Trouble, unsupported};
use crate::validation::setup::Setup;
use serde::Deserialize;

/// Most ticks of one run.
const TICKS_MAX: f64 = 1e7;

/// Who holds the device.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub(in crate::validation) enum HandEntry {
    None {},
    Rigid {
        m_kg: f64,
        #[serde(rename = "b_Ns_m")]
        b_ns_m: f64,
        #[serde(rename = "k_N_m")]
        k_n_m: f64,
    },
    Grip {
        #[serde(rename = "grip_k_N_m")]
        grip_k_n_m: f64,
        #[serde(rename = "grip_b_Ns_m")]
        grip_b_ns_m: f64,
        m_kg: f64,
        #[serde(rename = "b_Ns_m")]
        b_ns_m: f64,
        #[serde(rename = "k_N_m")]
        k_n_m: f64,
    },
}

/// How the intent is pushed into the wall.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::validation) struct Push {
    pub from_m: f64,
    pub to_m: f64,
    pub ramp_s: f64,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::validation) struct TransientEntry {
    #[serde(rename = "gain_Ns_m")]
    gain_ns_m: f64,
    tau_s: f64,
    freq_hz: f64,
    length_s: f64,
    refractory_s: f64,
}

impl Setup<'_> {
    pub fn hand(&self) -> Result<HandModel, CatalogueError> {
        let entry: HandEntry = self.get("hand")?.unwrap_or(HandEntry::None {});
        let (model, masses) = match entry {
            HandEntry::None {} => (HandModel::None, 1.0),
            HandEntry::Rigid { m_kg, b_ns_m, k_n_m } => {
                let (mass_kg, damping_ns_m, stiffness_n_m) = (m_kg, b_ns_m, k_n_m);
                (HandModel::Rigid { mass_kg, damping_ns_m, stiffness_n_m }, m_kg.min(k_n_m))
            }
            HandEntry::Grip { grip_k_n_m, grip_b_ns_m, m_kg, b_ns_m, k_n_m } => {
                let model = HandModel::Grip {
                    grip_n_m: grip_k_n_m,
                    grip_ns_m: grip_b_ns_m,
                    mass_kg: m_kg,
                    damping_ns_m: b_ns_m,
                    stiffness_n_m: k_n_m,
                };
                (model, m_kg.min(k_n_m).min(grip_k_n_m))
            }
        };
        if masses > 0.0 {
            return Ok(model);
        }
        Err(self.error("hand", "has no positive mass or stiffness", "write positive numbers"))
    }

    pub fn push(&self) -> Result<Push, CatalogueError> {
        let push: Push = self.need("push", self.get("push")?)?;
        if push.ramp_s > 0.0 && (push.to_m - push.from_m).is_finite() {
            return Ok(push);
        }
        Err(self.error("push", "takes no time", "write a positive ramp_s"))
    }

    pub fn transient(&self) -> Result<TransientSettings, CatalogueError> {
        let entry: TransientEntry = self.need("transient", self.get("transient")?)?;
        if !(entry.tau_s > 0.0) {
            return Err(self.error("transient", "never decays", "write a positive tau_s"));
        }
        Ok(TransientSettings {
            gain_ns_m: entry.gain_ns_m,
            decay_s: entry.tau_s,
            ball_hz: entry.freq_hz,
            face_hz: entry.freq_hz,
            length_s: entry.length_s,
            refractory_s: entry.refractory_s,
        })
    }

    pub(super) fn delay_samples(&self) -> Result<usize, Trouble> {
        match self.count("delay_samples")?.unwrap_or(0) {
            delay if delay < DELAY_MAX as u64 => Ok(delay as usize),
            _ => unsupported(format!("a delay of {DELAY_MAX} samples or more")),
        }
    }

    /// A number of 0 or more.
    pub(super) fn at_least_zero(&self, key: &str) -> Result<f64, CatalogueError> {
        let number = self.number_or_zero(key)?;
        if number >= 0.0 {
            return Ok(number);
        }
        Err(self.error(key, format!("{number} is negative"), "write a number of 0 or more"))
    }

    /// The ticks of a run that lasts as long as `key` says.
    pub(super) fn ticks(&self, key: &str, period_s: f64) -> Result<u64, CatalogueError> {
        let ticks = libm::round(self.positive(key)? / period_s);
        if (1.0..=TICKS_MAX).contains(&ticks) {
            return Ok(ticks as u64);
        }
        Err(self.error(key, format!("{ticks} ticks"), "ask for 1 to 1e7 ticks"))
    }
}
