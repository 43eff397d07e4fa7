//! Event lists of other simulators: read or refused with the place; what is read is judged, and judging ends.

use impact_pair::audit::{Audit, AuditSettings, Columns, read};
use impact_pair::watch::Unwatched;
use impact_pair::{ErrorKind, Scene};
use impact_pair_fuzz::{config, edited, share};
use proptest::prelude::*;

/// The exact orbit of figure 12 as text, with other separators, as JSON in three forms, and with what lists have besides.
fn seeds() -> Vec<String> {
    [
        "time,wall,velocity\n1,right,12.56\n2,left,-12.56\n3,right,12.56\n",
        "# t wall\n1\tR\n2\tL\n3\tR\n",
        "time;wall\n1.0;1\n2.0;-1\n3.0;1\n",
        "[{\"time\": 1, \"wall\": \"right\"}, {\"time\": 2, \"wall\": \"left\"}]",
        "{\"time\": [1, 2, 3], \"wall\": [\"right\", \"left\", \"right\"]}",
        "{\"time\": 1, \"wall\": \"right\"}\n{\"time\": 2, \"wall\": \"left\"}\n",
        "time,wall\n0.5,4.712388980384690\n1.5,-4.71238898\n1e9,right\n",
    ]
    .map(str::to_owned)
    .to_vec()
}

fn scene() -> Scene {
    let excitation = "excitation = { amplitude = 1, frequency = \"pi\", phase = 0 }";
    let rest =
        "pair = { gap = \"3*pi\", restitution = 0.5 }\nstart = { time = 0, wall = \"left\", velocity = \"-4*pi\" }";
    Scene::parse(&format!("{excitation}\n{rest}")).unwrap()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn lists_are_read_and_judged_or_refused(text in edited(seeds())) {
        let scene = scene();
        match read(&text, &Columns::default(), scene.pair()) {
            Ok(list) => {
                let rows = list.rows.len();
                let requested = AuditSettings { max_bits: 256, ..AuditSettings::default() };
                if let Ok(audit) = Audit::of(&scene, list, &requested, &Unwatched) {
                    prop_assert!(audit.findings().len() >= rows || requested.until.is_some());
                }
            }
            Err(error) => prop_assert!(error.kind() == ErrorKind::List && !error.to_string().is_empty(), "{error}"),
        }
    }
}

#[test]
fn many_are_read_and_many_refused() {
    let share = share(seeds(), |text| read(text, &Columns::default(), scene().pair()).is_ok());
    assert!((0.25..0.75).contains(&share), "{share}");
}
