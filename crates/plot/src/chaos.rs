//! Trapping regions and horseshoes in the reduced state space, as SVG.

mod cones;
mod leaf;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{Chaos, HSet, Hyperbolic, State, Trap, seen_impacts};
use impact_pair::json::counted;
use impact_pair::scene::Range;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::picture::{
    self, Arc, Axis, Canvas, Dots, Drawn, Element, FONT, LegendSymbol, Look, Path, Plane, SCALE, SKY,
};
use crate::picture::{VERMILION, greek, hex, legend, program, typeset_text, words};
use crate::sweep::Cells;

/// Size of a single panel, and of each of several panels side by side \[pixels\].
const SINGLE_PANEL_SIZE: (u32, u32) = (900, 640);
const PANEL_SIZE: (u32, u32) = (560, 640);
/// Impacts shown of a floating-point orbit, and impacts skipped before those of an orbit in a region.
const IMPACTS: usize = 20_000;
const TRANSIENT: usize = 2000;
/// Greatest number of impacts of the images that are shown.
const MAX_IMAGES: usize = 3;
/// Widths of lines.
const IMAGE_WIDTH: i32 = 6 * SCALE;
const OUTLINE_WIDTH: i32 = 3 * SCALE / 2;
/// Room on the right of axes.
const RIGHT_MARGIN: i32 = 30 * SCALE;
pub(crate) const PHASE_LABEL: &str = "phase $θ$ of the impact, mirrored to the left wall [rad]";
const SPEED_LABEL: &str = "speed before the impact, in $AΩ$";

/// The boxes of a region, and a floating-point orbit.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
pub fn trap(scene: &Scene, region: &Trap, look: &Look) -> Result<String> {
    let (columns, rows) = region.grid();
    let arc = Arc::holding(phases(region));
    let states = seen_impacts(scene.pair(), scene.start(), [TRANSIENT, IMPACTS])?;
    let entered = match region.entered() {
        Some(0) => "; the scene's start and all impacts after it are in it".to_owned(),
        Some(impact) => format!("; the scene's orbit is in it from impact {impact} on"),
        None => String::new(),
    };
    let proved = format!("certified: a trapping region of {} boxes{entered}; {}", region.boxes(), program());
    let floating = format!("{} impacts of a floating-point orbit after {TRANSIENT} others: non-rigorous", states.len());
    picture::svg(look.size(SINGLE_PANEL_SIZE), SCALE, |root| {
        let top = caption(scene, None, proved, (root, look))?;
        let boxes = format!("boxes of 2π/{columns} by 1/{rows}");
        let height = legend(root, top, &[(LegendSymbol::Cell(SKY), boxes), (LegendSymbol::Dot(BLACK), floating)])?;
        let (_, below) = root.split_vertically(top + height);
        let axes = [arc.axis(), speeds(region.speed())];
        let plane = Plane::draw(&below, axes, [PHASE_LABEL, SPEED_LABEL], RIGHT_MARGIN)?;
        root.draw(&cells(region, arc, &plane))?;
        root.draw(&dots(states.iter().map(|state| in_turn(arc, state)).collect(), &plane))?;
        Ok(())
    })
}

/// A floating-point orbit, the h-sets and their first images; the h-sets of the horseshoe in their own coordinates, in which
/// their images lie across them; and, for a given hyperbolic set, the strips, leaves and cones of one h-set.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
pub fn chaos(
    scene: &Scene,
    over: Option<&Range>,
    (found, set): (&Chaos, Option<&Hyperbolic>),
    look: &Look,
) -> Result<String> {
    let mut titles =
        vec!["(a)  the attractor, the h-sets and their images", "(b)  the h-sets along their leaf and across it"];
    titles.extend(set.map(|_| "(c)  an h-set: strips, leaves and cones"));
    let has_bases = !found.bases().is_empty();
    let size =
        look.size(if has_bases { (PANEL_SIZE.0 * titles.len() as u32, PANEL_SIZE.1) } else { SINGLE_PANEL_SIZE });
    picture::svg(size, SCALE, |root| {
        let top = caption(scene, over, proved(found), (root, look))?;
        let height = legend(root, top, &entries(found, set))?;
        let (_, mut below) = root.split_vertically(top + height);
        if !has_bases {
            return whole(found, &below, root);
        }
        let wide = size.0 as i32 * SCALE / titles.len() as i32;
        let mut areas = Vec::new();
        for words_of in titles {
            let (panel, rest) = below.split_horizontally(wide);
            let (title, area) = panel.split_vertically(24 * SCALE);
            title.draw(&Text::new(words_of, (16 * SCALE, 14 * SCALE), words(FONT, &BLACK, HPos::Left)))?;
            areas.push(area);
            below = rest;
        }
        whole(found, &areas[0], root)?;
        leaf::draw(scene, found, &areas[1], root)?;
        set.map_or(Ok(()), |set| cones::draw(scene, (found, set), &areas[2], root))
    })
}

