//! A carried ball that strikes a surface and slips on what carries it: the law of
//! [`super::cushion`], in closed form but for one angle or two.
//!
//! So does nearly every ball that meets a cushion: the nose presses it into the cloth, and there it
//! slips, because it has just turned back. The struck surface sticks or slips. With the direction
//! of each friction known everything is linear, and a direction is right if it is against the slip
//! that it leaves: an angle to be found, by Newton's method from the slip without friction of the
//! bed. That is a seventh of the work of [`super::one_ball`], which knows every other case and is
//! asked if this one turns out not to be at hand.
//!
//! In units of the mass, with x̂ level and away from the struck surface, ẑ the support's normal,
//! n = c x̂ + s ẑ, τ = c ẑ − s x̂, A = m R²/I, impulses p = Jc n + t_y ŷ + t_τ τ of the struck
//! surface and q of the bed, the slips after the impact are
//! ```text
//! struck: u_y = u_y° + (1+A) t_y + (1+As) q_y      u_τ = u_τ° + (1+A) t_τ − (s+A) q_x + c q_z
//! bed:    w_x = w_x° + c Jc − (s+A) t_τ + (1+A) q_x     w_y = w_y° + (1+As) t_y + (1+A) q_y
//! ```
//! and the normal velocities Jc + c q_x + s q_z = T, s Jc + c t_τ + q_z = Z are given.

use super::Mover;
use super::one_ball::Surface;
use glam::{DMat2, DVec2, DVec3};

/// Newton's iterations before giving up.
const ITERATIONS: usize = 12;
/// The change of an angle that ends the iteration [rad]. It converges quadratically, so what is
/// left then is the square of this.
const CLOSE_RAD: f64 = 1e-9;
/// Least level part of the struck surface's normal: on what is hardly steeper than the bed the
/// frame means nothing.
const LEVEL_LEAST: f64 = 0.1;

/// The impulses of the struck surface and of the bed on the ball [N s]; none if the ball does not
/// slip on the bed or is not pressed against both.
pub fn solve(ball: &Mover, struck: &Surface, bed: &Surface) -> Option<[DVec3; 2]> {
    let z = bed.normal;
    let s = struck.normal.dot(z);
    let level = struck.normal - z * s;
    let c = level.length();
    if c < LEVEL_LEAST || ball.inverse_mass == 0.0 {
        return None;
    }
    let x = level / c;
    let y = z.cross(x);
    let wedge = Wedge::new(ball, struck, bed, [x, y, z], (c, s));
    let hold = wedge.stick().or_else(|| wedge.slip())?;
    let unit = 1.0 / ball.inverse_mass;
    let tau = z * c - x * s;
    Some([
        (struck.normal * hold.press + y * hold.along.x + tau * hold.along.y) * unit,
        (x * hold.bed.x + y * hold.bed.y + z * hold.carry) * unit,
    ])
}

/// A ball between two surfaces, in the frame and the units above.
struct Wedge {
    c: f64,
    s: f64,
    /// 1 + A.
    own: f64,
    /// 1 + A s.
    sideways: f64,
    /// s + A.
    across: f64,
    /// T and Z.
    turned: f64,
    lifted: f64,
    /// Slip at the struck surface along ŷ and τ, and on the bed, before the impact [m/s].
    struck: DVec2,
    bed: DVec2,
    /// Friction of the struck surface and of the bed.
    friction: (f64, f64),
}

/// What both surfaces do, over the mass [m/s].
struct Hold {
    /// Along the struck surface's normal, and across it along ŷ and τ.
    press: f64,
    along: DVec2,
    /// Along the bed's normal, and across it.
    carry: f64,
    bed: DVec2,
}

impl Wedge {
    fn new(
        ball: &Mover,
        struck: &Surface,
        bed: &Surface,
        [x, y, z]: [DVec3; 3],
        (c, s): (f64, f64),
    ) -> Self {
        let a = ball.radius_m * ball.radius_m * ball.inverse_inertia / ball.inverse_mass;
        let (v, w) = (ball.velocity, ball.angular_velocity * ball.radius_m);
        let (vx, vy, vz) = (v.dot(x), v.dot(y), v.dot(z));
        let (wx, wy, wz) = (w.dot(x), w.dot(y), w.dot(z));
        Wedge {
            c,
            s,
            own: 1.0 + a,
            sideways: 1.0 + a * s,
            across: s + a,
            turned: struck.target_m_s - (c * vx + s * vz),
            lifted: bed.target_m_s - vz,
            struck: DVec2::new(vy - c * wz + s * wx, c * vz - s * vx + wy),
            bed: DVec2::new(vx - wy, vy + wx),
            friction: (struck.friction, bed.friction),
        }
    }

