//! One impact for all states of a set: from the departure to the next landing (Lemma V2).

use super::affine::{Affine, COLUMN_BITS};
use super::angle::Angle;
use super::budget::Budget;
use super::contact::{Claimed, Doubt, Start, contract, cut, first_contact};
use super::flight::Flight;
use super::root::{Root, root};
use super::shaking::{Shaking, Term, Wave};
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// The parameters of the motion, over the data of the scene.
#[derive(Clone)]
pub(crate) struct Parameters<'w> {
    /// `d/2` \[length\]
    pub half_gap: Affine,
    /// `e`
    pub restitution: Affine,
    /// The harmonics, the reference first.
    pub terms: Vec<Term>,
    /// The work that is left.
    pub budget: Budget<'w>,
}

/// The states at the beginning of a flight; phases are counted from the origin of the orbit.
#[derive(Clone, Debug)]
pub(crate) struct Launch {
    pub start: Start,
    /// \[rad\]
    pub phase: Affine,
    /// `y0` \[length\]
    pub height: Affine,
    /// `y'` after the impact \[length/rad\]
    pub velocity: Affine,
    /// Phases of the harmonics near that of the middle, if any are known.
    angles: Vec<Angle>,
}

/// The states just before an impact.
#[derive(Clone, Debug)]
pub(crate) struct Landing {
    pub wall: Wall,
    pub phase: Affine,
    /// `y'` \[length/rad\]
    pub velocity: Affine,
    /// Phases of the harmonics near that of the middle, if any are known.
    pub angles: Vec<Angle>,
}

/// Bits kept below the errors of a set.
const SPARE_BITS: u32 = 64;

/// `1` for the right wall, `-1` for the left wall: the sign of `y`.
fn side(wall: Wall, bits: u32) -> Real {
    Real::int(if wall == Wall::Right { 1 } else { -1 }, bits)
}

impl Parameters<'_> {
    /// Bits of the parameters.
    pub fn bits(&self) -> u32 {
        self.half_gap.centre.bits()
    }

    /// The phase `W t + tau` at the origin of all phases.
    pub fn origin(&self) -> Real {
        self.terms[0].phase.hull()
    }

    /// Moves the origin of phases to `phase`. Only for a single harmonic: other harmonics would have to follow.
    pub fn count_from(&mut self, phase: Real) {
        debug_assert!(self.terms.len() == 1);
        self.terms[0].phase = Affine::fixed(phase);
    }

    /// Whether the box stands still.
    pub fn is_still(&self) -> bool {
        self.terms.iter().all(|term| term.amplitude.hull().is_zero())
    }

    /// The parameters at the middle of the data.
    pub fn middle(&self) -> Self {
        let middle = |x: &Affine| Affine::fixed(x.centre.clone());
        let of_term = |term: &Term| Term {
            amplitude: middle(&term.amplitude),
            phase: middle(&term.phase),
            rate: term.rate.as_ref().map(middle),
        };
        Self {
            half_gap: middle(&self.half_gap),
            restitution: middle(&self.restitution),
            terms: self.terms.iter().map(of_term).collect(),
            budget: self.budget.clone(),
        }
    }

    /// Number of the interval data, as counted by the columns.
    pub fn columns(&self) -> usize {
        let Self { half_gap, restitution, terms, .. } = self;
        let of_term = |term: &Term| {
            [Some(&term.amplitude), Some(&term.phase), term.rate.as_ref()].map(|x| x.map_or(0, Affine::length))
        };
        let of_terms = terms.iter().flat_map(of_term);
        of_terms.chain([half_gap.length(), restitution.length()]).max().unwrap_or(0) // exact: a length
    }

    /// The forcing for the members chosen by `member`, counted from the phase `since` after the origin.
    pub fn shaking(&self, since: &Real, member: fn(&Affine) -> Real) -> Shaking {
        self.shaking_by(since, member, |_, at| Angle::new(at))
    }

    /// The same as [`shaking`](Self::shaking), with phases whose sines and cosines `angle` encloses, by the number of the harmonic.
    fn shaking_by(&self, since: &Real, member: fn(&Affine) -> Real, angle: impl Fn(usize, Real) -> Angle) -> Shaking {
        let wave = |(k, term): (usize, &Term)| term.wave(since, since.bits(), member, |at| angle(k, at));
        Shaking { waves: self.terms.iter().enumerate().map(wave).collect() }
    }
}

impl Landing {
    pub fn new(wall: Wall, phase: Affine, velocity: Affine) -> Self {
        Self { wall, phase, velocity, angles: Vec::new() }
    }
}

