//! `solver.*`: which method integrates the motion, how well, and what that cost.

use super::AlwaysRow;
use crate::variable::units::{ONE, SECOND};
use crate::variable::{Access, Bound, Enumeration, Kind, Meta, Role, Row, output, parameter};

/// How the motion is integrated.
#[derive(Clone, Debug, Default)]
pub struct Solver {
    /// Number of the method in [`METHODS`].
    pub method: i32,
    /// Relative tolerance [1].
    pub relative_tolerance: f64,
    /// Absolute tolerance in nominals [1]; 0: the relative one.
    pub absolute_tolerance: f64,
    /// Step of `symplectic` [s]; 0: chosen from the scene.
    pub step_size: f64,
    /// Order of `symplectic`: 2, 4, 6 or 8.
    pub order: i32,
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
}

/// The type of `solver.method`.
pub static METHODS: Enumeration = Enumeration {
    name: "SolverMethod",
    items: &[
        (numbers::AUTO, "auto", "the method that would cost least, by the linear equations at the start"),
        (numbers::DOPRI5, "dopri5", "explicit Runge-Kutta pair of Dormand and Prince, order 5(4), adaptive"),
        (numbers::DOP853, "dop853", "explicit Runge-Kutta method of Dormand and Prince, order 8(5,3), adaptive"),
        (
            numbers::SYMPLECTIC,
            "symplectic",
            "composition of free drifts and kicks, order solver.order, steps of solver.step_size",
        ),
        (numbers::STIFF, "stiff", "implicit Runge-Kutta method Radau IIA, order 5, exact Jacobian, adaptive"),
    ],
};

/// What a relative tolerance [1] must be: no tighter than double precision can keep.
pub const TOLERANCES: Bound = Bound::Within(1e-14, 1e-1);

/// The absolute tolerances that are possible: where a component passes zero nothing else counts, and far below the rounding
/// of the others steps would shrink without end.
const LEAST_ABSOLUTE: Bound = Bound::ZeroOrFrom(1e-20);

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
        "tolerance of a step's error, relative to the larger of the value and its nominal"
    ),
    parameter!(
        solver.absolute_tolerance,
        &ONE,
        Some(0.0),
        LEAST_ABSOLUTE,
        "tolerance of a step's error in nominals; 0: the relative tolerance"
    ),
    output!("solver.steps", &ONE, "steps accepted so far", |_, r| super::constant(r.cost.steps)),
    output!("solver.rejected", &ONE, "steps rejected so far", |_, r| super::constant(r.cost.rejected)),
    output!(
        "solver.evaluations",
        &ONE,
        "evaluations of the right-hand side so far, those for outputs between two steps included",
        |_, r| super::constant(r.cost.evaluations)
    ),
    output!("solver.next_step", &SECOND, "the step that the solver would like next; 0 before the run", |_, r| {
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
        "step of the symplectic method; 0: chosen from the scene"
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
];
