//! A tick allocates nothing.

use super::rig::{READY_TICKS, TICK_S, drawn_back, stroke};
use crate::counting::calls;
use glam::DVec3;
use hapticbillard::cue::Aim;
use hapticbillard::haptic::simulated::{Guide, HandModel};
use hapticbillard::haptic::{Device, Effect, EffectSet, HapticBall, Region};
use hapticbillard::ids::BallId;

/// Every kind of effect.
fn effects(generation: u32) -> EffectSet {
    let (stiffness_n_m, damping_ns_m, region) = (300.0, 0.5, Region::Everywhere);
    let (point, direction) = (DVec3::ZERO, DVec3::Z);
    EffectSet::of(
        generation,
        &[
            Effect::Constant { force: DVec3::X * 0.1 },
            Effect::Point { point, stiffness_n_m, damping_ns_m },
            Effect::Line { point, direction, stiffness_n_m, damping_ns_m },
            Effect::Plane { normal: DVec3::Z, offset_m: 0.02, stiffness_n_m, damping_ns_m },
            Effect::Sphere { centre: point, radius_m: 0.02, stiffness_n_m, damping_ns_m },
            Effect::Magnet { point, stiffness_n_m, force_max_n: 1.0, reach_m: 0.05 },
            Effect::Viscous { region, damping_ns_m },
            Effect::StickSlip { region, stiffness_n_m, force_max_n: 0.2 },
        ],
    )
}

#[test]
fn a_tick_with_table_balls_effects_and_a_stroke_allocates_nothing() {
    let aim = Aim { azimuth_rad: 0.3, elevation_rad: 0.3, ..Aim::default() };
    let mut rig = drawn_back(HandModel::GRIP, &aim);
    for id in 2..16 {
        let ball = HapticBall {
            id: BallId(id),
            position: rig.scene.balls[0].position + DVec3::new(0.06 * f64::from(id), 0.0, 0.0),
            ..rig.scene.balls[1]
        };
        assert!(rig.scene.add(ball));
    }
    let script = stroke(1.0, 0.0);
    let ticks = (script.duration_s() / TICK_S) as u64 - READY_TICKS;
    *rig.device.guide_mut() = Guide::Script(script);
    let mut contacts = 0;
    for tick in 0..ticks + 200 {
        let mut state = rig.device.read(TICK_S);
        if tick > ticks {
            // Down on the table, and a device that says no numbers.
            state.position.y -= 0.02;
            state.position.x = if tick % 50 == 0 { f64::NAN } else { state.position.x };
        }
        rig.scene.serial += u64::from(tick % 3 == 0);
        rig.scene.effects = effects(tick as u32 / 20);
        let before = calls();
        let force = rig.servo.tick(&state, &rig.scene, TICK_S);
        let report = *rig.servo.report();
        assert_eq!(calls() - before, 0, "tick {tick}");
        rig.device.write(force);
        contacts += u64::from(report.contact.is_some());
    }
    assert!(contacts > 0, "nothing was touched");
}
