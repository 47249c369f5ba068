//! The menus: pages that files describe, what they set and start, and who is where in them.
//!
//! A [`Menu`] is a state machine. Keys, a pointer, a gamepad or a script move it by
//! [`MenuInput`]; it answers with a [`Deed`]. A [`Lobby`] stands between the devices, a menu and a
//! game: it says which profile of keys is active, and gives a window its [`Order`]s. Pages and
//! links stand in `config/menus/`, the words in `config/text/`; nothing here knows a window.

mod page;
pub use page::{Act, Effect, Item, Page, PageError, Pages};

mod settings;
pub use settings::{GameChoice, HapticChoice, Range, Seat, Setting, Settings, TableChoice, Tongue};

mod notice;
pub use notice::Notice;

mod lobby;
pub use lobby::{Begin, Lobby, Order, Pointed};

mod wheel;
pub use wheel::{Wheel, WheelError, WheelPage};

mod model;
pub use model::{Deed, Menu, MenuInput};
