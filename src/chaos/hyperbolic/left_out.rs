//! Reasons why words are left out of a hyperbolic set.

/// A strip is cut into no more cells than this.
pub(super) const MOST_CELLS: usize = 1 << 18;

pub use impact_pair_model::vocabulary::LeftOut;

/// The reason in words, for messages.
pub fn why_left_out(why: LeftOut) -> String {
    let words = match why {
        LeftOut::Overlap => "the h-sets overlap as parallelograms",
        LeftOut::Strip => "no strip of its own is seen",
        LeftOut::Leaning => "its strip leans too much for cones this wide",
        LeftOut::Cells => return format!("its strip would be cut into more than {MOST_CELLS} cells"),
        LeftOut::Cone => "a cone is not proved to be mapped into itself and to expand",
        LeftOut::Return => "no other word leads to it, or back",
        LeftOut::Strings => "the expansion of strings of words is not bounded",
        LeftOut::Interrupted => "interrupted",
    };
    words.to_owned()
}
