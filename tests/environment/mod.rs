//! Numbers of the tests that the environment sets: how many cases, and from which seed.

use std::time::{SystemTime, UNIX_EPOCH};

/// The number in this variable, or the default; `all` is the greatest one, `fresh` another one each time.
pub fn number(name: &str, default: u64) -> u64 {
    match std::env::var(name).as_deref() {
        Ok("all") => u64::MAX,
        Ok("fresh") => SystemTime::now().duration_since(UNIX_EPOCH).expect("after 1970").as_nanos() as u64,
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name} must be a number, `all` or `fresh`, got {text:?}")),
        Err(_) => default,
    }
}
