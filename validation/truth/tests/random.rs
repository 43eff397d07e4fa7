//! A seeded generator, and how many cases the environment asks for.

use crate::environment::number;

/// splitmix64 (Steele, Lea & Flood 2014): tiny, deterministic, enough for picking test cases.
#[derive(Clone)]
pub struct Random(u64);

impl Random {
    /// The generator of this seed, whatever the environment says.
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    /// Seeded by `IMPACT_PAIR_SEED`, a number or `fresh`, or `fallback`; the seed is printed, so a failure shows it.
    pub fn seeded(fallback: u64) -> Random {
        let seed = number("IMPACT_PAIR_SEED", fallback);
        println!("IMPACT_PAIR_SEED={seed}");
        Random(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, count: u64) -> u64 {
        self.bits() % count
    }

    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len() as u64) as usize]
    }

    pub fn sign(&mut self) -> f64 {
        self.pick(&[1.0, -1.0])
    }

    /// Uniform in [low, high).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// 10 to a uniform power.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.uniform(low, high))
    }
}

/// An eighth of `base` cases, times `IMPACT_PAIR_MULTIPLIER`.
pub fn cases(base: usize) -> usize {
    (base * number("IMPACT_PAIR_MULTIPLIER", 1) as usize).div_ceil(8)
}

/// Does the work on all cores at once.
pub fn on_all_cores(work: impl Fn() + Sync) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| (0..cores).for_each(|_| drop(scope.spawn(&work))));
}
