//! What a picture shows: draw list, playhead, shapes, scoreboard and head-up display.

use glam::{DQuat, DVec2, DVec3, Vec3};
use hapticbillard::ball::{BallPlace, BallState, Motion, POOL_RADIUS_M};
use hapticbillard::events::{
    BallInHand, Event, Fact, FactKind, Foul, Group, Groups, Health, PlayerReport, PlayerState,
    ShotKind, Turn, TurnAfter, Verdict,
};
use hapticbillard::ids::{BallId, PlayerId, PocketId};
use hapticbillard::input::{HumanMode, HumanView, STYLUS};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{
    DrawList, HelpOf, Hud, Playhead, Radii, Remaining, Scoreboard, Shape, Words, ball_look,
    between, cue_shape, sphere,
};
use hapticbillard::rules::{Language, Texts};
use smallvec::smallvec;
use std::collections::BTreeMap;
use std::sync::Arc;

fn ball(id: u16, x: f64) -> BallState {
    BallState {
        id: BallId(id),
        position: DVec3::new(x, 0.0, POOL_RADIUS_M),
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        motion: Motion::Rest,
        place: BallPlace::OnTable,
    }
}

fn world(time_s: f64, balls: &[BallState]) -> Snapshot {
    Snapshot { time_s, balls: balls.to_vec(), cue: None }
}

/// Each edge once in each direction, all triangles turned outwards.
#[track_caller]
fn check_closed(shape: &Shape, is_outward: impl Fn(Vec3, Vec3) -> bool) {
    let point = |i: u32| Vec3::from(shape.positions[i as usize]);
    let mut edges = BTreeMap::new();
    for triangle in shape.indices.chunks(3) {
        let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
        let normal = (point(b) - point(a)).cross(point(c) - point(a));
        assert!(is_outward(point(a) + point(b) + point(c), normal), "{triangle:?}");
        for edge in [(a, b), (b, c), (c, a)] {
            *edges.entry(edge).or_insert(0) += 1;
        }
    }
    assert!(edges.iter().all(|(&(a, b), n)| *n == 1 && edges.contains_key(&(b, a))));
}

#[test]
fn spheres_have_the_papers_triangles_and_are_closed() {
    for (level, triangles) in [(2, 320), (3, 1280), (4, 5120)] {
        let shape = sphere(level);
        assert_eq!(shape.indices.len(), 3 * triangles);
        assert!(shape.positions.iter().all(|p| (Vec3::from(*p).length() - 1.0).abs() < 1e-6));
        check_closed(&shape, |middle, normal| middle.dot(normal) > 0.0);
    }
}

#[test]
fn the_cue_points_along_x_with_its_butt_behind() {
    let shape = cue_shape();
    let along = shape.positions.iter().map(|p| p[0]);
    let (least, most) = along.fold((f32::MAX, f32::MIN), |(a, b), x| (a.min(x), b.max(x)));
    assert!((most - 0.0106).abs() < 1e-6 && (-1.48..-1.45).contains(&least), "{least} {most}");
    assert_eq!(shape.positions.len(), shape.colours.len());
    for triangle in shape.indices.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|i| Vec3::from(shape.positions[triangle[i] as usize]));
        let normal = (b - a).cross(c - a);
        let outwards: Vec3 = triangle.iter().map(|i| Vec3::from(shape.normals[*i as usize])).sum();
        assert!(normal.dot(outwards) >= -1e-12, "{triangle:?}");
    }
}

#[test]
fn solids_and_stripes_share_their_colours() {
    for id in 1..=7 {
        let (solid, stripe) = (ball_look(BallId(id)), ball_look(BallId(id + 8)));
        assert_eq!(solid.colour, stripe.colour);
        assert!(!solid.is_striped && stripe.is_striped);
        assert_eq!((solid.number, stripe.number), (Some(id), Some(id + 8)));
    }
    assert_eq!(ball_look(BallId::CUE).number, None);
}

#[test]
fn a_moment_between_two_snapshots_lies_on_the_line_between_them() {
    let mut later = ball(1, 1.0);
    later.orientation = DQuat::from_rotation_z(1.0);
    let (a, b) = (world(1.0, &[ball(1, 0.0)]), world(1.1, &[later]));
    let middle = between(&a, &b, 1.025);
    assert!((middle.balls[0].position.x - 0.25).abs() < 1e-9);
    assert!(middle.balls[0].orientation.angle_between(DQuat::from_rotation_z(0.25)) < 1e-6);
    // A ball that falls is still on the table until it has.
    let mut down = ball(1, 1.0);
    down.place = BallPlace::Pocketed;
    let falls = between(&a, &world(1.1, &[down]), 1.05);
    assert_eq!(falls.balls[0].place, BallPlace::OnTable);
}

