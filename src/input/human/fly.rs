//! The camera led by hand: by keys and mouse, or by the stylus.

use super::super::drive::{CameraHand, Drive};
use super::super::feel::{FLY_M_PER_S, FLY_RAD_PER_S};
use super::{Human, Stage};
use crate::haptic::Leads;
use crate::input::Action;
use glam::{DVec2, DVec3};

impl Human {
    /// What a stylus is for now.
    pub fn stylus_leads_what(&self) -> Leads {
        match self.stage {
            _ if self.paused => Leads::Pointer,
            _ if self.camera.is_free() => Leads::Camera,
            Stage::Placing(_) | Stage::Choosing => Leads::Pointer,
            Stage::Aiming if self.pointing.is_some() => Leads::Pointer,
            Stage::Waiting | Stage::Aiming | Stage::Stroking(_) | Stage::Struck => Leads::Cue,
        }
    }

    /// The eye is led by hand from now on, or goes back to the cue.
    pub(super) fn lead_camera_or_cue(&mut self) {
        if self.paused {
            return;
        }
        let leads = !self.camera.is_free();
        if leads {
            self.let_go();
        }
        self.camera.set_free(leads);
    }

    /// One tick of an eye that keys lead.
    pub(super) fn fly_by_keys(&mut self) {
        let drive = self.driven_by_keys();
        self.fly(&drive);
    }

    /// One tick of an eye that the stylus leads.
    pub(in crate::input) fn fly_by(&mut self, hand: &CameraHand) {
        let drive = hand.drive(self.steering);
        self.fly(&drive.faster(self.stylus_speed));
    }

    fn fly(&mut self, drive: &Drive) {
        if !self.paused && self.camera.is_free() {
            self.camera.drive(drive);
        }
    }

    /// Keys that move the tip, and the left stick, move the eye.
    fn driven_by_keys(&self) -> Drive {
        let held = |more, less| self.held.balance(more, less) * self.fine();
        let stick = self.sticks.left() * self.fine();
        Drive {
            velocity: FLY_M_PER_S
                * DVec3::new(
                    held(Action::TipRight, Action::TipLeft) + stick.x,
                    held(Action::Raise, Action::Lower),
                    held(Action::TipUp, Action::TipDown) + stick.y,
                ),
            turn_rad_s: FLY_RAD_PER_S * held(Action::TurnLeft, Action::TurnRight),
            rise_rad_s: 0.0,
        }
    }

    /// A stylus points here in the window, in its heights from its middle: a ball in hand is there.
    pub(super) fn pointed_at(&mut self, at: DVec2) {
        if self.camera.is_free() {
            return;
        }
        let on_bed = self.camera.pose().on_level(at, self.radius_m);
        if let (Some(at), Some(_), false) = (on_bed, self.pointing, self.paused) {
            self.point_at(at);
        }
        if let (Stage::Placing(placing), Some(at), false) = (&mut self.stage, on_bed, self.paused) {
            placing.hold_at(at, self.table.bed.as_ref(), self.radius_m);
        }
    }
}
