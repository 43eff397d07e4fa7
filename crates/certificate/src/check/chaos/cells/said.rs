//! Consistency of the subintervals of a JSON of cells: no gap, no overlap, shares that follow (Lemma V35).

use std::cmp::Ordering;

use impact_pair_document::{SharesDocument, StretchDocument};
use impact_pair_exact::Exact;
use impact_pair_model::vocabulary::StretchVerdict;
use num_rational::BigRational;
use num_traits::Zero;

use crate::cells::CellsCertificate;
use crate::check::contact::Doubt;

/// Shares are whole numbers of these parts of the range.
const PARTS: i64 = 1_000_000;
/// Bits that a share which is not rational is enclosed with.
const BITS: u32 = 128;

impl CellsCertificate {
    /// The first subinterval, or their number for the whole, of which what is said contradicts the rest.
    pub(super) fn says_one_thing(&self) -> Result<(), (usize, Doubt)> {
        let (document, all) = (&self.document, self.count());
        let wrong = |event, message: &str| Err((event, Doubt::False(message.to_owned())));
        let mut from = &document.over.low.0;
        for (event, stretch) in document.stretches.iter().enumerate() {
            let meets = meet(from, &stretch.low.0, Ordering::Equal, "its lower end is not where the one before ends");
            meets.map_err(|doubt| (event, doubt))?;
            let follows =
                meet(&stretch.low.0, &stretch.high.0, Ordering::Less, "its lower end is not below the upper one");
            follows.map_err(|doubt| (event, doubt))?;
            if let Some(message) = contradiction(stretch) {
                return wrong(event, message);
            }
            from = &stretch.high.0;
        }
        meet(from, &document.over.high.0, Ordering::Equal, "the last subinterval does not end where the range does")
            .map_err(|doubt| (all, doubt))?;
        if document.certified != document.stretches.iter().all(|stretch| stretch.verdict != StretchVerdict::Undecided) {
            return wrong(all, "certified says something else of what is undecided than the list");
        }
        self.shares_follow(&document.shares).map_err(|doubt| (all, doubt))
    }

    /// Proves that no share of proved values is more than that of their subintervals, and the share of undecided ones no less.
    fn shares_follow(&self, shares: &SharesDocument) -> Result<(), Doubt> {
        let horseshoe = |stretch: &StretchDocument| stretch.entropy.is_some();
        let is = |name: StretchVerdict| move |stretch: &StretchDocument| stretch.verdict == name;
        let both = |stretch: &StretchDocument| stretch.entropy.is_some() && stretch.period.is_some();
        self.share("horseshoe", shares.horseshoe, Ordering::Greater, horseshoe)?;
        self.share("attracted", shares.attracted, Ordering::Greater, is(StretchVerdict::Attracted))?;
        self.share("stable", shares.stable, Ordering::Greater, is(StretchVerdict::Stable))?;
        self.share("both", shares.both, Ordering::Greater, both)?;
        self.share("undecided", shares.undecided, Ordering::Less, is(StretchVerdict::Undecided))
    }

    /// A share is the fraction of such subintervals, to a millionth of the range, and not beside it on the side that says more.
    fn share(
        &self,
        name: &str,
        claimed: f64,
        more: Ordering,
        is: impl Fn(&StretchDocument) -> bool,
    ) -> Result<(), Doubt> {
        let open = |message: &str| Doubt::Open(format!("shares.{name} {message}"));
        let width = |low: &Exact, high: &Exact| high.checked_sub(low).ok();
        let over = &self.document.over;
        let range = width(&over.low.0, &over.high.0).ok_or_else(|| open("is beyond exact expressions"))?;
        let mut ends = [BigRational::zero(), BigRational::zero()];
        for stretch in self.document.stretches.iter().filter(|stretch| is(stretch)) {
            let part = width(&stretch.low.0, &stretch.high.0).and_then(|part| part.checked_div(&range).ok());
            let part = part.ok_or_else(|| open("is beyond exact expressions"))?;
            let own = match part.as_rational() {
                Some(part) => [part.clone(), part.clone()],
                None => {
                    let part = part.enclose(BITS);
                    [part.inf().to_rational(), part.sup().to_rational()]
                }
            };
            ends = [&ends[0] + &own[0], &ends[1] + &own[1]];
        }
        let unit = BigRational::new(1.into(), PARTS.into());
        let parts = (claimed * PARTS as f64).round(); // V35: a share is that number of millionths
        let said =
            BigRational::from_float(parts).filter(|_| parts / PARTS as f64 == claimed).map(|parts| parts * &unit); // V35: exactly that one
        let Some(said) = said else { return Err(Doubt::False(format!("shares.{name} is no number of millionths"))) };
        let [low, high] = ends;
        // Of sums that are not rational nothing less than a millionth is certain.
        let slack = if low == high { BigRational::zero() } else { unit.clone() };
        let is_more = if more.is_gt() { said > &high + &slack } else { &said + &slack < low };
        let is_less = if more.is_gt() { &said + &unit + slack <= low } else { said >= high + &unit + slack };
        if is_more || is_less {
            return Err(Doubt::False(format!("shares.{name} is not the fraction of its subintervals")));
        }
        Ok(())
    }
}

/// One end is in an order to another one, or a message says that it is not.
fn meet(one: &Exact, other: &Exact, order: Ordering, message: &str) -> Result<(), Doubt> {
    match one.compare(other) {
        Some(found) if found == order => Ok(()),
        Some(_) => Err(Doubt::False(message.to_owned())),
        None => Err(Doubt::open("two ends are not distinguished")),
    }
}

/// The contradiction in a subinterval: a verdict that its other fields exclude.
fn contradiction(stretch: &StretchDocument) -> Option<&'static str> {
    let has_period = matches!(stretch.verdict, StretchVerdict::Attracted | StretchVerdict::Stable);
    let has_horseshoe = stretch.entropy.is_some();
    if has_period != stretch.period.is_some() {
        Some(if has_period {
            "its periodic orbit is missing"
        } else {
            "it has a periodic orbit, which its verdict has not"
        })
    } else if has_horseshoe == stretch.bases.is_empty() {
        Some("it has an entropy without h-sets, or h-sets without an entropy")
    } else if stretch.verdict == StretchVerdict::Horseshoe && !has_horseshoe {
        Some("its entropy is missing")
    } else if stretch.verdict == StretchVerdict::Undecided && has_horseshoe {
        Some("a horseshoe is claimed of what is undecided")
    } else {
        None
    }
}
