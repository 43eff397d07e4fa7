//! The manifolds of figures 10 and 11 as SVG.

mod curve;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::exact::Enclosure;
use impact_pair::two_impact::{Axis, Manifold, Mark, Point};
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::picture::{self, Canvas, Drawn, Element, FONT, LETTER_WIDTH, Look, Plane, SCALE, hex, letters};
use curve::{Kind, Slope};

/// Size of the picture, and the height added by a magnified window below.
const SIZE: (u32, u32) = (900, 640);
const MAGNIFIED_HEIGHT: u32 = 300;
/// Height of a line of the legend, and room for names on the right of the plot.
const LINE_HEIGHT: i32 = 26 * SCALE;
const RIGHT_MARGIN: i32 = 52 * SCALE;
/// Amplitude, in gaps, above which curves are cut off: near W = 0 they have no bound.
const MAX_AMPLITUDE: f64 = 0.75;

/// The magnified window: its ends on both axes.
pub type Window = [[f64; 2]; 2];

/// The picture as SVG; over v with both walls, since the curves are mirror images (72). With `window`, this part of the picture is
/// shown again below, magnified.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
pub fn svg(scene: &Scene, axis: Axis, curves: &[Manifold], window: Option<Window>, look: &Look) -> Result<String> {
    let picture = Picture { curves, slope: Slope::of(scene, axis), gap: middle(&scene.pair().gap().enclose(64)), axis };
    let height = SIZE.1 + if window.is_some() { MAGNIFIED_HEIGHT } else { 0 };
    picture::svg(look.size((SIZE.0, height)), SCALE, |root| {
        let top = caption(scene, axis, (root, look))?;
        let (_, below) = root.split_vertically(top + legend(root, top)?);
        picture.draw(window, (&below, root))
    })
}

fn middle(x: &Enclosure) -> f64 {
    x.mid_rad().0
}

/// The data of a picture.
struct Picture<'m> {
    curves: &'m [Manifold],
    slope: Slope,
    gap: f64,
    axis: Axis,
}

/// A mark and its place.
type Marked = (Option<Mark>, [f64; 2]);

impl Picture<'_> {
    /// The points of a curve and, over v, their mirror images after or before them.
    fn points(&self, curve: &Manifold) -> Vec<Marked> {
        let point = |point: &Point| (point.mark, [middle(&point.at), middle(&point.amplitude)]);
        let mut points: Vec<Marked> = curve.points.iter().map(point).collect();
        if let Axis::Velocity(_) = self.axis {
            let mirrored = points.iter().map(|(mark, [at, amplitude])| (*mark, [-at, *amplitude]));
            points.extend(mirrored.collect::<Vec<_>>());
            points.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
        }
        points
    }

    fn draw(&self, window: Option<Window>, (below, root): (&Canvas<'_>, &Canvas<'_>)) -> Drawn {
        let points: Vec<(u32, Vec<Marked>)> =
            self.curves.iter().map(|curve| (curve.cycles, self.points(curve))).collect();
        let all = || points.iter().flat_map(|(_, points)| points).map(|(_, place)| *place);
        let ends = all().fold((f64::MAX, f64::MIN), |(low, high), [at, _]| (low.min(at), high.max(at)));
        let highest = all().map(|[_, amplitude]| amplitude).fold(0.0, f64::max).min(MAX_AMPLITUDE * self.gap);
        let axes = [picture::Axis::over(ends.0, ends.1), picture::Axis::over(0.0, 1.05 * highest)];
        let height = below.dim_in_pixel().1 as i32;
        let part =
            if window.is_some() { height * MAGNIFIED_HEIGHT as i32 / (SIZE.1 + MAGNIFIED_HEIGHT) as i32 } else { 0 };
        let (upper, lower) = below.split_vertically(height - part);
        let plane = Plane::draw(&upper, axes, axis_names(self.axis), RIGHT_MARGIN)?;
        self.asymptote(&plane, root)?;
        self.content(&plane, root)?;
        names(&points, &plane, root)?;
        let Some([across, up]) = window else { return Ok(()) };
        let corners = [plane.pixel([across[0], up[1]]), plane.pixel([across[1], up[0]])];
        root.draw(&Rectangle::new(corners, BLACK.mix(0.6).stroke_width(SCALE as u32)))?;
        let (title, lower) = lower.split_vertically(24 * SCALE);
        title.draw(&Text::new("in the frame, magnified:", (16 * SCALE, 14 * SCALE), words(FONT, HPos::Left)))?;
        let axes = [across, up].map(|[low, high]| picture::Axis::over(low, high));
        let plane = Plane::draw(&lower, axes, axis_names(self.axis), RIGHT_MARGIN)?;
        self.content(&plane, root)
    }

    /// Draws curves and marks.
    fn content(&self, plane: &Plane, root: &Canvas<'_>) -> Drawn {
        let halves = if let Axis::Velocity(_) = self.axis { &[false, true][..] } else { &[false] };
        let curves = self.curves.iter().flat_map(|curve| halves.iter().map(move |half| (curve, *half)));
        let elements: String = curves.map(|(curve, half)| curve::elements(curve, &self.slope, plane, half)).collect();
        root.draw(&Element(plane.clipped(&elements)))?;
        for (mark, place) in self.curves.iter().flat_map(|curve| self.points(curve)) {
            if let Some(mark) = mark.filter(|_| is_inside(plane, place)) {
                symbol(root, mark, plane.pixel(place))?;
            }
        }
        Ok(())
    }

    /// Draws the limit `d/2` of `A_N` for large W and for small v.
    fn asymptote(&self, plane: &Plane, root: &Canvas<'_>) -> Drawn {
        if !is_inside(plane, [plane.axes[0].range().start, 0.5 * self.gap]) {
            return Ok(());
        }
        let ((left, right), (_, y)) = (plane.pixels[0], plane.pixel([0.0, 0.5 * self.gap]));
        let line = format!(
            "<path stroke=\"{}\" stroke-width=\"{SCALE}\" stroke-dasharray=\"{SCALE} {}\" d=\"M{left} {y}H{right}\"/>",
            hex(BLACK),
            3 * SCALE
        );
        root.draw(&Element(line))?;
        root.draw(&Text::new("$d/2$", (right + 5 * SCALE, y - 5 * SCALE), words(FONT, HPos::Left)))?;
        Ok(())
    }
}

