//! The output of `--version`: the program, its arithmetics, and the target of the build.

use std::env::consts::{ARCH, OS};
use std::sync::OnceLock;

/// The lines after the program's name.
pub fn text() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| {
        let number = env!("CARGO_PKG_VERSION");
        let doubles = "auto, float, interval (53 bits, rounded to nearest, error bounds proved)";
        let inari = if cfg!(feature = "inari") { ", inari (53 bits, rounded outward)" } else { "" };
        let (beyond, features) = (beyond_doubles(), features());
        let fused = if FUSED { "yes" } else { "no (same results, slower)" };
        format!(
            "{number}\narithmetics: {doubles}{inari}{beyond}\nfeatures: {features}\nbuilt for {ARCH} {OS}, CPU features: fma {fused}"
        )
    })
}

/// True if the target has an instruction for fused multiply-add.
const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// The features of the build.
fn features() -> String {
    let all = [("multiprecision", cfg!(feature = "multiprecision")), ("inari", cfg!(feature = "inari"))];
    let built: Vec<&str> = all.into_iter().filter_map(|(name, is_built)| is_built.then_some(name)).collect();
    if built.is_empty() { "none".to_owned() } else { built.join(", ") }
}

#[cfg(feature = "multiprecision")]
fn beyond_doubles() -> String {
    ", BITS (error bounds proved)".to_owned()
}

#[cfg(not(feature = "multiprecision"))]
fn beyond_doubles() -> String {
    String::new()
}
