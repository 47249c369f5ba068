//! Who plays.

use crate::scene::entrant::SIMULATIONS_MAX;
use crate::scene::reader::{Limits, Section};
use crate::scene::{PlayerKind, PlayerSection, STRENGTH_MAX, SceneError};

/// `[[player]]`.
pub(super) fn player(section: &Section<'_>) -> Result<PlayerSection, SceneError> {
    section.allow(&["name", "kind", "strength", "noise", "throw_factor", "simulations"])?;
    let kind = player_kind(section)?;
    let noise =
        section.number("noise", Limits { low: 0.0, high: 100.0, unit: "", example: "1.0" })?;
    let throw_factor = section
        .number("throw_factor", Limits { low: -0.9, high: 1.5, unit: "", example: "0.0" })?;
    let simulations = section.integer("simulations", 1..=SIMULATIONS_MAX.into())?;

    let only = |key: &str, allowed: &str, instead: &str| {
        let fix = format!("remove {key}, or write kind = \"{instead}\"");
        Err(section.error(key, allowed, &fix))
    };
    if noise.is_some() && !kind.is_computer() {
        return only("noise", "only a computer player has it", "paper");
    }
    if throw_factor.is_some() && kind != PlayerKind::Paper {
        return only("throw_factor", "only the paper's player has it", "paper");
    }
    let simulates = kind.is_computer() && kind != PlayerKind::Paper;
    if simulations.is_some() && !simulates {
        return only("simulations", "only a computer player that simulates has it", "club");
    }
    Ok(PlayerSection {
        name: section.text("name", "You")?.unwrap_or_else(|| kind.name().to_string()),
        kind,
        noise,
        throw_factor,
        simulations: simulations.map(|count| count as u32),
        line: section.line(),
    })
}

/// The kind of a player, with its strength.
fn player_kind(section: &Section<'_>) -> Result<PlayerKind, SceneError> {
    let kinds = PlayerKind::ALL.map(|kind| ([kind.name()], kind));
    let choices: Vec<(&[&'static str], PlayerKind)> =
        kinds.iter().map(|(names, kind)| (&names[..], *kind)).collect();
    let Some(kind) = section.choice("kind", &choices)? else {
        let allowed = "a player is human, paper, club, champion, computer or recorded";
        return Err(section.missing("kind", allowed, "write for example kind = \"human\""));
    };
    let strength = section.integer("strength", 0..=STRENGTH_MAX.into())?;
    match (kind, strength) {
        (PlayerKind::Computer(_), Some(strength)) => Ok(PlayerKind::Computer(strength as u8)),
        (_, Some(_)) => {
            let fix = "remove strength, or write kind = \"computer\"";
            Err(section.error("strength", "only kind = \"computer\" has it", fix))
        }
        (_, None) => Ok(kind),
    }
}
