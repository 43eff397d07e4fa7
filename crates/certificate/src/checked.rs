//! The claims of a document of one verb, in order, in words.

use std::sync::atomic::{AtomicUsize, Ordering};

use impact_pair_document::{ClaimName, counted};
use impact_pair_model::watch::{Stage, Watch};
use impact_pair_model::{Error, EventKind};

use crate::atlas::AtlasCertificate;
use crate::bifurcation::BifurcationCertificate;
use crate::cells::CellsCertificate;
use crate::chaos::ChaosCertificate;
use crate::check::Data;
use crate::cycles::CyclesCertificate;
use crate::global::GlobalCertificate;
use crate::periodic::PeriodicCertificate;
use crate::sweep::SweepCertificate;
use crate::tangency::TangencyCertificate;
use crate::trap::TrapCertificate;
use crate::windows::WindowsCertificate;
use crate::{Certificate, Limits, Verdict};

/// The statement on horseshoes that is not checked: boxes of components are not in a document. Lemma V37
const UNCHECKED_COMPONENT: &str = "which component holds a horseshoe";

/// A document whose claims are the items of a list, followed by statements about the whole document.
pub(super) trait Checked {
    /// Proves every claim again, or returns the first claim that is refuted or undecided. The watch can stop the check and receives the
    /// number of claims confirmed so far.
    fn check(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error>;

    /// Number of items.
    fn count(&self) -> usize;

    /// The key of the list.
    fn items(&self) -> &'static str;

    /// An item, in words.
    fn item(&self) -> &'static str;

    /// All claims, in words.
    fn all(&self) -> String {
        self.first(self.count())
    }

    /// The first items, in words.
    fn first(&self, count: usize) -> String {
        counted(count, self.item())
    }

    /// The place of an item, in words.
    fn place(&self, item: usize) -> String {
        self.path(item)
    }

    /// The claim that a finding is about, and the message.
    fn described(&self, event: usize, message: &str) -> String {
        if event < self.count() { format!("{}: {message}", self.place(event)) } else { message.to_owned() }
    }

    /// The path of an item.
    fn path(&self, item: usize) -> String {
        format!("{}[{item}]", self.items())
    }

    /// The path of the statement about the whole document.
    fn whole(&self) -> &'static str {
        "certified"
    }

    /// Whether a confirmed item is confirmed for all data, independently of the verdicts on other items.
    fn is_one_by_one(&self) -> bool {
        true
    }

    /// Whether none of the document's claims is checked: then nothing is confirmed.
    fn claims_nothing(&self) -> bool {
        self.count() == 0
    }

    /// The verdict, and how many items are confirmed for all data; documents that check item by item count themselves.
    fn judge(&self, limits: &Limits, watch: &dyn Watch) -> Result<(Verdict, usize), Error> {
        let reached = AtomicUsize::new(0);
        let watch = &|at: Stage<'_>| {
            if let Stage::Claims(claims) = at {
                reached.fetch_max(claims, Ordering::Relaxed);
            }
            watch.proceed(at)
        };
        let verdict = self.check(limits, watch)?;
        Ok((verdict, if self.is_one_by_one() { reached.into_inner() } else { 0 }))
    }
}

/// The methods of documents whose claims are the items of this list, each of which has this name.
macro_rules! checked {
    ($items:literal, $item:expr) => {
        fn check(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
            self.check_within(limits, watch)
        }

        fn count(&self) -> usize {
            self.count()
        }

        fn items(&self) -> &'static str {
            $items
        }

        fn item(&self) -> &'static str {
            $item
        }
    };
}

/// The method of documents that check item by item themselves.
macro_rules! judged {
    () => {
        fn judge(&self, limits: &Limits, watch: &dyn Watch) -> Result<(Verdict, usize), Error> {
            self.judge_within(limits, watch)
        }
    };
}

impl Checked for Certificate {
    checked!("events", "event");

    fn all(&self) -> String {
        format!("{} and the outcome{}", counted(self.events().len(), "event"), self.nearness())
    }

    fn first(&self, count: usize) -> String {
        let impacts = self.events()[..count].iter().filter(|claim| claim.kind.is_impact()).count();
        let events = counted(count, "event");
        if impacts == 0 { events } else { format!("{events}, impacts 1..{impacts}") }
    }

    fn place(&self, item: usize) -> String {
        match &self.events()[item].kind {
            EventKind::Impact { index, .. } => format!("events[{item}], impact {index}"),
            EventKind::Graze { .. } => format!("events[{item}], a graze"),
            EventKind::Rest { .. } => format!("events[{item}], a rest"),
            EventKind::Release => format!("events[{item}], a release"),
        }
    }

    fn described(&self, event: usize, message: &str) -> String {
        self.described(event, message)
    }

