//! The picture: the plane in the colours of the classes, with the paper's curves and figures.

use std::collections::BTreeMap;
use std::error::Error as StdError;
use std::fmt::Write;

use anyhow::Result;
use impact_pair::json::AtlasHead;
use impact_pair::scene::Key;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::curves::{self, Bifurcation, Parameters};
use super::leaves::{CLASSES, Leaves};
use crate::picture::{self, Axis, Canvas, Element, FONT, LegendSymbol, Look, Plane, SCALE, hex, words};
use crate::sweep::{Cells, described};
use impact_pair_answers::grid::Points;

/// Size of the picture, in pixels.
pub const SIZE: (u32, u32) = (960, 720);
/// Room on the right of the axes, and the radius of a figure's ring.
const RIGHT_MARGIN: i32 = 28 * SCALE;
const RING_RADIUS: i32 = 5 * SCALE;
/// The width of a curve, and of the curve with the white on both sides.
const CURVE_WIDTH: i32 = 2 * SCALE;
const HALO_WIDTH: i32 = 4 * SCALE;

/// The picture as SVG.
///
/// # Errors
/// Returns an error if the picture cannot be drawn, or the atlas cannot be read.
pub fn svg(atlas: &mut Points<AtlasHead>, look: &Look) -> Result<String> {
    let leaves = Leaves::of(atlas)?;
    Ok(drawn(&atlas.head, &leaves, look)?.0)
}

/// The picture, and the place of the plane in it: left, top, right and bottom, relative to its size.
pub fn drawn(head: &AtlasHead, leaves: &Leaves, look: &Look) -> Result<(String, [f64; 4])> {
    let mut place = [0.0; 4];
    let size = look.size(SIZE);
    let text = picture::svg(size, SCALE, |root| {
        let parameters = Parameters::of(&head.scene, &leaves.axes);
        let plane = frame(head, leaves, parameters.as_ref(), (root, look))?;
        let ((left, right), (bottom, top)) = (plane.pixels[0], plane.pixels[1]);
        let part = |pixel: i32, whole: u32| f64::from(pixel) / f64::from(whole * SCALE as u32);
        place = [part(left, size.0), part(top, size.1), part(right, size.0), part(bottom, size.1)];
        root.draw(&Element(cells(&plane, leaves)))?;
        if let Some(parameters) = &parameters {
            over(&plane, parameters, leaves, root)?;
        }
        Ok(())
    })?;
    Ok((text, place))
}

