//! What a player means, whatever is pressed for it.

use super::Controller;

/// Declares the actions, and what there is to know of each: its name in files and texts, and the
/// controller that takes it.
macro_rules! actions {
    ($($(#[$doc:meta])* $action:ident $name:literal $controller:ident;)*) => {
        /// What a player means.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Action {
            $($(#[$doc])* $action,)*
        }

        impl Action {
            /// All, in the order in which they are listed.
            pub const ALL: &'static [Action] = &[$(Action::$action),*];

            /// Its name in files, which is the key of its name in the texts.
            pub fn name(self) -> &'static str {
                match self {
                    $(Action::$action => $name,)*
                }
            }

            /// Who takes it.
            pub fn controller(self) -> Controller {
                match self {
                    $(Action::$action => Controller::$controller,)*
                }
            }
        }
    };
}

actions! {
    /// Held: the cue turns to the left.
    TurnLeft "turn_left" Cue;
    /// Held: the cue turns to the right.
    TurnRight "turn_right" Cue;
    /// Held: the tip goes to the left; a ball in hand too.
    TipLeft "tip_left" Cue;
    /// Held: the tip goes to the right; a ball in hand too.
    TipRight "tip_right" Cue;
    /// Held: the tip goes up; a ball in hand goes away from the eye.
    TipUp "tip_up" Cue;
    /// Held: the tip goes down; a ball in hand comes nearer.
    TipDown "tip_down" Cue;
    /// The tip goes back to the middle.
    TipMiddle "tip_middle" Cue;
    /// Held: the butt rises.
    Raise "raise" Cue;
    /// Held: the butt sinks.
    Lower "lower" Cue;
    /// Held: the wheel of the mouse raises the butt.
    WheelRaises "wheel_raises" Cue;
    /// Held: the mouse moves the tip on the cue ball.
    MouseMovesTip "mouse_moves_tip" Cue;
    /// Held: the mouse moves the cue along its shaft. Puts a ball in hand down.
    Stroke "stroke" Cue;
    /// Held: the tip is pulled back; let go: it strikes. Puts a ball in hand down.
    Strike "strike" Cue;
    /// Held: a tenth of every movement; what goes to the next thing goes to the one before.
    Fine "fine" Cue;
    /// More or less help to aim.
    AimAid "aim_aid" Cue;
    /// The next pocket is called; in training the next ball is taken up.
    NextPocket "next_pocket" Cue;
    /// The next ball is called.
    NextBall "next_ball" Cue;
    /// A pocket is called by pointing at it, until the next click.
    PointPocket "point_pocket" Cue;
    /// A safety is called, or is not.
    Safety "safety" Cue;
    /// A push-out is called, or is not.
    PushOut "push_out" Cue;
    /// Training: the last shot was none.
    UndoShot "undo_shot" Cue;
    /// Training: a ball is taken up, or put back.
    TakeUpBall "take_up_ball" Cue;
    /// The first of what the rules leave to a player.
    Option1 "option_1" Choice;
    /// The second.
    Option2 "option_2" Choice;
    /// The third.
    Option3 "option_3" Choice;
    /// Held: the mouse, or the right stick of a gamepad, looks round.
    Look "look" Eye;
    /// The table from above, or no longer.
    BirdsEye "birds_eye" Eye;
    /// From elsewhere: above, round the cue ball, behind it, from the ends and the side.
    NextView "next_view" Eye;
    /// The eye is led by hand, or goes back to where it was.
    Camera "camera" Eye;
    /// Held: the wheel menu.
    Wheel "wheel" Eye;
    /// The last shot is seen again, or no longer.
    Replay "replay" Clock;
    /// Where the balls of the last shot went, or no longer.
    Traces "traces" Eye;
    /// The computer aims.
    Suggest "suggest" Show;
    /// The film stands still, or goes on.
    FilmHold "film_hold" Film;
    /// The film goes slower.
    FilmSlower "film_slower" Film;
    /// The film goes faster.
    FilmFaster "film_faster" Film;
    /// Time stands still, or goes on.
    Pause "pause" Clock;
    /// Held: time runs faster while somebody waits.
    Hurry "hurry" Clock;
    /// The game ends, where time stands still.
    Quit "quit" Leave;
    /// The panel of a haptic device.
    Panel "panel" Show;
    /// What the computer thinks.
    Thoughts "thoughts" Show;
    /// Louder.
    Louder "louder" Sound;
    /// Softer.
    Softer "softer" Sound;
    /// No sound, or sound again.
    Mute "mute" Sound;
    /// For headphones or for loudspeakers.
    SoundMode "sound_mode" Sound;
    /// The tutorial goes on.
    NextLesson "next_lesson" Show;
    /// What there is to press.
    Help "help" Window;
    /// What is measured of the runtime.
    Meters "meters" Window;
    /// The window is written into a picture.
    Picture "picture" Window;
    /// To the line above.
    MenuUp "menu_up" Menu;
    /// To the line below.
    MenuDown "menu_down" Menu;
    /// What is set there becomes less, or the one before.
    MenuLess "menu_less" Menu;
    /// It becomes more, or the next.
    MenuMore "menu_more" Menu;
    /// The line is chosen.
    MenuAccept "menu_accept" Menu;
    /// Back to the page before.
    MenuBack "menu_back" Menu;
}

impl Action {
    /// The action of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|action| action.name() == name)
    }

    /// Whether nobody comes to a menu, or out of it, without a key for this.
    pub fn is_needed(self) -> bool {
        use Action::{MenuAccept, MenuBack, MenuDown, MenuLess, MenuMore, MenuUp, Pause};
        matches!(self, MenuUp | MenuDown | MenuLess | MenuMore | MenuAccept | MenuBack | Pause)
    }

    /// Whether it goes on as long as its key is held; the others do what they do at once.
    pub fn is_held(self) -> bool {
        use Action::{
            Fine, Hurry, Look, Lower, MouseMovesTip, Raise, Strike, Stroke, TipDown, TipLeft,
            TipRight, TipUp, TurnLeft, TurnRight, Wheel, WheelRaises,
        };
        matches!(
            self,
            TurnLeft
                | TurnRight
                | TipLeft
                | TipRight
                | TipUp
                | TipDown
                | Raise
                | Lower
                | WheelRaises
                | MouseMovesTip
                | Stroke
                | Strike
                | Fine
                | Look
                | Wheel
                | Hurry
        )
    }

    /// Which of the options it takes, counted from 0.
    pub fn option(self) -> Option<usize> {
        [Action::Option1, Action::Option2, Action::Option3].iter().position(|one| *one == self)
    }
}
