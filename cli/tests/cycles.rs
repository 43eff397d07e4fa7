//! `impact-pair cycles`: snapshots, and what of a document may be relied on.

use crate::common::{EXACT, program, snapshots};

snapshots! { EXACT;
    cycles_of_figure_14: program(&["cycles", "scenes/figure-14.toml", "--impacts", "1..5"]);
    cycles_of_figure_12: program(&["cycles", "scenes/figure-12.toml", "--impacts", "1..2"]);
    cycles_of_figure_16: program(&["cycles", "scenes/figure-16.toml", "--impacts", "3"]);
    cycles_of_chatter: program(&["cycles", "scenes/chatter.toml", "--impacts", "1..3"]);
    cycles_under_two_harmonics: program(&["cycles", "scenes/two-tones.toml", "--impacts", "1..3"]);
    numbers_of_impacts_that_are_none: program(&["cycles", "scenes/figure-14.toml", "--impacts", "5..4"]);
    arguments_of_cycles: program(&["cycles", "--help"]);
}

/// The one fixed point of the fourth iterate is a cycle of one impact, which was counted as one of four.
#[test]
fn r52_cycles_of_fewer_impacts_are_not_counted_as_cycles_of_more() {
    let last = |impacts: &str| {
        let answer = program(&["cycles", "scenes/figure-14.toml", "--impacts", impacts]).output().unwrap();
        String::from_utf8(answer.stdout).unwrap().lines().next_back().unwrap().to_owned()
    };
    let fewer = "and one of fewer impacts that returns after as many; none of them attracts";
    assert_eq!(last("4"), format!("certified: the region has no cycle of 4 impacts, {fewer}"));
    assert_eq!(last("3..4"), format!("certified: the region has exactly one cycle of 3 to 4 impacts, {fewer}"));
    assert_eq!(last("1..4"), "certified: the region has exactly 2 cycles of 1 to 4 impacts; none of them attracts");
}
