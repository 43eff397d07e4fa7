//! The asymptotic behaviour of the motion of a scene: [`describe`].
//!
//! Questions are examined in the order of their cost, and only as far as the answer requires: the certified orbit and its outcome; a
//! trapping region, where that leaves the fate undecided; a horseshoe, where the motion stays in the region.

mod document;
mod lines;
mod orbit;
mod question;
#[cfg(test)]
mod tests;
mod verb;

use impact_pair::chaos::{Chaos, HorseshoeSettings, Trap};
use impact_pair::watch::{Latched, Watch};
use impact_pair::{Effort, Error, Scene};
pub use lines::lines;
use orbit::Followed;
pub use verb::{DescribeOptions, Described};

/// The statements proved about the motion from the start of a scene.
///
/// **Enclosure**: every statement holds for all values of the scene's data. A fate is claimed where the orbit's outcome proves it, or
/// where one of its impacts lies in a trapping region. Lemmas Q3, D4, D5
#[derive(Debug)]
pub struct Description {
    request: DescribeOptions,
    /// The reason why no convergence to a periodic orbit can be proved, if there is one.
    is_unattracted: Option<&'static str>,
    orbit: Followed,
    region: Region,
    horseshoe: Horseshoe,
    is_interrupted: bool,
}

/// The result of the search for a trapping region.
#[derive(Debug)]
enum Region {
    Proved(Trap),
    /// None is proved, for this reason.
    Unproved(String),
    /// The region was not looked for, for this reason.
    NotExamined(String),
}

/// The result of the search for a horseshoe.
#[derive(Debug)]
enum Horseshoe {
    /// Chaos with the horseshoe's words, which may prove no entropy.
    Searched(Box<Chaos>),
    /// The horseshoe was not looked for, for this reason.
    NotExamined(String),
}

/// Describes the motion from the start of a scene, until the watch stops it; what is proved so far is kept.
///
/// **Cost**: milliseconds where the orbit's outcome decides the fate; up to half a minute for a horseshoe.
///
/// # Errors
/// If a value of the scene is beyond the range of flights.
///
/// ```
/// use impact_pair::Scene;
/// use impact_pair_answers::DescribeOptions;
/// use impact_pair_answers::describe::describe;
/// use impact_pair::json::FateName;
/// use impact_pair::watch::Unwatched;
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
///     pair = { gap = "3*pi", restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12 }
/// "#)?;
/// let found = describe(&scene, &DescribeOptions::default(), &Unwatched)?;
/// let document = found.document(&scene, "scene.toml")?;
/// assert_eq!(document.fate.kind, FateName::Attracted);
/// assert_eq!(document.fate.word.as_deref(), Some("P1 P2"));
/// # Ok::<(), impact_pair::Error>(())
/// ```
pub fn describe(scene: &Scene, request: &DescribeOptions, watch: &dyn Watch) -> Result<Description, Error> {
    let watch = Latched::new(watch);
    let orbit = orbit::followed(scene, request, &watch)?;
    let region = region(scene, &orbit, &watch);
    let horseshoe = horseshoe(scene, request, &region, &watch);
    let is_unattracted = question::is_unattracted(scene)?;
    Ok(Description { request: *request, is_unattracted, orbit, region, horseshoe, is_interrupted: watch.is_stopped() })
}

impl Description {
    /// The trapping region, if one is proved.
    pub fn region(&self) -> Option<&Trap> {
        match &self.region {
            Region::Proved(trap) => Some(trap),
            Region::Unproved(_) | Region::NotExamined(_) => None,
        }
    }

    /// The horseshoe, if a positive lower bound of the entropy is proved.
    pub fn horseshoe(&self) -> Option<&Chaos> {
        match &self.horseshoe {
            Horseshoe::Searched(chaos) if chaos.entropy() > 0.0 => Some(chaos),
            Horseshoe::Searched(_) | Horseshoe::NotExamined(_) => None,
        }
    }
}

const DECIDED_BY_OUTCOME: &str = "the outcome of the orbit decides the fate";
const STOPPED: &str = "interrupted";

/// The trapping region around what attracts the motion, where the orbit's outcome leaves the fate undecided.
fn region(scene: &Scene, orbit: &Followed, watch: &Latched<'_>) -> Region {
    let skipped = [(orbit.decides().is_some(), DECIDED_BY_OUTCOME), (watch.is_stopped(), STOPPED)];
    if let Some((_, why)) = skipped.iter().find(|(is_so, _)| *is_so) {
        return Region::NotExamined((*why).to_owned());
    }
    match Trap::of(scene, Effort::default(), watch) {
        Ok(Ok(trap)) => Region::Proved(trap),
        Ok(Err(why)) => Region::Unproved(why.words().to_owned()),
        // Several harmonics, or no excitation: the reduced impact map does not exist.
        Err(error) => Region::NotExamined(error.to_string()),
    }
}

/// The horseshoe of the impact map, where the motion stays in a region.
fn horseshoe(scene: &Scene, request: &DescribeOptions, region: &Region, watch: &Latched<'_>) -> Horseshoe {
    let why = match region {
        Region::Proved(_) if watch.is_stopped() => STOPPED,
        Region::Proved(trap) if trap.entered().is_none() => "the motion is not proved to enter the region",
        Region::Proved(_) => {
            let question = HorseshoeSettings { depth: Some(request.depth as usize), ..HorseshoeSettings::default() };
            return match Chaos::of_scene(scene, &question, watch) {
                Ok(chaos) => Horseshoe::Searched(Box::new(chaos)),
                Err(error) => Horseshoe::NotExamined(error.to_string()),
            };
        }
        Region::Unproved(_) => "no trapping region is proved",
        Region::NotExamined(why) => why,
    };
    Horseshoe::NotExamined(why.to_owned())
}
