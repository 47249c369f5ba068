//! From the time of the game to the frames of a stream.

use crate::units::Seconds;

/// What the way from the game to the callback may take beside the callback's own period [s].
const MARGIN_S: f64 = 0.005;
/// How much farther ahead than the first an onset may come to lie before it is too early [s].
const SLACK_S: f64 = 0.010;
/// After so long a silence [s] nobody can tell a spacing any more: then the lead is set anew, and
/// what two clocks drifted apart is gone.
const SILENCE_S: Seconds = 0.5;

/// Where a stream is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stream {
    /// The next frame that will be mixed.
    pub now: u64,
    /// How many are mixed at a time.
    pub period: u32,
}

/// Says at which frame a moment of the game is to be heard.
///
/// As long as game and stream run at one pace, all moments are late by the same lead, so that two
/// onsets are as far apart as physics has them, to the frame. The lead is a period of the stream
/// and [`MARGIN_S`]: whatever is told before the callback's next turn comes in time. When the game
/// has stood still, lagged, or run ahead, the lead is set anew; nothing is ever put into the past.
/// An onset that is told after a later one goes to its own frame, before that one; when the lead is
/// set anew, no later onset comes before an earlier one, and no state before an older one.
#[derive(Debug, Clone)]
pub struct Timeline {
    frames_per_s: f64,
    margin: f64,
    slack: f64,
    /// A moment of the game and its frame.
    anchor: Option<(Seconds, f64)>,
    /// The latest onset.
    heard_s: Seconds,
    /// The latest onset's frame, and the newest state's.
    onset: u64,
    state: u64,
}

impl Timeline {
    /// A timeline of a stream of `rate_hz` frames a second, for a game that runs at `pace` seconds
    /// a second: in slow motion sounds are as far apart as pictures are.
    pub fn new(rate_hz: f64, pace: f64) -> Self {
        Timeline {
            frames_per_s: rate_hz / pace,
            margin: MARGIN_S * rate_hz,
            slack: SLACK_S * rate_hz,
            anchor: None,
            heard_s: f64::NEG_INFINITY,
            onset: 0,
            state: 0,
        }
    }

    /// The frame of an onset at `time_s` of the game.
    pub fn onset(&mut self, time_s: Seconds, stream: Stream) -> u64 {
        if !((time_s - self.heard_s).abs() <= SILENCE_S) {
            self.anchor = None;
            self.heard_s = time_s;
        }
        let frame = self.frame(time_s, stream);
        if time_s < self.heard_s {
            // Its place is before what was told already.
            return frame;
        }
        self.heard_s = time_s;
        self.onset = self.onset.max(frame);
        self.onset
    }

    /// The frame of a ball's state at `time_s` of the game.
    pub fn state(&mut self, time_s: Seconds, stream: Stream) -> u64 {
        self.state = self.state.max(self.frame(time_s, stream));
        self.state
    }

    fn frame(&mut self, time_s: Seconds, stream: Stream) -> u64 {
        let now = stream.now as f64;
        let lead = f64::from(stream.period) + self.margin;
        let latest = now + lead + f64::from(stream.period) + self.slack;
        let on_line = self.anchor.map(|(at_s, frame)| frame + (time_s - at_s) * self.frames_per_s);
        let frame = match on_line {
            Some(frame) if now <= frame && frame <= latest => frame,
            _ => {
                self.anchor = Some((time_s, now + lead));
                now + lead
            }
        };
        // Half up; both are far below 2^52.
        (frame + 0.5) as u64
    }
}
