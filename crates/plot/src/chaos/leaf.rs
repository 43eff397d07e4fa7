//! The h-sets of a horseshoe in the coordinates along and across the leaf of one h-set: this h-set is the square from -1
//! to 1, and the others lie above and below it.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use impact_pair::Scene;
use impact_pair::chaos::{Chaos, HSet, State, Word};
use impact_pair::exact::Exact;
use impact_pair::orbit::{Arithmetic, Impact, Orbit, Settings, Start};
use impact_pair::pair::{ImpactPair, Wall};
use impact_pair::units::Units;
use plotters::style::RGBColor;

use super::{OUTLINE_WIDTH, RIGHT_MARGIN, dots, lines, round, seen};
use crate::picture::{Axis, BLUE, Canvas, Drawn, Element, GREEN, Plane, SCALE, VERMILION};
use crate::sweep::value;

/// Width of the margin shown around the h-sets, in half sides of an h-set.
pub const VIEW_MARGIN: f64 = 0.3;
/// H-sets farther away across the leaf are not shown.
const MAX_OFFSET: f64 = 12.0;
/// States of an h-set's middle line that are followed.
const SAMPLES: usize = 2000;
/// Neighbouring states whose images are farther apart than this have a graze between them.
const GRAZE_DISTANCE: f64 = 0.3;
/// Colours of the images by both words, and their width.
pub const COLOURS: [RGBColor; 2] = [BLUE, GREEN];
pub const STRIP_WIDTH: i32 = 3 * SCALE;

/// The coordinates of an h-set, exact for a parallelogram.
pub struct Leaf {
    centre: State,
    along: State,
    across: State,
}

impl Leaf {
    /// The coordinates of an h-set.
    pub fn of(base: &HSet) -> Self {
        let [a, b, c, d, _] = round(base);
        let of = |signs: [f64; 4]| {
            [0, 1].map(|i| 0.25 * (signs[0] * a[i] + signs[1] * b[i] + signs[2] * c[i] + signs[3] * d[i]))
        };
        Self { centre: of([1.0; 4]), along: of([-1.0, 1.0, 1.0, -1.0]), across: of([-1.0, -1.0, 1.0, 1.0]) }
    }

    /// A state in the coordinates of the h-set (along the leaf, across it), with its phase modulo whole forcing periods.
    fn place(&self, state: &State) -> State {
        let (phase, w) = (state[0] - self.centre[0], state[1] - self.centre[1]);
        let u = phase - phase.round();
        let ([a, b], [c, d]) = (self.along, self.across);
        let area = a * d - b * c;
        [(u * d - w * c) / area, (a * w - b * u) / area]
    }

    /// States of the h-set's middle line, from its left to its right edge.
    fn middle(&self) -> impl Iterator<Item = State> + '_ {
        (0..SAMPLES).map(|k| {
            let part = 2.0 * (k as f64 + 0.5) / SAMPLES as f64 - 1.0;
            [0, 1].map(|i| self.centre[i] + part * self.along[i])
        })
    }
}

/// For each of the horseshoe's two words, its instances between h-sets; h-sets from which only one word leads are left out.
pub fn words(found: &Chaos) -> [Vec<&Word>; 2] {
    let Some(names) = found.horseshoe() else { return [const { Vec::new() }; 2] };
    let named = |name: &Word| found.words().iter().filter(|word| word.is_same_block(name)).collect::<Vec<_>>();
    let [first, second] = names.map(named);
    let both = |word: &&&Word| [&first, &second].iter().all(|words| words.iter().any(|other| other.from == word.from));
    [first.iter().filter(both).copied().collect(), second.iter().filter(both).copied().collect()]
}

/// Draws the h-sets with their images that lie across them, in coordinates of the first h-set of the horseshoe.
pub fn draw(scene: &Scene, found: &Chaos, area: &Canvas<'_>, root: &Canvas<'_>) -> Drawn {
    let both = words(found);
    let concerned: BTreeSet<usize> = both.iter().flatten().flat_map(|word| [word.from, word.to]).collect();
    let first = concerned.first().copied().unwrap_or(0);
    let leaf = Leaf::of(&found.bases()[first]);
    let outlines: Vec<Vec<State>> =
        found.bases().iter().map(|base| round(base).iter().map(|corner| leaf.place(corner)).collect()).collect();
    let near = |outline: &&Vec<State>| outline.iter().all(|at| at[0].abs() < MAX_OFFSET && at[1].abs() < MAX_OFFSET);
    let ends = |axis: usize| {
        let shown = outlines.iter().filter(near).flatten().map(|at| at[axis]);
        shown.fold([-1.0, 1.0], |[low, high]: [f64; 2], at| [low.min(at), high.max(at)])
    };
    let window = [0, 1].map(ends).map(|[low, high]| [low - VIEW_MARGIN, high + VIEW_MARGIN]);
    let names = ["along the leaf, in half lengths of the h-set", "across the leaf, in half widths of the h-set"];
    let plane = Plane::draw(area, window.map(|[low, high]| Axis::over(low, high)), names, RIGHT_MARGIN)?;
    let is_shown = |at: &State| (0..2).all(|i| (window[i][0]..=window[i][1]).contains(&at[i]));
    let states = seen(found).map(|state| leaf.place(state)).filter(is_shown).collect();
    root.draw(&dots(states, &plane))?;
    let mut elements = String::new();
    for (words, colour) in both.iter().zip(COLOURS) {
        let strips: Vec<Vec<State>> = words.iter().flat_map(|word| strips(scene, found, word, &leaf)).collect();
        elements += &lines(&strips, &plane, (colour, STRIP_WIDTH));
    }
    elements += &lines(&outlines, &plane, (VERMILION, OUTLINE_WIDTH));
    root.draw(&Element(plane.clipped(&elements)))?;
    Ok(())
}

