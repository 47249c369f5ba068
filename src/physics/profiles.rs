//! Parameter profiles: which balls on which cloth between which cushions.

use super::Parameters;
use super::laws::choice::CushionLaw;
use super::parameters::Contact;
use crate::ball::{Ball, CAROM_MASS_KG, CAROM_RADIUS_M, POOL_MASS_KG, POOL_RADIUS_M};
use crate::ball::{SNOOKER_MASS_KG, SNOOKER_RADIUS_M};
use crate::ids::BallId;
use serde::{Deserialize, Serialize};

/// A game's equipment.
///
/// | | pool | snooker | carom |
/// |---|---|---|---|
/// | radius | 28.575 mm | 26.25 mm | 30.75 mm |
/// | mass | 170 g | 140.6 g | 210 g |
/// | ball, ball e, μ | 0.95, 0.05 | 0.89, 0.05 | 0.95, 0.05 |
/// | ball, cloth μ | 0.2 | 0.21 | 0.2 |
/// | rolling resistance | 0.01 | 0.01274 | 0.01 |
/// | cushion e, μ | 0.85, 0.2 | 0.85, 0.2 | e(v), 0.15 |
///
/// Pool: pooltool's and Alciatore's property lists. Snooker: Mathavan, Jackson, Parkin 2009 (a
/// rolling ball loses 0.124 to 0.126 m/s², a sliding one 1.75 to 2.4) and 2014 (ball, radius, mass,
/// μ of the cloth); they give cushion values only for their own law
/// ([`super::laws::mathavan_2010`]), so the joint law keeps those of pool. Carom: pooltool for ball
/// and friction, Han 2005 for the cushion's restitution e(v) ([`super::laws::han_2005`]); cloth as
/// for pool.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Equipment {
    /// American pool.
    Pool,
    /// Snooker.
    Snooker,
    /// Carom, three-cushion.
    Carom,
}

impl Equipment {
    /// The parameters of the contact laws.
    pub fn parameters(self) -> Parameters {
        let pool = Parameters::pool();
        match self {
            Equipment::Pool => pool,
            Equipment::Snooker => Parameters {
                ball: Contact { restitution: 0.89, friction: 0.05 },
                cloth: Contact { friction: 0.21, ..pool.cloth },
                rolling_resistance: 0.125 / 9.81,
                ..pool
            },
            Equipment::Carom => Parameters {
                cushion: Contact { friction: 0.15, ..pool.cushion },
                cushion_law: CushionLaw::Han2005,
                ..pool
            },
        }
    }

    /// A ball of the set.
    pub fn ball(self, id: BallId) -> Ball {
        let (radius_m, mass_kg) = match self {
            Equipment::Pool => (POOL_RADIUS_M, POOL_MASS_KG),
            Equipment::Snooker => (SNOOKER_RADIUS_M, SNOOKER_MASS_KG),
            Equipment::Carom => (CAROM_RADIUS_M, CAROM_MASS_KG),
        };
        Ball { radius_m, mass_kg, ..Ball::pool(id) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_profile_is_possible_and_its_ball_has_the_weight_of_its_material() {
        for equipment in [Equipment::Pool, Equipment::Snooker, Equipment::Carom] {
            equipment.parameters().check().unwrap();
            let ball = equipment.ball(BallId(1));
            let volume = 4.0 / 3.0 * core::f64::consts::PI * ball.radius_m.powi(3);
            let density = ball.mass_kg / volume;
            assert!((1650.0..1900.0).contains(&density), "{equipment:?}: {density}");
        }
    }
}
