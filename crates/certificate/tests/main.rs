//! The checker's tests on recorded documents, which need no producer.

mod altered;
#[path = "../../../tests/corrupted/changes.rs"]
mod changes;
mod claimed;
mod components;
#[path = "../../../tests/effort/mod.rs"]
mod effort;
#[path = "../../../tests/environment/mod.rs"]
mod environment;
mod forged;
mod globals;
mod recorded;
mod schemas;
mod tangency;
mod tiles;
mod unchecked;
