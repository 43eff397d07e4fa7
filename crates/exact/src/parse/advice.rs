//! Advice for a text that does not read as a number: the text that was perhaps meant.

use super::super::error::Advice;
use super::read;

/// Other notations, each with the one that is read here.
const NOTATIONS: [(&str, &str); 10] = [
    ("π", "pi"),
    ("Pi", "pi"),
    ("PI", "pi"),
    ("√", "sqrt"),
    ("×", "*"),
    ("·", "*"),
    ("−", "-"),
    ("²", "^2"),
    ("**", "^"),
    ("÷", "/"),
];
/// The beginnings of factors that may follow a number without a multiplication sign.
const FACTOR_STARTS: [&str; 5] = ["pi", "sqrt", "sin", "cos", "("];
/// Longer texts get no advice.
const MAX_LENGTH: usize = 100;

/// The advice for a text that does not read as a number.
pub(super) fn advice(text: &str) -> Advice {
    if text.len() > MAX_LENGTH {
        return Advice::Nothing;
    }
    let written = NOTATIONS.iter().fold(text.to_owned(), |text, (other, ours)| text.replace(other, ours));
    let tried = [with_products(&written), with_point(&written)];
    match tried.into_iter().find(|tried| tried != text && read(tried).is_ok()) {
        Some(meant) => Advice::Meant(meant),
        None if has_unit(text) => Advice::Units,
        None => Advice::Nothing,
    }
}

/// `2pi` as `2*pi`.
fn with_products(text: &str) -> String {
    let mut all = String::with_capacity(text.len());
    for (at, letter) in text.char_indices() {
        let multiplies = text[..at].ends_with(|before: char| before.is_ascii_digit() || before == ')');
        if multiplies && FACTOR_STARTS.iter().any(|factor| text[at..].starts_with(factor)) {
            all.push('*');
        }
        all.push(letter);
    }
    all
}

/// `9,42497` as `9.42497`; not `9,424`, which may be thousands.
fn with_point(text: &str) -> String {
    match text.split_once(',') {
        Some((whole, rest)) if rest.len() != 3 && rest.starts_with(|digit: char| digit.is_ascii_digit()) => {
            format!("{whole}.{rest}")
        }
        _ => text.to_owned(),
    }
}

/// Whether a text is a number followed by a unit's name or a degree sign.
fn has_unit(text: &str) -> bool {
    let is_of_a_unit = |letter: char| letter.is_alphabetic() || "/°^2 ".contains(letter);
    let number = text.trim_end_matches(is_of_a_unit);
    number.len() < text.trim_end().len() && !number.is_empty() && read(number).is_ok()
}
