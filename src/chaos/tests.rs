//! Images against certified first contacts of single flights, corrupted proofs, and entropies that are known.

use std::ops::ControlFlow;

use proptest::prelude::*;

use super::entropy::entropy;
use super::flights::Flights;
use super::guess::Guess;
use super::law::{Law, Side};
use super::propose::{Making, Proposal};
use super::quad::{Chord, Quad, State};
use super::refusal::NoTrap;
use super::trap::{Grid, Region};
use super::tube::{BoxChain, Part, proved_stretches};
use super::words::{HSet, Path, Search};
use super::{Asymptotics, Cells, Chaos, Entered, Horseshoe, HorseshoeSettings, RangeSettings, Trap, Verdict};
use crate::contact::{self, Margins, Radii, first_contact};
use crate::flight::Flight;
use crate::number::{Ball, Number, kernel::sin_cos};
use crate::orbit::{Orbit, Outcome, Progress, Settings};
use crate::pair::{Reduced, Wall};
use crate::scene::Key;
use crate::watch::{Stage, Unwatched, proceed_if};
use crate::{Effort, Scene};

const MAKING: Making = Making { longest: 0.01, margin: 1.08, pad: 2e-5, shortest: 1e-6, ahead: 4 };

/// `D` and `e` of figures 14, 17 and 16.
fn laws() -> [Law; 3] {
    let law = |gap: f64, restitution: f64| Law { gap: Ball::exact(gap), restitution: Ball::exact(restitution) };
    [law(1.178125, 0.5), law(1.0, 0.8), law(0.1, 0.8)]
}

fn figure_14() -> Law {
    Law { gap: Ball::new(9.42497 / 8.0, 1e-15), restitution: Ball::exact(0.5) }
}

fn bases() -> [HSet; 3] {
    [
        HSet::new([0.778431, 1.234518], [0.02877, 0.082], [-0.0002976, 0.002596]),
        HSet::new([0.779603, 1.224294], [0.028826, 0.081513], [-0.0001488, 0.001298]),
        HSet::new([0.780161, 1.219425], [0.028649, 0.083055], [-0.0001116, 0.000974]),
    ]
}

/// The next impact of the flight from one state by the closed form of [`crate::contact`]: another route, certified.
pub(super) fn truth(law: &Law, [phase, speed]: State) -> Option<(Side, [Ball; 2])> {
    let alpha = Ball::exact(1.0).checked_div(law.gap).unwrap();
    let pair = Reduced::new(alpha, law.restitution);
    let beta = pair.beta;
    let after = law.restitution * beta * Ball::exact(speed);
    let flight = Flight::from_wall(&pair.centre(), Wall::Left, phase, after.mid(), sin_cos(phase));
    let radii = Radii { velocity: after.rad(), ..Radii::default() };
    let contact::Verdict::Certified(contact) = first_contact(&flight, &Margins::new(&pair), radii) else { return None };
    let arrival = contact.phase + Ball::exact(contact.turns);
    Some(match contact.wall {
        Wall::Left => (Side::Near, [arrival, (-contact.velocity).checked_div(beta)?]),
        Wall::Right => (Side::Far, [arrival + Ball::exact(0.5), contact.velocity.checked_div(beta)?]),
    })
}

/// Whether two enclosures of one number have a member in common, up to rounding.
pub(super) fn meet(a: Ball, b: Ball) -> bool {
    (a.mid() - b.mid()).abs() <= a.rad() + b.rad() + 1e-15
}

