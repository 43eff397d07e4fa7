//! Regions that the motion does not leave, and horseshoes: the reduced state space, as SVG.

use std::f64::consts::TAU;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{Asked, Cells, Chaos, State, Stretch, Trap, Verdict, seen_impacts};
use impact_pair::exact::Exact;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::picture::{self, BLUE, Canvas, Drawn, GREY, LETTER, SCALE, SKY, VERMILION, words};
use crate::sweep::{Cells as Rectangles, Plane, described};

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

/// Columns of the diagram, impacts that are passed over in each and impacts that are shown, and the rows of a turn.
const COLUMNS: u32 = 640;
const SHOWN: [usize; 2] = [600, 200];
const ROWS: f64 = 300.0;
/// Height of the bar that tells what is proved.
const BAR: i32 = 14 * SCALE;

fn colour(verdict: &Verdict) -> RGBColor {
    match verdict {
        Verdict::Horseshoe { .. } => VERMILION,
        Verdict::Attracted { .. } => BLUE,
        Verdict::Undecided => GREY,
    }
}

/// A bifurcation diagram of floating orbits over a parameter, and a bar, both in the colours of what is proved.
///
/// # Errors
/// When it cannot be drawn.
pub fn cells(scene: &Scene, asked: &Asked, found: &Cells) -> Result<String> {
    let value = |x: &Exact| x.enclose(64).mid_rad().0;
    let (low, high) = (value(&asked.over.low), value(&asked.over.high));
    let ends: Vec<[f64; 2]> = found.stretches.iter().map(|one| [value(&one.low), value(&one.high)]).collect();
    let mut dots: Vec<(f64, usize, Vec<State>)> = Vec::new();
    for column in 0..COLUMNS {
        let part = Exact::from(i64::from(2 * column + 1)).checked_div(&Exact::from(i64::from(2 * COLUMNS)))?;
        let at = asked.over.low.checked_add(&asked.over.high.checked_sub(&asked.over.low)?.checked_mul(&part)?)?;
        let x = value(&at);
        let stretch = ends.iter().position(|&[_, end]| x <= end).unwrap_or(ends.len().saturating_sub(1));
        dots.push((x, stretch, seen_impacts(&scene.pair().with(asked.over.key, at)?, scene.start(), SHOWN)?));
    }
    let title = format!("{}: what is proved over {}", scene.title().unwrap_or("scene"), described(asked.over.key));
    let legend = [
        ("proved: a horseshoe, positive entropy", VERMILION),
        ("proved: the scene's orbit converges to a periodic one", BLUE),
        ("undecided", GREY),
    ];
    let mut data = String::new();
    let mut svg = picture::svg(SIZE, SCALE, |root| {
        let style = words(FONT, &BLACK, HPos::Left);
        root.draw(&Text::new(title.clone(), (16 * SCALE, 18 * SCALE), words(FONT + 3 * SCALE, &BLACK, HPos::Left)))?;
        let mut left = 24 * SCALE;
        for (name, colour) in legend {
            let (y, half) = (44 * SCALE, 5 * SCALE);
            root.draw(&Rectangle::new([(left, y - half), (left + 2 * half, y + half)], colour.filled()))?;
            root.draw(&Text::new(name, (left + 3 * half, y), style.clone()))?;
            left += 5 * half + (name.len() as f64 * LETTER * f64::from(FONT)) as i32;
        }
        let (_, below) = root.split_vertically(58 * SCALE);
        let plane = Plane::draw(
            &below,
            [picture::Axis::over(low, high), picture::Axis::angle()],
            [&described(asked.over.key), "phase θ before the impact, mirrored to the left wall [rad]"],
        )?;
        for (_, fill) in &legend {
            let is_of = |stretch: &Stretch| colour(&stretch.verdict) == *fill;
            let (mut paths, (top, _)) = (Rectangles::default(), plane.pixels[1]);
            for (_, &[from, to]) in found.stretches.iter().zip(&ends).filter(|(stretch, _)| is_of(stretch)) {
                let (left, right) = (plane.column(from), plane.column(to));
                paths.add((left, top), ((right - left).max(1), BAR));
            }
            let [width, height] = plane.size();
            let (width, height) = (width / COLUMNS as i32 + 1, height / ROWS as i32 + 1);
            for (x, _, states) in dots.iter().filter(|(_, stretch, _)| is_of(&found.stretches[*stretch])) {
                let mut rows: Vec<i32> = states.iter().map(|state| (state[0] * ROWS) as i32).collect();
                rows.sort_unstable();
                rows.dedup();
                for run in rows.chunk_by(|a, b| a + 1 == *b) {
                    let upper = plane.row(TAU * f64::from(run[run.len() - 1] + 1) / ROWS);
                    paths.add((plane.column(*x) - width / 2, upper), (width, height * run.len() as i32));
                }
            }
            data += &paths.element(*fill);
        }
        Ok(())
    })?;
    picture::on_top(&mut svg, &data);
    Ok(svg)
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
