//! The impact after the last listed impact, which proves that no other impact comes before a time.

use crate::check::{Data, Piece, Walk};
use crate::{Certificate, Claim};
use impact_pair_exact::{Exact, Real, decimal_bounds};
use impact_pair_model::EventKind;
use num_rational::BigRational;

/// Bits of the first precision of the search, and the number of precisions, each with twice the bits of the one before.
const BITS: u32 = 256;
const PRECISIONS: u32 = 6;
/// Bits of the printed bounds.
const PRINTED_BITS: u32 = 96;

impl Certificate {
    /// The first impact after all listed impacts, if the impact is proved to come after `until`.
    pub(super) fn next_after(&self, data: &Data, until: &Exact) -> Option<Claim> {
        (0..PRECISIONS).find_map(|n| self.next_in(BITS << n, data, until))
    }

    fn next_in(&self, bits: u32, data: &Data, until: &Exact) -> Option<Claim> {
        let mut walk = Walk::new(self, data, &Piece::default(), bits);
        for claim in self.events() {
            walk.confirm(claim).ok()?;
        }
        let landing = walk.next_landing()?;
        let number = |text: &String| Exact::parse(text).ok()?.as_rational().cloned();
        let printed = |x: &Real| -> Option<[BigRational; 2]> {
            let [lower, upper] = decimal_bounds(&x.enclosure().rounded(PRINTED_BITS));
            Some([number(&lower)?, number(&upper)?])
        };
        let time = printed(&walk.clock.time(&landing.phase.hull()))?;
        let is_later = Exact::from_rational(time[0].clone()).compare(until)?.is_gt();
        let mapping = walk.standing.last().mapping(landing.wall);
        let velocity = printed(&walk.clock.velocity(&landing.velocity.hull()))?;
        let index = self.events().len() as u64 + 1;
        is_later.then_some(Claim { wall: landing.wall, time, kind: EventKind::Impact { index, mapping, velocity } })
    }
}