proptest! {
    /// Lemmas D1-D3, D12: whatever lands, lands in the image, in all directions, for all members of `D` and `e`.
    #[test]
    fn images_hold_those_of_their_members(
        law in prop::sample::select(laws().to_vec()),
        radii in (prop_oneof![Just(0.0), 1e-7..1e-3f64], prop_oneof![Just(0.0), 1e-7..1e-3f64]),
        (gap, restitution) in (prop_oneof![Just(-1.0), Just(1.0), -1.0..=1.0f64], prop_oneof![Just(-1.0), Just(1.0), -1.0..=1.0f64]), phase in 0.0..1.0f64, speed in 0.02..1.6f64,
        size in prop_oneof![Just(1e-6), Just(1e-4), 1e-3..1e-2f64], turned in 0.0..1.0f64, thin in 0.001..1.0f64,
        (a, b) in (-1.0..=1.0f64, -1.0..=1.0f64), skew in -0.5..0.5f64, corner in any::<bool>(),
    ) {
        let (sin, cos) = sin_cos(turned);
        let chord = |end: f64| {
            let half = 0.2 * size * thin * (1.0 + skew * end);
            let at = |sign: f64| [phase + size * end * cos - sign * half * sin, speed + size * end * sin + sign * half * cos];
            Chord { bottom: at(-1.0), top: at(1.0) }
        };
        let (from, to) = (chord(-1.0), chord(1.0));
        let quad = Quad::between(&from, &to);
        let (a, b): (f64, f64) = if corner { (a.signum(), b.signum()) } else { (a, b) };
        let mix = |i: usize| 0.25 * ((1.0 - a) * ((1.0 - b) * from.bottom[i] + (1.0 + b) * from.top[i])
            + (1.0 + a) * ((1.0 - b) * to.bottom[i] + (1.0 + b) * to.top[i]));
        let member = [mix(0), mix(1)];
        let within = |x: Ball, radius: f64, part: f64| Ball::exact(x.mid() + part * radius * (1.0 - 1e-9));
        let one = Law { gap: within(law.gap, radii.0, gap), restitution: within(law.restitution, radii.1, restitution) };
        let law = Law { gap: law.gap.widened(radii.0), restitution: law.restitution.widened(radii.1) };
        let guess = Guess::new(&law);
        let landed = guess.map(quad.centre).and_then(|image| {
            let arrival = image.state[0] - image.side.shift();
            Some((image.side, Flights::new(&law, &quad).land(image.side, arrival)?))
        });
        if let (Some((side, landing)), Some((true_side, [u, w]))) = (landed, truth(&one, member)) {
            prop_assert_eq!(side, true_side);
            let (zero, one) = (Ball::exact(0.0), Ball::exact(1.0));
            let turned = [Ball::exact(cos), Ball::exact(sin)];
            for normal in [[one, zero], [zero, one], turned, [-turned[1], turned[0]]] {
                let found = landing.along(normal, [zero, zero]);
                let expected = normal[0] * u + normal[1] * w;
                prop_assert!(meet(found, expected), "{found:?} {expected:?}");
            }
        }
    }

    /// Lemma D4: the boxes hold where the flights from a box land.
    #[test]
    fn boxes_hold_the_images_of_their_members(
        law in prop::sample::select(laws().to_vec()), column in 0..512i32, row in prop_oneof![Just(0), 0..90i32],
        (a, b) in (0.0..=1.0f64, 0.0..=1.0f64),
    ) {
        let grid = Grid { columns: 512, rows: 64.0 };
        let mut found = std::collections::HashSet::new();
        let mut note = |side, cell| _ = found.insert((side, cell));
        if let Ok(reach) = grid.image(&law, &grid.quad((column, row)), &mut note) {
            let member = [(f64::from(column) + a) / 512.0, (f64::from(row) + b) / 64.0];
            if let Some((side, [u, w])) = truth(&law, member) {
                let near = |x: f64| found.contains(&(side, grid.cell(u.mid() + x, w.mid())));
                prop_assert!(near(0.0) || near(1e-12) || near(-1e-12), "{member:?} {u:?} {w:?}");
                prop_assert!(reach.time[0] > 0.0);
            }
        }
    }
}

/// Lemma D5: no box of the region can be left out where the orbit is.
#[test]
fn a_region_is_closed_and_one_with_a_hole_is_not() {
    let law = figure_14();
    let grid = Grid { columns: 256, rows: 32.0 };
    let region = Region::grow(&law, grid, grid.cell(0.778, 1.2345), &Unwatched).unwrap();
    let images = |hole: Option<(i32, i32)>| {
        let mut found = std::collections::HashSet::new();
        for &cell in region.cells.keys().filter(|&&cell| Some(cell) != hole) {
            grid.image(&law, &grid.quad(cell), &mut |_, cell| _ = found.insert(cell)).unwrap();
        }
        found.iter().all(|cell| region.cells.contains_key(cell) && Some(*cell) != hole)
    };
    assert!(images(None));
    let guess = Guess::new(&law);
    let mut state = [0.778, 1.2345];
    for _ in 0..300 {
        state = guess.map(state).unwrap().state;
        let cell = grid.cell(state[0], state[1]);
        assert!(region.cells.contains_key(&cell), "{state:?}");
    }
    assert!(!images(Some(grid.cell(state[0], state[1]))));
    // A ball that is hardly thrown on a pressed wall comes to rest.
    assert!(Region::grow(&law, grid, grid.cell(0.6, 0.001), &Unwatched).is_err());
}

