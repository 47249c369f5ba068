use crate::bytes::{check_line, chosen, text};
use hapticbillard::rules::{Console, ConsoleAnswer, GameKind, Language, Texts};

/// Of a longer file so many lines are read.
const LINES: usize = 200;

const LANGUAGES: [Language; 2] = [Language::English, Language::German];

thread_local! {
    /// What is said of each game.
    static TEXTS: Vec<[Texts; 2]> = {
        let texts = |game| LANGUAGES.map(|language| Texts::new(language).for_game(game));
        GameKind::ALL.into_iter().map(texts).collect()
    };
}

pub fn run(data: &[u8]) {
    let (choice, data) = chosen(data);
    let game = GameKind::ALL[choice % GameKind::ALL.len()];
    let mut console = Console::new(game);
    for (index, line) in text(data).lines().take(LINES).enumerate() {
        let before = console.answer();
        match console.feed_line(line) {
            Ok(answer) => TEXTS.with(|texts| {
                let texts = &texts[choice % GameKind::ALL.len()];
                texts.iter().for_each(|texts| check_answer(texts, &answer));
            }),
            // The program stops here; who types goes on from where the game stood.
            Err(error) => {
                let said = error.to_string();
                check_line(&said);
                assert!(said.starts_with(&format!("line {}", index + 1)), "{said}");
                assert_eq!(console.answer(), before, "{said}");
            }
        }
    }
}

/// Everything that the console prints of an answer.
fn check_answer(texts: &Texts, answer: &ConsoleAnswer) {
    let said = [
        answer.verdict.as_ref().map(|verdict| texts.verdict(verdict)),
        answer.turn.as_ref().map(|turn| texts.turn(turn)),
        answer.call.as_ref().map(|call| texts.call(call)),
    ];
    said.iter().flatten().for_each(|line| check_line(line));
    for reason in answer.verdict.iter().flat_map(|verdict| texts.why(verdict)) {
        check_line(&reason);
    }
    assert!(serde_json::to_string(answer).is_ok());
}
