//! Verdicts on rows of the list and on certified impacts.

/// Verdict on a row or a certified impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The listed impact is certified, and may be within the tolerance.
    Inside,
    /// The listed impact is certified, and proved to be outside the tolerance.
    Outside,
    /// The impact is certified, but not listed.
    Missed,
    /// The row is proved not to be a certified impact.
    False(Reason),
    /// The row is among the infinitely many impacts of a chatter.
    InChatter,
    /// The row is after the end of the certified orbit.
    Undecided,
    /// The row is after the last followed impact: the list lacks more impacts than it has rows.
    NotReached,
}

impl Verdict {
    /// Name of the verdict in the audit JSON.
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

    /// Whether list and true orbit are proved to differ here.
    pub fn disagrees(self) -> bool {
        matches!(self, Self::Outside | Self::Missed | Self::False(_))
    }
}

/// Reason why a row is false.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Another row is already matched to this impact.
    Twice,
    /// The impact that the row would be comes earlier or later in the list.
    Order,
    /// The nearest contact is on the other wall.
    Wall,
    /// The ball rests on the row's wall at that time.
    Rest,
    /// No impact is near, or none at all.
    None,
}

impl Reason {
    /// Name of the reason in the audit JSON.
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
