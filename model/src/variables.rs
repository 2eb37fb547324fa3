//! The one list of variables. A variable is written once, here or in the file of its effect: its value reference, its
//! typed access, its XML line and its documentation follow.

use crate::body::Body;
use crate::effects::{Effects, Info};
use crate::energy::Ledger;
use crate::error::Invalid;
use crate::integrate::Cost;
use crate::rotation::Angle;
use crate::state::Kinematics;
use crate::variable::units::*;
use crate::variable::{Access, Bound, Depends, Enumeration, Kind, Meta, Place, Role, Row, output, parameter};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::PI;

/// The parameters that are always there.
#[derive(Clone, Debug, Default)]
pub struct Setup {
    /// `rotor.*`
    pub rotor: Body,
    /// `start.*`
    pub start: Start,
    /// `solver.*`
    pub solver: Solver,
}

/// The motion at the start, in O.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// Position of the mass centre [m].
    pub r_c: Vector3<f64>,
    /// Velocity of the mass centre [m/s].
    pub v_c: Vector3<f64>,
    /// Axial angle φ [rad].
    pub phi: f64,
    /// Transverse Euler vector γ, y and z [rad].
    pub gamma: Vector2<f64>,
    /// Angular velocity ω [rad/s].
    pub omega: Vector3<f64>,
}

/// How the motion is integrated.
#[derive(Clone, Debug, Default)]
pub struct Solver {
    /// Number of the method in [`METHODS`].
    pub method: i32,
    /// Relative tolerance [1].
    pub relative_tolerance: f64,
    /// Absolute tolerance in nominals [1]; 0: the relative one.
    pub absolute_tolerance: f64,
}

/// What an instant of the run shows.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    /// The motion.
    pub motion: Kinematics<f64>,
    /// φ, wrapped.
    pub phi: Angle,
    /// The energies.
    pub ledger: Ledger,
    /// What the solver spent.
    pub cost: Cost,
}

impl Reading {
    fn r_c(&self) -> &Vector3<f64> {
        &self.motion.at.r_c
    }

    fn v_c(&self) -> &Vector3<f64> {
        &self.motion.at.v_c
    }

    fn k_c(&self) -> &Vector3<f64> {
        &self.motion.at.k_c
    }

    /// γ from e [rad], where rounding gives |γ| > π: π.
    fn gamma(&self) -> Vector3<f64> {
        let gamma = self.motion.tilt.gamma();
        if gamma.norm() > PI { gamma * (1.0 - 2.0 * f64::EPSILON) } else { gamma }
    }

    fn omega(&self) -> &Vector3<f64> {
        &self.motion.omega
    }

    fn axis(&self) -> &Vector3<f64> {
        self.motion.axis()
    }
}

/// The type of `solver.method`.
pub static METHODS: Enumeration = Enumeration {
    name: "SolverMethod",
    items: &[
        (2, "dopri5", "explicit Runge-Kutta pair of Dormand and Prince, order 5(4), adaptive"),
        (3, "dop853", "explicit Runge-Kutta method of Dormand and Prince, order 8(5,3), adaptive"),
    ],
};

/// What a relative tolerance [1] must be: no tighter than double precision can keep.
pub const TOLERANCES: Bound = Bound::Within(1e-14, 1e-1);

type Always = Row<Setup, Reading>;

const ANY: Bound = Bound::Finite;
const ATTITUDE: Depends = Depends::On(&["start.gamma"]);
const MOMENTUM: Depends = Depends::On(&["rotor.Ja", "rotor.Jt", "start.gamma", "start.omega"]);
const NOTHING: Depends = Depends::On(&[]);

/// The blocks that are always there, in the order of their value references.
pub static BLOCKS: [&[Always]; 5] = [ROTOR, START, SOLVER, MOTION, ENERGY];

const ROTOR: &[Always] = &[
    parameter!(rotor.m, &KILOGRAM, None, Bound::Positive, "mass"),
    parameter!(rotor.Ja, &KILOGRAM_METRE_SQUARED, None, Bound::Positive, "axial moment of inertia"),
    parameter!(rotor.Jt, &KILOGRAM_METRE_SQUARED, None, Bound::Positive, "transverse moment of inertia about c"),
    parameter!(rotor.l, &METRE, None, ANY, "distance from the support point a to the mass centre c"),
];

