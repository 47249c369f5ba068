//! The cases of the stability table; each has a scale in which its error is told.

use super::{Case, Measured, measure};
use crate::ball::{Ball, BallState};
use crate::ids::BallId;
use crate::mesh::Surface;
use crate::physics::{Contact, Parameters, PhysicsError, Simulation};
use crate::report::answers;
use crate::report::method::Method;
use crate::report::starts::{self, R, ball, cloth, ideal, nothing, on_bed};
use crate::report::trial::Patience;
use crate::table::{Plane, Table};
use glam::DVec3;

type Measurement = Result<Measured, PhysicsError>;

/// All cases.
pub const CASES: [Case; 19] = [
    Case {
        id: "mass_ratio",
        title: "a ball meets another of a millionth of its mass",
        measures: "velocity of the light one, over its own",
        run: mass_ratio,
    },
    Case {
        id: "galperin",
        title: "a light ball between a wall and one of a hundred times its mass: 31 contacts",
        measures: "energy, over the first",
        run: |method, patience| galperin(method, 1e2, patience),
    },
    Case {
        id: "galperin_1e4",
        title: "the same with ten thousand times its mass: 314 contacts",
        measures: "energy, over the first",
        run: |method, patience| galperin(method, 1e4, patience),
    },
    Case {
        id: "galperin_1e6",
        title: "the same with a million times its mass: 3141 contacts",
        measures: "energy, over the first",
        run: |method, patience| galperin(method, 1e6, patience),
    },
    Case {
        id: "tiny_fast",
        title: "40 balls of 0.5 mm at 50 m/s in a box",
        measures: "out of the box [m]",
        run: tiny_fast,
    },
    Case {
        id: "fast_ball",
        title: "a ball at 100 m/s against a wall",
        measures: "way after 0.1 s, over 10 m",
        run: fast_ball,
    },
    Case {
        id: "fast_spin",
        title: "600 rad/s on the cloth",
        measures: "place [m] in 3 s",
        run: fast_spin,
    },
    Case { id: "rest", title: "a ball lies for an hour", measures: "height [m]", run: rest },
    Case {
        id: "stack",
        title: "a ball on three that touch, rough balls",
        measures: "deepest overlap [m] in 3 s",
        run: stack,
    },
    Case {
        id: "wedge",
        title: "a ball drops into a wedge of two planes",
        measures: "centre, off the wedge's [m], from 2 s on",
        run: wedge,
    },
    Case {
        id: "grazing",
        title: "two balls that overlap by 1e-8 of their diameter when they pass",
        measures: "velocity of the struck one, over its own",
        run: grazing,
    },
    Case {
        id: "simultaneous",
        title: "a ball hits two that touch, in the middle",
        measures: "asymmetry of their places [m] in 1 s",
        run: simultaneous,
    },
    Case {
        id: "far_away",
        title: "sliding, a thousand kilometres from the origin",
        measures: "place [m] in 3 s",
        run: far_away,
    },
    Case {
        id: "no_friction",
        title: "no friction at all",
        measures: "place [m] in 3 s",
        run: no_friction,
    },
    Case {
        id: "huge_friction",
        title: "friction of a million",
        measures: "place [m] in 3 s",
        run: huge_friction,
    },
    Case {
        id: "restitution_0",
        title: "restitution 0: dropped, stays down",
        measures: "height [m] in 2 s",
        run: restitution_0,
    },
    Case {
        id: "restitution_1",
        title: "restitution 1: bounces for 20 s",
        measures: "energy, over the first",
        run: restitution_1,
    },
    Case {
        id: "dead_break",
        title: "break with restitution 0 between balls",
        measures: "deepest overlap [m] in 2 s",
        run: dead_break,
    },
    Case {
        id: "hard_break",
        title: "break with restitution 1 and no friction between balls",
        measures: "deepest overlap [m] in 2 s",
        run: hard_break,
    },
];

