//! Baked light against what is known of it.

use glam::{DVec3, Vec3};
use hapticbillard::room::{Baker, Finish, Pass, Surfaces};

fn bake(surfaces: &Surfaces, samples: u32, passes: usize) -> Baker<'_> {
    let mut baker = Baker::new(surfaces, samples);
    for pass in Pass::all().take(passes) {
        let light: Vec<(Vec3, f32)> = (0..baker.texels()).map(|k| baker.light(pass, k)).collect();
        baker.take(pass, &light);
    }
    baker
}

/// A cube of one metre, seen from inside.
fn box_of(finish: Finish) -> Surfaces {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let walls = [
        [DVec3::ZERO, x, y],
        [z, y, x],
        [DVec3::ZERO, y, z],
        [x, z, y],
        [DVec3::ZERO, z, x],
        [y, x, z],
    ];
    Surfaces::of_quads(&walls.map(|wall| (wall, finish)), 8.0)
}

/// In a closed room all of whose walls shine with `L` and throw back the share `a`, every wall
/// gets `L (1 + a + a² + …)`, as far as bounces are counted: L / (1 − a) in the end.
#[test]
fn a_furnace_is_as_bright_as_its_series() {
    for albedo in [0.2, 0.5, 0.8] {
        let surfaces = box_of(Finish::grey(albedo, 0.5));
        let baker = bake(&surfaces, 256, 5);
        let expected: f32 = (0..5).map(|k| 0.5 * albedo.powi(k)).sum();
        let (mut sum, mut worst) = (0.0, 0.0f32);
        for k in 0..baker.texels() {
            let [x, y] = baker.place(k);
            let light = baker.total(x, y).x;
            sum += light;
            // In the edges a lamp begins where the texel is, and few samples see it.
            let chart = surfaces.charts.iter().find(|chart| {
                (chart.x..chart.x + chart.columns).contains(&x)
                    && (chart.y..chart.y + chart.rows).contains(&y)
            });
            let chart = chart.unwrap();
            let is_inner = |at: u32, from: u32, count: u32| from + 1 < at && at + 2 < from + count;
            if is_inner(x, chart.x, chart.columns) && is_inner(y, chart.y, chart.rows) {
                worst = worst.max((light / expected - 1.0).abs());
            }
        }
        let mean = sum / baker.texels() as f32;
        println!("albedo {albedo}: mean {mean:.4}, known {expected:.4}, worst inside {worst:.4}");
        assert!((mean / expected - 1.0).abs() < 0.01, "albedo {albedo}: {mean}, not {expected}");
        assert!(worst < 0.1, "albedo {albedo}: {worst}");
    }
}

