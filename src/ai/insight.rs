//! What a player tells whoever wants to see it think (paper, figure 5.2).

use super::plan::{Line, LineEnd, Plan, PlanKind};
use super::view::TableView2d;
use crate::events::{Insight, Prospect, ProspectKind, Way, WayEnd};
use crate::ids::PlayerId;
use smallvec::{SmallVec, smallvec};

/// What the paper's player had in mind: all ways, and the one shot that cost least. It reckons with
/// costs and knows no chances.
pub fn of_plan(player: PlayerId, plan: &Plan, view: &TableView2d) -> Insight {
    let ends = plan.lines.iter().find(|line| {
        line.chosen && matches!(line.end, LineEnd::Pocket(_, pocket) if Some(pocket) == plan.pocket)
    });
    let course: SmallVec<_> = match (ends, plan.target.and_then(|ball| view.position(ball))) {
        (Some(line), Some(ball)) => smallvec![ball, line.to],
        _ => SmallVec::new(),
    };
    let chosen = Prospect {
        kind: match plan.kind {
            PlanKind::Pot => ProspectKind::Pot,
            PlanKind::Contact => ProspectKind::Contact,
            PlanKind::Kick => ProspectKind::Kick,
            PlanKind::Desperate => ProspectKind::Desperate,
            PlanKind::Break => ProspectKind::Break,
        },
        ball: plan.target,
        pocket: plan.pocket,
        ghost: plan.ghost,
        course,
        chance: None,
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
