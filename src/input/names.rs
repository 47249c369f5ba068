//! The name that somebody meant who wrote another one.

/// The name nearest to `wanted`: the fewest letters to put in, leave out or change.
pub(crate) fn nearest<'a>(wanted: &str, names: impl Iterator<Item = &'a str>) -> &'a str {
    names.min_by_key(|name| distance(wanted, name)).unwrap_or_default()
}

/// How many letters make one word of the other (Levenshtein 1965).
fn distance(a: &str, b: &str) -> usize {
    // Nobody writes a name of a thousand letters; whoever does gets a quick answer.
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().take(40).collect(), b.chars().collect());
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, left) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, right) in b.iter().enumerate() {
            let changed = diagonal + usize::from(left != right);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{distance, nearest};

    #[test]
    fn what_was_meant_is_found() {
        assert_eq!((distance("kitten", "sitting"), distance("", "ab")), (3, 2));
        assert_eq!(nearest("turn_lft", ["turn_right", "turn_left"].into_iter()), "turn_left");
    }
}
