//! First flights made to be hard, each judged by the independent truth: none may be wrong, none undecided.
//!
//! Families: grazes and near misses down to 1e-40 of the gap, by velocity, by gap, in low hops and 1e15 periods from
//! the start; contacts after 1e-9 periods; flights of 1e11 forcing periods whose last peak barely reaches; starts at rest. Times
//! are measured and printed (`--nocapture`), never asserted.

use crate::common::families;
use crate::common::short_flights;
use crate::common::verdicts::{Answer, Question, Report, ask};
use crate::common::{Random, cases};

/// One of five pairs of questions, spread over all that a family varies; all where more cases than the default are requested.
fn some(all: Vec<Question>) -> impl Iterator<Item = Question> {
    let is_all = cases(4) > 1;
    all.into_iter().enumerate().filter(move |(number, _)| is_all || number / 2 % 5 == 0).map(|(_, question)| question)
}

/// One round of all families.
fn round(random: &mut Random) -> Vec<Question> {
    let families = [
        families::grazes,
        families::late_grazes,
        families::gap_grazes,
        families::small_hops,
        families::long_flights,
        short_flights::early_contacts,
        short_flights::dead_starts,
        short_flights::releases,
    ];
    families.into_iter().flat_map(|family| some(family(random))).collect()
}

#[test]
fn adversarial_first_flights_are_right_and_decided() {
    let mut random = Random::seeded(501);
    let mut report = Report::default();
    for _ in 0..cases(4) {
        for question in round(&mut random) {
            if question.family == "early contact" {
                short_flights::assert_early(&question);
            }
            report.put(&question);
        }
    }
    report.print();
    let shown = |list: &[String]| list.iter().take(8).cloned().collect::<Vec<_>>().join("\n");
    let (wrong, undecided) = (report.wrong.len(), report.undecided.len());
    assert!(report.requested >= 300 * cases(4), "only {} flights", report.requested);
    assert_eq!(wrong, 0, "wrong:\n{}", shown(&report.wrong));
    assert_eq!(undecided, 0, "undecided of {}:\n{}", report.requested, shown(&report.undecided));
}

/// The control: twins differ by twice the depth and by nothing else, so the library's answer to one, judged by the truth
/// of the other, has to be found wrong; a judge that passes it would pass anything.
#[test]
fn the_reference_refutes_the_answer_to_a_changed_scene() {
    let mut random = Random::seeded(502);
    let (mut found, mut undecided) = (0, 0);
    let families = [families::grazes, families::gap_grazes, families::long_flights];
    let questions = families.map(|family| some(family(&mut random)).collect::<Vec<_>>());
    for pair in questions.iter().flat_map(|questions| questions.chunks_exact(2)) {
        for (one, other) in [(&pair[0], &pair[1]), (&pair[1], &pair[0])] {
            match ask(one, &other.truth()).0 {
                Answer::Wrong(_) => found += 1,
                Answer::Undecided(_) => undecided += 1,
                Answer::Right => panic!("the twins have one answer: {one:?} {other:?}"),
            }
        }
    }
    println!("{found} answers to twins are wrong, {undecided} are undecided");
    assert!(found > 60);
}
