//! Planning: what is in the way, where to meet a ball, which shot is cheapest.

use super::{BED, R, pockets, random_view, view};
use glam::{DVec2, dvec2};
use hapticbillard::ai::{
    CUT_LIMIT_RAD, Candidate, Goal, LineEnd, Plan, PlanKind, TableView2d, candidate, cost,
    is_blocked, placements, plan_shot, signed_angle, zone_holds,
};
use hapticbillard::events::{ShotKind, Zone};
use hapticbillard::ids::{BallId, PocketId};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

fn all(view: &TableView2d) -> Goal {
    let balls: Vec<_> = view.balls.iter().map(|ball| ball.id).collect();
    Goal { shot: ShotKind::Normal, own: balls.clone(), legal: balls }
}

fn plan_with(view: &TableView2d, goal: &Goal, f: f64) -> Plan {
    let cue = view.cue_ball.expect("the cue ball lies on the table");
    plan_shot(view, cue, goal, f, &mut Pcg64Mcg::seed_from_u64(1))
}

fn plan(view: &TableView2d) -> Plan {
    plan_with(view, &all(view), 0.0)
}

/// Written out without the crate's test: distance of a point to a segment.
fn distance_to_way(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let s = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    (a + s * (b - a)).distance(p)
}

#[test]
fn a_ball_blocks_between_the_ends_and_within_both_radii_only() {
    let (a, b) = (dvec2(0.0, 0.0), dvec2(1.0, 0.0));
    let blocked = |x, y| is_blocked(a, b, dvec2(x, y), 2.0 * R);
    assert!(blocked(0.5, 0.0) && blocked(0.5, 1.99 * R) && blocked(0.5, -1.99 * R));
    assert!(!blocked(0.5, 2.01 * R) && !blocked(0.5, -2.01 * R));
    assert!(blocked(0.001, 0.0) && !blocked(-0.001, 0.0));
    assert!(blocked(0.999, 0.0) && !blocked(1.001, 0.0));
    assert!(!is_blocked(a, a, a, 2.0 * R), "no way, nothing in it");
}

#[test]
fn straight_shot_meets_the_ball_on_the_line_to_the_pocket() {
    let pocket = pockets()[4];
    let ball = dvec2(0.6, 0.1);
    let way = (pocket.target() - ball).normalize();
    let table = view(ball - way * 0.5, &[(1, ball)]);
    let shot = candidate(&table, table.cue_ball.unwrap(), BallId(1), &pocket, 0.45).unwrap();
    assert!(shot.ghost.distance(ball - way * 2.0 * R) < 1e-12);
    assert!(shot.cut_rad.abs() < 1e-12 && shot.commanded_cut_rad.abs() < 1e-12);
}

#[test]
fn cut_is_commanded_steeper_by_the_throw_factor_on_both_sides() {
    let pocket = pockets()[4];
    let ball = dvec2(0.6, 0.1);
    let way = (pocket.target() - ball).normalize();
    for beside in [0.3, -0.3] {
        for f in [0.0, 0.07, 0.45] {
            let cue = ball - way * 0.6 + way.perp() * beside;
            let table = view(cue, &[(1, ball)]);
            let shot = candidate(&table, cue, BallId(1), &pocket, f).unwrap();
            let normal = (ball - shot.ghost) / (2.0 * R);
            assert!((normal.length() - 1.0).abs() < 1e-12, "the ghost touches the ball");
            let commanded = signed_angle(shot.direction, normal);
            let cut = signed_angle(shot.direction, way);
            assert!((commanded - (1.0 + f) * cut).abs() < 1e-4, "f {f}: {commanded} {cut}");
            assert!((commanded - shot.commanded_cut_rad).abs() < 1e-12);
            assert_eq!(cut.signum(), beside.signum(), "from the left it cuts to the left");
        }
    }
}

