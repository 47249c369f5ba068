//! Files are untrusted: whatever stands in them, a parser gives a value or an error of one line.

use super::generator::{cases, generator, seed, spoiled};
use hapticbillard::mesh::{Surface, parse_obj};
use hapticbillard::scene::Scene;
use hapticbillard::shipped;
use rand::RngExt;

/// What may be inserted anywhere: sections and keys in the wrong place.
const WORDS: [&str; 14] = [
    "[scene]\n",
    "[[ball]]\nid = 1\nposition_m = [0, 0]\n",
    "[sound]\n",
    "[[player]]\nkind = \"human\"\n",
    "radius_m = -1\n",
    "spring = { stiffness_n_m = 1, anchor_m = [0, 0, 1] }\n",
    "flags = { collide = false }\n",
    "[[mesh]]\nfile = \"a.obj\"\n",
    "[[box]]\ncentre_m = [0, 0, 0]\nsize_m = [1, 1, 1]\n",
    "[table]\npreset = \"pool-9ft\"\n",
    "[balls]\nrack = \"nine-ball\"\n",
    "step_ms = 0.001\n",
    "\"\"\"",
    "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
];

const CUBE: &str = "# a cube\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n\
    v 1 1 1\nv 0 1 1\nvn 0 0 1\nvt 0 0\nf 1 4 3 2\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf 1//1 2//1 6//1\n\
    f -8 -7 -3 -4\nusemtl cloth\ns off\n";

const OBJ_WORDS: [&str; 8] =
    ["v 1 2\n", "v 1 2 3 4 5 6 7\n", "f 1\n", "f 1 2 99999\n", "f 0 0 0\n", "f 1/", "v\n", "/"];

#[test]
fn spoiled_scenes_give_a_scene_or_one_line() {
    let (mut right, mut wrong) = (0, 0);
    for case in 0..cases(10_000) {
        let mut random = generator(case);
        let (_, text) = shipped::SCENES[random.random_range(0..shipped::SCENES.len())];
        let text = spoiled(text, &WORDS, &mut random);
        match Scene::parse("fuzz.toml", &text) {
            Ok(scene) => {
                right += 1;
                assert!(!scene.plan().is_empty(), "seed {}, case {case}", seed());
                assert!(scene.physics.step_ms > 0.0, "seed {}, case {case}", seed());
            }
            Err(error) => {
                wrong += 1;
                let line = error.to_string();
                let place = format!("seed {}, case {case}: {line:?}", seed());
                assert!(line.starts_with("fuzz.toml:"), "{place}");
                assert!(!line.contains(char::is_control), "{place}");
                assert!(line.len() < 2000, "{place}");
                assert!(1 <= error.line && error.line <= text.lines().count() + 1, "{place}");
            }
        }
    }
    // The canary: a generator that only makes right texts, or only wrong ones, tests nothing.
    assert!(right > 0 && wrong > right, "{right} right, {wrong} wrong");
}

#[test]
fn spoiled_meshes_give_a_mesh_or_one_line() {
    for case in 0..cases(10_000) {
        let mut random = generator(case);
        let text = spoiled(CUBE, &OBJ_WORDS, &mut random);
        match parse_obj(&text, Surface::Obstacle) {
            Ok(mesh) => {
                let corners = mesh.faces.iter().flat_map(|face| face.corners);
                for corner in corners {
                    let inside = (corner as usize) < mesh.vertices.len();
                    assert!(inside, "seed {}, case {case}", seed());
                }
                let finite = mesh.vertices.iter().all(|vertex| vertex.is_finite());
                assert!(finite, "seed {}, case {case}", seed());
            }
            Err(error) => {
                let line = error.to_string();
                let place = format!("seed {}, case {case}: {line:?}", seed());
                assert!(!line.contains(char::is_control) && line.len() < 2000, "{place}");
            }
        }
    }
}
