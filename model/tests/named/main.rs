//! Runs of scenes whose parameters go by name: over the list of all effects, which takes long to compile, so one program.

#[path = "../harness/mod.rs"]
mod harness;
#[path = "../oracles/mod.rs"]
mod oracles;

mod auto;
mod between_steps;
mod dependencies_of_draws;
mod endless;
mod exact_asymmetric;
mod exact_bearing;
mod exact_dependencies;
mod exact_each_method;
mod exact_exchange;
mod exact_extrapolation;
mod exact_heavy_top;
mod exact_honest_tolerance;
mod exact_imposed_speed;
mod exact_port;
mod exact_stored;
mod exact_tangents;
mod exact_turns;
mod general;
mod ledger;
mod ordinary;
mod scenes;
mod symplectic;
