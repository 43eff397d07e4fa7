//! The strongly connected parts of a graph, and which of them walks lead to. Lemma A6 of `docs/proofs/global.md#A6`

use crate::chaos::boxes::{Links, parts};

/// A graph's strongly connected parts, and where walks from each lead.
pub(super) struct Walks {
    /// The parts, in an order in which every part comes before those that it leads to.
    pub parts: Vec<Vec<usize>>,
    /// The part of each node.
    pub number: Vec<usize>,
    /// The place of each part among the recurrent ones, if it is one.
    pub index: Vec<Option<u32>>,
    /// The recurrent parts that each part leads to, itself among them, by their places, in order.
    pub reached: Vec<Vec<u32>>,
    /// For each part: whether something leaves the boxes on a walk from it.
    pub lost: Vec<bool>,
}

impl Walks {
    /// The parts and walks of the graph with these edges; `leaves` are the nodes that something leaves the graph from.
    pub fn of(next: &Links, leaves: &[bool]) -> Self {
        let count = leaves.len();
        let forth: Vec<Vec<usize>> = (0..count)
            .map(|node| next.of(node as u32).iter().map(|&to| to as usize).collect()) // exact: indices
            .collect();
        let parts = parts(&forth);
        let mut number = vec![0; count];
        for (i, part) in parts.iter().enumerate() {
            part.iter().for_each(|&node| number[node] = i);
        }
        let is_recurrent = |part: &[usize]| part.len() > 1 || forth[part[0]].contains(&part[0]);
        let mut index = vec![None; parts.len()];
        let recurrent = (0..parts.len()).filter(|&i| is_recurrent(&parts[i]));
        recurrent.enumerate().for_each(|(k, i)| index[i] = Some(k as u32)); // exact: fewer than 2^32
        let mut reached: Vec<Vec<u32>> = vec![Vec::new(); parts.len()];
        let mut lost = vec![false; parts.len()];
        for i in (0..parts.len()).rev() {
            let mut own: Vec<u32> = index[i].into_iter().collect();
            let mut is_left = parts[i].iter().any(|&node| leaves[node]);
            for &to in parts[i].iter().flat_map(|&node| &forth[node]) {
                if number[to] != i {
                    own.extend(&reached[number[to]]);
                    is_left |= lost[number[to]];
                    if own.len() > 64 {
                        own.sort_unstable();
                        own.dedup();
                    }
                }
            }
            own.sort_unstable();
            own.dedup();
            (reached[i], lost[i]) = (own, is_left);
        }
        Self { parts, number, index, reached, lost }
    }
}
