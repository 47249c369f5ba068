//! A ball on a single contact without closed form: it turns about the rim of a pocket, or off the
//! end of a shelf; it rolls or slides across a slope.
//!
//! About an edge its centre moves on a cylinder, on a slope in a plane. The contact presses as long
//! as weight exceeds what the turn takes, N/m = g n_z − |v⊥|²/R; friction is Coulomb's, or whatever
//! keeps the ball from slipping. Integrated with RK4. Three things end a step early, each at the
//! root of what announces it: the ball leaves (N = 0), it begins or ceases to slip, its contact
//! reaches the end of the edge.

use crate::physics::laws::Mover;
use crate::physics::laws::cloth::{self, Carrying};
use crate::physics::tolerance;
use crate::units::Seconds;
use glam::DVec3;

/// The parabola through the velocities at both ends of a step leaves the cylinder by no more than
/// this [m]; half of what still counts as touching.
const BULGE_M: f64 = 5e-7;

/// And it is behind or ahead on the cylinder by no more than this [m].
const BEHIND_M: f64 = 5e-7;

/// No step is longer [s].
const LONGEST_S: Seconds = 16e-3;

/// A step shorter than this ends where it begins [s].
const SHORTEST_S: Seconds = 1e-8;

/// Slip below this is rounding [m/s].
const ROUNDING_M_S: f64 = 1e-9;

/// So often its end is looked for at most; it takes some eight.
const TURNS_MAX: usize = 60;

/// How exactly the end of a step is found, over its length.
const ROOT: f64 = 1e-8;

/// What a ball lies on.
#[derive(Debug, Clone, Copy)]
pub enum Base {
    /// A straight edge: an end of it [m], the unit vector to the other end, its length [m].
    Edge {
        /// An end [m].
        from: DVec3,
        /// Unit vector to the other end.
        along: DVec3,
        /// Length [m].
        length_m: f64,
    },
    /// A plane with this unit normal on the side of the centre; where it ends is not its matter.
    Slope {
        /// Unit normal.
        normal: DVec3,
    },
}

impl Base {
    /// Unit normal at a centre, and the part of a velocity that turns it.
    fn normal(&self, position: DVec3, velocity: DVec3) -> (DVec3, DVec3) {
        match *self {
            Base::Edge { from, along, .. } => {
                let offset = position - from;
                let away = offset - along * offset.dot(along);
                (away.normalize_or(DVec3::Z), velocity - along * velocity.dot(along))
            }
            Base::Slope { normal } => (normal, DVec3::ZERO),
        }
    }

    /// How far a centre is from where the base ends, over the length of it.
    fn inside(&self, position: DVec3) -> f64 {
        match *self {
            Base::Edge { from, along, length_m } => {
                let place = (position - from).dot(along);
                place.min(length_m - place) / length_m
            }
            Base::Slope { .. } => f64::INFINITY,
        }
    }
}

/// What a ball lies on, and what acts on it.
#[derive(Debug, Clone, Copy)]
pub struct Pivot {
    /// The contact.
    pub base: Base,
    /// What its material does to a ball that it carries.
    pub law: Carrying,
    /// Downwards [m/s²].
    pub gravity_m_s2: f64,
}

/// A step of a ball.
#[derive(Debug, Clone, Copy)]
pub struct Step {
    /// How long it is [s].
    pub length_s: Seconds,
    /// How the ball moves at its end.
    pub end: Mover,
    /// Energy that friction and resistance took [J].
    pub loss_j: f64,
}

/// Where a ball is and how it moves; or how these change.
#[derive(Debug, Clone, Copy)]
struct State {
    position: DVec3,
    velocity: DVec3,
    angular_velocity: DVec3,
    /// Energy lost per mass [J/kg].
    lost: f64,
}

impl State {
    fn plus(&self, rate: &State, t: f64) -> State {
        State {
            position: self.position + rate.position * t,
            velocity: self.velocity + rate.velocity * t,
            angular_velocity: self.angular_velocity + rate.angular_velocity * t,
            lost: self.lost + rate.lost * t,
        }
    }
}

/// What acts at a moment.
struct Forces {
    normal: DVec3,
    /// Normal force per mass [m/s²].
    press: f64,
    /// Slip of the contact [m/s].
    slip: DVec3,
    /// Friction per mass that would keep the slip as it is [m/s²].
    holding: DVec3,
}

impl Pivot {
    /// How hard a ball is pressed against its base, over its mass [m/s²]; it leaves below zero.
    pub fn press(&self, position: DVec3, velocity: DVec3, radius_m: f64) -> f64 {
        let (normal, across) = self.base.normal(position, velocity);
        self.gravity_m_s2 * normal.z - across.length_squared() / radius_m
    }

