//! True strips of words of figure 14, and false ones; the flights of their states in doubles are an independent route.

use impact_pair_document::ChaosDocument;
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

use super::super::tests::figure_14;
use super::*;
use crate::check::Limits;
use crate::claims::Claims;

/// Five words: two h-sets to themselves and to each other, and one of 22 impacts, whose strip is bent.
fn document() -> Value {
    serde_json::from_str(include_str!("words.json")).expect("a document")
}

/// 15 words for all amplitudes from 7.99 to 8.01.
fn over_a_range() -> Value {
    serde_json::from_str(include_str!("range.json")).expect("a document")
}

/// The verdict of `check`, in words.
fn said(document: &Value) -> String {
    let Ok(claims) = Claims::parse(&document.to_string()) else { return "unreadable".into() };
    let judged = claims.judge(&Limits::default(), &Unwatched).expect("a verdict");
    claims.document(&judged).message
}

/// What `check` says after a change of a strip.
fn said_with(word: usize, change: impl Fn(&mut Vec<f64>, &mut Vec<f64>)) -> String {
    let mut document = document();
    let strip = &mut document["witness"]["strips"][word];
    let side = |name: &str| -> Vec<f64> {
        strip[name].as_array().unwrap().iter().map(|part| part.as_str().unwrap().parse().unwrap()).collect()
    };
    let (mut left, mut right) = (side("left"), side("right"));
    change(&mut left, &mut right);
    let decimals = |side: Vec<f64>| json!(side.iter().map(|part| format!("{part:.17}")).collect::<Vec<_>>());
    *strip = json!({"left": decimals(left), "right": decimals(right)});
    said(&document)
}

#[test]
fn words_with_their_strips_are_confirmed() {
    assert!(said(&document()).starts_with("confirmed: 5 words"), "{}", said(&document()));
    assert!(said_with(0, |_, _| {}).starts_with("confirmed"));
}

#[test]
fn a_document_without_strips_is_undecided() {
    let mut none = document();
    none.as_object_mut().unwrap().remove("witness");
    assert!(said(&none).contains("undecided: no witness"), "{}", said(&none));
    let mut fewer = document();
    fewer["witness"]["strips"].as_array_mut().unwrap().pop();
    assert!(said(&fewer).contains("its witness has 4 strips for 5 words"), "{}", said(&fewer));
    fewer["witness"] = Value::Null;
    assert!(said(&fewer).contains("no witness"), "{}", said(&fewer));
}

/// Each false strip is named by its word; those of the other words still prove these.
#[test]
fn false_strips_prove_nothing() {
    let is_refused = |word: usize, what: &str, change: &dyn Fn(&mut Vec<f64>, &mut Vec<f64>)| {
        let said = said_with(word, change);
        let expected = ["it is not proved again", "the work allowed is spent"]
            .map(|why| format!("undecided: words[{word}]: {why}"));
        assert!(expected.iter().any(|expected| said.starts_with(expected)), "{what} of {word}: {said}");
    };
    for word in [0, 1, 4] {
        let width = |left: &[f64], right: &[f64]| right[0] - left[0];
        let moved = |of_left: f64, of_right: f64| {
            move |left: &mut Vec<f64>, right: &mut Vec<f64>| {
                let width = width(left, right);
                left[0] += of_left * width;
                right[0] += of_right * width;
            }
        };
        is_refused(word, "moved to the right", &moved(0.2, 0.2));
        is_refused(word, "moved to the left", &moved(-0.2, -0.2));
        is_refused(word, "narrowed on the left", &moved(0.2, 0.0));
        is_refused(word, "narrowed on the right", &moved(0.0, -0.2));
        is_refused(word, "the left side leans", &|left, right| {
            let width = width(left, right);
            left.resize(left.len().max(2), 0.0);
            left[1] += 0.2 * width;
        });
        is_refused(word, "the right side is bent", &|left, right| {
            let width = width(left, right);
            right.resize(3, 0.0);
            right[2] -= 0.2 * width;
        });
        is_refused(word, "widened to the whole h-set", &|left, right| {
            *left = vec![-0.999];
            *right = vec![0.999];
        });
        is_refused(word, "sides exchanged", &|left, right| std::mem::swap(left, right));
        is_refused(word, "outside of the h-set", &|left, right| {
            left[0] += 2.0;
            right[0] += 2.0;
        });
        is_refused(word, "of no breadth", &|left, right| right.clone_from(left));
        is_refused(word, "too many coefficients", &|left, _| left.resize(33, 0.0));
        is_refused(word, "no coefficients", &|left, _| left.clear());
    }
    // A narrow strip that leans, without its lean.
    is_refused(4, "upright", &|left, right| {
        left.truncate(1);
        right.truncate(1);
    });
}

