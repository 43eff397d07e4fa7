//! Tolerances of the tests, all in one place: the least that each comparison needs, and why it needs that much.
//!
//! Two enclosures are compared by all their members, two doubles as they are. No certified result has a tolerance.

#![allow(dead_code, reason = "each test takes its own")]

/// Zeros that floats find for a proof to start from.
pub const FLOATING_POINT_ZERO: f64 = 1e-8;
/// Double-precision sums of sines against the standard library's, in parts of one and the value.
pub const WAVES: f64 = 1e-13;
/// Short hops against long ones, whose heights cancel: in balls, and in doubles down to a thousandth of a forcing period.
pub const HOP_OF_BALLS: f64 = 1e-12;
pub const HOP_OF_DOUBLES: f64 = 1e-11;
/// A series of an invariant manifold against the map: rounding of both.
pub const SERIES_OF_MANIFOLDS: f64 = 1e-13;
/// Central differences with steps of 1e-6: of long formulas with large third derivatives, and of short ones.
pub const DIFFERENCE: f64 = 1e-4;
pub const DIFFERENCE_OF_JETS: f64 = 1e-7;
/// The rest of a transient of 100 impacts, and that of the number of impacts per forcing period.
pub const TRANSIENT: f64 = 1e-5;
/// Finite-time exponents a cycle and an impact, computed from one logarithm.
pub const EXPONENT: f64 = 1e-12;
/// Norms by doubles: of two matrices, of products of some, of differences of runs, of a thousand factors.
pub const NORM: f64 = 1e-14;
pub const NORM_OF_PRODUCT: f64 = 1e-12;
pub const NORM_OF_DIFFERENCES: f64 = 1e-11;
pub const NORM_OF_THOUSAND_FACTORS: f64 = 1e-9;
/// Traces of proved orbits, from the middles of enclosures that differ in width; relative to those above 1.
pub const TRACE: f64 = 1e-6;
/// Eigenvalues that were printed to five, and to seven digits.
pub const EIGENVALUE: f64 = 1e-5;
pub const EIGENVALUE_7: f64 = 1e-7;
/// Phases of an orbit found again, far away in time.
pub const PHASE: f64 = 1e-9;
/// Bifurcations: a quotient told to eight digits; the closed form at an enclosure's middle.
pub const QUOTIENT: f64 = 1e-6;
pub const CLOSED_FORM: f64 = 1e-12;
/// Drawn numbers in doubles: phases of crossings after up to 40 impacts, places on a curve, ends of an axis.
pub const DRAWN_PHASE: f64 = 1e-6;
pub const DRAWN: f64 = 1e-9;
pub const DRAWN_END: f64 = 1e-12;
/// The error that an audit tells, to the digits that the list has.
pub const AUDITED: f64 = 1e-13;
