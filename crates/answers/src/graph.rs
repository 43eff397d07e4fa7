//! Directed graphs as files that other programs read: GraphML and DOT.

use std::fmt::{self, Display, Write};

use impact_pair::json::PROGRAM;

use crate::Format;

/// A node.
pub enum Value {
    Number(i64),
    Word(String),
}

/// A directed graph, whose edges may have a letter.
pub struct Graph<'g> {
    /// Title of the graph: what its nodes and edges are, in words.
    pub title: String,
    /// The names of what is known of nodes, and the types of it in GraphML.
    pub keys: &'static [(&'static str, &'static str)],
    /// For each node what is known of it, in the order of the names.
    pub nodes: Vec<Vec<Value>>,
    /// From node to node.
    pub edges: Box<dyn Iterator<Item = (usize, Option<char>, usize)> + 'g>,
}

impl Graph<'_> {
    /// The graph in a format: GraphML, or the language of Graphviz.
    pub fn text(self, format: Format) -> Result<String, fmt::Error> {
        if format == Format::Dot { self.dot() } else { self.graphml() }
    }

    /// Returns it as GraphML.
    fn graphml(self) -> Result<String, fmt::Error> {
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
        for (name, kind) in self.keys {
            key(name, "node", kind)?;
        }
        key("flight", "edge", "string")?;
        writeln!(out, "  <graph edgedefault=\"directed\">")?;
        writeln!(out, "    <data key=\"title\">{title}</data>\n    <data key=\"program\">{PROGRAM}</data>")?;
        for (i, values) in self.nodes.iter().enumerate() {
            write!(out, "    <node id=\"{i}\">")?;
            for ((key, _), value) in self.keys.iter().zip(values) {
                write!(out, "<data key=\"{key}\">{value}</data>")?;
            }
            writeln!(out, "</node>")?;
        }
        for (from, letter, to) in self.edges {
            match letter {
                Some(letter) => writeln!(
                    out,
                    "    <edge source=\"{from}\" target=\"{to}\"><data key=\"flight\">{letter}</data></edge>"
                )?,
                None => writeln!(out, "    <edge source=\"{from}\" target=\"{to}\"/>")?,
            }
        }
        writeln!(out, "  </graph>\n</graphml>")?;
        Ok(out)
    }

    /// Returns it in the language of Graphviz.
    fn dot(self) -> Result<String, fmt::Error> {
        let mut out = String::new();
        writeln!(out, "digraph {{\n  label=\"{}; {PROGRAM}\";", self.title.replace(['"', '\\'], "'"))?;
        for (i, values) in self.nodes.iter().enumerate() {
            let values = self.keys.iter().zip(values).map(|((key, _), value)| match value {
                Value::Number(number) => format!("{key}={number}"),
                Value::Word(word) => format!("{key}=\"{word}\""),
            });
            writeln!(out, "  {i} [{}];", values.collect::<Vec<_>>().join(", "))?;
        }
        for (from, letter, to) in self.edges {
            match letter {
                Some(letter) => writeln!(out, "  {from} -> {to} [label={letter}];")?,
                None => writeln!(out, "  {from} -> {to};")?,
            }
        }
        writeln!(out, "}}")?;
        Ok(out)
    }
}

impl Value {
    /// A number.
    pub fn of(number: impl Into<i64>) -> Self {
        Self::Number(number.into())
    }
}

impl Display for Value {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(out),
            Self::Word(word) => word.fmt(out),
        }
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
