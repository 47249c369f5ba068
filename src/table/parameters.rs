//! The numbers that make a table with or without pockets, and what they may be.
//!
//! One set of numbers makes everything: the faces that balls touch, the pockets that players aim
//! at, and the picture. The shipped set stands in `config/tables`, each number with its source.

use super::TableError;
use crate::one_line::one_line;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// What is wrong with a text, and in which line. The parser's own message has several lines.
fn with_line(text: &str, error: &toml::de::Error) -> String {
    let message = one_line(error.message(), 400);
    let before = error.span().and_then(|span| text.get(..span.start));
    let Some(before) = before else { return message };
    let index = before.matches('\n').count();
    let written = one_line(text.lines().nth(index).unwrap_or_default().trim(), 60);
    format!("line {}, '{written}': {message}", index + 1)
}

/// What is drawn on the cloth and set into the rails.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Marks {
    /// Head string, head spot, foot spot, and the sights on the rails.
    #[default]
    Pool,
    /// Baulk line, D and six spots; no sights.
    Snooker,
    /// Five spots, and the sights on the rails.
    Carom,
}

/// Dimensions of a table. Heights are above the cloth unless the name says otherwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableParameters {
    /// What is drawn on the cloth and set into the rails.
    #[serde(default)]
    pub marks: Marks,
    /// Playing area along x, nose to nose [m].
    pub length_m: f64,
    /// Playing area along y, nose to nose [m].
    pub width_m: f64,
    /// The cloth above the floor of the room [m].
    pub bed_height_m: f64,
    /// Diameter of the balls that the table is built for [m].
    pub ball_diameter_m: f64,
    /// Height of the nose over the diameter of a ball.
    pub nose_height_per_ball_diameter: f64,
    /// Rounding of the nose [m].
    pub nose_radius_m: f64,
    /// From the nose line back to the wood of the rail [m].
    pub cushion_width_m: f64,
    /// From the nose line back to where the rubber meets the cloth of the bed [m].
    pub cushion_foot_m: f64,
    /// From the nose line to the outer edge of the rail [m].
    pub rail_width_m: f64,
    /// Height of the top of the rail [m].
    pub rail_height_m: f64,
    /// Rounding of the rail's outer edge [m].
    pub rail_edge_radius_m: f64,
    /// Rounding of the table's outline in plan, at its four corners [m].
    pub outer_corner_radius_m: f64,
    /// Rounding of the slate's edge in a pocket [m]; 0 without pockets.
    #[serde(default)]
    pub drop_radius_m: f64,
    /// Bottom of the pockets below the cloth [m]; 0 without pockets.
    #[serde(default)]
    pub pocket_depth_m: f64,
    /// Underside of the frame below the cloth [m].
    pub body_depth_m: f64,
    /// Distance between neighbouring diamonds [m].
    #[serde(default)]
    pub diamond_pitch_m: f64,
    /// Middle of the diamonds behind the nose line [m].
    #[serde(default)]
    pub diamond_from_nose_m: f64,
    /// Length of a diamond, across the rail [m].
    #[serde(default)]
    pub diamond_length_m: f64,
    /// Width of a diamond, along the rail [m].
    #[serde(default)]
    pub diamond_width_m: f64,
    /// The four pockets in the corners; a table has both kinds or neither.
    pub corner: Option<PocketParameters>,
    /// The two pockets in the middle of the long rails.
    pub side: Option<PocketParameters>,
}

/// Dimensions of a pocket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PocketParameters {
    /// From nose tip to nose tip [m].
    pub mouth_m: f64,
    /// In plan, between the nose line and the jaw, through the rubber [deg].
    pub cut_angle_deg: f64,
    /// How far the jaw leans over the pocket from the vertical [deg].
    pub back_draft_deg: f64,
    /// From the middle of the mouth to the vertical cut of the slate [m].
    pub shelf_m: f64,
    /// Radius of the vertical cut of the slate [m].
    pub radius_m: f64,
}

impl TableParameters {
    /// Reads the parameters of a table from TOML.
    pub fn from_toml(text: &str) -> Result<Self, TableError> {
        let parameters: Self = toml::from_str(text)
            .map_err(|error| TableError::Toml { problem: with_line(text, &error) })?;
        parameters.check()?;
        Ok(parameters)
    }

    /// The pockets in the corners and in the middle of the long rails, on a table that has any.
    pub fn pockets(&self) -> Option<[&PocketParameters; 2]> {
        Some([self.corner.as_ref()?, self.side.as_ref()?])
    }

    /// Height of the cushion's nose above the cloth [m].
    pub fn nose_height_m(&self) -> f64 {
        self.nose_height_per_ball_diameter * self.ball_diameter_m
    }

    /// Half the outer length of the table along x [m].
    pub fn outer_x_m(&self) -> f64 {
        0.5 * self.length_m + self.rail_width_m
    }

