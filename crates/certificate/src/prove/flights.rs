//! The flights of a certificate as numbers without units: phases `W t + tau`, velocities in `A W`, lengths in `A`, with `A`, `W`, `tau` of
//! the reference harmonic.

use super::cuts::Cuts;
use crate::check::{self, Data, Doubt, Launch, Parameters, Piece, Walk};
use crate::{Certificate, Claim};
use impact_pair_exact::{Exact, Real};
use impact_pair_model::Wall;
use impact_pair_model::watch::{Stage, Watch};
use impact_pair_model::{EventKind, Excitation};
use num_rational::BigRational;

/// The start of an orbit.
#[derive(Clone, Debug)]
pub(super) struct Origin {
    pub phase: Real,
    /// Velocity before the impact, for a start on a wall.
    pub velocity: Real,
}

/// A flight from the middle of the data, and the impact that ends it.
#[derive(Clone, Debug)]
pub(super) struct Flight {
    /// The wall of the departure; `None` for a start inside the gap.
    pub from: Option<Wall>,
    pub wall: Wall,
    /// The phases at the ends of the flight.
    pub phases: [Real; 2],
    /// Velocity before the impact at the end of the flight.
    pub velocity: Real,
    /// `y''` at the end of the flight over the velocity there.
    pub tilt: Real,
    /// The claimed bounds of phase and velocity.
    pub printed: [[Real; 2]; 2],
    // Approximate quantities in doubles:
    /// Velocity before and after the departure; `e`, or 1 from inside the gap.
    pub before: f64,
    pub u: f64,
    pub restitution: f64,
    /// Length, `y''` at the ends, and velocity at the end of the flight.
    pub h: f64,
    pub bend: [f64; 2],
    pub rate: f64,
    /// The end of the departure and the end of the middle part, relative to the length.
    pub cuts: [f64; 2],
    /// Additional bits for extrema near a wall.
    pub nearness: u32,
    /// Upper bound of the displacement of the box.
    pub reach: f64,
    /// Half the widths of `e` and of `d/A`.
    pub spread: [f64; 2],
    /// Uncertainties of the box's displacement and velocity at a known phase.
    pub unknown: [f64; 2],
}

fn float(x: &Real) -> f64 {
    x.enclosure().mid_rad().0
}

fn half_width(x: &Real) -> f64 {
    x.enclosure().wid().scaled(-1).to_f64_up()
}

/// Uncertainties of the box's displacement and velocity at a known phase of the reference, from the interval data of the other
/// harmonics.
fn unknown(excitation: &Excitation, phase: &Real) -> [f64; 2] {
    let mut unknown = [0.0; 2];
    if excitation.is_point() {
        return unknown;
    }
    let of = |x: &Exact| Real::of(x, phase.bits());
    let reference = excitation.reference();
    for harmonic in &excitation.harmonics()[1..] {
        let share = of(harmonic.amplitude()).over(&of(reference.amplitude())).expect("the box is excited");
        let ratio = of(harmonic.frequency()).over(&of(reference.frequency())).expect("the frequency is positive");
        // As the proof computes it.
        let turned = ratio.clone() * phase + &(of(harmonic.phase()) - &(ratio.clone() * &of(reference.phase())));
        let parts = [share.clone(), share * &ratio];
        for (unknown, part) in unknown.iter_mut().zip(&parts) {
            *unknown += half_width(part) + float(part) * half_width(&turned);
        }
    }
    unknown
}

/// The start and the flights up to `claims`, which are impacts, at `bits`; or the reason why an impact cannot be confirmed, and its position.
pub(super) fn flights(
    certificate: &Certificate,
    data: &Data,
    claims: &[Claim],
    bits: u32,
    watch: &dyn Watch,
) -> (Origin, Vec<Flight>, Option<Doubt>) {
    let mut walk = Walk::new(certificate, data, &Piece::default(), bits);
    let scale = Scale::new(certificate.pair().excitation(), data, walk.parameters.clone(), bits);
    let (phase, velocity, _) = data.state(&Piece::default(), bits);
    let origin = Origin { phase: walk.absolute(&phase.less_centre().hull()), velocity: scale.unit(&velocity.hull()) };
    let mut before = float(&origin.velocity);
    let mut flights = Vec::new();
    for claim in claims {
        let EventKind::Impact { velocity: printed, .. } = &claim.kind else { break };
        let departure = walk.standing.departure().clone();
        if let Err(doubt) = walk.confirm(claim) {
            return (origin, flights, Some(doubt));
        }
        if watch.proceed(Stage::Claims(flights.len() + 1)).is_break() {
            return (origin, flights, Some(Doubt::open("interrupted")));
        }
        let printed = scale.printed(&claim.time, printed);
        let flight = scale.flight(&walk, &departure, printed, before);
        before = flight.rate;
        flights.push(flight);
    }
    (origin, flights, None)
}

