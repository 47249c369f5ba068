//! What the window has to say to the hand, in order.

use hapticbillard::input::RawInput;

/// Reports on their way to the hand.
///
/// The channel is bounded and the window never waits for it: when it is full, movements add up
/// here and buttons and keys wait in order. So nothing is lost and the queue stays short.
pub struct Outbox {
    channel: flume::Sender<RawInput>,
    waiting: std::collections::VecDeque<RawInput>,
}

impl Outbox {
    /// An outbox for this channel.
    pub fn new(channel: flume::Sender<RawInput>) -> Self {
        Outbox { channel, waiting: std::collections::VecDeque::new() }
    }

    /// Takes a report, and sends what can be sent.
    pub fn say(&mut self, report: RawInput) {
        match (self.waiting.back_mut(), report) {
            (Some(RawInput::Moved { right, up }), RawInput::Moved { right: x, up: y }) => {
                *right += x;
                *up += y;
            }
            _ => self.waiting.push_back(report),
        }
        self.send();
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

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::input::Button;

    #[test]
    fn a_full_channel_adds_movements_up_and_keeps_buttons_in_order() {
        let (sender, receiver) = flume::bounded(1);
        let mut outbox = Outbox::new(sender);
        let moved = |right| RawInput::Moved { right, up: -right };
        let press = RawInput::Button { button: Button::Left, down: true };
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
}
