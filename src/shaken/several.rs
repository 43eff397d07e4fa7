//! Several harmonics: first contacts by the scan of [`crate::several`].

use std::sync::Arc;

use num_bigint::BigInt;

use super::still::quarter_turn;
use super::{Flying, Origin, Parameters, Released, Shaken, Still, Sum};
use crate::Error;
use crate::contact::{Contact, Reason, SetContact, Undecided};
use crate::exact::{Enclosure, Exact};
use crate::flight::Launch;
use crate::impact::Touch;
use crate::number::{Ball, UNIT, up};
use crate::pair::{ImpactPair, Inward, Reduced, Wall, ball, within};
use crate::several::{
    Band, Doubt, FlightNumber, Found, Harmonics, PhaseNumber, Reach, Scan, Spectrum, SumFlight, accumulation, is_touch,
    release,
};

/// A pair that is shaken by several harmonics, equation (1).
#[derive(Clone, Debug)]
pub(crate) struct SeveralHarmonics {
    pub spectrum: Arc<Spectrum>,
    pub pair: Reduced<Ball>,
    pub floats: Sum<f64>,
    pub balls: Sum<Ball>,
    pub band: Arc<Band>,
}

impl SeveralHarmonics {
    /// The harmonics of `pair`, phases counted from the forcing period `origin`; `None` for a single harmonic.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions or doubles.
    pub fn new(pair: &ImpactPair, origin: &BigInt) -> Result<Option<Self>, Error> {
        let Some(spectrum) = Spectrum::new(pair, origin)? else { return Ok(None) };
        let harmonics = Harmonics::in_doubles(&spectrum, pair)?;
        let amplitude = pair.excitation().reference().amplitude();
        let sums = within("excitation.amplitude", amplitude, spectrum.sums())?;
        let enclose = |x: &Exact| ball("excitation.amplitude", x);
        let (alpha, beta) = (enclose(&sums.alpha)?, enclose(&sums.beta)?);
        let restitution = ball("pair.restitution", &sums.restitution)?;
        let floats = Harmonics::new(&spectrum, f64::MANTISSA_DIGITS);
        Ok(Some(Self {
            pair: Reduced { alpha, beta, restitution },
            floats: Sum { harmonics: floats, restitution: restitution.mid() },
            band: Arc::new(Band::new(&harmonics, spectrum.period)),
            balls: Sum { harmonics, restitution },
            spectrum: Arc::new(spectrum),
        }))
    }

    pub(super) fn reach(&self) -> Reach<'_> {
        Reach::new(&self.band, &self.balls.harmonics)
    }

    /// Isolates the first contact of all flights from these starts. Lemmas H2-H6
    pub fn first<N: FlightNumber>(&self, harmonics: &Harmonics<N>, all: Launch<N>) -> Result<Found<N>, Doubt<N>> {
        let centre = SumFlight::new(harmonics, all.map(FlightNumber::centre_of), None);
        Scan::new(&SumFlight::new(harmonics, all, None), &centre).first(&mut self.reach())
    }

    /// First contacts of all flights; a doubt that the centre does not share is due to the set's width.
    pub(super) fn scan<N: FlightNumber>(
        &self,
        all: &SumFlight<'_, N>,
        centre: &SumFlight<'_, N>,
    ) -> Result<Found<N>, Undecided> {
        Scan::new(all, centre).first(&mut self.reach()).map_err(|doubt| {
            let undecided = doubt.undecided(all.launch.wall);
            let is_width = || Scan::new(centre, centre).first(&mut self.reach()).is_ok();
            match doubt {
                Doubt::Graze { .. } | Doubt::SmallAngle if is_width() => {
                    Undecided { reason: Reason::Width, ..undecided }
                }
                _ => undecided,
            }
        })
    }

    /// Whether a ball on a wall at an origin, where the contact force is exactly 0, is proved to stick to the wall from then on.
    fn is_pressed_from(&self, wall: Wall, phases: &[Exact]) -> bool {
        let zero = Ball::exact(0.0);
        let launch = Launch::from_wall(wall, 0, zero, zero, false);
        let waves = waves(phases, f64::MANTISSA_DIGITS);
        let flight = SumFlight::new(&self.balls.harmonics, launch, waves.as_ref());
        let jerk = wall.inward(flight.jerk).bounds();
        flight.acceleration == zero && jerk.1 < 0.0 || is_touch(&self.spectrum, wall, phases)
    }
}

/// Sines and cosines of phases, exact at quarter periods; `None` without phases.
fn waves<N: FlightNumber>(phases: &[Exact], bits: u32) -> Option<Vec<(N, N)>> {
    let wave = |phase: &Exact| match quarter_turn(phase) {
        Some((sin, cos)) => (N::enclose(&sin, bits), N::enclose(&cos, bits)),
        None => N::enclose(phase, bits).wave(),
    };
    (!phases.is_empty()).then(|| phases.iter().map(wave).collect())
}

impl Shaken for SeveralHarmonics {
    fn pair(&self) -> &Reduced<Ball> {
        &self.pair
    }

    fn period(&self) -> Option<u32> {
        self.spectrum.period.and_then(|period| u32::try_from(period).ok())
    }

    fn displacement(&self, turns: i64, phase: Ball) -> [Ball; 3] {
        let sums = self.balls.harmonics.sums(turns, &phase);
        [sums.sine, sums.cosine, sums.acceleration]
    }

