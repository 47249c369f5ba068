//! A player's thoughts over the picture (paper, figure 5.2): which ways are free, which are
//! blocked, and what each shot that was considered promises.
//!
//! Free ways are whole lines, blocked ones dashed: colours alone would not do. They are Okabe and
//! Ito's (2008), which colour-blind eyes can tell, and stand out from green cloth.

use super::draw_list::{DrawList, GhostBall, Label, Line, Radii};
use super::words::Words;
use crate::events::{IdeaKind, Insight, Prospect, Way, WayEnd};
use crate::ids::{BallId, PocketId};
use crate::rules::Texts;
use glam::DVec2;

/// A free way.
const FREE: [f32; 3] = [0.42, 0.78, 0.98];
/// A blocked way.
const BLOCKED: [f32; 3] = [0.96, 0.42, 0.10];
/// What is played.
const CHOSEN: [f32; 3] = [1.0, 0.92, 0.30];

/// How far the lines float above the cloth [m]: above all lines of aim.
const LIFT_M: f64 = 0.0021;
/// Half the width of a line [m]: of a way, and of the way that is played.
const HALF_WIDTH_M: [f32; 2] = [0.0022, 0.0042];
/// A dash, and the gap behind it [m].
const DASH_M: [f64; 2] = [0.030, 0.028];
/// How far along its way the label of a shot stands before its ball [m].
const LABEL_M: f64 = 0.19;
/// A label stands no farther than so much of its way.
const LABEL_SHARE: f64 = 0.6;
/// Shots that are written down beside the picture, at most.
const ROWS: usize = 7;
/// Shots that promise less are not labelled on the table.
const LEAST_CHANCE: f64 = 0.005;

/// What is written beside the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct ThoughtsPanel {
    /// Whose thoughts.
    pub title: String,
    /// What the lines mean.
    pub legend: Vec<LegendRow>,
    /// Names of the columns of [`Self::rows`] behind the first; empty if nothing was estimated.
    pub head: Vec<String>,
    /// The shots that were considered, best first.
    pub rows: Vec<ThoughtRow>,
}

/// What a line means.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendRow {
    /// Red, green, blue in sRGB.
    pub colour: [f32; 3],
    /// The line has gaps.
    pub is_dashed: bool,
    /// What it means.
    pub text: String,
}

/// A shot in a row of text.
#[derive(Debug, Clone, PartialEq)]
pub struct ThoughtRow {
    /// What it is.
    pub text: String,
    /// What was estimated, under [`ThoughtsPanel::head`].
    pub values: Vec<String>,
    /// It is played.
    pub is_chosen: bool,
}

/// Draws the thoughts over the table.
pub fn draw_thoughts(insight: &Insight, radii: &Radii, list: &mut DrawList) {
    // What is blocked lies below what is free, and that below what is played.
    let mut ways: Vec<&Way> = insight.ways.iter().filter(|way| !way.is_chosen).collect();
    ways.sort_by_key(|way| way.is_free);
    for way in ways {
        let is_within_reach = !matches!(way.leads_to, WayEnd::Pocket(ball, _)
            if !is_reached(insight, ball));
        draw_way(way, is_within_reach, list);
    }
    let shown = best_of_each(insight);
    for prospect in shown.iter().filter(|prospect| !prospect.is_chosen) {
        let opacity = 0.25 + 0.5 * prospect.chance.unwrap_or(0.0) as f32;
        prospect.ways.iter().for_each(|way| solid(way, FREE, opacity, HALF_WIDTH_M[0], list));
    }
    if let Some(chosen) = insight.chosen() {
        draw_chosen(insight, chosen, radii, list);
    }
    list.labels.extend(shown.iter().filter_map(|prospect| label(prospect, radii)));
}

/// Whether the cue ball's way to this ball is free, if it was examined.
fn is_reached(insight: &Insight, ball: BallId) -> bool {
    let mut ways = insight.ways.iter().filter(|way| way.leads_to == WayEnd::Ball(ball)).peekable();
    ways.peek().is_none() || ways.any(|way| way.is_free)
}

/// The best of the shots that do the same, the chosen one before all.
fn best_of_each(insight: &Insight) -> Vec<&Prospect> {
    let mut all: Vec<&Prospect> = insight.prospects.iter().collect();
    let worth = |prospect: &Prospect| prospect.value.or(prospect.chance).unwrap_or(0.0);
    all.sort_by(|a, b| b.is_chosen.cmp(&a.is_chosen).then_with(|| worth(b).total_cmp(&worth(a))));
    let mut best: Vec<&Prospect> = Vec::new();
    for prospect in all {
        let aim = |other: &Prospect| (other.kind, other.ball, other.pocket);
        if !best.iter().any(|other| aim(other) == aim(prospect)) {
            best.push(prospect);
        }
    }
    best
}

fn draw_way(way: &Way, is_within_reach: bool, list: &mut DrawList) {
    match (way.is_free, is_within_reach) {
        (true, true) => solid(way, FREE, 0.7, HALF_WIDTH_M[0], list),
        // Nobody can use it now.
        (true, false) => solid(way, FREE, 0.22, HALF_WIDTH_M[0], list),
        (false, true) => dashed(way, BLOCKED, 0.8, list),
        (false, false) => dashed(way, BLOCKED, 0.4, list),
    }
}

