//! Pictures without a window, at small sizes.

mod options;
mod references;
mod still;

use glam::{DVec2, DVec3};
use hapticbillard::events::{FactSet, IdeaKind, Insight, Prospect, Way, WayEnd};
use hapticbillard::ids::{BallId, PlayerId, PocketId};
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::physics::Snapshot;
use hapticbillard::picture::{PictureSettings, Smoothing};
use hapticbillard::renderer::{
    BallInstance, DrawList, Hud, Radii, ThoughtsPanel, Words, ball_look, draw_thoughts,
};
use hapticbillard::rules::{Language, Texts};
use hapticbillard::table::Table;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::renderer::{Studio, number_layer};
use smallvec::smallvec;
use std::sync::Arc;

const SIZE: (u32, u32) = (320, 200);

/// The picture, or nothing where this machine cannot draw.
fn picture(table: &Table, list: &DrawList) -> Option<Vec<[u8; 4]>> {
    Some(studio(table)?.pixels(list, &smooth(), SIZE).unwrap())
}

/// Where pictures are made, or nothing where this machine cannot draw.
fn studio(table: &Table) -> Option<Studio> {
    Studio::new(&Arc::new(table.clone())).inspect_err(|error| println!("skipped: {error}")).ok()
}

/// As shipped, with smooth edges.
fn smooth() -> PictureSettings {
    PictureSettings { smooth: Smoothing::On, ..PictureSettings::default() }
}

fn at(pixels: &[[u8; 4]], x: u32, y: u32) -> [i32; 3] {
    let [r, g, b, _] = pixels[(y * SIZE.0 + x) as usize];
    [r, g, b].map(i32::from)
}

fn from_above(eye_z: f64, balls: Vec<BallInstance>) -> DrawList {
    let camera = CameraPose {
        eye: DVec3::new(0.0, -0.01, eye_z),
        target: DVec3::ZERO,
        ..CameraPose::default()
    };
    let view = HumanView { camera, ..HumanView::default() };
    let mut list = DrawList::new(&Snapshot::default(), &view, &Radii::default());
    list.balls = balls;
    list
}

fn lying(id: u16, orientation: [f32; 4]) -> BallInstance {
    BallInstance {
        id: BallId(id),
        look: ball_look(BallId(id)),
        position: [0.0, 0.0, 0.028_575],
        orientation,
        radius_m: 0.028_575,
    }
}

#[test]
fn the_cloth_is_green_and_the_cue_ball_white() {
    let table = Table::preset("pool-9ft").unwrap();
    let list = from_above(0.5, vec![lying(0, [0.0, 0.0, 0.0, 1.0])]);
    let Some(pixels) = picture(&table, &list) else { return };
    let [r, g, b] = at(&pixels, 20, 180);
    assert!(g > r + 30 && g > b + 15, "the cloth is {r} {g} {b}");
    let [r, g, b] = at(&pixels, 168, 106);
    assert!(r.min(g).min(b) > 120 && (r - b).abs() < 60, "the cue ball is {r} {g} {b}");
    // Beside the ball it is darker than away from it.
    let near = at(&pixels, 186, 100)[1];
    assert!(near + 10 < at(&pixels, 20, 100)[1], "no shadow: {near}");
}

#[test]
fn the_same_scene_gives_the_same_picture() {
    let stage = Stage::new(&load_scene("break_shot").unwrap(), "break_shot").unwrap();
    let mut simulation = stage.simulation().unwrap();
    simulation.advance(0.4, FactSet::NONE, &mut Vec::new()).unwrap();
    let world = simulation.snapshot(0.4);
    let list = DrawList::new(&world, &HumanView::default(), &Radii::default());
    let Some(first) = picture(&stage.table, &list) else { return };
    assert!(first == picture(&stage.table, &list).unwrap());
    let colours: std::collections::BTreeSet<_> = first.iter().collect();
    assert!(colours.len() > 500, "only {} colours", colours.len());
}

#[test]
fn numbers_are_not_mirrored_and_stand_upright() {
    let table = Table::preset("pool-9ft").unwrap();
    // The disc at +x upwards; its own z away from the eye's feet, that is up in the picture. A
    // quarter turn about −y brings x up and z to −x, then a quarter turn about −z.
    let half = 0.5f32.sqrt();
    let up =
        glam::Quat::from_xyzw(0.0, 0.0, -half, half) * glam::Quat::from_xyzw(0.0, -half, 0.0, half);
    assert!((up * glam::Vec3::X).distance(glam::Vec3::Z) < 1e-5);
    assert!((up * glam::Vec3::Z).distance(glam::Vec3::Y) < 1e-5);
    let list = from_above(0.24, vec![lying(7, up.to_array())]);
    let Some(pixels) = picture(&table, &list) else { return };
    // The ink of the picture against that of the texture, as it is and turned over.
    let side = 128;
    let layer = number_layer(7, side as u32);
    let (mut plain, mut mirrored, mut upside) = (0, 0, 0);
    for y in -12i32..=12 {
        for x in -12i32..=12 {
            let [r, g, b] = at(&pixels, (160 + x) as u32, (97 + y) as u32);
            let is_ink = r + g + b < 330;
            // About 19 pixels are the disc's radius; its middle lies above the picture's.
            let texel = |x: i32, y: i32| {
                let (u, v) = (64 + x * 64 / 19, 64 + y * 64 / 19);
                layer[(v * side + u) as usize] > 128
            };
            plain += i32::from(is_ink == texel(x, y));
            mirrored += i32::from(is_ink == texel(-x, y));
            upside += i32::from(is_ink == texel(x, -y));
        }
    }
    assert!(plain > mirrored + 30 && plain > upside + 30, "{plain} {mirrored} {upside}");
}

