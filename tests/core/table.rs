//! The pool table measured back from its vertices, not from its parameters.

use crate::geometry::closest_point;
use glam::{DVec2, DVec3};
use hapticbillard::ids::{PocketId, Rail};
use hapticbillard::mesh::Surface;
use hapticbillard::table::{Material, Pocket, Table, TableError, TableParameters};
use std::collections::BTreeSet;

const BALL_M: f64 = 0.05715;
const HALF: DVec2 = DVec2::new(1.27, 0.635);

fn pool() -> Table {
    Table::preset("pool-9ft").unwrap()
}

fn faces(table: &Table, belongs: impl Fn(Surface) -> bool) -> Vec<[DVec3; 3]> {
    (0..table.mesh.faces.len())
        .filter(|i| belongs(table.mesh.faces[*i].surface))
        .map(|i| table.mesh.corners(i))
        .collect()
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize()
}

/// Nose tips of a rail: the outermost vertices that lie on its nose line.
fn nose_line(table: &Table, on_line: impl Fn(DVec3) -> bool) -> Vec<DVec3> {
    let nose = 0.635 * BALL_M;
    let is_nose = |p: &DVec3| (p.z - nose).abs() < 1e-9 && on_line(*p);
    table.mesh.vertices.iter().copied().filter(is_nose).collect()
}

#[test]
fn mouths_are_as_wide_as_the_rules_say() {
    let table = pool();
    let long = nose_line(&table, |p| (p.y - HALF.y).abs() < 1e-9);
    let foot = nose_line(&table, |p| (p.x - HALF.x).abs() < 1e-9);
    let corner_on_long = long.iter().copied().max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
    let corner_on_foot = foot.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
    assert!((corner_on_long.distance(corner_on_foot) - 0.1159).abs() < 1e-4);
    let right = long.iter().map(|p| p.x).filter(|x| *x > 0.0).min_by(f64::total_cmp).unwrap();
    let left = long.iter().map(|p| p.x).filter(|x| *x < 0.0).max_by(f64::total_cmp).unwrap();
    assert!((right - left - 0.1286).abs() < 1e-4);

    let pocket = |id: PocketId| table.pockets.iter().find(|p| p.id == id).unwrap();
    let tips = pocket(PocketId::Fl).mouth;
    assert!(tips[0].distance(corner_on_long.truncate()) < 1e-9);
    assert!(tips[1].distance(corner_on_foot.truncate()) < 1e-9);
    let tips = pocket(PocketId::Ml).mouth;
    assert!((tips[0].x - left).abs() < 1e-9 && (tips[1].x - right).abs() < 1e-9);
}

#[test]
fn jaws_have_their_cut_angle_and_back_draft() {
    let table = pool();
    let long = faces(&table, |s| s == Surface::Cushion(Rail::Left));
    let foot = faces(&table, |s| s == Surface::Cushion(Rail::Foot));
    let cut = 0.1159 * 0.5f64.sqrt();
    // Nose tip, direction of the nose line from the tip into the rubber, pocket, expected angle.
    let corner = HALF + DVec2::splat(0.04);
    let jaws = [
        (&long, DVec2::new(HALF.x - cut, HALF.y), DVec2::NEG_X, corner, 142.0),
        (&foot, DVec2::new(HALF.x, HALF.y - cut), DVec2::NEG_Y, corner, 142.0),
        (&long, DVec2::new(0.0643, HALF.y), DVec2::X, DVec2::new(0.0, 0.704), 104.0),
    ];
    for (faces, tip, along_nose, pocket, expected_deg) in jaws {
        let mut count = 0;
        for face in faces.iter() {
            let middle = (face[0] + face[1] + face[2]) / 3.0;
            let n = normal(*face);
            let is_near = middle.truncate().distance(tip) < 0.08;
            // Faces of the sweep have no part along the nose line.
            if !is_near || n.truncate().dot(along_nose).abs() < 0.1 {
                continue;
            }
            count += 1;
            let jaw = n.truncate().normalize().perp();
            let jaw = if jaw.dot(pocket - tip) > 0.0 { jaw } else { -jaw };
            let angle_deg = libm::acos(jaw.dot(along_nose)).to_degrees();
            assert!((angle_deg - expected_deg).abs() < 0.1, "{angle_deg} at {tip}");
            let draft_deg = libm::atan(-n.z / n.truncate().length()).to_degrees();
            assert!((draft_deg - 13.0).abs() < 0.1, "{draft_deg} at {tip}");
            assert!(n.truncate().dot(pocket - tip) > 0.0, "the jaw faces its pocket");
        }
        assert!(count >= 10, "the facing at {tip} has {count} faces");
    }
}

