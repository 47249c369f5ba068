use super::*;

#[test]
fn every_shipped_scene_parses_and_has_a_title_and_a_sentence() {
    for (name, text) in crate::shipped::SCENES {
        let scene = Scene::parse(&format!("{name}.toml"), text).unwrap();
        assert!(!scene.about.name.is_empty() && !scene.about.description.is_empty(), "{name}");
        assert!(!scene.plan().is_empty(), "{name}");
        assert!(crate::shipped::scene(name).is_some());
    }
    assert_eq!(crate::shipped::scene("nothing"), None);
}

#[test]
fn sections_that_the_file_does_not_name_do_not_exist() {
    let text = "[scene]\nname = \"Empty\"\n[physics]\n";
    let scene = Scene::parse("empty.toml", text).unwrap();
    assert!(scene.table.is_none() && scene.balls.is_none() && scene.ball.is_empty());
    assert!(scene.cue.is_none() && scene.rules.is_none() && scene.players.is_empty());
    assert!(scene.camera.is_none() && scene.renderer.is_none() && scene.input.is_none());
    assert!(scene.actors.is_none() && scene.meshes.is_empty() && scene.planes.is_empty());
}
