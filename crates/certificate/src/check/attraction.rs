//! Claims about a periodic orbit that the motion converges to.
//!
//! Method (Lemma V6): from the last of the claimed impacts, which are confirmed before, Newton's iteration seeks a state that
//! recurs after a period of the word. An ellipse around that state is proved to be mapped into itself and contracted
//! ([`basin`](super::basin)), and the motion is proved to enter it. A narrow ellipse of the same axes then encloses the orbit
//! ([`fixed_point`](super::fixed_point)), which must lie in the claimed bounds.

use super::basin::{Ellipse, basin, contracted};
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::frame::{ClaimedImpact, Frame};
use super::round::Round;
use super::step::Landing;
use super::target::{BITS, Target};
use crate::Certificate;
use impact_pair_exact::Real;
use impact_pair_model::vocabulary::OutcomeKind;

/// Greatest number of pieces into which the interval data are cut.
const MAX_PIECES: usize = 256;
/// Flight evaluations that each piece allows for the next piece.
const WORK_PER_PIECE: u64 = 1 << 14;
/// Greatest number of periods that a motion is followed beyond the claimed impacts.
const MAX_PERIODS: u32 = 1 << 10;

impl Certificate {
    /// Proves that the motion converges to the claimed orbit, if the outcome claims it; the data are cut into at most `most` pieces.
    pub(super) fn attracts(&self, data: &Data, most: usize) -> Result<(), Doubt> {
        if self.outcome() != OutcomeKind::Attracted {
            return Ok(());
        }
        let claim = self.attraction().ok_or_else(|| Doubt::False("the outcome has no orbit".into()))?;
        if !claim.is_attractor(data.has_mirror().is_some()) {
            return Err(Doubt::False("only an orbit that is unique, admissible and stable is an attractor".into()));
        }
        let target = Target::new(data, &claim.word, claim.cycles, &claim.orbit)?;
        let hits: Vec<_> = self.events().iter().enumerate().filter_map(ClaimedImpact::of).collect();
        // Lemma V6 (from)
        let from = hits.iter().position(|hit| hit.index == claim.from && hit.wall == target.walls[0]);
        let from = from.ok_or_else(|| {
            Doubt::False("no listed impact on the first wall of the word has the number `from`".into())
        })?;
        let question = Convergence { target, hits, from };
        for_all_pieces(data, most, |piece| question.answer(piece), |piece| question.widest_datum(piece))
    }
}

/// Proves `answer` for all data, cut into at most `most` pieces, each along its widest datum.
pub(super) fn for_all_pieces(
    data: &Data,
    most: usize,
    answer: impl Fn(&Piece) -> Result<(), Doubt>,
    widest: impl Fn(&Piece) -> Option<usize>,
) -> Result<(), Doubt> {
    let most = most.min(MAX_PIECES); // proposes: when to give up
    let (mut pieces, mut cut) = (vec![Piece::default()], 1);
    while let Some(piece) = pieces.pop() {
        let Err(doubt) = answer(&piece) else {
            data.budget.add(WORK_PER_PIECE);
            continue;
        };
        match (&doubt, widest(&piece)) {
            (Doubt::Open(_), Some(datum)) if cut < most && !data.budget.is_spent() => {
                pieces.extend(piece.halves(datum));
                cut += 1;
            }
            _ => return Err(doubt),
        }
    }
    Ok(())
}

/// The datum on which the state after a period, from a recurring state near a guess, depends most.
pub(super) fn widest_datum(mut round: Round<'_>, guess: [Real; 2]) -> Option<usize> {
    let (centre, derivative) = round.polish(guess).ok()?;
    let still = derivative.map(|row| row.map(|_| Real::zero(BITS)));
    let last = round.run(round.set(&centre, &still)).ok()?.pop()?;
    last.phase.widest(round.first()).or(last.velocity.widest(round.first()))
}

/// The claim that a motion converges to a periodic orbit, with the impacts from which this is proved.
struct Convergence<'c> {
    target: Target<'c>,
    hits: Vec<ClaimedImpact<'c>>,
    /// Position of the impact from which on the motion is claimed to follow the word.
    from: usize,
}

