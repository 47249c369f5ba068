//! What the person sees, and from where.

use super::super::camera::Viewpoint;
use super::super::{AimAid, HumanMode, HumanView};
use super::{Human, KeyStroke, Stage};

impl Human {
    /// What the picture shows of the player now.
    pub fn view(&self) -> HumanView {
        let mut view = HumanView {
            camera: self.camera.pose(),
            aim: self.aim,
            strength_m_s: self.strength_m_s,
            is_practice: self.is_practice,
            cue_ball: self.cue_ball(),
            look: self.camera.looking(self.is_bird),
            overlay: self.overlay,
            ways: self.ways_ahead(),
            expected_m_s: self.expected_m_s(),
            ..HumanView::default()
        };
        match &self.stage {
            Stage::Waiting | Stage::Struck => {}
            Stage::Choosing => view.mode = HumanMode::Choosing,
            Stage::Placing(placing) => {
                view.mode = HumanMode::Placing;
                view.placing = Some(placing.at);
                view.placing_ball = placing.ball;
                view.placing_allowed = placing.is_allowed(&self.seen, &self.table, self.radius_m);
            }
            Stage::Aiming if self.stylus_leads() => {
                view.mode = HumanMode::HoldingStylus;
                view.strength_m_s = if self.is_stylus_armed() { self.tip_speed_m_s() } else { 0.0 };
            }
            Stage::Aiming => {
                view.mode = HumanMode::Aiming;
                self.show_ghost(&mut view);
            }
            Stage::Stroking(tip) => {
                view.mode = HumanMode::Stroking;
                view.pulled_back_m = tip.pulled_back_m();
                let by_key = self.key_stroke.as_ref().map(KeyStroke::speed_m_s);
                view.strength_m_s = by_key.unwrap_or(tip.speed_m_s().abs());
                self.show_ghost(&mut view);
            }
        }
        if matches!(self.stage, Stage::Aiming | Stage::Stroking(_)) {
            view.call = self.call_sight().and_then(|sight| self.calling.view(&sight));
        }
        if self.paused {
            view.mode = HumanMode::Paused;
        }
        view
    }

    /// The straight way to what is met first, if it is wanted.
    fn show_ghost(&self, view: &mut HumanView) {
        if let Some((place, heading)) = self.ghost.filter(|_| self.ahead.aid != AimAid::None) {
            (view.ghost, view.object_heading) = (Some(place), heading);
        }
    }

    /// The camera goes where the stage wants it.
    pub(super) fn follow_with_camera(&mut self) {
        let behind_cue = Viewpoint::Cue { ball: self.centre, aim: self.aim };
        let viewpoint = match self.stage {
            Stage::Placing(_) => Viewpoint::Bird,
            _ if self.is_bird => Viewpoint::Bird,
            Stage::Waiting | Stage::Choosing => Viewpoint::Overview,
            Stage::Aiming | Stage::Stroking(_) => behind_cue,
            Stage::Struck => Viewpoint::Watch { ball: self.centre, aim: self.aim },
        };
        self.camera.go_to(viewpoint);
    }
}
