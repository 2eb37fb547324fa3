//! The rotor of split-rotor: its rotation split into an axial angle φ and a transverse Euler vector γ (Sorokin and
//! Zhang 2018), its effects, its integration. A plain library: no FMI, no unsafe code.
//!
//! The modules stand on floors; each imports only from below (`docs/architecture.md`, held by `tests/tidy.rs`).
//! Equation numbers (`eq. n`) are those of `docs/theory.md`.
#![forbid(unsafe_code)]

// Floor 0: mathematics and records that know no rotor.
pub mod coefficient;
pub mod decompositions;
pub mod dual;
pub mod error;
pub mod integrate;
pub mod log;
pub mod rotation;
pub mod scalar;
pub mod section;
pub mod signal;
pub mod stored;
#[cfg(feature = "scenes")]
pub mod traced;

// Floor 1: kinematics, and the record of a variable, which may be read from them.
pub mod body;
pub mod state;
pub mod variable;

// Floor 2: what acts on the rotor.
pub mod effects;

// Floor 3: equations of motion and the energy ledger.
pub mod energy;
pub mod rotor;
pub mod splitting;

// Floor 4: the one list of variables.
pub mod variables;

// Floor 5: a whole run.
pub mod simulation;

// Floor 6: what engineers ask before a run, over the list of all effects.
#[cfg(feature = "general")]
pub mod linear;
#[cfg(feature = "general")]
pub mod periodic;

// Floor 7: scenes and their modelDescription.xml, for build.rs and xtask.
#[cfg(feature = "scenes")]
pub mod dependencies;
#[cfg(feature = "scenes")]
pub mod scene;
#[cfg(feature = "scenes")]
pub mod xml;
