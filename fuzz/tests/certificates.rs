//! Orbit documents: read or refused with the path of what is wrong; what is read is checked, and checking ends.

use impact_pair::Scene;
use impact_pair::orbit::Orbit;
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Certificate, Limits};
use impact_pair_fuzz::{config, edited, share};
use proptest::prelude::*;

/// A chaotic orbit, a rest, a graze and several harmonics, a few events each.
fn seeds() -> Vec<String> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");
    let document = |name: &str| {
        let scene = Scene::parse(&std::fs::read_to_string(format!("{folder}/{name}.toml")).unwrap()).unwrap();
        let settings = impact_pair::orbit::Settings { impacts: Some(4), ..scene.settings() };
        serde_json::to_string_pretty(&Orbit::of(&scene, settings).unwrap().document()).unwrap()
    };
    ["figure-14", "chatter", "graze", "two-tones"].map(document).to_vec()
}

/// Less than by default: there are many documents.
const LIMITS: Limits = Limits { bits: 1024, parts: 1 << 12, pieces: 4, work: 1 << 12 };

proptest! {
    #![proptest_config(config())]

    #[test]
    fn documents_are_read_and_checked_or_refused(text in edited(seeds())) {
        match Certificate::parse(&text) {
            Ok(certificate) => {
                let _ = certificate.check_within(&LIMITS, &Unwatched);
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}

#[test]
fn many_are_read_and_many_refused() {
    let share = share(seeds(), |text| Certificate::parse(text).is_ok());
    assert!((0.25..0.75).contains(&share), "{share}");
}