    /// One step of `ball`, whose centre is at `position` and which touches the base. None if there
    /// is no such motion: the ball leaves, or is too slow for anything but resistance to matter.
    /// The step is no longer than `longest_s`.
    pub fn step(&self, position: DVec3, ball: &Mover, longest_s: Seconds) -> Option<Step> {
        let mut start = State {
            position,
            velocity: ball.velocity,
            angular_velocity: ball.angular_velocity,
            lost: 0.0,
        };
        let shape = Shape::of(ball);
        let forces = self.forces(&start, &shape);
        if forces.press <= 0.0 || ball.velocity.length() < tolerance::PIVOT_M_S {
            return None;
        }
        let holds = forces.holding.length() <= self.law.friction * forces.press;
        let slips = forces.slip.length() > tolerance::SLIP_M_S;
        if !slips {
            shape.end_slip(&mut start, &forces);
        }
        let sticks = !slips && holds;
        let advance = |t: Seconds| self.runge_kutta(&start, &shape, sticks, t);
        let margin = |state: &State| self.margin(state, &shape, sticks, slips, &forces);

        let length_s = self.longest(&forces, position, ball).min(longest_s);
        let mut end = advance(length_s);
        let mut length = length_s;
        let left = margin(&end);
        if left < 0.0 {
            // Where it is on the way says a cubic, far more quickly.
            let between = Between::new(start, end, length_s, |s| self.rate(s, &shape, sticks));
            let ends = (margin(&start).max(0.0), left);
            let mut further = ROOT * length_s;
            length = first_below(length_s, ends, |t| margin(&between.at(t)));
            loop {
                length = (length + further).min(length_s);
                end = advance(length);
                if length >= length_s || margin(&end) < 0.0 {
                    break;
                }
                further *= 10.0;
            }
        }
        if length < SHORTEST_S {
            return None;
        }
        let mut mover =
            Mover { velocity: end.velocity, angular_velocity: end.angular_velocity, ..*ball };
        let after = self.forces(&end, &shape);
        let impulse = 0.5 * (forces.press + after.press.max(0.0)) * length / ball.inverse_mass;
        let rolled = f64::from(sticks);
        let resisted = cloth::resist(&mut mover, after.normal, impulse, rolled, &self.law, length);
        let loss_j = end.lost / ball.inverse_mass + resisted;
        Some(Step { length_s: length, end: mover, loss_j })
    }

    /// How long a step may be: j h³/12 is how far the parabola is off at its end, with j = 3 ω ω′ R
    /// away from the cylinder, ω′ ≤ g sin θ/R, and j ≈ v³/R² + g v/R along it.
    fn longest(&self, forces: &Forces, position: DVec3, ball: &Mover) -> Seconds {
        if let Base::Slope { .. } = self.base {
            return LONGEST_S;
        }
        let (_, across) = self.base.normal(position, ball.velocity);
        let down = (1.0 - forces.normal.z * forces.normal.z).max(0.0).sqrt();
        let speed = across.length();
        let mut length = 0.0;
        // On the way it speeds up, the less the shorter the step is.
        for _ in 0..2 {
            let further = down + speed * length / ball.radius_m;
            let faster = speed + self.gravity_m_s2 * further * length;
            let turn = faster / ball.radius_m;
            let away = 3.0 * turn * self.gravity_m_s2 * further;
            let along = turn * (turn * faster + self.gravity_m_s2);
            let cube = (BULGE_M / away).min(BEHIND_M / along);
            length = libm::cbrt(12.0 * cube).min(LONGEST_S);
        }
        length
    }

    /// Negative once something else begins: what is left until then, in no particular unit.
    fn margin(
        &self,
        state: &State,
        shape: &Shape,
        sticks: bool,
        slips: bool,
        start: &Forces,
    ) -> f64 {
        let now = self.forces(state, shape);
        let inside = self.base.inside(state.position);
        let pressed =
            if sticks { self.law.friction * now.press - now.holding.length() } else { now.press };
        let slipping = if slips { now.slip.dot(start.slip) } else { f64::INFINITY };
        inside.min(pressed).min(slipping)
    }

    fn forces(&self, state: &State, shape: &Shape) -> Forces {
        let (normal, across) = self.base.normal(state.position, state.velocity);
        let spin = state.angular_velocity;
        let tangential = |v: DVec3| v - normal * v.dot(normal);
        let weight = DVec3::NEG_Z * self.gravity_m_s2;
        let pulls = tangential(weight - spin.cross(across));
        Forces {
            normal,
            press: -weight.dot(normal) - across.length_squared() / shape.radius_m,
            slip: tangential(state.velocity - shape.radius_m * spin.cross(normal)),
            holding: pulls * (-shape.factor / (1.0 + shape.factor)),
        }
    }

