//! The comparison: the verdict on each row and each certified impact, and the place where the list diverges from the orbit.

use std::ops::Range;

use num_rational::BigRational;
use num_traits::Signed;

use super::align::{Alignment, align};
use super::finding::{Errors, Finding};
use super::list::Listed;
use super::tolerance::Tolerance;
use super::truth::{Rest, Site, SiteKind, Truth, is_faster};
use super::verdict::{Reason, Verdict};
use crate::exact::{Dyadic, Enclosure, compare_rational};

/// Place at which a list diverges from the orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divergence {
    /// Index among the findings.
    pub finding: usize,
    /// First true impact that the list does not follow.
    pub impact: u64,
    /// First row after that impact; `None` if there is none.
    pub row: Option<usize>,
}

/// The result of the comparison of a list.
pub(super) struct Comparison {
    /// The findings in the order of the list, with missed impacts in between.
    pub findings: Vec<Finding>,
    pub departure: Option<Divergence>,
}

impl Comparison {
    /// Compares the rows with the orbit certified up to the time `end`; where the rows are a whole list, up to the last contact that is one
    /// of them as well.
    pub fn new(truth: &Truth, rows: &[Listed], (end, is_whole): (&BigRational, bool), tolerance: &Tolerance) -> Self {
        let judge = Comparer::new(truth, rows, tolerance);
        let candidates: Vec<Vec<usize>> = (0..rows.len()).map(|row| judge.candidates(row)).collect();
        let alignment = align(&candidates, truth.sites.len(), |a, b, site| judge.is_nearer(a, b, site));
        let last = alignment.row_of.iter().rposition(Option::is_some).filter(|_| is_whole);
        // The row of an impact that is nearer to the end than the tolerance may be one of those that are left out.
        let latest = |site: &Site| {
            if is_whole { site.time.sup().clone() } else { tolerance.around_time(&site.time).sup().clone() }
        };
        let is_expected = |site: &usize| {
            last.is_some_and(|last| *site < last) || compare_rational(&latest(&truth.sites[*site]), end).is_le()
        };
        let missed = |sites: Range<usize>| sites.filter(is_expected).filter_map(|site| judge.missed(site, &alignment));
        let mut findings = Vec::new();
        let mut next = 0;
        for (row, listed) in rows.iter().enumerate() {
            let until = match alignment.site_of[row] {
                Some(site) => site,
                // Missed impacts come before a false row that is later.
                None => judge.unmatched_before(next, &alignment, &listed.time.low),
            };
            findings.extend(missed(next..until));
            next = next.max(until); // exact: one of both
            match alignment.site_of[row] {
                Some(site) => {
                    findings.push(judge.compared(row, site));
                    next = site + 1;
                }
                None => findings.push(judge.unmatched(row, &candidates[row], &alignment)),
            }
        }
        findings.extend(missed(next..truth.sites.len()));
        let departure = departure(&findings, &truth.sites);
        Self { findings, departure }
    }

    /// First finding that disagrees.
    pub fn first_disagreement(&self) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.verdict.disagrees())
    }
}

/// The rows and the truth, with what is looked up often.
struct Comparer<'a> {
    truth: &'a Truth,
    rows: &'a [Listed],
    tolerance: &'a Tolerance,
    times: Vec<Enclosure>,
    /// The middles of the contacts' times, and the times where the nearest contact changes.
    middles: Vec<Dyadic>,
    boundaries: Vec<Dyadic>,
}

impl<'a> Comparer<'a> {
    fn new(truth: &'a Truth, rows: &'a [Listed], tolerance: &'a Tolerance) -> Self {
        let times = rows.iter().map(|row| row.time.enclose(tolerance.bits)).collect();
        let middles = truth.sites.iter().map(Site::middle).collect();
        Self { truth, rows, tolerance, times, middles, boundaries: truth.boundaries() }
    }

    /// The contact nearest in time.
    fn nearest(&self, row: usize) -> Option<usize> {
        let before =
            self.boundaries.partition_point(|boundary| compare_rational(boundary, &self.rows[row].time.low).is_lt());
        (!self.truth.sites.is_empty()).then_some(before)
    }