fn world(
    table: &Table,
    balls: Vec<(Ball, BallState)>,
    method: Method,
    change: impl FnOnce(&mut Parameters),
) -> Result<Simulation, PhysicsError> {
    let settings = method.settings();
    let mut parameters = Parameters::of(&settings);
    change(&mut parameters);
    Simulation::with_parameters(table, balls, &settings, parameters)
}

fn place(world: &Simulation, id: u16, at: f64) -> DVec3 {
    world.sample(BallId(id), at).map_or(DVec3::NAN, |ball| ball.position)
}

fn velocity(world: &Simulation, id: u16, at: f64) -> DVec3 {
    world.sample(BallId(id), at).map_or(DVec3::NAN, |ball| ball.velocity)
}

fn plane(point: DVec3, normal: DVec3) -> Plane {
    Plane { point, normal, surface: Surface::Obstacle }
}

/// How deep the worst pair of balls of one size overlaps [m].
fn overlap(world: &Simulation, at: f64) -> f64 {
    let balls = world.snapshot(at).balls;
    let mut deepest = 0.0_f64;
    for (index, one) in balls.iter().enumerate() {
        for other in &balls[..index] {
            let depth = 2.0 * R - one.position.distance(other.position);
            deepest = if depth.is_nan() { f64::NAN } else { deepest.max(depth) };
        }
        deepest = deepest.max(R - one.position.z);
    }
    deepest
}

fn mass_ratio(method: Method, patience: Patience<'_>) -> Measurement {
    let (heavy, heavy_state) = ball(0, DVec3::ZERO, DVec3::X * 3.0, DVec3::ZERO);
    let (light, light_state) = ball(1, DVec3::X * 0.5, DVec3::ZERO, DVec3::ZERO);
    let heavy = Ball { mass_kg: 1e6 * light.mass_kg, ..heavy };
    let balls = vec![(heavy, heavy_state), (light, light_state)];
    let truth = 6.0 * 1e6 / (1e6 + 1.0);
    measure(patience, world(&nothing(), balls, method, ideal)?, 1.0, 40, |world, at| {
        let v = velocity(world, 1, at).x;
        // They meet within the first 0.15 s.
        if at < 0.2 { 0.0 } else { v / truth - 1.0 }
    })
}

fn galperin(method: Method, mass_ratio: f64, patience: Patience<'_>) -> Measurement {
    let (light, light_state) = ball(1, DVec3::X * 0.5, DVec3::ZERO, DVec3::ZERO);
    let (heavy, heavy_state) = ball(0, DVec3::X * 1.5, DVec3::NEG_X, DVec3::ZERO);
    let balls = vec![
        (Ball { mass_kg: mass_ratio, ..heavy }, heavy_state),
        (Ball { mass_kg: 1.0, ..light }, light_state),
    ];
    let mut table = nothing();
    table.planes.push(plane(DVec3::ZERO, DVec3::X));
    energy(world(&table, balls, method, ideal)?, 4.0, patience)
}

/// Relative change of kinetic and potential energy.
fn energy(world: Simulation, until_s: f64, patience: Patience<'_>) -> Measurement {
    let first = world.ledger().start_j;
    measure(patience, world, until_s, 100, |world, _| {
        let ledger = world.ledger();
        (ledger.kinetic_j + ledger.potential_j) / first - 1.0
    })
}

fn tiny_fast(method: Method, patience: Patience<'_>) -> Measurement {
    const SMALL_M: f64 = 0.0005;
    let half = DVec3::new(0.5, 0.3, 0.2);
    let mut table = nothing();
    for axis in DVec3::AXES {
        table.planes.push(plane(-half * axis, axis));
        table.planes.push(plane(half * axis, -axis));
    }
    let balls = (0..40_u16)
        .map(|id| {
            let k = f64::from(id);
            let at = DVec3::new(f64::from(id % 8) - 3.5, f64::from(id / 8) - 2.0, 0.0) * 0.1;
            let way = DVec3::new(libm::sin(1.7 * k), libm::cos(2.3 * k), libm::sin(0.9 * k + 1.0));
            let (made, state) = ball(id, at, way.normalize_or(DVec3::X) * 50.0, DVec3::ZERO);
            (Ball { radius_m: SMALL_M, ..made }, state)
        })
        .collect();
    measure(patience, world(&table, balls, method, ideal)?, 1.0, 100, |world, at| {
        let out = |place: DVec3| (place.abs() - half + SMALL_M).max_element();
        let worst = |worst: f64, out: f64| if out > worst || out.is_nan() { out } else { worst };
        world.snapshot(at).balls.iter().map(|ball| out(ball.position)).fold(0.0, worst)
    })
}

