//! `impact-pair two-impact SCENE`: motions with two impacts in N cycles, and the parameter manifolds of figures 10 and 11.

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::Args;
use impact_pair_answers::Picture;
use impact_pair_answers::values::window as range;
use impact_pair_plot::picture::Look;
use impact_pair_plot::two_impact::{self, Window};

use crate::destination::Destination;
use crate::verb::Outputs;

pub const EXIT_CODES: &str = "\
Exit code: 0 everything is decided; 1 something is undecided (the output lists it, and all that is proved), or \
Ctrl-C ended a parameter manifold (the output has the proved part); 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair two-impact scenes/figure-13.toml --cycles 1..4
  impact-pair two-impact scenes/figure-13.toml --solve-for amplitude --format json
  impact-pair two-impact scenes/figure-10.toml --manifold frequency=5..60:400 --plot figure-10.svg

Two of A, d and |v| are given, by --solve-for. velocity: A and d are those of the scene, and all motions without \
sticking with two impacts in N cycles are found, equispaced by (66), (67) or (70), (71), and the others, N odd or \
even, by (62), (63), isolated with proof. amplitude: d and the start's v are those of the scene, and A_N is that of \
(68). gap: A and the start's v are, and d is that of (67). These two are equispaced, so N is odd.

With several harmonics there is no closed form: periodic --word RL --cycles N --all finds such motions.

For each motion: whether a wall is touched earlier, and stability by (38). With e = 1 a motion is proved unstable, or \
elliptic: both eigenvalues lie on the unit circle, and linear theory says no more.

Parameter manifold: A_N (68) over W for the scene's d, e and start velocity, or over v for the scene's d, e and W. \
The output has the points of the grid, the points where first contact, stability or the sign of sin th0 change, and \
what is proved between each point and the next.

Exit code: 0 everything is decided; 1 something is undecided (the output lists it, and all that is proved), or \
Ctrl-C ended a parameter manifold (the output has the proved part); 2 usage, bad input, I/O.";

/// Reads two ranges, one for each axis.
fn window(text: &str) -> Result<Window, String> {
    let (across, up) = text.split_once(':').ok_or("accepted are two ranges such as 7..21:0..0.8")?;
    Ok([range(across)?, range(up)?])
}

/// The picture of a parameter manifold, and where both go.
#[derive(Args, Debug)]
pub struct ManifoldDrawing {
    /// Draw the parameter manifold
    #[arg(long, value_name = "FILE.svg|FILE.png|FILE.pdf", value_parser = impact_pair_plot::picture::path, requires = "manifold")]
    plot: Option<PathBuf>,
    /// Magnify this window of the picture in an inset
    #[arg(long, value_name = "X0..X1:Y0..Y1", value_parser = window, allow_hyphen_values = true, requires = "plot")]
    inset: Option<Window>,
    #[command(flatten)]
    look: Look,
    #[command(flatten)]
    destination: Destination,
}

impl Outputs for ManifoldDrawing {
    fn destination(&self) -> &Destination {
        &self.destination
    }

    fn plot(&self) -> Option<(&Path, &Look)> {
        self.plot.as_deref().map(|path| (path, &self.look))
    }

    fn svg(&self, picture: Picture<'_>) -> Result<String> {
        match picture {
            Picture::Manifolds(scene, axis, curves) => two_impact::svg(scene, axis, curves, self.inset, &self.look),
            other => impact_pair_plot::svg(other, &self.look),
        }
    }
}
