//! Every option changes the pixels that it should, and no others.

use super::{SIZE, lying, studio};
use glam::{DVec2, DVec3, Quat, Vec3};
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::physics::Snapshot;
use hapticbillard::picture::{
    Environment, PictureOption, PictureSettings, Shadows, Smoothing, Stereo,
};
use hapticbillard::renderer::{BallInstance, DrawList, GhostBall, Radii};
use hapticbillard::table::Table;
use hapticbillard_actors::renderer::Studio;

const RADIUS_M: f32 = 0.028_575;

fn at(id: u16, x: f32, y: f32) -> BallInstance {
    let turn = Quat::from_rotation_z(0.7) * Quat::from_rotation_y(-0.9);
    BallInstance { position: [x, y, RADIUS_M], ..lying(id, turn.to_array()) }
}

/// Three balls from near, two of which touch; a cushion above, none of the room.
fn close() -> DrawList {
    let camera = CameraPose {
        eye: DVec3::new(0.0, -0.02, 0.62),
        target: DVec3::new(0.0, 0.2, 0.0),
        ..CameraPose::default()
    };
    let view = HumanView { camera, ..HumanView::default() };
    let mut list = DrawList::new(&Snapshot::default(), &view, &Radii::default());
    list.balls = vec![at(3, -0.12, 0.18), at(10, -0.063, 0.18), at(0, 0.12, 0.25)];
    list
}

/// All that can be there, but smooth edges.
fn rich() -> PictureSettings {
    PictureSettings {
        triangles: 5120,
        texture: 1024,
        environment: Environment::All,
        normal_map: true,
        cloth_detail: true,
        level_of_detail: false,
        smooth: Smoothing::Off,
        ..PictureSettings::default()
    }
}

struct Shot {
    table: Table,
    studio: Studio,
    list: DrawList,
    plain: Vec<[u8; 4]>,
}

impl Shot {
    fn new(list: DrawList) -> Option<Self> {
        let table = Table::preset("pool-9ft").unwrap();
        let mut studio = studio(&table)?;
        let plain = studio.pixels(&list, &rich(), SIZE).unwrap();
        Some(Shot { table, studio, list, plain })
    }

    /// The pixels that are otherwise with other settings.
    fn changed(&mut self, settings: &PictureSettings) -> Vec<(u32, u32)> {
        let other = self.studio.pixels(&self.list, settings, SIZE).unwrap();
        let differ = |i: &usize| self.plain[*i] != other[*i];
        let place = |i: usize| (i as u32 % SIZE.0, i as u32 / SIZE.0);
        (0..other.len()).filter(differ).map(place).collect()
    }

    /// How far a pixel is from the nearest ball, in its radii on the screen.
    fn away(&self, (x, y): (u32, u32)) -> f64 {
        let camera = &self.list.camera;
        let aspect = f64::from(SIZE.0) / f64::from(SIZE.1);
        let on_screen = |at: DVec3| {
            let [right, down] = camera.place_of(at, aspect).unwrap();
            DVec2::new(right * f64::from(SIZE.0), down * f64::from(SIZE.1))
        };
        let ahead = (camera.target - camera.eye).normalize();
        let aside = ahead.cross(DVec3::Z).normalize() * f64::from(RADIUS_M);
        let away = |ball: &BallInstance| {
            let centre = Vec3::from(ball.position).as_dvec3();
            let (middle, rim) = (on_screen(centre), on_screen(centre + aside));
            let here = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            here.distance(middle) / rim.distance(middle)
        };
        self.list.balls.iter().map(away).fold(f64::INFINITY, f64::min)
    }

    /// At least so many pixels change, all of them within so many radii.
    #[track_caller]
    fn check(&mut self, settings: PictureSettings, least: usize, within: f64) {
        let changed = self.changed(&settings);
        assert!(changed.len() >= least, "only {} pixels change", changed.len());
        for pixel in changed {
            let away = self.away(pixel);
            assert!(away < within, "{pixel:?} changes, {away:.2} radii from any ball");
        }
    }
}

/// A ball's edge, and what a perspective adds to it.
const ON_BALLS: f64 = 1.12;

#[test]
fn what_touches_balls_changes_balls_only() {
    let Some(mut shot) = Shot::new(close()) else { return };
    shot.check(PictureSettings { triangles: 320, ..rich() }, 10, ON_BALLS);
    shot.check(PictureSettings { texture: 64, ..rich() }, 10, ON_BALLS);
    shot.check(PictureSettings { environment: Environment::Room, ..rich() }, 40, ON_BALLS);
    shot.check(PictureSettings { environment: Environment::Off, ..rich() }, 300, ON_BALLS);
    shot.check(PictureSettings { normal_map: false, ..rich() }, 40, ON_BALLS);
    shot.check(PictureSettings { level_of_detail: true, ..rich() }, 40, ON_BALLS);
}

#[test]
fn marks_change_marked_balls_only() {
    let Some(mut shot) = Shot::new(close()) else { return };
    let mut radii = Radii::default();
    radii.mark(true);
    let plain = shot.list.clone();
    for ball in &mut shot.list.balls {
        ball.look = radii.look(ball.id);
    }
    shot.check(rich(), 100, ON_BALLS);
    // The cue ball has no number, and only reflects the others.
    let cue_ball = plain.balls[2].position;
    let changed = shot.changed(&PictureSettings { environment: Environment::Off, ..rich() });
    shot.list.balls.retain(|ball| ball.position == cue_ball);
    shot.plain = shot.studio.pixels(&plain, &rich(), SIZE).unwrap();
    assert!(changed.iter().any(|pixel| shot.away(*pixel) > 2.0));
}

