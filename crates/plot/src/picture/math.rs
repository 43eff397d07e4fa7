//! Mathematics in text: the part between two dollars is set as mathematics, `_` and `^` begin subscripts and superscripts.

use std::fmt::Write;

/// Size of a subscript or superscript, and its shift, relative to the size of the line.
const SCRIPT_SIZE: f64 = 0.72;
const SUBSCRIPT_SHIFT: f64 = 0.25;
const SUPERSCRIPT_SHIFT: f64 = -0.38;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Level {
    Line,
    Lower,
    Upper,
}

impl Level {
    fn shift(self) -> f64 {
        match self {
            Self::Line => 0.0,
            Self::Lower => SUBSCRIPT_SHIFT,
            Self::Upper => SUPERSCRIPT_SHIFT,
        }
    }
}

/// Letters of one style.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Run {
    text: String,
    is_italic: bool,
    level: Level,
}

/// The parts of a text, with those between dollars marked; the last of an odd number of dollars is a plain character.
fn parts(text: &str) -> Vec<(String, bool)> {
    let mut parts: Vec<(String, bool)> =
        text.split('$').enumerate().map(|(i, part)| (part.to_owned(), i % 2 == 1)).collect();
    if parts.len().is_multiple_of(2)
        && let Some((last, _)) = parts.pop()
        && let Some((before, _)) = parts.last_mut()
    {
        *before = format!("{before}${last}");
    }
    parts
}

/// The styles of mathematics: single letters are quantities in italics, longer words are upright.
fn runs(text: &str, level: Level) -> Vec<Run> {
    let letters: Vec<char> = text.chars().collect();
    let mut runs: Vec<Run> = Vec::new();
    let mut at = 0;
    while at < letters.len() {
        let end =
            |is_in: fn(char) -> bool| letters[at..].iter().position(|c| !is_in(*c)).map_or(letters.len(), |n| at + n);
        match letters[at] {
            c @ ('_' | '^') if at + 1 < letters.len() => {
                let level = if c == '_' { Level::Lower } else { Level::Upper };
                let (from, to, next) = match letters[at + 1..].iter().position(|c| *c == '}') {
                    Some(close) if letters[at + 1] == '{' => (at + 2, at + 1 + close, at + 2 + close),
                    _ => (at + 1, at + 2, at + 2),
                };
                runs.extend(self::runs(&letters[from..to].iter().collect::<String>(), level));
                at = next;
            }
            '₀'..='₉' => {
                let to = end(|c| ('₀'..='₉').contains(&c));
                let digits =
                    letters[at..to].iter().filter_map(|c| char::from_digit(u32::from(*c) - u32::from('₀'), 10));
                runs.push(Run { text: digits.collect(), is_italic: false, level: Level::Lower });
                at = to;
            }
            'a'..='z' | 'A'..='Z' => {
                let to = end(|c| c.is_ascii_alphabetic());
                runs.push(Run { text: letters[at..to].iter().collect(), is_italic: to == at + 1, level });
                at = to;
            }
            c => {
                let is_italic = ('α'..='ω').contains(&c) && c != 'π';
                runs.push(Run { text: if c == '-' { '−' } else { c }.to_string(), is_italic, level });
                at += 1;
            }
        }
    }
    runs
}

fn all_runs(text: &str) -> Vec<Run> {
    let plain = |text| vec![Run { text, is_italic: false, level: Level::Line }];
    let all = parts(text)
        .into_iter()
        .flat_map(|(part, is_math)| if is_math { runs(&part, Level::Line) } else { plain(part) });
    let mut joined: Vec<Run> = Vec::new();
    for run in all.filter(|run| !run.text.is_empty()) {
        match joined.last_mut().filter(|last| (last.is_italic, last.level) == (run.is_italic, run.level)) {
            Some(last) => last.text.push_str(&run.text),
            None => joined.push(run),
        }
    }
    joined
}

/// The text as the content of an SVG text element of this `size`.
pub fn typeset(text: &str, size: f64) -> String {
    let mut svg = String::new();
    let mut level = Level::Line;
    for run in all_runs(text) {
        let words = escaped(&run.text);
        let mut look = String::new();
        // Writing to a String cannot fail.
        if run.level != level {
            let _ = write!(look, " dy=\"{:.1}\"", size * (run.level.shift() - level.shift()));
        }
        if run.level != Level::Line {
            let _ = write!(look, " font-size=\"{:.1}\"", size * SCRIPT_SIZE);
        }
        if run.is_italic {
            look.push_str(" font-style=\"italic\"");
        }
        level = run.level;
        let _ = if look.is_empty() { write!(svg, "{words}") } else { write!(svg, "<tspan{look}>{words}</tspan>") };
    }
    svg
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Approximate width of a text, in letters.
pub fn letters(text: &str) -> f64 {
    let width = |run: &Run| run.text.chars().count() as f64 * if run.level == Level::Line { 1.0 } else { SCRIPT_SIZE };
    all_runs(text).iter().map(width).sum()
}

/// Approximate width of a text of several runs in letters of this `size`; `None` for a text of a single run.
pub fn runs_width(text: &str, size: f64) -> Option<f64> {
    let runs = all_runs(text);
    let width = |run: &Run| {
        let small = if run.level == Level::Line { 1.0 } else { SCRIPT_SIZE };
        small * run.text.chars().map(advance).sum::<f64>()
    };
    (runs.len() > 1).then(|| size * runs.iter().map(width).sum::<f64>())
}

/// The width of a letter relative to its font size: between Arial and DejaVu Sans, rounded to classes of letters.
fn advance(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | '\'' | '′' => 0.25,
        ' ' | '\u{a0}' | 'f' | 't' | 'r' | '[' | ']' | '(' | ')' | '/' | ',' | '.' | ':' | ';' | 'I' | '·' => 0.33,
        'c' | 'k' | 's' | 'v' | 'x' | 'y' | 'z' => 0.53,
        'm' | 'M' | 'W' | '…' => 0.87,
        'w' | '=' | '+' | '−' | '<' | '>' | '≤' | '≥' | '→' => 0.72,
        'A'..='Z' | 'Ω' => 0.69,
        _ => 0.6,
    }
}

