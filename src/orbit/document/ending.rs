//! The last line of a table: the outcome, and whether everything requested is certified.

use std::fmt;

use impact_pair_document::{OrbitHead, counted};

use super::conclusion::Conclusion;
use crate::contact::Reason;
use crate::orbit::{Arithmetic, BITS, GRAZE_BITS, Limit, Orbit, Settings, VERDICT_BITS};
use crate::scene::DIGITS;

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

    /// Returns advice on what leads further, where something is known to.
    fn advice(&self) -> Option<&'static str> {
        let Settings { arithmetic, digits, max_bits, .. } = *self.settings;
        let reason = self.conclusion.reason();
        let are_bits_spent = self.bits >= max_bits;
        let has_fewer = digits > *DIGITS.start();
        let has_more = max_bits < *BITS.end();
        match (arithmetic, self.limit, reason) {
            _ if self.is_complete() || reason == Some(Reason::Budget) => None,
            (Arithmetic::Float, ..) | (_, Limit::Lasting, _) => None,
            (Arithmetic::Shadow, _, None) => has_fewer.then_some("try fewer --digits"),
            (Arithmetic::Shadow, ..) => None,
            (_, Limit::Intervals, Some(Reason::Width)) => Some("narrower intervals in the scene lead further"),
            (_, Limit::Intervals, None) => Some("try fewer --digits, or narrower intervals in the scene"),
            (_, Limit::Intervals, Some(_)) => None,
            (Arithmetic::Auto, Limit::Bits, Some(Reason::Precision)) if are_bits_spent => match (has_fewer, has_more) {
                (true, true) => Some("try fewer --digits or more --max-bits"),
                (true, false) => Some("try fewer --digits"),
                (false, true) => Some("try more --max-bits"),
                (false, false) => None,
            },
            (Arithmetic::Auto, Limit::Bits, Some(Reason::Width)) => {
                (are_bits_spent && has_more).then_some("try more --max-bits")
            }
            (Arithmetic::Auto, ..) => None,
            // What these bits do not decide auto does not either.
            (Arithmetic::Bits(VERDICT_BITS..), _, Some(Reason::Graze)) => None,
            (Arithmetic::Bits(GRAZE_BITS..), Limit::Graze, _) => None,
            (Arithmetic::Bits(bits), ..) => (bits < max_bits).then_some("try --arithmetic auto"),
            (Arithmetic::Interval | Arithmetic::Inari, ..) => Some("try --arithmetic auto"),
        }
    }
}

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
        self.advice().map_or(Ok(()), |advice| write!(f, "; {advice}"))
    }
}
