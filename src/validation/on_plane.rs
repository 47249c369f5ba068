//! One ball on a plane: sliding, rolling, spinning, and when it changes from one to the other.

use super::error::Trouble;
use super::observed::{Observations, Observed, degrees};
use super::probe::{LONGEST_S, Probe};
use super::setup::Setup;
use super::shapes::Wall;
use super::world::World;
use crate::ball::{BallState, Motion};
use crate::mesh::Surface;
use crate::physics::laws::cloth::slip_velocity;
use crate::physics::{Simulation, SolverKind};
use crate::units::Seconds;
use glam::DVec3;

/// Time over which accelerations are measured [s]: whole steps of 1, 2, 4 and 5 ms.
const MEASURE_S: Seconds = 2e-2;
/// Panels of a quadrature between two changes of motion.
const PANELS: u32 = 512;

pub(super) fn observe(
    setup: &Setup<'_>,
    keys: &[&str],
    solver: SolverKind,
) -> Result<Observations, Trouble> {
    let entry = setup.ball()?;
    let plane = setup.plane()?;
    let world =
        World::new(setup, core::slice::from_ref(&entry), solver)?.plane(&plane, Surface::Cloth);
    let run = Run {
        start: world.simulation()?,
        plane,
        radius_m: entry.radius_m,
        from: entry.position_m,
        velocity: entry.velocity_m_s,
        spin: entry.angular_velocity_rad_s,
    };
    let mut seen = Observations::default();
    seen.set("slip_start_m_s", run.slip(entry.velocity_m_s, entry.angular_velocity_rad_s));

    let asks = |part: &str| keys.iter().any(|key| key.contains(part));
    let start_j = world.energy_j(&run.start);
    let kinetic_j = run.start.ledger().kinetic_j;
    let rolling = if asks("roll") || asks("energy") || asks("turn") || asks("straight") {
        run.first(|_, state| !matches!(state.motion, Motion::Sliding | Motion::Airborne))?
    } else {
        None
    };
    if let Some((time, state, simulation)) = &rolling {
        run.rolling(*time, state, &mut seen)?;
        let lost = start_j - world.energy_j(simulation);
        seen.set("energy_lost_J", lost);
        seen.maybe("energy_lost_fraction", (kinetic_j > 0.0).then(|| lost / kinetic_j));
    }
    if asks("straight") {
        let until = rolling.as_ref().map_or(1.0, |(time, ..)| *time);
        seen.set("path_is_straight", run.is_straight(until)?);
    }
    if asks("curvature") {
        let after = run.probe().ahead(1e-3)?.velocity;
        let acceleration = (after - run.velocity) / 1e-3;
        let across = run.velocity.cross(acceleration).length();
        let speed = run.velocity.length();
        seen.maybe("curvature_radius_start_m", (across > 0.0).then(|| speed.powi(3) / across));
    }
    run.turning(keys, &mut seen)?;
    run.resting(keys, &mut seen)?;
    run.samples(setup, keys, &mut seen)?;
    Ok(seen)
}

struct Run {
    start: Simulation,
    plane: Wall,
    radius_m: f64,
    from: DVec3,
    velocity: DVec3,
    spin: DVec3,
}

impl Run {
    fn probe(&self) -> Probe {
        Probe::new(self.start.clone())
    }

    fn slip(&self, velocity: DVec3, spin: DVec3) -> DVec3 {
        slip_velocity(velocity, spin, self.radius_m, self.plane.normal)
    }

    /// The first time at which something holds, with the world then.
    fn first(
        &self,
        holds: impl Fn(Seconds, &BallState) -> bool,
    ) -> Result<Option<(Seconds, BallState, Simulation)>, Trouble> {
        let mut probe = self.probe();
        let found = probe.until(LONGEST_S, holds)?;
        Ok(found.map(|(time, state)| (time, state, probe.simulation)))
    }

    fn rolling(
        &self,
        time: Seconds,
        state: &BallState,
        seen: &mut Observations,
    ) -> Result<(), Trouble> {
        seen.set("t_roll_s", time);
        seen.set("roll_displacement_m", state.position - self.from);
        seen.set("roll_velocity_m_s", state.velocity);
        seen.set("roll_angular_velocity_rad_s", state.angular_velocity);
        let half = self.probe().ahead(0.5 * time)?.position - self.from;
        seen.set("half_roll_displacement_m", half);
        let quarter = self.probe().ahead(0.25 * time)?.position - self.from;
        seen.set("quarter_roll_displacement_m", quarter);
        let direction = |v: DVec3| libm::atan2(v.y, v.x);
        seen.set("roll_direction_deg", degrees(direction(state.velocity)));
        let turn = libm::atan2(
            self.velocity.cross(state.velocity).dot(self.plane.normal),
            self.velocity.dot(state.velocity),
        );
        seen.set("path_turn_deg", degrees(turn));
        Ok(())
    }

