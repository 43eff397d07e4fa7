//! README says of its commands what is measured.

use std::fs;

fn file(name: &str) -> String {
    fs::read_to_string(format!("{}/{name}", impact_pair_tests::ROOT)).unwrap()
}

/// `validation/fresh` measures README's commands in a fresh clone: its third line has "N processor minutes, M minutes" of each.
#[test]
fn the_minutes_of_readme_are_those_of_the_report() {
    let (report, readme) =
        (file("validation/report/fresh.md"), file("README.md").split_whitespace().collect::<Vec<_>>().join(" "));
    let measured: Vec<&str> = report.lines().nth(2).unwrap().split("; ").collect();
    for one in measured {
        let minutes = one.split_once(": ").unwrap().1.split(" on ").next().unwrap();
        assert!(readme.contains(&format!("{minutes} on two idle cores")), "README does not say: {minutes}");
    }
}
