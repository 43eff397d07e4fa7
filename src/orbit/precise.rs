//! One impact after another in multiprecision.
//!
//! The centre of the set is a pair of MPFR numbers and flies in balls; the set around it is the parallelogram of
//! [`super::set`], in units of a power of two, since a chaotic orbit of 10,000 impacts starts with one of `2^-5800`.
//! The Jacobian (A.7) multiplies these radii, so doubles do for it.

use rug::Float;

use super::motion::{Motion, scale};
use super::origin::{Location, Origin};
use super::plan::Plan;
use super::set::{Noise, SHORTEST_EDGE, Shape};
use crate::contact::multiprecision::{Doubles, Passed, Refined, Start, isolate_first, pass};
use crate::contact::{Contact, Margins, Undecided};
use crate::exact::{Enclosure, Exact};
use crate::flight::Flight;
use crate::mapping::{Passage, jacobian};
use crate::number::{ABOVE_TURN, Ball, LEAST_BITS, Magnitude, MpBall, Number};
use crate::pair::{Inward, Reduced, Wall};

/// Bits below the radius of a set that its centre is not worth.
const DROWNED: i64 = 64;

/// Certified in as many bits as the plan gives each impact.
#[derive(Debug)]
pub(super) struct PreciseMotion {
    /// In as many bits as the first impact gets.
    pair: Reduced<MpBall>,
    doubles: Doubles,
    plan: Plan,
    /// Impacts so far.
    index: u64,
    state: State,
}

#[derive(Debug)]
enum State {
    Wall { wall: Wall, set: PreciseSet, sin_cos: (MpBall, MpBall) },
    Inside { height: MpBall, phase: MpBall, velocity: MpBall },
}

/// A parallelogram of states around a centre.
#[derive(Debug)]
pub(super) struct PreciseSet {
    pub phase: Float,
    pub velocity: Float,
    /// In units of `2^unit`.
    pub shape: Shape,
    pub unit: i64,
}

impl PreciseSet {
    /// The box of all states within two balls.
    pub fn new(phase: &MpBall, velocity: &MpBall, scale: f64) -> Self {
        let unit = greatest_exponent(&[phase.rad(), velocity.rad()]);
        let shape = Shape::new(phase.rad().in_units_of(unit), velocity.rad().in_units_of(unit), scale);
        Self { phase: phase.mid().clone(), velocity: velocity.mid().clone(), shape, unit }
    }

    /// Encloses phases and velocities of the set.
    pub fn balls(&self) -> (MpBall, MpBall) {
        let (phase, velocity) = (self.shape.phase_radius(), self.shape.velocity_radius());
        let ball = |mid: &Float, rad| MpBall::new(mid.clone(), Magnitude::new(rad, self.unit));
        (ball(&self.phase, phase), ball(&self.velocity, velocity))
    }

    /// `log2` of the radii of phases and velocities.
    pub fn log2_radii(&self) -> (f64, f64) {
        let (phase, velocity) = self.balls();
        (phase.rad().log2(), velocity.rad().log2())
    }

    /// Phases and velocities as intervals.
    pub fn enclosures(&self) -> Option<(Enclosure, Enclosure)> {
        let (phase, velocity) = self.balls();
        Some((phase.enclosure()?, velocity.enclosure()?))
    }

    /// The image of the shape, in a unit that suits it and the noise of the centre.
    pub fn image(&self, jacobian: &[[Ball; 2]; 2], phase: Magnitude, velocity: Magnitude, slope: Ball) -> (Shape, i64) {
        let edges = self.shape.edges().map(|edge| Magnitude::new(edge, self.unit));
        let unit = greatest_exponent(&[edges[0], edges[1], phase, velocity]);
        let edges = edges.map(|edge| match edge.in_units_of(unit) {
            0.0 => 0.0,
            edge => edge.max(SHORTEST_EDGE), // M4: enlarges the set
        });
        let noise = Noise { phase: phase.in_units_of(unit), velocity: velocity.in_units_of(unit), slope };
        (self.shape.with_edges(edges).image(jacobian, &noise), unit)
    }
}

/// The exponent of the greatest of them, 0 when all are 0.
fn greatest_exponent(magnitudes: &[Magnitude]) -> i64 {
    magnitudes.iter().filter_map(|x| x.exponent()).max().unwrap_or(0) // M4: any unit will do for nothing
}

