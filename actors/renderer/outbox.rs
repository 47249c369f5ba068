//! What the window has to say to the hand, in order.

use hapticbillard::input::HandInput;
use hapticbillard::renderer::QueueReading;
use std::collections::VecDeque;

/// Buttons, keys and movements between them that wait here at most: nobody's hand makes so many
/// before the game looks again.
const WAITING: usize = 4096;

/// Reports on their way to the hand.
///
/// The channel is bounded and the window never waits for it: when it is full, movements add up
/// here and buttons and keys wait in order. So nothing is lost and the queue stays short. When even
/// here [`WAITING`] wait, the game does not listen: all of them are dropped and counted, and
/// everything counts as let go.
pub struct Outbox {
    channel: flume::Sender<HandInput>,
    waiting: VecDeque<HandInput>,
    lost: u64,
}

impl Outbox {
    /// An outbox for this channel.
    pub fn new(channel: flume::Sender<HandInput>) -> Self {
        Outbox { channel, waiting: VecDeque::new(), lost: 0 }
    }

    /// Takes a report, and sends what can be sent.
    pub fn say(&mut self, report: HandInput) {
        match (self.waiting.back_mut(), report) {
            (Some(HandInput::Moved { right, up }), HandInput::Moved { right: x, up: y }) => {
                *right += x;
                *up += y;
            }
            // Of a stick and of a trigger only the newest place counts.
            (Some(HandInput::Stick { stick, at }), HandInput::Stick { stick: same, at: new })
                if *stick == same =>
            {
                *at = new;
            }
            (Some(HandInput::Trigger(pressed)), HandInput::Trigger(new)) => *pressed = new,
            _ => self.waiting.push_back(report),
        }
        self.send();
        if WAITING < self.waiting.len() {
            self.lost += self.waiting.len() as u64;
            self.waiting = VecDeque::from([HandInput::FocusLost]);
        }
    }

    /// Sends what can be sent.
    pub fn send(&mut self) {
        while let Some(report) = self.waiting.pop_front() {
            match self.channel.try_send(report) {
                Ok(()) => {}
                Err(flume::TrySendError::Full(report)) => {
                    self.waiting.push_front(report);
                    return;
                }
                // The game is over: nobody listens any more.
                Err(flume::TrySendError::Disconnected(_)) => self.waiting.clear(),
            }
        }
    }
}

impl Outbox {
    /// What waits, and what was lost.
    pub fn reading(&self) -> QueueReading {
        QueueReading {
            name: "reports".into(),
            waiting: (self.channel.len() + self.waiting.len()) as u64,
            room: self.channel.capacity().unwrap_or_default() as u64,
            lost: self.lost,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::input::Action;

    #[test]
    fn a_full_channel_adds_movements_up_and_keeps_buttons_in_order() {
        let (sender, receiver) = flume::bounded(1);
        let mut outbox = Outbox::new(sender);
        let moved = |right| HandInput::Moved { right, up: -right };
        let press = HandInput::Act { action: Action::Stroke, down: true };
        for report in [moved(1.0), moved(2.0), moved(3.0), press, moved(4.0), moved(5.0)] {
            outbox.say(report);
        }
        let mut heard = Vec::new();
        while let Ok(report) = receiver.try_recv() {
            heard.push(report);
            outbox.send();
        }
        assert_eq!(heard, [moved(1.0), moved(5.0), press, moved(9.0)]);
    }

    #[test]
    fn what_nobody_ever_takes_is_dropped_and_everything_is_let_go() {
        let (sender, receiver) = flume::bounded(1);
        let mut outbox = Outbox::new(sender);
        let press = |down| HandInput::Act { action: Action::Stroke, down };
        let presses = WAITING + 2;
        for number in 0..presses {
            outbox.say(press(number % 2 == 0));
        }
        assert_eq!(outbox.reading().lost, (presses - 1) as u64);
        assert_eq!(receiver.try_recv(), Ok(press(true)));
        outbox.send();
        assert_eq!(receiver.try_recv(), Ok(HandInput::FocusLost));
    }
}