#[test]
fn nose_is_the_foremost_part_of_every_cushion() {
    let table = pool();
    for (rail, across) in [
        (Rail::Head, DVec3::NEG_X),
        (Rail::Foot, DVec3::X),
        (Rail::Left, DVec3::Y),
        (Rail::Right, DVec3::NEG_Y),
    ] {
        let cushion = faces(&table, |s| s == Surface::Cushion(rail));
        let foremost = cushion.iter().flatten().map(|p| p.dot(across)).fold(f64::MAX, f64::min);
        let line = across.truncate().abs().dot(HALF);
        assert!((foremost - line).abs() < 1e-12, "{rail:?}");
        for p in cushion.iter().flatten().filter(|p| p.dot(across) < foremost + 1e-9) {
            assert!((p.z / BALL_M - 0.635).abs() < 1e-9, "{rail:?} {p}");
        }
    }
}

#[test]
fn rolling_ball_meets_the_nose_at_its_height() {
    let table = pool();
    let cushion = faces(&table, |s| s == Surface::Cushion(Rail::Left));
    let radius = 0.5 * BALL_M;
    for i in 0..40 {
        let centre = DVec3::new(0.15 + 0.025 * f64::from(i), HALF.y - radius, radius);
        let (point, distance) = closest_point(&cushion, centre);
        assert!((point.z - 0.635 * BALL_M).abs() < 0.001, "{point}");
        assert!((point.x - centre.x).abs() < 1e-9, "{point}");
        // The nose is higher than the middle of the ball, so the ball gets a little nearer.
        assert!(radius < distance && distance < radius + 0.0011, "{distance}");
    }
}

/// All sizes of pool table, with the length and width of their beds [m].
const POOL: [(&str, f64, f64); 3] =
    [("pool-9ft", 2.54, 1.27), ("pool-8ft", 2.2352, 1.1176), ("pool-7ft", 1.9812, 0.9906)];

#[test]
fn bodies_are_closed_and_of_their_size_and_have_about_ten_thousand_faces() {
    for (name, length_m, width_m) in POOL {
        let table = Table::preset(name).unwrap();
        let bed = table.bed.unwrap();
        assert_eq!((bed.length_m, bed.width_m), (length_m, width_m), "{name}");
        check_body(&table);
    }
}

fn check_body(table: &Table) {
    assert_eq!(table.mesh.open_edges(), []);
    assert!((9_000..=12_000).contains(&table.mesh.faces.len()), "{}", table.mesh.faces.len());
    for i in 0..table.mesh.faces.len() {
        let [a, b, c] = table.mesh.corners(i);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let height = (b - a).cross(c - a).length() / longest;
        assert!(longest < 0.3, "face {i} is {longest} m long");
        assert!(height > 1e-5, "face {i} is a sliver");
    }
}

#[test]
fn normals_point_out_of_the_solid() {
    let table = pool();
    assert!(table.mesh.volume() > 0.0);
    let all = faces(&table, |_| true);
    let inside = |p: DVec3| {
        // A direction that meets no edge by accident.
        let ray = DVec3::new(0.5377, 0.3281, 0.7713).normalize();
        let winding: i32 = all.iter().filter_map(|f| crossing(*f, p, ray)).sum();
        assert!(winding == 0 || winding == 1, "winding {winding} at {p}");
        winding == 1
    };
    for (p, expected) in [
        (DVec3::new(0.31, 0.22, -0.1), true),
        (DVec3::new(0.31, 0.22, 0.01), false),
        (DVec3::new(0.31, 0.22, -0.21), false),
        (DVec3::new(0.6, 0.655, 0.035), true),
        (DVec3::new(0.6, 0.640, 0.010), false),
        (DVec3::new(1.4, 0.1, 0.04), true),
        (DVec3::new(1.4, 0.1, 0.044), false),
        (DVec3::new(0.003, 0.70, -0.1), false),
        (DVec3::new(0.003, 0.70, -0.16), true),
        (DVec3::new(-1.30, -0.667, -0.1), false),
        (DVec3::new(-1.30, -0.667, 0.03), false),
        (DVec3::new(-1.30, -0.667, -0.17), true),
    ] {
        assert_eq!(inside(p), expected, "{p}");
    }
}

