//! Comparison of another simulator's list of impacts with the certified orbit.
//!
//! ```
//! use impact_pair::Scene;
//! use impact_pair::audit::{AuditSettings, Audit, Columns, Verdict, read};
//! use impact_pair::watch::Unwatched;
//!
//! let scene = Scene::parse(r#"
//!     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
//!     pair = { gap = "3*pi", restitution = 0.5 }
//!     start = { time = 0, wall = "left", velocity = "-4*pi" }
//! "#)?;
//! // The exact orbit touches the walls at t = 1, 2, 3: the last time is wrong.
//! let list = read("time,wall\n1,right\n2,left\n3.1,right", &Columns::default(), scene.pair())?;
//! let audit = Audit::of(&scene, list, &AuditSettings::default(), &Unwatched)?;
//! let verdicts: Vec<Verdict> = audit.findings().iter().map(|finding| finding.verdict).collect();
//! assert_eq!(verdicts, [Verdict::Inside, Verdict::Inside, Verdict::Outside]);
//! assert!(!audit.is_agreed());
//! # Ok::<(), impact_pair::Error>(())
//! ```

mod align;
mod document;
mod doubles;
mod finding;
mod judge;
mod list;
#[cfg(test)]
mod matching;
#[cfg(test)]
mod tests;
mod tolerance;
mod truth;
mod verdict;

pub use doubles::{Doubles, Parting};
pub use finding::{Errors, Finding};
pub use judge::Divergence;
pub use list::{Column, Columns, List, Listed, Number, read};
pub use truth::{Rest, Site, SiteKind};
pub use verdict::{Reason, Verdict};

use std::cmp::Ordering;

use num_rational::BigRational;

use crate::contact::Reason as Doubt;
use crate::exact::{Enclosure, Exact};
use crate::orbit::Conclusion;
use crate::orbit::{Arithmetic, MAX_BITS, Settings};
use crate::scales::Scales;
use crate::scene::{DIGITS, Run};
use crate::watch::Watch;
use crate::{Error, Scene};
use judge::Comparison;
use tolerance::Tolerance;
use truth::Truth;

/// Digits that the truth has beyond those of the tolerance, so that its own width does not matter.
const EXTRA_DIGITS: u32 = 3;

/// Settings of an audit.
#[derive(Clone, Debug)]
pub struct AuditSettings {
    /// Tolerance: accepted difference of a time, in periods `2 pi/W`, and of a velocity, in `A W`.
    pub tolerance: Exact,
    /// Time up to which the list is compared \[time\]: later rows are ignored. By default the last time in the list.
    pub until: Option<Exact>,
    /// Digits of the certified orbit; by default three more than the tolerance has.
    pub digits: Option<u32>,
    /// Maximum precision of the certified orbit, in bits.
    pub max_bits: u32,
}

impl Default for AuditSettings {
    /// A tolerance of `10^-9`, up to the last time in the list.
    fn default() -> Self {
        let tolerance = "1e-9".parse().expect("a number");
        Self { tolerance, until: None, digits: None, max_bits: MAX_BITS }
    }
}

impl AuditSettings {
    /// Settings of the certified orbit up to the time `until`.
    fn settings(&self, until: Exact) -> Settings {
        let run = Run { impacts: None, until: Some(until), digits: Some(self.digits()) };
        Settings { max_bits: self.max_bits, ..run.settings(Arithmetic::Auto) }
    }

    /// The requested digits, or the digits that the tolerance needs.
    fn digits(&self) -> u32 {
        self.digits.unwrap_or_else(|| {
            let (_, size) = self.tolerance.enclose(64).to_f64_bounds();
            let digits = if size > 0.0 { -size.log10().floor() } else { f64::from(Settings::default().digits) }; // proposes
            // proposes
            (digits as u32 + EXTRA_DIGITS).clamp(*DIGITS.start(), *DIGITS.end())
        })
    }
}

