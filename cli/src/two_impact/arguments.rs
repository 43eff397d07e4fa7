//! Command-line arguments of `two-impact`.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use impact_pair::pair::Wall;
use impact_pair::scene::{Key, Range};
use impact_pair::two_impact::{COUNTS, CYCLES};
use impact_pair_plot::picture::Look;
use impact_pair_plot::two_impact::Window;

use crate::destination::Destination;
use crate::ending;

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
    let range = crate::values::window;
    let (across, up) = text.split_once(':').ok_or("accepted are two ranges such as 7..21:0..0.8")?;
    Ok([range(across)?, range(up)?])
}

#[derive(Args, Debug)]
pub struct TwoImpactArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// N, or a range such as 1..5, endpoints included
    #[arg(long, value_name = "N|LO..HI", default_value = "1", value_parser = crate::values::numbers(CYCLES), allow_hyphen_values = true)]
    pub cycles: RangeInclusive<u32>,
    /// The wall whose impact is listed first
    #[arg(long, value_enum, default_value_t)]
    pub wall: Side,
    /// Which of |v|, A and d to compute from the other two
    #[arg(long, value_enum, default_value_t, value_name = "velocity|amplitude|gap", conflicts_with = "manifold")]
    pub solve_for: SolveFor,
    /// A_N over a range: frequency=LO..HI:COUNT (figure 10) or velocity=LO..HI:COUNT (figure 11)
    #[arg(long, value_name = "KEY=LO..HI:COUNT", value_parser = manifold, allow_hyphen_values = true)]
    pub manifold: Option<Range>,
    /// Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of the
    /// scene, or 9]
    #[arg(long, value_name = "D", value_parser = crate::values::digits())]
    pub digits: Option<u32>,
    /// Output format [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    pub format: Option<TwoImpactFormat>,
    /// Draw the parameter manifold
    #[arg(long, value_name = "FILE.svg|FILE.png|FILE.pdf", value_parser = impact_pair_plot::picture::path, requires = "manifold")]
    pub plot: Option<PathBuf>,
    /// Magnify this window of the picture in an inset
    #[arg(long, value_name = "X0..X1:Y0..Y1", value_parser = window, allow_hyphen_values = true, requires = "plot")]
    pub inset: Option<Window>,
    #[command(flatten)]
    pub look: Look,
    #[command(flatten)]
    pub destination: Destination,
}

impl TwoImpactArguments {
    /// Output format: points in columns are those of a parameter manifold.
    ///
    /// # Errors
    /// Returns an error if the ending of the output belongs to no such format, or contradicts the given format.
    pub fn format(&self) -> Result<TwoImpactFormat> {
        let output = ("--output", self.destination.output.as_deref());
        let all = TwoImpactFormat::value_variants();
        let accepted = if self.manifold.is_some() { all } else { &[TwoImpactFormat::Table, TwoImpactFormat::Json] };
        let format = ending::format(self.format, output, accepted, TwoImpactFormat::default())?;
        if !accepted.contains(&format) {
            bail!("--format is csv, but accepted without --manifold are table and json");
        }
        Ok(format)
    }
}

/// Output formats of `two-impact`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TwoImpactFormat {
    /// Human-readable; for a parameter manifold the points where something changes
    #[default]
    Table,
    /// Schema impact-pair/periodic/1, a list of documents for a range of N; for a parameter manifold impact-pair/manifold/1
    Json,
    /// For a parameter manifold: one point per line, bounds in columns
    Csv,
}

/// A wall on the command line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Side {
    /// S-
    #[default]
    Left,
    /// S+
    Right,
}

impl Side {
    pub fn wall(self) -> Wall {
        match self {
            Self::Left => Wall::Left,
            Self::Right => Wall::Right,
        }
    }
}

/// The unknown of |v|, A and d, computed from the other two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum SolveFor {
    /// The motion, with its |v|, from A and d
    #[default]
    Velocity,
    /// A_N (68), from d and the start's velocity
    Amplitude,
    /// d (67), from A and the start's velocity
    Gap,
}

/// Reads the range of a parameter manifold.
fn manifold(text: &str) -> Result<Range, impact_pair::Error> {
    let (least, most) = (COUNTS.start(), COUNTS.end());
    let accepted = format!(
        "frequency=LO..HI:COUNT or velocity=LO..HI:COUNT with numbers LO < HI and COUNT from {least} to {most}"
    );
    let is_accepted = |range: &Range| {
        let is_counted = range.count().is_some_and(|count| (*least as u64..=*most as u64).contains(&count));
        is_counted && matches!(range.key(), Key::Frequency(None) | Key::StartVelocity)
    };
    // The velocity is that of the start.
    match text.strip_prefix("velocity") {
        Some(rest) => Range::parse(&format!("start.velocity{rest}"), &accepted, is_accepted),
        None => Range::parse(text, &accepted, is_accepted),
    }
}
