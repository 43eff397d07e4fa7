//! Other names of keys: the letters that stand for them, and names that are meant perhaps.

/// Accepted beside the names of keys: the letters in which results are printed, each with the table and the name that it stands for.
pub(super) const LETTERS: [(&str, &str, &str); 6] = [
    ("A", "excitation", "amplitude"),
    ("W", "excitation", "frequency"),
    ("angular-frequency", "excitation", "frequency"),
    ("tau", "excitation", "phase"),
    ("d", "pair", "gap"),
    ("e", "pair", "restitution"),
];

/// The name that a letter stands for; any other name as it is.
pub(super) fn spelled(name: &str) -> &str {
    LETTERS.iter().find(|(letter, ..)| *letter == name).map_or(name, |(.., long)| long)
}

/// Names with the letters that are accepted for them: `gap (d), restitution (e)`.
pub(super) fn listed(names: &[&str]) -> String {
    let with_letters = |name: &&str| {
        let letters: Vec<&str> = LETTERS.iter().filter(|(.., long)| long == name).map(|(letter, ..)| *letter).collect();
        if letters.is_empty() { (*name).to_owned() } else { format!("{name} ({})", letters.join(", ")) }
    };
    names.iter().map(with_letters).collect::<Vec<_>>().join(", ")
}

/// Symbols of other programs, which are suggestions: the symbol, the table and the key that it stands for.
const SYMBOLS: [(&str, &str, &str); 14] = [
    ("a", "excitation", "amplitude"),
    ("w", "excitation", "frequency"),
    ("omega", "excitation", "frequency"),
    ("Omega", "excitation", "frequency"),
    ("D", "pair", "gap"),
    ("r", "pair", "restitution"),
    ("epsilon", "pair", "restitution"),
    ("t", "start", "time"),
    ("t0", "start", "time"),
    ("v", "start", "velocity"),
    ("v0", "start", "velocity"),
    ("y", "start", "position"),
    ("y0", "start", "position"),
    ("side", "start", "wall"),
];

/// The key `table.key` that a symbol of the paper stands for, where it belongs to another table.
pub(super) fn elsewhere(name: &str) -> Option<String> {
    let (_, table, meant) = LETTERS.iter().chain(&SYMBOLS).find(|(symbol, ..)| *symbol == name)?;
    Some(format!("{table}.{meant}"))
}

/// The known key that an unknown name resembles most, if one is similar enough.
pub(super) fn nearest<'n>(name: &str, known: &[&'n str]) -> Option<&'n str> {
    if let Some((.., meant)) = SYMBOLS.iter().find(|(symbol, _, meant)| *symbol == name && known.contains(meant)) {
        return Some(meant);
    }
    let likeness = |other: &str| strsim::normalized_damerau_levenshtein(&name.to_lowercase(), other);
    let best = known.iter().copied().max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(best) > 0.6).then_some(best)
}
