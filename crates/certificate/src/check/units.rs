//! The units of the reduced map, exactly: amplitudes for lengths, the greatest speed of the box for speeds.

use impact_pair_exact::Exact;
use impact_pair_model::{Error, Harmonic, ImpactPair, within};

/// The forcing period `2 pi/W` \[time\].
pub(super) fn period(harmonic: &Harmonic) -> Result<Exact, Error> {
    let turn = Exact::pi() * Exact::from(2);
    within("excitation.frequency", harmonic.frequency(), turn.checked_div(harmonic.frequency()))
}

/// The greatest speed of the box, `A W` \[length/time\].
pub(super) fn greatest_speed(harmonic: &Harmonic) -> Result<Exact, Error> {
    let speed = harmonic.amplitude().checked_mul(harmonic.frequency());
    within("excitation.frequency", harmonic.frequency(), speed)
}

/// `d/A`, with the amplitude of a harmonic.
pub(super) fn ratio(pair: &ImpactPair, harmonic: &Harmonic) -> Result<Exact, Error> {
    within("pair.gap / excitation.amplitude", pair.gap(), pair.gap().checked_div(harmonic.amplitude()))
}
