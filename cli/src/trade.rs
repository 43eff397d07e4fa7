//! `impact-pair trade SCENE`: what accuracy costs on a scene.

pub const EXIT_CODES: &str = "\
Exit code: 0 every row was measured (an undecided one is a result); 1 interrupted (the output holds what was \
measured); 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair trade scenes/figure-14.toml --impacts 200
  impact-pair trade scenes/figure-12.toml --impacts 100 --format json --plot trade.svg

The rows: float; interval; inari, the textbook method, for one harmonic; shadow; 64, 128, 256, ... bits until one reaches \
all the impacts, two more bring no progress, or --max-bits; auto to 3, 9, 15, 30 and 100 digits.

Times are medians of 301 runs after a first one, or of as many as fit into 0.2 s. Orbit: impacts with phase and \
velocity enclosed in reduced units; with bounds: also their times and velocities in the units of the scene, as exact \
bounds. Reading the scene and printing are not included.

Widths are guaranteed: of times in periods 2 pi/W, of velocities in A W (in gap widths per period if A may be 0), \
rounded up. Certified digits: -log10 of the larger width. The errors of float are measured against certified \
enclosures (auto at 30 digits), as long as its walls are the true ones; an error is reported to exceed a threshold only where that is proved.

Exit code: 0 every row was measured (an undecided one is a result); 1 interrupted (the output holds what was \
measured); 2 usage, bad input, I/O.";
