//! A description in words: a few lines, each with a label.

use impact_pair::json::{DescribedExponent, DescriptionDocument, ExtendedBounds, HorseshoeDocument, TrapDocument};

use impact_pair::exact::{Exact, decimal_digits};

/// Bits that show bounds.
const BITS: u32 = 160;

/// Lines of a description: each a label, which may come several times, and a text.
pub fn lines(document: &DescriptionDocument) -> Vec<(&'static str, String)> {
    let certified = if document.certified { "certified: " } else { "" };
    let mut lines = vec![("fate", format!("{certified}{}", document.fate.message))];
    lines.extend(exponent(&document.exponent, document.fate.impacts).map(|text| ("exponent", text)));
    lines.extend(document.region.as_ref().map(|region| ("region", in_words(region))));
    lines.extend(entropy(document).map(|text| ("entropy", text)));
    let undecided = document.undecided.iter();
    lines.extend(undecided.map(|open| ("undecided", format!("{} {}", open.question, open.command))));
    let not_examined = document.not_examined.iter();
    lines.extend(not_examined.map(|skipped| ("not examined", format!("{}: {}", skipped.question, skipped.reason))));
    lines
}

/// The exponents, as far as they are known.
fn exponent(exponent: &DescribedExponent, impacts: u64) -> Option<String> {
    let limit = exponent.limit.as_ref().map(|limit| format!("{} per impact in the limit", shown(limit)));
    let finite =
        exponent.finite_time.as_ref().map(|finite| format!("{} per impact over {impacts} impacts", shown(finite)));
    let all: Vec<String> = limit.into_iter().chain(finite).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// Bounds with the digits that they have in common; infinite ones in words.
fn shown(bounds: &ExtendedBounds) -> String {
    let [low, high] = &**bounds;
    match [low, high].map(|end| Exact::parse(end)) {
        [Ok(low), Ok(high)] => {
            Exact::interval(&low, &high).map_or_else(|_| low.text(), |both| decimal_digits(&both.enclose(BITS)))
        }
        [Err(_), Ok(high)] => format!("at most {high}"),
        [_, Err(_)] => "minus infinity".to_owned(),
    }
}

fn in_words(region: &TrapDocument) -> String {
    format!(
        "trapping region of {} boxes; flights last {} [time], speeds before impacts are {} [length/time]",
        region.boxes, region.flight_time, region.speed_before
    )
}

fn entropy(document: &DescriptionDocument) -> Option<String> {
    let (entropy, horseshoe) = (document.entropy.as_ref()?, document.horseshoe.as_ref()?);
    let [impact, cycle] = [&entropy.per_impact, &entropy.per_cycle].map(|bound| bound.text());
    let HorseshoeDocument { words, in_region, .. } = horseshoe;
    let place = if *in_region { " in the region" } else { "" };
    let blocks = words.as_ref().map_or(String::new(), |[a, b]| format!(" of the blocks {a} and {b}"));
    Some(format!("a horseshoe{blocks}{place}: entropy at least {impact} per impact, {cycle} per forcing period"))
}
