//! Springs and dampers, by the closed propagator; and a virtual wall that is sampled.

use super::error::{Trouble, unsupported};
use super::observed::{Observations, degrees};
use super::setup::Setup;
use crate::ball::{Ball, SOLID_SPHERE};
use crate::ids::BallId;
use crate::physics::spring::propagator;
use core::f64::consts::TAU;

/// Samples of a period of the hand.
const SAMPLES: u32 = 8192;
/// A start has died away when it is this small.
const DIED: f64 = 1e-9;
/// Periods of the hand that are followed at most.
const PERIODS_MAX: f64 = 20_000.0;

/// A mass on a spring: undamped frequency and damping ratio.
#[derive(Clone, Copy)]
struct Oscillator {
    omega: f64,
    damping: f64,
}

impl Oscillator {
    fn new(inertia: f64, stiffness: f64, damping: f64) -> Self {
        let omega = (stiffness / inertia).sqrt();
        Oscillator { omega, damping: damping / (2.0 * inertia * omega) }
    }

    /// Place and speed after `dt`, the place from the anchor.
    fn after(&self, (x, v): (f64, f64), dt: f64) -> (f64, f64) {
        let [[a, b], [c, d]] = propagator(self.omega, self.damping, dt);
        (a * x + b * v, c * x + d * v)
    }

    /// The first time up to `limit` at which `holds`, looked for in `parts` and then halved.
    fn first(
        &self,
        start: (f64, f64),
        limit: f64,
        parts: u32,
        holds: impl Fn((f64, f64)) -> bool,
    ) -> Option<f64> {
        let at = |part: u32| limit * f64::from(part) / f64::from(parts);
        let part = (1..=parts).find(|part| holds(self.after(start, at(*part))))?;
        let (mut low, mut high) = (at(part - 1), at(part));
        loop {
            let middle = 0.5 * (low + high);
            if !(low < middle && middle < high) {
                return Some(high);
            }
            if holds(self.after(start, middle)) { high = middle } else { low = middle }
        }
    }
}

pub(super) fn spring(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (mass, stiffness) = (setup.positive("mass_kg")?, setup.positive("k_N_m")?);
    let damping = setup.number_or_zero("c_Ns_m")?;
    let anchor = setup.number_or_zero("anchor_m")?;
    let (x0, v0) = (setup.number("x0_m")? - anchor, setup.number("v0_m_s")?);
    let end = setup.end_s()?;
    let oscillator = Oscillator::new(mass, stiffness, damping);
    let (x, v) = oscillator.after((x0, v0), end);

    let mut seen = Observations::default();
    seen.set("x_m", x + anchor);
    seen.set("v_m_s", v);
    seen.set("omega_rad_s", oscillator.omega);
    seen.set("cycles", oscillator.omega * end / TAU);
    seen.set("c_critical_Ns_m", 2.0 * mass * oscillator.omega);
    let energy = |x: f64, v: f64| 0.5 * (stiffness * x * x + mass * v * v);
    seen.set("energy_J", energy(x, v));
    seen.set("amplitude_m", (2.0 * energy(x, v) / stiffness).sqrt());
    // The first top on the other side of the anchor.
    let period = TAU / oscillator.omega;
    let other_side = |(x, v): (f64, f64)| x * x0 < 0.0 && v * x0 >= 0.0;
    let peak = oscillator.first((x0, v0), 4.0 * period, 4000, other_side);
    if let Some(time) = peak {
        let (x, _) = oscillator.after((x0, v0), time);
        seen.set("t_peak_s", time);
        seen.set("overshoot_fraction", (x / x0).abs());
    }
    Ok(seen)
}

pub(super) fn angular(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let entry = setup.ball()?;
    setup.unit("axis")?;
    let ball = Ball {
        radius_m: entry.radius_m,
        mass_kg: entry.m,
        inertia_factor: entry.inertia_factor.unwrap_or(SOLID_SPHERE),
        ..Ball::pool(BallId(0))
    };
    let inertia = ball.inertia_kg_m2();
    let (stiffness, damping) = (setup.positive("kappa_Nm_rad")?, setup.number("c_Nms_rad")?);
    let oscillator = Oscillator::new(inertia, stiffness, damping);
    let start = (setup.number("angle0_rad")?, setup.number("rate0_rad_s")?);
    let (angle, rate) = oscillator.after(start, setup.end_s()?);
    let mut seen = Observations::default();
    seen.set("inertia_kg_m2", inertia);
    seen.set("angle_rad", angle);
    seen.set("rate_rad_s", rate);
    seen.set("undamped_freq_hz", oscillator.omega / TAU);
    Ok(seen)
}

