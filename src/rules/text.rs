//! Sentences for verdicts and turns, in English and German.
//!
//! The rules themselves speak in codes; the words are in `config/text/`.

use super::ball_names::ball_name;
use crate::events::{
    BallInHand, BallOn, Call, CallKind, Choice, Foul, Group, Groups, Racked, ShotKind, Turn,
    TurnAfter, Verdict,
};
use crate::ids::{BallId, GameKind, PlayerId, PocketId};
use serde::Serialize;
use serde_json::Value;

/// A language.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// German, as the paper is.
    German,
}

impl Language {
    /// All languages.
    pub const ALL: [Language; 2] = [Language::English, Language::German];

    /// Its code.
    pub fn id(self) -> &'static str {
        match self {
            Language::English => "en",
            Language::German => "de",
        }
    }

    /// The sentences of this language, as TOML.
    pub(crate) fn file(self) -> &'static str {
        match self {
            Language::English => include_str!("../../config/text/en.toml"),
            Language::German => include_str!("../../config/text/de.toml"),
        }
    }
}

/// The sentences of one language.
#[derive(Debug, Clone)]
pub struct Texts {
    table: toml::Table,
    names: [String; 2],
    game: Option<GameKind>,
}

impl Texts {
    /// The sentences of a language; the players are numbered.
    pub fn new(language: Language) -> Self {
        // The file is compiled in and a test reads it: it cannot fail on a user's machine.
        let table = language.file().parse().unwrap_or_default();
        let mut texts = Texts { table, names: Default::default(), game: None };
        texts.names = ["1", "2"].map(|number| texts.fill("player", "name", "number", number));
        texts
    }

    /// The same, with the players' own names.
    #[must_use]
    pub fn with_names(self, one: &str, two: &str) -> Self {
        Texts { names: [one.into(), two.into()], ..self }
    }

    /// The same, with the names that a game has for its balls.
    #[must_use]
    pub fn for_game(self, game: GameKind) -> Self {
        Texts { game: Some(game), ..self }
    }

    /// What a verdict says, for example "Foul: the cue ball was pocketed. Ball in hand for
    /// Player 2."
    pub fn verdict(&self, verdict: &Verdict) -> String {
        let mut sentences = Vec::new();
        if !verdict.fouls.is_empty() {
            let reasons: Vec<_> =
                verdict.fouls.iter().map(|foul| self.get("foul", &code(foul))).collect();
            let reasons = reasons.join(&self.get("verdict", "and"));
            sentences.push(self.fill("verdict", "foul", "reasons", &reasons));
        }
        if !verdict.spot.is_empty() {
            sentences.push(self.fill("verdict", "spot", "balls", &self.list(&verdict.spot)));
        }
        for player in [PlayerId::ONE, PlayerId::TWO] {
            let points = verdict.points.of(player);
            if points != 0 {
                let sentence = self.about("verdict", "points", player);
                sentences.push(sentence.replace("{points}", &format!("{points:+}")));
            }
        }
        sentences.extend(verdict.rack.map(|rack| match rack {
            Racked::All => self.get("verdict", "rack_all"),
            Racked::Fourteen => self.get("verdict", "rack_fourteen"),
        }));
        if let Some(chooser) = verdict.chooser {
            sentences.push(self.about("verdict", "chooser", chooser));
            return sentences.join(" ");
        }
        sentences.push(match (verdict.turn, verdict.winner, verdict.next_player) {
            (TurnAfter::End, Some(winner), _) => self.about("verdict", "winner", winner),
            (TurnAfter::End, None, _) | (_, _, None) => self.get("verdict", "no_winner"),
            (_, _, Some(next)) if verdict.ball_in_hand != BallInHand::None => {
                self.about("in_hand", &code(&verdict.ball_in_hand), next)
            }
            (TurnAfter::Continue, _, Some(next)) => self.about("turn", "again", next),
            (TurnAfter::Pass, _, Some(next)) => self.about("turn", "normal", next),
        });
        sentences.join(" ")
    }

