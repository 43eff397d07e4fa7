//! The assignment of rows of the list to contacts of the certified orbit.
//!
//! A row may be any of a few contacts, its candidates. As many rows as possible are matched such that rows and contacts keep their order: a
//! longest increasing subsequence (Hunt and Szymanski, Comm. ACM 20(5), 350-353, 1977). So a row out of place costs only itself.

/// The row of each contact and the contact of each row.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Alignment {
    pub site_of: Vec<Option<usize>>,
    pub row_of: Vec<Option<usize>>,
}

/// Matches rows to `sites` contacts; of several rows for one contact the one that `nearer` prefers.
///
/// `candidates[row]` are the contacts that the row may be, in ascending order; `nearer(a, b, site)` says whether row `a` is nearer to the
/// contact than row `b`.
pub(super) fn align(
    candidates: &[Vec<usize>],
    sites: usize,
    nearer: impl Fn(usize, usize, usize) -> bool,
) -> Alignment {
    let mut chain = longest(candidates);
    for at in 0..chain.len() {
        let (row, site) = chain[at];
        let after = if at == 0 { 0 } else { chain[at - 1].0 + 1 };
        let before = chain.get(at + 1).map_or(candidates.len(), |next| next.0);
        let rows = (after..before).filter(|&row| candidates[row].contains(&site));
        // Of equal ones the first.
        let nearest = rows.reduce(|best, row| if nearer(row, best, site) { row } else { best });
        chain[at].0 = nearest.unwrap_or(row); // exact: the row itself is one
    }
    let mut alignment = Alignment { site_of: vec![None; candidates.len()], row_of: vec![None; sites] };
    for (row, site) in chain {
        (alignment.site_of[row], alignment.row_of[site]) = (Some(site), Some(row));
    }
    alignment
}

/// A longest sequence of pairs of a row and one of its candidates in which both strictly ascend.
fn longest(candidates: &[Vec<usize>]) -> Vec<(usize, usize)> {
    // Of the sequences of each length so far the pair that ends lowest; with each pair the one before it.
    let mut ends: Vec<usize> = Vec::new();
    let mut pairs: Vec<(usize, usize, Option<usize>)> = Vec::new();
    for (row, sites) in candidates.iter().enumerate() {
        // Descending, so that no sequence takes a row twice.
        for &site in sites.iter().rev() {
            let length = ends.partition_point(|&end| pairs[end].1 < site);
            let before = length.checked_sub(1).map(|before| ends[before]);
            pairs.push((row, site, before));
            match ends.get_mut(length) {
                Some(end) => *end = pairs.len() - 1,
                None => ends.push(pairs.len() - 1),
            }
        }
    }
    let mut chain: Vec<(usize, usize)> = Vec::new();
    let mut at = ends.last().copied();
    while let Some(pair) = at {
        let (row, site, before) = pairs[pair];
        chain.push((row, site));
        at = before;
    }
    chain.reverse();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites_of(candidates: &[&[usize]], sites: usize) -> Vec<Option<usize>> {
        let candidates: Vec<Vec<usize>> = candidates.iter().map(|sites| sites.to_vec()).collect();
        align(&candidates, sites, |_, _, _| false).site_of
    }

    #[test]
    fn one_misplaced_row_is_the_only_disagreement() {
        let some = |sites: [usize; 4]| sites.map(Some).to_vec();
        assert_eq!(sites_of(&[&[0], &[1], &[2], &[3]], 4), some([0, 1, 2, 3]));
        // Left out, doubled, far ahead, swapped.
        assert_eq!(sites_of(&[&[0], &[2], &[3], &[4]], 5), some([0, 2, 3, 4]));
        assert_eq!(sites_of(&[&[0], &[1], &[1], &[2]], 3), [Some(0), Some(1), None, Some(2)]);
        assert_eq!(sites_of(&[&[0], &[9], &[1], &[2]], 10), [Some(0), None, Some(1), Some(2)]);
        assert_eq!(sites_of(&[&[0], &[2], &[1], &[3]], 4).iter().flatten().count(), 3);
    }

    #[test]
    fn ambiguous_rows_are_all_matched() {
        assert_eq!(sites_of(&[&[0, 1, 2], &[0, 1, 2], &[0, 1, 2]], 3), [Some(0), Some(1), Some(2)]);
        assert_eq!(sites_of(&[&[1], &[0, 1, 2], &[]], 3), [Some(1), Some(2), None]);
    }

    #[test]
    fn the_nearest_of_several_rows_is_matched() {
        let candidates = [vec![0], vec![1], vec![1], vec![1], vec![2]];
        let distance = [0, 5, 1, 3, 0];
        let alignment = align(&candidates, 3, |a, b, _| distance[a] < distance[b]);
        assert_eq!(alignment.row_of, [Some(0), Some(2), Some(4)]);
    }
}