fn draw_chosen(insight: &Insight, chosen: &Prospect, radii: &Radii, list: &mut DrawList) {
    for way in &chosen.ways {
        solid(way, CHOSEN, 0.95, HALF_WIDTH_M[1], list);
    }
    let cue_ways = chosen.ways.iter().any(|way| matches!(way.leads_to, WayEnd::Ball(_)));
    if !cue_ways {
        piece(insight.cue_ball, chosen.ghost, CHOSEN, 0.95, HALF_WIDTH_M[1], list);
    }
    let radius_m = radii.of(BallId::CUE);
    let [r, g, b] = CHOSEN;
    list.ghosts.push(GhostBall {
        position: chosen.ghost.extend(radius_m).as_vec3().to_array(),
        radius_m: radius_m as f32,
        colour: [r, g, b, 0.45],
    });
}

fn solid(way: &Way, colour: [f32; 3], opacity: f32, half_width_m: f32, list: &mut DrawList) {
    piece(way.from, way.to, colour, opacity, half_width_m, list);
}

fn dashed(way: &Way, colour: [f32; 3], opacity: f32, list: &mut DrawList) {
    let length = way.from.distance(way.to);
    let along = (way.to - way.from).normalize_or_zero();
    let [dash, gap] = DASH_M;
    let count = (length / (dash + gap)).ceil() as u32;
    for k in 0..count {
        let begin = f64::from(k) * (dash + gap);
        let end = (begin + dash).min(length);
        let (from, to) = (way.from + along * begin, way.from + along * end);
        piece(from, to, colour, opacity, HALF_WIDTH_M[0], list);
    }
}

fn piece(
    from: DVec2,
    to: DVec2,
    [r, g, b]: [f32; 3],
    opacity: f32,
    half_width_m: f32,
    list: &mut DrawList,
) {
    list.lines.push(Line {
        from: from.extend(LIFT_M).as_vec3().to_array(),
        to: to.extend(LIFT_M).as_vec3().to_array(),
        half_width_m,
        colour: [r, g, b, opacity],
    });
}

/// The chance of a shot, on the way of the ball that shall fall; that of a shot that is meant to
/// pocket nothing is told beside the picture.
fn label(prospect: &Prospect, radii: &Radii) -> Option<Label> {
    let chance = prospect.chance.filter(|chance| LEAST_CHANCE <= *chance || prospect.is_chosen)?;
    prospect.pot()?;
    let way = prospect.ways.iter().find(|way| matches!(way.leads_to, WayEnd::Pocket(..)))?;
    let length = way.from.distance(way.to);
    let along = (way.to - way.from).normalize_or_zero();
    let at = way.from + along * LABEL_M.min(LABEL_SHARE * length);
    Some(Label {
        at: at.extend(radii.of(BallId::CUE)).as_vec3().to_array(),
        text: percent(chance),
        colour: if prospect.is_chosen { CHOSEN } else { FREE },
        is_bold: prospect.is_chosen,
    })
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

impl ThoughtsPanel {
    /// What is written beside the thoughts of the player of this name.
    pub fn new(insight: &Insight, name: &str, texts: &Texts, words: &Words) -> Self {
        let row =
            |colour, is_dashed, key: &str| LegendRow { colour, is_dashed, text: words.get(key) };
        let mut legend = Vec::new();
        if insight.ways.iter().any(|way| way.is_free && !way.is_chosen) {
            legend.push(row(FREE, false, "thoughts_free"));
        }
        if insight.ways.iter().any(|way| !way.is_free) {
            legend.push(row(BLOCKED, true, "thoughts_blocked"));
        }
        if insight.chosen().is_some() {
            legend.push(row(CHOSEN, false, "thoughts_chosen"));
        }
        let shown = best_of_each(insight);
        let is_estimated = shown.iter().any(|prospect| prospect.chance.is_some());
        let head = if is_estimated { vec!["thoughts_chance", "thoughts_value"] } else { vec![] };
        let values = |prospect: &Prospect| {
            let value = prospect.value.map(|value| format!("{value:.2}"));
            let values = [prospect.chance.map(percent), value];
            values.map(|value| value.unwrap_or_else(|| String::from("–"))).to_vec()
        };
        let rows = shown.iter().take(ROWS).map(|prospect| ThoughtRow {
            text: describe(prospect, texts, words),
            values: if is_estimated { values(prospect) } else { Vec::new() },
            is_chosen: prospect.is_chosen,
        });
        ThoughtsPanel {
            title: words.fill("thoughts_title", "player", name),
            legend,
            head: head.into_iter().map(|key| words.get(key)).collect(),
            rows: rows.collect(),
        }
    }
}

/// A shot in words, such as "3: at the foot, left (bank)".
fn describe(prospect: &Prospect, texts: &Texts, words: &Words) -> String {
    let kind = match prospect.kind {
        IdeaKind::Pot => None,
        IdeaKind::Combination => Some("thoughts_combination"),
        IdeaKind::Bank => Some("thoughts_bank"),
        IdeaKind::Kick => Some("thoughts_kick"),
        IdeaKind::Carom => Some("thoughts_carom"),
        IdeaKind::Contact => Some("thoughts_contact"),
        IdeaKind::Break => Some("thoughts_break"),
        IdeaKind::Desperate => Some("thoughts_desperate"),
    };
    let kind = kind.map(|key| words.get(key));
    let aim = match (prospect.ball, prospect.pocket) {
        (Some(ball), Some(pocket)) => Some(potted(ball, pocket, texts)),
        (Some(ball), None) => Some(texts.ball(ball)),
        (None, _) => None,
    };
    match (aim, kind) {
        (Some(aim), Some(kind)) => format!("{aim} ({kind})"),
        (Some(text), None) | (None, Some(text)) => text,
        (None, None) => String::new(),
    }
}

fn potted(ball: BallId, pocket: PocketId, texts: &Texts) -> String {
    format!("{}: {}", texts.ball(ball), texts.pocket(pocket))
}
