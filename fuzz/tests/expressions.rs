//! Expressions: read or refused with a column inside the text; what is read prints and encloses.

use impact_pair::exact::Exact;
use impact_pair_fuzz::{config, edited, share};
use proptest::prelude::*;

fn seeds() -> Vec<String> {
    [
        "9.42497",
        "10*pi",
        "sqrt(2)/3 - 1e-40",
        "[9.42, 3*pi]",
        "cos(0.3) - cos(-0.3)",
        "-(1 + 2)^3/7",
        "sin(1e22)*sqrt(1 + pi)",
        "((1/3)^2 - sqrt(5))^4",
    ]
    .map(str::to_owned)
    .to_vec()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn expressions_are_read_or_refused(text in edited(seeds())) {
        match Exact::parse(&text) {
            Ok(x) => {
                // One more operation forgets the text, so that the expression itself is printed.
                let doubled = x.checked_add(&x).ok().filter(Exact::is_point);
                if let Some(doubled) = doubled {
                    let again = Exact::parse(&doubled.text());
                    let again = again.map_err(|error| TestCaseError::fail(format!("{doubled}: {error}")))?;
                    prop_assert!(again.enclose(80).intersection(&doubled.enclose(80)).is_some());
                    let _ = (x.sign(), x.compare(&again));
                }
            }
            Err(error) => prop_assert!((1..=text.len() + 1).contains(&error.column()), "{error}"),
        }
    }
}

#[test]
fn many_are_read_and_many_refused() {
    let share = share(seeds(), |text| Exact::parse(text).is_ok());
    assert!((0.25..0.75).contains(&share), "{share}");
}
