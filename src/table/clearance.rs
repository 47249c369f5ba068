//! How steeply the cue must be held so that it clears the rail behind the cue ball.

use super::Table;
use super::parameters::TableParameters;
use crate::cue::{Aim, BUTT_RADIUS_M, CUE_LENGTH_M, SHAFT_RADIUS_M};
use glam::DVec2;

/// Halvings of the angle: a quarter turn to 1e−12 rad.
const HALVINGS: usize = 40;

impl Table {
    /// Smallest elevation [rad] at which the cue of `aim` clears cushion and rail behind the ball;
    /// its own elevation does not matter. 0 without a bed.
    ///
    /// The cue is a cone from tip to butt whose tip touches the ball, and whose axis passes the
    /// ball's middle b above it. At distance l from the middle its lower side has the height
    /// R + l sin ε − (r(l) − b) cos ε and lies l cos ε + (r(l) − b) sin ε behind the middle.
    /// Pockets count as rail.
    pub fn clearance_elevation(&self, cue_ball: DVec2, aim: &Aim) -> f64 {
        let Some(parameters) = &self.parameters else { return 0.0 };
        let (right_m, above_m) = aim.axis_offset(0.5 * parameters.ball_diameter_m);
        let back = -DVec2::new(libm::cos(aim.azimuth_rad), libm::sin(aim.azimuth_rad));
        let from = cue_ball + aim.right().truncate() * right_m;
        let rails = [
            Rail::new(parameters, from.x, back.x, parameters.length_m),
            Rail::new(parameters, from.y, back.y, parameters.width_m),
        ];
        let clears = |elevation_rad: f64| {
            let cue = LowerSide::new(parameters, elevation_rad, above_m);
            rails.iter().flatten().all(|rail| rail.is_below(&cue))
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

/// Cushion and rail that the cue's plane cuts behind the ball: the height is straight from the nose
/// to the wood, and level from there to the outer edge.
struct Rail<'a> {
    parameters: &'a TableParameters,
    /// How far behind the ball's middle the nose is, and how far one metre across the rail is [m].
    nose_at_m: f64,
    per_m: f64,
}

impl<'a> Rail<'a> {
    /// The rail that is met from a coordinate of the cue ball along the same coordinate of the way
    /// back, on a bed of this size [m]; none if the cue lies along it.
    fn new(parameters: &'a TableParameters, from: f64, back: f64, size_m: f64) -> Option<Self> {
        let per_m = 1.0 / back.abs();
        let nose_at_m = (0.5 * size_m - from * back.signum()) * per_m;
        per_m.is_finite().then_some(Rail { parameters, nose_at_m, per_m })
    }

    /// Whether the cue passes over it. Both are straight from corner to corner of the rail, so that
    /// corners and the cue's ends decide.
    fn is_below(&self, cue: &LowerSide) -> bool {
        let width_m = self.parameters.rail_width_m;
        let corners = [0.0, self.parameters.cushion_width_m, width_m].map(|across| {
            let along = cue.along(self.nose_at_m + across * self.per_m);
            cue.has(along).then_some((across, along))
        });
        let ends = cue.ends_m.map(|along| {
            let across = (cue.behind(along) - self.nose_at_m) / self.per_m;
            (0.0..=width_m).contains(&across).then_some((across, along))
        });
        let mut places = corners.into_iter().chain(ends).flatten();
        places.all(|(across, along)| self.height(across) <= cue.height(along))
    }

    /// Height of cushion or rail so far behind the nose [m].
    fn height(&self, behind_nose: f64) -> f64 {
        let nose = self.parameters.nose_height_m() + self.parameters.nose_radius_m;
        let share = (behind_nose / self.parameters.cushion_width_m).min(1.0);
        nose + (self.parameters.rail_height_m - nose) * share
    }
}

/// The lower side of a cue that is held so steeply, along its axis from the ball's middle.
struct LowerSide {
    rise: f64,
    run: f64,
    ball_radius_m: f64,
    /// Radius that the cone would have at the ball's middle, as far as it lies under it [m].
    thickness_m: f64,
    taper: f64,
    /// Where tip and butt are [m].
    ends_m: [f64; 2],
}

impl LowerSide {
    fn new(parameters: &TableParameters, elevation_rad: f64, above_m: f64) -> Self {
        let (rise, run) = libm::sincos(elevation_rad);
        let ball_radius_m = 0.5 * parameters.ball_diameter_m;
        let taper = (BUTT_RADIUS_M - SHAFT_RADIUS_M) / CUE_LENGTH_M;
        let thickness_m = SHAFT_RADIUS_M - above_m - taper * ball_radius_m;
        let ends_m = [ball_radius_m, ball_radius_m + CUE_LENGTH_M];
        LowerSide { rise, run, ball_radius_m, thickness_m, taper, ends_m }
    }

    fn has(&self, along: f64) -> bool {
        (self.ends_m[0]..=self.ends_m[1]).contains(&along)
    }

    fn thickness(&self, along: f64) -> f64 {
        self.thickness_m + self.taper * along
    }

    /// How far behind the ball's middle it is there [m].
    fn behind(&self, along: f64) -> f64 {
        along * self.run + self.thickness(along) * self.rise
    }

    /// Where it is so far behind the ball's middle.
    fn along(&self, behind: f64) -> f64 {
        (behind - self.thickness_m * self.rise) / (self.run + self.taper * self.rise)
    }

    /// Its height over the bed there [m].
    fn height(&self, along: f64) -> f64 {
        self.ball_radius_m + along * self.rise - self.thickness(along) * self.run
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frozen on the head rail.
    const FROZEN: DVec2 = DVec2::new(-1.27 + 0.0286, 0.0);

    fn along(azimuth_rad: f64) -> Aim {
        Aim { azimuth_rad, ..Aim::default() }
    }

    #[test]
    fn cue_is_level_in_the_open_and_steep_at_the_rail() {
        let table = Table::preset("pool-9ft").unwrap();
        // From the middle along the table the butt ends over the bed's head half: 1.47 m of cue
        // against 1.27 m to the nose, so it must rise a little.
        let centre = table.clearance_elevation(DVec2::ZERO, &Aim::default()).to_degrees();
        assert!((0.5..2.5).contains(&centre), "{centre}");
        // Far from the rail behind: no cue over the rail at all.
        assert_eq!(table.clearance_elevation(DVec2::new(0.5, 0.0), &Aim::default()), 0.0);
        // Frozen on the head rail, shooting straight away from it.
        let frozen = table.clearance_elevation(FROZEN, &Aim::default()).to_degrees();
        assert!((8.0..40.0).contains(&frozen), "{frozen}");
        assert_eq!(Table::plane().clearance_elevation(DVec2::ZERO, &Aim::default()), 0.0);
    }

    #[test]
    fn nearer_to_the_rail_is_steeper() {
        let table = Table::preset("pool-9ft").unwrap();
        let elevations: Vec<f64> = (0..12)
            .map(|i| {
                table.clearance_elevation(DVec2::new(-1.2 + 0.1 * f64::from(i), 0.2), &along(0.3))
            })
            .collect();
        assert!(elevations.windows(2).all(|pair| pair[0] > pair[1]), "{elevations:?}");
    }

    #[test]
    fn elevation_is_the_same_in_the_mirror() {
        let table = Table::preset("pool-9ft").unwrap();
        let here = table.clearance_elevation(DVec2::new(-1.1, 0.3), &along(0.4));
        let there = table.clearance_elevation(DVec2::new(-1.1, -0.3), &along(-0.4));
        assert!((here - there).abs() < 1e-11, "{here} {there}");
    }

    #[test]
    fn lower_tip_is_steeper_at_the_rail() {
        let table = Table::preset("pool-9ft").unwrap();
        let at = |height_offset| {
            table.clearance_elevation(FROZEN, &Aim { height_offset, ..Aim::default() })
        };
        assert!(at(0.0) < at(-0.2) && at(-0.2) < at(-0.4), "{} {} {}", at(0.0), at(-0.2), at(-0.4));
        assert!(at(0.4) < at(0.0));
        // No part of the shaft is below the rail's top where it passes over it: measured anew.
        let parameters = table.parameters.as_ref().unwrap();
        let rail = Rail::new(parameters, FROZEN.x, -1.0, parameters.length_m).unwrap();
        let aim = Aim { height_offset: -0.4, elevation_rad: at(-0.4), ..Aim::default() };
        let tip = aim.tip_at_contact(FROZEN.extend(0.0286), 0.0286);
        // The shaft's cone goes on to the ball, before the middle of the tip's sphere.
        let lowest = (-7..1450).filter_map(|mm| {
            let back = f64::from(mm) * 1e-3;
            let radius = SHAFT_RADIUS_M + back / CUE_LENGTH_M * (BUTT_RADIUS_M - SHAFT_RADIUS_M);
            let under = tip - aim.direction() * back - aim.up() * radius;
            let behind_nose = -0.5 * parameters.length_m - under.x;
            let is_over = (0.0..parameters.rail_width_m).contains(&behind_nose);
            is_over.then(|| under.z - rail.height(behind_nose))
        });
        let gap = lowest.fold(f64::INFINITY, f64::min);
        assert!((-1e-4..1e-3).contains(&gap), "{gap}");
    }
}
