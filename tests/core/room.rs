//! The room: its shape for every table, what is free in it, and its light against closed forms.

mod light;

use glam::{DVec2, DVec3, Vec3};
use hapticbillard::ids::BallId;
use hapticbillard::input::CameraPose;
use hapticbillard::physics::Simulation;
use hapticbillard::room::{
    EAST_M, Group, LIGHT_WIDTH, LightMap, LightMapError, Room, WEST_M, WIDE_M, lamp_opacity,
};
use hapticbillard::scene::Scene;
use hapticbillard::shipped;
use hapticbillard::table::Table;

fn table(name: &str) -> Table {
    Table::preset(name).unwrap()
}

fn room(name: &str) -> Room {
    Room::around(&table(name)).unwrap()
}

#[test]
fn every_shipped_table_has_a_room_and_nothing_else_has_one() {
    for (name, _) in shipped::TABLES {
        let room = room(name);
        let surfaces = &room.surfaces;
        assert!(surfaces.size[1] <= LIGHT_WIDTH + 64, "{name}: {:?}", surfaces.size);
        assert!(surfaces.triangles.len() < 60_000, "{name}: {}", surfaces.triangles.len());
        for group in [Group::Standing, Group::Ceiling, Group::Lamp, Group::TableTop] {
            assert!(surfaces.triangles.iter().any(|(_, own)| *own == group), "{name}: {group:?}");
        }
    }
    assert!(Room::around(&Table::plane()).is_none());
}

#[test]
fn normals_look_the_way_of_their_triangles_and_light_lies_in_its_chart() {
    let room = room("pool-9ft");
    let surfaces = &room.surfaces;
    for (corners, group) in &surfaces.triangles {
        let [a, b, c] = corners.map(|corner| &surfaces.vertices[corner as usize]);
        let flat = (b.position - a.position).cross(c.position - a.position).normalize_or_zero();
        for vertex in [a, b, c] {
            assert!((vertex.normal.length() - 1.0).abs() < 1e-5, "{vertex:?}");
            // The table's own smooth parts are its own affair.
            let is_own = *group != Group::TableTop;
            assert!(!is_own || 1e-3 < vertex.normal.dot(flat), "{vertex:?} {flat}");
            let chart = &surfaces.charts[usize::from(vertex.chart)];
            let within = |x: f64, from: u32, count: u32| {
                f64::from(from) + 0.5 - 1e-6 <= x && x <= f64::from(from + count) - 0.5 + 1e-6
            };
            assert!(within(vertex.light.x, chart.x, chart.columns), "{vertex:?} {chart:?}");
            assert!(within(vertex.light.y, chart.y, chart.rows), "{vertex:?} {chart:?}");
        }
    }
}

#[test]
fn round_every_table_there_is_room_for_a_cue() {
    for (name, _) in shipped::TABLES {
        let room = room(name);
        for obstacle in &room.obstacles {
            let nearest = obstacle.least.clamp(-room.outer.extend(9.0), room.outer.extend(9.0));
            let nearest = nearest.clamp(obstacle.least, obstacle.most).truncate();
            let aside = (nearest.abs() - room.outer).max_element();
            assert!(1.1 < aside, "{name}: {aside} m to {obstacle:?}");
        }
    }
}

#[test]
fn the_same_table_gives_the_same_room_and_another_one_another() {
    assert_eq!(room("pool-9ft").digest(), room("pool-9ft").digest());
    let mut all: Vec<String> =
        shipped::TABLES.iter().map(|(name, _)| room(name).digest().to_string()).collect();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), shipped::TABLES.len());
}

/// Numbers from 0 to 1.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn whoever_is_led_out_of_things_is_outside_of_them() {
    let room = room("pool-9ft");
    let mut seed = 3;
    let (mut moved, mut free) = (0, 0);
    for _ in 0..20_000 {
        let mut next = |low: f64, high: f64| low + (high - low) * random(&mut seed);
        let point = DVec3::new(next(-6.0, 6.5), next(-5.0, 5.0), next(-1.5, 3.5));
        let radius = 0.15;
        let push = room.outside(point, radius);
        let at = point + push;
        assert!(WEST_M < at.x && at.x < EAST_M && at.y.abs() < WIDE_M, "{point} to {at}");
        assert!(room.floor_m < at.z && at.z < room.crown_m(), "{point} to {at}");
        for obstacle in &room.obstacles {
            let away = (at - at.clamp(obstacle.least, obstacle.most)).length();
            assert!(radius - 1e-6 < away, "{point} to {at}: {away} m from {obstacle:?}");
        }
        assert!(room.outside(at, radius).length() < 1e-9, "{at} is moved again");
        moved += usize::from(push != DVec3::ZERO);
        free += usize::from(push == DVec3::ZERO);
    }
    assert!(2_000 < moved && 2_000 < free, "{moved} {free}");
}

#[test]
fn over_the_table_nothing_is_in_the_way() {
    for (name, _) in shipped::TABLES {
        let room = room(name);
        for eye in [DVec3::new(-2.6, -1.1, 1.3), DVec3::new(0.0, 0.0, 0.5), DVec3::Z * 1.9] {
            assert_eq!(room.outside(eye, 0.15), DVec3::ZERO, "{name}: {eye}");
        }
    }
}

