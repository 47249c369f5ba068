//! Files are untrusted: whatever stands in them, a parser gives a value or an error of one line.

use super::generator::{cases, generator, seed, spoiled};
use hapticbillard::ids::BallId;
use hapticbillard::mesh::{Surface, parse_obj};
use hapticbillard::physics::{Simulation, SolverKind};
use hapticbillard::scene::Scene;
use hapticbillard::shipped;
use hapticbillard::table::{Table, TableParameters};
use hapticbillard::validation::{Catalogue, run};
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

/// A ball above a mesh that a scene names.
const MESH_SCENE: &str = "[scene]\nname = \"mesh\"\n[physics]\nsolver = \"fixed-step\"\n\
    step_ms = 4\n[[mesh]]\nfile = \"a.obj\"\n[[ball]]\nid = 1\nposition_m = [0.5, 0.4, 1.1]\n\
    velocity_m_s = [0.3, 0.2, -1]\n";

#[test]
fn a_scene_with_a_spoiled_mesh_is_played_or_refused_in_one_line() {
    let scene = Scene::parse("fuzz.toml", MESH_SCENE).unwrap();
    let (mut wrong, mut played, mut stopped) = (0, 0, 0);
    for case in 0..cases(2_000) {
        let mut random = generator(case);
        let place = format!("seed {}, case {case}", seed());
        let text = spoiled(CUBE, &OBJ_WORDS, &mut random);
        let table = match scene.build_table(&mut |_| Ok(text.clone())) {
            Ok(table) => table,
            Err(error) => {
                wrong += 1;
                let line = error.to_string();
                assert!(line.starts_with("fuzz.toml:6: mesh[0].file"), "{place}: {line}");
                assert!(!line.contains(char::is_control) && line.len() < 2000, "{place}: {line}");
                continue;
            }
        };
        // Faces without area, and far too large ones, lie in the way of a ball that falls on them.
        let run = scene.build_balls(&table).map_err(|error| error.to_string()).and_then(|balls| {
            let simulation = Simulation::from_parts(&table, balls, &scene.physics);
            let advanced = simulation.and_then(|mut simulation| {
                simulation.advance(0.2, Default::default(), &mut Vec::new())?;
                Ok(simulation.sample(BallId(1), 0.2))
            });
            advanced.map_err(|error| error.to_string())
        });
        match run {
            Ok(ball) => {
                played += 1;
                assert!(ball.is_some_and(|ball| ball.position.is_finite()), "{place}");
            }
            Err(line) => {
                stopped += 1;
                assert!(!line.contains(char::is_control) && line.len() < 2000, "{place}: {line}");
            }
        }
    }
    assert!(wrong > 0 && played > wrong / 10, "{wrong} wrong, {played} played, {stopped} stopped");
}

const TABLE_WORDS: [&str; 9] = [
    "[corner]\n",
    "length_m = \"long\"\n",
    "mouth_m = 0.0\n",
    "[side]\nradius_m = nan\n",
    "ball_diameter_m = inf\n",
    "rail_height_m = -0.036\n",
    "\"\"\"",
    "= =\n",
    "[[[[[[[[[[[[[[[[[[[[[[",
];

#[test]
fn spoiled_tables_are_built_or_refused_in_one_line() {
    let text = shipped::table("pool-9ft").unwrap();
    let (mut right, mut wrong) = (0, 0);
    for case in 0..cases(10_000) {
        let mut random = generator(case);
        let place = format!("seed {}, case {case}", seed());
        let parameters = TableParameters::from_toml(&spoiled(text, &TABLE_WORDS, &mut random));
        // To build the faces takes longer than to read: some are enough for a smoke.
        let built = parameters.and_then(|parameters| {
            right += 1;
            if right % 50 == 1 {
                return Table::from_parameters("fuzz", parameters).map(Some);
            }
            Ok(None)
        });
        match built {
            Ok(Some(table)) => {
                assert!(table.mesh.vertices.iter().all(|vertex| vertex.is_finite()), "{place}");
                assert!(!table.mesh.faces.is_empty() && table.pockets.len() == 6, "{place}");
            }
            Ok(None) => {}
            Err(error) => {
                wrong += 1;
                let line = error.to_string();
                assert!(!line.contains(char::is_control) && line.len() < 2000, "{place}: {line:?}");
            }
        }
    }
    assert!(right > 0 && wrong > 0, "{right} right, {wrong} wrong");
}

