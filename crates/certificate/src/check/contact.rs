//! The first contact of all flights of a set, proved by halving (Lemma V1).

use super::budget::Budget;
use super::flight::{Flight, Part};
use super::number::Number;
use super::span::Span;
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// A claim that is not confirmed, and the reason.
#[derive(Clone, Debug)]
pub(crate) enum Doubt {
    /// More bits, or smaller sets of data, may decide the claim.
    Open(String),
    /// The claim is proved to be false.
    False(String),
}

impl Doubt {
    /// An undecided claim, for this reason.
    pub fn open(reason: &str) -> Self {
        Self::Open(reason.into())
    }
}

/// Flight evaluations in doubles, beyond which a flight is followed in more bits.
const DOUBLES_WORK: u64 = 1 << 12;
/// Known bits of a contact for which doubles are enough: short flights, and wide sets, have fewer.
const KNOWN_IN_DOUBLES: u32 = 36;
/// Bits with which most parts of most flights are decided.
const FIRST_BITS: u32 = 128;
/// Halvings before Newton's iteration for a contact.
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
    /// The latest phase, if it is bounded by a claim.
    pub to: Option<Real>,
    /// True if the contact is the first; else any solution of the equations, reached from between the walls.
    pub is_first: bool,
}

/// Encloses the contact with `wall` near the guess: an interval of `h` that holds one contact of each flight, `y'` is not 0 on it,
/// and the ball is strictly between the walls from the departure to the beginning of the interval.
pub(super) fn first_contact(flight: &Flight, from: Start, wall: Wall, claimed: &Claimed) -> Result<Real, Doubt> {
    if let Some(contact) = first_contact_in_doubles(flight, from, wall, claimed) {
        return Ok(contact);
    }
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

/// [`first_contact`] in doubles, which decide most flights; `None` where they do not.
fn first_contact_in_doubles(flight: &Flight, from: Start, wall: Wall, claimed: &Claimed) -> Option<Real> {
    let doubles = flight.in_doubles(DOUBLES_WORK)?;
    let guess = Span::point(claimed.guess.to_f64());
    let (before, after) = bracket_near(&doubles, wall, &guess)?;
    if claimed.is_first {
        clear(&doubles, from, &before, &Span::point(0.0)).ok()?;
    }
    let contact = contract(&doubles, wall, before.hull(after)).in_bits(f64::MANTISSA_DIGITS)?;
    (known_bits(&contact) >= KNOWN_IN_DOUBLES).then_some(contact)
}

/// Leading bits that all members share, about.
pub(super) fn known_bits(x: &Real) -> u32 {
    let known = x.enclosure().mag().top().zip(x.wid().top()).map(|(large, small)| large - small);
    known.map_or(u32::MAX / 4, |known| u32::try_from(known).unwrap_or(0)) // proposes
}

/// Initial conditions of a flight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    /// The wall of the departure, if the ball departs from a wall.
    pub wall: Option<Wall>,
    /// True for a departure from rest, at the phase where the acceleration turns inward.
    pub is_release: bool,
}

