//! The widths of windows of stable periodic orbits over a parameter, on a logarithmic scale, as SVG.

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{FoundWindow, Windows};
use impact_pair::document::counted;
use impact_pair::exact::Exact;
use impact_pair::scene::Key;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::chaos::parameters;
use crate::picture::{self, Axis, BLUE, Canvas, FONT, GREY, Look, Mark, Plane, SCALE, VERMILION, words};
use crate::sweep::{described, value};

const SIZE: (u32, u32) = (900, 600);
/// Room on the right of the axes, and the radius of a mark.
const RIGHT: i32 = 30 * SCALE;
const RADIUS: i32 = 4 * SCALE;

/// A window in the plot: its value, the decimal logarithm of its width, its impacts, and whether all of it is proved.
struct Marked {
    at: f64,
    width: f64,
    impacts: usize,
    is_certified: bool,
}

/// Returns the windows whose ends are both proved: the value of the parameter, and the width.
///
/// # Errors
/// When it cannot be drawn.
pub fn windows(scene: &Scene, found: &Windows, look: &Look) -> Result<String> {
    let marked = |FoundWindow { impacts, window, .. }: &FoundWindow| {
        let width = window.width()?.log10();
        Some(Marked { at: value(&window.at), width, impacts: *impacts, is_certified: window.is_certified() })
    };
    let all: Vec<Marked> = found.windows.iter().filter_map(marked).collect();
    picture::svg(look.size(SIZE), SCALE, |root| {
        let plane = frame(scene, found, &all, (root, look))?;
        let line = |at: f64| {
            let (x, _) = plane.pixel([at, 0.0]);
            PathElement::new([(x, plane.pixels[1].0), (x, plane.pixels[1].1)], GREY.stroke_width(2 * SCALE as u32))
        };
        if let Some(own) = own_value(scene, found).map(value).filter(|own| is_inside(found, *own)) {
            root.draw(&line(own))?;
        }
        for Marked { at, width, impacts, is_certified } in &all {
            let (x, y) = plane.pixel([*at, *width]);
            root.draw(&Circle::new((x, y), RADIUS, colour(*is_certified).filled()))?;
            let place = (x + 2 * RADIUS, y);
            root.draw(&Text::new(impacts.to_string(), place, words(FONT, &BLACK, HPos::Left)))?;
        }
        Ok(())
    })
}

fn colour(is_certified: bool) -> RGBColor {
    if is_certified { BLUE } else { VERMILION }
}

/// The scene's own value of the parameter.
fn own_value<'s>(scene: &'s Scene, found: &Windows) -> Option<&'s Exact> {
    match found.over.key {
        Key::Gap => Some(scene.pair().gap()),
        Key::Restitution => Some(scene.pair().restitution()),
        _ => scene.pair().excitation().only().map(|harmonic| harmonic.amplitude()),
    }
}

fn is_inside(found: &Windows, own: f64) -> bool {
    (value(&found.over.low)..=value(&found.over.high)).contains(&own)
}

/// Title, what is given, and axes.
fn frame(
    scene: &Scene,
    found: &Windows,
    all: &[Marked],
    (root, look): (&Canvas<'_>, &Look),
) -> Result<Plane, Box<dyn std::error::Error>> {
    let key = found.over.key;
    let title = format!("{}: stable windows over the {key}", scene.title().unwrap_or("The impact map"));
    let said = format!(
        "{}, the number of impacts of the reduced map beside each; others are not excluded; {}",
        counted(all.len() as u32, "window"),
        picture::program()
    );
    let top = picture::caption(root, look, &title, &[parameters(scene, Some(&found.over)), said])?;
    let kinds =
        [(true, "both ends and all orbits between proved"), (false, "both ends proved, not all orbits between")];
    let shown = kinds.into_iter().filter(|(kind, _)| all.iter().any(|window| window.is_certified == *kind));
    let mut entries: Vec<(Mark, String)> =
        shown.map(|(kind, text)| (Mark::Cell(colour(kind)), text.to_owned())).collect();
    if own_value(scene, found).is_some_and(|own| is_inside(found, value(own))) {
        entries.push((Mark::Line(GREY, 2 * SCALE), "the scene's own value".to_owned()));
    }
    let height = picture::legend(root, top, &entries)?;
    let (_, below) = root.split_vertically(top + height);
    let ends =
        |end: fn(f64, f64) -> f64, other: f64| all.iter().map(|window| window.width).reduce(end).unwrap_or(other);
    let (narrow, wide) = (ends(f64::min, -1.0).floor() - 1.0, ends(f64::max, 0.0).ceil() + 1.0);
    let axes = [Axis::over(value(&found.over.low), value(&found.over.high)), Axis::over(narrow, wide)];
    Plane::draw(&below, axes, [&described(key), "decimal logarithm of the width of the window"], RIGHT)
}
