//! Placement of labels beside their markers such that they cover nothing.

/// A rectangle in pixels: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Area {
    /// The square around a marker.
    pub fn around((x, y): (f64, f64), half: f64) -> Self {
        Self { left: x - half, top: y - half, right: x + half, bottom: y + half }
    }

    fn meets(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    fn holds(&self, other: &Self) -> bool {
        self.left <= other.left && other.right <= self.right && self.top <= other.top && other.bottom <= self.bottom
    }

    /// The point of the rectangle nearest to `point`.
    pub fn nearest(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x.clamp(self.left, self.right), y.clamp(self.top, self.bottom))
    }

    fn distance(&self, (x, y): (f64, f64)) -> f64 {
        let near = self.nearest((x, y));
        (near.0 - x).hypot(near.1 - y)
    }

    /// Whether the line between two points passes through the rectangle, tested in steps of a pixel.
    fn is_crossed(&self, (x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> bool {
        let steps = (x1 - x0).hypot(y1 - y0).ceil().max(1.0) as u32;
        (0..=steps).any(|step| {
            let part = f64::from(step) / f64::from(steps);
            let (x, y) = (x0 + part * (x1 - x0), y0 + part * (y1 - y0));
            self.left < x && x < self.right && self.top < y && y < self.bottom
        })
    }
}

/// A label to place: its marker and its size.
#[derive(Clone, Copy, Debug)]
pub struct Label {
    pub marker: (f64, f64),
    pub width: f64,
    pub height: f64,
}

/// Half the width of a marker.
pub const HALF_MARKER: f64 = 7.0;
/// Distances of a label from its marker, tried in this order.
const DISTANCES: [f64; 9] = [10.0, 16.0, 24.0, 34.0, 46.0, 60.0, 76.0, 94.0, 114.0];
/// Directions tried at each distance, in sixteenths of a full angle from the right: beside first, then above and below.
const DIRECTIONS: [i32; 16] = [0, 8, 1, -1, 2, -2, 4, -4, 3, -3, 5, -5, 6, -6, 7, -7];
/// Least ratio of a label's distances from another marker and from its own marker.
const MIN_DISTANCE_RATIO: f64 = 1.3;
/// Distance above which a line leads from the marker to the label.
pub const LEADER_DISTANCE: f64 = 14.0;

/// Places the labels one after another within `frame`. Best is a place that covers nothing, where no line crosses anything
/// and no other marker is nearer; else a place that covers nothing;
/// else the place to the right of the marker.
pub fn place(labels: &[Label], frame: &Area) -> Vec<Area> {
    let markers: Vec<Area> = labels.iter().map(|label| Area::around(label.marker, HALF_MARKER)).collect();
    let mut placed: Vec<Area> = Vec::new();
    for (label, marker) in labels.iter().zip(&markers) {
        let is_free = |area: &&Area| frame.holds(area) && !markers.iter().chain(&placed).any(|taken| taken.meets(area));
        let is_clear = |area: &&Area| {
            let foot = area.nearest(label.marker);
            // Overlapping markers cannot be distinguished anyway.
            let others = || labels.iter().zip(&markers).filter(|(_, other)| !other.meets(marker));
            let is_nearest = others()
                .all(|(other, _)| area.distance(other.marker) > MIN_DISTANCE_RATIO * area.distance(label.marker));
            let mut leaders = placed.iter().zip(labels).map(|(area, label)| (label.marker, area.nearest(label.marker)));
            let others = others().map(|(_, other)| other);
            is_nearest
                && !others.chain(&placed).any(|taken| taken.is_crossed(label.marker, foot))
                && !leaders.any(|(from, to)| area.is_crossed(from, to))
        };
        let around = DISTANCES.iter().flat_map(|&distance| DIRECTIONS.map(|turn| candidate(label, distance, turn)));
        let candidates: Vec<Area> = around.collect();
        let free = || candidates.iter().filter(is_free);
        let area = free().find(is_clear).or_else(|| free().next()).unwrap_or(&candidates[0]);
        placed.push(*area);
    }
    placed
}

/// The label at `distance` in the direction `turn`; the middle of a side or a corner is nearest to the marker.
fn candidate(label: &Label, distance: f64, turn: i32) -> Area {
    let (sin, cos) = (f64::from(turn) * std::f64::consts::TAU / 16.0).sin_cos();
    let (x, y) = (label.marker.0 + distance * cos, label.marker.1 - distance * sin);
    // The fraction of the label that lies beyond the point, to the right and upwards.
    let side = |towards: f64| if towards.abs() < 0.2 { 0.5 } else { f64::from(towards > 0.0) };
    let (left, bottom) = (x - (1.0 - side(cos)) * label.width, y + (1.0 - side(sin)) * label.height);
    Area { left, top: bottom - label.height, right: left + label.width, bottom }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_a_cluster_cover_nothing() {
        let frame = Area { left: 0.0, top: 0.0, right: 800.0, bottom: 500.0 };
        let markers = [
            (20.0, 300.0),
            (24.0, 301.0),
            (30.0, 290.0),
            (30.0, 290.0),
            (30.0, 290.0),
            (60.0, 295.0),
            (64.0, 310.0),
            (780.0, 300.0),
        ];
        let labels = markers.map(|marker| Label { marker, width: 90.0, height: 14.0 });
        let placed = place(&labels, &frame);
        for (i, area) in placed.iter().enumerate() {
            assert!(frame.holds(area), "{area:?}");
            assert!(placed[..i].iter().all(|other| !other.meets(area)), "{i} {placed:?}");
            assert!(!markers.iter().any(|&marker| Area::around(marker, HALF_MARKER).meets(area)), "{i} {placed:?}");
        }
    }

    #[test]
    fn a_single_label_is_on_the_right_of_its_marker() {
        let frame = Area { left: 0.0, top: 0.0, right: 200.0, bottom: 100.0 };
        let label = Label { marker: (50.0, 50.0), width: 40.0, height: 14.0 };
        assert_eq!(place(&[label], &frame), [Area { left: 60.0, top: 43.0, right: 100.0, bottom: 57.0 }]);
    }
}
