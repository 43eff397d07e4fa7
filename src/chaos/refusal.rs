//! Reasons why no trapping region is proved: of a box, and of all grids.

/// The reason why a box is not proved to fly into others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    /// A ball of the box may come to rest, or bounce too little to be distinguished from one that does.
    Rest,
    /// A flight may be longer than is followed.
    Long,
}

/// The reason why no region is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoTrap {
    /// In the finest grid a ball may come to rest, or bounce too little to be distinguished from one that does.
    Rest,
    /// In the finest grid a flight may be longer than 64 forcing periods.
    Long,
    /// In the finest grid a ball may be so fast that the boxes up to its speed are not counted.
    Fast,
    /// The region still grew after millions of boxes.
    Boxes,
    /// `e` may be 1: the impact map then preserves the area `w dw dth`, and no set of boxes closes.
    Elastic,
    /// The scene's orbit has no impact that is seen.
    NoImpact,
    /// The search was stopped.
    Interrupted,
}

impl NoTrap {
    /// The reason in words, for messages.
    pub fn words(self) -> &'static str {
        match self {
            Self::Rest => "in the finest grid a ball may come to rest",
            Self::Long => "in the finest grid a flight may last for more than 64 forcing periods",
            Self::Fast => "in the finest grid a ball may be faster than the boxes that are counted, 2^31 in a column",
            Self::Boxes => "the region still grew after 4 million boxes",
            Self::Elastic => "where e may be 1 the impact map preserves area, and no boxes are mapped into themselves",
            Self::NoImpact => "the orbit of the scene has no impacts",
            Self::Interrupted => "interrupted",
        }
    }
}

impl From<Refusal> for NoTrap {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Rest => Self::Rest,
            Refusal::Long => Self::Long,
        }
    }
}
