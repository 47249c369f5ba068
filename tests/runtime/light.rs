//! Shipped light: it belongs to the rooms that are drawn, and it is what a baker computes.

use glam::Vec3;
use hapticbillard::room::{Baker, LightMap, Pass, Room};
use hapticbillard::shipped;
use hapticbillard::table::Table;
use hapticbillard_actors::renderer::{decode_light, encode_light, shipped_light};

fn room(name: &str) -> Room {
    Room::around(&Table::preset(name).unwrap()).unwrap()
}

#[test]
fn every_shipped_table_has_light_that_was_baked_for_its_room() {
    for (name, _) in shipped::TABLES {
        let room = room(name);
        let map = shipped_light(name, &room);
        assert!(map.is_ok(), "{name}: {}; run `make light`", map.unwrap_err());
    }
    let bytes: usize = hapticbillard_assets::LIGHT.iter().map(|(_, file)| file.len()).sum();
    assert!(bytes < 3_000_000, "{bytes} bytes");
}

#[test]
fn light_of_another_table_is_refused_with_the_way_out() {
    let wrong = shipped_light("pool-7ft", &room("pool-9ft")).unwrap_err().to_string();
    assert!(wrong.contains("baked for a room") && wrong.contains("hapticbillard bake"), "{wrong}");
    let wrong = shipped_light("pool-6ft", &room("pool-9ft")).unwrap_err().to_string();
    assert!(wrong.contains("none is shipped"), "{wrong}");
    assert!(decode_light(b"no picture").unwrap_err().to_string().contains("cannot be read"));
}

#[test]
fn a_picture_of_light_gives_back_every_texel() {
    let texels = (0..=255u8).map(|k| [k, 255 - k, k / 2]).collect();
    let map = LightMap { size: [16, 16], texels };
    assert_eq!(decode_light(&encode_light(&map).unwrap()).unwrap(), map);
}

/// How far light is from what it gives when it is computed once more from itself: lamps anew, and
/// one bounce of the map's own light. Mean over every so-manieth texel, relative.
fn error(room: &Room, map: &LightMap) -> f32 {
    let mut baker = Baker::new(&room.surfaces, 48);
    baker.go_on_from(map);
    let (mut sum, mut count) = (0.0, 0.0);
    for k in (0..baker.texels()).step_by(151) {
        let [x, y] = baker.place(k);
        let (bounced, inside) = baker.light(Pass::Bounce(1), k);
        // Under furniture the light is that of what is beside it.
        if 0.05 < inside {
            continue;
        }
        let now = baker.light(Pass::Direct, k).0 + bounced;
        let baked = Vec3::from(map.light(x, y));
        let now = now.min(Vec3::splat(2.0));
        sum += (now - baked).abs().element_sum() / (now + baked + 0.03).element_sum() * 2.0;
        count += 1.0;
    }
    assert!(500.0 < count, "{count} texels");
    sum / count
}

#[test]
fn shipped_light_is_that_of_its_room_within_a_twelfth() {
    let room = room("pool-9ft");
    let map = shipped_light("pool-9ft", &room).unwrap();
    let shipped = error(&room, &map);
    let unbaked = error(&room, &LightMap::unbaked(&room));
    println!("relative error of the shipped light {shipped:.4}, of none {unbaked:.4}");
    assert!(shipped < 0.083, "{shipped}");
    assert!(4.0 * shipped < unbaked, "{shipped} {unbaked}");
}