/// Lemma D4: boxes beyond the last row that is counted are refused, none of them is taken for that row.
#[test]
fn boxes_beyond_the_last_row_are_refused() {
    let [coarse, fine] = [32.0, 2_f64.powi(40)].map(|rows| Grid { columns: 256, rows });
    let quad = coarse.quad(coarse.cell(0.778, 1.2345));
    let mut noted = 0;
    let mut note = |_, _| noted += 1;
    assert!(coarse.image(&figure_14(), &quad, &mut note).is_ok());
    let before = std::mem::take(&mut noted);
    let mut note = |_, _| noted += 1;
    assert_eq!(fine.image(&figure_14(), &quad, &mut note).err(), Some(NoTrap::Fast));
    assert_eq!((before > 0, noted), (true, 0));
}

fn words(law: &Law, bases: &[HSet], depth: usize) -> Vec<Path> {
    let mut search = Search::new(law, bases, MAKING);
    (0..depth).for_each(|_| assert!(search.deepen(&Unwatched)));
    search.words
}

fn by_impact(words: &[Path], bases: usize) -> f64 {
    entropy(words, bases, |word| word.sides.len() as i64)
}

/// Figure 14, as an independent program found: 6 words of at most 3 impacts, entropy 0.2812 an impact, ln 2 a cycle.
#[test]
fn the_shortest_horseshoe_of_figure_14() {
    let words = words(&figure_14(), &bases(), 3);
    assert_eq!(words.len(), 6);
    let cycle = 2.0 * entropy(&words, 3, |word| word.half_turns);
    // A cycle takes 2 or 3 impacts: 1 = x^2 + x^3, the inverse of the plastic number.
    let expected = 0.281_199_574_322_961_8;
    assert!(by_impact(&words, 3) <= expected && by_impact(&words, 3) > expected - 1e-9, "{}", by_impact(&words, 3));
    assert!(cycle <= std::f64::consts::LN_2 && cycle > std::f64::consts::LN_2 - 1e-9);
}

/// An h-set that is moved across the leaves, or rotated, is crossed no more.
#[test]
fn moved_h_sets_give_less_entropy() {
    let entropy_of = |change: &dyn Fn(HSet) -> HSet| by_impact(&words(&figure_14(), &bases().map(change), 3), 3);
    let moved = |by: f64| {
        move |base: HSet| {
            let moved = |[u, w]: State| [u, w + by];
            let chord = |chord: Chord| Chord { bottom: moved(chord.bottom), top: moved(chord.top) };
            HSet { left: chord(base.left), right: chord(base.right) }
        }
    };
    assert!(entropy_of(&moved(0.0)) > 0.28);
    assert_eq!(entropy_of(&moved(0.02)), 0.0);
    assert_eq!(entropy_of(&moved(-0.02)), 0.0);
}

/// Cell chains that are right for one pair are wrong for another, and with a cell left out.
#[test]
fn corrupted_chains_of_boxes_are_refused() {
    let law = figure_14();
    let guess = Guess::new(&law);
    let base = bases()[0];
    let tube = BoxChain::between(base.left, base.right);
    let other = Law { gap: law.gap * Ball::exact(1.01), ..law };
    let proposals = MAKING.images(&guess, &tube);
    let Proposal { parts, side, next } = proposals.iter().find(|proposal| proposal.side == Side::Far).unwrap();
    let proved = |law: &Law, next: &BoxChain| {
        parts.iter().filter(|part| tube.is_mapped(law, &Guess::new(law), part, *side, next)).count()
    };
    let chain = |chords: Vec<Chord>| BoxChain::new(chords.clone(), vec![0.0; chords.len()]);
    let all = proved(&law, next);
    assert!(all > parts.len() * 9 / 10, "{all} of {}", parts.len());
    assert_eq!(proved(&other, next), 0);
    // Without a stretch in the middle parts behind it are not where they are said to be.
    let (half, chords) = (next.chords().len() / 2, next.chords());
    let gap: Vec<Chord> = chords[..half].iter().chain(&chords[half + 8..]).copied().collect();
    assert!(proved(&law, &chain(gap)) < all * 6 / 10);
    // As thick as a leaf away.
    let moved = |[u, w]: State| [u, w + 0.004];
    let away = chords.iter().map(|chord| Chord { bottom: moved(chord.bottom), top: moved(chord.top) }).collect();
    assert!(proved(&law, &chain(away)) < all / 10);
}

