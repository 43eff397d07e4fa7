//! The arithmetics that are measured, and when more bits do not help.

use std::fmt;

use impact_pair::orbit::{Arithmetic, BITS, Settings};

/// Digits that are requested of `auto`.
const DIGITS: [u32; 5] = [3, 9, 15, 30, 100];
/// Numbers of fixed bits without progress in impacts after which no more bits are measured: the first may just miss an impact.
const MAX_FRUITLESS_ROWS: u32 = 2;

/// An arithmetic with its precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TradeArithmetic {
    /// Plain doubles.
    Float,
    /// Certified in doubles.
    Interval,
    /// The textbook method.
    Inari,
    /// Certified bounds of one true orbit near the given one.
    Shadow,
    /// Certified with this number of bits.
    Bits(u32),
    /// Certified to this number of digits.
    Auto(u32),
}

impl TradeArithmetic {
    /// Settings of an orbit in this arithmetic, of the requested length.
    pub(super) fn settings(self, requested: &Settings) -> Settings {
        let settings = |arithmetic| Settings { arithmetic, ..requested.clone() };
        match self {
            Self::Float => settings(Arithmetic::Float),
            Self::Interval => settings(Arithmetic::Interval),
            Self::Inari => settings(Arithmetic::Inari),
            Self::Shadow => settings(Arithmetic::Shadow),
            Self::Bits(bits) => settings(Arithmetic::Bits(bits)),
            Self::Auto(digits) => Settings { digits, ..settings(Arithmetic::Auto) },
        }
    }
}

impl fmt::Display for TradeArithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&match self {
            Self::Float => "float".to_owned(),
            Self::Interval => "interval".to_owned(),
            Self::Inari => "inari".to_owned(),
            Self::Shadow => "shadow".to_owned(),
            Self::Bits(bits) => format!("{bits} bits"),
            Self::Auto(digits) => format!("auto, {digits} digits"),
        })
    }
}

/// The arithmetics to measure, one after another; the number of those of fixed bits depends on the results.
#[derive(Clone, Debug)]
pub(super) struct TradeSchedule {
    next: Option<TradeArithmetic>,
    max_bits: u32,
    /// True if the textbook method is measured: it is known for one harmonic only, and in a build with the feature `inari`.
    textbook: bool,
    /// The greatest number of impacts reached with fixed bits, and the number of steps since without progress.
    reached: u64,
    idle: u32,
}

impl TradeSchedule {
    pub fn new(max_bits: u32, textbook: bool) -> Self {
        Self { next: Some(TradeArithmetic::Float), max_bits, textbook, reached: 0, idle: 0 }
    }

    /// The arithmetic to measure.
    pub fn arithmetic(&self) -> Option<TradeArithmetic> {
        self.next
    }

    /// Advances after an arithmetic has reached `impacts` impacts, or all requested ones.
    pub fn advance(&mut self, impacts: u64, all: bool) {
        let auto = Some(TradeArithmetic::Auto(DIGITS[0]));
        self.next = match self.next {
            Some(TradeArithmetic::Float) => Some(TradeArithmetic::Interval),
            Some(TradeArithmetic::Interval) if self.textbook => Some(TradeArithmetic::Inari),
            Some(TradeArithmetic::Interval | TradeArithmetic::Inari) => Some(TradeArithmetic::Shadow),
            Some(TradeArithmetic::Shadow) => Some(TradeArithmetic::Bits(*BITS.start())),
            Some(TradeArithmetic::Bits(bits)) => {
                self.idle = if impacts > self.reached { 0 } else { self.idle + 1 };
                self.reached = self.reached.max(impacts);
                let double = bits.checked_mul(2).filter(|&double| double <= self.max_bits && !all);
                double.filter(|_| self.idle < MAX_FRUITLESS_ROWS).map(TradeArithmetic::Bits).or(auto)
            }
            Some(TradeArithmetic::Auto(digits)) => {
                DIGITS.into_iter().find(|&more| more > digits).map(TradeArithmetic::Auto)
            }
            None => None,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names of the arithmetics measured if `bits` bits reach `reach(bits)` of 100 impacts.
    fn measured_names(max_bits: u32, reach: impl Fn(u32) -> u64) -> Vec<String> {
        let mut schedule = TradeSchedule::new(max_bits, true);
        let mut names = Vec::new();
        while let Some(arithmetic) = schedule.arithmetic() {
            names.push(arithmetic.to_string());
            let impacts = if let TradeArithmetic::Bits(bits) = arithmetic { reach(bits) } else { 100 };
            schedule.advance(impacts, impacts == 100);
        }
        names
    }

    #[test]
    fn bits_double_until_all_impacts_are_reached() {
        let names = measured_names(1_000_000, |bits| u64::from(bits / 4).min(100));
        assert_eq!(names[..4], ["float", "interval", "inari", "shadow"]);
        assert_eq!(names[4..8], ["64 bits", "128 bits", "256 bits", "512 bits"]);
        assert_eq!(names[8..11], ["auto, 3 digits", "auto, 9 digits", "auto, 15 digits"]);
        assert_eq!(names[11..], ["auto, 30 digits", "auto, 100 digits"]);
    }

    #[test]
    fn bits_that_bring_nothing_twice_are_the_last() {
        assert_eq!(measured_names(1_000_000, |_| 20)[4..8], ["64 bits", "128 bits", "256 bits", "auto, 3 digits"]);
        assert_eq!(measured_names(1_000_000, |_| 0)[4..7], ["64 bits", "128 bits", "auto, 3 digits"]);
        assert_eq!(measured_names(200, |_| 20)[4..7], ["64 bits", "128 bits", "auto, 3 digits"]);
    }
}
