//! Lines with no more corners than can be seen.

/// The corners that a line needs to stay within a pixel of the canvas (Ramer 1972, Douglas and Peucker 1973).
pub fn simplified(line: &[(i32, i32)]) -> Vec<(i32, i32)> {
    let Some(first) = line.first() else { return Vec::new() };
    let mut corners = vec![*first];
    // Parts still to be looked at, the leftmost on top.
    let mut parts = vec![(0, line.len() - 1)];
    while let Some((from, to)) = parts.pop() {
        let distances = (from + 1..to).map(|at| (at, distance(line[at], line[from], line[to])));
        match distances.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((at, farthest)) if farthest > 1.0 => parts.extend([(at, to), (from, at)]),
            _ => corners.push(line[to]),
        }
    }
    corners.dedup();
    corners
}

/// From a point to the line between two others.
fn distance(point: (i32, i32), from: (i32, i32), to: (i32, i32)) -> f64 {
    let part = |a: (i32, i32), b: (i32, i32)| (f64::from(b.0 - a.0), f64::from(b.1 - a.1));
    let ((x, y), (u, v)) = (part(from, point), part(from, to));
    let length = u * u + v * v;
    let along = if length > 0.0 { ((x * u + y * v) / length).clamp(0.0, 1.0) } else { 0.0 };
    // No hypot: what that rounds to depends on the machine.
    let (x, y) = (x - along * u, y - along * v);
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_stay_and_straight_parts_lose_theirs() {
        let line = [(0, 0), (10, 1), (20, 0), (30, 0), (30, 40), (30, 20), (30, 0)];
        assert_eq!(simplified(&line), [(0, 0), (30, 0), (30, 40), (30, 0)]);
        assert_eq!(simplified(&[(1, 1), (1, 1)]), [(1, 1)]);
        assert_eq!(simplified(&[(3, 4)]), [(3, 4)]);
        assert_eq!(simplified(&[]), []);
    }

    #[test]
    fn a_circle_is_kept_to_a_pixel() {
        let at = |k: i32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 1000.0).sin_cos();
            ((500.0 * cos).round() as i32, (500.0 * sin).round() as i32)
        };
        let circle: Vec<_> = (0..=1000).map(at).collect();
        let corners = simplified(&circle);
        assert!((20..200).contains(&corners.len()), "{}", corners.len());
        for &point in &circle {
            let nearest = corners.windows(2).map(|pair| distance(point, pair[0], pair[1])).fold(f64::MAX, f64::min);
            assert!(nearest <= 1.0, "{point:?}: {nearest}");
        }
    }
}
