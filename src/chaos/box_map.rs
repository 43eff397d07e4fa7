//! Enclosures of the images of rectangles under the reduced impact map: Lemma D33 of `docs/proofs/chaos.md#D33`.

use std::collections::BTreeSet;

use super::law::{Law, Side};
use super::quad::Quad;
use super::refusal::Refusal;
use super::trap::{Arrivals, Grid};
use crate::Error;
use crate::pair::ImpactPair;

/// Bounds of phases, in forcing periods, and of speeds before the impact, over `A W`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Least and greatest phase.
    pub phase: [f64; 2],
    /// Least and greatest speed.
    pub speed: [f64; 2],
}

/// The image of a rectangle: bounds of the landings of its flights, by wall.
///
/// Phases begin in `[0, 1)` and may end beyond 1; those of a whole period are `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxImage {
    /// Landings on the wall that was left; `None` if there is none.
    pub near: Option<Rectangle>,
    /// Landings on the other wall.
    pub far: Option<Rectangle>,
    /// All landings.
    pub hull: Option<Rectangle>,
}

/// The reduced impact map on rectangles, for searches on grids.
///
/// **Enclosure**: the next impact of every motion with an impact in a rectangle is in its image, mirrored to the left wall. At a
/// graze both continuations are in it. Lemma D33
///
/// ```
/// use impact_pair::Scene;
/// use impact_pair::chaos::{BoxMap, Rectangle};
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
///     pair = { gap = "3*pi", restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = "-4*pi" }
/// "#)?;
/// // The motion of figure 12: phase 0 and speed 4 on each wall, mirrored to the left one.
/// let map = BoxMap::new(scene.pair(), 1 << 12)?;
/// let states = Rectangle { phase: [0.0, 0.001], speed: [3.999, 4.001] };
/// let image = map.image(&states).expect("a rectangle").expect("all flights land");
/// let far = image.far.expect("the other wall");
/// assert!(image.near.is_none() && far.speed[0] < 4.0 && far.speed[1] > 4.0);
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BoxMap {
    law: Law,
    grid: Grid,
}

/// The reason why the image of a rectangle is not bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unmapped {
    /// A ball may come to rest, or bounce too little to be distinguished from one that does.
    Rest,
    /// A flight may be longer than 64 forcing periods.
    Long,
}

/// Rectangles are rounded outward to multiples of `1/MESH`.
const MESH: f64 = 4_294_967_296.0;
/// The greatest phase and the greatest speed.
const MAX_COORDINATE: f64 = 1024.0;

impl BoxMap {
    /// Columns in a forcing period, a power of two.
    pub const COLUMNS: std::ops::RangeInclusive<i64> = 2..=1 << 20;

    /// The map of a pair; phases of landings are found in `columns` columns of a forcing period.
    ///
    /// # Errors
    /// With several harmonics, when a value is beyond the range of double-precision flights, and when `columns` is not a power of
    /// two in [`BoxMap::COLUMNS`].
    pub fn new(pair: &ImpactPair, columns: i64) -> Result<Self, Error> {
        // D33: columns are exact
        if !Self::COLUMNS.contains(&columns) || columns & (columns - 1) != 0 {
            let [least, most] = [Self::COLUMNS.start(), Self::COLUMNS.end()];
            let said = format!("columns is {columns}, but must be a power of two from {least} to {most}");
            return Err(Error::out_of_range("columns", said));
        }
        Ok(Self { law: Law::of(pair)?, grid: Grid { columns, rows: 1.0 } })
    }

    /// Encloses the landings of the flights from a rectangle, or gives the reason why they are not bounded. `None` for a
    /// rectangle whose ends are not in order, below 0 in speed, or beyond 1024.
    pub fn image(&self, states: &Rectangle) -> Option<Result<BoxImage, Unmapped>> {
        let Rectangle { phase, speed } = states;
        let in_order =
            |[low, high]: &[f64; 2]| low <= high && low.abs() <= MAX_COORDINATE && high.abs() <= MAX_COORDINATE; // D33: what is accepted
        if !in_order(phase) || !in_order(speed) || speed[0] < 0.0 {
            return None;
        }
        let mut landed: [Vec<Arrivals>; 2] = [Vec::new(), Vec::new()];
        let reached = self.grid.landings(&self.law, &outward([*phase, *speed]), &mut |arrivals| {
            landed[usize::from(arrivals.side == Side::Far)].push(arrivals);
        });
        Some(match reached {
            Err(Refusal::Rest) => Err(Unmapped::Rest),
            Err(Refusal::Long) => Err(Unmapped::Long),
            Ok(_) => {
                let [near, far] = landed.each_ref().map(|some| self.around(some.iter()));
                Ok(BoxImage { near, far, hull: self.around(landed.iter().flatten()) })
            }
        })
    }