#[test]
fn slow_motion_blends_ticks_and_the_usual_pace_shows_the_newest() {
    let state = |k: i32| Arc::new(world(0.001 * f64::from(k), &[ball(1, f64::from(k))]));
    let x = |head: &Playhead, now_s| head.shown(now_s).balls[0].position.x;
    let mut slow = Playhead::new(state(0), 0.1);
    slow.take(&state(1), 0.010);
    assert!((x(&slow, 0.015) - 0.5).abs() < 1e-6);
    assert_eq!(x(&slow, 0.5), 1.0);
    let mut usual = Playhead::new(state(0), 1.0);
    usual.take(&state(1), 0.010);
    assert_eq!(x(&usual, 0.010), 1.0);
}

#[test]
fn balls_in_pockets_and_in_the_hand_are_not_drawn() {
    let mut down = ball(3, 0.4);
    down.place = BallPlace::Pocketed;
    let world = world(0.0, &[ball(0, 0.0), ball(1, 0.2), down]);
    let ids = |view: &HumanView| -> Vec<u16> {
        let list = DrawList::new(&world, view, &Radii::default());
        list.balls.iter().map(|ball| ball.id.0).collect()
    };
    assert_eq!(ids(&HumanView::default()), [0, 1]);
    let placing = Some(DVec2::new(-0.7, 0.1));
    let view = HumanView { mode: HumanMode::Placing, placing, ..HumanView::default() };
    assert_eq!(ids(&view), [1]);
    let list = DrawList::new(&world, &view, &Radii::default());
    assert_eq!(list.ghosts.len(), 1);
}

#[test]
fn the_line_of_aim_ends_where_the_ghost_ball_begins() {
    let world = world(0.0, &[ball(0, 0.0), ball(1, 1.0)]);
    let ghost = Some(DVec3::new(1.0 - 2.0 * POOL_RADIUS_M, 0.0, POOL_RADIUS_M));
    let view = HumanView {
        mode: HumanMode::Aiming,
        ghost,
        object_heading: DVec2::X,
        ..HumanView::default()
    };
    let list = DrawList::new(&world, &view, &Radii::default());
    assert_eq!((list.lines.len(), list.ghosts.len()), (2, 1));
    assert!((f64::from(list.lines[0].to[0]) - (1.0 - 3.0 * POOL_RADIUS_M)).abs() < 1e-6);
    assert!((f64::from(list.lines[1].from[0]) - (1.0 + POOL_RADIUS_M)).abs() < 1e-6);
    // Watching, nobody aims.
    let view = HumanView { mode: HumanMode::Watching, ..view };
    assert!(DrawList::new(&world, &view, &Radii::default()).lines.is_empty());
}

fn turn(player: PlayerId, on_table: &[u16], groups: Groups) -> Event {
    let on_table: smallvec::SmallVec<[BallId; 16]> =
        on_table.iter().map(|id| BallId(*id)).collect();
    Event::Turn(Arc::new(Turn {
        player,
        shot: ShotKind::Normal,
        ball_in_hand: BallInHand::None,
        groups: Some(groups),
        legal_first: on_table.clone(),
        on_table,
        shot_number: 2,
        ..Turn::default()
    }))
}

fn fact(kind: FactKind) -> Event {
    Event::Fact(Fact { time_s: 1.0, kind })
}

fn struck() -> Event {
    fact(FactKind::CueBallStruck {
        ball: BallId::CUE,
        push: false,
        moving: false,
        player: None,
        miscue: false,
        position_m: DVec3::ZERO,
        normal_speed_m_s: 1.0,
    })
}

fn hud(board: &Scoreboard, view: &HumanView) -> Hud {
    let texts = Texts::new(Language::English).with_names("Ada", "Bo");
    Hud::new(board, view, &texts, &Words::new(Language::English))
}

#[test]
fn a_panel_shows_the_own_balls_that_are_left_and_then_the_8() {
    let mut board = Scoreboard::new(vec!["Ada".into(), "Bo".into()]);
    board.hear(&turn(PlayerId::ONE, &[1, 2, 8, 9, 15], Groups::Open));
    assert_eq!(hud(&board, &HumanView::default()).seats[0].remaining, Remaining::Open);
    let groups = Groups::assigned(PlayerId::ONE, Group::Solids);
    board.hear(&turn(PlayerId::ONE, &[1, 2, 8, 9, 15], groups));
    board.hear(&struck());
    board.hear(&fact(FactKind::BallPocketed {
        ball: BallId(2),
        pocket: PocketId::Hl,
        speed_m_s: 1.0,
    }));
    let seats = hud(&board, &HumanView::default()).seats;
    assert_eq!(seats[0].remaining, Remaining::Balls(vec![BallId(1), BallId::EIGHT]));
    assert_eq!(seats[1].remaining, Remaining::Balls([9, 15, 8].map(BallId).to_vec()));
    assert!(seats[0].is_at_table && !seats[1].is_at_table);
    assert_eq!((&*seats[0].plays, &*seats[1].plays), ("solids", "stripes"));
    board.hear(&turn(PlayerId::ONE, &[8, 9], groups));
    assert_eq!(hud(&board, &HumanView::default()).seats[0].plays, "the 8");
}

