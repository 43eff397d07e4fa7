//! Flights asked of the library and of the truth, and the judge between the two answers.
//!
//! The library's units: W = 2 pi, d = 1, A = alpha, tau = 0, so that the truth's time is the phase in forcing periods.
#![allow(dead_code)] // each test crate uses a part

use impact_pair::contact::{Contact, Margins, Radii, Verdict, first_contact};
use impact_pair::flight::Flight;
use impact_pair::number::{Ball, kernel};
use impact_pair::pair::{Reduced, Wall as LibraryWall};
use impact_pair_truth::{Problem, Start, Truth, Wall, pi_times, scan};
use rug::Float;

/// Bits of the truth.
pub const BITS: u32 = 320;

/// The place from which a flight starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum From {
    Left,
    Right,
    /// So high above the left wall.
    Inside(f64),
}

/// A box of flights around one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spread {
    pub radii: Radii,
    /// of alpha
    pub alpha: f64,
}

/// A flight in exact doubles; the velocity points away from the wall (for a start inside: to the right).
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub alpha: f64,
    pub phase: f64,
    pub velocity: f64,
    pub from: From,
}

impl Case {
    /// `2 pi alpha` as the library's caller would round it.
    pub fn beta(&self) -> f64 {
        std::f64::consts::TAU * self.alpha
    }

    /// The flight as the library takes it.
    pub fn flight(&self) -> Flight<f64> {
        let pair = Reduced { alpha: self.alpha, beta: self.beta(), restitution: 1.0 };
        let sin_cos = kernel::sin_cos(self.phase);
        match self.from {
            From::Left => Flight::from_wall(&pair, LibraryWall::Left, self.phase, self.velocity, sin_cos),
            From::Right => Flight::from_wall(&pair, LibraryWall::Right, self.phase, self.velocity, sin_cos),
            From::Inside(height) => Flight::from_inside(&pair, height, self.phase, self.velocity, sin_cos),
        }
    }

    /// The spread that a point flight needs: `2^-53` of height inside.
    pub fn point(&self) -> Spread {
        let height = if matches!(self.from, From::Inside(_)) { f64::EPSILON / 2.0 } else { 0.0 };
        Spread { radii: Radii { height, ..Radii::default() }, alpha: 0.0 }
    }

    /// The margins of the pairs within the spread; beta's radius covers its rounding.
    fn margins(&self, spread: &Spread) -> Margins {
        let rounding = float(pi_times(BITS, 2) * self.alpha - self.beta()).to_f64().abs().next_up();
        let beta = (std::f64::consts::TAU.next_up() * spread.alpha + rounding).next_up();
        Margins::new(&Reduced {
            alpha: Ball::new(self.alpha, spread.alpha),
            beta: Ball::new(self.beta(), beta),
            restitution: Ball::exact(1.0),
        })
    }

    /// The library's answer for all flights within the spread.
    pub fn verdict(&self, spread: &Spread) -> Verdict<Contact<Ball>> {
        first_contact(&self.flight(), &self.margins(spread), spread.radii)
    }

    /// The question put to the truth for the member of the box `spread` at `offsets` (in radii, each in [-1, 1]) of
    /// phase, velocity, height and alpha; `None` when there is no such state.
    pub fn member(&self, spread: &Spread, offsets: [f64; 4]) -> Option<(Problem, Start)> {
        let at = |centre: f64, radius: f64, offset: f64| float(float(radius) * offset + centre);
        let radii = &spread.radii;
        let alpha = at(self.alpha, spread.alpha, offsets[3]);
        if alpha < 0 {
            return None;
        }
        let problem = Problem::new(BITS, &alpha, "2*pi", 0, 1, 1);
        let phase = at(self.phase, radii.phase, offsets[0]);
        let velocity = at(self.velocity, radii.velocity, offsets[1]);
        let from_wall = |wall: Wall, velocity: &Float| {
            let inward = float(velocity * -wall.sign());
            (*velocity >= 0).then(|| Start::on_wall(&problem, wall, &phase, &inward))
        };
        let start = match self.from {
            From::Left => from_wall(Wall::Left, &velocity)?,
            From::Right => from_wall(Wall::Right, &velocity)?,
            From::Inside(height) => {
                let position = at(height, radii.height, offsets[2]) - 0.5f64;
                if float(position.abs_ref()) >= 0.5f64 {
                    return None;
                }
                Start::inside(&problem, &phase, &position, &velocity)
            }
        };
        Some((problem, start))
    }

    /// The question put to the truth for the flight itself.
    pub fn centre(&self) -> (Problem, Start) {
        self.member(&Spread::default(), [0.0; 4]).expect("a flight inside the gap")
    }
}

pub fn float<T>(value: T) -> Float
where
    Float: rug::Assign<T>,
{
    Float::with_val(2 * BITS, value)
}

pub fn holds(ball: Ball, value: &Float) -> bool {
    let distance = float(value - ball.mid()).abs();
    distance <= ball.rad()
}

pub fn same_wall(library: LibraryWall, truth: Wall) -> bool {
    matches!((library, truth), (LibraryWall::Left, Wall::Left) | (LibraryWall::Right, Wall::Right))
}

