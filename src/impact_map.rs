//! The impact map: sets of states just before an impact to those just before the next one, with the Jacobian over the set.
//!
//! This is the Poincare map of the impact pair, P1-P4 of **equations** (24)-(27) and (A.1)-(A.7) over sets: what proofs of
//! periodic orbits, covering relations and invariant sets are built from.
//!
//! [`Image::states`] holds the next impact of every state of a set whose flights are all proved to have their first contact on one
//! wall, for all parameters of the pair, and [`Image::jacobian`] the Jacobian (A.7) at each of them: Lemma S5 of
//! `docs/proofs/sets.md#S5`.

use crate::clock::Clock;
use crate::contact::Undecided;
use crate::exact::Exact;
use crate::mapping::Mapping;
use crate::number::Ball;
use crate::orbit::StateSet;
use crate::pair::{ImpactPair, Inward, Wall};
use crate::shaken::{Either, Flying, Leaving, under};
use crate::{Error, turns};

/// The result of a proof, or the reason why there is none.
pub type Answer<T> = Result<T, Undecided>;

/// The impact map of a pair.
///
/// Coordinates are dimensionless: the phase `(W t + tau)/(2 pi)` in forcing periods, and the velocity `y'` just before the impact in
/// gap widths per forcing period, `2 pi y'/(W d)`. Under several harmonics phases are those of the fastest one that moves the box.
///
/// ```
/// use impact_pair::impact_map::ImpactMap;
/// use impact_pair::number::Ball;
/// use impact_pair::{Scene, pair::Wall};
///
/// let scene = Scene::parse(&std::fs::read_to_string("scenes/figure-12-exact.toml")?)?;
/// let map = ImpactMap::new(scene.pair())?;
/// // The equispaced orbit of (66)-(69): the next impact is on the right wall, half a forcing period later, as fast.
/// let speed = 4.0 / 1.5; // 2 pi v/(W d) with v = 4 pi, W = pi, d = 3 pi
/// let start = map.states(Wall::Left, Ball::exact(0.0), Ball::new(-speed, 1e-9))?;
/// let image = map.image(&start).expect("decided");
/// assert_eq!(image.mapping.to_string(), "P2");
/// let phase = image.states.phase();
/// assert!((phase.mid() - 0.5).abs() <= phase.rad() && phase.rad() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ImpactMap {
    shaken: Either,
}

/// A set of states just before an impact on one wall: a parallelogram, cut with a box.
///
/// Images are parallelograms, so that a set is followed through many impacts without being wrapped in boxes.
#[derive(Clone, Copy, Debug)]
pub struct States {
    wall: Wall,
    turns: i64,
    set: StateSet,
}

/// The image of a set under the impact map, or under an iterate of it.
#[derive(Clone, Copy, Debug)]
pub struct Image {
    /// Encloses the states just before the next impact.
    pub states: States,
    /// Encloses `[[du1/du0, du1/dv0], [dv1/du0, dv1/dv0]]` at every state of the set: **equation** (A.7), phases `u`, velocities `v`.
    pub jacobian: [[Ball; 2]; 2],
    /// The mapping of the last flight: P1-P4.
    pub mapping: Mapping,
}

impl ImpactMap {
    /// The impact map of a pair; parameters that are intervals are varied over all their values.
    ///
    /// # Errors
    /// If a parameter is beyond the range of exact expressions or doubles.
    pub fn new(pair: &ImpactPair) -> Result<Self, Error> {
        let clock = Clock::new(pair, &Exact::from(0), 0)?;
        Ok(Self { shaken: Either::new(pair, &clock)? })
    }

    /// Box of all states on a wall with these phases and velocities before the impact.
    ///
    /// # Errors
    /// If a phase lies outside `[-1, 1]`, or if a velocity is not towards the wall: at most 0 on the left, at least 0 on the right.
    pub fn states(&self, wall: Wall, phase: Ball, velocity: Ball) -> Result<States, Error> {
        // exact: it refuses what is not promised
        if !(0.0..=1.0).contains(&phase.mag()) {
            let accepted = "must lie in [-1, 1] forcing periods";
            return Err(Error::out_of_range(None, format!("phase is {phase:?}, but {accepted}")));
        }
        let inward = wall.inward(velocity);
        let arrives = inward.mid() <= -inward.rad() && velocity.mag() < f64::INFINITY;
        if !arrives {
            let accepted = "must be at most 0 on the left wall, at least 0 on the right wall";
            return Err(Error::out_of_range(None, format!("velocity is {velocity:?}, but {accepted}")));
        }
        let (whole, middle) = turns::carry(0.0, phase.mid());
        let phase = Ball::new(middle, phase.rad());
        // N1: -1, 0 or 1
        Ok(States { wall, turns: whole as i64, set: StateSet::new(phase, velocity, self.scale(velocity)) })
    }

