//! `impact-pair two-impact SCENE`: motions with two impacts in N cycles, and the parameter manifolds of figures 10 and 11.

pub mod arguments;
mod csv;
mod table;

use anyhow::{Error, Result};
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::json::one_a_line;
use impact_pair::orbit::Settings;
use impact_pair::scene::{Key, Range as ParameterRange};
use impact_pair::two_impact::{Answer, Axis, Problem, Range, Unknown, speed};
use impact_pair::watch::Watch;

use crate::destination::{Files, OpenOutput};
use crate::progress::Progress;
use crate::{Answer as Exit, scene};
use arguments::{SolveFor, TwoImpactArguments, TwoImpactFormat};

/// The arguments, and how the answer is written.
type Options<'a> = (&'a TwoImpactArguments, TwoImpactFormat);

pub fn two_impact(arguments: &TwoImpactArguments) -> Result<Exit> {
    let format = arguments.format()?;
    let plot = arguments.plot.as_deref().map(|path| (path, &arguments.look));
    let OpenOutput { scene, files, path } = arguments.destination.begin(&arguments.scene, plot)?;
    let digits = arguments.digits.or(scene.run().digits).unwrap_or(Settings::default().digits);
    let named = || scene::name(path);
    let answer = match &arguments.manifold {
        Some(range) => draw_manifold((arguments, format), files, &scene, range, digits),
        None => list_motions((arguments, format), files, &scene, digits),
    };
    // An output that cannot be written is not the scene's fault.
    answer.map_err(|error| if error.is::<impact_pair::Error>() { error.context(named()) } else { error })
}

fn list_motions((arguments, format): Options<'_>, files: Files, scene: &Scene, digits: u32) -> Result<Exit> {
    let unknown = match arguments.solve_for {
        SolveFor::Velocity => Unknown::Velocity,
        SolveFor::Amplitude => Unknown::Amplitude(speed(scene)?),
        SolveFor::Gap => Unknown::Gap(speed(scene)?),
    };
    let progress = Progress::of("isolating motions", !files.quiet);
    let answers: Vec<Answer> = arguments
        .cycles
        .clone()
        .take_while(|_| progress.goes_on())
        .map(|cycles| Ok(Problem::new(scene.pair(), cycles, unknown.clone())?.answer_within(digits, &progress)))
        .collect::<Result<_, Error>>()?;
    progress.clear();
    let wall = arguments.wall.wall();
    let text = match format {
        TwoImpactFormat::Json => {
            let text = |answer: &Answer| one_a_line(&answer.document(scene.start(), wall), &["orbits"]);
            let documents: Vec<String> = answers.iter().map(text).collect();
            match documents.as_slice() {
                [one] => format!("{one}\n"),
                all => format!("[{}]\n", all.join(",\n")),
            }
        }
        TwoImpactFormat::Table | TwoImpactFormat::Csv => table::motions(scene, &unknown, &answers, wall),
    };
    let is_whole = answers.len() == arguments.cycles.clone().count();
    let open = match (is_whole && answers.iter().all(|answer| answer.is_complete), progress.goes_on()) {
        (true, _) => None,
        (false, false) => Some("interrupted: the motions written are proved, others are missing"),
        (false, true) => Some("not everything requested is decided: see what is undecided or null in the output"),
    };
    let open = open.map(str::to_owned);
    let is_table = format == TwoImpactFormat::Table;
    files.answer(&text, open, is_table)
}

fn draw_manifold(
    (arguments, format): Options<'_>,
    files: Files,
    scene: &Scene,
    over: &ParameterRange,
    digits: u32,
) -> Result<Exit> {
    let wall = arguments.wall.wall();
    let (axis, speed) = match over.key() {
        Key::StartVelocity => (Axis::Velocity(wall), Exact::from(0)), // the speed is what varies
        _ => (Axis::Frequency, speed(scene)?),
    };
    let (from, to, count) = (over.low().clone(), over.high().clone(), over.points() as usize);
    let range = Range { pair: scene.pair(), speed, axis, from, to, count };
    let progress = Progress::of("computing parameter manifolds", !files.quiet);
    let (curves, went_on) = range.manifolds(arguments.cycles.clone(), digits, &progress)?;
    progress.clear();
    let interrupted = !went_on;
    let text = match format {
        TwoImpactFormat::Table => table::manifolds(scene, axis, &curves),
        TwoImpactFormat::Json => {
            let document = range.document(scene.start(), &curves, interrupted);
            format!("{}\n", one_a_line(&document, &["curves", "points"]))
        }
        TwoImpactFormat::Csv => csv::csv(axis, &curves),
    };
    let open = interrupted.then(|| "interrupted: the points written are proved, others are missing".to_owned());
    if curves.is_empty() {
        return files.answer(&text, open, false);
    }
    let svg = || impact_pair_plot::two_impact::svg(scene, axis, &curves, arguments.inset, &arguments.look);
    files.draw((&text, open, false), svg)
}
