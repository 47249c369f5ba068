use crate::bytes::{check_line, text};
use hapticbillard::menu::{Deed, Effect, Menu, MenuInput, Pages, Settings};

const NAMES: [&str; 5] = ["main", "mode", "options", "over", "pause"];

/// Between two pages of a file.
const CUT: &str = "\n---\n";

/// A hand at the keys: each of its inputs, again and again.
const INPUTS: [MenuInput; 9] = [
    MenuInput::Down,
    MenuInput::More,
    MenuInput::Less,
    MenuInput::Accept,
    MenuInput::Press { line: 1, share: Some(0.7) },
    MenuInput::Over(3),
    MenuInput::Press { line: usize::MAX, share: Some(f64::NAN) },
    MenuInput::Up,
    MenuInput::Back,
];

pub fn run(data: &[u8]) {
    let text = text(data);
    let files: Vec<(&str, &str)> = NAMES.into_iter().zip(text.split(CUT)).collect();
    let pages = match Pages::parse(&files) {
        Ok(pages) => pages,
        Err(error) => return check_line(&error.to_string()),
    };
    assert_eq!(pages.iter().count(), files.len());
    let mut menu = Menu::new(pages, Settings::default());
    menu.open(NAMES[0]);
    for step in 0..4 * INPUTS.len() {
        let deed = menu.hear(INPUTS[step % INPUTS.len()]);
        let Some((page, focus)) = menu.seen() else { break };
        assert!(focus < page.items.len(), "{focus} of {page:?}");
        let sets = page.items.iter().any(|item| matches!(item.effect, Effect::Sets(_)));
        assert!(sets || deed != Some(Deed::Changed), "{page:?}");
    }
}
