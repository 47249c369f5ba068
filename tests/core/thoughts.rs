//! What a player tells of its thoughts, and how it is drawn.

use glam::DVec2;
use hapticbillard::cast::Cast;
use hapticbillard::events::{
    Event, IdeaKind, Insight, Prospect, Source, Topic, Topics, Way, WayEnd,
};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::{BallId, PlayerId, PocketId};
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::lockstep::{self, Setup};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{DrawList, Radii, Scoreboard, ThoughtsPanel, Words, draw_thoughts};
use hapticbillard::rules::{Language, Texts};
use hapticbillard::scene::Scene;
use hapticbillard::shipped;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard::units::Tick;
use smallvec::smallvec;
use std::sync::{Arc, Mutex};

fn way(is_free: bool, is_chosen: bool) -> Way {
    let (from, to) = (DVec2::ZERO, DVec2::new(0.58, 0.0));
    Way { from, to, leads_to: WayEnd::Pocket(BallId(3), PocketId::Fl), is_free, is_chosen }
}

fn pot(pocket: PocketId, chance: f64, is_chosen: bool) -> Prospect {
    Prospect {
        kind: IdeaKind::Pot,
        ball: Some(BallId(3)),
        pocket: Some(pocket),
        ghost: DVec2::new(-0.05, 0.0),
        ways: smallvec![way(true, is_chosen)],
        chance: Some(chance),
        legal: Some(1.0),
        value: Some(chance),
        samples: 8,
        is_chosen,
    }
}

fn insight(ways: Vec<Way>, prospects: Vec<Prospect>) -> Insight {
    Insight { player: PlayerId::ONE, cue_ball: DVec2::new(-0.5, 0.0), ways, prospects }
}

fn drawn(insight: &Insight) -> DrawList {
    let radii = Radii::default();
    let mut list = DrawList::new(&Snapshot::default(), &HumanView::default(), &radii);
    draw_thoughts(insight, &radii, &mut list);
    list
}

#[test]
fn a_free_way_is_one_line_and_a_blocked_one_is_dashed() {
    assert_eq!(drawn(&insight(vec![way(true, false)], vec![])).lines.len(), 1);
    let dashes = drawn(&insight(vec![way(false, false)], vec![])).lines;
    assert_eq!(dashes.len(), 10);
    let end = dashes.iter().map(|line| line.to[0]).fold(0.0, f32::max);
    assert!((0.5..=0.58).contains(&end), "{end}");
    // Not by colour alone, but by colour too.
    let free = drawn(&insight(vec![way(true, false)], vec![])).lines[0].colour;
    assert_ne!(free[..3], dashes[0].colour[..3]);
}

#[test]
fn what_is_played_is_drawn_last_and_widest_with_its_ghost() {
    let chosen = pot(PocketId::Fl, 0.8, true);
    let list = drawn(&insight(vec![way(true, true), way(false, false)], vec![chosen]));
    // Its own way and the cue ball's to the ghost, which nobody examined.
    let [.., own, cue] = &list.lines[..] else { panic!("{:?}", list.lines) };
    let widest = list.lines.iter().map(|line| line.half_width_m).fold(0.0, f32::max);
    assert_eq!((own.half_width_m, cue.half_width_m), (widest, widest));
    assert_eq!(list.ghosts.len(), 1);
    assert_eq!(list.labels.len(), 1);
    assert!(list.labels[0].text == "80 %" && list.labels[0].is_bold);
}

#[test]
fn shots_that_do_the_same_share_a_label_and_a_row() {
    let prospects = vec![
        pot(PocketId::Fl, 0.5, false),
        pot(PocketId::Fl, 0.4, true),
        pot(PocketId::Fr, 0.7, false),
        Prospect { pocket: None, kind: IdeaKind::Contact, ..pot(PocketId::Fl, 0.9, false) },
    ];
    let insight = insight(vec![], prospects);
    let labels: Vec<String> = drawn(&insight).labels.into_iter().map(|label| label.text).collect();
    assert_eq!(labels, ["40 %", "70 %"]);
    let (texts, words) = (Texts::new(Language::English), Words::new(Language::English));
    let panel = ThoughtsPanel::new(&insight, "Ann", &texts, &words);
    let rows: Vec<&str> = panel.rows.iter().map(|row| row.text.as_str()).collect();
    assert_eq!(rows, ["3: at the foot, left", "3 (to pocket nothing)", "3: at the foot, right"]);
    assert!(panel.rows[0].is_chosen && panel.title == "Ann's thoughts");
    assert_eq!(panel.rows[0].values, ["40 %", "0.40"]);
}

#[test]
fn labels_stand_where_the_camera_sees_them() {
    let above = CameraPose::above(2.54);
    let [right, down] = above.place_of(glam::DVec3::ZERO, 16.0 / 9.0).unwrap();
    assert!((right - 0.5).abs() < 1e-9 && (down - 0.5).abs() < 1e-9);
    let foot = above.place_of(glam::DVec3::X, 16.0 / 9.0).unwrap();
    assert!(0.6 < foot[0] && foot[0] < 1.0, "the foot is on the right: {foot:?}");
    let [_, left] = above.place_of(glam::DVec3::Y, 16.0 / 9.0).unwrap();
    assert!(left < 0.3, "the left side is on top: {left}");
    assert_eq!(above.place_of(glam::DVec3::Z * 9.0, 1.0), None, "behind the eye");
}

/// Keeps what it hears of thoughts.
#[derive(Clone, Default)]
struct Reader(Arc<Mutex<Vec<Arc<Insight>>>>);

impl Participant for Reader {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::of(&[Topic::Insight])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        for stamped in delivered.events.iter() {
            if let Event::Insight(insight) = &stamped.event {
                self.0.lock().unwrap().push(insight.clone());
            }
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

#[test]
fn a_game_is_the_same_whether_somebody_reads_thoughts_or_not() {
    let scene = Scene::parse("test", shipped::scene("eight_ball_headless").unwrap()).unwrap();
    let table = Arc::new(scene.build_table(&mut |_| Err(String::new())).unwrap());
    let reader = Reader::default();
    let play = |observers: Vec<Box<dyn Participant>>| {
        let cast = Cast::new(&scene, table.clone()).unwrap();
        lockstep::run(cast, Setup { observers, ..Setup::headless(Tick(30_000)) }).unwrap()
    };
    let (read, alone) = (play(vec![Box::new(reader.clone())]), play(vec![]));
    assert_eq!(read.hash.map(|hash| hash.all()), alone.hash.map(|hash| hash.all()));
    let thoughts = reader.0.lock().unwrap();
    assert!(thoughts.len() > 2, "{}", thoughts.len());
    assert!(thoughts.iter().all(|insight| insight.chosen().is_some()));
}

#[test]
fn no_core_of_a_game_hears_thoughts() {
    let scene = Scene::parse("test", shipped::scene("eight_ball").unwrap()).unwrap();
    let table = Arc::new(scene.build_table(&mut |_| Err(String::new())).unwrap());
    let cast = Cast::new(&scene, table).unwrap();
    let cores = cast.players.iter().map(|player| player.topics());
    let cores = cores.chain(cast.referee.iter().map(|referee| referee.topics()));
    for topics in cores.chain(cast.human.iter().map(|human| human.topics())) {
        assert!(!topics.contains(Topic::Insight));
    }
    assert!(Scoreboard::topics().contains(Topic::Insight));
}
