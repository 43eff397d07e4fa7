//! `tangency`: homoclinic tangencies of the equispaced motion over a parameter, proved.

use std::fmt::{self, Write};
use std::slice;

use anyhow::Result;
use clap::Args;
use impact_pair::exact::{decimal_bounds, decimal_digits};
use impact_pair::json::counted;
use impact_pair::scene::{Key, Over, Range};
use impact_pair::tangency::{
    Beside, FlightWord, TANGENCY_PARAMETERS, Tangencies, Tangency, TangencySettings, UnprovedTangency, at_least,
    is_tangency_range,
};
use impact_pair::watch::Watch;
use impact_pair::{Effort, Error, Scene};

use crate::values::{PrecisionArguments, count};
use crate::{Answer, Asked, Failure, Format, Picture, Sentence, Status, Step, TABLE_OR_JSON, Verb, heading, line};

/// Options of `tangency`.
#[derive(Args, Clone, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of d/A or e, and of the parameters of the invariant manifolds [default: that of the scene, or 9]")))]
pub struct TangencyOptions {
    /// The parameter and its range: gap, amplitude, restitution, or A/d, the amplitude in gaps [default: the gap, from 0.9999 to 1.0001 times that of
    /// the scene]
    #[arg(long, value_name = "KEY=LO..HI", value_parser = over)]
    pub over: Option<Over>,
    /// The flights from the unstable manifold to the stable one in time order: F to the far wall, N back to the near one
    /// [default: all words are searched]
    #[arg(long, value_name = "FLIGHTS")]
    pub word: Option<FlightWord>,
    /// Maximum number of flights that are searched without --word
    #[arg(long, value_name = "N", default_value_t = 18, value_parser = count(1..=40))]
    pub longest: u64,
    /// Maximum number of tangencies that are proved, the nearest ones
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = count(1..=100_000))]
    pub most: u64,
    /// Multiply the work by X: the search without --word takes about 30 million flights in floating point for each saddle, and as much again to
    /// follow folds, 10,000 flights each
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Width of the enclosures.
    #[command(flatten)]
    pub precision: PrecisionArguments,
}

/// Reads `KEY=LO..HI` of a parameter over which tangencies are searched.
fn over(text: &str) -> Result<Over, impact_pair::Error> {
    Over::parse(text, &format!("KEY=LO..HI with LO < HI, {TANGENCY_PARAMETERS}"), is_tangency_range)
}

/// The range of gaps next to that of a scene.
fn beside(scene: &Scene) -> Result<Range, Failure> {
    let gap = scene.pair().gap();
    if !gap.is_point() {
        let why = format!(" is missing, but pair.gap is the interval {gap}: accepted is the range of one parameter");
        return Err(Failure::Question(Sentence::default().step(Step::Name("over")).say(why)));
    }
    let end = |part: &str| {
        let end = gap.checked_mul(&part.parse().expect("a number"));
        end.map_err(|error| Error::range("pair.gap", gap, &error.to_string()))
    };
    Ok(Range::new(Key::Gap, end("0.9999")?, end("1.0001")?, None)?)
}

/// Tangencies over a parameter.
pub struct HomoclinicTangencies<'s> {
    scene: &'s Scene,
    found: Tangencies,
}

impl Verb for TangencyOptions {
    const NAME: &'static str = "tangency";
    const FORMATS: &'static [(Format, &'static str)] = TABLE_OR_JSON;
    const SCHEMA: &'static str = "impact-pair/tangency/1";
    const PICTURE: &'static str = "Draw the nearest tangency: both invariant manifolds in the section, and the point of tangency 1,000 times as large, at its value and 1e-4 to either side";
    type Answer<'s> = HomoclinicTangencies<'s>;

    fn answer<'s>(
        &self,
        Asked { scene, .. }: &Asked<'s>,
        watch: &dyn Watch,
    ) -> Result<HomoclinicTangencies<'s>, Failure> {
        let settings = TangencySettings {
            over: match &self.over {
                Some(over) => over.of(scene.pair())?,
                None => beside(scene)?,
            },
            word: self.word.clone(),
            longest: self.longest as usize,
            most: self.most as usize,
            effort: self.effort,
            precision: self.precision.of(scene),
        };
        let found = Tangencies::of(scene, &settings, watch).map_err(Failure::over(slice::from_ref(&settings.over)))?;
        Ok(HomoclinicTangencies { scene, found })
    }
}

