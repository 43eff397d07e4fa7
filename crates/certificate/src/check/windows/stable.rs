//! Proofs that all orbits between the two ends of a window are stable, on one curve through the listed orbit (Lemma V30).

use num_integer::Integer;

use super::between::{Between, TINY_CELL_BITS, unproved};
use super::cell::{Cell, Point};
use super::map::Map;
use crate::attraction::Passage;
use crate::check::bifurcation::ParameterFamily;
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use crate::check::frame::hull;
use crate::check::tangency::flights::Letter;
use crate::check::tangency::setting::Setting;
use crate::check::target::{MAX_BITS, narrowest};
use crate::check::units::greatest_speed;
use crate::check::walk::compare;
use crate::periodic::OrbitOf;
use crate::windows::ClaimedWindow;
use impact_pair_exact::{Exact, Real};
use impact_pair_model::Wall;

/// Bits of the arithmetic beyond those of the tiny cells: at first, and at most.
const SPARE_BITS: i64 = 160;
const MAX_SPARE_BITS: i64 = 640;
/// The largest tiny cell, as a power of 2.
const MAX_CELL_EXPONENT: i64 = -96;

impl ClaimedWindow {
    /// Proves that the orbits between the ends are stable, on one curve through the window's orbit; returns the bits used. Lemma V30
    pub(super) fn is_stable_between(&self, over: &ParameterFamily<'_>, budget: &Budget<'_>) -> Result<u32, Doubt> {
        let [one, other] = &self.ends[..] else { return Err(Doubt::open("an end of the window is not proved")) };
        let [claim] = &self.orbit.orbits[..] else { return Err(Doubt::open("the window has no orbit")) };
        if claim.orbit.physical != Some(true) || !claim.orbit.unique {
            return Err(Doubt::open("the orbit is not proved to be the only one in its bounds"));
        }
        let setting = Setting::new(over.pair, over.key)?;
        let narrow = narrowest([&one.parameter, &other.parameter].into_iter()).unwrap_or(0); // proposes: a size to try
        let first = &claim.orbit.impacts[0];
        let own = narrowest([&first.phase, &first.velocity].into_iter()).unwrap_or(0); // proposes: a size to try
        let size = MAX_CELL_EXPONENT.min(narrow.min(own) - TINY_CELL_BITS); // proposes: a size to try
        let mut spare = SPARE_BITS;
        let (bits, mut between, known) = loop {
            let bits = u32::try_from(spare - size).ok().filter(|bits| *bits <= MAX_BITS);
            let bits = bits.ok_or_else(|| Doubt::open("the bounds are too narrow"))?;
            match self.begun((&setting, over), (size, bits), (claim, budget)) {
                // In many flights rounding exceeds the tiny cell.
                Err(Doubt::Open(_)) if spare < MAX_SPARE_BITS && !budget.is_spent() => spare *= 2,
                begun => {
                    let (between, known) = begun?;
                    break (bits, between, known);
                }
            }
        };
        for end in [one, other] {
            between.reaches(&known, end, &setting)?;
        }
        Ok(bits)
    }

    /// The curve in `bits` bits, beginning at the claimed orbit, which is proved to be stable.
    fn begun<'b>(
        &self,
        (setting, over): (&Setting, &ParameterFamily<'_>),
        (size, bits): (i64, u32),
        (claim, budget): (&OrbitOf, &Budget<'b>),
    ) -> Result<(Between<'b>, Cell), Doubt> {
        let start = Start { setting, over, at: &self.at };
        let first = &claim.orbit.impacts[0];
        let guess = start.state(first, bits)?;
        let letters = self.flights.iter().map(|is_far| if *is_far { Letter::Far } else { Letter::Near }).collect();
        let far = self.flights.iter().filter(|is_far| **is_far).count() as i64; // exact: a count
        let map = Map::new(letters, setting.family(bits), budget.clone(), &guess)?;
        // Twice the period if it is mirrored, minus half a forcing period for each flight to the far wall.
        let rounds = if far.is_odd() { 2 } else { 1 };
        if i128::from(rounds * (2 * map.turns() - far)) != 2 * i128::from(claim.cycles) {
            return Err(Doubt::open("the flights of the window do not take the forcing periods of its orbit"));
        }
        let mut between = Between { map, size };
        let known = between.known(guess)?;
        start.holds(first, &known)?;
        Ok((between, known))
    }
}

/// The value at which the orbit of a window is listed.
struct Start<'c> {
    setting: &'c Setting,
    over: &'c ParameterFamily<'c>,
    at: &'c Exact,
}

