//! Commands: what a player or the rules want done.

use super::body::Body;
use super::segment::Segment;
use super::tip::Tip;
use super::{EventDriven, Lie, Order};
use crate::ball::BallPlace;
use crate::cue::CuePath;
use crate::events::{Command, FactKind, Spotting, TouchedBy, Zone};
use crate::ids::BallId;
use crate::physics::{PhysicsError, checks, tolerance};
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

    /// Has something carried out at `at`, after what is due then already.
    pub(super) fn order(&mut self, at: Seconds, order: Order) {
        let at = at.max(self.now);
        let place = self.commands.partition_point(|(other, _)| *other <= at);
        self.commands.insert(place, (at, order));
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
            Command::Undo => {
                if let Some(lies) = self.memory.take_back() {
                    self.lay_all(at, &lies);
                    if lies.iter().any(Lie::is_cue_ball_on_table) {
                        self.tell(at, Lie::TAKEN_BACK);
                    }
                }
            }
            // The rules' business, and [`Simulation`](crate::physics::Simulation)'s.
            Command::Call(_) | Command::Choose(_) | Command::Rack(_) => {}
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
        if moving {
            self.begin_shot(at);
        }
        if ok {
            self.put_down(at, index, place);
        }
        if moving {
            self.tell(at, FactKind::BallTouched { ball, by: TouchedBy::Hand });
        }
        self.tell(at, FactKind::BallPlaced { ball, zone, ok });
    }

    /// A shot begins, if none is under way.
    pub(super) fn begin_shot(&mut self, at: Seconds) {
        let (memory, bodies) = (&mut self.memory, &self.bodies);
        memory.begin(|| bodies.iter().map(|body| Lie::from(&body.sample(at))).collect());
    }

    /// A hand takes a ball: its energy leaves the world.
    fn take_up(&mut self, at: Seconds, index: usize) {
        if !self.bodies[index].in_play() {
            return;
        }
        self.close_segment(at, index);
        let body = &self.bodies[index];
        self.ledger.removed_j += self.energy_of(body, at);
        if body.ball.flags.integrate {
            let momentum = body.segment.velocity_at(at) * body.ball.mass_kg;
            self.ledger.momentum.removed += momentum;
        }
    }

    /// Lays balls down together, at rest.
    pub(super) fn lay_all(&mut self, at: Seconds, lies: &[Lie]) {
        let known = |lie: &Lie| Some((self.index(lie.ball)?, *lie));
        let lies: Vec<(usize, Lie)> = lies.iter().filter_map(known).collect();
        for (index, lie) in &lies {
            self.take_up(at, *index);
            let body = &mut self.bodies[*index];
            body.put(lie.place, at);
            body.held.clear();
            body.turn_into(Segment::still(at, lie.position, lie.orientation));
        }
        let changed: Vec<usize> = lies.iter().map(|(index, _)| *index).collect();
        self.touching.retain(|(a, b, _)| !changed.contains(a) && !changed.contains(b));
        // What one lies on, or beside, is there before it is asked for.
        for index in &changed {
            self.lay_down(*index);
            if self.bodies[*index].in_play() {
                self.ledger.placed_j += self.weight_j(&self.bodies[*index], at);
            }
            self.clear_touched_rails(*index);
        }
        self.predict(at, &changed);
        self.wake_neighbours(at, &changed);
    }

    /// Puts a ball down at rest.
    fn put_down(&mut self, at: Seconds, index: usize, place: DVec2) {
        self.take_up(at, index);
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

    /// Puts balls back on their spots, or where they belong if there is no room.
    fn spot_balls(&mut self, at: Seconds, spotting: &Spotting) {
        let (Some(bed), spots) = (self.terrain.bed, self.terrain.spots) else { return };
        let solid = self.bodies.iter().filter(|body| body.solid());
        let lies = |body: &Body| {
            (body.ball.id, body.segment.position_at(at).truncate(), body.ball.radius_m)
        };
        let lie = solid.map(lies).collect();
        for (ball, place) in spots.places(&bed, spotting, lie, |ball| self.radius_m(ball)) {
            if let Some(index) = self.index(ball) {
                self.put_down(at, index, place);
            }
        }
    }
}
