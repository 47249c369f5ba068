//! The pool table measured back from its vertices.

use glam::DVec3;
use hapticbillard::mesh::Surface;
use hapticbillard::table::Table;
use std::collections::BTreeMap;

fn pool() -> Table {
    Table::preset("pool-9ft").unwrap()
}

#[test]
fn body_is_closed_and_turned_outward() {
    let table = pool();
    let mut kinds: BTreeMap<Surface, usize> = BTreeMap::new();
    for f in &table.mesh.faces {
        *kinds.entry(f.surface).or_default() += 1;
    }
    println!("{kinds:?} {}", table.mesh.faces.len());
    let mut worst: Vec<_> = (0..table.mesh.faces.len())
        .map(|i| {
            let [a, b, c] = table.mesh.corners(i);
            let l = a.distance(b).max(b.distance(c)).max(c.distance(a));
            (l, (b - a).cross(c - a).length() / l, table.mesh.faces[i].surface, (a + b + c) / 3.0)
        })
        .collect();
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!("longest {:?}", &worst[..6]);
    worst.sort_by(|a, b| a.1.total_cmp(&b.1));
    println!("thinnest {:?}", &worst[..12]);
    assert_eq!(table.mesh.open_edges(), []);
    assert!(table.mesh.volume() > 0.0);
    println!("volume {}", table.mesh.volume());
    let _ = DVec3::ZERO;
}
