//! Models of the hand on the stylus.

/// What holds the handle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HandModel {
    /// Nobody.
    None,
    /// A mass on the handle, drawn to the intent by spring and damper.
    Rigid {
        /// Mass [kg].
        mass_kg: f64,
        /// Damping against the room [N s/m].
        damping_ns_m: f64,
        /// Stiffness towards the intent [N/m].
        stiffness_n_m: f64,
    },
    /// The same, but the handle is held by the spring and damper of a grip.
    Grip {
        /// Stiffness of the grip [N/m].
        grip_n_m: f64,
        /// Damping of the grip [N s/m].
        grip_ns_m: f64,
        /// Mass of the arm [kg].
        mass_kg: f64,
        /// Its damping against the room [N s/m].
        damping_ns_m: f64,
        /// Its stiffness towards the intent [N/m].
        stiffness_n_m: f64,
    },
}

impl HandModel {
    /// L: light fingers, a weak case.
    pub const LIGHT: HandModel =
        HandModel::Rigid { mass_kg: 0.05, damping_ns_m: 1.0, stiffness_n_m: 60.0 };
    /// A: an arm that holds the handle stiffly. Van Beek et al. 2015, one fitted trial.
    pub const ARM: HandModel =
        HandModel::Rigid { mass_kg: 0.554, damping_ns_m: 6.45, stiffness_n_m: 135.0 };
    /// G: the same arm with a soft grip.
    pub const GRIP: HandModel = HandModel::gripped(1.5);
    /// F: the same arm with a firm grip.
    pub const FIRM: HandModel = HandModel::gripped(4.0);
    /// Somebody at a mouse: critically damped with the handle of an Omni, 35 ms behind the intent;
    /// 3.3 N displace it by 16 mm, which can be seen.
    pub const MOUSE: HandModel =
        HandModel::Rigid { mass_kg: 0.2, damping_ns_m: 14.0, stiffness_n_m: 200.0 };

    const fn gripped(grip_ns_m: f64) -> HandModel {
        HandModel::Grip {
            grip_n_m: 800.0,
            grip_ns_m,
            mass_kg: 0.554,
            damping_ns_m: 6.45,
            stiffness_n_m: 135.0,
        }
    }
}
