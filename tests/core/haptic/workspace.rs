//! The workspace in the world: where it lies, how its edges turn it, the stabiliser.

use glam::{DQuat, DVec3};
use hapticbillard::cue::Aim;
use hapticbillard::haptic::{
    Buttons, DeviceSpec, DeviceState, HapticScene, Reach, SafetySettings, Servo, ServoReport,
    ServoSettings,
};
use hapticbillard::physics::Parameters;

const PIVOT: DVec3 = DVec3::new(0.3, -0.2, 0.03);

struct Desk {
    servo: Servo,
    scene: HapticScene,
    device: DeviceState,
}

impl Desk {
    fn new(aim: &Aim) -> Self {
        let mut settings = ServoSettings::of(&DeviceSpec::OMNI);
        settings.safety = SafetySettings::OFF;
        settings.coupling.tracking_rad_s = f64::INFINITY;
        let reach = Reach::to_ball(1, PIVOT, aim, &settings.reach, &Parameters::pool());
        Desk {
            servo: Servo::new(settings),
            scene: HapticScene { reach: Some(reach), ..HapticScene::default() },
            device: DeviceState::default(),
        }
    }

    fn at(&mut self, position: DVec3) -> ServoReport {
        self.device.position = position;
        self.scene.serial += 1;
        self.servo.tick(&self.device, &self.scene, 0.001);
        *self.servo.report()
    }
}

#[track_caller]
fn near(a: DVec3, b: DVec3) {
    assert!(a.distance(b) < 1e-9, "{a}, not {b}");
}

/// The ball's place in the device: (0, 0, −0.4 · 70 mm/2).
const BALL: DVec3 = DVec3::new(0.0, 0.0, -0.014);

#[test]
fn the_ball_lies_where_the_paper_puts_it_and_axes_are_those_of_the_aim() {
    for (azimuth_rad, elevation_rad) in [(0.0, 0.0), (1.1, 0.0), (-2.5, 0.7)] {
        let aim = Aim { azimuth_rad, elevation_rad, ..Aim::default() };
        let mut desk = Desk::new(&aim);
        let k = desk.scene.reach.unwrap().scale;
        near(desk.at(BALL).sample.tip, PIVOT);
        near(desk.at(BALL + DVec3::X * 0.01).sample.tip, PIVOT + aim.right() * (k * 0.01));
        near(desk.at(BALL + DVec3::Y * 0.01).sample.tip, PIVOT + aim.up() * (k * 0.01));
        let back = desk.at(BALL + DVec3::Z * 0.01).sample;
        near(back.tip, PIVOT - aim.direction() * (k * 0.01));
        near(back.direction, aim.direction());
    }
}

#[test]
fn edges_are_felt_and_turn_the_workspace_about_the_ball() {
    let mut desk = Desk::new(&Aim::default());
    // 75 mm to the right: the edge is 10 mm inside of the box, so 5 mm too far.
    let mut report = desk.at(DVec3::X * 0.075);
    assert!((report.force.0 - DVec3::NEG_X).length() < 1e-9, "{}", report.force.0);
    for _ in 0..999 {
        report = desk.at(DVec3::X * 0.075);
    }
    // 150 rad/(s m) · 5 mm for a second, clockwise from above.
    assert!((report.azimuth_rad + 0.75).abs() < 1e-9, "{}", report.azimuth_rad);
    near(desk.at(BALL).sample.tip, PIVOT);

    // The top raises the butt, up to the limit; the bottom lowers it, down to level.
    for _ in 0..5_000 {
        report = desk.at(DVec3::Y * 0.058);
    }
    assert!((report.elevation_rad - 60.0_f64.to_radians()).abs() < 1e-9);
    assert!(report.force.0.y < -1.0);
    for _ in 0..5_000 {
        report = desk.at(DVec3::Y * -0.058);
    }
    assert_eq!(report.elevation_rad, 0.0);
    // In between nothing turns.
    let before = desk.at(DVec3::ZERO).azimuth_rad;
    for _ in 0..1_000 {
        report = desk.at(DVec3::new(0.06, 0.04, 0.03));
    }
    assert_eq!(report.azimuth_rad, before);
}