    /// What a turn says, for example "Player 1 to break. Ball in hand behind the head string for
    /// Player 1. The table is open."
    pub fn turn(&self, turn: &Turn) -> String {
        if !turn.options.is_empty() {
            let options: Vec<_> = turn.options.iter().map(|option| self.choice(*option)).collect();
            let sentence = self.about("turn", "choose", turn.player);
            return sentence.replace("{options}", &options.join(&self.get("turn", "or")));
        }
        let mut sentences = vec![self.about("turn", &code(&turn.shot), turn.player)];
        if turn.ball_in_hand != BallInHand::None {
            sentences.push(self.about("in_hand", &code(&turn.ball_in_hand), turn.player));
        }
        let is_on_the_eight = turn.legal_first.as_slice() == [BallId::EIGHT];
        let plays = match turn.groups {
            None => None,
            Some(_) if turn.shot == ShotKind::Break => None,
            Some(Groups::Open) => Some("open"),
            Some(Groups::Assigned { .. }) if is_on_the_eight => Some("eight"),
            Some(groups) => groups.of(turn.player).map(|group| match group {
                Group::Solids => "solids",
                Group::Stripes => "stripes",
            }),
        };
        sentences.extend(plays.map(|key| self.about("turn", key, turn.player)));
        sentences.extend(self.ball_on(turn));
        let hints = [(turn.calls.push_out, "may_push_out"), (turn.warned, "warned")];
        for (_, key) in hints.iter().filter(|(holds, _)| *holds) {
            sentences.push(self.about("turn", key, turn.player));
        }
        sentences.join(" ")
    }

    /// Which ball must be met first, where that is not for the groups to say.
    fn ball_on(&self, turn: &Turn) -> Option<String> {
        let ball = match (turn.on, &turn.legal_first[..]) {
            (Some(BallOn::Ball(ball)), _) => ball,
            (Some(on), _) => return Some(self.get("on", &code(&on))),
            (None, [ball]) if turn.groups.is_none() && turn.on_table.len() > 1 => *ball,
            _ => return None,
        };
        Some(self.fill("on", "ball", "ball", &self.ball(ball)))
    }

    /// What was announced, for example "Called: the 5 into the pocket at the head, left."
    pub fn call(&self, call: &Call) -> String {
        match call {
            Call::Ball { ball, pocket: None } => {
                self.fill("call", "nominated", "ball", &self.ball(*ball))
            }
            Call::Ball { ball, pocket: Some(pocket) } => {
                let pocket = self.pocket(*pocket);
                let text = self.fill("call", "ball", "ball", &self.ball(*ball));
                text.replace("{pocket}", &pocket)
            }
            Call::Kind(CallKind::Nothing) => String::new(),
            Call::Kind(kind) => self.get("call", &code(kind)),
        }
    }

    /// Where a pocket is, for example "at the foot, left".
    pub fn pocket(&self, pocket: PocketId) -> String {
        self.get("pocket", &code(&pocket))
    }

    /// What a ball is called.
    pub fn ball(&self, ball: BallId) -> String {
        self.game.map_or_else(|| ball.to_string(), |game| ball_name(game, ball))
    }

    fn list(&self, balls: &[BallId]) -> String {
        balls.iter().map(|ball| self.ball(*ball)).collect::<Vec<_>>().join(", ")
    }

    /// What an option means, for a menu, for example "play the table as it is".
    pub fn choice(&self, choice: Choice) -> String {
        self.get("choice", &code(&choice))
    }

