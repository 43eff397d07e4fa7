//! Reference for the tests of this module: single flights by equations (11) and (12) in 320 bits; and the
//! flights that are tested, many of them grazing a wall by as little as doubles can distinguish.

use super::*;
use crate::number::tests::{Truth, member, places, powers};
use crate::number::{Std, kernel::sin_cos};
use crate::pair::Reduced;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// One flight, measured from its wall; times in forcing periods since its start.
#[derive(Clone, Debug)]
pub(super) struct TrueFlight {
    pub alpha: Truth,
    pub wall: Wall,
    pub phase: Truth,
    pub height: Truth,
    pub velocity: Truth,
}

impl TrueFlight {
    /// Mirrored sine and cosine.
    pub fn sin_cos(&self, time: &Truth) -> (Truth, Truth) {
        let (sin, cos) = (&self.phase + time).sin_cos();
        (sin * self.wall.sign(), cos * self.wall.sign())
    }

    pub fn drift(&self) -> Truth {
        &self.velocity + self.beta() * self.sin_cos(&0.0.into()).1
    }

    pub fn beta(&self) -> Truth {
        Truth::turn() * &self.alpha
    }

    /// **Equation** (11)
    pub fn height_at(&self, time: &Truth) -> Truth {
        let wave = self.sin_cos(time).0 - self.sin_cos(&0.0.into()).0;
        &self.height + self.drift() * time - &self.alpha * &wave
    }

    /// **Equation** (12)
    pub fn velocity_at(&self, time: &Truth) -> Truth {
        self.drift() - self.beta() * self.sin_cos(time).1
    }

    /// **Equation** (10)
    pub fn acceleration_at(&self, time: &Truth) -> Truth {
        Truth::turn() * self.beta() * self.sin_cos(time).0
    }

    /// The zero of `z - target` that Newton's method finds from `near`, where it converges.
    pub fn contact(&self, target: f64, near: &Truth) -> Truth {
        newton(near, |time| (self.height_at(time) - target).over(&self.velocity_at(time)))
    }

    /// The extremum that Newton's method finds from `near`.
    pub fn extremum(&self, near: &Truth) -> Truth {
        newton(near, |time| self.velocity_at(time).over(&self.acceleration_at(time)))
    }

    /// Whether the ball is proved to be beyond a wall at this time.
    pub fn is_outside(&self, time: &Truth) -> bool {
        let z = self.height_at(time);
        z.exceeds(1.0) || (-z).exceeds(0.0)
    }
}

/// The zero, with twice what the last step is; any number where a step has no end.
fn newton(near: &Truth, step: impl Fn(&Truth) -> Option<Truth>) -> Truth {
    let mut at = near.point();
    let mut left = Truth::from(1e9);
    for _ in 0..8 {
        let Some(next) = step(&at) else { return at.widened(&1e9.into()) };
        left = next;
        at = (&at - &left).point();
    }
    at.widened(&(left * 2.0))
}

/// A set of starts, for a set of pairs.
#[derive(Clone, Debug)]
pub(super) struct Case {
    pub pair: Reduced<Ball>,
    pub wall: Wall,
    pub inside: Option<f64>,
    pub phase: f64,
    pub velocity: f64,
    pub radii: Radii,
    /// A member's places in the balls of `A/d`, phase, velocity and height.
    pub places: [f64; 4],
}

impl Case {
    pub fn flight(&self) -> Flight<f64> {
        let (pair, sin_cos) = (self.pair.centre(), sin_cos(self.phase));
        match self.inside {
            Some(height) => Flight::from_inside(&pair, height, self.phase, self.velocity, sin_cos),
            None => Flight::from_wall(&pair, self.wall, self.phase, self.velocity, sin_cos),
        }
    }

    pub fn margins(&self) -> Margins {
        Margins::new(&self.pair)
    }

    /// The member of the set at other places.
    pub fn truth_at(&self, [alpha, phase, velocity, height]: [f64; 4]) -> TrueFlight {
        let Radii { phase: of_phase, velocity: of_velocity, height: of_height } = self.radii;
        let inside = self.inside.map(|height| Ball::new(height, of_height));
        TrueFlight {
            alpha: member(&self.pair.alpha, alpha),
            wall: if inside.is_some() { Wall::Left } else { self.wall },
            phase: member(&Ball::new(self.phase, of_phase), phase),
            velocity: member(&Ball::new(self.velocity, of_velocity), velocity),
            height: inside.map_or(0.0.into(), |ball| member(&ball, height)),
        }
    }

