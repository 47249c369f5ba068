//! The panel of a haptic device: what its servo does, in numbers and plain words.
//!
//! A servo ticks far more often than a picture is drawn, and numbers that change sixty times a
//! second cannot be read. So the panel shows the largest force and depth since it last changed, and
//! keeps a stage of the safety chain for a moment after it acted.

use super::hud::Gauge;
use super::words::Words;
use crate::haptic::{Counters, SafetyFlags, ServoReport};
use crate::units::Seconds;

/// How often the numbers change [s].
const RENEW_S: Seconds = 0.1;
/// How long a stage stays after it acted [s].
const STAY_S: Seconds = 0.6;
/// Over which time the rate is measured [s].
const RATE_S: Seconds = 0.5;

/// Every stage, from what takes the force away to what only shapes it, and its words.
const STAGES: [(SafetyFlags, &str); 11] = [
    (SafetyFlags::DISCONNECTED, "safety_disconnected"),
    (SafetyFlags::NOT_FINITE, "safety_not_finite"),
    (SafetyFlags::TOO_FAST, "safety_too_fast"),
    (SafetyFlags::STALE, "safety_stale"),
    (SafetyFlags::LATE, "safety_late"),
    (SafetyFlags::RAMP, "safety_ramp"),
    (SafetyFlags::THERMAL, "safety_thermal"),
    (SafetyFlags::CLAMP, "safety_clamp"),
    (SafetyFlags::PASSIVITY, "safety_passivity"),
    (SafetyFlags::SLEW, "safety_slew"),
    (SafetyFlags::CROSS_FADE, "safety_cross_fade"),
];

/// How punctual the servo is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Punctuality {
    /// Ticks so far.
    pub ticks: u64,
    /// Deadlines without a tick.
    pub missed: u64,
    /// From a deadline to the wake: half of all are not later, 99 of 100, and all [s].
    pub late_s: [Seconds; 3],
}

/// What the panel shows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FeltPanel {
    /// Which device.
    pub title: String,
    /// Names and values.
    pub rows: Vec<(String, String)>,
    /// The force, of the largest.
    pub force: Option<Gauge>,
    /// What the safety chain does, in plain words.
    pub acting: Vec<String>,
    /// It does something.
    pub is_acting: bool,
}

/// What is collected for the panel.
#[derive(Debug, Clone)]
pub struct Overlay {
    device: String,
    force_max_n: f64,
    /// The report that is shown, with the largest force and depth of its time.
    shown: Option<(ServoReport, Peak)>,
    peak: Peak,
    renewed_s: Seconds,
    counters: Counters,
    acted_s: [Option<Seconds>; STAGES.len()],
    now_s: Seconds,
    punctuality: Punctuality,
    rate: Rate,
}

#[derive(Debug, Clone, Copy, Default)]
struct Peak {
    force_n: f64,
    depth_m: f64,
}

/// Ticks at a time, and what came of them.
#[derive(Debug, Clone, Copy, Default)]
struct Rate {
    since: Option<(Seconds, u64)>,
    hz: Option<f64>,
}

impl Overlay {
    /// The panel of a device that renders `force_max_n` at most.
    pub fn new(device: String, force_max_n: f64) -> Self {
        Overlay {
            device,
            force_max_n,
            shown: None,
            peak: Peak::default(),
            renewed_s: f64::NEG_INFINITY,
            counters: Counters::default(),
            acted_s: [None; STAGES.len()],
            now_s: 0.0,
            punctuality: Punctuality::default(),
            rate: Rate::default(),
        }
    }

    /// Takes the newest tick at `now_s` on the picture's clock [s].
    pub fn take(&mut self, report: &ServoReport, now_s: Seconds) {
        self.now_s = now_s;
        self.peak.force_n = self.peak.force_n.max(report.force.0.length());
        self.peak.depth_m = self.peak.depth_m.max(report.depth_m);
        let acted = acted(report, &self.counters);
        self.counters = report.counters;
        for ((flag, _), when) in STAGES.iter().zip(&mut self.acted_s) {
            if acted.has(*flag) {
                *when = Some(now_s);
            }
        }
        if self.renewed_s + RENEW_S <= now_s {
            self.shown = Some((*report, std::mem::take(&mut self.peak)));
            self.renewed_s = now_s;
        }
    }