/// A list compared with the certified orbit.
///
/// **Cost**: of a list of `n` rows the orbit is followed to its end, but not beyond `2 n + 1000` impacts, and `2^16` more in a row on
/// one wall: then the list lacks more impacts than it has rows, and the rows that come later are [not reached](Verdict::NotReached).
pub struct Audit<'s> {
    /// Scene of the list's impacts.
    pub scene: &'s Scene,
    /// Rows that are compared.
    pub rows: Vec<Listed>,
    /// Number of rows after the end of the comparison.
    pub left_out: usize,
    /// Columns of the list that are not read.
    pub unused: Vec<String>,
    /// True if the list has no velocities, although they are looked for.
    lacks_velocities: bool,
    /// The end of the comparison: the requested time (an irrational one a little later), or the last one listed.
    end: BigRational,
    settings: Settings,
    tolerance: Tolerance,
    truth: Truth,
    judgement: Comparison,
    /// Orbits in doubles, compared in the same way.
    pub doubles: Doubles,
}

impl<'s> Audit<'s> {
    /// Compares the rows of `list` with the certified orbit of a scene, until interrupted by the watch.
    ///
    /// # Errors
    /// If there is no row, or the time to compare up to is out of range ([`ErrorKind::List`](crate::ErrorKind::List), or the
    /// key `until`), or the scene's values exceed the range of orbits.
    pub fn of(scene: &'s Scene, list: List, requested: &AuditSettings, watch: &dyn Watch) -> Result<Self, Error> {
        let List { mut rows, unused, velocities } = list;
        let lacks_velocities = velocities && rows.iter().all(|row| row.velocity.is_none());
        let listed = rows.len();
        let end = match &requested.until {
            Some(until) if until.compare(scene.start().time()) == Some(Ordering::Less) => {
                let (until, start) = (until.text(), scene.start().time().text());
                let message = format!("until is `{until}`, but accepted is a time from the start on, {start}");
                return Err(Error::out_of_range("until", message));
            }
            Some(until) => {
                let rounded_up = || until.enclose(Tolerance::GUARD).sup().to_rational();
                let end = until.as_rational().cloned().unwrap_or_else(rounded_up);
                rows.retain(|row| row.time.low <= end);
                end
            }
            None => rows.iter().map(|row| row.time.high.clone()).max().ok_or_else(|| Error::list("no row".into()))?,
        };
        let tolerance = Tolerance::new(scene, &requested.tolerance, requested.digits())?;
        // A listed impact may be early: the truth is followed for a period more.
        let after = &end + tolerance.scales.period.sup().to_rational();
        let settings = requested.settings(Exact::from_rational(after));
        let truth = Truth::follow(scene, settings.clone(), &tolerance, rows.len(), watch);
        let truth = truth.map_err(|error| match error.key() {
            Some("run.until") => out_of_reach(requested, &rows, scene.start().time()),
            _ => error,
        })?;
        let judgement = Comparison::new(&truth, &rows, (&end, listed == rows.len()), &tolerance);
        let doubles = Doubles::judge(scene, &settings, &truth, &end, &tolerance, watch)?;
        let left_out = listed - rows.len();
        Ok(Self {
            scene,
            rows,
            left_out,
            unused,
            lacks_velocities,
            end,
            settings,
            tolerance,
            truth,
            judgement,
            doubles,
        })
    }

    /// Units of the tolerance.
    pub fn scales(&self) -> &Scales<Enclosure> {
        &self.tolerance.scales
    }

    /// Tolerance, relative to [`scales`](Self::scales).
    pub fn tolerance(&self) -> &Exact {
        &self.tolerance.relative
    }

    /// Requested digits of the certified orbit.
    pub fn digits(&self) -> u32 {
        self.settings.digits
    }

    /// Findings in the order of the list, with missed impacts in between.
    pub fn findings(&self) -> &[Finding] {
        &self.judgement.findings
    }

    /// Place where the list diverges from the orbit; `None` if it does not.
    pub fn departure(&self) -> Option<Divergence> {
        self.judgement.departure
    }

    /// Number of findings with a verdict that satisfies a condition.
    pub fn count(&self, is: impl Fn(Verdict) -> bool) -> usize {
        self.findings().iter().filter(|finding| is(finding.verdict)).count()
    }

    /// First finding that disagrees.
    pub fn first_disagreement(&self) -> Option<&Finding> {
        self.judgement.first_disagreement()
    }

