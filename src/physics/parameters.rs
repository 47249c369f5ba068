//! The numbers of the contact laws.

use super::laws::choice::{BallLaw, CushionLaw, MultiContact};
use super::laws::cloth::Carrying;
use super::laws::mathavan_2010;
use super::laws::speed_friction::FrictionCurve;
use super::{Equipment, ExactTolerances, PhysicsSettings, Profile};
use crate::mesh::Surface;

/// Restitution and friction of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Newton's restitution of the normal speed at the contact.
    pub restitution: f64,
    /// Coulomb's friction coefficient.
    pub friction: f64,
}

/// All parameters of the contact laws. The values for pool are those of pooltool's and Alciatore's
/// property lists unless noted.
///
/// | | restitution | friction | |
/// |---|---|---|---|
/// | ball, ball | 0.95 | 0.05 | |
/// | ball, cloth | 0.5 | 0.2 | Alciatore; a ball dropped on slate and cloth |
/// | ball, cushion | 0.85 | 0.2 | |
/// | ball, pocket | 0.3 | 0.3 | leather and net; assumed |
/// | ball, wood or floor | 0.5 | 0.3 | assumed |
/// | ball, obstacle | 0.8 | 0.2 | assumed |
/// | tip, ball | 0.75 | 0.6 | leather; assumed, usual values |
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters {
    /// Two balls.
    pub ball: Contact,
    /// A ball and the bed, or flat ground.
    pub cloth: Contact,
    /// A ball and a cushion.
    pub cushion: Contact,
    /// A ball and the wall or bottom of a pocket.
    pub pocket: Contact,
    /// A ball and a rail's top or the floor.
    pub wood: Contact,
    /// A ball and anything else.
    pub obstacle: Contact,
    /// The tip and a ball.
    pub tip: Contact,
    /// Deceleration of a rolling ball over the normal acceleration.
    pub rolling_resistance: f64,
    /// Deceleration of the spin about the normal of what carries a ball [rad/s²].
    pub spin_deceleration_rad_s2: f64,
    /// Gravity, downwards [m/s²].
    pub gravity_m_s2: f64,
    /// Mass of the cue along its shaft [kg].
    pub cue_mass_kg: f64,
    /// Effective mass of its end across the shaft [kg].
    pub cue_end_mass_kg: f64,
    /// Radius of its tip's curvature [m].
    pub tip_radius_m: f64,
    /// Rate at which the hand draws a cue back to its path after a contact [rad/s]: the
    /// undamped frequency of the critically damped coupling.
    pub cue_coupling_rad_s: f64,
    /// Static friction over sliding friction; only `profile = "2009"` tells them apart (paper,
    /// section 2.4).
    pub static_over_sliding: f64,
    /// What two balls do to each other.
    pub ball_law: BallLaw,
    /// How friction between balls falls with their slip, where the law asks for it.
    pub ball_friction_curve: FrictionCurve,
    /// What a cushion does to a ball.
    pub cushion_law: CushionLaw,
    /// What several contacts at one instant do.
    pub multi_contact: MultiContact,
    /// From where on the exact solver is content with less than a closed form.
    pub exact: ExactTolerances,
    /// Whether a carried ball may be thrown up.
    pub flight: bool,
}

impl Parameters {
    /// Pool balls on a pool table under `profile = "standard"`.
    pub fn pool() -> Self {
        Parameters {
            ball: Contact { restitution: 0.95, friction: 0.05 },
            cloth: Contact { restitution: 0.5, friction: 0.2 },
            cushion: Contact { restitution: 0.85, friction: 0.2 },
            pocket: Contact { restitution: 0.3, friction: 0.3 },
            wood: Contact { restitution: 0.5, friction: 0.3 },
            obstacle: Contact { restitution: 0.8, friction: 0.2 },
            tip: Contact { restitution: 0.75, friction: 0.6 },
            rolling_resistance: 0.01,
            spin_deceleration_rad_s2: 10.0,
            gravity_m_s2: 9.81,
            cue_mass_kg: crate::cue::CUE_MASS_KG,
            cue_end_mass_kg: crate::cue::CUE_END_MASS_KG,
            tip_radius_m: crate::cue::TIP_RADIUS_M,
            cue_coupling_rad_s: 40.0,
            static_over_sliding: 1.0,
            ball_law: BallLaw::default(),
            ball_friction_curve: FrictionCurve::ALCIATORE,
            cushion_law: CushionLaw::default(),
            multi_contact: MultiContact::default(),
            exact: ExactTolerances::default(),
            flight: true,
        }
    }

