use super::*;
use crate::scenes::scene_of as scene;
use impact_pair::json::{DescriptionDocument, FateName};
use impact_pair::watch::{Stage, Unwatched, proceed_if};

fn figure(amplitude: &str, gap: &str, restitution: &str) -> Scene {
    let excitation = format!("amplitude = {amplitude}, frequency = \"pi\", phase = 0");
    let pair = format!("gap = {gap}, restitution = {restitution}");
    scene(&excitation, &pair, "time = 0, wall = \"left\", velocity = -12.56636")
}

/// Description of a scene without a search for a horseshoe, which takes long.
fn described(scene: &Scene) -> DescriptionDocument {
    let watch = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Horseshoe { .. }));
    let request = DescribeOptions { impacts: 500, ..DescribeOptions::default() };
    describe(scene, &request, &watch).unwrap().document(scene, "scene.toml").unwrap()
}

/// Of the equispaced motion of (66)-(69) with these data both eigenvalues are `e^2`: the exponent tends to `ln e`.
#[test]
fn an_attracted_motion_has_its_exponent_in_the_limit_and_no_region() {
    let document = described(&figure("1", "\"3*pi\"", "0.5"));
    assert_eq!((document.fate.kind, document.fate.from.is_some()), (FateName::Attracted, true));
    let [low, high] = document.exponent.limit.unwrap().each_ref().map(|end| end.parse::<f64>().unwrap());
    assert!(low <= 0.5_f64.ln() && 0.5_f64.ln() <= high && high - low < 1e-3, "{low} {high}");
    assert!(document.region.is_none() && document.entropy.is_none() && document.undecided.is_empty());
    assert_eq!(document.not_examined.len(), 1);
    assert_eq!(document.proof.unwrap().outcome.orbit, document.fate.orbit);
}

/// With e = 0 and `sin th0 = 0` the next impact does not depend on the start, to first order: `dt1/dt0 = 0` in (A.7), and so for ever,
/// though the orbit that attracts the motion has an eigenvalue that is not 0.
#[test]
fn r39_without_restitution_the_exponent_in_the_limit_is_bounded_from_above_only() {
    let start = "time = 0.25, wall = \"left\", velocity = -12";
    let document =
        described(&scene("amplitude = 1, frequency = \"pi\", phase = 0", "gap = 3.2, restitution = 0", start));
    assert_eq!(document.fate.kind, FateName::Attracted);
    let limit = document.exponent.limit.unwrap();
    let [low, high] = &*limit;
    // Of (66), (67) with e = 0: 2 sin th0 + pi cos th0 = 3.2, and the eigenvalue is ((pi/2) tan th0)^2 in two impacts.
    let phase = 2.0_f64.atan2(std::f64::consts::PI) - (3.2 / 2.0_f64.hypot(std::f64::consts::PI)).acos();
    let truth = (std::f64::consts::FRAC_PI_2 * phase.tan()).ln();
    let high = high.parse::<f64>().unwrap();
    assert!(low == "-inf" && truth <= high + 1e-12 && high - truth < 1e-6, "{low} {high} {truth}");
}

/// The ball first sticks to its wall, and is released at a phase that does not depend on the start: all later derivatives are 0.
#[test]
fn r44_after_a_rest_the_exponent_in_the_limit_is_bounded_from_above_only() {
    let start = "time = 1.5, wall = \"left\", velocity = 0";
    let document =
        described(&scene("amplitude = 1, frequency = \"pi\", phase = 0", "gap = 3, restitution = 0.5", start));
    assert_eq!(document.fate.kind, FateName::Attracted);
    assert_eq!(*document.exponent.finite_time.unwrap(), ["-inf", "-inf"]);
    let limit = document.exponent.limit.unwrap();
    let [low, high] = &*limit;
    assert!(low == "-inf" && high.parse::<f64>().unwrap() < 0.0, "{low} {high}");
}

