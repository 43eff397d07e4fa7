//! The stretches of a manifold's curve, drawn as Bézier segments with the slopes of (68).

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

use impact_pair::Scene;
use impact_pair::two_impact::{Axis, Manifold, Part, Stability};
use plotters::style::RGBColor;

use super::middle;
use crate::picture::{BLUE, GREY, Path, Plane, SCALE, VERMILION, hermite, hex};

/// The properties proved for a part of a curve, shown by colour and width.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Stable,
    Unstable,
    Unphysical,
}

impl Kind {
    fn of(part: Part) -> Self {
        match (part.is_physical, part.stability) {
            (false, _) => Self::Unphysical,
            (true, Stability::Stable) => Self::Stable,
            (true, _) => Self::Unstable,
        }
    }

    /// Colour and width.
    pub fn look(self) -> (RGBColor, i32) {
        match self {
            Self::Stable => (BLUE, 4 * SCALE),
            Self::Unstable => (VERMILION, 2 * SCALE),
            Self::Unphysical => (GREY, SCALE),
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "admissible and stable",
            Self::Unstable => "admissible, unstable",
            Self::Unphysical => "a wall is touched earlier",
        }
    }
}

/// A point of a curve and the slope of the curve there.
type Knot = ([f64; 2], f64);

/// A stretch of a curve of one kind.
struct Stretch {
    kind: Kind,
    is_solid: bool,
    knots: Vec<Knot>,
}

/// Data from which the slopes of the curves are computed.
pub struct Slope {
    axis: Axis,
    gap: f64,
    restitution: f64,
    frequency: f64,
    speed: f64,
}

impl Slope {
    pub fn of(scene: &Scene, axis: Axis) -> Self {
        let (pair, number) = (scene.pair(), |x: &impact_pair::exact::Exact| middle(&x.enclose(64)));
        Self {
            axis,
            gap: number(pair.gap()),
            restitution: number(pair.restitution()),
            frequency: number(pair.excitation().reference().frequency()),
            speed: number(scene.start().velocity()).abs(),
        }
    }

    /// `dA_N/dW` or `dA_N/dv`, of `4 A^2 = a^2 + b^2` with `a = (1-e)|v|/W` and `b = d - (1+e) N pi |v|/(2 W)`.
    /// **Equations** (68), (72), (73)
    pub fn at(&self, cycles: u32, [at, amplitude]: [f64; 2]) -> f64 {
        let (frequency, speed) = match self.axis {
            Axis::Frequency => (at, self.speed),
            Axis::Velocity(_) => (self.frequency, at.abs()),
        };
        let (e, reach) = (self.restitution, (1.0 + self.restitution) * f64::from(cycles) * FRAC_PI_2);
        let (a, b) = ((1.0 - e) * speed / frequency, self.gap - reach * speed / frequency);
        let steepness = match self.axis {
            Axis::Frequency => (b * reach * speed / frequency - a * a) / frequency,
            Axis::Velocity(_) => (a * (1.0 - e) - b * reach) / frequency * at.signum(),
        };
        steepness / (4.0 * amplitude)
    }
}

/// The stretches of a curve.
fn stretches(curve: &Manifold, slope: &Slope) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = Vec::new();
    let mut is_open = false;
    for pair in curve.points.windows(2) {
        let ends = [&pair[0], &pair[1]].map(|point| {
            let place = [middle(&point.at), middle(&point.amplitude)];
            (place, slope.at(curve.cycles, place))
        });
        let Some(part) = pair[0].after else {
            is_open = false;
            continue;
        };
        let (kind, is_solid) = (Kind::of(part), part.is_solid);
        match all.last_mut().filter(|last| is_open && last.kind == kind && last.is_solid == is_solid) {
            Some(last) => last.knots.push(ends[1]),
            None => all.push(Stretch { kind, is_solid, knots: ends.to_vec() }),
        }
        is_open = true;
    }
    all
}

