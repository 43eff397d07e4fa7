//! The fate of every motion of a pair, as SVG: the state space coloured by the attractors of its motions, and the graph of components.

mod morse;

use std::f64::consts::TAU;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{BasinOutcome, Global, Kind, LimitCycle, Patch, State};
use impact_pair::json::GlobalDocument;
use impact_pair::json::counted;
use impact_pair::pair::Wall;
use plotters::prelude::*;

use crate::chaos::PHASE_LABEL;
use crate::picture::{
    self, Axis, BLUE, Canvas, Drawn, Element, GREEN, LegendSymbol, Look, ORANGE, PURPLE, Plane, SCALE, SKY,
};
use crate::picture::{VERMILION, greek, program};
use crate::sweep::Cells;

/// Size of the picture, and width of the graph.
const SIZE: (u32, u32) = (1160, 680);
const GRAPH_WIDTH: i32 = 320 * SCALE;
/// Room on the right of axes.
const RIGHT_MARGIN: i32 = 16 * SCALE;
/// Colours of attractors, in their order; further attractors use the colours again.
const ATTRACTOR_COLOURS: [RGBColor; 5] = [BLUE, GREEN, ORANGE, PURPLE, SKY];
/// Colour of states whose attractor is undecided.
const UNDECIDED_COLOUR: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
/// Least side at which a box of a component that is not an attractor is drawn.
const MIN_BOX_SIDE: i32 = 3 * SCALE / 2;
const RADIUS: i32 = 5 * SCALE;
const SPEED_LABEL: &str = "speed before the impact, in $AΩ$";
/// Greatest number of components in the legend and in the graph.
const MAX_COMPONENTS: usize = 12;

/// The state space, coloured by the proved fate of its motions, with its components, and the graph of components.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
pub fn global(scene: &Scene, found: &Global, document: &GlobalDocument, look: &Look) -> Result<String> {
    picture::svg(look.size(SIZE), SCALE, |root| {
        let title = scene.title().unwrap_or("The impact map");
        let said = format!("{}; {}", document.statement, program());
        let top = picture::caption(root, look, title, &[greek(&scene.pair().in_words()), said])?;
        let height = picture::legend(root, top, &entries(found))?;
        let (_, below) = root.split_vertically(top + height);
        let (left, right) = below.split_horizontally(below.dim_in_pixel().0 as i32 - GRAPH_WIDTH);
        space(found, &left, root)?;
        morse::draw(found, &right)
    })
}

/// The colour of a component.
fn colour(found: &Global, component: usize) -> RGBColor {
    let is_attractor = |i: usize| found.components[i].kind.is_attractor();
    match found.components[component].kind {
        Kind::Undecided => BLACK,
        _ if is_attractor(component) => {
            ATTRACTOR_COLOURS[(0..component).filter(|&i| is_attractor(i)).count() % ATTRACTOR_COLOURS.len()]
        }
        _ => VERMILION,
    }
}

/// The entries of the legend.
fn entries(found: &Global) -> Vec<(LegendSymbol, String)> {
    let is_drawn = |goes: fn(&BasinOutcome) -> bool| found.patches.iter().any(|patch| goes(&patch.goes));
    let attractors =
        (0..found.components.len()).filter(|&i| found.components[i].kind.is_attractor()).take(MAX_COMPONENTS);
    let mut all: Vec<(LegendSymbol, String)> = attractors
        .map(|i| (LegendSymbol::Cell(colour(found, i)), format!("every motion ends in {}: proved", name(found, i))))
        .collect();
    if is_drawn(|goes| *goes == BasinOutcome::Undecided) {
        all.push((LegendSymbol::Cell(UNDECIDED_COLOUR), "goes to one of several, or undecided".to_owned()));
    }
    let within = |is: fn(&Kind) -> bool| found.components.iter().any(|own| is(&own.kind) && own.boxes > 0);
    if within(|kind| matches!(kind, Kind::Saddle(_) | Kind::Grazing)) {
        all.push((LegendSymbol::Cell(VERMILION), "saddles, grazing states".to_owned()));
    }
    if within(Kind::is_undecided) {
        all.push((LegendSymbol::Cell(BLACK), "undecided components".to_owned()));
    }
    all
}

/// The number and kind of a component.
fn name(found: &Global, component: usize) -> String {
    let (number, kind) = (component + 1, &found.components[component].kind);
    match kind {
        Kind::RestCycle(Some(rest)) => format!("{number} (cycle with rests, {})", counted(rest.cycles, "cycle")),
        Kind::RestCycle(None) => format!("{number} (cycle with rests)"),
        kind => match kind.limit() {
            Some(limit) => format!("{number} ({}, {})", kind.kind(), counted(limit.problem.chain().cycles(), "cycle")),
            None => format!("{number} ({})", kind.kind()),
        },
    }
}

/// Draws the state space.
fn space(found: &Global, area: &Canvas<'_>, root: &Canvas<'_>) -> Drawn {
    let plane =
        Plane::draw(area, [Axis::angle(), Axis::over(0.0, found.fastest)], [PHASE_LABEL, SPEED_LABEL], RIGHT_MARGIN)?;
    let mut data = String::new();
    let mut layer = |colour: RGBColor, least: i32, is_shown: &dyn Fn(&BasinOutcome) -> bool| {
        let mut all = Cells::default();
        for patch in found.patches.iter().filter(|patch| is_shown(&patch.goes)) {
            add(&mut all, &plane, patch, least);
        }
        data += &all.element(colour);
    };
    layer(UNDECIDED_COLOUR, 1, &|goes| *goes == BasinOutcome::Undecided);
    for i in (0..found.components.len()).filter(|&i| found.components[i].kind.is_attractor()) {
        layer(colour(found, i), 1, &|goes| *goes == BasinOutcome::To(i));
    }
    for i in 0..found.components.len() {
        layer(colour(found, i), MIN_BOX_SIDE, &|goes| *goes == BasinOutcome::Within(i));
    }
    root.draw(&Element(plane.clipped(&data)))?;
    for (i, limit) in found.components.iter().enumerate().filter_map(|(i, own)| Some((i, own.kind.limit()?))) {
        for state in states(limit, found) {
            let at = plane.pixel(state);
            root.draw(&Circle::new(at, RADIUS, WHITE.filled()))?;
            root.draw(&Circle::new(at, RADIUS - SCALE, colour(found, i).filled()))?;
        }
    }
    Ok(())
}

fn add(all: &mut Cells, plane: &Plane, patch: &Patch, least: i32) {
    let [[left, right], [low, high]] = [patch.phases.map(|phase| phase * TAU), patch.speeds];
    let ((x0, y0), (x1, y1)) = (plane.pixel([left, high]), plane.pixel([right, low]));
    all.add((x0, y0), ((x1 - x0).max(least), (y1 - y0).max(least)));
}

/// The impacts of a cycle, mirrored to the left wall, phases in radians.
fn states<'l>(limit: &'l LimitCycle, found: &Global) -> impl Iterator<Item = State> + use<'l> {
    let unit = found.speed_unit;
    limit.orbit.impacts.iter().map(move |impact| {
        let half = if impact.wall == Wall::Right { 0.5 } else { 0.0 };
        let phase = (impact.phase.mid_rad().0 + half).rem_euclid(1.0);
        [phase * TAU, impact.velocity.mid_rad().0.abs() * unit]
    })
}
