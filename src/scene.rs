//! Scenes: a file says what exists in a game, and what it does not name does not exist.
//!
//! A scene is parsed from text; whoever has files hands their texts in. Everything in it is
//! untrusted: sizes are bounded, and whatever is wrong becomes a [`SceneError`] of one line that
//! names file, line, key and value and says what is allowed.

mod build;
mod check;
mod entrant;
mod error;
mod overrides;
mod plan;
mod player_kind;
mod reader;
mod sections;
#[cfg(test)]
mod tests;

pub use entrant::{Entrant, NoEntrant};
pub use error::SceneError;
pub use overrides::Overrides;
pub use plan::{PlanKind, PlanLine};
pub use player_kind::{PlayerKind, STRENGTH_MAX, STRENGTH_USUAL, UnknownComputer};

use crate::ball::{Ball, BallFlags, SOLID_SPHERE, Spring};
use crate::ids::{BallId, GameKind, PlayerId};
use crate::mesh::Surface;
use crate::physics::{Equipment, Parameters, PhysicsSettings};
use crate::table::Plane;
use glam::DVec3;

/// Largest scene file that is read [bytes].
pub const FILE_BYTES_MAX: usize = 4 << 20;
/// Most balls in a scene.
pub const BALLS_MAX: usize = 4096;
/// Most meshes in a scene; as many planes, and as many boxes.
pub const MESHES_MAX: usize = 64;
/// Depth of an overlap that is still taken for touching [m]: rounding of written decimals.
const TOUCHING_M: f64 = 1e-7;

/// What exists in a game. Sections that the file does not have are `None` or empty.
///
/// ```
/// use hapticbillard::physics::Simulation;
/// use hapticbillard::scene::Scene;
///
/// let text = r#"
///     [scene]
///     name = "A ball rolls"
///     [physics]
///     gravity_m_s2 = 9.81
///     [[plane]]
///     normal = [0, 0, 1]
///     [[ball]]
///     id = 0
///     position_m = [0, 0]
///     velocity_m_s = [2, 0, 0]
/// "#;
/// let scene = Scene::parse("rolls.toml", text)?;
/// let table = scene.build_table(&mut |file| Err(format!("there is no {file}")))?;
/// let balls = scene.build_balls(&table)?;
/// let shot = Simulation::from_parts(&table, balls, &scene.physics)?.run_until_rest()?;
/// assert!(shot.end_s > 10.0);
///
/// // What is wrong is told with its place and the way out.
/// let wrong = text.replace("[2, 0, 0]", "[2, 0]");
/// let error = Scene::parse("rolls.toml", &wrong).map(|_| ()).unwrap_err().to_string();
/// assert!(error.starts_with("rolls.toml:11: ball[0].velocity_m_s"), "{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The file, as the caller named it.
    pub file: String,
    /// `[scene]`
    pub about: About,
    /// `[physics]`
    pub physics: PhysicsSettings,
    /// `[table]`
    pub table: Option<TableSection>,
    /// `[[mesh]]`
    pub meshes: Vec<MeshSection>,
    /// `[[plane]]`
    pub planes: Vec<Plane>,
    /// `[[box]]`
    pub boxes: Vec<BoxSection>,
    /// `[balls]`
    pub balls: Option<BallsSection>,
    /// `[[ball]]`, in the order of the file.
    pub ball: Vec<BallSection>,
    /// `[cue]`
    pub cue: Option<CueSection>,
    /// `[rules]`
    pub rules: Option<RulesSection>,
    /// `[[player]]`: none, one or two.
    pub players: Vec<PlayerSection>,
    /// `[camera]`
    pub camera: Option<CameraSection>,
    /// `[renderer]`
    pub renderer: Option<RendererSection>,
    /// `[sound]`
    pub sound: Option<SoundSection>,
    /// `[haptic]`
    pub haptic: Option<HapticSection>,
    /// `[input]`
    pub input: Option<InputSection>,
    /// `[actors]`; without it everybody is real.
    pub actors: Option<ActorsSection>,
}

