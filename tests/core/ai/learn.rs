//! Lessons by the real simulation: what the paper's player learned, and what the throw table knows.

use hapticbillard::ai::lesson::{
    Drill, Lesson, Strength, Summary, THROW_CELLS, Trial, conditions, exams, mean_hit_rate,
    pot_error_deg, practice_table, practise, throw_cell, throw_table,
};
use hapticbillard::ai::{PlayerSettings, ThrowTable};
use hapticbillard::physics::{PhysicsSettings, Profile};

/// As many as the findings are stated for.
const SEEDS: u64 = 100;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

#[test]
fn findings_of_the_paper_come_out_of_the_simulation() {
    for exam in exams() {
        let table = practice_table(&exam.condition.physics).unwrap();
        let courses: Vec<_> =
            (1..=SEEDS).map(|seed| practise(&exam.lesson, &table, seed).unwrap()).collect();
        let summary = Summary::of(&courses);
        for demand in &exam.demands {
            let (value, ok) = demand.judge(&summary);
            let Lesson { outliers, threshold, .. } = exam.lesson;
            let what = (demand.finding, demand.what, exam.condition.id, outliers, threshold);
            assert!(ok, "{what:?}: {value:?}");
        }
    }
}

#[test]
fn every_condition_can_be_learned_under_and_a_seed_gives_the_same_bits() {
    for condition in conditions() {
        let table = practice_table(&condition.physics).unwrap();
        for strength in [Strength::AsPlayed, Lesson::default().strength] {
            let lesson = Lesson { shots: 30, strength, ..Lesson::default() };
            let course = practise(&lesson, &table, 5).unwrap();
            assert_eq!(course.len(), 30, "{}", condition.id);
            let seen = course.iter().filter(|trial| trial.error_deg.is_some()).count();
            assert!(seen >= 28, "{}: {seen}", condition.id);
            assert_eq!(practise(&lesson, &table, 5).unwrap(), course, "{}", condition.id);
            assert_ne!(practise(&lesson, &table, 6).unwrap(), course, "{}", condition.id);
        }
    }
}

#[test]
fn steps_and_events_teach_the_same_under_the_same_laws() {
    let learned = |id: &str| {
        let condition = conditions().into_iter().find(|condition| condition.id == id).unwrap();
        let table = practice_table(&condition.physics).unwrap();
        let lesson = Lesson { observation_error_deg: 0.0, outliers: 0.0, ..Lesson::default() };
        practise(&lesson, &table, 1).unwrap().last().unwrap().factor
    };
    let (steps, exact) = (learned("standard_steps"), learned("standard"));
    assert!((steps - exact).abs() < 0.01, "{steps} {exact}");
}

#[test]
fn a_ball_without_friction_goes_along_the_line_of_centres() {
    let physics = PhysicsSettings { ball_friction: false, ..PhysicsSettings::default() };
    let table = practice_table(&physics).unwrap();
    for side in [1.0, -1.0] {
        let drill = Drill {
            cut_rad: side * 30.0 * DEGREE,
            commanded_rad: side * 33.0 * DEGREE,
            to_ball_m: 0.5,
            tip_speed_m_s: 1.5,
            obstacle: None,
        };
        let seen = drill.play(&table).unwrap().unwrap();
        // Aimed 3° too thin, it leaves 3° too thin, on either side.
        assert!((seen.error_deg + 3.0).abs() < 0.02, "{seen:?}");
        assert!((1.0..3.0).contains(&seen.ball_speed_m_s), "{seen:?}");
    }
}

#[test]
fn a_ball_in_the_way_makes_a_gross_error() {
    let table = practice_table(&PhysicsSettings::default()).unwrap();
    let lesson = |outliers| Lesson { outliers, threshold: false, ..Lesson::default() };
    let course = practise(&lesson(1.0), &table, 3).unwrap();
    let gross = |trial: &&Trial| trial.error_deg.is_some_and(|error| error.abs() > 10.0);
    assert!(course.iter().filter(gross).count() * 10 >= course.len() * 8);
    assert!(mean_hit_rate(&course).iter().all(Option::is_none), "they do not count");
    // The same shots without the ball in the way.
    let free = practise(&lesson(0.0), &table, 3).unwrap();
    assert!(free.iter().filter(gross).count() == 0);
    assert_eq!(free[7].cut_deg, course[7].cut_deg);
}

#[test]
fn the_shipped_throw_table_is_what_the_simulation_teaches() {
    let shipped = ThrowTable::shipped();
    let cloth = practice_table(&PhysicsSettings::default()).unwrap();
    let factors: Vec<f64> = (0..THROW_CELLS)
        .map(|cell| throw_cell(cell, &cloth, shipped.seed, shipped.shots).unwrap())
        .collect();
    let learned = throw_table(&factors, shipped.seed, shipped.shots);
    assert_eq!(ThrowTable::parse(&learned.to_toml()), Ok(shipped));
}

#[test]
fn the_throw_table_aims_far_better_than_a_single_factor() {
    let cloth = practice_table(&PhysicsSettings::default()).unwrap();
    let table = ThrowTable::shipped();
    let by_table = pot_error_deg(|cut, speed| table.factor(cut, speed), &cloth, 99, 2000).unwrap();
    let single = |factor: f64| pot_error_deg(|_, _| factor, &cloth, 99, 2000).unwrap();
    assert!(by_table < 0.12, "{by_table} deg");

    let in_use = single(PlayerSettings::paper(1, Profile::Standard).throw_factor);
    assert!(by_table < 0.5 * in_use, "{by_table} against {in_use} deg");
    // Even against the best that a single one could be in hindsight.
    let best = (0..30).map(|n| single(0.03 + 0.002 * f64::from(n))).fold(f64::MAX, f64::min);
    assert!(by_table < 0.7 * best, "{by_table} against {best} deg");
}