impl Launch {
    /// Departure from `wall` by Newton's impact law (15), `p = -e v`.
    pub fn rebound(parameters: &Parameters, landing: &Landing) -> Self {
        let Landing { wall, phase, velocity, angles } = landing;
        let restitution = &parameters.restitution;
        let centre = -(restitution.centre.clone() * &velocity.centre);
        let slopes = (-velocity.hull(), -restitution.hull());
        let after = Affine::of(centre, &[(&slopes.0, restitution), (&slopes.1, velocity)]);
        Self { angles: angles.clone(), ..Self::on_wall(parameters, *wall, phase.clone(), after) }
    }

    /// Departure from inside the gap.
    pub fn inside(phase: Affine, height: Affine, velocity: Affine) -> Self {
        Self { start: Start { wall: None, is_release: false }, phase, height, velocity, angles: Vec::new() }
    }

    /// Departure from `wall` with the velocity `velocity` after the impact.
    pub fn on_wall(parameters: &Parameters, wall: Wall, phase: Affine, velocity: Affine) -> Self {
        let half_gap = &parameters.half_gap;
        let side = side(wall, half_gap.centre.bits());
        let height = Affine::of(half_gap.centre.clone() * &side, &[(&side, half_gap)]);
        Self { start: Start { wall: Some(wall), is_release: false }, phase, height, velocity, angles: Vec::new() }
    }

    /// The flights of the members chosen by `member`; `angle` encloses sine and cosine of a phase of a harmonic.
    fn flight<'w>(
        &self,
        parameters: &Parameters<'w>,
        member: fn(&Affine) -> Real,
        angle: impl Fn(usize, Real) -> Angle,
    ) -> Flight<'w> {
        let bits = self.bits(parameters);
        let of = |x: &Affine| member(x).rounded(bits);
        Flight {
            shaking: parameters.shaking_by(&of(&self.phase), member, angle),
            half_gap: of(&parameters.half_gap),
            height: of(&self.height),
            velocity: of(&self.velocity),
            budget: parameters.budget.clone(),
        }
    }

    /// Bits of the flights: not many more than the known bits of the set.
    fn bits(&self, parameters: &Parameters) -> u32 {
        // Phases are added to the phase of a flight, velocities to the velocity of the box: near 0 the leading bits of either matter little.
        let amplitude = parameters.terms[0].amplitude.centre.enclosure().mag().top().unwrap_or(0); // proposes
        let known = self.phase.accuracy(0).max(self.velocity.accuracy(amplitude)); // proposes
        let most = parameters.bits();
        known.map_or(most, |known| known.saturating_add(SPARE_BITS).min(most)) // X1: any number of bits encloses
    }

    /// The flights of the whole set.
    pub fn flights<'w>(&self, parameters: &Parameters<'w>) -> Flight<'w> {
        self.flight(parameters, Affine::hull, |_, at| Angle::new(at))
    }

    /// The flights of the whole set, of which `one` is one.
    fn flights_around<'w>(&self, parameters: &Parameters<'w>, one: &Flight<'_>) -> Flight<'w> {
        self.flight(parameters, Affine::hull, |k, at| one.shaking.waves[k].first.around(at))
    }

    /// Encloses the landings, if all flights are proved to touch `wall` first, near the claimed place.
    pub fn land(&self, parameters: &Parameters, wall: Wall, claimed: &Claimed) -> Result<Landing, Doubt> {
        let centre = self.middle_flight(parameters);
        let set = self.flights_around(parameters, &centre);
        let bits = set.bits();
        let contact = first_contact(&set, self.start, wall, claimed)?.at(bits);
        // Columns that are more than widths are worth a sharper contact.
        let is_sharp = self.phase.column_bits() > COLUMN_BITS;
        let Root { flight: centre, near, contact: own } = root(&centre, wall, &contact, is_sharp);
        let set = set.known_as(&centre);
        let contact = if is_sharp { contract(&set, wall, contact) } else { cut(&set, wall, &contact, &near) };
        let contact = contact.hull(&near);
        let v = set.slope(&contact);
        let over = |x: Real| x.over(&v).ok_or_else(|| Doubt::open("a graze is not excluded"));

        // d(th1, v1) by implicit differentiation of (A.2/4/6) and of (A.1/3/5).
        let acceleration1 = set.curvature(&contact);
        let slopes = self.slopes(parameters, (&set, wall), &contact);
        let dt = slopes.iter().map(|slope| Ok((over(slope.along.clone())?, slope.x))).collect::<Result<Vec<_>, _>>()?;
        let dv: Vec<_> =
            dt.iter().zip(&slopes).map(|((dt, x), slope)| (acceleration1.clone() * dt + &slope.beside, *x)).collect();
        let by_value = |slopes: &[(Real, &Affine)], centre| {
            let terms: Vec<_> = slopes.iter().map(|(slope, x)| (slope, *x)).collect();
            Affine::of(centre, &terms).recentred()
        };
        // The state of the middle, from the near point on.
        let phase = self.phase.centre.rounded(bits) + &own;
        let velocity = centre.slope(&near) + &(centre.curvature(&own.hull(&near)) * &(own - &near));
        let (phase, velocity) = (by_value(&dt, phase), by_value(&dv, velocity));
        Ok(Landing { wall, phase, velocity, angles: centre.shaking.known_later() })
    }

    /// The slopes of a landing on `wall` at `h`, one for each quantity that the landing depends on; `set` encloses all flights.
    fn slopes<'x>(&'x self, parameters: &'x Parameters, (set, wall): (&Flight, Wall), h: &Real) -> Vec<Slope<'x>> {
        let bits = set.bits();
        let acceleration = set.shaking.first_acceleration();
        let one = Real::int(1, bits);
        let by = |x, along, beside| Slope { x, along, beside };
        let mut slopes = vec![
            by(&self.phase, acceleration.clone() * h + &set.velocity, -acceleration),
            by(&self.height, -one.clone(), Real::zero(bits)),
            by(&self.velocity, -h.clone(), one),
            by(&parameters.half_gap, side(wall, bits), Real::zero(bits)),
        ];
        let since = self.phase.hull().rounded(bits);
        for (wave, term) in set.shaking.waves.iter().zip(&parameters.terms) {
            slopes.extend(term.slopes(wave, &since, h));
        }
        slopes
    }

    /// Encloses `y` minus the level of `wall` at the extrema of all flights; `h` holds their phases, `centre` the middle's value (Lemma V4).
    pub fn beyond(&self, parameters: &Parameters, wall: Wall, h: &Real, centre: Real) -> Affine {
        let set = self.flights(parameters);
        // V4: y' vanishes, so that the height does not depend on the place of the extremum
        let slopes = self.slopes(parameters, (&set, wall), &h.at(set.bits()));
        let by: Vec<_> = slopes.into_iter().map(|Slope { x, along, .. }| (-along, x)).collect();
        let terms: Vec<_> = by.iter().map(|(slope, x)| (slope, *x)).collect();
        Affine::of(centre, &terms).recentred()
    }

    /// The flight of the middle of the set.
    pub fn middle_flight<'w>(&self, parameters: &Parameters<'w>) -> Flight<'w> {
        let near = |k: usize, at: &Real| self.angles.get(k).and_then(|angle: &Angle| angle.turned(at));
        self.flight(parameters, |x| x.centre.clone(), |k, at| near(k, &at).unwrap_or_else(|| Angle::new(at)))
    }
}

