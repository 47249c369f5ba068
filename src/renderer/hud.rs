//! The head-up display: what is written over the picture, as text and numbers without places.

use super::felt::FeltTool;
use super::menu_panel::MenuPanel;
use super::meters::MetersPanel;
use super::overlay::FeltPanel;
use super::scoreboard::Scoreboard;
use super::thoughts::ThoughtsPanel;
use super::wheel_panel::WheelPanel;
use super::words::Words;
use crate::cue::OFFSET_LIMIT;
use crate::events::{BallInHand, Group, PlayerState, ShotKind};
use crate::ids::{BallId, PlayerId};
use crate::input::{HumanMode, HumanView, Tutor};
use crate::rules::Texts;

/// The speed at which the gauge of strength is full [m/s]: a hard break.
const FULL_SPEED_M_S: f64 = 10.0;

/// What one player's panel shows.
#[derive(Debug, Clone, PartialEq)]
pub struct SeatPanel {
    /// The name.
    pub name: String,
    /// What is played: a group, the 8, or that the table is open; empty in games without groups.
    pub plays: String,
    /// The balls still to be pocketed.
    pub remaining: Remaining,
    /// Points, where the game has them.
    pub score: Option<i32>,
    /// It is this player's turn.
    pub is_at_table: bool,
}

/// The balls a player still has to pocket.
#[derive(Debug, Clone, PartialEq)]
pub enum Remaining {
    /// Nobody has a group.
    Open,
    /// These.
    Balls(Vec<BallId>),
}

/// Where the tip meets the cue ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipDial {
    /// Right of the middle, in ball radii.
    pub side: f64,
    /// Above the middle, in ball radii.
    pub height: f64,
    /// The largest offset, in ball radii.
    pub limit: f64,
}

/// A bar between empty and full.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// From 0 to 1.
    pub fill: f64,
    /// What is written beside it.
    pub text: String,
}

/// Everything that is written over the picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hud {
    /// One panel per player.
    pub seats: Vec<SeatPanel>,
    /// What happened or is to be done, most important first; whole sentences.
    pub message: Vec<String>,
    /// The message tells of a foul.
    pub is_foul: bool,
    /// What is announced for the shot.
    pub call: Option<String>,
    /// What the player must choose from, a line each; the numbers are the keys.
    pub options: Vec<String>,
    /// What the player can do now.
    pub hint: String,
    /// Where the tip meets the cue ball, while aiming.
    pub tip: Option<TipDial>,
    /// How far the butt is raised, while aiming.
    pub elevation: Option<String>,
    /// Speed of the tip, while stroking and after a stroke.
    pub strength: Option<Gauge>,
    /// In large letters in the middle, with a hint under it: pause, or who won.
    pub banner: Option<(String, String)>,
    /// The table of controls, with its title.
    pub help: Option<(String, Vec<(String, String)>)>,
    /// The lesson of a tutorial: its title and what to do.
    pub lesson: Option<(String, String)>,
    /// How to get help; empty while it is shown.
    pub help_hint: String,
    /// What the haptic device does.
    pub felt: Option<FeltPanel>,
    /// What a computer player thought.
    pub thoughts: Option<ThoughtsPanel>,
    /// What is measured of the runtime.
    pub meters: Option<MetersPanel>,
    /// The menu over everything else.
    pub menu: Option<MenuPanel>,
    /// The wheel menu.
    pub wheel: Option<WheelPanel>,
    /// Where a stylus points [pixels], where that is of use.
    pub pointer: Option<[f64; 2]>,
}

