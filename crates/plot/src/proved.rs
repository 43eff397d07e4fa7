//! The bifurcation diagram of a parameter, in the colours of the results proved for each value, as SVG.

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::{Cells, RangeSettings, State, Verdict, seen_impacts};
use impact_pair::exact::Exact;
use plotters::prelude::*;

use crate::chaos::{PHASE_LABEL, parameters};
use crate::picture::{self, Arc, Axis, BLUE, Canvas, Element, GREY, LegendSymbol, Look, PURPLE, SCALE, SKY, VERMILION};
use crate::sweep::{Cells as Rectangles, Plane, described, value};

const SIZE: (u32, u32) = (960, 680);
/// Columns of the diagram, rows of the diagram, and the impacts of each column: how many are skipped and how many shown.
const COLUMNS: u32 = 600;
const ROWS: i32 = 260;
const IMPACTS: [usize; 2] = [600, 160];
/// Height of the bar above the diagram that shows the verdicts, and its distance from the diagram.
const BAR_HEIGHT: i32 = 14 * SCALE;
const BAR_DISTANCE: i32 = 4 * SCALE;

/// The entries of the legend, by kind of verdict, with their colours.
const LEGEND: [(&str, RGBColor); 5] = [
    ("proved: a horseshoe, positive entropy", VERMILION),
    ("proved: the scene's orbit converges to a periodic one", BLUE),
    ("proved: a stable periodic orbit exists", SKY),
    ("proved: a stable periodic orbit and a horseshoe", PURPLE),
    ("undecided", GREY),
];

fn kind(verdict: &Verdict) -> usize {
    match verdict {
        Verdict::Horseshoe(_) => 0,
        Verdict::Attracted { beside: None, .. } => 1,
        Verdict::Stable { beside: None, .. } => 2,
        Verdict::Attracted { .. } | Verdict::Stable { .. } => 3,
        Verdict::Undecided => 4,
    }
}

/// A column of the diagram: value of the parameter, kind of the proved result, and impacts of a floating-point orbit.
struct Column {
    at: f64,
    kind: usize,
    states: Vec<State>,
}

/// The diagram of floating-point orbits over the parameter, with a bar above, both in the colours of the proved results.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
pub fn cells(scene: &Scene, requested: &RangeSettings, found: &Cells, look: &Look) -> Result<String> {
    let columns: Vec<Column> =
        (0..COLUMNS).map(|number| column(scene, requested, found, number)).collect::<Result<_>>()?;
    let arc = Arc::holding(columns.iter().flat_map(|column| &column.states).map(|state| [state[0]; 2]));
    let of_kind = |number: usize| found.stretches.iter().filter(move |stretch| kind(&stretch.verdict) == number);
    let named: Vec<usize> = (0..LEGEND.len()).filter(|&number| of_kind(number).next().is_some()).collect();
    picture::svg(look.size(SIZE), SCALE, |root| {
        let plane = frame(scene, requested, (&named, arc), (root, look))?;
        let mut data = String::new();
        for (number, (_, colour)) in LEGEND.iter().enumerate() {
            let mut all = Rectangles::default();
            for stretch in of_kind(number) {
                let [left, right] = [&stretch.low, &stretch.high].map(|end| plane.column(value(end)));
                all.add((left, plane.pixels[1].0 - BAR_DISTANCE - BAR_HEIGHT), ((right - left).max(1), BAR_HEIGHT));
            }
            columns.iter().filter(|column| column.kind == number).for_each(|column| column.draw(arc, &plane, &mut all));
            data += &all.element(*colour);
        }
        Ok(root.draw(&Element(data))?)
    })
}

fn column(scene: &Scene, requested: &RangeSettings, found: &Cells, number: u32) -> Result<Column> {
    let (low, high) = (requested.over.low(), requested.over.high());
    let part = Exact::from(i64::from(2 * number + 1)).checked_div(&Exact::from(i64::from(2 * COLUMNS)))?;
    let exact = low.checked_add(&high.checked_sub(low)?.checked_mul(&part)?)?;
    let at = value(&exact);
    let stretch = found.stretches.iter().find(|stretch| at <= value(&stretch.high));
    let kind = stretch.map_or(LEGEND.len() - 1, |stretch| kind(&stretch.verdict));
    let states = seen_impacts(&scene.pair().with(requested.over.key(), exact)?, scene.start(), IMPACTS)?;
    Ok(Column { at, kind, states })
}

/// Draws title, fixed parameters and axes.
fn frame(
    scene: &Scene,
    requested: &RangeSettings,
    (named, arc): (&[usize], Arc),
    (root, look): (&Canvas<'_>, &Look),
) -> Result<Plane, Box<dyn std::error::Error>> {
    let over = described(requested.over.key());
    let title =
        format!("{}: what is proved over the {}", scene.title().unwrap_or("The impact map"), requested.over.key());
    let [transient, impacts] = IMPACTS;
    let bar = format!(
        "bar: proved for all values; below: impacts {} to {} of floating-point orbits, non-rigorous",
        transient + 1,
        transient + impacts
    );
    let lines = [parameters(scene, Some(&requested.over)), format!("{bar}; {}", picture::program())];
    let top = picture::caption(root, look, &title, &lines)?;
    let entries: Vec<(LegendSymbol, String)> =
        named.iter().map(|&number| (LegendSymbol::Cell(LEGEND[number].1), LEGEND[number].0.to_owned())).collect();
    let height = picture::legend(root, top, &entries)?;
    let (_, below) = root.split_vertically(top + height + BAR_DISTANCE + BAR_HEIGHT);
    let axes = [Axis::between(value(requested.over.low()), value(requested.over.high())), arc.axis()];
    Plane::draw(&below, axes, [&over, PHASE_LABEL])
}

impl Column {
    fn draw(&self, arc: Arc, plane: &Plane, all: &mut Rectangles) {
        let [across, down] = plane.size();
        let (width, height) = (across / COLUMNS as i32 + 1, (down + ROWS - 1) / ROWS);
        let row = |state: &State| (plane.pixels[1].1 - plane.row(arc.place(state[0]))) / height;
        let mut rows: Vec<i32> = self.states.iter().map(row).collect();
        rows.sort_unstable();
        rows.dedup();
        for run in rows.chunk_by(|a, b| a + 1 == *b) {
            let upper = plane.pixels[1].1 - height * (run[run.len() - 1] + 1);
            all.add((plane.column(self.at) - width / 2, upper), (width, height * run.len() as i32));
        }
    }
}
