//! `impact-pair cycles SCENE --impacts LO..HI`: all periodic orbits of a trapping region, proved.

pub const HELP: &str = "\
Examples:
  impact-pair cycles scenes/figure-14.toml --impacts 1..7
  impact-pair cycles scenes/figure-14.toml --impacts 1..5 --format json --output cycles.json

In the trapping region of the verb trap, with every impact mirrored to the left wall, a periodic orbit and its \
mirror image are one cycle. All periodic orbits of period n of the impact map are found: chains of boxes that the \
region allows are contracted by Newton's impact law until each is excluded or holds one proved cycle. The output \
counts the fixed points of the n-th iterate, including those of shorter cycles, and the cycles of least period n. \
Cycles on a single wall, or with an odd number of crossings, are counted as well. Outside the region there may be \
others. One harmonic only.

Exit code: 0 the list is proved complete, with the stability of each cycle; 1 something is undecided, or the run was \
interrupted (the proved part is written); 2 usage, bad input, I/O.";
