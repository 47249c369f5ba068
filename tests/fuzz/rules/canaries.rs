//! Each of these judges is wrong in one point; if the account did not notice, it would be blind.

use super::play::play;
use hapticbillard::events::{Groups, TurnAfter, Verdict};
use hapticbillard::ids::BallId;
use hapticbillard::rules::{GameKind, Judge, Shot, State, game, judge};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

#[test]
fn a_wrong_judge_is_found_out() {
    for (kind, wrong) in [(GameKind::PaperEightBall, &PAPER[..]), (GameKind::WpaEightBall, &WPA)] {
        assert_eq!(found_out(kind, game(kind).judge), None);
        for (name, judge) in wrong {
            assert!(found_out(kind, *judge).is_some(), "{kind}: nobody noticed: {name}");
        }
    }
}

fn found_out(kind: GameKind, judge: Judge) -> Option<String> {
    (1..=60).find_map(|seed| play(kind, judge, &mut Pcg64Mcg::seed_from_u64(seed)).err())
}

const PAPER: [(&str, Judge); 7] = [
    ("the fouling player goes on", |state, call, shot| {
        let verdict = judge(GameKind::PaperEightBall, state, call, shot);
        match verdict.turn {
            TurnAfter::Pass => Verdict { next_player: Some(state.player), ..verdict },
            _ => verdict,
        }
    }),
    ("a scratch is none", |state, call, shot| {
        let shot = Shot { cue_pocketed: false, ..shot.clone() };
        judge(GameKind::PaperEightBall, state, call, &shot)
    }),
    ("groups are assigned anew", |state, call, shot| {
        let open = State { groups: Some(Groups::Open), ..state.clone() };
        let verdict = judge(GameKind::PaperEightBall, state, call, shot);
        let anew = judge(GameKind::PaperEightBall, &open, call, shot);
        Verdict { groups: anew.groups, ..verdict }
    }),
    ("any pocketed ball is spotted", |state, call, shot| {
        let verdict = judge(GameKind::PaperEightBall, state, call, shot);
        Verdict { spot: verdict.pocketed.clone(), ..verdict }
    }),
    ("there is no draw", |state, call, shot| {
        let state = State { dry_turns: 0, ..state.clone() };
        judge(GameKind::PaperEightBall, &state, call, shot)
    }),
    ("the 8 loses on the break too", |state, call, shot| {
        let verdict = judge(GameKind::PaperEightBall, state, call, shot);
        match verdict.pocketed.contains(&BallId::EIGHT) {
            true => Verdict {
                turn: TurnAfter::End,
                next_player: None,
                winner: Some(state.player.other()),
                ..verdict
            },
            false => verdict,
        }
    }),
    ("of two at the same time the first told is met first", |state, call, shot| {
        let mut shot = shot.clone();
        shot.first_contacts.truncate(1);
        judge(GameKind::PaperEightBall, state, call, &shot)
    }),
];

const WPA: [(&str, Judge); 4] = [
    ("nobody chooses", |state, call, shot| {
        let verdict = judge(GameKind::WpaEightBall, state, call, shot);
        Verdict { chooser: None, ..verdict }
    }),
    ("a scratch leaves the cue ball where it is", |state, call, shot| Verdict {
        ball_in_hand: Default::default(),
        ..judge(GameKind::WpaEightBall, state, call, shot)
    }),
    ("the 2 is spotted", |state, call, shot| Verdict {
        spot: [BallId(2)].into_iter().collect(),
        ..judge(GameKind::WpaEightBall, state, call, shot)
    }),
    ("a win goes on", |state, call, shot| {
        let verdict = judge(GameKind::WpaEightBall, state, call, shot);
        match verdict.turn {
            TurnAfter::End => {
                let next_player = Some(state.player);
                Verdict { turn: TurnAfter::Continue, next_player, ..verdict }
            }
            _ => verdict,
        }
    }),
];