/// The first contradiction of a certified contact to that of one true start, in words, or `None`.
pub fn objection(found: &Contact<Ball>, start: &Start, truth: &Truth) -> Option<String> {
    let Truth::Contact { time, wall, velocity_before } = truth else {
        return Some(format!("certified, but the truth is {truth:?}"));
    };
    if !same_wall(found.wall, *wall) {
        return Some(format!("wall {:?} at {}, but the truth is {wall:?} at {time}", found.wall, found.time.mid()));
    }
    let elapsed = float(time - &start.time);
    let phase = float(time - found.turns);
    let checks =
        [("time", found.time, &elapsed), ("phase", found.phase, &phase), ("velocity", found.velocity, velocity_before)];
    checks.iter().find(|(_, ball, value)| !holds(*ball, value)).map(|(name, ball, value)| {
        let off = float(*value - ball.mid()).abs().to_f64() / ball.rad();
        format!("{name} {} is {off} radii of {:e} away", value.to_f64(), ball.rad())
    })
}

/// Counts of a category of flights, and what went wrong in it.
#[derive(Default)]
pub struct Tally {
    name: String,
    pub requested: usize,
    pub certified: usize,
    pub undecided: usize,
    /// Rests, never a contact, or a graze of the truth's own: nothing to certify.
    pub nothing: usize,
    pub skipped: usize,
    pub scanned: usize,
    /// Widths of the time bracket in ulps of `turns + phase`.
    pub widths: Vec<f64>,
    pub failures: Vec<String>,
    pub examples: Vec<Case>,
}

impl Tally {
    pub fn new(name: &str) -> Tally {
        Tally { name: name.into(), ..Tally::default() }
    }

    /// Puts the point flight to both; `points` > 0 also scans for earlier contacts.
    pub fn flight(&mut self, case: &Case, points: usize) -> Option<Contact<Ball>> {
        self.requested += 1;
        let verdict = case.verdict(&case.point());
        let (problem, start) = case.centre();
        let truth = impact_pair_truth::first_contact(&problem, &start);
        match (&verdict, &truth) {
            (_, Truth::Graze { .. }) => self.skipped += 1,
            (Verdict::Undecided(_), Truth::Rests | Truth::Never) => self.nothing += 1,
            (Verdict::Undecided(_), Truth::Contact { .. }) => {
                self.undecided += 1;
                if self.examples.len() < 3 {
                    self.examples.push(*case);
                }
            }
            (Verdict::Certified(found), _) => {
                self.certified += 1;
                let total = found.turns + found.phase.mid();
                let ulp = total.abs().next_up() - total.abs();
                self.widths.push(2.0 * found.phase.rad() / ulp);
                if let Some(objection) = objection(found, &start, &truth) {
                    self.fail(case, objection);
                } else if points > 0 {
                    self.scanned += 1;
                    let until = found.time.mid() - found.time.rad();
                    if let Some(earlier) = scan(&problem, &start, until, points) {
                        self.fail(case, format!("beyond the wall {earlier} after the start already"));
                    }
                }
            }
        }
        verdict.certified()
    }

    /// Asks for a box of flights and puts its corners and members at `offsets` to the truth.
    pub fn members(&mut self, case: &Case, spread: Spread, offsets: &[[f64; 4]]) {
        self.requested += 1;
        let Verdict::Certified(found) = case.verdict(&spread) else {
            self.undecided += 1;
            return;
        };
        self.certified += 1;
        for offset in offsets {
            let Some((problem, start)) = case.member(&spread, *offset) else { continue };
            let truth = impact_pair_truth::first_contact(&problem, &start);
            if matches!(truth, Truth::Graze { .. }) {
                self.skipped += 1;
            } else if let Some(objection) = objection(&found, &start, &truth) {
                self.fail(case, format!("{objection} at {offset:?} of {spread:?}"));
            }
        }
    }

    pub fn fail(&mut self, case: &Case, objection: String) {
        self.failures.push(format!("{objection}: {case:?}"));
    }

    pub fn undecided_rate(&self) -> f64 {
        self.undecided as f64 / (self.certified + self.undecided).max(1) as f64
    }

    pub fn quantile(&mut self, part: f64) -> f64 {
        self.widths.sort_by(f64::total_cmp);
        let last = self.widths.len().saturating_sub(1);
        self.widths.get((last as f64 * part) as usize).copied().unwrap_or(f64::NAN)
    }

    /// Prints the counts and panics if anything failed.
    pub fn finish(&mut self) {
        let quantiles = [0.05, 0.25, 0.5, 0.75, 0.95, 1.0].map(|part| format!("{:.3}", self.quantile(part)));
        println!(
            "{}: {} asked, {} certified, {} undecided ({:.4} %), {} without contact, {} skipped, {} scanned, \
             {} failures; time bracket in ulps {}",
            self.name,
            self.requested,
            self.certified,
            self.undecided,
            100.0 * self.undecided_rate(),
            self.nothing,
            self.skipped,
            self.scanned,
            self.failures.len(),
            quantiles.join(" "),
        );
        if std::env::var_os("IMPACT_PAIR_EXAMPLES").is_some() {
            println!("  undecided, for example {:?}", self.examples);
        }
        let shown: Vec<_> = self.failures.iter().take(8).collect();
        assert!(self.failures.is_empty(), "{} failures in {}: {shown:#?}", self.failures.len(), self.name);
    }
}