#[test]
fn faces_that_stop_balls_look_at_them() {
    let room = room("pool-9ft");
    let mesh = room.collision();
    assert!(60 < mesh.faces.len() && mesh.faces.len() < 400, "{} faces", mesh.faces.len());
    for index in 0..mesh.faces.len() {
        let [a, b, c] = mesh.corners(index);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let middle = (a + b + c) / 3.0;
        assert!((normal.length() - 1.0).abs() < 1e-9, "face {index} has no area");
        // A small step along the normal leads into the room, or into the next thing; a step
        // against it always leads into something.
        let behind = room.outside(middle - normal * 0.02, 0.001);
        assert!(1e-3 < behind.length(), "face {index} at {middle} looks the wrong way");
    }
}

#[test]
fn the_lamp_is_hidden_only_where_it_would_cover_the_table() {
    let half = DVec2::new(1.435, 0.8);
    let opacity = |eye: [f64; 3]| lamp_opacity(DVec3::from(eye), half);
    // From above, from a place under the vault, and behind the cue.
    assert_eq!(opacity([0.0, -0.02, 2.8]), 0.0);
    assert_eq!(opacity([0.0, -1.0, 2.1]), 0.0);
    assert_eq!(opacity([-1.6, 0.0, 0.3]), 1.0);
    assert_eq!(lamp_opacity(CameraPose::default().eye, half), 1.0);
    assert_eq!(opacity([-3.9, -2.6, 0.9]), 1.0);
    // It fades: on the way up no step changes much.
    let mut before = 1.0;
    for k in 0..=2000 {
        let now = opacity([-2.0, -0.5, 1.0 + 0.001 * f64::from(k)]);
        assert!((now - before).abs() < 0.05, "{before} to {now} at step {k}");
        before = now;
    }
    assert_eq!(before, 0.0);
}

#[test]
fn a_map_of_another_room_is_refused() {
    let (own, other) = (room("pool-9ft"), room("pool-8ft"));
    let map = LightMap::unbaked(&own);
    assert_eq!(map.fits(&own, &own.digest().to_string()), Ok(()));
    let wrong = map.fits(&own, &other.digest().to_string()).unwrap_err();
    assert!(matches!(wrong, LightMapError::Room { .. }), "{wrong}");
    assert!(wrong.to_string().contains("hapticbillard bake"), "{wrong}");
    let small = LightMap { size: [1, 1], texels: vec![[0; 3]] };
    let wrong = small.fits(&own, &own.digest().to_string()).unwrap_err();
    assert!(wrong.to_string().contains("1 x 1 texels"), "{wrong}");
}

#[test]
fn unbaked_light_is_brightest_under_the_lamp() {
    let room = room("pool-9ft");
    let map = LightMap::unbaked(&room);
    let [offset, scale] = room.bed_light();
    let at = |x: f64, y: f64| {
        let size = DVec2::from(map.size.map(f64::from));
        let place = (offset + scale * DVec2::new(x, y)) * size;
        Vec3::from(map.light(place.x as u32, place.y as u32)).element_sum()
    };
    assert!(at(1.2, 0.5) < at(0.0, 0.0) && at(-1.2, 0.0) < at(0.0, 0.0));
}

/// A ball that is thrown from over the table, in a room or not; none if it did not leave it.
fn thrown(with_room: bool, way: DVec3) -> Vec<DVec3> {
    let [x, y, z] = way.to_array();
    let text = format!(
        "[scene]\nname = \"thrown\"\n[physics]\n[table]\npreset = \"pool-9ft\"\n\
         room = {with_room}\n[[ball]]\nid = 0\nposition_m = [0.0, 0.0, 0.4]\n\
         velocity_m_s = [{x}, {y}, {z}]\n"
    );
    let scene = Scene::parse("thrown", &text).unwrap();
    let table = scene.build_table(&mut |_| Err(String::new())).unwrap();
    let balls = scene.build_balls(&table).unwrap();
    let parameters = scene.parameters();
    let start = Simulation::with_parameters(&table, balls, &scene.physics, parameters).unwrap();
    let shot = start.run_until_rest().unwrap();
    shot.trajectory(BallId::CUE).every(0.002).map(|state| state.position).collect()
}

#[test]
fn a_ball_that_leaves_the_table_stays_in_the_room() {
    let room = room("pool-9ft");
    let radius = 0.5 * 0.057_15;
    let floor = -Table::preset("pool-9ft").unwrap().parameters.unwrap().bed_height_m;
    let (mut off, mut stopped) = (0, 0);
    for k in 0..24 {
        let way = DVec2::from_angle(f64::from(k) * 0.2618 + 0.05) * (6.0 + 0.3 * f64::from(k));
        let way = way.extend(1.5);
        let [inside, endless] = [true, false].map(|with_room| thrown(with_room, way));
        for at in &inside {
            let walls = at.x < WEST_M || EAST_M < at.x || WIDE_M < at.y.abs();
            assert!(!walls, "{way}: at {at}");
            let deepest = room.obstacles.iter().map(|obstacle| {
                let away = at.distance(at.clamp(obstacle.least, obstacle.most));
                radius - away
            });
            let deepest = deepest.fold(0.0, f64::max);
            assert!(deepest < 1e-6, "{way}: {deepest} m in something at {at}");
        }
        let [end, far] = [&inside, &endless].map(|way| *way.last().unwrap());
        off += i32::from(end.z < floor + 2.0 * radius);
        stopped += i32::from(0.2 < end.distance(far));
    }
    assert!(off > 20 && stopped > 15, "{off} left the table, {stopped} were stopped");
}
