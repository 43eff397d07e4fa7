//! `impact-pair audit SCENE EVENTS`: another simulator's list of impacts, judged by the certified orbit.

mod align;
pub mod arguments;
mod document;
mod doubles;
mod judge;
mod list;
mod table;
mod tolerance;
mod truth;
mod verdict;

use std::io::{self, IsTerminal, Write};

use anyhow::{Context, Error, Result, anyhow, bail};
use impact_pair::Scene;
use impact_pair::contact::Reason;
use impact_pair::document::Conclusion;
use impact_pair::exact::Exact;
use impact_pair::orbit::Settings;
use num_rational::BigRational;

use crate::Answer;
use crate::output::Output;
use crate::progress::{Progress, interruption};
use crate::scene;
use arguments::{AuditArguments, AuditFormat};
use doubles::Doubles;
use judge::Judgement;
use list::{Listed, Walls};
use tolerance::Tolerance;
use truth::Truth;
use verdict::Verdict;

/// A list and what is found of it.
pub struct Audit<'a> {
    scene: &'a Scene,
    /// What is judged.
    rows: &'a [Listed],
    /// Rows after the time to judge up to.
    left_out: usize,
    /// The time to judge up to: that asked for (an irrational one a little later), or the last one listed.
    end: BigRational,
    settings: Settings,
    tolerance: Tolerance,
    truth: Truth,
    judgement: Judgement,
    /// The same of orbits in doubles.
    doubles: Doubles,
}

pub fn audit(arguments: &AuditArguments) -> Result<Answer> {
    if arguments.scene.as_os_str() == "-" && arguments.events.as_os_str() == "-" {
        bail!("scene and events are both -, but stdin is only one of them");
    }
    let scene = scene::read(&arguments.scene)?;
    let named = || scene::name(&arguments.events);
    let text = scene::text(&arguments.events)?;
    let mut rows = list::read(&text, &arguments.columns(), &Walls::new(scene.pair().gap())).with_context(named)?;
    for input in [&arguments.scene, &arguments.events] {
        scene::keep(input, arguments.output.as_deref())?;
    }

    // From here on Ctrl-C keeps what is certified.
    interruption();
    let mut out = Output::open(arguments.output.as_deref())?;
    let visible = !arguments.quiet && io::stderr().is_terminal();
    let progress = Progress::new(Some(rows.len() as u64), visible);
    let audit = Audit::new(&scene, &mut rows, arguments, &progress)?;
    progress.clear();

    let text = match arguments.format {
        AuditFormat::Table => table::table(&audit, &named(), arguments.all),
        AuditFormat::Json => document::text(&audit),
    };
    let said_already = arguments.format == AuditFormat::Table && out.is_stdout();
    out.write_all(text.as_bytes()).context("cannot write the output")?;
    out.commit()?;
    if !audit.is_agreed() && !arguments.quiet && !said_already {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{}", audit.conclusion());
    }
    Ok(if audit.is_agreed() { Answer::Complete } else { Answer::Incomplete })
}

impl<'a> Audit<'a> {
    /// Judges `rows` up to the time asked for; later ones are left out.
    fn new(
        scene: &'a Scene,
        rows: &'a mut Vec<Listed>,
        arguments: &AuditArguments,
        progress: &Progress,
    ) -> Result<Self> {
        let listed = rows.len();
        let end = match &arguments.until {
            Some(until) => {
                let rounded_up = || until.enclose(Tolerance::GUARD).hi().to_rational();
                let end = until.as_rational().cloned().unwrap_or_else(rounded_up);
                rows.retain(|row| row.time.low <= end);
                end
            }
            None => rows.iter().map(|row| row.time.high.clone()).max().context("no row")?,
        };
        // A listed impact may be early: the truth is followed for a period more.
        let digits = arguments.settings(Exact::from(0)).digits;
        let tolerance = Tolerance::new(scene, &arguments.tolerance, digits);
        let after = &end + tolerance.scales.period.hi().to_rational();
        let settings = arguments.settings(Exact::from_rational(after));
        let truth = Truth::follow(scene, settings.clone(), &tolerance, progress);
        let truth = truth.map_err(|error| match error.key() {
            Some("run.until") => too_late(arguments, rows),
            _ => Error::from(error).context(scene::name(&arguments.scene)),
        })?;
        let judgement = Judgement::new(&truth, rows, &end, &tolerance);
        let doubles = Doubles::judge(scene, &settings, &truth, &end, &tolerance)?;
        let left_out = listed - rows.len();
        Ok(Self { scene, rows, left_out, end, settings, tolerance, truth, judgement, doubles })
    }

    /// Whether what is certified ends before the time to judge up to.
    fn is_open(&self) -> bool {
        self.truth.doubtful_from.as_ref().is_some_and(|from| from.lo().to_rational() <= self.end)
    }

    /// Whether nothing disagrees and nothing is undecided.
    fn is_agreed(&self) -> bool {
        !self.is_open() && self.judgement.count(|verdict| verdict.disagrees() || verdict == Verdict::Undecided) == 0
    }

    /// One line in words, with what else there is to try.
    fn conclusion(&self) -> String {
        let open = self.is_open().then(|| self.truth.conclusion.message().to_owned());
        let mut said = match (self.judgement.count(Verdict::disagrees), open) {
            (0, None) => format!("agreed: all {} listed", self.rows.len()),
            (0, Some(open)) => open,
            (n, open) => {
                let impacts = if n == 1 { "impact" } else { "impacts" };
                format!("disagreed: {n} {impacts}{}", open.map_or(String::new(), |open| format!("; {open}")))
            }
        };
        if let Some(hint) = self.hint() {
            said += &format!("; {hint}");
        }
        said
    }

    fn hint(&self) -> Option<&'static str> {
        let is_short = |conclusion: &Conclusion| conclusion.reason() == Some(Reason::Precision);
        if self.is_open() && is_short(&self.truth.conclusion) {
            return Some("try more --max-bits or fewer --digits");
        }
        // Wrong in velocity alone from the first impact on: it may be another velocity.
        let first = self.judgement.first_disagreement()?;
        let errors = first.errors.as_ref()?;
        let is_velocity =
            !self.tolerance.is_outside_in_time(&errors.time) && self.judgement.impact(first, &self.truth) <= 1;
        is_velocity
            .then_some("velocities are asked for just before the impact; --no-velocity judges times and walls only")
    }
}

/// The error that the time to judge up to is beyond what an orbit can be followed to.
fn too_late(arguments: &AuditArguments, rows: &[Listed]) -> Error {
    let latest = rows.iter().max_by(|one, other| one.time.high.cmp(&other.time.high));
    match (&arguments.until, latest) {
        (None, Some(Listed { place, time, .. })) => {
            let list = scene::name(&arguments.events);
            anyhow!("{list}: {place}: time is `{}`, later than an orbit can be followed to", time.written)
        }
        (until, _) => {
            let until = until.as_ref().map_or(String::new(), Exact::text);
            anyhow!("--until is `{until}`, later than an orbit can be followed to")
        }
    }
}
