//! Both invariant manifolds of a saddle in the section, and a homoclinic tangency magnified, at and near its parameter value, as SVG.

use anyhow::{Context, Result};
use impact_pair::Scene;
use impact_pair::chaos::State;
use impact_pair::exact::decimal_f64;
use impact_pair::scene::Key;
use impact_pair::tangency::{Portrait, Tangencies, Tangency};
use plotters::prelude::*;

use crate::chaos::parameters;
use crate::orbit::title;
use crate::picture::{
    self, Axis, BLUE, Canvas, Dots, Drawn, Element, LegendSymbol, Look, Path, Plane, SCALE, VERMILION, hex,
};
use crate::sweep::value;

const SIZE: (u32, u32) = (1200, 940);
/// Room on the right of the axes, and the radius of a mark.
const RIGHT_MARGIN: i32 = 38 * SCALE;
const RADIUS: i32 = 4 * SCALE;
/// The greatest speed of the section, and the factor of magnification.
const MAX_SPEED: f64 = 3.0;
const MAGNIFICATION: f64 = 1000.0;
/// Distance of the parameter from the tangency in panels (c) and (d), in the units of the scene.
const PARAMETER_OFFSET: f64 = 1e-4;
const NAMES: [&str; 2] = ["phase $θ$ of the impact, mirrored to the left wall [rad]", "speed $w = |v|/(AΩ)$"];

/// The picture of the first tangency: the section, and the neighbourhood of a point of the orbit magnified 1,000 times, at the tangency
/// and at parameter values `1e-4` below and above.
///
/// # Errors
/// Returns an error if there is no tangency, or the picture cannot be drawn.
pub fn tangency(scene: &Scene, found: &Tangencies, look: &Look) -> Result<String> {
    let first = found.tangencies.first().context("there is no tangency to draw")?;
    let own = first.parameter.mid_rad().0;
    let [gap, e] = [scene.pair().gap(), scene.pair().restitution()].map(value);
    let amplitude = scene.pair().excitation().only().map_or(f64::NAN, |harmonic| value(harmonic.amplitude()));
    let pair = |parameter: f64| match found.over.key() {
        Key::Gap => [parameter / amplitude, e],
        Key::Restitution => [gap / amplitude, parameter],
        _ => [gap / parameter, e],
    };
    let portrait =
        Portrait::of(first, pair(own)).context("the invariant manifolds cannot be followed in floating point")?;
    picture::svg(look.size(SIZE), SCALE, |root| {
        let top = head(scene, found, (root, look))?;
        let (_, below) = root.split_vertically(top);
        let areas = below.split_evenly((2, 2));
        section(&portrait, (&areas[0], root))?;
        let key = found.over.key();
        let values = [
            ("(b)", 0.0, "at the tangency"),
            ("(c)", -PARAMETER_OFFSET, "1e-4 below"),
            ("(d)", PARAMETER_OFFSET, "1e-4 above"),
        ];
        for ((letter, apart, words), area) in values.into_iter().zip(&areas[1..]) {
            let at = own + apart;
            let heading = format!(
                "{letter}  {words}: {key} = {}, magnified {MAGNIFICATION:.0} times",
                decimal_f64((at * 1e7).round() / 1e7)
            );
            let below = title(area, &heading)?;
            magnified((&portrait, first), pair(at), (&below, root))?;
        }
        Ok(())
    })
}

/// Draws title, fixed parameters and the meaning of the colours; returns their height.
fn head(
    scene: &Scene,
    found: &Tangencies,
    (root, look): (&Canvas<'_>, &Look),
) -> Result<i32, Box<dyn std::error::Error>> {
    let name = format!("{}: a homoclinic tangency", scene.title().unwrap_or("The impact map"));
    let said = format!(
        "the tangency is proved, the curves are in floating point; both branches of the fold are nearer to each other than a line is wide; {}",
        picture::program()
    );
    let top = picture::caption(root, look, &name, &[parameters(scene, Some(&found.over)), said])?;
    let entries = [
        (LegendSymbol::Cell(VERMILION), "unstable manifold of the equispaced motion".to_owned()),
        (LegendSymbol::Cell(BLUE), "stable manifold".to_owned()),
        (LegendSymbol::Cell(BLACK), "saddle".to_owned()),
        (LegendSymbol::Ring, "point of tangency".to_owned()),
    ];
    Ok(top + picture::legend(root, top, &entries)?)
}

/// Draws the invariant manifolds, the saddle and the point of tangency.
fn section(portrait: &Portrait, (area, root): (&Canvas<'_>, &Canvas<'_>)) -> Drawn {
    let below = title(area, "(a)  both invariant manifolds in the section")?;
    let plane = Plane::draw(&below, [Axis::angle(), Axis::over(0.0, MAX_SPEED)], NAMES, RIGHT_MARGIN)?;
    for (colour, states) in [(BLUE, &portrait.stable), (VERMILION, &portrait.unstable)] {
        let shown = states.iter().filter(|[_, w]| *w < MAX_SPEED);
        root.draw(&Dots { colour, places: shown.map(|state| plane.pixel(*state)).collect() }.element())?;
    }
    root.draw(&Circle::new(plane.pixel(portrait.saddle), RADIUS, BLACK.filled()))?;
    root.draw(&Circle::new(plane.pixel(portrait.point), 2 * RADIUS, BLACK.stroke_width(SCALE as u32)))?;
    Ok(())
}

/// Draws the invariant manifolds near the point of tangency.
fn magnified(
    (portrait, tangency): (&Portrait, &Tangency),
    pair: [f64; 2],
    (area, root): (&Canvas<'_>, &Canvas<'_>),
) -> Drawn {
    let within = [std::f64::consts::PI / MAGNIFICATION, 0.5 * MAX_SPEED / MAGNIFICATION];
    // In thousandths, relative to the point.
    let axes = within.map(|within| Axis::over(-1e3 * within, 1e3 * within));
    let [theta, w] = portrait.point;
    let names = [format!("$θ$ less {theta:.7} [0.001 rad]"), format!("$w$ less {w:.7} [0.001]")];
    let plane = Plane::draw(area, axes, [&names[0], &names[1]], RIGHT_MARGIN)?;
    let Some([unstable, stable]) = portrait.magnified(tangency, pair, within) else { return Ok(()) };
    let curve = |points: &[State], colour: RGBColor| {
        let mut path = Path::default();
        for (i, state) in points.iter().enumerate() {
            let place = plane.place([1e3 * (state[0] - theta), 1e3 * (state[1] - w)]);
            if i == 0 { path.move_to(place) } else { path.line_to(place) }
        }
        format!("<path stroke=\"{}\" stroke-width=\"{}\" d=\"{}\"/>\n", hex(colour), 2 * SCALE, path.data())
    };
    root.draw(&Element(plane.clipped(&(curve(&stable, BLUE) + &curve(&unstable, VERMILION)))))?;
    Ok(())
}
