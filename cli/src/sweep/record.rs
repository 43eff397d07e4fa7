//! What is written of a sweep: its head, and a record a point, as JSON; all other formats are made from these.

use anyhow::{Result, bail};
use impact_pair::Scene;
use impact_pair::certificate::{self, PROGRAM, asked_arithmetic};
use impact_pair::exact::{Exact, decimal_bounds, decimal_bounds_f64};
use impact_pair::lyapunov::Exponent;
use impact_pair::number::Ball;
use impact_pair::orbit::{Outcome, Period};
use impact_pair::scene::Key;
use impact_pair::sweep::{Asked, Axis, Grid, Point, State};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::arguments::Shard;

pub const SCHEMA: &str = "impact-pair/sweep/1";

/// Bounds as decimals, rounded outward.
pub type Bounds = [String; 2];

/// What a sweep is about: all that its points depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    pub schema: String,
    pub program: String,
    pub title: Option<String>,
    /// As in the orbit JSON; of what varies the scene's own value.
    pub scene: Value,
    pub over: Vec<Over>,
    pub points: u64,
    pub transient: u64,
    pub impacts: u64,
    pub digits: u32,
    pub certified: bool,
    pub arithmetic: Value,
    /// The points have no impacts.
    pub summary: bool,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shard: Option<[u64; 2]>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Over {
    pub key: String,
    pub from: String,
    pub to: String,
    pub count: u64,
}

impl Head {
    pub fn new(scene: &Scene, grid: &Grid, asked: &Asked, summary: bool, shard: Option<Shard>) -> Self {
        let over = |axis: &Axis| Over {
            key: axis.key.name().to_owned(),
            from: axis.low.text(),
            to: axis.high.text(),
            count: axis.count,
        };
        Self {
            schema: SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            title: scene.title().map(str::to_owned),
            scene: certificate::scene(scene.pair(), scene.start()),
            over: grid.axes().iter().map(over).collect(),
            points: grid.points(),
            transient: asked.transient,
            impacts: asked.impacts,
            digits: asked.settings.digits,
            certified: certificate::is_certified(asked.settings.arithmetic),
            arithmetic: asked_arithmetic(&asked.settings),
            summary,
            shard: shard.map(|shard| [shard.number, shard.of]),
        }
    }

    /// Reads the first line of what this program has written.
    pub fn read(line: &str) -> Result<Self> {
        let head: Self = match serde_json::from_str(line) {
            Ok(head) => head,
            Err(error) => bail!("line 1 is no head of schema {SCHEMA}: {error}"),
        };
        if head.schema != SCHEMA {
            bail!("the schema is {}, but accepted is {SCHEMA}", head.schema);
        }
        head.grid()?;
        Ok(head)
    }

    /// The grid, anew.
    pub fn grid(&self) -> Result<Grid> {
        let axis = |over: &Over| format!("{}={}..{}:{}", over.key, over.from, over.to, over.count).parse::<Axis>();
        let grid = Grid::new(self.over.iter().map(axis).collect::<Result<_, _>>()?)?;
        if grid.points() != self.points {
            bail!("points is {}, but the grid has {}", self.points, grid.points());
        }
        Ok(grid)
    }

    /// The points that belong to it.
    pub fn own(&self) -> impl Iterator<Item = u64> + use<> {
        let shard = self.shard.map(|[number, of]| Shard { number, of });
        (0..self.points).filter(move |&point| shard.is_none_or(|shard| shard.holds(point)))
    }

    pub fn line(&self) -> String {
        serde_json::to_string(self).expect("a head is plain data")
    }
}

/// What is certified at a point.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    pub point: u64,
    /// The exact values, an axis each.
    pub values: Vec<String>,
    pub outcome: String,
    /// Why it is undecided.
    pub reason: Option<String>,
    pub message: String,
    /// All that was asked is certified.
    pub complete: bool,
    /// The most bits that an impact took.
    pub bits: u32,
    /// Certified, those of the transient among them.
    pub impacts: u64,
    /// The first one wider than asked for.
    pub wide_from: Option<u64>,
    pub impacts_per_cycle: Option<Bounds>,
    pub exponent: Growth,
    /// What it is attracted to, or, without a state, the exact period.
    pub period: Option<Periodic>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub states: Vec<Impact>,
}

