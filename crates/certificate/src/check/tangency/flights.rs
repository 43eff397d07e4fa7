//! The flights of a word of the reduced map as jets, each proved to end at its first contact (Lemmas V1, V17).

use super::jet::{self, Jet, product, scaled, sum};
use super::saddle::Law;
use super::series::State;
use crate::check::affine::Affine;
use crate::check::angle::Angle;
use crate::check::budget::Budget;
use crate::check::contact::{Claimed, Doubt, Start, contract, first_contact, first_hit};
use crate::check::flight::Flight;
use crate::check::shaking::{Shaking, Term};
use impact_pair_exact::{Enclosure, Real};
use impact_pair_model::Wall;

/// Bits in which guesses are refined.
const GUESS_BITS: u32 = 128;
/// Steps per radian of a guess, and the greatest number of steps.
const STEPS_PER_RADIAN: f64 = 64.0;
const MAX_STEPS: u32 = 1 << 14;
const HALVINGS: u32 = 40;

/// A flight from the near wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::check) enum Letter {
    /// A flight to the far wall.
    Far,
    /// A flight back to the near wall.
    Near,
}

impl Letter {
    fn wall(self) -> Wall {
        match self {
            Self::Far => Wall::Right,
            Self::Near => Wall::Left,
        }
    }
}

/// All flights from a set of states, in units in which `A` and `W` are 1; the near wall is the left one.
pub(super) struct Launch<'b> {
    flight: Flight<'b>,
}

const FROM_WALL: Start = Start { wall: Some(Wall::Left), is_release: false };

impl<'b> Launch<'b> {
    /// The flights from impacts with these phases and speeds.
    pub fn new([gap, e]: [&Real; 2], [phase, speed]: [&Real; 2], budget: &Budget<'b>) -> Self {
        let bits = e.bits();
        let term =
            Term { amplitude: Affine::fixed(Real::int(1, bits)), phase: Affine::fixed(Real::zero(bits)), rate: None };
        let half_gap = gap.half();
        let flight = Flight {
            shaking: Shaking { waves: vec![term.wave(phase, bits, Affine::hull, Angle::new)] },
            height: -&half_gap,
            half_gap,
            velocity: e.clone() * speed,
            budget: budget.clone(),
        };
        Self { flight }
    }

    /// Encloses the duration of all flights up to the first contact, which is proved to be with the wall of the letter. A proof that
    /// the flights end on the other wall refutes the word.
    pub fn first(&self, letter: Letter, guess: &Real) -> Result<Real, Doubt> {
        let claimed = |guess: &Real| Claimed {
            from: Real::zero(self.flight.bits()),
            guess: guess.clone(),
            to: None,
            is_first: true,
        };
        let answer = first_contact(&self.flight, FROM_WALL, letter.wall(), &claimed(guess));
        let other = if letter == Letter::Far { Wall::Left } else { Wall::Right };
        match answer {
            Ok(time) => Ok(contract(&self.flight, letter.wall(), time.at(self.flight.bits()))),
            Err(doubt) => {
                let hit = first_hit(&self.flight.rounded(GUESS_BITS), FROM_WALL);
                let elsewhere = hit.and_then(|hit| first_contact(&self.flight, FROM_WALL, other, &claimed(&hit)).ok());
                Err(elsewhere.map_or(doubt, |_| Doubt::False("a flight ends on the other wall".into())))
            }
        }
    }

    /// Whether no flight has another contact between the two times: the ball moves towards the wall of its contact all the while.
    pub fn is_only(&self, contact: &Real, other: &Real) -> bool {
        !self.flight.slope(&contact.hull(other)).is_across()
    }

    /// The contact of the middle's flight, which a bracket of all contacts contains.
    fn within(&self, letter: Letter, bracket: Real) -> Real {
        contract(&self.flight, letter.wall(), bracket)
    }
}