/// The phases of the columns of a region: left and right ends, in forcing periods.
fn phases(region: &Trap) -> impl Iterator<Item = [f64; 2]> {
    let columns = region.grid().0 as f64;
    region.columns().into_keys().map(move |column| [column, column + 1].map(|column| f64::from(column) / columns))
}

/// The boxes of a region.
fn cells(region: &Trap, arc: Arc, plane: &Plane) -> Element {
    let (columns, rows) = region.grid();
    let width = 1.0 / columns as f64;
    let mut cells = Cells::default();
    let runs = region.columns().into_iter().flat_map(|(column, runs)| runs.into_iter().map(move |run| (column, run)));
    for (column, (first, last)) in runs {
        let left = arc.place((f64::from(column) + 0.5) * width) - std::f64::consts::PI * width;
        let [low, high] = [first, last + 1].map(|row| f64::from(row) / rows);
        let right = left + std::f64::consts::TAU * width;
        let ((x0, y0), (x1, y1)) = (plane.pixel([left, high]), plane.pixel([right, low]));
        cells.add((x0, y0), (x1 - x0, y1 - y0));
    }
    Element(cells.element(SKY))
}

/// Draws a region, the given states (phases in forcing periods) and the h-sets of a horseshoe, if there is one, into an area.
pub(crate) fn section(
    region: &Trap,
    horseshoe: Option<&Chaos>,
    states: &[State],
    (area, root): (&Canvas<'_>, &Canvas<'_>),
) -> Drawn {
    let arc = Arc::holding(phases(region).chain(states.iter().map(|[phase, _]| [*phase; 2])));
    let fastest = states.iter().map(|[_, speed]| *speed).fold(region.speed()[1], f64::max);
    let axes = [arc.axis(), speeds([region.speed()[0], fastest])];
    let plane = Plane::draw(area, axes, [PHASE_LABEL, SPEED_LABEL], RIGHT_MARGIN)?;
    root.draw(&cells(region, arc, &plane))?;
    root.draw(&dots(states.iter().map(|state| in_turn(arc, state)).collect(), &plane))?;
    let bases = horseshoe.map_or(&[][..], Chaos::bases).iter();
    let bases: Vec<Vec<State>> = bases.flat_map(|base| pieces(arc, &round(base))).collect();
    root.draw(&Element(plane.clipped(&lines(&bases, &plane, (VERMILION, OUTLINE_WIDTH)))))?;
    Ok(())
}

/// The line on the proved results.
fn proved(found: &Chaos) -> String {
    let counted = format!(
        "{} of at most {} from {}",
        counted(found.words().len() as u32, "word"),
        counted(found.depth(), "impact"),
        counted(found.bases().len() as u32, "h-set")
    );
    if found.entropy() > 0.0 {
        let [impact, cycle] = [found.entropy(), found.entropy_a_cycle()].map(rounded_down);
        return format!(
            "certified: a horseshoe, topological entropy at least {impact} per impact, {cycle} per forcing period; {counted}; {}",
            program()
        );
    }
    format!("undecided: no horseshoe is proved; {counted}; {}", program())
}

