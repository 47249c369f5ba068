//! Pictures without a window, at small sizes.

use glam::DVec3;
use hapticbillard::events::FactSet;
use hapticbillard::ids::BallId;
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{BallInstance, DrawList, Radii, ball_look};
use hapticbillard::table::Table;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::renderer::{number_layer, pixels};

const SIZE: (u32, u32) = (320, 200);

/// The picture, or nothing where this machine cannot draw.
fn picture(table: &Table, list: &DrawList) -> Option<Vec<[u8; 4]>> {
    match pixels(table, list, SIZE) {
        Ok(pixels) => Some(pixels),
        Err(error) => {
            println!("skipped: {error}");
            None
        }
    }
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
    let layer = number_layer(7);
    let side = 128;
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
