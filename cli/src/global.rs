//! `impact-pair global SCENE`: where every motion goes, proved.

pub const HELP: &str = "\
Examples:
  impact-pair global scenes/figure-12.toml
  impact-pair global scenes/figure-14.toml --plot global.svg --format json --output global.json

With every impact mirrored to the left wall, all phases and all speeds that motions have in the end are covered by \
boxes. Enclosures of the successors of each box, an impact or a rest and its release, make a graph; at a graze both \
continuations are included. Its recurrent components hold all that motions do in the end: each is halved, box by box, \
until the limit of its motions is proved (a periodic orbit, a cycle with rests, a graze in every forcing period), \
or until enough boxes are mapped. The start of the scene is not used. One harmonic and a restitution below 0.99 only; \
parameters may be intervals.

An undecided component has no claim, not even that a motion stays in it. Of a \
`closed` one all motions are in it in the end. With --basins the basin of an attractor is the boxes all of whose motions \
are proved to end in it, as a part of the state space: lower bounds. With --horseshoes the largest few undecided \
components are searched for horseshoes, as chaos proves them: where one is proved the component holds a compact \
invariant set of positive topological entropy.

With --plot the state space is coloured by the attractor that its motions end in, beside the graph of components. The \
formats graphml and dot write that graph: an edge where motions may go from one component to another.

Exit code: 0 every motion that touches a wall is proved to end in one cycle with rests, or to tend to one attractor, \
apart from saddles and grazes; 1 not so, or the run was interrupted (the proved part is written); 2 usage, bad input, \
I/O.";
