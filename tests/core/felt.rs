//! What a picture shows of a haptic device: every number is the servo's own.

use glam::{DVec3, Vec3};
use hapticbillard::ball::{BallState, POOL_RADIUS_M};
use hapticbillard::cue::TIP_RADIUS_M;
use hapticbillard::haptic::{
    Buttons, CueBody, DeviceSpec, DeviceState, Force, HapticBall, HapticScene, Reach,
    ReachSettings, SafetyFlags, SafetySettings, Servo, ServoReport, ServoSettings,
};
use hapticbillard::ids::BallId;
use hapticbillard::input::{HumanMode, HumanView};
use hapticbillard::physics::{Parameters, Snapshot};
use hapticbillard::renderer::{
    DrawList, FeltLook, FeltTool, HelpOf, Hud, Overlay, Punctuality, Radii, Scoreboard, Solid,
    SolidShape, Words, aimed_by_stylus, force_colour,
};
use hapticbillard::rules::{Language, Texts};
use hapticbillard::table::Table;
use hapticbillard::units::TICK_S;

const SCALE: f64 = 2.0;
const PIVOT: DVec3 = DVec3::new(-0.635, 0.0, POOL_RADIUS_M);

fn reach(azimuth_rad: f64, cue: bool) -> Reach {
    let cue = cue.then(|| CueBody::of(&Parameters::pool()));
    Reach {
        serial: 1,
        pivot: PIVOT,
        azimuth_rad,
        elevation_rad: 0.0,
        scale: SCALE,
        stroke_gain: 1.0,
        turns: true,
        solid: true,
        tip_radius_m: TIP_RADIUS_M,
        cue,
    }
}

/// A servo with a fixed ball at the pivot, or with none in reach, after its device was at
/// `position` for a while.
fn held(position: DVec3, azimuth_rad: f64, ball: bool) -> ServoReport {
    let spec = DeviceSpec::OMNI;
    let safety = SafetySettings { force_max_n: 3.3, ..SafetySettings::OFF };
    let mut servo = Servo::new(ServoSettings { safety, ..ServoSettings::of(&spec) });
    let reach = Some(reach(azimuth_rad, false));
    let mut scene = HapticScene { serial: 1, reach, ..HapticScene::default() };
    if ball {
        let (id, radius_m) = (BallId(3), POOL_RADIUS_M);
        scene.add(HapticBall { id, radius_m, position: PIVOT, ..HapticBall::NONE });
    }
    // From outside to its place.
    for k in 0..=200 {
        let away = DVec3::Z * (0.06 * (1.0 - f64::from(k.min(100)) / 100.0));
        let state = DeviceState { position: position + away, ..DeviceState::default() };
        servo.tick(&state, &scene, TICK_S);
    }
    *servo.report()
}

fn look(tool: FeltTool) -> FeltLook {
    FeltLook::new(tool, 3.3, &ReachSettings::default())
}

fn picture(report: &ServoReport, tool: FeltTool) -> DrawList {
    let mut list = DrawList::new(&Snapshot::default(), &HumanView::default(), &Radii::default());
    list.show_felt(report, &look(tool));
    list
}

fn of(list: &DrawList, shape: SolidShape) -> Vec<Solid> {
    list.solids.iter().copied().filter(|solid| solid.shape == shape).collect()
}

/// A device place at this distance from the ball's middle, on the user's side [m, world].
fn in_front(distance_m: f64) -> DVec3 {
    DVec3::new(0.0, 0.0, -0.014 + distance_m / SCALE)
}

