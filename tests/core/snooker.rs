//! What snooker needs besides its rules' scenarios: spots, sight, table, choices, physics.

use crate::geometry::closest_point;
use glam::{DVec2, DVec3};
use hapticbillard::ball::{Ball, BallPlace, BallState, SNOOKER_RADIUS_M};
use hapticbillard::events::{
    BallInHand, BallOn, Choice, Command, Event, Fact, FactKind, FactSet, Source, Spotting, Stamp,
    Stamped, Turn, Verdict, Zone,
};
use hapticbillard::ids::{BallId, GameKind, PlayerId};
use hapticbillard::mesh::Surface;
use hapticbillard::physics::{PhysicsSettings, Simulation, Snapshot, SolverKind, Strike};
use hapticbillard::rack::{From, JITTER_MAX_M, Rack, Sight, Spots, overlaps};
use hapticbillard::rules::{Phase, Referee, State, legal_first};
use hapticbillard::table::{Bed, Table};
use hapticbillard::tick::{Delivered, Participant};
use hapticbillard::units::Tick;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

const BED: Bed = Bed { length_m: 3.569, width_m: 1.778 };
const R: f64 = SNOOKER_RADIUS_M;
const SIGHT: Sight = Sight { bed: BED, spots: Spots::Snooker, radius_m: R };
const YELLOW: BallId = BallId(16);
const GREEN: BallId = BallId(17);
const BROWN: BallId = BallId(18);
const BLUE: BallId = BallId(19);
const PINK: BallId = BallId(20);
const BLACK: BallId = BallId(21);
const COLOURS: [BallId; 6] = [YELLOW, GREEN, BROWN, BLUE, PINK, BLACK];

fn own(ball: BallId) -> DVec2 {
    Spots::Snooker.of(&BED, ball)
}

fn place(ball: BallId, occupied: &[DVec2]) -> DVec2 {
    let occupied: Vec<_> = occupied.iter().map(|at| (BallId(1), *at, R)).collect();
    Spots::Snooker.place(&BED, ball, BallId::CUE, &occupied, R)
}

fn spot<const N: usize>(balls: [BallId; N]) -> Command {
    Command::SpotBalls(Spotting { balls: balls.into_iter().collect(), cue_ball: BallId::CUE })
}

/// WPBSA: the numbers of the rules, in millimetres, to the rounding of the inch.
#[test]
fn line_d_and_spots_lie_where_the_rules_say() {
    let near = |value: f64, rule: f64| assert!((value - rule).abs() < 0.5e-3, "{value} {rule}");
    near(BED.baulk_line_x() + 0.5 * BED.length_m, 0.737);
    near(BED.d_radius_m(), 0.292);
    near(0.5 * BED.length_m - own(BLACK).x, 0.324);
    near(own(PINK).x, 0.25 * BED.length_m);
    assert_eq!(own(BLUE), DVec2::ZERO);
    assert_eq!(own(BROWN), DVec2::new(BED.baulk_line_x(), 0.0));
    // Seen from the baulk end, yellow is on the right: y runs to the left.
    near(own(YELLOW).y, -0.292);
    near(own(GREEN).y, 0.292);
}

#[test]
fn the_d_is_a_half_circle_behind_the_line() {
    let (x, radius) = (BED.baulk_line_x(), BED.d_radius_m());
    let inside = |dx: f64, dy: f64| BED.in_zone(Zone::D, DVec2::new(x + dx, dy));
    assert!(inside(0.0, 0.0) && inside(0.0, radius) && inside(-radius, 0.0));
    assert!(inside(-0.7 * radius, 0.7 * radius));
    assert!(!inside(0.001, 0.0) && !inside(-0.001, radius) && !inside(-1.01 * radius, 0.0));
    assert!(!inside(-0.72 * radius, 0.72 * radius));
    assert!(BED.in_zone(Zone::D, BED.home(Zone::D)));
}

