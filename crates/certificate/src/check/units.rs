//! The units of the reduced map, exactly: lengths are in amplitudes, speeds in the greatest one of the box.

use impact_pair_exact::Exact;
use impact_pair_model::{Error, Harmonic, ImpactPair, within};

/// Returns the forcing period `2 pi/W` \[time\].
pub(super) fn period(harmonic: &Harmonic) -> Result<Exact, Error> {
    let turn = Exact::pi() * Exact::from(2);
    within("excitation.frequency", harmonic.frequency(), turn.checked_div(harmonic.frequency()))
}

/// Returns the greatest speed of the box `A W` \[length/time\].
pub(super) fn greatest_speed(harmonic: &Harmonic) -> Result<Exact, Error> {
    let speed = harmonic.amplitude().checked_mul(harmonic.frequency());
    within("excitation.frequency", harmonic.frequency(), speed)
}

/// Returns `d/A`, of the amplitude of a harmonic.
pub(super) fn ratio(pair: &ImpactPair, harmonic: &Harmonic) -> Result<Exact, Error> {
    within("pair.gap / excitation.amplitude", pair.gap(), pair.gap().checked_div(harmonic.amplitude()))
}
