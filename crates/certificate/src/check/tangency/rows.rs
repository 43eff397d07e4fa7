//! The ends of an orbit from one manifold to the other, and the derivatives of its equations (Lemma V31).

use super::area::{BITS, OTHER, PARAMETER, STABLE, STATES, UNSTABLE, Vector};
use super::shot;
use crate::check::contact::Doubt;
use crate::check::legs::{Legs, Rows, product};
use impact_pair_exact::Real;

/// An end of the orbit on its manifold.
pub(super) struct End {
    /// The state at the centre, and the derivative by `sigma` there.
    pub at: Vector,
    pub tangent: Vector,
    /// Encloses all states.
    pub states: Vector,
    /// The derivatives by `sigma`, parameter and other datum.
    pub slopes: Rows<3>,
    /// Derivatives of the derivative by `sigma` by the same coordinates.
    pub bends: Rows<3>,
    /// The speeds and the durations of all flights between the end and the saddle.
    pub near: Vector,
}

/// The derivatives of one equation, each with the index of its value.
pub(super) type Row = Vec<(usize, Real)>;

/// The derivatives of the equations of the flights.
pub(super) fn of_flights(legs: &Legs<2, 2>, (first, last): (&End, &End), count: usize) -> Vec<Row> {
    let mut rows = Vec::new();
    for k in 0..count {
        let (by_state, by_data) = legs.of_flight(k);
        let from_first = product(&by_state, &first.slopes);
        for i in 0..2 {
            let mut data = [0, 1].map(|j| by_data[i][j].clone());
            let mut row = Vec::new();
            let place = STATES + 2 * k;
            if k == 0 {
                row.push((UNSTABLE, from_first[i][0].clone()));
                data = [0, 1].map(|j| data[j].clone() + &from_first[i][1 + j]);
            } else {
                row.extend([0, 1].map(|j| (place - 2 + j, by_state[i][j].clone())));
            }
            if k + 1 == count {
                row.push((STABLE, -&last.slopes[i][0]));
                data = [0, 1].map(|j| data[j].clone() - &last.slopes[i][1 + j]);
            } else {
                row.push((place + i, Real::int(-1, BITS)));
            }
            let [parameter, other] = data;
            row.extend([(PARAMETER, parameter), (OTHER, other)]);
            rows.push(row);
        }
    }
    rows
}

/// The derivatives of the determinant of both tangents, and `q` and `m`.
pub(super) fn of_tangents(
    legs: &Legs<2, 2>,
    (first, last): (&End, &End),
    count: usize,
) -> Result<(Row, [Real; 2]), Doubt> {
    let to_the_end = legs.to_the_end();
    let tangents: Vec<Vector> = (0..=count).map(|k| column(&legs.slopes(k), 0)).collect();
    // The change of the last tangent with a coordinate of flight `k`.
    let bent = |k: usize, a: usize| image(&to_the_end[k + 1], &image(&legs.bends(k)[a], &tangents[k]));
    let (end, tangent) = (column(&last.slopes, 0), &tangents[count]);
    let of_first = |j: usize| {
        let moved = column(&first.slopes, j);
        let bend = image(&to_the_end[0], &column(&first.bends, j));
        (0..2).fold(bend, |all, a| sum(&all, &scaled(&bent(0, a), &moved[a])))
    };
    let of_data = |j: usize| (0..count).fold(of_first(j), |all, k| sum(&all, &bent(k, 1 + j)));
    let by_data = |j: usize| determinant(&of_data(j), &end) + &determinant(tangent, &column(&last.bends, j));
    let mut row = vec![
        (UNSTABLE, determinant(&of_first(0), &end)),
        (STABLE, determinant(tangent, &column(&last.bends, 0))),
        (PARAMETER, by_data(1)),
        (OTHER, by_data(2)),
    ];
    let states = (1..count).flat_map(|k| [0, 1].map(|a| (k, a)));
    row.extend(states.map(|(k, a)| (STATES + 2 * (k - 1) + a, determinant(&bent(k, a), &end))));
    let curved = (0..count).flat_map(|k| [0, 1].map(|a| scaled(&bent(k, a), &tangents[k][a])));
    let curved = curved.fold(image(&to_the_end[0], &column(&first.bends, 0)), |all, x| sum(&all, &x));
    let moved = column(&legs.slopes(count), 1);
    let unfolding =
        shot::unfolding([tangent, &end], [&curved, &column(&last.bends, 0)], [&moved, &column(&last.slopes, 1)]);
    Ok((row, unfolding.ok_or_else(|| Doubt::open("the tangent of the stable manifold may be 0"))?))
}

pub(super) fn determinant(a: &Vector, b: &Vector) -> Real {
    a[0].clone() * &b[1] - &(a[1].clone() * &b[0])
}

pub(super) fn image(matrix: &Rows<2>, vector: &Vector) -> Vector {
    matrix.each_ref().map(|row| row[0].clone() * &vector[0] + &(row[1].clone() * &vector[1]))
}

pub(super) fn sum(a: &Vector, b: &Vector) -> Vector {
    [0, 1].map(|i| a[i].clone() + &b[i])
}

pub(super) fn scaled(a: &Vector, by: &Real) -> Vector {
    a.each_ref().map(|x| x.clone() * by)
}

pub(super) fn column<const N: usize>(rows: &Rows<N>, j: usize) -> Vector {
    rows.each_ref().map(|row| row[j].clone())
}