#[test]
fn a_foul_says_why_in_a_sentence_until_the_next_stroke() {
    let mut board = Scoreboard::new(vec!["Ada".into(), "Bo".into()]);
    board.hear(&turn(PlayerId::ONE, &[1, 8], Groups::Open));
    board.hear(&Event::Verdict(Arc::new(Verdict {
        player: Some(PlayerId::ONE),
        fouls: smallvec![Foul::Scratch],
        turn: TurnAfter::Pass,
        next_player: Some(PlayerId::TWO),
        ball_in_hand: BallInHand::Anywhere,
        ..Verdict::default()
    })));
    board.hear(&turn(PlayerId::TWO, &[1, 8], Groups::Open));
    let shown = hud(&board, &HumanView::default());
    assert!(shown.is_foul);
    assert_eq!(
        shown.message,
        [
            "Foul: the cue ball was pocketed. Ball in hand for Bo.",
            "The cue ball must stay on the table, but it went down in a pocket."
        ]
    );
    board.hear(&struck());
    let shown = hud(&board, &HumanView::default());
    assert!(!shown.is_foul && shown.message.is_empty());
    assert_eq!(shown.hint, "Balls are rolling. Hold f: faster.");
}

#[test]
fn what_is_wrong_with_the_haptic_device_is_told_until_it_is_right() {
    let mut board = Scoreboard::new(vec!["Ada".into()]);
    let health = |health| Event::Health(Arc::new(health));
    let lines = |board: &Scoreboard| hud(board, &HumanView::default()).message;
    board.hear(&health(Health::Refused {
        actor: "haptic".into(),
        asked: "locked memory".into(),
        reason: "no".into(),
        remedy: "ask nicely".into(),
    }));
    let actor = STYLUS.to_string();
    board.hear(&health(Health::ActorFailed { actor: actor.clone(), reason: "unplugged".into() }));
    let told = [
        "The haptic device is gone: the mouse strikes.",
        "Force feedback: locked memory was refused (no); ask nicely.",
    ];
    assert_eq!(lines(&board), told);
    board.hear(&struck());
    assert_eq!(lines(&board), told[..1]);
    board.hear(&health(Health::ActorRestarted { actor }));
    assert!(lines(&board).is_empty());
    let holding = HumanView { mode: HumanMode::HoldingStylus, ..HumanView::default() };
    assert!(hud(&board, &holding).hint.starts_with("Stylus: hold the front button"));
}

#[test]
fn what_the_computer_does_and_who_won_is_told() {
    let mut board = Scoreboard::new(vec!["Ada".into(), "Bo".into()]);
    board.hear(&turn(PlayerId::TWO, &[8], Groups::Open));
    board.hear(&Event::Player(PlayerReport { player: PlayerId::TWO, state: PlayerState::Lazing }));
    assert_eq!(hud(&board, &HumanView::default()).hint, "Bo thinks. Hold f: less waiting.");
    let paused = HumanView { mode: HumanMode::Paused, ..HumanView::default() };
    assert_eq!(hud(&board, &paused).banner.unwrap().0, "Paused");
    board.hear(&Event::Verdict(Arc::new(Verdict {
        player: Some(PlayerId::TWO),
        legal: true,
        turn: TurnAfter::End,
        winner: Some(PlayerId::TWO),
        ..Verdict::default()
    })));
    assert_eq!(hud(&board, &HumanView::default()).banner.unwrap().0, "Bo wins");
}

#[test]
fn the_strength_and_the_tip_are_shown_while_stroking() {
    let board = Scoreboard::new(vec!["Ada".into()]);
    let mut view = HumanView { mode: HumanMode::Stroking, ..HumanView::default() };
    view.strength_m_s = 4.0;
    view.aim.side_offset = 0.25;
    let shown = hud(&board, &view);
    let gauge = shown.strength.unwrap();
    assert!((gauge.fill - 0.4).abs() < 1e-9);
    assert_eq!(gauge.text, "4.0 m/s");
    assert_eq!(shown.tip.unwrap().side, 0.25);
    assert_eq!(hud(&board, &HumanView::default()).tip, None);
}

#[test]
fn both_languages_have_the_same_words_and_controls() {
    let [english, german] = Language::ALL.map(Words::new);
    assert!(english.keys().eq(german.keys()));
    for of in [HelpOf::Keys, HelpOf::Pad, HelpOf::Felt, HelpOf::Menu] {
        let [english, german] = [&english, &german].map(|words| words.help(of));
        assert_eq!(english.len(), german.len());
        assert!(english.len() > 8);
        for (keys, does) in english.into_iter().chain(german) {
            let both = [keys, does];
            // Every key in it has a name, and every action a key.
            assert!(both.iter().all(|text| !text.is_empty() && !text.contains(['{', '–', '_'])));
        }
    }
}
