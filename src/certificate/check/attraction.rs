//! What is claimed of a periodic orbit that the motion converges to.
//!
//! The route: from the claimed impacts, confirmed before as theorems, the library proves the orbit and its neighbourhood
//! again, the orbit to more digits than are claimed. This is Lemma Q3 of `docs/proofs.md` as `run` uses it: the one part
//! of a check that is no second route.

use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use super::contact::Doubt;
use crate::certificate::attraction::Attraction;
use crate::certificate::{Certificate, Claim, ClaimKind};
use crate::document::Units;
use crate::exact::{Dyadic, Enclosure, Exact, decimal_digits};
use crate::number::Ball;
use crate::periodic::{Attractor, Passing, PeriodicOrbit, Problem, find_attractor};
use crate::turns;

/// Bits of the conversions of claimed bounds to turns and gaps.
const BITS: u32 = 640;
/// The orbit is proved to so many digits more than are claimed, and to so many at most.
const MORE_DIGITS: u32 = 5;
const MOST_DIGITS: u32 = 200;

impl Certificate {
    /// Proves again that the motion converges to the orbit claimed, where that is claimed.
    pub(super) fn attracts(&self) -> Result<(), Doubt> {
        if self.outcome() != "attracted" {
            return Ok(());
        }
        let claim = self.attraction().ok_or_else(|| Doubt::False("the outcome has no orbit".into()))?;
        if !claim.is_attractor {
            return Err(Doubt::False("only an orbit that is unique, physical and stable is an attractor".into()));
        }
        let open = |message: &str| Doubt::Open(message.into());
        self.pair().harmonic("an attractor").map_err(|error| open(&error.to_string()))?;
        let states = self.states().ok_or_else(|| open("the impacts are beyond doubles"))?;
        let problem = |word: &_, cycles| {
            let is_it = *word == claim.word && u64::from(cycles) == claim.cycles;
            is_it.then(|| Problem::new(self.pair(), word, cycles).ok()).flatten()
        };
        let found = find_attractor(&states, claim.digits(), problem)
            .ok_or_else(|| open("the motion is not proved to converge to such an orbit"))?;
        if found.from > claim.from {
            return Err(Doubt::Open(format!("that is proved only from impact {} on", found.from)));
        }
        self.compare(claim, &found)
    }

    /// The claimed impacts in turns and gaps a turn.
    fn states(&self) -> Option<Vec<Passing>> {
        let excitation = self.pair().excitation().reference();
        let turn = Exact::pi() * Exact::from(2);
        let rate = excitation.frequency().checked_div(&turn).ok()?.enclose(BITS);
        let shift = excitation.phase().checked_div(&turn).ok()?.enclose(BITS);
        let slowness =
            turn.checked_div(&excitation.frequency().checked_mul(self.pair().gap()).ok()?).ok()?.enclose(BITS);
        let ball = |x: Enclosure| {
            let (mid, rad) = x.mid_rad();
            (mid.is_finite() && rad.is_finite()).then(|| Ball::new(mid, rad))
        };
        let state = |claim: &Claim| {
            let ClaimKind::Impact { index, velocity, .. } = &claim.kind else { return None };
            let passing = || {
                let phase = enclosure(&claim.time).mul(&rate, BITS).add(&shift, BITS);
                let whole = phase.lo().to_rational().round(); // Q3: any whole number of turns
                let rest = ball(phase.sub(&Enclosure::from_rational(&whole, BITS), BITS))?;
                let velocity = ball(enclosure(velocity).mul(&slowness, BITS))?;
                Some(Passing {
                    index: *index,
                    wall: claim.wall,
                    turns: turns::later(0, whole.to_i64()?)?,
                    phase: rest,
                    velocity,
                })
            };
            Some(passing())
        };
        self.events().iter().filter_map(state).collect()
    }