    /// Row that a finding is about.
    pub fn row(&self, finding: &Finding) -> Option<&Listed> {
        finding.row.map(|row| &self.rows[row])
    }

    /// Certified contact that a finding is about.
    pub fn site(&self, finding: &Finding) -> Option<&Site> {
        finding.site.map(|site| &self.truth.sites[site])
    }

    /// Number of the impact that a finding is about: of a false row the nearest one.
    pub fn impact(&self, finding: &Finding) -> u64 {
        self.site(finding).map_or(0, |site| site.index)
    }

    /// First impact whose enclosure is wider than the requested digits.
    pub fn first_wide(&self) -> Option<u64> {
        self.truth.wide
    }

    /// Whether the certified orbit ends before the end of the comparison.
    pub fn is_open(&self) -> bool {
        self.truth.doubtful_from.as_ref().is_some_and(|from| from.inf().to_rational() <= self.end)
    }

    /// Whether nothing disagrees and nothing is undecided.
    pub fn is_agreed(&self) -> bool {
        !self.is_open() && self.count(|verdict| verdict.disagrees() || verdict == Verdict::Undecided) == 0
    }

    /// Result in one line.
    pub fn conclusion(&self) -> String {
        let hint = match self.hint() {
            Some(Hint::Velocity) => "; velocities are expected just before the impact",
            Some(Hint::Precision) | None => "",
        };
        let unused =
            if self.unused.is_empty() { String::new() } else { format!("; not read: {}", self.unused.join(", ")) };
        format!("{}{hint}{unused}", self.verdict())
    }

    /// Whether the list agrees, in words.
    pub fn verdict(&self) -> String {
        let open = self.is_open().then(|| self.truth.message());
        match (self.count(Verdict::disagrees), open) {
            (0, None) if self.is_agreed() => format!("agreed: all {} listed", self.rows.len()),
            (0, None) => format!(
                "undecided: {} of {} listed",
                self.count(|verdict| verdict == Verdict::Undecided),
                self.rows.len()
            ),
            (0, Some(open)) => open,
            (n, open) => {
                let impacts = if n == 1 { "impact" } else { "impacts" };
                format!("disagreed: {n} {impacts}{}", open.map_or(String::new(), |open| format!("; {open}")))
            }
        }
    }

    /// What may help where the list does not agree.
    pub fn hint(&self) -> Option<Hint> {
        let is_short = |conclusion: &Conclusion| conclusion.reason() == Some(Doubt::Precision);
        if self.is_open() && is_short(&self.truth.conclusion) {
            return Some(Hint::Precision);
        }
        // Wrong in velocity alone from the first impact on: it may be another velocity.
        let first = self.first_disagreement()?;
        let errors = first.errors.as_ref()?;
        let is_velocity = !self.tolerance.is_outside_in_time(&errors.time) && self.impact(first) <= 1;
        is_velocity.then_some(Hint::Velocity)
    }

    /// True if the list has no velocities, although they are looked for.
    pub fn lacks_velocities(&self) -> bool {
        self.lacks_velocities
    }
}

/// What may help where a list does not agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hint {
    /// More bits, or fewer digits of the certified orbit.
    Precision,
    /// The velocities just before the impacts, or none.
    Velocity,
}

/// Error that the requested end of the comparison is before the start, or later than an orbit can be followed.
fn out_of_reach(requested: &AuditSettings, rows: &[Listed], start: &Exact) -> Error {
    const BEYOND_LATEST_TIME: &str = "later than an orbit can be followed to";
    let latest = rows.iter().max_by(|one, other| one.time.high.cmp(&other.time.high));
    match (&requested.until, latest) {
        (None, Some(Listed { place, time, .. })) => {
            let is_early = Exact::from_rational(time.high.clone()).compare(start) == Some(Ordering::Less);
            let why =
                if is_early { format!("before the start at {}", start.text()) } else { BEYOND_LATEST_TIME.to_owned() };
            Error::list(format!("{place}: time is `{}`, {why}", time.written))
        }
        (until, _) => {
            let until = until.as_ref().map_or(String::new(), Exact::text);
            Error::out_of_range("until", format!("until is `{until}`, {BEYOND_LATEST_TIME}"))
        }
    }
}
