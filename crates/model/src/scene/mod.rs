//! The scene file: one impact pair, one start, and how far to follow the orbit, in TOML.
//!
//! A bare number is the exact decimal as written, a string is an expression (`"3*pi"`) or an interval of values
//! (`"[9.42, 9.43]"`); see [`Exact::parse`]. Nothing is rounded to a double, nothing is clamped. Required are
//! `[excitation]` with `amplitude`, `frequency` and `phase` (for several harmonics lists of one length; a single phase
//! holds for all harmonics), `[pair]` with `gap` and `restitution`, and `[start]` with `time`, `velocity` and either `wall`
//! or `position`. `title` and `[run]` are optional. The letters `A`, `W`, `tau`, `d` and `e` stand for the names of parameters.

mod key;
mod letters;
mod range;
mod section;
mod vary;
mod words;

use toml_edit::{Document, TomlError};

use crate::error::Error;
use crate::excerpt::Excerpt;
use crate::excitation::{Excitation, Harmonic};
use crate::pair::{ImpactPair, Wall};
pub use crate::settings::DIGITS;
use crate::settings::{Arithmetic, Settings};
use crate::start::Start;
use impact_pair_exact::Exact;
pub use key::{Key, Term};
pub use range::{Over, Range};
use section::{Entry, Section, quoted};

/// Digits of a shadow if none are requested: the width of a shadow is not controlled, so the digits of `[run]` do not apply.
const SHADOW_DIGITS: u32 = 6;

/// A scene file: an impact pair, a start, and how far to follow the orbit.
///
/// ```
/// use impact_pair_model::Scene;
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
/// "#)?;
/// assert_eq!(scene.pair().gap().text(), "9.42497");
/// assert_eq!(scene.settings().impacts, Some(100));
/// # Ok::<(), impact_pair_model::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scene {
    title: Option<String>,
    pair: ImpactPair,
    start: Start,
    run: Run,
    places: Vec<(String, Excerpt)>,
}

/// The length and accuracy of the orbit: the table `[run]`.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// Stop after this number of impacts; 0 requests none.
    pub impacts: Option<u64>,
    /// Stop at this time \[time\].
    pub until: Option<Exact>,
    /// Requested widths; see [`Settings::digits`].
    pub digits: Option<u32>,
}

impl Run {
    /// The settings of an orbit, by default nine digits, and 100 impacts if neither a number nor a stop time is given.
    pub fn settings(&self, arithmetic: Arithmetic) -> Settings {
        let defaults = Settings::default();
        let impacts = if self.until.is_none() { self.impacts.or(defaults.impacts) } else { self.impacts };
        let digits = self.digits.unwrap_or(defaults.digits);
        Settings { impacts, until: self.until.clone(), digits, arithmetic, ..Settings::default() }
    }
}

impl Scene {
    /// A scene that stands in no file.
    pub fn new(pair: ImpactPair, start: Start) -> Self {
        Self { title: None, pair, start, run: Run::default(), places: Vec::new() }
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// If a key is unknown, duplicate or missing, a value has the wrong type or is out of range, or the text is not TOML: the message
    /// names the line, the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let document = Document::parse(text).map_err(|error| unreadable(text, error))?;
        let file = Section::file(text, document.as_table());
        file.refuse_unknown(&["title", "excitation", "pair", "start", "run"])?;
        let title = file.entry("title").map(|title| title.one_line().map(str::to_owned)).transpose()?;
        let excitation = file.section("excitation", &["amplitude", "frequency", "phase"])?;
        let pair = file.section("pair", &["gap", "restitution"])?;
        let start = file.section("start", &["time", "wall", "position", "velocity"])?;
        let run = file.optional_section("run", &["impacts", "until", "digits"])?;

        let places: Vec<_> = [&excitation, &pair, &start].into_iter().chain(&run).flat_map(Section::places).collect();
        let located = |error: Error| at_its_place(error, &places);
        let pair = {
            let terms = read_terms(&excitation)?
                .into_iter()
                .map(|[amplitude, frequency, phase]| Harmonic::new(amplitude, frequency, phase));
            let excitation = terms.collect::<Result<_, _>>().and_then(Excitation::new).map_err(located)?;
            let [gap, restitution] = ["gap", "restitution"].map(|key| pair.require(key)?.number());
            ImpactPair::new(excitation, gap?, restitution?).map_err(located)?
        };
        let start = read_start(&start, &pair).map_err(located)?;
        let run = run.map(|run| read_run(&run)).transpose()?.unwrap_or_default();
        Ok(Self { title, pair, start, run, places })
    }

    /// The title, if there is one.
    pub fn title(&self) -> Option<&str> {
        self.title.as_deref()
    }

    /// The impact pair.
    pub fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    /// The start of the orbit.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// The table `[run]`.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The settings of `[run]`, in the cheapest arithmetic that decides.
    pub fn settings(&self) -> Settings {
        self.run.settings(Arithmetic::Auto)
    }

    /// The settings of the run: those of `requested`, else those of the table `[run]`.
    pub fn settings_requested(&self, requested: Run, arithmetic: Arithmetic) -> Settings {
        let (impacts, until) =
            (requested.impacts.or(self.run.impacts), requested.until.or_else(|| self.run.until.clone()));
        Run { impacts, until, digits: self.digits_requested(requested.digits, arithmetic) }.settings(arithmetic)
    }

