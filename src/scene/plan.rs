//! What a scene will start, which terms its physics has, and what was left out and why.

use super::{HapticDevice, Scene, StandIn};
use serde::Serialize;

/// One line of the plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PlanLine {
    /// What the line is about.
    pub kind: PlanKind,
    /// Name of the actor, thread or term.
    pub name: String,
    /// What it does, where it runs, or why it was left out.
    pub detail: String,
}

/// What a line of the plan is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PlanKind {
    /// An actor that will be started.
    Actor,
    /// A term of the physics that will be computed.
    Term,
    /// Something that will not exist.
    LeftOut,
}

impl Scene {
    /// What will be started, which physics terms are in the plan, what was left out and why.
    pub fn plan(&self) -> Vec<PlanLine> {
        let mut plan = Plan { lines: Vec::new() };
        self.actors_of_plan(&mut plan);
        self.sound_of_plan(&mut plan);
        self.haptic_of_plan(&mut plan);
        self.terms_of_plan(&mut plan);
        // Stable: within a kind the order of the calls stays.
        plan.lines.sort_by_key(|line| line.kind as u8);
        plan.lines
    }

    fn actors_of_plan(&self, plan: &mut Plan) {
        plan.add(PlanKind::Actor, "conductor", "owns the logical clock; a task");
        plan.add(PlanKind::Actor, "event_manager", "orders and delivers events; a task");
        let place = if self.physics.thread { "a thread of its own" } else { "a task" };
        plan.add(
            PlanKind::Actor,
            "physics",
            &format!("moves {}; {place}", counted(self.ball_count(), "ball")),
        );
        match &self.rules {
            Some(rules) => {
                let detail = format!("referees {}; a task", rules.game.id());
                plan.add(PlanKind::Actor, "rules", &detail);
            }
            None => plan.left_out("rules", "the scene has no [rules]"),
        }
        let computers = self.players.iter().filter(|player| player.kind.is_computer());
        for player in computers.clone() {
            let detail = format!("plays as \"{}\"; a task", player.name);
            plan.add(PlanKind::Actor, "ai", &detail);
        }
        if computers.count() == 0 {
            plan.left_out("ai", "no [[player]] is a computer");
        }
        let stand_in = self.actors.as_ref().and_then(|actors| actors.input.as_ref());
        match (&self.input, stand_in) {
            (Some(_), Some(StandIn::Recorded(file))) => {
                plan.add(PlanKind::Actor, "input", &format!("plays back {file}; a task"));
            }
            (Some(input), None) => {
                let detail = format!("mouse and keyboard, profile {}; a task", input.profile);
                plan.add(PlanKind::Actor, "input", &detail);
            }
            (None, _) => plan.left_out("input", "the scene has no [input]"),
        }
        match &self.renderer {
            Some(renderer) => {
                let detail = format!(
                    "a window of {} x {} pixels; the main thread",
                    renderer.width, renderer.height
                );
                plan.add(PlanKind::Actor, "renderer", &detail);
            }
            None => plan.left_out("renderer", "the scene has no [renderer]"),
        }
    }

    /// Without `[sound]` no thread exists and no audio library is asked for anything; without a
    /// window nobody listens.
    fn sound_of_plan(&self, plan: &mut Plan) {
        match &self.sound {
            Some(sound) if self.renderer.is_some() => {
                let device = sound.device.as_deref().unwrap_or("the system's default");
                let detail = format!(
                    "what happens, through {device}; a task, a thread that keeps the device, and \
                     the mixer in the audio callback"
                );
                plan.add(PlanKind::Actor, "sound", &detail);
            }
            Some(_) => plan.left_out("sound", "without [renderer] nobody listens"),
            None => plan.left_out("sound", "the scene has no [sound]"),
        }
    }

    /// Without `[haptic]` no servo, no mesh for it and no thread exist.
    fn haptic_of_plan(&self, plan: &mut Plan) {
        match &self.haptic {
            Some(haptic) => {
                let device = haptic.device.name();
                match haptic.device {
                    HapticDevice::None => plan.left_out("haptic", "[haptic] names no device"),
                    HapticDevice::Auto
                    | HapticDevice::Simulated
                    | HapticDevice::Mouse
                    | HapticDevice::Recorded(_)
                    | HapticDevice::Haply(_) => {
                        let detail = format!(
                            "what the device \"{device}\" feels, in a window; a task, and its \
                             servo on a real-time thread"
                        );
                        plan.add(PlanKind::Actor, "haptic", &detail);
                    }
                    HapticDevice::OpenHaptics(_) => {
                        let detail = format!(
                            "what the device \"{device}\" feels, in a window; a task, and its \
                             servo in the scheduler of the device's library"
                        );
                        plan.add(PlanKind::Actor, "haptic", &detail);
                    }
                }
            }
            None => plan.left_out("haptic", "the scene has no [haptic]"),
        }
    }

    fn terms_of_plan(&self, plan: &mut Plan) {
        let balls = self.ball_count();
        let term = |plan: &mut Plan, present: bool, name: &str, detail: &str, why: &str| {
            if present {
                plan.add(PlanKind::Term, name, detail);
            } else {
                plan.left_out(name, why);
            }
        };
        let gravity = format!("{} m/s² downwards", self.physics.gravity_m_s2);
        term(plan, self.physics.gravity_m_s2 > 0.0, "gravity", &gravity, "gravity_m_s2 is 0");
        let why = "flight is false";
        term(plan, self.physics.flight, "flight", "balls hop and jump", why);
        let pairs = counted(balls * balls.saturating_sub(1) / 2, "pair");
        term(plan, balls > 1, "ball-ball contact", &pairs, "fewer than two balls");
        let friction = self.physics.ball_friction && balls > 1;
        let why = if balls > 1 { "ball_friction is false" } else { "fewer than two balls" };
        term(plan, friction, "ball-ball friction", "throws the object ball", why);
        let faces = self.table.is_some() || !self.meshes.is_empty() || !self.boxes.is_empty();
        let why = "no [table], [[mesh]] or [[box]]";
        term(plan, faces, "ball-face contact", "found through a grid of cells", why);
        // A table stands on the floor of a room.
        let count = self.planes.len() + usize::from(self.table.is_some());
        let why = "no [[plane]], and no [table] with its floor";
        term(plan, count > 0, "ball-plane contact", &counted(count, "half space"), why);
        term(plan, self.table.is_some(), "pockets", "balls that fall stay down", "no [table]");
        let springs = self.ball.iter().filter(|ball| ball.spring.is_some()).count();
        let detail = format!("for {}", counted(springs, "ball"));
        term(plan, springs > 0, "springs", &detail, "no [[ball]] has a spring");
        term(plan, self.cue.is_some(), "cue contact", "tip against ball", "no [cue]");
    }

    /// How many balls the scene begins with.
    pub fn ball_count(&self) -> usize {
        let Some(balls) = &self.balls else { return self.ball.len() };
        let replaced = |id| self.ball.iter().any(|ball| ball.id == id);
        balls.rack.ids().filter(|id| !replaced(*id)).count() + self.ball.len()
    }
}

/// A number of things in words.
fn counted(count: usize, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

struct Plan {
    lines: Vec<PlanLine>,
}

impl Plan {
    fn add(&mut self, kind: PlanKind, name: &str, detail: &str) {
        self.lines.push(PlanLine { kind, name: name.to_string(), detail: detail.to_string() });
    }

    fn left_out(&mut self, name: &str, why: &str) {
        self.add(PlanKind::LeftOut, name, why);
    }
}
