//! Values of options: how they are read, and what is accepted.

use std::ops::RangeInclusive;

use clap::Args;
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::orbit::{BITS, MAX_BITS};
use impact_pair::periodic::Precision;
use impact_pair::scene::DIGITS;

/// The arithmetics, as they are typed.
pub const ARITHMETICS: &str = "auto|float|interval|inari|shadow|BITS";

/// How narrow enclosures are requested. What their widths are relative to, each verb says by `mut_arg("digits", ..)`.
#[derive(Args, Clone, Debug)]
pub struct PrecisionArguments {
    /// Requested width of enclosures, at most 10^-D
    #[arg(long, value_name = "D", value_parser = digits())]
    digits: Option<u32>,
    /// Maximum precision, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    max_bits: u32,
}

impl PrecisionArguments {
    /// The digits of the command line, or else of the scene, or else the usual ones.
    pub fn of(&self, scene: &Scene) -> Precision {
        let digits = self.digits.or(scene.run().digits).unwrap_or(Precision::default().digits);
        Precision { digits, max_bits: self.max_bits }
    }
}

/// Reads a number of digits.
pub fn digits() -> impl Fn(&str) -> Result<u32, String> + Clone {
    whole(DIGITS)
}

/// Reads a number of bits.
pub fn bits() -> impl Fn(&str) -> Result<u32, String> + Clone {
    whole(BITS)
}

/// Reads a whole number of this range.
pub fn whole(range: RangeInclusive<u32>) -> impl Fn(&str) -> Result<u32, String> + Clone {
    let number = count(u64::from(*range.start())..=u64::from(*range.end()));
    // exact: in the range
    move |text| number(text).map(|number| number as u32)
}

/// Reads how many: a whole number of this range.
pub fn count(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<u64, String> + Clone {
    let accepted = match range.clone().into_inner() {
        (least, u64::MAX) => format!("accepted is a whole number, {least} or greater"),
        (least, most) => format!("accepted is a whole number from {least} to {most}"),
    };
    move |text| match text.parse() {
        Ok(number) if range.contains(&number) => Ok(number),
        Ok(_) => Err(accepted.clone()),
        Err(_) => {
            // 1e5, 1,000
            let meant = Exact::parse(text).ok().and_then(|number| number.as_rational().map(ToString::to_string));
            let meant = meant.unwrap_or_else(|| text.replace([',', '_', ' ', '\''], ""));
            let hint = if meant.parse::<u64>().is_ok() { format!("; did you mean {meant}?") } else { String::new() };
            Err(format!("{accepted}{hint}"))
        }
    }
}

/// Reads whole numbers of this range: one, or from the first to the last one.
pub fn numbers(accepted: RangeInclusive<u32>) -> impl Fn(&str) -> Result<RangeInclusive<u32>, String> + Clone {
    move |text| {
        let (low, high) = text.split_once("..").unwrap_or((text, text));
        let number = |text: &str| text.trim().parse().ok().filter(|number| accepted.contains(number));
        match (number(low), number(high)) {
            (Some(low), Some(high)) if low <= high => Ok(low..=high),
            _ => {
                let (least, most) = (accepted.start(), accepted.end());
                Err(format!("accepted is an integer from {least} to {most}, or a range of them such as 1..5"))
            }
        }
    }
}

/// Reads a single exact number.
pub fn point(text: &str) -> Result<Exact, String> {
    let unit = || match text.trim().split_once(' ') {
        Some((number, unit)) if Exact::parse(number).is_ok() && unit.trim().chars().all(char::is_alphabetic) => {
            format!("; numbers are in the units of the scene and have none of their own: did you mean {number}?")
        }
        _ => String::new(),
    };
    let number = Exact::parse(text).map_err(|error| format!("{error}{}", unit()))?;
    if number.is_point() { Ok(number) } else { Err("accepted is a single number, not an interval".into()) }
}

/// Reads a range on an axis of a picture: about what its ends are.
pub fn window(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| Ok::<f64, String>(point(text)?.enclose(64).mid_rad().0);
    let (low, high) = text.split_once("..").ok_or("accepted is a range such as 0.2..0.5")?;
    match (number(low)?, number(high)?) {
        (low, high) if low < high => Ok([low, high]),
        _ => Err("accepted is a range whose lower end comes first".into()),
    }
}