/// A number with four decimals, rounded down.
fn rounded_down(x: f64) -> String {
    // The product may have been rounded up to a whole number.
    let whole = (x * 1e4).next_down().max(0.0).floor();
    format!("{:.4}", whole / 1e4)
}

/// The part of the floating-point orbit that is shown.
fn seen(found: &Chaos) -> impl Iterator<Item = &State> {
    found.attractor().iter().take(IMPACTS)
}

/// The entries of the legend.
fn entries(found: &Chaos, set: Option<&Hyperbolic>) -> Vec<(LegendSymbol, String)> {
    let mut entries = Vec::new();
    let impacts = seen(found).count();
    if impacts > 0 {
        entries.push((
            LegendSymbol::Dot(BLACK),
            format!("{impacts} impacts of a floating-point orbit without its transient: non-rigorous"),
        ));
    }
    if !found.bases().is_empty() {
        let depth = found.depth().min(MAX_IMAGES);
        let later = if depth == 1 { "1 impact".to_owned() } else { format!("1 to {depth} impacts") };
        entries.push((LegendSymbol::Outline(VERMILION), "h-sets".to_owned()));
        entries.push((
            LegendSymbol::Line(SKY, IMAGE_WIDTH),
            format!("(a) their images {later} later, up to where they cover an h-set: proved"),
        ));
    }
    for (words, colour) in leaf::words(found).iter().zip(leaf::COLOURS) {
        let Some(word) = words.first() else { continue };
        let name = typeset_text(&word.in_mappings());
        entries.push((
            LegendSymbol::Line(colour, leaf::STRIP_WIDTH),
            format!("(b) images by {name}, which are proved to cover h-sets"),
        ));
    }
    if let Some(set) = set {
        let [strips, leaves, cones] = cones::COLOURS;
        let words = counted(set.words.len() as u32, "word");
        entries.push((LegendSymbol::Cell(strips), format!("(c) strips of the {words} of a uniformly hyperbolic set")));
        entries
            .push((LegendSymbol::Line(leaves, cones::LEAF_WIDTH), "(c) images that lie across the h-set".to_owned()));
        entries.push((LegendSymbol::Cell(cones), "(c) cones that hold the expanding directions: proved".to_owned()));
    }
    entries
}