    fn rate(&self, state: &State, shape: &Shape, sticks: bool) -> State {
        let forces = self.forces(state, shape);
        let slip = forces.slip.length();
        let friction = if sticks {
            forces.holding
        } else {
            // What begins to slip goes where friction fails to hold it.
            let way = if slip > ROUNDING_M_S {
                forces.slip / -slip
            } else {
                forces.holding.normalize_or_zero()
            };
            way * (self.law.friction * forces.press.max(0.0))
        };
        let normal = forces.normal;
        State {
            position: state.velocity,
            velocity: DVec3::NEG_Z * self.gravity_m_s2 + normal * forces.press + friction,
            angular_velocity: normal.cross(friction) * (-1.0 / (shape.factor * shape.radius_m)),
            lost: if sticks { 0.0 } else { -friction.dot(forces.slip) },
        }
    }

    fn runge_kutta(&self, start: &State, shape: &Shape, sticks: bool, t: Seconds) -> State {
        let rate = |state: &State| self.rate(state, shape, sticks);
        let a = rate(start);
        let b = rate(&start.plus(&a, 0.5 * t));
        let c = rate(&start.plus(&b, 0.5 * t));
        let d = rate(&start.plus(&c, t));
        let ends = start.plus(&a, t / 6.0).plus(&d, t / 6.0);
        ends.plus(&b, t / 3.0).plus(&c, t / 3.0)
    }
}

/// What matters of a ball besides its motion.
struct Shape {
    radius_m: f64,
    /// I/(m R²).
    factor: f64,
}

impl Shape {
    fn of(ball: &Mover) -> Self {
        let square = ball.radius_m * ball.radius_m;
        Shape {
            radius_m: ball.radius_m,
            factor: ball.inverse_mass / (ball.inverse_inertia * square),
        }
    }

    /// The last of the slip goes at once.
    fn end_slip(&self, state: &mut State, forces: &Forces) {
        let change = forces.slip * (-self.factor / (1.0 + self.factor));
        state.velocity += change;
        state.angular_velocity -= forces.normal.cross(change) / (self.factor * self.radius_m);
    }
}

/// A path through a step: the cubics through its ends that begin and end as it does.
struct Between {
    start: State,
    way: State,
    leaves: State,
    arrives: State,
    length_s: Seconds,
}

impl Between {
    fn new(start: State, end: State, length_s: Seconds, rate: impl Fn(&State) -> State) -> Self {
        let (leaves, arrives) = (rate(&start), rate(&end));
        Between { start, way: end.plus(&start, -1.0), leaves, arrives, length_s }
    }

    fn at(&self, t: Seconds) -> State {
        let s = t / self.length_s;
        let (back, square) = (1.0 - s, s * s);
        self.start
            .plus(&self.way, square * (3.0 - 2.0 * s))
            .plus(&self.leaves, t * back * back)
            .plus(&self.arrives, -t * s * back)
    }
}

