//! The flights of a certificate as numbers without units: phases `W t + tau`, velocities in `A W`, lengths in `A`, all of the
//! reference harmonic.

use super::cuts::Cuts;
use crate::check::{self, Data, Doubt, Piece, Walk};
use crate::{Certificate, Claim};
use impact_pair_exact::{Exact, Real};
use impact_pair_model::Wall;
use impact_pair_model::watch::{Stage, Watch};
use impact_pair_model::{EventKind, Excitation};

/// The start of an orbit.
#[derive(Clone, Debug)]
pub(super) struct Origin {
    pub phase: Real,
    /// Before the impact for a start on a wall.
    pub velocity: Real,
}

/// A flight from the middle of the data, and the impact that ends it.
#[derive(Clone, Debug)]
pub(super) struct Flight {
    /// The wall it leaves; `None` for a start inside the gap.
    pub from: Option<Wall>,
    pub wall: Wall,
    /// At its ends.
    pub phases: [Real; 2],
    /// Before the impact at its end.
    pub velocity: Real,
    /// `y''` at its end over that.
    pub tilt: Real,
    /// The claimed bounds of phase and velocity.
    pub printed: [[Real; 2]; 2],
    // About as much in doubles:
    /// Velocity before and after the departure; `e`, or 1 from inside the gap.
    pub before: f64,
    pub u: f64,
    pub restitution: f64,
    /// Length, `y''` at the ends, and velocity at the end.
    pub h: f64,
    pub bend: [f64; 2],
    pub rate: f64,
    /// The ends of departure and middle, as parts of the length.
    pub cuts: [f64; 2],
    /// Bits that extrema near a wall take.
    pub nearness: u32,
    /// No displacement of the box is greater.
    pub reach: f64,
    /// Half the widths of `e` and of `d/A`.
    pub spread: [f64; 2],
    /// How far the displacement of the box and its velocity are unknown at a known phase.
    pub unknown: [f64; 2],
}

fn float(x: &Real) -> f64 {
    x.enclosure().mid_rad().0
}

fn half_width(x: &Real) -> f64 {
    x.enclosure().wid().scaled(-1).to_f64_up()
}

/// How far displacement and velocity of the box are unknown at a known phase of the reference: by what the data of the other
/// harmonics leave open.
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

/// The start and the flights up to `claims`, which are impacts, at `bits`; or why one cannot be confirmed, after how many.
pub(super) fn flights(
    certificate: &Certificate,
    data: &Data,
    claims: &[Claim],
    bits: u32,
    watch: &dyn Watch,
) -> (Origin, Vec<Flight>, Option<Doubt>) {
    let mut walk = Walk::new(certificate, data, &Piece::default(), bits);
    let parameters = walk.parameters.clone();
    let amplitude = parameters.terms[0].amplitude.hull();
    let unit = |x: &Real| x.over(&amplitude).expect("the box is excited");
    let middle = |x: &Real| Real::point(x.mid(), bits);
    let (phase, velocity, _) = data.state(&Piece::default(), bits);
    let origin = Origin { phase: walk.absolute(&phase.less_centre().hull()), velocity: unit(&velocity.hull()) };
    let half_gap = unit(&parameters.half_gap.hull());
    let spread = [half_width(&parameters.restitution.hull()), 2.0 * half_width(&half_gap)];
    let mut before = float(&origin.velocity);
    let mut flights = Vec::new();
    for claim in claims {
        let EventKind::Impact { velocity: printed, .. } = &claim.kind else { break };
        let departure = walk.standing.departure().clone();
        if let Err(doubt) = walk.confirm(claim) {
            return (origin, flights, Some(doubt));
        }
        if watch.proceed(Stage::Claims(flights.len() + 1)).is_break() {
            return (origin, flights, Some(Doubt::Open("interrupted".to_owned())));
        }
        let landing = walk.standing.landing().expect("an impact was confirmed");
        let from = departure.start.wall;
        let phases = [&departure.phase, &landing.phase].map(|x| middle(&walk.absolute(&x.centre)));
        let velocity = middle(&unit(&landing.velocity.centre));
        let length = phases[1].clone() - &phases[0];
        let centre = check::Flight {
            shaking: parameters.shaking(&departure.phase.centre, |x| x.centre.clone()),
            half_gap: parameters.half_gap.centre.clone(),
            height: departure.height.centre.clone(),
            velocity: departure.velocity.centre.clone(),
            budget: parameters.budget.clone(),
        };
        let bend = [centre.shaking.first_acceleration(), centre.shaking.acceleration(&length)].map(|x| unit(&x));
        let cuts = Cuts::new(&centre, float(&length));
        let aw = amplitude.clone() * &Real::of(&data.frequency, bits);
        let time = claim
            .time
            .each_ref()
            .map(|time| Real::rational(time, bits) * &Real::of(&data.frequency, bits) + &Real::of(&data.delay, bits));
        let speeds = printed.each_ref().map(|v| Real::rational(v, bits).over(&aw).expect("the box is excited"));
        let u = float(&unit(&departure.velocity.centre));
        flights.push(Flight {
            from,
            wall: landing.wall,
            tilt: middle(&bend[1].over(&velocity).expect("an impact has a velocity")),
            printed: [time, speeds],
            before,
            u,
            restitution: if from.is_some() { float(&parameters.restitution.centre) } else { 1.0 },
            h: float(&length),
            bend: bend.each_ref().map(float),
            rate: float(&velocity),
            cuts: cuts.places(u == 0.0),
            nearness: cuts.nearness(),
            reach: float(&unit(&centre.shaking.reach())),
            spread,
            unknown: unknown(certificate.pair().excitation(), &phases[1]),
            phases,
            velocity,
        });
        before = flights.last().map_or(before, |flight| flight.rate);
    }
    (origin, flights, None)
}