/// Approximate end of a flight: the first of small steps at whose end the ball is beyond a wall. Non-rigorous.
pub(in crate::check) fn guess([gap, e]: [f64; 2], [phase, speed]: [f64; 2]) -> Real {
    let drift = e * speed + phase.cos(); // proposes
    let height = |h: f64| drift * h - (phase + h).sin() + phase.sin(); // proposes
    let is_inside = |h: f64| height(h) > 0.0 && height(h) < gap; // proposes
    let ends = (1..MAX_STEPS).map(|k| f64::from(k) / STEPS_PER_RADIAN); // proposes
    let [mut inside, mut beyond] =
        ends.into_iter().find(|h| !is_inside(*h)).map_or([0.0, 1.0], |h| [h - 1.0 / STEPS_PER_RADIAN, h]); // proposes
    for _ in 0..HALVINGS {
        let middle = (inside + beyond) / 2.0; // proposes
        if is_inside(middle) { inside = middle } else { beyond = middle }
    }
    Real::new(Enclosure::from_f64_bounds(beyond, beyond).expect("a number"), GUESS_BITS)
}

/// One flight of all members: its duration, and the state just before the impact at its end.
pub(in crate::check) struct Flown {
    pub time: Real,
    pub state: State,
}

/// Flies from a state to the next impact. Lemma V17
pub(in crate::check) fn fly(
    law: &Law,
    from: &State,
    (letter, guess): (Letter, &Real),
    budget: &Budget<'_>,
) -> Result<Flown, Doubt> {
    let (bits, gap) = (law.bits(), &law.gap);
    let open = || Doubt::open("a contact is not proved to be transversal");
    let [theta, speed, level, bounce] = [&from.phase, &from.speed, gap, &law.e].map(|jet| jet.value(bits));
    let [at, w, d, e] = [&theta, &speed, &level, &bounce].map(Affine::hull);
    let time = Launch::new([&d, &e], [&at, &w], budget).first(letter, guess)?;
    let middle = Launch::new([&level.centre, &bounce.centre], [&theta.centre, &speed.centre], budget);
    let own = middle.within(letter, time.clone());
    let (s, c) = at.sin_cos();
    let arrival = e.clone() * &w + &c - &(at + &time).cos();
    let over = |x: Real| x.over(&arrival).ok_or_else(open);
    // v dtheta_1 = dl - h (e dw + w de) + (h sin theta + e w) dtheta
    let by_phase = over(time.clone() * &s + &(e.clone() * &w))?;
    let slopes = [by_phase, over(-(time.clone() * &e))?, over(Real::int(1, bits))?, over(-(time.clone() * &w))?];
    let mut terms = vec![(&slopes[0], &theta), (&slopes[1], &speed), (&slopes[3], &bounce)];
    if letter == Letter::Far {
        terms.push((&slopes[2], &level));
    }
    let landing = Affine::of(theta.centre.clone() + &own, &terms);
    let (s, c) = from.phase.sin_cos(bits);
    let drift = from.speed.times(&law.e).plus(&c);
    let mut phase = Jet::constant_of(landing);
    // The first derivatives, then the second ones.
    for powers in [[jet::X, jet::D], [jet::XX, jet::XD]] {
        let (s1, c1) = phase.sin_cos(bits);
        let height = drift.times(&phase.minus(&from.phase)).minus(&s1).plus(&s);
        let height = if letter == Letter::Far { height.minus(gap) } else { height };
        let arrival = Jet::constant_of(drift.minus(&c1).value(bits));
        let step = height.times_integer(-1).over(&arrival, bits).ok_or_else(open)?;
        phase = phase.with(powers, &step);
    }
    let (_, c1) = phase.sin_cos(bits);
    let speed = drift.minus(&c1);
    let state = match letter {
        Letter::Far => State { phase: phase.plus(&Jet::constant(law.pi.clone())), speed },
        Letter::Near => State { phase, speed: speed.times_integer(-1) },
    };
    Ok(Flown { time, state })
}

/// The determinant of two vectors.
pub(in crate::check) fn across(a: [&Affine; 2], b: [&Affine; 2]) -> Affine {
    let bits = a[0].centre.bits();
    sum(&product(a[0], b[1]), &scaled(&product(a[1], b[0]), &Real::int(-1, bits)))
}
