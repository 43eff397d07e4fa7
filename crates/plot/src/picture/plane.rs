//! Conversion from numbers on two axes to pixels of a plot.

use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;

use super::{Axis, Canvas, FONT, Place, SCALE};

/// The pixels of a plot.
#[derive(Clone, Debug)]
pub struct Plane {
    /// The axes, across and up.
    pub axes: [Axis; 2],
    /// Left to right, bottom to top.
    pub pixels: [(i32, i32); 2],
}

impl Plane {
    /// Draws axes with the names `names` and a thin mesh into an area, with room `right` on their right.
    ///
    /// # Errors
    /// Returns an error if the axes cannot be drawn.
    pub fn draw(
        area: &Canvas<'_>,
        axes: [Axis; 2],
        names: [&str; 2],
        right: i32,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        axes.iter().try_for_each(Axis::require_resolved)?;
        let [x, y] = axes.clone();
        let mut chart = ChartBuilder::on(area)
            .margin(10 * SCALE)
            .margin_right(right)
            .x_label_area_size(48 * SCALE)
            .y_label_area_size(62 * SCALE)
            .build_cartesian_2d(x, y)?;
        let font = ("sans-serif", FONT);
        chart
            .configure_mesh()
            .x_desc(names[0])
            .y_desc(names[1])
            .label_style(font)
            .axis_desc_style(font)
            .bold_line_style(BLACK.mix(0.12).stroke_width(SCALE as u32))
            .max_light_lines(0)
            .set_all_tick_mark_size(5 * SCALE)
            .axis_style(BLACK.stroke_width(SCALE as u32))
            .draw()?;
        let (across, down) = chart.plotting_area().get_pixel_range();
        Ok(Self { axes, pixels: [(across.start, across.end - 1), (down.end - 1, down.start)] })
    }

    /// The pixel of a place, moved to the nearest edge if the place is outside.
    pub fn pixel(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let clamped = |axis: usize, value: f64| {
            let (from, to) = self.pixels[axis];
            self.axes[axis].map(&value, (from, to)).clamp(from.min(to), from.max(to))
        };
        (clamped(0, x), clamped(1, y))
    }

    /// The place in fractional pixels, which may lie outside.
    pub fn place(&self, place: [f64; 2]) -> Place {
        let at = |axis: usize| {
            let (from, to) = self.pixels[axis];
            f64::from(to - from).mul_add(self.axes[axis].part(place[axis]), f64::from(from))
        };
        (at(0), at(1))
    }

    /// The displacement in fractional pixels from `place` to `place + rate`.
    pub fn pixel_displacement(&self, place: [f64; 2], rate: [f64; 2]) -> Place {
        let (a, b) = (self.place(place), self.place([place[0] + rate[0], place[1] + rate[1]]));
        (b.0 - a.0, b.1 - a.1)
    }

    /// Elements clipped to the plot; lines on its edge are drawn whole.
    pub fn clipped(&self, elements: &str) -> String {
        let ((left, right), (bottom, top)) = (self.pixels[0], self.pixels[1]);
        let edge = 3 * SCALE;
        let (x, y, width, height) = (left - edge, top - edge, right - left + 2 * edge, bottom - top + 2 * edge);
        format!(
            "<clipPath id=\"plot-{left}-{top}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n\
             <g fill=\"none\" clip-path=\"url(#plot-{left}-{top})\">\n{elements}</g>"
        )
    }
}