impl Hud {
    /// What stands in the window, given the state of the game and what the player does.
    pub fn new(board: &Scoreboard, view: &HumanView, texts: &Texts, words: &Words) -> Self {
        let mut hud =
            Hud { seats: seats(board, words), help_hint: words.get("help_hint"), ..Hud::default() };
        if let Some(verdict) = &board.verdict {
            hud.message.push(texts.verdict(verdict));
            hud.is_foul = !verdict.fouls.is_empty();
            if hud.is_foul {
                // Why, in a sentence per foul.
                hud.message.extend(texts.why(verdict).into_iter().take(verdict.fouls.len()));
            }
        } else if let Some(turn) = board.turn.as_ref().filter(|_| !board.is_rolling) {
            let mut told = (**turn).clone();
            if matches!(
                view.mode,
                HumanMode::Aiming
                    | HumanMode::Pointing
                    | HumanMode::HoldingStylus
                    | HumanMode::Stroking
            ) {
                // The ball that was in hand lies on the table.
                told.ball_in_hand = BallInHand::None;
            }
            if turn.on_table.is_empty() {
                // Without object balls there is nothing to break.
                told.shot = ShotKind::Normal;
            }
            hud.message.push(texts.turn(&told));
        }
        if board.is_unrecorded {
            hud.message.push(words.get("not_recorded"));
        }
        if let Some(reason) = &board.unfelt {
            hud.message.push(words.fill("haptic", "reason", reason));
        }
        if let Some(reason) = &board.unheard {
            hud.message.push(words.fill("no_sound", "reason", reason));
        }
        if board.is_without_stylus {
            hud.message.push(words.get("stylus_gone"));
        }
        hud.message.extend(board.refused.iter().map(|refused| {
            words
                .fill("refused", "asked", &refused.asked)
                .replace("{reason}", &refused.reason)
                .replace("{remedy}", &refused.remedy)
        }));
        let call = match view.mode {
            HumanMode::Aiming
            | HumanMode::Pointing
            | HumanMode::HoldingStylus
            | HumanMode::Stroking => view.call.as_ref().map(|view| &view.call),
            _ => board.call.as_ref(),
        };
        hud.call = call.filter(|_| board.over.is_none()).map(|call| texts.call(call));
        if let (HumanMode::Choosing, Some(turn)) = (view.mode, &board.turn) {
            let lines = turn.options.iter().enumerate();
            hud.options =
                lines.map(|(i, choice)| format!("{}   {}", i + 1, texts.choice(*choice))).collect();
        }
        hud.hint = hint(board, view, words);
        if matches!(view.mode, HumanMode::Aiming | HumanMode::Stroking) {
            hud.tip = Some(TipDial {
                side: view.aim.side_offset,
                height: view.aim.height_offset,
                limit: OFFSET_LIMIT,
            });
            let degrees = format!("{:.0}", view.aim.elevation_rad.to_degrees());
            hud.elevation = Some(words.fill("elevation", "degrees", &degrees));
        }
        let strokes = matches!(view.mode, HumanMode::Stroking | HumanMode::HoldingStylus);
        let gauge = |m_s: f64| Gauge {
            fill: (m_s / FULL_SPEED_M_S).clamp(0.0, 1.0),
            text: words.fill("speed", "speed", &format!("{m_s:.1}")),
        };
        if strokes || (board.is_rolling && view.strength_m_s > 0.0) {
            hud.strength = Some(gauge(view.strength_m_s));
        } else if !view.ways.is_empty() {
            // The ways are those of a stroke as hard as this.
            hud.strength = Some(gauge(view.expected_m_s));
        }
        hud.banner = banner(board, view, words);
        hud
    }
}

impl Hud {
    /// What stands over a film of the last shot that is so far, of so many seconds, at this rate.
    pub fn of_film(
        board: &Scoreboard,
        (at_s, whole_s): (f64, f64),
        rate: f64,
        words: &Words,
    ) -> Self {
        let text = words.fill("film_place", "at", &format!("{at_s:.1}"));
        let text = text.replace("{whole}", &format!("{whole_s:.1}"));
        let fill = if 0.0 < whole_s { (at_s / whole_s).clamp(0.0, 1.0) } else { 1.0 };
        Hud {
            seats: seats(board, words),
            message: vec![words.fill("film", "rate", &rate.to_string())],
            hint: words.get("film_hint"),
            strength: Some(Gauge { fill, text }),
            ..Hud::default()
        }
    }

    /// The same while somebody shows how to play.
    #[must_use]
    pub fn with_lesson(
        mut self,
        tutor: &Tutor,
        view: &HumanView,
        is_by_pad: bool,
        words: &Words,
    ) -> Self {
        let (at, of) = tutor.count();
        let title = words.fill("tutor", "at", &at.to_string()).replace("{of}", &of.to_string());
        let name = tutor.lesson().name();
        let text = match is_by_pad {
            true => words.get(&format!("{name}_pad")),
            false => words.get(name),
        };
        // It says what to do; only where there is something else to be done now, that stays.
        if matches!(view.mode, HumanMode::Aiming | HumanMode::Watching) {
            self.hint = String::new();
        }
        Hud { lesson: Some((title, text)), ..self }
    }