#[test]
fn the_arrow_is_as_long_as_the_force_and_points_where_it_pushes() {
    for azimuth_rad in [0.0, 0.8, -2.0] {
        // 2 mm of the device deep: 1 N at 500 N/m.
        let contact_m = POOL_RADIUS_M + TIP_RADIUS_M;
        let report = held(in_front(contact_m - 0.002 * SCALE), azimuth_rad, true);
        let newtons = report.force.0.length();
        assert!((newtons - 1.0).abs() < 0.02, "{newtons}");
        let list = picture(&report, FeltTool::Stylus);
        let [head] = of(&list, SolidShape::Cone)[..] else { panic!("one arrow") };
        let end = Vec3::from(head.to).as_dvec3();
        let way = end - report.proxy;
        let (sin, cos) = libm::sincos(azimuth_rad);
        let back = DVec3::new(-cos, -sin, 0.0);
        assert!((way - back * (0.024 * SCALE * newtons)).length() < 1e-4, "{way}");
        assert_eq!(head.colour[..3], force_colour(newtons / 3.3));
        assert!(head.is_over);
    }
    assert!(
        of(&picture(&held(in_front(0.1), 0.0, true), FeltTool::Stylus), SolidShape::Cone)
            .is_empty()
    );
    assert_ne!(force_colour(0.0), force_colour(1.0));
    assert_eq!(force_colour(1.0), force_colour(7.0));
}

#[test]
fn the_stylus_stays_outside_and_the_depth_is_seen_inside() {
    let contact_m = POOL_RADIUS_M + TIP_RADIUS_M;
    let depth_m = 0.003;
    let report = held(in_front(contact_m - depth_m * SCALE), 0.0, true);
    assert!((report.depth_m - depth_m).abs() < 1e-4, "{}", report.depth_m);
    let list = picture(&report, FeltTool::Stylus);
    let tip = Vec3::from(list.stylus.unwrap().tip).as_dvec3();
    assert!((tip.distance(PIVOT) - contact_m).abs() < 1e-5);
    let shining: Vec<DVec3> = of(&list, SolidShape::Ball)
        .iter()
        .filter(|ball| ball.is_over)
        .map(|ball| Vec3::from(ball.from).as_dvec3())
        .collect();
    let [inside, touched] = shining[..] else { panic!("{shining:?}") };
    assert!((inside.distance(tip) - depth_m * SCALE).abs() < 2e-4);
    assert!((touched.distance(PIVOT) - POOL_RADIUS_M).abs() < 1e-4);
    // Without contact there is neither.
    let free = picture(&held(in_front(0.1), 0.0, true), FeltTool::Stylus);
    assert!(free.solids.iter().all(|solid| !solid.is_over) && free.stylus.is_some());
}

#[test]
fn the_edges_of_the_workspace_are_there_and_those_that_are_pushed_stand_out() {
    let edges = |position: DVec3| -> Vec<f32> {
        let list = picture(&held(position, 0.0, false), FeltTool::Cue);
        let rods = of(&list, SolidShape::Cylinder);
        rods.iter().filter(|rod| !rod.is_over).map(|rod| rod.colour[3]).collect()
    };
    let faint = edges(DVec3::ZERO);
    assert_eq!(faint.len(), 12);
    assert!(faint.iter().all(|opacity| *opacity < 0.3));
    let pushed = edges(DVec3::new(0.074, 0.0, 0.0));
    assert_eq!(pushed.iter().filter(|opacity| **opacity > 0.5).count(), 4);
    // Depth has no planes.
    assert!(edges(DVec3::new(0.0, 0.0, 0.05)).iter().all(|opacity| *opacity < 0.3));
}

#[test]
fn a_cue_takes_the_place_of_the_worlds_and_nothing_is_drawn_of_a_device_out_of_reach() {
    let report = held(in_front(0.08), 0.3, false);
    let list = picture(&report, FeltTool::Cue);
    let cue = list.cue.unwrap();
    assert!(list.stylus.is_none() && cue.direction == report.sample.direction);
    assert!(cue.tip.distance(report.proxy) < 1e-9);
    let list = picture(&ServoReport::default(), FeltTool::Cue);
    assert!(list.cue.is_none() && list.stylus.is_none() && list.solids.is_empty());
}

fn cue_ball() -> Snapshot {
    Snapshot { balls: vec![BallState::at_rest(BallId::CUE, PIVOT)], ..Snapshot::default() }
}

