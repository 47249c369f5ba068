//! Checks that the parts of a scene fit each other and that nothing in it is impossible.

use super::reader::Section;
use super::*;
use crate::table::{Bed, TableParameters};

/// Height below which a ball beside the bed would be inside the rails [m].
const RAIL_TOP_M: f64 = 0.05;

/// Finds the first thing that cannot be.
pub(super) fn check(scene: &Scene, root: &Section<'_>) -> Result<(), SceneError> {
    ids(scene, root)?;
    ground(scene, root)?;
    overlaps(scene, root)?;
    game(scene, root)?;
    players(scene, root)?;
    actors(scene, root)
}

fn at(
    root: &Section<'_>,
    list: &str,
    index: usize,
    key: &str,
    allowed: &str,
    fix: &str,
) -> SceneError {
    match root.entries(list, usize::MAX) {
        Ok(entries) if index < entries.len() => entries[index].error(key, allowed, fix),
        _ => root.error(list, allowed, fix),
    }
}

fn ids(scene: &Scene, root: &Section<'_>) -> Result<(), SceneError> {
    let mut order: Vec<usize> = (0..scene.ball.len()).collect();
    order.sort_by_key(|i| (scene.ball[*i].id, *i));
    let twice = order.windows(2).filter(|pair| scene.ball[pair[0]].id == scene.ball[pair[1]].id);
    let Some(second) = twice.map(|pair| pair[1]).min() else { return Ok(()) };
    let allowed = "another ball has this number already";
    Err(at(root, "ball", second, "id", allowed, "give each ball a number of its own"))
}

/// No ball in the ground, in a wall or beside the bed.
fn ground(scene: &Scene, root: &Section<'_>) -> Result<(), SceneError> {
    if let (Some(_), None) = (&scene.balls, &scene.table) {
        return Err(root.error_about(
            "balls",
            "a rack stands on a table",
            "write [table] and preset = \"pool-9ft\", or list each ball as [[ball]]",
        ));
    }
    let meshes = scene.table.is_some() || !scene.meshes.is_empty() || !scene.boxes.is_empty();
    if !scene.physics.flight && meshes {
        return Err(root.error_about(
            "physics",
            "flight = false keeps balls on a plane, and there are faces to fall from",
            "describe the ground and the cushions as [[plane]], or leave flight out",
        ));
    }
    let bed = scene.table.as_ref().and_then(|table| bed(&table.preset));
    for (i, ball) in scene.ball.iter().enumerate().filter(|(_, ball)| ball.flags.collide) {
        let wrong = |allowed: &str, fix: &str| Err(at(root, "ball", i, "position_m", allowed, fix));
        let (centre, reach) = (ball.position_m, ball.radius_m - TOUCHING_M);
        let low = centre.z - reach;
        if let Some(bed) = bed {
            let inside = bed.holds(centre.truncate(), ball.radius_m - TOUCHING_M);
            if low < RAIL_TOP_M && !inside {
                let x = 0.5 * bed.length_m - ball.radius_m;
                let y = 0.5 * bed.width_m - ball.radius_m;
                return wrong(
                    &format!(
                        "outside the bed: x from {:.4} to {x:.4}, y from {:.4} to {y:.4}",
                        -x, -y
                    ),
                    "move the ball onto the bed",
                );
            }
            if low < 0.0 {
                let allowed = format!("under the cloth: a height of at least {}", ball.radius_m);
                return wrong(&allowed, "leave the height out to put the ball on the bed");
            }
        }
        for (k, plane) in scene.planes.iter().enumerate() {
            if (centre - plane.point).dot(plane.normal) < reach {
                let allowed = format!("in plane[{k}]: at least its radius away, on the free side");
                return wrong(&allowed, "move the ball, or turn the plane's normal round");
            }
        }
        for (k, block) in scene.boxes.iter().enumerate() {
            let outside = (centre - block.centre_m).abs() - 0.5 * block.size_m;
            if outside.max(DVec3::ZERO).length() < reach {
                let allowed = format!("in box[{k}]: at least its radius away from it");
                return wrong(&allowed, "move the ball or the box");
            }
        }
    }
    Ok(())
}

/// Whether a shipped table has pockets.
fn has_pockets(preset: &str) -> bool {
    parameters(preset).is_some_and(|table| table.pockets().is_some())
}

fn parameters(preset: &str) -> Option<TableParameters> {
    TableParameters::from_toml(crate::shipped::table(preset)?).ok()
}

/// The bed of a shipped table, without building its mesh.
fn bed(preset: &str) -> Option<Bed> {
    let parameters = parameters(preset)?;
    Some(Bed { length_m: parameters.length_m, width_m: parameters.width_m })
}

