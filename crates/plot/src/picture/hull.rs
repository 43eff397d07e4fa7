//! Convex hulls: the area swept between two successive boxes.

/// The corners of the convex hull of the points, in order around it (Andrew's monotone chain).
pub fn hull(mut points: Vec<(i32, i32)>) -> Vec<(i32, i32)> {
    points.sort_unstable();
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let chain = |points: &mut dyn Iterator<Item = (i32, i32)>| {
        let mut corners: Vec<(i32, i32)> = Vec::new();
        for point in points {
            while let [.., a, b] = corners[..]
                && turn(a, b, point) <= 0
            {
                corners.pop();
            }
            corners.push(point);
        }
        corners.pop();
        corners
    };
    let mut corners = chain(&mut points.iter().copied());
    corners.extend(chain(&mut points.iter().rev().copied()));
    corners
}

/// Twice the area of the triangle, positive if it turns left.
fn turn(a: (i32, i32), b: (i32, i32), c: (i32, i32)) -> i64 {
    let part = |a: i32, b: i32| i64::from(b) - i64::from(a);
    part(a.0, b.0) * part(a.1, c.1) - part(a.1, b.1) * part(a.0, c.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_two_boxes() {
        let points = vec![(0, 0), (2, 0), (2, 2), (0, 2), (5, 5), (7, 5), (7, 7), (5, 7), (1, 1), (6, 6)];
        assert_eq!(hull(points), [(0, 0), (2, 0), (7, 5), (7, 7), (5, 7), (0, 2)]);
        assert_eq!(hull(vec![(1, 1), (1, 1)]), [(1, 1)]);
        assert_eq!(hull(vec![(0, 0), (1, 1), (2, 2)]), [(0, 0), (2, 2)]);
    }
}
