//! A certificate as a theorem that Coq checks.
//!
//! `validation/coq` holds the model, a verified program that checks certificates, and its proof. The file written here holds the
//! data: the scene, the printed bounds, boxes around the impacts and the cuts of the flights. Coq trusts none of
//! these data.

mod cuts;
mod flights;
mod legs;
mod next;
mod number;
mod text;

use super::Certificate;
use super::check::{Data, Doubt, Finding};
use flights::{Flight, Origin, flights};
use impact_pair_document::ClaimName;
use impact_pair_exact::Exact;
use impact_pair_model::Error;
use impact_pair_model::vocabulary::OutcomeKind;
use impact_pair_model::watch::{Latched, Watch};
use legs::{Box, Leg, excess, leg, start};

/// A file for Coq.
#[derive(Clone, Debug)]
pub struct Theorem {
    /// The file.
    pub text: String,
    /// Number of impacts that the file proves.
    pub impacts: usize,
    /// The reason why fewer impacts than requested are proved.
    pub stop: Option<Finding>,
    /// Other claims of the document, in words: events from the first other event on, an outcome of another kind.
    pub left_out: Option<String>,
}

/// log2 of the step of the first grid, and bits of the first computation.
const FIRST_SCALE: u32 = 64;
const FIRST_BITS: u32 = 256;
const MAX_BITS: u32 = 1 << 16;
/// Bits of the computation below the grid.
const SPARE_BITS: u32 = 64;

impl Certificate {
    /// A file for Coq that proves the first `most` impacts, or the impacts up to the first other event. The theorem: for every start
    /// and all parameters of the scene there is exactly one orbit, its impacts are first contacts on these walls, and its times
    /// and velocities lie in the printed bounds.
    ///
    /// `watch` receives the number of impacts computed so far, and may stop the computation: then fewer impacts are proved.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond what exact expressions or Coq's hold, the box is not shaken, or the orbit is a shadowed one.
    ///
    /// # Examples
    /// ```
    /// use impact_pair_certificate::Certificate;
    /// use impact_pair_model::watch::Unwatched;
    ///
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// let theorem = Certificate::parse(text)?.prove(2, &Unwatched)?;
    /// assert_eq!((theorem.impacts, theorem.stop), (2, None));
    /// assert!(theorem.text.contains("Theorem "));
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn prove(&self, most: usize, watch: &dyn Watch) -> Result<Theorem, Error> {
        if self.claim() == ClaimName::Shadowed {
            return Err(Error::certificate("claim \"shadowed\": only orbits from exact starts can be proved".into()));
        }
        let data = Data::new(self.pair(), self.start())?;
        Error::require_positive("excitation.amplitude", self.pair().excitation().reference().amplitude())?;
        let is_point = data.is_point();
        let claims = self.events().iter().take_while(|claim| claim.kind.is_impact());
        let mut claims: Vec<_> = claims.take(most).cloned().collect();
        // If the requested time ended the list, the next impact proves that no other impact comes before that time.
        let listed = claims.len();
        let until = self.ended().until.as_ref().filter(|_| listed == self.events().len());
        claims.extend(until.and_then(|until| self.next_after(&data, &until.0)));
        let is_last_missing = until.is_some() && claims.len() == listed;
        let until = until.filter(|_| claims.len() > listed);
        let contradiction = (listed == self.events().len()).then(|| self.contradicts_its_list()).flatten();
        let (mut bits, mut scale) = (FIRST_BITS, FIRST_SCALE);
        let watch = Latched::new(watch);
        loop {
            let (origin, flights, doubt) = flights(self, &data, &claims, bits, &watch);
            let missing = match doubt {
                Some(Doubt::Open(_)) if is_point && bits < MAX_BITS && !watch.is_stopped() => {
                    bits *= 2;
                    continue;
                }
                other => other,
            };
            let (begin, legs) = loop {
                let (begin, legs) = chain(&origin, &flights, scale);
                // A finer grid makes no box finite: sides in units of the grid grow as the motion spreads.
                let wanting = legs.iter().zip(&flights).map(|(leg, flight)| excess(flight, &leg.arrival));
                let wanting = wanting.take_while(|&wanting| wanting < u32::MAX).max();
                // Nor does a grid that is finer than the computation.
                match wanting.filter(|&wanting| wanting > 0 && is_point && scale + SPARE_BITS <= bits) {
                    Some(wanting) => scale += wanting + 1,
                    None => break (begin, legs),
                }
            };
            if bits < scale + SPARE_BITS && is_point && bits < MAX_BITS {
                bits = (scale + 2 * SPARE_BITS).max(2 * bits);
                continue;
            }
            let fits = |(leg, flight): &(&Leg, &Flight)| excess(flight, &leg.arrival) == 0 && legs::is_sound(leg);
            let proved = legs.iter().zip(&flights).take_while(fits).count();
            let stop = match missing {
                Some(Doubt::Open(message) | Doubt::False(message)) if proved == flights.len() => Some(message),
                None if is_last_missing && proved == flights.len() => {
                    Some("the next impact, after the time `until`, is not found".to_owned())
                }
                _ if proved < flights.len() => Some("boxes do not fit into the printed bounds".to_owned()),
                _ => contradiction.clone(),
            };
            let stop = stop.map(|message| Finding { event: proved.min(self.events().len()), message });
            let until = until.filter(|_| proved == claims.len());
            let ending = (contradiction.is_none(), until.map(|until| &until.0));
            let text = text::file(self, &claims[..proved], &begin, &legs[..proved], ending)?;
            let left_out = self.left_out(proved.min(listed));
            return Ok(Theorem { text, impacts: proved.min(listed), stop, left_out });
        }
    }

    /// A contradiction between the outcome and the list of impacts.
    fn contradicts_its_list(&self) -> Option<String> {
        if let Err(Doubt::False(message) | Doubt::Open(message)) = self.says_one_thing() {
            return Some(message);
        }
        let (until, last) = (&self.ended().until.as_ref()?.0, self.events().last()?);
        let is_later = Exact::from_rational(last.time[0].clone()).compare(until)?.is_gt();
        is_later.then(|| "a listed event comes after the time `until`".to_owned())
    }

    /// The claims of the document besides its first impacts; none if the theorem covers the beginning of a longer list.
    fn left_out(&self, impacts: usize) -> Option<String> {
        let others = self.events().len() - impacts;
        let is_cut = self.events().get(impacts).is_some_and(|next| next.kind.is_impact());
        let is_stated = matches!(self.outcome(), OutcomeKind::ImpactsReached | OutcomeKind::TimeReached);
        match others {
            _ if is_cut => None,
            0 if is_stated => None,
            0 => Some(format!("the outcome `{}`", self.outcome())),
            _ => Some(format!("events[{impacts}] and what comes after it, and the outcome")),
        }
    }
}

/// The boxes of an orbit, each computed from the box before.
fn chain(origin: &Origin, flights: &[Flight], scale: u32) -> (Box, Vec<Leg>) {
    let begin = start(origin, scale);
    let mut legs: Vec<Leg> = Vec::with_capacity(flights.len());
    for flight in flights {
        let next = leg(flight, legs.last().map_or(&begin, |leg| &leg.arrival));
        legs.push(next);
    }
    (begin, legs)
}
