//! `impact-pair trap SCENE`: a trapping region, proved.

pub const HELP: &str = "\
Examples:
  impact-pair trap scenes/figure-14.toml
  impact-pair trap scenes/figure-17.toml --plot region.svg --format json --output region.json
  impact-pair trap scenes/figure-14.toml --words 22

The trapping region (forward invariant) is a set of boxes in phase and speed before the impact, with every impact \
mirrored to the left wall. It grows from the end of a floating-point orbit until each flight from a box is proved to \
land in boxes; at a graze both continuations are included. A motion with one impact in the region has all later \
impacts there, never sticks, has no complete chatter, and keeps within the bounds for all time. Whether the region \
attracts motions from outside is not claimed. One harmonic only.

With --words N an edge of the graph of boxes leads from each to all that its flights may land in: F on the far wall \
(P1 or P2), N on the near one (P3 or P4). The sets of boxes that words of F and N lead to are the nodes of the graph \
of words. The words of N letters that it allows are counted exactly: the motions in the region make no others, so \
the topological entropy of their words is at most ln count / N for each N, and at most the growth rate of the paths \
where the graph of words is closed. Of P1-P4 there are twice as many words, as each begins on either wall. The \
entropy of the motions themselves may be greater: two may have one word.

The formats graphml and dot write the graph of boxes, with --words the graph of words, whose paths from node 0 on \
are the words. At a graze both walls are allowed.

Exit code: 0 a region is proved, as fine as --effort requests, the scene's own orbit is in it from some impact on, and the \
words are counted if --words is given; 1 one of these is undecided; 2 usage, bad input, I/O.";
