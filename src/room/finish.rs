//! What things are made of: colour, grain, gloss, glow.

use super::grain::Grain;

/// A surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finish {
    /// The texture that its colour is multiplied with, 1 on average.
    pub grain: Grain,
    /// Share of the light that it throws back, linear.
    pub colour: [f32; 3],
    /// How much of a mirror it is: 0 for cloth, 1 for lacquer, more for metal.
    pub gloss: f32,
    /// What it gives off by itself [radiance, in units of the light that falls on a white surface
    /// in full light].
    pub emission: [f32; 3],
}

impl Finish {
    const fn of(grain: Grain, colour: [f32; 3], gloss: f32) -> Self {
        Finish { grain, colour, gloss, emission: [0.0; 3] }
    }

    /// A lamp of this colour, so many times as bright; it throws back nothing.
    const fn lit(colour: [f32; 3], times: f32) -> Self {
        let [r, g, b] = colour;
        let emission = [r * times, g * times, b * times];
        Finish { grain: Grain::Plain, colour: [0.0; 3], gloss: 0.0, emission }
    }

    /// Something matt that throws back and gives off the same in all colours.
    pub const fn grey(albedo: f32, emission: f32) -> Self {
        let emission = [emission; 3];
        Finish { emission, ..Finish::of(Grain::Plain, [albedo; 3], 0.0) }
    }

    /// Whether it gives off anything.
    pub fn shines(&self) -> bool {
        self.emission != [0.0; 3]
    }
}

/// Bricks of the walls.
pub(super) const BRICK: Finish = Finish::of(Grain::Brick, [0.235, 0.105, 0.068], 0.0);
/// Bricks of the vault, under old whitewash.
pub(super) const VAULT: Finish = Finish::of(Grain::Brick, [0.36, 0.27, 0.20], 0.0);
/// Dressed stone of pilasters and ribs.
pub(super) const STONE: Finish = Finish::of(Grain::Stone, [0.30, 0.255, 0.205], 0.0);
/// The floor.
pub(super) const BOARDS: Finish = Finish::of(Grain::Boards, [0.175, 0.094, 0.049], 0.25);
/// Panels along the walls and the front of the bar.
pub(super) const PANELS: Finish = Finish::of(Grain::Panels, [0.105, 0.047, 0.023], 0.2);
/// Rails, frames, furniture.
pub(super) const OAK: Finish = Finish::of(Grain::Wood, [0.145, 0.064, 0.029], 0.3);
/// Polished tops.
pub(super) const POLISHED: Finish = Finish::of(Grain::Wood, [0.17, 0.070, 0.030], 0.9);
/// The table's apron and legs, as the table's own shader has its dark wood.
pub(super) const TABLE_WOOD: Finish = Finish::of(Grain::Wood, [0.100, 0.036, 0.016], 0.35);
/// Shafts of cues.
pub(super) const MAPLE: Finish = Finish::of(Grain::Wood, [0.52, 0.36, 0.19], 0.5);
/// Butts of cues, and ebony.
pub(super) const EBONY: Finish = Finish::of(Grain::Wood, [0.045, 0.022, 0.014], 0.6);
/// Oxblood leather.
pub(super) const LEATHER: Finish = Finish::of(Grain::Leather, [0.135, 0.026, 0.019], 0.35);
/// Brass.
pub(super) const BRASS: Finish = Finish::of(Grain::Plain, [0.42, 0.29, 0.11], 1.8);
/// Black iron.
pub(super) const IRON: Finish = Finish::of(Grain::Plain, [0.025, 0.024, 0.023], 0.5);
/// Slate to write on.
pub(super) const SLATE: Finish = Finish::of(Grain::Plaster, [0.030, 0.034, 0.033], 0.1);
/// Chalk.
pub(super) const CHALK: Finish = Finish::of(Grain::Plaster, [0.62, 0.62, 0.58], 0.0);
/// Paper of posters.
pub(super) const PAPER: Finish = Finish::of(Grain::Plaster, [0.62, 0.52, 0.36], 0.0);
/// Cork.
pub(super) const CORK: Finish = Finish::of(Grain::Plaster, [0.30, 0.18, 0.09], 0.0);
/// A mirror that has seen much smoke.
pub(super) const MIRROR: Finish = Finish::of(Grain::Plaster, [0.11, 0.10, 0.085], 0.3);
/// Enamel of the lamp's shades outside, and inside.
pub(super) const SHADE: Finish = Finish::of(Grain::Plain, [0.012, 0.085, 0.045], 1.2);
/// See [`SHADE`].
pub(super) const SHADE_INSIDE: Finish = Finish::of(Grain::Plain, [0.80, 0.74, 0.62], 0.0);
/// Colour of the light of the lamps, as the shaders have it.
pub(super) const LAMP_GLASS: Finish = Finish::lit([1.0, 0.93, 0.80], super::lamp::RADIANCE);
/// What leaves a shade at its top, where the lamp is bare.
pub(super) const LAMP_TOP: Finish = Finish::lit([1.0, 0.86, 0.66], 130.0);
/// Small lamps: sconces and the light over shelves.
pub(super) const SMALL_LAMP: Finish = Finish::lit([1.0, 0.60, 0.27], 110.0);
/// A strip over a shelf.
pub(super) const STRIP: Finish = Finish::lit([1.0, 0.64, 0.31], 38.0);
/// The night outside.
pub(super) const NIGHT: Finish = Finish::lit([0.28, 0.45, 1.0], 1.6);

/// Paint of any colour.
pub(super) const fn paint(colour: [f32; 3]) -> Finish {
    Finish::of(Grain::Plain, colour, 0.25)
}

/// Glass of any colour.
pub(super) const fn glass(colour: [f32; 3]) -> Finish {
    Finish::of(Grain::Plain, colour, 1.3)
}

/// The cloth and the wood of the table, as its own shaders have them on average, for what they
/// throw back.
pub(super) fn of_table(material: crate::table::Material) -> Finish {
    use crate::table::Material;
    match material {
        Material::Cloth => Finish::of(Grain::Plain, [0.012, 0.205, 0.098], 0.0),
        Material::CushionCloth => Finish::of(Grain::Plain, [0.010, 0.170, 0.082], 0.0),
        Material::Wood => Finish::of(Grain::Wood, [0.19, 0.07, 0.028], 0.3),
        Material::DarkWood | Material::Floor => TABLE_WOOD,
        Material::Casting => Finish::of(Grain::Plain, [0.30, 0.26, 0.20], 1.6),
        Material::Leather => Finish::of(Grain::Plain, [0.012, 0.010, 0.009], 0.0),
        Material::Diamond | Material::Line => Finish::of(Grain::Plain, [0.80, 0.77, 0.68], 0.3),
    }
}
