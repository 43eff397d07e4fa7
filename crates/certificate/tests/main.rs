//! The checker's tests on recorded documents, which need no producer.

#[path = "../../../tests/spoiled/changes.rs"]
mod changes;
mod claimed;
<<<<<<< HEAD
#[path = "../../../tests/effort/mod.rs"]
mod effort;
=======
mod components;
>>>>>>> mend
#[path = "../../../tests/environment/mod.rs"]
mod environment;
mod globals;
mod recorded;
mod schemas;
mod tangency;
mod tiles;
