//! Nodes around the impacts of a shadowed orbit, each of which covers the next (Lemma V10).

use num_rational::BigRational;

use super::affine::{Affine, COLUMN_BITS};
use super::clock::{Beside, beside};
use super::contact::{Claimed, Doubt, Start};
use super::data::{Data, Piece};
use super::frame::Frame;
use super::step::{Departure, Landing};
use crate::{Claim, ClaimKind};
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::Wall;

/// Pairs of numbers by phase \[rad\] and velocity \[length/rad\], or along the expanding axis and the other one.
pub(super) type Pair = [f64; 2];

/// The states `centre + xi u + eta s`, `|xi| <= a`, `|eta| <= b`, before an impact, or of starts.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub centre: [Real; 2],
    /// `[u, s]`
    pub axes: [Pair; 2],
    /// `[a, b]`
    pub sides: Pair,
}

/// Where starts and impacts are, with the data that flights depend on.
pub(super) struct Course<'c> {
    pub data: &'c Data,
    pub frame: Frame,
    /// Walls and bounds of the impacts.
    pub hits: &'c [Hit<'c>],
    /// Whether the starts differ by their times alone; else by their velocities alone.
    pub is_of_times: bool,
}

/// What is claimed of an impact.
pub(super) struct Hit<'c> {
    pub wall: Wall,
    pub time: &'c [BigRational; 2],
    pub velocity: &'c [BigRational; 2],
}

impl<'c> Hit<'c> {
    /// The claim of an impact.
    pub fn of(claim: &'c Claim) -> Option<Self> {
        match &claim.kind {
            ClaimKind::Impact { velocity, .. } => Some(Self { wall: claim.wall, time: &claim.time, velocity }),
            _ => None,
        }
    }
}

impl Course<'_> {
    /// The departure from the impact `k` with these states before it, from the start for 0.
    pub fn departure(&self, k: usize, [phase, velocity]: [Affine; 2]) -> Departure {
        let parameters = &self.frame.parameters;
        match k.checked_sub(1).map_or(self.data.wall, |hit| Some(self.hits[hit].wall)) {
            Some(wall) => Departure::rebound(parameters, &Landing { wall, phase, velocity }),
            None => {
                let height = self.data.state(&Piece::default(), parameters.bits()).2;
                let height = height.expect("a start without a wall is inside the gap");
                Departure { start: Start { wall: None, is_release: false }, phase, height, velocity }
            }
        }
    }

    /// The states of node `k`: with the exact time, or velocity, of the start for 0.
    pub fn states(&self, k: usize, node: &Node) -> [Affine; 2] {
        let side = |i: usize, j: usize| Real::point(exact(node.axes[j][i]).times(&exact(node.sides[j])), COLUMN_BITS);
        let mut states = [0, 1].map(|i| Affine::spanned(node.centre[i].clone(), 0, [side(i, 0), side(i, 1)]));
        if k == 0 {
            let (phase, velocity, _) = self.data.state(&Piece::default(), self.frame.turn.bits());
            if self.is_of_times { states[1] = velocity } else { states[0] = phase.less_centre() }
        }
        states
    }

    /// Proves that node `k` covers the next one, which lies in the bounds of its impact; `lasting` is about how long the flights
    /// last. What is found is nothing that refutes a claim: other starts may do it.
    pub fn link(&self, k: usize, [node, next]: [&Node; 2], lasting: &Real) -> Result<(), Doubt> {
        let hit = &self.hits[k];
        let claimed = Claimed { from: Real::zero(lasting.bits()), guess: lasting.clone(), to: None, is_first: true };
        let departure = self.departure(k, self.states(k, node));
        let landing = departure.land(&self.frame.parameters, hit.wall, &claimed).map_err(|doubt| open(&doubt))?;
        if !covers(&landing, next) {
            return Err(Doubt::Open("no orbit is proved to go on from the impact before".into()));
        }
        let [phase, velocity] = self.states(k + 1, next).map(|x| x.hull());
        let [time, velocity] = [self.frame.clock.time(&phase), self.frame.clock.velocity(&velocity)];
        for (what, found, claimed) in [("time", time, hit.time), ("velocity", velocity, hit.velocity)] {
            if !matches!(beside(&found, claimed), Beside::Inside) {
                return Err(Doubt::Open(format!("the {what} is not proved to be inside for any start")));
            }
        }
        Ok(())
    }
}

/// Whether the image of a node, whose two deviations are those of its sides, covers another one.
fn covers(image: &Landing, next: &Node) -> bool {
    let [u, s] = next.axes.map(|axis| axis.map(|x| Real::point(exact(x), COLUMN_BITS)));
    let off = [&image.phase, &image.velocity].map(|x| x.without(0).hull());
    let off = [0, 1].map(|i| (off[i].clone() - &next.centre[i]).rounded(COLUMN_BITS));
    let column = |j: usize| [image.phase.column(j), image.velocity.column(j)];
    let across = |[p, q]: &[Real; 2], [x, y]: &[Real; 2]| p.clone() * y - &(q.clone() * x);
    let most = |x: Real| Real::point(x.enclosure().mag(), COLUMN_BITS);
    let least = |x: Real| Real::point(x.enclosure().mig(), COLUMN_BITS);
    let [a, b] = next.sides.map(|side| most(Real::point(exact(side), COLUMN_BITS)));
    // Coordinates along u and s, both times the determinant.
    let along = |x: &[Real; 2]| across(x, &s);
    let beside = |x: &[Real; 2]| across(&u, x);
    let determinant = most(across(&u, &s));
    let [far, wide] = [column(0), column(1)];
    let beyond = (a * &determinant) + &most(along(&wide)) + &most(along(&off));
    let apart = most(beside(&far)) + &most(beside(&wide)) + &most(beside(&off));
    beyond.is_below(&least(along(&far))) && apart.is_below(&(b * &determinant))
}

/// What is true of one set need not be of others.
pub(super) fn open(doubt: &Doubt) -> Doubt {
    let (Doubt::Open(message) | Doubt::False(message)) = doubt;
    Doubt::Open(message.clone())
}

/// A double as it is, for nodes: 0 for one that is no number, as any will do.
fn exact(x: f64) -> Dyadic {
    Dyadic::from_f64(x).unwrap_or_else(Dyadic::zero)
}
