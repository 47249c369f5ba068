//! Films of games: which moment a frame shows, and frames as YUV4MPEG2, which every encoder reads.

use crate::units::Seconds;

/// A film's frames in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmClock {
    /// Frames a second.
    pub fps: u32,
    /// Seconds of the game per second of the film.
    pub speed: f64,
    /// The moment of the first frame [s].
    pub from_s: Seconds,
}

impl FilmClock {
    /// The moment of the game that a frame shows, counted from 0; computed from its number, so that
    /// no error adds up.
    pub fn moment_s(&self, frame: u64) -> Seconds {
        self.from_s + frame as f64 * self.speed / f64::from(self.fps)
    }

    /// How many frames there are of so many seconds of the game, the first one included.
    pub fn frames_in(&self, seconds: Seconds) -> u64 {
        // A little more, for a product that is a whole number but for rounding.
        let whole = libm::floor(seconds.max(0.0) * f64::from(self.fps) / self.speed + 1e-6);
        1 + whole as u64
    }
}

/// The head of a film of this size [pixels].
pub fn y4m_head((width, height): (u32, u32), fps: u32) -> String {
    format!("YUV4MPEG2 W{width} H{height} F{fps}:1 Ip A1:1 C444\n")
}

/// One frame from pixels, rows from the top: luminance and both differences of colour by ITU-R
/// BT.601, each in a plane of full size.
pub fn y4m_frame(rows: &[[u8; 4]]) -> Vec<u8> {
    let mut frame = Vec::with_capacity(6 + 3 * rows.len());
    frame.extend_from_slice(b"FRAME\n");
    // Luminance from 16 to 235, differences from 16 to 240 about 128; all in 1/65536.
    let planes: [([i32; 3], i32); 3] = [
        ([16_829, 33_039, 6_416], 16),
        ([-9_714, -19_070, 28_784], 128),
        ([28_784, -24_103, -4_681], 128),
    ];
    for (weights, zero) in planes {
        frame.extend(rows.iter().map(|[r, g, b, _]| {
            let [r, g, b] = [r, g, b].map(|channel| i32::from(*channel));
            let sum = weights[0] * r + weights[1] * g + weights[2] * b;
            ((sum + 32_768) >> 16).saturating_add(zero).clamp(0, 255) as u8
        }));
    }
    frame
}
