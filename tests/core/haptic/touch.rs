//! Touching fixed things: table, trim, balls that cannot move.

use super::rig::TICK_S;
use glam::{DVec2, DVec3};
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
use hapticbillard::haptic::{
    Device, DeviceSpec, DeviceState, HapticBall, HapticMesh, HapticScene, Reach, ReachSettings,
    SafetySettings, Servo, ServoReport, ServoSettings, Touched,
};
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;
use std::sync::Arc;

/// The tip of a pool cue [m].
const TIP_M: f64 = 0.0106;

fn mesh() -> Arc<HapticMesh> {
    Arc::new(HapticMesh::of(&Table::preset("pool-9ft").unwrap()))
}

/// The middle of the workspace at `middle`, looking along +x; nothing can be struck.
fn reach(middle: DVec3, scale: f64) -> Reach {
    let depth_m = ReachSettings::default().box_m.z;
    Reach {
        serial: 1,
        // The pivot is not in the middle: 0.4 of half the depth before it.
        pivot: middle + DVec3::X * (0.2 * depth_m * scale),
        azimuth_rad: 0.0,
        elevation_rad: 0.0,
        scale,
        stroke_gain: 1.0,
        turns: false,
        solid: true,
        tip_radius_m: TIP_M,
        cue: None,
    }
}

/// Device coordinates of a place relative to the middle of the workspace.
fn device(world: DVec3, scale: f64) -> DVec3 {
    DVec3::new(-world.y, world.z, -world.x) / scale
}

fn bare(mesh: Arc<HapticMesh>, friction: f64) -> Servo {
    let mut settings = ServoSettings::of(&DeviceSpec::OMNI);
    settings.safety = SafetySettings::OFF;
    settings.coupling.friction = friction;
    settings.transient.gain_ns_m = 0.0;
    Servo::new(settings).among(mesh)
}

#[test]
fn a_tip_never_gets_through_the_table_however_fast() {
    let mesh = mesh();
    // On the bed, on a cushion's nose, on the rail, over a pocket's edge.
    for place in [DVec2::ZERO, DVec2::new(0.3, 0.63), DVec2::new(-0.9, 0.72), DVec2::new(0.0, 0.66)]
    {
        for speed_m_s in [0.1, 1.0, 5.0, 12.0] {
            let (mut servo, scale) = (bare(mesh.clone(), 0.0), 2.0);
            let middle = place.extend(0.12);
            let scene = HapticScene { reach: Some(reach(middle, scale)), ..HapticScene::default() };
            let mut z = 0.0;
            let mut least = f64::INFINITY;
            while z > -0.3 {
                let state = DeviceState {
                    position: device(DVec3::new(0.0, 0.0, z), scale),
                    ..DeviceState::default()
                };
                servo.tick(&state, &scene, TICK_S);
                least = least.min(servo.report().proxy.z);
                z -= speed_m_s * TICK_S;
            }
            // A pocket is 15 cm deep; the bed and the rails are not.
            let floor = if place.y == 0.66 { -0.15 } else { 0.0 };
            assert!(least > floor + TIP_M - 1e-6, "{place}, {speed_m_s}: {least}");
        }
    }
}

#[test]
fn the_bed_pushes_up_as_deep_as_the_hand_is() {
    let (mut servo, scale) = (bare(mesh(), 0.0), 2.0);
    let middle = DVec3::new(0.2, 0.1, 0.05);
    let scene = HapticScene { reach: Some(reach(middle, scale)), ..HapticScene::default() };
    let mut press = |depth_m: f64| {
        // In the device's scale, below where the tip lies on the cloth.
        let z = -(middle.z - TIP_M) / scale - depth_m;
        let state = DeviceState { position: DVec3::Y * z, ..DeviceState::default() };
        let force = servo.tick(&state, &scene, TICK_S).0;
        (force, *servo.report())
    };
    assert_eq!(press(-0.001).0, DVec3::ZERO);
    let (force, report) = press(0.002);
    assert!((force - DVec3::Y).length() < 1e-6, "{force}");
    assert!((report.depth_m - 0.002).abs() < 1e-9);
    assert!(matches!(report.contact.unwrap().touched, Touched::Face));
    assert!(press(0.003).1.contact.is_none(), "only the beginning is an event");
    assert_eq!(press(-0.001).0, DVec3::ZERO);
}