    /// The rectangle around landings: the complement of the widest gap between their columns. Lemma D33
    fn around<'a>(&self, landed: impl Iterator<Item = &'a Arrivals> + Clone) -> Option<Rectangle> {
        let count = self.grid.columns;
        let shift = |side: Side| if side == Side::Far { count / 2 } else { 0 };
        let columns = landed.clone().map(|arrivals| (arrivals.column + shift(arrivals.side)).rem_euclid(count));
        let columns: Vec<i64> = columns.collect::<BTreeSet<_>>().into_iter().collect();
        let first = *columns.first()?;
        let next = columns.iter().skip(1).copied().chain([first + count]);
        let gaps = columns.iter().zip(next).map(|(&column, next)| (next - column, next));
        let (gap, begin) = gaps.max().filter(|&(gap, _)| gap > 1).unwrap_or((1, count)); // D33: any gap will do
        let low = begin.rem_euclid(count);
        let ends = [low, low + count + 1 - gap].map(|column| column as f64 / count as f64); // exact: a power of two
        let outer = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.min(c), b.max(d)]; // D33: the outer ends
        let speed = landed.map(|arrivals| arrivals.speeds).reduce(outer)?;
        Some(Rectangle { phase: ends, speed })
    }
}

/// The least rectangle with ends in the mesh that holds one. Lemma D33
fn outward(ends: [[f64; 2]; 2]) -> Quad {
    let ends = ends.map(|[low, high]| [(low * MESH).floor() / MESH, (high * MESH).ceil() / MESH]); // D33: outward
    let centre = ends.map(|[low, high]| 0.5 * (low + high)); // D33: exact
    let radii = ends.map(|[low, high]| 0.5 * (high - low)); // D33: exact
    Quad::rectangle(centre, radii, ends[1][0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(columns: i64) -> Result<BoxMap, Error> {
        BoxMap::new(&crate::tests::pair_of(&[["2.3", "5", "0.4"]], "7.1", "0.63"), columns)
    }

    /// Bounds of phase of the rectangle around landings in these columns of eight, all on the near wall.
    fn around(columns: &[i64]) -> [f64; 2] {
        let map = map(8).unwrap();
        let landed = columns.iter().map(|&column| Arrivals { column, side: Side::Near, speeds: [1.0, 2.0] });
        let landed: Vec<Arrivals> = landed.collect();
        map.around(landed.iter()).unwrap().phase
    }

    #[test]
    fn the_arc_around_columns_is_the_shorter_one() {
        assert_eq!(around(&[3]), [0.375, 0.5]);
        assert_eq!(around(&[7, 8]), [0.875, 1.125]);
        assert_eq!(around(&[1, 2, 4]), [0.125, 0.625]);
        assert_eq!(around(&[-1, 17]), [0.875, 1.25]);
        assert_eq!(around(&(0..8).collect::<Vec<_>>()), [0.0, 1.0]);
    }

    #[test]
    fn rectangles_are_rounded_outward() {
        let quad = outward([[0.1, 0.3], [0.7, 0.7]]);
        for (i, [low, high]) in [[0.1, 0.3], [0.7, 0.7]].into_iter().enumerate() {
            assert!(quad.centre[i] - quad.sides[i][i] < low && high < quad.centre[i] + quad.sides[i][i]);
            assert!(quad.sides[i][i] <= 0.5 * (high - low) + 1.0 / MESH);
        }
        assert!(quad.floor < 0.7);
    }

    #[test]
    fn an_invalid_rectangle_has_no_image() {
        let map = map(1 << 10).unwrap();
        for (phase, speed) in [([0.2, 0.1], [1.0, 2.0]), ([0.0, 0.1], [-0.1, 2.0]), ([0.0, f64::NAN], [1.0, 2.0])] {
            assert!(map.image(&Rectangle { phase, speed }).is_none());
        }
        assert_eq!(map.image(&Rectangle { phase: [0.6, 0.7], speed: [0.0, 0.1] }), Some(Err(Unmapped::Rest)));
        assert!(self::map(1000).unwrap_err().to_string().contains("power of two"));
    }
}
