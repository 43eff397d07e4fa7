//! Verdicts on rows of the list and on certified impacts.

/// The verdict on a row or a certified impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Certified, within the tolerance.
    Inside,
    /// Certified, and proved to be outside the tolerance.
    Outside,
    /// Certified, but not listed.
    Missed,
    /// Listed, and proved not to happen.
    False(Reason),
    /// Among the infinitely many impacts of a chatter.
    InChatter,
    /// After the end of the certified orbit.
    Undecided,
    /// After the impact from which on the orbit was not followed: the list lacks more impacts than it has rows.
    NotReached,
}

impl Verdict {
    /// Returns the word of the audit JSON.
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

    /// Returns whether the list is proved to differ from the true orbit here.
    pub fn disagrees(self) -> bool {
        matches!(self, Self::Outside | Self::Missed | Self::False(_))
    }
}

/// The reason why a row is false.
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
    /// Returns the word of the audit JSON.
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