/// Renewal equations with known roots.
#[test]
fn entropies_that_are_known() {
    let word = |from: usize, to: usize, impacts: usize| Path {
        from,
        to,
        sides: vec![Side::Far; impacts],
        half_turns: 1,
        ends: [Vec::new(), Vec::new()],
    };
    let golden = (0.5 * (1.0 + 5f64.sqrt())).ln();
    let cases: [(Vec<Path>, usize, f64); 5] = [
        (vec![word(0, 0, 1), word(0, 0, 1)], 1, std::f64::consts::LN_2),
        (vec![word(0, 0, 1), word(0, 0, 2)], 1, golden),
        (vec![word(0, 0, 1), word(0, 1, 1), word(1, 0, 1)], 2, golden),
        (vec![word(0, 0, 3)], 1, 0.0),
        (vec![word(0, 1, 1)], 2, 0.0),
    ];
    for (words, bases, expected) in cases {
        let found = by_impact(&words, bases);
        assert!(found <= expected && expected - found < 1e-9, "{found} {expected}");
    }
    assert_eq!(entropy(&[word(0, 0, 1)], 1, |_| 0), 0.0);
}

#[test]
fn overlapping_h_sets_are_reported() {
    let [a, b, c] = bases();
    assert!(a.is_convex() && a.is_apart(&b) && b.is_apart(&c) && !a.is_apart(&a));
    let later = HSet::new([1.778431, 1.234518], [0.02877, 0.082], [-0.0002976, 0.002596]);
    assert!(!a.is_apart(&later) && b.is_apart(&later));
    assert!(!HSet { left: a.right, right: a.left }.is_convex());
}

fn scene(amplitude: &str) -> Scene {
    crate::tests::scene("figure-14").with(&[(Key::Amplitude(None), amplitude.parse().unwrap())]).unwrap()
}

/// Lemma D12: one horseshoe for all gaps within a part in 10^4, as an independent trial found with these h-sets.
#[test]
fn the_shortest_horseshoe_holds_for_an_interval_of_gaps() {
    for part in [1e-6, 1e-5, 1e-4] {
        let law = figure_14();
        let law = Law { gap: law.gap.widened(part * law.gap.mid()), ..law };
        let chaos = Chaos::proved(&law, bases().to_vec(), (3, u64::MAX), &Unwatched);
        assert!(chaos.entropy() > 0.281_199 && chaos.words().len() == 6, "{part} {}", chaos.entropy());
    }
}

/// Lemma D13: the scene's orbit and the h-sets are in one region; a displaced h-set is not.
#[test]
fn the_horseshoe_of_figure_14_is_where_the_orbit_is() {
    let question = HorseshoeSettings { depth: Some(3), bases: bases().to_vec(), ..HorseshoeSettings::default() };
    let chaos = Chaos::of_scene(&scene("8"), &question, &Unwatched).unwrap();
    let Asymptotics { attractor, region } = chaos.asymptotics();
    let trap = Trap::of(&scene("8"), Effort::default(), &Unwatched).unwrap().unwrap();
    assert!(attractor.is_none());
    assert_eq!(*region, Some(Entered { boxes: trap.boxes(), at_impact: 2, holds_bases: true }));
    assert!(bases().iter().all(|base| trap.holds(base)));
    assert!(!trap.holds(&HSet::new([0.5, 1.23], [0.03, 0.08], [-0.0003, 0.0026])));
    // One that is too long by far sticks out.
    assert!(!trap.holds(&HSet::new([0.778431, 1.234518], [0.3, 0.8], [-0.0003, 0.0026])));
}

/// A finer region that is not found, or not waited for, was passed over without a word.
#[test]
fn r52_a_region_that_is_coarser_than_requested_says_why() {
    let watch = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Region(2_000..)));
    let region = |effort: &str| Trap::of(&scene("8"), effort.parse().unwrap(), &watch).unwrap().unwrap();
    let [coarsest, stopped] = ["1.9", "16"].map(region);
    assert_eq!((coarsest.coarser(), stopped.coarser()), (None, Some(NoTrap::Interrupted)));
    assert_eq!(coarsest.grid(), stopped.grid());
    let finer = Trap::of(&scene("8"), "2".parse().unwrap(), &Unwatched).unwrap().unwrap();
    assert!(finer.coarser().is_none() && finer.grid().0 == 2 * coarsest.grid().0);
}