/// No ball in another. Sweeps along x, so that many balls cost little.
fn overlaps(scene: &Scene, root: &Section<'_>) -> Result<(), SceneError> {
    let left = |i: usize| scene.ball[i].position_m.x - scene.ball[i].radius_m;
    let mut order: Vec<usize> =
        (0..scene.ball.len()).filter(|i| scene.ball[*i].flags.collide).collect();
    order.sort_by(|a, b| left(*a).total_cmp(&left(*b)).then(a.cmp(b)));
    let mut first: Option<(usize, usize)> = None;
    for (n, &a) in order.iter().enumerate() {
        let right = scene.ball[a].position_m.x + scene.ball[a].radius_m;
        for &b in order[n + 1..].iter().take_while(|b| left(**b) < right) {
            let (one, two) = (&scene.ball[a], &scene.ball[b]);
            let apart = one.position_m.distance(two.position_m);
            if apart < one.radius_m + two.radius_m - TOUCHING_M {
                let pair = (a.max(b), a.min(b));
                first = Some(first.map_or(pair, |first| first.min(pair)));
            }
        }
    }
    let Some((later, earlier)) = first else { return Ok(()) };
    let (one, two) = (&scene.ball[earlier], &scene.ball[later]);
    let allowed = format!(
        "overlaps ball {} by {:.4} m: centres at least {:.6} m apart",
        one.id,
        one.radius_m + two.radius_m - one.position_m.distance(two.position_m),
        one.radius_m + two.radius_m,
    );
    Err(at(root, "ball", later, "position_m", &allowed, "move one of the two"))
}

/// The rules have what they judge.
fn game(scene: &Scene, root: &Section<'_>) -> Result<(), SceneError> {
    let Some(rules) = scene.rules else {
        return match scene.players.is_empty() {
            true => Ok(()),
            false => Err(root.error_about(
                "player",
                "players need rules",
                "write [rules] and game = \"free-play\", or remove the players",
            )),
        };
    };
    let wrong = |allowed: &str, fix: &str| {
        Err(root.section("rules")?.map_or_else(
            || root.error_about("rules", allowed, fix),
            |section| section.error("game", allowed, fix),
        ))
    };
    let has_cue_ball =
        scene.balls.is_some() || scene.ball.iter().any(|ball| ball.id == BallId::CUE);
    if scene.players.is_empty() {
        return wrong("rules need players", "write [[player]] and kind = \"paper\"");
    }
    if !has_cue_ball {
        return wrong("rules need a cue ball, which has the number 0", "write [[ball]] and id = 0");
    }
    match misfit(scene, rules.game) {
        Some((allowed, fix)) => wrong(&allowed, &fix),
        None => Ok(()),
    }
}

/// Why a scene is none of a game, and what helps; none if it is one.
pub(super) fn misfit(scene: &Scene, game: GameKind) -> Option<(String, String)> {
    let rack = scene.balls.as_ref().map(|balls| balls.rack.name());
    if let Some(wanted) = game.rack()
        && rack != Some(wanted)
    {
        let fix = format!("write [balls] and rack = {wanted:?}");
        return Some((format!("{game} begins with its rack"), fix));
    }
    if scene.players.len() < game.players_min() {
        let fix = "write a second [[player]]".to_string();
        return Some((format!("{game} has two players"), fix));
    }
    None
}

/// Everybody who plays has what it takes.
fn players(scene: &Scene, root: &Section<'_>) -> Result<(), SceneError> {
    let recorded = scene.actors.as_ref().is_some_and(|actors| actors.input.is_some());
    // A stylus is a hand too, where nobody plays with the mouse.
    let has_stylus =
        scene.haptic.as_ref().is_some_and(|haptic| haptic.device != HapticDevice::None);
    for (i, player) in scene.players.iter().enumerate() {
        let wrong = |allowed: &str, fix: &str| Err(at(root, "player", i, "kind", allowed, fix));
        if scene.cue.is_none() {
            return wrong("a player needs a cue", "write a section [cue]");
        }
        let is_led = match player.kind {
            kind if kind.is_computer() => true,
            PlayerKind::Human => scene.input.is_some() || has_stylus,
            _ => scene.input.is_some(),
        };
        if !is_led {
            let fix = "write a section [input], or [haptic] for a stylus";
            return wrong("such a player needs an input", fix);
        }
        if player.kind == PlayerKind::Recorded && !recorded {
            return wrong(
                "such a player needs a recording",
                "write [actors] and input = \"recorded:FILE\"",
            );
        }
        let is_computer = player.kind.is_computer();
        if is_computer && scene.cue.is_some_and(|cue| cue != CueSection::POOL) {
            let fix = "remove the keys of [cue], or write kind = \"human\"";
            return wrong("a computer player knows only a pool cue", fix);
        }
        if is_computer && scene.table.is_none() {
            return wrong("a computer player needs a table", "write a section [table]");
        }
        let is_pocketless = scene.table.as_ref().is_some_and(|table| !has_pockets(&table.preset));
        if player.kind == PlayerKind::Paper && is_pocketless {
            let allowed = "the paper's player aims at pockets, and this table has none";
            let fix = "write kind = \"club\", or a table with pockets such as pool-9ft";
            return wrong(allowed, fix);
        }
        if scene.players[..i].iter().any(|other| other.name == player.name) {
            let allowed = "another player has this name already";
            let fix = "write for example name = \"Second\"";
            return Err(at(root, "player", i, "name", allowed, fix));
        }
    }
    Ok(())
}

/// Nobody works for somebody who is not there.
fn actors(scene: &Scene, root: &Section<'_>) -> Result<(), SceneError> {
    if scene.renderer.is_some() && scene.camera.is_none() {
        let fix = "write a section [camera]";
        return Err(root.error_about("renderer", "a window needs a camera", fix));
    }
    let stand_in = scene.actors.as_ref().and_then(|actors| actors.input.as_ref());
    if let (Some(StandIn::Recorded(_)), None, Some(section)) =
        (stand_in, &scene.input, root.section("actors")?)
    {
        let allowed = "there is no input to stand in for";
        return Err(section.error("input", allowed, "write a section [input]"));
    }
    Ok(())
}
