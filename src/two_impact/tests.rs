//! The closed forms against their equations.
