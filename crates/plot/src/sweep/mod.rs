//! Sweeps as SVG: the bifurcation diagram over one key, the map of outcomes over two.
//!
//! Axes and text are drawn by plotters; the data, up to a million cells, are one path for each colour.

mod cells;
mod diagram;
mod kind;
mod legend;
mod map;

use std::error::Error as StdError;

use anyhow::Result;
use impact_pair::exact::Exact;
use impact_pair::json::{ExtendedBounds, SweepHead};
use impact_pair_answers::grid::{Head, Points};
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;

pub(crate) use self::cells::Cells;
pub use self::kind::Outcomes;
pub(crate) use self::legend::described;
use crate::picture::{self, Axis, Canvas, Element, FONT, Look, SCALE};

/// Size of the picture, in pixels.
const SIZE: (u32, u32) = (960, 680);

type Drawn<T> = Result<T, Box<dyn StdError>>;

/// The vertical axis of a diagram.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Show {
    /// W t + tau of each impact
    #[default]
    Phase,
    /// y' before each impact
    Velocity,
}

/// The picture as SVG: a diagram over one key, with all or a range of its vertical axis, or a map over two keys.
///
/// # Errors
/// Returns an error if the picture cannot be drawn, or the sweep cannot be read.
pub fn svg(sweep: &mut Points<SweepHead>, show: Show, within: Option<[f64; 2]>, look: &Look) -> Result<String> {
    let grid = sweep.head.grid()?;
    picture::svg(look.size(SIZE), SCALE, |root| {
        let data = match grid.axes() {
            [x] => diagram::draw(sweep, x, (show, within), (root, look))?,
            _ => map::draw(sweep, &grid, (root, look))?,
        };
        root.draw(&Element(data))?;
        Ok(())
    })
}

/// The pixels of a plot, across and down.
pub(crate) struct Plane {
    axes: [Axis; 2],
    pub pixels: [(i32, i32); 2],
}

impl Plane {
    /// Draws the axes, with the names `names`, into `area`.
    pub fn draw(area: &Canvas<'_>, axes: [Axis; 2], names: [&str; 2]) -> Drawn<Self> {
        axes.iter().try_for_each(Axis::require_resolved)?;
        let [x, y] = axes.clone();
        let mut chart = ChartBuilder::on(area)
            .margin(10 * SCALE)
            .margin_right(28 * SCALE)
            .x_label_area_size(48 * SCALE)
            .y_label_area_size(76 * SCALE)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc(names[0])
            .y_desc(names[1])
            .label_style(("sans-serif", FONT))
            .axis_desc_style(("sans-serif", FONT))
            .set_all_tick_mark_size(5 * SCALE)
            .axis_style(BLACK.stroke_width(SCALE as u32))
            .draw()?;
        let (across, down) = chart.plotting_area().get_pixel_range();
        Ok(Self { axes, pixels: [(across.start, across.end), (down.start, down.end)] })
    }

    /// Pixels across, and down.
    pub fn size(&self) -> [i32; 2] {
        self.pixels.map(|(from, to)| to - from)
    }

    /// Whether a part of the range from `low` to `high` is on the vertical axis.
    fn shows(&self, [low, high]: [f64; 2]) -> bool {
        let range = self.axes[1].range();
        low <= range.end && high >= range.start
    }

    /// The horizontal pixel of `x`.
    pub fn column(&self, x: f64) -> i32 {
        self.axes[0].map(&x, self.pixels[0])
    }

    /// The vertical pixel of `y`, moved inside the plot.
    pub fn row(&self, y: f64) -> i32 {
        let (top, bottom) = self.pixels[1];
        self.axes[1].map(&y, (bottom, top)).clamp(top, bottom)
    }
}

/// The middle of a pair of bounds.
fn middle(bounds: &ExtendedBounds) -> Result<f64> {
    let [low, high] = &**bounds;
    Ok(0.5 * (double(low)? + double(high)?))
}

/// Approximate value of a decimal.
fn double(text: &str) -> Result<f64> {
    Ok(text.parse()?)
}

/// Approximate value of an exact number.
pub(crate) fn value(x: &Exact) -> f64 {
    x.enclose(64).mid_rad().0
}
