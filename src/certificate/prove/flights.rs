//! The flights of a certificate as numbers without units: phases `W t + tau`, velocities in `A W`, lengths in `A`.

use crate::certificate::check::{Data, Doubt, Piece, Walk};
use crate::certificate::{Certificate, Claim, ClaimKind};
use crate::exact::Real;
use crate::pair::Wall;

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
    /// `sin th1` over that.
    pub tilt: Real,
    /// The claimed bounds of phase and velocity.
    pub printed: [[Real; 2]; 2],
    // About as much in doubles:
    /// Velocity before and after the departure; `e`, or 1 from inside the gap.
    pub before: f64,
    pub u: f64,
    pub restitution: f64,
    /// Length, sines at the ends, and velocity at the end.
    pub h: f64,
    pub sin: [f64; 2],
    pub rate: f64,
    /// The phase of the departure in `[0, 2 pi)`, `y` there and `d/2`.
    pub turn: f64,
    pub height: f64,
    pub half_gap: f64,
    /// Half the widths of `e` and of `d/A`.
    pub spread: [f64; 2],
}

fn float(x: &Real) -> f64 {
    x.enclosure().mid_rad().0
}

fn half_width(x: &Real) -> f64 {
    x.enclosure().width().scaled(-1).to_f64_up()
}

/// The start and the flights up to `claims`, which are impacts, at `bits`; or why one cannot be confirmed, after how many.
pub(super) fn flights(
    certificate: &Certificate,
    data: &Data,
    claims: &[Claim],
    bits: u32,
    progress: &mut impl FnMut(usize),
) -> (Origin, Vec<Flight>, Option<Doubt>) {
    let mut walk = Walk::new(certificate, data, &Piece::default(), bits);
    let parameters = walk.parameters.clone();
    let amplitude = parameters.terms[0].amplitude.hull();
    let unit = |x: &Real| x.over(&amplitude).expect("the box is shaken");
    let middle = |x: &Real| Real::point(x.mid(), bits);
    let (phase, velocity, height) = data.state(&Piece::default(), bits);
    let origin = Origin { phase: walk.absolute(&phase.less_centre().hull()), velocity: unit(&velocity.hull()) };
    let half_gap = unit(&parameters.half_gap.hull());
    let spread = [half_width(&parameters.restitution.hull()), 2.0 * half_width(&half_gap)];
    let mut before = float(&origin.velocity);
    let mut flights = Vec::new();
    for claim in claims {
        let ClaimKind::Impact { velocity: printed, .. } = &claim.kind else { break };
        let departure = walk.departure.clone();
        if let Err(doubt) = walk.confirm(claim) {
            return (origin, flights, Some(doubt));
        }
        progress(flights.len() + 1);
        let landing = walk.landing.as_ref().expect("an impact was confirmed");
        let from = departure.start.wall;
        let phases = [&departure.phase, &landing.phase].map(|x| middle(&walk.absolute(&x.centre)));
        let velocity = middle(&unit(&landing.velocity.centre));
        let [(sin0, cos0), (sin1, _)] = phases.each_ref().map(Real::sin_cos);
        let turn = float(&sin0).atan2(float(&cos0)).rem_euclid(std::f64::consts::TAU);
        let aw = amplitude.clone() * &Real::of(&data.frequency, bits);
        let time = claim
            .time
            .each_ref()
            .map(|time| Real::rational(time, bits) * &Real::of(&data.frequency, bits) + &Real::of(&data.delay, bits));
        let speeds = printed.each_ref().map(|v| Real::rational(v, bits).over(&aw).expect("the box is shaken"));
        let height = match from {
            Some(wall) => -wall.sign() * float(&half_gap),
            None => height.as_ref().map_or(0.0, |height| float(&unit(&height.centre))),
        };
        flights.push(Flight {
            from,
            wall: landing.wall,
            tilt: middle(&sin1.over(&velocity).expect("an impact has a velocity")),
            printed: [time, speeds],
            before,
            u: float(&unit(&departure.velocity.centre)),
            restitution: if from.is_some() { float(&parameters.restitution.centre) } else { 1.0 },
            h: float(&(phases[1].clone() - &phases[0])),
            sin: [float(&sin0), float(&sin1)],
            rate: float(&velocity),
            turn,
            height,
            half_gap: float(&half_gap),
            spread,
            phases,
            velocity,
        });
        before = flights.last().map_or(before, |flight| flight.rate);
    }
    (origin, flights, None)
}
