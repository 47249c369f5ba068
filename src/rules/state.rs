//! What a game must remember from shot to shot, and which games there are.

use super::games::game;
use super::shot::{Shot, hash_list};
use crate::events::{
    BallInHand, BallOn, ByPlayer, Choice, Groups, Racked, ShotKind, TurnAfter, Verdict, Zone,
};
use crate::hash::StateHash;
use crate::ids::{BallId, GameKind, PlayerId};
use serde::{Deserialize, Deserializer, Serialize, de::Error};
use smallvec::SmallVec;

/// The table and the game before a shot, as far as rules need it.
///
/// JSON: the `state` of a rule scenario. Fields that are absent are none, empty, false or 0;
/// fields of games that are not known here are ignored.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
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
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub pocketed_this_turn: bool,
    /// Who broke this rack.
    #[serde(skip_serializing_if = "is_one", deserialize_with = "one_of_two")]
    pub breaker: PlayerId,
    /// Fouls in a row, where a game counts them.
    #[serde(skip_serializing_if = "ByPlayer::is_nothing")]
    pub fouls: ByPlayer<u8>,
    /// The player was told that the next foul is the third in a row.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub warned: bool,
    /// This is the shot right after a legal break.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub after_break: bool,
    /// Points, where a game has them.
    #[serde(skip_serializing_if = "ByPlayer::is_nothing")]
    pub score: ByPlayer<i32>,
    /// Snooker: what is on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<BallOn>,
    /// Snooker: the colour, or the free ball, that was nominated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nominated: Option<BallId>,
    /// Snooker: any ball may be nominated as if it were on.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub free_ball: bool,
    /// Snooker: what a miss left, for whoever may have it put back.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missed: Option<Box<Missed>>,
    /// The ball that the player strikes.
    #[serde(skip_serializing_if = "is_zero")]
    pub cue_ball: BallId,
    /// Balls that lie against the cue ball, where that matters.
    #[serde(skip_serializing_if = "SmallVec::is_empty", deserialize_with = "ascending")]
    pub frozen_to_cue: SmallVec<[BallId; 2]>,
    /// What the player must choose from before anybody shoots; nothing if there is no choice.
    #[serde(skip_serializing_if = "SmallVec::is_empty")]
    pub options: SmallVec<[Choice; 3]>,
    /// Nobody plays but this player.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_alone: bool,
}

/// What a shot began with that may be put back.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Missed {
    /// Object balls on the table, in ascending order.
    #[serde(deserialize_with = "ascending")]
    pub on_table: SmallVec<[BallId; 16]>,
    /// What was on.
    pub on: Option<BallOn>,
    /// Whether any ball could be nominated.
    pub free_ball: bool,
}

fn is_one(player: &PlayerId) -> bool {
    *player == PlayerId::ONE
}

fn is_zero(ball: &BallId) -> bool {
    ball.0 == 0
}

fn one_of_two<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PlayerId, D::Error> {
    match PlayerId::deserialize(deserializer)? {
        player @ (PlayerId::ONE | PlayerId::TWO) => Ok(player),
        other => Err(D::Error::custom(format!("player {other}: expected 1 or 2"))),
    }
}

fn ascending<'de, D: Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> Result<SmallVec<[BallId; N]>, D::Error>
where
    [BallId; N]: smallvec::Array<Item = BallId>,
{
    let mut balls: SmallVec<[BallId; N]> = SmallVec::deserialize(deserializer)?;
    balls.sort_unstable();
    balls.dedup();
    Ok(balls)
}

impl State {
    /// The state before the first shot of a game, with these balls on the table.
    pub fn opening(
        kind: GameKind,
        player: PlayerId,
        on_table: impl IntoIterator<Item = BallId>,
    ) -> Self {
        let mut on_table: SmallVec<[BallId; 16]> = on_table.into_iter().collect();
        on_table.sort_unstable();
        on_table.dedup();
        let has_cue_ball = on_table.contains(&BallId::CUE);
        on_table.retain(|ball| *ball != BallId::CUE);
        let shot = ShotKind::Break;
        let mut state = State { shot, player, breaker: player, on_table, ..State::default() };
        (game(kind).open)(&mut state, has_cue_ball);
        state
    }

    /// The state before another break of the same match by `player`: a full rack, what the match
    /// has counted so far.
    pub fn reopened(&self, kind: GameKind, player: PlayerId) -> Self {
        let balls = (0..=game(kind).balls).map(BallId);
        let (score, is_alone) = (self.score, self.is_alone);
        State { score, is_alone, ..State::opening(kind, player, balls) }
    }

