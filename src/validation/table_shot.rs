//! Balls on the table plane with vertical walls: the same shot in other frames, or mirrored.

use super::error::Trouble;
use super::observed::Observations;
use super::setup::Setup;
use super::shapes::BallEntry;
use super::world::World;
use crate::ball::BallState;
use crate::events::{Fact, FactSet, Topic};
use crate::ids::BallId;
use crate::physics::{Simulation, SolverKind};
use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Without frames of its own, the world is looked at this often [s].
const LOOK_S: f64 = 0.01;
/// Energy that may appear, over that at the start: rounding.
const APPEARS: f64 = 1e-12;

pub(super) fn observe(
    setup: &Setup<'_>,
    keys: &[&str],
    solver: SolverKind,
) -> Result<Observations, Trouble> {
    let balls = setup.balls()?;
    let world = World::new(setup, &balls, solver)?.bed().walls(&setup.walls()?);
    let end = setup.end_s()?;
    let mut samples = setup.numbers("sample_time_s")?;
    if samples.is_empty() {
        samples.push(end);
    }
    samples.retain(|time| (0.0..=end).contains(time));
    samples.sort_by(f64::total_cmp);
    let shot = Shot { start: world.simulation()?, count: balls.len(), samples, end };

    let mut seen = Observations::default();
    let asks = |part: &str| keys.iter().any(|key| key.contains(part));
    if asks("difference") || asks("order") {
        shot.compare_frames(setup, &mut seen)?;
    }
    if asks("mirror") || asks("axis") {
        shot.mirror(setup, &balls, &mut seen)?;
    }
    if asks("momentum") {
        seen.maybe("momentum_after_first_impacts_Ns", shot.momentum(&balls)?);
    }
    if asks("energy") {
        seen.set("energy_never_increases", shot.energy_falls(&world)?);
    }
    Ok(seen)
}

struct Shot {
    start: Simulation,
    count: usize,
    samples: Vec<f64>,
    end: f64,
}

/// What a run showed: states at the sample times, and what happened.
struct Film {
    states: Vec<Vec<BallState>>,
    facts: Vec<Fact>,
}

impl Shot {
    fn states(&self, simulation: &Simulation, at: f64) -> Result<Vec<BallState>, Trouble> {
        let state = |place: usize| {
            let state = simulation.sample(BallId(place as u16), at);
            state.ok_or_else(|| Trouble::Failed(format!("ball {place} is gone")))
        };
        (0..self.count).map(state).collect()
    }

    /// Runs in frames whose lengths `next` gives, time by time; a frame without length is a pause.
    fn film(&self, mut next: impl FnMut(f64) -> f64) -> Result<Film, Trouble> {
        let mut simulation = self.start.clone();
        let mut film = Film { states: Vec::new(), facts: Vec::new() };
        let mut time = 0.0;
        let mut due = self.samples.iter().copied().peekable();
        loop {
            let frame_end = (time + next(time)).min(self.end);
            // A sample within a frame is taken from the frame's end, as a picture would be.
            simulation.advance(frame_end, FactSet::NONE, &mut film.facts)?;
            while let Some(sample) = due.next_if(|sample| *sample <= frame_end) {
                let mut then = self.start.clone();
                if sample == frame_end {
                    film.states.push(self.states(&simulation, sample)?);
                } else {
                    // Not long before the time reached is not far enough for a long frame.
                    then.advance(sample, FactSet::NONE, &mut Vec::new())?;
                    film.states.push(self.states(&then, sample)?);
                }
            }
            if frame_end >= self.end {
                return Ok(film);
            }
            time = frame_end;
        }
    }

    /// The same shot in frames of several lengths, of random lengths, and with a pause.
    fn compare_frames(&self, setup: &Setup<'_>, seen: &mut Observations) -> Result<(), Trouble> {
        let mut lengths = setup.frames_s(self.end)?;
        if lengths.is_empty() {
            lengths.push(LOOK_S);
        }
        let mut films = Vec::new();
        for length in &lengths {
            films.push(self.film(self.stops(|_| *length))?);
        }
        if let Some(random) = setup.random_frames(self.end)? {
            let mut generator = Pcg64Mcg::seed_from_u64(random.seed);
            let draw = move |_| generator.random_range(random.min_s..random.max_s);
            films.push(self.film(self.stops(draw))?);
        }
        if let Some(pause) = setup.pause()? {
            let length = lengths[0];
            let mut left = pause.steps;
            let still = move |time: f64| {
                if time >= pause.at_s && left > 0 {
                    left -= 1;
                    return 0.0;
                }
                length
            };
            films.push(self.film(self.stops(still))?);
        }
        let (mut way, mut speed, mut same) = (0.0_f64, 0.0_f64, true);
        let order = |film: &Film| -> Vec<String> {
            film.facts.iter().map(|fact| format!("{:?}", names(fact))).collect()
        };
        let first = &films[0];
        for film in &films[1..] {
            for (a, b) in first.states.iter().flatten().zip(film.states.iter().flatten()) {
                way = way.max((a.position - b.position).length());
                speed = speed.max((a.velocity - b.velocity).length());
            }
            same &= order(first) == order(film);
        }
        seen.set("max_difference_position_m", way);
        seen.set("max_difference_velocity_m_s", speed);
        seen.set("same_event_order", same);
        Ok(())
    }

