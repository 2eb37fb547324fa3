//! Exact answers, each with its source, kept apart from the tests that use them. None of this code calls the library's
//! mathematics: the crate does not know the model. `tests/` checks each answer against something that it was not made from.

pub mod asymmetric;
pub mod bounds;
pub mod elliptic;
pub mod extrapolation;
pub mod fixed;
pub mod forward_whirl;
pub mod jeffcott;
pub mod limited_power;
pub mod machine;
pub mod monotone;
pub mod motion;
pub mod numerics;
pub mod paper;
pub mod rigid_body;
pub mod rotation;
pub mod top;
pub mod trees;
pub mod whirl;
pub mod words;
