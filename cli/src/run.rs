//! `impact-pair run SCENE`: the certified impacts of a scene.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;

use anyhow::{Context, Result};
use impact_pair::document::{Conclusion, Ending, Event};
use impact_pair::orbit::{Orbit, Settings};

use crate::Answer;
use crate::arguments::{Format, RunArguments};
use crate::listing::Listing;
use crate::output::Output;
use crate::progress::{Progress, catch_interruption};
use crate::scene;

pub fn run(arguments: &RunArguments) -> Result<Answer> {
    let format = arguments.destination.format(arguments.format)?;
    let scene = scene::read(&arguments.scene)?;
    let settings = Settings { attractor: true, ..arguments.settings(&scene) };
    let mut orbit = Orbit::of(&scene, settings.clone()).with_context(|| scene::name(&arguments.scene))?;
    scene::keep(&arguments.scene, arguments.destination.output.as_deref())?;

    // From here on Ctrl-C keeps what is certified.
    catch_interruption();
    let out = Output::open(arguments.destination.output.as_deref())?;
    let visible = !arguments.destination.quiet && io::stderr().is_terminal() && !out.is_terminal();
    let said_already = format == Format::Table && out.is_stdout();
    let progress = Progress::new(settings.impacts, visible);
    let mut listing = Listing::new(format, &scene, &settings, out);
    let write = "cannot write the output";
    listing.begin(&orbit).context(write)?;
    let mut last = None;
    let written = orbit.follow(&progress, |orbit, step| {
        let index = last.as_ref().map_or(0, |event: &Event| event.index);
        let Some(event) = Event::of(orbit, &step, index) else { return ControlFlow::Continue(()) };
        if let Err(error) = listing.event(&event) {
            return ControlFlow::Break(error);
        }
        last = Some(event);
        ControlFlow::Continue(())
    });
    if let ControlFlow::Break(error) = written {
        return Err(error).context(write);
    }
    progress.clear();
    let conclusion = Conclusion::of(&orbit, scene.start(), last.as_ref());
    let ending = Ending::of(&orbit, conclusion, &settings);
    listing.end(&ending).context(write)?.commit()?;

    if !ending.is_complete() && !arguments.destination.quiet && !said_already {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{ending}");
    }
    Ok(if ending.is_complete() { Answer::Complete } else { Answer::Incomplete })
}
