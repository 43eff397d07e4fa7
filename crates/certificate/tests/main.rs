//! The checker's tests on recorded documents, which need no producer.

mod cases;
mod claimed;
#[path = "../../../tests/environment/mod.rs"]
mod environment;
mod keys;
mod limits;
mod recorded;
mod schemas;
mod unchecked;