/// What a surface gets from a rectangle parallel to it, one of whose corners lies straight above,
/// over what the whole sky would give: configuration factor B-3 of J. Howell, "A catalog of
/// radiation heat transfer configuration factors"; also M. Modest, "Radiative heat transfer",
/// appendix D, 10.
fn corner_factor(a: f64, b: f64, height: f64) -> f64 {
    let (a, b) = (a / height, b / height);
    let (ra, rb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    let sum = a / ra * libm::atan(b / ra) + b / rb * libm::atan(a / rb);
    sum / core::f64::consts::TAU
}

/// The same for a rectangle from `least` to `most`, seen from the origin.
fn factor(least: [f64; 2], most: [f64; 2], height: f64) -> f64 {
    let corner = |x: f64, y: f64| corner_factor(x.abs(), y.abs(), height) * x.signum() * y.signum();
    corner(most[0], most[1]) - corner(least[0], most[1]) - corner(most[0], least[1])
        + corner(least[0], least[1])
}

/// A floor of 2 m by 2 m about the origin under a lamp of 0.6 m by 0.4 m.
fn under_a_lamp(height: f64, more: &[([DVec3; 3], Finish)]) -> Surfaces {
    let floor = [DVec3::new(-1.0, -1.0, 0.0), DVec3::X * 2.0, DVec3::Y * 2.0];
    let lamp = [DVec3::new(-0.3, -0.2, height), DVec3::Y * 0.4, DVec3::X * 0.6];
    let mut quads = vec![(floor, Finish::grey(0.5, 0.0)), (lamp, Finish::grey(0.0, 3.0))];
    quads.extend_from_slice(more);
    Surfaces::of_quads(&quads, 10.0)
}

/// The worst error over the floor, of its brightest light.
fn lamp_error(samples: u32) -> f64 {
    let height = 0.8;
    let surfaces = under_a_lamp(height, &[]);
    let baker = bake(&surfaces, samples, 1);
    let chart = surfaces.charts[0];
    assert_eq!((chart.columns, chart.rows), (21, 21));
    let brightest = 3.0 * factor([-0.3, -0.2], [0.3, 0.2], height);
    let mut worst: f64 = 0.0;
    // Texels at the edge lie on the floor with half of themselves only.
    for (i, j) in (1..20).flat_map(|j| (1..20).map(move |i| (i, j))) {
        let (x, y) = (f64::from(i) * 0.1 - 1.0, f64::from(j) * 0.1 - 1.0);
        let known = 3.0 * factor([-0.3 - x, -0.2 - y], [0.3 - x, 0.2 - y], height);
        let light = f64::from(baker.total(chart.x + i, chart.y + j).x);
        worst = worst.max((light - known).abs() / brightest);
    }
    worst
}

#[test]
fn light_under_a_rectangular_lamp_is_that_of_the_closed_form() {
    let errors = [4, 16, 64, 256].map(lamp_error);
    println!("worst error at 4, 16, 64, 256 samples: {errors:.4?}");
    assert!(errors[0] < 0.25 && errors[1] < 0.13 && errors[2] < 0.035 && errors[3] < 0.014);
    assert!(errors[3] < 0.15 * errors[0], "more samples do not help: {errors:?}");
}

#[test]
fn what_stands_before_the_lamp_throws_a_shadow() {
    // A plate that hides the whole lamp from the middle of the floor, and none of it from afar.
    let plate = [DVec3::new(-0.3, -0.3, 0.2), DVec3::X * 0.6, DVec3::Y * 0.6];
    let turned = [plate[0], plate[2], plate[1]];
    let black = Finish::grey(0.0, 0.0);
    let surfaces = under_a_lamp(0.8, &[(plate, black), (turned, black)]);
    let baker = bake(&surfaces, 512, 1);
    let chart = surfaces.charts[0];
    let known = 3.0 * factor([-1.2, -1.1], [-0.6, -0.7], 0.8);
    assert_eq!(baker.total(chart.x + 10, chart.y + 10).x, 0.0);
    let corner = f64::from(baker.total(chart.x + 19, chart.y + 19).x);
    assert!((corner / known - 1.0).abs() < 0.05, "{corner}, not {known}");
}

#[test]
fn a_green_floor_makes_a_grey_ceiling_green() {
    let green = Finish { colour: [0.05, 0.5, 0.1], ..Finish::grey(0.0, 0.0) };
    let floor = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let ceiling = [DVec3::Z, DVec3::Y, DVec3::X];
    // A small lamp that looks down.
    let lamp = [DVec3::new(0.4, 0.4, 0.9), DVec3::Y * 0.2, DVec3::X * 0.2];
    let surfaces = Surfaces::of_quads(
        &[(floor, green), (ceiling, Finish::grey(0.5, 0.0)), (lamp, Finish::grey(0.0, 5.0))],
        10.0,
    );
    let baker = bake(&surfaces, 64, 2);
    let chart = surfaces.charts[1];
    let light = baker.total(chart.x + 2, chart.y + 2);
    assert!(0.0 < light.x && (light.y / light.x - 10.0).abs() < 0.1, "{light}");
}

#[test]
fn a_bake_is_the_same_every_time() {
    let surfaces = under_a_lamp(0.5, &[]);
    let [first, second] = [0, 1].map(|_| {
        let baker = bake(&surfaces, 16, 3);
        let bits = |k: usize| {
            let [x, y] = baker.place(k);
            baker.total(x, y).to_array().map(f32::to_bits)
        };
        (0..baker.texels()).map(bits).collect::<Vec<_>>()
    });
    assert_eq!(first, second);
}
