//! Many flights, and many sets of flights, from a wall: lanes that are decided, and the others one by one.

use super::columns::{Brackets, LaneValue, Spreads};
use super::{LANES, Lanes};
use crate::contact::bounds::{Margins, Radii};
use crate::contact::judges::{SetContact, accelerations, first_contacts, together};
use crate::contact::solve::is_phase;
use crate::contact::{Contact, PairBounds, Undecided, Verdict, first_contact};
use crate::flight::Flight;
use crate::mapping::Sheared;
use crate::number::{Ball, kernel};
use crate::pair::{Inward, Reduced, Wall, rebound_of};

/// Encloses the first contacts of many flights of one pair. Each leaves a wall at a phase in forcing periods, with a velocity away from the wall
/// in gap widths per forcing period.
///
/// **Enclosure**: `answer` gets, in the order of the starts, the verdict of [`first_contact`] on each, with the same bits.
/// **Cost**: about half of the cost of single flights, where the target has vectors of four doubles and FMA.
///
/// ```
/// use impact_pair::contact::{Verdict, first_contacts_of};
/// use impact_pair::number::Ball;
/// use impact_pair::pair::{Reduced, Wall};
/// // No shaking (A = 0): the gap is crossed in the time that the velocity says.
/// let (zero, one) = (Ball::exact(0.0), Ball::exact(1.0));
/// let pair = Reduced { alpha: zero, beta: zero, restitution: one };
/// let mut times = Vec::new();
/// first_contacts_of(&pair, [0.25, 0.5, 1.0].map(|v| (Wall::Left, 0.0, Ball::exact(v))), |verdict| match verdict {
///     Verdict::Certified(contact) => times.push(contact.time.mid()),
///     Verdict::Undecided(_) => unreachable!(),
/// });
/// assert_eq!(times, [4.0, 2.0, 1.0]);
/// ```
pub fn first_contacts_of(
    pair: &Reduced<Ball>,
    starts: impl IntoIterator<Item = (Wall, f64, Ball)>,
    mut answer: impl FnMut(Verdict<Contact<Ball>>),
) {
    let PairBounds { centre, margins, .. } = PairBounds::new(*pair);
    let (mut lanes, mut spreads, mut brackets) = (Lanes::EMPTY, Spreads::EMPTY, Brackets::EMPTY);
    let mut starts = starts.into_iter();
    let mut phases = [0.0; LANES];
    loop {
        let mut count = 0;
        for (lane, (wall, phase, velocity)) in (0..LANES).zip(&mut starts) {
            lanes.start(lane, wall, phase, velocity.mid());
            spreads.set(lane, Radii { velocity: velocity.rad(), ..Radii::default() });
            phases[lane] = phase;
            count = lane + 1;
        }
        if count == 0 {
            return;
        }
        lanes.solve(&centre);
        lanes.certify_points(&margins, &spreads, &mut brackets);
        for lane in 0..count {
            let flight = lanes.flights.get(lane);
            answer(if bool::of(lanes.states.is_decided[lane]) {
                Verdict::Certified(brackets.get(lane, lanes.searches.get(lane)).contact(&flight))
            } else {
                first_contact(&Flight { phase: phases[lane], ..flight }, &margins, spreads.get(lane))
            });
        }
    }
}

/// The image of a set of states before an impact under one mapping, P1-P4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// Encloses the contacts of all states; its velocity is that before the next impact.
    pub contact: Contact<Ball>,
    /// Encloses the Jacobian (A.7) at all states.
    pub jacobian: [[Ball; 2]; 2],
}