    /// The struck surface sticks; none if it does not.
    ///
    /// With t from u = 0 the slip on the bed is w = a° + q_z (g d μ + h), d the direction of the
    /// bed's friction, and q_z = N/(α + β d_x).
    fn stick(&self) -> Option<Hold> {
        let Wedge { c, s, own, sideways, across, .. } = *self;
        let (limit, friction) = self.friction;
        let free = self.bed
            + DVec2::new(
                c * self.turned + across / own * self.struck.y,
                -sideways / own * self.struck.x,
            );
        let yields =
            DVec2::new(own - c * c - across * across / own, own - sideways * sideways / own);
        let lean = DVec2::new(c * (across / own - s), 0.0);
        let carried = self.lifted - s * self.turned + c / own * self.struck.y;
        let (alpha, beta) = (c * c * (1.0 - 1.0 / own), friction * c * (across / own - s));

        let mut way = -free.try_normalize()?;
        for _ in 0..ITERATIONS {
            let share = alpha + beta * way.x;
            let carry = carried / share;
            let pull = yields * way * friction + lean;
            let slip = free + pull * carry;
            let turn =
                yields * way.perp() * friction * carry + pull * (carry * beta * way.y / share);
            let change = turned(way, slip, way.perp_dot(turn));
            way = (way + way.perp() * change).normalize();
            // Nonsense ends here as well.
            if !(change.abs() > CLOSE_RAD) {
                let carry = carried / (alpha + beta * way.x);
                let bed = way * (friction * carry);
                let press = self.turned - c * bed.x - s * carry;
                let along = DVec2::new(
                    -(self.struck.x + sideways * bed.y) / own,
                    -(self.struck.y - across * bed.x + c * carry) / own,
                );
                let hold = Hold { press, along, carry, bed };
                let holds = along.length() <= limit * press;
                return (holds && self.slips(&hold)).then_some(hold);
            }
        }
        None
    }

    /// Both slip; none if one of them does not.
    fn slip(&self) -> Option<Hold> {
        let Wedge { c, s, own, sideways, across, turned: t, lifted: z, .. } = *self;
        let (rub, friction) = self.friction;
        let mut along = -self.struck.try_normalize()?;
        let mut way = -(self.bed + DVec2::X * (c * t)).try_normalize()?;
        for _ in 0..ITERATIONS {
            // Jc + p q_z = T, r Jc + q_z = Z.
            let (p, r) = (c * friction * way.x + s, s + c * rub * along.y);
            let inverse = 1.0 / (1.0 - p * r);
            let (press, carry) = ((t - p * z) * inverse, (z - r * t) * inverse);
            // How they change as each direction turns.
            let (r_along, p_way) = (c * rub * along.x, -c * friction * way.y);
            let press_turns = [p * r_along * press * inverse, -p_way * carry * inverse];
            let carry_turns = [-r_along * press * inverse, r * p_way * carry * inverse];
            let (rubs, drags) = (along * rub, way * friction);
            let rub_turns = [rubs * press_turns[0] + rubs.perp() * press, rubs * press_turns[1]];
            let drag_turns =
                [drags * carry_turns[0], drags * carry_turns[1] + drags.perp() * carry];

            let struck = |rub: DVec2, drag: DVec2, carry: f64| {
                DVec2::new(
                    own * rub.x + sideways * drag.y,
                    own * rub.y - across * drag.x + c * carry,
                )
            };
            let bed = |rub: DVec2, drag: DVec2, press: f64| {
                DVec2::new(
                    c * press - across * rub.y + own * drag.x,
                    sideways * rub.x + own * drag.y,
                )
            };
            let (rubs, drags) = (rubs * press, drags * carry);
            let u = self.struck + struck(rubs, drags, carry);
            let w = self.bed + bed(rubs, drags, press);
            let [u_along, u_way] =
                [0, 1].map(|k| struck(rub_turns[k], drag_turns[k], carry_turns[k]));
            let [w_along, w_way] = [0, 1].map(|k| bed(rub_turns[k], drag_turns[k], press_turns[k]));
            let matrix = DMat2::from_cols(
                DVec2::new(along.perp_dot(u_along) - along.dot(u), way.perp_dot(w_along)),
                DVec2::new(along.perp_dot(u_way), way.perp_dot(w_way) - way.dot(w)),
            );
            let change = -(matrix.inverse() * DVec2::new(along.perp_dot(u), way.perp_dot(w)));
            if !(change.abs().max_element() > CLOSE_RAD) {
                // The last change, to first order; its square is less than rounding.
                let hold = Hold {
                    press: press + press_turns[0] * change.x + press_turns[1] * change.y,
                    along: rubs + rub_turns[0] * change.x + rub_turns[1] * change.y,
                    carry: carry + carry_turns[0] * change.x + carry_turns[1] * change.y,
                    bed: drags + drag_turns[0] * change.x + drag_turns[1] * change.y,
                };
                let against = along.dot(u) < 0.0;
                return (against && self.slips(&hold)).then_some(hold);
            }
            along = (along + along.perp() * change.x).normalize();
            way = (way + way.perp() * change.y).normalize();
        }
        None
    }

