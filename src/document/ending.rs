//! The last line of a table: the outcome, and whether everything requested is certified.

use std::fmt;

use impact_pair_document::ArithmeticDocument;

use super::conclusion::Conclusion;
use super::orbit::{arithmetic, is_certified};
use crate::contact::Reason;
use crate::orbit::{Arithmetic, MULTIPRECISION, Orbit, Settings, VERDICT_BITS};

/// The outcome of an orbit, compared with the request.
pub struct Ending<'s> {
    /// The conclusion of the orbit.
    pub conclusion: Conclusion,
    /// The arithmetic, as in the orbit JSON.
    pub computed: ArithmeticDocument,
    /// The first impact whose enclosure is wider than the requested digits.
    pub wide: Option<u64>,
    /// The request.
    pub settings: &'s Settings,
    /// The most bits that it was computed with.
    pub bits: u32,
}

impl<'s> Ending<'s> {
    /// Returns the ending of an orbit that has ended, or was left.
    pub fn of(orbit: &Orbit, conclusion: Conclusion, settings: &'s Settings) -> Self {
        let (computed, wide, bits) = (arithmetic(orbit), orbit.first_wide(), orbit.bits());
        Self { conclusion, computed, wide, settings, bits }
    }

    /// Returns whether everything requested is certified, or with `float` computed.
    pub fn is_complete(&self) -> bool {
        self.conclusion.reason().is_none() && self.wide.is_none()
    }

    /// Returns advice on other settings, if they would help.
    fn hint(&self) -> Option<&'static str> {
        let reason = self.conclusion.reason().filter(|reason| *reason != Reason::Budget);
        match (self.settings.arithmetic, reason) {
            (Arithmetic::Auto, Some(Reason::Precision)) if MULTIPRECISION => {
                Some("try fewer --digits or more --max-bits")
            }
            (Arithmetic::Auto, Some(Reason::Precision)) => {
                Some("try fewer --digits, or --arithmetic interval, which continues with wider enclosures")
            }
            (Arithmetic::Bits(VERDICT_BITS..), _) => None,
            (Arithmetic::Interval | Arithmetic::Inari | Arithmetic::Bits(_), _)
                if reason.is_some() || self.wide.is_some() =>
            {
                Some("try --arithmetic auto")
            }
            (Arithmetic::Shadow, None) if self.wide.is_some() => Some("try fewer --digits"),
            // Of point data more bits make every enclosure narrower.
            (Arithmetic::Auto, Some(Reason::Width)) if MULTIPRECISION => {
                Some("narrower intervals in the scene lead further")
            }
            // Of intervals more bits were not tried.
            (Arithmetic::Auto, Some(Reason::Graze)) if self.bits >= VERDICT_BITS => {
                Some("8192 bits do not decide; try --arithmetic with more, such as 65536")
            }
            (Arithmetic::Auto, None) if self.wide.is_some() => {
                Some("try fewer --digits, or narrower intervals in the scene")
            }
            _ => None,
        }
    }
}

impl fmt::Display for Ending<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = self.conclusion.message();
        match (self.conclusion.reason(), is_certified(self.settings.arithmetic)) {
            (Some(_), _) => f.write_str(message)?,
            (None, true) => write!(f, "certified: {message}")?,
            (None, false) => write!(f, "computed, not certified: {message}")?,
        }
        if let Some(index) = self.wide {
            write!(f, "; impact {index} is the first one wider than {} digits", self.settings.digits)?;
        }
        self.hint().map_or(Ok(()), |hint| write!(f, "; {hint}"))
    }
}
