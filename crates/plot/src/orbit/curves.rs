//! The curves of a panel: Bézier segments, thin and translucent where there are many, so that density shows.

use std::fmt::Write;

use super::frame::Frame;
use super::style::Style;
use super::trace::{Part, Point};
use crate::picture::{Canvas, Drawn, Element, Path, Plane, SCALE, hermite, hex};

/// Points of a stroke for one Bézier segment, which is 1/24 of a forcing period long.
pub const POINTS_PER_SEGMENT: usize = 4;
/// Number of flights from which on curves are translucent, and the least opacity.
const TRANSLUCENT_FROM: f64 = 30.0;
const MIN_OPACITY: f64 = 0.2;
/// Opacity of jumps: jumps are fainter than flights, but do not darken each other, since they lie on walls.
const JUMP_OPACITY: f64 = 0.45;

/// The curve of a stroke on a panel.
pub fn path(points: &[Point], frame: &Frame<'_>, plane: &Plane) -> Path {
    let middle = |point: &Point| frame.place(point).map(|span| span.middle);
    let mut path = Path::default();
    let last = points.len() - 1;
    let knots: Vec<&Point> = (0..last).step_by(POINTS_PER_SEGMENT).chain([last]).map(|at| &points[at]).collect();
    path.move_to(plane.place(middle(knots[0])));
    for pair in knots.windows(2) {
        let turns = pair[1].at - pair[0].at;
        let end = |point: &Point| {
            (
                plane.place(middle(point)),
                plane.pixel_displacement(middle(point), frame.rate(point).map(|rate| rate * turns)),
            )
        };
        path.curve_to(hermite(end(pair[0]), end(pair[1])));
    }
    path
}

/// The style of one kind of strokes: their parts, width in pixels of the picture, and opacity.
type Look = (&'static [Part], f64, f64);

/// Draws all curves of a panel, with the curves of the transient first.
pub fn draw(frame: &Frame<'_>, style: Style, plane: &Plane, root: &Canvas<'_>) -> Drawn {
    let mut svg = String::new();
    for is_transient in [true, false] {
        let of = |parts: &'static [Part]| {
            let strokes =
                frame.strokes().filter(move |(stroke, points)| parts.contains(&stroke.part) && points.len() > 1);
            strokes.filter(|(stroke, _)| (stroke.impacts < style.transient) == is_transient)
        };
        let flights = of(&[Part::Flight]).count() as f64;
        let is_dense = !frame.panel.is_of_time() && flights > TRANSLUCENT_FROM;
        let (width, opacity) =
            if is_dense { (1.0, (TRANSLUCENT_FROM / flights).sqrt().max(MIN_OPACITY)) } else { (1.5, 1.0) };
        let looks: [Look; 3] = [
            (&[Part::Jump], 1.0, JUMP_OPACITY),
            (&[Part::Flight], width, opacity),
            (&[Part::Chatter, Part::Rest], 5.0, 1.0),
        ];
        for (parts, width, opacity) in looks {
            let paths: Vec<Path> = of(parts).map(|(_, points)| path(points, frame, plane)).collect();
            if !paths.is_empty() {
                let colour = hex(style.curve(if is_transient { 0 } else { style.transient }));
                group(&mut svg, &paths, is_dense && parts == [Part::Flight], &colour, (width, opacity));
            }
        }
    }
    root.draw(&Element(plane.clipped(&svg)))?;
    Ok(())
}

/// Writes the paths of one style; each dense path is an element of its own, so that paths darken each other.
fn group(svg: &mut String, paths: &[Path], is_dense: bool, colour: &str, (width, opacity): (f64, f64)) {
    let width = width * f64::from(SCALE);
    // Writing to a String cannot fail.
    let _ = write!(
        svg,
        "<g stroke=\"{colour}\" stroke-width=\"{width}\" stroke-opacity=\"{opacity:.2}\" stroke-linejoin=\"round\">"
    );
    let data = paths.iter().map(Path::data);
    if is_dense {
        data.for_each(|data| {
            let _ = write!(svg, "<path d=\"{data}\"/>");
        });
    } else {
        let _ = write!(svg, "<path d=\"{}\"/>", data.collect::<String>());
    }
    svg.push_str("</g>\n");
}
