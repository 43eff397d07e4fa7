//! Check of the claims of a document about a hyperbolic set (Lemma V14): cones, strings and rates are proved in intervals of doubles, with the strips
//! that the document has for them.

mod powers;
mod prove;
mod rates;
mod sides;
mod strings;
mod strip;

use impact_pair_document::{ConesWitness, Decimal, HyperbolicDocument, RatesDocument};
use impact_pair_exact::Dyadic;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::Law;
use super::allowance::{Allowance, End};
use super::bases::HSet;
use super::guess::Guess;
use super::span::Span;
use super::words::Word;
use crate::check::blocks::in_blocks;
use crate::check::contact::Doubt;
use powers::logarithm;
use prove::{Proved, heights, lead_back};
use rates::{Edge, Graph};
use strings::{Step, Strings};
pub(super) use strip::Frame;
use strip::{Branch, Map, double};

/// The claims: bounds as doubles within those of the document.
struct Claimed {
    kappa: f64,
    entropy: [[f64; 2]; 2],
    exponents: [[f64; 2]; 2],
    second: [f64; 2],
    dimension: [f64; 2],
}

/// Doubles that are no wider than given bounds.
fn inner([low, high]: &[Decimal; 2]) -> [f64; 2] {
    let double = |x: BigRational, is_low: bool| {
        let Some(near) = x.to_f64().filter(|near| near.is_finite()) else { return f64::NAN };
        let exact = |x: f64| Dyadic::from_f64(x).and_then(|_| BigRational::from_float(x));
        let is_inside = exact(near).is_some_and(|near| if is_low { near >= x } else { near <= x });
        // V14: a double further inside
        if is_inside {
            near
        } else if is_low {
            near.next_up()
        } else {
            near.next_down()
        }
    };
    [double(low.value(), true), double(high.value(), false)]
}

fn rates(RatesDocument { per_impact, per_cycle }: &RatesDocument) -> [[f64; 2]; 2] {
    [inner(per_impact), inner(per_cycle)]
}

fn open(what: &str) -> Doubt {
    Doubt::Open(format!("hyperbolic.{what}"))
}

/// Returns the doubt that is left of what is said of a hyperbolic set of listed words, if any is.
pub(super) fn doubt(
    law: &Law,
    (bases, words): (&[HSet], &[Word]),
    (set, witness): (&HyperbolicDocument, Option<&ConesWitness>),
    work: &Allowance,
) -> Result<Option<Doubt>, End> {
    let numbers: Vec<usize> = set.words.iter().map(|&number| number as usize).collect(); // exact: of 32 bits
    let listed: Option<Vec<&Word>> = numbers.iter().map(|&number| words.get(number)).collect();
    let is_increasing = set.words.windows(2).all(|pair| pair[0] < pair[1]);
    let Some(listed) = listed.filter(|_| is_increasing && !set.words.is_empty()) else {
        return Ok(Some(Doubt::False("hyperbolic.words are not different ones of the words".to_owned())));
    };
    if !lead_back(&listed.iter().map(|word| [word.from, word.to]).collect::<Vec<_>>(), bases.len()) {
        return Ok(Some(Doubt::False("hyperbolic.words do not lead back to each other".to_owned())));
    }
    // V14: cones are proved of a slope that is a double
    let [kappa, same] = inner(&[set.kappa.clone(), set.kappa.clone()]);
    if kappa != same {
        return Ok(Some(open("kappa is no double, and nothing is proved of cones of such a slope")));
    }
    let Some(witness) = witness else { return Ok(Some(Doubt::open("hyperbolic: no witness"))) };
    if witness.words.len() != listed.len() {
        let message = format!("hyperbolic: its witness has {} words for {}", witness.words.len(), listed.len());
        return Ok(Some(Doubt::Open(message)));
    }
    let claimed = Claimed {
        kappa,
        entropy: rates(&set.entropy),
        exponents: rates(&set.exponents),
        second: inner(&set.second_exponent),
        dimension: inner(&set.dimension),
    };
    let frames: Vec<Frame> = bases.iter().map(Frame::of).collect();
    let apart =
        |k: usize| (0..k).all(|other| (-8..=8).all(|turns| frames[k].is_apart(&frames[other], f64::from(turns))));
    if !(0..frames.len()).all(|k| frames[k].is_near() && frames[k].is_apart(&frames[k], 1.0) && apart(k)) {
        let message = "words: the h-sets as parallelograms are not proved to be disjoint, with positive speeds";
        return Ok(Some(open(message)));
    }
    let map = Map { law, guess: &Guess::new(law), frames: &frames, work };
    let mut branches: Vec<Branch> = Vec::new();
    for ((word, document), number) in listed.iter().zip(&witness.words).zip(&numbers) {
        let is_free = |branch: &Branch| {
            let mut others = branches.iter().filter(|other| other.from == branch.from);
            branch.strip.is_sound() && others.all(|other| branch.strip.is_apart(&other.strip))
        };
        let Some(branch) = Branch::read(word, document).filter(is_free) else { return Ok(Some(unproved(*number))) };
        branches.push(branch);
    }
    if let Some(doubt) = entropy(&branches, &claimed) {
        return Ok(Some(doubt));
    }
    let prove = |word: usize| {
        let branch = branches[word].clone();
        Ok(map.prove(&branch, kappa)?.map(|images| Proved { branch, images }))
    };
    let all = in_blocks(0..branches.len(), 1, |range| range.map(prove).collect(), |_| {})?;
    if let Some(lost) = all.iter().position(Option::is_none) {
        return Ok(Some(unproved(numbers[lost])));
    }
    measured(&map, &all.into_iter().flatten().collect::<Vec<_>>(), witness, &claimed)
}

