//! The safety chain: everything between the laws and the motors, in one order.
//!
//! | | stage | acts |
//! |---|---|---|
//! | 1 | [`finite`] | a number that is none becomes no force |
//! | 2 | [`stale`] | a world older than 20 ms fades out in 50 ms |
//! | 3 | [`cross_fade`] | other effects come in over 50 ms |
//! | 4 | [`passivity`] | energy out of nowhere is damped, a loop that swings on is softened |
//! | 5 | [`slew`] | 2 N/ms, transients exempt |
//! | 6 | [`thermal`] | 0.88 N root mean square |
//! | 7 | [`clamp`] | 3.3 N, direction kept; the only place that knows it |
//! | 8 | [`too_fast`] | a device that runs away is let go |
//! | 9 | [`ramp`] | after a start and after every interruption it rises slowly |
//! | 10 | [`deadlines`] | late ticks halve the stiffness, a stall switches off |
//! | 11 | [`connection`] | no force on a device that is not ready, or without a living hand |
//!
//! Numbers are those of an Omni.

mod finite;

mod stale;

mod cross_fade;

mod passivity;

mod slew;

mod thermal;

mod clamp;

mod too_fast;

mod ramp;

mod deadlines;

mod connection;

mod late;

use super::device::{DeviceState, Force};
use super::effect_force::Hand;
use super::report::{Counters, SafetyFlags, ServoReport};
use super::scene::HapticScene;
use super::settings::{SafetySettings, ServoSettings};
use glam::DVec3;

/// What the world does to the hand, in the device frame.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Felt {
    /// Springs of what is touched [N].
    pub contact: DVec3,
    /// Transients of impacts [N].
    pub sharp: DVec3,
}

/// The state of all stages.
#[derive(Debug, Clone)]
pub(super) struct Safety {
    stale: stale::Stale,
    cross_fade: cross_fade::CrossFade,
    passivity: passivity::Passivity,
    slew: slew::Slew,
    thermal: thermal::Thermal,
    too_fast: too_fast::TooFast,
    ramp: ramp::Ramp,
    deadlines: deadlines::Deadlines,
    sent: late::Sent,
    generation: Option<u32>,
}

impl Safety {
    pub fn new(settings: &ServoSettings) -> Self {
        Safety {
            stale: stale::Stale::new(),
            cross_fade: cross_fade::CrossFade::new(),
            passivity: passivity::Passivity::new(),
            slew: slew::Slew::default(),
            thermal: thermal::Thermal::default(),
            too_fast: too_fast::TooFast::default(),
            ramp: ramp::Ramp::new(settings.safety.start_s),
            deadlines: deadlines::Deadlines::new(),
            sent: late::Sent::new(settings.latency_s, settings.period_s),
            generation: None,
        }
    }

