//! Verified numerics for the horizontal impact pair: a ball between the two walls of an excited box.
//!
//! R. P. S. Han, A. C. J. Luo and W. Deng, *Chaotic motion of a horizontal impact pair*, Journal of Sound and
//! Vibration 181(2), 231-250 (1995), is read here with proofs: every impact of the mappings P1-P4 is enclosed in an
//! interval that provably holds it, none is missed, none is invented. What is undecided in the arithmetic chosen
//! is [`Undecided`](contact::Undecided), with its reason.
//!
//! # The paper, equation by equation
//!
//! | equation | what | item |
//! |---|---|---|
//! | (1), (9) | displacement of the box, one harmonic or several | [`Excitation`], [`Harmonic`], [`excitation::displacement_velocity_acceleration`] |
//! | fig. 1, (14) | gap, walls | [`ImpactPair`], [`pair::Wall`] |
//! | (10)-(13) | motion between impacts | [`flight::Flight`] |
//! | (10)-(13), figs 12-17 | motion between impacts, for figures | [`orbit::CoursePoint`], [`orbit::Orbit::course_point`] |
//! | (11), (12) | the motion at any time; the next impacts of many states | [`orbit::Dense`], [`orbit::Arrivals`] |
//! | (15) | Newton's impact law | [`pair::rebound`] |
//! | (14), (A.2), (A.4), (A.6) | the first contact, certified; with the feature `inari` by the textbook method | [`contact::first_contact`], `contact::textbook::first_contact` |
//! | (16), (17), (A.1), (A.3), (A.5) | chains of impacts | [`orbit::Orbit`] |
//! | (18)-(23) | switch-planes, in three coordinates | [`switch_plane::SwitchPoint`], [`orbit::Orbit::switch_point`] |
//! | (24)-(27) | mappings P1-P4 | [`mapping::Mapping`] |
//! | (28), (29), (33), (52), (55) | models: words of mappings | [`mapping::Word`] |
//! | (24)-(27), (A.7) | the impact map over sets of states, with its Jacobian | [`impact_map::ImpactMap`] |
//! | (A.7) | Jacobian of a mapping | [`mapping::jacobian`] |
//! | (56)-(73), figs 10, 11 | two impacts in N cycles: closed forms, all others, first contacts, stability, parameter manifolds | [`two_impact`] |
//! | (28)-(37), (52)-(56) | periodic orbits of any word, proved; all of them | [`periodic::Problem`], [`periodic::Chain`] |
//! | (38)-(40) | eigenvalues, stability; fold and pitchfork of two-impact motions | [`periodic::eigenvalues`], [`periodic::Stability`], [`two_impact::Mark`] |
//! | beyond the paper | chatter, rest and release; grazes; exact recurrence | [`orbit::Progress`], [`orbit::Outcome`] |
//! | beyond the paper | finite-time Lyapunov exponents with proved bounds; sweeps over parameters and initial data are in `impact-pair-answers` | [`lyapunov`] |
//! | beyond the paper | homoclinic tangencies of the equispaced motion (66), (67) | [`tangency`] |
//! | beyond the paper | where every motion goes; atlases over the plane of two parameters are in `impact-pair-answers` | [`chaos::Global`] |
//! | beyond the paper | true orbits near chaotic ones, however long: shadowing | [`covering::Shadow`] |
//! | beyond the paper | as many digits as requested | [`orbit::Arithmetic`], `number::MpBall`, `orbit::Plan` |
//! | beyond the paper | with the feature `inari`: intervals of that package, IEEE 1788 | `number::inari`, `orbit::Orbit::intervals` |
//! | figs 12-17 | scene files | [`scene::Scene`], `scenes/` |
//!
//! # Modules, in reading order
//!
//! Data flows one way: scene, exact parameters, balls, flight, contact, orbit, certificate. The lemmas that the code
//! rests on are in `docs/proofs`, with the labels that the comments use.
//!
//! # Conventions
//!
//! Internally, time is in forcing periods (`W t + tau = 2 pi u`), length in gap widths, velocity in gap widths per forcing period; then
//! only `A/d` and `e` are left. Velocities carry their sign and are those *before* an impact unless the name says
//! `after`. In an enclosure the true value lies within the radius of a [`number::Ball`], or between the bounds of an
//! [`exact::Enclosure`].
//!
//! # Example
//!
//! ```
//! use impact_pair::orbit::{Orbit, Outcome, Settings};
//! use impact_pair::scene::Scene;
//!
//! let scene = Scene::parse(r#"
//!     [excitation]
//!     amplitude = 1
//!     frequency = "pi"
//!     phase = 0
//!     [pair]
//!     gap = "3*pi"
//!     restitution = 0.5
//!     [start]
//!     time = 0
//!     wall = "left"
//!     velocity = "-4*pi"
//! "#)?;
//! let mut orbit = Orbit::new(scene.pair(), scene.start(), Settings::default())?;
//! let first = orbit.next().expect("an impact");
//! let (time, velocity) = orbit.bounds(&first);
//! // The exact orbit of eqs (66)-(69): on the right wall at t = 1 with v = 4 pi.
//! let (low, high) = time.to_f64_bounds();
//! assert!(low <= 1.0 && 1.0 <= high && high - low < 1e-14);
//! let (low, high) = velocity.to_f64_bounds();
//! assert!(low < 12.5663706143592 && 12.5663706143591 < high);
//! # Ok::<(), impact_pair::Error>(())
//! ```

pub mod audit;
pub mod chaos;
pub mod clock;
pub mod contact;
pub mod covering;
pub mod excitation;
pub mod flight;
pub mod impact;
pub mod impact_map;
pub mod lyapunov;
pub mod mapping;
pub mod number;
pub mod orbit;
pub mod pair;
pub mod periodic;
mod rest;
pub mod scales;
mod several;
mod shaken;
pub mod switch_plane;
pub mod tangency;
#[cfg(test)]
mod tests;
mod threads;
#[cfg(test)]
#[path = "../tests/tolerances/mod.rs"]
mod tolerances;
pub mod turns;
pub mod two_impact;
pub mod units;

#[doc(inline)]
pub use impact_pair_document as json;
#[doc(inline)]
pub use impact_pair_exact as exact;
#[doc(inline)]
pub use impact_pair_model::scene;
#[doc(inline)]
pub use impact_pair_model::watch;
pub use impact_pair_model::{Effort, Error, ErrorKind, Excitation, Harmonic, ImpactPair, Scene};
/// The package inari, in the version that this crate computes with; in a build with the feature `inari`.
#[cfg(all(feature = "inari", target_feature = "fma"))]
pub use inari;

/// The examples of the README and of the manual are tests as well.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
#[cfg(doctest)]
#[doc = include_str!("../docs/howto/programs.md")]
struct Programs;
