//! Sets of states as parallelograms along the expansion: they grow as the motion stretches them, not as boxes do (Lemma V2, axes).

use super::affine::{Affine, COLUMN_BITS};
use super::step::Landing;
use impact_pair_exact::{Dyadic, Real};

/// A vector of phase and velocity.
type Vector = [Real; 2];

/// Bits of the sides of a set: their products with doubles are exact in `COLUMN_BITS` bits.
const SIDE_BITS: u32 = 32;

impl Landing {
    /// A superset without error, with two deviations of its own from `first` on, after those of the data: the first one is along the longer
    /// of its own columns, the second one across that column.
    pub fn aligned(self, first: usize) -> Self {
        let Self { wall, phase, velocity, angles } = self;
        let [phase, velocity] = [phase, velocity].map(|x| x.with_exact_columns(first));
        let states = [&phase, &velocity];
        let columns = [0, 1].map(|j| states.map(|x| x.column(first + j)));
        let errors = states.map(Affine::spread);
        let along = direction(&columns);
        let across = [-&along[1], along[0].clone()];
        let square = product(&along, &along);
        let side = |axis: &Vector| {
            let size = |x: &Vector| Real::point(product(axis, x).enclosure().mag(), COLUMN_BITS);
            let reach = size(&columns[0]) + &size(&columns[1]) + &size(&errors);
            let side = reach.over(&square)?.rounded(SIDE_BITS);
            Some(Real::point(side.enclosure().sup().clone(), COLUMN_BITS))
        };
        let (Some(long), Some(wide)) = (side(&along), side(&across)) else {
            return Self { wall, phase, velocity, angles };
        };
        let own = |x: Affine, i: usize| x.with_own(first, [&along[i] * &long, &across[i] * &wide]);
        Self { wall, phase: own(phase, 0), velocity: own(velocity, 1), angles }
    }
}

fn product(x: &Vector, y: &Vector) -> Real {
    &x[0] * &y[0] + &(&x[1] * &y[1])
}

/// Direction of the longer column, in doubles; that of the phase where there are no columns.
fn direction(columns: &[Vector; 2]) -> Vector {
    // proposes: any direction is sound
    let top = |column: &Vector| column.iter().filter_map(|x| x.enclosure().mag().top()).max();
    let longer = if top(&columns[1]) > top(&columns[0]) { &columns[1] } else { &columns[0] };
    let point = |x: f64| Real::point(Dyadic::from_f64(x).unwrap_or_else(Dyadic::zero), COLUMN_BITS); // proposes
    match top(longer) {
        Some(top) => longer.each_ref().map(|x| point(x.mid().scaled(-top).to_f64_down())),
        None => [1.0, 0.0].map(point),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_pair_model::Wall;
    use proptest::prelude::*;

    fn real(x: f64) -> Real {
        Real::point(Dyadic::from_f64(x).unwrap(), 192)
    }

    proptest! {
        /// Corners of a parallelogram with errors have coordinates of at most 1 in the aligned set, by Cramer's rule in fractions.
        #[test]
        fn an_aligned_set_holds_the_corners(
            m in prop::array::uniform4(-1e3..1e3f64), scale in prop::array::uniform2(-300..0i32), error in prop::array::uniform2(0.0..1.0f64),
            is_flat: bool, is_box: bool
        ) {
            let [a, b, c, d] = m;
            let [b, d] = if is_flat { [2.0 * a, 2.0 * c] } else { [b, d] };
            let [first, second] = scale.map(|n| 2f64.powi(n));
            let rows = if is_box { [[0.0; 2]; 2] } else { [[a * first, b * second], [c * first, d * second]] };
            let errors = error.map(|x| x * second);
            let state = |i: usize| {
                Affine::spanned(Real::within(&Dyadic::from_f64(errors[i]).unwrap(), 192), 0, rows[i].map(real)).recentred()
            };
            let set = Landing::new(Wall::Left, state(0), state(1)).aligned(0);
            let exact = |x: f64| Dyadic::from_f64(x).unwrap().to_rational();
            let column = |x: &Affine, j| { let x = x.column(j); assert!(x.wid().is_zero()); x.mid().to_rational() };
            let [u, s] = [0, 1].map(|j| [&set.phase, &set.velocity].map(|x| column(x, j)));
            for signs in 0..16u32 {
                let sign = |n: u32| if signs >> n & 1 == 1 { exact(1.0) } else { exact(-1.0) };
                let at = |i: usize| exact(rows[i][0]) * sign(0) + exact(rows[i][1]) * sign(1) + exact(errors[i]) * sign(2 + i as u32);
                let x = [at(0), at(1)];
                let across = |p: &[_; 2], q: &[_; 2]| &p[0] * &q[1] - &p[1] * &q[0];
                let determinant = across(&u, &s);
                let size = |x: num_rational::BigRational| if x < exact(0.0) { -x } else { x };
                prop_assert!(size(across(&x, &s)) <= size(determinant.clone()) && size(across(&u, &x)) <= size(determinant));
            }
        }

        /// Members that depend on a datum, in a column that is known up to an error, have coordinates of at most 1 in the aligned set, too.
        #[test]
        fn columns_of_the_data_stay(
            m in prop::array::uniform4(-1e3..1e3f64), datum in prop::array::uniform2(-1e3..1e3f64), wide in prop::array::uniform2(0.0..1.0f64),
            signs in prop::array::uniform5(-1.0..=1.0f64)
        ) {
            let within = |x: f64, r: f64| (real(x) + &Real::within(&Dyadic::from_f64(r).unwrap(), 192)).at(COLUMN_BITS);
            let exact = |x: f64| Dyadic::from_f64(x).unwrap().to_rational();
            let state = |i: usize| {
                let own = Affine::spanned(real(0.0), 1, [real(m[2 * i]), real(m[2 * i + 1])]);
                let of_datum = Affine::varied(real(0.0), Dyadic::power_of_two(0), 0);
                Affine::of(real(0.0), &[(&within(datum[i], wide[i]), &of_datum), (&real(1.0), &own)])
            };
            let set = Landing::new(Wall::Left, state(0), state(1)).aligned(1);
            let column = |x: &Affine, j| { let x = x.column(j); assert!(x.wid().is_zero()); x.mid().to_rational() };
            let [d, u, s] = [0, 1, 2].map(|j| [&set.phase, &set.velocity].map(|x| column(x, j)));
            let at = |i: usize| {
                let member = exact(datum[i]) + exact(wide[i]) * exact(signs[i]);
                (member - &d[i]) * exact(signs[2]) + exact(m[2 * i]) * exact(signs[3]) + exact(m[2 * i + 1]) * exact(signs[4])
            };
            let x = [at(0), at(1)];
            let across = |p: &[_; 2], q: &[_; 2]| &p[0] * &q[1] - &p[1] * &q[0];
            let determinant = across(&u, &s);
            let size = |x: num_rational::BigRational| if x < exact(0.0) { -x } else { x };
            prop_assert!(size(across(&x, &s)) <= size(determinant.clone()) && size(across(&u, &x)) <= size(determinant));
        }
    }
}