    /// The contacts on its wall that a row may be: the nearest one, and all whose enclosures are within the tolerance; the start and
    /// grazes, which need not be listed, only then, and not what may be an impact of a chatter that follows.
    fn candidates(&self, row: usize) -> Vec<usize> {
        let near = self.near(row);
        let is_start = |site: usize| self.truth.sites[site].kind == SiteKind::Start;
        let nearest = self.nearest(row).filter(|&site| !near.contains(&site));
        let nearest = nearest.filter(|&site| !is_start(site) && !self.is_beyond(row, site));
        let (lower, upper) = (nearest.filter(|&site| site < near.start), nearest.filter(|&site| site >= near.end));
        let all = lower.into_iter().chain(near).chain(upper);
        let all: Vec<usize> = all.filter(|&site| self.truth.sites[site].wall == self.rows[row].wall).collect();
        let is_impact = |site: usize| self.truth.sites[site].kind == SiteKind::Impact;
        let to_impact = all.iter().filter(|&&site| is_impact(site)).map(|&site| self.distance(row, site)).min();
        // What need not be listed takes no row from an impact that is nearer to it.
        let is_nearest = |site: usize| to_impact.as_ref().is_none_or(|least| &self.distance(row, site) <= least);
        let may_be = |&site: &usize| is_impact(site) || is_nearest(site) && !self.is_of_chatter_after(row, site);
        all.iter().copied().filter(may_be).collect()
    }

    /// The contacts whose enclosures a row meets, within the tolerance.
    fn near(&self, row: usize) -> Range<usize> {
        let (around, sites) = (self.tolerance.around_time(&self.times[row]), &self.truth.sites);
        let (from, to) = (around.inf(), around.sup());
        let mut first = self.middles.partition_point(|middle| middle < from);
        let mut end = self.middles.partition_point(|middle| middle <= to);
        while first > 0 && sites[first - 1].time.sup() >= from {
            first -= 1;
        }
        while sites.get(end).is_some_and(|site| site.time.inf() <= to) {
            end += 1;
        }
        first..end
    }

    /// Whether a row's velocity is proved not to be the contact's, and may be that of an impact in the chatter after the contact.
    fn is_of_chatter_after(&self, row: usize, site: usize) -> bool {
        let rest = self.truth.sites[site].rest.as_ref();
        self.is_outside_in_velocity(row, site) && rest.is_some_and(|rest| self.is_in_chatter(row, site, rest))
    }

    /// Whether a row's velocity is proved not to be the contact's; false if either has none.
    fn is_outside_in_velocity(&self, row: usize, site: usize) -> bool {
        let velocities = self.velocity(row).zip(self.truth.sites[site].velocity.as_ref());
        velocities.is_some_and(|(listed, truth)| {
            self.tolerance.is_outside_in_velocity(&self.tolerance.distance(&listed, truth))
        })
    }

    /// Whether a contact that is not certified may come within the time enclosure of this one.
    fn is_before_doubt(&self, site: usize) -> bool {
        self.truth.doubtful_from.as_ref().is_some_and(|from| from.inf() <= self.truth.sites[site].time.sup())
    }

    /// Whether a row may be a contact that is not certified, by the comparison of times.
    fn is_in_doubt(&self, row: usize) -> bool {
        let around = self.tolerance.around_time(&self.times[row]);
        self.truth.doubtful_from.as_ref().is_some_and(|from| around.sup() >= from.inf())
            || self.near(row).any(|site| self.is_before_doubt(site))
    }

    /// Whether any other contact, certified or not, may come within the time enclosure of this one.
    fn may_hold_another(&self, site: usize) -> bool {
        let sites = &self.truth.sites;
        let meets =
            |one: usize, next: usize| sites.get(next).is_some_and(|next| next.time.inf() <= sites[one].time.sup());
        self.is_before_doubt(site) || meets(site, site + 1) || site > 0 && meets(site - 1, site)
    }

    /// Whether a row is so late that it may be a contact after the last certified one.
    fn is_beyond(&self, row: usize, site: usize) -> bool {
        let is_open = self.truth.doubtful_from.is_some() && site + 1 == self.truth.sites.len();
        // As far as the last contact's half of the flight that led to it.
        let end = || {
            let middle = self.middles[site].to_rational();
            let half = site.checked_sub(1).map(|before| &middle - self.boundaries[before].to_rational());
            half.map_or_else(|| middle.clone(), |half| &middle + half)
        };
        is_open && self.rows[row].time.low > end()
    }

    /// Whether row `one` is nearer to a contact than row `other`: by velocity, if only one of the two velocities may be the contact's, else by
    /// time.
    fn is_nearer(&self, one: usize, other: usize, site: usize) -> bool {
        let [is_one_outside, is_other_outside] = [one, other].map(|row| self.is_outside_in_velocity(row, site));
        if is_one_outside != is_other_outside {
            return is_other_outside;
        }
        self.distance(one, site) < self.distance(other, site)
    }

