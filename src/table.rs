//! Tables: what balls play on, from one set of parameters, from mesh files or from planes.
//!
//! The origin is the middle of the bed, which lies at z = 0; x runs along it from head to foot,
//! y to the left, z up. All lengths in metres.

use crate::ids::PocketId;
use crate::mesh::{Mesh, Surface};
use glam::{DVec2, DVec3};

/// A table, or any other ground to play on.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Its name, as scenes write it.
    pub name: String,
    /// The playing area, if it is a billiard table.
    pub bed: Option<Bed>,
    /// Its pockets, in the order of [`PocketId::ALL`].
    pub pockets: Vec<Pocket>,
    /// Everything that balls can touch, but for planes.
    pub mesh: Mesh,
    /// Half spaces, infinitely wide.
    pub planes: Vec<Plane>,
}

/// The playing area between the noses of the cushions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bed {
    /// From nose to nose, along x [m].
    pub length_m: f64,
    /// From nose to nose, along y [m].
    pub width_m: f64,
}

impl Bed {
    /// x of the head string [m].
    pub fn head_string_x(&self) -> f64 {
        -0.25 * self.length_m
    }

    /// Where a rack's apex ball stands [m].
    pub fn foot_spot(&self) -> DVec2 {
        DVec2::new(0.25 * self.length_m, 0.0)
    }

    /// The middle of the head string [m].
    pub fn head_spot(&self) -> DVec2 {
        DVec2::new(self.head_string_x(), 0.0)
    }

    /// Whether a ball of this radius lies between the noses without touching one.
    pub fn holds(&self, position: DVec2, radius_m: f64) -> bool {
        position.x.abs() + radius_m <= 0.5 * self.length_m
            && position.y.abs() + radius_m <= 0.5 * self.width_m
    }
}

/// A pocket, as players see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pocket {
    /// Its name.
    pub id: PocketId,
    /// The two nose tips of its mouth [m].
    pub mouth: [DVec2; 2],
    /// Middle of the drop opening in the slate [m].
    pub centre: DVec2,
    /// Radius of that opening [m].
    pub radius_m: f64,
    /// Unit vector from the bed into the pocket.
    pub heading: DVec2,
}

impl Pocket {
    /// Where a player aims: the middle between the nose tips [m].
    pub fn target(&self) -> DVec2 {
        0.5 * (self.mouth[0] + self.mouth[1])
    }
}

/// A half space: solid below, `normal` points to the free side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point of its surface [m].
    pub point: DVec3,
    /// Unit vector to the free side.
    pub normal: DVec3,
    /// What it is made of.
    pub surface: Surface,
}
