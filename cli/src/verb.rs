//! Verbs that answer with one document: their scene, format, output and picture.

use std::iter;
use std::path::{Path, PathBuf};

use anyhow::{Error, Result, anyhow, bail};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Arg, Args, ValueEnum};
use impact_pair::Scene;
use impact_pair_answers::{Answer, Asked, Failure, Format, Picture, Verb};
use impact_pair_plot::picture::Look;

use crate::destination::{Destination, Drawing};
use crate::output::note;
use crate::progress::Progress;
use crate::{Answer as Exit, ending, scene};

/// Arguments of a verb.
#[derive(Args, Debug)]
#[command(mut_args(drawn::<V>))]
pub struct Arguments<V: Verb, O: Outputs> {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    #[command(flatten)]
    options: V,
    #[arg(long, help = format_help::<V>(), value_name = "FORMAT", value_parser = formats(V::FORMATS))]
    format: Option<Format>,
    #[command(flatten)]
    outputs: O,
}

/// The argument, where it draws a picture with what the picture of this verb shows.
fn drawn<V: Verb>(argument: Arg) -> Arg {
    if argument.get_id() == "plot" { argument.help(V::PICTURE) } else { argument }
}

/// Help of the format.
fn format_help<V: Verb>() -> String {
    let schema = if V::SCHEMA.is_empty() { String::new() } else { format!("; json is schema {}", V::SCHEMA) };
    let usual = V::FORMATS[0].0.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
    format!("Output format{schema} [default: by the extension of --output, else {usual}]")
}

/// Reads one of the formats of a verb.
pub fn formats<F: ValueEnum + Send + Sync + 'static>(
    all: &'static [(F, &'static str)],
) -> impl TypedValueParser<Value = F> {
    let all = all.iter().filter_map(|(format, help)| Some(format.to_possible_value()?.help(*help)));
    PossibleValuesParser::new(all).map(|name| F::from_str(&name, false).expect("one of them"))
}

/// The outputs of a verb.
pub trait Outputs: Args {
    /// Where the document goes.
    fn destination(&self) -> &Destination;

    /// Where the picture goes, and how it looks.
    fn plot(&self) -> Option<(&Path, &Look)>;

    /// Draws the picture as SVG.
    fn svg(&self, picture: Picture<'_>) -> Result<String>;
}

impl Outputs for Destination {
    fn destination(&self) -> &Destination {
        self
    }

    fn plot(&self) -> Option<(&Path, &Look)> {
        None
    }

    fn svg(&self, picture: Picture<'_>) -> Result<String> {
        impact_pair_plot::svg(picture, &Look::default())
    }
}

impl Outputs for Drawing {
    fn destination(&self) -> &Destination {
        &self.destination
    }

    fn plot(&self) -> Option<(&Path, &Look)> {
        self.plot.as_deref().map(|path| (path, &self.look))
    }

    fn svg(&self, picture: Picture<'_>) -> Result<String> {
        impact_pair_plot::svg(picture, &self.look)
    }
}

/// Answers a verb.
pub fn answer<V: Verb, O: Outputs>(arguments: Arguments<V, O>) -> Result<Exit> {
    let Arguments { scene: path, mut options, format, outputs } = arguments;
    let destination = outputs.destination();
    let accepted: Vec<Format> =
        V::FORMATS.iter().map(|(format, _)| *format).filter(|format| options.refuses(*format).is_none()).collect();
    let format = ending::format(format, ("--output", destination.output.as_deref()), &accepted, accepted[0])?;
    if let Some(why) = options.refuses(format) {
        let name = format.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
        bail!("--format is {name}, but {why}");
    }
    let inputs: Vec<PathBuf> = options.inputs().iter().map(|input| input.path()).collect();
    if scene::is_stdio(&path) && inputs.iter().any(|input| scene::is_stdio(input)) {
        bail!("scene and events are both -, but stdin can only be one of them");
    }
    let scene = scene::read(&path).map_err(|error| swapped::<V>(&path, &inputs).unwrap_or(error))?;
    options.inputs().into_iter().try_for_each(|input| input.load(scene::text))?;
    let all: Vec<&PathBuf> = iter::once(&path).chain(&inputs).collect();
    let files = destination.open(&all, outputs.plot())?;
    let named = |error: Error| if error.is::<impact_pair::Error>() { error.context(scene::name(&path)) } else { error };
    let progress = Progress::counting(options.counts(&scene), !files.quiet);
    let (name, is_drawn) = (path.display().to_string(), outputs.plot().is_some());
    let asked = Asked { scene: &scene, name: &name, is_drawn, is_document: format == Format::Json };
    let found = options.answer(&asked, &progress).map_err(|failure| placed(failure, &path))?;
    progress.clear();
    found.notes().iter().for_each(|line| note(files.quiet, line));
    let status = found.status();
    let open = (!status.is_complete()).then(|| status.to_string());
    let Some(text) = found.text(format).map_err(named)? else {
        note(files.quiet, &status.to_string());
        return Ok(Exit::Incomplete);
    };
    let is_said = format.is_for_people() && open.as_ref().is_some_and(|open| text.contains(open));
    files.draw((&text, open, is_said), || found.picture().map(|picture| outputs.svg(picture)))
}

/// The error of a scene that stands in the place of another input.
fn swapped<V: Verb>(path: &Path, inputs: &[PathBuf]) -> Option<Error> {
    let is_scene =
        |input: &&PathBuf| !scene::is_stdio(input) && scene::text(input).is_ok_and(|text| Scene::parse(&text).is_ok());
    let [one, other] = [path, inputs.iter().find(is_scene)?].map(scene::name);
    let verb = V::NAME;
    Some(anyhow!("{one} is not a scene, but {other} is one: did you mean impact-pair {verb} {other} {one}?"))
}

/// The error with what it is about: an option, or else the scene.
pub fn placed(failure: Failure, scene: &Path) -> Error {
    match failure {
        Failure::Scene(error) => Error::from(error).context(scene::name(scene)),
        Failure::Option { option, value, error } => Error::from(*error).context(format!("--{option} {value}")),
        Failure::Named(error) => anyhow!("--{error}"),
        Failure::Input { input, error } => Error::from(*error).context(input),
        Failure::Value { .. } | Failure::Question(_) => anyhow!("{failure}"),
    }
}