const START: &[Always] = &[
    parameter!(start.r_c.x, &METRE, Some(0.0), ANY, "position of the mass centre at the start, x"),
    parameter!(start.r_c.y, &METRE, Some(0.0), ANY, "position of the mass centre at the start, y"),
    parameter!(start.r_c.z, &METRE, Some(0.0), ANY, "position of the mass centre at the start, z"),
    parameter!(start.v_c.x, &METRE_PER_SECOND, Some(0.0), ANY, "velocity of the mass centre at the start, x"),
    parameter!(start.v_c.y, &METRE_PER_SECOND, Some(0.0), ANY, "velocity of the mass centre at the start, y"),
    parameter!(start.v_c.z, &METRE_PER_SECOND, Some(0.0), ANY, "velocity of the mass centre at the start, z"),
    parameter!(start.phi, &RADIAN, Some(0.0), ANY, "axial angle at the start"),
    parameter!(
        "start.gamma.y",
        start.gamma.x,
        &RADIAN,
        Some(0.0),
        ANY,
        "transverse Euler vector at the start, y (|gamma| <= pi)"
    ),
    parameter!(
        "start.gamma.z",
        start.gamma.y,
        &RADIAN,
        Some(0.0),
        ANY,
        "transverse Euler vector at the start, z (|gamma| <= pi)"
    ),
    parameter!(start.omega.x, &RADIAN_PER_SECOND, Some(0.0), ANY, "angular velocity at the start, x"),
    parameter!(start.omega.y, &RADIAN_PER_SECOND, Some(0.0), ANY, "angular velocity at the start, y"),
    parameter!(start.omega.z, &RADIAN_PER_SECOND, Some(0.0), ANY, "angular velocity at the start, z"),
];

const SOLVER: &[Always] = &[
    Row {
        meta: Meta {
            name: "solver.method",
            description: "method of integration",
            unit: &ONE,
            kind: Kind::Enumeration(&METHODS),
            role: Role::Parameter { default: Some(3.0), bound: ANY },
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
        Bound::NotNegative,
        "tolerance of a step's error in nominals; 0: the relative tolerance"
    ),
    output!("solver.steps", &ONE, NOTHING, "steps accepted so far", |_, r| r.cost.steps),
    output!("solver.rejected", &ONE, NOTHING, "steps rejected so far", |_, r| r.cost.rejected),
    output!(
        "solver.evaluations",
        &ONE,
        NOTHING,
        "evaluations of the right-hand side so far, those for outputs between two steps included",
        |_, r| r.cost.evaluations
    ),
    output!(
        "solver.next_step",
        &SECOND,
        NOTHING,
        "the step that the solver would like next; 0 before the run",
        |_, r| r.cost.next_step
    ),
    output!(
        "solver.error_estimate",
        &ONE,
        NOTHING,
        "sum of the local error estimates of the accepted steps, relative as the tolerance is",
        |_, r| r.cost.error_estimate
    ),
];

const MOTION: &[Always] = &[
    output!("r_c.x", &METRE, Depends::On(&["start.r_c.x"]), "position of the mass centre, x", |_, r| r.r_c().x),
    output!("r_c.y", &METRE, Depends::On(&["start.r_c.y"]), "position of the mass centre, y", |_, r| r.r_c().y),
    output!("r_c.z", &METRE, Depends::On(&["start.r_c.z"]), "position of the mass centre, z", |_, r| r.r_c().z),
    output!("v_c.x", &METRE_PER_SECOND, Depends::On(&["start.v_c.x"]), "velocity of the mass centre, x", |_, r| r
        .v_c()
        .x),
    output!("v_c.y", &METRE_PER_SECOND, Depends::On(&["start.v_c.y"]), "velocity of the mass centre, y", |_, r| r
        .v_c()
        .y),
    output!("v_c.z", &METRE_PER_SECOND, Depends::On(&["start.v_c.z"]), "velocity of the mass centre, z", |_, r| r
        .v_c()
        .z),
    output!("phi", &RADIAN, Depends::On(&["start.phi"]), "axial angle, 2 pi turns + angle", |_, r| r.phi.radians()),
    output!("turns", &ONE, Depends::On(&["start.phi"]), "whole turns of the axial angle", |_, r| r.phi.turns),
    output!("angle", &RADIAN, Depends::On(&["start.phi"]), "axial angle less its whole turns, in [0, 2 pi)", |_, r| r
        .phi
        .remainder),
    output!("gamma.y", &RADIAN, ATTITUDE, "transverse Euler vector, y", |_, r| r.gamma().y),
    output!("gamma.z", &RADIAN, ATTITUDE, "transverse Euler vector, z", |_, r| r.gamma().z),
    output!("omega.x", &RADIAN_PER_SECOND, MOMENTUM, "angular velocity, x", |_, r| r.omega().x),
    output!("omega.y", &RADIAN_PER_SECOND, MOMENTUM, "angular velocity, y", |_, r| r.omega().y),
    output!("omega.z", &RADIAN_PER_SECOND, MOMENTUM, "angular velocity, z", |_, r| r.omega().z),
    output!("omega_phi", &RADIAN_PER_SECOND, MOMENTUM, "axial rate, the rate of phi", |_, r| r.motion.axial_rate()),
    output!("K_c.x", &ANGULAR_MOMENTUM, MOMENTUM, "angular momentum about the mass centre, x", |_, r| r.k_c().x),
    output!("K_c.y", &ANGULAR_MOMENTUM, MOMENTUM, "angular momentum about the mass centre, y", |_, r| r.k_c().y),
    output!("K_c.z", &ANGULAR_MOMENTUM, MOMENTUM, "angular momentum about the mass centre, z", |_, r| r.k_c().z),
    output!("axis.x", &ONE, ATTITUDE, "rotor axis t, x", |_, r| r.axis().x),
    output!("axis.y", &ONE, ATTITUDE, "rotor axis t, y", |_, r| r.axis().y),
    output!("axis.z", &ONE, ATTITUDE, "rotor axis t, z", |_, r| r.axis().z),
];

const KINETIC: &[&str] = &["rotor.m", "rotor.Ja", "rotor.Jt", "start.v_c", "start.gamma", "start.omega"];

const ENERGY: &[Always] = &[
    output!("energy.kinetic", &JOULE, Depends::On(KINETIC), "kinetic energy", |_, r| r.ledger.kinetic),
    output!("energy.potential", &JOULE, Depends::Potential, "potential energy of all effects", |_, r| r
        .ledger
        .potential),
    output!("energy.total", &JOULE, Depends::PotentialAnd(KINETIC), "kinetic and potential energy", |_, r| r
        .ledger
        .total()),
    output!("energy.supplied", &JOULE, NOTHING, "work supplied since the start", |_, r| r.ledger.supplied),
    output!("energy.dissipated", &JOULE, NOTHING, "work lost since the start", |_, r| r.ledger.dissipated),
    output!(
        "energy.residual",
        &JOULE,
        NOTHING,
        "total - total(start) - supplied + dissipated: zero for an exact solution",
        |_, r| r.ledger.residual()
    ),
];

const _: () = {
    assert!(BLOCKS.len() <= Place::FIRST_EFFECT as usize, "blocks run into those of the effects");
    let mut i = 0;
    while i < BLOCKS.len() {
        assert!(BLOCKS[i].len() <= 256, "a block has at most 256 variables");
        i += 1;
    }
};

/// The row at this place, if it is one of those that are always there.
pub fn always(place: Place) -> Option<&'static Always> {
    BLOCKS.get(place.block as usize)?.get(place.row)
}