/// Whether a place lies within the axes.
fn is_inside(plane: &Plane, place: [f64; 2]) -> bool {
    (0..2).all(|axis| plane.axes[axis].range().contains(&place[axis]))
}

/// The names of the axes.
fn axis_names(axis: Axis) -> [&'static str; 2] {
    let across = match axis {
        Axis::Frequency => "angular frequency $Ω$ [rad/time]",
        Axis::Velocity(_) => {
            "relative velocity $v$ before the impact [length/time]: on the left wall $v < 0$, on the right wall $v > 0$"
        }
    };
    [across, "amplitude $A_N$ [length]"]
}

/// Draws the names of the curves, at the ends that have more room.
fn names(points: &[(u32, Vec<Marked>)], plane: &Plane, root: &Canvas<'_>) -> Drawn {
    let ends = |is_last: bool| -> Vec<(u32, (i32, i32))> {
        let shown = points.iter().filter_map(|(cycles, points)| {
            let mut inside = points.iter().filter(|(_, place)| is_inside(plane, *place));
            let end = if is_last { inside.next_back() } else { inside.next() };
            end.map(|(_, place)| (*cycles, plane.pixel(*place)))
        });
        shown.collect()
    };
    let (first, last) = (ends(false), ends(true));
    let is_last = room(&last) >= room(&first);
    for (cycles, (x, y)) in if is_last { last } else { first } {
        let place = if is_last { (x + 5 * SCALE, y) } else { (x + 8 * SCALE, y - 9 * SCALE) };
        root.draw(&Text::new(format!("$N = {cycles}$"), place, words(FONT, HPos::Left)))?;
    }
    Ok(())
}

/// The least distance between names at these places; from 1 on names do not cover each other.
fn room(places: &[(u32, (i32, i32))]) -> f64 {
    let distance = |a: (i32, i32), b: (i32, i32)| {
        let part = |a: i32, b: i32, size: i32| f64::from((a - b).abs()) / f64::from(size);
        part(a.0, b.0, 3 * FONT).max(part(a.1, b.1, FONT))
    };
    let pairs =
        places.iter().enumerate().flat_map(|(i, (_, a))| places[..i].iter().map(move |(_, b)| distance(*a, *b)));
    pairs.fold(f64::INFINITY, f64::min)
}

