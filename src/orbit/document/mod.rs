//! The orbit JSON, and its events and outcome.

mod conclusion;
mod ending;
mod event;
#[cfg(test)]
mod tests;

use std::ops::ControlFlow;

use impact_pair_document::{
    ArithmeticDocument, ClaimName, EventDocument, ORBIT_SCHEMA, OrbitDocument, OrbitHead, PROGRAM, SceneDocument,
};

use super::{Arithmetic, Orbit, Progress};
use crate::watch::{Unwatched, Watch};
pub use conclusion::Conclusion;
pub use ending::{Advice, Ending};
pub use event::{Bounds, Event, Events};
use impact_pair_model::vocabulary::ArithmeticKind;

impl Orbit {
    /// Follows the orbit to its end, and returns it as a document.
    ///
    /// ```
    /// use impact_pair::{Scene, orbit::Orbit};
    /// use impact_pair_certificate::Certificate;
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
    ///     pair = { gap = 9.42497, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -12.56636 }
    ///     run = { impacts = 3 }"#)?;
    /// let orbit = Orbit::of(&scene, scene.settings())?.document();
    /// let claimed = Certificate::parse(&serde_json::to_string(&orbit)?)?;
    /// assert_eq!((claimed.events().len(), claimed.outcome().to_string().as_str()), (3, "impacts-reached"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn document(&mut self) -> OrbitDocument {
        self.document_within(&Unwatched, |_, _| ())
    }

    /// Follows the orbit until it ends or the watch stops it, and returns it as a document; `each` receives every event.
    pub fn document_within(&mut self, watch: &dyn Watch, mut each: impl FnMut(&Self, &Progress)) -> OrbitDocument {
        let mut events: Vec<Event> = Vec::new();
        let _ = self.follow(watch, |orbit, step| {
            each(orbit, &step);
            events.extend(Event::of(orbit, &step));
            ControlFlow::<()>::Continue(())
        });
        let outcome = Conclusion::of(self, events.last()).document();
        OrbitDocument::of(self.head(), events.iter().map(EventDocument::from).collect(), outcome)
    }

    /// Returns the head of the orbit JSON of an orbit that has ended: scene, program and arithmetic.
    pub fn head(&self) -> OrbitHead {
        self.head_of(self.computed())
    }

    /// Returns the head before the first impact: with the requested arithmetic, but that it is shadowed or not is known already.
    pub fn head_at_first(&self) -> OrbitHead {
        self.head_of(match self.arithmetic() {
            Arithmetic::Shadow => self.computed(),
            _ => ArithmeticDocument::requested(&self.requested.settings),
        })
    }

    fn head_of(&self, computed: ArithmeticDocument) -> OrbitHead {
        OrbitHead {
            schema: ORBIT_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            scene: SceneDocument::new(self.pair(), self.start()),
            certified: self.arithmetic().is_certified(),
            claim: if computed == ArithmeticDocument::shadow() { ClaimName::Shadowed } else { ClaimName::ExactStart },
            arithmetic: computed,
        }
    }

    /// Returns the arithmetic: `float`, `interval` or `inari` with 53 bits, `multiprecision` with those of its first impact, or `shadow`.
    pub fn computed(&self) -> ArithmeticDocument {
        let kind = match (self.arithmetic(), self.bits()) {
            (Arithmetic::Shadow, _) if self.shadow().is_some() => return ArithmeticDocument::shadow(),
            (Arithmetic::Float, _) => ArithmeticKind::Float,
            (Arithmetic::Inari, _) => ArithmeticKind::Inari,
            (_, f64::MANTISSA_DIGITS) => ArithmeticKind::Interval,
            _ => ArithmeticKind::Multiprecision,
        };
        ArithmeticDocument::computed(kind, self.bits())
    }
}