    fn steepest(&self) -> f64 {
        self.balls.harmonics.rates.second
    }

    fn acceleration(&self, turns: i64, phase: f64) -> f64 {
        self.floats.harmonics.sums(turns, &phase).acceleration
    }

    fn max_reported_chatter(&self, least: f64) -> Option<f64> {
        // A rest is reported once the remaining chatter is shorter than the digits show.
        Some(least.max(f64::MIN_POSITIVE)) // proposes: Z1 is proved where it says so
    }

    fn accumulation(&self, wall: Wall, turns: i64, phase: &Enclosure, after: Ball, phases: &[Exact]) -> Option<f64> {
        let (mid, rad) = phase.mid_rad();
        if !phases.is_empty() && after == Ball::exact(0.0) && self.is_pressed_from(wall, phases) {
            return Some(0.0);
        }
        accumulation(&self.balls.harmonics, self.pair.restitution, wall, turns, Ball::new(mid, rad), after)
    }

    fn release(&self, wall: Wall, turns: i64, phase: &Enclosure, bits: u32) -> Option<Released> {
        let zero = release(&self.spectrum, &self.balls.harmonics, wall, turns, phase.mid_rad().0)?;
        let at = Touch { wall, turns: zero.turns, phase: zero.enclosure(bits)? };
        Some(Released { at, zero: Some(zero) })
    }

    fn may_be_loose(&self, wall: Wall, turns: i64, phase: &Enclosure) -> bool {
        let (mid, rad) = phase.mid_rad();
        let inward = wall.inward(self.balls.harmonics.sums(turns, &Ball::new(mid, rad)).acceleration);
        inward.mid() + inward.rad() >= 0.0
    }

    fn still(&self, origin: &Origin<Exact>) -> Option<Still> {
        Still::under_several(&self.spectrum, origin, || self.band.tight(&self.balls.harmonics)).ok().flatten()
    }
}

impl Parameters for SeveralHarmonics {
    type In<N: PhaseNumber> = Sum<N>;
    type Waves<N: FlightNumber> = Vec<(N, N)>;

    fn floats(&self) -> &Sum<f64> {
        &self.floats
    }

    fn balls(&self) -> &Sum<Ball> {
        &self.balls
    }

    fn waves<N: FlightNumber>(&self, exact: &[Exact], phase: &N, bits: u32) -> Option<Vec<(N, N)>> {
        // Of a phase that is rounded the centre is another.
        let is_point = (phase.clone() - phase.centre_of()).is_zero();
        if is_point { waves(exact, bits) } else { None }
    }
}

impl Flying for SeveralHarmonics {
    fn propose(&self, launch: &Launch<f64>) -> Result<Contact<f64>, Undecided> {
        let found = self.first(&self.floats.harmonics, launch.clone()).map_err(|doubt| doubt.undecided(launch.wall))?;
        let velocity = match found.wall {
            Wall::Left => found.centre_velocity.min(0.0),  // proposes
            Wall::Right => found.centre_velocity.max(0.0), // proposes
        };
        let (turns, time) = (found.at.turns as f64, found.at.time()); // proposes
        Ok(Contact { wall: found.wall, turns, phase: launch.phase + found.at.rest, time, velocity })
    }

    fn first_contact(
        &self,
        all: Launch<Ball>,
        waves: Option<&Vec<(Ball, Ball)>>,
    ) -> Result<(Contact<Ball>, [Ball; 2]), Undecided> {
        let centre = all.map(FlightNumber::centre_of);
        let (contact, accelerations) = self.first_contacts(all, centre, waves)?;
        Ok((contact.all, accelerations))
    }

    fn first_contacts(
        &self,
        all: Launch<Ball>,
        centre: Launch<Ball>,
        waves: Option<&Vec<(Ball, Ball)>>,
    ) -> Result<(SetContact, [Ball; 2]), Undecided> {
        let (phase, middle) = (all.phase, centre.phase.mid());
        let [all, centre] = [all, centre].map(|launch| SumFlight::new(&self.balls.harmonics, launch, waves));
        let found = self.scan(&all, &centre)?;
        Ok((set_contact(&found, phase, middle), [all.acceleration, found.acceleration]))
    }
}

/// The contact that was found, of flights that start at `phase`, their centre at `middle`.
fn set_contact(found: &Found<Ball>, phase: Ball, middle: f64) -> SetContact {
    let rest = found.at.rest.mid();
    let at = middle + rest;
    let rounding = UNIT * at.abs();
    let time = found.at.time();
    let velocity = found.centre_velocity;
    // The enclosure of all, around the velocity of the centre.
    let apart = (found.velocity.mid() - velocity.mid()).abs();
    SetContact {
        all: Contact {
            wall: found.wall,
            turns: found.at.turns as f64, // N1: below 2^52
            phase: Ball::new(at, up(found.reach + phase.rad() + (phase.mid() - middle).abs() + rounding)),
            time: time.widened(found.reach),
            velocity: Ball::new(velocity.mid(), up(found.velocity.rad() + apart)),
        },
        phase: Ball::new(at, up(found.centre_reach + rounding)),
        // That at the time found; the phase that is stored is rounded (Lemma S4).
        velocity: velocity.widened(up(found.acceleration.mag() * rounding)),
        slope: found.acceleration,
    }
}