#[test]
fn shadows_change_the_surroundings_of_balls_only() {
    let Some(mut shot) = Shot::new(close()) else { return };
    for shadows in [Shadows::Off, Shadows::Maps, Shadows::Volumes] {
        shot.check(PictureSettings { shadows, ..rich() }, 500, 6.0);
    }
}

#[test]
fn the_nap_of_the_cloth_changes_no_ball() {
    let Some(mut shot) = Shot::new(close()) else { return };
    let changed = shot.changed(&PictureSettings { cloth_detail: false, ..rich() });
    assert!(changed.len() > SIZE.0 as usize * SIZE.1 as usize / 3, "{}", changed.len());
    // The outermost pixels of a ball are cloth in part.
    let on_balls = changed.iter().filter(|pixel| shot.away(**pixel) < 0.9).count();
    assert_eq!(on_balls, 0);
}

#[test]
fn what_is_not_of_this_picture_changes_nothing() {
    let Some(mut shot) = Shot::new(close()) else { return };
    for option in [PictureOption::FrameLimit, PictureOption::HudScale] {
        for place in 0..option.values().len() {
            let mut settings = rich();
            settings.put(option, place);
            assert_eq!(shot.changed(&settings), [], "{option:?}");
        }
    }
    // Nobody had to draw anything but this table.
    assert!(shot.table.bed.is_some());
}

#[test]
fn resolution_and_smooth_edges_keep_the_picture_as_a_whole() {
    let Some(mut shot) = Shot::new(close()) else { return };
    let mean = |pixels: &[[u8; 4]]| {
        let sum: u64 = pixels.iter().flat_map(|p| &p[..3]).map(|c| u64::from(*c)).sum();
        sum as f64 / pixels.len() as f64
    };
    for settings in [
        PictureSettings { render_scale: 50, ..rich() },
        PictureSettings { smooth: Smoothing::On, ..rich() },
    ] {
        let other = shot.studio.pixels(&shot.list, &settings, SIZE).unwrap();
        assert!(other != shot.plain);
        let (a, b) = (mean(&other), mean(&shot.plain));
        assert!((a / b - 1.0).abs() < 0.02, "{a} {b}");
    }
}

#[test]
fn red_is_for_the_left_eye_and_cyan_for_the_right_one() {
    let Some(mut shot) = Shot::new(close()) else { return };
    let mut seen = |stereo, list: &DrawList| {
        let settings = PictureSettings { stereo, ..rich() };
        shot.studio.pixels(list, &settings, SIZE).unwrap()
    };
    let list = close();
    let [off, left, middle, right] =
        [Stereo::Off, Stereo::Left, Stereo::Middle, Stereo::Right].map(|s| seen(s, &list));
    let cyan = |p: &[u8; 4]| [p[1], p[2]];
    let near = |a: [u8; 2], b: [u8; 2]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) < 3);
    let same = |a: &[[u8; 4]], b: &[[u8; 4]], part: &dyn Fn(&[u8; 4]) -> [u8; 2]| {
        a.iter().zip(b).filter(|(a, b)| near(part(a), part(b))).count() as f64 / a.len() as f64
    };
    // Where the right eye leads, its picture is the one without glasses.
    assert!(same(&right, &off, &cyan) > 0.999);
    assert!(same(&left, &off, &cyan) < 0.995 && same(&middle, &off, &cyan) < 0.995);
    // Where the left eye leads, red is the brightness of the picture without glasses.
    let brightness = |p: &[u8; 4]| {
        let [r, g, b] = [p[0], p[1], p[2]].map(f32::from);
        let bright = (0.4 * r + 0.45 * g + 0.15 * b).round() as u8;
        [bright, bright]
    };
    let fits = left.iter().zip(&off).filter(|(a, b)| near([a[0]; 2], brightness(b))).count();
    assert!(fits as f64 > 0.999 * left.len() as f64, "{fits} of {}", left.len());
}

#[test]
fn overlapping_shadows_are_darker() {
    // Between two balls that stand apart, where shadows of different lamps meet, and beside one.
    let mut list = close();
    list.camera.eye = DVec3::new(0.0, -0.02, 0.5);
    list.camera.target = DVec3::ZERO;
    // From the lamp at the left and the one at the right, both fall on the place between them.
    list.balls = vec![at(0, -0.045, 0.0), at(9, 0.045, 0.0)];
    let Some(mut shot) = Shot::new(list.clone()) else { return };
    let mut dark = |list: &DrawList, shadows| {
        let settings = PictureSettings { shadows, cloth_detail: false, ..rich() };
        let pixels = shot.studio.pixels(list, &settings, SIZE).unwrap();
        let [_, g, _, _] = pixels[(SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize];
        i32::from(g)
    };
    for shadows in [Shadows::Soft, Shadows::Maps, Shadows::Volumes] {
        let bare = DrawList { balls: Vec::new(), ..list.clone() };
        let one = DrawList { balls: vec![list.balls[0]], ..list.clone() };
        let [none, one, both] = [&bare, &one, &list].map(|list| dark(list, shadows));
        assert!(none > one + 4 && one > both + 4, "{shadows:?}: {none} {one} {both}");
    }
}

#[test]
fn see_through_balls_and_thirty_more_are_no_obstacle() {
    let mut list = close();
    let ghost = GhostBall { position: [0.0, 0.1, RADIUS_M], radius_m: RADIUS_M, colour: [1.0; 4] };
    list.ghosts.push(ghost);
    list.balls = (0..70)
        .map(|i| at(i % 16, 0.06 * (f32::from(i % 10) - 5.0), 0.06 * f32::from(i / 10)))
        .collect();
    let Some(mut shot) = Shot::new(list) else { return };
    for shadows in [Shadows::Off, Shadows::Maps, Shadows::Volumes] {
        assert!(!shot.changed(&PictureSettings { shadows, ..rich() }).is_empty());
    }
}
