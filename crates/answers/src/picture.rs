//! What pictures of answers show.

use impact_pair::Scene;
use impact_pair::chaos::{Cells, Chaos, Global, Hyperbolic, RangeSettings, Trap, Windows};
use impact_pair::json::{DescriptionDocument, GlobalDocument};
use impact_pair::scene::Range;
use impact_pair::tangency::Tangencies;
use impact_pair::two_impact::{Axis, Manifold};

use crate::describe::Description;
use crate::trade::Trade;

/// The results that a picture of an answer shows; `impact-pair-plot` draws them.
#[derive(Clone, Copy)]
pub enum Picture<'a> {
    /// A trapping region.
    Trap(&'a Scene, &'a Trap),
    /// Horseshoes, of all values of a range if there is one, and the hyperbolic set in them.
    Chaos(&'a Scene, Option<&'a Range>, &'a Chaos, Option<&'a Hyperbolic>),
    /// Verdicts over a range of a parameter.
    ChaosCells(&'a Scene, &'a RangeSettings, &'a Cells),
    /// Stable periodic orbits over a parameter.
    Windows(&'a Scene, &'a Windows),
    /// The state space, and the components of its recurrent set.
    Global(&'a Scene, &'a Global, &'a GlobalDocument),
    /// Homoclinic tangencies.
    Tangency(&'a Scene, &'a Tangencies),
    /// The description of a motion.
    Description(&'a Scene, &'a Description, &'a DescriptionDocument),
    /// The cost of accuracy.
    Trade(&'a Trade<'a>),
    /// Parameter manifolds.
    Manifolds(&'a Scene, Axis, &'a [Manifold]),
}
