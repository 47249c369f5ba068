//! The computer players of a scene, with all that they think with.

use super::CastError;
use crate::ai::{Adviser, Level, Mind, MindSetup, Player, PlayerSettings, ThrowTable};
use crate::ball::{Ball, BallState};
use crate::cue::Aim;
use crate::hash::seed_of;
use crate::ids::PlayerId;
use crate::input::Foresight;
use crate::physics::{PhysicsError, PhysicsSettings, Profile, Simulation, SolverKind};
use crate::rules::Referee;
use crate::scene::{PlayerKind, PlayerSection, Scene};
use crate::table::{Bed, Table};
use std::sync::Arc;

/// How many shots of the event-driven solver take as long as one in fixed steps, roughly: who has
/// only the latter tries so many times fewer.
const SHOTS_PER_STEPPED_SHOT: u32 = 16;

/// Who advises thinks as far as the champion, and reckons with an arm as unsteady as a person's.
const ADVISER_STRENGTH: u8 = 70;

/// What the computer players of a game have in common.
pub(super) struct Surroundings<'a> {
    pub scene: &'a Scene,
    pub table: &'a Arc<Table>,
    pub balls: &'a [(Ball, BallState)],
    /// The simulation of the game before its first tick.
    pub simulation: &'a Simulation,
    /// The referee of the game, likewise.
    pub referee: Option<&'a Referee>,
    pub ball_radius_m: f64,
}

/// A simulation of a player's own, without anybody who plays on it.
#[derive(Clone)]
struct Own {
    simulation: Simulation,
    /// It computes in steps, which takes many times as long.
    in_steps: bool,
}

/// The computer players, in the order of their seats.
pub(super) fn computers(around: &Surroundings<'_>) -> Result<Vec<Player>, CastError> {
    let seats = around.scene.players.iter().zip([PlayerId::ONE, PlayerId::TWO]);
    let mut own = None;
    let mut players = Vec::new();
    for (section, id) in seats.filter(|(section, _)| section.kind.is_computer()) {
        let Some(bed) = around.table.bed else {
            return Err(CastError::NoTable { player: section.name.clone() });
        };
        players.push(around.computer(section, id, bed, &mut own)?);
    }
    Ok(players)
}

