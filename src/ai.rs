//! Computer players: they see what anybody sees and act by the commands anybody has.
//!
//! [`Player`] takes part in the game like a human's input does. The paper's player (section 5.4)
//! sees a [`TableView2d`] and nothing else; it cannot simulate, so it cannot look ahead. The others
//! ask a [`Mind`]: geometry proposes [ideas](fn@ideas), a simulation of the mind's own decides
//! under the player's own noise, and what a position is worth stands for the rest of the game. A
//! [`Thinker`] says where that is done; the answer is the same wherever.

mod view;
pub use view::{SeenBall, TableView2d};

mod geometry;
pub use geometry::{is_blocked, signed_angle};

mod speed;
pub use speed::{BALL_PER_TIP_SPEED, arrival_speed, launch_speed, pot_tip_speed};

mod plan;
pub use plan::{
    CUT_LIMIT_RAD, Candidate, Goal, Line, LineEnd, Plan, PlanKind, candidate, cost, plan_shot,
};

mod fallback;

mod settings;
pub use settings::{Level, NOISE_USUAL, PlayerSettings};

mod hold;
pub use hold::Clearance;

mod ideas;
pub use ideas::{Idea, IdeaKind, Repertoire, ideas, spots};

mod mind;
pub use mind::{
    Considered, Decision, Deliberation, Inline, Mind, MindSetup, Outcome, PlannedShot, Task,
    TaskKind, Thoughts, Workers,
};

mod noise;
pub use noise::StrokeNoise;
pub(crate) use noise::normal;

mod thinker;
pub use thinker::{ThinkInline, Thinker, Thinking};

mod choose;
pub use choose::{Outlook, call, choose};

mod place;
pub use place::{placements, zone_holds};

mod insight;
pub use insight::{insight_of_plan, insight_of_thoughts};

mod learn;
pub use learn::AimLearner;

pub mod lesson;

mod throw_table;
pub use throw_table::{ThrowTable, ThrowTableError};

mod stroke;
pub use stroke::{Stroke, TIP_SPEED_MAX_M_S, approach, resting_pose, withdrawal};

mod player;
pub use player::Player;

mod adviser;
pub use adviser::{Advice, Adviser, Question};
