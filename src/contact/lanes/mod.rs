//! The first contacts of many flights, [`LANES`] at a time: the scalar proofs in loops without a branch.
//!
//! No formula and no bound stands here. Each loop calls, for every lane, what the solver and the judge of one flight call
//! ([`super::solve`], [`super::certify`]), on the same numbers, so that a lane that is decided has that flight's bits and its
//! proof. The compiler makes vector instructions of the loops, as there are no calls in them. What needs more than the common
//! steps is not decided here, but by the scalar flight: an extremum near a wall, a drift near `beta`, what is undecided in the end.

#![allow(clippy::needless_range_loop, reason = "a lane is a place in many columns")]

mod columns;
mod many;
#[cfg(test)]
mod tests;

pub use many::{Image, first_contacts_of, image_of, images_of};

use super::bounds::{Bounds, Margins};
use super::certify::{SHORT_FLIGHT, is_near_time};
use super::extrema::{Extrema, Piece, Target};
use super::solve::{LONGEST_FLIGHT, Search, hop_guess, is_phase, look_near, on_monotone, on_piece, reaches_far};
use crate::flight::Flight;
use crate::number::{Kernel, Trigonometry, kernel};
use crate::pair::{Reduced, Wall};
use columns::{Brackets, Departures, Flights, Iterates, LaneValue, Searches, Spreads, State, States, Turnings};

/// Flights at a time: a few vectors.
const LANES: usize = 16;
/// Steps to a contact: two or three are usual.
const STEPS: usize = 6;
/// Time at which lanes without a proposed hop are looked at first, in forcing periods.
const FIRST_TIME: f64 = 0.0625;

/// Flights of one pair that are solved together.
struct Lanes {
    flights: Flights,
    searches: Searches,
    iterates: Iterates,
    departures: Departures,
    turnings: Turnings,
    states: States,
}

impl Lanes {
    const EMPTY: Self = Self {
        flights: Flights::EMPTY,
        searches: Searches::EMPTY,
        iterates: Iterates::EMPTY,
        departures: Departures::EMPTY,
        turnings: Turnings::EMPTY,
        states: States::EMPTY,
    };

    /// A start on a wall, with its velocity away from it; one that the kernel does not take is not decided.
    #[inline(always)]
    fn start(&mut self, lane: usize, wall: Wall, phase: f64, velocity: f64) {
        let is_decided = is_phase(phase);
        self.flights.wall[lane] = wall.held();
        self.flights.phase[lane] = if is_decided { phase } else { 0.0 };
        self.flights.velocity[lane] = velocity;
        self.states.is_decided[lane] = is_decided.held();
    }

    /// Proposes contacts, as the scalar solver does.
    fn solve(&mut self, pair: &Reduced<f64>) {
        self.launch(pair);
        self.propose();
        let any = |lanes: &Self, requested: fn(State) -> bool| (0..LANES).any(|lane| requested(lanes.states.get(lane)));
        if any(self, |state| state.is_decided && !state.is_hop) {
            self.refine();
            self.part();
        }
        if any(self, |state| state.is_near) {
            self.refine_near();
        }
    }

    /// The flights from their starts.
    #[inline(never)]
    fn launch(&mut self, pair: &Reduced<f64>) {
        for lane in 0..LANES {
            let Flight { wall, phase, velocity, .. } = self.flights.get(lane);
            self.flights.set(lane, Flight::from_wall(pair, wall, phase, velocity, kernel::sin_cos(phase)));
        }
    }