impl Convergence<'_> {
    /// Proves the convergence for all data of a piece.
    fn answer(&self, piece: &Piece) -> Result<(), Doubt> {
        let frame = Frame::new(self.target.data, piece, BITS);
        let end = self.end().ok_or_else(|| Doubt::open("the flights of a round are not listed"))?;
        self.answer_from(end, piece, &frame)
    }

    /// The datum on which the orbit depends most.
    fn widest_datum(&self, piece: &Piece) -> Option<usize> {
        let frame = Frame::new(self.target.data, piece, BITS);
        let end = self.end().filter(|_| frame.parameters.columns() > 0)?;
        widest_datum(self.round(end, &frame), self.guess(end, &frame))
    }

    /// The last impact that comes whole rounds of the word after impact `from`, if the flights of a round are listed.
    fn end(&self) -> Option<usize> {
        let each = self.target.walls.len();
        let end = self.from + (self.hits.len() - 1 - self.from) / each * each; // exact: an index
        (self.hits.len() > each).then_some(end)
    }

    /// The first impact from which on the motion follows the word without interruption up to the impact `end`.
    fn beginning(&self, end: usize) -> usize {
        let mut at = end;
        while let Some(before) = at.checked_sub(self.target.walls.len()) {
            let hits = &self.hits[before..=at];
            let follows = |pair: &[ClaimedImpact<'_>]| pair[1].event == pair[0].event + 1;
            if !hits.windows(2).all(follows)
                || hits.iter().zip(self.target.walls.iter().cycle()).any(|(hit, &wall)| hit.wall != wall)
            {
                break;
            }
            at = before;
        }
        at
    }

    /// The round from the impact `end` on; durations of flights are those of the last listed round, which may begin at an earlier impact.
    fn round<'p>(&'p self, end: usize, frame: &'p Frame) -> Round<'p> {
        let first = end.min(self.hits.len() - 1 - self.target.walls.len()); // proposes: how long flights are
        let phases: Vec<_> = self.hits[first..=first + self.target.walls.len()]
            .iter()
            .map(|hit| frame.clock.phase(&hit.time[0]))
            .collect();
        let bits = frame.turn.bits();
        let time = |flight: &[Real]| Real::point((flight[1].clone() - &flight[0]).mid(), bits);
        let mut times: Vec<Real> = phases.windows(2).map(time).collect();
        times.rotate_left((end - first) % self.target.walls.len());
        self.target.round(frame, times, true)
    }

    fn state(&self, end: usize, frame: &Frame) -> Landing {
        frame.states(&self.hits[end])
    }

    fn guess(&self, end: usize, frame: &Frame) -> [Real; 2] {
        let state = self.state(end, frame);
        [state.phase.centre, state.velocity.centre]
    }

    fn answer_from(&self, end: usize, piece: &Piece, frame: &Frame) -> Result<(), Doubt> {
        let open = |message: &str| Doubt::open(message);
        let mut round = self.round(end, frame);
        let (centre, derivative) = round.polish(self.guess(end, frame))?;
        let near = |state: Landing| {
            let phase = round.near(&state.phase, &centre[0]).ok_or_else(|| open("the phase is too large"))?;
            Ok(Landing { phase, ..state })
        };
        let state = near(self.state(end, frame))?;
        let claimed = near(self.target.first(frame))?;
        let shapes = contracted(&centre, &derivative);
        if shapes.is_empty() {
            return Err(open("the orbit is not proved to be stable"));
        }
        let basin = basin(&round, &shapes, &[&state, &claimed])?;
        arrives(&round, &basin, state)?;
        let beginning = self.beginning(end);
        if beginning > self.from {
            let from = self.hits[beginning].index;
            return Err(Doubt::Open(format!("that is proved only from impact {from} on")));
        }
        self.target.encloses(piece, &basin, &claimed, &centre, &round)
    }
}

/// Proves that the motion enters a basin, from a set of its states on.
fn arrives(round: &Round<'_>, basin: &Ellipse, mut state: Landing) -> Result<(), Doubt> {
    for _ in 0..MAX_PERIODS {
        if basin.holds(&state) {
            return Ok(());
        }
        state = round.run(state)?.pop().expect("the set");
    }
    Err(Doubt::open("the motion is not proved to come near enough to the orbit"))
}
