//! What came from outside, made fit for one line of a message.

/// `text` without control characters and line separators, cut at `length` characters.
pub(crate) fn one_line(text: &str, length: usize) -> String {
    let mut line: String =
        text.chars().take(length).map(|c| if breaks(c) { ' ' } else { c }).collect();
    if text.chars().nth(length).is_some() {
        line.push('…');
    }
    line
}

/// Whether `text` is one line of at most `length` characters as it is.
pub(crate) fn is_one_line(text: &str, length: usize) -> bool {
    text.chars().count() <= length && !text.contains(breaks)
}

/// What ends a line or steers a terminal.
fn breaks(c: char) -> bool {
    c.is_control() || matches!(c, '\u{2028}' | '\u{2029}')
}

/// The message of a JSON error without its own line and column, which the caller knows better.
pub(crate) fn without_place(error: &serde_json::Error) -> String {
    let text = error.to_string();
    one_line(text.rfind(" at line ").map_or(text.as_str(), |end| &text[..end]), 400)
}

#[cfg(test)]
mod tests {
    use super::one_line;

    #[test]
    fn breaks_become_spaces_and_long_texts_are_cut() {
        assert_eq!(one_line("a\r\nb\u{2028}c\td", 9), "a  b c d");
        assert_eq!(one_line("ääää", 3), "äää…");
        assert_eq!(one_line("ääää", 4), "ääää");
    }
}
