//! The first contact of all flights of a set, proved by halving (Lemma V1).

use super::budget::Budget;
use super::flight::{Flight, Part};
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::Wall;

/// A claim that is not confirmed, and the reason.
#[derive(Clone, Debug)]
pub(crate) enum Doubt {
    /// More bits, or smaller sets of data, may tell.
    Open(String),
    /// The claim is proved to be false.
    False(String),
}

impl Doubt {
    /// Returns the doubt about what is left open for this reason.
    pub fn open(reason: &str) -> Self {
        Self::Open(reason.into())
    }
}

/// Bits that most parts of most flights are judged with.
const FIRST_BITS: u32 = 128;
/// Halvings that find a contact for Newton's iteration.
const BISECTION_BITS: u32 = 20;
/// Steps of Newton's iteration from a guess.
const STEPS: u32 = 64;

/// The claimed place of a contact: phases since the departure.
#[derive(Clone, Debug)]
pub(crate) struct Claimed {
    /// The earliest phase.
    pub from: Real,
    /// An approximate place, near which the contact is sought.
    pub guess: Real,
    /// The latest phase, where a claim gives one.
    pub to: Option<Real>,
    /// True if it is the first contact; else any that solves the equations, reached from between the walls.
    pub is_first: bool,
}

/// The contact with `wall` near the guess: an interval of `h` that holds one contact of each flight, `y'` not 0 on it, and the
/// ball strictly between the walls from the departure to its beginning.
pub(super) fn first_contact(flight: &Flight, from: Start, wall: Wall, claimed: &Claimed) -> Result<Real, Doubt> {
    let most = flight.bits();
    let mut bits = FIRST_BITS;
    loop {
        let coarse = flight.rounded(bits.min(most)); // X1: any number of bits encloses
        match isolate(&coarse, from, wall, claimed) {
            Err(Doubt::Open(_)) if bits < most && !coarse.budget.is_spent() => bits *= 4,
            Err(doubt) => return Err(doubt),
            Ok(bracket) => return Ok(contract(&coarse, wall, bracket)),
        }
    }
}

/// Initial conditions of a flight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    /// The wall it leaves, if it does.
    pub wall: Option<Wall>,
    /// True if it begins at rest, at the phase where the acceleration turns inward.
    pub is_release: bool,
}

fn isolate(flight: &Flight, from: Start, wall: Wall, claimed: &Claimed) -> Result<Real, Doubt> {
    let bits = flight.bits();
    let guessed = Real::point(claimed.guess.mid(), bits);
    let h = newton(flight, wall, &guessed);
    let is_near = |x: &Real| x.is_positive() && !(guessed.clone() + &guessed).is_below(x);
    let Some((before, after)) = Some(&h).filter(|h| is_near(h)).and_then(|h| bracket(flight, wall, h)) else {
        // No contact is found near the guess: one before it may be, or none at all.
        if claimed.is_first {
            refute(flight, from, wall, claimed)?;
            clear(flight, from, &guessed, &claimed.from)?;
        }
        return Err(Doubt::Open(format!("no contact with the {} wall is found there", wall.name())));
    };
    if claimed.is_first {
        clear(flight, from, &before, &claimed.from)?;
    }
    Ok(before.hull(&after))
}

/// Refutes a contact with `wall` within the claimed bounds, if none is proved to come there (Lemma V1).
fn refute(flight: &Flight, from: Start, wall: Wall, claimed: &Claimed) -> Result<(), Doubt> {
    let Some(to) = &claimed.to else { return Ok(()) };
    let [_, to] = to.rounded(flight.bits()).ends();
    if flight.height(&claimed.from.hull(&to)).is_apart_from(&flight.level(wall)) {
        return Err(Doubt::False(format!("the ball is not at the {} wall then", wall.name())));
    }
    match clear(flight, from, &to, &claimed.from) {
        Ok(()) => Err(Doubt::False(format!("no contact with the {} wall comes by then", wall.name()))),
        Err(Doubt::Open(_)) => Ok(()),
        Err(doubt) => Err(doubt),
    }
}

/// Two points around `h`, the ball between the walls at the first and beyond `wall` at the second, `y'` not 0 between them.
fn bracket(flight: &Flight, wall: Wall, h: &Real) -> Option<(Real, Real)> {
    let bits = h.bits();
    let mut reach = h.half();
    for _ in 0..bits {
        let (before, after) = (h.clone() - &reach, h.clone() + &reach);
        let slope = flight.slope(&before.hull(&after));
        let arrives = if wall == Wall::Right { slope.is_positive() } else { slope.is_negative() };
        if arrives && matches!(flight.place(&flight.height(&before)), Part::Clear) {
            let (end, level) = (flight.height(&after), flight.level(wall));
            let is_beyond = if wall == Wall::Right { level.is_below(&end) } else { end.is_below(&level) };
            return is_beyond.then_some((before, after));
        }
        reach = reach.half();
    }
    None
}

/// The ball is strictly between the walls on all of `(0, end]`, up to the least member of `end`, where the flight begins as `from` says.
///
/// A contact before `claimed` proves the claim false; a later one may be what is claimed.
pub(super) fn clear(flight: &Flight, from: Start, end: &Real, claimed: &Real) -> Result<(), Doubt> {
    let bits = end.bits();
    let (mut at, mut width) = (Real::zero(bits), end.clone());
    if let Some(wall) = from.wall {
        while !flight.departs(wall, &width, from.is_release) {
            width = width.half();
            if is_short(&width, end) || flight.budget.is_spent() {
                return Err(Doubt::Open(format!("the ball is not proved to leave the {} wall", wall.name())));
            }
        }
        at = width.clone();
    }
    for _ in 0..flight.budget.parts {
        if !at.is_below(end) {
            return Ok(());
        }
        if flight.budget.is_spent() {
            break;
        }
        let next = Real::point((at.clone() + &width).mid(), bits);
        let next = if next.is_below(end) { next } else { end.clone() };
        match flight.judge(&at, &next) {
            Part::Clear => (at, width) = (next, width.clone() + &width),
            Part::Contact if next.is_below(claimed) => return Err(Doubt::False("an earlier contact is proved".into())),
            Part::Contact => return Err(Doubt::open("an earlier contact is proved, within the bounds")),
            Part::Open => width = width.half(),
        }
        if is_short(&width, end) {
            return Err(Doubt::open("an earlier contact is not excluded"));
        }
    }
    Err(give_up_reason(&flight.budget, &at, end))
}

