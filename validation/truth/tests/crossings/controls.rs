//! The control of the comparisons: claims about a neighbour are found wrong.

use impact_pair::document;
use impact_pair::orbit::Settings;
use impact_pair_truth::float;

use super::members::Member;
use super::motion::{self, Halt};
use super::scenes::{Case, case};
use super::traits::{Excitation, array, crossing};
use crate::random::Random;

/// Scenes of points from the covering array, which is gone through as often as it takes.
fn cases(count: usize) -> impl Iterator<Item = Case> {
    let array = array(7);
    let rows = (0..).map(move |number| crossing(&array, number));
    let rows = rows.filter(|row| row.excitation != Excitation::MayVanish);
    let cases = rows.enumerate().filter_map(|(number, row)| case(row, Random::new(number as u64)));
    cases.filter(|case| case.scene.pair().is_point() && case.scene.start().is_point()).take(count)
}

#[test]
fn the_motion_of_a_neighbouring_start_is_refuted() {
    let (mut requested, mut found) = (0, 0);
    for case in cases(60) {
        let settings = Settings { impacts: Some(3), max_bits: 1024, ..Settings::default() };
        let Ok(orbit) = document::orbit(case.scene.pair(), case.scene.start(), settings) else { continue };
        let document = serde_json::to_value(orbit).expect("plain data");
        let mut member = Member::new(&case.scene, || 0.0);
        if document["events"][0]["event"] != "impact" || motion::judge(&document, &member).is_err() {
            continue;
        }
        requested += 1;
        member.shaken.gap *= float(1.0 + 1e-7);
        found += usize::from(matches!(motion::judge(&document, &member), Err(Halt::Wrong(_))));
    }
    println!("{found} of {requested} motions of neighbours are found wrong");
    assert!(requested > 10 && 10 * found > 9 * requested);
}
