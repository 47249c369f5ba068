//! What the person sees, and from where.

use super::super::camera::Viewpoint;
use super::super::{Action, AimAid, HumanMode, HumanView, View, sight};
use super::{Human, KeyStroke, Stage};
use crate::events::Turn;
use crate::ids::BallId;
use crate::physics::Snapshot;
use crate::table::Table;
use crate::tick::Participant;
use glam::DVec2;
use std::sync::Arc;

impl Human {
    /// Eyes without a hand, behind a cue ball that is about to be struck in this direction [rad],
    /// which they follow.
    pub fn onlooker(
        table: Arc<Table>,
        seen: &Snapshot,
        cue_ball: BallId,
        azimuth_rad: f64,
    ) -> Self {
        let mut eyes = Human::new(Vec::new(), table);
        eyes.turn = Some(Arc::new(Turn { cue_ball, ..Turn::default() }));
        let _ = eyes.start(seen);
        (eyes.view, eyes.only_looks) = (View::Follow, true);
        eyes.aim.azimuth_rad = azimuth_rad;
        eyes
    }

    /// What the picture shows of the player now.
    pub fn view(&self) -> HumanView {
        let mut view = HumanView {
            camera: self.camera.pose(),
            rides: self.camera.rides().map(|at| (self.cue_ball(), at)),
            aim: self.aim,
            strength_m_s: self.strength_m_s,
            is_practice: self.is_practice,
            cue_ball: self.cue_ball(),
            look: self.camera.looking(self.view),
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
            Stage::Aiming if self.pointing.is_some() => {
                (view.mode, view.pointing) = (HumanMode::Pointing, self.pointing);
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

    /// Whether the mouse, or a stick, looks round now.
    pub(super) fn looks_round(&self) -> bool {
        self.held.has(Action::Look) || self.camera.is_free() || self.only_looks
    }

    /// The straight way to what is met first, if it is wanted.
    fn show_ghost(&self, view: &mut HumanView) {
        if let Some((place, heading)) = self.ghost.filter(|_| self.ahead.aid != AimAid::None) {
            (view.ghost, view.object_heading) = (Some(place), heading);
        }
    }

    /// The camera goes where the player likes to look from, or the stage wants it.
    pub(super) fn follow_with_camera(&mut self) {
        // The cue ball lies where it is aimed at, or where it was seen last.
        let seen = match self.stage {
            Stage::Waiting | Stage::Choosing | Stage::Placing(_) => {
                sight::place_of(&self.seen, self.cue_ball())
            }
            Stage::Aiming | Stage::Stroking(_) | Stage::Struck => None,
        };
        let (ball, aim) = (seen.unwrap_or(self.centre), self.aim);
        let viewpoint = match (&self.stage, self.view) {
            (Stage::Placing(_), _) | (_, View::Bird) => Viewpoint::Bird,
            (Stage::Aiming, _) if self.pointing.is_some() => Viewpoint::Bird,
            (_, View::Round) => Viewpoint::Round { ball },
            (_, View::Follow) => Viewpoint::Follow { ball, aim },
            (_, View::Head) => Viewpoint::Beside(DVec2::NEG_X),
            (_, View::Foot) => Viewpoint::Beside(DVec2::X),
            (_, View::Side) => Viewpoint::Beside(DVec2::NEG_Y),
            (Stage::Waiting | Stage::Choosing, View::Usual) => Viewpoint::Overview,
            (Stage::Aiming | Stage::Stroking(_), View::Usual) => Viewpoint::Cue { ball, aim },
            (Stage::Struck, View::Usual) => Viewpoint::Watch { ball, aim },
        };
        self.camera.go_to(viewpoint);
    }
}