/// Bounds of the finite-time exponent, or why there are none.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Growth {
    pub per_impact: Option<Bounds>,
    pub per_cycle: Option<Bounds>,
    pub reason: Option<String>,
}

/// A period.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Periodic {
    pub word: Option<String>,
    pub impacts: u64,
    pub cycles: u64,
    /// From this impact on the orbit is in a neighbourhood that the period contracts.
    pub from: Option<u64>,
    /// The impact that the word starts with.
    pub first: Option<Impact>,
}

/// A state on a switch-plane.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Impact {
    pub index: u64,
    pub wall: String,
    pub phase: Bounds,
    pub velocity: Bounds,
}

impl From<&State> for Impact {
    fn from(state: &State) -> Self {
        Self {
            index: state.index,
            wall: state.wall.name().to_owned(),
            phase: decimal_bounds(&state.phase),
            velocity: decimal_bounds(&state.velocity),
        }
    }
}

fn bounds(ball: Ball) -> Bounds {
    match ball.enclosure() {
        Some(enclosure) => decimal_bounds(&enclosure),
        None => decimal_bounds_f64(ball.mid() - ball.rad(), ball.mid() + ball.rad()),
    }
}

impl Growth {
    fn of(exponent: Exponent) -> Self {
        let rest = || Some(["-inf".to_owned(), "-inf".to_owned()]);
        match exponent {
            Exponent::Finite { per_impact, per_cycle } => {
                Self { per_impact: Some(bounds(per_impact)), per_cycle: Some(bounds(per_cycle)), reason: None }
            }
            Exponent::Forgets => Self { per_impact: rest(), per_cycle: rest(), reason: None },
            Exponent::Unknown(unknown) => {
                Self { per_impact: None, per_cycle: None, reason: Some(unknown.name().to_owned()) }
            }
        }
    }
}

impl Record {
    pub fn new(number: u64, values: &[(Key, Exact)], point: &Point, summary: bool) -> Self {
        // Chaos is never claimed: what is not proved to be attracted is only that.
        let outcome = match &point.outcome {
            Outcome::ImpactsReached | Outcome::TimeReached => "not-attracted",
            other => other.kind(),
        };
        let period = match (&point.outcome, &point.attraction) {
            (Outcome::Periodic(Period { cycles, impacts }), _) => {
                Some(Periodic { word: None, impacts: *impacts, cycles: *cycles, from: None, first: None })
            }
            (_, Some(attraction)) => Some(Periodic {
                word: Some(attraction.word.to_string()),
                impacts: attraction.word.mappings().len() as u64,
                cycles: attraction.cycles.into(),
                from: Some(attraction.from),
                first: Some(Impact::from(&attraction.first)),
            }),
            _ => None,
        };
        let is_lost = matches!(point.exponent, Exponent::Unknown(unknown) if !unknown.is_definite());
        let reason = point.conclusion.reason();
        Self {
            point: number,
            values: values.iter().map(|(_, value)| value.text()).collect(),
            outcome: outcome.to_owned(),
            reason: reason.map(|reason| reason.name().to_owned()),
            message: point.conclusion.message().to_owned(),
            complete: reason.is_none() && point.first_wide.is_none() && !is_lost,
            bits: point.bits,
            impacts: point.impacts,
            wide_from: point.first_wide,
            impacts_per_cycle: point.impacts_per_cycle.map(bounds),
            exponent: Growth::of(point.exponent),
            period,
            states: if summary { Vec::new() } else { point.states.iter().map(Impact::from).collect() },
        }
    }

    pub fn line(&self) -> String {
        serde_json::to_string(self).expect("a record is plain data")
    }

    pub fn read(line: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(line)
    }
}