    /// The digits of an orbit: those requested, or else those of `[run]`; `SHADOW_DIGITS` for a shadow.
    pub fn digits_requested(&self, digits: Option<u32>, arithmetic: Arithmetic) -> Option<u32> {
        digits.or(if arithmetic == Arithmetic::Shadow { Some(SHADOW_DIGITS) } else { self.run.digits })
    }

    /// Adds the line of the error's key, if the key is in the file.
    pub fn located(&self, error: Error, settings: &Settings) -> Error {
        let is_ours = |until: &Exact| self.run.until.as_ref().is_some_and(|ours| ours.text() == until.text());
        // A time to stop at that is not the file's has no line in it.
        let is_strange = error.key() == Some("run.until") && !settings.until.as_ref().is_none_or(is_ours);
        if is_strange { error } else { at_its_place(error, &self.places) }
    }
}

/// Adds the line of the error's key, or of the first of several keys (`excitation.amplitude / pair.gap`).
fn at_its_place(error: Error, places: &[(String, Excerpt)]) -> Error {
    let key = error.key().unwrap_or_default();
    match places.iter().find(|(known, _)| key.contains(known.as_str())) {
        Some((_, excerpt)) => error.at(excerpt.clone()),
        None => error,
    }
}

/// The error for a text that is not TOML, with the line at fault.
fn unreadable(text: &str, error: TomlError) -> Error {
    let at = error.span().unwrap_or(text.len()..text.len());
    let excerpt = Excerpt::new(text, at);
    let hint = if error.message().contains("overflow") { " (write the number as a string)" } else { "" };
    let written = excerpt.text().trim();
    let message = format!("{} in {}{hint}", error.message(), quoted(written));
    Error::scene(message).meant(as_toml(written)).at(excerpt).because(error)
}

/// The line as valid TOML, if its value is an expression or a word without quotes.
fn as_toml(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next()?.trim();
    let text = match Exact::parse(value) {
        Ok(_) => value.to_owned(),
        Err(error) => error.meant().map(str::to_owned).or_else(|| is_wall(value).then(|| value.to_owned()))?,
    };
    let value = if text.parse::<f64>().is_ok() { text } else { format!("\"{text}\"") };
    let meant = format!("{} = {value}", key.trim());
    (meant != line).then_some(meant)
}

/// Amplitude, frequency and phase of each harmonic.
fn read_terms(excitation: &Section<'_>) -> Result<Vec<[Exact; 3]>, Error> {
    let amplitudes = excitation.require("amplitude")?.terms()?;
    let (frequency, phase) = (excitation.require("frequency")?, excitation.require("phase")?);
    let count = amplitudes.len();
    let frequencies = frequency.terms()?;
    let shared = |phase: Vec<Exact>| phase.into_iter().cycle().take(count).collect();
    let phases: Vec<Exact> = if phase.is_list() { phase.terms()? } else { shared(phase.terms()?) };
    let fits = |entry: &Entry<'_>, found: usize, accepted: &str| {
        let terms = if found == 1 { "1 term" } else { &format!("{found} terms") };
        let accepted = format!("has {terms}, must have {count} like excitation.amplitude{accepted}");
        if found == count { Ok(()) } else { Err(entry.refused(&accepted)) }
    };
    fits(&frequency, frequencies.len(), "")?;
    fits(&phase, phases.len(), ", or be a single number")?;
    Ok(amplitudes.into_iter().zip(frequencies).zip(phases).map(|((a, w), tau)| [a, w, tau]).collect())
}

fn read_start(start: &Section<'_>, pair: &ImpactPair) -> Result<Start, Error> {
    let time = start.require("time")?.number()?;
    let velocity = start.require("velocity")?.number()?;
    match (start.entry("wall"), start.entry("position")) {
        (Some(wall), None) => Start::on_wall(time, read_wall(&wall)?, velocity),
        (None, Some(position)) => Start::inside(pair, time, position.number()?, velocity),
        (Some(wall), Some(position)) => Err(position
            .refused(&format!("start.wall is given too, on line {}: a start has one or the other", wall.line()))),
        (None, None) => Err(start.missing("wall", "must be \"left\" or \"right\", or start.position be given")),
    }
}

fn read_wall(wall: &Entry<'_>) -> Result<Wall, Error> {
    let accepted = "\"left\" or \"right\"";
    let name = wall.text(accepted)?;
    let walls = [Wall::Left, Wall::Right].into_iter().find(|wall| wall.name() == name);
    let meant = name.to_lowercase();
    let meant = is_wall(&meant).then(|| format!("\"{meant}\""));
    walls.ok_or_else(|| wall.refused(&format!("must be {accepted}")).meant(meant))
}

fn is_wall(name: &str) -> bool {
    [Wall::Left, Wall::Right].iter().any(|wall| wall.name() == name)
}

fn read_run(run: &Section<'_>) -> Result<Run, Error> {
    let impacts = run.entry("impacts").map(|impacts| impacts.integer(0..=i64::MAX as u64)).transpose()?;
    let digits = (*DIGITS.start()).into()..=(*DIGITS.end()).into();
    let digits = run.entry("digits").map(|entry| entry.integer(digits)).transpose()?;
    let until = run.entry("until").map(|until| until.point()).transpose()?;
    Ok(Run { impacts, until, digits: digits.map(|digits| digits as u32) })
}