fn unproved(number: usize) -> Doubt {
    open(&format!("words: words[{number}] is not proved to expand cones of slope kappa"))
}

/// Refutes or leaves undecided that the growth of the words is between the bounds of the entropy; `None` if it is proved.
fn entropy(words: &[Branch], claimed: &Claimed) -> Option<Doubt> {
    let graph = |weight: &dyn Fn(&Branch) -> f64| {
        let edge = |branch: &Branch| {
            let length = weight(branch);
            Edge { from: branch.from, to: branch.to, weight: Span::point(length), length }
        };
        Graph::new(words.iter().map(edge))
    };
    // exact: lengths, and halves of integers of a word
    let graphs = [graph(&|word| word.flights.len() as f64), graph(&|word| 0.5 * word.half_cycles as f64)];
    let is_root = |(graph, [low, high]): (&Graph, [f64; 2])| graph.is_root(low, false) && graph.is_root(high, true);
    let names = ["entropy.per_impact", "entropy.per_cycle"];
    let wrong = (0..2).find(|&k| !is_root((&graphs[k], claimed.entropy[k])))?;
    Some(open(&format!("{} does not follow from the words", names[wrong])))
}

/// The claims that are left open by the graphs of strings.
fn measured(map: &Map<'_>, all: &[Proved], witness: &ConesWitness, claimed: &Claimed) -> Result<Option<Doubt>, End> {
    let Some(twice) = restitution(map.law).map(|log| log.scaled(2.0)) else { return Ok(Some(open("exponents"))) };
    let counting = counting(map, all, witness)?;
    let is_same = all.len() == counting.len();
    let [least, most] = [0, 1].map(|end| {
        let unstable = double(&witness.unstable[end])?;
        let stable = Span::point(claimed.dimension[end]) - Span::point(unstable);
        // V14: at least what is left of the lower bound, at most what is left of the upper one
        Some([unstable, if end == 0 { stable.hi() } else { stable.lo() }])
    });
    let [mut exponents, mut second, mut upper, mut lower] = [false, false, false, claimed.dimension[0] <= 0.0]; // V14: no dimension is negative
    let mut visit = |graph: &[Step]| {
        let (by_impacts, by_cycles, stable) = graphs(all, graph, twice);
        let is_between =
            |graph: &Graph, [low, high]: [f64; 2]| graph.is_ratio(low, true) && graph.is_ratio(high, false);
        let first = claimed.second.map(|rest| twice - Span::point(rest));
        exponents |= is_between(&by_impacts, claimed.exponents[0]) && is_between(&by_cycles, claimed.exponents[1]);
        second |= is_between(&by_impacts, [first[1].hi(), first[0].lo()]);
        upper |= is_sum(&by_impacts, &stable, most, true);
        lower |= is_same && is_sum(&by_impacts, &stable, least, false);
        exponents && second && upper && (lower || !is_same)
    };
    let [letters, counting_letters] = witness.letters;
    Strings { map, words: all, kappa: claimed.kappa }.measure(letters, &mut visit)?;
    let ways: Vec<[usize; 2]> = counting.iter().map(|word| [word.branch.from, word.branch.to]).collect();
    if !lower && !is_same && lead_back(&ways, map.frames.len()) {
        let mut visit = |graph: &[Step]| {
            let (by_impacts, _, stable) = graphs(&counting, graph, twice);
            lower |= is_sum(&by_impacts, &stable, least, false);
            lower
        };
        Strings { map, words: &counting, kappa: claimed.kappa }.measure(counting_letters, &mut visit)?;
    }
    let known = [(exponents, "exponents"), (second, "second_exponent"), (upper && lower, "dimension")];
    Ok(known.iter().find(|(is, _)| !is).map(|(_, name)| open(&format!("{name}: the bounds are not proved again"))))
}

/// The words that count for the lower bound of the dimension by the witness, as far as they are proved to be alone.
fn counting(map: &Map<'_>, all: &[Proved], witness: &ConesWitness) -> Result<Vec<Proved>, End> {
    let heights = heights(all, map.frames.len());
    let mut counting = Vec::new();
    for (word, document) in all.iter().zip(&witness.words) {
        if document.counts && map.is_alone(word, all, &heights)? {
            counting.push(word.clone());
        }
    }
    Ok(counting)
}

/// Returns whether the dimensions along the expanding and the contracting direction are proved to be at most two numbers, or at least.
fn is_sum(unstable: &Graph, stable: &Graph, parts: Option<[f64; 2]>, is_at_most: bool) -> bool {
    parts.is_some_and(|[one, other]| unstable.is_root(one, is_at_most) && stable.is_root(other, is_at_most))
}

/// Encloses `ln e`.
fn restitution(law: &Law) -> Option<Span> {
    let e = law.restitution;
    Some(logarithm(e.lo())?.hull(logarithm(e.hi())?))
}

/// The graph of strings by impacts and by forcing periods, and that of what contracts.
fn graphs(words: &[Proved], graph: &[Step], twice: Span) -> (Graph, Graph, Graph) {
    // exact: a half
    let cycles = |word: usize| 0.5 * words[word].branch.half_cycles as f64;
    let stable = |edge: &Edge| Edge { weight: edge.weight - twice * Span::point(edge.length), ..*edge };
    (
        Graph::new(graph.iter().map(|(edge, _)| *edge)),
        Graph::new(graph.iter().map(|(edge, word)| Edge { length: cycles(*word), ..*edge })),
        Graph::new(graph.iter().map(|(edge, _)| stable(edge))),
    )
}
