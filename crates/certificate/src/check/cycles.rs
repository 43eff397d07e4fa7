//! Check of a JSON of all cycles: the orbits exist, none is a shorter orbit run through several times, and no two are the same
//! (Lemma D23). Completeness of the list is not checked.

use std::collections::BTreeMap;

use num_rational::BigRational;

use super::contact::Doubt;
use super::{Finding, Limits, Verdict};
use crate::attraction::{Bounds, ClaimedOrbit, Passage};
use crate::cycles::CyclesCertificate;
use impact_pair_exact::Enclosure;
use impact_pair_model::watch::Watch;
use impact_pair_model::{Error, Wall};

/// Bits of pi in comparisons of phases of different forcing periods.
const BITS: u32 = 256;

impl CyclesCertificate {
    /// Proves every orbit again, that the orbits are different, and that the counts are right. Otherwise names the first claim that is
    /// refuted or undecided. The watch can stop the check and receives the orbits confirmed so far.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let whole = self.orbits.count();
        if let Some(message) = self.contradiction.as_deref() {
            return Ok(Verdict::Refuted(Finding { event: whole, message: message.to_owned() }));
        }
        let verdict = self.orbits.check_within(limits, watch)?;
        Ok(match (verdict, self.are_different()) {
            (verdict @ Verdict::Confirmed { .. }, Ok(())) => verdict,
            (Verdict::Confirmed { .. }, Err(doubt)) => doubt.on(whole),
            (verdict, _) => verdict,
        })
    }

    /// Proves that no two orbits are the same or mirror images: for each choice of the first impact the bounds of some impact are
    /// disjoint.
    fn are_different(&self) -> Result<(), Doubt> {
        let turn = Turn::new();
        let mut known: BTreeMap<Vec<bool>, Vec<(usize, &[Passage])>> = BTreeMap::new();
        for (i, claim) in self.orbits.orbits.iter().enumerate() {
            let impacts = &claim.orbit.impacts[..];
            let likes = known.entry(flights(impacts)).or_default();
            if let Some((j, _)) = likes.iter().find(|(_, other)| turn.may_be_same(impacts, other)) {
                return Err(Doubt::Open(format!("orbits[{j}] and orbits[{i}] are not proved to be two")));
            }
            likes.push((i, impacts));
        }
        Ok(())
    }
}

/// For each flight of an orbit, whether it leads to the other wall; the greatest rotation, so independent of first impact and mirror.
fn flights(impacts: &[Passage]) -> Vec<bool> {
    let count = impacts.len();
    let from = |shift: usize| -> Vec<bool> {
        (shift..shift + count).map(|i| impacts[i % count].wall != impacts[(i + 1) % count].wall).collect()
    };
    (0..count).map(from).max().unwrap_or_default() // exact: none of none
}

/// Whether two orbits may be the same, or mirror images, by their bounds.
pub(super) fn may_be_same(one: &ClaimedOrbit, other: &ClaimedOrbit) -> bool {
    Turn::new().may_be_same(&one.impacts, &other.impacts)
}

/// Bounds of `pi`.
struct Turn {
    half: Bounds,
}

impl Turn {
    fn new() -> Self {
        let pi = Enclosure::pi(BITS);
        Self { half: [pi.inf().to_rational(), pi.sup().to_rational()] }
    }

    /// Whether two orbits may be the same, or mirror images, by their bounds.
    fn may_be_same(&self, a: &[Passage], b: &[Passage]) -> bool {
        let all = (0..b.len()).flat_map(|shift| [(shift, false), (shift, true)]);
        all.into_iter().any(|(shift, is_mirrored)| self.may_be_one(a, b, shift, is_mirrored))
    }

    /// Whether `b`, or its mirror image, may be `a` with impact `shift` of `b` as the first impact, by the bounds.
    fn may_be_one(&self, a: &[Passage], b: &[Passage], shift: usize, is_mirrored: bool) -> bool {
        let on = |wall: Wall| if is_mirrored { wall.other() } else { wall };
        a.len() == b.len()
            && (0..a.len()).all(|i| {
                let (one, other) = (&a[i], &b[(i + shift) % b.len()]);
                let [low, high] = &other.velocity;
                let velocity = if is_mirrored { [-high, -low] } else { other.velocity.clone() };
                one.wall == on(other.wall)
                    && overlap(&one.velocity, &velocity)
                    && self.phases_overlap(&one.phase, &other.phase, is_mirrored)
            })
    }

    /// Whether two phases may be equal modulo whole forcing periods, with half a forcing period added to the second if
    /// `is_mirrored`; both have lower bounds in `[0, 2 pi]`.
    fn phases_overlap(&self, one: &Bounds, other: &Bounds, is_mirrored: bool) -> bool {
        (-2..=2).any(|turns| {
            let halves = 2 * turns + i32::from(is_mirrored);
            let [low, high] = self.half.each_ref().map(|half| half * BigRational::from_integer(halves.into()));
            let [low, high] = if halves < 0 { [high, low] } else { [low, high] };
            overlap(one, &[&other[0] + low, &other[1] + high])
        })
    }
}

fn overlap(one: &Bounds, other: &Bounds) -> bool {
    one[0] <= other[1] && other[0] <= one[1]
}
