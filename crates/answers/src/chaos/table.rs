//! The table of `chaos`.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use impact_pair::chaos::{Chaos, LeftOut, why_left_out};
use impact_pair::json::counted;
use impact_pair::json::{ChaosCellsDocument, ChaosDocument, HyperbolicDocument, RatesDocument, SharesDocument};
use impact_pair::pair::Wall;

use crate::{Status, Step};

/// One horseshoe, for one pair or all of a range.
pub fn horseshoe(document: &ChaosDocument, found: &Chaos) -> Result<String, fmt::Error> {
    let mut out = String::new();
    if let Some(over) = &document.over {
        writeln!(out, "for all values of {} from {} to {}", over.key, over.low.0, over.high.0)?;
    }
    let words = found.words().len();
    writeln!(
        out,
        "\n{}, {} of at most {}, {} boxes",
        counted(document.bases.len() as u32, "h-set"),
        counted(words as u32, "word"),
        counted(document.depth.get(), "impact"),
        document.boxes
    )?;
    if let Some([a, b]) = found.horseshoe() {
        let time = |half: i64| if half == 2 { "1 cycle".to_owned() } else { format!("{} cycles", 0.5 * half as f64) };
        let blocks = [a, b].map(|word| format!("{} ({})", word.in_mappings(), time(word.half_cycles)));
        let mirrored = [a, b].iter().any(|word| word.walls.last() == Some(&Wall::Right));
        let mirrored = if mirrored { " (mirrored where it starts on the right wall)" } else { "" };
        writeln!(
            out,
            "for every sequence of these two blocks{mirrored} there is a motion, for every periodic sequence a periodic one:"
        )?;
        writeln!(out, "  {}\n  {}", blocks[0], blocks[1])?;
    }
    if let Some(exponent) = document.exponent_seen {
        writeln!(out, "Lyapunov exponent of the floating-point orbit: {exponent:.3} per impact (non-rigorous)")?;
    }
    match &document.hyperbolic {
        Some(Some(set)) => out.push_str(&hyperbolic(document, set)?),
        Some(None) => writeln!(out, "undecided whether any of its words are hyperbolic")?,
        None => {}
    }
    for line in asymptotics(document) {
        writeln!(out, "{line}")?;
    }
    writeln!(out, "\n{}", conclusion(document, found))?;
    Ok(out)
}

/// The hyperbolic set of words, and what it is measured to be.
fn hyperbolic(document: &ChaosDocument, set: &HyperbolicDocument) -> Result<String, fmt::Error> {
    let mut out = String::new();
    let all = document.words.len();
    let left = if set.words.len() == all { "all".to_owned() } else { format!("{} of the", set.words.len()) };
    writeln!(
        out,
        "\nproved: the motions of {left} {all} words are a uniformly hyperbolic set ({} cells, cones of slope {})",
        set.cells,
        set.kappa.text()
    )?;
    let rates =
        |rates: &RatesDocument| format!("{} per impact, {} per forcing period", rates.per_impact, rates.per_cycle);
    writeln!(out, "  topological entropy          {}", rates(&set.entropy))?;
    writeln!(out, "  greater Lyapunov exponent    {} (every invariant measure)", rates(&set.exponents))?;
    writeln!(out, "  smaller Lyapunov exponent    {} per impact", set.second_exponent)?;
    writeln!(out, "  Hausdorff dimension          {}", set.dimension)?;
    Ok(out)
}

/// Returns a line for each reason why words are left out of the hyperbolic set, with their places in the list of words.
pub fn left_out(words: &[(usize, LeftOut)]) -> Vec<String> {
    let mut reasons: BTreeMap<LeftOut, Vec<String>> = BTreeMap::new();
    words.iter().for_each(|(number, why)| reasons.entry(*why).or_default().push(number.to_string()));
    let line = |(why, numbers): (LeftOut, Vec<String>)| {
        let words = if numbers.len() == 1 { "word" } else { "words" };
        format!("left out of the hyperbolic set, as {}: {words} {}", why_left_out(why), numbers.join(", "))
    };
    reasons.into_iter().map(line).collect()
}

