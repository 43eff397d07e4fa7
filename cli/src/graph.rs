//! Directed graphs as files that other programs read: GraphML and DOT.

use std::fmt::{self, Write};

use impact_pair::json::PROGRAM;

/// A directed graph whose edges have a letter.
pub struct Graph<'g> {
    /// What it is a graph of, in words.
    pub title: String,
    /// Whole numbers that nodes have, by their names.
    pub keys: [&'static str; 2],
    /// For each node those of its numbers that it has.
    pub nodes: Vec<Vec<i64>>,
    /// From node to node.
    pub edges: Box<dyn Iterator<Item = (usize, char, usize)> + 'g>,
}

impl Graph<'_> {
    /// Returns it as GraphML.
    pub fn graphml(self) -> Result<String, fmt::Error> {
        let title = escaped(&self.title);
        let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
                       <graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n"
            .to_owned();
        let mut key = |name: &str, of: &str, kind: &str| {
            writeln!(out, "  <key id=\"{name}\" for=\"{of}\" attr.name=\"{name}\" attr.type=\"{kind}\"/>")
        };
        for name in ["title", "program"] {
            key(name, "graph", "string")?;
        }
        for name in self.keys {
            key(name, "node", "long")?;
        }
        key("flight", "edge", "string")?;
        writeln!(out, "  <graph edgedefault=\"directed\">")?;
        writeln!(out, "    <data key=\"title\">{title}</data>\n    <data key=\"program\">{PROGRAM}</data>")?;
        for (i, numbers) in self.nodes.iter().enumerate() {
            write!(out, "    <node id=\"{i}\">")?;
            for (key, number) in self.keys.iter().zip(numbers) {
                write!(out, "<data key=\"{key}\">{number}</data>")?;
            }
            writeln!(out, "</node>")?;
        }
        for (from, letter, to) in self.edges {
            writeln!(out, "    <edge source=\"{from}\" target=\"{to}\"><data key=\"flight\">{letter}</data></edge>")?;
        }
        writeln!(out, "  </graph>\n</graphml>")?;
        Ok(out)
    }

    /// Returns it in the language of Graphviz.
    pub fn dot(self) -> Result<String, fmt::Error> {
        let mut out = String::new();
        writeln!(out, "digraph {{\n  label=\"{}; {PROGRAM}\";", self.title.replace(['"', '\\'], "'"))?;
        for (i, numbers) in self.nodes.iter().enumerate() {
            let numbers = self.keys.iter().zip(numbers).map(|(key, number)| format!("{key}={number}"));
            writeln!(out, "  {i} [{}];", numbers.collect::<Vec<_>>().join(", "))?;
        }
        for (from, letter, to) in self.edges {
            writeln!(out, "  {from} -> {to} [label={letter}];")?;
        }
        writeln!(out, "}}")?;
        Ok(out)
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
