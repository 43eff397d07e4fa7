//! Images of cells under the flights of a period, and the curve of periodic orbits in a cell (Lemma V30).

use super::cell::{FRAME_BITS, Point};
use crate::check::contact::Doubt;
use crate::check::legs::{Legs, Rows};
use crate::check::round::{Matrix, along, inverse};
use impact_pair_exact::Real;

/// The image of a cell under the flights of a period.
pub(super) struct Image {
    /// Displacement of the state at the centre, without whole forcing periods.
    pub off: [Real; 2],
    /// Encloses the derivatives of the displacement by the coordinates `q` over the cell.
    pub slopes: Rows<3>,
    pub legs: Legs<3, 1>,
    /// The derivatives of the state at the start by the coordinates.
    pub starts: Rows<3>,
    /// The functions that vanish where 1, or -1, is an eigenvalue.
    pub criticals: [Critical; 2],
}

/// `1 + det - trace` or `1 + det + trace` of the derivative by the state, zero where 1, or -1, is an eigenvalue.
pub(super) struct Critical {
    /// The function over the cell.
    pub value: Real,
    /// Derivatives of the function by the coordinates `q` over the cell.
    pub slopes: [Real; 3],
}

/// Slopes along the curve of periodic orbits of a cell.
pub(super) struct Along {
    /// Bounds of the derivatives of `q_1` and `q_2` by `q_0`.
    steepness: Option<Real>,
}

impl Image {
    /// The derivatives by two coordinates.
    fn square(&self, coordinates: [usize; 2]) -> Matrix {
        self.slopes.each_ref().map(|row| coordinates.map(|j| row[j].clone()))
    }

    /// Approximate inverse of the derivatives by two coordinates; any matrix is sound.
    fn newton(&self, coordinates: [usize; 2]) -> Option<Matrix> {
        let middles = self.square(coordinates).map(|row| row.map(|x| x.middle()));
        Some(inverse(&middles)?.map(|row| row.map(|x| x.middle())))
    }

    /// Returns the step of Newton's iteration for a periodic orbit in two coordinates of a thin cell, in its units. Non-rigorous.
    pub fn step(&self, coordinates: [usize; 2]) -> Option<[Real; 2]> {
        Some(self.newton(coordinates)?.map(|row| -along(&row, &self.off)))
    }

    /// Returns the direction of the curve of periodic orbits, of any length. Non-rigorous.
    pub fn direction(&self) -> Point {
        let [a, b] = &self.slopes;
        let minor = |i: usize, j: usize| a[i].clone() * &b[j] - &(a[j].clone() * &b[i]);
        [minor(1, 2), minor(2, 0), minor(0, 1)].map(|x| x.middle())
    }

    /// For each coordinate across, the sum that has to be below 1, and the part that is not the curve's own change. Lemma V30
    fn sums(&self) -> Option<([Real; 2], Along)> {
        let newton = self.newton([1, 2])?;
        let change = self.legs.moved(&newton, &self.starts);
        let magnitude = |x: &Real| Real::point(x.enclosure().mag(), FRAME_BITS);
        let own = [0, 1].map(|k| magnitude(&(change[k][1 + k].clone() - 1)) + &magnitude(&change[k][2 - k]));
        let drift = change.each_ref().map(|row| magnitude(&row[0]));
        let moved = newton.each_ref().map(|row| magnitude(&along(row, &self.off)));
        let sums = [0, 1].map(|k| own[k].clone() + &drift[k] + &moved[k]);
        let one = Real::int(1, FRAME_BITS);
        let steepness = greater(&drift).over(&(one - &greater(&own)));
        Some((sums, Along { steepness }))
    }

    /// Approximate factors by which the sides across are too short.
    pub fn stretch(&self) -> Option<[Real; 2]> {
        Some(self.sums()?.0)
    }

    /// Proves that the periodic orbits of the cell are one curve: exactly one for each `q_0`. Lemma V30
    pub fn curve(&self) -> Result<Along, Doubt> {
        let one = Real::int(1, FRAME_BITS);
        let proved = self.sums().filter(|(sums, _)| sums.iter().all(|sum| sum.is_below(&one)));
        proved.map(|(_, along)| along).ok_or_else(|| Doubt::open("the orbits are not proved to be one curve"))
    }
}

/// The greater of two bounds.
fn greater([a, b]: &[Real; 2]) -> Real {
    let [a, b] = [a, b].map(|x| x.enclosure().sup());
    Real::point(if a < b { b.clone() } else { a.clone() }, FRAME_BITS)
}

impl Critical {
    /// Bound of the change of the function with `q_1` and `q_2`.
    pub fn across(&self) -> Real {
        let [_, a, b] = self.slopes.each_ref().map(|x| Real::point(x.enclosure().mag(), FRAME_BITS));
        a + &b
    }
}

impl Along {
    /// Bounds of the derivative by `q_0` along the curve.
    pub fn slope(&self, x: &Critical) -> Option<Real> {
        let most = x.across() * self.steepness.as_ref()?;
        Some(x.slopes[0].clone() + &Real::within(most.enclosure().sup(), FRAME_BITS))
    }
}