/// +1 if a ray from `p` leaves through the face, −1 if it enters (Möller and Trumbore 1997).
fn crossing([a, b, c]: [DVec3; 3], p: DVec3, ray: DVec3) -> Option<i32> {
    let (ab, ac) = (b - a, c - a);
    let across = ray.cross(ac);
    let determinant = ab.dot(across);
    let from_a = p - a;
    let u = from_a.dot(across) / determinant;
    let turned = from_a.cross(ab);
    let v = ray.dot(turned) / determinant;
    let t = ac.dot(turned) / determinant;
    let hits = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0;
    hits.then_some(if determinant < 0.0 { 1 } else { -1 })
}

fn cushions_near(table: &Table, pocket: &Pocket) -> Vec<[DVec3; 3]> {
    let mut near = faces(table, |s| matches!(s, Surface::Cushion(_)));
    near.retain(|f| f.iter().any(|p| p.truncate().distance(pocket.centre) < 0.25));
    near
}

#[test]
fn ball_rolls_through_every_mouth_and_down_to_the_bottom() {
    for (name, ..) in POOL {
        check_pockets(&Table::preset(name).unwrap());
    }
}

fn check_pockets(table: &Table) {
    let radius = 0.5 * BALL_M;
    for pocket in &table.pockets {
        let cushions = cushions_near(table, pocket);
        let walls = faces(table, |s| s == Surface::Pocket(pocket.id));
        let way = pocket.centre - pocket.target();
        assert!(way.normalize().dot(pocket.heading) > 1.0 - 1e-12);
        for i in -20..=20 {
            let p = pocket.target() + way * f64::from(i) / 20.0;
            let (_, distance) = closest_point(&cushions, p.extend(radius));
            assert!(distance > radius + 0.01, "{} at step {i}: {distance}", pocket.id);
        }
        for i in 0..=20 {
            let p = pocket.centre.extend(radius - 0.15 * f64::from(i) / 20.0);
            let (_, distance) = closest_point(&walls, p);
            assert!(distance > radius + 0.01, "{}: {distance}", pocket.id);
        }
        let bottom = faces(table, |s| s == Surface::PocketBottom(pocket.id));
        let highest = bottom.iter().flatten().map(|p| p.z).fold(f64::MIN, f64::max);
        assert!(highest + BALL_M < 0.0, "a ball on the bottom lies below the cloth");
    }
}

/// The highest face over or under `p` with its height, seen from above.
fn from_above(all: &[([DVec3; 3], Surface)], p: DVec2) -> Option<(f64, Surface)> {
    all.iter()
        .filter_map(|([a, b, c], surface)| {
            let (a2, b2, c2) = (a.truncate(), b.truncate(), c.truncate());
            let area = (b2 - a2).perp_dot(c2 - a2);
            let (u, v) = ((p - a2).perp_dot(c2 - a2) / area, (b2 - a2).perp_dot(p - a2) / area);
            let hits = area > 1e-12 && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
            hits.then_some((a.z + u * (b.z - a.z) + v * (c.z - a.z), *surface))
        })
        .max_by(|x, y| x.0.total_cmp(&y.0))
}

#[test]
fn the_bed_is_cloth_away_from_pockets_and_nothing_has_a_hole() {
    let table = pool();
    let all: Vec<_> = (0..table.mesh.faces.len())
        .map(|i| (table.mesh.corners(i), table.mesh.faces[i].surface))
        .collect();
    let outer = HALF + DVec2::splat(0.165);
    for i in -29..=29 {
        for j in -16..=16 {
            // An odd pitch, so that no ray runs along the edges of the grid.
            let p = DVec2::new(0.0493 * f64::from(i) + 0.0007, 0.0493 * f64::from(j) + 0.0003);
            let rounded = (p.abs() - outer + DVec2::splat(0.09)).max(DVec2::ZERO).length() > 0.089;
            if rounded || p.x.abs() > outer.x || p.y.abs() > outer.y {
                continue;
            }
            let (z, surface) = from_above(&all, p).unwrap_or_else(|| panic!("hole at {p}"));
            let over_pocket = table
                .pockets
                .iter()
                .any(|pocket| pocket.centre.distance(p) < pocket.radius_m + 0.0046);
            let on_bed = p.x.abs() < HALF.x && p.y.abs() < HALF.y && !over_pocket;
            if on_bed {
                assert_eq!((z, surface), (0.0, Surface::Cloth), "{p}");
            } else if !over_pocket {
                assert!((0.0..=0.0430001).contains(&z), "{p} {z}");
            }
        }
    }
}

#[test]
fn table_is_its_own_mirror_image() {
    let table = pool();
    let key = |p: DVec3| p.to_array().map(|value| (value * 1e12).round() as i64);
    let points: BTreeSet<_> = table.mesh.vertices.iter().map(|p| key(*p)).collect();
    for flip in [DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0)] {
        assert!(table.mesh.vertices.iter().all(|p| points.contains(&key(*p * flip))));
    }
}

