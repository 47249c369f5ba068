//! Sound files, with their names. Their reader belongs to the actors, which the core's tests do not
//! know: this is read by libFuzzer and by `tests/fuzz/sounds.rs`.

use crate::bytes::{check_line, chosen};
use glam::Vec3;
use hapticbillard::sound::{Bank, ClipName, Onset, Voice};
use hapticbillard_actors::sound::bank_files::add_bytes;

/// Rates of streams [Hz].
const RATES_HZ: [u32; 4] = [48_000, 44_100, 8_000, 192_000];
/// No file system has longer names [bytes].
const NAME_MAX: usize = 255;

/// A byte that chooses the rate of the stream, a line with the name, then the file.
pub fn run(data: &[u8]) {
    let (choice, data) = chosen(data);
    let rate_hz = RATES_HZ[choice % RATES_HZ.len()];
    let end = data.iter().position(|byte| *byte == b'\n').unwrap_or(data.len()).min(NAME_MAX);
    let (name, file) = data.split_at(end);
    let name: ClipName = match String::from_utf8_lossy(name).parse() {
        Ok(name) => name,
        Err(error) => return check_line(&error.to_string()),
    };
    let mut bank = Bank::default();
    match add_bytes(&mut bank, name, file.get(1..).unwrap_or_default(), rate_hz) {
        Ok(()) => play(&bank, name, rate_hz as f32),
        Err(reason) => check_line(&reason.to_string()),
    }
}

/// Whatever stood in the file, what is heard are numbers of no great size.
fn play(bank: &Bank, name: ClipName, rate_hz: f32) {
    assert_eq!(bank.count(name.class), 1);
    let onset = Onset {
        time_s: 0.0,
        class: name.class,
        speed_m_s: name.speed_m_s,
        position_m: Vec3::ZERO,
        axis: Vec3::ZERO,
        seed: 1,
    };
    let mut voice = Voice::begin(&onset, bank, rate_hz);
    let mut samples = vec![0.0; voice.remaining() as usize];
    voice.fill(bank, &mut samples);
    assert!(samples.iter().all(|sample| sample.abs() < 1e4), "{name}");
}