    /// Twice the distance in time from the middle of a row to that of a contact.
    fn distance(&self, row: usize, site: usize) -> BigRational {
        let time = &self.rows[row].time;
        let middle = self.middles[site].to_rational();
        (&time.low + &time.high - &middle - &middle).abs()
    }

    /// The first contact from `next` on that is matched or is not before this time.
    fn unmatched_before(&self, next: usize, alignment: &Alignment, time: &BigRational) -> usize {
        let is_earlier =
            |&site: &usize| alignment.row_of[site].is_none() && compare_rational(&self.middles[site], time).is_lt();
        (next..self.middles.len()).take_while(is_earlier).last().map_or(next, |last| last + 1)
    }

    fn missed(&self, site: usize, alignment: &Alignment) -> Option<Finding> {
        let is_missed = alignment.row_of[site].is_none() && self.truth.sites[site].kind == SiteKind::Impact;
        is_missed.then_some(Finding { verdict: Verdict::Missed, row: None, site: Some(site), errors: None })
    }

    /// The verdict on a row that is this contact.
    fn compared(&self, row: usize, site: usize) -> Finding {
        let (tolerance, Site { time, velocity, .. }) = (self.tolerance, &self.truth.sites[site]);
        let errors = Errors {
            time: tolerance.distance(&self.times[row], time),
            velocity: self
                .velocity(row)
                .zip(velocity.as_ref())
                .map(|(listed, truth)| tolerance.distance(&listed, truth)),
        };
        let is_outside = tolerance.is_outside_in_time(&errors.time)
            || errors.velocity.as_ref().is_some_and(|velocity| tolerance.is_outside_in_velocity(velocity));
        // A row before the enclosure, and before the doubt, is no contact at all.
        let may_be_another = self.near(row).contains(&site) && self.may_hold_another(site);
        if is_outside && (may_be_another || self.is_in_doubt(row)) {
            return Finding { verdict: Verdict::Undecided, row: Some(row), site: None, errors: None };
        }
        let verdict = if is_outside { Verdict::Outside } else { Verdict::Inside };
        Finding { verdict, row: Some(row), site: Some(site), errors: Some(errors) }
    }

    fn velocity(&self, row: usize) -> Option<Enclosure> {
        self.rows[row].velocity.as_ref().map(|velocity| velocity.enclose(self.tolerance.bits))
    }

    /// The verdict on a row that is no contact.
    fn unmatched(&self, row: usize, candidates: &[usize], alignment: &Alignment) -> Finding {
        let (nearest, time) = (self.nearest(row), &self.times[row]);
        let is_in_doubt = self.is_in_doubt(row);
        let rests = nearest.into_iter().flat_map(|site| [Some(site), site.checked_sub(1)]).flatten();
        let mut rests = rests.filter_map(|site| Some((site, self.truth.sites[site].rest.as_ref()?)));
        let rest = rests.find(|&(site, rest)| self.is_within(time, site, rest) || self.is_of_chatter_after(row, site));
        let (verdict, site) = match rest {
            Some((site, rest)) if self.is_in_chatter(row, site, rest) => (Verdict::InChatter, Some(site)),
            Some((site, _)) => (Verdict::False(Reason::Rest), Some(site)),
            None if is_in_doubt && self.truth.is_cut => (Verdict::NotReached, None),
            None if is_in_doubt => (Verdict::Undecided, None),
            None => {
                let taken = candidates.iter().copied().find(|&site| alignment.row_of[site].is_some());
                let is_on_wall = |site: usize| self.truth.sites[site].wall == self.rows[row].wall;
                let reason = match (taken, candidates, nearest) {
                    (Some(_), _, _) => Reason::Twice,
                    (None, [_, ..], _) => Reason::Order,
                    (None, [], Some(site)) if !is_on_wall(site) => Reason::Wall,
                    (None, [], _) => Reason::None,
                };
                (Verdict::False(reason), taken.or(nearest))
            }
        };
        Finding { verdict, row: Some(row), site, errors: None }
    }

    /// Whether a time comes after the contact and not after the release of the rest that follows the contact.
    fn is_within(&self, time: &Enclosure, site: usize, rest: &Rest) -> bool {
        let is_before_its_end = match (&rest.until, &self.truth.doubtful_from) {
            (Some(until), _) => time.sup() <= until.sup(),
            (None, None) => true,
            // The duration of the rest is unknown.
            (None, Some(_)) => time.inf() <= self.tolerance.around_time(&rest.from).sup(),
        };
        time.inf() > self.truth.sites[site].time.sup() && is_before_its_end
    }

