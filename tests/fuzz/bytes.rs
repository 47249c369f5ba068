//! Bytes from outside as targets take them, and what must hold of every message about them.

use std::borrow::Cow;

/// Bytes as text. What is no UTF-8 is refused where files are opened.
pub fn text(data: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(data)
}

/// The first byte, which chooses, and the rest.
pub fn chosen(data: &[u8]) -> (usize, &[u8]) {
    data.split_first().map_or((0, data), |(first, rest)| (usize::from(*first), rest))
}

/// What is said of an error: one line that fits a message.
#[track_caller]
pub fn check_line(line: &str) {
    let breaks = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}');
    assert!(!line.contains(breaks), "more than one line: {line:?}");
    assert!(!line.is_empty() && line.len() < 2500, "{} bytes: {line:?}", line.len());
}

/// Bytes that decide what chance decides elsewhere; zeros where they end.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// The next ones.
    pub fn take<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        let count = N.min(self.0.len());
        bytes[..count].copy_from_slice(&self.0[..count]);
        self.0 = &self.0[count..];
        bytes
    }

    /// The next eight as a number.
    pub fn number(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    /// The next numbers.
    pub fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.number())
    }
}
