use crate::bytes::{check_line, text};
use hapticbillard::ids::GameKind;
use hapticbillard::scene::Scene;

/// What stands in every mesh file that a scene names: a slope.
pub const COURSE: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0.2\nv -1 1 0.2\nf 1 2 3 4\n";

pub fn run(data: &[u8]) {
    let text = text(data);
    match Scene::parse("scene.toml", &text) {
        Ok(scene) => set_up(&scene),
        Err(error) => {
            let said = error.to_string();
            check_line(&said);
            assert!(said.starts_with(&format!("scene.toml:{}: ", error.line)), "{said}");
            assert!((1..=text.lines().count() + 1).contains(&error.line), "{said}");
        }
    }
}

/// Puts the balls on what the scene names. To make a shipped table takes much longer than to read
/// a scene, and is the same every time.
fn set_up(scene: &Scene) {
    assert!(!scene.plan().is_empty());
    check_line(&format!("{}: {}", scene.about.name, scene.about.description));
    for player in &scene.players {
        check_line(&format!("{} wins", player.name));
    }
    for (problem, fix) in GameKind::ALL.into_iter().filter_map(|game| scene.misfit(game)) {
        check_line(&problem);
        check_line(&fix);
    }
    let ground = Scene { table: None, balls: None, ..scene.clone() };
    let balls =
        ground.build_table(&mut |_| Ok(COURSE.into())).and_then(|table| ground.build_balls(&table));
    match balls {
        Ok(balls) => assert_eq!(balls.len(), scene.ball.len()),
        Err(error) => check_line(&error.to_string()),
    }
}
