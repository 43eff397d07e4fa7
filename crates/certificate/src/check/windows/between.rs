//! Proofs that all orbits between the two ends of a window are stable, on one curve through the orbit that is listed (Lemma V30).
//!
//! Points of the curve are found by Newton's iteration, each in a tiny cell in which it is proved. Cells over the way from one to the next are
//! proved to hold one curve, of stable orbits, or, next to an end, one along which the eigenvalue that passes 1 or -1 does so once.

use num_integer::Integer;

use super::cell::{Along, Cell, Image, Map, Point};
use crate::attraction::Passage;
use crate::bifurcation::{ClaimedPoint, Kind};
use crate::check::bifurcation::Over;
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use crate::check::frame::hull;
use crate::check::tangency::flights::Letter;
use crate::check::tangency::setting::Setting;
use crate::check::target::{MOST_BITS, narrowest};
use crate::check::units::greatest_speed;
use crate::check::walk::compare;
use crate::periodic::OrbitOf;
use crate::windows::ClaimedWindow;
use impact_pair_exact::{Dyadic, Exact, Real};
use impact_pair_model::Wall;

/// Bits of the arithmetic beyond those of the tiny cells, at first and at most, and of these beyond the bounds of the ends.
const SPARE_BITS: i64 = 160;
const MOST_SPARE_BITS: i64 = 640;
const INSIDE: i64 = 24;
/// Bits by which a tiny cell is narrower across the curve.
const THIN: i64 = 28;
/// The largest tiny cell, as a power of 2.
const LARGEST: i64 = -96;
/// Steps of Newton's iteration, and how much smaller than a tiny cell the last one is, as a power of 2.
const ENOUGH: i64 = 8;
const STEPS: u32 = 24;
/// Number of bisections of the path between two points, or to an end.
const HALVED: u32 = 12;
/// The sides of a cell across the curve at first, as a power of 2, in units of how far the curve strays from its direction.
const ROOM: i64 = 3;
/// Number of times that a cell is widened.
const WIDENED: u32 = 4;
/// The coordinate that is the parameter.
const PARAMETER: usize = 2;