/// A = 8.4, where the diagram has a gap: the orbit converges to eight impacts in three cycles, and a horseshoe is beside it.
#[test]
fn a_saddle_is_distinguished_from_an_attractor() {
    let corners = [
        [[0.805_264_494_210_566_3, 1.297_437_476_872_194], [0.808_274_341_166_306_4, 1.271_623_566_663_777_4]],
        [[0.747_691_477_240_234_9, 1.126_724_932_061_096_4], [0.750_701_324_195_974_9, 1.100_911_021_852_679_9]],
    ];
    let [left, right] = corners.map(|[bottom, top]| Chord { bottom, top });
    let question =
        HorseshoeSettings { depth: Some(5), bases: vec![HSet { left, right }], ..HorseshoeSettings::default() };
    let chaos = Chaos::of_scene(&scene("8.4"), &question, &Unwatched).unwrap();
    let attractor = chaos.asymptotics().attractor.as_ref().unwrap();
    assert_eq!((attractor.word.mappings().len(), attractor.cycles), (8, 3));
    assert!(chaos.entropy() > 0.0 && chaos.asymptotics().region.is_none_or(|region| !region.holds_bases));
}

/// A = 0.498 d, where four impacts expand by half only: two words of 16 impacts in an h-set, so entropy (log 2)/16, and none of fewer. Only the
/// finest cell chain leads there, and none does in an h-set that is moved off the leaves.
#[test]
fn slow_expansion_is_proved_by_fine_chains_of_boxes() {
    let scene = Scene::parse(include_str!("../../validation/paper/scenes/chaos-0.498.toml")).unwrap();
    let law = Law::of(scene.pair()).unwrap();
    let base = |moved: f64| {
        let corners = [
            [[0.8768535695463056, 1.510478046875815], [0.8765226990068338, 1.509182114492489]],
            [[0.8708488438018199, 1.4978168596534225], [0.8700849022232074, 1.4956077809016395]],
        ];
        let [left, right] = corners.map(|chord| chord.map(|[u, w]| [u, w + moved]));
        let chord = |[bottom, top]: [State; 2]| Chord { bottom, top };
        HSet { left: chord(left), right: chord(right) }
    };
    let proved =
        |depth: usize, moved: f64| Chaos::proved(&law, vec![base(moved)], (depth, u64::MAX), &Unwatched).entropy();
    let expected = std::f64::consts::LN_2 / 16.0;
    assert!(proved(16, 0.0) <= expected && proved(16, 0.0) > expected - 1e-9);
    assert_eq!([proved(15, 0.0), proved(16, 0.01)], [0.0, 0.0]);
}

