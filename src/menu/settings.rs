//! What a player sets, and keeps from game to game.

use crate::ids::PlayerId;
use crate::input::{AimAid, Steering};
use crate::one_line::one_line;
use crate::picture::{PictureOption, PictureSettings, Preset};
use crate::rules::Language;
use crate::scene::{Entrant, PlayerKind, STRENGTH_MAX, STRENGTH_USUAL};
use crate::shipped;
use serde::{Deserialize, Serialize};

/// Steps of what is set in steps.
const STRENGTH_STEP: u8 = 5;
const VOLUME_STEP: u16 = 10;
/// As loud as a mixer plays the shipped scenes.
const VOLUME_MAX: u16 = 130;
const MOUSE_STEP: u16 = 25;
const MOUSE_MAX: u16 = 400;

/// Everything that is set.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// What is played.
    pub game: GameChoice,
    /// How large the table is, where pool is played.
    pub table: TableChoice,
    /// Who plays first.
    pub player_1: Seat,
    /// How strong, from 0 to 100, if that is a computer.
    pub strength_1: u8,
    /// Who plays second.
    pub player_2: Seat,
    /// How strong.
    pub strength_2: u8,
    /// The language of everything written.
    pub language: Tongue,
    /// Volume [% of what the scene says].
    pub volume_percent: u16,
    /// How far everything moves with the mouse [% of the usual].
    pub mouse_percent: u16,
    /// How far everything moves with a stylus [%].
    pub stylus_percent: u16,
    /// The window fills the screen.
    pub full_screen: bool,
    /// What helps to aim.
    pub aim_aid: AimAid,
    /// The haptic device that is played with.
    pub haptic: HapticChoice,
    /// How its stylus leads the camera.
    pub steering: Steering,
    /// A gamepad shakes with contacts.
    pub rumble: bool,
    /// Whoever plays was told of the tutorial.
    pub welcomed: bool,
    /// How pictures are drawn.
    pub picture: PictureSettings,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            game: GameChoice::WpaEightBall,
            table: TableChoice::NineFoot,
            player_1: Seat::Human,
            strength_1: STRENGTH_USUAL,
            player_2: Seat::Computer,
            strength_2: STRENGTH_USUAL,
            language: Tongue::System,
            volume_percent: 100,
            mouse_percent: 100,
            stylus_percent: 100,
            full_screen: false,
            aim_aid: AimAid::Line,
            haptic: HapticChoice::None,
            steering: Steering::ByPlace,
            rumble: true,
            welcomed: false,
            picture: PictureSettings::default(),
        }
    }
}

/// A game, and the shipped scene that it is played in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GameChoice {
    /// Eight-ball by the world's rules.
    WpaEightBall,
    /// Eight-ball as in the paper.
    EightBall,
    /// Nine-ball.
    NineBall,
    /// Straight pool.
    Straight,
    /// Snooker.
    Snooker,
    /// Three-cushion carom.
    ThreeCushion,
    /// Free carom.
    FreeCarom,
    /// A rack without rules.
    FreePlay,
    /// Without fouls; shots are taken back.
    Training,
}

impl GameChoice {
    /// All, in the order in which they are offered.
    pub const ALL: [GameChoice; 9] = [
        GameChoice::WpaEightBall,
        GameChoice::EightBall,
        GameChoice::NineBall,
        GameChoice::Straight,
        GameChoice::Snooker,
        GameChoice::ThreeCushion,
        GameChoice::FreeCarom,
        GameChoice::FreePlay,
        GameChoice::Training,
    ];

    /// The shipped scene.
    pub fn scene(self) -> &'static str {
        match self {
            GameChoice::WpaEightBall => "wpa_eight_ball",
            GameChoice::EightBall => "eight_ball",
            GameChoice::NineBall => "nine_ball",
            GameChoice::Straight => "straight",
            GameChoice::Snooker => "snooker",
            GameChoice::ThreeCushion => "three_cushion",
            GameChoice::FreeCarom => "free_carom",
            GameChoice::FreePlay => "free_play",
            GameChoice::Training => "training",
        }
    }

    /// The key of its name in the texts.
    pub fn key(self) -> &'static str {
        // Scenes are named after what is played there.
        self.scene()
    }

    /// Whether it is played on a pool table.
    pub fn is_pool(self) -> bool {
        !matches!(self, GameChoice::Snooker | GameChoice::ThreeCushion | GameChoice::FreeCarom)
    }

    /// How many play.
    pub fn seats(self) -> usize {
        match self {
            GameChoice::FreePlay | GameChoice::Training => 1,
            _ => 2,
        }
    }
}

