//! Every number of the servo that is a choice, with its unit.

use super::device::DeviceSpec;
use crate::units::Seconds;

/// All settings of a servo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoSettings {
    /// Planned time between ticks [s].
    pub period_s: Seconds,
    /// How late a force acts, besides the period [s].
    pub latency_s: Seconds,
    /// No effect and no coupling is stiffer than this [N/m]; infinite: as stiff as it says.
    pub stiffness_max_n_m: f64,
    /// Cut-off of the filter on the device's velocity, which all damping uses [Hz]; infinite: none.
    pub velocity_filter_hz: f64,
    /// Device and tip.
    pub coupling: CouplingSettings,
    /// What is felt of an impact.
    pub transient: TransientSettings,
    /// Edges of the workspace and stabiliser.
    pub reach: ReachSettings,
    /// The safety chain.
    pub safety: SafetySettings,
}

impl ServoSettings {
    /// What suits a device.
    pub fn of(spec: &DeviceSpec) -> Self {
        ServoSettings {
            period_s: spec.period_s(),
            latency_s: spec.latency_s,
            velocity_filter_hz: 60.0,
            stiffness_max_n_m: stiffness_for(spec, 0.0),
            coupling: CouplingSettings {
                tracking_rad_s: if spec.quantum_m > 0.0 { 300.0 } else { f64::INFINITY },
                ..CouplingSettings::default()
            },
            transient: TransientSettings::default(),
            reach: ReachSettings::default(),
            safety: SafetySettings::of(spec),
        }
    }
}

/// Damping that the lightest grip adds [N s/m].
const LIGHT_GRIP_NS_M: f64 = 1.0;
/// How much of a stability limit is used.
const CAUTION: f64 = 0.6;
/// What dry friction above [`STICKY_N`] makes of a limit without any: three times and more in the
/// closed loop.
const STICKY: f64 = 3.0;
/// See [`STICKY`] [N].
const STICKY_N: f64 = 0.2;

/// The stiffest wall that a device renders in a loop that is late by `late_s` besides its period
/// and the device's own latency [N/m]: K < (b + B)/(T/2 + t_d) (Gil et al. 2004), with a light grip
/// for b and with caution, and at most what the device is made for.
pub fn stiffness_for(spec: &DeviceSpec, late_s: Seconds) -> f64 {
    let delay_s = 0.5 * spec.period_s() + spec.latency_s + late_s;
    let friction = if spec.friction_n >= STICKY_N { STICKY } else { 1.0 };
    let limit = CAUTION * friction * (spec.damping_ns_m + LIGHT_GRIP_NS_M) / delay_s;
    limit.min(spec.stiffness_max_n_m)
}

/// The largest damping that the observer may add [N s/m]: a part of what is stable on the bare
/// handle, v\[k+1\] = v\[k\] − (B T/m) v\[k−n\], which is B < 2 cos(n π/(2 n + 1)) m/T.
fn damping_for(spec: &DeviceSpec) -> f64 {
    let n = libm::round(spec.latency_s * spec.rate_hz);
    let limit = 2.0 * libm::cos(n * std::f64::consts::PI / (2.0 * n + 1.0));
    (0.25 * limit * spec.mass_kg * spec.rate_hz).min(spec.damping_max_ns_m).min(5.0)
}

/// The virtual coupling between device and tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CouplingSettings {
    /// Stiffness that is felt where the proxy is kept from the tip [N/m], in the device's scale.
    pub stiffness_n_m: f64,
    /// Damping of the same [N s/m].
    pub damping_ns_m: f64,
    /// How much of the lag of a cue that has struck is felt: 1 as much as a spring of this
    /// stiffness gives, 0 only the blow.
    pub recoil: f64,
    /// Rate of the spring that draws the tip after the device [rad/s]; infinite: it is where the
    /// device is.
    pub tracking_rad_s: f64,
    /// Friction of everything that is touched.
    pub friction: f64,
}

impl Default for CouplingSettings {
    fn default() -> Self {
        CouplingSettings {
            stiffness_n_m: 500.0,
            damping_ns_m: 0.0,
            recoil: 0.5,
            tracking_rad_s: 300.0,
            friction: 0.2,
        }
    }
}

/// What is felt of an impact, beyond the spring: F = −L v_n exp(−t/τ) cos(2π f t) n.
/// Kuchenbecker, Fiene, Niemeyer 2006.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransientSettings {
    /// L [N s/m].
    pub gain_ns_m: f64,
    /// τ [s].
    pub decay_s: Seconds,
    /// f of a leather tip on a ball [Hz].
    pub ball_hz: f64,
    /// f on wood, cushion or cloth [Hz].
    pub face_hz: f64,
    /// It ends after this time [s].
    pub length_s: Seconds,
    /// Another one does not begin within this time [s].
    pub refractory_s: Seconds,
}

impl Default for TransientSettings {
    fn default() -> Self {
        TransientSettings {
            gain_ns_m: 4.0,
            decay_s: 0.006,
            ball_hz: 150.0,
            face_hz: 300.0,
            length_s: 0.03,
            refractory_s: 0.02,
        }
    }
}