/// The image of an h-set's middle line under a word, where it lies across the other h-set: of certified impacts.
pub fn strips(scene: &Scene, found: &Chaos, word: &Word, shown: &Leaf) -> Vec<Vec<State>> {
    let [from, to] = [word.from, word.to].map(|number| Leaf::of(&found.bases()[number]));
    let images = from.middle().map(|state| image(scene.pair(), state, &word.walls));
    let is_across = |image: &State| {
        let [along, across] = to.place(image);
        along.abs() <= 1.0 + VIEW_MARGIN && across.abs() <= 1.0
    };
    let mut strips: Vec<Vec<State>> = vec![Vec::new()];
    for image in images {
        let place = image.filter(is_across).map(|image| shown.place(&image));
        let is_next = |last: &State| place.is_some_and(|place| (place[0] - last[0]).abs() < GRAZE_DISTANCE);
        if strips.last().and_then(|strip| strip.last()).is_some_and(|last| !is_next(last)) {
            strips.push(Vec::new());
        }
        if let (Some(place), Some(strip)) = (place, strips.last_mut()) {
            strip.push(place);
        }
    }
    strips
}

/// The state after impacts on these walls; `None` if the walls differ, or if doubles do not certify the orbit.
fn image(pair: &ImpactPair, [phase, speed]: State, walls: &[Wall]) -> Option<State> {
    let harmonic = pair.excitation().only()?;
    let (gaps, amplitudes) = (Units::gaps(pair).ok()?.map(value), Units::amplitudes(harmonic).ok()?.map(value));
    let time = harmonic.time_at(&Exact::try_from(TAU * phase).ok()?).ok()?;
    let velocity = Exact::try_from(-speed * amplitudes.velocity).ok()?;
    let start = Start::on_wall(time, Wall::Left, velocity).ok()?;
    let settings =
        Settings { impacts: Some(walls.len() as u64), arithmetic: Arithmetic::Interval, ..Settings::default() };
    let impacts: Vec<Impact> = Orbit::new(pair, &start, settings).ok()?.collect();
    let last = impacts.last().filter(|_| impacts.iter().map(|impact| impact.wall).eq(walls.iter().copied()))?;
    // Mirrored to the left wall.
    let mirrored = if last.wall == Wall::Right { 0.5 } else { 0.0 };
    Some([last.phase.mid() + mirrored, last.velocity.mid().abs() * gaps.velocity / amplitudes.velocity])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_h_set_is_the_unit_square_in_its_coordinates() {
        let leaf = Leaf::of(&HSet::new([0.9, 1.2], [0.03, 0.08], [-0.0002, 0.001]));
        let near = |at: State, place: State| (0..2).all(|i| (leaf.place(&at)[i] - place[i]).abs() < 1e-9);
        assert!(near([0.9, 1.2], [0.0, 0.0]) && near([0.93, 1.28], [1.0, 0.0]) && near([0.8998, 1.201], [0.0, 1.0]));
        // A forcing period later.
        assert!(near([1.8702, 1.119], [-1.0, -1.0]));
    }

    /// A start of equations (66), (67) is mapped to itself, and so is the mirror image of the impact on the other wall.
    #[test]
    fn the_state_of_an_equispaced_motion_is_its_own_image() {
        let scene = Scene::parse(
            "excitation = { amplitude = 1, frequency = \"pi\", phase = 0 }\npair = { gap = \"3*pi\", restitution = 0.5 }\n\
             start = { time = 0, wall = \"left\", velocity = \"-4*pi\" }",
        )
        .unwrap();
        let (left, right) = (Wall::Left, Wall::Right);
        for walls in [&[right][..], &[right, left], &[right, left, right]] {
            let [phase, speed] = image(scene.pair(), [0.0, 4.0], walls).unwrap();
            assert!((phase - phase.round()).abs() < 1e-9 && (speed - 4.0).abs() < 1e-9, "{phase} {speed}");
        }
        assert_eq!(image(scene.pair(), [0.0, 4.0], &[left]), None);
    }
}
