//! The limits of `check` where tests compare its verdicts on documents.

use impact_pair_certificate::Limits;

use crate::environment::number;

/// Places that are looked at: a sixteenth of the default.
const PLACES: u64 = 1 << 14;

/// The default limits with fewer places, of which `IMPACT_PAIR_MULTIPLIER` allows as many more, up to the default: the documents as they
/// are are confirmed within it, so that a copy is refused for what is changed in it.
pub fn limits() -> Limits {
    let all = Limits::default();
    Limits { work: all.work.min(PLACES.saturating_mul(number("IMPACT_PAIR_MULTIPLIER", 1))), ..all }
}