#[test]
fn friction_holds_within_its_cone_and_slides_at_its_rim() {
    let (mut servo, scale, mu) = (bare(mesh(), 0.4), 1.0, 0.4);
    let middle = DVec3::new(0.2, 0.1, 0.03);
    let scene = HapticScene { reach: Some(reach(middle, scale)), ..HapticScene::default() };
    let depth = 0.004;
    let mut to = |right: f64| {
        let position = DVec3::new(right, -(middle.z - TIP_M) - depth, 0.0);
        let state = DeviceState { position, ..DeviceState::default() };
        servo.tick(&state, &scene, TICK_S).0
    };
    to(0.0);
    to(0.0);
    // Static friction is 1.3 times the sliding one: 0.52 · 4 mm = 2.08 mm.
    let held = to(0.001);
    assert!((held.x + 0.5).abs() < 1e-6, "{held}");
    let held = to(0.002);
    assert!((held.x + 1.0).abs() < 1e-6, "{held}");
    let mut slid = DVec3::ZERO;
    for k in 0..100 {
        slid = to(0.003 + 1e-4 * f64::from(k));
    }
    let cone = slid.x.abs() / slid.y;
    assert!((cone - mu).abs() < 0.02, "{cone}");
}

#[test]
fn a_corner_of_bed_and_cushion_holds_the_tip_from_both_sides() {
    let (mut servo, scale) = (bare(mesh(), 0.0), 1.0);
    let middle = DVec3::new(0.3, 0.58, 0.03);
    let scene = HapticScene { reach: Some(reach(middle, scale)), ..HapticScene::default() };
    let mut report = ServoReport::default();
    for k in 0..200 {
        // Towards +y, which is left of +x, and down.
        let way = 0.0004 * f64::from(k);
        let position = device(DVec3::new(0.0, way, -0.5 * way), scale);
        servo.tick(&DeviceState { position, ..DeviceState::default() }, &scene, TICK_S);
        report = *servo.report();
    }
    let force = report.force.0;
    assert!(force.x > 1.0 && force.y > 1.0, "{force}");
    assert!((report.proxy.z - TIP_M).abs() < 1e-4, "{}", report.proxy);
}

#[test]
fn a_fixed_ball_is_felt_round_and_a_moving_one_pushes_without_a_jump() {
    let (mut servo, scale) = (bare(mesh(), 0.0), 1.0);
    let middle = DVec3::new(0.0, 0.0, 0.5);
    let mut scene = HapticScene { reach: Some(reach(middle, scale)), ..HapticScene::default() };
    let ball = |x: f64, v: f64| HapticBall {
        position: middle + DVec3::new(x, 0.0, 0.0),
        velocity: DVec3::X * v,
        radius_m: 0.03,
        ..HapticBall::NONE
    };
    scene.add(ball(0.05, 0.0));
    let mut to = |world: DVec3, scene: &HapticScene| {
        let position = device(world, scale);
        servo.tick(&DeviceState { position, ..DeviceState::default() }, scene, TICK_S).0
    };
    let reach_m = 0.03 + TIP_M;
    for k in 0..12 {
        let angle = 0.1 * f64::from(k);
        let out = DVec3::new(-libm::cos(angle), libm::sin(angle), 0.0);
        let force = to(DVec3::X * 0.05 + out * (reach_m - 0.002), &scene);
        assert!((force.length() - 1.0).abs() < 0.02, "{angle}: {force}");
        assert!(force.normalize().dot(device(out, 1.0)) > 0.999, "{angle}");
    }
    for _ in 0..20 {
        to(DVec3::X * (0.05 - reach_m), &scene);
    }
    // It rolls against the resting tip at 0.2 m/s, told every 4 ms, each time a little off.
    let mut last: Option<f64> = None;
    for k in 0..60_u32 {
        if k % 4 == 0 {
            scene.serial += 1;
            let wobble = if k % 8 == 0 { 2e-5 } else { -2e-5 };
            scene.balls[0] = ball(0.05 - 0.000_2 * f64::from(k) + wobble, -0.2);
        }
        let force = to(DVec3::X * (0.05 - reach_m), &scene).length();
        if let Some(last) = last {
            assert!((force - last).abs() < 0.13, "{k}: {last} to {force}");
        }
        last = Some(force);
    }
    assert!(last.unwrap() > 3.0);
}