#[test]
fn a_floor_lies_under_everything() {
    let table = pool();
    let (low, _) = table.mesh.bounds().unwrap();
    let floor = table.planes.iter().find(|plane| plane.surface == Surface::Floor).unwrap();
    assert_eq!((floor.point.z, floor.normal), (-0.77, DVec3::Z));
    assert!(floor.point.z < low.z);
}

#[test]
fn tables_of_other_sizes_close_too() {
    let text = hapticbillard::shipped::table("pool-9ft").unwrap();
    let regulation = TableParameters::from_toml(text).unwrap();
    let eight_foot = TableParameters { length_m: 2.3368, width_m: 1.1684, ..regulation.clone() };
    let mut tight = regulation.clone();
    let corner = tight.corner.as_mut().unwrap();
    (corner.mouth_m, corner.shelf_m) = (0.105, 0.05);
    for parameters in [eight_foot, tight] {
        let table = Table::from_parameters("other", parameters).unwrap();
        assert_eq!(table.mesh.open_edges(), []);
        assert_eq!(table.pockets.len(), 6);
    }
    let half = TableParameters { side: None, ..regulation.clone() };
    assert_eq!(half.check(), Err(TableError::HalfPocketed));
    let mut broken = regulation;
    broken.side.as_mut().unwrap().cut_angle_deg = 60.0;
    assert!(matches!(
        Table::from_parameters("broken", broken),
        Err(TableError::Parameter { key, value: 60.0, .. }) if key == "side.cut_angle_deg"
    ));
}

#[test]
fn unknown_presets_and_broken_texts_say_what_is_allowed() {
    let error = Table::preset("pool-12ft").unwrap_err().to_string();
    assert!(error.contains("'pool-12ft'") && error.contains("pool-9ft"), "{error}");
    let error = TableParameters::from_toml("length_m = 'long'").unwrap_err().to_string();
    assert!(error.contains("length_m"), "{error}");
    let error = Table::from_mesh("v 0 0 0\nf 1 1 2").unwrap_err().to_string();
    assert!(error.contains("line 2"), "{error}");
    let nan = hapticbillard::shipped::table("pool-9ft").unwrap().replace("0.77", "nan");
    assert!(matches!(TableParameters::from_toml(&nan), Err(TableError::Parameter { .. })));
}

#[test]
fn plane_is_cloth_without_bed_or_mesh() {
    let plane = Table::plane();
    assert_eq!((plane.planes.len(), plane.mesh.faces.len()), (1, 0));
    assert!(plane.bed.is_none() && plane.pockets.is_empty() && plane.display().is_empty());
}

#[test]
fn visible_parts_are_sound_and_fit_the_physical_body() {
    let table = pool();
    let parts = table.display();
    let names: BTreeSet<_> = parts.iter().map(|part| part.name).collect();
    assert_eq!(names.len(), parts.len());
    let (low, high) = table.mesh.bounds().unwrap();
    for part in &parts {
        assert_eq!(part.positions.len(), part.normals.len());
        assert_eq!(part.positions.len(), part.uvs.len());
        assert!(part.indices.iter().all(|i| (*i as usize) < part.positions.len()));
        for corners in part.indices.chunks_exact(3) {
            let at = |k: usize| DVec3::from(part.positions[corners[k] as usize].map(f64::from));
            let flat = (at(1) - at(0)).cross(at(2) - at(0)).normalize_or_zero();
            for k in corners {
                let n = DVec3::from(part.normals[*k as usize].map(f64::from));
                assert!((n.length() - 1.0).abs() < 1e-5, "{}", part.name);
                assert!(flat == DVec3::ZERO || n.dot(flat) > 0.5, "{}", part.name);
            }
        }
        if matches!(part.material, Material::Cloth | Material::CushionCloth | Material::Wood) {
            for p in &part.positions {
                let p = DVec3::from(p.map(f64::from));
                assert!((p - p.clamp(low, high)).length() < 1e-6, "{} {p}", part.name);
            }
        }
    }
    let find = |material| parts.iter().find(|part| part.material == material).unwrap();
    // Eighteen rhombs of four triangles.
    assert_eq!(find(Material::Diamond).indices.len(), 18 * 4 * 3);
    let nearest = find(Material::CushionCloth)
        .positions
        .iter()
        .map(|p| f64::from(p[1].abs()))
        .fold(f64::MAX, f64::min);
    assert!(nearest < 1e-3, "the short rails' cushions cross the middle");
}
