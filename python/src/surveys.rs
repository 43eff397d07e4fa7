//! Sweeps and atlases with their points, whatever their records are.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

use impact_pair::json::{AtlasHead, SweepHead};
use impact_pair::watch::{Silent, Watch};
use impact_pair_answers::grid::{Cell, Head, Kind, Points, Survey, Tally, complete, line};
use impact_pair_answers::sweep::Table;
use impact_pair_answers::{Failure, Status};
use impact_pair_plot::picture::{Look, hex};
use impact_pair_plot::sweep::{Outcomes, Show};
use impact_pair_plot::{atlas, sweep};

use crate::errors::Fault;
use crate::watched::Monitor;

/// The kind of each point, colours of kinds, the legend, and rings.
pub type MapOutcomes = (Vec<usize>, Vec<String>, Vec<(String, String)>, Vec<(f64, f64, String)>);
/// Receives the columns and the rows of a table.
pub type Reader<'r> = &'r mut dyn FnMut(&[(String, Kind)], &[Vec<Cell<'_>>]);

/// A sweep or an atlas with its finished points.
pub trait Kept: Send + Sync {
    /// Refuses a grid whose corners are not accepted.
    fn check(&self) -> Result<(), Failure>;
    /// The first line.
    fn head(&self) -> String;
    /// The line of a point; `None` where it was stopped.
    fn line(&self, point: u64, monitor: &Monitor) -> Result<Option<String>, Fault>;
    /// Computes what is missing, by all processors; after Ctrl-C what is finished is there.
    fn complete(&self, monitor: &Monitor) -> Result<(), Fault>;
    /// The points that are missing.
    fn missing(&self) -> Vec<u64>;
    /// Adds the lines of points.
    fn add_lines(&self, lines: &str) -> Result<(), Fault>;
    /// The lines of points that are there.
    fn lines(&self, points: Range<u64>) -> Result<String, Fault>;
    /// How much is proved at the points that are there.
    fn status(&self) -> Result<Status, Fault>;
    /// Points that are there as rows of CSV, those from the first one on with the names of columns.
    fn csv(&self, points: Range<u64>, rows: &str) -> Result<String, Fault>;
    /// Reads a table.
    fn table(&self, rows: &str, read: Reader<'_>) -> Result<(), Fault>;
    /// The picture of this name.
    fn picture(&self, name: &str) -> Result<String, Fault>;
    /// The outcomes of a map, attractors of one pair told apart unless `by_word`.
    fn outcomes(&self, by_word: bool) -> Result<MapOutcomes, Fault>;
}

/// Names that Python has for the tables and pictures of a sweep or an atlas.
pub trait Named: Tally {
    /// The table with these rows.
    fn table(rows: &str) -> Result<Self::Table, Fault>;
    /// The picture of this name.
    fn picture(points: &mut Points<Self>, name: &str) -> Result<String, Fault>;
    /// The outcomes of a map.
    fn outcomes(points: &mut Points<Self>, by_word: bool) -> Result<MapOutcomes, Fault>;
}

impl Named for SweepHead {
    fn table(rows: &str) -> Result<Table, Fault> {
        match rows {
            "mixed" => Ok(Table::Mixed),
            "points" => Ok(Table::Points),
            "states" => Ok(Table::States),
            other => Err(Fault::range("rows", other, "must be mixed, points or states")),
        }
    }

    fn picture(points: &mut Points<Self>, name: &str) -> Result<String, Fault> {
        let show = match name {
            "phase" => Show::Phase,
            "velocity" => Show::Velocity,
            other => return Err(Fault::range("show", other, "must be phase or velocity")),
        };
        sweep::svg(points, show, None, &Look::default()).map_err(Fault::other)
    }

    fn outcomes(points: &mut Points<Self>, by_word: bool) -> Result<MapOutcomes, Fault> {
        let found = Outcomes::of(points, by_word).map_err(Fault::other)?;
        let legend = found.legend().into_iter().map(|(colour, name)| (hex(colour), name)).collect();
        let rings = found.rings().into_iter().map(|([phase, velocity], colour)| (phase, velocity, hex(colour)));
        let rings = rings.collect();
        let colours = found.colours.into_iter().map(hex).collect();
        Ok((found.points.into_iter().flatten().collect(), colours, legend, rings))
    }
}

impl Named for AtlasHead {
    fn table(_: &str) -> Result<(), Fault> {
        Ok(())
    }

    fn picture(points: &mut Points<Self>, name: &str) -> Result<String, Fault> {
        let drawn = if name == "html" { atlas::html(points) } else { atlas::svg(points, &Look::default()) };
        drawn.map_err(Fault::other)
    }

    fn outcomes(_: &mut Points<Self>, _: bool) -> Result<MapOutcomes, Fault> {
        Err(Fault::other("an atlas has no map of outcomes"))
    }
}

struct Own<S: Survey> {
    survey: S,
    points: Mutex<Points<S::Head>>,
}

/// A sweep or an atlas with its points in a file, or in one that is gone with the program.
pub fn kept<S: Survey + 'static>(survey: S, path: Option<PathBuf>) -> Result<Box<dyn Kept>, Fault>
where
    S::Head: Named,
{
    let points = Points::kept(survey.head().clone(), path).map_err(said)?;
    Ok(Box::new(Own { survey, points: Mutex::new(points) }))
}

impl<S: Survey> Own<S> {
    fn points(&self) -> MutexGuard<'_, Points<S::Head>> {
        self.points.lock().expect("no thread has panicked")
    }
}

impl<S: Survey> Kept for Own<S>
where
    S::Head: Named,
{
    fn check(&self) -> Result<(), Failure> {
        self.survey.check()
    }

    fn head(&self) -> String {
        line(self.survey.head())
    }

    fn line(&self, point: u64, monitor: &Monitor) -> Result<Option<String>, Fault> {
        self.survey.line(point, &Silent(monitor)).map_err(of_point)
    }

    fn complete(&self, monitor: &Monitor) -> Result<(), Fault> {
        let mut points = self.points();
        monitor.report(points.count());
        let watch: &dyn Watch = &Silent(monitor);
        complete(&self.survey, &mut points, None, (watch, &|| monitor.add_one())).map_err(of_point)
    }

    fn missing(&self) -> Vec<u64> {
        self.points().missing()
    }

    fn add_lines(&self, lines: &str) -> Result<(), Fault> {
        self.points().add_lines(lines).map_err(said)
    }

    fn lines(&self, points: Range<u64>) -> Result<String, Fault> {
        let mut text = String::new();
        let add = |line: &str| {
            text += line;
            text.push('\n');
            Ok(())
        };
        self.points().each_of(points, add).map_err(said)?;
        Ok(text)
    }

    fn status(&self) -> Result<Status, Fault> {
        Tally::tally(&mut *self.points()).map_err(said)
    }

    fn csv(&self, points: Range<u64>, rows: &str) -> Result<String, Fault> {
        let (head, table) = (self.survey.head(), S::Head::table(rows)?);
        let mut text = if points.start == 0 { head.csv_head(table) } else { String::new() };
        let add = |line: &str| {
            text += &head.csv_rows(table, &serde_json::from_str(line)?);
            Ok(())
        };
        self.points().each_of(points, add).map_err(said)?;
        Ok(text)
    }

    fn table(&self, rows: &str, read: Reader<'_>) -> Result<(), Fault> {
        let (head, table) = (self.survey.head(), S::Head::table(rows)?);
        let mut records = Vec::new();
        let add = |record| {
            records.push(record);
            Ok(())
        };
        self.points().each_record(add).map_err(said)?;
        let rows: Vec<_> = records.iter().flat_map(|record| head.rows(table, record)).collect();
        read(&head.columns(table), &rows);
        Ok(())
    }

    fn picture(&self, name: &str) -> Result<String, Fault> {
        S::Head::picture(&mut self.points(), name)
    }

    fn outcomes(&self, by_word: bool) -> Result<MapOutcomes, Fault> {
        S::Head::outcomes(&mut self.points(), by_word)
    }
}

/// An error of points that are kept, with its causes.
fn said(error: anyhow::Error) -> Fault {
    Fault::other(format!("{error:#}"))
}

/// The error of a point, which it names.
fn of_point(error: anyhow::Error) -> Fault {
    let Some(own) = error.downcast_ref::<impact_pair::Error>() else { return said(error) };
    let (key, value) = (own.key().map(str::to_owned), own.value().map(str::to_owned));
    Fault::Said { class: "RangeError", message: format!("{error}: {own}"), key, value }
}