    /// Why a verdict is as it is: one sentence per foul, then what became of turn and game.
    pub fn why(&self, verdict: &Verdict) -> Vec<String> {
        let mut keys: Vec<String> = verdict.fouls.iter().map(code).collect();
        if keys.is_empty() {
            keys.push("no_foul".into());
        }
        let end = match (verdict.turn, verdict.winner) {
            (TurnAfter::End, Some(_)) => end_of_game(verdict),
            (TurnAfter::End, None) => Some("no_winner"),
            (TurnAfter::Pass, _) if verdict.options.contains(&Choice::PassBack) => Some("push_out"),
            // The foul has already said why.
            (TurnAfter::Pass | TurnAfter::Continue, _) if !verdict.legal => None,
            (TurnAfter::Continue, _) => Some("continue"),
            (TurnAfter::Pass, _) => Some("pass"),
        };
        keys.extend(end.map(String::from));
        keys.iter().map(|key| self.get("why", key)).collect()
    }

    /// A sentence about a player.
    fn about(&self, section: &str, key: &str, player: PlayerId) -> String {
        self.fill(section, key, "player", &self.names[player.index()])
    }

    fn fill(&self, section: &str, key: &str, place: &str, value: &str) -> String {
        self.get(section, key).replace(&format!("{{{place}}}"), value)
    }

    /// The text at a key; the key itself where there is none, so that nothing is ever silent.
    fn get(&self, section: &str, key: &str) -> String {
        self.find(section, key).map_or_else(|| format!("{section}.{key}"), String::from)
    }

    fn find(&self, section: &str, key: &str) -> Option<&str> {
        self.table.get("rules")?.get(section)?.get(key)?.as_str()
    }
}

/// Why a verdict is as it is, in a language; see [`Texts::why`].
pub fn explain(verdict: &Verdict, language: Language) -> Vec<String> {
    Texts::new(language).why(verdict)
}

/// What decided a game that somebody has won. Groups are of eight-ball, and what is left without
/// points or a third foul is nine-ball.
fn end_of_game(verdict: &Verdict) -> Option<&'static str> {
    let has_won = verdict.winner == verdict.player;
    match () {
        () if verdict.groups.is_some() => Some(if has_won { "win" } else { "loss" }),
        () if verdict.fouls.contains(&Foul::ThreeFouls) => None,
        () if verdict.points.is_nothing() => Some("win_nine"),
        () => Some("win_points"),
    }
}

