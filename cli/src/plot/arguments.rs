//! Command-line arguments of `plot`.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use impact_pair_answers::RunOptions;
use impact_pair_answers::values::{whole, window};
use impact_pair_plot::orbit::{Figure, Panel};
use impact_pair_plot::picture::Look;

use crate::destination::Destination;

pub const HELP: &str = "\
Examples:
  impact-pair plot scenes/figure-14.toml --all --output figure-14.svg
  impact-pair plot scenes/figure-13.toml --panel c --transient 10 --output figure-13.svg
  impact-pair plot scenes/chatter.toml --panel a --zoom 0.2..0.5 --theme dark --output chatter.svg

The panels are those of the paper's figures 12-17; their letters a to h are accepted as names, too. Between impacts \
the motion is drawn from its closed form, (11) and (12), as cubic Bézier segments of a twenty-fourth of a forcing \
period, which deviate from it by less than A/80,000. All of it is enclosed; an enclosure wider than a pixel is drawn \
as a band or a box around its middle. Without proved bounds time panels are hatched. A float run is drawn in \
another colour, with the note that it is not certified.

Exit code: 0 everything drawn is certified (or float, which is non-rigorous); 1 the orbit is undecided from some \
impact on, was interrupted, or is wider than --digits (the picture shows the certified part, with a note); 2 usage, \
bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("impacts", |impacts| impacts.help("Stop after N impacts [default: 4000 for switch-planes and sections, else as many as the forcing periods need]")))]
#[command(mut_arg("until", |until| until.help("Stop at this time, a number or an expression such as 100*pi")))]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of times relative to 2 pi/W, of velocities relative to A W [default: that of the scene, or 9]")))]
#[command(mut_arg("arithmetic", |arithmetic| arithmetic.help("The arithmetic, as in run")))]
#[command(group(ArgGroup::new("shown").required(true).args(["panels", "all"])))]
pub struct PlotArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// A panel to draw; repeat the option for several panels on one sheet
    #[arg(long = "panel", value_enum, value_name = "NAME")]
    panels: Vec<Panel>,
    /// All eight panels on one sheet, as in the paper
    #[arg(long)]
    all: bool,
    /// Number of forcing periods shown in the time panels
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = whole(1..=10_000))]
    cycles: u32,
    /// Number of forcing periods shown in the phase planes
    #[arg(long, value_name = "N", default_value_t = 40, value_parser = whole(1..=10_000))]
    orbit_cycles: u32,
    /// Number of impacts in the transient, drawn grey together with the motion up to them
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole(0..=u32::MAX))]
    transient: u32,
    /// Show the time panels again between these two times
    #[arg(long, value_name = "T0..T1", value_parser = window, allow_hyphen_values = true)]
    zoom: Option<[f64; 2]>,
    #[command(flatten)]
    run: RunOptions,
    /// The picture, written atomically; the extension selects the format
    #[arg(id = "plot", long = "output", short = 'o', value_name = "FILE.svg|FILE.png|FILE.pdf", value_parser = impact_pair_plot::picture::path)]
    pub output: PathBuf,
    #[command(flatten)]
    pub look: Look,
    /// Print no notes and no progress on stderr
    #[arg(long, short)]
    pub quiet: bool,
}

impl PlotArguments {
    /// Returns where the picture goes.
    pub fn destination(&self) -> Destination {
        Destination { output: Some(self.output.clone()), quiet: self.quiet }
    }

    /// Returns the panels requested, each once, in the order of the paper if all are.
    pub fn figure(&self) -> Figure {
        let mut panels = if self.all { Panel::ALL.to_vec() } else { Vec::new() };
        for &panel in &self.panels {
            if !panels.contains(&panel) {
                panels.push(panel);
            }
        }
        Figure {
            panels,
            cycles: self.cycles,
            orbit_cycles: self.orbit_cycles,
            transient: self.transient as usize, // exact: 32 bits
            zoom: self.zoom,
            run: self.run.clone(),
            look: self.look.clone(),
        }
    }
}