    /// All that is found of the orbit lies inside the claimed bounds.
    fn compare(&self, claim: &Attraction, found: &Attractor) -> Result<(), Doubt> {
        let PeriodicOrbit { impacts, trace, determinant, eigenvalues: [one, other], symmetric, bits, .. } =
            &found.orbit;
        let document = Units::new(self.pair()).map_err(|error| Doubt::Open(error.to_string()))?;
        match symmetric {
            None => return Err(Doubt::Open("it is not decided whether the orbit is symmetric".into())),
            symmetric if *symmetric != claim.symmetric => {
                return Err(Doubt::False("whether the orbit is symmetric is claimed wrongly".into()));
            }
            Some(_) => {}
        }
        if claim.impacts.len() != impacts.len() {
            return Err(Doubt::False(format!("the orbit has {} impacts", impacts.len())));
        }
        let phases: Vec<_> = impacts.iter().map(|impact| turns::in_radians(&impact.phase, *bits)).collect();
        // One shift for the whole orbit: its impacts come at their distances.
        let first = claim.impacts.first().zip(phases.first());
        let shift = first.and_then(|((_, [claimed, _]), found)| turns_between(found, claimed));
        let shift = shift.unwrap_or_else(|| Enclosure::point(Dyadic::zero()));
        for ((claimed, found), phase) in claim.impacts.iter().zip(impacts).zip(phases) {
            let (wall, [claimed_phase, claimed_velocity]) = claimed;
            if *wall != found.wall {
                return Err(Doubt::False("an impact of the orbit is on the other wall".into()));
            }
            inside("phase", &phase.add(&shift, BITS + 64), claimed_phase)?;
            inside("velocity", &document.velocity(&found.velocity, *bits), claimed_velocity)?;
        }
        let numbers = [trace, determinant, &one.re, &one.im, &other.re, &other.im];
        numbers.into_iter().zip(&claim.numbers).try_for_each(|(found, claimed)| inside("number", found, claimed))
    }
}

impl Attraction {
    /// Digits enough to be narrower than what is claimed.
    fn digits(&self) -> u32 {
        let widths = self.impacts.iter().flat_map(|(_, bounds)| bounds).map(|[lower, upper]| upper - lower);
        let narrowest = widths.filter(Signed::is_positive).min();
        let digits = narrowest.and_then(|width| width.to_f64()).map_or(0.0, |width| -width.log10());
        (digits.max(0.0) as u32).saturating_add(MORE_DIGITS).min(MOST_DIGITS) // proposes: digits to prove the orbit to
    }
}

/// The whole turns that bring a phase nearest to the claimed one, in radians; `None` beyond doubles.
fn turns_between(phase: &Enclosure, [lower, upper]: &[BigRational; 2]) -> Option<Enclosure> {
    let middle = lower.to_f64().zip(upper.to_f64()).map_or(0.0, |(lower, upper)| 0.5 * (lower + upper));
    let turns = ((middle - phase.mid_rad().0) / std::f64::consts::TAU).round(); // Q3: any whole number of turns
    let twice = Enclosure::from_f64_bounds(2.0 * turns, 2.0 * turns)?;
    Some(Enclosure::pi(BITS + 64).mul(&twice, BITS + 64))
}

fn enclosure([lower, upper]: &[BigRational; 2]) -> Enclosure {
    Enclosure::from_rational(lower, BITS).hull(&Enclosure::from_rational(upper, BITS))
}

/// What is found lies inside the claimed bounds.
fn inside(what: &str, found: &Enclosure, [lower, upper]: &[BigRational; 2]) -> Result<(), Doubt> {
    let (lo, hi) = (found.lo().to_rational(), found.hi().to_rational());
    let shown = decimal_digits(&found.rounded(160));
    if lower <= &lo && &hi <= upper {
        Ok(())
    } else if &hi < lower || upper < &lo {
        Err(Doubt::False(format!("the true {what} of the orbit is {shown}")))
    } else {
        Err(Doubt::Open(format!("the true {what} of the orbit, {shown}, is not proved to be inside")))
    }
}
