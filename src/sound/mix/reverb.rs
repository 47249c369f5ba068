//! The reverberation of the room: eight delay lines that feed each other.

use super::Room;
use crate::sound::filter::TINY;

/// Lengths of the lines [s]: no two have a common rhythm.
const LINES_S: [f32; LINES] = [0.0089, 0.0113, 0.0137, 0.0169, 0.0193, 0.0231, 0.0277, 0.0319];
const LINES: usize = 8;
/// With which sign the sound enters each line, and leaves it.
const SIGNS: [f32; LINES] = [1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0];
/// Above this the walls swallow more [Hz].
const DULL_HZ: f32 = 4_000.0;

/// A network of delay lines with a lossless matrix between them (Jot and Chaigne 1991), here
/// Householder's. Even lines go to the left ear and odd ones to the right.
#[derive(Debug, Clone)]
pub struct Reverb {
    lines: [Line; LINES],
    /// Share of a change that passes a line's low-pass in a frame.
    bright: f32,
    gain: [f32; 2],
}

#[derive(Debug, Clone)]
struct Line {
    ring: Box<[f32]>,
    at: usize,
    feedback: f32,
    low: f32,
}

impl Line {
    fn new(length_s: f32, rate_hz: f32, t60_s: f32) -> Line {
        // Odd, for want of a prime.
        let length = (length_s * rate_hz) as usize | 1;
        let feedback = libm::powf(10.0, -3.0 * length as f32 / (rate_hz * t60_s));
        Line { ring: vec![0.0; length].into_boxed_slice(), at: 0, feedback, low: 0.0 }
    }
}

impl Reverb {
    /// Silent so far; as loud as the room would be.
    pub fn new(room: &Room, rate_hz: f32) -> Reverb {
        let lines = LINES_S.map(|length_s| Line::new(length_s, rate_hz, room.t60_s));
        let silent = Reverb { lines, bright: 1.0, gain: [1.0; 2] };
        // What comes out of a click in all is measured, before the walls dull it.
        let mut tried = silent.clone();
        let mut energy = [0.0_f32; 2];
        for frame in 0..(1.5 * room.t60_s * rate_hz) as u32 {
            let heard = tried.next(if frame == 0 { 1.0 } else { 0.0 });
            energy.iter_mut().zip(heard).for_each(|(sum, x)| *sum += x * x);
        }
        let bright = 1.0 - libm::expf(-std::f32::consts::TAU * DULL_HZ / rate_hz);
        Reverb { bright, gain: energy.map(|sum| (room.late_energy() / sum).sqrt()), ..silent }
    }

    /// What the ears get while `x` enters.
    pub fn next(&mut self, x: f32) -> [f32; 2] {
        let mut fed = [0.0; LINES];
        let mut heard = [0.0; 2];
        for (i, line) in self.lines.iter_mut().enumerate() {
            let y = line.ring[line.at];
            heard[i % 2] += SIGNS[i] * y;
            line.low += (y - line.low) * self.bright;
            fed[i] = line.low * line.feedback;
        }
        let shared = fed.iter().sum::<f32>() * (2.0 / LINES as f32);
        for (i, line) in self.lines.iter_mut().enumerate() {
            line.ring[line.at] = fed[i] - shared + SIGNS[(i + 1) % LINES] * x + TINY;
            line.at = if line.at + 1 == line.ring.len() { 0 } else { line.at + 1 };
        }
        [heard[0] * self.gain[0], heard[1] * self.gain[1]]
    }
}
