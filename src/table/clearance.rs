//! How steeply the cue must be held so that it clears the rail behind the cue ball.

use super::Table;
use super::parameters::TableParameters;
use crate::cue::{BUTT_RADIUS_M, CUE_LENGTH_M, SHAFT_RADIUS_M};
use glam::DVec2;

/// Points along the rail's cross section that are tested.
const SAMPLES: usize = 24;
/// Halvings of the angle: a quarter turn to 1e−12 rad.
const HALVINGS: usize = 40;

impl Table {
    /// Smallest elevation [rad] at which a cue that is aimed at the middle of the ball, along
    /// `azimuth_rad` from +x, clears cushion and rail behind the ball; 0 without a bed.
    ///
    /// The cue is a cone from tip to butt whose tip touches the ball. At distance l from the
    /// ball's middle its lower side has the height R + l sin ε − r(l) cos ε and lies
    /// l cos ε + r(l) sin ε behind the middle. Pockets count as rail.
    pub fn clearance_elevation(&self, cue_ball: DVec2, azimuth_rad: f64) -> f64 {
        let Some(parameters) = &self.parameters else { return 0.0 };
        let back = -DVec2::new(libm::cos(azimuth_rad), libm::sin(azimuth_rad));
        let half = 0.5 * DVec2::new(parameters.length_m, parameters.width_m);
        let leave = |widened: f64| distance_out(cue_ball, back, half + DVec2::splat(widened));
        let clears = |elevation: f64| {
            let (rise, run) = (libm::sin(elevation), libm::cos(elevation));
            (0..=SAMPLES).all(|i| {
                let behind_nose = cross_section(parameters, i);
                let height = height(parameters, behind_nose);
                match lower_side(parameters, leave(behind_nose), rise, run) {
                    Some(z) => height <= z,
                    None => true,
                }
            })
        };
        if clears(0.0) {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, core::f64::consts::FRAC_PI_2);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if clears(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }
}

/// How far behind the nose line sample `i` lies [m]: half of them on the cushion.
fn cross_section(parameters: &TableParameters, i: usize) -> f64 {
    let half = SAMPLES / 2;
    if i <= half {
        return parameters.cushion_width_m * i as f64 / half as f64;
    }
    let wood = parameters.rail_width_m - parameters.cushion_width_m;
    parameters.cushion_width_m + wood * (i - half) as f64 / half as f64
}

/// Height of cushion or rail there [m].
fn height(parameters: &TableParameters, behind_nose: f64) -> f64 {
    let nose = parameters.nose_height_m() + parameters.nose_radius_m;
    let share = (behind_nose / parameters.cushion_width_m).min(1.0);
    nose + (parameters.rail_height_m - nose) * share
}

/// Height of the cue's lower side `behind` the ball's middle [m]; `None` where there is no cue.
fn lower_side(parameters: &TableParameters, behind: f64, rise: f64, run: f64) -> Option<f64> {
    let ball = 0.5 * parameters.ball_diameter_m;
    let taper = (BUTT_RADIUS_M - SHAFT_RADIUS_M) / CUE_LENGTH_M;
    let thickness = |l: f64| SHAFT_RADIUS_M + taper * (l - ball);
    let along = (behind - thickness(0.0) * rise) / (run + taper * rise);
    let is_cue = ball <= along && along <= ball + CUE_LENGTH_M;
    is_cue.then(|| ball + along * rise - thickness(along) * run)
}

/// How far it is from `from` along `direction` out of the box of this half size [m].
fn distance_out(from: DVec2, direction: DVec2, half: DVec2) -> f64 {
    let along = |from: f64, direction: f64, half: f64| {
        if direction == 0.0 {
            f64::INFINITY
        } else {
            (half - from * direction.signum()) / direction.abs()
        }
    };
    along(from.x, direction.x, half.x).min(along(from.y, direction.y, half.y)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cue_is_level_in_the_open_and_steep_at_the_rail() {
        let table = Table::preset("pool-9ft").unwrap();
        // From the middle along the table the butt ends over the bed's head half: 1.47 m of cue
        // against 1.27 m to the nose, so it must rise a little.
        let centre = table.clearance_elevation(DVec2::ZERO, 0.0).to_degrees();
        assert!((0.5..2.5).contains(&centre), "{centre}");
        // Far from the rail behind: no cue over the rail at all.
        assert_eq!(table.clearance_elevation(DVec2::new(0.5, 0.0), 0.0), 0.0);
        // Frozen on the head rail, shooting straight away from it.
        let frozen = table.clearance_elevation(DVec2::new(-1.27 + 0.0286, 0.0), 0.0).to_degrees();
        assert!((8.0..40.0).contains(&frozen), "{frozen}");
        assert_eq!(Table::plane().clearance_elevation(DVec2::ZERO, 0.0), 0.0);
    }

    #[test]
    fn nearer_to_the_rail_is_steeper() {
        let table = Table::preset("pool-9ft").unwrap();
        let elevations: Vec<f64> = (0..12)
            .map(|i| table.clearance_elevation(DVec2::new(-1.2 + 0.1 * f64::from(i), 0.2), 0.3))
            .collect();
        assert!(elevations.windows(2).all(|pair| pair[0] > pair[1]), "{elevations:?}");
    }

    #[test]
    fn elevation_is_the_same_in_the_mirror() {
        let table = Table::preset("pool-9ft").unwrap();
        let here = table.clearance_elevation(DVec2::new(-1.1, 0.3), 0.4);
        let there = table.clearance_elevation(DVec2::new(-1.1, -0.3), -0.4);
        assert!((here - there).abs() < 1e-11, "{here} {there}");
    }
}