/// Draws title, parameters and program; returns their height.
fn caption(scene: &Scene, axis: Axis, (root, look): (&Canvas<'_>, &Look)) -> Result<i32, Box<dyn std::error::Error>> {
    let (pair, start) = (scene.pair(), scene.start());
    let given = match axis {
        Axis::Frequency => format!("v = {}", start.velocity()),
        Axis::Velocity(_) => format!("W = {}", pair.excitation().reference().frequency()),
    };
    let title = scene.title().unwrap_or("Equispaced motions with two impacts in N cycles").to_owned();
    let parameters = picture::greek(&format!("d = {}, e = {}, {given}", pair.gap(), pair.restitution()));
    let program =
        format!("$A_N$ of equation (68) for odd $N$, equispaced impacts, every part proved; {}", picture::program());
    picture::caption(root, look, &title, &[parameters, program])
}

/// An entry of the legend.
#[derive(Clone, Copy)]
enum Entry {
    Line(Kind),
    Symbol(Mark, &'static str),
    Words(&'static str),
}

/// The entries, in their order.
const ENTRIES: [Entry; 7] = [
    Entry::Line(Kind::Stable),
    Entry::Line(Kind::Unstable),
    Entry::Line(Kind::Unphysical),
    Entry::Words("solid: $sin θ_0 > 0$, dashed: $< 0$"),
    Entry::Symbol(Mark::Fold, "fold"),
    Entry::Symbol(Mark::Pitchfork, "pitchfork"),
    Entry::Symbol(Mark::Graze, "graze of the near wall"),
];

impl Entry {
    /// The words of the entry, and their distance from its left end.
    fn words(self) -> (&'static str, i32) {
        match self {
            Self::Line(kind) => (kind.name(), 42 * SCALE),
            Self::Symbol(_, name) => (name, 20 * SCALE),
            Self::Words(words) => (words, 0),
        }
    }

    fn draw(self, root: &Canvas<'_>, (x, y): (i32, i32)) -> Drawn {
        match self {
            Self::Line(kind) => {
                let (colour, width) = kind.look();
                let line = colour.stroke_width(width as u32);
                root.draw(&PathElement::new([(x, y), (x + 34 * SCALE, y)], line))?;
            }
            Self::Symbol(mark, _) => symbol(root, mark, (x + 6 * SCALE, y))?,
            Self::Words(_) => {}
        }
        let (name, indent) = self.words();
        root.draw(&Text::new(name, (x + indent, y), words(FONT, HPos::Left)))?;
        Ok(())
    }
}

/// Draws the legend of lines and symbols below `top`, in as many lines as needed; returns its height.
fn legend(root: &Canvas<'_>, top: i32) -> Result<i32, Box<dyn std::error::Error>> {
    let (left, right) = (24 * SCALE, root.dim_in_pixel().0 as i32 - 16 * SCALE);
    let (mut x, mut line) = (left, 0);
    for entry in ENTRIES {
        let (name, indent) = entry.words();
        let width = indent + (LETTER_WIDTH * f64::from(FONT) * letters(name)) as i32;
        if x > left && x + width > right {
            (x, line) = (left, line + 1);
        }
        entry.draw(root, (x, top + LINE_HEIGHT * line + LINE_HEIGHT / 2))?;
        x += width + 30 * SCALE;
    }
    Ok(LINE_HEIGHT * (line + 1))
}

/// Draws the symbol of a mark; where `sin th0 = 0` the line itself changes.
fn symbol(root: &Canvas<'_>, mark: Mark, (x, y): (i32, i32)) -> Drawn {
    let (line, half) = (BLACK.stroke_width(SCALE as u32), 9 * SCALE / 2);
    match mark {
        Mark::Level => {}
        // Hollow, since what is between them may be short.
        Mark::Fold => root.draw(&Circle::new((x, y), 5 * SCALE, line))?,
        Mark::Pitchfork => {
            let corners = [(-half, -half), (half, -half), (half, half), (-half, half), (-half, -half)];
            root.draw(&PathElement::new(corners.map(|(a, b)| (x + a, y + b)), line))?;
        }
        Mark::Graze => root.draw(&Cross::new((x, y), 5 * SCALE, line))?,
    }
    Ok(())
}

fn words<'a>(size: i32, side: HPos) -> TextStyle<'a> {
    picture::words(size, &BLACK, side)
}