    /// The member of the set at `places`.
    pub fn truth(&self) -> TrueFlight {
        self.truth_at(self.places)
    }

    /// Between two speeds after which different walls are hit there is one that grazes: nearly this one.
    fn grazing(mut self, off: f64) -> Self {
        let hit = |velocity: f64| {
            let flight = Self { velocity, ..self.clone() }.flight();
            first_contact_f64::<Kernel>(&flight).map(|contact| contact.wall)
        };
        let (mut low, mut high) = (self.velocity, self.velocity.abs() + 4.0);
        let least = hit(low);
        if hit(high) != least {
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                *(if hit(middle) == least { &mut low } else { &mut high }) = middle;
            }
            self.velocity = low * (1.0 + off);
        }
        self
    }
}

/// `A/d` over six decades with a radius of nothing to a millionth.
pub(super) fn pairs() -> impl Strategy<Value = Reduced<Ball>> {
    let radius = prop_oneof![2 => Just(0.0), 1 => powers(-17.0, -6.0)];
    (powers(-3.0, 3.0), radius).prop_map(|(alpha, radius)| {
        let alpha = Ball::new(alpha, alpha * radius);
        Reduced::new(alpha, Ball::exact(0.5))
    })
}

/// Starts from walls and inside, points or sets, of every speed, half of them next to a graze.
pub(super) fn cases() -> impl Strategy<Value = Case> {
    let wall = prop_oneof![Just(Wall::Left), Just(Wall::Right)];
    let phase = prop_oneof![4 => -0.5..0.5f64, 1 => (-4..=4i32).prop_map(|k| f64::from(k) / 8.0)];
    let speed = prop_oneof![1 => Just(0.0), 4 => powers(-9.0, 1.0)];
    let inside = prop_oneof![
        3 => Just(None),
        1 => (prop_oneof![0.0..1.0f64, powers(-15.0, -1.0)], any::<bool>()).prop_map(Some),
    ];
    let radius = || prop_oneof![2 => Just(0.0), 1 => powers(-18.0, -5.0)];
    let off =
        prop_oneof![Just(None), (powers(-17.0, -1.0), -1.0..1.0f64).prop_map(|(x, sign)| Some(x * sign.signum()))];
    let places = [places(), places(), places(), places()];
    (pairs(), wall, inside, phase, speed, [radius(), radius(), radius()], places, off).prop_map(
        |(pair, wall, inside, phase, speed, [of_phase, of_velocity, of_height], mut places, off)| {
            let speed = speed * pair.beta.mid();
            let velocity = if inside.is_some_and(|(_, falls)| falls) { -speed } else { speed };
            // A ball starts inside the gap: no member of its height is beyond the wall that is near.
            places[3] = f64::abs(places[3]) * if inside.is_some_and(|(z, _)| z > 0.5) { -1.0 } else { 1.0 };
            let radii = Radii { phase: of_phase, velocity: of_velocity * speed, height: of_height + f64::EPSILON };
            let radii = if inside.is_some() { radii } else { Radii { height: 0.0, ..radii } };
            let case = Case { pair, wall, inside: inside.map(|(z, _)| z), phase, velocity, radii, places };
            match off {
                Some(off) => case.grazing(off),
                None => case,
            }
        },
    )
}

/// Asserts that this is the member's first contact: it holds its zero, and no earlier one is seen.
pub(super) fn assert_first(truth: &TrueFlight, found: &Contact<Ball>) -> Result<Truth, TestCaseError> {
    let near = if truth.wall == found.wall { 0.0 } else { 1.0 };
    let time = truth.contact(near, &found.time.mid().into());
    prop_assert!(time.is_in(&found.time), "the contact is at {:?}", time.0.to_f64_bounds());
    prop_assert!((&truth.phase + &time - found.turns).is_in(&found.phase), "phase");
    let velocity = truth.velocity_at(&time) * truth.wall.sign();
    prop_assert!(velocity.is_in(&found.velocity), "velocity {:?}", velocity.0.to_f64_bounds());
    for part in 1..8 {
        prop_assert!(!truth.is_outside(&(&time * (f64::from(part) / 8.0))), "{part}/8 of the way to the contact");
    }
    Ok(time)
}

