//! The orbit JSON.

use std::ops::ControlFlow;

use impact_pair_document::{
    ArithmeticDocument, ClaimName, EventDocument, ORBIT_SCHEMA, OrbitDocument, OrbitHead, PROGRAM, SceneDocument,
};

use super::{Conclusion, Event};
use crate::orbit::{Arithmetic, Orbit, Progress, Settings, Start};
use crate::watch::{Unwatched, Watch};
use crate::{Error, ImpactPair};

/// Returns the orbit of `pair` from `start`, followed to its end, as a document.
///
/// # Errors
/// As [`Orbit::new`].
///
/// ```
/// use impact_pair::{Scene, document};
/// use impact_pair_certificate::Certificate;
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
///     run = { impacts = 3 }"#)?;
/// let orbit = document::orbit(scene.pair(), scene.start(), scene.settings())?;
/// let claimed = Certificate::parse(&serde_json::to_string(&orbit)?)?;
/// assert_eq!((claimed.events().len(), claimed.outcome()), (3, "impacts-reached"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn orbit(pair: &ImpactPair, start: &Start, settings: Settings) -> Result<OrbitDocument, Error> {
    Ok(follow(&mut Orbit::new(pair, start, settings)?, &Unwatched, |_, _| ()))
}

/// Follows an orbit, until it ends or the watch stops it, and returns it as a document; `each` receives every event.
pub fn follow(orbit: &mut Orbit, watch: &dyn Watch, mut each: impl FnMut(&Orbit, &Progress)) -> OrbitDocument {
    let mut events: Vec<Event> = Vec::new();
    let _ = orbit.follow(watch, |orbit, step| {
        each(orbit, &step);
        events.extend(Event::of(orbit, &step));
        ControlFlow::<()>::Continue(())
    });
    OrbitDocument {
        head: head(orbit.pair(), orbit.start(), orbit.arithmetic(), arithmetic(orbit)),
        outcome: Conclusion::of(orbit, events.last()).document(),
        events: events.iter().map(EventDocument::from).collect(),
    }
}

/// Returns the head of the orbit JSON: scene, program and arithmetic.
///
/// `computed` is the result of [`arithmetic`] when the orbit has ended, or of [`arithmetic_at_first`] before.
pub fn head(pair: &ImpactPair, start: &Start, arithmetic: Arithmetic, computed: ArithmeticDocument) -> OrbitHead {
    OrbitHead {
        schema: ORBIT_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        scene: SceneDocument::new(pair, start),
        certified: is_certified(arithmetic),
        claim: if computed == ArithmeticDocument::shadow() { ClaimName::Shadowed } else { ClaimName::ExactStart },
        arithmetic: computed,
    }
}

/// Returns the arithmetic of an orbit: `float`, `interval` or `inari` with 53 bits, `multiprecision` with those of its first impact, or `shadow`.
pub fn arithmetic(orbit: &Orbit) -> ArithmeticDocument {
    let kind = match (orbit.arithmetic(), orbit.bits()) {
        (Arithmetic::Shadow, _) if orbit.shadow().is_some() => return ArithmeticDocument::shadow(),
        (Arithmetic::Float, _) => "float",
        (Arithmetic::Inari, _) => "inari",
        (_, f64::MANTISSA_DIGITS) => "interval",
        _ => "multiprecision",
    };
    ArithmeticDocument::computed(kind, orbit.bits())
}

/// Returns the arithmetic of an orbit before its first impact: the requested one, but that it is shadowed or not is known already.
pub fn arithmetic_at_first(orbit: &Orbit, settings: &Settings) -> ArithmeticDocument {
    match settings.arithmetic {
        Arithmetic::Shadow => arithmetic(orbit),
        _ => ArithmeticDocument::requested(settings),
    }
}

/// Returns whether the arithmetic is rigorous.
pub fn is_certified(arithmetic: Arithmetic) -> bool {
    match arithmetic {
        Arithmetic::Float => false,
        Arithmetic::Auto | Arithmetic::Interval | Arithmetic::Inari | Arithmetic::Shadow | Arithmetic::Bits(_) => true,
    }
}