/// From `v+ = pi` at `th0 = pi/2`, with `A = 1` and `W = 2 pi`, the drift is `pi`: `y' = pi - 2 pi cos th` is 0 next at `th = 5 pi/3`, where the right
/// wall is touched if `d = 1 + sqrt(3)/2 + 7 pi/12` (11), (12). Of what starts nearby a part hits it and a part does not.
#[test]
fn r45_after_a_graze_there_is_no_exponent_in_the_limit() {
    let excitation = "amplitude = 1, frequency = \"2*pi\", phase = 0";
    let start = "time = 0.25, wall = \"left\", velocity = \"-2*pi\"";
    let exponent = |gap: &str| {
        let document = described(&scene(excitation, &format!("gap = \"{gap}\", restitution = 0.5"), start));
        assert_eq!(document.fate.kind, FateName::Attracted, "{gap}");
        (document.exponent.finite_time.is_some(), document.exponent.limit.is_some())
    };
    assert_eq!(exponent("1 + sqrt(3)/2 + 7*pi/12"), (false, false));
    assert_eq!(exponent("1.01 + sqrt(3)/2 + 7*pi/12"), (true, true));
}

/// Lemma Q3 holds for all data: so it does for all gaps of an interval.
#[test]
fn intervals_of_data_are_described_for_all_their_values() {
    let document = described(&figure("1", "\"[9.4249, 9.425]\"", "0.5"));
    assert_eq!(document.fate.kind, FateName::Attracted);
    assert!(document.scene.gap.0.text().contains("9.4249"));
}

/// `y + E` stays as it is where the ball starts with the velocity of the box, and the box moves less than the walls are away.
#[test]
fn a_ball_without_drift_never_touches_a_wall() {
    let inside = "time = 0, position = 0, velocity = \"-pi\"";
    let free = scene("amplitude = 1, frequency = \"pi\", phase = 0", "gap = 9, restitution = 0.5", inside);
    let document = described(&free);
    assert_eq!((document.fate.kind, document.fate.impacts), (FateName::NeverImpacts, 0));
    assert!(document.exponent.limit.is_none() && document.exponent.finite_time.is_none());
}

#[test]
fn a_ball_on_the_wall_of_a_box_that_stands_still_rests_for_ever() {
    for restitution in ["0", "0.5", "1"] {
        let pair = format!("gap = 9, restitution = {restitution}");
        let start = "time = 0, wall = \"right\", velocity = 0";
        let document = described(&scene("amplitude = 0, frequency = 1, phase = 0", &pair, start));
        assert_eq!(document.fate.kind, FateName::RestsForever, "{restitution}");
        assert_eq!(document.fate.message, "the ball rests on the right wall for ever");
    }
}

/// With `e = 0` each motion of one harmonic is periodic from a release on, if it rests.
#[test]
fn plastic_impacts_are_described_without_a_false_claim() {
    let plastic = described(&figure("1", "9.42497", "0"));
    assert!(matches!(plastic.fate.kind, FateName::Periodic | FateName::Attracted), "{:?}", plastic.fate);
}

/// Without an excitation a ball that bounces loses speed for ever: neither periodic nor at rest.
#[test]
fn without_an_excitation_region_and_horseshoe_are_not_examined() {
    let still = "time = 0, wall = \"left\", velocity = -1";
    let document = described(&scene("amplitude = 0, frequency = 1, phase = 0", "gap = 9, restitution = 0.5", still));
    assert_eq!(document.fate.kind, FateName::Undecided);
    let [orbit, region] = &document.not_examined[..] else { panic!("{:?}", document.not_examined) };
    assert!(region.question.contains("region"), "{region:?}");
    // Each flight takes twice as long as the one before: no number of impacts, and no precision, ends that.
    assert!(
        orbit.question.starts_with("what happens after impact 5") && orbit.reason.contains("too long"),
        "{orbit:?}"
    );
    assert!(document.undecided.is_empty(), "{:?}", document.undecided);
}