/// The bits planned for an impact, but none that the width of the set would drown by [`DROWNED`] bits.
pub(super) fn bits_for(plan: &Plan, set: &PreciseSet, index: u64) -> u32 {
    let planned = plan.bits(index);
    let (phase, velocity) = (set.shape.phase_radius(), set.shape.velocity_radius());
    let radius = Magnitude::new(phase.max(velocity / set.shape.scale()), set.unit); // proposes: bits to compute with
    match radius.exponent() {
        // proposes
        Some(exponent) => planned.min((DROWNED - exponent).clamp(i64::from(LEAST_BITS), i64::from(planned)) as u32),
        None => planned,
    }
}

/// What a step leads to.
struct Arrival {
    contact: Contact<Ball>,
    set: PreciseSet,
    sin_cos: (MpBall, MpBall),
}

impl PreciseMotion {
    pub fn new(exact: &Reduced<Exact>, pair: &Reduced<Ball>, origin: &Origin<Exact>, plan: Plan) -> Self {
        let bits = plan.bits(0);
        let enclose = |x: &Exact| MpBall::enclosing(&x.enclose(bits + 8), bits);
        let doubles = Doubles { pair: *pair, centre: pair.centre(), margins: Margins::new(pair) };
        let (phase, velocity) = (enclose(&origin.phase), enclose(&origin.velocity));
        let state = match &origin.place {
            Location::Wall(wall) => State::Wall {
                wall: *wall,
                set: PreciseSet::new(&phase, &velocity, scale(pair, velocity.to_ball())),
                sin_cos: MpBall::exact(phase.mid().clone()).sin_cos(),
            },
            Location::Inside(height) => State::Inside { height: enclose(height), phase, velocity },
        };
        Self { pair: exact.map(enclose), doubles, plan, index: 0, state }
    }

    /// From inside the gap: the enclosure of all first contacts is the new set.
    fn first(&self, height: &MpBall, phase: &MpBall, velocity: &MpBall) -> Result<Arrival, Undecided> {
        let (height, phase, velocity) = (height.clone(), phase.clone(), velocity.clone());
        let sin_cos = phase.sin_cos();
        let all = Flight::from_inside(&self.pair, height, phase.clone(), velocity.clone(), sin_cos);
        let start =
            Start { wall: None, height: all.height.to_ball(), phase: phase.to_ball(), velocity: velocity.to_ball() };
        let isolated = isolate_first(&self.doubles, &start, || all.clone(), &all.map(centre_of))?;
        let contact = isolated.contact(all.wall);
        let narrow = Undecided::precision(&contact);
        let refined = isolated.refine(&all, self.plan.bits(1)).ok_or(narrow)?;
        let Refined { at, error, velocity, sin_cos } = refined;
        // The velocity at each contact of the set: at most the error away from `at`.
        let velocity = all.wall.inward(velocity.widened(all.steepest() * error));
        let sin_cos = all.wall.mirror(sin_cos);
        let phase = MpBall::new(at, error);
        let set = PreciseSet::new(&phase, &velocity, scale(&self.doubles.pair, velocity.to_ball()));
        Ok(Arrival { contact, set, sin_cos })
    }

    /// From a wall: **equations** (15), (A.1)-(A.7) over the set.
    fn step(&self, wall: Wall, set: &PreciseSet, sin_cos: &(MpBall, MpBall)) -> Result<Arrival, Undecided> {
        let bits = bits_for(&self.plan, set, self.index);
        let pair = self.pair.map(|x| x.rounded(bits));
        let (phase, before) = set.balls();
        let doubles = &self.doubles;
        let (phase64, before64) = (phase.to_ball(), before.to_ball());
        let sin_cos = (sin_cos.0.rounded(bits), sin_cos.1.rounded(bits));
        let centre =
            launch(&pair, wall, MpBall::exact(set.phase.clone()), MpBall::exact(set.velocity.clone()), sin_cos.clone());
        let all = || launch_all(&pair, wall, set, &sin_cos);
        let start = Start {
            wall: Some(wall),
            height: Ball::exact(0.0),
            phase: phase64,
            velocity: wall.inward(doubles.pair.rebound_of(before64)),
        };
        let isolated = isolate_first(doubles, &start, all, &centre)?;
        let contact = isolated.contact(wall);
        let narrow = Undecided::precision(&contact);
        let next_bits = bits_for(&self.plan, set, self.index + 1);
        let Refined { at, error, velocity, sin_cos: arrival } = isolated.refine(&centre, next_bits).ok_or(narrow)?;
        let passage = Passage {
            time: contact.time,
            sin0: sin_cos.0.to_ball().widened(ABOVE_TURN * phase64.rad()),
            sin1: wall.inward(isolated.sin),
            velocity0: before64,
            velocity1: contact.velocity,
        };
        let wide = Undecided::width(&contact);
        let jacobian = jacobian(doubles.pair.beta, doubles.pair.restitution, &passage).ok_or(wide)?;
        // The acceleration between `at` and the contact.
        let sin1 = isolated.sin.widened(ABOVE_TURN * error.to_f64());
        let slope = wall.inward(doubles.pair.beta.turn() * doubles.pair.beta * sin1);
        let velocity = wall.inward(velocity).rounded(next_bits);
        let (shape, unit) = set.image(&jacobian, error, velocity.rad(), slope);
        let set = PreciseSet { phase: at, velocity: velocity.mid().clone(), shape, unit };
        Ok(Arrival { contact, set, sin_cos: wall.mirror(arrival) })
    }
}

