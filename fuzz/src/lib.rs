//! Texts that almost mean something: valid ones with a few edits, for everything that reads.
//!
//! `FUZZ_CASES` says how many of each (250; `validation/run --full` takes 100,000), `PROPTEST_RNG_SEED` which ones. A text that
//! fails is made as short as it can be and printed.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestRunner};

/// The configuration of all fuzz tests: `FUZZ_CASES` texts each, or 250.
pub fn config() -> Config {
    let cases = std::env::var("FUZZ_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(250);
    Config { cases, failure_persistence: None, ..Config::default() }
}

/// Replacements of numbers, words and signs.
const WORDS: &str = "0 -0 1 -1 0.5 1e-40 1e-400 1e400 1e-4000 9007199254740993 99999999999999999999 1e99999999999 NaN inf \
    pi -3*pi sqrt(2) sin(1e22) 1/3 1/0 sqrt(-1) [] {} null true left right = \
    ,";
const TOKENS: [&str; 11] =
    ["[0, 1]", "[1, 0]", "\"1\"", "\"[0, 1e-9]\"", "\"\"", "\"left\"", "\u{0}", "\u{e9}", "\u{1F600}", "\n", "\""];

/// One edit, at a place given as a fraction of the text.
#[derive(Clone, Debug)]
enum Edit {
    /// Instead of the word there.
    Replace(f64, &'static str),
    Insert(f64, &'static str),
    Delete(f64, usize),
    Repeat(f64, usize),
    /// The rest is that of another text, from about the same place on.
    Splice(f64, usize),
}

/// The share of such texts that is read: a fuzz of what is always refused judges nothing.
pub fn share(seeds: Vec<String>, is_read: impl Fn(&str) -> bool) -> f64 {
    const TEXTS: usize = 500;
    let mut runner = TestRunner::deterministic();
    let texts = edited(seeds);
    let read =
        (0..TEXTS).filter(|_| is_read(&texts.new_tree(&mut runner).expect("no text is rejected").current())).count();
    read as f64 / TEXTS as f64
}

/// One of the seeds with up to a few edits.
pub fn edited(seeds: Vec<String>) -> impl Strategy<Value = String> {
    let place = || 0.0..1.0;
    let tokens: Vec<&str> = WORDS.split(' ').chain(TOKENS).collect();
    let token = || prop::sample::select(tokens.clone());
    let edit = prop_oneof![
        4 => (place(), token()).prop_map(|(at, token)| Edit::Replace(at, token)),
        1 => (place(), token()).prop_map(|(at, token)| Edit::Insert(at, token)),
        1 => (place(), 1_usize..12).prop_map(|(at, length)| Edit::Delete(at, length)),
        1 => (place(), 1_usize..40).prop_map(|(at, length)| Edit::Repeat(at, length)),
        1 => (place(), any::<usize>()).prop_map(|(at, seed)| Edit::Splice(at, seed)),
    ];
    (any::<prop::sample::Index>(), prop::collection::vec(edit, 0..4)).prop_map(move |(seed, edits)| {
        edits.iter().fold(seed.get(&seeds).clone(), |text, edit| edit.apply(&text, &seeds))
    })
}

impl Edit {
    fn apply(&self, text: &str, seeds: &[String]) -> String {
        let letters: Vec<char> = text.chars().collect();
        let at = |place: f64, length: usize| (place * length as f64) as usize;
        let text = |parts: &[&[char]]| parts.concat().into_iter().collect::<String>();
        let new = |token: &str| token.chars().collect::<Vec<_>>();
        match *self {
            Self::Replace(place, token) => {
                let at = at(place, letters.len());
                let is_word = |letter: &char| letter.is_alphanumeric() || "+-.*/()".contains(*letter);
                let begin = letters[..at].iter().rposition(|letter| !is_word(letter)).map_or(0, |before| before + 1);
                let end =
                    letters[at..].iter().position(|letter| !is_word(letter)).map_or(letters.len(), |after| at + after);
                text(&[&letters[..begin], &new(token), &letters[end..]])
            }
            Self::Insert(place, token) => {
                let (before, after) = letters.split_at(at(place, letters.len()));
                text(&[before, &new(token), after])
            }
            Self::Delete(place, length) => {
                let (before, after) = letters.split_at(at(place, letters.len()));
                text(&[before, &after[length.min(after.len())..]])
            }
            Self::Repeat(place, length) => {
                let (before, after) = letters.split_at(at(place, letters.len()));
                let again = &after[..length.min(after.len())];
                text(&[before, again, after])
            }
            Self::Splice(place, seed) => {
                let other: Vec<char> = seeds[seed % seeds.len()].chars().collect();
                text(&[&letters[..at(place, letters.len())], &other[at(place, other.len())..]])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_have_the_effect_of_their_names() {
        let seeds = ["v = 1.5, w".to_owned(), "0123456789".to_owned()];
        for (edit, expected) in [
            (Edit::Replace(0.45, "pi"), "v = pi, w"),
            (Edit::Insert(0.0, "-"), "-v = 1.5, w"),
            (Edit::Delete(0.75, 100), "v = 1.5"),
            (Edit::Repeat(0.0, 2), "v v = 1.5, w"),
            (Edit::Splice(0.4, 3), "v = 456789"),
        ] {
            assert_eq!(edit.apply(&seeds[0], &seeds), expected, "{edit:?}");
        }
    }
}
