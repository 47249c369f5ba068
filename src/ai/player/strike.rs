//! From the decision what to play to the end of the shot: aiming, the stroke, watching.

use super::{Player, command};
use crate::ai::choose::call;
use crate::ai::hold;
use crate::ai::insight::{insight_of_plan, insight_of_thoughts};
use crate::ai::mind::{Decision, PlannedShot, TaskKind};
use crate::ai::plan::{Goal, examined_lines, plan_shot};
use crate::ai::stroke::{Stroke, TIP_SPEED_MAX_M_S, approach, resting_pose, withdrawal};
use crate::ai::view::TableView2d;
use crate::cue::{Aim, CuePath};
use crate::events::{Call, Command, Event, PlayerState, ShotKind, Turn};
use crate::tick::{Delivered, Outcome};
use crate::units::Tick;
use glam::DVec2;
use std::sync::Arc;

/// How long after a stroke's end its contact may still be reported [ticks].
const CONTACT_TICKS: u64 = 3;
/// How often the player aims anew in one go if the stroke met nothing.
const REAIMS: u32 = 3;
/// The longest that a shot is watched [ticks]: two minutes.
const ANALYZING_TICKS: u64 = 120_000;

/// What is played, and what is announced with it.
struct Intent {
    aim: Aim,
    speed_m_s: f64,
    call: Option<Call>,
}

impl Player {
    /// Decides once and begins to lead the cue to the ball.
    pub(super) fn aim(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let view = self.look(&delivered.table);
        let Some(turn) = self.turn.clone() else {
            self.leave_table(out);
            return;
        };
        let Some(cue_ball) = view.cue_ball else {
            // It is gone, which no rule asks for: put it down again.
            self.leave_table(out);
            self.begin_turn(turn, delivered, out);
            return;
        };

        self.plan = None;
        let intent = match self.decided(|kind| kind == TaskKind::Shoot) {
            Some(Decision::Shoot(shot)) => {
                let PlannedShot { aim, speed_m_s, call, .. } = *shot;
                Intent { aim, speed_m_s, call }
            }
            _ => self.intent_from_above(&turn, &view, cue_ball),
        };
        let stroke = self.stroke_for(&intent, cue_ball);
        if let Some(plan) = &mut self.plan {
            plan.speed_m_s = stroke.speed_m_s;
        }
        self.tell(&turn, &view, cue_ball, out);
        // It is heard long before the tip has come to the ball.
        if let Some(call) = intent.call {
            command(Command::Call(call), out);
        }
        self.has_asked = false;
        let from = delivered.table.cue.unwrap_or_else(|| resting_pose(self.id, &self.bed));
        let path = approach(&from, &stroke, delivered.tick.end_s());
        self.stroke = Some(stroke);
        self.due = path.end_s().map(Tick::containing);
        self.report(PlayerState::Aiming, out);
        move_cue(path, out);
    }

    /// Tells whoever watches what it had in mind.
    fn tell(&self, turn: &Turn, view: &TableView2d, cue_ball: DVec2, out: &mut Outcome) {
        let searched = || {
            let thoughts = &self.search.as_ref()?.deliberation()?.thoughts;
            let ways = match turn.shot {
                // The rack stands in its own way.
                ShotKind::Break => Vec::new(),
                _ => {
                    let goal = Goal::of(turn, view, self.played_from);
                    examined_lines(view, cue_ball, &goal.own, None)
                }
            };
            Some(insight_of_thoughts(self.id, cue_ball, thoughts, &ways))
        };
        let insight = match &self.plan {
            Some(plan) => Some(insight_of_plan(self.id, plan)),
            None => searched(),
        };
        out.publish.extend(insight.map(|insight| Event::Insight(Arc::new(insight)).into()));
    }

    /// What the paper's player would play: through the middle of the cue ball, the cue held over
    /// rails and balls.
    fn intent_from_above(&mut self, turn: &Turn, view: &TableView2d, cue_ball: DVec2) -> Intent {
        let goal = Goal::of(turn, view, self.played_from);
        let plan = plan_shot(view, cue_ball, &goal, self.settings.throw_factor, &mut self.rng);
        let mut aim = Aim::along(plan.direction);
        let over_rail = (self.clearance)(cue_ball, aim.azimuth_rad);
        // It has thought of no other shot.
        aim.elevation_rad =
            hold::elevation(view, cue_ball, &aim, over_rail).unwrap_or(hold::ELEVATION_MAX_RAD);
        let speed_m_s = hold::tip_speed(plan.speed_m_s, aim.elevation_rad);
        let call = call(&plan, turn.calls);
        self.plan = Some(plan);
        Intent { aim, speed_m_s, call }
    }

    /// Errs as much as the settings ask for, and is never faster than a person.
    fn stroke_for(&mut self, intent: &Intent, cue_ball: DVec2) -> Stroke {
        let (noise, radius_m) = (self.settings.stroke_noise(), self.ball_radius_m);
        let (aim, speed_m_s) = noise.err(intent.aim, intent.speed_m_s, radius_m, &mut self.rng);
        let centre = cue_ball.extend(radius_m);
        Stroke::at_ball(aim.limited(), centre, radius_m, speed_m_s.min(TIP_SPEED_MAX_M_S))
    }

    pub(super) fn shoot(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let Some(stroke) = self.stroke else {
            self.leave_table(out);
            return;
        };
        let path = stroke.path(delivered.tick.end_s());
        self.due = path.end_s().map(|end_s| Tick::containing(end_s).after(CONTACT_TICKS));
        self.report(PlayerState::Shooting, out);
        move_cue(path, out);
    }

    /// The stroke met nothing: aims anew, and after a few times collects itself first.
    pub(super) fn missed(&mut self, delivered: &Delivered, out: &mut Outcome) {
        if self.reaims < REAIMS {
            self.reaims += 1;
            self.aim(delivered, out);
        } else {
            command(Command::LiftCue, out);
            self.report(PlayerState::Idle, out);
            self.laze(delivered, out);
        }
    }

    /// The ball is on its way: takes the cue back before it can touch it again.
    pub(super) fn withdraw(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let from = delivered.table.cue.or_else(|| self.stroke.map(|stroke| stroke.address()));
        if let Some(from) = from {
            move_cue(withdrawal(&from, delivered.tick.end_s()), out);
        }
        self.due = Some(delivered.tick.after(ANALYZING_TICKS));
        self.report(PlayerState::Analyzing, out);
    }

    /// The shot is over.
    pub(super) fn finish(&mut self, now: Tick, out: &mut Outcome) {
        command(Command::LiftCue, out);
        self.due = Some(now.after(1));
        self.report(PlayerState::Done, out);
    }
}

fn move_cue(path: CuePath, out: &mut Outcome) {
    command(Command::MoveCue(Arc::new(path)), out);
}