#[test]
fn the_stabiliser_holds_tip_and_direction_to_the_line_of_the_press() {
    let mut desk = Desk::new(&Aim { azimuth_rad: 0.4, ..Aim::default() });
    // The stylus points 10° to the left of −z.
    desk.device.orientation = DQuat::from_axis_angle(DVec3::Y, 10.0_f64.to_radians());
    let start = DVec3::new(0.01, 0.005, 0.03);
    let free = desk.at(start).sample;
    assert!(!free.stabilised);
    desk.device.buttons = Buttons::FRONT;
    let pressed = desk.at(start).sample;
    near(pressed.tip, free.tip);
    let line = pressed.direction;
    let expected = Aim { azimuth_rad: 0.4 + 10.0_f64.to_radians(), ..Aim::default() };
    near(line, expected.direction());

    let reach = desk.scene.reach.unwrap();
    for k in 0..100 {
        let s = f64::from(k);
        // A shaking hand that turns the stylus.
        desk.device.orientation = DQuat::from_axis_angle(DVec3::X, 0.2 * libm::sin(s));
        let shake = 0.002 * DVec3::new(libm::sin(3.0 * s), libm::cos(5.0 * s), 0.0);
        let along = DQuat::from_axis_angle(DVec3::Y, 10.0_f64.to_radians()) * DVec3::NEG_Z;
        let way = -0.0002 * s;
        let report = desk.at(start + along * way + shake);
        near(report.sample.direction, line);
        let off = report.sample.tip - pressed.tip;
        near(off, line * off.dot(line));
        // Sideways shaking moves the tip only by what of it lies along the line.
        let expected = reach.scale * reach.stroke_gain * (way + shake.dot(along));
        assert!((off.dot(line) - expected).abs() < 1e-9);
        // And the device is drawn back to the line.
        let away = shake - along * shake.dot(along);
        assert!((report.force.0 + 300.0 * away).length() < 1e-6, "{}", report.force.0);
    }
    // Let go, the tip goes back to the device without a jump.
    desk.device.buttons = Buttons::default();
    let mut last = desk.servo.report().sample.tip;
    let here = desk.device.position;
    for _ in 0..200 {
        let tip = desk.at(here).sample.tip;
        assert!(tip.distance(last) < 0.003, "{}", tip.distance(last));
        last = tip;
    }
    let mut other = Desk::new(&Aim { azimuth_rad: 0.4, ..Aim::default() });
    near(last, other.at(here).sample.tip);
}

#[test]
fn a_workspace_that_is_laid_anew_is_there_at_once_and_nothing_else_moves_it() {
    let mut desk = Desk::new(&Aim::default());
    desk.at(BALL);
    let reach = desk.scene.reach.as_mut().unwrap();
    reach.pivot = PIVOT + DVec3::X;
    near(desk.at(BALL).sample.tip, PIVOT);
    desk.scene.reach.as_mut().unwrap().serial = 2;
    near(desk.at(BALL).sample.tip, PIVOT + DVec3::X);
    assert_eq!(desk.servo.report().sample.velocity, DVec3::ZERO);
}

#[test]
fn every_press_begins_a_stroke_but_one_that_was_made_for_something_else() {
    let mut desk = Desk::new(&Aim::default());
    let cue = desk.scene.reach.unwrap().cue;
    let mut tick = |buttons, cue| {
        desk.device.buttons = buttons;
        desk.scene.reach.as_mut().unwrap().cue = cue;
        desk.at(DVec3::ZERO).sample.stabilised
    };
    for stroke in 0..3 {
        assert!(!tick(Buttons::default(), cue));
        assert!(tick(Buttons::FRONT, cue) && tick(Buttons::FRONT, cue), "stroke {stroke}");
    }
    // Pressed while there was no cue to strike with.
    assert!(!tick(Buttons::default(), None) && !tick(Buttons::FRONT, None));
    assert!(!tick(Buttons::FRONT, cue));
    assert!(!tick(Buttons::default(), cue) && tick(Buttons::FRONT, cue));
}

#[test]
fn a_workspace_laid_while_the_hand_is_low_leaves_the_tip_on_the_table() {
    let table = hapticbillard::table::Table::preset("pool-9ft").unwrap();
    let mesh = hapticbillard::haptic::HapticMesh::of(&table);
    let mut desk = Desk::new(&Aim::default());
    desk.servo = desk.servo.among(std::sync::Arc::new(mesh));
    let reach = desk.scene.reach.as_mut().unwrap();
    reach.pivot = DVec3::new(-0.6, 0.0, hapticbillard::ball::POOL_RADIUS_M);
    let radius_m = reach.tip_radius_m;
    // 60 mm under the ball, which lies 29 mm above the bed.
    let low = DVec3::new(0.01, -0.03, 0.02);
    for tick in 0..20 {
        let report = desk.at(low);
        assert!(report.sample.tip.z > radius_m - 1e-6, "{tick}: {}", report.sample.tip);
        assert!(report.proxy.z > radius_m - 1e-6, "{tick}: {}", report.proxy);
    }
    let up = desk.at(DVec3::new(0.01, 0.01, 0.02));
    assert!(up.sample.tip.z > radius_m, "{}", up.sample.tip);
}
