//! Statements of a JSON of a global analysis that no lemma of `check` covers.

use impact_pair_document::{ComponentDocument, GlobalDocument};
use impact_pair_model::vocabulary::{Class, ComponentKind};

use super::is_saddle_set;

/// Keys whose values are not checked, some keys several times. Lemmas V20, V27, V28, V37
pub(super) fn keys(document: &GlobalDocument, says_there_are_no_others: bool, has_grazing_motion: bool) -> Vec<String> {
    let components = &document.components;
    let any = |is_so: &dyn Fn(&ComponentDocument) -> bool| components.iter().any(is_so);
    let mut keys =
        ["program", "scene.excitation.phase", "scene.start", "boxes", "halvings", "order"].map(str::to_owned).to_vec();
    keys.extend(
        ["components.boxes", "components.area"].iter().filter(|_| !components.is_empty()).map(|key| (*key).to_owned()),
    );
    keys.extend(any(&|own| own.reason.is_some()).then(|| "components.reason".to_owned()));
    let has_basins = says_there_are_no_others && document.basins.is_some();
    keys.extend((!has_basins && document.basins.is_some()).then(|| "basins".to_owned()));
    keys.push(if has_basins { "basins.boxes" } else { "greatest_speed" }.to_owned());
    keys.extend((!any(&|own| own.orbit.is_some())).then(|| "scene.excitation.frequency".to_owned()));
    keys.extend(document.interrupted.then(|| "interrupted".to_owned()));
    // The claim that components are closed is not checked, nor its consequences.
    keys.extend(["class", "statement"].iter().filter(|_| document.class == Class::Closed).map(|key| (*key).to_owned()));
    // Without a claim that there are no other components, `closed` is not checked.
    let is_unbound = !says_there_are_no_others && !components.is_empty();
    keys.extend(is_unbound.then(|| "components.closed".to_owned()));
    for (i, own) in components.iter().enumerate() {
        let may_be_none = is_saddle_set(own) || own.kind == ComponentKind::Grazing && !has_grazing_motion;
        keys.extend((is_unbound && may_be_none).then(|| format!("components[{i}].kind")));
        let of_period = ["reduced_impacts", "spectral_radius"].into_iter().filter(|_| lacks_symmetry(own));
        keys.extend(of_period.map(|key| format!("components[{i}].{key}")));
    }
    // The sentence states whether there is a mirror image, and which component holds a horseshoe.
    let is_unsaid = |own: &ComponentDocument| lacks_symmetry(own) || own.horseshoe.is_some();
    keys.extend(any(&is_unsaid).then(|| "statement".to_owned()));
    keys
}

/// Whether the symmetry of a periodic motion is undecided in the document: then its period under the reduced map is not checked.
fn lacks_symmetry(own: &ComponentDocument) -> bool {
    own.orbit.as_ref().is_some_and(|orbit| orbit.symmetric.is_none())
}
