//! What every solver asks of the balls and commands that it is given.

use super::{PhysicsError, tolerance};
use crate::ball::{Ball, BallState};
use crate::events::{Command, Zone};
use crate::ids::BallId;
use crate::table::{Bed, Pocket};
use crate::units::Seconds;
use glam::{DVec2, DVec3};

/// The balls in ascending order of id, if they can exist together.
///
/// # Errors
/// [`PhysicsError`] for impossible values, double names and balls that overlap.
pub fn checked(mut balls: Vec<(Ball, BallState)>) -> Result<Vec<(Ball, BallState)>, PhysicsError> {
    balls.sort_by_key(|(ball, _)| ball.id);
    for (ball, state) in &balls {
        check_ball(ball, state)?;
    }
    if let Some(pair) = balls.windows(2).find(|pair| pair[0].0.id == pair[1].0.id) {
        return Err(PhysicsError::DuplicateBall(pair[0].0.id));
    }
    check_overlaps(&balls)?;
    Ok(balls)
}

/// A setting within its range.
///
/// # Errors
/// [`PhysicsError::Setting`] if it is not.
pub fn check_setting(
    key: &'static str,
    value: f64,
    low: f64,
    high: f64,
    allowed: &'static str,
) -> Result<(), PhysicsError> {
    if low <= value && value <= high {
        Ok(())
    } else {
        Err(PhysicsError::Setting { key, value, allowed })
    }
}

fn check_ball(ball: &Ball, state: &BallState) -> Result<(), PhysicsError> {
    let positive = "must be a positive number";
    for (key, value) in [
        ("radius_m", ball.radius_m),
        ("mass_kg", ball.mass_kg),
        ("inertia_factor", ball.inertia_factor),
    ] {
        check_setting(key, value, f64::MIN_POSITIVE, 1e9, positive)?;
    }
    for (term, value) in [
        ("position", state.position),
        ("velocity", state.velocity),
        ("angular velocity", state.angular_velocity),
    ] {
        if !value.is_finite() {
            return Err(PhysicsError::NonFinite { ball: ball.id, time_s: 0.0, term });
        }
    }
    if !(state.orientation.is_finite() && state.orientation.length_squared() > 1e-12) {
        return Err(PhysicsError::NonFinite { ball: ball.id, time_s: 0.0, term: "orientation" });
    }
    Ok(())
}

/// Sorted along x, so that a thousand balls are not half a million pairs.
fn check_overlaps(balls: &[(Ball, BallState)]) -> Result<(), PhysicsError> {
    let mut order: Vec<usize> = (0..balls.len())
        .filter(|index| {
            balls[*index].0.flags.collide
                && balls[*index].1.place == crate::ball::BallPlace::OnTable
        })
        .collect();
    let low = |index: &usize| balls[*index].1.position.x - balls[*index].0.radius_m;
    order.sort_by(|a, b| low(a).total_cmp(&low(b)));
    for (place, index) in order.iter().enumerate() {
        let (a, at) = &balls[*index];
        for other in
            order[place + 1..].iter().take_while(|other| low(other) <= at.position.x + a.radius_m)
        {
            let (b, there) = &balls[*other];
            let depth_m = a.radius_m + b.radius_m - at.position.distance(there.position);
            if depth_m > tolerance::START_OVERLAP_M {
                let (a, b) = if a.id < b.id { (a.id, b.id) } else { (b.id, a.id) };
                return Err(PhysicsError::Overlap { a, b, depth_m });
            }
        }
    }
    Ok(())
}

/// The pairs that lie against each other, of balls with their middles and radii [m]; the lower
/// number first, in ascending order.
pub fn frozen_pairs(mut balls: Vec<(BallId, DVec3, f64)>) -> Vec<(BallId, BallId)> {
    let low = |(_, middle, radius_m): &(BallId, DVec3, f64)| middle.x - radius_m;
    balls.sort_by(|a, b| low(a).total_cmp(&low(b)).then(a.0.cmp(&b.0)));
    let mut pairs = Vec::new();
    for (i, (a, here, radius_m)) in balls.iter().enumerate() {
        let right = here.x + radius_m + tolerance::APART_M;
        for (b, there, other_m) in balls[i + 1..].iter().take_while(|other| low(other) <= right) {
            if here.distance(*there) - radius_m - other_m <= tolerance::APART_M {
                pairs.push((*a.min(b), *a.max(b)));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// A command whose numbers are numbers.
///
/// # Errors
/// [`PhysicsError::Command`] otherwise.
pub fn check_command(at: Seconds, command: &Command) -> Result<(), PhysicsError> {
    let broken = |term| Err(PhysicsError::Command { time_s: at, term });
    if !at.is_finite() {
        return broken("time");
    }
    match command {
        Command::MoveCue(path) => {
            for piece in &path.pieces {
                let times = piece.start_s.is_finite() && piece.duration_s.is_finite();
                let vectors = [
                    piece.position,
                    piece.velocity,
                    piece.acceleration,
                    piece.direction,
                    piece.direction_end,
                ];
                if !times || !vectors.iter().all(|v| v.is_finite()) {
                    return broken("cue path");
                }
            }
            Ok(())
        }
        Command::PlaceBall { position_m, .. } if !position_m.is_finite() => broken("position"),
        _ => Ok(()),
    }
}

/// Whether a ball may be put down here: in its zone, on the bed, over no pocket, on no other ball.
/// `others` are the places and radii of the balls in play.
pub fn may_stand(
    bed: Option<&Bed>,
    pockets: &[Pocket],
    mut others: impl Iterator<Item = (DVec3, f64)>,
    radius_m: f64,
    place: DVec2,
    zone: Zone,
) -> bool {
    if let Some(bed) = bed {
        let over_pocket =
            pockets.iter().any(|pocket| pocket.centre.distance(place) <= pocket.radius_m);
        if !bed.in_zone(zone, place) || !bed.holds(place, radius_m) || over_pocket {
            return false;
        }
    }
    let centre = place.extend(radius_m);
    !others.any(|(other, other_radius)| other.distance(centre) < radius_m + other_radius)
}
