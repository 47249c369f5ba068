//! Friction between balls that falls with the speed of the slip.

/// μ(s) = a + b exp(−c s): a fit to measured throws.
///
/// | | value | |
/// |---|---|---|
/// | a | 0.009951 | what is left at high speed |
/// | b | 0.108 | what slow surfaces have on top |
/// | c | 1.088 s/m | how fast it falls |
///
/// Alciatore, TP A.14, fitted to Marlow, The Physics of Pocket Billiards (1995): 0.11 at 0.07 m/s,
/// 0.06 at 0.7 m/s, 0.01 at 7 m/s. Limits: μ is frozen at the slip of the first contact, so the
/// impact itself stays Coulomb's ([`super::ball_ball`]); that μ rises while the slip falls is left
/// out, as in TP A.14. Clean, dry phenolic balls; chalk or humidity change everything.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionCurve {
    /// What is left at high speed.
    pub a: f64,
    /// What slow surfaces have on top.
    pub b: f64,
    /// How fast it falls with the slip [s/m].
    pub c_s_m: f64,
}

impl FrictionCurve {
    /// The published fit.
    pub const ALCIATORE: FrictionCurve = FrictionCurve { a: 9.951e-3, b: 0.108, c_s_m: 1.088 };

    /// μ at a slip speed [m/s].
    pub fn at(&self, slip_m_s: f64) -> f64 {
        self.a + self.b * libm::exp(-self.c_s_m * slip_m_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fit_meets_the_three_measured_values() {
        for (slip, measured) in [(0.0707, 0.11), (0.707, 0.06), (7.07, 0.01)] {
            assert!((FrictionCurve::ALCIATORE.at(slip) - measured).abs() < 1.5e-3, "{slip}");
        }
    }
}