#[test]
fn thin_cuts_and_slanting_side_pockets_are_left_out() {
    let cut_of = |cue, ball, pocket: usize| {
        candidate(&view(cue, &[(1, ball)]), cue, BallId(1), &pockets()[pocket], 0.0)
    };
    // 80 degrees off the line to the foot left pocket.
    let ball = dvec2(0.8, 0.2);
    let way = (pockets()[4].target() - ball).normalize();
    let ghost = ball - way * 2.0 * R;
    let from = |degrees: f64| ghost - DVec2::from_angle(degrees.to_radians()).rotate(way) * 0.4;
    assert!(cut_of(from(65.0), ball, 4).is_some());
    assert!(cut_of(from(75.0), ball, 4).is_none());
    // Along the rail into the side pocket.
    let ball = dvec2(0.5, 0.55);
    assert!(cut_of(dvec2(0.8, 0.55), ball, 2).is_none());
}

#[test]
fn every_term_makes_a_shot_dearer() {
    let table = view(DVec2::ZERO, &[]);
    let degree = std::f64::consts::PI / 180.0;
    let of =
        |d1, d2, cut: f64, entry: f64, gap| cost(d1, d2, cut * degree, entry * degree, gap, &table);
    let base = of(0.5, 0.7, 20.0, 10.0, 0.4);
    assert!(of(0.6, 0.7, 20.0, 10.0, 0.4) > base, "longer way to the ball");
    assert!(of(0.5, 0.8, 20.0, 10.0, 0.4) > base, "longer way to the pocket");
    assert!(of(0.5, 0.7, 30.0, 10.0, 0.4) > base, "larger cut");
    assert!(of(0.5, 0.7, 20.0, 20.0, 0.4) > base, "more slanting pocket");
    assert!((of(0.5, 0.7, 20.0, 10.0, 0.9 * R) - base - 0.6).abs() < 1e-12, "too close");
    let follows = of(0.5, 0.3, 2.9, 0.0, 0.4) - of(0.5, 0.3, 3.1, 0.0, 0.4);
    assert!((follows - 0.4).abs() < 0.002, "cue ball follows");
    assert_eq!(of(0.5, 0.3, -20.0, 0.0, 0.4), of(0.5, 0.3, 20.0, 0.0, 0.4), "either side");
    let longest = of(1.27, 1.27, 60.0, 45.0, 1.0);
    assert!((longest - (1.0 + 1.5 + 0.8)).abs() < 1e-9, "the weights at their scales");
}

#[test]
fn the_easier_of_two_balls_is_played() {
    // Ball 1 needs a large cut, ball 2 is nearly straight into the side pocket.
    let table = view(dvec2(0.02, -0.3), &[(1, dvec2(0.9, -0.3)), (2, dvec2(0.0, 0.2))]);
    let plan = plan(&table);
    assert_eq!((plan.kind, plan.target), (PlanKind::Pot, Some(BallId(2))));
    assert_eq!(plan.pocket, Some(PocketId::Ml));
}

/// Every candidate of every pair, tested by an independent distance.
fn open_pots(table: &TableView2d) -> Vec<Candidate> {
    let cue = table.cue_ball.expect("the cue ball lies on the table");
    let mut open = Vec::new();
    for ball in &table.balls {
        for pocket in &table.pockets {
            let Some(shot) = candidate(table, cue, ball.id, pocket, 0.07) else { continue };
            let others = || table.balls.iter().filter(|other| other.id != ball.id);
            let free = others().all(|other| {
                distance_to_way(cue, shot.ghost, other.position) >= 2.0 * R
                    && distance_to_way(ball.position, shot.pocket_target, other.position) >= 2.0 * R
            });
            if free {
                open.push(shot);
            }
        }
    }
    open
}