/// The data of a certificate, and its units.
struct Scale<'d> {
    excitation: &'d Excitation,
    data: &'d Data<'d>,
    parameters: Parameters<'d>,
    /// `A` of the reference harmonic \[length\]
    amplitude: Real,
    /// See [`Flight::spread`].
    spread: [f64; 2],
    bits: u32,
}

impl<'d> Scale<'d> {
    fn new(excitation: &'d Excitation, data: &'d Data<'d>, parameters: Parameters<'d>, bits: u32) -> Self {
        let amplitude = parameters.terms[0].amplitude.hull();
        let scale = Self { excitation, data, parameters, amplitude, spread: [0.0; 2], bits };
        let half_gap = scale.unit(&scale.parameters.half_gap.hull());
        let spread = [half_width(&scale.parameters.restitution.hull()), 2.0 * half_width(&half_gap)];
        Self { spread, ..scale }
    }

    /// A length in `A`, or a velocity of lengths per radian in `A W`.
    fn unit(&self, x: &Real) -> Real {
        x.over(&self.amplitude).expect("the box is excited")
    }

    fn middle(&self, x: &Real) -> Real {
        Real::point(x.mid(), self.bits)
    }

    /// The claimed bounds of a time as phases, and of a velocity in `A W`.
    fn printed(&self, time: &[BigRational; 2], velocity: &[BigRational; 2]) -> [[Real; 2]; 2] {
        let of = |x: &Exact| Real::of(x, self.bits);
        let frequency = of(&self.data.frequency);
        let aw = self.amplitude.clone() * &frequency;
        let phase = |time: &BigRational| Real::rational(time, self.bits) * &frequency + &of(&self.data.delay);
        let speed = |v: &BigRational| Real::rational(v, self.bits).over(&aw).expect("the box is excited");
        [time.each_ref().map(phase), velocity.each_ref().map(speed)]
    }

    /// The flight from a departure to the last impact of a walk; `before` is the velocity before the departure.
    fn flight(&self, walk: &Walk<'_>, departure: &Launch, printed: [[Real; 2]; 2], before: f64) -> Flight {
        let landing = walk.standing.landing().expect("an impact was confirmed");
        let (from, parameters) = (departure.start.wall, &self.parameters);
        let phases = [&departure.phase, &landing.phase].map(|x| self.middle(&walk.absolute(&x.centre)));
        let velocity = self.middle(&self.unit(&landing.velocity.centre));
        let length = phases[1].clone() - &phases[0];
        let centre = check::Flight {
            shaking: parameters.shaking(&departure.phase.centre, |x| x.centre.clone()),
            half_gap: parameters.half_gap.centre.clone(),
            height: departure.height.centre.clone(),
            velocity: departure.velocity.centre.clone(),
            budget: parameters.budget.clone(),
        };
        let bend = [centre.shaking.first_acceleration(), centre.shaking.acceleration(&length)].map(|x| self.unit(&x));
        let cuts = Cuts::new(&centre, float(&length));
        let u = float(&self.unit(&departure.velocity.centre));
        Flight {
            from,
            wall: landing.wall,
            tilt: self.middle(&bend[1].over(&velocity).expect("an impact has a velocity")),
            printed,
            before,
            u,
            restitution: if from.is_some() { float(&parameters.restitution.centre) } else { 1.0 },
            h: float(&length),
            bend: bend.each_ref().map(float),
            rate: float(&velocity),
            cuts: cuts.places(u == 0.0),
            nearness: cuts.nearness(),
            reach: float(&self.unit(&centre.shaking.reach())),
            spread: self.spread,
            unknown: unknown(self.excitation, &phases[1]),
            phases,
            velocity,
        }
    }
}
