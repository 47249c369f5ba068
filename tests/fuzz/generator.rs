//! Seeds from the environment, and ways to spoil a text.

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The seed of this run: `FUZZ_SEED`, or always the same.
pub fn seed() -> u64 {
    number("FUZZ_SEED", 20_090_701)
}

/// How many cases this run tries: `FUZZ_EVENTS`, or a short smoke.
pub fn cases(smoke: u64) -> u64 {
    number("FUZZ_EVENTS", smoke)
}

/// The number in a variable of the environment, or another one where there is none.
pub fn number(name: &str, default: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name}={text} is no whole number")),
        Err(_) => default,
    }
}

/// A generator for one case of a run.
pub fn generator(case: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed() ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// What may be done to a text; each run leaves some of them out, so that what is left goes deeper.
#[derive(Clone, Copy)]
enum Spoil {
    DropLine,
    RepeatLine,
    SwapLines,
    DropByte,
    FlipCharacter,
    Insert,
    Number,
    Cut,
}

const SPOILS: [Spoil; 8] = [
    Spoil::DropLine,
    Spoil::RepeatLine,
    Spoil::SwapLines,
    Spoil::DropByte,
    Spoil::FlipCharacter,
    Spoil::Insert,
    Spoil::Number,
    Spoil::Cut,
];

/// Numbers at the edges of what programs expect.
const NUMBERS: [&str; 16] = [
    "0",
    "-0.0",
    "-1",
    "1e308",
    "1e-308",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "65536",
    "4294967296",
    "9223372036854775807",
    "99999999999999999999",
    "0x10",
    "1_000",
    "0.1",
];

/// A spoiled copy of `text`; `words` are what may be inserted.
pub fn spoiled(text: &str, words: &[&str], generator: &mut Pcg64Mcg) -> String {
    let enabled: Vec<Spoil> = SPOILS.into_iter().filter(|_| generator.random_bool(0.6)).collect();
    let mut text = text.to_string();
    for _ in 0..generator.random_range(1..=4) {
        if let Some(spoil) = pick(&enabled, generator) {
            text = spoil_once(&text, *spoil, words, generator);
        }
    }
    text
}

fn pick<'a, T>(list: &'a [T], generator: &mut impl Rng) -> Option<&'a T> {
    if list.is_empty() { None } else { list.get(generator.random_range(0..list.len())) }
}

fn spoil_once(text: &str, spoil: Spoil, words: &[&str], generator: &mut Pcg64Mcg) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let mut characters: Vec<char> = text.chars().collect();
    if lines.is_empty() || characters.is_empty() {
        return text.to_string();
    }
    let line = generator.random_range(0..lines.len());
    let other = generator.random_range(0..lines.len());
    let place = generator.random_range(0..characters.len());
    match spoil {
        Spoil::DropLine => drop(lines.remove(line)),
        Spoil::RepeatLine => lines.insert(other, lines[line]),
        Spoil::SwapLines => lines.swap(line, other),
        Spoil::DropByte => {
            characters.remove(place);
            return characters.into_iter().collect();
        }
        Spoil::FlipCharacter => {
            let any = ['"', '[', ']', '=', '\n', '\r', '\0', '#', '.', 'é', '\u{202e}', '🎱', '\\'];
            characters[place] = *pick(&any, generator).unwrap_or(&'?');
            return characters.into_iter().collect();
        }
        Spoil::Insert => {
            let word = pick(words, generator).copied().unwrap_or_default();
            characters.splice(place..place, word.chars());
            return characters.into_iter().collect();
        }
        Spoil::Number => {
            let number = pick(&NUMBERS, generator).copied().unwrap_or_default();
            return with_number(text, place, number);
        }
        Spoil::Cut => return characters.into_iter().take(place).collect(),
    }
    lines.join("\n") + "\n"
}

/// `text` with the first number behind character `place` replaced.
fn with_number(text: &str, place: usize, number: &str) -> String {
    let characters: Vec<char> = text.chars().collect();
    let is_part = |c: &char| c.is_ascii_digit() || *c == '.' || *c == '-';
    let Some(start) = (place..characters.len()).find(|i| characters[*i].is_ascii_digit()) else {
        return text.to_string();
    };
    let end = (start..characters.len()).find(|i| !is_part(&characters[*i]));
    let before: String = characters[..start].iter().collect();
    let after: String = characters[end.unwrap_or(characters.len())..].iter().collect();
    before + number + &after
}
