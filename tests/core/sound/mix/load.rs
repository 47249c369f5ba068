//! What it costs: a figure to read, not a limit.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::{Mixer, SoundClass};
use std::time::Instant;

/// Keeps all slots taken and sixteen balls rolling for `blocks` blocks of 512 frames.
fn blocks(mixer: &mut Mixer, count: u32) -> Vec<f64> {
    let mut out = [[0.0; 2]; 512];
    (0..count)
        .map(|block| {
            for k in 0..16_u16 {
                let t = f32::from(k);
                let place = Vec3::new(libm::sinf(t), 1.0 + 0.3 * libm::cosf(t), 0.0);
                mixer.roll(&rolling(k, place, Vec3::X));
            }
            let mut k = 0_u32;
            while mixer.work().voices < 64 {
                let t = (block * 64 + k) as f32;
                let place = Vec3::new(libm::sinf(t), libm::cosf(t), 0.0);
                let class = [SoundClass::BallClick, SoundClass::Pocket, SoundClass::Cushion]
                    [k as usize % 3];
                let mut onset = click(place, 0.5 + 0.01 * (k % 64) as f32);
                (onset.class, onset.seed) = (class, block);
                mixer.start(mixer.frame(), &onset);
                k += 1;
            }
            assert_eq!((mixer.work().voices, mixer.work().rolling), (64, 16));
            let begin = Instant::now();
            mixer.mix(&mut out);
            begin.elapsed().as_secs_f64() / (512.0 / f64::from(RATE_HZ))
        })
        .collect()
}

#[test]
fn a_full_house_costs_this_share_of_the_time_it_sounds() {
    for (name, mut mixer) in [("open field", field()), ("cellar", cellar())] {
        let mut shares = blocks(&mut mixer, 200);
        shares.sort_by(f64::total_cmp);
        let percent = |at: usize| 100.0 * shares[at];
        println!(
            "64 voices, 16 balls, {name}, 512 frames of 48 kHz: median {:.1} %, p99 {:.1} %, \
             most {:.1} % of the period",
            percent(100),
            percent(197),
            percent(199)
        );
    }
}