    /// Chooses the piece on which the contact is searched for, and the bracket, of each flight.
    #[inline(never)]
    fn propose(&mut self) {
        for lane in 0..LANES {
            let flight = &self.flights.get(lane);
            let is_monotone = flight.is_monotone();
            // Any flight that has extrema stands for one that has none.
            let turning = &Flight {
                beta: if is_monotone { 1.0 } else { flight.beta },
                drift: if is_monotone { 0.0 } else { flight.drift },
                ..*flight
            };
            let extrema = Extrema::new::<Kernel>(turning);
            let margin = Kernel::ACOS_ERROR * flight.beta;
            let piece = extrema.first_piece(flight.drift);
            let is_clear = piece
                .is_some_and(|piece| !extrema.is_close(&piece, flight.drift, margin) & (piece.k <= LONGEST_FLIGHT));
            let piece = piece.unwrap_or(Piece { target: Target::Near, k: 0.0 }); // proposes
            let (kepler, guess) = on_monotone(flight);
            let ends = (guess <= LONGEST_FLIGHT) & (flight.drift != 0.0); // proposes
            let is_pressed = !is_monotone & (flight.sin <= 0.0);
            let hop = hop_guess(flight);
            let is_hop = is_pressed & (flight.velocity > 0.0) & hop.is_some();
            let is_piece = is_clear & !(is_pressed & (flight.velocity <= 0.0));
            let is_found = is_hop | if is_monotone { ends } else { is_piece };
            let is_decided = bool::of(self.states.is_decided[lane]) & is_found;
            let on_piece = on_piece(flight, &extrema, piece);
            let search = if is_monotone { kepler } else { on_piece };
            let is_searched = is_decided & !is_hop;
            let sane = |x: f64| if is_searched { x } else { 0.0 };
            let target = if is_hop { Target::Near } else { search.target };
            self.searches.set(
                lane,
                Search {
                    target,
                    turns: sane(search.turns),
                    at: sane(search.at),
                    low: sane(search.low),
                    high: sane(search.high),
                },
            );
            self.turnings.set(lane, extrema);
            let is_hop = is_hop & is_decided;
            let time = if is_hop { hop.unwrap_or(FIRST_TIME) } else { FIRST_TIME }; // proposes
            self.states.set(lane, State { k: piece.k, time, is_hop, is_near: is_hop, is_decided });
        }
    }

    /// Steps in all lanes until each one's next is as good as exact: further ones change nothing.
    #[inline(never)]
    fn refine(&mut self) {
        let mut is_last = [0.0; LANES];
        for _ in 0..STEPS {
            for lane in 0..LANES {
                let flight = &self.flights.get(lane);
                let mut search = self.searches.get(lane);
                let (iterate, last) = search.look::<Kernel>(flight);
                search.advance(&iterate);
                let at = if last { iterate.at } else { search.at };
                self.searches.set(lane, Search { at, ..search });
                self.iterates.set(lane, iterate);
                let State { is_hop, is_decided, .. } = self.states.get(lane);
                is_last[lane] = (last | is_hop | !is_decided).held();
            }
            if is_last.iter().all(|&last| bool::of(last)) {
                return;
            }
        }
        for lane in 0..LANES {
            self.states.is_decided[lane] *= is_last[lane];
        }
    }

    /// Determines which flights are short, and the times of these from their starts.
    #[inline(never)]
    fn part(&mut self) {
        for lane in 0..LANES {
            let flight = &self.flights.get(lane);
            let iterate = &self.iterates.get(lane);
            let state = self.states.get(lane);
            let is_short =
                state.is_decided & !state.is_hop & (flight.elapsed(iterate.turns, iterate.at) <= SHORT_FLIGHT);
            let short = iterate.turns + (iterate.at - flight.phase) - iterate.step;
            let is_settled = !is_short | is_near_time(short);
            let time = if is_short & is_settled { short } else { state.time };
            // The time of a short flight is measured from its start.
            self.searches.turns[lane] = if is_short { 0.0 } else { iterate.turns };
            let is_near = (state.is_hop | is_short) & is_settled;
            self.states.set(lane, State { time, is_near, is_decided: state.is_decided & is_settled, ..state });
        }
    }

    /// Newton steps of hops, and a look at short flights.
    #[inline(never)]
    fn refine_near(&mut self) {
        let mut is_last = [0.0; LANES];
        for _ in 0..STEPS {
            for lane in 0..LANES {
                let flight = &self.flights.get(lane);
                let state = self.states.get(lane);
                let (iterate, departure) =
                    look_near::<Kernel>(flight, Target::of(self.searches.target[lane]), state.time);
                let last = iterate.is_last_of_hop();
                let next = state.time - iterate.step;
                let is_moved = state.is_hop & !last;
                let is_within = (0.0..=0.125).contains(&next);
                let goes_on = iterate.is_on_hop() & if last { !reaches_far(flight, state.time) } else { is_within };
                let time = if is_moved & is_within { next } else { state.time };
                let other = self.iterates.get(lane);
                self.iterates.set(lane, if state.is_near { iterate } else { other });
                self.departures.set(lane, departure);
                self.states
                    .set(lane, State { time, is_decided: state.is_decided & (goes_on | !state.is_hop), ..state });
                is_last[lane] = (!is_moved).held();
            }
            if (0..LANES).all(|lane| bool::of(is_last[lane]) | !bool::of(self.states.is_decided[lane])) {
                return;
            }
        }
        for lane in 0..LANES {
            self.states.is_decided[lane] *= is_last[lane];
        }
    }