pub(super) fn two_masses(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let pair = |key| -> Result<[f64; 2], Trouble> { Ok(setup.two(key)?) };
    let ([m1, m2], [v1, v2]) = (pair("mass_kg")?, pair("velocity_start_m_s")?);
    if !(m1 > 0.0 && m2 > 0.0) {
        return Err(setup.error("mass_kg", "a mass is not positive", "write two masses").into());
    }
    let stiffness = setup.positive("k_N_m")?;
    // The distance oscillates with the reduced mass; the centre of mass goes on evenly.
    let oscillator = Oscillator::new(m1 * m2 / (m1 + m2), stiffness, 0.0);
    let end = setup.end_s()?;
    let start = (0.0, v2 - v1);
    let (apart, _) = oscillator.after(start, end);
    let centre = (m1 * v1 + m2 * v2) / (m1 + m2) * end;
    let mut seen = Observations::default();
    let (x1, x2) = (centre - m2 / (m1 + m2) * apart, centre + m1 / (m1 + m2) * apart);
    seen.set("x_m", vec![x1, x2]);
    seen.set("omega_rad_s", oscillator.omega);
    let sign = start.1;
    let back = |(x, _): (f64, f64)| x * sign <= 0.0;
    seen.maybe("contact_time_s", oscillator.first(start, TAU / oscillator.omega, 1000, back));
    Ok(seen)
}

/// Follows the mass until its start has died away, the hand's motion cut into straight pieces, and
/// reads amplitude and phase off one period.
pub(super) fn frequency_response(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (mass, stiffness) = (setup.positive("mass_kg")?, setup.positive("k_N_m")?);
    let damping = setup.number("c_Ns_m")?;
    let (amplitude, frequency) = (setup.positive("hand_amplitude_m")?, setup.positive("freq_hz")?);
    let oscillator = Oscillator::new(mass, stiffness, damping);
    let period = 1.0 / frequency;
    // The slower of the two decays.
    let sigma = oscillator.damping * oscillator.omega;
    let slow = if oscillator.damping > 1.0 {
        let root = (sigma * sigma - oscillator.omega * oscillator.omega).sqrt();
        oscillator.omega * oscillator.omega / (sigma + root)
    } else {
        sigma
    };
    let periods = (-libm::log(DIED) / (slow * period)).ceil();
    if periods.is_nan() || periods > PERIODS_MAX {
        return unsupported("a start that does not die away has no steady state");
    }

    let dt = period / f64::from(SAMPLES);
    let [[a, b], [c, d]] = propagator(oscillator.omega, oscillator.damping, dt);
    let hand = |sample: u32| amplitude * libm::sin(TAU * f64::from(sample) / f64::from(SAMPLES));
    let hands: Vec<f64> = (0..=SAMPLES).map(hand).collect();
    let (mut x, mut v) = (0.0, 0.0);
    let (mut sine, mut cosine) = (0.0, 0.0);
    for turn in 0..=periods as u64 {
        let last = turn == periods as u64;
        for sample in 0..SAMPLES as usize {
            let speed = (hands[sample + 1] - hands[sample]) / dt;
            // Seen from an anchor that moves evenly.
            let (from, drift) = (x - hands[sample], v - speed);
            x = a * from + b * drift + hands[sample + 1];
            v = c * from + d * drift + speed;
            if last {
                let (s, k) = libm::sincos(TAU * (sample as f64 + 1.0) / f64::from(SAMPLES));
                sine += x * s;
                cosine += x * k;
            }
        }
    }
    // Straight pieces between the samples of a sine have its frequency with this much of it.
    let half_sample = core::f64::consts::PI / f64::from(SAMPLES);
    let kept = (libm::sin(half_sample) / half_sample).powi(2);
    let scale = 2.0 / f64::from(SAMPLES) / (amplitude * kept);
    let (real, imaginary) = (sine * scale, cosine * scale);
    let mut seen = Observations::default();
    seen.set("amplitude_ratio", libm::hypot(real, imaginary));
    seen.set("phase_deg", degrees(libm::atan2(imaginary, real)));
    // (k + i c Ω)(1 − H) A
    let omega = TAU * frequency;
    let coupling = libm::hypot(stiffness, damping * omega);
    let apart = libm::hypot(1.0 - real, imaginary);
    seen.set("force_amplitude_N", coupling * apart * amplitude);
    Ok(seen)
}