/// A size of pool table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TableChoice {
    /// That of tournaments.
    NineFoot,
    /// That of homes.
    EightFoot,
    /// That of bars.
    SevenFoot,
}

impl TableChoice {
    /// The key of its name in the texts.
    pub fn key(self) -> &'static str {
        match self {
            TableChoice::NineFoot => "nine_foot",
            TableChoice::EightFoot => "eight_foot",
            TableChoice::SevenFoot => "seven_foot",
        }
    }

    /// The shipped table.
    pub fn preset(self) -> &'static str {
        match self {
            TableChoice::NineFoot => "pool-9ft",
            TableChoice::EightFoot => "pool-8ft",
            TableChoice::SevenFoot => "pool-7ft",
        }
    }
}

/// A haptic device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HapticChoice {
    /// None.
    None,
    /// A simulated one, whose hand the mouse moves.
    Mouse,
    /// A Haply Inverse3.
    Haply,
    /// One by OpenHaptics.
    Openhaptics,
}

impl HapticChoice {
    /// All, in the order in which they are offered.
    pub const ALL: [HapticChoice; 4] =
        [HapticChoice::None, HapticChoice::Mouse, HapticChoice::Haply, HapticChoice::Openhaptics];

    /// The key of its name in the texts.
    pub fn key(self) -> &'static str {
        match self {
            HapticChoice::None => "haptic_none",
            HapticChoice::Mouse => "haptic_mouse",
            HapticChoice::Haply => "haptic_haply",
            HapticChoice::Openhaptics => "haptic_openhaptics",
        }
    }

    /// What a scene asks for that is played with it.
    fn section(self) -> &'static str {
        match self {
            HapticChoice::None => "",
            HapticChoice::Mouse => "\n[haptic]\ndevice = \"mouse\"\n",
            HapticChoice::Haply => "\n[haptic]\ndevice = \"haply\"\n",
            HapticChoice::Openhaptics => "\n[haptic]\ndevice = \"openhaptics\"\n",
        }
    }
}

/// Who decides for a player.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Seat {
    /// Somebody at mouse, keyboard or stylus.
    Human,
    /// A computer.
    Computer,
}

impl Seat {
    /// The key of its name in the texts.
    pub fn key(self) -> &'static str {
        match self {
            Seat::Human => "human",
            Seat::Computer => "computer",
        }
    }
}

/// A language, or the one that the system speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tongue {
    /// As the system.
    System,
    /// English.
    English,
    /// German.
    German,
}

impl Tongue {
    /// The key of its name in the texts.
    pub fn key(self) -> &'static str {
        match self {
            Tongue::System => "system",
            Tongue::English => "english",
            Tongue::German => "german",
        }
    }

    /// The language, where the system's is this one.
    pub fn language(self, system: Language) -> Language {
        match self {
            Tongue::System => system,
            Tongue::English => Language::English,
            Tongue::German => Language::German,
        }
    }
}

/// One thing that can be set, by the name that pages give it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Setting {
    /// What is played.
    Game,
    /// How large the table is.
    Table,
    /// Who plays first.
    #[serde(rename = "player_1")]
    PlayerOne,
    /// How strong a computer there is.
    #[serde(rename = "strength_1")]
    StrengthOne,
    /// Who plays second.
    #[serde(rename = "player_2")]
    PlayerTwo,
    /// How strong a computer there is.
    #[serde(rename = "strength_2")]
    StrengthTwo,
    /// The language.
    Language,
    /// The volume.
    Volume,
    /// How far everything moves with the mouse.
    MouseSpeed,
    /// How far everything moves with a stylus.
    StylusSpeed,
    /// Whether the window fills the screen.
    FullScreen,
    /// What helps to aim.
    AimAid,
    /// The haptic device.
    Haptic,
    /// How its stylus leads the camera.
    Steering,
    /// Whether a gamepad shakes with contacts.
    Rumble,
    /// How much pictures may cost, all at once.
    Preset,
    /// One thing of how pictures are drawn.
    Picture(PictureOption),
}

impl Setting {
    /// All but those of pictures.
    const PLAIN: [Setting; 16] = [
        Setting::Game,
        Setting::Table,
        Setting::PlayerOne,
        Setting::StrengthOne,
        Setting::PlayerTwo,
        Setting::StrengthTwo,
        Setting::Language,
        Setting::Volume,
        Setting::MouseSpeed,
        Setting::StylusSpeed,
        Setting::FullScreen,
        Setting::AimAid,
        Setting::Haptic,
        Setting::Steering,
        Setting::Rumble,
        Setting::Preset,
    ];

