//! Tables: what balls play on, from one set of parameters, from mesh files or from planes.
//!
//! The origin is the middle of the bed, which lies at z = 0; x runs along it from head to foot,
//! y to the left, z up. All lengths in metres.
//!
//! A table for pool or carom is made from [`TableParameters`] alone: the closed mesh that balls
//! touch, the pockets that players aim at (if it has any), and, when somebody asks, the parts that
//! are drawn. All three agree because they share one plan; none is read from a model file.

mod parameters;

mod marks;

mod plan;

mod flat;

mod quarter;

mod pocketless;

mod pocket;

mod physics_mesh;

mod clearance;

mod display;

mod trim;

pub use display::{DisplayPart, Material};
pub use marks::{ClothMarks, HALF_LINE_M, SPOT_RADIUS_M};
pub use parameters::{Marks, PocketParameters, TableParameters};

use crate::events::Zone;
use crate::ids::PocketId;
use crate::mesh::{Mesh, ObjError, Surface, parse_obj};
use crate::rack::Spots;
use crate::shipped;
use glam::{DVec2, DVec3};

/// Why there is no table.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// No shipped table has this name.
    #[error("table preset '{name}' is unknown; shipped presets: {known}")]
    UnknownPreset {
        /// The name that was asked for.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// The text is no set of table parameters.
    #[error("table parameters cannot be read: {problem}")]
    Toml {
        /// What is wrong, with its place.
        problem: String,
    },
    /// A parameter is out of its range.
    #[error("table parameter {key} = {value} must be from {least} to {most}")]
    Parameter {
        /// Its name.
        key: String,
        /// Its value.
        value: f64,
        /// The least that is allowed, given the other parameters.
        least: f64,
        /// The most that is allowed.
        most: f64,
    },
    /// A table has all six pockets or none.
    #[error("a table with only [corner] or only [side] pockets; write both sections, or neither")]
    HalfPocketed,
    /// Each parameter is possible, but together they make no table.
    #[error(
        "the table's pockets, cushions and rails do not fit each other; \
         compare mouths, shelves, radii and widths with those of the preset pool-9ft"
    )]
    Shape,
    /// The mesh file is broken.
    #[error("mesh of the table: {0}")]
    Obj(#[from] ObjError),
}

/// A table, or any other ground to play on.
///
/// ```
/// use hapticbillard::table::Table;
///
/// let table = Table::preset("pool-9ft")?;
/// let bed = table.bed.ok_or("a pool table has a bed")?;
/// assert_eq!((bed.length_m, bed.width_m), (2.54, 1.27));
///
/// // How far it is from the foot spot to each pocket.
/// for pocket in &table.pockets {
///     println!("{}: {:.2} m", pocket.id, pocket.target().distance(bed.foot_spot()));
/// }
/// // What balls touch is one closed body.
/// assert!(table.mesh.open_edges().is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Its name, as scenes write it.
    pub name: String,
    /// The playing area, if it is a billiard table.
    pub bed: Option<Bed>,
    /// Its pockets, in the order of [`PocketId::ALL`]; none on a carom table.
    pub pockets: Vec<Pocket>,
    /// Everything that balls can touch, but for planes.
    pub mesh: Mesh,
    /// Half spaces, infinitely wide.
    pub planes: Vec<Plane>,
    /// Where balls return to.
    pub spots: Spots,
    /// What it was made from, if it is a billiard table.
    pub parameters: Option<TableParameters>,
}

impl Table {
    /// A shipped table by name, for example `pool-9ft`.
    pub fn preset(name: &str) -> Result<Table, TableError> {
        let text = shipped::table(name).ok_or_else(|| TableError::UnknownPreset {
            name: name.to_owned(),
            known: shipped::TABLES.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", "),
        })?;
        Table::from_parameters(name, TableParameters::from_toml(text)?)
    }

    /// A table of these dimensions, standing on an endless floor.
    pub fn from_parameters(name: &str, parameters: TableParameters) -> Result<Table, TableError> {
        parameters.check()?;
        let floor = Plane {
            point: DVec3::new(0.0, 0.0, -parameters.bed_height_m),
            normal: DVec3::Z,
            surface: Surface::Floor,
        };
        Ok(Table {
            name: name.to_owned(),
            bed: Some(Bed { length_m: parameters.length_m, width_m: parameters.width_m }),
            pockets: match parameters.pockets() {
                Some(kinds) => PocketId::ALL.map(|id| pocket(&parameters, kinds, id)).to_vec(),
                None => Vec::new(),
            },
            mesh: physics_mesh::physics_mesh(&parameters)?,
            planes: vec![floor],
            spots: Spots::default(),
            parameters: Some(parameters),
        })
    }

    /// Endless cloth at z = 0 and nothing else.
    pub fn plane() -> Table {
        let cloth = Plane { point: DVec3::ZERO, normal: DVec3::Z, surface: Surface::Cloth };
        Table { name: "plane".to_owned(), planes: vec![cloth], ..Table::default() }
    }

    /// A table from a Wavefront OBJ text; faces are obstacles unless their material says otherwise
    /// (see [`parse_obj`]).
    pub fn from_mesh(obj_text: &str) -> Result<Table, TableError> {
        let mesh = parse_obj(obj_text, Surface::Obstacle)?;
        Ok(Table { name: "mesh".to_owned(), mesh, ..Table::default() })
    }
}

