//! `impact-pair tangency SCENE`: homoclinic tangencies of the equispaced motion over a parameter, proved.

pub const HELP: &str = "\
Examples:
  impact-pair tangency scenes/figure-14.toml --over gap=9.425..9.426 --word FFFFFFFNFFFFFNFFNFFNFFFF
  impact-pair tangency scenes/figure-14.toml --over gap=9.4245..9.4252 --longest 18

The equispaced motion (66), (67) of half a forcing period between impacts is a fixed point of the reduced map, which \
mirrors every impact to the left wall. Where it is a saddle, floating point searches for folds of its unstable \
manifold near its stable one, along the flights of --word or along all words of at most --longest flights: F is a \
flight to the far wall, N one back to the near wall. Each tangency listed is proved: for exactly one value of the \
parameter within its bounds the two invariant manifolds have a common point along these flights, with sigma_u and sigma_s \
within their bounds, at which they are tangent; the tangency is quadratic (q is not 0); it unfolds with a speed other \
than 0 (m is not 0); each flight of the orbit ends at its first contact. The product of the eigenvalues is e^2: the \
saddle is dissipative. Other tangencies are not excluded, and the scene's own value of the parameter is not \
examined. One harmonic only.

On either side of a tangency two ranges of the parameter are listed where they are proved: for each value of the first, the invariant \
manifolds have exactly two common points along these flights, for each value of the second none, with sigma_u, sigma_s \
and all states between both points in the boxes of the JSON.

The coefficient of restitution may be an interval, with --over restitution gap and amplitude may: for each value in it there is \
exactly one tangency whose parameter, sigma_u, sigma_s and states are in the bounds of the JSON, all bounds hold for each, and \
--digits is not used.

Where sigma_u or sigma_s is not small, flights of the invariant manifolds are added to the word at that end: the orbit is the \
same.

Exit code: 0 there are tangencies, and all folds that were tried are proved to lead to one; 1 some are not, there is \
none, the search ended at the limit of its work, or the run was interrupted (the proved part is written); 2 usage, bad input, I/O.";