/// D9: a state of an h-set wider than a forcing period has two phases there, and would follow two words that are one.
#[test]
fn r32_a_base_wider_than_a_turn() {
    let chaos = |right: f64| {
        let edge = |phase: f64| Chord { bottom: [phase, 5.0], top: [phase, 5.1] };
        let question = HorseshoeSettings {
            depth: Some(1),
            bases: vec![HSet { left: edge(0.1), right: edge(right) }],
            ..HorseshoeSettings::default()
        };
        Chaos::of_scene(&scene("8"), &question, &|_: Stage<'_>| ControlFlow::Break(()))
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    assert!(chaos(1.05).is_ok());
    assert!(chaos(1.3).unwrap_err().contains("its own translate"));
}

/// D7, D9: parts that were used before, or lead backward, or leave some out, make no stretch more, whatever is proposed.
#[test]
fn r32_distinct_words_rest_on_parts_that_lie_apart() {
    let part = |cell: usize, [from, to]: [f64; 2], place: usize| Part { cell, from, to, place };
    let parts = [part(0, [-1.0, 0.5], 3), part(0, [0.5, 1.0], 4), part(1, [-1.0, 1.0], 5), part(2, [-1.0, 0.0], 5)];
    let mut used = None;
    assert_eq!(proved_stretches(&parts, &[true, true, false, true], &mut used), [0..=1, 3..=3]);
    assert!(proved_stretches(&parts, &[true; 4], &mut used).is_empty(), "the same parts again");
    let next = [part(2, [-0.5, 1.0], 7), part(3, [-1.0, 1.0], 7)];
    assert!(proved_stretches(&next, &[true; 2], &mut used).is_empty(), "a stretch that begins within the one before");
    assert_eq!(proved_stretches(&[part(2, [0.0, 1.0], 7)], &[true], &mut used), [0..=0]);
    // Backward within a cell, or beyond it: not mapped, though the same states forward are.
    let (law, guess) = (figure_14(), Guess::new(&figure_14()));
    let HSet { left, right } = bases()[0];
    let tube = BoxChain::between(left, right);
    let Proposal { parts, side, next } = MAKING.images(&guess, &tube).swap_remove(0);
    let good = parts[parts.len() / 2];
    let is_mapped = |part: Part| tube.is_mapped(&law, &guess, &part, side, &next);
    assert!(is_mapped(good) && !is_mapped(Part { from: good.to, to: good.from, ..good }));
}

/// As far as the makings are compared, the horseshoe found is as short as there is; deeper, the entropy is what counts.
#[test]
fn a_deeper_search_leads_further() {
    let chaos = |depth: usize| {
        Chaos::of_scene(
            &scene("8"),
            &HorseshoeSettings { depth: Some(depth), bases: bases().to_vec(), ..HorseshoeSettings::default() },
            &Unwatched,
        )
        .unwrap()
    };
    let shallow = chaos(8);
    assert_eq!(shallow.horseshoe().unwrap().map(|word| word.in_mappings()), ["P1 P2", "P1 P2 P4"]);
    assert!(shallow.entropy() > 0.438 && chaos(12).entropy() > 0.462);
}

fn cells(over: &str, cells: u32, halvings: u32) -> Cells {
    let requested = RangeSettings { over: over.parse().unwrap(), cells, halvings, depth: 5 };
    Cells::of(scene("8").pair(), scene("8").start(), &requested, &Unwatched).unwrap()
}

/// Lemma D14: stretches follow one another from end to end, and what is proved of all holds of some: of single values, proved by
/// themselves with the same h-sets, or by the orbit of each.
#[test]
fn verdicts_of_a_stretch_hold_for_its_values() {
    for (over, count, name) in [("amplitude=1..1.1", 2, "attracted"), ("amplitude=9.06..9.064", 1, "horseshoe")] {
        let found = cells(over, count, 6);
        let stretches = &found.stretches;
        assert!(stretches.iter().all(|stretch| stretch.verdict.kind().to_string() == name), "{over}");
        assert!(!found.interrupted && stretches.windows(2).all(|pair| pair[0].high.text() == pair[1].low.text()));
        let last = stretches.last().unwrap();
        let ends = [(&stretches[0].low, &stretches[0].verdict), (&last.high, &last.verdict)]
            .map(|(end, verdict)| (end.text(), verdict));
        assert_eq!(format!("amplitude={}..{}", ends[0].0, ends[1].0), over);
        for (value, verdict) in &ends {
            match verdict {
                Verdict::Horseshoe(Horseshoe { entropy, bases, .. }) => {
                    let law = Law::of(scene(value).pair()).unwrap();
                    let chaos = Chaos::proved(&law, bases.clone(), (5, u64::MAX), &Unwatched);
                    assert!(entropy[0] > 0.1 && chaos.entropy() >= 0.9 * entropy[0], "{value} {}", chaos.entropy());
                }
                Verdict::Attracted { word, cycles, .. } => {
                    let settings = Settings { impacts: Some(300), attractor: true, ..Settings::default() };
                    let mut orbit = Orbit::of(&scene(value), settings).unwrap();
                    while !matches!(orbit.advance(), Progress::Ended) {}
                    let Some(Outcome::Attracted(attractor)) = orbit.outcome() else { panic!("{value}") };
                    assert_eq!((attractor.word.mappings().len(), attractor.cycles), (word.mappings().len(), *cycles));
                }
                Verdict::Stable { .. } | Verdict::Undecided => unreachable!(),
            }
        }
    }
}

/// Nothing is certified of a cell that holds a value at which the orbit changes what it converges to.
#[test]
fn a_cell_across_a_bifurcation_is_undecided() {
    // The equispaced orbit of two impacts in a cycle is stable at A = 1 and not at A = 9.
    assert_eq!(cells("amplitude=1..9", 1, 0).stretches[0].verdict, Verdict::Undecided);
    let stopped = Cells::of(
        scene("8").pair(),
        scene("8").start(),
        &RangeSettings { over: "amplitude=1..2".parse().unwrap(), cells: 3, halvings: 2, depth: 3 },
        &|_: Stage<'_>| ControlFlow::Break(()),
    );
    let stopped = stopped.unwrap();
    assert!(stopped.interrupted && stopped.stretches.len() == 1 && stopped.stretches[0].verdict == Verdict::Undecided);
}