/// The dependence of a landing on a quantity `x`: `v dth1 = along dx`, `dv = y'' dth1 + beside dx`.
struct Slope<'x> {
    x: &'x Affine,
    along: Real,
    beside: Real,
}

impl Term {
    /// The slopes of a landing at `h` after a departure at the phase `since`, by the inexact data of the harmonic.
    fn slopes(&self, wave: &Wave, since: &Real, h: &Real) -> Vec<Slope<'_>> {
        let Self { amplitude, phase, rate } = self;
        let mut slopes = Vec::new();
        if [Some(amplitude), Some(phase), rate.as_ref()].into_iter().flatten().all(Affine::is_fixed) {
            return slopes;
        }
        let (sin1, cos1) = wave.sin_cos(h);
        let (sin0, cos0) = (&wave.first.sin, &wave.first.cos);
        let (turned, slowed) = (cos1.clone() - cos0, sin1.clone() - sin0);
        if !amplitude.is_fixed() {
            let along = slowed.clone() - &wave.rated(cos0.clone() * h, 1);
            slopes.push(Slope { x: amplitude, along, beside: -wave.rated(turned.clone(), 1) });
        }
        let of_amplitude = |x: Real| x * &wave.amplitude;
        if !phase.is_fixed() {
            let along = turned.clone() + &wave.rated(sin0.clone() * h, 1);
            slopes.push(Slope {
                x: phase,
                along: of_amplitude(along),
                beside: of_amplitude(wave.rated(slowed.clone(), 1)),
            });
        }
        if let Some(rate) = rate.as_ref().filter(|rate| !rate.is_fixed()) {
            // The rate also changes the harmonic's phase at the departure.
            let until = since.clone() + h;
            let swept = sin0.clone() * since;
            let along = cos1 * &until - &(cos0.clone() * &until) + &wave.rated(swept.clone() * h, 1);
            let beside = wave.rated(sin1 * &until - &swept, 1) - &turned;
            slopes.push(Slope { x: rate, along: of_amplitude(along), beside: of_amplitude(beside) });
        }
        slopes
    }
}