/// Returns the lines on the scene's own orbit: its attractor, and its entry into the region of the horseshoe, as far as proved.
fn asymptotics(document: &ChaosDocument) -> Vec<String> {
    let mut lines = Vec::new();
    let scene_orbit = document.scene_orbit.as_ref();
    let attracted = scene_orbit.and_then(|orbit| orbit.attracted.as_ref());
    if let Some(period) = attracted {
        let (impacts, cycles) = (counted(period.impacts, "impact"), counted(period.cycles, "cycle"));
        let beside = if document.certified {
            ";\n  it does not tend to the horseshoe, only transients can visit it"
        } else {
            ""
        };
        lines.push(format!(
            "proved: the scene's own orbit converges to a stable periodic orbit of {impacts} in {cycles}{beside}"
        ));
    }
    if !document.certified {
        return lines;
    }
    lines.push(match scene_orbit.and_then(|orbit| orbit.region.as_ref()) {
        Some(region) if region.holds_bases => format!(
            "proved: the horseshoe lies in a region of {} boxes in which the scene's own orbit stays from impact {} on",
            region.boxes, region.entered_at_impact
        ),
        Some(region) => format!(
            "undecided whether the horseshoe lies in the region of {} boxes in which the scene's own orbit stays",
            region.boxes
        ),
        None if attracted.is_none() => "undecided whether the scene's own orbit visits the horseshoe".to_owned(),
        None => return lines,
    });
    lines
}

/// The last line.
pub fn conclusion(document: &ChaosDocument, found: &Chaos) -> Status {
    let stopped = if document.interrupted { "interrupted: " } else { "" };
    let is_complete = document.certified && !document.interrupted && document.hyperbolic != Some(None);
    let status = |words: String| Status::new(is_complete, words);
    if document.certified {
        let [impact, cycle] = [&document.entropy.per_impact, &document.entropy.per_cycle].map(|entropy| entropy.text());
        return status(format!(
            "{stopped}certified: the impact map holds a horseshoe; its topological entropy is at least {impact} per impact, {cycle} per forcing period"
        ));
    }
    let is_searched = !document.interrupted && found.bases().is_empty();
    if is_searched && document.exponent_seen.is_some_and(|exponent| exponent < 1e-3) {
        let regular = "the floating-point orbit is regular, and its transients show no horseshoe; there may be one";
        return status(format!("undecided: {regular}"));
    }
    let status = status(format!("{stopped}undecided: no horseshoe is proved"));
    match (document.interrupted, document.over.is_some()) {
        // It was not the settings that ended the search.
        (true, _) => status,
        (false, true) => status.say("; try ").step(Step::Narrower("over")),
        (false, false) => status.say("; try ").step(Step::More("depth")),
    }
}

/// The stretches of a range, a line each.
pub fn stretches(document: &ChaosCellsDocument) -> Result<String, fmt::Error> {
    let mut out = String::new();
    writeln!(out, "over {} from {} to {}\n", document.over.key, document.over.low.0, document.over.high.0)?;
    writeln!(out, "{:>12} {:>12}  verdict", "from", "to")?;
    for stretch in &document.stretches {
        let [low, high] = [&stretch.low, &stretch.high].map(|end| end.0.text());
        let entropy = stretch.entropy.as_ref().map(|entropy| {
            let [impact, cycle] = [&entropy.per_impact, &entropy.per_cycle].map(|entropy| entropy.text());
            format!("entropy at least {impact} per impact, {cycle} per forcing period")
        });
        let period = stretch
            .period
            .as_ref()
            .map(|period| format!("{} in {}", counted(period.impacts, "impact"), counted(period.cycles, "cycle")));
        let what = match (period, entropy) {
            (Some(period), Some(entropy)) => format!("{period}, beside a horseshoe: {entropy}"),
            (one, other) => one.or(other).unwrap_or_default(),
        };
        writeln!(out, "{}", format!("{low:>12} {high:>12}  {:10} {what}", stretch.verdict).trim_end())?;
    }
    writeln!(out, "\n{}", shares(document))?;
    Ok(out)
}

/// Returns the part of the range that is proved, in words.
pub fn shares(document: &ChaosCellsDocument) -> String {
    let SharesDocument { horseshoe, attracted, stable, both, undecided } = &document.shares;
    // In hundredths of a percent, rounded as the shares are, which are millionths.
    let percent = |parts: f64| format!("{:.2} %", parts / 100.0);
    let proved = |share: &f64| percent(((share * 1e6).round() / 100.0).floor());
    let open = |share: &f64| percent(((share * 1e6).round() / 100.0).ceil());
    let said = if document.certified { "certified" } else { "not all certified" };
    let stopped = if document.interrupted { "interrupted: " } else { "" };
    let other = if *stable > 0.0 {
        format!(", over {} a stable periodic orbit exists that it is not proved to converge to", proved(stable))
    } else {
        String::new()
    };
    format!(
        "{stopped}{said}: over {} of the range the scene's own orbit is attracted{other}, {} are proved to hold a horseshoe ({} both), {} undecided",
        proved(attracted),
        proved(horseshoe),
        proved(both),
        open(undecided)
    )
}
