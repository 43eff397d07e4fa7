//! `two-impact`: motions with two impacts in N cycles, and the parameter manifolds of figures 10 and 11.

mod csv;
mod table;

use std::ops::RangeInclusive;

use anyhow::Result;
use clap::{Args, ValueEnum};
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::json::one_a_line;
use impact_pair::orbit::Settings;
use impact_pair::pair::Wall;
use impact_pair::scene::{Key, Range as ParameterRange};
use impact_pair::two_impact::{Answer as Motions, Axis, COUNTS, CYCLES, Manifold, Problem, Range, Unknown, speed};
use impact_pair::watch::Watch;

use crate::values::{digits, numbers};
use crate::{Answer, Asked, Counts, Failure, Format, Picture, Status, Verb};

/// Options of `two-impact`.
#[derive(Args, Clone, Debug)]
pub struct TwoImpactOptions {
    /// N, or a range such as 1..5, endpoints included
    #[arg(long, value_name = "N|LO..HI", default_value = "1", value_parser = numbers(CYCLES), allow_hyphen_values = true)]
    pub cycles: RangeInclusive<u32>,
    /// The wall whose impact is listed first
    #[arg(long, value_enum, default_value_t)]
    pub wall: Side,
    /// Which of |v|, A and d to compute from the other two
    #[arg(long, value_enum, default_value_t, value_name = "velocity|amplitude|gap", conflicts_with = "manifold")]
    pub solve_for: SolveFor,
    /// A_N over a range: frequency=LO..HI:COUNT (figure 10) or velocity=LO..HI:COUNT (figure 11)
    #[arg(long, value_name = "KEY=LO..HI:COUNT", value_parser = manifold, allow_hyphen_values = true)]
    pub manifold: Option<ParameterRange>,
    /// Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of the
    /// scene, or 9]
    #[arg(long, value_name = "D", value_parser = digits())]
    pub digits: Option<u32>,
}

/// A wall as an option.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Side {
    /// S-
    #[default]
    Left,
    /// S+
    Right,
}

/// The unknown of |v|, A and d, computed from the other two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum SolveFor {
    /// The motion, with its |v|, from A and d
    #[default]
    Velocity,
    /// A_N (68), from d and the start's velocity
    Amplitude,
    /// d (67), from A and the start's velocity
    Gap,
}

/// Reads the range of a parameter manifold.
fn manifold(text: &str) -> Result<ParameterRange, impact_pair::Error> {
    let (least, most) = (COUNTS.start(), COUNTS.end());
    let accepted = format!(
        "frequency=LO..HI:COUNT or velocity=LO..HI:COUNT with numbers LO < HI and COUNT from {least} to {most}"
    );
    let is_accepted = |range: &ParameterRange| {
        let is_counted = range.count().is_some_and(|count| (*least as u64..=*most as u64).contains(&count));
        is_counted && matches!(range.key(), Key::Frequency(None) | Key::StartVelocity)
    };
    // The velocity is that of the start.
    match text.strip_prefix("velocity") {
        Some(rest) => ParameterRange::parse(&format!("start.velocity{rest}"), &accepted, is_accepted),
        None => ParameterRange::parse(text, &accepted, is_accepted),
    }
}

/// Motions with two impacts, or parameter manifolds.
pub enum TwoImpact<'s> {
    /// The motions in each number of cycles.
    Motions {
        /// Scene of the motions.
        scene: &'s Scene,
        /// What is solved for.
        unknown: Unknown,
        /// Wall whose impact is listed first.
        wall: Wall,
        /// The answer for each number of cycles, as far as the computation came.
        motions: Vec<Motions>,
        /// True if there are answers for all of them.
        is_whole: bool,
        /// True if the watch stopped it.
        is_stopped: bool,
    },
    /// The parameter manifold of each number of cycles.
    Manifolds {
        /// Scene of the manifolds.
        scene: &'s Scene,
        /// Range of the parameter.
        range: Range<'s>,
        /// The manifolds.
        curves: Vec<Manifold>,
        /// True if the watch stopped it.
        is_stopped: bool,
    },
}

