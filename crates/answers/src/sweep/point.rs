//! One point of a sweep: an orbit, followed past a transient, and its certified results.

use std::ops::ControlFlow;

use impact_pair::json::SweepImpact;

use impact_pair::Error;
use impact_pair::Scene;
use impact_pair::exact::Enclosure;
use impact_pair::lyapunov::{Disturbance, Exponent, Passed};
use impact_pair::number::Ball;
use impact_pair::orbit::{Arithmetic, Conclusion, Event, Lasting, Orbit, Outcome, Reference, Settings, Shadowing};
use impact_pair::watch::Watch;

use super::attraction::{Attraction, attraction};
use super::window::Window;

/// Greatest number of impacts at a point.
pub const MOST_IMPACTS: u64 = 1_000_000_000;

/// The settings of each point.
#[derive(Clone, Debug)]
pub struct PointSettings {
    /// Impacts that are certified first and not listed.
    pub transient: u64,
    /// Number of impacts after the transient.
    pub impacts: u64,
    /// True if the impacts are not listed, only their summary.
    pub summary: bool,
    /// Number, from 0, of the term whose cycles are the unit, from [`Grid::reference`](crate::grid::Grid::reference); `None` for the fastest term that
    /// moves the box.
    pub reference: Option<usize>,
    /// Digits and arithmetic; the orbit stops after the sum of `transient` and `impacts`.
    pub settings: Settings,
}

/// The certified results of a point.
#[derive(Clone, Debug)]
pub struct Point {
    /// The impacts after the transient; none in a summary.
    pub states: Vec<SweepImpact<Enclosure>>,
    /// Number of certified impacts, those of the transient included.
    pub impacts: u64,
    /// Impacts per forcing period after the transient, an infinite ball where a chatter has infinitely many; `None` without two of them.
    pub impacts_per_cycle: Option<Ball>,
    /// The growth rate of a small disturbance after the transient.
    pub exponent: Exponent,
    /// The periodic orbit that the orbit is proved to converge to, if any.
    pub attraction: Option<Attraction>,
    /// Period of `attraction`, or of the exact repetition.
    pub lasting: Option<Lasting>,
    /// The outcome of the orbit.
    pub outcome: Outcome,
    /// The outcome in words.
    pub conclusion: Conclusion,
    /// The start that has the orbit, if it is not the exact one.
    pub shadow: Option<Shadowing>,
    /// First impact that is wider than requested.
    pub first_wide: Option<u64>,
    /// Greatest number of bits that an impact took.
    pub bits: u32,
}

impl Point {
    /// Whether everything requested is certified.
    fn is_complete(&self) -> bool {
        self.first_wide.is_none() && !matches!(self.outcome, Outcome::Undecided { .. })
    }
}

/// Follows the orbit of a scene to its end; `None` if the watch stops it before.
///
/// In [`Arithmetic::Shadow`], a point is shadowed only if doubles do not certify the digits from the exact start. If shadowing fails as well,
/// [`Arithmetic::Auto`] takes over.
///
/// # Errors
/// If a value is beyond the range of double-precision flights.
pub fn follow(scene: &Scene, requested: &PointSettings, watch: &dyn Watch) -> Result<Option<Point>, Error> {
    if requested.settings.arithmetic != Arithmetic::Shadow {
        return follow_in(requested.settings.arithmetic, scene, requested, watch);
    }
    for arithmetic in [Arithmetic::Interval, Arithmetic::Shadow] {
        match follow_in(arithmetic, scene, requested, watch)? {
            Some(point) if !point.is_complete() => {}
            done => return Ok(done),
        }
    }
    follow_in(Arithmetic::Auto, scene, requested, watch)
}

