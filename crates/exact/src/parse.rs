//! Reading expressions: one pass, two mutually recursive functions, and a limit on everything that could grow.

mod advice;

use std::str::FromStr;
use std::sync::Arc;

use super::error::{ParseError, Problem, shortened};
use super::literal::exact_decimal;
use super::{Exact, ExactError, LARGEST_POWER};
use advice::advice;

/// Longer texts are refused.
const LONGEST_TEXT: usize = 1 << 14;
/// More nested parentheses are refused.
const DEEPEST_NESTING: usize = 256;

const OPERAND: &str = "a number, `pi`, `sqrt(`, `sin(`, `cos(`, `(` or a sign";
const OPERATOR: &str = "`+`, `-`, `*`, `/`, `^` or the end";
const CLOSING_OPERATOR: &str = "`+`, `-`, `*`, `/`, `^` or `)`";
const EXPONENT: &str = "an integer from -10000 to 10000";

/// The loosest operations that a part of an expression may contain without parentheses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Level {
    Sum,
    Product,
}

impl Exact {
    /// Reads an exact real number, or an interval `[a, b]` of them.
    ///
    /// Accepted are decimals (`9.42497`, `.5`, `1e-300`, and underscores between digits as TOML has them), `pi`, `sqrt(x)`, `sin(x)`,
    /// `cos(x)`, `+ - * /`, `^` with an integer exponent (binding tighter than a sign: `-2^2` is -4), and parentheses. A sign directly after
    /// a sign is refused: `1 - (-2)` is read, `1 - -2` and `1.7 +- 0.1` are not.
    ///
    /// **Errors** name the byte column, what was found there and what is accepted. Refused too: a divisor that cannot be proved
    /// nonzero, a root of what cannot be proved nonnegative, texts over 16384 bytes, over 256 levels of nesting, exponents of `^`
    /// over 10000, decimals beyond 1e10000 or below 1e-10000, values beyond 2^40000.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// assert_eq!(Exact::parse("-2^2 + 1/4")?.as_rational().unwrap().to_string(), "-15/4");
    /// assert!(Exact::parse("[3, 2]").is_err());
    /// assert!(Exact::parse("nan").is_err());
    /// # Ok::<(), impact_pair_exact::ParseError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Exact, ParseError> {
        if text.len() > LONGEST_TEXT {
            return Err(ParseError::new(0, Problem::TooLong { length: text.len(), limit: LONGEST_TEXT }));
        }
        let mut value = read(text).map_err(|error| error.advised(advice(text)))?;
        // On one line: blanks and line ends between the parts of an expression mean nothing.
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        value.written = Some(Arc::from(words.join(" ")));
        Ok(value)
    }
}

impl FromStr for Exact {
    type Err = ParseError;
    fn from_str(text: &str) -> Result<Exact, ParseError> {
        Exact::parse(text)
    }
}

/// Reads the whole text as an expression or an interval.
fn read(text: &str) -> Result<Exact, ParseError> {
    Reader { text, at: 0, nesting: 0 }.whole()
}

/// A text and how far it has been read.
struct Reader<'t> {
    text: &'t str,
    at: usize,
    nesting: usize,
}

