//! Three equations in three unknowns: Newton's iteration, and proofs of existence and uniqueness of a zero (Lemma V19).

use super::disc::most;
use super::saddle::Family;
use super::shot::{Range, Shot, Unknowns};
use crate::check::contact::Doubt;
use impact_pair_exact::Real;

/// Steps of Newton's iteration.
const STEPS: u32 = 12;

type Matrix = [[Real; 3]; 3];

/// The result of interval Newton for a box.
pub(super) enum Zeros {
    /// Exactly one zero, inside the box.
    One,
    /// At most one zero.
    AtMostOne,
    /// No zero.
    None,
    /// Nothing is proved.
    Open,
}

/// Approximate inverse of the middles; any matrix is sound.
fn inverse(rows: &Matrix) -> Option<Matrix> {
    let rows = rows.clone().map(|row| row.map(|x| x.middle()));
    let minor =
        |a: usize, b: usize, i: usize, j: usize| rows[a][i].clone() * &rows[b][j] - &(rows[a][j].clone() * &rows[b][i]);
    let adjoint = |i: usize, k: usize| minor((k + 1) % 3, (k + 2) % 3, (i + 1) % 3, (i + 2) % 3);
    let whole = (0..3).map(|i| rows[0][i].clone() * &adjoint(i, 0)).reduce(|sum, x| sum + &x)?.middle();
    let row = |i: usize| Some([adjoint(i, 0), adjoint(i, 1), adjoint(i, 2)].map(|x| x.over(&whole)));
    let unwrapped = |row: Option<[Option<Real>; 3]>| {
        let [a, b, c] = row?;
        Some([a?.middle(), b?.middle(), c?.middle()])
    };
    Some([unwrapped(row(0))?, unwrapped(row(1))?, unwrapped(row(2))?])
}

fn along(row: &[Real; 3], vector: &[Real; 3]) -> Real {
    (0..3).map(|k| row[k].clone() * &vector[k]).reduce(|sum, x| sum + &x).expect("three terms")
}

/// A point next to a zero, from a guess. Non-rigorous.
pub(super) fn polished(
    range: &mut Range<'_>,
    family: &Family,
    guess: &Unknowns,
    size: i64,
) -> Result<(Unknowns, Shot), Doubt> {
    let mut at = guess.clone().map(|x| x.at(family.bits()).middle());
    let mut before = None;
    for _ in 0..STEPS {
        let shot = range.shot(family, &at)?;
        let newton = inverse(&shot.slopes()).ok_or_else(|| Doubt::open("no tangency is found near the bounds"))?;
        let residual = shot.residual();
        let step = newton.map(|row| along(&row, &residual).middle());
        let top = step.iter().filter_map(|x| x.enclosure().mag().top()).max();
        // proposes: whether to go on
        let is_near = top.is_none_or(|top| top < size);
        if is_near {
            return Ok((at, shot));
        }
        if before.is_some_and(|before| top.is_some_and(|top| top > before + 8)) {
            break;
        }
        before = top;
        for (x, step) in at.iter_mut().zip(&step) {
            *x = (x.clone() - step).middle();
        }
    }
    Err(Doubt::open("no tangency is found near the bounds"))
}

/// Number of zeros of a box, from the shots at a point `at` of the box and over the whole box. Lemma V19
pub(super) fn zeros(box_: &Unknowns, (at, here): (&Unknowns, &Shot), over: &Shot) -> Zeros {
    let Some(newton) = inverse(&here.slopes()) else { return Zeros::Open };
    let (slopes, residual) = (over.slopes(), here.residual());
    let bits = box_[0].bits();
    if (0..3).any(|i| at[i].intersection(&box_[i]).is_none()) {
        return Zeros::Open;
    }
    let off = [0, 1, 2].map(|i| box_[i].clone() - &at[i]);
    let reach = off.each_ref().map(|x| Real::point(x.enclosure().wid(), bits));
    let (mut is_inside, mut is_contracted, mut is_apart) = (true, true, false);
    for (i, row) in newton.iter().enumerate() {
        let moved = along(row, &residual);
        let change = [0, 1, 2].map(|j| {
            let column = [0, 1, 2].map(|k| slopes[k][j].clone());
            let unit = Real::int(i64::from(i == j), bits);
            unit - &along(row, &column)
        });
        // One metric for all rows: each unknown in units of its radius.
        let rate = (0..3).map(|j| most(&change[j]) * &reach[j]).reduce(|sum, x| sum + &x).expect("three terms");
        is_contracted &= rate.is_below(&reach[i]);
        let image = at[i].clone() - &moved + &along(&change, &off);
        let [low, high] = box_[i].ends();
        is_inside &= low.is_below(&image) && image.is_below(&high);
        is_apart |= image.is_apart_from(&box_[i]);
    }
    match (is_apart, is_inside, is_contracted) {
        (true, ..) => Zeros::None,
        (_, true, true) => Zeros::One,
        (_, _, true) => Zeros::AtMostOne,
        _ => Zeros::Open,
    }
}