/// What may be inserted into a catalogue.
const CATALOGUE_WORDS: [&str; 10] = [
    "\"runs\": [{}, {}],",
    "\"law\": \"clamp_2009\",",
    "null",
    "1e308",
    "-1",
    "[[[[[[",
    "\"measured_",
    "{\"interval\": true}",
    "\"kind_of_run\": \"spring\",",
    "\"e_ball\": \"x\",",
];

/// The shipped cases that need no solver and little time, one a line and key.
fn small_cases() -> Vec<String> {
    let mut shipped: Vec<serde_json::Value> = Vec::new();
    for text in [shipped::CASES, shipped::HAPTIC_CASES] {
        let mut catalogue: serde_json::Value = serde_json::from_str(text).unwrap();
        shipped.append(catalogue["cases"].as_array_mut().unwrap());
    }
    let solved = [
        "single_ball",
        "balls_free",
        "ball_mesh",
        "flight",
        "static",
        "table_shot",
        // Many loops each.
        "stability",
        "strike",
    ];
    let cases = shipped.iter().filter(|case| {
        let kind = case["kind_of_run"].as_str().unwrap();
        !solved.iter().any(|name| kind.starts_with(name))
            && case["setup"].get("break_scene").is_none()
    });
    cases
        .map(|case| {
            let mut case = case.clone();
            // Few runs: a spoiled file is as good with two as with thirty.
            if let Some(runs) = case["setup"].get_mut("runs") {
                runs.as_array_mut().unwrap().truncate(2);
                for (_, expect) in case["expect"].as_object_mut().unwrap() {
                    expect.as_array_mut().unwrap().truncate(2);
                }
            }
            serde_json::to_string_pretty(&serde_json::json!({ "cases": [case] })).unwrap()
        })
        .collect()
}

#[test]
fn spoiled_catalogues_give_outcomes_or_one_line() {
    let texts = small_cases();
    assert!(texts.len() > 30);
    let (mut right, mut wrong, mut ended) = (0, 0, [0; 3]);
    for case in 0..cases(4_000) {
        let mut random = generator(case);
        let text = &texts[random.random_range(0..texts.len())];
        let text = spoiled(text, &CATALOGUE_WORDS, &mut random);
        let place = format!("seed {}, case {case}", seed());
        let outcomes = Catalogue::parse(&text).and_then(|catalogue| {
            catalogue
                .cases
                .iter()
                .map(|case| run(case, SolverKind::FixedStep))
                .collect::<Result<Vec<_>, _>>()
        });
        match outcomes {
            Ok(outcomes) => {
                right += 1;
                for outcome in outcomes {
                    ended[outcome.status as usize] += 1;
                    assert!(!outcome.error.is_some_and(f64::is_nan), "{place}");
                    let shown = outcome.key.is_some() || outcome.reason.is_some();
                    assert!(shown, "{place}: {outcome:?}");
                }
            }
            Err(error) => {
                wrong += 1;
                let line = error.to_string();
                assert!(!line.contains(char::is_control), "{place}: {line:?}");
                assert!(line.len() < 2000, "{place}: {line:?}");
            }
        }
    }
    // The canary: all ends are reached.
    if cases(4_000) >= 1000 {
        assert!(
            right > 50 && wrong > 50 && ended.iter().all(|n| *n > 0),
            "{right} {wrong} {ended:?}"
        );
    }
}
