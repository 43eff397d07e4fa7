//! The mappings P1-P4 between the switch-planes, words of them, and their Jacobian (A.7).

use std::fmt;
use std::str::FromStr;

use crate::error::Error;
use crate::number::Number;
use crate::pair::{Wall, rebound};

/// A mapping from one switch-plane to the next. **Equations** (24)-(27)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mapping {
    /// S+ -> S-, right wall to left wall; `D = -d` (A.1), (A.2).
    P1,
    /// S- -> S+, left wall to right wall; `D = +d` (A.3), (A.4).
    P2,
    /// S+ -> S+, right wall to itself; `D = 0` (A.5), (A.6).
    P3,
    /// S- -> S-, left wall to itself; `D = 0` (A.5), (A.6).
    P4,
}

impl Mapping {
    /// The mapping of a flight from one wall to the other or back.
    pub fn between(from: Wall, to: Wall) -> Self {
        match (from, to) {
            (Wall::Right, Wall::Left) => Self::P1,
            (Wall::Left, Wall::Right) => Self::P2,
            (Wall::Right, Wall::Right) => Self::P3,
            (Wall::Left, Wall::Left) => Self::P4,
        }
    }

    /// The walls the mapping leaves from and arrives at.
    pub fn walls(self) -> (Wall, Wall) {
        match self {
            Self::P1 => (Wall::Right, Wall::Left),
            Self::P2 => (Wall::Left, Wall::Right),
            Self::P3 => (Wall::Right, Wall::Right),
            Self::P4 => (Wall::Left, Wall::Left),
        }
    }
}

impl fmt::Display for Mapping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::P1 => "P1",
            Self::P2 => "P2",
            Self::P3 => "P3",
            Self::P4 => "P4",
        })
    }
}

/// A composition of mappings, in time order; written as in the paper with the first mapping right-most.
///
/// Read from `"P2 P4 P1 P3"` or, by the walls of the impacts in time order, from `"RRLL"` (the same motion:
/// the ball is on the right wall, returns to it by P3, goes left by P1, returns by P4, goes right by P2).
///
/// ```
/// use impact_pair::mapping::{Mapping, Word};
/// let model_iii: Word = "P2 P4 P1 P3".parse()?;
/// assert_eq!(model_iii.mappings().first(), Some(&Mapping::P3));
/// assert_eq!(model_iii, "RRLL".parse()?);
/// assert_eq!(model_iii.to_string(), "P2 P4 P1 P3");
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Word(Vec<Mapping>);

impl Word {
    /// The word of these mappings, given in time order.
    ///
    /// # Errors
    /// When a mapping does not start on the wall where the one before it ended, or there is none.
    pub fn new(mappings: Vec<Mapping>) -> Result<Self, Error> {
        let chained = mappings.windows(2).all(|pair| pair[0].walls().1 == pair[1].walls().0);
        let word = Self(mappings);
        if word.0.is_empty() || !chained {
            return Err(Error::word(&word.to_string()));
        }
        Ok(word)
    }

    /// The mappings in time order.
    pub fn mappings(&self) -> &[Mapping] {
        &self.0
    }

    /// Whether the word can be repeated: it ends on the wall it starts from.
    pub fn is_closed(&self) -> bool {
        self.0.first().map(|m| m.walls().0) == self.0.last().map(|m| m.walls().1)
    }
}

impl FromStr for Word {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let walls: Option<Vec<Wall>> = text
            .chars()
            .map(|c| match c {
                'L' => Some(Wall::Left),
                'R' => Some(Wall::Right),
                _ => None,
            })
            .collect();
        if let Some(walls) = walls.filter(|walls| !walls.is_empty()) {
            let next = walls.iter().cycle().skip(1);
            return Self::new(walls.iter().zip(next).map(|(&a, &b)| Mapping::between(a, b)).collect());
        }
        let mappings: Option<Vec<Mapping>> = text
            .split_whitespace()
            .rev()
            .map(|name| {
                [Mapping::P1, Mapping::P2, Mapping::P3, Mapping::P4].into_iter().find(|m| m.to_string() == name)
            })
            .collect();
        Self::new(mappings.ok_or_else(|| Error::word(text))?)
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, mapping) in self.0.iter().rev().enumerate() {
            if i > 0 {
                f.write_str(" ")?;
            }
            mapping.fmt(f)?;
        }
        Ok(())
    }
}

