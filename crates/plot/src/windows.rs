//! The widths of windows of stable periodic orbits over a parameter, on a logarithmic scale, as SVG.

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{FoundWindow, Windows};
use impact_pair::exact::Exact;
use impact_pair::json::counted;
use impact_pair::scene::Key;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::chaos::parameters;
use crate::picture::{self, Axis, BLUE, Canvas, FONT, GREY, LegendSymbol, Look, Plane, SCALE, VERMILION, words};
use crate::sweep::{described, value};

const SIZE: (u32, u32) = (900, 600);
/// Room on the right of the axes, and the radius of a mark.
const RIGHT_MARGIN: i32 = 30 * SCALE;
const RADIUS: i32 = 4 * SCALE;
/// Rows above and below a mark in which its label may be placed.
const ROWS: i32 = 6;

/// A window in the plot: value, decimal logarithm of the width, impacts, and whether all of the window is proved.
struct Marked {
    at: f64,
    width: f64,
    impacts: usize,
    is_certified: bool,
}

/// The windows whose ends are both proved: the value of the parameter, and the width.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
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
        let marks: Vec<_> = all.iter().map(|window| plane.pixel([window.at, window.width])).collect();
        for (Marked { is_certified, .. }, mark) in all.iter().zip(&marks) {
            root.draw(&Circle::new(*mark, RADIUS, colour(*is_certified).filled()))?;
        }
        let texts: Vec<String> = all.iter().map(|window| window.impacts.to_string()).collect();
        for (text, place) in texts.iter().zip(places(&marks, &texts)) {
            root.draw(&Text::new(text.clone(), place, words(FONT, &BLACK, HPos::Left)))?;
        }
        Ok(())
    })
}

/// Places of the labels of marks: the left end at half the height of each label. A label is on the right of its mark, on the left, above
/// or below, or farther above and below: at the first of these places where it meets no mark and no earlier label.
fn places(marks: &[(i32, i32)], texts: &[String]) -> Vec<(i32, i32)> {
    let size = |text: &str| (text.len() as i32 * FONT * 3 / 5, FONT);
    let meets =
        |(x, y): (i32, i32), (width, height): (i32, i32), ((left, right), (top, bottom)): ((i32, i32), (i32, i32))| {
            x < right && left < x + width && y - height / 2 < bottom && top < y + height / 2
        };
    let mut taken: Vec<_> = marks.iter().map(|(x, y)| ((x - RADIUS, x + RADIUS), (y - RADIUS, y + RADIUS))).collect();
    let place = |((x, y), text): (&(i32, i32), &String)| {
        let (width, height) = size(text);
        let beside = [x + 2 * RADIUS, x - 2 * RADIUS - width].map(|x| (x, *y));
        let off = |k: i32| [1, -1].map(|sign| (x - width / 2, y - sign * (RADIUS + k * height)));
        let all: Vec<(i32, i32)> = beside.into_iter().chain((1..=ROWS).flat_map(off)).collect();
        let is_free = |at: &&(i32, i32)| !taken.iter().any(|one| meets(**at, (width, height), *one));
        let (x, y) = *all.iter().find(is_free).unwrap_or(&all[0]);
        taken.push(((x, x + width), (y - height / 2, y + height / 2)));
        (x, y)
    };
    marks.iter().zip(texts).map(place).collect()
}

fn colour(is_certified: bool) -> RGBColor {
    if is_certified { BLUE } else { VERMILION }
}

/// The scene's own value of the parameter.
fn own_value<'s>(scene: &'s Scene, found: &Windows) -> Option<&'s Exact> {
    match found.over.key() {
        Key::Gap => Some(scene.pair().gap()),
        Key::Restitution => Some(scene.pair().restitution()),
        _ => scene.pair().excitation().only().map(|harmonic| harmonic.amplitude()),
    }
}

fn is_inside(found: &Windows, own: f64) -> bool {
    (value(found.over.low())..=value(found.over.high())).contains(&own)
}

/// Draws title, fixed parameters and axes.
fn frame(
    scene: &Scene,
    found: &Windows,
    all: &[Marked],
    (root, look): (&Canvas<'_>, &Look),
) -> Result<Plane, Box<dyn std::error::Error>> {
    let key = found.over.key();
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
    let mut entries: Vec<(LegendSymbol, String)> =
        shown.map(|(kind, text)| (LegendSymbol::Cell(colour(kind)), text.to_owned())).collect();
    if own_value(scene, found).is_some_and(|own| is_inside(found, value(own))) {
        entries.push((LegendSymbol::Line(GREY, 2 * SCALE), "the scene's own value".to_owned()));
    }
    let height = picture::legend(root, top, &entries)?;
    let (_, below) = root.split_vertically(top + height);
    let ends =
        |end: fn(f64, f64) -> f64, other: f64| all.iter().map(|window| window.width).reduce(end).unwrap_or(other);
    let (narrow, wide) = (ends(f64::min, -1.0).floor() - 1.0, ends(f64::max, 0.0).ceil() + 1.0);
    let axes = [Axis::over(value(found.over.low()), value(found.over.high())), Axis::over(narrow, wide)];
    Plane::draw(&below, axes, [&described(key), "decimal logarithm of the width of the window"], RIGHT_MARGIN)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Labels of marks that are close or coincide overlap neither each other nor a mark.
    #[test]
    fn labels_do_not_overlap() {
        let marks = [(100, 100), (104, 100), (100, 104), (108, 101), (400, 100), (401, 160)];
        let texts = ["20", "22", "24", "9", "35", "44"].map(str::to_owned);
        let found = places(&marks, &texts);
        let boxes: Vec<[i32; 4]> = found
            .iter()
            .zip(&texts)
            .map(|((x, y), text)| [*x, x + text.len() as i32 * FONT * 3 / 5, y - FONT / 2, y + FONT / 2])
            .collect();
        for (i, a) in boxes.iter().enumerate() {
            for b in &boxes[..i] {
                assert!(a[0] >= b[1] || b[0] >= a[1] || a[2] >= b[3] || b[2] >= a[3], "{a:?} {b:?}");
            }
        }
        assert_eq!(found[4], (400 + 2 * RADIUS, 100));
    }
}
