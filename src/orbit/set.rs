//! Sets of states: a centre and a parallelogram around it, reorganised at each impact.
//!
//! The image of a set follows from that of its centre and the Jacobian over the set (Lemmas S1, S2 and S4 of `docs/proofs/sets.md#S1`).
//! With the rotation whose first axis is the longest image edge the parallelogram neither degenerates nor is wrapped in a box, so
//! contracting orbits go on for ever.
//!
//! Coordinates are (phase in forcing periods, velocity / scale), the scale a power of two near the velocities of the
//! orbit, so that a rotation mixes like with like.

use crate::contact::SetContact;
use crate::number::{Ball, TINY, UNIT, up};

/// The edges of an image are longer: so products with them, which may underflow, lose less than is added (Lemma S2).
pub(super) const SHORTEST_EDGE: f64 = f64::from_bits((1023 - 600) << 52);

/// The parallelogram of a set around its centre.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// The first axis: the first column of the rotation.
    pub(super) axis: (f64, f64),
    /// Half the edges along the axes.
    pub(super) edges: [f64; 2],
    /// The unit of velocities.
    pub(super) scale: f64,
}

/// The error of the image of a centre (Lemma S4).
#[derive(Clone, Copy, Debug)]
pub struct Noise {
    /// of the phase
    pub phase: f64,
    /// of the velocity at that phase
    pub velocity: f64,
    /// the acceleration on arrival
    pub slope: Ball,
}

impl Shape {
    /// Box of these radii; velocities are of the order of `scale`, a power of two.
    pub fn new(phase: f64, velocity: f64, scale: f64) -> Self {
        // Lemma B1: nothing is exactly nothing; any other quotient may underflow.
        let unscaled = if velocity == 0.0 { 0.0 } else { up(velocity / scale + TINY) };
        Self { axis: (1.0, 0.0), edges: [phase, unscaled], scale }
    }

    /// Bounds the distances of phases from the centre's.
    #[inline(always)]
    pub fn phase_radius(&self) -> f64 {
        let (c, s) = self.axis;
        up(c.abs() * self.edges[0] + s.abs() * self.edges[1])
    }

    /// Bounds the distances of velocities.
    #[inline(always)]
    pub fn velocity_radius(&self) -> f64 {
        let (c, s) = self.axis;
        up(self.scale * (s.abs() * self.edges[0] + c.abs() * self.edges[1]))
    }

    /// Image of the shape (Lemmas S1, S2, S4) for the Jacobian over the set.
    #[inline(always)]
    pub fn image(&self, jacobian: &[[Ball; 2]; 2], noise: &Noise) -> Self {
        let exact = Ball::exact;
        let (c, s) = self.axis;
        // Powers of two: exact unless they overflow, and then the balls are infinite.
        let (scale, unscale) = (exact(self.scale), exact(1.0 / self.scale));
        let [[a, b], [d, e]] = *jacobian;
        // Not by `map` of the array, which is not always inlined.
        let turned = |x: Ball, y: Ball| [x * exact(c) + y * exact(s), y * exact(c) - x * exact(s)];
        let columns = [turned(a, b * scale), turned(d * unscale, e)];
        let (p, q) = (noise.phase, up(noise.velocity * (1.0 / self.scale)));
        let shear = noise.slope * unscale;
        // The longest of both image edges and the error of the centre gives the first axis.
        let edge = |j: usize| (columns[0][j].mid() * self.edges[j], columns[1][j].mid() * self.edges[j]);
        let axis = direction([edge(0), edge(1), (p, p * shear.mid())]);
        let (c1, s1) = (exact(axis.0), exact(axis.1));
        // The transpose of the rotation is its inverse up to the factor 1/(c^2 + s^2), within 1 +- 8 UNIT.
        let reach = |edges: [Ball; 2], noise: [Ball; 2]| {
            let image = edges[0].mag() * self.edges[0] + edges[1].mag() * self.edges[1];
            up(image + noise[0].mag() * p + noise[1].mag() * q + SHORTEST_EDGE) * (1.0 + 16.0 * UNIT)
        };
        let along = [columns[0][0] * c1 + columns[1][0] * s1, columns[0][1] * c1 + columns[1][1] * s1];
        let across = [columns[1][0] * c1 - columns[0][0] * s1, columns[1][1] * c1 - columns[0][1] * s1];
        let edges = [reach(along, [c1 + s1 * shear, s1]), reach(across, [c1 * shear - s1, c1])];
        Self { axis, edges, scale: self.scale }
    }
}

/// All states within a parallelogram around a centre that also lie in a box around it.
///
/// The box is that of the contact's own enclosure: narrower where an error of the velocity would tilt into the phase.
#[derive(Clone, Copy, Debug)]
pub struct StateSet {
    /// Phase of the centre, in forcing periods.
    pub phase: f64,
    /// Velocity of the centre, before the impact, in gap widths per forcing period.
    pub velocity: f64,
    shape: Shape,
    /// The radii of the box, of phase and velocity.
    box_radii: (f64, f64),
}

impl StateSet {
    /// Box of all states within the radii of `phase` and `velocity`.
    pub fn new(phase: Ball, velocity: Ball, scale: f64) -> Self {
        Self {
            phase: phase.mid(),
            velocity: velocity.mid(),
            shape: Shape::new(phase.rad(), velocity.rad(), scale),
            box_radii: (phase.rad(), velocity.rad()),
        }
    }

    /// Encloses the phases of the set.
    #[inline(always)]
    pub fn phase_ball(&self) -> Ball {
        Ball::new(self.phase, self.shape.phase_radius().min(self.box_radii.0)) // S2: cut with the box of C3
    }

    /// Encloses the velocities of the set.
    #[inline(always)]
    pub fn velocity_ball(&self) -> Ball {
        Ball::new(self.velocity, self.shape.velocity_radius().min(self.box_radii.1)) // S2: cut with the box of C3
    }

    /// Image of the set: `centre` encloses the image of the centre, `jacobian` the Jacobian over the set.
    #[inline(always)]
    pub fn image(&self, centre: &SetContact, jacobian: &[[Ball; 2]; 2]) -> Self {
        debug_assert_eq!(centre.phase.mid(), centre.all.phase.mid(), "both enclosures have one middle");
        debug_assert_eq!(centre.velocity.mid(), centre.all.velocity.mid(), "both enclosures have one middle");
        let noise = Noise { phase: centre.phase.rad(), velocity: centre.velocity.rad(), slope: centre.slope };
        Self {
            phase: centre.phase.mid(),
            velocity: centre.velocity.mid(),
            shape: self.shape.image(jacobian, &noise),
            box_radii: (centre.all.phase.rad(), centre.all.velocity.rad()),
        }
    }

    /// The set with its phases counted from elsewhere: `phase` is the centre's, exactly.
    #[inline(always)]
    pub fn at_phase(&self, phase: f64) -> Self {
        Self { phase, ..*self }
    }
}

/// The direction of the longest of the vectors; the first axis when it has none that doubles can tell.
#[inline(always)]
fn direction(vectors: [(f64, f64); 3]) -> (f64, f64) {
    let square = |v: (f64, f64)| v.0.mul_add(v.0, v.1 * v.1);
    let longer = |a: (f64, f64), b: (f64, f64)| if square(a) >= square(b) { a } else { b };
    let longest = longer(longer(vectors[0], vectors[1]), vectors[2]);
    // Far from under- and overflow the rotation is orthonormal to a few units in the last place.
    if (1e-280..1e280).contains(&square(longest)) {
        let length = square(longest).sqrt();
        (longest.0 / length, longest.1 / length)
    } else {
        (1.0, 0.0)
    }
}
