//! The gamepads of this machine.

use super::pad::PadSource;
use gilrs::ev::filter::{Filter, axis_dpad_to_button};
use gilrs::ff::{BaseEffect, BaseEffectType, Effect, EffectBuilder, Repeat, Replay, Ticks};
use gilrs::{Axis, Button, EventType, Gilrs, GilrsBuilder};
use hapticbillard::input::{PadAxis, PadButton, PadInput, Rumble};
use std::collections::BTreeSet;
use std::time::Duration;

/// All gamepads that are plugged in; to the game they are one.
pub struct Gamepads {
    gilrs: Gilrs,
    /// Those that are there.
    there: BTreeSet<usize>,
    /// It shakes as long as this is kept.
    shake: Option<Effect>,
    /// That one cannot shake was said already.
    is_told: bool,
}

impl Gamepads {
    /// Looks what is plugged in.
    ///
    /// # Errors
    /// What the system says.
    pub fn open() -> Result<Self, String> {
        // The core knows better where a stick rests, and what a trigger means.
        let built = GilrsBuilder::new().with_default_filters(false).build();
        let gilrs = built.map_err(|error| error.to_string())?;
        let there: BTreeSet<usize> = gilrs.gamepads().map(|(id, _)| id.into()).collect();
        for (_, pad) in gilrs.gamepads() {
            tracing::info!("gamepad: {}", pad.name());
        }
        Ok(Gamepads { gilrs, there, shake: None, is_told: false })
    }
}

impl PadSource for Gamepads {
    fn next(&mut self, patience: Duration) -> Option<PadInput> {
        let event = self.gilrs.next_event_blocking(Some(patience));
        let event = event.filter_ev(&axis_dpad_to_button, &mut self.gilrs)?;
        self.gilrs.update(&event);
        match event.event {
            EventType::ButtonPressed(which, _) => pressed(which, true),
            EventType::ButtonReleased(which, _) => pressed(which, false),
            EventType::ButtonChanged(which, value, _) => {
                let axis = match which {
                    Button::LeftTrigger2 => PadAxis::LeftTrigger,
                    Button::RightTrigger2 => PadAxis::RightTrigger,
                    _ => return None,
                };
                Some(PadInput::Axis { axis, value: value.into() })
            }
            EventType::AxisChanged(which, value, _) => {
                let axis = match which {
                    Axis::LeftStickX => PadAxis::LeftX,
                    Axis::LeftStickY => PadAxis::LeftY,
                    Axis::RightStickX => PadAxis::RightX,
                    Axis::RightStickY => PadAxis::RightY,
                    _ => return None,
                };
                Some(PadInput::Axis { axis, value: value.into() })
            }
            EventType::Connected => {
                self.there.insert(event.id.into()).then_some(PadInput::Connected)
            }
            EventType::Disconnected => {
                self.there.remove(&event.id.into());
                self.shake = None;
                Some(PadInput::Lost)
            }
            _ => None,
        }
    }

    fn shake(&mut self, rumble: Rumble) {
        let pads: Vec<_> = self
            .gilrs
            .gamepads()
            .filter(|(_, pad)| pad.is_ff_supported())
            .map(|(id, _)| id)
            .collect();
        if pads.is_empty() {
            return;
        }
        let play_for = Ticks::from_ms(rumble.duration_ms);
        let magnitude = (rumble.strength.clamp(0.0, 1.0) * f64::from(u16::MAX)) as u16;
        let scheduling = Replay { play_for, ..Replay::default() };
        let kinds = [BaseEffectType::Strong { magnitude }, BaseEffectType::Weak { magnitude }];
        let mut effect = EffectBuilder::new();
        for kind in kinds {
            effect.add_effect(BaseEffect { kind, scheduling, ..BaseEffect::default() });
        }
        let effect = effect.gamepads(&pads).repeat(Repeat::For(play_for)).finish(&mut self.gilrs);
        let played = effect.and_then(|effect| effect.play().map(|()| effect));
        match played {
            Ok(effect) => self.shake = Some(effect),
            // A gamepad that cannot shake is as good as any other.
            Err(error) if !std::mem::replace(&mut self.is_told, true) => {
                tracing::info!("the gamepad does not shake: {error}");
            }
            Err(_) => {}
        }
    }
}

/// A button, where the game knows it. Triggers are told by how far they are pressed.
fn pressed(which: Button, down: bool) -> Option<PadInput> {
    let button = match which {
        Button::South => PadButton::A,
        Button::East => PadButton::B,
        Button::West => PadButton::X,
        Button::North => PadButton::Y,
        Button::DPadUp => PadButton::Up,
        Button::DPadDown => PadButton::Down,
        Button::DPadLeft => PadButton::Left,
        Button::DPadRight => PadButton::Right,
        Button::LeftTrigger => PadButton::LeftShoulder,
        Button::RightTrigger => PadButton::RightShoulder,
        Button::LeftThumb => PadButton::LeftStick,
        Button::RightThumb => PadButton::RightStick,
        Button::Start => PadButton::Start,
        Button::Select => PadButton::Select,
        _ => return None,
    };
    Some(PadInput::Button { button, down })
}
