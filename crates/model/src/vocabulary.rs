//! The closed vocabularies of results, which the computation, its documents and their check have in common: each word is written once.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The end of an orbit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum OutcomeKind {
    /// All requested impacts are listed.
    #[default]
    ImpactsReached,
    /// All events up to the requested time are listed.
    TimeReached,
    /// From a release on the motion is proved to repeat exactly, for ever.
    Periodic,
    /// The motion is proved to converge to a stable periodic orbit.
    Attracted,
    /// The ball rests on its wall for ever.
    RestsForever,
    /// No wall is ever touched again.
    NeverImpacts,
    /// The next event is not proved.
    Undecided,
}

/// The result at a point of a sweep, in the order in which they are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PointOutcome {
    /// The motion is proved to converge to a stable periodic orbit.
    Attracted,
    /// No wall is ever touched again.
    NeverImpacts,
    /// From a release on the motion is proved to repeat exactly, for ever.
    Periodic,
    /// The ball rests on its wall for ever.
    RestsForever,
    /// The next event is not proved.
    Undecided,
    /// All that was requested is listed, and the limit of the motion is not decided.
    UndecidedLimit,
}

/// The reason why a question about a flight is undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// A wall may be touched with zero velocity: a graze, or a ball that comes to rest.
    Graze,
    /// The set of states has become too wide to decide.
    Width,
    /// The requested width is beyond this arithmetic.
    Precision,
    /// The flight is longer than the solver follows, or has no end that it can prove.
    Budget,
}

/// The arithmetic in which an orbit was computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ArithmeticKind {
    /// The cheapest arithmetic that certifies each impact; where it is not said, in older documents, which it was.
    #[default]
    Auto,
    /// Plain double precision, not certified.
    Float,
    /// Double precision, certified.
    Interval,
    /// The textbook method in intervals.
    Inari,
    /// More than double precision.
    Multiprecision,
    /// A true orbit from a start very near the given one.
    Shadow,
}

/// The linear stability of an orbit: whether small disturbances die out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Stability {
    /// Both eigenvalues lie inside the unit circle, proved.
    Stable,
    /// One eigenvalue lies outside the unit circle, proved.
    Unstable,
    /// `e = 1`, and both eigenvalues lie on the unit circle, apart and not real, proved: small disturbances neither die out nor grow in
    /// linear theory, which decides no more.
    Elliptic,
    /// None of these is proved: a bifurcation is too near.
    #[default]
    Undecided,
}

/// The kinds of bifurcation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Bifurcation {
    /// The branch has a quadratic turning point: (40).
    Fold,
    /// A symmetric orbit becomes two that are mirror images: (40) by an eigenvalue -1 of half the period.
    Pitchfork,
    /// (39): an orbit of twice the period branches off.
    PeriodDoubling,
    /// A wall is touched with zero velocity: beyond, the word is another one. For `e = 0` also an impact at which the contact force ends: beyond,
    /// the ball rests after it.
    Graze,
}

/// The end of a followed branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum BranchEnd {
    /// The range of the parameter ends.
    Range,
    /// At a fold.
    Fold,
    /// At a pitchfork.
    Pitchfork,
    /// At a period doubling.
    PeriodDoubling,
    /// At a graze.
    Graze,
    /// Nowhere: it closes.
    Closed,
    /// The branch breaks off before the range ends.
    Lost,
    /// The branch was not followed further, at the caller's request.
    Interrupted,
}

/// A change along a curve of two-impact motions, in the order of rising `d W/|v|`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Mark {
    /// The near wall is grazed: admissible beyond.
    Graze,
    /// The pitchfork (40): stable from here to the fold.
    Pitchfork,
    /// `sin th0 = 0`: dashed before, solid beyond.
    Level,
    /// The fold (40), where `A_N` is least.
    Fold,
}

/// What equispaced two-impact motions are solved for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum SolvedFor {
    /// The velocity before the impacts.
    #[default]
    Velocity,
    /// `A`
    Amplitude,
    /// `d`
    Gap,
}

/// What parameter manifolds are drawn over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ManifoldAxis {
    /// `W`
    Frequency,
    /// The velocity before the impacts.
    Velocity,
}

/// The sign of a sine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Sign {
    /// Below 0.
    Negative,
    /// 0
    Zero,
    /// Above 0.
    Positive,
}