/// `[scene]`: what the scene is called.
#[derive(Debug, Clone, PartialEq)]
pub struct About {
    /// Its title.
    pub name: String,
    /// One sentence for the list of scenes.
    pub description: String,
    /// Fixes everything random.
    pub seed: u64,
}

/// `[table]`: a table made from one set of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct TableSection {
    /// Name of the parameters, such as `pool-9ft`.
    pub preset: String,
    /// Walls and furniture of its room stop balls that leave it; else the floor is endless.
    pub room: bool,
    /// Where it stands in the file.
    pub line: usize,
}

/// `[[mesh]]`: a fixed body from a Wavefront OBJ file.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSection {
    /// The file, seen from the scene's folder.
    pub file: String,
    /// What it is made of.
    pub surface: Surface,
    /// Where its origin is put [m].
    pub offset_m: DVec3,
    /// Its lengths are multiplied by this.
    pub scale: f64,
    /// Where it stands in the file.
    pub line: usize,
}

/// `[[box]]`: a fixed box along the axes; it becomes twelve faces.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxSection {
    /// Its middle [m].
    pub centre_m: DVec3,
    /// Its edges [m].
    pub size_m: DVec3,
    /// What it is made of.
    pub surface: Surface,
}

/// `[balls]`: a rack.
#[derive(Debug, Clone, PartialEq)]
pub struct BallsSection {
    /// Which.
    pub rack: RackKind,
    /// Where it stands in the file.
    pub line: usize,
}

/// How the balls of a game are set up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RackKind {
    /// Fifteen balls in a triangle, the 8 in its middle, and the cue ball.
    EightBall,
    /// Nine balls in a diamond, the 9 in its middle, and the cue ball.
    NineBall,
    /// Snooker: fifteen reds in a triangle, the colours on their spots, and the cue ball.
    Snooker,
    /// White, yellow and red of carom.
    Carom,
}

impl RackKind {
    /// The balls it sets up, in ascending order.
    pub fn ids(self) -> impl Iterator<Item = BallId> {
        let last = match self {
            RackKind::EightBall => 15,
            RackKind::NineBall => 9,
            RackKind::Snooker => 21,
            RackKind::Carom => 2,
        };
        (0..=last).map(BallId)
    }

    /// All racks.
    pub const ALL: [RackKind; 4] =
        [RackKind::EightBall, RackKind::NineBall, RackKind::Snooker, RackKind::Carom];

    /// The rack with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rack| rack.name() == name)
    }

    /// What is played with these balls.
    pub fn equipment(self) -> Equipment {
        match self {
            RackKind::EightBall | RackKind::NineBall => Equipment::Pool,
            RackKind::Snooker => Equipment::Snooker,
            RackKind::Carom => Equipment::Carom,
        }
    }

    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            RackKind::EightBall => "eight-ball",
            RackKind::NineBall => "nine-ball",
            RackKind::Snooker => "snooker",
            RackKind::Carom => "carom",
        }
    }
}

/// `[[ball]]`: one ball. With a rack, an entry replaces the rack's ball of that id.
#[derive(Debug, Clone, PartialEq)]
pub struct BallSection {
    /// Its name.
    pub id: BallId,
    /// Radius [m].
    pub radius_m: f64,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Moment of inertia over m R².
    pub inertia_factor: f64,
    /// Centre [m]; without a height it lies on z = 0.
    pub position_m: DVec3,
    /// Velocity [m/s].
    pub velocity_m_s: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity_rad_s: DVec3,
    /// What acts on it.
    pub flags: BallFlags,
    /// Pulls it to an anchor, if present.
    pub spring: Option<Spring>,
    /// Where it stands in the file.
    pub line: usize,
}

impl BallSection {
    /// The ball without its motion.
    pub fn ball(&self) -> Ball {
        Ball {
            id: self.id,
            radius_m: self.radius_m,
            mass_kg: self.mass_kg,
            inertia_factor: self.inertia_factor,
            flags: self.flags,
            spring: self.spring,
        }
    }
}

