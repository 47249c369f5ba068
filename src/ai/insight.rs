//! What a player tells whoever wants to see it think (paper, figure 5.2).

use super::mind::{Considered, Thoughts};
use super::plan::{Line, LineEnd, Plan, PlanKind};
use crate::events::{IdeaKind, Insight, Prospect, Way, WayEnd};
use crate::ids::PlayerId;
use glam::DVec2;

/// What the paper's player had in mind: all ways, and the one shot that cost least. It reckons with
/// costs and knows no chances.
pub fn insight_of_plan(player: PlayerId, plan: &Plan) -> Insight {
    let chosen = Prospect {
        kind: match plan.kind {
            PlanKind::Pot => IdeaKind::Pot,
            PlanKind::Contact => IdeaKind::Contact,
            PlanKind::Kick => IdeaKind::Kick,
            PlanKind::Desperate => IdeaKind::Desperate,
            PlanKind::Break => IdeaKind::Break,
        },
        ball: plan.target,
        pocket: plan.pocket,
        ghost: plan.ghost,
        ways: plan.lines.iter().filter(|line| line.chosen).map(way).collect(),
        chance: None,
        legal: None,
        value: None,
        samples: 0,
        is_chosen: true,
    };
    Insight {
        player,
        cue_ball: plan.cue_ball,
        ways: plan.lines.iter().map(way).collect(),
        prospects: vec![chosen],
    }
}

/// What a searching player had in mind for a cue ball at `cue_ball` [m], and all `ways` there are.
pub fn insight_of_thoughts(
    player: PlayerId,
    cue_ball: DVec2,
    thoughts: &Thoughts,
    ways: &[Line],
) -> Insight {
    Insight {
        player,
        cue_ball,
        ways: ways.iter().map(way).collect(),
        prospects: thoughts.candidates.iter().map(prospect).collect(),
    }
}

fn prospect(considered: &Considered) -> Prospect {
    let idea = &considered.idea;
    Prospect {
        kind: idea.kind,
        ball: idea.ball.or(idea.first),
        pocket: idea.pocket,
        ghost: idea.ghost,
        ways: idea.lines.iter().map(way).collect(),
        chance: Some(considered.success),
        legal: Some(considered.legal),
        value: Some(considered.value),
        samples: considered.samples,
        is_chosen: considered.chosen,
    }
}

fn way(line: &Line) -> Way {
    Way {
        from: line.from,
        to: line.to,
        leads_to: match line.end {
            LineEnd::Ball(ball) => WayEnd::Ball(ball),
            LineEnd::Pocket(ball, pocket) => WayEnd::Pocket(ball, pocket),
        },
        is_free: line.free,
        is_chosen: line.chosen,
    }
}
