//! The actor itself.

use super::HAPTIC;
use super::seat::{Held, Seat};
use glam::DVec2;
use hapticbillard::ball::BallPlace;
use hapticbillard::cue::Aim;
use hapticbillard::events::Health;
use hapticbillard::haptic::{DeviceStatus, SafetyFlags, ServoReport, stiffness_for};
use hapticbillard::ids::BallId;
use hapticbillard::input::feel::ELEVATION_MAX_RAD;
use kameo::prelude::*;
use std::sync::Arc;

/// Ticks before the lateness is taken for what it will be.
const TICKS_MIN: u64 = 1000;
/// The share of wakes that a stiffness must bear.
const SHARE: f64 = 0.99;
/// A greatest stiffness that differs less is left as it is.
const CLOSE: f64 = 0.05;

/// Controls a servo while it lives.
#[derive(Actor)]
pub struct Haptic {
    held: Held,
    told: SafetyFlags,
    was_running: bool,
    /// How far the workspace was turned when it was looked at last [rad].
    turned: DVec2,
}

impl Haptic {
    /// Takes hold of a servo. None while somebody else does.
    pub fn new(seat: &Arc<Seat>) -> Option<Self> {
        let held = seat.hold()?;
        let turned = seat.signs().turned();
        Some(Haptic { held, told: SafetyFlags::default(), was_running: true, turned })
    }
}

/// Look at the servo.
pub struct Look;

/// What was seen.
#[derive(Debug, Clone, PartialEq, Reply)]
pub struct Looked {
    /// The last tick.
    pub report: ServoReport,
    /// The greatest stiffness now [N/m].
    pub stiffness_max_n_m: f64,
    /// What the player should be told, if anything.
    pub news: Vec<Health>,
}

impl Message<Look> for Haptic {
    type Reply = Looked;

    async fn handle(&mut self, _: Look, _: &mut Context<Self, Looked>) -> Looked {
        let report = self.held.report();
        self.adapt();
        self.follow(&report);
        // Where nobody holds the dead man's switch the device may be well all the same.
        let flags = match report.sample.device.status {
            DeviceStatus::Ready => report.flags.without(SafetyFlags::DISCONNECTED),
            DeviceStatus::Warm | DeviceStatus::Lost => report.flags,
        };
        let news = self.news(flags);
        Looked { report, stiffness_max_n_m: self.held.orders().stiffness_max_n_m, news }
    }
}

impl Haptic {
    /// The greatest stiffness follows the lateness.
    fn adapt(&mut self) {
        let seat = self.held.seat().clone();
        let orders = *self.held.orders();
        let stiffness_max_n_m = allowed(&seat);
        let change = (stiffness_max_n_m - orders.stiffness_max_n_m).abs();
        if change > CLOSE * orders.stiffness_max_n_m {
            self.held.order(super::Orders { stiffness_max_n_m, ..orders });
        }
    }

    /// The workspace follows the cue ball from shot to shot, and whoever turns it with the mouse;
    /// otherwise it keeps its direction.
    fn follow(&mut self, report: &ServoReport) {
        let seat = self.held.seat().clone();
        let told = seat.mail().last();
        let turned = seat.signs().turned();
        let by = turned - std::mem::replace(&mut self.turned, turned);
        let orders = *self.held.orders();
        let (Some(lay), Some(reach)) = (seat.lay(), orders.reach) else { return };
        let cue_ball = told.as_ref().and_then(|told| told.table.ball(BallId::CUE));
        let pivot = cue_ball
            .filter(|ball| ball.place == BallPlace::OnTable)
            .map_or(reach.pivot, |ball| ball.position);
        if pivot == reach.pivot && by == DVec2::ZERO {
            return;
        }
        let azimuth_rad = report.azimuth_rad + by.x;
        let elevation_rad = (report.elevation_rad + by.y).clamp(0.0, ELEVATION_MAX_RAD);
        let aim = Aim { azimuth_rad, elevation_rad, ..Aim::default() };
        let reach = lay.to(reach.serial.wrapping_add(1), pivot, &aim);
        self.held.order(super::Orders { reach: Some(reach), ..orders });
    }

    /// What is wrong and was right when looked at last; and the other way round.
    fn news(&mut self, flags: SafetyFlags) -> Vec<Health> {
        let mut news = Vec::new();
        let mut failed = |reason: &str| {
            news.push(Health::ActorFailed { actor: HAPTIC.into(), reason: reason.into() });
        };
        let (told, was_running) = (self.told, self.was_running);
        self.told = flags;
        self.was_running = self.held.seat().is_running();
        let wrong = [
            (SafetyFlags::NOT_FINITE, "the device says no numbers: no force"),
            (SafetyFlags::STALE, "the world stands still: the force fades out"),
            (SafetyFlags::DISCONNECTED, "the device is not ready: no force"),
        ];
        for (flag, reason) in wrong.iter().filter(|(flag, _)| flags.has(*flag) && !told.has(*flag))
        {
            let why = match *flag {
                SafetyFlags::DISCONNECTED => self.held.seat().why(),
                _ => None,
            };
            let reason = why.map_or(reason.to_string(), |why| format!("{reason}; {why}"));
            tracing::warn!("{HAPTIC} ({flag:?}): {reason}");
            failed(&reason);
        }
        if was_running && !self.was_running {
            let why = self.held.seat().why();
            failed(&why.unwrap_or("the servo ended; the device is without force".to_string()));
        }
        let is_fine = |flags: SafetyFlags| wrong.iter().all(|(flag, _)| !flags.has(*flag));
        if is_fine(flags) && !is_fine(told) && self.was_running {
            news.push(Health::ActorRestarted { actor: HAPTIC.into() });
        }
        news
    }
}

/// The greatest stiffness that the lateness of servo and device allows [N/m].
pub fn allowed(seat: &Seat) -> f64 {
    let timing = seat.timing();
    let late_s = match timing.ticks() {
        ticks if ticks < TICKS_MIN => 0.0,
        _ => timing.lateness.quantile(SHARE) as f64 * 1e-9,
    };
    stiffness_for(seat.spec(), late_s + seat.device_late_s())
}