impl Reader<'_> {
    /// An expression or an interval, up to the end of the text.
    fn whole(&mut self) -> Result<Exact, ParseError> {
        let start = self.skip_space();
        let value = if self.take(b'[') {
            let lower = self.expression(Level::Sum)?;
            self.expect(b',', "`+`, `-`, `*`, `/`, `^` or `,` and the upper end")?;
            let upper = self.expression(Level::Sum)?;
            self.expect(b']', "`+`, `-`, `*`, `/`, `^` or `]`")?;
            Exact::interval(&lower, &upper).map_err(|reason| ParseError::new(start, reason))?
        } else {
            self.expression(Level::Sum)?
        };
        self.skip_space();
        if self.at < self.text.len() {
            return Err(self.unexpected(OPERATOR));
        }
        Ok(value)
    }

    /// A sum of products, or one product.
    fn expression(&mut self, level: Level) -> Result<Exact, ParseError> {
        let mut value = self.operand()?;
        loop {
            let at = self.skip_space();
            let result = match self.peek() {
                Some(b'*') => {
                    self.at += 1;
                    value.checked_mul(&self.operand()?)
                }
                Some(b'/') => {
                    self.at += 1;
                    value.checked_div(&self.operand()?)
                }
                Some(b'+') if level == Level::Sum => {
                    self.at += 1;
                    value.checked_add(&self.expression(Level::Product)?)
                }
                Some(b'-') if level == Level::Sum => {
                    self.at += 1;
                    value.checked_sub(&self.expression(Level::Product)?)
                }
                _ => return Ok(value),
            };
            value = result.map_err(|reason| ParseError::new(at, reason))?;
        }
    }

    /// A sign, if one stands here: its place, and whether it is minus. After another sign it is refused: `1.7 +- 0.1` is not 1.6.
    fn sign(&mut self) -> Result<(usize, bool), ParseError> {
        let start = self.skip_space();
        let mut negative = false;
        while let Some(sign @ (b'+' | b'-')) = self.peek() {
            if self.text[..self.at].trim_ascii_end().ends_with(['+', '-']) {
                return Err(ParseError::new(self.at, Problem::TwoSigns));
            }
            negative = sign == b'-';
            self.at += 1;
            self.skip_space();
        }
        Ok((start, negative))
    }

    /// A sign, perhaps, then a number, `pi`, a function call or parentheses, then perhaps a power.
    fn operand(&mut self) -> Result<Exact, ParseError> {
        let (start, negative) = self.sign()?;
        let at = self.at;
        let function = match self.peek() {
            Some(b'(') => None,
            Some(b'0'..=b'9' | b'.') => {
                let number = self.number()?;
                return self.finish(number, at, start, negative);
            }
            Some(b'[') => return Err(ParseError::new(at, Problem::InnerInterval)),
            Some(b'a'..=b'z' | b'A'..=b'Z' | b'_') => {
                let name = self.word();
                match name {
                    "pi" => {
                        self.at += name.len();
                        return self.finish(Exact::pi(), at, start, negative);
                    }
                    "sqrt" => Some(Exact::checked_sqrt as fn(&Exact) -> Result<Exact, ExactError>),
                    "sin" => Some(Exact::checked_sin as fn(&Exact) -> _),
                    "cos" => Some(Exact::checked_cos as fn(&Exact) -> _),
                    _ if ["nan", "inf", "infinity"].contains(&name.to_ascii_lowercase().as_str()) => {
                        return Err(ParseError::new(at, Problem::NotFinite { found: name.to_owned() }));
                    }
                    _ => return Err(self.unexpected(OPERAND)),
                }
            }
            _ => return Err(self.unexpected(OPERAND)),
        };
        self.at += self.word().len();
        self.open()?;
        let inner = self.expression(Level::Sum)?;
        self.close()?;
        let value = function.map_or(Ok(inner.clone()), |function| function(&inner));
        let value = value.map_err(|reason| ParseError::new(at, reason))?;
        self.finish(value, at, start, negative)
    }

    /// An operand that begins at `at`, after a sign at `start`, if it has one: its power, if one follows, and its sign.
    fn finish(&mut self, value: Exact, at: usize, start: usize, negative: bool) -> Result<Exact, ParseError> {
        self.skip_space();
        let value = if self.take(b'^') {
            let n = self.exponent()?;
            value.checked_powi(n).map_err(|reason| ParseError::new(at, reason))?
        } else {
            value
        };
        if negative { value.checked_neg().map_err(|reason| ParseError::new(start, reason)) } else { Ok(value) }
    }

    /// An integer exponent: digits, perhaps signed, in parentheses, or itself with an exponent (`2^3^2` is `2^9`).
    fn exponent(&mut self) -> Result<i64, ParseError> {
        let (start, negative) = self.sign()?;
        let mut value = if self.peek() == Some(b'(') {
            self.open()?;
            let value = self.exponent()?;
            self.close()?;
            value
        } else {
            self.integer()?
        };
        self.skip_space();
        if self.take(b'^') {
            self.enter()?;
            let at = self.skip_space();
            let n = self.exponent()?;
            self.nesting -= 1;
            value = u32::try_from(n)
                .ok()
                .and_then(|n| value.checked_pow(n))
                .filter(|value| value.abs() <= LARGEST_POWER)
                .ok_or_else(|| self.found_at(at, EXPONENT))?;
        }
        if value.abs() > LARGEST_POWER {
            return Err(ParseError::new(start, ExactError::ExponentTooLarge { exponent: value }));
        }
        Ok(if negative { -value } else { value })
    }

    /// The digits of an exponent.
    fn integer(&mut self) -> Result<i64, ParseError> {
        let at = self.at;
        let digits = self.digits();
        let not_an_integer = digits.is_empty() || matches!(self.peek(), Some(b'.' | b'e' | b'E'));
        if not_an_integer {
            return Err(self.found_at(at, EXPONENT));
        }
        // More digits than an i64 holds are too large as well.
        Ok(digits.parse().unwrap_or(i64::MAX)) // exact: refused as too large
    }

    /// A decimal, exactly: digits, a point and more digits, and a power of ten.
    fn number(&mut self) -> Result<Exact, ParseError> {
        let start = self.at;
        let mut digits = self.digits();
        let mut exponent = 0i64;
        if self.take(b'.') {
            let places = self.digits();
            exponent = -(places.len() as i64); // exact: a length
            digits += &places;
        }
        if digits.is_empty() {
            return Err(self.found_at(start, OPERAND));
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            self.at += 1;
            let sign = self.peek();
            if matches!(sign, Some(b'+' | b'-')) {
                self.at += 1;
            }
            let written = self.digits();
            if written.is_empty() {
                return Err(self.unexpected("the digits of a power of ten"));
            }
            // Anything that overflows here lies beyond the limit below; zero times it is zero.
            // exact: refused as too large, or 0
            let written = written.parse::<i64>().unwrap_or(i64::MAX / 4).min(i64::MAX / 4);
            exponent += if sign == Some(b'-') { -written } else { written };
        }
        exact_decimal(&digits, exponent)
            .map(Exact::from_rational)
            .ok_or_else(|| ParseError::new(start, Problem::Magnitude { found: shortened(&self.text[start..self.at]) }))
    }

    /// Digits, without the single underscores that may stand between two of them.
    fn digits(&mut self) -> String {
        let bytes = self.text.as_bytes();
        let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
        let mut digits = String::new();
        loop {
            if is_digit(self.at) {
                digits.push(char::from(bytes[self.at]));
            } else if digits.is_empty() || bytes.get(self.at) != Some(&b'_') || !is_digit(self.at + 1) {
                return digits;
            }
            self.at += 1;
        }
    }

    /// The letters, digits and underscores ahead.
    fn word(&self) -> &str {
        let rest = &self.text[self.at..];
        // exact: a place in the text
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        &rest[..end]
    }

    fn open(&mut self) -> Result<(), ParseError> {
        self.expect(b'(', "`(`")?;
        self.enter()
    }

    fn close(&mut self) -> Result<(), ParseError> {
        self.nesting -= 1;
        self.expect(b')', CLOSING_OPERATOR)
    }

    /// One level deeper.
    fn enter(&mut self) -> Result<(), ParseError> {
        self.nesting += 1;
        if self.nesting > DEEPEST_NESTING {
            return Err(ParseError::new(self.at, Problem::TooNested { limit: DEEPEST_NESTING }));
        }
        Ok(())
    }

    fn expect(&mut self, byte: u8, accepted: &'static str) -> Result<(), ParseError> {
        self.skip_space();
        if self.take(byte) { Ok(()) } else { Err(self.unexpected(accepted)) }
    }

    fn take(&mut self, byte: u8) -> bool {
        let there = self.peek() == Some(byte);
        self.at += usize::from(there);
        there
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// The position after white space.
    fn skip_space(&mut self) -> usize {
        while self.peek().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
        self.at
    }

    fn unexpected(&self, accepted: &'static str) -> ParseError {
        self.found_at(self.at, accepted)
    }

    /// Returns the error for the text at a position: a word, one character, or the end.
    fn found_at(&self, at: usize, accepted: &'static str) -> ParseError {
        // Positions are always at the start of a character, since only ASCII is ever consumed.
        let rest = self.text.get(at..).unwrap_or_default(); // shown
        // shown
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '.')).unwrap_or(rest.len());
        let found = match (rest[..end].is_empty(), rest.chars().next()) {
            (_, None) => "the end".to_owned(),
            (true, Some(other)) => format!("`{}`", other.escape_debug()),
            (false, _) => format!("`{}`", shortened(&rest[..end])),
        };
        ParseError::new(at, Problem::Unexpected { found, accepted })
    }
}

#[cfg(test)]
mod tests;
