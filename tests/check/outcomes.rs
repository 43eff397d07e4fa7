//! Claims of outcomes, and the work that a check may take.

use super::*;

/// Released at `t = 1` it is released again 7 cycles and 70 listed impacts later, on the same wall, and after twice that; three times that are not listed.
#[test]
fn r46_a_multiple_of_a_period_is_one_where_it_is_listed() {
    let document = certificate("1", "wall = \"left\", velocity = 0", "0.5", 160);
    assert_eq!(document["outcome"]["period"], json!({ "cycles": 7, "impacts": 70 }));
    let with = |cycles: u64, impacts: u64| {
        corrupted(&document, "/outcome/period", json!({ "cycles": cycles, "impacts": impacts }))
    };
    for times in 1..3 {
        assert!(matches!(with(7 * times, 70 * times), Verdict::Confirmed { .. }), "{times}");
    }
    for (cycles, impacts) in [(21, 210), (14, 70), (7, 140), (14, 139), (10, 100), (0, 0), (u64::MAX / 7 * 7, 70)] {
        assert!(matches!(with(cycles, impacts), Verdict::Refuted(_)), "{impacts} in {cycles}");
    }
}

/// The time to stop at is less than the event by what its bounds tell, as the time of the event is an exact expression, `pi/2` or `pi`: it was enclosed
/// less narrowly, and the event listed.
#[test]
fn r46_no_exact_event_is_listed_that_comes_after_the_time_to_stop_at() {
    let half_pi = "1.570796326794896619231321691639751442098584699687552910487472296153908203143";
    let pi = "3.141592653589793238462643383279502884197169399375105820974944592307816406286";
    let events = |start: &str, until: &str| {
        let document = orbit(&format!(
            "excitation = {{ amplitude = 1, frequency = 1, phase = 0 }}\npair = {{ gap = 2, restitution = 0.5 }}\n\
             start = {{ {start} }}\nrun = {{ until = \"{until}\" }}"
        ));
        assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{until}: {:?}", verdict(&document));
        document["events"].as_array().unwrap().len()
    };
    let grazes = "time = 0, position = 0, velocity = -1";
    assert_eq!([&format!("{half_pi}098"), &format!("{half_pi}2")].map(|until| events(grazes, until)), [0, 1]);
    // It rests on the right wall until it is released.
    let rests = "time = 0.5, wall = \"right\", velocity = 0";
    assert_eq!([&format!("{pi}19"), &format!("{pi}3")].map(|until| events(rests, until)), [1, 2]);
}

#[test]
fn r17_an_outcome_is_what_its_fields_say() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 3);
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
    let refuted = |outcome: Value| {
        let mut copy = document.clone();
        copy["outcome"] = outcome;
        matches!(verdict(&copy), Verdict::Refuted(_))
    };
    assert!(refuted(json!({"kind": "impacts-reached", "impacts": 3, "message": "9999 impacts"})));
    assert!(refuted(json!({"kind": "impacts-reached", "impacts": 4, "message": "4 impacts"})));
    assert!(refuted(json!({"kind": "impacts-reached", "impacts": 3, "until": "1"})));
    let until = |time: &str| json!({"kind": "time-reached", "impacts": 3, "until": time});
    assert!(
        refuted(until("9999"))
            && refuted(until("1e-3"))
            && refuted(json!({"kind": "time-reached", "impacts": 3, "until": null}))
    );
    // Up to just before the next impact, and just beyond it.
    let next = found_again(&certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 4)).pop().unwrap().0;
    let [lower, upper] = impact_pair::exact::decimal_bounds(&next.rounded(64));
    let mut copy = document.clone();
    copy["outcome"] = until(&lower);
    assert!(matches!(verdict(&copy), Verdict::Confirmed { .. }), "{:?}", verdict(&copy));
    assert!(!matches!(
        verdict(&{
            copy["outcome"] = until(&upper);
            copy
        }),
        Verdict::Confirmed { .. }
    ));
    assert!(refuted(until(&format!("{upper} + 1e-12"))));
    let older = document.to_string().replace("\"impacts\":3,", "").replace(",\"impacts\":3", "");
    let refused = Certificate::parse(&older).unwrap_err().to_string();
    assert!(refused.contains("outcome.impacts is missing"), "{refused}");
}

#[test]
fn r17_work_is_counted_and_a_graze_that_is_invented_is_bounded_by_it() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 3);
    let [_, upper] = impact_pair::exact::decimal_bounds(&found_again(&document).pop().unwrap().0);
    let invented = |time: [&str; 2], work: u64| {
        let mut copy = document.clone();
        copy["events"].as_array_mut().unwrap().push(json!({"event": "graze", "wall": "right", "time": time}));
        let certificate = Certificate::parse(&copy.to_string()).unwrap();
        certificate.check_within(&Effort { work, ..Effort::default() }, &Unwatched).unwrap()
    };
    match invented([&upper, "50"], 0) {
        Verdict::Undecided(finding) => assert!(finding.message.ends_with("the work allowed is spent"), "{finding:?}"),
        other => panic!("{other:?}"),
    }
    // Far from the wall nothing need be sought.
    let whole = Effort::default().work;
    let middle = |by: &str| {
        impact_pair::exact::decimal_bounds(&format!("{upper} + {by}").parse::<Exact>().unwrap().enclose(96))[0].clone()
    };
    assert!(matches!(invented([&middle("0.3"), &middle("0.3001")], whole), Verdict::Refuted(_)));
}

#[test]
fn r17_who_stops_a_check_keeps_what_is_proved() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 9);
    let certificate = Certificate::parse(&document.to_string()).unwrap();
    let stop_at = |event: usize| {
        let stop = |at: Stage<'_>| proceed_if(at != Stage::Claims(event));
        certificate.check_within(&Effort::default(), &stop).unwrap()
    };
    for events in [1, 4, 8] {
        assert_eq!(stop_at(events), Verdict::Interrupted { events });
    }
    assert!(matches!(stop_at(99), Verdict::Confirmed { .. }));
}

#[test]
fn r35_who_stops_a_proof_keeps_what_is_proved() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 9);
    let certificate = Certificate::parse(&document.to_string()).unwrap();
    let theorem = certificate.prove(9, &|at: Stage<'_>| proceed_if(at != Stage::Claims(5))).unwrap();
    assert_eq!((theorem.impacts, theorem.stop.map(|stop| stop.message)), (4, Some("interrupted".to_owned())));
}

#[test]
fn a_contact_that_does_not_come_is_refuted_in_the_first_bits() {
    let document = certificate("8", "wall = \"left\", velocity = 0", "0.5", 3);
    let refuted = |edit: fn(&mut Vec<Value>)| {
        let mut copy = document.clone();
        edit(copy["events"].as_array_mut().unwrap());
        let certificate = Certificate::parse(&copy.to_string()).unwrap();
        let effort = Effort { bits: 192, ..Effort::default() };
        match certificate.check_within(&effort, &Unwatched).unwrap() {
            Verdict::Refuted(finding) => finding.message,
            other => panic!("{other:?}"),
        }
    };
    // A rest, a release, impacts on the right, the left and the left wall.
    let elsewhere = refuted(|events| (events[3]["wall"], events[3]["mapping"]) = (json!("right"), json!("P3")));
    assert_eq!(elsewhere, "the ball is not at the right wall then");
    let twice = refuted(|events| {
        events[4] = events[3].clone();
        (events[4]["index"], events[4]["mapping"]) = (json!(3), json!("P4"));
    });
    assert_eq!(twice, "no contact with the left wall comes by then");
}