fn fast_ball(method: Method, patience: Patience<'_>) -> Measurement {
    let mut table = nothing();
    table.planes.push(plane(DVec3::X * 3.333, DVec3::NEG_X));
    let balls = vec![ball(0, DVec3::ZERO, DVec3::X * 100.0, DVec3::ZERO)];
    measure(patience, world(&table, balls, method, ideal)?, 0.1, 25, |world, at| {
        let wall = 3.333 - R;
        let way = 100.0 * at;
        let truth = if way < wall { way } else { 2.0 * wall - way };
        (place(world, 0, at).x - truth) / 10.0
    })
}

fn slides(
    method: Method,
    at_m: f64,
    spin: DVec3,
    patience: Patience<'_>,
    change: impl Fn(&mut Parameters),
) -> Measurement {
    let v = DVec3::X * 1.5;
    let mut law = Parameters::of(&method.settings());
    change(&mut law);
    let balls = vec![on_bed(0, at_m, 0.0, v, spin)];
    measure(patience, world(&cloth(), balls, method, change)?, 3.0, 60, |world, at| {
        let moved = answers::on_cloth(v, spin, &law, at);
        (place(world, 0, at) - DVec3::new(at_m, 0.0, R) - moved).length()
    })
}

fn fast_spin(method: Method, patience: Patience<'_>) -> Measurement {
    slides(method, 0.0, DVec3::new(300.0, 600.0, 100.0), patience, |_| {})
}

fn far_away(method: Method, patience: Patience<'_>) -> Measurement {
    slides(method, 1e6, DVec3::ZERO, patience, |_| {})
}

fn no_friction(method: Method, patience: Patience<'_>) -> Measurement {
    slides(method, 0.0, DVec3::Y * 50.0, patience, |law| {
        law.cloth.friction = 0.0;
        law.rolling_resistance = 0.0;
    })
}

fn huge_friction(method: Method, patience: Patience<'_>) -> Measurement {
    slides(method, 0.0, DVec3::Y * 20.0, patience, |law| law.cloth.friction = 1e6)
}

fn rest(method: Method, patience: Patience<'_>) -> Measurement {
    let balls = vec![on_bed(0, 0.3, 0.2, DVec3::ZERO, DVec3::ZERO)];
    measure(patience, world(&cloth(), balls, method, |_| {})?, 3600.0, 7200, |world, at| {
        place(world, 0, at).z - R
    })
}

fn stack(method: Method, patience: Patience<'_>) -> Measurement {
    // Three balls in a triangle and one in the hollow between them, a regular tetrahedron.
    let side = 2.0 * R;
    let base = [(0.0, 0.0), (side, 0.0), (0.5 * side, 0.75_f64.sqrt() * side)];
    let still = DVec3::ZERO;
    let mut balls: Vec<_> =
        (0..3).zip(base).map(|(id, (x, y))| on_bed(id, x, y, still, still)).collect();
    let top = DVec3::new(
        0.5 * side,
        0.75_f64.sqrt() * side / 3.0,
        R + (2.0_f64 / 3.0).sqrt() * side + 1e-9,
    );
    balls.push(ball(3, top, still, still));
    let rough = |law: &mut Parameters| {
        law.ball.friction = 0.6;
        law.cloth.friction = 0.6;
    };
    measure(patience, world(&cloth(), balls, method, rough)?, 3.0, 300, overlap)
}

