//! A window of the picture, magnified where it covers least.

use plotters::coord::ranged1d::Ranged;

use crate::picture::{Place, Plane, SCALE};

/// The size of the inset, in parts of the plot, and the room of its labels in pixels.
const PART: f64 = 0.42;
const LABELS: (i32, i32) = (52 * SCALE, 34 * SCALE);
/// Places that are tried, across and down.
const TRIED: i32 = 12;
const MARGIN: i32 = 14 * SCALE;

/// What is magnified: from where to where, on both axes.
pub type Window = [[f64; 2]; 2];

/// A rectangle in pixels.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

impl Area {
    fn holds(&self, (x, y): Place) -> bool {
        let inside = |low: i32, x: f64, high: i32| f64::from(low) <= x && x <= f64::from(high);
        inside(self.left, x, self.right) && inside(self.top, y, self.bottom)
    }
}

/// The window on the plot.
pub fn window(plane: &Plane, [across, up]: Window) -> Area {
    let ((left, bottom), (right, top)) = (plane.pixel([across[0], up[0]]), plane.pixel([across[1], up[1]]));
    Area { left, top, right, bottom }
}

/// Where the inset, labels among it, covers the fewest of these places; the topmost one of several.
pub fn place(plane: &Plane, window: Area, covered: &[Place]) -> Area {
    let ((left, right), (bottom, top)) = (plane.pixels[0], plane.pixels[1]);
    let size = |length: i32| (PART * f64::from(length)) as i32;
    let (width, height) = (size(right - left) + LABELS.0, size(bottom - top) + LABELS.1);
    let mut best: Option<(usize, Area)> = None;
    for step in 0..TRIED * TRIED {
        let part = |room: i32, k: i32| MARGIN + (room - 2 * MARGIN).max(0) * k / (TRIED - 1);
        let (x, y) = (left + part(right - left - width, step % TRIED), top + part(bottom - top - height, step / TRIED));
        let area = Area { left: x, top: y, right: x + width, bottom: y + height };
        let corners = [(window.left, window.top), (window.right, window.bottom)];
        let own = corners.iter().filter(|(x, y)| area.holds((f64::from(*x), f64::from(*y)))).count();
        let count = covered.iter().filter(|place| area.holds(**place)).count() + covered.len() * own;
        if best.is_none_or(|(fewest, _)| count < fewest) {
            best = Some((count, area));
        }
    }
    best.map_or(window, |(_, area)| area)
}

/// Whether a place is on the axes.
pub fn is_inside(plane: &Plane, place: [f64; 2]) -> bool {
    (0..2).all(|axis| plane.axes[axis].range().contains(&place[axis]))
}
