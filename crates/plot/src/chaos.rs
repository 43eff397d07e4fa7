//! Regions that the motion does not leave, and horseshoes: the reduced state space, as SVG.

use std::f64::consts::TAU;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{Chaos, State, Trap};
use plotters::prelude::*;

use crate::picture::{self, BLUE, Canvas, Drawn, GREY, SCALE, SKY, VERMILION};

const SIZE: (u32, u32) = (900, 640);
const FONT: i32 = 15 * SCALE;

/// What is drawn: filled quadrilaterals, curves, dots.
struct Layers {
    boxes: Vec<[State; 2]>,
    dots: Vec<State>,
    curves: Vec<Vec<State>>,
    outlines: Vec<Vec<State>>,
    caption: String,
}

/// The boxes of a region.
///
/// # Errors
/// When it cannot be drawn.
pub fn trap(scene: &Scene, region: &Trap) -> Result<String> {
    let (columns, rows) = region.grid();
    let place = |column: i32, row: i32| [f64::from(column) / columns as f64, f64::from(row) / rows];
    let runs = region.columns().into_iter().flat_map(|(column, runs)| runs.into_iter().map(move |run| (column, run)));
    let boxes = runs.map(|(column, (first, last))| [place(column, first), place(column + 1, last + 1)]).collect();
    let caption = format!("a region that no motion leaves: {} boxes", region.boxes());
    draw(scene, Layers { boxes, dots: Vec::new(), curves: Vec::new(), outlines: Vec::new(), caption })
}

/// The floating orbit in grey, the bases and the first tubes.
///
/// # Errors
/// When it cannot be drawn.
pub fn chaos(scene: &Scene, found: &Chaos) -> Result<String> {
    let outlines = found
        .bases()
        .iter()
        .map(|base| vec![base.left.bottom, base.right.bottom, base.right.top, base.left.top, base.left.bottom]);
    let dots = found.attractor().iter().take(20_000).copied().collect();
    let caption = format!(
        "{} words from {} bases (outlined), their first images (blue), a floating orbit (grey)",
        found.words().len(),
        found.bases().len()
    );
    draw(
        scene,
        Layers { boxes: Vec::new(), dots, curves: found.tubes().to_vec(), outlines: outlines.collect(), caption },
    )
}

/// Pieces of a curve with phases in one turn.
fn pieces(curve: &[State]) -> Vec<Vec<State>> {
    let mut pieces: Vec<Vec<State>> = Vec::new();
    for pair in curve.windows(2) {
        let whole = pair[0][0].floor();
        let [from, to] = [pair[0], pair[1]].map(|[phase, speed]| [phase - whole, speed]);
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

fn draw(scene: &Scene, layers: Layers) -> Result<String> {
    picture::svg(SIZE, SCALE, |root| layers.draw(scene, root))
}

impl Layers {
    fn draw(&self, scene: &Scene, root: &Canvas<'_>) -> Drawn {
        let font = ("sans-serif", FONT);
        let title = format!("{}: {}", scene.title().unwrap_or("scene"), self.caption);
        let root = root.margin(8 * SCALE, 0, 0, 0).titled(&title, font)?;
        let corners = self.boxes.iter().flatten();
        let highest =
            corners.chain(&self.dots).chain(self.outlines.iter().flatten()).fold(0.0, |most: f64, at| most.max(at[1]));
        let mut chart = ChartBuilder::on(&root)
            .margin(10 * SCALE)
            .margin_right(30 * SCALE)
            .x_label_area_size(48 * SCALE)
            .y_label_area_size(62 * SCALE)
            .build_cartesian_2d(picture::Axis::over(0.0, TAU), picture::Axis::over(0.0, 1.05 * highest))?;
        chart
            .configure_mesh()
            .x_desc("phase θ before the impact, mirrored to the left wall [rad]")
            .y_desc("speed before the impact / (AΩ)")
            .label_style(font)
            .axis_desc_style(font)
            .bold_line_style(BLACK.mix(0.12).stroke_width(SCALE as u32))
            .max_light_lines(0)
            .set_all_tick_mark_size(5 * SCALE)
            .axis_style(BLACK.stroke_width(SCALE as u32))
            .draw()?;
        let place = |[phase, speed]: State| (TAU * phase, speed);
        let fill = |[low, high]: &[State; 2]| Rectangle::new([place(*low), place(*high)], SKY.filled());
        chart.draw_series(self.boxes.iter().map(fill))?;
        let dot = |&state: &State| Circle::new(place(state), SCALE / 2, GREY.filled());
        chart.draw_series(self.dots.iter().map(dot))?;
        for piece in self.curves.iter().flat_map(|curve| pieces(curve)) {
            chart.draw_series(LineSeries::new(piece.into_iter().map(place), BLUE.stroke_width(SCALE as u32)))?;
        }
        for outline in &self.outlines {
            let line = outline.iter().copied().map(place);
            chart.draw_series(LineSeries::new(line, VERMILION.stroke_width(2 * SCALE as u32)))?;
        }
        Ok(())
    }
}