/// A mass with damping against a spring whose force is held between ticks.
pub(super) fn sampled_wall(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (mass, tick) = (setup.positive("mass_kg")?, setup.positive("T_s")?);
    let damping = setup.number("b_Ns_m")?;
    let delay = setup.count("delay_samples")?.unwrap_or(0);
    if delay > 64 || damping < 0.0 {
        return unsupported("a delay above 64 samples, or negative damping");
    }
    let wall = SampledWall::new(mass, damping, tick, delay as usize);
    let mut seen = Observations::default();
    let (mut low, mut high) = (0.0, 4.0 * mass / (tick * tick) + 4.0 * damping / tick);
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            break;
        }
        if wall.is_stable(middle, 1.0) { low = middle } else { high = middle }
    }
    seen.set("K_limit_N_m", low);
    let tests = setup.numbers("K_test_N_m")?;
    seen.set("spectral_radius", tests.iter().map(|k| wall.radius(*k)).collect::<Vec<_>>());
    Ok(seen)
}

/// Characteristic polynomial of the loop: zᵈ (z² − tr z + det) + K (b₁ z + b₀).
struct SampledWall {
    delay: usize,
    trace: f64,
    determinant: f64,
    /// How the force of a tick moves the mass by its end, and what of that comes a tick later.
    now: f64,
    later: f64,
}

impl SampledWall {
    fn new(mass: f64, damping: f64, tick: f64, delay: usize) -> Self {
        // x″ = (F − b x′)/m over one tick: decay of the speed, and the ways of speed and force.
        let rate = damping / mass;
        let z = rate * tick;
        let (decay, speed_way, force_way, force_speed);
        if z < 1e-4 {
            decay = libm::exp(-z);
            speed_way = tick * (1.0 - z / 2.0 + z * z / 6.0);
            force_speed = speed_way / mass;
            force_way = tick * tick / mass * (0.5 - z / 6.0 + z * z / 24.0);
        } else {
            decay = libm::exp(-z);
            speed_way = -libm::expm1(-z) / rate;
            force_speed = speed_way / mass;
            force_way = (tick - speed_way) / (rate * mass);
        }
        SampledWall {
            delay,
            trace: 1.0 + decay,
            determinant: decay,
            now: force_way,
            later: speed_way * force_speed - force_way * decay,
        }
    }

    /// Whether all roots lie within a circle of this radius, by the recursion of Schur and Cohn.
    fn is_stable(&self, stiffness: f64, radius: f64) -> bool {
        // Highest power first; z = r w scales the coefficients.
        let mut p = vec![0.0; self.delay + 3];
        p[0] = 1.0;
        p[1] = -self.trace;
        p[2] = self.determinant;
        let last = p.len() - 1;
        p[last - 1] += stiffness * self.now;
        p[last] += stiffness * self.later;
        let mut scale = 1.0;
        for coefficient in p.iter_mut().rev() {
            *coefficient *= scale;
            scale *= radius;
        }
        while p.len() > 1 {
            let last = p.len() - 1;
            let reflection = p[last] / p[0];
            if reflection.is_nan() || reflection.abs() >= 1.0 {
                return false;
            }
            p = (0..last).map(|k| p[k] - reflection * p[last - k]).collect();
        }
        true
    }

    fn radius(&self, stiffness: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        while !self.is_stable(stiffness, high) && high < 1e12 {
            high *= 2.0;
        }
        loop {
            let middle = 0.5 * (low + high);
            if !(low < middle && middle < high) {
                return high;
            }
            if self.is_stable(stiffness, middle) { high = middle } else { low = middle }
        }
    }
}