    /// Takes how punctual the servo is.
    pub fn take_punctuality(&mut self, punctuality: Punctuality, now_s: Seconds) {
        self.punctuality = punctuality;
        match self.rate.since {
            Some((since_s, ticks)) if since_s + RATE_S <= now_s => {
                let ran = punctuality.ticks.saturating_sub(ticks) as f64;
                self.rate.hz = Some(ran / (now_s - since_s));
                self.rate.since = Some((now_s, punctuality.ticks));
            }
            Some(_) => {}
            None => self.rate.since = Some((now_s, punctuality.ticks)),
        }
    }

    /// What the panel shows now; none before the first tick.
    pub fn panel(&self, words: &Words) -> Option<FeltPanel> {
        let (report, peak) = self.shown.as_ref()?;
        let us = |seconds: f64| format!("{:.0}", seconds * 1e6);
        let [p50, p99, most] = self.punctuality.late_s.map(us);
        let rate = self.rate.hz.map_or_else(|| String::from("–"), |hz| format!("{hz:.0}"));
        let missed = self.punctuality.missed.to_string();
        let late = words
            .fill("felt_late_value", "p50", &p50)
            .replace("{p99}", &p99)
            .replace("{max}", &most);
        let factor = report.stiffness_factor;
        let stiffness = format!("{:.0} N/m", report.stiffness_max_n_m * factor);
        let stiffness = if factor < 0.995 {
            let percent = format!("{:.0}", 100.0 * factor);
            format!("{stiffness} {}", words.fill("felt_softened", "percent", &percent))
        } else {
            stiffness
        };
        let force = words
            .fill("felt_force_value", "force", &format!("{:.2}", peak.force_n))
            .replace("{max}", &format!("{:.1}", self.force_max_n));
        let rate = words.fill("felt_rate_value", "hz", &rate).replace("{missed}", &missed);
        let rows = [
            ("felt_rate", rate),
            ("felt_late", late),
            ("felt_force", force.clone()),
            ("felt_depth", format!("{:.1} mm", 1e3 * peak.depth_m)),
            ("felt_energy", format!("{:+.1} mJ", 1e3 * report.energy_j)),
            ("felt_stiffness", stiffness),
        ];
        let acting: Vec<String> = STAGES
            .iter()
            .zip(self.acted_s)
            .filter(|(_, when)| when.is_some_and(|when| self.now_s < when + STAY_S))
            .map(|((_, key), _)| words.get(key))
            .collect();
        let is_acting = !acting.is_empty();
        Some(FeltPanel {
            title: words.fill("felt_title", "device", &self.device),
            rows: rows.map(|(key, value)| (words.get(key), value)).into(),
            force: Some(Gauge {
                fill: (peak.force_n / self.force_max_n).clamp(0.0, 1.0),
                text: force,
            }),
            acting: if is_acting { acting } else { vec![words.get("safety_quiet")] },
            is_acting,
        })
    }
}

/// What acts in this tick, or has acted since a tick with these counters.
fn acted(report: &ServoReport, before: &Counters) -> SafetyFlags {
    let now = &report.counters;
    let mut acted = report.flags;
    for (flag, count, last) in [
        (SafetyFlags::NOT_FINITE, now.not_finite, before.not_finite),
        (SafetyFlags::PASSIVITY, now.passivity, before.passivity),
        (SafetyFlags::SLEW, now.slew, before.slew),
        (SafetyFlags::CLAMP, now.clamp, before.clamp),
        (SafetyFlags::TOO_FAST, now.too_fast, before.too_fast),
        (SafetyFlags::LATE, now.late, before.late),
    ] {
        acted.set(flag, last < count);
    }
    acted
}