impl ClaimedWindow {
    /// The orbits between its ends are stable, on one curve that leads through its orbit, proved in N bits. Lemma V30
    pub(super) fn is_stable_between(&self, over: &Over<'_>, budget: &Budget<'_>) -> Result<u32, Doubt> {
        let [one, other] = &self.ends[..] else { return Err(Doubt::open("an end of the window is not proved")) };
        let [claim] = self.orbit.orbits() else { return Err(Doubt::open("the window has no orbit")) };
        if claim.orbit.physical != Some(true) || !claim.orbit.unique {
            return Err(Doubt::open("the orbit is not proved to be the only one in its bounds"));
        }
        let setting = Setting::new(over.pair, over.key)?;
        let narrow = narrowest([&one.parameter, &other.parameter].into_iter()).unwrap_or(0); // proposes: a size to try
        let first = &claim.orbit.impacts[0];
        let own = narrowest([&first.phase, &first.velocity].into_iter()).unwrap_or(0); // proposes: a size to try
        let size = LARGEST.min(narrow.min(own) - INSIDE); // proposes: a size to try
        let mut spare = SPARE_BITS;
        let (bits, mut between, known) = loop {
            let bits = u32::try_from(spare - size).ok().filter(|bits| *bits <= MOST_BITS);
            let bits = bits.ok_or_else(|| Doubt::open("the bounds are too narrow"))?;
            match self.begun((&setting, over), (size, bits), (claim, budget)) {
                // Rounding in all flights is more than the tiny cell where they are many.
                Err(Doubt::Open(_)) if spare < MOST_SPARE_BITS && !budget.is_spent() => spare *= 2,
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

    /// The curve in N bits, with the orbit that is claimed, proved to be stable.
    fn begun<'b>(
        &self,
        (setting, over): (&Setting, &Over<'_>),
        (size, bits): (i64, u32),
        (claim, budget): (&OrbitOf, &Budget<'b>),
    ) -> Result<(Between<'b>, Cell), Doubt> {
        let start = Start { setting, over, at: &self.at };
        let first = &claim.orbit.impacts[0];
        let guess = start.state(first, bits)?;
        let letters = self.flights.iter().map(|is_far| if *is_far { Letter::Far } else { Letter::Near }).collect();
        let far = self.flights.iter().filter(|is_far| **is_far).count() as i64; // exact: a count
        let map = Map::new(letters, setting.family(bits), budget.clone(), &guess)?;
        // Twice the period where it is a mirrored one, less half a forcing period for each flight to the far wall.
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
    over: &'c Over<'c>,
    at: &'c Exact,
}

impl Start<'_> {
    /// `A W` at the value.
    fn unit(&self, bits: u32) -> Result<Real, Doubt> {
        let there =
            self.over.pair.with(self.over.key, self.at.clone()).map_err(|error| Doubt::Open(error.to_string()))?;
        let harmonic =
            there.excitation().only().ok_or_else(|| Doubt::open("with several harmonics, windows are not checked"))?;
        let speed = greatest_speed(harmonic).map_err(|error| Doubt::Open(error.to_string()))?;
        Ok(Real::of(&speed, bits))
    }

    /// The middle of the bounds of an impact, as a state of the reduced map and a value of its parameter.
    fn state(&self, impact: &Passage, bits: u32) -> Result<Point, Doubt> {
        let middle = |bounds: &[_; 2]| hull(&bounds.each_ref().map(|x| Real::rational(x, bits))).middle();
        let phase = middle(&impact.phase);
        let phase = if impact.wall == Wall::Left { phase } else { phase + &Real::pi(bits) };
        let speed =
            middle(&impact.velocity).over(&self.unit(bits)?).ok_or_else(|| Doubt::open("the amplitude may be 0"))?;
        let speed = if impact.wall == Wall::Left { -speed } else { speed };
        Ok([phase, speed, self.setting.reduced(&Real::of(self.at, bits))?])
    }

    /// A cell holds the value, and its states are those of the bounds of an impact.
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

/// Turns a refutation into an undecided claim: it may be about another orbit than that of the document.
fn unproved(doubt: Doubt) -> Doubt {
    match doubt {
        Doubt::False(message) | Doubt::Open(message) => Doubt::Open(message),
    }
}

/// A point of the curve, and the direction of the curve there, both about.
struct Spot {
    at: Point,
    direction: Point,
}

/// The curve of orbits of a window.
struct Between<'b> {
    map: Map<'b>,
    /// Size of the tiny cells, as a power of 2.
    size: i64,
}

impl Between<'_> {
    fn power(&self, n: i64) -> Real {
        Real::point(Dyadic::power_of_two(n), self.map.bits())
    }

    fn point(&self, x: &Real) -> Real {
        Real::point(x.mid(), self.map.bits())
    }

    /// The orbit near a guess with the same coordinate `kept`. Non-rigorous.
    fn settled(&mut self, mut at: Point, kept: usize) -> Result<Spot, Doubt> {
        let others = others(kept);
        for _ in 0..STEPS {
            let (thin, unit) = self.map.thin(&at);
            let image = self.map.image(&thin)?;
            let step = image.step(others).ok_or_else(lost)?;
            let mut most = None;
            for (k, &i) in others.iter().enumerate() {
                let step = step[k].clone() * &unit;
                at[i] = self.point(&(at[i].clone() + &step));
                most = most.max(step.enclosure().mag().top()); // proposes: when to stop
            }
            // proposes: when to stop
            if most.is_none_or(|top| top < self.size - INSIDE) {
                return Ok(Spot { at, direction: image.direction() });
            }
        }
        Err(lost())
    }

    /// The orbit of the curve from a point on at which an eigenvalue is 1, or -1. Non-rigorous.
    fn critical(&mut self, mut at: Point, which: usize) -> Result<Spot, Doubt> {
        let none = || Doubt::open("no end of the window is found");
        for _ in 0..STEPS {
            let (thin, unit) = self.map.thin(&at);
            let image = self.map.image(&thin)?;
            let (direction, critical) = (image.direction(), &image.criticals[which]);
            let slope = (0..3).map(|j| critical.slopes[j].clone() * &direction[j]).reduce(|sum, x| sum + &x);
            let part = critical.value.middle().over(&slope.ok_or_else(none)?.middle()).ok_or_else(none)?;
            let mut step = direction.each_ref().map(|x| -self.point(&(x.clone() * &part * &unit)));
            let most = step.iter().filter_map(|x| x.enclosure().mag().top()).max();
            // proposes: when to stop
            if most.is_none_or(|top| top < self.size - ENOUGH) {
                return Ok(Spot { at, direction });
            }
            let next = (0..HALVED).find_map(|_| {
                let there = [0, 1, 2].map(|i| self.point(&(at[i].clone() + &step[i])));
                step = step.each_ref().map(Real::half);
                let main = farther(&there, &at);
                self.settled(there, main).ok()
            });
            at = next.ok_or_else(none)?.at;
        }
        Err(none())
    }

    /// A cell around a point of the curve that goes so far along the coordinate `main`, and nowhere across.
    fn around(&self, spot: Spot, (main, along): (usize, &Real)) -> Result<Cell, Doubt> {
        let Spot { at, direction } = spot;
        let part = |x: &Real| Some(x.over(&direction[main])? * along);
        let [Some(a), Some(b), Some(c)] = direction.each_ref().map(part) else { return Err(lost()) };
        let zero = || [0, 1, 2].map(|_| Real::zero(self.map.bits()));
        Ok(Cell::new(at, [[a, b, c], zero(), zero()]))
    }

    /// A tiny cell around a point, in which there is an orbit, and what is made of it.
    fn tiny(&mut self, spot: Spot, (main, along): (usize, &Real)) -> Result<(Cell, Image, Along), Doubt> {
        let across = self.power(self.size - THIN);
        let cell = self.around(spot, (main, along))?.with_sides(main, [across.clone(), across]);
        let image = self.map.image(&cell)?;
        let along = image.curve()?;
        Ok((cell, image, along))
    }

    /// The orbit at the value of the parameter of a guess, in a tiny cell, proved to be stable.
    fn known(&mut self, guess: Point) -> Result<Cell, Doubt> {
        let spot = self.settled(guess, PARAMETER)?;
        let along = self.power(INSIDE - i64::from(self.map.bits()));
        let (cell, image, _) = self.tiny(spot, (PARAMETER, &along))?;
        if image.criticals.iter().all(|x| x.value.is_positive()) {
            Ok(cell)
        } else {
            Err(Doubt::open("the orbit is not proved to be stable"))
        }
    }

    /// The curve leads from an orbit to an end, along stable orbits.
    fn reaches(&mut self, known: &Cell, end: &ClaimedPoint, setting: &Setting) -> Result<(), Doubt> {
        let which = usize::from(end.kind != Kind::Fold);
        let spot = self.critical(known.centre.clone(), which)?;
        let main = farther(&spot.at, &known.centre);
        let (zero, image, along) = self.tiny(spot, (main, &self.power(self.size)))?;
        let critical = &image.criticals[which];
        // Opposite signs at both ends of the curve.
        let slope = along.slope(critical).ok_or_else(lost)?;
        let slope = Real::point(slope.enclosure().mig(), self.map.bits());
        let (thin, _) = self.map.thin(&zero.centre);
        let middle = Real::point(self.map.image(&thin)?.criticals[which].value.enclosure().mag(), self.map.bits());
        let middle = middle + &critical.across();
        if !middle.is_below(&slope) {
            return Err(Doubt::open("no eigenvalue is proved to pass 1 or -1 at an end of the window"));
        }
        let parameter = setting.parameter(&zero.hull()[PARAMETER]);
        let parameter = parameter.ok_or_else(|| Doubt::open("the parameter is not proved to be positive"))?;
        compare("parameter", &parameter, &end.parameter).map_err(unproved)?;
        let mut from = known.clone();
        let mut answer = Err(Doubt::open("nothing is tried"));
        for _ in 0..HALVED {
            answer = self.is_last(&from, &zero, which);
            if answer.is_ok() {
                break;
            }
            let middle = self.between(&from, &zero)?;
            self.are_stable(&from, &middle, HALVED)?;
            from = middle;
        }
        answer
    }

    /// A tiny cell about half-way.
    fn between(&mut self, from: &Cell, to: &Cell) -> Result<Cell, Doubt> {
        let main = farther(&from.centre, &to.centre);
        let at = [0, 1, 2].map(|i| self.point(&(from.centre[i].clone() + &to.centre[i]).half()));
        let spot = self.settled(at, main)?;
        let along = self.power(self.size);
        Ok(self.tiny(spot, (main, &along))?.0)
    }

    /// A cell that holds the curve between two tiny ones, which is proved to be one.
    fn over(&mut self, from: &Cell, to: &Cell) -> Result<(Image, Along), Doubt> {
        let main = farther(&from.centre, &to.centre);
        let middle = [0, 1, 2].map(|i| self.point(&(from.centre[i].clone() + &to.centre[i]).half()));
        let spot = self.settled(middle, main)?;
        let at = spot.at.clone();
        let half = (to.centre[main].clone() - &from.centre[main]).half();
        let half = Real::point(half.enclosure().mag(), self.map.bits());
        let along = half.clone() + &(half * &self.power(-4)); // proposes: a size to try
        let thin = self.around(spot, (main, &along))?;
        // The distance of an end from the direction of the curve.
        let strays = |end: &Point, i: usize| {
            let part = (end[main].clone() - &at[main]).over(&along)?;
            Some((end[i].clone() - &at[i] - &(part * &thin.frame[0][i])).enclosure().mag())
        };
        let across = others(main).map(|i| {
            let most = strays(&from.centre, i).max(strays(&to.centre, i))?; // proposes: a size to try
            Some(Real::point(most.scaled(ROOM), self.map.bits()) + &self.power(self.size + ROOM))
        });
        let [Some(a), Some(b)] = across else { return Err(lost()) };
        let mut cell = thin.with_sides(main, [a, b]);
        for _ in 0..WIDENED {
            if !(cell.holds(&from.hull()) && cell.holds(&to.hull())) {
                return Err(Doubt::open("a cell does not hold the orbits that it is to join"));
            }
            let image = self.map.image(&cell)?;
            if let Ok(along) = image.curve() {
                return Ok((image, along));
            }
            let stretch = image.stretch().ok_or_else(lost)?;
            cell = cell.widened(stretch.map(|x| x * 2 + &self.power(1 - ROOM)));
        }
        Err(Doubt::open("the orbits are not proved to be one curve"))
    }

    /// Proves that all orbits of the curve between two tiny cells are stable.
    fn are_stable(&mut self, from: &Cell, to: &Cell, depth: u32) -> Result<(), Doubt> {
        let joined = self.over(from, to).and_then(|(image, _)| {
            let is_stable = image.criticals.iter().all(|x| x.value.is_positive());
            if is_stable {
                Ok(())
            } else {
                Err(Doubt::open("the orbits in the middle of the window are not proved to be stable"))
            }
        });
        match joined {
            Err(Doubt::Open(_)) if depth > 0 => {
                let middle = self.between(from, to)?;
                self.are_stable(from, &middle, depth - 1)?;
                self.are_stable(&middle, to, depth - 1)
            }
            answer => answer,
        }
    }

    /// Proves that all orbits from a stable one to the end are stable.
    fn is_last(&mut self, from: &Cell, zero: &Cell, which: usize) -> Result<(), Doubt> {
        let (image, along) = self.over(from, zero)?;
        let is_monotone = along.slope(&image.criticals[which]).is_some_and(|slope| !slope.is_across());
        if is_monotone && image.criticals[1 - which].value.is_positive() {
            Ok(())
        } else {
            Err(Doubt::open("the orbits next to an end of the window are not proved to be stable"))
        }
    }
}

/// The state's coordinate in which two points are farther apart.
fn farther(a: &Point, b: &Point) -> usize {
    let apart = |i: usize| (a[i].clone() - &b[i]).enclosure().mag();
    usize::from(apart(1) > apart(0))
}

fn others(kept: usize) -> [usize; 2] {
    [(kept + 1) % 3, (kept + 2) % 3]
}

fn lost() -> Doubt {
    Doubt::open("the curve of the orbits is lost")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Effort;
    use crate::windows::WindowsCertificate;
    use impact_pair_model::watch::Unwatched;
    use serde_json::{Value, json};

    const DOCUMENT: &str = include_str!("../../../tests/documents/windows.jsonl");
    const FIGURE_16: &str = include_str!("../../../tests/window-of-figure-16.json");

    fn budget() -> Budget<'static> {
        Budget::new(Effort::default().work, Effort::default().parts, &Unwatched)
    }

    /// The verdict on the orbits between the ends of a window with another value, its orbit and its ends not checked.
    fn between(key: &str, value: Value) -> Result<u32, Doubt> {
        let mut document: Value = serde_json::from_str(DOCUMENT).unwrap();
        *document["windows"][0].pointer_mut(key).unwrap() = value;
        let own = WindowsCertificate::parse(&document.to_string()).unwrap();
        let over = Over { pair: own.pair(), start: own.start(), key: own.over() };
        own.windows()[0].is_stable_between(&over, &budget())
    }

    /// The curve of stable orbits leads to the ends that are claimed, from the orbit that is claimed (Lemma V30, window), whatever V8 and V9 say of them.
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

    /// Rounding in 32 flights of figure 16 is more than a tiny cell has room for at first.
    #[test]
    fn r52_the_orbit_of_a_window_of_figure_16_is_proved_in_more_bits() {
        let own = WindowsCertificate::parse(FIGURE_16).unwrap();
        let (over, window) = (Over { pair: own.pair(), start: own.start(), key: own.over() }, &own.windows()[0]);
        let (setting, size) = (Setting::new(over.pair, over.key).unwrap(), -141);
        let begun = |spare: i64| {
            let bits = u32::try_from(spare - size).unwrap();
            window.begun((&setting, &over), (size, bits), (&window.orbit.orbits()[0], &budget()))
        };
        assert!(begun(SPARE_BITS).is_err() && begun(2 * SPARE_BITS).is_ok());
    }
}
