//! The impact pair of figure 1: excitation, gap, restitution, and their dimensionless form.

use std::fmt;

use crate::error::Error;
use crate::excitation::{Excitation, Harmonic};
use impact_pair_exact::Exact;
use serde::{Deserialize, Serialize};

/// A wall of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Wall {
    /// `y = -d/2`: switch-plane Sigma-, arrivals with `v <= 0`.
    Left,
    /// `y = +d/2`: switch-plane Sigma+, arrivals with `v >= 0`.
    Right,
}

impl fmt::Display for Wall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Wall {
    /// The opposite wall.
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// `left` or `right`
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// `1` for the left wall, `-1` for the right wall: the direction away from the wall.
    #[inline(always)]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }

    /// The phase that mirroring to the left wall adds, in forcing periods.
    #[inline(always)]
    pub fn mirror_phase(self) -> f64 {
        match self {
            Self::Left => 0.0,
            Self::Right => 0.5,
        }
    }
}

/// A ball between the two walls of an excited box: **equations** (1), (14), (15).
///
/// ```
/// use impact_pair_model::{Harmonic, ImpactPair};
/// let harmonic = Harmonic::new("8".parse()?, "pi".parse()?, "0".parse()?)?;
/// let pair = ImpactPair::new(harmonic, "9.42497".parse()?, "0.5".parse()?)?;
/// assert_eq!(pair.gap().text(), "9.42497");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ImpactPair {
    excitation: Excitation,
    gap: Exact,
    restitution: Exact,
}

impl ImpactPair {
    /// A pair with this excitation, gap `d > 0` \[length\] and restitution `0 <= e <= 1`.
    ///
    /// # Errors
    /// If a value is out of range, or cannot be proved to be in range.
    pub fn new(excitation: impl Into<Excitation>, gap: Exact, restitution: Exact) -> Result<Self, Error> {
        Error::require_positive("pair.gap", &gap)?;
        Error::require_range("pair.restitution", &restitution, 0, 1)?;
        Ok(Self { excitation: excitation.into(), gap, restitution })
    }

    /// The excitation (1).
    pub fn excitation(&self) -> &Excitation {
        &self.excitation
    }

    /// The excitation (9) of a pair with one harmonic.
    ///
    /// # Errors
    /// If there are several harmonics: `what` requires a single one.
    pub fn harmonic(&self, what: &str) -> Result<&Harmonic, Error> {
        self.excitation.only().ok_or_else(|| Error::several(self.excitation.harmonics().len(), what))
    }

    /// The gap `d` \[length\].
    pub fn gap(&self) -> &Exact {
        &self.gap
    }

    /// The coefficient of restitution `e`.
    pub fn restitution(&self) -> &Exact {
        &self.restitution
    }

    /// Whether no parameter is an interval.
    pub fn is_point(&self) -> bool {
        self.excitation.is_point() && self.gap.is_point() && self.restitution.is_point()
    }
}
