//! Check of the claims of a document about a hyperbolic set (Lemma V14): strips are sought anew, and cones, strings and rates proved in
//! intervals of doubles.

mod powers;
mod prove;
mod rates;
mod seek;
mod sides;
mod strings;
mod strip;

use impact_pair_document::{Decimal, HyperbolicDocument, RatesDocument};
use impact_pair_exact::Dyadic;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::Law;
use super::allowance::{Allowance, End};
use super::bases::HSet;
use super::guess::Guess;
use super::span::Span;
use super::words::Word;
use crate::check::contact::Doubt;
use powers::logarithm;
use prove::{Proved, heights, recurrent};
use rates::{Edge, Graph};
use seek::branches;
use strings::{Step, Strings};
pub(super) use strip::Frame;
use strip::{Branch, Map};

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

fn is_within([low, high]: [f64; 2], [least, most]: [f64; 2]) -> bool {
    least <= low && low <= high && high <= most
}

fn open(what: &str) -> Doubt {
    Doubt::Open(format!("hyperbolic.{what}"))
}

/// Returns the doubt that is left of what is said of a hyperbolic set of listed words, if any is.
pub(super) fn doubt(
    law: &Law,
    (bases, words): (&[HSet], &[Word]),
    set: &HyperbolicDocument,
    work: &Allowance,
) -> Result<Option<Doubt>, End> {
    let listed: Option<Vec<(usize, Word)>> = set
        .words
        .iter()
        .map(|&number| {
            let number = number as usize; // exact: of 32 bits
            words.get(number).map(|word| (number, word.clone()))
        })
        .collect();
    let is_increasing = set.words.windows(2).all(|pair| pair[0] < pair[1]);
    let Some(listed) = listed.filter(|_| is_increasing && !set.words.is_empty()) else {
        return Ok(Some(Doubt::False("hyperbolic.words are not different ones of the words".to_owned())));
    };
    // V14: cones are proved of a slope that is a double
    let [kappa, same] = inner(&[set.kappa.clone(), set.kappa.clone()]);
    if kappa != same {
        return Ok(Some(open("kappa is no double, and nothing is proved of cones of such a slope")));
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
    let guess = Guess::new(law);
    let map = Map { law, guess: &guess, frames: &frames, work };
    let mut doubt = None;
    for known in EXPANSION_ACCURACIES {
        doubt = proved(&map, &listed, &claimed, known)?;
        if !matches!(doubt, Some(Doubt::Open(_))) {
            break;
        }
    }
    Ok(doubt)
}

/// Expansions are known up to such a part per impact of the word, or to the next where that is too little.
const EXPANSION_ACCURACIES: [f64; 2] = [0.03, 0.01];

fn proved(map: &Map<'_>, listed: &[(usize, Word)], claimed: &Claimed, known: f64) -> Result<Option<Doubt>, End> {
    let strips = branches(map.guess, map.frames, listed);
    let mut all: Vec<Proved> = Vec::new();
    for (number, word) in listed {
        let seen = strips.iter().find(|(seen, _)| seen == number).map_or(&[][..], |(_, branches)| branches);
        let is_free = |branch: &&Branch| {
            let mut others = all.iter().map(|other| &other.branch).filter(|other| other.from == branch.from);
            word.half_cycles > 0
                && branch.strip.is_sound()
                && others.all(|other| branch.strip.is_before(&other.strip) || other.strip.is_before(&branch.strip))
        };
        let mut found = None;
        for branch in seen.iter().filter(is_free) {
            found = map.prove(branch, claimed.kappa, known)?.map(|images| Proved { branch: branch.clone(), images });
            if found.is_some() {
                break;
            }
        }
        let Some(found) = found else { return Ok(Some(unproved(*number))) };
        all.push(found);
    }
    let bases = map.frames.len();
    let count = all.len();
    let all = recurrent(all, bases);
    if all.len() < count {
        return Ok(Some(Doubt::False("hyperbolic.words do not lead back to each other".to_owned())));
    }
    if let Some(doubt) = entropy(&all, claimed) {
        return Ok(Some(doubt));
    }
    let heights = heights(&all, bases);
    let mut alone = Vec::new();
    for word in &all {
        if map.is_alone(word, &all, &heights)? {
            alone.push(word.clone());
        }
    }
    let alone = recurrent(alone, bases);
    measured(map, &all, &alone, claimed)
}

fn unproved(number: usize) -> Doubt {
    open(&format!("words: words[{number}] is not proved to expand cones of slope kappa"))
}

/// Refutes or leaves undecided that the growth of the words is between the bounds of the entropy; `None` if it is proved.
fn entropy(words: &[Proved], claimed: &Claimed) -> Option<Doubt> {
    let graph = |weight: &dyn Fn(&Branch) -> f64| {
        let edge = |Proved { branch, .. }: &Proved| {
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

/// The bounds from the graphs of strings: those that are not reached at last.
fn measured(map: &Map<'_>, all: &[Proved], alone: &[Proved], claimed: &Claimed) -> Result<Option<Doubt>, End> {
    let Some(twice) = restitution(map.law).map(|log| log.scaled(2.0)) else { return Ok(Some(open("exponents"))) };
    let is_same = all.len() == alone.len();
    let [mut exponents, mut second, mut upper, mut lower] = [false, false, false, claimed.dimension[0] <= 0.0]; // V14: no dimension is negative
    let mut visit = |graph: &[Step]| {
        let (by_impacts, by_cycles, stable) = graphs(all, graph, twice);
        if !(exponents && second) {
            let ratios = [&by_impacts, &by_cycles].map(|graph| [graph.ratio(true), graph.ratio(false)]);
            exponents |= (0..2).all(|k| is_within(ratios[k], claimed.exponents[k]));
            let rest = [twice - Span::point(ratios[0][1]), twice - Span::point(ratios[0][0])];
            second |= is_within([rest[0].lo(), rest[1].hi()], claimed.second);
        }
        if exponents
            && second
            && let Some([low, high]) = dimension(&by_impacts, &stable)
        {
            upper |= high <= claimed.dimension[1];
            lower |= is_same && low >= claimed.dimension[0];
        }
        exponents && second && upper && (lower || !is_same)
    };
    Strings { map, words: all, kappa: claimed.kappa }.each(&mut visit)?;
    if !lower && !is_same {
        let mut visit = |graph: &[Step]| {
            let (by_impacts, _, stable) = graphs(alone, graph, twice);
            lower |= dimension(&by_impacts, &stable).is_some_and(|[low, _]| low >= claimed.dimension[0]);
            lower
        };
        Strings { map, words: alone, kappa: claimed.kappa }.each(&mut visit)?;
    }
    let known = [(exponents, "exponents"), (second, "second_exponent"), (upper && lower, "dimension")];
    Ok(known.iter().find(|(is, _)| !is).map(|(_, name)| open(&format!("{name}: the bounds are not proved again"))))
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

/// Bounds of the sum of both dimensions.
fn dimension(unstable: &Graph, stable: &Graph) -> Option<[f64; 2]> {
    let ([a, b], [c, d]) = (unstable.root()?, stable.root()?);
    Some([(a + c).next_down(), (b + d).next_up()])
}