impl Verb for TwoImpactOptions {
    const NAME: &'static str = "two-impact";
    const FORMATS: &'static [(Format, &'static str)] = &[
        (Format::Table, "Human-readable; for a parameter manifold the points where something changes"),
        (
            Format::Json,
            "Schema impact-pair/periodic/1, a list of documents for a range of N; for a parameter manifold impact-pair/manifold/1",
        ),
        (Format::Csv, "For a parameter manifold: one point per line, bounds in columns"),
    ];
    const SCHEMA: &'static str = "";
    const PICTURE: &'static str = "Draw the parameter manifold";
    type Answer<'s> = TwoImpact<'s>;

    fn counts(&self, _: &Scene) -> Counts {
        Counts::Nothing(match self.manifold {
            Some(_) => "computing parameter manifolds",
            None => "isolating motions",
        })
    }

    fn refuses(&self, format: Format) -> Option<&'static str> {
        let is_csv = self.manifold.is_none() && format == Format::Csv;
        is_csv.then_some("accepted without --manifold are table and json")
    }

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<TwoImpact<'s>, Failure> {
        let digits = self.digits.or(scene.run().digits).unwrap_or(Settings::default().digits);
        let cycles = self.cycles.clone();
        let wall = match self.wall {
            Side::Left => Wall::Left,
            Side::Right => Wall::Right,
        };
        if let Some(over) = &self.manifold {
            let (axis, speed) = match over.key() {
                Key::StartVelocity => (Axis::Velocity(wall), Exact::from(0)), // the speed is what varies
                _ => (Axis::Frequency, speed(scene)?),
            };
            let (from, to, count) = (over.low().clone(), over.high().clone(), over.points() as usize);
            let range = Range { pair: scene.pair(), speed, axis, from, to, count };
            let (curves, went_on) = range.manifolds(cycles, digits, watch)?;
            return Ok(TwoImpact::Manifolds { scene, range, curves, is_stopped: !went_on });
        }
        let unknown = match self.solve_for {
            SolveFor::Velocity => Unknown::Velocity,
            SolveFor::Amplitude => Unknown::Amplitude(speed(scene)?),
            SolveFor::Gap => Unknown::Gap(speed(scene)?),
        };
        let mut motions = Vec::new();
        for cycles in cycles.clone() {
            if !motions.is_empty() && !watch.goes_on() {
                break;
            }
            motions.push(Problem::new(scene.pair(), cycles, unknown.clone())?.answer_within(digits, watch));
        }
        let is_whole = motions.len() == cycles.count();
        Ok(TwoImpact::Motions { scene, unknown, wall, motions, is_whole, is_stopped: !watch.goes_on() })
    }
}

impl Answer for TwoImpact<'_> {
    fn status(&self) -> Status {
        match self {
            Self::Manifolds { is_stopped: true, .. } => {
                Status::new(false, "interrupted: the points written are proved, others are missing")
            }
            Self::Motions { motions, is_whole, is_stopped, .. } => {
                match (*is_whole && motions.iter().all(|motions| motions.is_complete), is_stopped) {
                    (true, _) => Status::new(true, "certified"),
                    (false, true) => {
                        Status::new(false, "interrupted: the motions written are proved, others are missing")
                    }
                    (false, false) => {
                        let where_open = "see what is undecided or null in the output";
                        Status::new(false, format!("not everything requested is decided: {where_open}"))
                    }
                }
            }
            Self::Manifolds { is_stopped: false, .. } => Status::new(true, "certified"),
        }
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(match (self, format) {
            (Self::Motions { scene, wall, motions, .. }, Format::Json) => {
                let text = |motions: &Motions| one_a_line(&motions.document(scene.start(), *wall), &["orbits"]);
                let documents: Vec<String> = motions.iter().map(text).collect();
                match documents.as_slice() {
                    [one] => format!("{one}\n"),
                    all => format!("[{}]\n", all.join(",\n")),
                }
            }
            (Self::Motions { scene, unknown, wall, motions, .. }, _) => table::motions(scene, unknown, motions, *wall),
            (Self::Manifolds { scene, range, curves, is_stopped }, Format::Json) => {
                let document = range.document(scene.start(), curves, *is_stopped);
                format!("{}\n", one_a_line(&document, &["curves", "points"]))
            }
            (Self::Manifolds { range, curves, .. }, Format::Csv) => csv::csv(range.axis, curves),
            (Self::Manifolds { scene, range, curves, .. }, _) => table::manifolds(scene, range.axis, curves),
        }))
    }

    fn picture(&self) -> Option<Picture<'_>> {
        let Self::Manifolds { scene, range, curves, .. } = self else { return None };
        (!curves.is_empty()).then_some(Picture::Manifolds(scene, range.axis, curves))
    }
}
