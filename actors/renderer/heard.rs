//! Sound in the window: where the picture is seen from it is heard from, and keys turn volume and
//! mode.

use crate::sound::Knobs;
use hapticbillard::input::{Action, CameraPose};
use hapticbillard::renderer::{Hud, Words};
use hapticbillard::sound::{Listener, Mode};
use std::sync::Arc;

/// How long volume and mode stand in the window after it was turned [s].
const SHOWN_S: f64 = 2.0;

/// What a window has to do with sound.
pub struct HeardSetup {
    /// Where it is heard from.
    pub listener: triple_buffer::Input<Listener>,
    /// Volume, mute and mode.
    pub knobs: Arc<Knobs>,
}

/// The window's end.
pub struct HeardScreen {
    setup: HeardSetup,
    turned_s: f64,
    mode_s: f64,
    ran_dry: u64,
    ran_dry_s: f64,
}

impl HeardScreen {
    /// Before the first picture.
    pub fn new(setup: HeardSetup) -> Self {
        HeardScreen {
            setup,
            turned_s: f64::NEG_INFINITY,
            mode_s: f64::NEG_INFINITY,
            ran_dry: 0,
            ran_dry_s: f64::NEG_INFINITY,
        }
    }

    /// The picture is taken from here.
    pub fn listen_at(&mut self, camera: &CameraPose) {
        let forward = (camera.target - camera.eye).as_vec3();
        self.setup.listener.write(Listener::looking(camera.eye.as_vec3(), forward, glam::Vec3::Z));
    }

    /// The volume is so much of what the scene says.
    pub fn set(&self, share: f32) {
        self.setup.knobs.set(share);
    }

    /// Does what an action does to the sound at `now_s` on the window's clock.
    pub fn turn(&mut self, action: Action, now_s: f64) {
        match action {
            Action::Louder => self.setup.knobs.turn(true),
            Action::Softer => self.setup.knobs.turn(false),
            Action::Mute => self.setup.knobs.mute(),
            Action::SoundMode => {
                self.setup.knobs.change_mode();
                self.mode_s = now_s;
                return;
            }
            _ => return,
        }
        self.turned_s = now_s;
    }

    /// Volume and mode, while they were turned just now; that it is off, as long as it is;
    /// that the device ran dry, for a while.
    pub fn write(&mut self, written: &mut Hud, words: &Words, now_s: f64) {
        let knobs = &self.setup.knobs;
        if knobs.is_muted() {
            written.message.push(words.get("muted"));
        } else if now_s < self.turned_s + SHOWN_S {
            let percent = format!("{:.0}", knobs.share() * 100.0);
            written.message.push(words.fill("volume", "percent", &percent));
        }
        let ran_dry = knobs.ran_dry();
        if std::mem::replace(&mut self.ran_dry, ran_dry) != ran_dry {
            self.ran_dry_s = now_s;
        }
        if now_s < self.ran_dry_s + SHOWN_S {
            written.message.push(words.fill("ran_dry", "times", &ran_dry.to_string()));
        }
        if now_s < self.mode_s + SHOWN_S {
            written.message.push(words.get(match knobs.mode() {
                Mode::Headphones => "headphones",
                Mode::Loudspeakers => "loudspeakers",
            }));
        }
    }
}
