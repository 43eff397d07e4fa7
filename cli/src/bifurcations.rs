//! `impact-pair bifurcations SCENE --word WORD --cycles N --over KEY=LO..HI`: folds, pitchforks, doublings, grazes, proved.

pub const HELP: &str = "\
Examples:
  impact-pair bifurcations scenes/cascade.toml --word RL --cycles 1 --over amplitude=0.3..0.499
  impact-pair bifurcations scenes/cascade.toml --word RL --cycles 1 --over gap=1.02..1.1
  impact-pair bifurcations scenes/square-wave.toml --word RL --cycles 5 --over amplitude.2=0..2

Orbits of the word are searched for at values spread over the range. Their branches are followed through folds, and \
so are the branches that leave at pitchforks and period doublings: the cascade. Each point listed is proved: exactly \
one such bifurcation lies within its bounds. Other bifurcations are not excluded. Only A/d and e matter: over \
frequency there are no bifurcations.

With several harmonics, --over amplitude.K=... varies the amplitude of term K, counted from 1. The frequencies must \
be commensurate, and N must be a whole number of common periods, counted in periods of the fastest harmonic. \
Pitchforks exist only if each harmonic changes sign over half the common period.

Exit code: 0 every change that was found is proved to the requested width; 1 some are not, a branch was lost, or the \
run was interrupted (the output still has the certified part); 2 usage, bad input, I/O.";
