//! A stylus that strikes, as if its hand were at mouse and keyboard: so that the picture shows its
//! line of aim, where its tip meets the ball, and how fast it is.

use super::draw_list::Radii;
use crate::cue::Aim;
use crate::haptic::ServoReport;
use crate::ids::BallId;
use crate::input::{HumanMode, HumanView, first_met};
use crate::physics::Snapshot;
use crate::table::Table;
use glam::DVec3;

/// The view of somebody at the table, with what the stylus does in place of aim and stroke: while
/// all balls lie, and the tip is behind the cue ball. Otherwise nobody aims.
#[must_use]
pub fn aimed_by_stylus(
    view: &HumanView,
    report: &ServoReport,
    world: &Snapshot,
    table: &Table,
    radii: &Radii,
) -> HumanView {
    let aimed = || {
        let may_aim =
            matches!(view.mode, HumanMode::Watching | HumanMode::Aiming | HumanMode::HoldingStylus);
        if !may_aim || world.is_rolling() {
            return None;
        }
        let centre = world.on_table().find(|ball| ball.id == BallId::CUE)?.position;
        let workspace = report.workspace.as_ref()?;
        let direction = report.sample.direction;
        let reach_m = radii.of(BallId::CUE) + workspace.tip_radius_m;
        // How far the line of the shaft passes by the middle of the ball.
        let way = centre - report.target;
        let beside = direction * way.dot(direction) - way;
        let offset = beside / reach_m;
        let [side_offset, height_offset] =
            [workspace.turn.x_axis, workspace.turn.y_axis].map(|axis| offset.dot(axis));
        if !(offset.length() < 1.0 && way.dot(direction) > 0.0) {
            return None;
        }
        let azimuth_rad = libm::atan2(direction.y, direction.x);
        let elevation_rad = report.elevation_rad;
        let aim = Aim { azimuth_rad, elevation_rad, side_offset, height_offset };
        let level = direction.truncate().normalize_or_zero();
        let met = first_met(world, table.bed.as_ref(), BallId::CUE, centre, level);
        let is_stroke = report.sample.stabilised;
        Some(HumanView {
            mode: if is_stroke { HumanMode::Stroking } else { HumanMode::Aiming },
            aim,
            strength_m_s: report.sample.velocity.dot(direction).abs(),
            ghost: met.map(|(ghost, _): (DVec3, _)| ghost),
            object_heading: met.map_or_else(Default::default, |(_, heading)| heading),
            ..view.clone()
        })
    };
    let watching = match view.mode {
        HumanMode::Aiming => HumanMode::Watching,
        mode => mode,
    };
    aimed().unwrap_or_else(|| HumanView { mode: watching, ..view.clone() })
}