#[test]
fn the_rack_has_its_colours_on_their_spots_and_its_apex_behind_the_pink() {
    let table = Table { bed: Some(BED), ..Table::default() };
    for seed in 0..50 {
        let balls = Rack::snooker(seed).place(&table).unwrap();
        assert_eq!(balls.len(), 22);
        assert_eq!(overlaps(&balls), None, "seed {seed}");
        let at = |id: BallId| balls[usize::from(id.0)].1.position.truncate();
        assert!(balls.iter().all(|(ball, state)| {
            ball.radius_m == R && state.position.z == R && BED.holds(state.position.truncate(), R)
        }));
        assert!(COLOURS.iter().all(|colour| at(*colour) == own(*colour)));
        let gap = at(BallId(1)).distance(own(PINK)) - 2.0 * R;
        assert!(0.0 < gap && gap <= 4.0 * JITTER_MAX_M, "{gap}");
        assert!((1..=15).all(|id| at(BallId(id)).x > own(PINK).x + 1.9 * R));
        assert!(BED.in_zone(Zone::D, at(BallId::CUE)));
    }
}

#[test]
fn a_colour_goes_to_its_own_spot_or_the_highest_free_one() {
    assert!(COLOURS.iter().all(|colour| place(*colour, &[]) == own(*colour)));
    // A hair beside the spot is on it.
    assert_eq!(place(YELLOW, &[own(YELLOW) + DVec2::X * (2.0 * R - 1e-6)]), own(BLACK));
    assert_eq!(place(YELLOW, &[own(YELLOW) + DVec2::X * (2.0 * R + 1e-6)]), own(YELLOW));
    assert_eq!(place(YELLOW, &[own(YELLOW), own(BLACK)]), own(PINK));
    assert_eq!(place(BLACK, &[own(BLACK), own(PINK), own(BLUE)]), own(BROWN));
}

#[test]
fn a_colour_without_a_spot_lies_towards_the_top_cushion_or_else_away_from_it() {
    let all = COLOURS.map(own).to_vec();
    for colour in COLOURS {
        let at = place(colour, &all);
        assert_eq!(at.y, own(colour).y);
        assert!((at.x - own(colour).x - 2.0 * R).abs() < 2e-6, "{colour}: {at}");
    }
    // Reds fill the way from the black to the top cushion.
    let mut full = all;
    full.extend((1..6).map(|i| own(BLACK) + DVec2::X * (2.0 * R * f64::from(i))));
    let at = place(BLACK, &full);
    assert!((own(BLACK).x - at.x - 2.0 * R).abs() < 2e-6, "{at}");
}

#[test]
fn colours_with_free_spots_are_spotted_first_then_the_highest() {
    let order = |balls: &[BallId], occupied: &[DVec2]| {
        let occupied: Vec<_> = occupied.iter().map(|at| (BallId(1), *at, R)).collect();
        Spots::Snooker.in_order(&BED, balls, &occupied, R).to_vec()
    };
    assert_eq!(order(&[YELLOW, BLACK, BLUE], &[]), [BLACK, BLUE, YELLOW]);
    assert_eq!(order(&[BLACK, PINK], &[own(BLACK)]), [PINK, BLACK]);
    let both = [own(BLACK), own(GREEN)];
    assert_eq!(order(&[GREEN, BLACK, YELLOW], &both), [YELLOW, BLACK, GREEN]);
    // Pool knows no order.
    let pool = Spots::Foot.in_order(&BED, &[BallId(2), BallId(9), BallId(1)], &[], R);
    assert_eq!(pool.to_vec(), [2, 9, 1].map(BallId));
}

/// Both solvers spot a list of colours as the pure function says, one after the other.
#[test]
fn both_solvers_spot_colours_by_the_rule() {
    let table = Table { bed: Some(BED), spots: Spots::Snooker, ..Table::plane() };
    let ball = |id: BallId, at: DVec2| (Ball::snooker(id), BallState::at_rest(id, at.extend(R)));
    for solver in [SolverKind::EventDriven, SolverKind::FixedStep] {
        // A red on the black's spot; the colours lie elsewhere.
        let balls = vec![
            ball(BallId::CUE, DVec2::new(-1.0, 0.5)),
            ball(BallId(1), own(BLACK)),
            ball(PINK, DVec2::new(0.2, 0.6)),
            ball(BLACK, DVec2::new(0.2, 0.4)),
            ball(YELLOW, DVec2::new(0.2, 0.2)),
        ];
        let settings = PhysicsSettings { solver, ..PhysicsSettings::default() };
        let mut simulation = Simulation::from_parts(&table, balls, &settings).unwrap();
        simulation.apply(0.0, &spot([BLACK, PINK, YELLOW])).unwrap();
        simulation.advance(0.1, FactSet::NONE, &mut Vec::new()).unwrap();
        let at = |id| simulation.sample(id, 0.1).unwrap().position.truncate();
        assert_eq!(at(PINK), own(PINK), "{solver:?}");
        assert_eq!(at(YELLOW), own(YELLOW), "{solver:?}");
        assert_eq!(at(BLACK), own(BLUE), "the highest free spot; {solver:?}");
    }
}

