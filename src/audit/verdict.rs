//! What is said of a row of the list, or of a certified impact.

/// What a row or a certified impact is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Certified, and no farther from it than the tolerance.
    Inside,
    /// Certified, and proved to be farther.
    Outside,
    /// Certified, on no row.
    Missed,
    /// On a row, and not certified.
    False(Reason),
    /// Among the infinitely many of a chatter.
    InChatter,
    /// After the end of what is certified.
    Undecided,
    /// After the impact from which on the orbit was not followed: the list lacks more impacts than it has rows.
    NotReached,
}

impl Verdict {
    /// The word of the audit JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inside => "inside",
            Self::Outside => "outside",
            Self::Missed => "missed",
            Self::False(_) => "false",
            Self::InChatter => "chatter",
            Self::Undecided => "undecided",
            Self::NotReached => "not-reached",
        }
    }

    /// Whether list and truth differ here, as far as is known.
    pub fn disagrees(self) -> bool {
        matches!(self, Self::Outside | Self::Missed | Self::False(_))
    }
}

/// Why a row is false.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Another row is this impact already.
    Twice,
    /// The impact it would be comes earlier or later in the list.
    Order,
    /// The nearest contact is on the other wall.
    Wall,
    /// The ball rests on its wall at that time.
    Rest,
    /// No impact is near, or none at all.
    None,
}

impl Reason {
    /// The word of the audit JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Twice => "twice",
            Self::Order => "order",
            Self::Wall => "wall",
            Self::Rest => "rest",
            Self::None => "none",
        }
    }
}