/// `[cue]`: there is a cue, or something else that balls are struck with. What it does not say is
/// as with a pool cue.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct CueSection {
    /// Radius of the tip's curvature [m].
    pub tip_radius_m: Option<f64>,
    /// Mass along the shaft [kg].
    pub mass_kg: Option<f64>,
    /// Effective mass of the end across the shaft [kg].
    pub end_mass_kg: Option<f64>,
    /// Restitution between tip and ball.
    pub tip_restitution: Option<f64>,
    /// Friction between tip and ball.
    pub tip_friction: Option<f64>,
}

impl CueSection {
    /// A pool cue.
    pub const POOL: CueSection = CueSection {
        tip_radius_m: None,
        mass_kg: None,
        end_mass_kg: None,
        tip_restitution: None,
        tip_friction: None,
    };

    /// Puts what the section says into `parameters`.
    pub fn apply(&self, parameters: &mut Parameters) {
        let set = |value: &mut f64, given: Option<f64>| *value = given.unwrap_or(*value);
        set(&mut parameters.tip_radius_m, self.tip_radius_m);
        set(&mut parameters.cue_mass_kg, self.mass_kg);
        set(&mut parameters.cue_end_mass_kg, self.end_mass_kg);
        set(&mut parameters.tip.restitution, self.tip_restitution);
        set(&mut parameters.tip.friction, self.tip_friction);
    }
}

/// `[rules]`: what is played.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RulesSection {
    /// The game.
    pub game: GameKind,
    /// Who breaks.
    pub first_player: PlayerId,
}

/// `[[player]]`: who plays.
#[derive(Debug, Clone, PartialEq)]
pub struct PlayerSection {
    /// What the player is called.
    pub name: String,
    /// Who decides.
    pub kind: PlayerKind,
    /// Noise of a computer's stroke, in multiples of the Computer Pool Olympiad's; none: what
    /// belongs to its kind.
    pub noise: Option<f64>,
    /// Throw compensation of the paper's player (paper, section 5.4.3); none: the player's own.
    pub throw_factor: Option<f64>,
    /// Shots that a computer may simulate for a decision; none: what belongs to its kind.
    pub simulations: Option<u32>,
    /// Where it stands in the file.
    pub line: usize,
}

/// `[camera]`: there is a camera. It has no keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CameraSection;

/// `[renderer]`: there is a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RendererSection {
    /// Width of the picture [pixels].
    pub width: u32,
    /// Height of the picture [pixels].
    pub height: u32,
    /// Fills the whole screen.
    pub fullscreen: bool,
}

/// `[sound]`: what happens is heard.
#[derive(Debug, Clone, PartialEq)]
pub struct SoundSection {
    /// Name of the output; none: the system's own choice.
    pub device: Option<String>,
    /// Factor of the whole, 0 to 4.
    pub volume: f64,
    /// What the two channels are played by.
    pub mode: SoundMode,
    /// The walls of a room answer.
    pub room: bool,
    /// The soft noise of a room at night.
    pub room_tone: bool,
    /// A folder of recordings that stand in for what is synthesised, seen from the scene's folder.
    pub recordings: Option<String>,
}

/// What the two channels are played by.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum SoundMode {
    /// Headphones: one channel an ear.
    #[default]
    Headphones,
    /// Two loudspeakers in front of the player.
    Loudspeakers,
}

impl SoundMode {
    /// The names in a scene.
    pub const WORDS: [(&[&str], SoundMode); 2] = [
        (&["headphones"], SoundMode::Headphones),
        (&["loudspeakers", "speakers"], SoundMode::Loudspeakers),
    ];
}

/// `[haptic]`: forces are felt at a device.
#[derive(Debug, Clone, PartialEq)]
pub struct HapticSection {
    /// Which device.
    pub device: HapticDevice,
    /// The processor core that the real-time thread asks for.
    pub core: Option<u32>,
    /// Its real-time priority, 1 to 99.
    pub priority: Option<u32>,
    /// How long before a deadline it stops sleeping and spins [µs].
    pub spin_us: Option<u32>,
    /// Metres of the world per metre of the device.
    pub scale: Option<f64>,
    /// Further factor along the shaft during a stroke.
    pub stroke_gain: Option<f64>,
    /// The window begins with the panel of numbers.
    pub overlay: bool,
}

