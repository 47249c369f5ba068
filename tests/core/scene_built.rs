//! What a scene's table and balls are once they are built.

use hapticbillard::scene::Scene;

/// The smallest scene.
const HEAD: &str = "[scene]\nname = \"x\"\n[physics]\n";

#[test]
fn two_numbers_put_a_ball_on_the_ground_and_three_say_its_height() {
    let text = format!(
        "{HEAD}[[ball]]\nid = 3\nradius_m = 0.02\nposition_m = [1, 2]\n\
         [[ball]]\nid = 4\nposition_m = [1, 2, 3]\nflags = {{ gravity = false }}\n"
    );
    let scene = Scene::parse("s.toml", &text).unwrap();
    assert_eq!(scene.ball[0].position_m.to_array(), [1.0, 2.0, 0.02]);
    assert_eq!(scene.ball[1].position_m.to_array(), [1.0, 2.0, 3.0]);
    assert!(!scene.ball[1].flags.gravity && scene.ball[1].flags.collide);
}

#[test]
fn a_mesh_that_is_used_twice_is_read_once() {
    let mesh = "[[mesh]]\nfile = \"a.obj\"\n[[mesh]]\nfile = \"b.obj\"\n";
    let scene = Scene::parse("s.toml", &format!("{HEAD}{mesh}{mesh}")).unwrap();
    assert_eq!(scene.meshes_needed(), ["a.obj", "b.obj"]);
}

#[test]
fn a_rack_counts_its_balls_and_an_entry_replaces_one_of_them() {
    let table = "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \"nine-ball\"\n";
    let cue = "[[ball]]\nid = 0\nposition_m = [-0.6, 0.1]\n";
    let count = |text: String| Scene::parse("s.toml", &text).unwrap().ball_count();
    assert_eq!(count(format!("{HEAD}{table}")), 10);
    assert_eq!(count(format!("{HEAD}{table}{cue}")), 10);
    assert_eq!(count(format!("{HEAD}{cue}")), 1);
}

/// Table and balls of a scene whose mesh files all hold `mesh`.
fn built(text: &str, mesh: &str) -> Result<Vec<f64>, String> {
    let scene = Scene::parse("s.toml", text).expect("the scene itself is right");
    let table = scene.build_table(&mut |_| Ok(mesh.to_string())).map_err(|e| e.to_string())?;
    let balls = scene.build_balls(&table).map_err(|e| e.to_string())?;
    Ok(balls.iter().map(|(_, state)| state.position.x).collect())
}

#[test]
fn every_shipped_scene_builds_its_table_and_its_balls() {
    for (name, text) in hapticbillard::shipped::SCENES {
        let count = Scene::parse(name, text).unwrap().ball_count();
        let mesh = hapticbillard::shipped::mesh(&format!("{name}.obj")).unwrap_or_default();
        assert_eq!(built(text, mesh).map(|balls| balls.len()), Ok(count), "{name}");
    }
}

#[test]
fn an_entry_takes_the_place_of_the_ball_in_the_rack() {
    let table = "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \"eight-ball\"\n";
    let cue = "[[ball]]\nid = 0\nposition_m = [-0.9, 0.1]\n";
    let balls = built(&format!("{HEAD}{table}{cue}"), "").unwrap();
    assert_eq!((balls.len(), balls[0]), (16, -0.9));

    let cue = "[[ball]]\nid = 0\nposition_m = [0.635, 0]\n";
    let error = built(&format!("{HEAD}{table}{cue}"), "").unwrap_err();
    assert!(error.starts_with("s.toml:8: ball[0].position_m = [0.635, 0.0, 0.028575]: overlaps"));
}

#[test]
fn a_mesh_is_scaled_and_moved_and_no_ball_may_be_in_it() {
    let triangle = "v 0 -1 -1\nv 0 1 -1\nv 0 0 1\nf 1 2 3\n";
    let mesh = "[[mesh]]\nfile = \"a.obj\"\nscale = 2\noffset_m = [0.5, 0, 0]\n";
    let ball = |x: f64| format!("{HEAD}{mesh}[[ball]]\nid = 0\nposition_m = [{x}, 0]\n");
    assert_eq!(built(&ball(0.4), triangle), Ok(vec![0.4]));
    assert_eq!(
        built(&ball(0.49), triangle).unwrap_err(),
        "s.toml:8: ball[0].position_m = [0.49, 0.0, 0.028575]: in a mesh: at least its radius away \
         from every face; move the ball, or set offset_m of the mesh"
    );
    assert_eq!(
        built(&ball(0.4), "v 1 2\n").unwrap_err(),
        "s.toml:4: mesh[0].file = \"a.obj\": line 1: found 2 coordinates; expected 3; correct the \
         mesh file"
    );
}
