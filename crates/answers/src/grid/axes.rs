//! The points of a sweep: exact values of one or two keys of a scene.

use impact_pair::Error;
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::json::SweepAxis;
use impact_pair::scene::{Key, Over, Range};

/// Greatest number of points of a grid.
pub const MOST_POINTS: u64 = 100_000_000;

/// Reads an axis: `KEY=LO..HI:COUNT`, evenly spread exact values of a key, endpoints included.
///
/// # Errors
/// If the text is no range with a number of values, 2 or more.
///
/// ```
/// let axis = impact_pair_answers::grid::axis("amplitude=0..1:4")?;
/// assert_eq!(axis.to_string(), "amplitude=0..1:4");
/// assert!(impact_pair_answers::grid::axis("amplitude=0..1").is_err());
/// # Ok::<(), impact_pair::Error>(())
/// ```
pub fn axis(text: &str) -> Result<Over, Error> {
    Over::parse(text, ACCEPTED_FORM, is_axis)
}

const ACCEPTED_FORM: &str = "KEY=LO..HI:COUNT with single numbers LO < HI and COUNT from 2 on";

fn is_axis(range: &Range) -> bool {
    range.count().is_some_and(|count| (2..=MOST_POINTS).contains(&count))
}

/// One axis, or two: then the values of the second one vary faster.
#[derive(Clone, Debug)]
pub struct Grid {
    axes: Vec<Range>,
}

impl Grid {
    /// The grid of these axes.
    ///
    /// # Errors
    /// If there are no axes or more than two, if two set the same key, or if there are more than [`MOST_POINTS`] points.
    pub fn new(axes: Vec<Range>) -> Result<Self, Error> {
        if let Some(range) = axes.iter().find(|range| !is_axis(range)) {
            return Err(refused(&range.to_string(), ACCEPTED_FORM));
        }
        let text = || axes.iter().map(Range::to_string).collect::<Vec<_>>().join(" ");
        let points = axes.iter().try_fold(1u64, |product, axis| product.checked_mul(axis.points()));
        match &axes[..] {
            [] | [_, _, _, ..] => return Err(refused(&text(), "one axis, or two")),
            [a, b] if a.key().is_one_with(b.key()) => {
                return Err(refused(&text(), "two axes with different keys"));
            }
            _ => {}
        }
        if points.is_none_or(|points| points > MOST_POINTS) {
            return Err(refused(&text(), &format!("at most {MOST_POINTS} points")));
        }
        Ok(Self { axes })
    }

    /// The axes.
    pub fn axes(&self) -> &[Range] {
        &self.axes
    }

    /// Number of points.
    pub fn points(&self) -> u64 {
        self.axes.iter().map(Range::points).product()
    }

    /// Points at the ends of all axes.
    ///
    /// If these are valid scenes, all points are. The values that a key accepts are an interval, and those that two keys accept together, as `|y|
    /// < d/2`, a convex set.
    pub fn corners(&self) -> Vec<u64> {
        match &self.axes[..] {
            [slow, fast] => {
                let (slow, fast) = (slow.points(), fast.points());
                vec![0, fast - 1, (slow - 1) * fast, slow * fast - 1]
            }
            _ => vec![0, self.points() - 1],
        }
    }

    /// Positions of a point on each axis, counted from 0.
    pub fn places(&self, point: u64) -> Vec<u64> {
        match &self.axes[..] {
            [slow, fast] => vec![(point / fast.points()) % slow.points(), point % fast.points()],
            _ => vec![point],
        }
    }