/// The words of a scene in typeset notation.
pub fn greek(words: &str) -> String {
    let names = [("tau", "τ"), ("2 pi", "2π"), ("pi", "π"), ("A W", "AΩ"), ("W", "Ω"), ("-", "−"), ("'", "′")];
    let words = powers(&roots(words));
    format!("${}$", names.iter().fold(words, |words, (ascii, greek)| words.replace(ascii, greek)).replace('*', ""))
}

/// The program's text with numbers and the paper's names of mappings in typeset notation.
pub fn typeset_text(words: &str) -> String {
    (1..=4).fold(each_power(words, "$"), |words, k| words.replace(&format!("P{k}"), &format!("$P_{k}$")))
}

/// Roots of numbers without brackets, followed by a space.
fn roots(words: &str) -> String {
    let mut parts = words.split("sqrt(");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        match part.split_once(')').filter(|(number, _)| number.chars().all(|c| c.is_ascii_digit())) {
            Some((number, rest)) => {
                let rest = rest.strip_prefix('*').map_or(rest.to_owned(), |rest| format!("\u{2009}{rest}"));
                text = format!("{text}√{number}{rest}");
            }
            None => text = format!("{text}√({part}"),
        }
    }
    text
}

/// Powers of ten in mathematics.
fn powers(words: &str) -> String {
    each_power(words, "")
}

/// Replaces powers of ten by superscripts, with `around` on both sides of each number.
fn each_power(words: &str, around: &str) -> String {
    let is_number = |text: &str| text.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit());
    let word = |word: &str| {
        let number = word.trim_end_matches([',', ';', ')']);
        let end = &word[number.len()..];
        match number.split_once('e') {
            Some((mantissa, exponent)) if is_number(mantissa) && exponent.parse::<i32>().is_ok() => {
                format!("{around}{mantissa}·10^{{{exponent}}}{around}{end}")
            }
            _ => word.to_owned(),
        }
    };
    words.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_italic_and_indices_are_subscripts() {
        let lower = "<tspan dy=\"2.5\" font-size=\"7.2\" font-style=\"italic\">N</tspan>";
        assert_eq!(
            typeset("amplitude $A_N$ [length]", 10.0),
            format!("amplitude <tspan font-style=\"italic\">A</tspan>{lower}<tspan dy=\"-2.5\"> [length]</tspan>")
        );
        let text = typeset("$Ωt mod 2π$ < 10$^{-9}$", 10.0);
        assert!(text.starts_with("Ω<tspan font-style=\"italic\">t</tspan> mod 2π &lt; 10<tspan dy=\"-3.8\""), "{text}");
        assert!(text.ends_with(">−9</tspan>"), "{text}");
        assert!(typeset("$t₀$", 10.0).ends_with("<tspan dy=\"2.5\" font-size=\"7.2\">0</tspan>"));
    }

    #[test]
    fn other_words_stay_as_they_are() {
        for text in ["my_scene costs 5$", "a^b", "", "x_"] {
            assert_eq!(typeset(text, 10.0), text);
        }
        assert_eq!(letters("$A_N$ = 1"), 5.0 + SCRIPT_SIZE);
        assert_eq!(runs_width("amplitude", 10.0), None);
        assert!((runs_width("$A_N$", 10.0).unwrap() - 6.9 * (1.0 + SCRIPT_SIZE)).abs() < 1e-9);
    }

    #[test]
    fn expressions_are_set_as_in_print() {
        assert_eq!(greek("W = (pi, sqrt(2)*pi), tau = 10*pi"), "$Ω = (π, √2\u{2009}π), τ = 10π$");
        assert_eq!(greek("v = -1e-9, y' = 2.5e3"), "$v = −1·10^{−9}, y′ = 2.5·10^{3}$");
        assert_eq!(greek("sqrt(1+pi)"), "$√(1+π)$");
        assert_eq!(
            typeset_text("P2 P1 within 3.5e-14 periods, 1e-9)"),
            "$P_2$ $P_1$ within $3.5·10^{-14}$ periods, $1·10^{-9}$)"
        );
    }
}
