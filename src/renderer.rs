//! What a picture shows, as plain data: everything about drawing but the drawing.
//!
//! A [`DrawList`] is made from a snapshot of the world and the player's view; a [`Hud`] from the
//! [`Scoreboard`], which is reduced from events. Whoever owns a graphics library turns both into
//! pixels; nothing here knows one.

mod draw_list;

mod lamps;

mod look;

mod reach;

mod reel;
pub use reel::{Film, Reel};

mod mount;

mod playhead;

mod screening;
pub use screening::Screening;

mod shape;

mod stereo;

mod vectors;

mod scoreboard;

mod hud;

mod menu_panel;
mod wheel_panel;

mod words;

mod felt;

mod felt_aim;

mod felt_eye;

mod film;

mod overlay;

mod thoughts;

mod meters;

pub use draw_list::{
    BallInstance, DrawList, GhostBall, Label, Line, Radii, Solid, SolidShape, StylusPose,
};
pub use felt::{FeltLook, FeltTool, force_colour};
pub use felt_aim::aimed_by_stylus;
pub use felt_eye::FeltEye;
pub use film::{FilmClock, y4m_frame, y4m_head};
pub use hud::{Gauge, Hud, Remaining, SeatPanel, TipDial};
pub use lamps::{Corner, LAMP_APART_M, LAMP_HEIGHT_M, LAMPS, ROD_SHADOW_TRIANGLES, rod_shadow};
pub use look::{BallLook, BallSet, ball_look};
pub use menu_panel::{Area, MenuLayout, MenuLine, MenuPanel, player_names};
pub use meters::{MeterBoard, MetersPanel, QueueReading, QueueRow, Readings, Spread};
pub use mount::Mount;
pub use overlay::{FeltPanel, Overlay, Punctuality};
pub use playhead::{Playhead, between};
pub use reach::{Patch, cue_shadow, patches, shadow_reach_m};
pub use scoreboard::{Refused, Scoreboard};
pub use shape::{Shape, cone, cue_shape, cylinder, sphere, stylus_shape};
pub use stereo::eyes;
pub use thoughts::{LegendRow, ThoughtRow, ThoughtsPanel, draw_thoughts};
pub use vectors::draw_vectors;
pub use wheel_panel::{WheelItem, WheelPanel};
pub use words::{HelpOf, Words};