    /// The force that may be sent, `hand.dt` after the last one. The device has been found to say
    /// numbers.
    pub fn pass(
        &mut self,
        felt: Felt,
        hand: &Hand,
        device: &DeviceState,
        scene: &HapticScene,
        settings: &ServoSettings,
        report: &mut ServoReport,
    ) -> Force {
        let (safety, dt) = (&settings.safety, hand.dt);
        let stiffness = self.passivity.factor() * self.deadlines.factor();
        let mut flags = SafetyFlags::default();

        // 1 to 3: numbers, the age of the world, old and new effects.
        let (contact, is_contact_finite) = finite::checked(felt.contact);
        let (mut sharp, is_sharp_finite) = finite::checked(felt.sharp);
        let age_gain = self.stale.gain(scene.serial, dt, safety.stale_s, safety.fade_s);
        let effects = self.cross_fade.force(&scene.effects, hand, safety.fade_s);
        let is_finite = is_contact_finite && is_sharp_finite && !effects.is_broken;
        let mut force = (contact + effects.force - effects.sharp) * (stiffness * age_gain);
        sharp = (sharp + effects.sharp) * age_gain;
        let wanted = force + sharp;
        flags.set(SafetyFlags::NOT_FINITE, !is_finite);
        flags.set(SafetyFlags::STALE, age_gain < 1.0);
        flags.set(SafetyFlags::CROSS_FADE, effects.is_fading);

        // 4: what came out that never went in.
        if self.generation.replace(scene.effects.generation) != Some(scene.effects.generation) {
            self.passivity.reset();
        }
        let (damping_max, swing_m) = (safety.passivity_damping_ns_m, safety.soften_swing_m);
        let acting = self.sent.acting();
        let passive = self.passivity.pass(force, acting, hand.position, dt, damping_max, swing_m);
        force = passive.force;
        flags.set(SafetyFlags::PASSIVITY, passive.acts);

        // 5 to 7: how fast, how long, how much.
        let (limited, is_limited) = self.slew.limited(force, dt, safety.slew_n_s);
        let most_n = safety.force_max_n;
        let (held, is_held) = self.thermal.held_back(limited + sharp, safety.thermal_n, most_n);
        let (mut force, is_clamped) = clamp::clamped(held, most_n);
        flags.set(SafetyFlags::SLEW, is_limited);
        flags.set(SafetyFlags::THERMAL, is_held);
        flags.set(SafetyFlags::CLAMP, is_clamped);

        // 8 to 11: whether at all.
        let speed = self.too_fast.watch(
            hand.velocity.length(),
            safety.speed_max_m_s,
            safety.too_fast_ticks,
        );
        let is_too_fast = speed != too_fast::Speed::Fine;
        let is_first_too_fast = speed == too_fast::Speed::Trips;
        let gain = self.ramp.gain(wanted.length(), dt, safety.start_below_n);
        force *= gain;
        let punctuality = self.deadlines.watch(dt, settings.period_s, safety);
        let is_open = connection::is_open(device.status, scene.live);
        if is_too_fast || punctuality.is_stall || !is_open {
            force = self.switch_off(safety);
        }
        flags.set(SafetyFlags::TOO_FAST, is_too_fast);
        flags.set(SafetyFlags::RAMP, gain < 1.0);
        flags.set(SafetyFlags::LATE, punctuality.is_late);
        flags.set(SafetyFlags::DISCONNECTED, !is_open);

        self.sent.send(force);
        self.thermal.took(force, dt, safety.thermal_s);
        count(&mut report.counters, flags, is_first_too_fast, punctuality.is_stall);
        report.flags = flags;
        report.wanted = Force(wanted);
        report.force = Force(force);
        report.force_rms_n = self.thermal.rms_n();
        report.energy_j = self.passivity.energy_j();
        report.stiffness_factor = stiffness;
        Force(force)
    }

    /// The device says no numbers, or no time has passed: nothing is sent.
    pub fn refuse(&mut self, safety: &SafetySettings, report: &mut ServoReport) -> Force {
        let off = self.switch_off(safety);
        self.sent.send(off);
        report.flags = SafetyFlags::NOT_FINITE;
        report.counters.not_finite += 1;
        (report.wanted, report.force) = (Force::ZERO, Force::ZERO);
        Force::ZERO
    }

    fn switch_off(&mut self, safety: &SafetySettings) -> DVec3 {
        self.ramp.restart(safety.recover_s);
        self.slew.restart();
        DVec3::ZERO
    }
}

fn count(counters: &mut Counters, flags: SafetyFlags, is_too_fast: bool, is_stall: bool) {
    let add = |counter: &mut u64, on: bool| *counter += u64::from(on);
    add(&mut counters.not_finite, flags.has(SafetyFlags::NOT_FINITE));
    add(&mut counters.passivity, flags.has(SafetyFlags::PASSIVITY));
    add(&mut counters.slew, flags.has(SafetyFlags::SLEW));
    add(&mut counters.clamp, flags.has(SafetyFlags::CLAMP));
    add(&mut counters.late, flags.has(SafetyFlags::LATE));
    add(&mut counters.too_fast, is_too_fast);
    add(&mut counters.stalls, is_stall);
}