/// Approximate end of the first part of a flight by whose end a wall is hit; `None` if none is found.
pub(super) fn first_hit(flight: &Flight, from: Start) -> Option<Real> {
    let bits = flight.bits();
    let (mut end, no_claim) = (Real::int(1, bits), Real::zero(bits));
    // Ever twice as long a flight, until it is not clear; then the last length that is clear by halving.
    let is_clear = |end: &Real| clear_throughout(flight, from, end, &no_claim).is_ok();
    while is_clear(&end) {
        end = end.clone() + &end;
        if flight.budget.is_spent() || is_short(&Real::int(1, bits), &end) {
            return None;
        }
    }
    let (mut clear, mut hit) = (Real::zero(bits), end);
    for _ in 0..BISECTION_BITS {
        let middle = Real::point(clear.hull(&hit).mid(), bits);
        if is_clear(&middle) { clear = middle } else { hit = middle }
    }
    Some(hit)
}

/// The same, in as few bits as will do.
pub(super) fn clear_throughout(flight: &Flight, from: Start, end: &Real, claimed: &Real) -> Result<(), Doubt> {
    let most = flight.bits();
    let mut bits = FIRST_BITS;
    loop {
        let coarse = flight.rounded(bits.min(most)); // X1: any number of bits encloses
        let [_, last] = end.rounded(coarse.bits()).ends();
        match clear(&coarse, from, &last, claimed) {
            Err(Doubt::Open(_)) if bits < most && !coarse.budget.is_spent() => bits *= 4,
            answer => return answer,
        }
    }
}

/// The reason why a flight is not followed to its end.
fn give_up_reason(budget: &Budget, at: &Real, end: &Real) -> Doubt {
    let times = (end.to_f64() / at.to_f64()).ceil(); // shown
    let is_estimated = budget.is_spent() && times.is_finite();
    let needed = if is_estimated { format!(": about {times:.0} times as much would do") } else { String::new() };
    Doubt::Open(format!("the flight is too long for the work allowed{needed}"))
}

/// Returns whether a part is too short for the arithmetic.
fn is_short(width: &Real, whole: &Real) -> bool {
    let top = |x: &Real| x.enclosure().mag().top();
    top(width).is_none_or(|short| top(whole).is_none_or(|long| long - short > i64::from(whole.bits()) / 2))
}

/// The limit of Newton's plain iteration from `guess`; it begins with the bits of `guess` and takes as many as its digits are
/// worth. Nothing is proved of it.
pub(super) fn newton(flight: &Flight, wall: Wall, guess: &Real) -> Real {
    let most = flight.bits();
    let mut bits = guess.bits().min(most); // proposes: a guess of Newton's
    let mut h = Real::point(guess.mid(), bits);
    let mut before = None;
    for _ in 0..STEPS {
        let coarse = flight.rounded(bits);
        let point = |x: Real| Real::point(x.mid(), bits);
        let (height, slope) = (point(coarse.height(&h)), point(coarse.slope(&h)));
        let Some(step) = (height - &point(coarse.level(wall))).over(&slope) else { return h };
        let step = point(step);
        // As many digits as the precision holds, or as rounding leaves of them.
        let size = step.enclosure().mag();
        let is_last = is_last(&step, &h) || before.is_some_and(|before| size.scaled(1) > before);
        h = point(h - &step);
        before = Some(size);
        match (is_last, bits < most) {
            (true, false) => return h,
            (true, true) => (bits, before) = ((2 * bits).min(most), None), // proposes
            (false, _) => {}
        }
    }
    h
}

/// Returns whether a step of Newton's iteration, which doubles the digits, is the last one needed.
fn is_last(step: &Real, h: &Real) -> bool {
    let top = |x: &Real| x.enclosure().mag().top();
    top(step).is_none_or(|small| top(h).is_none_or(|large| 2 * (large - small) > i64::from(h.bits())))
}

/// The bracket cut by interval Newton for as long as that halves it: it still holds all contacts (Lemma V1).
pub(super) fn contract(flight: &Flight, wall: Wall, bracket: Real) -> Real {
    let level = flight.level(wall);
    zero(bracket, |h| flight.height(h) - &level, |part| flight.slope(part))
}

/// A bracket of the only zero of a function, and of all functions of a set, cut by interval Newton for as long as that halves
/// it; `slope` holds their derivatives over a part of it.
pub(super) fn zero(bracket: Real, value: impl Fn(&Real) -> Real, slope: impl Fn(&Real) -> Real) -> Real {
    let mut bracket = bracket;
    loop {
        let middle = Real::point(bracket.mid(), bracket.bits());
        let Some(step) = value(&middle).over(&slope(&bracket)) else { return bracket };
        let cut = bracket.cut(&(middle - &step));
        let is_halved = width(&cut).scaled(1) < width(&bracket);
        bracket = cut;
        if !is_halved {
            return bracket;
        }
    }
}

fn width(x: &Real) -> Dyadic {
    x.enclosure().wid()
}