    /// Cuts frames at the sample times, so that each sample is the end of a frame.
    fn stops(&self, mut length: impl FnMut(f64) -> f64) -> impl FnMut(f64) -> f64 {
        let samples = self.samples.clone();
        move |time| {
            let wanted = length(time);
            let next = samples.iter().find(|sample| **sample > time);
            match next {
                Some(sample) if time + wanted > *sample => sample - time,
                _ => wanted,
            }
        }
    }

    /// How far the balls are from being their own mirror image, early and late.
    fn mirror(
        &self,
        setup: &Setup<'_>,
        balls: &[BallEntry],
        seen: &mut Observations,
    ) -> Result<(), Trouble> {
        let normal = setup.unit("mirror_normal")?;
        let image = |v: DVec3| v - normal * (2.0 * v.dot(normal));
        let near = |a: DVec3, b: DVec3| (a - b).length() <= 1e-9;
        let partner = |ball: &BallEntry| {
            balls.iter().position(|other| near(image(ball.position_m), other.position_m))
        };
        let partners: Option<Vec<usize>> = balls.iter().map(partner).collect();
        let Some(partners) = partners else {
            let problem = "the start is not its own mirror image";
            return Err(setup.error("mirror_normal", problem, "give every ball a partner").into());
        };
        let late_from = setup.maybe("late_from_s")?.unwrap_or(f64::INFINITY);
        let mut film = self.film(self.stops(|_| LOOK_S))?;
        let (mut mirror, mut axis) = ([0.0_f64; 2], [0.0_f64; 2]);
        for (time, states) in self.samples.iter().zip(film.states.drain(..)) {
            let late = usize::from(*time >= late_from);
            for (place, other) in partners.iter().enumerate() {
                let error = (image(states[place].position) - states[*other].position).length();
                mirror[late] = mirror[late].max(error);
                if place == *other {
                    axis[late] = axis[late].max(states[place].position.dot(normal).abs());
                }
            }
        }
        seen.set("max_mirror_error_early_m", mirror[0]);
        seen.set("max_mirror_error_late_m", mirror[1]);
        seen.set("max_distance_of_axis_balls_early_m", axis[0]);
        seen.set("max_distance_of_axis_balls_late_m", axis[1]);
        Ok(())
    }

    /// The momentum of all balls right after the first ones met [N s].
    fn momentum(&self, balls: &[BallEntry]) -> Result<Option<DVec3>, Trouble> {
        let mut simulation = self.start.clone();
        let mut facts = Vec::new();
        let met = FactSet::of(&[Topic::BallsCollided]);
        let time = simulation.advance(self.end, met, &mut facts)?;
        if !facts.iter().any(|fact| fact.kind.topic() == Topic::BallsCollided) {
            return Ok(None);
        }
        let states = self.states(&simulation, time)?;
        Ok(Some(states.iter().zip(balls).map(|(state, ball)| state.velocity * ball.m).sum()))
    }

    fn energy_falls(&self, world: &World) -> Result<bool, Trouble> {
        let mut simulation = self.start.clone();
        let start = world.energy_j(&simulation);
        let mut before = start;
        let steps = (self.end / LOOK_S).ceil() as u64;
        for step in 1..=steps {
            let time = (LOOK_S * step as f64).min(self.end);
            simulation.advance(time, FactSet::NONE, &mut Vec::new())?;
            let now = world.energy_j(&simulation);
            if now > before + APPEARS * start.abs() {
                return Ok(false);
            }
            before = now;
        }
        Ok(true)
    }
}

/// What happened to whom, without when and where.
fn names(fact: &Fact) -> (&'static str, [Option<BallId>; 2]) {
    use crate::events::FactKind::{BallsCollided, CushionHit};
    let balls = match fact.kind {
        BallsCollided { a, b, .. } => [Some(a), Some(b)],
        CushionHit { ball, .. } => [Some(ball), None],
        _ => [None, None],
    };
    (fact.kind.name(), balls)
}
