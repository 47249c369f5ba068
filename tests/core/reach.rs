//! Where in a picture lies what moves.

use glam::{DVec3, Mat4, Vec2, Vec3, Vec4};
use hapticbillard::cue::{CUE_LENGTH_M, CuePose};
use hapticbillard::ids::BallId;
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{
    BallInstance, DrawList, Line, Patch, Radii, ball_look, cue_shadow, patches, shadow_reach_m,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SIZE: (u32, u32) = (640, 400);
const RADIUS_M: f32 = 0.0286;
const BED: Vec2 = Vec2::new(1.27, 0.635);

fn nothing() -> DrawList {
    DrawList::new(&Snapshot::default(), &HumanView::default(), &Radii::default())
}

/// What OpenGL is told, with the eye's near and far plane.
fn matrix(camera: &CameraPose) -> Mat4 {
    let (near, far) = (0.05, 25.0);
    let eye = camera.eye.as_vec3();
    let ahead = (camera.target.as_vec3() - eye).normalize();
    let right = ahead.cross(Vec3::Z).normalize();
    let up = right.cross(ahead);
    let tall = 1.0 / (0.5 * camera.field_of_view_rad as f32).tan();
    let view = Mat4::from_cols(right.extend(0.0), up.extend(0.0), (-ahead).extend(0.0), Vec4::W)
        .transpose()
        * Mat4::from_translation(-eye);
    let depth = near - far;
    Mat4::from_cols(
        Vec4::X * tall / 1.6,
        Vec4::Y * tall,
        Vec4::new(0.0, 0.0, (far + near) / depth, -1.0),
        Vec4::new(0.0, 0.0, 2.0 * far * near / depth, 0.0),
    ) * view
}

/// Where a point is in the picture, if the eye sees it there.
fn place(matrix: Mat4, at: Vec3) -> Option<Vec2> {
    let at = matrix * at.extend(1.0);
    let place = at.truncate().truncate() / at.w;
    (0.05 < at.w && place.abs().max_element() < 1.0).then_some(place)
}

fn holds(patches: &[Patch], place: Vec2) -> bool {
    patches.iter().any(|patch| {
        Vec2::from(patch.least).cmple(place).all() && place.cmple(Vec2::from(patch.most)).all()
    })
}

fn share(patches: &[Patch]) -> f32 {
    let area = |patch: &Patch| {
        let side = Vec2::from(patch.most) - Vec2::from(patch.least);
        0.25 * side.x * side.y
    };
    patches.iter().map(area).sum()
}

fn ball(position: Vec3) -> BallInstance {
    BallInstance {
        id: BallId(3),
        look: ball_look(BallId(3)),
        position: position.to_array(),
        orientation: [0.0, 0.0, 0.0, 1.0],
        radius_m: RADIUS_M,
    }
}

#[test]
fn whatever_moves_lies_in_a_patch() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let mut any = |least: Vec3, most: Vec3| {
        least + (most - least) * Vec3::from_array(std::array::from_fn(|_| random.random()))
    };
    let (low, high) = (Vec3::new(-1.27, -0.635, RADIUS_M), Vec3::new(1.27, 0.635, 0.2));
    let (mut seen, mut small) = (0, 0);
    for _ in 0..2_000 {
        let eye = any(Vec3::new(-3.0, -2.0, 0.1), Vec3::new(3.0, 2.0, 2.5)).as_dvec3();
        let target = any(low, high).as_dvec3();
        let camera = CameraPose { eye, target, ..CameraPose::default() };
        let matrix = matrix(&camera);
        let mut list = nothing();
        let middle = any(low, high);
        list.balls.push(ball(middle));
        let direction = (any(Vec3::NEG_ONE, Vec3::ONE) - Vec3::Z * 0.3).as_dvec3().normalize();
        let tip = any(low, high).as_dvec3();
        list.cue = Some(CuePose { tip, velocity: DVec3::ZERO, direction, solid: false });
        let (from, to) = (any(low, high), any(low, high));
        list.lines.push(Line {
            from: from.to_array(),
            to: to.to_array(),
            half_width_m: 0.002,
            colour: [1.0; 4],
        });
        let patches = patches(&list, BED, matrix, SIZE);
        let area = share(&patches);
        assert!(area <= 1.0001, "patches lie on each other: {area}");
        small += i32::from(area < 0.5);
        let dark = cue_shadow(list.cue.as_ref().unwrap(), BED);
        let reach = shadow_reach_m(RADIUS_M, middle.z).unwrap();
        for _ in 0..20 {
            let way = any(Vec3::NEG_ONE, Vec3::ONE).normalize_or_zero();
            let along: f32 = any(Vec3::ZERO, Vec3::ONE).x;
            let cloth =
                (middle.truncate() + any(Vec3::NEG_ONE, Vec3::ONE).truncate() * reach).extend(0.0);
            let shaft = (tip - direction * CUE_LENGTH_M * f64::from(along)).as_vec3();
            // Somewhere in the area that the cue can darken.
            let shares: Vec<f32> = dark.iter().map(|_| any(Vec3::ZERO, Vec3::ONE).x).collect();
            let sum: f32 = shares.iter().sum();
            let under = dark.iter().zip(&shares).map(|(at, share)| *at * *share / sum);
            if !dark.is_empty() {
                let at = under.sum::<Vec2>().extend(0.0);
                if let Some(place) = place(matrix, at) {
                    assert!(holds(&patches, place), "{at} at {place}, eye {eye}");
                }
            }
            for at in [middle + way * RADIUS_M, cloth, shaft, from.lerp(to, along)] {
                if let Some(place) = place(matrix, at) {
                    seen += 1;
                    assert!(holds(&patches, place), "{at} at {place}, eye {eye}");
                }
            }
        }
    }
    assert!(seen > 50_000 && small > 500, "{seen} points, {small} small pictures");
}