impl Setup {
    /// The first of its parameters whose value is not possible.
    fn check(&self) -> Result<(), Invalid> {
        for row in BLOCKS.into_iter().flatten() {
            if let Access::Parameter { get, .. } = row.access {
                row.meta.check(|| row.meta.name.into(), get(self))?;
            }
        }
        self.rotor.check()?;
        let theta = self.start.gamma.norm();
        if theta > PI {
            return Err(Invalid::new("|start.gamma|", theta, format!("at most pi = {PI:?}")));
        }
        Ok(())
    }
}

/// The parameters of a scene: those that are always there and those of its effects.
#[derive(Clone, Debug, Default)]
pub struct Parameters<E> {
    /// Those that are always there.
    pub setup: Setup,
    /// Those of the effects.
    pub effects: E,
}

impl<E: Effects> Parameters<E> {
    /// The full name of the variable at this place; None where there is none.
    pub fn name(place: Place) -> Option<String> {
        always(place).map_or_else(|| E::name(place), |row| Some(row.meta.name.to_owned()))
    }

    /// What is said of the variable at this place, parameter or output; None where there is none.
    pub fn meta(place: Place) -> Option<&'static Meta> {
        always(place).map_or_else(|| E::meta(place), |row| Some(&row.meta))
    }

    /// The value of a parameter; None where there is none at this place.
    pub fn get(&self, place: Place) -> Option<f64> {
        match always(place) {
            None => self.effects.parameter(place),
            Some(Row { access: Access::Parameter { get, .. }, .. }) => Some(get(&self.setup)),
            Some(_) => None,
        }
    }

    /// Sets a parameter; false where there is none at this place.
    pub fn set(&mut self, place: Place, value: f64) -> bool {
        match always(place) {
            None => self.effects.set_parameter(place, value),
            Some(Row { access: Access::Parameter { set, .. }, .. }) => {
                set(&mut self.setup, value);
                true
            }
            Some(_) => false,
        }
    }

    /// The first parameter whose value is not possible.
    pub fn check(&self) -> Result<(), Invalid> {
        self.setup.check()?;
        self.effects.check()
    }
}

/// A variable of a scene, by its full name.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its full name.
    pub name: String,
    /// Where it stands.
    pub place: Place,
    /// What is said of it.
    pub meta: Meta,
}

/// The list: all variables of a scene that calls for `effects`, each with its index from 1 among its kind.
pub fn of_scene(effects: &[(&'static Info, u32)]) -> Vec<Variable> {
    let mut list = Vec::new();
    let mut block = |block: u32, prefix: &str, metas: Vec<Meta>| {
        list.extend(metas.into_iter().enumerate().map(|(row, meta)| Variable {
            name: format!("{prefix}{}", meta.name),
            place: Place { block, row },
            meta,
        }));
    };
    for (number, rows) in (0..).zip(BLOCKS) {
        block(number, "", rows.iter().map(|row| row.meta).collect());
    }
    for (info, index) in effects {
        block(Place::effect_block(info.number, *index), &format!("{}.", info.name), (info.metas)());
    }
    list
}