    /// Half the outer width of the table along y [m].
    pub fn outer_y_m(&self) -> f64 {
        0.5 * self.width_m + self.rail_width_m
    }

    /// The middles of the sights, seven on each long rail (six where there is a pocket in the
    /// middle) and three on each short one, with the unit vector across the rail [m]. A snooker
    /// table has none.
    pub(super) fn sights(&self) -> Vec<(DVec2, DVec2)> {
        if self.marks == Marks::Snooker {
            return Vec::new();
        }
        let line =
            0.5 * DVec2::new(self.length_m, self.width_m) + DVec2::splat(self.diamond_from_nose_m);
        let pitch = self.diamond_pitch_m;
        let mut sights = Vec::new();
        for sign in [-1.0, 1.0] {
            let has_pocket = self.side.is_some();
            for k in [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0] {
                if k == 0.0 && has_pocket {
                    continue;
                }
                sights.push((DVec2::new(k * pitch, sign * line.y), DVec2::Y));
            }
            for k in [-1.0, 0.0, 1.0] {
                sights.push((DVec2::new(sign * line.x, k * pitch), DVec2::X));
            }
        }
        sights
    }

    /// Whether every number lies where a table can be built from it.
    pub fn check(&self) -> Result<(), TableError> {
        let ball = self.ball_diameter_m;
        let nose = self.nose_height_m();
        within("length_m", self.length_m, 1.0, 5.0)?;
        within("width_m", self.width_m, 0.5, 3.0)?;
        within("bed_height_m", self.bed_height_m, self.body_depth_m, 2.0)?;
        within("ball_diameter_m", ball, 0.03, 0.08)?;
        within("nose_height_per_ball_diameter", self.nose_height_per_ball_diameter, 0.5, 0.8)?;
        within("nose_radius_m", self.nose_radius_m, 0.0005, 0.2 * nose)?;
        within("cushion_width_m", self.cushion_width_m, 0.02, 0.1)?;
        let foot_most = 0.8 * self.cushion_width_m;
        within("cushion_foot_m", self.cushion_foot_m, 2.0 * self.nose_radius_m, foot_most)?;
        within("rail_height_m", self.rail_height_m, nose + self.nose_radius_m, ball)?;
        within("rail_width_m", self.rail_width_m, self.cushion_width_m + 0.03, 0.3)?;
        within("rail_edge_radius_m", self.rail_edge_radius_m, 0.001, 0.02)?;
        let corner_most = 0.8 * self.rail_width_m;
        within("outer_corner_radius_m", self.outer_corner_radius_m, 0.02, corner_most)?;
        if self.corner.is_some() || self.side.is_some() {
            within("drop_radius_m", self.drop_radius_m, 0.001, 0.02)?;
            let depth_least = ball + self.drop_radius_m;
            within("pocket_depth_m", self.pocket_depth_m, depth_least, 0.5)?;
        }
        within("body_depth_m", self.body_depth_m, self.pocket_depth_m.max(0.05) + 0.01, 1.0)?;
        if self.marks != Marks::Snooker {
            self.check_sights()?;
        }
        if self.corner.is_some() != self.side.is_some() {
            return Err(TableError::HalfPocketed);
        }
        let pockets = self.pockets().into_iter().flatten();
        for ((name, angle_least), pocket) in [("corner", 136.0), ("side", 92.0)].iter().zip(pockets)
        {
            let key = |field: &str| format!("{name}.{field}");
            within(&key("mouth_m"), pocket.mouth_m, 1.2 * ball, 4.0 * ball)?;
            within(&key("cut_angle_deg"), pocket.cut_angle_deg, *angle_least, 160.0)?;
            within(&key("back_draft_deg"), pocket.back_draft_deg, 0.0, 20.0)?;
            within(&key("shelf_m"), pocket.shelf_m, 0.0, 0.08)?;
            within(&key("radius_m"), pocket.radius_m, 0.7 * ball, 0.12)?;
        }
        Ok(())
    }

    fn check_sights(&self) -> Result<(), TableError> {
        within("diamond_pitch_m", self.diamond_pitch_m, 0.05, 0.2 * self.length_m)?;
        let least = self.cushion_width_m + 0.5 * self.diamond_length_m;
        within("diamond_from_nose_m", self.diamond_from_nose_m, least, self.rail_width_m)?;
        within("diamond_length_m", self.diamond_length_m, 0.001, 0.05)?;
        within("diamond_width_m", self.diamond_width_m, 0.001, 0.05)
    }
}

fn within(key: &str, value: f64, least: f64, most: f64) -> Result<(), TableError> {
    if least <= value && value <= most {
        return Ok(());
    }
    Err(TableError::Parameter { key: key.to_owned(), value, least, most })
}