impl Answer for HomoclinicTangencies<'_> {
    fn status(&self) -> Status {
        let found = &self.found;
        let proved = match found.tangencies.len() {
            1 => "1 homoclinic tangency".to_owned(),
            count => format!("{count} homoclinic tangencies"),
        };
        let is_certified = found.is_certified();
        if found.interrupted {
            return Status::new(is_certified, format!("interrupted: {proved} proved so far"));
        }
        if is_certified {
            return Status::new(true, format!("certified: {proved}; others are not excluded"));
        }
        let status = Status::new(false, format!("undecided: {proved} proved; "));
        let (steps, status) = match found.limited {
            true => (
                [Step::A("word"), Step::Smaller("longest"), Step::More("effort")],
                status.say("the search ended at the limit of its work: "),
            ),
            false => ([Step::Another("word"), Step::Larger("longest"), Step::Wider("over")], status),
        };
        let [one, two, three] = steps;
        status.say("try ").step(one).say(", ").step(two).say(" or ").step(three)
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        let Self { scene, found } = self;
        Ok(Some(match format {
            Format::Json => line(&found.document(scene))?,
            _ => table(scene, found, &self.status())?,
        }))
    }

    fn picture(&self) -> Option<Picture<'_>> {
        Some(Picture::Tangency(self.scene, &self.found))
    }
}

fn table(scene: &Scene, found: &Tangencies, status: &Status) -> Result<String, fmt::Error> {
    let mut out = heading(scene);
    let (key, low, high) = (found.over.key(), found.over.low(), found.over.high());
    writeln!(out, "over {} from {low} to {high}\n", key.place())?;
    for tangency in &found.tangencies {
        rows(&mut out, key, tangency)?;
    }
    for UnprovedTangency { near, flights } in &found.unproved {
        writeln!(out, "undecided: near {near:.12}, {flights}: {}", UnprovedTangency::REASON)?;
    }
    writeln!(out, "\n{status}")?;
    Ok(out)
}

fn rows(out: &mut String, key: Key, found: &Tangency) -> fmt::Result {
    let count = counted(found.flights.len() as u32, "flight");
    writeln!(out, "{} = {}: quadratic tangency, {count}", key.place(), decimal_digits(&found.parameter))?;
    writeln!(out, "  from P_u(sigma_u) to P_s(sigma_s): {}", found.flights)?;
    let [unstable, stable] = found.eigenvalues.each_ref().map(decimal_digits);
    writeln!(out, "  saddle: phase {} rad, speed {} A W", decimal_digits(&found.phase), decimal_digits(&found.speed))?;
    writeln!(out, "  eigenvalues {unstable} and {stable}; no resonance up to order {}", found.resonances_excluded_to)?;
    writeln!(out, "  sigma_u = {}", decimal_digits(&found.unstable))?;
    writeln!(out, "  sigma_s = {}", decimal_digits(&found.stable))?;
    let unit = if key == Key::Restitution { "e" } else { "d/A" };
    let [quadratic, unfolding] = [&found.quadratic, &found.unfolding].map(decimal_digits);
    writeln!(out, "  q = {quadratic}, m = {unfolding} per unit of {unit}")?;
    if found.states.is_some() {
        writeln!(out, "  exactly one for each value of the scene's interval, the states in the bounds of the JSON")?;
    }
    if let Some(Beside { two, none, .. }) = &found.beside {
        let [two, none] = [two, none].map(|range| decimal_bounds(range).join(" to "));
        writeln!(out, "  two common points for {two}, none for {none}: in the boxes of the JSON")?;
    }
    let [speed, flight] = [found.least_speed, found.least_flight].map(at_least);
    writeln!(out, "  speeds at least {} A W, flights at least {} rad", speed.text(), flight.text())
}