#[test]
fn where_the_stylus_would_strike_is_shown_as_if_a_mouse_aimed() {
    let table = Table::preset("pool-9ft").unwrap();
    let view = HumanView { mode: HumanMode::Aiming, ..HumanView::default() };
    let aimed = |position: DVec3, world: &Snapshot| {
        let report = held(position, 0.4, false);
        aimed_by_stylus(&view, &report, world, &table, &Radii::default())
    };
    let world = cue_ball();
    let seen = aimed(in_front(0.1), &world);
    assert_eq!(seen.mode, HumanMode::Aiming);
    assert!(seen.aim.side_offset.abs() < 1e-6 && (seen.aim.azimuth_rad - 0.4).abs() < 1e-6);
    let ghost = seen.ghost.unwrap() - PIVOT;
    assert!((libm::atan2(ghost.y, ghost.x) - 0.4).abs() < 1e-9);
    // Half a ball's reach to the right and a quarter up.
    let reach_m = (POOL_RADIUS_M + TIP_RADIUS_M) / SCALE;
    let aside = in_front(0.1) + DVec3::new(0.5 * reach_m, 0.25 * reach_m, 0.0);
    let seen = aimed(aside, &world);
    assert!((seen.aim.side_offset - 0.5).abs() < 1e-3, "{:?}", seen.aim);
    assert!((seen.aim.height_offset - 0.25).abs() < 1e-3, "{:?}", seen.aim);
    // Past the ball, in front of it, or while it rolls, nobody aims.
    let past = in_front(0.1) + DVec3::X * 1.2 * reach_m;
    let mut rolling = cue_ball();
    rolling.balls[0].velocity = DVec3::X;
    for (place, world) in [(past, &world), (in_front(-0.1), &world), (in_front(0.1), &rolling)] {
        assert_eq!(aimed(place, world).mode, HumanMode::Watching);
    }
}

#[test]
fn a_held_front_button_is_a_stroke_with_its_speed() {
    let table = Table::preset("pool-9ft").unwrap();
    let mut servo = Servo::new(ServoSettings::of(&DeviceSpec::OMNI));
    let reach = Some(reach(0.0, true));
    let scene = HapticScene { reach, ..HapticScene::default() };
    for k in 0..60 {
        let state = DeviceState {
            position: DVec3::Z * (0.06 - 0.000_5 * f64::from(k)),
            // What is down at first was pressed for something else.
            buttons: if k == 0 { Buttons::default() } else { Buttons::FRONT },
            ..DeviceState::default()
        };
        servo.tick(&state, &scene, TICK_S);
    }
    let view = HumanView { mode: HumanMode::Aiming, ..HumanView::default() };
    let report = servo.report();
    let seen = aimed_by_stylus(&view, report, &cue_ball(), &table, &Radii::default());
    assert_eq!(seen.mode, HumanMode::Stroking);
    // 0.5 m/s of the hand at twice the scale.
    assert!((seen.strength_m_s - 1.0).abs() < 0.02, "{}", seen.strength_m_s);
}

fn row(overlay: &Overlay, key: &str) -> String {
    let words = Words::new(Language::English);
    let panel = overlay.panel(&words).unwrap();
    panel.rows.into_iter().find(|(name, _)| *name == words.get(key)).unwrap().1
}

fn acting(overlay: &Overlay) -> Vec<String> {
    overlay.panel(&Words::new(Language::English)).unwrap().acting
}

fn pushing(newtons: f64) -> ServoReport {
    let force = Force(DVec3::X * newtons);
    ServoReport { force, stiffness_max_n_m: 500.0, stiffness_factor: 1.0, ..ServoReport::default() }
}

