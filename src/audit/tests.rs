use super::*;
use crate::tests::scene;
use crate::watch::Unwatched;

#[test]
fn the_truth_is_finer_than_the_tolerance() {
    let digits = |text: &str| AuditSettings { tolerance: text.parse().unwrap(), ..AuditSettings::default() }.digits();
    assert_eq!([digits("1e-9"), digits("2e-9"), digits("1"), digits("0.5")], [12, 12, 3, 4]);
    assert_eq!(digits("0"), 12);
    assert!(digits("1e-5000") > 300);
}

/// The impacts of the exact orbit of figure 12, at t = 1, 2, 3, ...
fn listed(times: impl Iterator<Item = u64>) -> String {
    let row = |t: u64| format!("{t},{}\n", if t % 2 == 1 { "right" } else { "left" });
    format!("time,wall\n{}", times.map(row).collect::<String>())
}

/// With a tolerance of a forcing period a row before impact 3 is impact 4: then impact 3, which is later than all rows, is missed.
#[test]
fn r40_an_impact_before_a_listed_one_is_missed_whatever_the_time_of_the_last_row() {
    let scene = scene("figure-12-exact");
    let verdicts = |list: &str, until: Option<&str>| -> Vec<Verdict> {
        let list = read(list, &Columns::default(), scene.pair()).unwrap();
        let until = until.map(|until| until.parse().unwrap());
        let requested = AuditSettings { tolerance: "1".parse().unwrap(), until, ..AuditSettings::default() };
        let audit = Audit::of(&scene, list, &requested, &Unwatched).unwrap();
        audit.findings().iter().map(|finding| finding.verdict).collect()
    };
    let list = "time,wall\n1,right\n2,left\n2.5,left";
    let [inside, missed] = [Verdict::Inside, Verdict::Missed];
    assert_eq!(verdicts(list, None), [inside, inside, missed, inside]);
    // Its row may be one of those that are left out.
    assert_eq!(verdicts(&list.replace("2.5,", "3,right\n2.5,"), Some("2.75")), [inside; 3]);
}

/// Rests are no impacts, in whatever form the list comes.
#[test]
fn r44_of_columns_in_json_those_that_are_no_impacts_are_skipped() {
    let scene = scene("figure-12-exact");
    let read = |list: &str| read(list, &Columns::default(), scene.pair()).unwrap();
    let columns = r#"{"event": ["impact", "rest", "impact"], "time": [1, 1.5, 2], "wall": ["right", "right", "left"]}"#;
    let list = read(columns);
    assert!(list.unused.is_empty() && list.rows.len() == 2, "{list:?}");
    assert!(Audit::of(&scene, list, &AuditSettings::default(), &Unwatched).unwrap().is_agreed());
    assert_eq!(read("event,time,wall\nimpact,1,right\nrest,1.5,right\nimpact,2,left").rows.len(), 2);
}

fn refused(list: &str, until: Option<&str>) -> String {
    let scene = scene("figure-12-exact");
    let requested = AuditSettings { until: until.map(|until| until.parse().unwrap()), ..AuditSettings::default() };
    let list = read(list, &Columns::default(), scene.pair());
    list.and_then(|list| Audit::of(&scene, list, &requested, &Unwatched).map(drop)).unwrap_err().to_string()
}

/// Of two times of one row the last one was compared.
#[test]
fn r45_a_row_in_json_has_each_key_once() {
    for list in [
        r#"[{"time": 7, "time": 1, "wall": "right"}]"#,
        r#"{"time": [7], "time": [1], "wall": ["right"]}"#,
        r#"{"events": [], "events": [{"time": 1, "wall": "right"}]}"#,
    ] {
        assert!(refused(list, None).contains("twice"), "{list}");
    }
}

/// In words above a list `time` and `wall` are no columns, where there are more or fewer of them.
#[test]
fn r45_a_comment_names_columns_only_if_there_is_one_for_each_word() {
    let scene = scene("figure-12-exact");
    for comment in ["my own time integrator", "wall clock time", "the wall", "time wall"] {
        let list = format!("# {comment}\n1 right\n2 left");
        let list = read(&list, &Columns::default(), scene.pair()).unwrap();
        assert!(Audit::of(&scene, list, &AuditSettings::default(), &Unwatched).unwrap().is_agreed(), "{comment}");
    }
    let list = read("# wall, time\nright, 1\nleft, 2", &Columns::default(), scene.pair()).unwrap();
    assert!(Audit::of(&scene, list, &AuditSettings::default(), &Unwatched).unwrap().is_agreed());
}

/// Nothing was compared, and it was said to agree; rows before the start were said to be too late.
#[test]
fn r45_nothing_is_compared_before_the_start() {
    let list = "time,wall\n1,right";
    assert_eq!(refused(list, Some("-1")), "until is `-1`, but accepted is a time from the start on, 0");
    assert!(refused("time,wall\n-3,right", None).ends_with("time is `-3`, before the start at 0"));
    assert!(refused(list, Some("1e30")).contains("later than an orbit can be followed to"));
}

#[test]
fn a_corrupted_time_does_not_cost_an_endless_run() {
    let scene = scene("figure-12-exact");
    let audit = |list: &str| {
        let rows = read(list, &Columns::default(), scene.pair()).unwrap();
        Audit::of(&scene, rows, &AuditSettings::default(), &Unwatched).unwrap()
    };
    let corrupted = audit(&(listed(1..6) + "1000000000,left\n"));
    let counts = [Verdict::Inside, Verdict::Missed, Verdict::NotReached, Verdict::Undecided];
    assert_eq!(counts.map(|verdict| corrupted.count(|other| other == verdict)), [5, 1008, 1, 0]);
    assert_eq!(corrupted.findings().last().unwrap().verdict, Verdict::NotReached);
    assert!(!corrupted.is_agreed() && corrupted.first_disagreement().is_some_and(|first| corrupted.impact(first) == 6));
    // In the middle of a list it costs itself only, as any other row: what comes before it in time is reached.
    let sparse = audit(&listed((1..1500).filter(|t| t % 3 == 0)));
    assert_eq!([sparse.count(|v| v == Verdict::Inside), sparse.count(|v| v == Verdict::Missed)], [499, 998]);
    assert_eq!(sparse.count(|v| v == Verdict::NotReached), 0);
}
