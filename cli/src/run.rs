//! `impact-pair run SCENE`: the certified impacts of a scene.

use std::fs;
use std::io::{self, IsTerminal, Read, Write};
use std::path::Path;
use std::sync::atomic::Ordering;

use anyhow::{Context, Result, bail};
use impact_pair::Scene;
use impact_pair::certificate::{Conclusion, Event, arithmetic};
use impact_pair::orbit::Progress as Step;

use crate::Answer;
use crate::arguments::{Format, RunArguments};
use crate::ending::Ending;
use crate::listing::Listing;
use crate::output::Output;
use crate::progress::{Progress, interruption};

pub fn run(arguments: &RunArguments) -> Result<Answer> {
    let scene = read(&arguments.scene)?;
    let settings = arguments.settings(&scene);
    let mut orbit = scene.orbit(settings.clone()).with_context(|| name(&arguments.scene))?;
    if let Some(output) = &arguments.output
        && fs::canonicalize(output).is_ok_and(|output| fs::canonicalize(&arguments.scene).is_ok_and(|s| s == output))
    {
        bail!("cannot write {}: it is the scene", output.display());
    }

    let interrupted = interruption();
    let out = Output::open(arguments.output.as_deref())?;
    let visible = !arguments.quiet && io::stderr().is_terminal() && !out.is_terminal();
    let said_already = arguments.format == Format::Table && out.is_stdout();
    let progress = Progress::new(settings.impacts, visible);
    let mut listing = Listing::new(arguments.format, &scene, &settings, out);
    let write = "cannot write the output";
    listing.begin().context(write)?;
    let mut last = None;
    while !interrupted.load(Ordering::Relaxed) {
        let step = orbit.advance();
        match step {
            Step::Retraced(index) => progress.retrace(index, orbit.bits()),
            Step::Ended => break,
            Step::Impact(_) | Step::Graze(_) | Step::Rest(_) | Step::Release(_) => {}
        }
        let index = last.as_ref().map_or(0, |event: &Event| event.index);
        if let Some(event) = Event::of(&orbit, &step, index) {
            listing.event(&event).context(write)?;
            progress.reach(event.index);
            last = Some(event);
        }
    }
    progress.clear();
    let conclusion = Conclusion::of(&orbit, scene.start(), last.as_ref());
    let ending = Ending { conclusion, computed: arithmetic(&orbit), wide: orbit.first_wide(), settings: &settings };
    listing.end(&ending).context(write)?.commit()?;

    if !ending.is_complete() && !arguments.quiet && !said_already {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{ending}");
    }
    Ok(if ending.is_complete() { Answer::Complete } else { Answer::Incomplete })
}

/// Reads the scene of a file, or of stdin when it is `-`.
fn read(path: &Path) -> Result<Scene> {
    let text = if path.as_os_str() == "-" {
        let mut text = String::new();
        io::stdin().read_to_string(&mut text).map(|_| text)
    } else {
        fs::read_to_string(path)
    };
    let text = text.with_context(|| format!("cannot read {}", name(path)))?;
    Scene::parse(&text).with_context(|| name(path))
}

fn name(path: &Path) -> String {
    if path.as_os_str() == "-" { "stdin".into() } else { path.display().to_string() }
}
