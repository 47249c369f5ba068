//! The room around the table: what its walls send back, each once.

use super::head::{arrivals, shadow_gain};
use super::line::{Line, Sums};
use super::surroundings::Surroundings;
use glam::Vec3;

/// Images keep this distance from their walls [m].
const WALL_M: f32 = 0.01;

/// A box with walls that answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Corner with the least coordinates [m]; the bed of the table is at z = 0.
    pub low_m: Vec3,
    /// Corner with the greatest coordinates [m].
    pub high_m: Vec3,
    /// Time in which the sound of the room falls by 60 dB [s].
    pub t60_s: f32,
}

impl Room {
    /// A cellar of 7 m x 5 m x 2.6 m with a carpet, the table in its middle.
    pub const CELLAR: Room =
        Room { low_m: Vec3::new(-3.5, -2.5, -0.78), high_m: Vec3::new(3.5, 2.5, 1.82), t60_s: 0.4 };

    /// Whether it is a room: of 0.5 m to 100 m each way, that rings 0.05 s to 10 s.
    pub fn is_sound(&self) -> bool {
        let size = self.high_m - self.low_m;
        let corners = self.low_m.is_finite() && self.high_m.is_finite();
        corners
            && size.min_element() >= 0.5
            && size.max_element() <= 100.0
            && (0.05..=10.0).contains(&self.t60_s)
    }

    fn volume_m3(&self) -> f32 {
        let size = self.high_m - self.low_m;
        size.x * size.y * size.z
    }

    fn surface_m2(&self) -> f32 {
        let size = self.high_m - self.low_m;
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Share of the power that a wall keeps (Eyring 1930): α = 1 - exp(-0.161 V / (S T₆₀)).
    pub fn absorption(&self) -> f32 {
        1.0 - libm::expf(-0.161 * self.volume_m3() / (self.surface_m2() * self.t60_s))
    }

    /// Mean square of the sound that met two walls or more, over that of the source at 1 m, for a
    /// source alike in all directions: 16π/R, R = Sα/(1 - α) (Beranek 1954), less the part that
    /// comes by one wall alone.
    pub fn late_energy(&self) -> f32 {
        let kept = 1.0 - self.absorption();
        16.0 * std::f32::consts::PI * kept * kept / (self.surface_m2() * self.absorption())
    }

    /// The six images of a source, with the sign of each axis.
    fn images(&self, source_m: Vec3) -> [(Vec3, Vec3); 6] {
        let margin = Vec3::splat(WALL_M);
        let source_m = source_m.clamp(self.low_m + margin, self.high_m - margin);
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        std::array::from_fn(|i| {
            let axis = axes[i / 2];
            let wall_m = if i % 2 == 0 { self.low_m } else { self.high_m };
            let image_m = source_m + axis * (2.0 * (wall_m - source_m));
            (image_m, Vec3::ONE - 2.0 * axis)
        })
    }
}

/// A delay in whole frames and a factor.
#[derive(Debug, Clone, Copy, Default)]
struct Tap {
    delay: u64,
    gain: f32,
}

/// What the walls make of a source: six images of it, and what goes into the reverberation.
///
/// Delay and level of an image are those at either ear; of the head's shadow they have the level
/// at one frequency, and the paint of the walls is one filter for all of them.
#[derive(Debug, Clone, Copy)]
pub struct Reflections {
    taps: [[Tap; 2]; 6],
    send: Tap,
}

impl Reflections {
    /// Of a source that sends the factor `directivity(direction)` along a unit vector.
    pub fn new(
        room: &Room,
        around: &Surroundings,
        source_m: Vec3,
        directivity: impl Fn(Vec3) -> f32,
    ) -> Reflections {
        let kept = (1.0 - room.absorption()).sqrt();
        let mut power = 0.0;
        let taps = room.images(source_m).map(|(image_m, mirror)| {
            let to_ear = (around.listener.position_m - image_m).normalize_or(Vec3::X);
            // The way out of the source that the image stands for.
            let sent = directivity(to_ear * mirror);
            power += sent * sent / 6.0;
            arrivals(&around.listener, around.mode, image_m).map(|arrival| Tap {
                delay: around.delay(arrival.path_m) as u64,
                gain: kept * sent * arrival.gain * shadow_gain(arrival.alpha),
            })
        });
        let way_m = around.listener.position_m.distance(source_m);
        let send = Tap { delay: around.delay(way_m) as u64, gain: power.sqrt() };
        Reflections { taps, send }
    }

    /// The longest of its delays [frames].
    pub fn delay_max(&self) -> u64 {
        self.taps.iter().flatten().map(|tap| tap.delay).fold(self.send.delay, u64::max)
    }

    /// Adds what comes of a line from frame `from` on.
    pub fn add(&self, line: &mut Line, from: u64, frames: usize, sums: &mut Sums) {
        for taps in &self.taps {
            for (sum, tap) in sums.reflected.iter_mut().zip(taps) {
                line.add_to(from.wrapping_sub(tap.delay), &mut sum[..frames], tap.gain);
            }
        }
        let sum = &mut sums.send[..frames];
        line.add_to(from.wrapping_sub(self.send.delay), sum, self.send.gain);
    }
}