/// Where a function that is positive, or zero, at 0 and negative at `length` becomes negative, to
/// [`ROOT`] of the length: by the Illinois variant of regula falsi, and by halves where that is
/// slow.
fn first_below(length: f64, ends: (f64, f64), value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, length);
    let (mut above, mut below) = ends;
    let (mut side, mut middle, mut width) = (0, f64::INFINITY, length);
    for turn in 1..=TURNS_MAX {
        let last = middle;
        middle = low + (high - low) * (above / (above - below)).clamp(1e-3, 1.0 - 1e-3);
        if turn % 3 == 0 {
            if high - low > 0.25 * width {
                middle = 0.5 * (low + high);
            }
            width = high - low;
        }
        if high - low <= ROOT * length || (middle - last).abs() <= 0.5 * ROOT * length {
            break;
        }
        let here = value(middle);
        if here < 0.0 {
            (high, below) = (middle, here);
            above *= if side == -1 { 0.5 } else { 1.0 };
            side = -1;
        } else {
            (low, above) = (middle, here);
            below *= if side == 1 { 0.5 } else { 1.0 };
            side = 1;
        }
    }
    middle
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::{Ball, POOL_RADIUS_M};
    use crate::ids::BallId;

    const G: f64 = 9.81;

    fn edge(friction: f64) -> Pivot {
        let base = Base::Edge { from: DVec3::ZERO, along: DVec3::Y, length_m: 1.0 };
        let law = Carrying { friction, rolling_resistance: 0.0, spin_deceleration_rad_s2: 0.0 };
        Pivot { base, law, gravity_m_s2: G }
    }

    /// A ball that comes over the edge at `speed`, rolling if `rolls`: cosine of the angle at which
    /// it leaves, its energy over m at the start and then, and steps.
    fn over_the_edge(pivot: &Pivot, speed: f64, rolls: bool) -> (f64, f64, f64, usize) {
        let ball = Ball::pool(BallId(1));
        let spin = if rolls { DVec3::Y * (speed / ball.radius_m) } else { DVec3::ZERO };
        let mut mover = Mover::new(&ball, DVec3::X * speed, spin);
        let mut position = DVec3::new(1e-9, 0.5, ball.radius_m);
        let energy = |mover: &Mover, z: f64| mover.kinetic_j() * mover.inverse_mass + G * z;
        let start = energy(&mover, position.z);
        let mut steps = 0;
        while let Some(step) = pivot.step(position, &mover, 1.0) {
            position += 0.5 * (mover.velocity + step.end.velocity) * step.length_s;
            mover = step.end;
            // Back onto the cylinder, as the solver lays it.
            let away = DVec3::new(position.x, 0.0, position.z);
            position += away.normalize() * (ball.radius_m - away.length());
            let normal = away.normalize();
            let along = mover.velocity - normal * mover.velocity.dot(normal);
            mover.velocity = along.normalize() * mover.velocity.length();
            steps += 1;
            assert!(steps < 1000);
        }
        (position.z / ball.radius_m, start, energy(&mover, position.z), steps)
    }

    #[test]
    fn without_friction_a_ball_leaves_an_edge_where_its_weight_no_longer_holds_it() {
        // cos θ = (2 + v²/(g R))/3, from energy and N = 0.
        for speed in [0.02, 0.1, 0.3, 0.5] {
            let (cosine, before, after, steps) = over_the_edge(&edge(0.0), speed, false);
            let exact = (2.0 + speed * speed / (G * POOL_RADIUS_M)) / 3.0;
            assert!((cosine - exact).abs() < 1e-4, "{speed}: {cosine} {exact}");
            assert!((after / before - 1.0).abs() < 1e-4, "{speed}: {before} {after}");
            assert!(steps < 80, "{speed}: {steps}");
        }
    }

    #[test]
    fn a_ball_that_cannot_slip_leaves_at_ten_seventeenths() {
        // With 7/10 v² as energy: cos θ = (10 + 7 v²/(g R))/17.
        for speed in [0.02, 0.2, 0.4] {
            let (cosine, before, after, _) = over_the_edge(&edge(1e6), speed, true);
            let exact = (10.0 + 7.0 * speed * speed / (G * POOL_RADIUS_M)) / 17.0;
            assert!((cosine - exact).abs() < 1e-4, "{speed}: {cosine} {exact}");
            assert!((after / before - 1.0).abs() < 1e-4, "{speed}: {before} {after}");
        }
    }

    #[test]
    fn on_a_slope_a_ball_rolls_down_with_five_sevenths_and_sideways_as_it_was() {
        let normal = DVec3::new(0.3, 0.0, 0.91_f64.sqrt());
        let pivot = Pivot { base: Base::Slope { normal }, ..edge(0.5) };
        let ball = Ball::pool(BallId(1));
        let velocity = DVec3::Y * 0.4;
        let spin = normal.cross(velocity) / ball.radius_m;
        let step = pivot.step(DVec3::ZERO, &Mover::new(&ball, velocity, spin), 1.0).unwrap();
        let fall = (DVec3::NEG_Z * G - normal * (DVec3::NEG_Z * G).dot(normal)) * (5.0 / 7.0);
        let exact = velocity + fall * step.length_s;
        assert!(step.end.velocity.distance(exact) < 1e-14, "{step:?}");
        assert!(step.loss_j.abs() < 1e-15);
    }

    #[test]
    fn the_first_negative_value_is_found_whatever_the_shape() {
        for place in [1e-4, 0.1, 0.5, 0.93, 0.9999] {
            let shapes: [fn(f64) -> f64; 4] = [
                |x| -x,
                |x| -x * (1.0 + 50.0 * x * x),
                |x| libm::cbrt(-x),
                |x| libm::expm1(-9.0 * x),
            ];
            for (number, shape) in shapes.iter().enumerate() {
                let value = |x: f64| shape(x - place);
                let found = first_below(1.0, (value(0.0), value(1.0)), value);
                assert!((found - place).abs() < 2e-8, "{number} {place}: {found}");
            }
        }
    }

    #[test]
    fn a_step_ends_where_the_edge_does() {
        let pivot = edge(0.3);
        let ball = Ball::pool(BallId(1));
        let velocity = DVec3::new(0.05, 0.4, 0.0);
        let place = DVec3::new(1e-9, 1.0 - 0.4e-3, ball.radius_m);
        let spin = DVec3::Z.cross(velocity) / ball.radius_m;
        let step = pivot.step(place, &Mover::new(&ball, velocity, spin), 1.0).unwrap();
        assert!((step.length_s - 1e-3).abs() < 1e-5, "{step:?}");
    }
}
