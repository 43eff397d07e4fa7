//! The bifurcation diagram of a parameter, in the colours of what is proved of each of its values, as SVG.

use std::f64::consts::TAU;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{Asked, Cells, State, Verdict, seen_impacts};
use impact_pair::exact::Exact;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::picture::{self, Axis, BLUE, Canvas, Drawn, Element, GREY, LETTER, SCALE, VERMILION, words};
use crate::sweep::{Cells as Rectangles, Plane, described};

const SIZE: (u32, u32) = (960, 680);
const FONT: i32 = 15 * SCALE;
/// Height of title and legend.
const CAPTION: i32 = 58 * SCALE;
/// Columns of the diagram, rows of a turn, and in each column the impacts that are passed over, and those that are shown.
const COLUMNS: u32 = 600;
const ROWS: f64 = 260.0;
const IMPACTS: [usize; 2] = [600, 160];
/// Height of the bar that tells what is proved.
const BAR: i32 = 14 * SCALE;

/// What is told, and in which colour.
const LEGEND: [(&str, RGBColor); 3] = [
    ("proved: a horseshoe, positive entropy", VERMILION),
    ("proved: the scene's orbit converges to a periodic one", BLUE),
    ("undecided", GREY),
];

fn kind(verdict: &Verdict) -> usize {
    match verdict {
        Verdict::Horseshoe { .. } => 0,
        Verdict::Attracted { .. } => 1,
        Verdict::Undecided => 2,
    }
}

fn value(x: &Exact) -> f64 {
    x.enclose(64).mid_rad().0
}

/// A column of the diagram: where it is, what is proved there, and the impacts of a floating orbit.
struct Column {
    at: f64,
    kind: usize,
    states: Vec<State>,
}

/// The diagram of floating orbits over the parameter, and above it a bar, both in the colours of what is proved.
///
/// # Errors
/// When it cannot be drawn.
pub fn cells(scene: &Scene, asked: &Asked, found: &Cells) -> Result<String> {
    let columns: Vec<Column> = (0..COLUMNS).map(|number| column(scene, asked, found, number)).collect::<Result<_>>()?;
    picture::svg(SIZE, SCALE, |root| {
        let plane = frame(scene, asked, root)?;
        let mut data = String::new();
        for (number, (_, colour)) in LEGEND.iter().enumerate() {
            let mut all = Rectangles::default();
            let stretches = found.stretches.iter().filter(|stretch| kind(&stretch.verdict) == number);
            for stretch in stretches {
                let [left, right] = [&stretch.low, &stretch.high].map(|end| plane.column(value(end)));
                all.add((left, plane.pixels[1].0), ((right - left).max(1), BAR));
            }
            columns.iter().filter(|column| column.kind == number).for_each(|column| column.draw(&plane, &mut all));
            data += &all.element(*colour);
        }
        Ok(root.draw(&Element(data))?)
    })
}

fn column(scene: &Scene, asked: &Asked, found: &Cells, number: u32) -> Result<Column> {
    let (low, high) = (&asked.over.low, &asked.over.high);
    let part = Exact::from(i64::from(2 * number + 1)).checked_div(&Exact::from(i64::from(2 * COLUMNS)))?;
    let exact = low.checked_add(&high.checked_sub(low)?.checked_mul(&part)?)?;
    let at = value(&exact);
    let stretch = found.stretches.iter().find(|stretch| at <= value(&stretch.high));
    let kind = stretch.map_or(LEGEND.len() - 1, |stretch| kind(&stretch.verdict));
    let states = seen_impacts(&scene.pair().with(asked.over.key, exact)?, scene.start(), IMPACTS)?;
    Ok(Column { at, kind, states })
}

/// Title, legend and axes.
fn frame(scene: &Scene, asked: &Asked, root: &Canvas<'_>) -> Result<Plane, Box<dyn std::error::Error>> {
    let over = described(asked.over.key);
    let title = format!("{}: what is proved over the {over}", scene.title().unwrap_or("scene"));
    root.draw(&Text::new(title, (16 * SCALE, 18 * SCALE), words(FONT + 3 * SCALE, &BLACK, HPos::Left)))?;
    legend(root)?;
    let (_, below) = root.split_vertically(CAPTION);
    let axes = [Axis::over(value(&asked.over.low), value(&asked.over.high)), Axis::angle()];
    Plane::draw(&below, axes, [&over, "phase θ before the impact, mirrored to the left wall [rad]"])
}

fn legend(root: &Canvas<'_>) -> Drawn {
    let mut left = 24 * SCALE;
    for (name, colour) in LEGEND {
        let (y, half) = (44 * SCALE, 5 * SCALE);
        root.draw(&Rectangle::new([(left, y - half), (left + 2 * half, y + half)], colour.filled()))?;
        root.draw(&Text::new(name, (left + 3 * half, y), words(FONT, &BLACK, HPos::Left)))?;
        left += 6 * half + (name.len() as f64 * LETTER * f64::from(FONT)) as i32;
    }
    Ok(())
}

impl Column {
    fn draw(&self, plane: &Plane, all: &mut Rectangles) {
        let [across, down] = plane.size();
        let (width, height) = (across / COLUMNS as i32 + 1, (f64::from(down) / ROWS).ceil() as i32);
        let mut rows: Vec<i32> = self.states.iter().map(|state| (state[0] * ROWS) as i32).collect();
        rows.sort_unstable();
        rows.dedup();
        for run in rows.chunk_by(|a, b| a + 1 == *b) {
            let upper = plane.row(TAU * f64::from(run[run.len() - 1] + 1) / ROWS);
            all.add((plane.column(self.at) - width / 2, upper), (width, height * run.len() as i32));
        }
    }
}
