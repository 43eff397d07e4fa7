//! How an orbit ends: the outcome, whether everything requested is certified, and what leads further.

use std::fmt;

use impact_pair_document::{OrbitHead, counted};

use super::conclusion::Conclusion;
use crate::contact::Reason;
use crate::orbit::{Arithmetic, BITS, GRAZE_BITS, Limit, Orbit, Settings, VERDICT_BITS};
use crate::scene::DIGITS;

/// A change that is known to lead further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advice {
    /// To request fewer digits.
    FewerDigits,
    /// To allow more bits.
    MoreBits,
    /// To let the arithmetic be chosen.
    AutoArithmetic,
    /// To give narrower intervals in the scene.
    NarrowerIntervals,
}

/// The outcome of an orbit, compared with the request.
pub struct Ending<'s> {
    /// The conclusion of the orbit.
    pub conclusion: Conclusion,
    /// The head of the orbit JSON.
    pub head: OrbitHead,
    /// The first impact whose enclosure is wider than the requested digits.
    pub wide: Option<u64>,
    /// The request.
    pub settings: &'s Settings,
    /// The most bits that it was computed with.
    pub bits: u32,
    /// The obstacle to narrower enclosures.
    limit: Limit,
}

impl<'s> Ending<'s> {
    /// Returns the ending of an orbit that has ended, or was left.
    pub fn of(orbit: &Orbit, conclusion: Conclusion, settings: &'s Settings) -> Self {
        let (head, wide, bits) = (orbit.head(), orbit.first_wide(), orbit.bits());
        Self { conclusion, head, wide, settings, bits, limit: orbit.limit() }
    }

    /// Returns whether everything requested is certified, or with `float` computed.
    pub fn is_complete(&self) -> bool {
        self.conclusion.reason().is_none() && self.wide.is_none()
    }

    /// Changes that are each known to lead further; empty where none is known.
    pub fn advice(&self) -> Vec<Advice> {
        use Advice::{AutoArithmetic, FewerDigits, MoreBits, NarrowerIntervals};
        let Settings { arithmetic, digits, max_bits, .. } = *self.settings;
        let reason = self.conclusion.reason();
        let are_bits_spent = self.bits >= max_bits;
        let has_fewer = digits > *DIGITS.start();
        let has_more = max_bits < *BITS.end();
        let if_possible = |advice: &[(bool, Advice)]| -> Vec<Advice> {
            advice.iter().filter(|(is_possible, _)| *is_possible).map(|(_, advice)| *advice).collect()
        };
        match (arithmetic, self.limit, reason) {
            _ if self.is_complete() || reason == Some(Reason::Budget) => Vec::new(),
            (Arithmetic::Float, ..) | (_, Limit::Lasting, _) => Vec::new(),
            (Arithmetic::Shadow, _, None) => if_possible(&[(has_fewer, FewerDigits)]),
            (Arithmetic::Shadow, ..) => Vec::new(),
            (_, Limit::Intervals, Some(Reason::Width)) => vec![NarrowerIntervals],
            (_, Limit::Intervals, None) => vec![FewerDigits, NarrowerIntervals],
            (_, Limit::Intervals, Some(_)) => Vec::new(),
            (Arithmetic::Auto, Limit::Bits, Some(Reason::Precision)) if are_bits_spent => {
                if_possible(&[(has_fewer, FewerDigits), (has_more, MoreBits)])
            }
            (Arithmetic::Auto, Limit::Bits, Some(Reason::Width)) => {
                if_possible(&[(are_bits_spent && has_more, MoreBits)])
            }
            (Arithmetic::Auto, ..) => Vec::new(),
            // What these bits do not decide auto does not either.
            (Arithmetic::Bits(VERDICT_BITS..), _, Some(Reason::Graze)) => Vec::new(),
            (Arithmetic::Bits(GRAZE_BITS..), Limit::Graze, _) => Vec::new(),
            (Arithmetic::Bits(bits), ..) => if_possible(&[(bits < max_bits, AutoArithmetic)]),
            (Arithmetic::Interval | Arithmetic::Inari, ..) => vec![AutoArithmetic],
        }
    }
}

/// The outcome in words, and the first impact that is wider than requested.
impl fmt::Display for Ending<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = self.conclusion.message();
        match (self.conclusion.reason(), self.settings.arithmetic.is_certified()) {
            (Some(_), _) => f.write_str(message)?,
            (None, true) => write!(f, "certified: {message}")?,
            (None, false) => write!(f, "computed, not certified: {message}")?,
        }
        if let Some(index) = self.wide {
            write!(f, "; impact {index} is the first one wider than {}", counted(self.settings.digits, "digit"))?;
        }
        Ok(())
    }
}