/// The curve as elements, mirrored if `is_mirrored`: on the other wall the curve is the same with `-v` (72).
pub fn elements(curve: &Manifold, slope: &Slope, plane: &Plane, is_mirrored: bool) -> String {
    let mirrored = |([at, amplitude], slope): Knot| {
        if is_mirrored { ([-at, amplitude], -slope) } else { ([at, amplitude], slope) }
    };
    let mut svg = String::new();
    for Stretch { kind, is_solid, knots } in stretches(curve, slope) {
        let mut path = Path::default();
        path.move_to(plane.place(mirrored(knots[0]).0));
        for pair in knots.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(mirrored);
            let run = b.0[0] - a.0[0];
            let end = |(place, slope): Knot| (plane.place(place), plane.pixel_displacement(place, [run, slope * run]));
            path.curve_to(hermite(end(a), end(b)));
        }
        let (colour, width) = kind.look();
        // Writing to a String cannot fail.
        let _ = writeln!(
            svg,
            "<path stroke=\"{}\" stroke-width=\"{width}\"{} d=\"{}\"/>",
            hex(colour),
            if is_solid { String::new() } else { dashes() },
            path.data()
        );
    }
    svg
}

/// The attribute of dashed lines.
fn dashes() -> String {
    format!(" stroke-dasharray=\"{} {}\"", 9 * SCALE, 5 * SCALE)
}

#[cfg(test)]
mod tests {
    use impact_pair::exact::Exact;
    use impact_pair::pair::Wall;
    use impact_pair::two_impact::Range;

    use super::*;
    use impact_pair::watch::Unwatched;

    fn scene(name: &str) -> Scene {
        let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        Scene::parse(&std::fs::read_to_string(path).unwrap()).unwrap()
    }

    #[test]
    fn cubics_between_points_are_near_the_enclosures_of_a_finer_grid() {
        let figures = [
            ("figure-10", Axis::Frequency, "2", "60"),
            ("figure-11", Axis::Velocity(Wall::Left), "-300", "-1"),
            ("figure-11", Axis::Velocity(Wall::Right), "1", "300"),
        ];
        for (name, axis, from, to) in figures {
            let scene = scene(name);
            let (slope, speed) = (Slope::of(&scene, axis), Exact::from(20));
            let range = |count: usize| Range {
                pair: scene.pair(),
                speed: speed.clone(),
                axis,
                from: Exact::parse(from).unwrap(),
                to: Exact::parse(to).unwrap(),
                count,
            };
            for cycles in [1, 3] {
                // The fine grid has a point halfway between two points of the coarse grid.
                let [coarse, fine] = [400, 799].map(|count| range(count).manifold(cycles, 12, &Unwatched).unwrap());
                let knots: Vec<Knot> =
                    stretches(&coarse, &slope).into_iter().flat_map(|stretch| stretch.knots).collect();
                let mut judged = 0;
                for point in &fine.points {
                    let at = middle(&point.at);
                    let Some(pair) = knots.windows(2).find(|pair| pair[0].0[0] < at && at < pair[1].0[0]) else {
                        continue;
                    };
                    let ([x0, y0], [x1, y1]) = (pair[0].0, pair[1].0);
                    let (t, run) = ((at - x0) / (x1 - x0), x1 - x0);
                    let [first, second, end] =
                        hermite(((x0, y0), (run, pair[0].1 * run)), ((x1, y1), (run, pair[1].1 * run)));
                    let s = 1.0 - t;
                    let y = s * s * s * y0 + 3.0 * s * s * t * first.1 + 3.0 * s * t * t * second.1 + t * t * t * end.1;
                    // 1/20 of a pixel of a plot of 20 in 500 pixels.
                    assert!((y - middle(&point.amplitude)).abs() < 2e-3, "{name} {cycles} {at}: {y}");
                    judged += 1;
                }
                assert!(judged > 300, "{name}: {judged}");
            }
        }
    }
}
