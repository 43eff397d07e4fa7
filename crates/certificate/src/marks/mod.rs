//! What `check` says of each value of a document: it is checked, and by which lemmas, or it is not, and why.
//!
//! For each struct of a document a function takes all its fields: a new one does not compile until it is decided here. `leaves` sorts
//! the values of a file by these marks, and `docs/verified.md` has a table of them.

mod chaos;
mod global;
mod grid;
mod orbit;
mod periodic;
mod scene;
mod tangency;

pub(super) use chaos::{cells, chaos, trap};
pub(super) use global::Components;
pub(super) use global::global;
pub(super) use grid::{Listed, Pinned, Proved, atlas, point, record, sweep};
pub(super) use orbit::{description, orbit};
pub(super) use periodic::{bifurcations, cycles, periodic, two_impact, windows};
pub(super) use tangency::tangency;

/// The key of the marks of the lines that follow a head: these have a list of their own.
pub(super) const LINES: &str = "[]";

/// What is said of a value, and of those in it.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    pub said: Said,
    /// The lemmas that check it; empty where none ever does.
    pub by: &'static str,
    /// Why it is not checked, or where it is not; empty where it always is.
    pub why: &'static str,
    /// Whether it is decided for each item of a list: then its path names the item.
    pub is_of_item: bool,
    /// Whether `null` is a claim.
    pub null_claims: bool,
    within: Within,
}

/// What is said of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Said {
    /// It is checked.
    Checked,
    /// It is a claim that is not checked: a reader may take it for proved.
    Claimed,
    /// It claims nothing: a request, a method, words on what is undecided.
    Setting,
    /// This value claims nothing, as `false` of a flag, or a witness.
    Nothing,
}

#[derive(Clone, Debug)]
enum Within {
    /// All that is in it is marked as it is.
    Same,
    Fields(Vec<(&'static str, Mark)>),
    Items(Vec<Mark>),
    Each(Box<Mark>),
}

/// A value that these lemmas check.
pub(super) fn checked(by: &'static str) -> Mark {
    Mark { said: Said::Checked, by, why: "", is_of_item: false, null_claims: false, within: Within::Same }
}

/// A claim that no lemma of the check covers.
pub(super) fn claimed(why: &'static str) -> Mark {
    Mark { said: Said::Claimed, by: "", why, ..checked("") }
}

/// A value that claims nothing.
pub(super) fn setting(why: &'static str) -> Mark {
    Mark { said: Said::Setting, by: "", why, ..checked("") }
}

/// What these lemmas prove claims with: it claims nothing itself.
pub(super) fn witness(by: &'static str) -> Mark {
    Mark { said: Said::Nothing, by, why: "a witness: claims are proved with it", ..checked("") }
}

/// A struct, with what is said of each of its fields: without one of them it does not compile.
macro_rules! fields {
    ($document:expr, $kind:ident { $($key:ident: $mark:expr),+ $(,)? }) => {{
        let $kind { $($key: _),+ } = $document;
        $crate::marks::Mark::of_fields(vec![$((stringify!($key), $mark)),+])
    }};
}
pub(super) use fields;

/// A list whose items have one mark: nothing in it depends on the item, or on what it has.
pub(super) fn each<T>(items: &[T], mark: impl Fn(&T) -> Mark) -> Mark {
    let within = items.first().map_or(Within::Same, |first| Within::Each(Box::new(mark(first))));
    Mark { within, ..checked("") }
}

/// A list whose items have these marks.
pub(super) fn list(marks: Vec<Mark>) -> Mark {
    Mark { within: Within::Items(marks), ..checked("") }
}

/// A list whose items have marks of their own.
pub(super) fn items<'t, T: 't>(items: impl IntoIterator<Item = &'t T>, mark: impl Fn(&T) -> Mark) -> Mark {
    list(items.into_iter().map(mark).collect())
}

/// A struct that may not be there.
pub(super) fn optional<T>(value: Option<&T>, mark: impl Fn(&T) -> Mark) -> Mark {
    value.map_or(checked(""), mark)
}

impl Mark {
    /// A struct of these fields.
    pub fn of_fields(fields: Vec<(&'static str, Self)>) -> Self {
        Self { within: Within::Fields(fields), ..checked("") }
    }

    /// The same, but a claim that is not checked unless the document is of this kind.
    pub fn only(self, is_checked: bool, why: &'static str) -> Self {
        let said = if is_checked { self.said } else { Said::Claimed };
        Self { said, why, ..self }
    }

    /// The same, but no claim unless the document is of this kind.
    pub fn used(self, is_used: bool, why: &'static str) -> Self {
        let said = if is_used { self.said } else { Said::Setting };
        Self { said, why, ..self }
    }

    /// The same, which is decided for this item of a list alone.
    pub fn here(self) -> Self {
        Self { is_of_item: true, ..self }
    }

    /// As [`only`](Self::only), for this item of a list alone.
    pub fn only_here(self, is_checked: bool, why: &'static str) -> Self {
        self.only(is_checked, why).here()
    }

    /// As [`used`](Self::used), for this item of a list alone.
    pub fn used_here(self, is_used: bool, why: &'static str) -> Self {
        self.used(is_used, why).here()
    }

    /// Of a flag, which claims nothing where it is false.
    pub fn flag(self, is_so: bool) -> Self {
        let said = if is_so { self.said } else { Said::Nothing };
        Self { said, ..self }
    }

    /// Of a value of which `null` is a claim as well.
    pub fn or_null(self) -> Self {
        Self { null_claims: true, ..self }
    }

    /// The mark of a value at a key.
    pub fn at(&self, key: &str) -> Option<&Self> {
        match &self.within {
            Within::Fields(fields) => fields.iter().find(|(own, _)| *own == key).map(|(_, mark)| mark),
            Within::Same => Some(self),
            Within::Items(_) | Within::Each(_) => None,
        }
    }

    /// The mark of an item of a list.
    pub fn item(&self, i: usize) -> Option<&Self> {
        match &self.within {
            Within::Items(marks) => marks.get(i),
            Within::Each(mark) => Some(mark),
            Within::Same => Some(self),
            Within::Fields(_) => None,
        }
    }

    /// The same with one more field, or another mark of one that it has.
    pub fn with(mut self, key: &'static str, mark: Self) -> Self {
        if let Within::Fields(fields) = &mut self.within {
            fields.retain(|(own, _)| *own != key);
            fields.push((key, mark));
        }
        self
    }

    /// What is said of the values at each key, without positions in lists: what checks it, and why it is not checked, or where.
    pub fn rows(&self, path: &str, rows: &mut Vec<(String, &'static str, &'static str)>) {
        if !(self.by.is_empty() && self.why.is_empty()) {
            rows.push((path.to_owned(), self.by, self.why));
        }
        match &self.within {
            Within::Fields(fields) => fields.iter().for_each(|(key, mark)| match (path, *key) {
                ("", LINES) => mark.rows("points", rows),
                ("", key) => mark.rows(key, rows),
                (path, key) => mark.rows(&format!("{path}.{key}"), rows),
            }),
            Within::Items(marks) => marks.iter().for_each(|mark| mark.rows(path, rows)),
            Within::Each(mark) => mark.rows(path, rows),
            Within::Same => {}
        }
    }
}