    /// Number, from 0, of the term whose period is the unit of the sweep of a scene: the same for all its points. `None` where the excitation has
    /// a single term.
    ///
    /// This term is the fastest of those that move the box where all axes are at their upper ends, so it may be a term whose amplitude varies
    /// from 0. Phases `W t + tau` and forcing periods refer to this term at every point, also where another term is faster, or where this term
    /// does not move the box.
    ///
    /// # Errors
    /// If an upper end is not a valid value for the scene.
    ///
    /// ```
    /// use impact_pair::Scene;
    /// use impact_pair_answers::grid::Grid;
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = [1, 0], frequency = [2, 3], phase = 0 }
    ///     pair = { gap = 4, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -1 }
    /// "#)?;
    /// let reference = |axis: &str| Grid::new(vec![axis.parse()?])?.reference(&scene);
    /// assert_eq!((reference("amplitude.2=0..1:3")?, reference("amplitude.1=0..1:3")?), (Some(1), Some(0)));
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    pub fn reference(&self, scene: &Scene) -> Result<Option<usize>, Error> {
        let mut pair = scene.pair().clone();
        for axis in self.axes.iter().filter(|axis| axis.key() < Key::StartTime) {
            pair = pair.with(axis.key(), axis.high().clone())?;
        }
        let excitation = pair.excitation();
        Ok((excitation.terms().len() > 1).then(|| excitation.reference_term()))
    }

    /// Scene of a point: with these values instead of its own, `start.phase` being that of the sweep's [reference](Self::reference).
    ///
    /// # Errors
    /// As of [`Scene::with`].
    pub fn scene(&self, scene: &Scene, values: &[(Key, Exact)]) -> Result<Scene, Error> {
        let reference = self.reference(scene)?;
        let (phases, others): (Vec<_>, Vec<_>) = values.iter().cloned().partition(|(key, _)| *key == Key::StartPhase);
        let varied = scene.with(&others)?;
        let (Some(term), [(_, phase)]) = (reference, &phases[..]) else { return scene.with(values) };
        let time = varied.pair().excitation().terms()[term].time_at(phase);
        let time = time.map_err(|error| refused(&format!("start.phase={phase}"), &error.to_string()).because(error))?;
        varied.with(&[(Key::StartTime, time)])
    }

    /// Values of a point, one per axis.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions.
    pub fn values(&self, point: u64) -> Result<Vec<(Key, Exact)>, Error> {
        let value = |(axis, place): (&Range, u64)| {
            let value = axis
                .value(place, axis.points() - 1)
                .map_err(|error| refused(&axis.to_string(), &error.to_string()).because(error))?;
            Ok((axis.key(), value))
        };
        self.axes.iter().zip(self.places(point)).map(value).collect()
    }
}

/// An axis in the form of heads.
pub(crate) fn written(axis: &Range) -> SweepAxis {
    SweepAxis { key: axis.key().to_string(), from: axis.low().text(), to: axis.high().text(), count: axis.points() }
}

/// Axes of a head.
///
/// # Errors
/// If one of the written axes is not valid.
pub(crate) fn axes(written: &[SweepAxis]) -> Result<Vec<Range>, Error> {
    let axis_of = |over: &SweepAxis| {
        let text = format!("{}={}..{}:{}", over.key, over.from, over.to, over.count);
        Range::parse(&text, ACCEPTED_FORM, is_axis)
    };
    written.iter().map(axis_of).collect()
}

fn refused(text: &str, accepted: &str) -> Error {
    Error::out_of_range(None, format!("the grid is \"{text}\", but accepted is {accepted}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(axes: &[&str]) -> Result<Grid, Error> {
        Grid::new(axes.iter().map(|axis| axis.parse()).collect::<Result<_, _>>()?)
    }

    #[test]
    fn points_are_exact() {
        let grid = grid(&["start.phase=-pi..pi:3", "pair.gap=0.1..0.4:4"]).unwrap();
        assert_eq!(grid.points(), 12);
        let texts = |point| grid.values(point).unwrap().iter().map(|(_, x)| x.text()).collect::<Vec<_>>();
        assert_eq!(texts(0), ["-pi", "0.1"]);
        assert_eq!(texts(6), ["0", "0.3"]);
        assert_eq!(texts(11), ["pi", "0.4"]);
    }

    #[test]
    fn a_key_without_a_grid_is_refused() {
        let twice = ["gap=1..2:3", "pair.gap=1..2:3"];
        let times = ["start.time=1..2:3", "start.phase=1..2:3"];
        let large = ["gap=1..2:100000", "amplitude=1..2:100000"];
        for axes in [&["gap=1..2"][..], &["gap=1..2:1"], &["gap=2..1:5"], &["gap=[1,2]..3:5"], &["gap=1..x:5"], &[]] {
            assert!(grid(axes).unwrap_err().to_string().contains("but accepted is"), "{axes:?}");
        }
        let terms = ["phase=1..2:3", "phase.2=1..2:3"];
        for axes in [&twice, &times, &terms, &large] {
            assert!(grid(axes).is_err(), "{axes:?}");
        }
        assert!(grid(&["mass=1..2:5"]).unwrap_err().to_string().contains("the key is \"mass\""));
    }
}
