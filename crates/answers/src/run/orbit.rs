//! The answer to `run`: an orbit that has ended, with its events.

use std::convert::Infallible;
use std::ops::ControlFlow;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::orbit::{Advice, Conclusion, Ending, Event, Orbit, Settings};
use impact_pair::watch::Watch;

use super::Listing;
use crate::{Answer, Asked, Counts, Failure, Format, RunOptions, Status, Step, Verb};

/// An orbit that is followed to its end, or until the watch stops it.
pub struct FollowedOrbit<'s> {
    scene: &'s Scene,
    settings: Settings,
    orbit: Orbit,
    events: Vec<Event>,
}

impl Verb for RunOptions {
    const NAME: &'static str = "run";
    const FORMATS: &'static [(Format, &'static str)] = &[
        (Format::Table, "Human-readable: the certain digits, then the last digits of both bounds"),
        (Format::Json, "One document, schema impact-pair/orbit/1"),
        (Format::Jsonl, "JSON Lines as they are certified: the head, one event per line, the outcome"),
        (Format::Csv, "One event per line, bounds in columns"),
    ];
    const SCHEMA: &'static str = "";
    type Answer<'s> = FollowedOrbit<'s>;

    fn counts(&self, scene: &Scene) -> Counts {
        Counts::Impacts(self.settings(scene).impacts)
    }

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<FollowedOrbit<'s>, Failure> {
        let settings = self.settings(scene);
        let mut orbit = Orbit::of(scene, settings.clone())?;
        let mut events = Vec::new();
        let ControlFlow::Continue(()) = orbit.follow(watch, |orbit, step| {
            events.extend(Event::of(orbit, &step));
            ControlFlow::<Infallible>::Continue(())
        });
        Ok(FollowedOrbit { scene, settings, orbit, events })
    }
}

impl FollowedOrbit<'_> {
    fn ending(&self) -> Ending<'_> {
        Ending::of(&self.orbit, Conclusion::of(&self.orbit, self.events.last()), &self.settings)
    }
}

impl Answer for FollowedOrbit<'_> {
    fn status(&self) -> Status {
        Status::from(&self.ending())
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        let mut listing = Listing::new(format, self.scene, &self.settings, Vec::new());
        listing.begin(&self.orbit)?;
        self.events.iter().try_for_each(|event| listing.event(event))?;
        Ok(Some(String::from_utf8(listing.end(&self.ending())?)?))
    }
}

/// The last line of the table of an orbit.
impl From<&Ending<'_>> for Status {
    fn from(ending: &Ending<'_>) -> Self {
        let status = Self::new(ending.is_complete(), ending.to_string());
        ending.advice().into_iter().enumerate().fold(status, |status, (k, advice)| {
            let before = if k == 0 { "; try " } else { " or " };
            match advice {
                Advice::NarrowerIntervals if k == 0 => status.say("; narrower intervals in the scene lead further"),
                Advice::NarrowerIntervals => status.say(", or narrower intervals in the scene"),
                Advice::FewerDigits => status.say(before).step(Step::Fewer("digits")),
                Advice::MoreBits => status.say(before).step(Step::More("max-bits")),
                Advice::AutoArithmetic => status.say(before).step(Step::Value("arithmetic", "auto")),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use impact_pair::watch::Unwatched;

    use crate::scenes::scene;
    use crate::{Answer as _, Asked, RunOptions, Verb as _, read_options};

    /// The status of the orbit of figure 14 with these options, in the words of the command line and of Python.
    fn said(options: &str) -> [String; 2] {
        let options: RunOptions = read_options(RunOptions::NAME, &serde_json::from_str(options).unwrap()).unwrap();
        let scene = scene("figure-14");
        let asked = Asked { scene: &scene, name: "scene.toml", is_drawn: false, is_document: false };
        let status = options.answer(&asked, &Unwatched).unwrap().status();
        [status.to_string(), status.in_python()]
    }

    #[test]
    fn what_leads_further_is_said_as_the_reader_writes_it() {
        let [own, python] = said(r#"{"impacts": 500, "max-bits": 64}"#);
        assert!(own.ends_with("; try fewer --digits or more --max-bits"), "{own}");
        assert!(python.ends_with("; try fewer digits or more max_bits"), "{python}");
        let [own, python] = said(r#"{"impacts": 500, "arithmetic": "interval"}"#);
        assert!(own.ends_with("; try --arithmetic auto"), "{own}");
        assert!(python.ends_with("; try arithmetic=\"auto\""), "{python}");
        let [own, python] = said(r#"{"impacts": 5}"#);
        assert_eq!(own, python);
    }
}