/// Draws title, parameters and proved results; returns their height.
fn caption(
    scene: &Scene,
    over: Option<&Range>,
    proved: String,
    (root, look): (&Canvas<'_>, &Look),
) -> Result<i32, Box<dyn std::error::Error>> {
    picture::caption(root, look, scene.title().unwrap_or("The impact map"), &[parameters(scene, over), proved])
}

/// The parameters of a scene; with `over`, the range of the varied parameter.
pub(crate) fn parameters(scene: &Scene, over: Option<&Range>) -> String {
    let words = scene.pair().in_words();
    let Some(over) = over else { return greek(&format!("{words}; {}", scene.start().in_words())) };
    let symbol = over.key().symbol().0;
    let fixed: Vec<&str> =
        words.split(", ").filter(|word| !greek(word).starts_with(&format!("${symbol} = "))).collect();
    let range = greek(&format!("{} ≤ {symbol} ≤ {}", over.low(), over.high()));
    format!("{}; all {range}", greek(&format!("{}; {}", fixed.join(", "), scene.start().in_words())))
}

/// The axis of speeds over a range; from 0 on if the range begins near 0.
fn speeds([low, high]: [f64; 2]) -> Axis {
    if low < 0.5 * high { Axis::over(0.0, 1.05 * high) } else { Axis::around([low, high].into_iter()) }
}

/// Draws the whole state space.
fn whole(found: &Chaos, area: &Canvas<'_>, root: &Canvas<'_>) -> Drawn {
    let dots_shown = || seen(found);
    let corners = || found.bases().iter().flat_map(round);
    let all = || dots_shown().copied().chain(found.tubes().iter().flatten().copied()).chain(corners());
    let arc = Arc::holding(all().map(|[phase, _]| [phase; 2]));
    let ends = all().fold([f64::MAX, 0.0], |[low, high]: State, [_, speed]| [low.min(speed), high.max(speed)]);
    let plane = Plane::draw(area, [arc.axis(), speeds(ends)], [PHASE_LABEL, SPEED_LABEL], RIGHT_MARGIN)?;
    let images: Vec<Vec<State>> = found.tubes().iter().flat_map(|tube| pieces(arc, tube)).collect();
    let bases: Vec<Vec<State>> = found.bases().iter().flat_map(|base| pieces(arc, &round(base))).collect();
    root.draw(&Element(plane.clipped(&lines(&images, &plane, (SKY, IMAGE_WIDTH)))))?;
    root.draw(&dots(dots_shown().map(|state| in_turn(arc, state)).collect(), &plane))?;
    root.draw(&Element(plane.clipped(&lines(&bases, &plane, (VERMILION, OUTLINE_WIDTH)))))?;
    Ok(())
}

/// The corners of an h-set, with the first corner again at the end.
fn round(base: &HSet) -> [State; 5] {
    [base.left.bottom, base.right.bottom, base.right.top, base.left.top, base.left.bottom]
}

/// The place of a state on the axes: phase along the arc, and speed.
fn in_turn(arc: Arc, [phase, speed]: &State) -> State {
    [arc.place(*phase), *speed]
}

/// Pieces of a curve, on the axes: a new piece where the curve leaves the arc at one end and enters at the other.
fn pieces(arc: Arc, curve: &[State]) -> Vec<Vec<State>> {
    let mut pieces: Vec<Vec<State>> = Vec::new();
    for state in curve.iter().map(|state| in_turn(arc, state)) {
        let is_near = |last: &State| (last[0] - state[0]).abs() < std::f64::consts::PI;
        match pieces.last_mut().filter(|piece| piece.last().is_some_and(is_near)) {
            Some(piece) => piece.push(state),
            None => pieces.push(vec![state]),
        }
    }
    pieces
}

/// Curves on the axes as one element.
fn lines(curves: &[Vec<State>], plane: &Plane, (colour, width): (RGBColor, i32)) -> String {
    let mut path = Path::default();
    for curve in curves {
        let mut places = curve.iter().map(|state| plane.place(*state));
        let Some(first) = places.next() else { continue };
        path.move_to(first);
        places.for_each(|place| path.line_to(place));
    }
    format!(
        "<path stroke=\"{}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" d=\"{}\"/>\n",
        hex(colour),
        path.data()
    )
}

/// States on the axes as dots.
fn dots(states: Vec<State>, plane: &Plane) -> Element {
    Dots { colour: BLACK, places: states.into_iter().map(|state| plane.pixel(state)).collect() }.element()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_never_described_as_equalities() {
        assert_eq!(
            [0.28119957, 0.43326711, 0.0, 0.00009999].map(rounded_down),
            ["0.2811", "0.4332", "0.0000", "0.0000"]
        );
        // The product of this number is rounded up to a whole number.
        let less = 0.0037_f64.next_down();
        assert!(less * 1e4 == 37.0 && rounded_down(less) == "0.0036");
    }

    #[test]
    fn a_parameter_that_varies_has_its_range() {
        let scene = Scene::parse(
            "excitation = { amplitude = 8, frequency = \"pi\", phase = 0 }\npair = { gap = 9.42497, restitution = 0.5 }\n\
             start = { time = 0, wall = \"left\", velocity = -1 }",
        )
        .unwrap();
        let over: Range = "gap=9.4..9.5".parse().unwrap();
        let words = parameters(&scene, Some(&over));
        assert_eq!(words, "$A = 8, Ω = π, τ = 0, e = 0.5; start: t = 0, left wall, v = −1$; all $9.4 ≤ d ≤ 9.5$");
        assert!(parameters(&scene, None).contains("d = 9.42497"));
    }

    #[test]
    fn a_curve_is_cut_where_the_arc_ends() {
        let arc = Arc::holding([[0.0, 1.0]].into_iter());
        let cut = pieces(arc, &[[0.9, 1.0], [0.98, 1.0], [1.04, 1.0], [1.1, 1.0]]);
        assert_eq!(cut.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
    }
}
