//! An h-set in its own coordinates, as the square from -1 to 1: the strips of the words of a hyperbolic set, the leaves along which
//! images cross the h-set, and cones of expanding directions.

use impact_pair::Scene;
use impact_pair::chaos::{Chaos, Cone, Hyperbolic, State};
use plotters::style::RGBColor;

use super::leaf::{self, Leaf, VIEW_MARGIN};
use super::{OUTLINE_WIDTH, RIGHT_MARGIN, lines};
use crate::picture::{Axis, BLUE, Canvas, Drawn, Element, ORANGE, Path, Plane, SCALE, SKY, VERMILION, hex};

/// Colours of the strips, of the leaves and of the cones.
pub const COLOURS: [RGBColor; 3] = [SKY, BLUE, ORANGE];
/// Cones along the leaf of a word.
const CONES: usize = 9;
/// Greatest extent of a cone along the h-set and across it, in half sides of the h-set.
const CONE_SIZE: [f64; 2] = [0.1, 0.2];
/// Width of leaves.
pub const LEAF_WIDTH: i32 = SCALE;

/// Index of the h-set with the most cones.
fn shown(found: &Chaos, set: &Hyperbolic) -> usize {
    let cones = |base: usize| set.cones.iter().filter(|cone| found.words()[cone.word].to == base).count();
    (0..found.bases().len()).rev().max_by_key(|&base| cones(base)).unwrap_or(0)
}

/// Draws the h-set with the most cones.
pub fn draw(scene: &Scene, (found, set): (&Chaos, &Hyperbolic), area: &Canvas<'_>, root: &Canvas<'_>) -> Drawn {
    let base = shown(found, set);
    let names = ["along the h-set, in half lengths", "across it, in half widths"];
    let window = [-1.0 - VIEW_MARGIN, 1.0 + VIEW_MARGIN];
    let plane = Plane::draw(area, [0, 1].map(|_| Axis::over(window[0], window[1])), names, RIGHT_MARGIN)?;
    let own = Leaf::of(&found.bases()[base]);
    let word = |number: &usize| &found.words()[*number];
    let into: Vec<&usize> = set.words.iter().filter(|number| word(number).to == base).collect();
    let [strips, leaves, cones] = COLOURS;
    let from = set.words.iter().zip(&set.strips).filter(|(number, _)| word(number).from == base);
    let mut elements = filled(from.map(|(_, sides)| strip(*sides)), &plane, strips);
    let images = |number: &&usize| leaf::strips(scene, found, word(number), &own);
    elements += &lines(&into.iter().flat_map(images).collect::<Vec<_>>(), &plane, (leaves, LEAF_WIDTH));
    elements += &filled(into.iter().flat_map(|number| wedges(set, **number)), &plane, cones);
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
    elements += &lines(&[square.to_vec()], &plane, (VERMILION, OUTLINE_WIDTH));
    root.draw(&Element(plane.clipped(&elements)))?;
    Ok(())
}

/// The corners of a strip.
fn strip([left, right]: [[f64; 2]; 2]) -> Vec<State> {
    vec![[left[0], -1.0], [right[0], -1.0], [right[1], 1.0], [left[1], 1.0]]
}

/// Some cones at the images of a word's cells, spread along the h-set, each as two triangles.
fn wedges(set: &Hyperbolic, number: usize) -> Vec<Vec<State>> {
    let own: Vec<&Cone> = set.cones.iter().filter(|cone| cone.word == number).collect();
    let near = |at: f64| {
        own.iter().min_by(|a, b| (a.place[0] - at).abs().total_cmp(&(b.place[0] - at).abs())).map(|cone| wedge(cone))
    };
    (0..CONES).filter_map(|k| near(2.0 * (k as f64 + 0.5) / CONES as f64 - 1.0)).flatten().collect()
}

/// The two triangles of a cone: the states in the directions between its slopes.
fn wedge(Cone { place: [xi, eta], slopes, .. }: &Cone) -> [Vec<State>; 2] {
    let steep = slopes.iter().fold(0.0, |most: f64, slope| most.max(slope.abs()));
    let reach = CONE_SIZE[0].min(CONE_SIZE[1] / steep);
    [-reach, reach].map(|run| vec![[*xi, *eta], [xi + run, eta + run * slopes[0]], [xi + run, eta + run * slopes[1]]])
}

/// Areas as one element.
fn filled(areas: impl Iterator<Item = Vec<State>>, plane: &Plane, colour: RGBColor) -> String {
    let mut path = Path::default();
    for area in areas {
        let mut places = area.iter().chain(area.first()).map(|state| plane.place(*state));
        let Some(first) = places.next() else { continue };
        path.move_to(first);
        places.for_each(|place| path.line_to(place));
    }
    format!("<path fill=\"{}\" stroke=\"none\" d=\"{}\"/>\n", hex(colour), path.data())
}