    /// The paper's model (`profile = "2009"`). The report prints no coefficients; these give its
    /// figures: ball friction 0.33 with static friction a little above it brings the learner's
    /// factor to 0.45 (section 5.4.3). Cloth friction is half of the standard one, because the
    /// paper's normal force counts the weight of a lying ball twice: once as gravity and once as
    /// the collision that gravity causes in each step (section 2.4).
    pub fn paper_2009() -> Self {
        Parameters {
            ball: Contact { restitution: 0.9, friction: 0.33 },
            cloth: Contact { restitution: 0.5, friction: 0.1 },
            static_over_sliding: 1.1,
            ..Self::pool()
        }
    }

    /// The parameters that a scene's settings ask for.
    pub fn of(settings: &PhysicsSettings) -> Self {
        Self::with_equipment(settings, Equipment::Pool)
    }

    /// The same for another game's equipment. The paper's profile knows only its own.
    pub fn with_equipment(settings: &PhysicsSettings, equipment: Equipment) -> Self {
        let mut parameters = match settings.profile {
            Profile::Standard => equipment.parameters(),
            Profile::Paper2009 => Self::paper_2009(),
        };
        parameters.gravity_m_s2 = settings.gravity_m_s2;
        parameters.ball_law = settings.ball_law;
        parameters.cushion_law = settings.cushion_law;
        parameters.multi_contact = settings.multi_contact;
        parameters.exact = settings.exact;
        parameters.flight = settings.flight;
        if settings.cushion_law == CushionLaw::Mathavan2010 {
            parameters.cushion = mathavan_2010::CUSHION;
        }
        if !settings.ball_friction {
            parameters.ball.friction = 0.0;
            parameters.ball_friction_curve = FrictionCurve { a: 0.0, b: 0.0, c_s_m: 0.0 };
        }
        parameters
    }

    /// Restitution and friction between a ball and a surface.
    pub fn surface(&self, surface: Surface) -> Contact {
        match surface {
            Surface::Cloth => self.cloth,
            Surface::Cushion(_) => self.cushion,
            Surface::Pocket(_) | Surface::PocketBottom(_) => self.pocket,
            Surface::Wood | Surface::Floor => self.wood,
            Surface::Obstacle => self.obstacle,
        }
    }

    /// What a surface of that friction does to a ball that it carries.
    pub fn carrying(&self, friction: f64) -> Carrying {
        Carrying {
            friction,
            rolling_resistance: self.rolling_resistance,
            spin_deceleration_rad_s2: self.spin_deceleration_rad_s2,
        }
    }

    /// The first value that is impossible, with what is allowed.
    pub fn check(&self) -> Result<(), super::PhysicsError> {
        use super::PhysicsError::Setting;
        let contacts = [
            ("ball contact", self.ball),
            ("cloth contact", self.cloth),
            ("cushion contact", self.cushion),
            ("pocket contact", self.pocket),
            ("wood contact", self.wood),
            ("obstacle contact", self.obstacle),
            ("tip contact", self.tip),
        ];
        for (key, Contact { restitution, friction }) in contacts {
            if !(0.0..=1.0).contains(&restitution) {
                let allowed = "restitution must lie between 0 and 1";
                return Err(Setting { key, value: restitution, allowed });
            }
            if !(friction.is_finite() && 0.0 <= friction) {
                let allowed = "friction must be 0 or more";
                return Err(Setting { key, value: friction, allowed });
            }
        }
        let positive = "must be 0 or more";
        for (key, value) in [
            ("ball friction a", self.ball_friction_curve.a),
            ("ball friction b", self.ball_friction_curve.b),
            ("ball friction c", self.ball_friction_curve.c_s_m),
            ("rolling resistance", self.rolling_resistance),
            ("spin deceleration", self.spin_deceleration_rad_s2),
            ("gravity_m_s2", self.gravity_m_s2),
            ("cue coupling", self.cue_coupling_rad_s),
        ] {
            if !(value.is_finite() && 0.0 <= value) {
                return Err(Setting { key, value, allowed: positive });
            }
        }
        for (key, value) in [
            ("cue mass", self.cue_mass_kg),
            ("cue end mass", self.cue_end_mass_kg),
            ("tip radius", self.tip_radius_m),
            ("hop_m_s", self.exact.hop_m_s),
            ("lasting_step_ms", self.exact.lasting_step_s),
        ] {
            if !(value.is_finite() && 0.0 < value) {
                return Err(Setting { key, value, allowed: "must be more than 0" });
            }
        }
        Ok(())
    }
}
