//! Nodes around the impacts of a shadowed orbit, each of which covers the next (Lemma V10).

use super::affine::{Affine, COLUMN_BITS};
use super::clock::{SetPosition, beside};
use super::contact::{Claimed, Doubt};
use super::data::{Data, Piece};
use super::frame::{ClaimedImpact, Frame};
use super::step::{Landing, Launch};
use impact_pair_exact::{Dyadic, Real};

/// Pairs of doubles by phase \[rad\] and velocity \[length/rad\], or along the expanding and the contracting axis.
pub(super) type Pair = [f64; 2];

/// The states `centre + xi u + eta s`, `|xi| <= a`, `|eta| <= b`, before an impact or at the start.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub centre: [Real; 2],
    /// `[u, s]`
    pub axes: [Pair; 2],
    /// `[a, b]`
    pub sides: Pair,
}

/// Starts and impacts, with the data that flights depend on.
pub(super) struct Course<'c> {
    pub data: &'c Data<'c>,
    pub frame: Frame<'c>,
    /// Walls and bounds of the impacts.
    pub hits: &'c [ClaimedImpact<'c>],
    /// True if the starts differ by their times alone; else by their velocities alone.
    pub is_of_times: bool,
}

impl Course<'_> {
    /// Departure from impact `k` with the given states before the impact; from the start for `k = 0`.
    pub fn departure(&self, k: usize, [phase, velocity]: [Affine; 2]) -> Launch {
        let parameters = &self.frame.parameters;
        match k.checked_sub(1).map_or(self.data.wall, |hit| Some(self.hits[hit].wall)) {
            Some(wall) => Launch::rebound(parameters, &Landing::new(wall, phase, velocity)),
            None => {
                let height = self.data.state(&Piece::default(), parameters.bits()).2;
                let height = height.expect("a start without a wall is inside the gap");
                Launch::inside(phase, height, velocity)
            }
        }
    }

    /// States of node `k`; for `k = 0` with the exact velocity, or time, of the start.
    pub fn states(&self, k: usize, node: &Node) -> [Affine; 2] {
        let side = |i: usize, j: usize| Real::point(exact(node.axes[j][i]).times(&exact(node.sides[j])), COLUMN_BITS);
        let mut states = [0, 1].map(|i| Affine::spanned(node.centre[i].clone(), 0, [side(i, 0), side(i, 1)]));
        if k == 0 {
            let (phase, velocity, _) = self.data.state(&Piece::default(), self.frame.turn.bits());
            if self.is_of_times { states[1] = velocity } else { states[0] = phase.less_centre() }
        }
        states
    }

    /// Proves that node `k` covers the next node, and that the next node lies in the bounds of its impact. Returns how far the impact's
    /// time may be from the middle of its claimed bounds \[rad\]; `lasting` is the approximate duration of the flight. A failure never
    /// refutes a claim: other starts may have the claimed impacts.
    pub fn link(&self, k: usize, [node, next]: [&Node; 2], lasting: &Real) -> Result<Dyadic, Doubt> {
        let hit = &self.hits[k];
        let claimed = Claimed { from: Real::zero(lasting.bits()), guess: lasting.clone(), to: None, is_first: true };
        let departure = self.departure(k, self.states(k, node));
        let landing = departure.land(&self.frame.parameters, hit.wall, &claimed).map_err(|doubt| open(&doubt))?;
        if !covers(&landing, next) {
            return Err(Doubt::open("no orbit is proved to go on from the impact before"));
        }
        let [phase, velocity] = self.states(k + 1, next).map(|x| x.hull());
        let [time, velocity] = [self.frame.clock.time(&phase), self.frame.clock.velocity(&velocity)];
        for (what, found, claimed) in [("time", &time, hit.time), ("velocity", &velocity, hit.velocity)] {
            if !matches!(beside(found, claimed), SetPosition::Inside) {
                return Err(Doubt::Open(format!("the {what} is not proved to be inside for any start")));
            }
        }
        Ok(self.frame.clock.off(&time, hit.time))
    }
}

/// Whether the image of a node, whose two deviations are along the node's sides, covers another node.
///
/// Where the determinant may be 0, its lower bound is not above 0, and the second comparison fails (Lemma V10).
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
    let determinant = across(&u, &s);
    let [at_least, at_most] = [least(determinant.clone()), most(determinant)];
    let [far, wide] = [column(0), column(1)];
    let beyond = (a * &at_most) + &most(along(&wide)) + &most(along(&off));
    let apart = most(beside(&far)) + &most(beside(&wide)) + &most(beside(&off));
    beyond.is_below(&least(along(&far))) && apart.is_below(&(b * &at_least))
}

/// Turns a refutation into an undecided claim: a statement that is false for one set may hold for others.
pub(super) fn open(doubt: &Doubt) -> Doubt {
    let (Doubt::Open(message) | Doubt::False(message)) = doubt;
    Doubt::Open(message.clone())
}