    /// All.
    pub fn all() -> impl Iterator<Item = Setting> {
        Setting::PLAIN.into_iter().chain(PictureOption::ALL.map(Setting::Picture))
    }
}

/// What a setting can be: numbered places, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// So many values beside each other, that go round.
    Choice(usize),
    /// A scale up to this place.
    Scale(usize),
}

impl Range {
    /// The last place.
    pub fn last(self) -> usize {
        match self {
            Range::Choice(count) => count.saturating_sub(1),
            Range::Scale(last) => last,
        }
    }
}

const TABLES: [TableChoice; 3] =
    [TableChoice::NineFoot, TableChoice::EightFoot, TableChoice::SevenFoot];
const SEATS: [Seat; 2] = [Seat::Human, Seat::Computer];
const TONGUES: [Tongue; 3] = [Tongue::System, Tongue::English, Tongue::German];

/// Where `value` stands in a list; at its front if it does not.
fn place<T: PartialEq>(list: &[T], value: &T) -> usize {
    list.iter().position(|one| one == value).unwrap_or(0)
}

/// Where a speed stands on its scale, from one step on: what moves nothing is of no use.
fn speed_place(percent: u16) -> usize {
    (percent.clamp(MOUSE_STEP, MOUSE_MAX) / MOUSE_STEP - 1).into()
}

/// What it makes of a movement.
fn speed_factor(percent: u16) -> f64 {
    f64::from(percent.clamp(MOUSE_STEP, MOUSE_MAX)) / 100.0
}

impl Settings {
    /// Reads what [`Settings::to_toml`] wrote; what is missing is as usual.
    ///
    /// # Errors
    /// One line: what is wrong, and where.
    pub fn parse(text: &str) -> Result<Self, String> {
        let read: Self =
            toml::from_str(text).map_err(|error| one_line(error.to_string().trim_end(), 400))?;
        Ok(Settings { picture: read.picture.sound(), ..read })
    }

    /// As TOML.
    pub fn to_toml(&self) -> String {
        // Numbers, names and a yes or no: nothing that TOML has not.
        toml::to_string(self).unwrap_or_default()
    }

    /// What can be set.
    pub fn range(setting: Setting) -> Range {
        match setting {
            Setting::Game => Range::Choice(GameChoice::ALL.len()),
            Setting::Table => Range::Choice(TABLES.len()),
            Setting::PlayerOne | Setting::PlayerTwo => Range::Choice(SEATS.len()),
            Setting::StrengthOne | Setting::StrengthTwo => {
                Range::Scale((STRENGTH_MAX / STRENGTH_STEP).into())
            }
            Setting::Language => Range::Choice(TONGUES.len()),
            Setting::Volume => Range::Scale((VOLUME_MAX / VOLUME_STEP).into()),
            // From one step on: a mouse that moves nothing is of no use.
            Setting::MouseSpeed | Setting::StylusSpeed => {
                Range::Scale((MOUSE_MAX / MOUSE_STEP - 1).into())
            }
            Setting::FullScreen | Setting::Rumble => Range::Choice(2),
            Setting::AimAid => Range::Choice(AimAid::ALL.len()),
            Setting::Haptic => Range::Choice(HapticChoice::ALL.len()),
            Setting::Steering => Range::Choice(Steering::ALL.len()),
            Setting::Preset => Range::Choice(Preset::ALL.len()),
            Setting::Picture(option) => match option {
                PictureOption::RenderScale => Range::Scale(option.values().len() - 1),
                _ => Range::Choice(option.values().len()),
            },
        }
    }

    /// Which place of its range a setting has.
    pub fn place(&self, setting: Setting) -> usize {
        match setting {
            Setting::Game => place(&GameChoice::ALL, &self.game),
            Setting::Table => place(&TABLES, &self.table),
            Setting::PlayerOne => place(&SEATS, &self.player_1),
            Setting::StrengthOne => (self.strength_1.min(STRENGTH_MAX) / STRENGTH_STEP).into(),
            Setting::PlayerTwo => place(&SEATS, &self.player_2),
            Setting::StrengthTwo => (self.strength_2.min(STRENGTH_MAX) / STRENGTH_STEP).into(),
            Setting::Language => place(&TONGUES, &self.language),
            Setting::Volume => (self.volume_percent.min(VOLUME_MAX) / VOLUME_STEP).into(),
            Setting::MouseSpeed => speed_place(self.mouse_percent),
            Setting::StylusSpeed => speed_place(self.stylus_percent),
            Setting::FullScreen => self.full_screen.into(),
            Setting::Rumble => self.rumble.into(),
            Setting::AimAid => place(&AimAid::ALL, &self.aim_aid),
            Setting::Haptic => place(&HapticChoice::ALL, &self.haptic),
            Setting::Steering => place(&Steering::ALL, &self.steering),
            Setting::Preset => {
                // What nobody chose so stands before the first.
                Preset::of(&self.picture).map_or(0, |preset| place(&Preset::ALL, &preset))
            }
            Setting::Picture(option) => self.picture.place(option),
        }
    }