/// What the Jacobian of one mapping depends on; velocities in gaps a turn, with their sign, before the impacts.
#[derive(Clone, Copy, Debug)]
pub struct Passage<N> {
    /// `h = t1 - t0` in turns.
    pub time: N,
    /// `sin th0` at the impact the flight starts with.
    pub sin0: N,
    /// `sin th1` at the impact it ends with.
    pub sin1: N,
    /// `v0`
    pub velocity0: N,
    /// `v1`
    pub velocity1: N,
}

/// `[[dt1/dt0, dt1/dv0], [dv1/dt0, dv1/dv0]]` of a mapping, times in turns, velocities in gaps a turn.
///
/// **Equation** (A.7), the same for P1-P4. **Enclosure** (for balls): holds the Jacobian at every start whose
/// passage lies in `passage`. `None` when `v1` may be 0: the arrival may be a graze.
///
/// # Departs from the paper
/// Its second row has `sin(W t_i + tau)` for `sin(W t_{i+1} + tau)`, and its velocity column lacks
/// `e h/v_{i+1}`; both are misprints. The determinant is `e^2 v0/v1`.
///
/// ```
/// use impact_pair::mapping::{Passage, jacobian};
/// // No shaking: a ball at 4 gaps a turn rebounds with e v0 = 2 and crosses in half a turn.
/// let passage = Passage { time: 0.5, sin0: 0.0, sin1: 0.0, velocity0: -4.0, velocity1: 2.0 };
/// let [[a, b], [c, d]] = jacobian(0.0, 0.5, &passage).unwrap();
/// assert_eq!([a, b, c, d], [1.0, 0.125, 0.0, -0.5]);
/// assert_eq!(a * d - b * c, 0.5 * 0.5 * -4.0 / 2.0);
/// ```
#[inline(always)]
pub fn jacobian<N: Number>(beta: N, restitution: N, passage: &Passage<N>) -> Option<[[N; 2]; 2]> {
    let Passage { time, sin0, sin1, velocity0, velocity1 } = passage.clone();
    let swing = beta.turn() * beta;
    jacobian_between(restitution, time, [swing.clone() * sin0, swing * sin1], [velocity0, velocity1])
}

/// The same from the accelerations `y''` after the impact it starts with and at the one it ends with.
#[inline(always)]
pub(crate) fn jacobian_between<N: Number>(
    restitution: N,
    time: N,
    [swing0, swing1]: [N; 2],
    [velocity0, velocity1]: [N; 2],
) -> Option<[[N; 2]; 2]> {
    let inverse = N::from_f64(1.0).checked_div(velocity1)?;
    let after = rebound(&restitution, velocity0);
    let time_by_time = swing0.clone().mul_add(time.clone(), after) * inverse.clone();
    let time_by_velocity = restitution.clone() * time * inverse;
    let velocity_by_time = swing1.clone().mul_add(time_by_time.clone(), -swing0);
    let velocity_by_velocity = swing1.mul_add(time_by_velocity.clone(), -restitution);
    Some([[time_by_time, time_by_velocity], [velocity_by_time, velocity_by_velocity]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Ball;
    use proptest::prelude::*;

    proptest! {
        /// det DP = e^2 v0/v1, a theorem of (A.7).
        #[test]
        fn the_determinant_is_e_squared_times_the_ratio_of_velocities(
            beta in 0.01..100.0f64, e in 0.0..=1.0f64, time in 1e-6..10.0f64,
            sin0 in -1.0..1.0f64, sin1 in -1.0..1.0f64, v0 in -10.0..10.0f64, v1 in 0.1..10.0f64,
        ) {
            let ball = Ball::exact;
            let passage = Passage { time: ball(time), sin0: ball(sin0), sin1: ball(sin1), velocity0: ball(v0), velocity1: ball(v1) };
            let [[a, b], [c, d]] = jacobian(ball(beta), ball(e), &passage).unwrap();
            let (found, expected) = (a * d - b * c, ball(e) * ball(e) * ball(v0).checked_div(ball(v1)).unwrap());
            prop_assert!((found.mid() - expected.mid()).abs() <= found.rad() + expected.rad());
        }
    }

    #[test]
    fn words_read_as_they_are_written() {
        for text in ["P2 P1", "P3", "P2 P4 P1 P3", "P2 P4 P1", "P1 P3 P2", "P2 P4 P4 P1 P3 P3"] {
            let word: Word = text.parse().unwrap();
            assert_eq!(word.to_string(), text);
            assert!(word.is_closed());
        }
    }

    #[test]
    fn words_that_do_not_chain_are_refused() {
        for text in ["", "P1 P1", "P5", "P2 P3 P2", "RLX", "rl"] {
            assert!(text.parse::<Word>().is_err(), "{text}");
        }
    }
}