/// Follows the orbit of a scene in one arithmetic.
fn follow_in(
    arithmetic: Arithmetic,
    scene: &Scene,
    requested: &PointSettings,
    watch: &dyn Watch,
) -> Result<Option<Point>, Error> {
    let impacts = Some(requested.transient.saturating_add(requested.impacts));
    let settings = Settings { impacts, until: None, arithmetic, attractor: true, ..requested.settings.clone() };
    let mut orbit = Orbit::of(scene, settings)?;
    let unit = Reference::of(scene.pair(), requested.reference)?;
    let mut window = Window::new(&orbit, (requested.transient, requested.summary), &unit);
    let mut last = None;
    let _ = orbit.follow(watch, |orbit, event| {
        window.follow(orbit, &event);
        last = Some(event);
        ControlFlow::<()>::Continue(())
    });
    let Some(outcome) = orbit.outcome().cloned() else { return Ok(None) };
    let last = last.and_then(|event| Event::of(&orbit, &event));
    let exponent =
        window.disturbance.as_ref().map_or_else(|| Disturbance::of(&orbit).exponent(), Disturbance::exponent);
    let passed = window.disturbance.as_ref().map_or_else(Passed::default, Disturbance::passed); // exact: none has begun
    let (attraction, cycles) = match &outcome {
        Outcome::Attracted(attractor) => {
            (Some(attraction(&orbit, attractor, &unit, passed)), Some(attractor.cycles.into()))
        }
        Outcome::Periodic(period) => (None, Some(period.cycles)),
        _ => (None, None),
    };
    Ok(Some(Point {
        lasting: cycles.map(|cycles| unit.lasting(cycles)),
        impacts: window.listed,
        impacts_per_cycle: window.impacts_per_cycle(&orbit),
        exponent,
        states: window.states,
        attraction,
        conclusion: Conclusion::of(&orbit, last.as_ref()),
        outcome,
        shadow: orbit.shadow(),
        first_wide: orbit.first_wide(),
        bits: orbit.bits(),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{scene, scene_of};
    use crate::sweep::document::record;
    use crate::tolerances::TRANSIENT;
    use approx::assert_abs_diff_eq;
    use impact_pair::pair::Wall;
    use impact_pair::scene::Key;
    use impact_pair::watch::{Stage, Unwatched};

    fn point(scene: &Scene, transient: u64, impacts: u64) -> Point {
        let requested = PointSettings {
            transient,
            impacts,
            summary: false,
            reference: None,
            settings: Settings { digits: 6, ..Settings::default() },
        };
        follow(scene, &requested, &Unwatched).unwrap().unwrap()
    }

    #[test]
    fn a_summary_lacks_the_impacts_and_nothing_else() {
        for name in ["figure-12", "chatter"] {
            let (scene, values) = (scene(name), [(Key::StartPhase, "0".parse().unwrap())]);
            let line = |summary| {
                let settings = Settings { digits: 6, ..Settings::default() };
                let requested = PointSettings { transient: 5, impacts: 40, summary, reference: None, settings };
                record(0, &values, &follow(&scene, &requested, &Unwatched).unwrap().unwrap())
            };
            let (short, mut full) = (line(true), line(false));
            assert_eq!((short.states.len(), full.states.len()), (0, 40));
            full.states.clear();
            assert_eq!(serde_json::to_string(&short).unwrap(), serde_json::to_string(&full).unwrap());
        }
    }

    #[test]
    fn an_attracting_orbit_is_given_from_the_left_wall() {
        let point = point(&scene("figure-12"), 100, 10);
        let attraction = point.attraction.unwrap();
        assert_eq!((attraction.word.to_string().as_str(), point.lasting.unwrap().cycles), ("P1 P2", Some(1)));
        let first = attraction.first.unwrap();
        assert_eq!(first.wall, Wall::Left);
        // The message names the same word, wherever the last impact is.
        for impacts in [10, 11] {
            let record = record(0, &[], &self::point(&scene("figure-12"), 100, impacts));
            assert!(record.message.contains("(P1 P2)") && record.period.unwrap().word.unwrap() == "P1 P2");
        }
        assert_eq!(point.states.iter().map(|state| state.index).collect::<Vec<_>>(), (101..=110).collect::<Vec<_>>());
        // The rest of the transient is 0.26^50: the first impact on the left is the attractor's.
        let left = point.states.iter().find(|state| state.wall == Wall::Left).unwrap();
        assert_abs_diff_eq!(left.velocity, first.velocity, epsilon = TRANSIENT);
        let rate = point.impacts_per_cycle.unwrap();
        assert_abs_diff_eq!(rate.mid(), 2.0, epsilon = TRANSIENT + rate.rad());
        // Of the two eigenvalues 0.25764 is the larger: its logarithm for two impacts.
        let Exponent::Finite { per_cycle, .. } = point.exponent else { panic!("an exponent") };
        assert!((per_cycle.mid() - 0.25764f64.ln()).abs() < 0.5, "{per_cycle:?}");
        let [low, high] = attraction.limit.unwrap().map(|end| 2.0 * end);
        assert!(high - low < 1e-10 && (low - 0.25764f64.ln()).abs() < 1e-4, "{low} {high}");
    }

    /// A rest before the first impact: the exponent over all impacts is minus infinity however many there are; that after the transient is not.
    #[test]
    fn r44_the_limit_of_an_exponent_is_that_of_the_impacts_after_the_transient() {
        let start = "time = 1.5, wall = \"left\", velocity = 0";
        let rests = scene_of("amplitude = 1, frequency = \"pi\", phase = 0", "gap = 3, restitution = 0.5", start);
        let lowest = |transient: u64| point(&rests, transient, 40).attraction.unwrap().limit.unwrap()[0];
        assert!(lowest(0) == f64::NEG_INFINITY && lowest(1).is_finite());
    }

    #[test]
    fn mirror_images_are_two_attractors_of_one_word() {
        // A = 0.36 is beyond the pitchfork at 0.3458...: two orbits RL exist, mirror images of each other.
        let scene = scene("cascade");
        let from = |phase: &str| {
            let varied = scene.with(&[(Key::StartPhase, phase.parse().unwrap())]).unwrap();
            let point = point(&varied, 600, 4);
            // There are others as well.
            point.attraction.filter(|_| point.lasting.is_some_and(|lasting| lasting.cycles == Some(1)))
        };
        let phases = ["0", "1", "2", "3", "4", "5", "6"];
        let found: Vec<_> = phases.iter().filter_map(|phase| from(phase)).collect();
        let phase = |attraction: &Attraction| attraction.first.as_ref().unwrap().phase.mid_rad().0;
        assert!(found.len() > 3 && found.iter().all(|one| one.word == found[0].word));
        let (low, high) = found.iter().map(phase).fold((9f64, 0f64), |(a, b), x| (a.min(x), b.max(x)));
        assert!(high - low > 0.1 && found.iter().map(phase).all(|x| x - low < 1e-4 || high - x < 1e-4));
    }

    /// Of the diagram's chaotic points one true orbit is listed; its exponent is near that of floating point (0.399 per impact).
    #[test]
    fn chaotic_points_alone_are_shadowed() {
        let follow = |name: &str, impacts: u64| {
            let settings = Settings { arithmetic: Arithmetic::Shadow, digits: 6, ..Settings::default() };
            follow(
                &scene(name),
                &PointSettings { transient: 500, impacts, summary: false, reference: None, settings },
                &Unwatched,
            )
            .unwrap()
            .unwrap()
        };
        let chaos = follow("figure-14", 20_000);
        assert!(chaos.shadow.is_some() && chaos.is_complete() && chaos.states.len() == 20_000);
        let Exponent::Finite { per_impact, .. } = chaos.exponent else { panic!("an exponent: {:?}", chaos.exponent) };
        assert!((per_impact.mid() - 0.399).abs() < 0.01 && per_impact.rad() < 1e-9, "{per_impact:?}");
        for name in ["figure-12", "chatter", "cascade"] {
            let point = follow(name, 300);
            assert!(point.shadow.is_none() && point.is_complete(), "{name}");
        }
    }

    #[test]
    fn rests_grazes_and_ends_keep_the_certified_impacts() {
        let chatter = point(&scene("chatter"), 5, 60);
        assert!(matches!(chatter.outcome, Outcome::Periodic(_)) && chatter.exponent == Exponent::Forgets);
        assert_eq!(chatter.impacts_per_cycle.map(Ball::mid), Some(f64::INFINITY));
        assert_eq!(chatter.states.len(), 60);
        let settings = Settings { arithmetic: Arithmetic::Interval, ..Settings::default() };
        let requested = PointSettings { transient: 20, impacts: 500, summary: false, reference: None, settings };
        let chaos = follow(&scene("figure-14"), &requested, &Unwatched).unwrap().unwrap();
        assert!(matches!(chaos.outcome, Outcome::Undecided { .. }) && chaos.states.len() > 20);
        assert_eq!(chaos.states.len() as u64 + 20, chaos.impacts);
        assert!(follow(&scene("figure-14"), &requested, &|_: Stage<'_>| ControlFlow::Break(())).unwrap().is_none());
    }
}
