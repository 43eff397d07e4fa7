//! Flights asked of the library and of the truth, and the judge between the two answers.
//!
//! The library's units: W = 2 pi, d = 1, A = alpha, tau = 0, so that the truth's time is the phase in forcing periods.

use impact_pair::contact::{Contact, Margins, Radii, Verdict, first_contact};
use impact_pair::flight::Flight;
use impact_pair::number::{Ball, kernel};
use impact_pair::pair::{Reduced, Wall as LibraryWall};
use impact_pair_truth::{Next, Shaken, State, Tone, Wall, float};
use rug::Float;
use rug::float::Constant;

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

/// 2 pi, to all bits.
pub fn turn() -> Float {
    float(Constant::Pi) * 2
}

/// A pair with `W = 2 pi`, `tau = 0` and `d = 1`.
pub fn reduced(alpha: Float, restitution: f64) -> Shaken {
    let tone = |amplitude| Tone { amplitude, frequency: turn(), phase: float(0) };
    let tones = if alpha.is_zero() { Vec::new() } else { vec![tone(alpha)] };
    Shaken { tones, gap: float(1), restitution: float(restitution) }
}

impl Case {
    /// `2 pi alpha` as the library's caller would round it.
    fn beta(&self) -> f64 {
        std::f64::consts::TAU * self.alpha
    }

    /// The flight as the library takes it.
    fn flight(&self) -> Flight<f64> {
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
        let rounding = float(turn() * self.alpha - self.beta()).to_f64().abs().next_up();
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

    /// The pair and the state of the member of the box `spread` at `offsets` (in radii, each in [-1, 1]) of phase, velocity, height and
    /// alpha; `None` when there is no such state.
    fn member(&self, spread: &Spread, offsets: [f64; 4]) -> Option<(Shaken, State)> {
        let at = |centre: f64, radius: f64, offset: f64| float(float(radius) * offset + centre);
        let radii = &spread.radii;
        let alpha = at(self.alpha, spread.alpha, offsets[3]);
        if alpha < 0 {
            return None;
        }
        let pair = reduced(alpha, 1.0);
        let phase = at(self.phase, radii.phase, offsets[0]);
        let velocity = at(self.velocity, radii.velocity, offsets[1]);
        let wall = match self.from {
            From::Left => Wall::Left,
            From::Right => Wall::Right,
            From::Inside(height) => {
                let position = at(height, radii.height, offsets[2]) - 0.5f64;
                let is_inside = float(position.abs_ref()) < 0.5f64;
                return is_inside.then(|| (pair, State::inside(phase, position, velocity)));
            }
        };
        let state = State::on_wall(&pair, wall, phase, float(&velocity * -wall.sign()));
        (velocity >= 0).then_some((pair, state))
    }
}

/// Whether the ball holds the number.
pub fn holds(ball: Ball, value: &Float) -> bool {
    float(value - ball.mid()).abs() <= ball.rad()
}

pub fn same_wall(library: LibraryWall, truth: Wall) -> bool {
    (library == LibraryWall::Left) == (truth == Wall::Left)
}

/// The first contradiction of a certified contact to that of one true start, in words, or `None`.
fn objection(found: &Contact<Ball>, start: &State, truth: &Next) -> Option<String> {
    let Next::Contact(contact) = truth else {
        return Some(format!("certified, but the truth is {truth:?}"));
    };
    if !same_wall(found.wall, contact.wall) {
        return Some(format!("wall {:?} at {}, but the truth is {contact:?}", found.wall, found.time.mid()));
    }
    let elapsed = float(&contact.time - &start.time);
    let phase = float(&contact.time - found.turns);
    let checks = [
        ("time", found.time, &elapsed),
        ("phase", found.phase, &phase),
        ("velocity", found.velocity, &contact.velocity_before),
    ];
    checks.iter().find(|(_, ball, value)| !holds(*ball, value)).map(|(name, ball, value)| {
        let off = float(*value - ball.mid()).abs().to_f64() / ball.rad();
        format!("{name} {} is {off} radii of {:e} away", value.to_f64(), ball.rad())
    })
}

/// Counts of a family of flights, and what went wrong in it.
#[derive(Default)]
pub struct Tally {
    pub name: String,
    pub requested: usize,
    certified: usize,
    undecided: usize,
    /// Rests, and never a contact: nothing to certify.
    nothing: usize,
    /// Grazes of the truth's own.
    skipped: usize,
    /// Widths of the time bracket in ulps of `turns + phase`.
    widths: Vec<f64>,
    failures: Vec<String>,
}

impl Tally {
    pub fn new(name: &str) -> Tally {
        Tally { name: name.into(), ..Tally::default() }
    }

    /// Puts the point flight to both.
    pub fn flight(&mut self, case: &Case) -> Option<Contact<Ball>> {
        self.requested += 1;
        let verdict = case.verdict(&case.point());
        let (pair, start) = case.member(&Spread::default(), [0.0; 4]).expect("a flight inside the gap");
        let truth = pair.next(&start);
        match (&verdict, &truth) {
            (_, Next::Touch(..) | Next::Open) => self.skipped += 1,
            (Verdict::Undecided(_), Next::Rests | Next::Never) => self.nothing += 1,
            (Verdict::Undecided(_), Next::Contact(_)) => self.undecided += 1,
            (Verdict::Certified(found), _) => {
                self.certified += 1;
                let total = found.turns + found.phase.mid();
                self.widths.push(2.0 * found.phase.rad() / (total.abs().next_up() - total.abs()));
                self.failures.extend(objection(found, &start, &truth).map(|why| format!("{why}: {case:?}")));
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
            let Some((pair, start)) = case.member(&spread, *offset) else { continue };
            let truth = pair.next(&start);
            if matches!(truth, Next::Touch(..) | Next::Open) {
                self.skipped += 1;
            } else if let Some(objection) = objection(&found, &start, &truth) {
                self.failures.push(format!("{objection} at {offset:?} of {spread:?}: {case:?}"));
            }
        }
    }

    /// Prints the counts; asserts that nothing failed, how many are undecided at most, and how wide the middle bracket is at most.
    pub fn finish(&mut self, most_undecided: f64, widest: f64) {
        self.widths.sort_by(f64::total_cmp);
        let middle = self.widths.get(self.widths.len() / 2).copied().unwrap_or(0.0);
        let rate = self.undecided as f64 / (self.certified + self.undecided).max(1) as f64;
        let Tally { name, requested, certified, nothing, skipped, failures, .. } = self;
        println!(
            "{name}: {requested} asked, {certified} certified, {:.4} % undecided, {nothing} without contact, {skipped} skipped, \
             {} failures; middle bracket {middle:.2} ulps",
            100.0 * rate,
            failures.len(),
        );
        assert!(
            failures.is_empty(),
            "{} failures in {name}: {:#?}",
            failures.len(),
            &failures[..failures.len().min(8)]
        );
        assert!(rate <= most_undecided, "{name}: {rate} are undecided");
        assert!(middle <= widest, "{name}: the middle bracket is {middle} ulps wide");
        // A truth that is never asked, or never decides, would pass anything.
        assert!(2 * *skipped <= *requested, "{name}: {skipped} of {requested} are left open by the truth");
    }
}