#[test]
fn strips_of_other_words_prove_nothing() {
    for (word, other) in [(0, 1), (1, 0), (2, 3), (3, 2), (4, 1), (1, 4), (0, 3)] {
        let mut document = document();
        document["witness"]["strips"][word] = document["witness"]["strips"][other].clone();
        let said = said(&document);
        assert!(
            said.starts_with(&format!("undecided: words[{word}]: it is not proved again")),
            "{word} {other}: {said}"
        );
    }
}

/// A word that is listed twice has one strip: it counts once.
#[test]
fn two_words_do_not_share_states() {
    let mut document = document();
    document["words"][4] = document["words"][1].clone();
    document["witness"]["strips"][4] = document["witness"]["strips"][1].clone();
    let said = said(&document);
    assert!(said.contains("words[1] and words[4]: their strips are not proved to have no state in common"), "{said}");
}

#[test]
fn coefficients_are_decimals() {
    for part in ["NaN", "inf", "-0.85x", ""] {
        let mut document = document();
        document["witness"]["strips"][0]["left"][0] = json!(part);
        assert_eq!(said(&document), "unreadable", "{part}");
    }
    let mut document = document();
    document["witness"]["strips"][0]["middle"] = json!([]);
    assert_eq!(said(&document), "unreadable");
}

/// The h-sets of a document, the words and their strips.
fn read(document: Value) -> (Vec<HSet>, Vec<(Word, Strip)>) {
    let document: ChaosDocument = serde_json::from_value(document).expect("a document");
    let bases = document.bases.iter().map(|base| HSet::of(&base.corners)).collect::<Vec<_>>();
    let words = document.words.iter().map(|word| Word::of(word, bases.len()).expect("a word"));
    let strips = document.witness.expect("a witness").strips;
    let strips = strips.iter().map(|strip| Strip::read(strip).expect("a strip"));
    let words = words.zip(strips).collect();
    (bases, words)
}

fn listed() -> (Vec<HSet>, Vec<(Word, Strip)>) {
    read(document())
}

fn is_proved(bases: &[HSet], word: &Word, strip: &Strip) -> bool {
    let law = figure_14();
    Cover::new(&law, bases).is_proved(word, strip, &Allowance::new(1 << 26, &Unwatched)).expect("an answer")
}

#[test]
fn strips_of_words_with_other_claims_prove_nothing() {
    let (bases, words) = listed();
    for (word, strip) in &words {
        assert!(is_proved(&bases, word, strip), "{word:?}");
        let with = |change: &dyn Fn(&mut Word)| {
            let mut other = word.clone();
            change(&mut other);
            is_proved(&bases, &other, strip)
        };
        assert!(!with(&|word| word.half_cycles += 2) && !with(&|word| word.half_cycles -= 2), "{word:?}");
        assert!(!with(&|word| word.half_cycles += 1), "{word:?}");
        assert!(!with(&|word| word.to = (word.to + 1) % 3), "{word:?}");
        assert!(!with(&|word| word.flights.push(true)), "{word:?}");
        for k in 0..word.flights.len() {
            assert!(!with(&|word| word.flights[k] = !word.flights[k]), "{word:?} {k}");
        }
    }
}

/// Strips that stand still prove words for all gaps of a narrow range, and for none of a wide one.
#[test]
fn strips_prove_words_over_a_range() {
    let (bases, words) = listed();
    let over = |radius: f64| {
        let law = figure_14();
        let gap = law.gap + Span::new(-radius, radius);
        Law { gap, ..law }
    };
    let count = |law: Law| {
        let cover = Cover::new(&law, &bases);
        let work = Allowance::new(1 << 26, &Unwatched);
        words[..4].iter().filter(|(word, strip)| cover.is_proved(word, strip, &work).expect("an answer")).count()
    };
    assert_eq!([1e-7, 0.01].map(|radius| count(over(radius))), [4, 0]);
}

/// Spent work proves nothing.
#[test]
fn a_word_is_given_up_where_its_work_is_spent() {
    let (bases, words) = listed();
    let (word, strip) = &words[0];
    let law = figure_14();
    let found = Cover::new(&law, &bases).is_proved(word, strip, &Allowance::new(100, &Unwatched));
    assert_eq!(found, Err(End::Spent));
}