#[test]
fn where_nothing_moves_there_is_no_patch() {
    let camera = CameraPose::default();
    assert_eq!(patches(&nothing(), BED, matrix(&camera), SIZE), []);
    let mut list = nothing();
    // Far behind the eye.
    list.balls.push(ball(camera.eye.as_vec3() * 3.0));
    assert_eq!(patches(&list, BED, matrix(&camera), SIZE), []);
    // A lonely ball takes little.
    list.balls = vec![ball(Vec3::new(0.0, 0.0, RADIUS_M))];
    let found = patches(&list, BED, matrix(&camera), SIZE);
    assert!((0.0001..0.06).contains(&share(&found)), "{}", share(&found));
}

#[test]
fn what_reaches_up_to_the_eye_may_be_anywhere() {
    let camera = CameraPose::default();
    let mut list = nothing();
    let ahead = (camera.target - camera.eye).normalize() * 0.06;
    list.balls.push(ball((camera.eye + ahead).as_vec3()));
    assert_eq!(patches(&list, BED, matrix(&camera), SIZE), [Patch::WHOLE]);
    list.balls = vec![ball(Vec3::NAN)];
    assert_eq!(patches(&list, BED, matrix(&camera), SIZE), [Patch::WHOLE]);
}

#[test]
fn a_cue_darkens_no_more_than_the_bed() {
    let mut cue = CuePose {
        tip: DVec3::new(0.0, 0.0, 0.05),
        velocity: DVec3::ZERO,
        direction: DVec3::X,
        solid: false,
    };
    // 0.3 m beside it and before it; behind it the bed ends.
    let area = cue_shadow(&cue, BED);
    let [least, most] = [Vec2::min, Vec2::max].map(|of| area.iter().copied().reduce(of).unwrap());
    assert!(least.distance(Vec2::new(-1.27, -0.3)) < 1e-5, "{least}");
    assert!(most.distance(Vec2::new(0.3, 0.3)) < 1e-5, "{most}");
    // Without a table it is as long as the cue.
    let area = cue_shadow(&cue, Vec2::ZERO);
    assert!((area.iter().map(|at| at.x).fold(0.0, f32::min) + 1.77).abs() < 1e-5);
    // Outside; upright; nowhere.
    cue.tip.y = 2.0;
    assert_eq!(cue_shadow(&cue, BED), []);
    cue.direction = DVec3::NEG_Z;
    assert!(cue_shadow(&cue, BED).len() < 3);
    cue.tip = DVec3::NAN;
    cue_shadow(&cue, BED);
}