impl Start<'_> {
    /// `A W` at the value of the parameter.
    fn unit(&self, bits: u32) -> Result<Real, Doubt> {
        let there =
            self.over.pair.with(self.over.key, self.at.clone()).map_err(|error| Doubt::Open(error.to_string()))?;
        let harmonic =
            there.excitation().only().ok_or_else(|| Doubt::open("with several harmonics, windows are not checked"))?;
        let speed = greatest_speed(harmonic).map_err(|error| Doubt::Open(error.to_string()))?;
        Ok(Real::of(&speed, bits))
    }

    /// The middle of the bounds of an impact, as a state of the reduced map with the value of the parameter.
    fn state(&self, impact: &Passage, bits: u32) -> Result<Point, Doubt> {
        let middle = |bounds: &[_; 2]| hull(&bounds.each_ref().map(|x| Real::rational(x, bits))).middle();
        let phase = middle(&impact.phase);
        let phase = if impact.wall == Wall::Left { phase } else { phase + &Real::pi(bits) };
        let speed =
            middle(&impact.velocity).over(&self.unit(bits)?).ok_or_else(|| Doubt::open("the amplitude may be 0"))?;
        let speed = if impact.wall == Wall::Left { -speed } else { speed };
        Ok([phase, speed, self.setting.reduced(&Real::of(self.at, bits))?])
    }

    /// Proves that a cell holds the value, and that its states lie in the bounds of an impact.
    fn holds(&self, impact: &Passage, known: &Cell) -> Result<(), Doubt> {
        let [phase, speed, parameter] = known.hull();
        let bits = parameter.bits();
        let own = self.setting.reduced(&Real::of(self.at, bits))?;
        if !parameter.enclosure().contains_enclosure(own.enclosure()) {
            return Err(Doubt::open("the value of the window is not proved to be that of an orbit"));
        }
        let is_left = impact.wall == Wall::Left;
        let phase = if is_left { phase } else { phase - &Real::pi(bits) };
        let velocity = speed * &self.unit(bits)?;
        compare("phase of the orbit", &phase, &impact.phase).map_err(unproved)?;
        compare("velocity of the orbit", &if is_left { -velocity } else { velocity }, &impact.velocity)
            .map_err(unproved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Limits;
    use crate::windows::WindowsCertificate;
    use impact_pair_model::watch::Unwatched;
    use serde_json::{Value, json};

    const DOCUMENT: &str = include_str!("../../../tests/documents/windows.jsonl");
    const FIGURE_16: &str = include_str!("../../../tests/window-of-figure-16.json");

    fn budget() -> Budget<'static> {
        Budget::new(Limits::default().work, Limits::default().parts, &Unwatched)
    }

    /// The verdict on the orbits between the ends of a window with another value; the orbit and the ends are not checked.
    fn between(key: &str, value: Value) -> Result<u32, Doubt> {
        let mut document: Value = serde_json::from_str(DOCUMENT).unwrap();
        *document["windows"][0].pointer_mut(key).unwrap() = value;
        let own = WindowsCertificate::read(&[document]).unwrap().0;
        let over = ParameterFamily { pair: &own.pair, start: &own.start, key: own.over };
        own.windows[0].is_stable_between(&over, &budget())
    }

    /// The curve of stable orbits leads from the claimed orbit to the claimed ends (Lemma V30, window), independently of V8 and V9.
    #[test]
    fn a_curve_leads_from_the_claimed_orbit_to_the_claimed_ends() {
        let elsewhere =
            [("/from", json!(["0.1038", "0.1039"]), "parameter"), ("/at", json!("0.21"), "phase of the orbit")];
        for (key, value, words) in elsewhere {
            let found = between(key, value);
            let is_open = matches!(&found, Err(Doubt::Open(message)) if message.contains(words));
            assert!(is_open, "{key}: {found:?}");
        }
    }

    /// Rounding in 32 flights of figure 16 exceeds the first tiny cell.
    #[test]
    fn r52_the_orbit_of_a_window_of_figure_16_is_proved_in_more_bits() {
        let own = WindowsCertificate::read(&[serde_json::from_str(FIGURE_16).unwrap()]).unwrap().0;
        let (over, window) = (ParameterFamily { pair: &own.pair, start: &own.start, key: own.over }, &own.windows[0]);
        let (setting, size) = (Setting::new(over.pair, over.key).unwrap(), -141);
        let begun = |spare: i64| {
            let bits = u32::try_from(spare - size).unwrap();
            window.begun((&setting, &over), (size, bits), (&window.orbit.orbits[0], &budget()))
        };
        assert!(begun(SPARE_BITS).is_err() && begun(2 * SPARE_BITS).is_ok());
    }
}
