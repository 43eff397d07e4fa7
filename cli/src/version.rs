//! The output of `--version`: the program, its arithmetics, and the target of the build.

use std::env::consts::{ARCH, OS};
use std::sync::OnceLock;

use impact_pair::orbit::INARI;

/// The lines after the program's name.
pub fn text() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| {
        let number = env!("CARGO_PKG_VERSION");
        let doubles = "auto, float, interval (53 bits, rounded to nearest, error bounds proved)";
        let inari = if INARI { ", inari (53 bits, rounded outward)" } else { "" };
        let beyond = ", BITS (error bounds proved)";
        let fused = if FUSED { "yes" } else { "no (same results, slower)" };
        format!("{number}\narithmetics: {doubles}{inari}{beyond}\nbuilt for {ARCH} {OS}, CPU features: fma {fused}")
    })
}

/// True if the target has an instruction for fused multiply-add.
const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));
