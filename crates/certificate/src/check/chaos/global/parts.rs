//! Strongly connected parts of a graph.

/// The strongly connected part of each node, numbered from 0 on (Tarjan's algorithm, without recursion).
pub(super) fn parts(next: &[Vec<usize>]) -> Vec<usize> {
    const UNASSIGNED: usize = usize::MAX;
    let (mut index, mut low) = (vec![UNASSIGNED; next.len()], vec![0; next.len()]);
    let (mut part, mut count) = (vec![UNASSIGNED; next.len()], 0);
    let (mut stack, mut seen) = (Vec::new(), 0);
    for root in 0..next.len() {
        if index[root] != UNASSIGNED {
            continue;
        }
        let mut path = vec![(root, 0)];
        while let Some(&mut (node, ref mut tried)) = path.last_mut() {
            if *tried == 0 {
                (index[node], low[node]) = (seen, seen);
                seen += 1;
                stack.push(node);
            }
            if let Some(&to) = next[node].get(*tried) {
                *tried += 1;
                if index[to] == UNASSIGNED {
                    path.push((to, 0));
                } else if part[to] == UNASSIGNED {
                    low[node] = low[node].min(index[to]); // exact: numbers of nodes
                }
                continue;
            }
            if low[node] == index[node] {
                while let Some(member) = stack.pop() {
                    part[member] = count;
                    if member == node {
                        break;
                    }
                }
                count += 1;
            }
            path.pop();
            if let Some(&(before, _)) = path.last() {
                low[before] = low[before].min(low[node]); // exact: numbers of nodes
            }
        }
    }
    part
}

/// Returns whether a graph has no cycle that avoids a node.
pub(super) fn is_acyclic_but_for(without: usize, next: &[Vec<usize>]) -> bool {
    let others = |to: &Vec<usize>| to.iter().copied().filter(|&to| to != without).collect();
    let mut forth: Vec<Vec<usize>> = next.iter().map(others).collect();
    forth[without].clear();
    let part = parts(&forth);
    let count = part.iter().max().map_or(0, |&last| last + 1);
    count == forth.len() && forth.iter().enumerate().all(|(node, to)| !to.contains(&node))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_strongly_connected() {
        let next = vec![vec![1], vec![2], vec![0, 3], vec![4], vec![3, 5], vec![], vec![6]];
        let part = parts(&next);
        assert!(part[0] == part[1] && part[1] == part[2] && part[3] == part[4]);
        assert_eq!(part.iter().collect::<std::collections::BTreeSet<_>>().len(), 4);
    }
}