/// The flight that starts with an impact on `wall`, `before` being the velocity before it.
fn launch(
    pair: &Reduced<MpBall>,
    wall: Wall,
    phase: MpBall,
    before: MpBall,
    sin_cos: (MpBall, MpBall),
) -> Flight<MpBall> {
    Flight::from_wall(pair, wall, phase, wall.inward(pair.rebound(before)), sin_cos)
}

/// The same for all the states of a set as one flight; sine and cosine are those of the centre.
fn launch_all(pair: &Reduced<MpBall>, wall: Wall, set: &PreciseSet, sin_cos: &(MpBall, MpBall)) -> Flight<MpBall> {
    let (phase, before) = set.balls();
    let turned = Magnitude::new(ABOVE_TURN, 0) * phase.rad();
    let sin_cos = (sin_cos.0.clone().widened(turned), sin_cos.1.clone().widened(turned));
    launch(pair, wall, phase, before, sin_cos)
}

impl Motion for PreciseMotion {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let Arrival { contact, mut set, sin_cos } = match &self.state {
            State::Wall { wall, set, sin_cos } => self.step(*wall, set, sin_cos)?,
            State::Inside { height, phase, velocity } => self.first(height, phase, velocity)?,
        };
        // Into [-1/2, 1/2], exactly (Sterbenz).
        let whole = set.phase.clone().round().to_f64(); // exact: within a few turns
        set.phase -= whole;
        let (phase, velocity) = set.balls();
        self.index += 1;
        self.state = State::Wall { wall: contact.wall, set, sin_cos };
        Ok(Contact { turns: contact.turns + whole, phase: phase.to_ball(), velocity: velocity.to_ball(), ..contact })
    }

    fn bits(&self) -> u32 {
        self.plan.bits(0)
    }

    fn pass_graze(&mut self) -> Option<Passed> {
        let passed = pass(&match &self.state {
            State::Wall { wall, set, sin_cos } => launch_all(&self.pair, *wall, set, sin_cos),
            State::Inside { height, phase, velocity } => {
                let (height, phase, velocity) = (height.clone(), phase.clone(), velocity.clone());
                let sin_cos = phase.sin_cos();
                Flight::from_inside(&self.pair, height, phase, velocity, sin_cos)
            }
        })?;
        let (height, velocity) = (passed.height.clone(), passed.velocity.clone());
        self.state = State::Inside { height, phase: MpBall::exact(passed.phase.clone()), velocity };
        Some(passed)
    }

    fn plan(&self) -> Option<&Plan> {
        Some(&self.plan)
    }

    fn accuracy(&self) -> f64 {
        let (a, b) = match &self.state {
            State::Wall { set, .. } => set.log2_radii(),
            State::Inside { phase, height, .. } => (phase.rad().log2(), height.rad().log2()),
        };
        -a.max(b) // proposes: bits to raise by
    }

    fn radii(&self) -> Option<(f64, f64)> {
        match &self.state {
            State::Wall { set, .. } => Some(set.log2_radii()),
            State::Inside { .. } => None,
        }
    }

    fn enclosures(&self) -> Option<(Enclosure, Enclosure)> {
        match &self.state {
            State::Wall { set, .. } => set.enclosures(),
            State::Inside { .. } => None,
        }
    }
}

fn centre_of(x: &MpBall) -> MpBall {
    MpBall::exact(x.mid().clone())
}