fn is_red(ball: BallId) -> bool {
    BallOn::Red.is(ball)
}

fn snookered(from: From, balls: &[(u16, f64, f64)]) -> bool {
    let balls: Vec<_> = balls.iter().map(|(id, x, y)| (BallId(*id), DVec2::new(*x, *y))).collect();
    SIGHT.is_snookered(from, &balls, is_red)
}

#[test]
fn who_sees_one_ball_on_from_edge_to_edge_is_not_snookered() {
    let here = From::Here(DVec2::new(-0.5, 0.0));
    assert!(!snookered(here, &[(1, 0.5, 0.0)]));
    assert!(snookered(here, &[(1, 0.5, 0.0), (21, 0.0, 0.0)]), "in the way");
    assert!(snookered(here, &[(1, 0.5, 0.0), (21, 0.0, 2.5 * R)]), "one edge is hidden");
    assert!(!snookered(here, &[(1, 0.5, 0.0), (21, 0.0, 3.2 * R)]), "beside the way");
    assert!(!snookered(here, &[(1, 0.5, 0.0), (2, 0.0, 0.0)]), "a ball on hides nothing");
    assert!(!snookered(here, &[(1, 0.5, 0.0), (21, 0.0, 0.0), (2, 0.5, 0.5)]), "another is free");
    assert!(!snookered(here, &[(1, 0.5, 0.0), (21, 1.0, 0.0)]), "behind the ball on");
    assert!(!snookered(here, &[(1, 0.5, 0.0), (21, -0.5 - 2.0 * R, 0.0)]), "behind the cue ball");
    assert!(!snookered(here, &[(1, -0.5 + 2.0 * R, 0.0), (21, 0.0, 0.0)]), "a ball on is touched");
    assert!(!snookered(here, &[(21, 0.0, 0.0)]), "nothing is on");
}

/// Steps along both edges with a distance at each, where the function solves.
#[test]
fn sight_agrees_with_a_ball_that_is_pushed_along_both_edges() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let mut counts = [0; 2];
    for _ in 0..3000 {
        let mut draw = || DVec2::new(rng.random_range(-1.0..1.0), rng.random_range(-0.8..0.8));
        let (cue, on) = (draw(), draw());
        let others: Vec<DVec2> = (0..6).map(|_| draw()).collect();
        let way = on - cue;
        if way.length() < 3.0 * R || others.iter().any(|o| o.distance(cue) < 2.0 * R) {
            continue;
        }
        let turn = libm::asin(2.0 * R / way.length());
        let mut nearest = f64::INFINITY;
        for side in [-turn, turn] {
            let along = DVec2::from_angle(side).rotate(way.normalize());
            let steps = 4000;
            for k in 0..=steps {
                let at = cue + along * way.dot(along) * (f64::from(k) / f64::from(steps));
                nearest = others.iter().map(|o| o.distance(at)).fold(nearest, f64::min);
            }
        }
        // Too near to call for steps of half a millimetre.
        if (nearest - 2.0 * R).abs() < 1e-4 {
            continue;
        }
        let mut balls = vec![(BallId(1), on)];
        balls.extend(others.iter().zip(COLOURS).map(|(at, id)| (id, *at)));
        let found = SIGHT.is_snookered(From::Here(cue), &balls, is_red);
        assert_eq!(found, nearest < 2.0 * R, "{cue} {balls:?}");
        counts[usize::from(found)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 300), "{counts:?}");
}

#[test]
fn from_the_d_a_ball_is_hidden_only_if_it_is_so_from_everywhere() {
    // A colour right in front of the red hides it from the whole D, one farther off does not.
    assert!(snookered(From::D, &[(1, 1.5, 0.0), (21, 1.5 - 2.0 * R - 1e-4, 0.0)]));
    assert!(!snookered(From::D, &[(1, 1.5, 0.0), (21, 0.0, 0.0)]));
    assert!(!snookered(From::D, &[(1, 1.5, 0.0)]));
}

