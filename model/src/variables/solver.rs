//! `solver.*`: which method integrates the motion, how well, and what that cost.

use super::AlwaysRow;
use crate::variable::units::{ONE, SECOND};
use crate::variable::{Access, Bound, Enumeration, Kind, Meta, Role, Row, output, parameter};

/// How the motion is integrated.
#[derive(Clone, Debug, Default)]
pub struct Solver {
    /// Number of the method in [`METHODS`]; which one is in force, [`Solver::method_in_force`] says.
    pub method: i32,
    /// The same number for hosts that cannot set an enumeration; 0: as `method` says.
    pub method_number: i32,
    /// Relative to the size of the motion \[1].
    pub relative_tolerance: f64,
    /// The least error that is asked for, in nominals \[1].
    pub absolute_tolerance: f64,
    /// Longest step of `symplectic` \[s]; 0: chosen from the scene.
    pub step_size: f64,
    /// Order of `symplectic`: 2, 4, 6 or 8.
    pub order: i32,
    /// How many evaluations of the right-hand side one communication step may take.
    pub max_evaluations: f64,
}

impl Solver {
    /// The number of the method that integrates.
    pub fn method_in_force(&self) -> i32 {
        if self.method_number == 0 { self.method } else { self.method_number }
    }

    /// The variable that says so.
    pub fn method_variable(&self) -> &'static str {
        if self.method_number == 0 { "solver.method" } else { "solver.method_number" }
    }
}

/// The numbers of the methods, never reused.
pub mod numbers {
    /// Chosen by the scene.
    pub const AUTO: i32 = 1;
    /// Explicit, order 5.
    pub const DOPRI5: i32 = 2;
    /// Explicit, order 8.
    pub const DOP853: i32 = 3;
    /// A composition of drifts and kicks.
    pub const SYMPLECTIC: i32 = 4;
    /// Implicit, order 5.
    pub const STIFF: i32 = 5;
    /// Taylor's series.
    pub const TAYLOR: i32 = 6;
}

/// The type of `solver.method`.
pub static METHODS: Enumeration = Enumeration {
    name: "SolverMethod",
    items: &[
        (
            numbers::AUTO,
            "auto",
            "taylor or dop853, and stiff where stability would hold these to short steps; exact where nothing acts",
        ),
        (numbers::DOPRI5, "dopri5", "explicit Runge-Kutta pair of Dormand and Prince, order 5(4), adaptive"),
        (numbers::DOP853, "dop853", "explicit Runge-Kutta method of Dormand and Prince, order 8(5,3), adaptive"),
        (
            numbers::SYMPLECTIC,
            "symplectic",
            "composition of free drifts and kicks, order solver.order, steps of at most solver.step_size",
        ),
        (numbers::STIFF, "stiff", "implicit Runge-Kutta method Radau IIA, order 5, exact Jacobian, adaptive"),
        (
            numbers::TAYLOR,
            "taylor",
            "power series in time, adaptive; dop853 where the motion has none, or where stability holds their steps",
        ),
    ],
};

/// What a relative tolerance \[1] must be: no tighter than double precision can keep.
pub const TOLERANCES: Bound = Bound::Within(1e-14, 1e-1);

/// The absolute tolerances that are possible: where a component passes zero nothing else counts, and far below the rounding
/// of the others steps would shrink without end; and an error of the nominals' size is no solution.
const ABSOLUTE_TOLERANCES: Bound = Bound::ZeroOrWithin(1e-20, 1e-2);

/// The possible values of `solver.method_number`.
const METHOD_NUMBERS: Bound = Bound::OneOf(&{
    let mut numbers = [0.0; METHODS.items.len() + 1];
    let mut n = 0;
    while n < METHODS.items.len() {
        numbers[n + 1] = METHODS.items[n].0 as f64;
        n += 1;
    }
    numbers
});

pub(super) const ROWS: &[AlwaysRow] = &[
    Row {
        meta: Meta {
            name: "solver.method",
            description: "method of integration",
            unit: &ONE,
            kind: Kind::Enumeration(&METHODS),
            role: Role::Parameter { default: Some(numbers::AUTO as f64), bound: Bound::Finite },
        },
        access: Access::Parameter {
            get: |s| f64::from(s.solver.method),
            set: |s, value| s.solver.method = value as i32,
        },
    },
    parameter!(
        solver.relative_tolerance,
        &ONE,
        Some(1e-8),
        TOLERANCES,
        "tolerance of a step's error, relative to how far and how fast the motion goes"
    ),
    parameter!(
        solver.absolute_tolerance,
        &ONE,
        Some(0.0),
        ABSOLUTE_TOLERANCES,
        "lower limit of the step error tolerance, relative to the nominal values"
    ),
    output!("solver.steps", &ONE, "steps accepted so far", |_, r| super::constant(r.cost.steps)),
    output!("solver.rejected", &ONE, "steps rejected so far", |_, r| super::constant(r.cost.rejected)),
    output!(
        "solver.evaluations",
        &ONE,
        "evaluations of the right-hand side so far, those for outputs between two steps included",
        |_, r| super::constant(r.cost.evaluations)
    ),
    output!("solver.next_step", &SECOND, "proposed size of the next step; 0 before the run", |_, r| {
        super::constant(r.cost.next_step)
    }),
    output!(
        "solver.error_estimate",
        &ONE,
        "sum of the local error estimates of the accepted steps, relative as the tolerance is",
        |_, r| super::constant(r.cost.error_estimate)
    ),
    parameter!(
        solver.step_size,
        &SECOND,
        Some(0.0),
        Bound::NotNegative,
        "longest step of the symplectic method, shorter where the relative tolerance asks for it; 0: chosen from the scene"
    ),
    Row {
        meta: Meta {
            name: "solver.order",
            description: "order of the symplectic method",
            unit: &ONE,
            kind: Kind::Integer,
            role: Role::Parameter { default: Some(6.0), bound: Bound::OneOf(&[2.0, 4.0, 6.0, 8.0]) },
        },
        access: Access::Parameter { get: |s| f64::from(s.solver.order), set: |s, value| s.solver.order = value as i32 },
    },
    parameter!(
        solver.max_evaluations,
        &ONE,
        Some(1e7),
        Bound::Within(1e3, 1e12),
        "work that one communication step may take, in explicit evaluations of the right-hand side"
    ),
    Row {
        meta: Meta {
            name: "solver.method_number",
            description: "solver.method as an Integer, for hosts that cannot set an Enumeration; 0: as solver.method says",
            unit: &ONE,
            kind: Kind::Integer,
            role: Role::Parameter { default: Some(0.0), bound: METHOD_NUMBERS },
        },
        access: Access::Parameter {
            get: |s| f64::from(s.solver.method_number),
            set: |s, value| s.solver.method_number = value as i32,
        },
    },
    output!(
        "solver.time",
        &SECOND,
        "time that the motion has reached; after a discarded step, the last successful time",
        |_, r| { r.motion.t }
    ),
];