    /// Whether the ball is pressed against both surfaces and slips on the bed against its friction.
    fn slips(&self, hold: &Hold) -> bool {
        let Wedge { c, own, sideways, across, .. } = *self;
        let slip = self.bed
            + DVec2::new(
                c * hold.press - across * hold.along.y + own * hold.bed.x,
                sideways * hold.along.x + own * hold.bed.y,
            );
        hold.press > 0.0 && hold.carry >= 0.0 && slip.dot(hold.bed) <= 0.0 && hold.along.is_finite()
    }
}

/// Newton's change of the angle of `way` that brings it against `slip`; `turn` is how much of the
/// slip's own change with the angle lies across `way`.
fn turned(way: DVec2, slip: DVec2, turn: f64) -> f64 {
    -way.perp_dot(slip) / (turn - way.dot(slip))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;
    use crate::physics::laws::one_ball;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    #[test]
    fn struck_and_slipping_balls_are_solved_as_by_the_general_method() {
        let mut random = Pcg64::seed_from_u64(3);
        let (mut stuck, mut slipped, mut left) = (0, 0, 0);
        for case in 0..20_000 {
            let mut one = |size: f64| random.random_range(-size..size);
            let lean = one(0.3);
            let towards = one(3.2);
            let heading = DVec3::new(libm::cos(towards), libm::sin(towards), 0.0);
            let normal = heading * (1.0 - lean * lean).sqrt() + DVec3::Z * lean;
            let velocity =
                heading * (-0.01 - 5.0 * one(1.0).abs()) + DVec3::Z.cross(heading) * one(4.0);
            let spin = DVec3::new(one(100.0), one(100.0), one(100.0));
            let rolls = DVec3::Z.cross(velocity) / 0.028575 + DVec3::Z * spin.z;
            let ball = Ball::pool(BallId(1));
            let spin = if case % 2 == 0 { rolls } else { spin };
            let ball = Mover::new(&ball, velocity, spin);
            let target_m_s = -0.85 * velocity.dot(normal);
            let struck = Surface { normal, target_m_s, friction: one(0.4).abs() };
            let bed = Surface { normal: DVec3::Z, target_m_s: 0.0, friction: one(0.4).abs() };
            let Some(direct) = solve(&ball, &struck, &bed) else {
                left += 1;
                continue;
            };
            let Some(general) = one_ball::solve(&ball, &[struck, bed]) else { continue };
            // Where the slip nearly ends the general method stops with the looser end.
            for (one, other) in direct.iter().zip(&general) {
                assert!(one.distance(*other) < 1e-9, "{case}: {direct:?} {general:?}");
            }
            let mut after = ball;
            after.push(normal, direct[0]);
            after.push(DVec3::Z, direct[1]);
            let drag = direct[1].with_z(0.0);
            let slip = after.surface_velocity(DVec3::Z).with_z(0.0);
            assert!(after.velocity.z.abs() < 1e-13 && drag.dot(slip) <= 0.0, "{case}");
            assert!(drag.cross(slip).length() <= 1e-12 * drag.length(), "{case}: {drag} {slip}");
            assert!((after.velocity.dot(normal) - target_m_s).abs() < 1e-13, "{case}");
            let slip = after.surface_velocity(normal);
            if (slip - normal * slip.dot(normal)).length() < 1e-11 {
                stuck += 1;
            } else {
                slipped += 1;
            }
        }
        assert!(stuck > 2_000 && slipped > 4_000, "{stuck} {slipped} {left}");
    }
}