#[test]
fn a_blocked_shot_is_never_played_when_an_open_one_exists() {
    let mut pots = 0;
    for seed in 0..400 {
        let table = random_view(seed, 2 + (seed % 14) as u16);
        let goal = all(&table);
        let plan = plan_with(&table, &goal, 0.07);
        let open = open_pots(&table);
        if open.is_empty() {
            continue;
        }
        pots += 1;
        assert_eq!(plan.kind, PlanKind::Pot, "seed {seed}");
        let best = open.iter().map(|shot| shot.cost).fold(f64::INFINITY, f64::min);
        assert!((plan.cost - best).abs() < 1e-12, "seed {seed}: {} {best}", plan.cost);
        assert!(plan.cut_rad.abs() <= CUT_LIMIT_RAD);
        assert!(0.5 < plan.speed_m_s && plan.speed_m_s <= 4.5);
        let chosen: Vec<_> = plan.lines.iter().filter(|line| line.chosen).collect();
        assert_eq!(chosen.len(), 2);
        assert!(chosen.iter().all(|line| line.free), "seed {seed}: {chosen:?}");
        assert_eq!(plan.lines.len(), goal.own.len() * 7);
    }
    assert!(pots > 200, "only {pots} tables with an open pot: the test says little");
}

#[test]
fn without_a_pot_the_nearest_reachable_ball_is_met_without_touching_another() {
    // Both own balls hide from every pocket behind a wall of others; ball 2 is nearer but covered.
    let table = view(
        dvec2(-0.6, 0.0),
        &[(1, dvec2(0.5, 0.3)), (2, dvec2(-0.2, 0.0)), (9, dvec2(-0.35, 0.0))],
    );
    let legal = vec![BallId(1), BallId(2)];
    let goal = Goal { shot: ShotKind::Normal, own: vec![], legal };
    let plan = plan_with(&table, &goal, 0.0);
    assert_eq!(plan.kind, PlanKind::Contact);
    let target = table.position(plan.target.unwrap()).unwrap();
    assert!((plan.ghost.distance(target) - 2.0 * R).abs() < 1e-9);
    for ball in table.balls.iter().filter(|ball| Some(ball.id) != plan.target) {
        assert!(distance_to_way(plan.cue_ball, plan.ghost, ball.position) >= 2.0 * R);
    }
}

#[test]
fn a_hidden_ball_is_kicked_at_by_one_cushion() {
    let mut balls = vec![(1, dvec2(0.25, 0.0))];
    // A fence between cue ball and ball.
    balls.extend((0..5).map(|i| (9 + i, dvec2(-0.25, (f64::from(i) - 2.0) * 2.05 * R))));
    let table = view(dvec2(-0.75, 0.0), &balls);
    let goal = Goal { shot: ShotKind::Normal, own: vec![BallId(1)], legal: vec![BallId(1)] };
    let plan = plan_with(&table, &goal, 0.0);
    assert_eq!((plan.kind, plan.target), (PlanKind::Kick, Some(BallId(1))));
    // In and out at the same angle: half way over, the middle touches the cushion.
    let bounce = plan.cue_ball + plan.direction * (0.5 / plan.direction.x);
    assert!((bounce.y.abs() - (0.5 * BED.width_m - R)).abs() < 1e-9, "{bounce}");
}

#[test]
fn whatever_is_on_the_table_something_is_played() {
    let empty = view(dvec2(0.1, 0.2), &[]);
    assert_eq!(plan(&empty).kind, PlanKind::Desperate);
    // Walled in on all sides.
    let ring = (0..6).map(|i| {
        let angle = f64::from(i) * std::f64::consts::FRAC_PI_3;
        (9 + i as u16, DVec2::from_angle(angle) * 2.02 * R)
    });
    let balls: Vec<_> = [(1, dvec2(0.6, 0.0))].into_iter().chain(ring).collect();
    let table = view(DVec2::ZERO, &balls);
    let goal = Goal { shot: ShotKind::Normal, own: vec![BallId(1)], legal: vec![BallId(1)] };
    let plan = plan_with(&table, &goal, 0.0);
    assert_eq!((plan.kind, plan.target), (PlanKind::Desperate, Some(BallId(1))));
    assert!(plan.direction.is_normalized() && plan.speed_m_s > 0.0);
}

