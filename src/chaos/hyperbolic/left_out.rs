//! Reasons why words are left out of a hyperbolic set.

/// A strip is cut into no more cells than this.
pub(super) const MOST_CELLS: usize = 1 << 18;

/// The reason why a word is left out of a hyperbolic set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
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

impl LeftOut {
    /// Name of the reason in documents.
    pub fn name(self) -> &'static str {
        match self {
            Self::Overlap => "overlap",
            Self::Strip => "strip",
            Self::Leaning => "leaning",
            Self::Cells => "cells",
            Self::Cone => "cone",
            Self::Return => "return",
            Self::Strings => "strings",
            Self::Interrupted => "interrupted",
        }
    }

    /// The reason in words, for messages.
    pub fn words(self) -> String {
        let words = match self {
            Self::Overlap => "the h-sets overlap as parallelograms",
            Self::Strip => "no strip of its own is seen",
            Self::Leaning => "its strip leans too much for cones this wide",
            Self::Cells => return format!("its strip would be cut into more than {MOST_CELLS} cells"),
            Self::Cone => "a cone is not proved to be mapped into itself and to expand",
            Self::Return => "no other word leads to it, or back",
            Self::Strings => "the expansion of strings of words is not bounded",
            Self::Interrupted => "interrupted",
        };
        words.to_owned()
    }
}