#[test]
fn crossing_a_diamond_is_felt() {
    let table = Table::preset("pool-9ft").unwrap();
    let parameters = table.parameters.clone().unwrap();
    let mesh = mesh();
    let sight = DVec3::new(
        parameters.diamond_pitch_m,
        0.5 * parameters.width_m + parameters.diamond_from_nose_m,
        parameters.rail_height_m,
    );
    // A light hand draws the tip along the rail, 3 mm pressed in, across `place`.
    let wobble = |place: DVec3| {
        let middle = place + DVec3::Z * 0.03;
        let scale = 1.0;
        let down = -(0.03 - TIP_M) - 0.003;
        let (from, to) = (DVec3::new(0.0, down, 0.02), DVec3::new(0.0, down, -0.02));
        let legs = vec![
            Leg::to(from + DVec3::Y * 0.02, 0.7),
            Leg::to(from, 0.2),
            Leg::to(from, 0.2),
            Leg::ramp(to, 0.5),
        ];
        let script = HandScript::drawn(from + DVec3::Y * 0.02, legs);
        let spec = DeviceSpec::OMNI;
        let mut hand = SimulatedDevice::new(spec, HandModel::LIGHT, Guide::Script(script));
        let mut servo = Servo::new(ServoSettings::of(&spec)).among(mesh.clone());
        let mut scene = HapticScene { reach: Some(reach(middle, scale)), ..HapticScene::default() };
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for tick in 0..1_600_u32 {
            let state = hand.read(if tick == 0 { 0.0 } else { TICK_S });
            scene.serial += 1;
            let force = servo.tick(&state, &scene, TICK_S);
            hand.write(force);
            assert!(force.0.length() <= 3.3);
            if (1_250..1_550).contains(&tick) {
                low = low.min(hand.position().y);
                high = high.max(hand.position().y);
            }
        }
        high - low
    };
    let (over, beside) = (wobble(sight), wobble(sight + DVec3::X * 0.1));
    assert!(over > 0.000_5 && over > 5.0 * beside, "{over} m over it, {beside} m beside it");
}

#[test]
fn the_spheres_of_the_shipped_scene_are_felt_all_round() {
    let text = hapticbillard::shipped::scene("haptic_touch").unwrap();
    let scene = Scene::parse("haptic_touch", text).unwrap();
    assert!(scene.haptic.is_some() && scene.rules.is_none() && scene.cue.is_none());
    let table = scene.build_table(&mut |_| Err(String::new())).unwrap();
    let balls = scene.build_balls(&table).unwrap();
    let reached =
        |f: fn(DVec3, f64) -> DVec3| balls.iter().map(move |(b, s)| f(s.position, b.radius_m));
    let low = reached(|p, r| p - r).fold(DVec3::INFINITY, DVec3::min);
    let high = reached(|p, r| p + r).fold(DVec3::NEG_INFINITY, DVec3::max);
    let reach = Reach::around(1, low, high, TIP_M, &ReachSettings::default());
    let mut felt = HapticScene { reach: Some(reach), ..HapticScene::default() };
    for (ball, state) in &balls {
        assert!(felt.add(HapticBall::of(ball, state)));
    }
    let middle = 0.5 * (low + high);
    for (ball, state) in &balls {
        for side in [DVec3::Z, DVec3::Y, DVec3::NEG_Y, DVec3::NEG_X] {
            // From outside onto the ball, 2 mm too deep.
            let mut servo = bare(Arc::new(HapticMesh::of(&table)), 0.0);
            let touching = ball.radius_m + TIP_M;
            let mut report = ServoReport::default();
            for k in 0..60 {
                let way = touching + 0.005 - 0.007 * f64::from(k.min(50)) / 50.0;
                let position = device(state.position + side * way - middle, reach.scale);
                let state = DeviceState { position, ..DeviceState::default() };
                servo.tick(&state, &felt, TICK_S);
                report = *servo.report();
            }
            let force = report.force.0;
            // The edges of the workspace may push as well, from the sides.
            assert!(force.dot(device(side, 1.0)) > 0.3, "ball {}, {side}: {force}", ball.id);
            assert!((report.depth_m * reach.scale - 0.002).abs() < 2e-4, "{}", report.depth_m);
        }
    }
}
