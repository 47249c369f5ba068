use crate::bytes::{Bytes, chosen};
use crate::rules::play::play;
use hapticbillard::rules::{GameKind, game};
use rand::TryRng;
use std::convert::Infallible;

/// The bytes decide everything that chance decides in the seeded test.
pub fn run(data: &[u8]) {
    let (choice, data) = chosen(data);
    let kind = GameKind::ALL[choice % GameKind::ALL.len()];
    if let Err(problem) = play(kind, game(kind).judge, &mut Bytes(data)) {
        panic!("{kind}: {problem}");
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