    /// Puts a setting at a place of its range; beyond it, at its end.
    pub fn put(&mut self, setting: Setting, place: usize) {
        let place = place.min(Self::range(setting).last());
        // No scale has more places than a byte holds.
        let steps = u8::try_from(place).unwrap_or(u8::MAX);
        match setting {
            Setting::Game => self.game = GameChoice::ALL[place],
            Setting::Table => self.table = TABLES[place],
            Setting::PlayerOne => self.player_1 = SEATS[place],
            Setting::StrengthOne => self.strength_1 = steps.saturating_mul(STRENGTH_STEP),
            Setting::PlayerTwo => self.player_2 = SEATS[place],
            Setting::StrengthTwo => self.strength_2 = steps.saturating_mul(STRENGTH_STEP),
            Setting::Language => self.language = TONGUES[place],
            Setting::Volume => self.volume_percent = u16::from(steps) * VOLUME_STEP,
            Setting::MouseSpeed => self.mouse_percent = (u16::from(steps) + 1) * MOUSE_STEP,
            Setting::StylusSpeed => self.stylus_percent = (u16::from(steps) + 1) * MOUSE_STEP,
            Setting::FullScreen => self.full_screen = place == 1,
            Setting::Rumble => self.rumble = place == 1,
            Setting::AimAid => self.aim_aid = AimAid::ALL[place],
            Setting::Haptic => self.haptic = HapticChoice::ALL[place],
            Setting::Steering => self.steering = Steering::ALL[place],
            Setting::Preset => self.picture = Preset::ALL[place].applied(self.picture),
            Setting::Picture(option) => self.picture.put(option, place),
        }
    }

    /// Whether a setting means anything beside the others.
    pub fn is_of_use(&self, setting: Setting) -> bool {
        let two = self.game.seats() == 2;
        match setting {
            Setting::Table => self.game.is_pool(),
            Setting::PlayerOne => two,
            Setting::StrengthOne => two && self.player_1 == Seat::Computer,
            Setting::PlayerTwo => two,
            Setting::StrengthTwo => two && self.player_2 == Seat::Computer,
            Setting::Steering | Setting::StylusSpeed => {
                !matches!(self.haptic, HapticChoice::None | HapticChoice::Mouse)
            }
            _ => true,
        }
    }

    /// The shipped scene of the game that is set, on the table and with the device that are set.
    pub fn scene_text(&self) -> String {
        let text = shipped::scene(self.game.scene()).unwrap_or_default();
        let usual = format!("preset = {:?}", TableChoice::NineFoot.preset());
        let text = text.replace(&usual, &format!("preset = {:?}", self.table.preset()));
        text + self.haptic.section()
    }

    /// Who plays the game that is set, from player 1 on. Who plays alone is a person.
    pub fn entrants(&self) -> Vec<Entrant> {
        if self.game.seats() == 1 {
            return vec![PlayerKind::Human.into()];
        }
        let seats = [(self.player_1, self.strength_1), (self.player_2, self.strength_2)];
        let kind = |(seat, strength)| match seat {
            Seat::Human => PlayerKind::Human,
            Seat::Computer => PlayerKind::Computer(strength),
        };
        seats.map(|seat| kind(seat).into()).to_vec()
    }

    /// Who sits at a place.
    pub fn seat(&self, player: PlayerId) -> Seat {
        match player.index() {
            0 => self.player_1,
            _ => self.player_2,
        }
    }

    /// How strong a computer there is.
    pub fn strength(&self, player: PlayerId) -> u8 {
        match player.index() {
            0 => self.strength_1,
            _ => self.strength_2,
        }
    }

    /// What a movement of the mouse is multiplied by.
    pub fn mouse_factor(&self) -> f64 {
        speed_factor(self.mouse_percent)
    }

    /// What a movement of a stylus is multiplied by where it points or leads the camera.
    pub fn stylus_factor(&self) -> f64 {
        speed_factor(self.stylus_percent)
    }

    /// What the scene's volume is multiplied by.
    pub fn volume_factor(&self) -> f32 {
        f32::from(self.volume_percent.min(VOLUME_MAX)) / 100.0
    }
}
