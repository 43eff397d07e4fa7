//! The points or cells of an atlas, as rectangles of the plane.

use anyhow::{Context, Result};
use impact_pair::exact::Exact;
use impact_pair::json::vocabulary::Class;
use impact_pair::json::{AtlasHead, AtlasRecord};
use impact_pair::scene::Range;
use plotters::style::RGBColor;

use crate::picture::{BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION, YELLOW};
use crate::sweep::value;
use impact_pair_answers::grid::{Head, Points};

/// The classes, with their colours and words, the strongest first. If none of the first three is proved, a stable periodic orbit
/// for all parameters of a cell, or a horseshoe, takes precedence.
pub const CLASSES: [(&str, RGBColor, &str); 7] = [
    ("one-rest-cycle", GREEN, "every motion that touches a wall ends in one cycle with rests"),
    ("one-attractor", BLUE, "every motion that touches a wall tends to one attractor, or stays at saddles or grazes"),
    ("attractors", SKY, "attractors proved, others not excluded"),
    (STABLE, PURPLE, "a stable periodic orbit, else undecided"),
    (HORSESHOE, YELLOW, "a horseshoe, else undecided"),
    ("closed", ORANGE, "every motion that touches a wall in closed sets or at saddles in the end, else undecided"),
    ("undecided", VERMILION, "undecided"),
];

/// The class drawn for a cell with a stable orbit, and for a point or cell with a horseshoe.
const STABLE: &str = "stable";
const HORSESHOE: &str = "horseshoe";

/// A point, with half a step around it, or a cell.
pub struct Leaf {
    /// Ends on both axes.
    pub ends: [[f64; 2]; 2],
    /// The class drawn for the point or cell, as a position in [`CLASSES`].
    pub class: usize,
    /// The proved results, without the parts of cells that are subdivided.
    pub record: AtlasRecord,
}

/// All points or cells, and the axes.
pub struct Leaves {
    pub axes: [Range; 2],
    pub all: Vec<Leaf>,
}

impl Leaves {
    /// Reads the points or cells of an atlas.
    ///
    /// # Errors
    /// Returns an error if the atlas cannot be read, or has an unknown class.
    pub fn of(atlas: &mut Points<AtlasHead>) -> Result<Self> {
        let head = atlas.head.clone();
        let plane = head.grid()?;
        let axes = [0, 1].map(|axis| plane.axes()[axis].clone());
        let half = axes.each_ref().map(|axis| {
            let steps = (axis.points() - 1) as f64;
            if head.cells { 0.0 } else { 0.5 * (value(axis.high()) - value(axis.low())) / steps }
        });
        let mut all = Vec::new();
        atlas.each_record(|record| {
            for leaf in record.leaves() {
                let class = CLASSES.iter().position(|(class, ..)| *class == shown(leaf));
                let class = class.with_context(|| format!("there is no class {}", leaf.class))?;
                let mut ends = [[0.0; 2]; 2];
                for (axis, text) in leaf.values.iter().take(2).enumerate() {
                    let (low, high) = interval(&Exact::parse(text)?);
                    ends[axis] = [low - half[axis], high + half[axis]];
                }
                all.push(Leaf { ends, class, record: leaf.clone() });
            }
            Ok(())
        })?;
        Ok(Self { axes, all })
    }

    /// The ends of the plane on both axes, with half a step around points.
    pub fn range(&self) -> [[f64; 2]; 2] {
        let own = self.axes.each_ref().map(|axis| [value(axis.low()), value(axis.high())]);
        self.all.iter().fold(own, |all, leaf| {
            [0, 1].map(|axis| [all[axis][0].min(leaf.ends[axis][0]), all[axis][1].max(leaf.ends[axis][1])])
        })
    }

    /// The classes that occur, each with its number of points or cells.
    pub fn counts(&self) -> Vec<(usize, usize)> {
        let of = |class: usize| (class, self.all.iter().filter(|leaf| leaf.class == class).count());
        (0..CLASSES.len()).map(of).filter(|(_, count)| *count > 0).collect()
    }
}

/// The class drawn for a point or a cell: its own class, or the stable orbit or horseshoe proved where its class says little.
fn shown(leaf: &AtlasRecord) -> String {
    match leaf.class {
        Class::Closed | Class::Undecided if !leaf.stable.is_empty() => STABLE.to_owned(),
        Class::Closed | Class::Undecided if leaf.entropy() > 0.0 => HORSESHOE.to_owned(),
        class => class.to_string(),
    }
}

/// Approximate ends of a number or an interval.
fn interval(x: &Exact) -> (f64, f64) {
    x.ends().map_or((value(x), value(x)), |(low, high)| (value(&low), value(&high)))
}