/// The code of a value in JSON, by which its sentence is found.
fn code(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(Value::String(code)) => code,
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::Foul;
    use smallvec::smallvec;

    /// All fouls. The match keeps the list complete: a new foul does not compile without a place.
    fn all_fouls() -> Vec<Foul> {
        let next = |foul: Foul| match foul {
            Foul::Scratch => Some(Foul::CueOff),
            Foul::CueOff => Some(Foul::NoContact),
            Foul::NoContact => Some(Foul::WrongFirst),
            Foul::WrongFirst => Some(Foul::NoRail),
            Foul::NoRail => Some(Foul::BallOff),
            Foul::BallOff => Some(Foul::DoubleHit),
            Foul::DoubleHit => Some(Foul::Push),
            Foul::Push => Some(Foul::TouchedBall),
            Foul::TouchedBall => Some(Foul::BadPlacement),
            Foul::BadPlacement => Some(Foul::Kitchen),
            Foul::Kitchen => Some(Foul::Moving),
            Foul::Moving => Some(Foul::OutOfTurn),
            Foul::OutOfTurn => Some(Foul::IllegalBreak),
            Foul::IllegalBreak => Some(Foul::EightEarly),
            Foul::EightEarly => Some(Foul::EightWrongPocket),
            Foul::EightWrongPocket => Some(Foul::ThreeFouls),
            Foul::ThreeFouls => Some(Foul::BallNotOnPocketed),
            Foul::BallNotOnPocketed => None,
        };
        std::iter::successors(Some(Foul::Scratch), |foul| next(*foul)).collect()
    }

    #[test]
    fn every_foul_has_its_sentences_in_both_languages() {
        assert_eq!(all_fouls().len(), 18);
        for language in Language::ALL {
            let texts = Texts::new(language);
            for foul in all_fouls() {
                for section in ["foul", "why"] {
                    let text = texts.find(section, &code(&foul));
                    assert!(text.is_some_and(|text| text.len() > 10), "{language:?} {foul:?}");
                }
            }
        }
    }

    /// All options. The match keeps the list complete, as that of the fouls.
    fn all_choices() -> Vec<Choice> {
        let next = |choice: Choice| match choice {
            Choice::Accept => Some(Choice::CueInHandKitchen),
            Choice::CueInHandKitchen => Some(Choice::RerackAndBreak),
            Choice::RerackAndBreak => Some(Choice::RerackOpponentBreaks),
            Choice::RerackOpponentBreaks => Some(Choice::Respot8Continue),
            Choice::Respot8Continue => Some(Choice::Respot8CueInHandKitchen),
            Choice::Respot8CueInHandKitchen => Some(Choice::Rebreak),
            Choice::Rebreak => Some(Choice::Shoot),
            Choice::Shoot => Some(Choice::PassBack),
            Choice::PassBack => Some(Choice::AskAgain),
            Choice::AskAgain => Some(Choice::Play),
            Choice::Play => Some(Choice::PutBack),
            Choice::PutBack => Some(Choice::SpotFrozen),
            Choice::SpotFrozen => None,
        };
        std::iter::successors(Some(Choice::Accept), |choice| next(*choice)).collect()
    }

    #[test]
    fn every_option_has_its_words_in_both_languages() {
        assert_eq!(all_choices().len(), 13);
        for language in Language::ALL {
            let texts = Texts::new(language);
            for choice in all_choices() {
                assert!(!texts.choice(choice).starts_with("choice."), "{language:?} {choice:?}");
            }
        }
    }

    #[test]
    fn every_call_has_its_sentence_in_both_languages() {
        for language in Language::ALL {
            let texts = Texts::new(language);
            for pocket in PocketId::ALL {
                let text = texts.call(&Call::Ball { ball: BallId(5), pocket: Some(pocket) });
                assert!(text.contains('5') && !text.contains(['{', '_']), "{text}");
            }
            for kind in [CallKind::Safety, CallKind::PushOut] {
                assert!(!texts.call(&Call::Kind(kind)).contains("call."), "{language:?} {kind:?}");
            }
        }
    }

    #[test]
    fn both_languages_have_the_same_keys_and_the_same_braces() {
        fn shape(value: &toml::Value, path: String, into: &mut Vec<String>) {
            match value {
                toml::Value::Table(table) => {
                    table.iter().for_each(|(key, v)| shape(v, format!("{path}.{key}"), into));
                }
                toml::Value::String(text) => {
                    let holes = text.split('{').skip(1).filter_map(|rest| rest.split('}').next());
                    into.push(format!("{path} {:?}", holes.collect::<Vec<_>>()));
                }
                _ => into.push(format!("{path} is no text")),
            }
        }
        let [english, german] = Language::ALL.map(|language| {
            let table: toml::Table = language.file().parse().unwrap();
            let mut keys = Vec::new();
            shape(&table["rules"], String::new(), &mut keys);
            keys
        });
        assert_eq!(english, german);
    }

    #[test]
    fn a_scratch_reads_like_a_referee() {
        let verdict = Verdict {
            player: Some(PlayerId::ONE),
            fouls: smallvec![Foul::Scratch],
            turn: TurnAfter::Pass,
            next_player: Some(PlayerId::TWO),
            ball_in_hand: BallInHand::Anywhere,
            ..Verdict::default()
        };
        assert_eq!(
            Texts::new(Language::English).verdict(&verdict),
            "Foul: the cue ball was pocketed. Ball in hand for Player 2."
        );
        assert_eq!(
            Texts::new(Language::German).with_names("Ada", "Bo").verdict(&verdict),
            "Foul: der Spielball wurde versenkt. Bo darf den Spielball frei legen."
        );
        assert_eq!(
            explain(&verdict, Language::English),
            ["The cue ball must stay on the table, but it went down in a pocket."]
        );
    }
}