/// The exact value of a double, for nodes; 0 for NaN and infinities, as any node is sound.
fn exact(x: f64) -> Dyadic {
    Dyadic::from_f64(x).unwrap_or_else(Dyadic::zero)
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_pair_model::Wall;
    use proptest::prelude::*;

    const BITS: u32 = 192;

    fn real(x: f64) -> Real {
        Real::point(exact(x), BITS)
    }

    /// `centre + columns q`
    fn image(centre: Pair, columns: [Pair; 2]) -> Landing {
        let [phase, velocity] =
            [0, 1].map(|i| Affine::spanned(real(centre[i]), 0, [real(columns[0][i]), real(columns[1][i])]));
        Landing::new(Wall::Left, phase, velocity)
    }

    fn node(centre: Pair, axes: [Pair; 2], sides: Pair) -> Node {
        Node { centre: centre.map(real), axes, sides }
    }

    #[test]
    fn a_node_is_covered_up_to_its_sides() {
        let next = node([5.0, 7.0], [[1.0, 0.0], [0.0, 1.0]], [1.0, 0.5]);
        let covered = |centre, columns| covers(&image(centre, columns), &next);
        let (far, wide) = ([3.0, 0.125], [0.25, 0.125]);
        assert!(covered([5.0, 7.0], [far, wide]) && covered([5.0, 7.0], [far.map(|x| -x), wide]));
        for off in [1.7, -1.7] {
            assert!(covered([5.0 + off, 7.0], [far, wide]) && !covered([5.0 + 1.1 * off, 7.0], [far, wide]));
        }
        for off in [0.24, -0.24] {
            assert!(covered([5.0, 7.0 + off], [far, wide]) && !covered([5.0, 7.0 + 1.1 * off], [far, wide]));
        }
        // Too short, too wide, along the other axis.
        assert!(!covered([5.0, 7.0], [[1.2, 0.0], wide]) && !covered([5.0, 7.0], [far, [0.25, 0.5]]));
        assert!(!covered([5.0, 7.0], [wide, far]) && !covered([5.0, 7.0], [[3.0, 0.5], wide]));
        let flat = node([5.0, 7.0], [[1.0, 0.0], [1.0, 0.0]], [1.0, 0.5]);
        assert!(!covers(&image([5.0, 7.0], [far, wide]), &flat));
    }

    /// Parallel axes span no node, however their determinant is rounded: the products of these doubles have more digits than
    /// are kept, so that the determinant's enclosure holds 0.
    #[test]
    fn r32_parallel_axes_are_covered_by_nothing() {
        let [p, q] = [0x7_ffff_ffff_fffb_u64, 0x5_5555_5555_5555].map(|x| x as f64 * 2f64.powi(-51));
        let flat = node([0.0, 0.0], [[p, q], [3.0 * p, 3.0 * q]], [2f64.powi(-60), 1.0]);
        let across = |j: usize| real(flat.axes[0][j]) * &real(flat.axes[1][1 - j]);
        assert!((across(0) - &across(1)).is_zero());
        // The image is a segment across the line of the flat node, longer than this line at the scale of its first side.
        let image = image([0.0, 0.0], [[0.0, 2f64.powi(-100)], [0.0, 0.0]]);
        assert!(!covers(&image, &flat));
    }

    proptest! {
        /// `covers` is compared with the images of the edges and of inner points of a node, in floating point.
        #[test]
        fn images_of_edges_lie_beyond_edges(
            centre in prop::array::uniform2(-1.0..1.0f64), far in prop::array::uniform2(-5.0..5.0f64), wide in prop::array::uniform2(-1.0..1.0f64),
            angle in 0.0..6.3f64, between in 0.1..3.0f64, sides in prop::array::uniform2(-1.5..1.5f64), at in -1.0..1.0f64
        ) {
            let axes = [[angle.cos(), angle.sin()], [(angle + between).cos(), (angle + between).sin()]];
            if covers(&image(centre, [far, wide]), &node([0.0; 2], axes, sides)) {
                let [u, s] = axes;
                let cross = |[a, b]: Pair, [x, y]: Pair| a * y - b * x;
                let state = |q: Pair| [0, 1].map(|i| centre[i] + far[i] * q[0] + wide[i] * q[1]);
                let along = |q| cross(state(q), s) / cross(u, s);
                let beside = |q| cross(u, state(q)) / cross(u, s);
                let [one, other] = [[-1.0, at], [1.0, at]].map(along);
                prop_assert!(one.abs() > sides[0].abs() * (1.0 - 1e-12) && other.abs() > sides[0].abs() * (1.0 - 1e-12) && one * other <= 0.0);
                for q in [[at, -1.0], [at, 1.0], [-1.0, at], [1.0, at]] {
                    prop_assert!(beside(q).abs() <= sides[1].abs() * (1.0 + 1e-12) + 1e-12);
                }
            }
        }
    }
}