    /// Whether a row lies in the complete chatter before this rest. Its wall is the chatter's; its time lies between the impact at `site` and the
    /// start of the rest, to the tolerance; its velocity lies between that impact's and 0.
    fn is_in_chatter(&self, row: usize, site: usize, rest: &Rest) -> bool {
        let first = &self.truth.sites[site];
        let time = &self.times[row];
        let [begin, end] = [&first.time, &rest.from].map(|time| self.tolerance.around_time(time));
        let velocities = self.velocity(row).zip(first.velocity.as_ref());
        let is_fast = velocities.is_some_and(|(listed, before)| is_faster(&listed, before, self.tolerance));
        let is_between = begin.inf() <= time.sup() && time.inf() <= end.sup();
        rest.is_accumulation && self.rows[row].wall == first.wall && is_between && !is_fast
    }
}

/// The first missed or false finding from which on, counted to any later one, fewer than half are inside, if both kinds
/// come from there on: a list that only lacks or only adds impacts is on the orbit still.
fn departure(findings: &[Finding], sites: &[Site]) -> Option<Divergence> {
    let score = |verdict: Verdict| match verdict {
        Verdict::Inside => 1,
        Verdict::Outside | Verdict::Missed | Verdict::False(_) => -1,
        Verdict::InChatter | Verdict::NotReached | Verdict::Undecided => 0,
    };
    let mut first = None;
    // The greatest sum of scores from here on, and what is yet to come.
    let mut greatest = i64::MIN;
    let (mut misses, mut invents) = (false, false);
    for (at, Finding { verdict, .. }) in findings.iter().enumerate().rev() {
        greatest = score(*verdict) + greatest.max(0); // exact: small integers
        misses |= *verdict == Verdict::Missed;
        invents |= matches!(verdict, Verdict::False(_));
        if matches!(verdict, Verdict::Missed | Verdict::False(_)) && greatest < 0 && misses && invents {
            first = Some(at);
        }
    }
    first.map(|finding| {
        let before = findings[..finding].iter().rev().filter(|f| f.verdict != Verdict::InChatter);
        let last = before.filter(|f| !matches!(f.verdict, Verdict::False(_))).find_map(|f| f.site);
        let row = findings[finding..].iter().find_map(|finding| finding.row);
        Divergence { finding, impact: last.map_or(0, |site| sites[site].index) + 1, row }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::Wall;

    /// `i`: inside, `o`: outside, `m`: missed, `f`: false, `c`: in the chatter; a site for each but the false ones.
    fn departure_of(verdicts: &str) -> Option<(usize, u64)> {
        let verdict = |letter| match letter {
            'i' => Verdict::Inside,
            'o' => Verdict::Outside,
            'm' => Verdict::Missed,
            'f' => Verdict::False(Reason::None),
            _ => Verdict::InChatter,
        };
        let zero = Enclosure::point(Dyadic::zero());
        let mut sites = Vec::new();
        let finding = |letter| {
            let verdict = verdict(letter);
            let is_site = matches!(verdict, Verdict::Inside | Verdict::Outside | Verdict::Missed);
            let index = sites.len() as u64 + 1;
            let site = Site {
                kind: SiteKind::Impact,
                index,
                wall: Wall::Left,
                time: zero.clone(),
                velocity: None,
                rest: None,
            };
            is_site.then(|| sites.push(site));
            Finding { verdict, row: None, site: is_site.then(|| sites.len() - 1), errors: None }
        };
        let findings: Vec<Finding> = verdicts.chars().map(finding).collect();
        departure(&findings, &sites).map(|departure| (departure.finding, departure.impact))
    }

    #[test]
    fn a_list_that_continues_inside_has_not_diverged() {
        for verdicts in
            ["", "iiii", "iimii", "iifii", "iifmii", "iiiif", "iiiim", "mmmm", "ooooo", "iimcccc", "iimiifiii"]
        {
            assert_eq!(departure_of(verdicts), None, "{verdicts}");
        }
    }

    #[test]
    fn a_list_diverges_where_it_is_no_longer_inside() {
        assert_eq!(departure_of("iiifmoofmof"), Some((3, 4)));
        assert_eq!(departure_of("iiomoofmof"), Some((3, 4)));
        // Before, one impact was left out; after, one is inside by chance.
        assert_eq!(departure_of("iimiiiiifmoomifofmoo"), Some((8, 9)));
        assert_eq!(departure_of("fmo"), Some((0, 1)));
    }
}
