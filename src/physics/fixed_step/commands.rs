//! Commands: what a player or the rules want done.

use super::body::Body;
use super::cue_motion::CueMotion;
use super::{Due, FixedStep, weight_j};
use crate::ball::{BallPlace, Motion};
use crate::cue::CuePath;
use crate::events::{Command, FactKind, Spotting, TouchedBy, Zone};
use crate::ids::BallId;
use crate::physics::{PhysicsError, checks, tolerance};
use crate::rack::Occupied;
use crate::units::Seconds;
use glam::{DVec2, DVec3};
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

    /// Carries out what is due at the grid time in hand.
    pub(super) fn carry_out_commands(&mut self) {
        while self.commands.front().is_some_and(|due| due.step <= self.step) {
            let Some(Due { command, .. }) = self.commands.pop_front() else { return };
            match command {
                Command::MoveCue(path) => self.move_cue(path),
                Command::LiftCue => self.cue = None,
                Command::PlaceBall { ball, position_m, zone } => {
                    self.place_ball(ball, position_m, zone);
                }
                Command::SpotBalls(spotting) => self.spot_balls(&spotting),
                // The rules' business.
                Command::Call(_) | Command::Choose(_) | Command::Rack(_) | Command::Undo => {}
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
        let (now, g) = (self.grid(self.step), self.parameters.gravity_m_s2);
        let body = &mut self.bodies[index];
        if body.in_play() {
            self.ledger.removed_j += body.mover().kinetic_j() + weight_j(body, g);
            if body.ball.flags.integrate {
                self.ledger.momentum.removed += body.velocity * body.ball.mass_kg;
            }
        }
        body.placed = (body.place, now);
        body.place = BallPlace::OnTable;
        body.position = place.extend(body.ball.radius_m);
        body.velocity = DVec3::ZERO;
        body.angular_velocity = DVec3::ZERO;
        body.motion = Motion::Rest;
        body.way = None;
        body.asleep = false;
        self.ledger.placed_j += weight_j(body, g);
        self.touching.retain(|(a, b)| *a != index && *b != index);
        self.find_supports(index);
        self.clear_touched_rails(index);
    }

    /// Puts balls on their spots, or where they belong if there is no room.
    fn spot_balls(&mut self, Spotting { balls, cue_ball }: &Spotting) {
        let (Some(bed), spots) = (self.ground.bed, self.ground.spots) else { return };
        for ball in balls {
            let Some(index) = self.index(*ball) else { continue };
            let others = self.bodies.iter().filter(|body| body.solid() && body.ball.id != *ball);
            let lies = |body: &Body| (body.ball.id, body.position.truncate(), body.ball.radius_m);
            let occupied: Vec<Occupied> = others.map(lies).collect();
            let radius_m = self.bodies[index].ball.radius_m;
            self.put_down(index, spots.place(&bed, *ball, *cue_ball, &occupied, radius_m));
        }
    }
}