fn fact(text: &str) -> Fact {
    serde_json::from_str(text).expect("a test writes facts as rule files do")
}

fn on_table(balls: impl IntoIterator<Item = u16>) -> State {
    let on_table = balls.into_iter().map(BallId).collect();
    State { on_table, on: Some(BallOn::Red), ..State::default() }
}

fn started(state: State) -> Referee {
    let mut referee = Referee::resume(GameKind::Snooker, state);
    referee.begin([]);
    referee
}

fn shot(referee: &mut Referee, between: &[&str]) -> Vec<Event> {
    let mut said = referee.handle(&fact(r#"{"t":0,"e":"tip","ball":"0"}"#)).to_vec();
    for text in between {
        said.extend(referee.handle(&fact(text)));
    }
    said.extend(referee.handle(&fact(r#"{"t":9,"e":"settle"}"#)));
    said
}

fn turn(said: &[Event]) -> &Turn {
    match said.last() {
        Some(Event::Turn(turn)) => turn,
        other => panic!("a turn was awaited, not {other:?}"),
    }
}

fn verdict(said: &[Event]) -> &Verdict {
    match said.first() {
        Some(Event::Verdict(verdict)) => verdict,
        other => panic!("a verdict was awaited, not {other:?}"),
    }
}

const MISS: &str = r#"{"t":1,"e":"hit","a":"0","b":"21"}"#;
const BLACK_FELL: &str = r#"{"t":2,"e":"pocket","ball":"21","pocket":"FL"}"#;

#[test]
fn colours_are_spotted_before_the_choice() {
    let mut referee = started(on_table([1, 2, 16, 17, 18, 19, 20, 21]));
    let said = shot(&mut referee, &[MISS, BLACK_FELL]);
    assert_eq!(said[1], Event::Command(spot([BLACK])));
    assert!(turn(&said).on_table.contains(&BLACK));
    assert_eq!(referee.phase(), Phase::Choosing);
}

#[test]
fn after_a_miss_the_balls_may_be_put_back() {
    let mut state = on_table([1, 2, 16, 17, 18, 19, 20, 21]);
    state.on = Some(BallOn::Colour);
    state.ball_in_hand = BallInHand::None;
    let mut referee = started(state.clone());
    let fell = r#"{"t":2,"e":"pocket","ball":"1","pocket":"FL"}"#;
    let met_red = r#"{"t":1,"e":"hit","a":"0","b":"1"}"#;
    let said = shot(&mut referee, &[met_red, fell]);
    assert_eq!(verdict(&said).options.as_slice(), [Choice::Play, Choice::AskAgain]);
    let options = [Choice::Play, Choice::AskAgain, Choice::PutBack];
    assert_eq!(turn(&said).options.as_slice(), options);
    assert_eq!(turn(&said).player, PlayerId::TWO);
    assert_eq!(turn(&said).score.unwrap().of(PlayerId::TWO), 7);

    let ask = |choice| {
        let mut referee = referee.clone();
        let said = referee.obey(Source::Input, &Command::Choose(choice)).to_vec();
        (said.clone(), turn(&said).clone())
    };
    let (said, back) = ask(Choice::PutBack);
    assert_eq!(said[0], Event::Command(Command::Undo));
    assert_eq!((back.player, back.on), (PlayerId::ONE, Some(BallOn::Colour)));
    assert_eq!(back.on_table, state.on_table, "the red is back");
    assert_eq!(back.score.unwrap().of(PlayerId::TWO), 7, "the penalty stays");
    assert!(back.options.is_empty() && back.calls.ball);

    // That physics tells where the cue ball lies again is no placement of the offender.
    let mut returned = referee.clone();
    returned.obey(Source::Input, &Command::Choose(Choice::PutBack));
    let lies = fact(r#"{"t":9,"e":"place","ball":"0","zone":"anywhere","ok":true}"#);
    assert!(returned.handle(&lies).is_empty());
    let met_blue = r#"{"t":1,"e":"hit","a":"0","b":"19"}"#;
    assert!(verdict(&shot(&mut returned, &[met_blue])).legal);

    let (said, again) = ask(Choice::AskAgain);
    assert_eq!(said.len(), 1);
    assert_eq!((again.player, again.on), (PlayerId::ONE, Some(BallOn::Red)));
    assert!(!again.on_table.contains(&BallId(1)), "the red stays down");
    let (_, play) = ask(Choice::Play);
    assert_eq!((play.player, play.on), (PlayerId::TWO, Some(BallOn::Red)));
}

#[test]
fn a_free_ball_is_the_others_and_not_the_offenders() {
    let mut referee = started(on_table([1, 2, 16, 17, 18, 19, 20, 21]));
    referee.handle(&fact(r#"{"t":0,"e":"tip","ball":"0"}"#));
    referee.handle(&fact(MISS));
    let said = referee.handle(&fact(r#"{"t":9,"e":"settle","snookered":true}"#)).to_vec();
    assert!(verdict(&said).free_ball && turn(&said).free_ball);
    let ask = |choice| {
        let mut referee = referee.clone();
        turn(&referee.obey(Source::Input, &Command::Choose(choice))).clone()
    };
    let play = ask(Choice::Play);
    assert!(play.free_ball && play.calls.ball);
    assert_eq!(play.legal_first, play.on_table, "any ball may be nominated");
    let again = ask(Choice::AskAgain);
    assert!(!again.free_ball && !again.calls.ball);
    assert_eq!(again.legal_first.as_slice(), [1, 2].map(BallId));
}

#[test]
fn no_miss_is_called_without_one_or_where_a_player_needs_penalties() {
    let options = |state: &State, between: &[&str]| {
        turn(&shot(&mut started(state.clone()), between)).options.len()
    };
    let state = on_table([1, 16, 17, 18, 19, 20, 21]);
    assert_eq!(options(&state, &[MISS]), 3);
    // A red is met first: a foul, but no miss.
    let met = r#"{"t":1,"e":"hit","a":"0","b":"1"}"#;
    assert_eq!(options(&state, &[met, BLACK_FELL]), 2);
    // A red, a black and all colours: 35 points are left.
    let mut behind = state.clone();
    behind.score.one = 35;
    assert_eq!(options(&behind, &[MISS]), 2, "nobody could win any more");
    behind.score.one = 34;
    assert_eq!(options(&behind, &[MISS]), 3);
    behind.score = State::default().score;
    behind.score.two = 28;
    assert_eq!(options(&behind, &[MISS]), 2, "and so after the penalty");
}

/// In every state what is announced as on can be met without a foul, and nothing else.
#[test]
fn whoever_may_be_hit_first_is_hit_without_a_foul_and_nobody_else() {
    let sets: [&[u16]; 4] =
        [&[1, 2, 16, 17, 18, 19, 20, 21], &[16, 17, 18, 19, 20, 21], &[20, 21], &[21]];
    for balls in sets {
        for on in [BallOn::Red, BallOn::Colour, BallOn::Ball(BallId(balls[0])), BallOn::Ball(BLACK)]
        {
            for free_ball in [false, true] {
                let mut state = on_table(balls.iter().copied());
                (state.on, state.free_ball) = (Some(on), free_ball);
                let legal = legal_first(GameKind::Snooker, &state);
                for ball in state.on_table.clone() {
                    let hit = format!(r#"{{"t":1,"e":"hit","a":"0","b":"{ball}"}}"#);
                    let said = shot(&mut started(state.clone()), &[&hit]);
                    let is_legal = verdict(&said).legal;
                    assert_eq!(is_legal, legal.contains(&ball), "{on:?} {free_ball} {ball}");
                }
            }
        }
    }
}

/// The referee of a game on a table sees for itself whether a foul snookers: colours that return
/// to their spots included, and from the D where the cue ball is gone.
#[test]
fn the_referee_sees_who_is_snookered() {
    let balls = |cue: Option<DVec2>, red: DVec2, black: Option<DVec2>| {
        let mut balls = Vec::new();
        for (id, at) in [(BallId::CUE, cue), (BallId(1), Some(red)), (BLACK, black)] {
            let mut ball = BallState::at_rest(id, at.unwrap_or_default().extend(R));
            if at.is_none() {
                ball.place = BallPlace::Pocketed;
            }
            balls.push(ball);
        }
        Arc::new(Snapshot { balls, ..Snapshot::default() })
    };
    let free = |sight: bool, between: &[&str], table: Arc<Snapshot>| {
        let mut referee = Referee::resume(GameKind::Snooker, on_table([1, 21]));
        if sight {
            referee = referee.with_sight(SIGHT);
        }
        referee.begin([]);
        let facts = [&[r#"{"t":0,"e":"tip","ball":"0"}"#], between].concat();
        let settled = [r#"{"t":9,"e":"settle"}"#];
        let events: Arc<[Stamped]> = facts
            .iter()
            .chain(&settled)
            .enumerate()
            .map(|(i, text)| {
                let stamp = Stamp { tick: Tick(1), source: Source::Physics, sequence: i as u64 };
                Stamped { stamp, event: Event::Fact(fact(text)) }
            })
            .collect();
        let outcome = referee.collect(&Delivered { tick: Tick(1), events, table });
        let said: Vec<Event> = outcome.publish.into_iter().map(|p| p.event).collect();
        verdict(&said).free_ball
    };
    let behind_black = own(BLACK) + DVec2::X * 6.0 * R;
    let (here, beside) = (Some(DVec2::ZERO), Some(behind_black + DVec2::Y * 0.5));
    let fell = [MISS, BLACK_FELL];
    assert!(free(true, &fell, balls(here, behind_black, None)), "the black returns into the way");
    assert!(!free(true, &fell, balls(beside, behind_black, None)), "and here it does not");
    assert!(!free(false, &fell, balls(here, behind_black, None)), "nobody looks");
    let on_spot = Some(own(BLACK));
    let hidden = own(BLACK) + DVec2::X * (2.0 * R + 1e-4);
    let scratch = [
        r#"{"t":1,"e":"hit","a":"0","b":"1"}"#,
        r#"{"t":2,"e":"pocket","ball":"0","pocket":"FL"}"#,
    ];
    assert!(free(true, &scratch, balls(None, hidden, on_spot)), "from everywhere in the D");
    assert!(!free(true, &scratch, balls(None, DVec2::new(1.0, 0.5), on_spot)));
    let clean = [r#"{"t":1,"e":"hit","a":"0","b":"1"}"#];
    assert!(!free(true, &clean, balls(here, behind_black, on_spot)), "without a foul never");
}

#[test]
fn the_table_is_closed_and_a_ball_rolls_through_every_mouth() {
    let table = Table::preset("snooker-12ft").unwrap();
    assert_eq!(table.mesh.open_edges(), []);
    assert!(table.mesh.volume() > 0.0);
    assert_eq!(table.bed, Some(BED));
    let cushions: Vec<[DVec3; 3]> = (0..table.mesh.faces.len())
        .filter(|i| matches!(table.mesh.faces[*i].surface, Surface::Cushion(_)))
        .map(|i| table.mesh.corners(i))
        .collect();
    for pocket in &table.pockets {
        let way = pocket.centre - pocket.target();
        let gap = |share: f64| {
            let at = (pocket.target() + way * share).extend(R);
            closest_point(&cushions, at).1 - R
        };
        let least = (-10..=10).map(|i| gap(f64::from(i) / 10.0)).fold(f64::INFINITY, f64::min);
        assert!((0.012..0.03).contains(&least), "{}: {least}", pocket.id);
    }
    let parts = table.display();
    assert!(parts.iter().all(|part| part.name != "diamonds" && !part.indices.is_empty()));
}

#[test]
fn balls_fall_into_all_pockets_of_the_table() {
    let table = Table::preset("snooker-12ft").unwrap();
    for pocket in table.pockets.clone() {
        let start = pocket.target() - 0.5 * pocket.heading;
        let state = BallState::at_rest(BallId::CUE, start.extend(R));
        let balls = vec![(Ball::snooker(BallId::CUE), state)];
        let settings = PhysicsSettings::default();
        let simulation = Simulation::from_parts(&table, balls, &settings).unwrap();
        let azimuth_deg = pocket.heading.to_angle().to_degrees();
        let strike = Strike { speed_m_s: 1.2, azimuth_deg, ..Strike::CENTRE };
        let shot = simulation.strike(strike).unwrap().run_until_rest().unwrap();
        let fell = shot.facts.iter().any(|fact| {
            matches!(fact.kind, FactKind::BallPocketed { pocket: found, .. } if found == pocket.id)
        });
        assert!(fell, "{}: {:?}", pocket.id, shot.facts);
    }
}