fn wedge(method: Method, patience: Patience<'_>) -> Measurement {
    let mut table = nothing();
    for x in [-1.0, 1.0] {
        table.planes.push(plane(DVec3::ZERO, DVec3::new(x, 0.0, 1.0).normalize_or(DVec3::Z)));
    }
    let depth = R * 2.0_f64.sqrt();
    let start = DVec3::new(0.01, 0.0, depth + 0.05);
    let balls = vec![ball(0, start, DVec3::ZERO, DVec3::ZERO)];
    measure(patience, world(&table, balls, method, |_| {})?, 6.0, 300, |world, at| {
        let off = (place(world, 0, at) - DVec3::Z * depth).length();
        if at < 2.0 { 0.0 } else { off }
    })
}

fn grazing(method: Method, patience: Patience<'_>) -> Measurement {
    let aside = 2.0 * R * (1.0 - 1e-8);
    let balls = vec![
        ball(0, DVec3::X * -0.5, DVec3::X, DVec3::ZERO),
        ball(1, DVec3::Y * aside, DVec3::ZERO, DVec3::ZERO),
    ];
    let share = 1.0 - 1e-8;
    let truth = (1.0_f64 - share * share).sqrt();
    measure(patience, world(&nothing(), balls, method, ideal)?, 2.0, 80, |world, at| {
        if at < 0.6 { 0.0 } else { velocity(world, 1, at).length() / truth - 1.0 }
    })
}

fn simultaneous(method: Method, patience: Patience<'_>) -> Measurement {
    let balls = vec![
        on_bed(0, -0.4, 0.0, DVec3::X * 3.0, DVec3::ZERO),
        on_bed(1, 0.0, R, DVec3::ZERO, DVec3::ZERO),
        on_bed(2, 0.0, -R, DVec3::ZERO, DVec3::ZERO),
    ];
    measure(patience, world(&cloth(), balls, method, |_| {})?, 1.0, 40, |world, at| {
        let (left, right) = (place(world, 1, at), place(world, 2, at));
        (left * DVec3::new(1.0, -1.0, 1.0) - right).length() + place(world, 0, at).y.abs()
    })
}

fn dropped(method: Method, restitution: f64) -> Result<Simulation, PhysicsError> {
    let balls = vec![ball(0, DVec3::Z * (R + 0.3), DVec3::ZERO, DVec3::ZERO)];
    world(&cloth(), balls, method, |law| law.cloth = Contact { restitution, friction: 0.0 })
}

fn restitution_0(method: Method, patience: Patience<'_>) -> Measurement {
    measure(patience, dropped(method, 0.0)?, 2.0, 100, |world, at| {
        place(world, 0, at).z - R - (0.3 - 0.5 * 9.81 * at * at).max(0.0)
    })
}

fn restitution_1(method: Method, patience: Patience<'_>) -> Measurement {
    let world = dropped(method, 1.0)?;
    // Height above the lying ball is what can be told: its weight has no zero.
    let (mass, full) = (0.17, 0.17 * 9.81 * 0.3);
    measure(patience, world, 20.0, 400, |world, at| {
        let (v, z) = (velocity(world, 0, at).length(), place(world, 0, at).z - R);
        (0.5 * mass * v * v + mass * 9.81 * z) / full - 1.0
    })
}

fn racked(method: Method, contact: Contact, patience: Patience<'_>) -> Measurement {
    let world = world(&starts::noses(), starts::racked(0), method, |law| law.ball = contact)?;
    measure(patience, world, 2.0, 200, overlap)
}

fn dead_break(method: Method, patience: Patience<'_>) -> Measurement {
    racked(method, Contact { restitution: 0.0, friction: 0.05 }, patience)
}

fn hard_break(method: Method, patience: Patience<'_>) -> Measurement {
    racked(method, Contact { restitution: 1.0, friction: 0.0 }, patience)
}