#[test]
fn the_break_is_full_at_the_apex_ball() {
    let foot = BED.foot_spot();
    let rack: Vec<_> = (0..5_u16)
        .flat_map(|row| (0..=row).map(move |i| (row, i)))
        .enumerate()
        .map(|(n, (row, i))| {
            let (row, i) = (f64::from(row), f64::from(i));
            (n as u16 + 1, foot + dvec2(row * 1.733 * R, (2.0 * i - row) * 1.001 * R))
        })
        .collect();
    let table = view(dvec2(-0.7, 0.2), &rack);
    let goal = Goal { shot: ShotKind::Break, ..all(&table) };
    let plan = plan_with(&table, &goal, 0.07);
    assert_eq!((plan.kind, plan.target), (PlanKind::Break, Some(BallId(1))));
    assert!(plan.direction.perp_dot(foot - plan.cue_ball).abs() < 1e-12);
    let ball_speed = plan.speed_m_s * hapticbillard::ai::BALL_PER_TIP_SPEED;
    assert!((7.0..9.0).contains(&ball_speed), "{ball_speed} m/s");
    let spots = placements(&table, Zone::Kitchen, &goal, 0.07, &mut Pcg64Mcg::seed_from_u64(3));
    assert!(!spots.is_empty());
    assert!(spots.iter().all(|spot| spot.x < BED.head_string_x() && table.has_room(*spot)));
}

#[test]
fn placements_are_legal_on_200_tables_and_mostly_offer_a_pot() {
    let mut with_pot = 0;
    for seed in 0..200 {
        let table = random_view(1000 + seed, 1 + (seed % 15) as u16);
        let zone = [Zone::Anywhere, Zone::Kitchen, Zone::D][(seed % 3) as usize];
        let goal = all(&table);
        let spots = placements(&table, zone, &goal, 0.07, &mut Pcg64Mcg::seed_from_u64(seed));
        assert!(!spots.is_empty(), "seed {seed}");
        for &spot in &spots {
            assert!(zone_holds(zone, &BED, spot), "seed {seed}: {spot} outside {zone:?}");
            assert!(BED.holds(spot, R), "seed {seed}: {spot} off the bed");
            let nearest =
                table.balls.iter().map(|ball| ball.position.distance(spot)).fold(1.0, f64::min);
            assert!(nearest > 2.0 * R, "seed {seed}: {spot} on a ball");
        }
        let plan = plan_shot(&table, spots[0], &goal, 0.07, &mut Pcg64Mcg::seed_from_u64(1));
        if zone == Zone::Anywhere {
            with_pot += u32::from(plan.kind == PlanKind::Pot);
        }
    }
    assert!(with_pot >= 65, "{with_pot} of 67 tables with the ball in hand anywhere");
}

#[test]
fn from_the_kitchen_balls_in_the_kitchen_are_not_met_first() {
    use hapticbillard::events::{BallInHand, Turn};
    use hapticbillard::ids::PlayerId;
    let table = view(dvec2(-0.9, 0.0), &[(1, dvec2(-1.0, 0.3)), (2, dvec2(0.4, 0.1))]);
    let turn = Turn {
        player: PlayerId::ONE,
        shot: ShotKind::Normal,
        ball_in_hand: BallInHand::Kitchen,
        groups: None,
        on_table: [BallId(1), BallId(2)].into_iter().collect(),
        legal_first: [BallId(1), BallId(2)].into_iter().collect(),
        shot_number: 3,
        ..Turn::default()
    };
    assert_eq!(Goal::of(&turn, &table, Some(Zone::Kitchen)).legal, [BallId(2)]);
    assert_eq!(Goal::of(&turn, &table, Some(Zone::Anywhere)).legal.len(), 2);
}

#[test]
fn lines_tell_free_from_blocked() {
    let table = view(
        dvec2(-0.5, 0.0),
        &[(1, dvec2(0.5, 0.0)), (2, dvec2(-0.2, 0.3)), (9, dvec2(0.0, 0.0))],
    );
    let goal = Goal { own: vec![BallId(1), BallId(2)], ..all(&table) };
    let plan = plan_with(&table, &goal, 0.0);
    let free = |ball| {
        let mut to_ball = plan.lines.iter().filter(|line| line.end == LineEnd::Ball(BallId(ball)));
        to_ball.next().unwrap().free
    };
    assert!(!free(1) && free(2));
}
