//! The textbook method, one impact after another: plain interval arithmetic, as a reference for the other methods.
//!
//! Flights are solved by [`crate::contact::textbook`]. The set of states is a box: its image is that of the centre and
//! the Jacobian (A.7) over the box times the box around the centre (Lemma S1), cut with the contacts of the whole box. A
//! box is wrapped in another at each impact; [`super::set`] rotates its axes instead.

use std::convert::Infallible;

use inari::Interval;

use super::motion::Motion;
use crate::contact::textbook::first_contact;
use crate::contact::{Contact, Grazed, Reason, Undecided, Verdict};
use crate::flight::Flight;
use crate::mapping::{Passage, jacobian};
use crate::number::{Ball, Enclosing, Number, Wave};
use crate::pair::{Inward, Reduced};
use crate::shaken::{Location, Origin, State};

/// One impact after another.
#[derive(Clone, Debug)]
pub(super) struct TextbookMotion {
    pair: Reduced<Interval>,
    /// A box; its whole forcing periods are not counted.
    state: State<Interval>,
}

/// The states in another arithmetic.
fn states<N: Copy, M>(state: &State<N>, f: impl Fn(N) -> M) -> State<M> {
    state.map(|_, &x| Ok::<_, Infallible>(f(x))).unwrap_or_else(|none| match none {})
}

/// The flights that start from these states. **Equation** (15)
fn flight<N: Wave>(State { place, phase, velocity, .. }: State<N>, pair: &Reduced<N>) -> Flight<N> {
    let sin_cos = phase.wave();
    match place {
        Location::Wall(wall) => Flight::from_wall(pair, wall, phase, wall.inward(pair.rebound(velocity)), sin_cos),
        Location::Inside(height) => Flight::from_inside(pair, height, phase, velocity, sin_cos),
    }
}

impl TextbookMotion {
    pub fn new(pair: &Reduced<Ball>, origin: &Origin<Ball>) -> Self {
        Self { pair: pair.map(|&x| x.into()), state: states(&origin.state, Interval::from) }
    }

    /// The first contact of all flights from a state.
    fn contact(&self, state: State<Interval>) -> Result<Contact<Interval>, Undecided> {
        match first_contact(&flight(state, &self.pair)) {
            Verdict::Certified(contact) => Ok(contact),
            Verdict::Undecided(undecided) => Err(undecided),
        }
    }

    /// Phase and velocity of all the contacts, in the mean value form. **Equations** (A.1)-(A.7), Lemma S1
    fn image(&self, contact: &Contact<Interval>) -> Result<(Interval, Interval), Undecided> {
        let State { phase, velocity, .. } = self.state;
        let centre = self.contact(states(&self.state, |x| x.centre()))?;
        let passage = Passage {
            time: contact.time,
            sin0: phase.wave().0,
            sin1: contact.phase.wave().0,
            velocity0: velocity,
            velocity1: contact.velocity,
        };
        let jacobian = jacobian(self.pair.beta, self.pair.restitution, &passage);
        let [[a, b], [c, d]] = jacobian.ok_or_else(|| Undecided::width(&balls(contact)))?;
        let (apart, faster) = (phase.spread(), velocity.spread());
        let turns = Interval::from_f64(contact.turns - centre.turns);
        let at = centre.phase - turns + (a * apart + b * faster);
        let before = centre.velocity + (c * apart + d * faster);
        Ok((at.intersection(contact.phase), before.intersection(contact.velocity)))
    }
}

fn balls(contact: &Contact<Interval>) -> Contact<Ball> {
    let Contact { wall, turns, phase, time, velocity } = *contact;
    Contact { wall, turns, phase: phase.as_ball(), time: time.as_ball(), velocity: velocity.as_ball() }
}

impl Motion for TextbookMotion {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let mut contact = self.contact(self.state.clone()).map_err(|doubt| {
            // A doubt that the centre does not share is the set's width's fault.
            let centre = self.contact(states(&self.state, |x| x.centre()));
            let is_wide = centre.is_ok() && doubt.reason == Reason::Graze;
            if is_wide { Undecided { reason: Reason::Width, ..doubt } } else { doubt }
        })?;
        // From inside the gap the enclosure of all first contacts is the new set.
        if let Location::Wall(_) = self.state.place {
            (contact.phase, contact.velocity) = self.image(&contact)?;
        }
        let Contact { wall, phase, velocity, .. } = contact;
        self.state = State { place: Location::Wall(wall), turns: 0, phase, velocity };
        Ok(balls(&contact))
    }

    fn pass_graze(&mut self) -> Option<Grazed> {
        use crate::contact::multiprecision::pass;
        use crate::number::MpBall;
        use crate::shaken::precise::PASSING_BITS;
        let wide = |x: Interval| MpBall::from_ball(x.as_ball()).rounded(PASSING_BITS);
        let passed = pass(&flight(states(&self.state, wide), &self.pair.map(|&x| wide(x))))?;
        let passed = passed.in_doubles()?;
        let Grazed { phase, height, velocity, .. } = passed;
        let place = Location::Inside(height.into());
        self.state = State { place, turns: 0, phase: phase.into(), velocity: velocity.into() };
        Some(passed)
    }

    fn accuracy(&self) -> f64 {
        let State { phase, velocity, .. } = &self.state;
        -phase.rad().max(velocity.rad()).log2() // proposes: bits to raise by
    }
}
