//! Where an eye can be: in a room, and not in what stands there.

use crate::table::Bed;
use glam::{DVec2, DVec3};

/// The room round a table, from its floor, and how far its walls are from the middle [m].
const WALLS: (DVec3, DVec3) = (DVec3::new(-4.0, -3.25, -0.6), DVec3::new(4.0, 3.25, f64::INFINITY));
/// The ceiling that stops an eye on foot [m]; from a view above the table there is none.
const CEILING_M: f64 = 2.2;
/// How much wider and longer a table is than its bed, how low it reaches and how high [m].
const TABLE_M: (f64, f64, f64) = (0.3, -0.8, 0.045);
/// What keeps this distance from everything [m]: the ball that an eye hangs on.
const RADIUS_M: f64 = 0.055;
/// Half the lamp over the table, its lower and its upper side [m].
const LAMP_M: (DVec2, f64, f64) = (DVec2::new(1.02, 0.19), 1.03, 1.30);

/// A room, as coarse as an eye needs it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Room {
    walls: Option<(DVec3, DVec3)>,
    /// What stands or hangs in it: lower and upper corners [m].
    boxes: Vec<(DVec3, DVec3)>,
}

impl Room {
    /// The room round a table with this bed. Where there is no bed there is no room: an eye can be
    /// anywhere.
    pub fn round(bed: Option<&Bed>) -> Self {
        let Some(bed) = bed else { return Room::default() };
        let (wider, low, high) = TABLE_M;
        let half = bed.half() + DVec2::splat(0.5 * wider);
        let (lamp, under, over) = LAMP_M;
        let boxes = vec![
            ((-half).extend(low), half.extend(high)),
            ((-lamp).extend(under), lamp.extend(over)),
        ];
        Room { walls: Some(WALLS), boxes }
    }

    /// The same with what else stands there: lower and upper corners [m].
    #[must_use]
    pub fn with(mut self, boxes: impl IntoIterator<Item = (DVec3, DVec3)>) -> Self {
        self.boxes.extend(boxes);
        self
    }

    /// The place nearest to `at` [m] where an eye can be that is on its way to another. What hangs
    /// over the table stops nobody who goes above it: from there one looks through it.
    pub fn outside(&self, at: DVec3, towards: DVec3) -> DVec3 {
        let mut at = match self.walls {
            Some((low, high)) => at.clamp(low + RADIUS_M, high - RADIUS_M),
            None => at,
        };
        for (low, high) in &self.boxes {
            if 0.0 < low.z && low.z < towards.z {
                continue;
            }
            let (low, high) = (*low - RADIUS_M, *high + RADIUS_M);
            if !(at.cmpgt(low).all() && at.cmplt(high).all()) {
                continue;
            }
            // Out by the shortest way, which from a table is never down through its legs.
            let ways = [
                (at.x - low.x, DVec3::X * (low.x - at.x)),
                (high.x - at.x, DVec3::X * (high.x - at.x)),
                (at.y - low.y, DVec3::Y * (low.y - at.y)),
                (high.y - at.y, DVec3::Y * (high.y - at.y)),
                (at.z - low.z, DVec3::Z * (low.z - at.z)),
                (high.z - at.z, DVec3::Z * (high.z - at.z)),
            ];
            let shortest = ways.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
            at += shortest.map_or(DVec3::ZERO, |(_, way)| way);
        }
        at
    }

    /// The same place, not above the ceiling.
    pub fn under_ceiling(&self, at: DVec3) -> DVec3 {
        if self.walls.is_some() { at.with_z(at.z.min(CEILING_M)) } else { at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room() -> Room {
        Room::round(Some(&Bed { length_m: 2.54, width_m: 1.27 }))
    }

    #[test]
    fn nothing_is_in_a_wall_in_the_table_or_in_the_lamp() {
        let room = room();
        let outside = |x, y, z| room.outside(DVec3::new(x, y, z), DVec3::ZERO);
        // Free places stay, bit for bit.
        assert_eq!(outside(-2.6, -1.1, 1.5), DVec3::new(-2.6, -1.1, 1.5));
        assert_eq!(outside(0.0, 0.0, 0.5), DVec3::new(0.0, 0.0, 0.5));
        let corner = outside(9.0, -9.0, -3.0);
        assert!(corner.distance(DVec3::new(3.945, -3.195, -0.545)) < 1e-12, "{corner}");
        // Out of the table upwards near its top, aside near its side.
        let above = outside(0.3, 0.2, 0.03);
        assert!(above.truncate() == DVec2::new(0.3, 0.2) && (above.z - 0.1).abs() < 1e-12);
        let aside = outside(0.0, 0.7, -0.3);
        assert!((aside.y - 0.84).abs() < 1e-12 && aside.z == -0.3, "{aside}");
        let beneath = outside(0.0, 0.0, 1.1);
        assert!((beneath.z - 0.975).abs() < 1e-12, "{beneath}");
        assert_eq!(room.outside(DVec3::Z * 1.1, DVec3::Z * 2.4), DVec3::Z * 1.1);
        assert_eq!(room.under_ceiling(DVec3::Z * 3.0), DVec3::Z * 2.2);
        assert_eq!(Room::round(None).outside(DVec3::ZERO, DVec3::ZERO), DVec3::ZERO);
    }

    #[test]
    fn who_is_pushed_out_stays_out() {
        let room = room();
        for n in 0..4_000_u32 {
            let of = |k: u32| f64::from(n.wrapping_mul(k) % 1009) / 1009.0 - 0.5;
            let at = DVec3::new(10.0 * of(7919), 9.0 * of(104_729), 4.0 * of(1_299_709));
            let once = room.outside(at, DVec3::ZERO);
            assert!(room.outside(once, DVec3::ZERO).distance(once) < 1e-9, "{at} {once}");
        }
    }
}
