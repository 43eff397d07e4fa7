//! The checker's tests on recorded documents, which need no producer.

mod cases;
mod claimed;
mod effort;
#[path = "../../../tests/environment/mod.rs"]
mod environment;
mod keys;
mod recorded;
mod schemas;
mod unchecked;
