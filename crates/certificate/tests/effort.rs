//! The effort that `check` may take where tests compare its verdicts on documents.

use impact_pair_certificate::Effort;

use crate::environment::number;

/// Places that are looked at: a sixteenth of the default.
const PLACES: u64 = 1 << 14;

/// The default effort with fewer places, of which `IMPACT_PAIR_MULTIPLIER` allows as many more, up to the default: the documents as they
/// are are confirmed within it, so that a copy is refused for what is changed in it.
pub fn effort() -> Effort {
    let all = Effort::default();
    Effort { work: all.work.min(PLACES.saturating_mul(number("IMPACT_PAIR_MULTIPLIER", 1))), ..all }
}
