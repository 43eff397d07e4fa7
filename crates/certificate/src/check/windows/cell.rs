//! Parallelepipeds of states of the reduced map and values of its parameter (Lemma V30).

use crate::check::affine::Affine;
use impact_pair_exact::{Dyadic, Real};

/// Phase \[rad\], speed over `A W`, and the parameter `D` or `e`.
pub(super) type Point = [Real; 3];

/// Bits of the directions of a cell, which are exact.
pub(super) const FRAME_BITS: u32 = 96;
/// `centre + frame[0] q_0 + frame[1] q_1 + frame[2] q_2` with `|q_i| <= 1`; the directions are points.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub centre: Point,
    pub frame: [Point; 3],
}

impl Cell {
    /// The cell with these directions, rounded.
    pub fn new(centre: Point, frame: [Point; 3]) -> Self {
        let rounded = |x: Real| x.rounded(FRAME_BITS).middle();
        Self { centre: centre.map(|x| x.middle()), frame: frame.map(|direction| direction.map(rounded)) }
    }

    /// The cell with these sides along the two coordinates other than `main`.
    pub fn with_sides(self, main: usize, sides: [Real; 2]) -> Self {
        let [first, ..] = self.frame;
        let [a, b] = sides;
        let side = |i: usize, x: &Real| {
            let own = (main + 1 + i) % 3;
            [0, 1, 2].map(|j| if j == own { x.clone() } else { Real::zero(FRAME_BITS) })
        };
        Self::new(self.centre, [first, side(0, &a), side(1, &b)])
    }

    /// The cell with its sides across multiplied by these factors.
    pub fn widened(self, [a, b]: [Real; 2]) -> Self {
        let [first, second, third] = self.frame;
        Self::new(self.centre, [first, second.map(|x| x * &a), third.map(|x| x * &b)])
    }

    /// The coordinate `i` of the members.
    pub fn spanned(&self, i: usize) -> Affine {
        let unit = |j: usize| Affine::varied(Real::zero(FRAME_BITS), Dyadic::power_of_two(0), j);
        let [a, b, c] = [0, 1, 2].map(unit);
        let [u, v, w] = self.frame.each_ref().map(|direction| &direction[i]);
        Affine::of(self.centre[i].clone(), &[(u, &a), (v, &b), (w, &c)])
    }

    /// Bounds of the members.
    pub fn hull(&self) -> Point {
        [0, 1, 2].map(|i| self.spanned(i).hull())
    }

    /// Whether all points of `all` are members, and none is on a face.
    pub fn holds(&self, all: &Point) -> bool {
        let off = [0, 1, 2].map(|i| all[i].clone() - &self.centre[i]);
        let columns = |i: usize| [0, 1, 2].map(|j| self.frame[j][i].at(off[i].bits()));
        let rows = [0, 1, 2].map(columns);
        let minor = |a: usize, b: usize, i: usize, j: usize| {
            rows[a][i].clone() * &rows[b][j] - &(rows[a][j].clone() * &rows[b][i])
        };
        // Adjoint matrix over the determinant.
        let adjoint = |i: usize, k: usize| minor((k + 1) % 3, (k + 2) % 3, (i + 1) % 3, (i + 2) % 3);
        let added = |i: usize, of: &dyn Fn(usize) -> Real| {
            of(0) * &adjoint(i, 0) + &(of(1) * &adjoint(i, 1)) + &(of(2) * &adjoint(i, 2))
        };
        let whole = added(0, &|k| rows[k][0].clone());
        let one = Real::int(1, off[0].bits());
        let is_within = |q: Real| q.is_below(&one) && (-q).is_below(&one);
        (0..3).all(|i| added(i, &|k| off[k].clone()).over(&whole).is_some_and(is_within))
    }
}
