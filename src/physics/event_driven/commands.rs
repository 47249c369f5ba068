//! Commands: what a player or the rules want done.

use super::EventDriven;
use super::body::Body;
use super::segment::Segment;
use super::tip::Tip;
use crate::ball::BallPlace;
use crate::cue::CuePath;
use crate::events::{Command, FactKind, Spotting, TouchedBy, Zone};
use crate::ids::BallId;
use crate::physics::{PhysicsError, checks, tolerance};
use crate::rack::Occupied;
use crate::units::Seconds;
use glam::DVec2;
use std::sync::Arc;

impl EventDriven {
    /// Whether a command can be carried out at all.
    pub(super) fn check_command(&self, at: Seconds, command: &Command) -> Result<(), PhysicsError> {
        checks::check_command(at, command)?;
        let unknown = match command {
            Command::PlaceBall { ball, .. } => self.index(*ball).is_none().then_some(*ball),
            Command::SpotBalls(spotting) => {
                spotting.balls.iter().copied().find(|ball| self.index(*ball).is_none())
            }
            _ => None,
        };
        unknown.map_or(Ok(()), |ball| Err(PhysicsError::UnknownBall(ball)))
    }

    /// Carries a command out.
    pub(super) fn carry_out(&mut self, at: Seconds, command: &Command) -> Result<(), PhysicsError> {
        match command {
            Command::MoveCue(path) => self.move_cue(at, path.clone()),
            Command::LiftCue => self.tip = None,
            Command::PlaceBall { ball, position_m, zone } => {
                self.place_ball(at, *ball, *position_m, *zone);
            }
            Command::SpotBalls(spotting) => self.spot_balls(at, spotting),
            // The rules' business.
            Command::Call(_) | Command::Choose(_) | Command::Rack(_) | Command::Undo => {}
        }
        Ok(())
    }

    fn move_cue(&mut self, at: Seconds, path: Arc<CuePath>) {
        match &mut self.tip {
            Some(tip) => tip.cue.follow(path),
            None => self.tip = Some(Tip::new(path, &self.parameters)),
        }
        self.open_window(at);
    }

    fn place_ball(&mut self, at: Seconds, ball: BallId, place: DVec2, zone: Zone) {
        let Some(index) = self.index(ball) else { return };
        let moving = self
            .bodies
            .iter()
            .any(|body| body.in_play() && body.liveliness(at) > tolerance::REST_M_S);
        let others = self
            .bodies
            .iter()
            .enumerate()
            .filter(|(other, body)| *other != index && body.solid())
            .map(|(_, body)| (body.segment.position_at(at), body.ball.radius_m));
        let radius = self.bodies[index].ball.radius_m;
        let (bed, pockets) = (self.terrain.bed.as_ref(), &self.terrain.pockets);
        let ok = checks::may_stand(bed, pockets, others, radius, place, zone);
        if ok {
            self.put_down(at, index, place);
        }
        if moving {
            self.tell(at, FactKind::BallTouched { ball, by: TouchedBy::Hand });
        }
        self.tell(at, FactKind::BallPlaced { ball, zone, ok });
    }

    /// Puts a ball down at rest.
    fn put_down(&mut self, at: Seconds, index: usize, place: DVec2) {
        if self.bodies[index].in_play() {
            self.close_segment(at, index);
            let body = &self.bodies[index];
            self.ledger.removed_j += self.energy_of(body, at);
            if body.ball.flags.integrate {
                let momentum = body.segment.velocity_at(at) * body.ball.mass_kg;
                self.ledger.momentum.removed += momentum;
            }
        }
        let body = &mut self.bodies[index];
        body.put(BallPlace::OnTable, at);
        let position = place.extend(body.ball.radius_m);
        let rest = Segment::still(at, position, body.segment.orientation_at(at));
        body.turn_into(rest);
        self.ledger.placed_j += self.weight_j(&self.bodies[index], at);
        self.touching.retain(|(a, b, _)| *a != index && *b != index);
        self.lay_down(index);
        self.clear_touched_rails(index);
        self.predict(at, &[index]);
        self.wake_neighbours(at, &[index]);
    }

    /// Puts balls on their spots, or where they belong if there is no room.
    fn spot_balls(&mut self, at: Seconds, Spotting { balls, cue_ball }: &Spotting) {
        let (Some(bed), spots) = (self.terrain.bed, self.terrain.spots) else { return };
        for ball in balls {
            let Some(index) = self.index(*ball) else { continue };
            let others = self.bodies.iter().filter(|body| body.solid() && body.ball.id != *ball);
            let lies = |body: &Body| {
                let middle = body.segment.position_at(at).truncate();
                (body.ball.id, middle, body.ball.radius_m)
            };
            let occupied: Vec<Occupied> = others.map(lies).collect();
            let radius_m = self.bodies[index].ball.radius_m;
            self.put_down(at, index, spots.place(&bed, *ball, *cue_ball, &occupied, radius_m));
        }
    }
}
