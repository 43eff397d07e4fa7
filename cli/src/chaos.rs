//! `impact-pair chaos SCENE`: horseshoes and a lower bound of the entropy, proved.

pub const HELP: &str = "\
Examples:
  impact-pair chaos scenes/figure-14.toml --depth 4
  impact-pair chaos scenes/figure-14.toml --bases bases.json --depth 3 --hyperbolic
  impact-pair chaos scenes/figure-14.toml --over amplitude=1..1.1:2 --plot proved.svg

The h-sets are quadrilaterals of states along the leaves of the attractor, found from a floating-point orbit or read \
from --bases. The image of each is followed, impact by impact, by a chain of boxes; each box is proved to be mapped \
along the next ones. Where the image covers an h-set (a covering relation), the walls of its impacts are a word. For \
each sequence of words that fit together there is a true motion with these impacts, and for a periodic sequence a \
periodic one; their number bounds the topological entropy from below. This proves a horseshoe and sensitive \
dependence on initial conditions in it. It does not prove that every motion is chaotic, that the attractor is, or \
that the Lyapunov exponent is positive. One harmonic only.

With --hyperbolic, words are proved to be uniformly hyperbolic by cones, where they are; the others are left out. For each two-sided sequence of these words there is then exactly one motion, and the output bounds their entropy from both sides, the Lyapunov exponents of every invariant measure on the set of these motions, and its Hausdorff dimension. That set is not the attractor, and a typical orbit is not in it.

For the orbit of the scene's own start, the output states whether it is proved to converge to a periodic orbit, so \
that only transients visit the horseshoe, or to stay in a trapping region that contains the horseshoe. With --over \
KEY=LO..HI:COUNT, each cell of the range is tested for a horseshoe, for convergence of that orbit, and for a stable \
periodic orbit that it may not converge to; each verdict holds for all values in its interval.

Exit code: 0 a positive entropy is proved, or with COUNT a verdict for every value; 1 it is not, or the run was \
interrupted (the proved part is written); 2 usage, bad input, I/O.";
