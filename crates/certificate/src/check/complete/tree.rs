//! The text of a tree of boxes, read node by node.

use super::super::contact::Doubt;

/// What a tree says of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Node {
    /// The box is settled at once.
    Leaf,
    /// The box is halved at a place of one of its phases, in forcing periods.
    Halved { phase: usize, place: f64 },
}

/// The nodes of a tree that are not read yet, each before those of its halves.
pub(super) struct Tree<'t>(&'t str);

/// The node of a box that is settled.
const LEAF: char = '-';

impl<'t> Tree<'t> {
    pub fn new(text: &'t str) -> Self {
        Self(text)
    }

    /// The next node, of a box of `phases` phases.
    pub fn node(&mut self, phases: usize) -> Result<Node, Doubt> {
        let none = || Doubt::open("the tree of the search ends before its boxes do");
        let mut rest = self.0.chars();
        let letter = rest.next().ok_or_else(none)?;
        let rest = rest.as_str();
        if letter == LEAF {
            self.0 = rest;
            return Ok(Node::Leaf);
        }
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len()); // exact: to the end of the text
        let (place, rest) = rest.split_at(end);
        self.0 = rest;
        let phase = ('a'..='z').chain('A'..='Z').take(phases).position(|own| own == letter);
        match (phase, place.parse::<f64>()) {
            (Some(phase), Ok(place)) if place.is_finite() => Ok(Node::Halved { phase, place }),
            _ => Err(Doubt::open("the tree of the search has a node that is none")),
        }
    }

    /// Proves that all nodes are read.
    pub fn end(self) -> Result<(), Doubt> {
        if self.0.is_empty() { Ok(()) } else { Err(Doubt::open("the tree of the search goes on after its last box")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_are_letters_with_a_place_and_leaves() {
        let mut tree = Tree::new("a.5-b12.25--");
        assert_eq!(tree.node(2).unwrap(), Node::Halved { phase: 0, place: 0.5 });
        assert_eq!(tree.node(2).unwrap(), Node::Leaf);
        assert_eq!(tree.node(2).unwrap(), Node::Halved { phase: 1, place: 12.25 });
        assert!(tree.node(2).is_ok() && tree.node(2).is_ok() && tree.node(2).is_err() && tree.end().is_ok());
        assert!(Tree::new("-").end().is_err());
        for none in ["c.5", "a", "a.", "a1.2.3", "?1", "ae5", "é", "1"] {
            assert!(Tree::new(none).node(2).is_err(), "{none}");
        }
    }
}
