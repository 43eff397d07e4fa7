//! All zeros of a function of one variable, none missed, and each as narrow as the arithmetic allows (Lemma W6).

use std::cmp::Ordering;

use crate::exact::Dyadic;

use super::jet::Jet;
use crate::exact::Real;

/// Greatest number of boxes that one interval is cut into.
const MAX_BOXES: usize = 4000;
/// Greatest number of steps of [`refine`].
const MAX_STEPS: usize = 400;

/// The result for the zeros in a part of an interval.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// Exactly one, for each choice of the parameters; `f` is strictly monotone on `x` and has the sign `left` before it.
    Zero { x: Real, left: Ordering },
    /// Not decided.
    Doubt(Real),
}

/// An interval, and the signs of the function at its ends where they are known: `Equal` says that it is 0 there.
pub(super) struct Interval {
    /// The interval from one end to the other, or a little beyond.
    pub x: Real,
    pub signs: [Option<Ordering>; 2],
}

/// The result for a box.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BoxClass {
    /// The function has this sign.
    Sign(Ordering),
    /// The function rises or falls.
    Slope,
    Neither,
}

/// A row of neighbouring boxes that may hold zeros.
struct Row {
    x: Real,
    is_monotone: bool,
    /// The sign of the function where it begins.
    sign: Option<Ordering>,
}

/// Finds all zeros of `f` strictly inside the interval; `f` gives `None` where it cannot be enclosed.
///
/// **Undecided when** a box of the least width shows neither the function's sign nor its slope's (a double zero, or too
/// few bits), or the signs at the ends of the interval are not known.
pub(super) fn zeros(interval: &Interval, f: impl Fn(&Real) -> Option<Jet>) -> Vec<Part> {
    // Half of the bits: a double zero is seen no better.
    let least = interval.x.wid().scaled(-i64::from(interval.x.bits()) / 2);
    let (mut stack, mut parts) = (vec![interval.x.clone()], Vec::new());
    let (mut left, mut row, mut boxes): (_, Option<Row>, usize) = (interval.signs[0], None, 0);
    while let Some(x) = stack.pop() {
        boxes += 1;
        let class = classify(&x, &f);
        if class == BoxClass::Neither && boxes < MAX_BOXES && x.wid() > least {
            let [low, high] = x.ends();
            let middle = x.middle();
            stack.push(middle.hull(&high));
            stack.push(low.hull(&middle));
            continue;
        }
        match class {
            BoxClass::Sign(sign) => {
                parts.extend(row.take().and_then(|row| row.close(Some(sign))));
                left = Some(sign);
            }
            BoxClass::Slope | BoxClass::Neither => {
                let open = row.get_or_insert_with(|| Row { x: x.clone(), is_monotone: true, sign: left });
                open.x = open.x.hull(&x);
                open.is_monotone &= class == BoxClass::Slope;
            }
        }
    }
    parts.extend(row.and_then(|row| row.close(interval.signs[1])));
    parts
}

fn classify(x: &Real, f: impl Fn(&Real) -> Option<Jet>) -> BoxClass {
    let Some(jet) = f(x) else { return BoxClass::Neither };
    let jet = jet.cut(x, f);
    match (jet.value.sign(), jet.slope.sign()) {
        (Some(sign @ (Ordering::Less | Ordering::Greater)), _) => BoxClass::Sign(sign),
        (_, Some(Ordering::Less | Ordering::Greater)) => BoxClass::Slope,
        _ => BoxClass::Neither,
    }
}

impl Row {
    /// The zero of the row, or the doubt whether it has any, given the sign at its end; `None` if the row has none. Slopes of neighbouring boxes
    /// agree where they meet.
    fn close(self, right: Option<Ordering>) -> Option<Part> {
        match (self.sign, right) {
            (Some(left), Some(right)) if self.is_monotone => {
                let differ = left == right.reverse() && left != Ordering::Equal;
                differ.then_some(Part::Zero { x: self.x, left })
            }
            _ => Some(Part::Doubt(self.x)),
        }
    }
}

/// Narrows a part of an interval that holds one zero, on which `f` is strictly monotone with the sign `left` before it.
///
/// **Enclosure**: for every choice of the parameters the zero stays inside.
pub(super) fn refine(x: Real, left: Ordering, f: impl Fn(&Real) -> Option<Jet>) -> Real {
    let mut x = x;
    for _ in 0..MAX_STEPS {
        let middle = x.middle();
        let Some(there) = f(&middle) else { break };
        let newton =
            f(&x).and_then(|over| there.value.over(&over.slope)).and_then(|step| x.intersection(&(&middle - step)));
        let [low, high] = x.ends();
        let halved = there.value.sign().map(|sign| match sign {
            Ordering::Equal => middle.clone(),
            sign if sign == left => middle.hull(&high),
            _ => low.hull(&middle),
        });
        let next = match (newton, halved) {
            (Some(a), Some(b)) => a.intersection(&b).expect("both hold the zero"),
            (Some(next), None) | (None, Some(next)) => next,
            (None, None) => break,
        };
        // A step that gains less than a quarter is the last one.
        let [three, four] = [3, 4].map(|n: i64| Dyadic::new(n.into(), 0));
        let is_done = next.wid().times(&four) >= x.wid().times(&three);
        x = next;
        if is_done {
            break;
        }
    }
    x
}