fn way(from: DVec2, to: DVec2, leads_to: WayEnd, is_free: bool) -> Way {
    Way { from, to, leads_to, is_free, is_chosen: false }
}

/// Two balls, two ways each; the 3 is played.
fn insight() -> Insight {
    let (cue_ball, pocket) = (DVec2::new(-0.6, -0.2), DVec2::new(1.2, 0.57));
    let shot = |ball: u16, at: DVec2, chance: f64, is_chosen: bool| Prospect {
        kind: IdeaKind::Pot,
        ball: Some(BallId(ball)),
        pocket: Some(PocketId::Fl),
        ghost: at - (pocket - at).normalize() * 0.057,
        ways: smallvec![
            Way { is_chosen, ..way(cue_ball, at, WayEnd::Ball(BallId(ball)), true) },
            Way { is_chosen, ..way(at, pocket, WayEnd::Pocket(BallId(ball), PocketId::Fl), true) },
        ],
        chance: Some(chance),
        legal: Some(0.98),
        value: Some(chance * 0.8),
        samples: 64,
        is_chosen,
    };
    let (three, six) = (DVec2::new(0.1, 0.1), DVec2::new(0.5, -0.3));
    Insight {
        player: PlayerId::ONE,
        cue_ball,
        ways: vec![
            way(cue_ball, six, WayEnd::Ball(BallId(6)), true),
            way(six, DVec2::new(1.2, -0.57), WayEnd::Pocket(BallId(6), PocketId::Fr), false),
        ],
        prospects: vec![shot(6, six, 0.31, false), shot(3, three, 0.87, true)],
    }
}

#[test]
fn chances_stand_on_the_table_and_their_panel_beside_it() {
    let table = Table::preset("pool-9ft").unwrap();
    let camera = CameraPose::above(2.54).aside(0.43);
    let view = HumanView { camera, ..HumanView::default() };
    let mut list = DrawList::new(&Snapshot::default(), &view, &Radii::default());
    let insight = insight();
    draw_thoughts(&insight, &Radii::default(), &mut list);
    let (texts, words) = (Texts::new(Language::English), Words::new(Language::English));
    let panel = ThoughtsPanel::new(&insight, "Ann", &texts, &words);
    let hud = Hud { thoughts: Some(panel), ..Hud::default() };
    let Some(mut studio) = studio(&table) else { return };
    let plain = DrawList { labels: Vec::new(), ..list.clone() };
    let with = studio.written(&list, &hud, &smooth(), SIZE).unwrap();
    let without = studio.pixels(&plain, &smooth(), SIZE).unwrap();
    let differ = |x: u32, y: u32| at(&with, x, y) != at(&without, x, y);
    // Where the label of the 3 stands, by the same perspective as everything on the table.
    let [x, y, z] = list.labels.iter().find(|label| label.is_bold).unwrap().at.map(f64::from);
    let aspect = f64::from(SIZE.0) / f64::from(SIZE.1);
    let [right, down] = camera.place_of(DVec3::new(x, y, z), aspect).unwrap();
    let (x, y) = ((right * f64::from(SIZE.0)) as u32, (down * f64::from(SIZE.1)) as u32);
    assert!((x - 3..x + 3).any(|x| differ(x, y)), "no label at {x}, {y}");
    assert!(differ(SIZE.0 - 30, 30), "no panel");
    assert!(!differ(20, SIZE.1 - 20), "written where nothing is");
}

#[test]
fn a_billiard_table_stands_in_a_room_and_a_course_on_plain_ground() {
    let mut lists = Vec::new();
    for scene in ["eight_ball", "minigolf"] {
        let stage = Stage::new(&load_scene(scene).unwrap(), scene).unwrap();
        let camera = CameraPose {
            eye: DVec3::new(-3.5, -2.0, 0.4),
            target: DVec3::new(1.0, 1.0, 0.9),
            ..CameraPose::default()
        };
        let view = HumanView { camera, ..HumanView::default() };
        let list = DrawList::new(&Snapshot::default(), &view, &Radii::default());
        let Some(pixels) = picture(&stage.table, &list) else { return };
        lists.push(pixels);
    }
    // Above the horizon: bricks, shelves, lamps; or nothing at all.
    let colours = |pixels: &[[u8; 4]]| {
        let upper = &pixels[..(SIZE.0 * SIZE.1 / 4) as usize];
        upper.iter().collect::<std::collections::BTreeSet<_>>().len()
    };
    assert!(1000 < colours(&lists[0]), "{} colours", colours(&lists[0]));
    assert!(colours(&lists[1]) < 10, "{} colours", colours(&lists[1]));
}

#[test]
fn neither_lamp_nor_vault_hides_the_table_from_above() {
    for name in ["pool-9ft", "snooker-12ft"] {
        let table = Table::preset(name).unwrap();
        let length_m = table.bed.unwrap().length_m;
        let camera = CameraPose::above(length_m);
        let view = HumanView { camera, ..HumanView::default() };
        let list = DrawList::new(&Snapshot::default(), &view, &Radii::default());
        let Some(pixels) = picture(&table, &list) else { return };
        for x in (60..260).step_by(10) {
            let [r, g, b] = at(&pixels, x, 105);
            assert!(g > r + 20 && g > b + 10, "{name}: {r} {g} {b} at {x}");
        }
    }
}