fn isolate(flight: &Flight, from: Start, wall: Wall, claimed: &Claimed) -> Result<Real, Doubt> {
    let bits = flight.bits();
    let guessed = Real::point(claimed.guess.mid(), bits);
    let Some((before, after)) = bracket_near(flight, wall, &guessed) else {
        // No contact is found near the guess: there may be an earlier contact, or none at all.
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

/// Refutes a contact with `wall` within the claimed bounds, if all flights are proved to have none there (Lemma V1).
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

/// Two points around the contact with `wall` that Newton's iteration finds near the guess, as those of [`bracket`].
fn bracket_near<N: Number>(flight: &Flight<'_, N>, wall: Wall, guess: &N) -> Option<(N, N)> {
    let h = newton(flight, wall, guess);
    let is_near = h.is_positive() && !(guess.clone() + guess).is_below(&h);
    if is_near { bracket(flight, wall, &h) } else { None }
}

/// Two points around `h`: the ball is between the walls at the first, beyond `wall` at the second, and `y'` is not 0 between them.
fn bracket<N: Number>(flight: &Flight<'_, N>, wall: Wall, h: &N) -> Option<(N, N)> {
    let mut reach = h.half();
    for _ in 0..h.bits() {
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

/// Proves that the ball is strictly between the walls on `(0, end]`, up to the least member of `end`; `from` is the departure.
///
/// A contact before `claimed` proves the claim false; a later contact may be the claimed one.
pub(super) fn clear<N: Number>(flight: &Flight<'_, N>, from: Start, end: &N, claimed: &N) -> Result<(), Doubt> {
    let (mut at, mut width) = (end.nothing(), end.clone());
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
        let next = (at.clone() + &width).middle();
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
    // The length of the flight is doubled until the flight is not clear; then halving finds the last clear length.
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

/// [`clear`] in the fewest bits that suffice.
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
fn give_up_reason<N: Number>(budget: &Budget, at: &N, end: &N) -> Doubt {
    let times = (end.to_f64() / at.to_f64()).ceil(); // shown
    let is_estimated = budget.is_spent() && times.is_finite();
    let needed = if is_estimated { format!(": about {times:.0} times as much would do") } else { String::new() };
    Doubt::Open(format!("the flight is too long for the work allowed{needed}"))
}

/// Whether a part is too short for the arithmetic.
fn is_short<N: Number>(width: &N, whole: &N) -> bool {
    width.top().is_none_or(|short| whole.top().is_none_or(|long| long - short > i64::from(whole.bits()) / 2))
}

/// The limit of Newton's iteration from `guess`, beginning with the bits of `guess` and adding bits as digits become correct.
/// Non-rigorous.
pub(super) fn newton<N: Number>(flight: &Flight<'_, N>, wall: Wall, guess: &N) -> N {
    let most = flight.bits();
    let mut bits = guess.bits().min(most); // proposes: a guess of Newton's
    let mut h = guess.rounded(bits).middle();
    let mut before = None::<N>;
    for _ in 0..STEPS {
        let coarse = flight.rounded(bits).known_at(&h);
        let (height, slope) = (coarse.height(&h).middle(), coarse.slope(&h).middle());
        let Some(step) = (height - &coarse.level(wall).middle()).over(&slope) else { return h };
        let step = step.middle();
        // The step shows as many digits as the precision holds, or as rounding leaves.
        let size = step.size();
        let is_last = is_last(&step, &h) || before.is_some_and(|before| before.is_below(&(size.clone() + &size)));
        h = (h - &step).middle();
        before = Some(size);
        match (is_last, bits < most) {
            (true, false) => return h,
            (true, true) => (bits, before) = ((2 * bits).min(most), None), // proposes
            (false, _) => {}
        }
    }
    h
}

/// Whether a step of Newton's iteration, which doubles the digits, is the last step needed.
fn is_last<N: Number>(step: &N, h: &N) -> bool {
    step.top().is_none_or(|small| h.top().is_none_or(|large| 2 * (large - small) > i64::from(h.bits())))
}

/// The bracket cut by interval Newton as long as each step halves it: the result still holds all contacts (Lemma V1).
pub(super) fn contract<N: Number>(flight: &Flight<'_, N>, wall: Wall, bracket: N) -> N {
    let level = flight.level(wall);
    zero(bracket, |h| flight.height(h) - &level, |part| flight.slope(part))
}

/// The bracket cut by one step of interval Newton from a point in the bracket (Lemma V1).
pub(super) fn cut(flight: &Flight, wall: Wall, bracket: &Real, from: &Real) -> Real {
    let off = flight.height(from) - &flight.level(wall);
    off.over(&flight.slope(bracket)).map_or_else(|| bracket.clone(), |step| bracket.cut(&(from.clone() - &step)))
}

/// Encloses the only zero of each function of a set in a bracket, cut by interval Newton as long as each step halves it; `slope`
/// encloses the derivatives over a part of the bracket.
pub(super) fn zero<N: Number>(bracket: N, value: impl Fn(&N) -> N, slope: impl Fn(&N) -> N) -> N {
    let mut bracket = bracket;
    loop {
        let middle = bracket.middle();
        let Some(step) = value(&middle).over(&slope(&bracket)) else { return bracket };
        let cut = bracket.cut(&(middle - &step));
        let is_halved = is_halved(&cut, &bracket);
        bracket = cut;
        if !is_halved {
            return bracket;
        }
    }
}

/// Whether a set is less than half as wide as another one.
pub(super) fn is_halved<N: Number>(part: &N, whole: &N) -> bool {
    let width = part.width();
    (width.clone() + &width).is_below(&whole.width())
}
