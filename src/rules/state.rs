//! What a game must remember from shot to shot, and which games there are.

use super::shot::{Shot, hash_list};
use crate::events::{BallInHand, Groups, ShotKind, TurnAfter, Verdict, Zone};
use crate::hash::StateHash;
use crate::ids::{BallId, GameKind, PlayerId};
use serde::{Deserialize, Deserializer, Serialize, de::Error};
use smallvec::SmallVec;

/// The table and the game before a shot, as far as rules need it.
///
/// JSON: the `state` of a rule scenario. Fields that are absent are none, empty, false or 0;
/// fields of games that are not known here are ignored.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct State {
    /// What kind of shot comes next.
    pub shot: ShotKind,
    /// Who shoots.
    #[serde(deserialize_with = "one_of_two")]
    pub player: PlayerId,
    /// Who plays which group; none where a game has none.
    pub groups: Option<Groups>,
    /// Object balls on the table, in ascending order.
    #[serde(deserialize_with = "ascending")]
    pub on_table: SmallVec<[BallId; 16]>,
    /// Where the cue ball may be put.
    pub ball_in_hand: BallInHand,
    /// Turns in a row, of both players together, in which no object ball was pocketed.
    pub dry_turns: u32,
    /// An object ball was pocketed earlier in this very turn, so that it cannot be a dry one.
    #[serde(skip_serializing_if = "is_false")]
    pub pocketed_this_turn: bool,
}

impl Default for State {
    fn default() -> Self {
        State {
            shot: ShotKind::Normal,
            player: PlayerId::ONE,
            groups: None,
            on_table: SmallVec::new(),
            ball_in_hand: BallInHand::None,
            dry_turns: 0,
            pocketed_this_turn: false,
        }
    }
}

fn is_false(flag: &bool) -> bool {
    !*flag
}

fn one_of_two<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PlayerId, D::Error> {
    match PlayerId::deserialize(deserializer)? {
        player @ (PlayerId::ONE | PlayerId::TWO) => Ok(player),
        other => Err(D::Error::custom(format!("player {other}: expected 1 or 2"))),
    }
}

fn ascending<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<SmallVec<[BallId; 16]>, D::Error> {
    let mut balls = SmallVec::deserialize(deserializer)?;
    balls.sort_unstable();
    balls.dedup();
    Ok(balls)
}

impl State {
    /// The state before the first shot of a game, with these balls on the table. In eight-ball the
    /// cue ball is in hand behind the head string, wherever it lies; in free play it is played
    /// from where it lies, and in hand anywhere if it is not on the table.
    pub fn opening(
        game: GameKind,
        player: PlayerId,
        on_table: impl IntoIterator<Item = BallId>,
    ) -> Self {
        let mut on_table: SmallVec<[BallId; 16]> = on_table.into_iter().collect();
        on_table.sort_unstable();
        on_table.dedup();
        let has_cue_ball = on_table.contains(&BallId::CUE);
        on_table.retain(|ball| *ball != BallId::CUE);
        let (groups, ball_in_hand) = match game {
            GameKind::PaperEightBall => (Some(Groups::Open), BallInHand::Kitchen),
            GameKind::FreePlay if has_cue_ball => (None, BallInHand::None),
            GameKind::FreePlay => (None, BallInHand::Anywhere),
        };
        State { shot: ShotKind::Break, player, groups, on_table, ball_in_hand, ..State::default() }
    }

    /// Turns in a row without a pocketed object ball, once this shot is over. A turn counts when it
    /// ends; one in which a ball was pocketed starts the count anew.
    pub fn dry_turns_after(&self, shot: &Shot) -> u32 {
        if !shot.pocketed.is_empty() || self.pocketed_this_turn {
            0
        } else {
            self.dry_turns.saturating_add(1)
        }
    }

    /// Whether the cue ball may be put down in a zone.
    pub fn may_place_in(&self, zone: Zone) -> bool {
        match self.ball_in_hand {
            BallInHand::None => false,
            BallInHand::Anywhere => true,
            BallInHand::Kitchen => zone == Zone::Kitchen,
            BallInHand::D => zone == Zone::D,
        }
    }

    /// The object balls that a shot left on the table, before any is spotted.
    pub fn left_by(&self, shot: &Shot) -> SmallVec<[BallId; 16]> {
        let is_left = |ball: &BallId| !shot.has_pocketed(*ball) && !shot.off.contains(ball);
        self.on_table.iter().copied().filter(is_left).collect()
    }

    /// The state before the next shot.
    pub fn after(&self, shot: &Shot, verdict: &Verdict) -> State {
        let mut on_table = self.left_by(shot);
        on_table.extend(verdict.spot.iter().copied());
        on_table.sort_unstable();
        on_table.dedup();
        let pocketed = self.pocketed_this_turn || !shot.pocketed.is_empty();
        let turn_goes_on = verdict.turn == TurnAfter::Continue;
        State {
            shot: ShotKind::Normal,
            player: verdict.next_player.unwrap_or(self.player),
            groups: verdict.groups,
            on_table,
            ball_in_hand: verdict.ball_in_hand,
            dry_turns: match turn_goes_on && !pocketed {
                true => self.dry_turns,
                false => self.dry_turns_after(shot),
            },
            pocketed_this_turn: pocketed && turn_goes_on,
        }
    }

    /// Adds everything to `hash`.
    pub fn hash_into(&self, hash: &mut StateHash) {
        hash.u64(self.shot as u64);
        hash.u64(self.player.0.into());
        hash.u64(match self.groups {
            None => 0,
            Some(Groups::Open) => 1,
            Some(Groups::Assigned { one }) => 2 + one as u64,
        });
        hash_list(hash, self.on_table.iter().map(|ball| ball.0.into()));
        hash.u64(self.ball_in_hand as u64);
        hash.u64(self.dry_turns.into());
        hash.u64(self.pocketed_this_turn.into());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_game_is_found_by_both_its_names_and_others_are_refused() {
        for game in GameKind::ALL {
            assert_eq!(game.id().parse(), Ok(game));
            assert_eq!(game.short_id().parse(), Ok(game));
        }
        let error = "wpa8".parse::<GameKind>().unwrap_err().to_string();
        assert_eq!(
            error,
            "unknown game 'wpa8'; the games are 'paper-eight-ball' (short 'paper8'), \
             'free-play' (short 'free_play')"
        );
    }

    #[test]
    fn absent_fields_of_a_state_are_empty() {
        let state: State = serde_json::from_str("{}").unwrap();
        assert_eq!(state, State::default());
        let error = serde_json::from_str::<State>(r#"{"player":3}"#).unwrap_err();
        assert!(error.to_string().contains("expected 1 or 2"), "{error}");
    }
}
