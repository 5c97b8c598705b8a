//! The nearest of some known names: what a typing error was meant to be.

/// The distance of two words in typing errors: letters put in, left out, replaced, or two neighbours swapped (optimal string
/// alignment). Capitals count as their small letters.
fn distance(a: &str, b: &str) -> usize {
    let letters = |s: &str| s.chars().flat_map(char::to_lowercase).collect::<Vec<char>>();
    let (a, b) = (letters(a), letters(b));
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let same = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (last[j - 1] + same).min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

/// The longest word that is compared: what is longer is no typing error.
const LONGEST: usize = 64;

/// The known name nearest to `word`, the first of several, and whether it is near enough to have been meant. The beginning of
/// a name is as near as one error.
pub fn nearest<'n>(word: &str, names: impl IntoIterator<Item = &'n str>) -> Option<(&'n str, bool)> {
    let short: String = word.chars().take(LONGEST).collect();
    let (name, errors) = names
        .into_iter()
        .filter(|n| n.len() <= 4 * LONGEST)
        .map(|n| (n, if short.len() > 2 && n.starts_with(&short) { 1 } else { distance(&short, n) }))
        .min_by_key(|&(_, errors)| errors)?;
    let longer = short.chars().count().max(name.chars().count());
    Some((name, errors == 1 || 3 * errors <= longer + 1))
}

/// "; did you mean `radius`?", if one of these names was meant.
pub(crate) fn meant<'n>(word: &str, names: impl IntoIterator<Item = &'n str>) -> String {
    match nearest(word, names) {
        Some((name, true)) => format!("; did you mean `{name}`?"),
        _ => String::new(),
    }
}

/// The same of a key; where none was meant, the nearest of those that there are.
pub(crate) fn suggestion<'n>(word: &str, names: impl IntoIterator<Item = &'n str>) -> String {
    match nearest(word, names) {
        Some((name, true)) => format!("; did you mean `{name}`?"),
        Some((name, false)) => format!("; the nearest known is `{name}`"),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typing_errors_are_understood() {
        let keys = ["name", "mass", "radius", "position", "velocity", "material", "restitution"];
        for (word, meant) in [
            ("raduis", "radius"),
            ("Radius", "radius"),
            ("radious", "radius"),
            ("mas", "mass"),
            ("pos", "position"),
            ("restitutoin", "restitution"),
            ("velocty", "velocity"),
        ] {
            assert_eq!(nearest(word, keys).unwrap().0, meant, "{word}");
        }
        assert_eq!(suggestion("raduis", keys), "; did you mean `radius`?");
        assert!(suggestion("xyzzy", keys).contains("nearest known"));
        assert_eq!(suggestion("a", []), "");
        assert_eq!(meant("raduis", keys), "; did you mean `radius`?");
        assert_eq!(meant("xyzzy", keys), "", "nobody who wrote this meant any of them");
        assert_eq!((distance("", "abc"), distance("abc", ""), distance("ab", "ba")), (3, 3, 1));
    }
}
