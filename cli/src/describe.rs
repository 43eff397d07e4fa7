//! `impact-pair describe SCENE`: what becomes of a motion, in one answer.

pub const EXIT_CODES: &str = "\
Exit code: 0 the fate of the motion is certified; 1 it is undecided, or the run was interrupted; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair describe scenes/figure-12.toml
  impact-pair describe scenes/chatter.toml --plot chatter.svg --format json --output chatter.json
  impact-pair describe scenes/figure-15.toml --impacts 500

The fate of the motion is one of: attracted (it converges to a stable periodic orbit), periodic (it repeats exactly), \
rests-forever, never-impacts, stays-in-region (a trapping region holds all its impacts from one on), undecided. The \
questions are examined in the order of their cost, and only as far as the fate requires: the certified orbit with its \
outcome, for up to --impacts impacts and in double precision for ten times as many; where that leaves the fate \
undecided, a trapping region; where the motion stays in the region, a horseshoe in it and a lower bound of the \
topological entropy. So no region and no horseshoe are looked for where the motion is attracted, periodic or at rest: \
trap and chaos find those. Region and horseshoe need one harmonic.

The exponent in the limit is the logarithm of the spectral radius of the attracting orbit's Jacobian, per impact, \
only an upper bound where e may be 0; the finite-time exponent is that of the certified impacts. That a motion is \
chaotic is never claimed. Each undecided question is listed with a command that continues. [run] of the scene is not used.

Exit code: 0 the fate is certified; 1 it is undecided, or the run was interrupted (the output still has the \
certified part); 2 usage, bad input, I/O.";