/// A pocket as players see it.
fn pocket(
    parameters: &TableParameters,
    [corner, side]: [&PocketParameters; 2],
    id: PocketId,
) -> Pocket {
    let noses = 0.5 * DVec2::new(parameters.length_m, parameters.width_m);
    let (sx, sy) = match id {
        PocketId::Hl => (-1.0, 1.0),
        PocketId::Hr => (-1.0, -1.0),
        PocketId::Ml | PocketId::Fl => (1.0, 1.0),
        PocketId::Mr | PocketId::Fr => (1.0, -1.0),
    };
    let signs = DVec2::new(sx, sy);
    if id.is_side() {
        let half = 0.5 * side.mouth_m;
        return Pocket {
            id,
            mouth: [DVec2::new(-half, sy * noses.y), DVec2::new(half, sy * noses.y)],
            centre: signs * plan::side_centre(parameters, side),
            radius_m: side.radius_m,
            heading: DVec2::new(0.0, sy),
        };
    }
    let cut = corner.mouth_m * 0.5f64.sqrt();
    Pocket {
        id,
        mouth: [signs * (noses - DVec2::new(cut, 0.0)), signs * (noses - DVec2::new(0.0, cut))],
        centre: signs * plan::corner_centre(parameters, corner),
        radius_m: corner.radius_m,
        heading: signs * 0.5f64.sqrt(),
    }
}

/// How far beside the head spot the first cue ball of carom stands [m]: marks of the UMB for the
/// match table.
pub const CAROM_START_M: f64 = 0.1825;

/// Radius of snooker's D over the width of the bed: 11½ inches on a table 70 inches wide.
const D_RADIUS: f64 = 11.5 / 70.0;
/// Snooker's baulk line in front of the head cushion over the bed's length: 29 of 140½ inches.
const BAULK: f64 = 29.0 / 140.5;

/// The playing area between the noses of the cushions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bed {
    /// From nose to nose, along x [m].
    pub length_m: f64,
    /// From nose to nose, along y [m].
    pub width_m: f64,
}

impl Bed {
    /// Half its length and width [m].
    pub fn half(&self) -> DVec2 {
        0.5 * DVec2::new(self.length_m, self.width_m)
    }

    /// x of the head string [m].
    pub fn head_string_x(&self) -> f64 {
        -0.25 * self.length_m
    }

    /// x of snooker's baulk line [m].
    pub fn baulk_line_x(&self) -> f64 {
        (BAULK - 0.5) * self.length_m
    }

    /// Radius of snooker's D round the middle of the baulk line [m].
    pub fn d_radius_m(&self) -> f64 {
        D_RADIUS * self.width_m
    }

    /// Where a rack's apex ball stands [m].
    pub fn foot_spot(&self) -> DVec2 {
        DVec2::new(0.25 * self.length_m, 0.0)
    }

    /// The middle of the head string [m].
    pub fn head_spot(&self) -> DVec2 {
        DVec2::new(self.head_string_x(), 0.0)
    }

    /// Where a ball in hand is held at first [m]: over the head spot; for the D on the baulk line,
    /// in the middle between the spots of the brown and the yellow.
    pub fn home(&self, zone: Zone) -> DVec2 {
        match zone {
            Zone::D => DVec2::new(self.baulk_line_x(), -0.5 * self.d_radius_m()),
            Zone::Anywhere | Zone::Kitchen => self.head_spot(),
        }
    }

    /// Whether a place on the bed lies in a zone.
    pub fn in_zone(&self, zone: Zone, place: DVec2) -> bool {
        let middle = DVec2::new(self.baulk_line_x(), 0.0);
        match zone {
            Zone::Anywhere => true,
            Zone::Kitchen => place.x <= self.head_string_x(),
            // Written decimals of a place on the line are a hair off.
            Zone::D => {
                let slack = 1e-9;
                place.x <= middle.x + slack && place.distance(middle) <= self.d_radius_m() + slack
            }
        }
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