    /// Encloses the states of a set just before the next impact, and the Jacobian over the set.
    ///
    /// # Undecided
    /// If not all flights of the set are proved to end on the same wall: the set is too wide, or a flight may graze or end in a rest.
    pub fn image(&self, states: &States) -> Answer<Image> {
        under!(&self.shaken, shaken => fly(&**shaken, states))
    }

    /// Encloses the image of a set under `count` mappings, at least one, and the product of their Jacobians.
    ///
    /// # Undecided
    /// If one of the images is undecided.
    pub fn iterate(&self, states: &States, count: usize) -> Answer<Image> {
        let mut image = self.image(states)?;
        for _ in 1..count {
            let next = self.image(&image.states)?;
            image = Image { jacobian: product(&next.jacobian, &image.jacobian), ..next };
        }
        Ok(image)
    }

    /// The unit of velocities in sets.
    fn scale(&self, velocity: Ball) -> f64 {
        use crate::shaken::Shaken;
        under!(&self.shaken, shaken => shaken.pair().scale(velocity))
    }
}

impl States {
    /// The wall.
    pub fn wall(&self) -> Wall {
        self.wall
    }

    /// Whole forcing periods that phases are counted from.
    pub fn turns(&self) -> i64 {
        self.turns
    }

    /// Encloses the phases less the whole forcing periods, in forcing periods.
    pub fn phase(&self) -> Ball {
        self.set.phase_ball()
    }

    /// Encloses the velocities before the impact, in gap widths per forcing period.
    pub fn velocity(&self) -> Ball {
        self.set.velocity_ball()
    }

    /// Encloses phase, in forcing periods, and speed of the states mirrored to the left wall.
    ///
    /// Under one harmonic, `y -> -y` half a forcing period later is a symmetry of the motion: an impact on the right wall is mirrored
    /// to one on the left wall half a forcing period earlier, and the impact map becomes one of phase and speed. Lemma R1
    pub fn mirrored(&self) -> [Ball; 2] {
        let half = if self.wall == Wall::Left { 0.0 } else { -0.5 };
        [self.phase() + Ball::exact(half), -self.wall.inward(self.velocity())]
    }
}

impl Image {
    /// Encloses the Jacobian with speeds, `|y'|`, for velocities, of a set that lay on this wall.
    pub fn jacobian_of_speeds(&self, from: Wall) -> [[Ball; 2]; 2] {
        let [[a, b], [c, d]] = self.jacobian;
        let (before, after) = (|x: Ball| -from.inward(x), |x: Ball| -self.states.wall.inward(x));
        [[a, before(b)], [after(c), after(before(d))]]
    }
}

/// Lemma S5
fn fly<S: Flying>(shaken: &S, states: &States) -> Answer<Image> {
    let States { wall, turns, set } = *states;
    let leaving = Leaving { wall, turns, phase: set.phase_ball(), before: set.velocity_ball(), is_release: false };
    let (contact, jacobian) = shaken.fly(leaving, None)?;
    let jacobian = jacobian.jacobian();
    let set = set.image(&contact, &jacobian);
    let (whole, phase) = turns::carry(contact.all.turns, set.phase);
    let turns = turns::after(turns, whole).ok_or_else(Undecided::endless)?;
    let states = States { wall: contact.all.wall, turns, set: set.at_phase(phase) };
    Ok(Image { states, jacobian, mapping: Mapping::between(wall, states.wall) })
}

fn product(after: &[[Ball; 2]; 2], before: &[[Ball; 2]; 2]) -> [[Ball; 2]; 2] {
    let entry = |i: usize, j: usize| after[i][0] * before[0][j] + after[i][1] * before[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}