fn left_of(from: State, to: State, [u, w]: State) -> f64 {
    (to[0] - from[0]) * (w - from[1]) - (to[1] - from[1]) * (u - from[0])
}

/// States of proved strips fly as their words say, and both sides land beyond the edges: by flights in doubles.
#[test]
fn states_of_a_proved_strip_fly_as_the_word_says() {
    let (bases, words) = listed();
    let guess = Guess::new(&figure_14());
    words.iter().for_each(|(word, strip)| flies(&bases, word, strip, &guess));
}

/// So they do at some amplitudes of a range, with the strips that are there then.
#[test]
fn states_of_strips_that_move_fly_as_their_words_say() {
    let (bases, words) = read(over_a_range());
    assert!(
        words.iter().filter(|(_, strip)| strip.of([[0.5; 2].map(Span::point); 2]).left.moves(0.0)[0] != 0.0).count()
            > 10
    );
    let [low, high] = [9.42497 / 8.01, 9.42497 / 7.99];
    for part in [-1.0, -0.4, 0.0, 0.7, 1.0] {
        let gap = Span::point(0.5 * ((1.0 - part) * low + (1.0 + part) * high));
        let guess = Guess::new(&Law { gap, restitution: Span::point(0.5) });
        let shift = [[Span::point(part), Span::point(0.0)], [Span::point(0.0); 2]];
        words.iter().for_each(|(word, strip)| flies(&bases, word, &strip.of(shift), &guess));
    }
}

/// States of a strip land between bottom and top, and those of both sides beyond the edges, one on each.
fn flies(bases: &[HSet], word: &Word, strip: &Strip, guess: &Guess) {
    let (frame, base) = (Frame::of(&bases[word.from]), bases[word.to]);
    let far = word.flights.iter().filter(|&&is_far| is_far).count() as f64;
    let turns = 0.5 * (word.half_cycles as f64 + far);
    let last = |across: f64, height: f64| {
        let [left, right] = [&strip.left, &strip.right].map(|side| side.at(Span::point(height)).mid());
        let xi = 0.5 * ((1.0 - across) * left + (1.0 + across) * right);
        let mut state = [0, 1].map(|i| frame.centre[i] + xi * frame.along[i] + height * frame.across[i]);
        for &is_far in &word.flights {
            let image = guess.map(state).expect("a flight");
            assert_eq!(image.is_far, is_far, "{word:?}");
            state = image.state;
        }
        [state[0] - turns, state[1]]
    };
    let mut sides = [[0; 2]; 2];
    for (i, j) in (-8..=8_i32).flat_map(|i| (-20..=20).map(move |j| (i, j))) {
        let end = last(f64::from(i) / 8.0, f64::from(j) / 20.0);
        assert!(left_of(base.left.bottom, base.right.bottom, end) > 0.0, "{word:?}");
        assert!(left_of(base.left.top, base.right.top, end) < 0.0, "{word:?}");
        if i.abs() == 8 {
            let beyond = [
                left_of(base.left.bottom, base.left.top, end) > 0.0,
                left_of(base.right.bottom, base.right.top, end) < 0.0,
            ];
            assert_ne!(beyond[0], beyond[1], "{word:?}");
            sides[usize::from(i > 0)][usize::from(beyond[1])] += 1;
        }
    }
    assert!(sides == [[41, 0], [0, 41]] || sides == [[0, 41], [41, 0]], "{word:?} {sides:?}");
}

/// Over a range strips have to move, and as the words do.
#[test]
fn strips_that_do_not_move_as_their_words_prove_nothing() {
    let all = over_a_range();
    assert!(said(&all).starts_with("confirmed: 15 words"), "{}", said(&all));
    let with = |change: &dyn Fn(&mut Value)| {
        let mut other = all.clone();
        other["witness"]["strips"].as_array_mut().unwrap().iter_mut().for_each(change);
        said(&other)
    };
    let still = with(&|strip| drop(strip.as_object_mut().unwrap().remove("moved")));
    assert!(still.starts_with("undecided: words["), "{still}");
    let of_the_other = with(&|strip| {
        for moved in strip["moved"].as_array_mut().into_iter().flatten() {
            let [gap, restitution] = [0, 1].map(|k| moved["by"][k].clone());
            moved["by"] = json!([restitution, gap]);
        }
    });
    assert!(of_the_other.starts_with("undecided: words["), "{of_the_other}");
    let twice = with(&|strip| {
        for moved in strip["moved"].as_array_mut().into_iter().flatten() {
            moved["left"] = json!(["0.01"]);
        }
    });
    assert!(twice.starts_with("undecided: words["), "{twice}");
}