    /// Turning point, return, and the moment at which the spin has died.
    fn turning(&self, keys: &[&str], seen: &mut Observations) -> Result<(), Trouble> {
        let (from, ahead) = (self.from, self.velocity);
        if keys.iter().any(|key| key.contains("turn")) {
            let turn = self.first(|_, state| state.velocity.dot(ahead) <= 0.0)?;
            seen.maybe("t_turn_s", turn.as_ref().map(|(time, ..)| *time));
            let there = turn.as_ref().map(|(_, state, _)| state.position - from);
            seen.maybe("turn_displacement_m", there);
            if let Some((.., simulation)) = turn {
                let mut probe = Probe::new(simulation);
                let back = |_, state: &BallState| (state.position - from).dot(ahead) <= 0.0;
                if let Some((time, state)) = probe.until(LONGEST_S, back)? {
                    seen.set("t_return_s", time);
                    seen.set("return_velocity_m_s", state.velocity);
                }
            }
        }
        if keys.iter().any(|key| key.contains("stun")) {
            let normal = self.plane.normal;
            let across = self.spin - normal * self.spin.dot(normal);
            let stun = self.first(|_, state| state.angular_velocity.dot(across) <= 0.0)?;
            if let Some((time, state, _)) = stun {
                seen.set("t_stun_s", time);
                seen.set("stun_displacement_m", state.position - from);
                seen.set("stun_velocity_m_s", state.velocity);
            }
        }
        Ok(())
    }

    fn resting(&self, keys: &[&str], seen: &mut Observations) -> Result<(), Trouble> {
        let asks = |part: &str| keys.iter().any(|key| key.contains(part));
        if asks("stop") {
            let stop = self.first(|_, state| state.velocity == DVec3::ZERO)?;
            if let Some((time, state, _)) = stop {
                seen.set("t_stop_s", time);
                seen.set("stop_displacement_m", state.position - self.from);
            }
            let rest = self.first(|_, state| state.motion == Motion::Rest)?;
            seen.maybe("t_spin_stop_s", rest.map(|(time, ..)| time));
        }
        if asks("rotation") {
            seen.maybe("rotation_total_rad", self.rotation()?);
        }
        Ok(())
    }

    /// The angle that the ball turns through until it rests: ∫ |ω| dt by Simpson's rule, from one
    /// change of motion to the next.
    fn rotation(&self) -> Result<Option<f64>, Trouble> {
        let mut probe = self.probe();
        let mut total = 0.0;
        loop {
            let (from, motion) = (probe.clone(), probe.state()?.motion);
            if motion == Motion::Rest {
                return Ok(Some(total));
            }
            let begin = from.simulation.now_s();
            let Some((end, _)) = probe.until(LONGEST_S, |_, state| state.motion != motion)? else {
                return Ok(None);
            };
            let h = (end - begin) / f64::from(2 * PANELS);
            let mut walk = from;
            let mut before = walk.state()?.angular_velocity.length();
            for panel in 0..PANELS {
                let at = |k: u32| begin + h * f64::from(2 * panel + k);
                let middle = walk.ahead(at(1))?.angular_velocity.length();
                // What holds just before the change, not after it.
                let last = if panel + 1 == PANELS { end.next_down() } else { at(2) };
                let after = walk.ahead(last)?.angular_velocity.length();
                walk.advance(last)?;
                total += h / 3.0 * (before + 4.0 * middle + after);
                before = after;
            }
        }
    }

    fn is_straight(&self, until: Seconds) -> Result<bool, Trouble> {
        let line = self.velocity.normalize_or(DVec3::X);
        for part in 1..=16 {
            let at = until * f64::from(part) / 16.0;
            let way = self.probe().ahead(at)?.position - self.from;
            if way.cross(line).length() > 1e-9 * way.length().max(1e-3) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn samples(
        &self,
        setup: &Setup<'_>,
        keys: &[&str],
        seen: &mut Observations,
    ) -> Result<(), Trouble> {
        let asks = |part: &str| keys.iter().any(|key| key.contains(part));
        let times = setup.numbers("sample_time_s")?;
        let Some(time) = times.last().copied() else {
            if asks("rolls") {
                let rolls = self.first(|_, state| state.motion == Motion::Rolling)?;
                seen.set("rolls", rolls.is_some());
            }
            return Ok(());
        };
        if !(0.0..=LONGEST_S).contains(&time) {
            let problem = format!("{time} s is no time to run to");
            return Err(setup.error("sample_time_s", problem, "write 0 to 1000 s").into());
        }
        if asks("quaternion") {
            let mut probe = self.probe();
            let mut worst = 0.0_f64;
            for part in 0..=1000 {
                probe.advance(time * f64::from(part) / 1000.0)?;
                worst = worst.max((probe.state()?.orientation.length() - 1.0).abs());
            }
            seen.set("max_quaternion_norm_error", worst);
        }
        let state = self.probe().ahead(time)?;
        seen.set("sample_displacement_m", state.position - self.from);
        seen.set("sample_velocity_m_s", state.velocity);
        seen.set("sample_angular_velocity_rad_s", state.angular_velocity);
        seen.set("sample_slip_m_s", self.slip(state.velocity, state.angular_velocity));
        seen.set("rolls", state.motion == Motion::Rolling);
        if asks("acceleration") {
            let dt = MEASURE_S.min(time);
            let before = self.probe().ahead(time - dt)?;
            let rate = |now: DVec3, before: DVec3| -> Observed { ((now - before) / dt).into() };
            seen.set("sample_acceleration_m_s2", rate(state.velocity, before.velocity));
            let spin = rate(state.angular_velocity, before.angular_velocity);
            seen.set("sample_angular_acceleration_rad_s2", spin);
        }
        Ok(())
    }
}
