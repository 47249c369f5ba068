//! Commands: what a player or the rules want done.

use super::body::Body;
use super::cue_motion::CueMotion;
use super::{Due, FixedStep, Lie, Order, collect, weight_j};
use crate::ball::BallPlace;
use crate::cue::CuePath;
use crate::events::{Command, FactKind, Spotting, TouchedBy, Zone};
use crate::ids::BallId;
use crate::physics::{PhysicsError, checks, tolerance};
use crate::units::Seconds;
use glam::DVec2;
use std::sync::Arc;

impl FixedStep {
    /// Whether a command can be carried out at all.
    pub(super) fn check_command(&self, at: Seconds, command: &Command) -> Result<(), PhysicsError> {
        checks::check_command(at, command)?;
        match command {
            Command::PlaceBall { ball, .. } if self.index(*ball).is_none() => {
                Err(PhysicsError::UnknownBall(*ball))
            }
            Command::SpotBalls(spotting) => {
                match spotting.balls.iter().find(|ball| self.index(**ball).is_none()) {
                    Some(ball) => Err(PhysicsError::UnknownBall(*ball)),
                    None => Ok(()),
                }
            }
            _ => Ok(()),
        }
    }

    /// Has something carried out at the first grid time from `at` on.
    pub(super) fn order(&mut self, at: Seconds, order: Order) {
        let step = self.step_at(at).max(self.step);
        let place = self.commands.partition_point(|due| due.step <= step);
        self.commands.insert(place, Due { step, order });
    }

    /// Carries out what is due at the grid time in hand.
    pub(super) fn carry_out_commands(&mut self) {
        while self.commands.front().is_some_and(|due| due.step <= self.step) {
            let Some(Due { order, .. }) = self.commands.pop_front() else { return };
            let command = match order {
                Order::Command(command) => command,
                Order::Lay(lies) => {
                    self.lay_all(&lies);
                    continue;
                }
            };
            match command {
                Command::MoveCue(path) => self.move_cue(path),
                Command::LiftCue => self.cue = None,
                Command::PlaceBall { ball, position_m, zone } => {
                    self.place_ball(ball, position_m, zone);
                }
                Command::SpotBalls(spotting) => self.spot_balls(&spotting),
                Command::Undo => {
                    if let Some(lies) = self.memory.take_back() {
                        self.lay_all(&lies);
                        if lies.iter().any(Lie::is_cue_ball_on_table) {
                            let now = self.grid(self.step);
                            self.tell(now, Lie::TAKEN_BACK);
                        }
                    }
                }
                // The rules' business, and [`Simulation`](crate::physics::Simulation)'s.
                Command::Call(_) | Command::Choose(_) | Command::Rack(_) => {}
            }
        }
    }

    fn move_cue(&mut self, path: Arc<CuePath>) {
        match &mut self.cue {
            Some(cue) => cue.guided.follow(path),
            None => self.cue = Some(CueMotion::new(path, &self.parameters)),
        }
    }

    fn place_ball(&mut self, ball: BallId, place: DVec2, zone: Zone) {
        let Some(index) = self.index(ball) else { return };
        let now = self.grid(self.step);
        let lively = |index: usize| {
            let body = &self.bodies[index];
            body.in_play() && body.liveliness() > tolerance::REST_M_S
        };
        let moving = (0..self.bodies.len()).any(lively);
        let ok = self.may_stand(index, place, zone);
        if moving {
            self.begin_shot();
        }
        if ok {
            self.put_down(index, place);
        }
        if moving {
            self.tell(now, FactKind::BallTouched { ball, by: TouchedBy::Hand });
        }
        self.tell(now, FactKind::BallPlaced { ball, zone, ok });
    }

    /// Whether a ball may be put here: in its zone, on the bed, on no other ball.
    fn may_stand(&self, index: usize, place: DVec2, zone: Zone) -> bool {
        let others = self
            .bodies
            .iter()
            .enumerate()
            .filter(|(other, body)| *other != index && body.solid())
            .map(|(_, body)| (body.position, body.ball.radius_m));
        let radius = self.bodies[index].ball.radius_m;
        let (bed, pockets) = (self.ground.bed.as_ref(), &self.ground.pockets);
        checks::may_stand(bed, pockets, others, radius, place, zone)
    }

    /// Puts a ball down at rest.
    fn put_down(&mut self, index: usize, place: DVec2) {
        let body = &self.bodies[index];
        let position = place.extend(body.ball.radius_m);
        let (ball, orientation) = (body.ball.id, body.orientation);
        self.lay_one(index, &Lie { ball, place: BallPlace::OnTable, position, orientation });
        self.find_supports(index);
        self.clear_touched_rails(index);
    }

    /// A shot begins, if none is under way.
    pub(super) fn begin_shot(&mut self) {
        let (memory, bodies) = (&mut self.memory, &self.bodies);
        let lie = |body: &Body| Lie {
            ball: body.ball.id,
            place: body.place,
            position: body.position,
            orientation: body.orientation,
        };
        memory.begin(|| bodies.iter().map(lie).collect());
    }

    /// Lays balls down together, at rest.
    fn lay_all(&mut self, lies: &[Lie]) {
        let known = |lie: &Lie| Some((self.index(lie.ball)?, *lie));
        let lies: Vec<(usize, Lie)> = lies.iter().filter_map(known).collect();
        lies.iter().for_each(|(index, lie)| self.lay_one(*index, lie));
        // What one lies on, or beside, is there before it is asked for.
        for (index, _) in lies {
            self.find_supports(index);
            self.clear_touched_rails(index);
        }
    }

    /// A hand takes a ball and lays it down at rest, or keeps it out of play.
    fn lay_one(&mut self, index: usize, lie: &Lie) {
        let (now, g) = (self.grid(self.step), self.parameters.gravity_m_s2);
        let body = &mut self.bodies[index];
        if body.in_play() {
            self.ledger.removed_j += body.mover().kinetic_j() + weight_j(body, g);
            if body.ball.flags.integrate {
                self.ledger.momentum.removed += body.velocity * body.ball.mass_kg;
            }
        }
        collect(body, lie.place, now);
        body.position = lie.position;
        body.orientation = lie.orientation;
        body.way = None;
        body.asleep = false;
        if body.in_play() {
            self.ledger.placed_j += weight_j(body, g);
        }
        self.touching.retain(|(a, b)| *a != index && *b != index);
    }

    /// Puts balls back on their spots, or where they belong if there is no room.
    fn spot_balls(&mut self, spotting: &Spotting) {
        let (Some(bed), spots) = (self.ground.bed, self.ground.spots) else { return };
        let solid = self.bodies.iter().filter(|body| body.solid());
        let lies = |body: &Body| (body.ball.id, body.position.truncate(), body.ball.radius_m);
        let lie = solid.map(lies).collect();
        let radius_m = |ball| Some(self.bodies[self.index(ball)?].ball.radius_m);
        for (ball, place) in spots.places(&bed, spotting, lie, radius_m) {
            if let Some(index) = self.index(ball) {
                self.put_down(index, place);
            }
        }
    }
}
