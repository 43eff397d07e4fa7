//! `impact-pair periodic SCENE --word WORD --cycles N`: the periodic orbits of a word, proved.

pub const HELP: &str = "\
Examples:
  impact-pair periodic scenes/figure-15.toml --word RRLLL --cycles 1
  impact-pair periodic scenes/figure-13.toml --word \"P2 P1\" --cycles 1 --digits 30 --format json
  impact-pair periodic scenes/figure-13.toml --word RL --cycles 1 --all

Each orbit listed is proved to be the only one within its bounds. Admissible: no flight touches a wall before it \
ends; otherwise the orbit is virtual. Stable: both eigenvalues of the Jacobian of a period lie inside the unit \
circle; unstable: one lies outside; elliptic: e = 1, and both lie on it, apart and not real. Without --all the search starts from the scene's own motion and from a grid of \
initial conditions, and there may be other orbits. Motions with sticking are not searched for, not even with --all: \
for e > 0 they have infinitely many impacts per period, or meet a wall with zero velocity exactly where the contact \
force sets in; for e = 0 each follows from a release, and run proves it from there.

Exit code: 0 everything requested is certified; 1 some of it is not: no orbit was found, or part of one is undecided \
or wider than --digits (the output still has the certified part); 2 usage, bad input, I/O.";