impl Surroundings<'_> {
    fn computer(
        &self,
        section: &PlayerSection,
        id: PlayerId,
        bed: Bed,
        own: &mut Option<Own>,
    ) -> Result<Player, CastError> {
        let mut settings = self.settings(section, id)?;
        let rails = self.table.clone();
        let clearance = Arc::new(move |at, azimuth_rad| {
            rails.clearance_elevation(at, &Aim { azimuth_rad, ..Aim::default() })
        });
        let player = |settings| {
            let pockets = self.table.pockets.clone();
            Player::new(id, settings, bed, pockets, self.ball_radius_m, clearance)
        };
        let Some(referee) = self.referee.filter(|_| settings.level.simulates()) else {
            return Ok(player(settings));
        };

        // Two searching players look at copies of one table, which is prepared once.
        let Own { simulation, in_steps } = match own {
            Some(own) => own.clone(),
            None => own.insert(self.own_simulation()?).clone(),
        };
        if in_steps && section.simulations.is_none() {
            settings.simulations = settings.simulations.div_ceil(SHOTS_PER_STEPPED_SHOT);
        }
        let mind = Mind::new(self.mind_setup(simulation, &settings, bed, referee));
        Ok(player(settings).with_mind(Arc::new(mind), referee.clone()))
    }

    fn mind_setup(
        &self,
        simulation: Simulation,
        settings: &PlayerSettings,
        bed: Bed,
        referee: &Referee,
    ) -> MindSetup {
        MindSetup {
            simulation,
            balls: self.balls.iter().map(|(ball, _)| ball.clone()).collect(),
            table: self.table.clone(),
            bed,
            ball_radius_m: self.ball_radius_m,
            game: referee.game(),
            level: settings.level,
            noise: settings.stroke_noise(),
            throw: match self.scene.physics.profile {
                Profile::Standard => ThrowTable::shipped(),
                Profile::Paper2009 => ThrowTable::constant(settings.throw_factor),
            },
            simulations: settings.simulations,
        }
    }

    /// Somebody who tells a person what to play, by trying it on this table; none where nothing is
    /// played.
    pub fn adviser(&self, simulation: Simulation) -> Option<Adviser> {
        let (referee, bed) = (self.referee?, self.table.bed?);
        let seed = self.scene.about.seed;
        let settings =
            PlayerSettings::of_strength(ADVISER_STRENGTH, seed, self.scene.physics.profile);
        let setup = self.mind_setup(simulation, &settings, bed, referee);
        Some(Adviser::new(setup, referee.clone()))
    }

    fn settings(&self, section: &PlayerSection, id: PlayerId) -> Result<PlayerSettings, CastError> {
        let seed = seed_of(self.scene.about.seed, u64::from(id.0));
        let profile = self.scene.physics.profile;
        let of_level = |level| PlayerSettings::of_level(level, seed, profile);
        let mut settings = match section.kind {
            PlayerKind::Club => of_level(Level::Club),
            PlayerKind::Champion => of_level(Level::Champion),
            PlayerKind::Computer(strength) => PlayerSettings::of_strength(strength, seed, profile),
            PlayerKind::Paper | PlayerKind::Human | PlayerKind::Recorded => of_level(Level::Paper),
        };
        if self.table.pockets.is_empty() && !settings.level.simulates() {
            // A weak player of carom has the club's head and an unsteady arm.
            let PlayerKind::Computer(_) = section.kind else {
                return Err(CastError::NoPockets { player: section.name.clone() });
            };
            settings = PlayerSettings { noise: settings.noise, ..of_level(Level::Club) };
        }
        settings.noise = section.noise.unwrap_or(settings.noise);
        settings.throw_factor = section.throw_factor.unwrap_or(settings.throw_factor);
        settings.simulations = section.simulations.unwrap_or(settings.simulations);
        Ok(settings)
    }

    /// A table on which strokes are tried for a person; none where nobody sits at mouse and
    /// keyboard, nobody has a cue, or shots are computed in steps, which takes too long.
    pub fn tried_on(&self) -> Result<Option<Simulation>, PhysicsError> {
        if !self.scene.has_hand() || self.scene.cue.is_none() {
            return Ok(None);
        }
        let Own { simulation, in_steps } = self.own_simulation()?;
        Ok((!in_steps).then_some(simulation))
    }

    /// What a person sees ahead on this table.
    pub fn foresight(&self, simulation: Simulation) -> Foresight {
        Foresight::new(simulation, self.balls.iter().map(|(ball, _)| ball.clone()).collect())
    }

    /// The exact solver wherever it knows the scene's contact laws, whatever the game itself is
    /// computed with: it takes a fraction of the time, and a player who reckons with the laws need
    /// not reckon with the errors of a step. Only profile `2009` has laws that need steps.
    fn own_simulation(&self) -> Result<Own, PhysicsError> {
        let settings = &self.scene.physics;
        match (settings.solver, settings.profile) {
            (SolverKind::EventDriven, _) => {
                Ok(Own { simulation: self.simulation.clone(), in_steps: false })
            }
            (SolverKind::FixedStep, Profile::Standard) => {
                let exact = PhysicsSettings { solver: SolverKind::EventDriven, ..settings.clone() };
                let (balls, parameters) = (self.balls.to_vec(), self.scene.parameters());
                let simulation =
                    Simulation::with_parameters(self.table, balls, &exact, parameters)?;
                let simulation = simulation.with_racks(self.scene.racks(self.table));
                Ok(Own { simulation, in_steps: false })
            }
            (SolverKind::FixedStep, Profile::Paper2009) => {
                let simulation = self.simulation.clone();
                Ok(Own { simulation, in_steps: true })
            }
        }
    }
}