    fn whole(&self) -> &'static str {
        "outcome"
    }

    fn claims_nothing(&self) -> bool {
        self.claims_nothing()
    }

    /// False for interval data, whose pieces come one after another, and for a shadowed orbit, whose links prove nothing separately.
    fn is_one_by_one(&self) -> bool {
        self.claim() == ClaimName::ExactStart && Data::new(self.pair(), self.start()).is_ok_and(|data| data.is_point())
    }
}

impl Certificate {
    /// The claim that a finding is about, and the message.
    pub fn described(&self, event: usize, message: &str) -> String {
        let claim = if event < self.events().len() { self.place(event) } else { self.whole().to_owned() };
        format!("{claim}: {message}")
    }
}

impl Checked for PeriodicCertificate {
    checked!("orbits", "orbit");

    fn all(&self) -> String {
        let orbits = self.first(self.count());
        if self.search.is_some() { format!("{orbits}, and that there are no others") } else { orbits }
    }

    fn claims_nothing(&self) -> bool {
        self.count() == 0 && self.search.is_none()
    }
}

impl Checked for CyclesCertificate {
    checked!("orbits", "orbit");

    fn whole(&self) -> &'static str {
        if self.contradiction.is_some() { "fixed_points" } else { "certified" }
    }
}

impl Checked for BifurcationCertificate {
    checked!("points", "bifurcation");

    fn all(&self) -> String {
        counted(self.checked(), "bifurcation")
    }
}

impl Checked for WindowsCertificate {
    checked!("windows", "window");

    fn all(&self) -> String {
        let windows = counted(self.count(), "window");
        match self.windows.iter().filter(|window| window.stable_between).count() {
            whole if whole == self.count() => format!("the orbits of {windows} from end to end"),
            0 => format!("a stable orbit in {windows}, not from end to end"),
            whole => format!("a stable orbit in {windows}, in {whole} of them from end to end"),
        }
    }
}

impl Checked for GlobalCertificate {
    checked!("components", "component");

    fn all(&self) -> String {
        let components = counted(self.count(), "component");
        match (self.says_there_are_no_others, self.has_horseshoes()) {
            (true, _) => {
                format!("{components}, and that every motion that touches a wall is in one of them in the end")
            }
            (false, false) => format!("what is proved of {components}"),
            (false, true) => format!("what is proved of {components}, not {UNCHECKED_COMPONENT}"),
        }
    }

    fn claims_nothing(&self) -> bool {
        !self.claims_something()
    }

    fn is_one_by_one(&self) -> bool {
        false
    }
}

impl Checked for TangencyCertificate {
    checked!("tangencies", "tangency");

    fn first(&self, count: usize) -> String {
        format!("{count} homoclinic {}", if count == 1 { "tangency" } else { "tangencies" })
    }
}

impl Checked for SweepCertificate {
    checked!("points", "point");
    judged!();

    fn all(&self) -> String {
        format!("the impacts of {}", counted(self.claimed(), "point"))
    }

    fn claims_nothing(&self) -> bool {
        self.claimed() == 0
    }
}

impl Checked for AtlasCertificate {
    checked!("points", "point");
    judged!();

    fn first(&self, count: usize) -> String {
        counted(count, if self.has_cells { "tile" } else { "point" })
    }

    fn claims_nothing(&self) -> bool {
        self.claimed() == 0
    }

    fn all(&self) -> String {
        let claimed = self.claimed();
        let said = match self.has_cells {
            true => format!(
                "what is proved of every motion that touches a wall, for all parameters of {}",
                counted(claimed, "cell")
            ),
            false => format!("what is proved of every motion that touches a wall, at {}", counted(claimed, "point")),
        };
        if self.has_horseshoes() { format!("{said}, not {UNCHECKED_COMPONENT}") } else { said }
    }
}

impl Checked for CellsCertificate {
    checked!("stretches", "subinterval");
    judged!();

    fn claims_nothing(&self) -> bool {
        self.claimed() == 0
    }

    fn all(&self) -> String {
        format!("the verdicts on {} and the shares", counted(self.claimed(), "subinterval"))
    }
}

impl Checked for ChaosCertificate {
    checked!("words", "word");

    fn all(&self) -> String {
        format!("{}, the entropies and the horseshoe", counted(self.count(), "word"))
    }

    fn is_one_by_one(&self) -> bool {
        false
    }
}

impl Checked for TrapCertificate {
    checked!("region", "box");

    fn all(&self) -> String {
        let words = if self.document.words.is_some() { ", and the count and entropy of its words" } else { "" };
        format!("a trapping region of {} and its bounds{words}", self.first(self.count()))
    }

    fn first(&self, count: usize) -> String {
        format!("{count} {}", if count == 1 { "box" } else { "boxes" })
    }

    fn place(&self, item: usize) -> String {
        format!("box {item}")
    }

    fn path(&self, _: usize) -> String {
        "region".to_owned()
    }

    fn is_one_by_one(&self) -> bool {
        false
    }
}