/// The class of a pair: the ends of all its motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// Every motion that touches a wall ends in one cycle with rests.
    OneRestCycle,
    /// Every motion that touches a wall tends to one attractor, or stays at saddles or grazing states.
    OneAttractor,
    /// Attractors are proved, and others may exist.
    Attractors,
    /// Every motion that touches a wall is in the end in closed components of which nothing else is known, or stays at saddles or grazing
    /// states.
    Closed,
    /// Nothing of these.
    Undecided,
}

/// What the motions that stay in a component do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ComponentKind {
    /// They tend to a periodic motion that attracts all motions near it.
    Attracting,
    /// They tend to a periodic motion that does not, or stay in a set of saddle type.
    Saddle,
    /// They are released again and again in the same state.
    RestCycle,
    /// They graze one wall once in every forcing period, for ever.
    Grazing,
    /// Nothing is proved.
    Undecided,
}

/// The limit that leaves a component undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum OpenReason {
    /// The number of boxes that are mapped in all.
    Most,
    /// The number of halvings.
    Halvings,
    /// The work of the images.
    Work,
    /// The analysis was interrupted.
    Interrupted,
}

/// The verdict on all values of a parameter in a stretch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum StretchVerdict {
    /// The impact map of each pair holds a horseshoe.
    Horseshoe,
    /// The orbit of the scene's own start converges to a stable periodic orbit.
    Attracted,
    /// Each pair has a stable periodic orbit; that the scene's own orbit converges to it is not proved.
    Stable,
    /// Nothing is proved.
    Undecided,
}

/// The reason why a word is left out of a hyperbolic set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LeftOut {
    /// The h-sets overlap as parallelograms.
    Overlap,
    /// No strip of the word is seen in floating point, or none beside the strips of shorter words.
    Strip,
    /// A curve in the cones could meet a side of the word's strip twice.
    Leaning,
    /// The word's strip would be cut into too many cells.
    Cells,
    /// A smallest cell is not proved to map its cone into itself, and to expand.
    Cone,
    /// No word of the set leads to the word's first h-set, or from its last one.
    Return,
    /// The expansion of strings of words is not bounded.
    Strings,
    /// The search was stopped.
    Interrupted,
}

/// The reason why there is no exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum NoExponent {
    /// There are no two impacts in a row.
    NoImpacts,
    /// At a graze the map has no derivative; it may have been a miss.
    Graze,
    /// The ball rests with zero contact force: some nearby motions leave.
    Unpressed,
    /// The states are known too coarsely, or the ball is on its wall without velocity and is not proved to be accelerated away from it.
    Width,
}

/// What an exhaustive list of periodic orbits leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub enum Excludes {
    /// Motions with a rest, which the equations of chains do not have.
    #[serde(rename = "motions that rest")]
    Resting,
}

impl BranchEnd {
    /// The end at a bifurcation.
    pub fn at(kind: Bifurcation) -> Self {
        match kind {
            Bifurcation::Fold => Self::Fold,
            Bifurcation::Pitchfork => Self::Pitchfork,
            Bifurcation::PeriodDoubling => Self::PeriodDoubling,
            Bifurcation::Graze => Self::Graze,
        }
    }
}

impl NoExponent {
    /// Whether the exponent is proved not to exist; otherwise it could not be found.
    pub fn is_definite(self) -> bool {
        match self {
            Self::NoImpacts | Self::Unpressed => true,
            // A graze is listed where no precision tells it from a miss.
            Self::Graze | Self::Width => false,
        }
    }
}

impl PointOutcome {
    /// The result where an orbit ends like this: of a motion that is not proved to be attracted only the limit is undecided.
    pub fn of(orbit: OutcomeKind) -> Self {
        match orbit {
            OutcomeKind::ImpactsReached | OutcomeKind::TimeReached => Self::UndecidedLimit,
            OutcomeKind::Periodic => Self::Periodic,
            OutcomeKind::Attracted => Self::Attracted,
            OutcomeKind::RestsForever => Self::RestsForever,
            OutcomeKind::NeverImpacts => Self::NeverImpacts,
            OutcomeKind::Undecided => Self::Undecided,
        }
    }
}

/// Words are printed as they are written in documents.
macro_rules! printed {
    ($($vocabulary:ident),+) => {
        $(impl fmt::Display for $vocabulary {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.serialize(f)
            }
        })+
    };
}
printed!(
    OutcomeKind,
    PointOutcome,
    Reason,
    Stability,
    Bifurcation,
    NoExponent,
    ArithmeticKind,
    OpenReason,
    BranchEnd,
    Mark,
    ManifoldAxis,
    Class,
    ComponentKind,
    StretchVerdict
);