/// Encloses the image of all states of a wall: phase in forcing periods, velocity before the impact in gap widths per forcing period;
/// **equations** (15), (A.1)-(A.7).
///
/// **Enclosure**: for all states in the balls, and all parameters in those of the pair, contact and Jacobian lie in
/// [`Image`]. `margins` are the pair's.
/// **Undecided when** [`first_contact`] is, over the set, or the velocity of arrival may be 0.
pub fn image_of(pair: &Reduced<Ball>, margins: &Margins, (wall, [phase, before]): (Wall, [Ball; 2])) -> Verdict<Image> {
    if !is_phase(phase.mid()) {
        return Verdict::Undecided(Undecided::endless());
    }
    let [point, all] = radii(pair, phase, before);
    let velocity = centre_after(pair, wall, before).mid();
    let sin_cos = kernel::sin_cos(phase.mid());
    let flight = Flight::from_wall(&pair.centre(), wall, phase.mid(), velocity, sin_cos);
    finish(pair, [phase, before], &flight, first_contacts(&flight, margins, point, all))
}

/// Encloses the images of many sets of states, in their order, bit for bit as [`image_of`] does: at half the cost.
pub fn images_of(
    pair: &Reduced<Ball>,
    sets: impl IntoIterator<Item = (Wall, [Ball; 2])>,
    mut answer: impl FnMut(Verdict<Image>),
) {
    let PairBounds { centre, margins, .. } = PairBounds::new(*pair);
    let mut lanes = Lanes::EMPTY;
    let [mut points, mut spreads] = [Spreads::EMPTY; 2];
    let [mut centres, mut alls] = [Brackets::EMPTY; 2];
    let mut sets = sets.into_iter();
    let mut given = [(Wall::Left, [Ball::exact(0.0); 2]); LANES];
    loop {
        let mut count = 0;
        for (lane, (wall, [phase, before])) in (0..LANES).zip(&mut sets) {
            lanes.start(lane, wall, phase.mid(), centre_after(pair, wall, before).mid());
            let [point, all] = radii(pair, phase, before);
            points.set(lane, point);
            spreads.set(lane, all);
            given[lane] = (wall, [phase, before]);
            count = lane + 1;
        }
        if count == 0 {
            return;
        }
        lanes.solve(&centre);
        lanes.certify_sets(&margins, &spreads, &mut alls);
        lanes.bracket_centres(&margins, &points, &mut centres);
        for lane in 0..count {
            answer(if bool::of(lanes.states.is_decided[lane]) {
                let flight = &lanes.flights.get(lane);
                let [all, point] = [&alls, &centres].map(|brackets| brackets.get(lane, lanes.searches.get(lane)));
                finish(pair, given[lane].1, flight, Ok(together(flight, &margins, &all, &point)))
            } else {
                image_of(pair, &margins, given[lane])
            });
        }
    }
}

/// The velocity away from the wall after the impact of the set's centre.
#[inline(always)]
fn centre_after(pair: &Reduced<Ball>, wall: Wall, before: Ball) -> Ball {
    wall.inward(rebound_of(pair.restitution, Ball::exact(before.mid())))
}

/// Radii of the flight from the centre, and of the flights from all states, around the doubles of the centre.
#[inline(always)]
fn radii(pair: &Reduced<Ball>, phase: Ball, before: Ball) -> [Radii; 2] {
    let after = |before| rebound_of(pair.restitution, before).rad();
    let point = Radii { velocity: after(Ball::exact(before.mid())), ..Radii::default() };
    [point, Radii { phase: phase.rad(), velocity: after(before), ..point }]
}

/// The image from the contacts of a set.
#[inline(always)]
fn finish(
    pair: &Reduced<Ball>,
    [phase, before]: [Ball; 2],
    flight: &Flight<f64>,
    contacts: Result<(SetContact, Ball), Undecided>,
) -> Verdict<Image> {
    let (SetContact { all, .. }, sin1) = match contacts {
        Ok(contacts) => contacts,
        Err(undecided) => return Verdict::Undecided(undecided),
    };
    let accelerations = accelerations(pair, phase, flight.wall.inward(flight.sin), sin1);
    match Sheared::between(pair.restitution, all.time, accelerations, [before, all.velocity]) {
        Some(jacobian) => Verdict::Certified(Image { contact: all, jacobian: jacobian.jacobian() }),
        None => Verdict::Undecided(Undecided::width(&all)),
    }
}
