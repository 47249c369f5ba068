//! Other programs: what they are given, and what is taken from them.

use super::scene;
use hapticbillard::report::{
    PeerStatus, Peers, PeersError, Prepared, SceneCase, cheaper_and_better,
};
use serde_json::{Value, json};

fn case(id: &str, starts: usize) -> SceneCase {
    Prepared::new(scene(id), starts).unwrap().case()
}

/// Results of one program in three steps, as `tests/peers` writes them.
fn sample() -> Value {
    let row = |step_ms: f64, error_m: f64, cpu: f64| {
        json!({
            "scene": "draw", "digest": case("draw", 1).digest, "program": "other",
            "setting": "fine", "step_ms": step_ms, "starts": 3, "error_m": error_m,
            "cpu_us_per_s": [cpu, cpu, 2.0 * cpu], "status": "ok", "remark": "",
        })
    };
    json!({
        "made": "a day, a processor",
        "programs": [
            {"name": "other", "version": "1.2", "about": "In steps.", "problem": null},
            {"name": "absent", "version": null, "about": "", "problem": "did not install: no"},
        ],
        "rows": [row(4.0, 1e-2, 10.0), row(2.0, 5e-3, 20.0), row(1.0, 6e-3, 40.0)],
    })
}

#[test]
fn a_case_is_what_the_scene_is_run_with() {
    let cut = case("cut", 2);
    assert_eq!((cut.starts.len(), cut.looks_s.len()), (2, 32));
    assert_eq!(cut.looks_s[31], cut.until_s);
    assert_eq!(cut.ground.planes.iter().filter(|plane| plane.surface == "cushion").count(), 4);
    assert_eq!(cut.ground.planes[0].rub.friction, 0.2);
    for start in &cut.starts {
        assert!(start.truth_m.iter().all(|balls| balls.len() == start.balls.len()));
        // The first look is soon after the start: the ball has gone straight on by then.
        let ball = &start.balls[0];
        let straight = ball.position_m + ball.velocity_m_s * cut.looks_s[0];
        assert!(start.truth_m[0][0].distance(straight) < 0.01);
    }
    let pocket = case("pocket", 1);
    let faces: usize = pocket.ground.parts.iter().map(|part| part.faces.len()).sum();
    assert!(faces > 9_000, "{faces}");
    for part in &pocket.ground.parts {
        let corners = part.faces.iter().flatten();
        assert!(corners.copied().all(|corner| (corner as usize) < part.vertices_m.len()));
    }
    assert!(case("spring", 1).starts[0].balls[0].spring.is_some());
}

#[test]
fn a_digest_tells_other_questions_and_not_more_starts() {
    assert_eq!(case("draw", 1).digest, case("draw", 3).digest);
    assert_ne!(case("draw", 1).digest, case("masse", 1).digest);
    // The same balls and ground under other laws.
    let mut other = scene("draw");
    other.until = hapticbillard::report::Until::Time(1.024);
    let other = Prepared::new(other, 1).unwrap().case();
    assert_ne!(case("draw", 1).digest, other.digest);
}

#[test]
fn results_are_read_and_the_best_of_them_found() {
    let peers = Peers::parse(&sample().to_string()).unwrap();
    assert_eq!(peers.of_scene("draw").count(), 3);
    assert_eq!(peers.rows[1].method(), "other, fine");
    assert_eq!(peers.rows[0].point(), Some((1e-2, 10.0)));
    let steps = |error_m: f64, cpu: f64| {
        let rows = cheaper_and_better(peers.rows.iter(), error_m, cpu);
        rows.iter().map(|row| row.step_ms.unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(steps(1e-9, 1e9), [] as [f64; 0]);
    assert_eq!(steps(1.0, 5.0), [] as [f64; 0]);
    assert_eq!(steps(5e-3, 20.0), [] as [f64; 0]);
    assert_eq!(steps(6e-3, 20.0), [2.0]);
    assert_eq!(steps(1e-2, 40.0), [4.0, 2.0, 1.0]);
}

#[test]
fn results_of_another_question_are_told() {
    let digest = case("draw", 3).digest;
    let mut file = sample();
    assert_eq!(Peers::parse(&file.to_string()).unwrap().stale("draw", digest), None);
    file["rows"][2]["digest"] = json!("0000000000000001");
    let peers = Peers::parse(&file.to_string()).unwrap();
    assert_eq!(peers.stale("draw", digest), Some(&peers.rows[2]));
    assert_eq!(peers.stale("masse", digest), None);
}

#[track_caller]
fn refused(place: &str, value: Value, expected: &str) {
    let mut file = sample();
    file["rows"][1][place] = value;
    let error = Peers::parse(&file.to_string()).unwrap_err();
    let PeersError::Row { row: 2, problem, .. } = &error else { panic!("{error}") };
    assert_eq!(*problem, expected, "{error}");
}

#[test]
fn a_row_that_cannot_be_is_refused_with_its_place() {
    refused("scene", json!("banana"), "there is no such scene");
    refused("program", json!("absent"), "there is no such program that ran");
    refused("step_ms", json!(0.0), "its step is not above 0");
    refused("error_m", json!(-1.0), "its error is no length");
    refused("cpu_us_per_s", json!([1.0, 0.0, 1.0]), "its processor time is not above 0");
    refused("error_m", Value::Null, "it ran well but has no error or no processor time");
    refused("status", json!("cannot_express"), "it did not run well and does not say why");
    let broken = Peers::parse("{\n\"made\": 3}").unwrap_err();
    assert!(matches!(broken, PeersError::Text { line: 2, .. }), "{broken}");
    let mut extra = sample();
    extra["rows"][0]["colour"] = json!("red");
    assert!(Peers::parse(&extra.to_string()).is_err());
}

#[test]
fn a_row_that_did_not_run_well_is_no_point() {
    let mut file = sample();
    file["rows"][0]["status"] = json!("failed");
    file["rows"][0]["remark"] = json!("at 0.5 s: diverged");
    let peers = Peers::parse(&file.to_string()).unwrap();
    assert_eq!((peers.rows[0].status, peers.rows[0].point()), (PeerStatus::Failed, None));
    assert_eq!(cheaper_and_better(peers.rows.iter(), 1.0, 15.0), [] as [&_; 0]);
}
