//! What `--version` says: the program, its arithmetics, and what it was built for.

use std::env::consts::{ARCH, OS};
use std::sync::OnceLock;

/// The lines after the program's name.
pub fn text() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| {
        let number = env!("CARGO_PKG_VERSION");
        let doubles = "auto, float, interval (53 bits, rounded to nearest, error bounds proved), inari (53 bits, rounded outward)";
        let (beyond, features) = beyond_doubles();
        let fused = if FUSED { "yes" } else { "no (same results, slower)" };
        format!(
            "{number}\narithmetics: {doubles}{beyond}\nfeatures: {features}\nbuilt for {ARCH} {OS}, CPU features: fma {fused}"
        )
    })
}

/// Whether a fused product and sum is one instruction.
const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

#[cfg(feature = "multiprecision")]
fn beyond_doubles() -> (String, &'static str) {
    let mpfr = impact_pair::number::mpfr_version();
    (format!(", BITS (MPFR {mpfr}, correctly rounded, error bounds proved)"), "multiprecision")
}

#[cfg(not(feature = "multiprecision"))]
fn beyond_doubles() -> (String, &'static str) {
    (String::new(), "none (built without multiprecision)")
}
