use super::measure::{centroid_hz, peak_db};
use hapticbillard::sound::{Bank, SoundClass};

const RATE_HZ: f32 = 48_000.0;

fn click(speed_m_s: f32, variant: u32) -> Vec<f32> {
    Bank::synthesise(SoundClass::BallClick, speed_m_s, variant, RATE_HZ)
}

#[test]
fn look() {
    for v in [0.5f32, 1.0, 3.0, 5.0, 10.0] {
        let n = 64;
        let db: f32 = (0..n).map(|k| peak_db(&click(v, k))).sum::<f32>() / n as f32;
        let c: f64 = (0..n).map(|k| centroid_hz(&click(v, k), RATE_HZ)).sum::<f64>() / n as f64;
        println!("{v} {db} {c} {}", click(v, 0).len());
    }
}
