//! The bytes of an input decide everything that chance decides in the seeded fuzz test of the
//! rules; libFuzzer changes them so that they reach code that none has reached yet.
//!
//! `cd tests/fuzz/coverage && mkdir -p corpus/rules`, then
//! `cargo run --release --bin rules -- corpus/rules -max_total_time=600`

#![no_main]
// The modules are those of the seeded test, which uses more of them.
#![allow(dead_code)]

#[path = "../facts.rs"]
mod facts;
#[path = "../rules"]
mod rules {
    pub mod account;
    pub mod paper;
    pub mod play;
    pub mod script;
}

use hapticbillard::rules::{GameKind, game};
use libfuzzer_sys::fuzz_target;
use rand::TryRng;
use std::convert::Infallible;

/// Bytes instead of chance; zeros where they end.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        let count = N.min(self.0.len());
        bytes[..count].copy_from_slice(&self.0[..count]);
        self.0 = &self.0[count..];
        bytes
    }
}

impl TryRng for Bytes<'_> {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        // Two bytes decide as well as four, and inputs stay short.
        Ok(u32::from(u16::from_le_bytes(self.take())) << 16)
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(u64::from(u16::from_le_bytes(self.take())) << 48)
    }

    fn try_fill_bytes(&mut self, to: &mut [u8]) -> Result<(), Infallible> {
        to.iter_mut().for_each(|byte| [*byte] = self.take());
        Ok(())
    }
}

fuzz_target!(|data: &[u8]| {
    let [first, rest @ ..] = data else { return };
    let kind = GameKind::ALL[usize::from(*first) % GameKind::ALL.len()];
    if let Err(problem) = rules::play::play(kind, game(kind).judge, &mut Bytes(rest)) {
        panic!("{kind}: {problem}");
    }
});
