//! Shared parts of the benches: the flights of figures 12-17, from their printed data; a clock and a median.

use std::time::Instant;

use impact_pair::flight::Flight;
use impact_pair::inari::Interval;
use impact_pair::number::{Ball, Number, Wave, kernel};
use impact_pair::orbit::{Arithmetic, Orbit, Settings, Start};
use impact_pair::pair::{Inward, Reduced, Wall};
use impact_pair::{Harmonic, ImpactPair};

/// A figure of the paper: its number and its data.
pub struct Figure {
    /// `fig12` to `fig17`
    pub name: &'static str,
    /// Its impact pair.
    pub pair: ImpactPair,
    /// Its start, on the left wall.
    pub start: Start,
}

/// Figures 12-17, as printed.
pub fn figures() -> Vec<Figure> {
    [
        ("fig12", "pi", "1", "9.42497", "0.5", "-12.56636", "0"),
        ("fig13", "pi", "2", "9.42497", "0.5", "-12.56636", "0"),
        ("fig14", "pi", "8", "9.42497", "0.5", "-12.56636", "0"),
        ("fig15", "10*pi", "2", "1", "0.8", "-14.48", "0"),
        ("fig16", "20*pi", "10", "1", "0.8", "-2", "0"),
        ("fig17", "200*pi", "10", "10", "0.8", "0", "1.047196"),
    ]
    .map(|(name, frequency, amplitude, gap, restitution, velocity, phase)| {
        let value = |text: &str| text.parse().expect("printed data");
        let harmonic = Harmonic::new(value(amplitude), value(frequency), value(phase)).expect("printed data");
        let pair = ImpactPair::new(harmonic, value(gap), value(restitution)).expect("printed data");
        let start = Start::on_wall(value("0"), Wall::Left, value(velocity)).expect("printed data");
        Figure { name, pair, start }
    })
    .into()
}

impl Figure {
    /// The first `impacts` impacts in `arithmetic`.
    pub fn orbit(&self, arithmetic: Arithmetic, impacts: u64) -> Orbit {
        let settings = Settings { impacts: Some(impacts), arithmetic, ..Settings::default() };
        Orbit::new(&self.pair, &self.start, settings).expect("printed data")
    }

    /// Starts of the first `count` flights of the floating-point orbit, after their impacts, and the reduced pair in balls.
    pub fn launches(&self, count: u64) -> (Reduced<Ball>, Vec<Launch>) {
        let pair = Reduced::exact(&self.pair).and_then(|exact| exact.enclosed()).expect("printed data");
        let launches = self
            .orbit(Arithmetic::Float, count)
            .map(|impact| Launch {
                wall: impact.wall,
                phase: impact.phase.mid(),
                velocity: impact.wall.inward(pair.centre().rebound(impact.velocity.mid())),
            })
            .collect();
        (pair, launches)
    }
}

/// The start of one flight.
#[derive(Clone, Copy)]
pub struct Launch {
    /// The wall it leaves.
    pub wall: Wall,
    /// Phase at the start \[forcing periods\].
    pub phase: f64,
    /// Velocity after the impact, relative to the gap.
    pub velocity: f64,
}

impl Launch {
    /// The flight, with the certified kernel's sine and cosine.
    #[inline(always)]
    pub fn flight(&self, pair: &Reduced<f64>) -> Flight<f64> {
        self.flight_with(pair, kernel::sin_cos(self.phase))
    }

    /// The flight in intervals.
    pub fn intervals(&self, pair: &Reduced<Interval>) -> Flight<Interval> {
        let [phase, velocity] = [self.phase, self.velocity].map(Interval::from_f64);
        Flight::from_wall(pair, self.wall, phase, velocity, phase.wave())
    }

    /// The flight with the given sine and cosine of its phase.
    #[inline(always)]
    pub fn flight_with(&self, pair: &Reduced<f64>, sin_cos: (f64, f64)) -> Flight<f64> {
        Flight::from_wall(pair, self.wall, self.phase, self.velocity, sin_cos)
    }
}

/// Nanoseconds that each of `count` pieces of a work takes.
pub fn time(count: usize, work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_nanos() as f64 / count as f64
}

/// The middle one of the values; no number of none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