/// Draws title, fixed parameters, the legend and axes; returns the plane.
fn frame(
    head: &AtlasHead,
    leaves: &Leaves,
    parameters: Option<&Parameters>,
    (root, look): (&Canvas<'_>, &Look),
) -> Result<Plane, Box<dyn StdError>> {
    let title = format!("{}: where every motion goes", head.title.as_deref().unwrap_or("The impact pair"));
    let top = picture::caption(root, look, &title, &[given(head), caption_text(head, leaves)])?;
    let what = if head.cells { "cells" } else { "points" };
    let entry = |(class, count): (usize, usize)| {
        let (_, colour, words) = CLASSES[class];
        (LegendSymbol::Cell(colour), format!("{words}: {count} {what}"))
    };
    let mut entries: Vec<(LegendSymbol, String)> = leaves.counts().into_iter().map(entry).collect();
    if let Some(parameters) = parameters {
        let is_there = |kind: Bifurcation| {
            curves::all()
                .any(|(one, cycles)| one == kind && is_seen(&parameters.curve(one, cycles, leaves.range()), leaves))
        };
        let kinds = [(Bifurcation::Fold, "folds"), (Bifurcation::Pitchfork, "pitchforks (dashed)")];
        let names: Vec<&str> = kinds.into_iter().filter(|(kind, _)| is_there(*kind)).map(|(_, name)| name).collect();
        if !names.is_empty() {
            let of = "of equispaced motions (66)-(69), N = 1, 3, 5";
            entries.push((LegendSymbol::Line(BLACK, CURVE_WIDTH), format!("{} {of}", names.join(" and "))));
        }
        if !parameters.figures(leaves.range()).is_empty() {
            entries.push((LegendSymbol::Ring, "the paper's figures".to_owned()));
        }
    }
    let height = picture::legend(root, top, &entries)?;
    let (_, below) = root.split_vertically(top + height + 6 * SCALE);
    let axes = leaves.range().map(|[low, high]| Axis::between(low, high));
    let names = leaves.axes.each_ref().map(|axis| described(axis.key()));
    Plane::draw(&below, axes, [&names[0], &names[1]], RIGHT_MARGIN)
}

/// The parameters that do not vary and have an effect.
fn given(head: &AtlasHead) -> String {
    let varies =
        |key: fn(&Key) -> bool| head.over.iter().filter_map(|over| over.key.parse().ok()).any(|own: Key| key(&own));
    let scene = &head.scene;
    let amplitude = scene.excitation.amplitude.first().map(|amplitude| amplitude.0.text());
    let entries = [
        ("A", amplitude, varies(|key| matches!(key, Key::Amplitude(_)))),
        ("d", Some(scene.gap.0.text()), varies(|key| *key == Key::Gap)),
        ("e", Some(scene.restitution.0.text()), varies(|key| *key == Key::Restitution)),
    ];
    let fixed = entries.into_iter().filter(|(_, _, varies)| !varies);
    let mut words: Vec<String> =
        fixed.filter_map(|(symbol, text, _)| Some(format!("${symbol}$ = {}", text?))).collect();
    words.push("all starts; of the parameters only $A/d$ and $e$ matter".to_owned());
    words.join(", ")
}

/// The line on the computation: number of points or cells, and program.
fn caption_text(head: &AtlasHead, leaves: &Leaves) -> String {
    let what = if head.cells {
        format!("{} cells, each for all parameters in it", leaves.all.len())
    } else {
        let [x, y] = leaves.axes.each_ref().map(|axis| axis.points());
        format!("{x} × {y} points, each for its exact parameters")
    };
    format!("{what}; proved; {}", picture::program())
}

/// A rectangle for each point or cell, by colours; undecided rectangles are also struck through.
fn cells(plane: &Plane, leaves: &Leaves) -> String {
    let mut paths: BTreeMap<usize, Cells> = BTreeMap::new();
    let mut strokes = String::new();
    for leaf in &leaves.all {
        let [[west, east], [south, north]] = leaf.ends;
        let ((left, bottom), (right, top)) = (plane.pixel([west, south]), plane.pixel([east, north]));
        paths.entry(leaf.class).or_default().add((left, top), (right - left, bottom - top));
        if CLASSES[leaf.class].0 == "undecided" {
            // Writing to a String cannot fail.
            let _ = write!(strokes, "M{left} {bottom}L{right} {top}");
        }
    }
    let mut drawn: String = paths.iter().map(|(class, cells)| cells.element(CLASSES[*class].1)).collect();
    let _ = writeln!(drawn, "<path stroke=\"#FFFFFF\" stroke-width=\"{}\" d=\"{strokes}\"/>", SCALE / 2);
    drawn
}

/// Whether any point of a curve is in the plane.
fn is_seen(curve: &[[f64; 2]], leaves: &Leaves) -> bool {
    let range = leaves.range();
    curve.iter().any(|at| at.iter().zip(range).all(|(x, [low, high])| (low..=high).contains(x)))
}

/// Draws the curves, and the paper's figures with their numbers.
fn over(plane: &Plane, parameters: &Parameters, leaves: &Leaves, root: &Canvas<'_>) -> Result<(), Box<dyn StdError>> {
    let range = leaves.range();
    let mut drawn = String::new();
    for (kind, cycles) in curves::all() {
        let curve = parameters.curve(kind, cycles, range);
        let mut data = String::new();
        for (i, at) in curve.iter().enumerate() {
            let (x, y) = plane.place(*at);
            let _ = write!(data, "{}{x:.1} {y:.1}", if i == 0 { "M" } else { "L" });
        }
        let dashes = if kind == Bifurcation::Pitchfork {
            format!(" stroke-dasharray=\"{0} {0}\"", 3 * CURVE_WIDTH)
        } else {
            String::new()
        };
        for (colour, width, dashes) in [(WHITE, HALO_WIDTH, ""), (BLACK, CURVE_WIDTH, dashes.as_str())] {
            let _ = writeln!(drawn, "<path stroke=\"{}\" stroke-width=\"{width}\"{dashes} d=\"{data}\"/>", hex(colour));
        }
    }
    root.draw(&Element(plane.clipped(&drawn)))?;
    let rings: Vec<(u32, (i32, i32))> =
        parameters.figures(range).into_iter().map(|(number, at)| (number, plane.pixel(at))).collect();
    for (_, at) in &rings {
        root.draw(&Circle::new(*at, RING_RADIUS + SCALE, WHITE.filled()))?;
        root.draw(&Circle::new(*at, RING_RADIUS, BLACK.stroke_width(SCALE as u32)))?;
    }
    let mut taken: Vec<Label> = rings.iter().map(|(_, at)| Label::ring(*at)).collect();
    for (number, at) in rings {
        let text = format!("fig. {number}");
        let label = Label::beside(at, &text, plane.pixels, &taken);
        let [left, top, right, bottom] = label.ends;
        root.draw(&Rectangle::new([(left, top), (right, bottom)], WHITE.mix(0.8).filled()))?;
        root.draw(&Text::new(text, (left + SCALE, (top + bottom) / 2), words(FONT, &BLACK, HPos::Left)))?;
        taken.push(label);
    }
    Ok(())
}

/// A rectangle of pixels that a ring or a label fills: left, top, right and bottom.
#[derive(Clone, Copy)]
struct Label {
    ends: [i32; 4],
}

impl Label {
    fn ring((x, y): (i32, i32)) -> Self {
        let by = RING_RADIUS + SCALE;
        Self { ends: [x - by, y - by, x + by, y + by] }
    }

    /// The first place beside a ring where a label is in the plane and covers nothing, tried in this order: right, left, above, below; above
    /// and below first centred, then to both sides. Right of the ring if there is no such place.
    fn beside((x, y): (i32, i32), text: &str, pixels: [(i32, i32); 2], taken: &[Self]) -> Self {
        let (width, half) = (text.len() as i32 * FONT * 2 / 5 + 2 * SCALE, FONT * 3 / 5);
        let (away, far) = (RING_RADIUS + 3 * SCALE, RING_RADIUS + 2 * SCALE + half);
        let of = |left: i32, middle: i32| Self { ends: [left, middle - half, left + width, middle + half] };
        let along = [x - width / 2, x - RING_RADIUS, x + RING_RADIUS - width];
        let places = [of(x + away, y), of(x - away - width, y)].into_iter();
        let mut places =
            places.chain([y - far, y + far].into_iter().flat_map(|middle| along.map(|left| of(left, middle))));
        let is_free = |own: &Self| own.is_in(pixels) && !taken.iter().any(|other| own.meets(other));
        places.find(is_free).unwrap_or_else(|| of(x + away, y))
    }

    fn is_in(&self, [(low, high), (bottom, top)]: [(i32, i32); 2]) -> bool {
        let [left, above, right, below] = self.ends;
        left >= low && right <= high && above >= top.min(bottom) && below <= top.max(bottom)
    }

    fn meets(&self, other: &Self) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.ends, other.ends);
        a < g && e < c && b < h && f < d
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Figures 12 and 13 are close together, and in the gallery near an edge of the plane: no label covers another label, or a ring.
    #[test]
    fn labels_of_figures_do_not_meet() {
        let pixels = [(0, 2000), (1500, 0)];
        for from_the_edge in [300, 64] {
            for rings in [[from_the_edge, from_the_edge + 122], [2000 - from_the_edge, 1878 - from_the_edge]] {
                let rings = rings.map(|x| (x, 700));
                let mut taken: Vec<Label> = rings.iter().map(|at| Label::ring(*at)).collect();
                for at in rings {
                    let label = Label::beside(at, "fig. 12", pixels, &taken);
                    assert!(label.is_in(pixels) && !taken.iter().any(|other| label.meets(other)), "{:?}", label.ends);
                    taken.push(label);
                }
            }
        }
    }
}
