//! Tests of which row is which impact.

use super::{Audit, AuditSettings, Columns, Reason, Verdict, read};
use crate::Scene;
use crate::orbit::{Orbit, Settings};
use crate::watch::Unwatched;

/// The scene of `A`, `W`, `d`, `e`, `tau` and the start.
fn scene([amplitude, frequency, gap, restitution, phase]: [&str; 5], start: &str) -> Scene {
    Scene::parse(&format!(
        "excitation = {{ amplitude = \"{amplitude}\", frequency = \"{frequency}\", phase = \"{phase}\" }}\n\
         pair = {{ gap = \"{gap}\", restitution = \"{restitution}\" }}\nstart = {{ {start} }}"
    ))
    .unwrap()
}

/// The orbit of figure 12 that hits the walls at t = 1, 2, 3, ...
fn exact_orbit_of_figure_12() -> Scene {
    scene(["1", "pi", "3*pi", "0.5", "0"], "time = 0, wall = \"left\", velocity = \"-4*pi\"")
}

/// The verdicts on a list, with a tolerance and a time to compare up to.
fn verdicts(scene: &Scene, list: &str, tolerance: &str, until: Option<&str>) -> Vec<Verdict> {
    let list = read(list, &Columns::default(), scene.pair()).unwrap();
    let until = until.map(|until| until.parse().unwrap());
    let requested = AuditSettings { tolerance: tolerance.parse().unwrap(), until, ..AuditSettings::default() };
    let audit = Audit::of(scene, list, &requested, &Unwatched).unwrap();
    audit.findings().iter().map(|finding| finding.verdict).collect()
}

/// The certified impacts as rows of time, wall and velocity.
fn impacts(scene: &Scene, count: u64) -> Vec<String> {
    let settings = Settings { impacts: Some(count), digits: 15, ..scene.settings() };
    let mut orbit = Orbit::of(scene, settings).unwrap();
    let mut rows = Vec::new();
    orbit.follow_impacts(&Unwatched, |orbit, impact| {
        let [time, velocity] = <[_; 2]>::from(orbit.bounds(&impact)).map(|x| x.mid_rad().0);
        rows.push(format!("{time:?},{},{velocity:?}", impact.wall.name()));
        std::ops::ControlFlow::<()>::Continue(())
    });
    rows
}

/// The ball is in the gap at 17.2, between an impact on the right wall and one on the left, after which infinitely many follow within the
/// tolerance: a slow row there was taken for one of those.
#[test]
fn r51_a_row_before_the_contact_that_a_chatter_begins_with_is_false() {
    let scene = scene(["1", "pi", "9.42497", "0.3", "pi"], "time = 0, wall = \"left\", velocity = -0.5");
    let mut rows = impacts(&scene, 39);
    let all = |rows: &[String]| verdicts(&scene, &rows.join("\n"), "0.13", None);
    assert!(all(&rows).iter().all(|verdict| !verdict.disagrees()), "{:?}", all(&rows));
    let place = rows.iter().position(|row| row.starts_with("18.12")).unwrap();
    rows.insert(place, "17.2,left,-0.1".to_owned());
    assert_eq!(all(&rows)[place], Verdict::False(Reason::Twice));
}

/// Impact 1 is listed, a little late but within the tolerance, and later than the time to compare up to: it was said to be missed.
#[test]
fn r51_an_impact_whose_row_may_be_left_out_is_not_missed() {
    let scene = exact_orbit_of_figure_12();
    let until = |until| verdicts(&scene, "time,wall\n1.0000000001,right\n2,left", "1e-9", Some(until));
    assert_eq!(until("1.000000000001"), []);
    assert_eq!(until("1.00000001"), [Verdict::Inside]);
    // Farther from the end than the tolerance it is missed.
    let late = "time,wall\n1.1,right\n2,left";
    assert_eq!(verdicts(&scene, late, "1e-9", Some("1.05")), [Verdict::Missed]);
}

/// A start on the wall of the first impact took the row of that impact, and so on: an exact list lacked its last impact.
#[test]
fn r51_a_start_takes_no_row_from_the_first_impact() {
    let start = "time = 1.689, wall = \"left\", velocity = -0.9953";
    let scene = scene(["0.3", "pi", "7.505", "0.9", "-2.112"], start);
    let rows = impacts(&scene, 30);
    for (list, count) in [(rows.clone(), 30), ([vec!["1.689,left,-0.9953".to_owned()], rows].concat(), 31)] {
        assert_eq!(verdicts(&scene, &list.join("\n"), "0.5", None), vec![Verdict::Inside; count]);
    }
}

/// Of an interval of velocities no impact is certified: the first one of a member, soon after the start, was a start of another velocity.
#[test]
fn r51_rows_of_members_of_an_interval_are_not_outside() {
    let of = |velocity: &str| {
        let start = format!("time = 0.9592, wall = \"left\", velocity = \"{velocity}\"");
        scene(["0.3", "1", "0.8393", "0.01", "2.652"], &start)
    };
    let (member, all) = (of("-0.2198"), of("[-0.27475645421059482, -0.18051287595206105]"));
    let rows = impacts(&member, 20);
    assert!(verdicts(&member, &rows.join("\n"), "1e-2", None).iter().all(|verdict| !verdict.disagrees()));
    assert_eq!(verdicts(&all, &rows.join("\n"), "1e-2", None), vec![Verdict::Undecided; rows.len()]);
}

/// The velocity of the second row was not read, which its column is not named for; a row may have a name before its columns.
#[test]
fn r51_a_row_has_no_more_columns_than_the_first_line() {
    let scene = exact_orbit_of_figure_12();
    for list in ["time,wall\n1,right\n2,left,5", "1 right\n2 left 5", "time wall\n1 1.5 right"] {
        let refused = read(list, &Columns::default(), scene.pair()).unwrap_err().to_string();
        assert!(refused.contains("with 3 columns, but line 1 has 2"), "{refused}");
    }
    assert_eq!(verdicts(&scene, "time,wall\n1,right,\n2,left,", "1e-9", None), [Verdict::Inside; 2]);
}

/// An impact whose event has another case was skipped, and missed.
#[test]
fn r51_an_impact_is_one_in_any_case() {
    let scene = exact_orbit_of_figure_12();
    let text = "event,time,wall\nImpact,1,right\nIMPACT,2,left";
    let json = r#"[{"event": "Impact", "time": 1, "wall": "right"}, {"event": "impact", "time": 2, "wall": "left"}]"#;
    for list in [text, json] {
        assert_eq!(verdicts(&scene, list, "1e-9", None), [Verdict::Inside; 2], "{list}");
    }
}