#[test]
fn the_panel_shows_the_rate_and_the_largest_force_of_a_tenth_of_a_second() {
    let mut overlay = Overlay::new("test".into(), 3.3);
    assert!(overlay.panel(&Words::new(Language::English)).is_none());
    for (now_s, newtons) in [(0.0, 0.0), (0.03, 2.0), (0.06, 0.5)] {
        overlay.take(&pushing(newtons), now_s);
        assert_eq!(row(&overlay, "felt_force"), "0.00 N of 3.3 N");
    }
    overlay.take(&pushing(0.5), 0.11);
    assert_eq!(row(&overlay, "felt_force"), "2.00 N of 3.3 N");
    overlay.take(&pushing(0.5), 0.22);
    assert_eq!(row(&overlay, "felt_force"), "0.50 N of 3.3 N");

    let late_s = [5e-6, 4.2e-5, 0.001_2];
    for (now_s, ticks) in [(0.0, 100), (0.3, 390), (0.5, 595)] {
        overlay.take_punctuality(Punctuality { ticks, missed: 3, late_s }, now_s);
    }
    assert_eq!(row(&overlay, "felt_rate"), "990 Hz, 3 ticks missed");
    assert_eq!(row(&overlay, "felt_late"), "median 5 µs, p99 42 µs, max 1200 µs");
}

#[test]
fn a_stage_that_acted_between_two_pictures_is_told_for_a_moment() {
    let mut overlay = Overlay::new("test".into(), 3.3);
    overlay.take(&pushing(0.0), 0.0);
    assert_eq!(acting(&overlay), ["Safety: nothing to do."]);
    // Only the counter knows of the clamp; the ramp is on now.
    let mut report = pushing(3.3);
    report.counters.clamp = 2;
    report.flags.set(SafetyFlags::RAMP, true);
    overlay.take(&report, 0.2);
    let told = ["The force is still rising after a start.", "Cut at the largest force."];
    assert_eq!(acting(&overlay), told);
    report.flags = SafetyFlags::default();
    overlay.take(&report, 0.7);
    assert_eq!(acting(&overlay), told);
    overlay.take(&report, 0.9);
    assert_eq!(acting(&overlay), ["Safety: nothing to do."]);
    report.stiffness_factor = 0.5;
    overlay.take(&report, 1.0);
    assert_eq!(row(&overlay, "felt_stiffness"), "250 N/m (softened to 50 %)");
}

#[test]
fn every_stage_has_words_in_every_language() {
    for language in Language::ALL {
        let words = Words::new(language);
        for bit in 0..11 {
            let mut overlay = Overlay::new("test".into(), 3.3);
            let flags = SafetyFlags(1 << bit);
            overlay.take(&ServoReport { flags, ..pushing(0.0) }, 0.0);
            let panel = overlay.panel(&words).unwrap();
            assert!(panel.is_acting && panel.acting.len() == 1, "{bit}");
            assert!(panel.acting[0].contains(' ') && !panel.acting[0].contains('_'));
            assert!(
                panel.rows.iter().all(|(name, value)| !name.contains('_') && !value.contains('{'))
            );
        }
    }
}

#[test]
fn whoever_moves_the_hand_with_a_mouse_is_told_how() {
    let words = Words::new(Language::English);
    let board = Scoreboard::new(Vec::new());
    let hint = |tool, view: &HumanView| {
        let hud = Hud::new(&board, view, &Texts::new(Language::English), &words);
        hud.with_felt(None, tool, view, &words)
    };
    let touch = hint(Some(FeltTool::Stylus), &HumanView::default());
    assert_eq!(touch.hint, words.get("felt_touch"));
    let help = words.help(HelpOf::Felt);
    assert!(help.iter().any(|(_, does)| does.contains("moves the hand")));
    let stroke = HumanView { mode: HumanMode::Stroking, ..HumanView::default() };
    assert_eq!(hint(Some(FeltTool::Cue), &stroke).hint, words.get("felt_stroke"));
    let placing = HumanView { mode: HumanMode::Placing, ..HumanView::default() };
    assert_eq!(hint(Some(FeltTool::Cue), &placing).hint, words.get("not_there"));
    // Somebody with a real device has no use for words about the mouse.
    assert_eq!(hint(None, &HumanView::default()).hint, "");
}