/// A haptic device, as scenes name it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HapticDevice {
    /// The first that is there, and the simulated one if there is none.
    Auto,
    /// A simulated device in a simulated hand.
    Simulated,
    /// The same; a mouse moves the hand.
    Mouse,
    /// A recording of a device, seen from the scene's folder.
    Recorded(String),
    /// A device of the OpenHaptics library, such as the PHANTOM Omni: the one of this name there,
    /// or the library's own choice.
    OpenHaptics(Option<String>),
    /// A Haply Inverse3 at its service: the one at this `HOST:PORT`, or on this machine.
    Haply(Option<String>),
    /// None, although the scene could be felt.
    None,
}

impl HapticDevice {
    /// Those that are named by one word.
    pub const PLAIN: [HapticDevice; 6] = [
        HapticDevice::Auto,
        HapticDevice::Simulated,
        HapticDevice::Mouse,
        HapticDevice::OpenHaptics(None),
        HapticDevice::Haply(None),
        HapticDevice::None,
    ];

    /// The device of this name, as scenes and options write it; none if there is none.
    pub fn named(text: &str) -> Option<HapticDevice> {
        match text.split_once(':') {
            Some((_, "")) => None,
            Some(("recorded", file)) => Some(HapticDevice::Recorded(file.into())),
            Some(("openhaptics", name)) => Some(HapticDevice::OpenHaptics(Some(name.into()))),
            Some(("haply", address)) => {
                let (host, port) = address.rsplit_once(':')?;
                let is_port = port.parse::<u16>().is_ok_and(|port| port > 0);
                let is_address = !host.is_empty() && is_port;
                is_address.then(|| HapticDevice::Haply(Some(address.into())))
            }
            _ => HapticDevice::PLAIN.into_iter().find(|device| device.name() == text),
        }
    }

    /// Its name in a scene.
    pub fn name(&self) -> String {
        match self {
            HapticDevice::Auto => "auto".into(),
            HapticDevice::Simulated => "simulated".into(),
            HapticDevice::Mouse => "mouse".into(),
            HapticDevice::Recorded(file) => format!("recorded:{file}"),
            HapticDevice::OpenHaptics(None) => "openhaptics".into(),
            HapticDevice::OpenHaptics(Some(name)) => format!("openhaptics:{name}"),
            HapticDevice::Haply(None) => "haply".into(),
            HapticDevice::Haply(Some(address)) => format!("haply:{address}"),
            HapticDevice::None => "none".into(),
        }
    }
}

/// `[input]`: mouse, keyboard and who stands in for them.
#[derive(Debug, Clone, PartialEq)]
pub struct InputSection {
    /// Name of the profile that says what each key does.
    pub profile: String,
}

/// `[actors]`: who stands in for whom.
#[derive(Debug, Clone, PartialEq)]
pub struct ActorsSection {
    /// What stands in for the hands at the input.
    pub input: Option<StandIn>,
}

/// A stand-in for an actor.
#[derive(Debug, Clone, PartialEq)]
pub enum StandIn {
    /// A recording, seen from the scene's folder.
    Recorded(String),
}

impl Scene {
    /// Reads a scene. `file_name` is only used to say where an error is.
    pub fn parse(file_name: &str, text: &str) -> Result<Scene, SceneError> {
        sections::parse(file_name, text)
    }

    /// The mesh files that [`Scene::build_table`] will ask for, in order, each once.
    pub fn meshes_needed(&self) -> Vec<&str> {
        let mut files: Vec<&str> = Vec::new();
        for mesh in &self.meshes {
            if !files.contains(&&*mesh.file) {
                files.push(&mesh.file);
            }
        }
        files
    }
}

/// Moment of inertia of a ball that does not say otherwise.
const INERTIA_DEFAULT: f64 = SOLID_SPHERE;