/// The workspace and how it is moved (paper, section 3.3.3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReachSettings {
    /// Width, height and depth of the box that is used [m].
    pub box_m: glam::DVec3,
    /// Metres of the world per metre of the device.
    pub scale: f64,
    /// Further factor along the shaft during a stroke: with it a hand at 1.5 m/s leads the tip at
    /// 8.25 m/s, which breaks with a cue ball at 11 m/s.
    pub stroke_gain: f64,
    /// How far inside of its faces the edge planes stand [m].
    pub edge_m: f64,
    /// Stiffness of the edge planes [N/m].
    pub edge_stiffness_n_m: f64,
    /// How fast the workspace turns per metre that the stylus is pushed into an edge [rad/(s m)].
    pub turn_rad_s_m: f64,
    /// The fastest turn [rad/s].
    pub turn_max_rad_s: f64,
    /// The steepest workspace [rad].
    pub elevation_max_rad: f64,
    /// Stiffness of the line that the stabiliser holds the device to [N/m].
    pub line_stiffness_n_m: f64,
    /// Time in which the tip goes back to the device after the stabiliser lets go [s].
    pub release_s: Seconds,
}

impl Default for ReachSettings {
    fn default() -> Self {
        ReachSettings {
            box_m: glam::DVec3::new(0.160, 0.120, 0.070),
            scale: 2.0,
            stroke_gain: 2.75,
            edge_m: 0.010,
            edge_stiffness_n_m: 200.0,
            turn_rad_s_m: 150.0,
            turn_max_rad_s: 1.5,
            elevation_max_rad: 60.0 * std::f64::consts::PI / 180.0,
            line_stiffness_n_m: 300.0,
            release_s: 0.1,
        }
    }
}

/// The safety chain; each stage can be left out by the value named.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafetySettings {
    /// A world older than this fades out [s]; infinite: never.
    pub stale_s: Seconds,
    /// Time of that fade, and of the cross-fade between effects [s]; 0: at once.
    pub fade_s: Seconds,
    /// Largest damping of the passivity controller [N s/m]; 0: none.
    pub passivity_damping_ns_m: f64,
    /// A loop that swings more than this although that damping acts is softened [m]; infinite:
    /// never.
    pub soften_swing_m: f64,
    /// Fastest change of the force [N/s]; infinite: none. A transient is exempt.
    pub slew_n_s: f64,
    /// Root mean square that the motors bear [N]; infinite: none.
    pub thermal_n: f64,
    /// Time constant of the motors' heat [s].
    pub thermal_s: Seconds,
    /// Largest force [N]; infinite: none.
    pub force_max_n: f64,
    /// A device faster than this for [`SafetySettings::too_fast_ticks`] goes off [m/s]; infinite:
    /// none.
    pub speed_max_m_s: f64,
    /// See above.
    pub too_fast_ticks: u32,
    /// Time in which the force comes back after it was off [s]; 0: at once.
    pub recover_s: Seconds,
    /// Time in which the force rises after a start [s]; 0: at once.
    pub start_s: Seconds,
    /// The rise begins once less than this is wanted [N]; infinite: at once.
    pub start_below_n: f64,
    /// A tick is late if it takes longer than this many periods; infinite: never.
    pub late_periods: f64,
    /// So many late ticks in a row halve the stiffness.
    pub late_ticks: u32,
    /// After this many ticks in time the stiffness is doubled again.
    pub punctual_ticks: u32,
    /// A stall of this length switches the force off [s]; infinite: never.
    pub stall_s: Seconds,
}

impl SafetySettings {
    /// Every stage is left out, but for numbers that are none, a lost device and the dead man's
    /// switch.
    pub const OFF: SafetySettings = SafetySettings {
        stale_s: f64::INFINITY,
        fade_s: 0.0,
        passivity_damping_ns_m: 0.0,
        soften_swing_m: f64::INFINITY,
        slew_n_s: f64::INFINITY,
        thermal_n: f64::INFINITY,
        thermal_s: 20.0,
        force_max_n: f64::INFINITY,
        speed_max_m_s: f64::INFINITY,
        too_fast_ticks: 3,
        recover_s: 0.0,
        start_s: 0.0,
        start_below_n: f64::INFINITY,
        late_periods: f64::INFINITY,
        late_ticks: 3,
        punctual_ticks: 1000,
        stall_s: f64::INFINITY,
    };

    /// What protects a device and a hand.
    pub fn of(spec: &DeviceSpec) -> Self {
        SafetySettings {
            stale_s: 0.020,
            fade_s: 0.050,
            passivity_damping_ns_m: damping_for(spec),
            soften_swing_m: 1e-4,
            slew_n_s: 2000.0,
            thermal_n: spec.force_continuous_n,
            thermal_s: 20.0,
            force_max_n: spec.force_max_n,
            speed_max_m_s: 2.0,
            too_fast_ticks: 3,
            recover_s: 0.5,
            start_s: 0.5,
            start_below_n: 0.2,
            late_periods: 1.5,
            late_ticks: 3,
            punctual_ticks: 1000,
            stall_s: 0.020,
        }
    }
}