    /// Whether this is the first shot of a rack.
    pub fn is_break(&self) -> bool {
        self.shot == ShotKind::Break
    }

    /// Whether the cue ball is played from behind the head string.
    pub fn is_in_kitchen(&self) -> bool {
        self.ball_in_hand == BallInHand::Kitchen
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

    /// The same, now that the player at the table was told how many fouls in a row he has. A
    /// program always tells.
    #[must_use]
    pub fn with_warning(self) -> Self {
        State { warned: self.fouls.of(self.player) >= 2, ..self }
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

    /// A hand has put an object ball on the table.
    pub fn bring_back(&mut self, ball: BallId) {
        if let Err(place) = self.on_table.binary_search(&ball) {
            self.on_table.insert(place, ball);
        }
    }

    /// The state before the next shot, or before the choice that decides it: then it is the
    /// chooser's turn.
    pub fn after(&self, shot: &Shot, verdict: &Verdict) -> State {
        let mut on_table = self.left_by(shot);
        on_table.extend(verdict.spotted_now().iter().copied());
        if verdict.rack == Some(Racked::Fourteen) {
            on_table.extend((1..=15).map(BallId));
        }
        on_table.sort_unstable();
        on_table.dedup();
        let pocketed = self.pocketed_this_turn || !shot.pocketed.is_empty();
        let turn_goes_on = verdict.turn == TurnAfter::Continue;
        let add = |player| self.score.of(player).saturating_add(verdict.points.of(player));
        State {
            shot: ShotKind::Normal,
            player: verdict.chooser.or(verdict.next_player).unwrap_or(self.player),
            groups: verdict.groups,
            on_table,
            ball_in_hand: verdict.ball_in_hand,
            dry_turns: match turn_goes_on && !pocketed {
                true => self.dry_turns,
                false => self.dry_turns_after(shot),
            },
            pocketed_this_turn: pocketed && turn_goes_on,
            fouls: verdict.fouls_after,
            score: ByPlayer { one: add(PlayerId::ONE), two: add(PlayerId::TWO) },
            on: verdict.ball_on_next,
            free_ball: verdict.free_ball,
            options: verdict.options.clone(),
            after_break: false,
            warned: false,
            nominated: None,
            missed: None,
            breaker: self.breaker,
            cue_ball: self.cue_ball,
            is_alone: self.is_alone,
            frozen_to_cue: SmallVec::new(),
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
        hash.u64(self.breaker.0.into());
        hash.u64(u64::from(self.fouls.one) << 8 | u64::from(self.fouls.two));
        for flag in [self.warned, self.after_break, self.free_ball] {
            hash.u64(flag.into());
        }
        hash.u64(i64::from(self.score.one) as u64);
        hash.u64(i64::from(self.score.two) as u64);
        hash.u64(code_of(self.on));
        hash.u64(self.nominated.map_or(0, |ball| 1 + u64::from(ball.0)));
        hash.u64(self.cue_ball.0.into());
        hash_list(hash, self.frozen_to_cue.iter().map(|ball| ball.0.into()));
        hash_list(hash, self.options.iter().map(|choice| *choice as u64));
        if let Some(missed) = &self.missed {
            hash_list(hash, missed.on_table.iter().map(|ball| ball.0.into()));
            hash.u64(code_of(missed.on));
            hash.u64(missed.free_ball.into());
        }
    }
}

fn code_of(on: Option<BallOn>) -> u64 {
    match on {
        None => 0,
        Some(BallOn::Red) => 1,
        Some(BallOn::Colour) => 2,
        Some(BallOn::Ball(ball)) => 3 + u64::from(ball.0),
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
        let error = "wpa88".parse::<GameKind>().unwrap_err().to_string();
        assert!(error.starts_with("unknown game 'wpa88'; the games are"), "{error}");
        assert!(error.contains("'wpa-eight-ball' (short 'wpa8'), "), "{error}");
    }

    #[test]
    fn absent_fields_of_a_state_are_empty() {
        let state: State = serde_json::from_str("{}").unwrap();
        assert_eq!(state, State::default());
        let error = serde_json::from_str::<State>(r#"{"player":3}"#).unwrap_err();
        assert!(error.to_string().contains("expected 1 or 2"), "{error}");
    }
}
