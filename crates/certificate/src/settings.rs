//! Keys of documents that claim nothing: the request, the method, words about undecided results.
//!
//! A value at any other key that is not checked is a claim that a reader may take for proved: the first line of `check` names it.

/// Paths without positions in lists, each with everything below it.
const SETTINGS: [&str; 41] = [
    // The request. Of the scene: data on which no claim of the document depends.
    "scene",
    "title",
    "over",
    "digits",
    "impacts",
    "transient",
    "summary",
    "shard",
    "depth",
    "horseshoes",
    "work",
    "most",
    "halvings",
    "cells",
    "boxes",
    "schema",
    // Method, resolution, and whether all requested results are there. `excludes` narrows `exhaustive`.
    "program",
    "arithmetic",
    "certified",
    "excludes",
    "interrupted",
    "limited",
    "searched_impacts",
    "hyperbolic.cells",
    "basins.boxes",
    "components.boxes",
    "points.components.boxes",
    "points.bits",
    "points.seconds",
    // The start that all points have in common is given at each point as well.
    "claim",
    // Undecided results, and the reasons.
    "undecided",
    "not_examined",
    "left_out",
    "exponent_seen",
    "outcome.reason",
    "outcome.wall",
    "outcome.time[1]",
    "components.reason",
    "windows.reason",
    "points.reason",
    "points.components.reason",
];

/// Whether a path, or a path without positions in lists, leads to a value that claims nothing.
pub(super) fn is_setting(path: &str) -> bool {
    // The cells into which a tile is cut have the keys of the tile.
    let of_tile = path.replace("quarters.", "");
    SETTINGS.iter().any(|setting| {
        of_tile.strip_prefix(setting).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_below_a_setting_is_one() {
        for path in ["scene.start.time", "over[0]", "points.quarters.quarters.seconds", "outcome.time[1]", "boxes"] {
            assert!(is_setting(path), "{path}");
        }
        for path in ["exhaustive", "points.exponent", "outcome.time", "components.area", "boxes_seen", "orbits.unique"]
        {
            assert!(!is_setting(path), "{path}");
        }
    }
}