/// Asserts that the extrema of the first forcing periods, and the last ones before the contact, are not beyond a wall.
fn assert_clear(flight: &Flight<f64>, truth: &TrueFlight, contact: &Truth) -> Result<(), TestCaseError> {
    if flight.drift.abs() >= flight.beta {
        return Ok(());
    }
    let extrema = extrema::Extrema::new::<Kernel>(flight);
    let whole = contact.0.to_f64_bounds().0.floor();
    for first in [extrema.first_max, extrema.first_min] {
        for turns in [0.0, 1.0, whole - 2.0, whole - 1.0, whole] {
            let time = truth.extremum(&(Truth::from(first) + turns));
            if contact.exceeds(&time) && time.exceeds(0.0) {
                prop_assert!(!truth.is_outside(&time), "extremum at {:?}", time.0.to_f64_bounds());
            }
        }
    }
    Ok(())
}

/// Asserts that plain doubles with either trigonometry are close to a contact that is decided: a label, not a proof.
fn assert_near(case: &Case, found: &Contact<Ball>) -> Result<(), TestCaseError> {
    let own = first_contact_f64::<Kernel>(&case.flight()).expect("the proposal that was certified");
    prop_assert_eq!(own.wall, found.wall);
    // The error of times by the rounding of heights.
    let noise = 1e-13 * (1.0 + case.pair.alpha.mid()) * (1.0 + own.time) / own.velocity.abs() + found.time.rad();
    prop_assert!((own.time - found.time.mid()).abs() <= noise);
    if let Some(other) = first_contact_f64::<Std>(&case.flight()).filter(|other| other.wall == found.wall) {
        // The other trigonometry may fall to the other side of a near graze, forcing periods away.
        let same_turn = (other.time - own.time).abs() < 0.1;
        prop_assert!(!same_turn || (other.time - found.time.mid()).abs() <= noise);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Lemmas C3 to C6.
    #[test]
    fn a_certified_contact_holds_the_first_one_of_every_member(case in cases()) {
        let flight = case.flight();
        let Verdict::Certified(found) = first_contact(&flight, &case.margins(), case.radii) else { return Ok(()) };
        let contact = assert_first(&case.truth(), &found)?;
        assert_clear(&flight, &case.truth(), &contact)?;
        assert_near(&case, &found)?;
    }

    /// The sets of an orbit: all its members, and more closely those near the centre (Lemma S4).
    #[test]
    fn the_image_of_a_set_holds_that_of_every_member(case in cases(), narrow in powers(-3.0, 0.0)) {
        let Radii { phase, velocity, height } = case.radii;
        let point = Radii { phase: 0.0, velocity: velocity * narrow, height };
        let Ok((found, sin)) = first_contacts(&case.flight(), &case.margins(), point, case.radii) else { return Ok(()) };
        let truth = case.truth();
        let time = assert_first(&truth, &found.all)?;
        prop_assert!((truth.sin_cos(&time).0 * truth.wall.sign()).is_in(&sin), "sine {sin:?}");
        // A member of the narrow set: the velocity lies on the slope through the phase.
        let centre = Case { radii: Radii { phase, ..point }, ..case.clone() };
        let truth = centre.truth_at([case.places[0], 0.0, case.places[2], case.places[3]]);
        let time = assert_first(&truth, &found.all)?;
        let at = &truth.phase + &time - found.all.turns;
        prop_assert!(at.is_in(&found.phase), "phase {:?}", found.phase);
        let slope = member(&found.slope, 1.0).0.hull(&member(&found.slope, -1.0).0);
        let along = Truth(slope) * (at - found.phase.mid());
        prop_assert!((truth.velocity_at(&time) * truth.wall.sign() - along).is_in(&found.velocity), "velocity {:?}", found.velocity);
    }
}

/// Half the cases are meant to graze; enough of both are decided, and some of the grazes are not.
#[test]
fn the_cases_have_every_verdict() {
    let mut runner = TestRunner::deterministic();
    let mut count = [0, 0, 0];
    for _ in 0..400 {
        let case = cases().new_tree(&mut runner).unwrap().current();
        let kind = match first_contact(&case.flight(), &case.margins(), case.radii) {
            Verdict::Certified(_) => 0,
            Verdict::Undecided(Undecided { reason: Reason::Graze, .. }) => 1,
            Verdict::Undecided(_) => 2,
        };
        count[kind] += 1;
    }
    assert!(count[0] > 200 && count[1] > 20, "{count:?}");
}