    /// Brackets the contacts (Lemma C3).
    #[inline(always)]
    fn bracket<const WIDE: bool>(&mut self, margins: &Margins, spreads: &Spreads, brackets: &mut Brackets) {
        for lane in 0..LANES {
            let flight = &self.flights.get(lane);
            let bounds = &Bounds::<WIDE>::new(flight, margins, spreads.get(lane));
            let iterate = &self.iterates.get(lane);
            let (bracket, is_proved) = bounds.long_bracket(iterate, flight.elapsed(iterate.turns, iterate.at));
            brackets.set(lane, bracket);
            let State { is_near, is_decided, .. } = self.states.get(lane);
            self.states.is_decided[lane] = (is_decided & (is_proved | is_near)).held();
        }
        if self.states.is_near.iter().any(|&near| bool::of(near)) {
            self.bracket_near::<WIDE>(margins, spreads, brackets);
        }
    }

    /// Brackets the contacts of the flights that are near.
    #[inline(never)]
    fn bracket_near<const WIDE: bool>(&mut self, margins: &Margins, spreads: &Spreads, brackets: &mut Brackets) {
        for lane in 0..LANES {
            let flight = &self.flights.get(lane);
            let bounds = &Bounds::<WIDE>::new(flight, margins, spreads.get(lane));
            let (bracket, is_proved) = bounds.near_bracket(&self.iterates.get(lane), &self.departures.get(lane));
            let State { is_near, is_decided, .. } = self.states.get(lane);
            let other = brackets.get(lane, self.searches.get(lane));
            brackets.set(lane, if is_near { bracket } else { other });
            self.states.is_decided[lane] = (is_decided & (is_proved | !is_near)).held();
        }
    }

    /// Decides whether no other contact comes before the contacts that are bracketed (Lemmas C4-C6).
    #[inline(always)]
    fn judge<const WIDE: bool>(&mut self, margins: &Margins, spreads: &Spreads, brackets: &Brackets) {
        for lane in 0..LANES {
            let flight = &self.flights.get(lane);
            let bounds = &Bounds::<WIDE>::new(flight, margins, spreads.get(lane));
            let bracket = &brackets.get(lane, self.searches.get(lane));
            let State { k, is_hop, is_decided, .. } = self.states.get(lane);
            let is_first = bounds.is_plainly_first(&self.turnings.get(lane), k, &bracket.arrival);
            let is_monotone = flight.is_monotone();
            let is_proved = (is_hop & bounds.is_one_hop(bracket).is_ok())
                | (!is_hop & is_monotone & bounds.is_clearly_monotone())
                | (!is_hop & !is_monotone & is_first);
            self.states.is_decided[lane] = (is_decided & is_proved).held();
        }
    }

    /// Certifies the contacts of flights that start at exact phases.
    #[inline(never)]
    fn certify_points(&mut self, margins: &Margins, spreads: &Spreads, brackets: &mut Brackets) {
        self.bracket::<false>(margins, spreads, brackets);
        self.judge::<false>(margins, spreads, brackets);
    }

    /// Certifies the contacts of all flights of sets.
    #[inline(never)]
    fn certify_sets(&mut self, margins: &Margins, spreads: &Spreads, brackets: &mut Brackets) {
        self.bracket::<true>(margins, spreads, brackets);
        self.judge::<true>(margins, spreads, brackets);
    }

    /// Brackets the contacts of the flights from the centres of sets, which are proved to be first with those of the sets.
    #[inline(never)]
    fn bracket_centres(&mut self, margins: &Margins, spreads: &Spreads, brackets: &mut Brackets) {
        self.bracket::<false>(margins, spreads, brackets);
    }
}
