//! The line of a file that an error is about.

use std::fmt;
use std::ops::Range;

/// A line of a text with the marked part that an error is about.
///
/// It is shown as by compilers:
///
/// ```text
///    |
/// 10 | gap = "9,42497"
///    |         ^
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    line: usize,
    text: String,
    /// The marked part, in characters of the line.
    marked: Range<usize>,
}

impl Excerpt {
    /// Marks `bytes` of a text in the line where they begin; bytes beyond the end of that line are not marked.
    pub(crate) fn new(text: &str, bytes: Range<usize>) -> Self {
        let whole = |at: usize| (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
        let start = whole(bytes.start);
        let before = &text[..start];
        let begin = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = text[begin..].lines().next().unwrap_or_default();
        let end = whole(bytes.end.max(start)).min(begin + line.len());
        let chars = |from: usize, to: usize| text.get(from..to).map_or(0, |part| part.chars().count());
        let from = chars(begin, start);
        let marked = from..from + chars(start, end).max(1);
        Self { line: 1 + before.matches('\n').count(), text: line.replace('\t', " "), marked }
    }

    /// The number of the line, from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The line, without its end.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The marked part, in characters of the line from 0.
    pub fn marked(&self) -> Range<usize> {
        self.marked.clone()
    }
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        let Range { start, end } = self.marked;
        let marks = "^".repeat(end - start);
        write!(f, "{margin} |\n{number} | {}\n{margin} | {}{marks}", self.text, " ".repeat(start))
    }
}

#[cfg(test)]
mod tests {
    use super::Excerpt;

    #[test]
    fn excerpts_point_at_the_faulty_text() {
        let text = "a = 1\nπ = \"8 mm\"\n";
        let at = text.find("mm").unwrap();
        let excerpt = Excerpt::new(text, at..at + 2);
        assert_eq!((excerpt.line(), excerpt.text(), excerpt.marked()), (2, "π = \"8 mm\"", 7..9));
        assert_eq!(excerpt.to_string(), "  |\n2 | π = \"8 mm\"\n  |        ^^");
    }

    #[test]
    fn ends_of_lines_and_of_the_text_are_places_too() {
        for (bytes, line, marked) in [(5..9, 1, 5..6), (6..6, 2, 0..1), (8..8, 2, 2..3), (100..200, 2, 2..3)] {
            let excerpt = Excerpt::new("a = 1\nb ", bytes.clone());
            assert_eq!((excerpt.line(), excerpt.marked()), (line, marked), "{bytes:?}");
        }
    }
}
