//! Curves as SVG paths: lines and cubic Bézier segments, in tenths of a pixel of the canvas.

use std::fmt::Write;

/// A place on the canvas.
pub type Place = (f64, f64);
/// Units of a path for each pixel of the canvas.
const UNITS_PER_PIXEL: f64 = 10.0;
/// Greatest distance of a control point from the chord for a curve drawn as a straight line: 1/20 of a pixel of the picture.
const STRAIGHTNESS: f64 = 0.2;

/// Two cubic Bézier control points and the end of a segment that begins at `from`: the cubic with these places and, per length of the
/// segment, these rates at its ends (Hermite).
///
/// A motion `f` over a time `h` differs from the cubic by at most `h^4/384 max |f''''|`. The motion has `f'''' = A W^4 sin` (11), so
/// over 1/24 of a forcing period the error of the displacement is less than `A/80,000`, of the velocity less than
/// `A W/80,000`; with several harmonics less than the sum of these bounds, since W is the greatest frequency.
pub fn hermite((from, start): (Place, Place), (to, end): (Place, Place)) -> [Place; 3] {
    let along = |place: Place, rate: Place, part: f64| (rate.0.mul_add(part, place.0), rate.1.mul_add(part, place.1));
    [along(from, start, 1.0 / 3.0), along(to, end, -1.0 / 3.0), to]
}

/// The data of a path.
#[derive(Clone, Debug, Default)]
pub struct Path {
    data: String,
    /// Last point of the path, in tenths of a pixel of the canvas: differences of these integers do not accumulate rounding errors.
    at: (i64, i64),
}

fn tenths((x, y): Place) -> (i64, i64) {
    ((x * UNITS_PER_PIXEL).round() as i64, (y * UNITS_PER_PIXEL).round() as i64)
}

impl Path {
    /// Begins a new part.
    pub fn move_to(&mut self, place: Place) {
        let at = tenths(place);
        self.write('M', &[(at.0, at.1)]);
        self.at = at;
    }

    /// A straight part.
    pub fn line_to(&mut self, place: Place) {
        let to = tenths(place);
        if to != self.at {
            self.write('l', &[self.offset_to(to)]);
            self.at = to;
        }
    }

    /// A Bézier segment, or a straight line where the difference is not visible.
    pub fn curve_to(&mut self, [first, second, end]: [Place; 3]) {
        let from = (self.at.0 as f64 / UNITS_PER_PIXEL, self.at.1 as f64 / UNITS_PER_PIXEL);
        let is_straight = [first, second].iter().all(|control| off_chord(*control, from, end) < STRAIGHTNESS);
        if is_straight {
            return self.line_to(end);
        }
        let places = [first, second, end].map(tenths);
        self.write('c', &places.map(|place| self.offset_to(place)));
        self.at = places[2];
    }

    fn offset_to(&self, (x, y): (i64, i64)) -> (i64, i64) {
        (x.saturating_sub(self.at.0), y.saturating_sub(self.at.1))
    }

    fn write(&mut self, command: char, places: &[(i64, i64)]) {
        self.data.push(command);
        let mut is_first = true;
        for number in places.iter().flat_map(|place| [place.0, place.1]) {
            if !is_first && number >= 0 {
                self.data.push(' ');
            }
            is_first = false;
            let (sign, whole, part) =
                (if number < 0 { "-" } else { "" }, number.unsigned_abs() / 10, number.unsigned_abs() % 10);
            // Writing to a String cannot fail.
            let _ = match part {
                0 => write!(self.data, "{sign}{whole}"),
                _ => write!(self.data, "{sign}{whole}.{part}"),
            };
        }
    }

    /// The data of the attribute `d` of an SVG path.
    pub fn data(&self) -> &str {
        &self.data
    }
}

/// The distance of a place from the chord between two others.
fn off_chord((x, y): Place, (x0, y0): Place, (x1, y1): Place) -> f64 {
    let (u, v) = (x1 - x0, y1 - y0);
    let length = u * u + v * v;
    let along = if length > 0.0 { (((x - x0) * u + (y - y0) * v) / length).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (x - x0 - along * u, y - y0 - along * v);
    // No hypot: its rounding depends on the machine.
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_its_own_curve_and_a_chord_is_a_line() {
        // t, t^3 over [0, 1]
        let [first, second, end] = hermite(((0.0, 0.0), (1.0, 0.0)), ((1.0, 1.0), (1.0, 3.0)));
        for t in [0.25f64, 0.5, 0.9] {
            let s = 1.0 - t;
            let at = |a: f64, b: f64, c: f64| 3.0 * s * s * t * a + 3.0 * s * t * t * b + t * t * t * c;
            let y = at(first.1, second.1, end.1);
            assert!((y - t * t * t).abs() < 1e-15 && (at(first.0, second.0, end.0) - t).abs() < 1e-15);
        }
        let mut path = Path::default();
        path.move_to((0.0, 100.0));
        path.curve_to([(10.0, 100.0), (20.0, 100.1), (30.0, 100.0)]);
        path.line_to((30.04, 100.0));
        path.curve_to([(40.0, 100.0), (60.26, 80.0), (60.0, 50.5)]);
        assert_eq!(path.data(), "M0 100l30 0c10 0 30.3-20 30-49.5");
        // Rounding does not add up along a path.
        let mut path = Path::default();
        path.move_to((0.0, 0.0));
        (1..=1000).for_each(|k| path.line_to((f64::from(k) * 1.03, f64::from(k) * -0.97)));
        let numbers = path.data().replace('-', " -").replace(['M', 'l'], " ");
        let numbers: Vec<f64> = numbers.split_whitespace().map(|number| number.parse().unwrap()).collect();
        let sum = |from: usize| numbers.iter().skip(from).step_by(2).sum::<f64>();
        assert!((sum(0) - 1030.0).abs() < 0.1 && (sum(1) + 970.0).abs() < 0.1, "{} {}", sum(0), sum(1));
    }
}