#[test]
fn several_harmonics_have_a_fate_but_no_region() {
    let excitation = "amplitude = [1, 0.1], frequency = [\"pi\", \"sqrt(2)*pi\"], phase = 0";
    let start = "time = 0, wall = \"left\", velocity = -12.56636";
    let document = described(&scene(excitation, "gap = 9.42497, restitution = 0.5", start));
    assert_eq!(document.fate.kind, FateName::Undecided);
    assert!(document.not_examined[1].reason.contains("2 harmonics"), "{:?}", document.not_examined);
    // Without a common period no orbit of impacts is periodic: more of them would not decide.
    assert!(document.undecided.is_empty() && document.not_examined[0].reason.contains("common period"));
}

/// The motion of figure 14 is in the region that `trap` proves, from the same impact on.
#[test]
fn a_motion_in_a_region_carries_what_trap_proves() {
    let scene = figure("8", "9.42497", "0.5");
    let document = described(&scene);
    let trap = Trap::of(&scene, Effort::default(), &Unwatched).unwrap().unwrap();
    assert_eq!((document.fate.kind, document.fate.from), (FateName::StaysInRegion, trap.entered()));
    assert_eq!(document.region, Some(trap.document(&scene).unwrap()));
    assert!(document.certified && document.interrupted && document.proof.is_none());
    assert!(document.undecided.iter().any(|open| open.command.starts_with("impact-pair chaos scene.toml")));
}

#[test]
fn a_check_stopped_at_once_is_undecided_and_says_so() {
    let scene = figure("1", "9.42497", "0.5");
    let found = describe(&scene, &DescribeOptions::default(), &|_: Stage<'_>| proceed_if(false)).unwrap();
    let document = found.document(&scene, "it's a scene.toml").unwrap();
    assert!(document.interrupted && !document.certified);
    assert_eq!(document.undecided[0].command, "impact-pair describe 'it'\\''s a scene.toml'");
}

#[test]
fn the_lines_are_those_of_the_document() {
    let document = described(&figure("1", "9.42497", "0.5"));
    let lines = lines(&document);
    assert_eq!(lines[0], ("fate", format!("certified: {}", document.fate.message)));
    assert!(lines.iter().all(|(label, text)| !label.is_empty() && !text.is_empty()) && lines.len() <= 10);
}

/// The command that goes on where a motion stays in a region leads further: it proves the convergence, where more impacts do.
#[test]
fn r62_more_impacts_are_the_next_step_of_a_motion_in_a_region() {
    let scene = Scene::parse(include_str!("../../../../scenes/figure-14-sink.toml")).unwrap();
    let describe = |impacts: u64| {
        let watch = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Horseshoe { .. }));
        let request = DescribeOptions { impacts, ..DescribeOptions::default() };
        describe(&scene, &request, &watch).unwrap().document(&scene, "scene.toml").unwrap()
    };
    let next = |document: &DescriptionDocument| document.undecided[0].command.clone();
    let few = describe(2);
    assert_eq!(
        (few.fate.kind, next(&few)),
        (FateName::StaysInRegion, "impact-pair describe scene.toml --impacts 20".into())
    );
    assert_eq!(describe(20).fate.kind, FateName::Attracted);
    let chaos = figure("8", "9.42497", "0.5");
    let watch = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Horseshoe { .. }));
    let found =
        super::describe(&chaos, &DescribeOptions { impacts: 100, ..DescribeOptions::default() }, &watch).unwrap();
    let found = Description { request: DescribeOptions { impacts: 20_000, ..found.request }, ..found };
    assert_eq!(next(&found.document(&chaos, "scene.toml").unwrap()), "impact-pair global scene.toml");
}

/// With e = 1 more impacts lead nowhere: areas are kept, so that no orbit attracts others, with shaking or without.
#[test]
fn i62_at_e_1_no_command_is_advised_for_convergence() {
    for amplitude in ["0", "1"] {
        let document = described(&figure(amplitude, "9.42497", "1"));
        assert_eq!((document.fate.kind, document.undecided.len()), (FateName::Undecided, 0), "{amplitude}");
        let [convergence, ..] = &document.not_examined[..] else { panic!("nothing is said of convergence") };
        assert!(convergence.question == "convergence to a periodic orbit" && convergence.reason.contains("e = 1"));
    }
}
