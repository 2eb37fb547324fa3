//! Exact answers, each with its source, kept apart from the tests that use them. None of this code calls the library's
//! mathematics; `exact_oracles.rs` checks each answer against something that it was not made from.

#![allow(dead_code, reason = "each test crate uses a part")]

pub mod asymmetric;
pub mod cross_coupling;
pub mod elliptic;
pub mod extrapolation;
pub mod fixed;
pub mod heavy_top;
pub mod jeffcott;
pub mod machine;
pub mod motion;
pub mod numerics;
pub mod paper;
pub mod point_masses;
pub mod rigid_body;
pub mod rotating_damping;
pub mod rotation;
pub mod top;
pub mod trees;
pub mod words;