    /// The same with the panel of a haptic device, and with other words where a mouse moves the
    /// hand that holds this tool.
    #[must_use]
    pub fn with_felt(
        self,
        felt: Option<FeltPanel>,
        by_mouse: Option<FeltTool>,
        view: &HumanView,
        words: &Words,
    ) -> Self {
        let Some(tool) = by_mouse else { return Hud { felt, ..self } };
        let hint = match (tool, view.mode) {
            (_, HumanMode::Paused | HumanMode::Placing | HumanMode::Pointing) => self.hint,
            (FeltTool::Stylus, _) => words.get("felt_touch"),
            (FeltTool::Cue, HumanMode::Stroking) => words.get("felt_stroke"),
            (FeltTool::Cue, HumanMode::Aiming) => words.get("felt_aim"),
            // Away from the ball one finds back like this; while balls roll there is nothing to do.
            (FeltTool::Cue, _) if self.hint.is_empty() => words.get("felt_aim"),
            (FeltTool::Cue, _) => self.hint,
        };
        Hud { felt, hint, ..self }
    }

    /// The same for somebody who holds a gamepad.
    #[must_use]
    pub fn for_pad(self, view: &HumanView, words: &Words) -> Self {
        let hint = match view.mode {
            HumanMode::Choosing => words.get("choose_pad"),
            HumanMode::Placing if view.placing_allowed => words.get("in_hand_pad"),
            HumanMode::Aiming => words.get("aim_pad"),
            HumanMode::Stroking => words.get("stroke_pad"),
            _ => self.hint,
        };
        Hud { hint, help_hint: words.get("help_hint_pad"), ..self }
    }
}

fn seats(board: &Scoreboard, words: &Words) -> Vec<SeatPanel> {
    let players = [PlayerId::ONE, PlayerId::TWO].into_iter().take(board.names.len());
    players
        .map(|player| {
            let remaining = board.remaining(player);
            let plays = match (&board.groups, board.group(player), &remaining) {
                (None, ..) => String::new(),
                (Some(_), Some(_), Some(balls)) if balls.as_slice() == [BallId::EIGHT] => {
                    words.get("eight")
                }
                (Some(_), Some(Group::Solids), _) => words.get("solids"),
                (Some(_), Some(Group::Stripes), _) => words.get("stripes"),
                (Some(_), None, _) => words.get("open"),
            };
            SeatPanel {
                name: board.name(player).to_string(),
                plays,
                remaining: remaining.map_or(Remaining::Open, Remaining::Balls),
                score: board.turn.as_ref().and_then(|turn| Some(turn.score?.of(player))),
                is_at_table: board.over.is_none()
                    && board.turn.as_ref().is_some_and(|turn| turn.player == player),
            }
        })
        .collect()
}

fn hint(board: &Scoreboard, view: &HumanView, words: &Words) -> String {
    if board.over.is_some() {
        return String::new();
    }
    if view.look.free && view.mode != HumanMode::Paused {
        return words.get("free_camera");
    }
    match view.mode {
        HumanMode::Choosing => words.get("choose"),
        HumanMode::Placing if view.placing_allowed && view.is_practice => {
            words.get("training_in_hand")
        }
        HumanMode::Placing if view.placing_allowed => words.get("in_hand"),
        HumanMode::Placing => words.get("not_there"),
        HumanMode::Aiming if view.is_practice => words.get("training"),
        HumanMode::Aiming => words.get("aim"),
        HumanMode::Pointing => words.get("pointing"),
        HumanMode::HoldingStylus => words.get("stylus"),
        HumanMode::Stroking => words.get("stroke"),
        HumanMode::Paused => String::new(),
        HumanMode::Watching if board.is_rolling => words.get("rolling"),
        HumanMode::Watching => {
            let Some(turn) = &board.turn else { return String::new() };
            let key = match board.states[turn.player.index()] {
                PlayerState::Lazing if !turn.options.is_empty() => "choosing",
                PlayerState::Lazing => "thinking",
                PlayerState::Aiming => "aiming",
                PlayerState::Shooting => "shooting",
                PlayerState::Idle | PlayerState::Analyzing | PlayerState::Done => {
                    return String::new();
                }
            };
            words.fill(key, "player", board.name(turn.player))
        }
    }
}

fn banner(board: &Scoreboard, view: &HumanView, words: &Words) -> Option<(String, String)> {
    match (board.over, view.mode) {
        (Some(Some(winner)), _) => {
            let title = words.fill("wins", "player", board.name(winner));
            Some((title, words.get("over_hint")))
        }
        (Some(None), _) => Some((words.get("draw"), words.get("over_hint"))),
        (None, HumanMode::Paused) => Some((words.get("paused"), words.get("paused_hint"))),
        (None, _) => None,
    }
}
