//! The one list of variables. A variable is written once, here or in the file of its effect: its value reference, its
//! typed access, its XML line and its documentation follow.

mod solver;

pub use solver::{METHODS, Solver, TOLERANCES, numbers};

use crate::body::{self, Body, Shape};
use crate::dual::Tangent;
use crate::effects::{Effects, Info, Motion, full_name};
use crate::energy::Ledger;
use crate::error::Invalid;
use crate::integrate::Cost;
use crate::rotation::Chart;
use crate::rotor;
use crate::scalar::Scalar;
use crate::state::{COORDINATES, DISSIPATED, Kinematics, Rates, SUPPLIED, WITH_WORK};
use crate::stored::{Damaged, Stored, Walk};
#[cfg(feature = "scenes")]
use crate::traced::Traced;
use crate::variable::units::*;
use crate::variable::{Access, Bound, Kind, Meta, Output, Place, Role, Row, Shown, output, parameter};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::{PI, TAU};

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
    /// Position of the mass centre \[m].
    pub r_c: Vector3<f64>,
    /// Velocity of the mass centre [m/s].
    pub v_c: Vector3<f64>,
    /// Axial angle φ \[rad].
    pub phi: f64,
    /// Transverse Euler vector γ, y and z \[rad].
    pub gamma: Vector2<f64>,
    /// Angular velocity ω [rad/s].
    pub omega: Vector3<f64>,
    /// Whether the motion begins where what acts balances, sought from there.
    pub at_rest: bool,
}

/// What an instant of the run shows.
#[derive(Clone, Copy, Debug)]
pub struct Reading<S: Scalar = f64> {
    /// The motion.
    pub motion: Kinematics<S>,
    /// The energies.
    pub ledger: Ledger<S>,
    /// What the solver spent.
    pub cost: Cost,
}

impl<S: Scalar> Reading<S> {
    fn r_c(&self) -> Vector3<S> {
        self.motion.r_c()
    }

    fn v_c(&self) -> Vector3<S> {
        self.motion.v_c()
    }

    fn k_c(&self) -> Vector3<S> {
        self.motion.momentum()
    }

    /// γ_y and γ_z from e \[rad], where rounding gives |γ| > π: π.
    fn gamma(&self) -> Vector2<S> {
        let gamma = self.motion.tilt.gamma();
        let is_crossed = self.motion.tilt.chart() == Chart::FromMinusE;
        if is_crossed && gamma.map(S::re).norm_squared() > PI * PI {
            gamma * S::constant(1.0 - 2.0 * f64::EPSILON)
        } else {
            gamma
        }
    }

    fn omega(&self) -> &Vector3<S> {
        &self.motion.omega
    }

    fn axis(&self) -> &Vector3<S> {
        self.motion.axis()
    }

    /// The coordinates and the work by their number.
    fn state(&self, n: usize) -> S {
        let mut whole = [S::zero(); WITH_WORK];
        self.motion.at.write(&mut whole);
        [whole[SUPPLIED], whole[DISSIPATED]] = [self.ledger.supplied, self.ledger.dissipated];
        whole[n]
    }
}

/// What an instant shows, and the state of N numbers behind it.
#[derive(Clone, Copy, Debug)]
pub struct Instant<const N: usize, S: Scalar = f64> {
    /// What it shows.
    pub reading: Reading<S>,
    /// The state.
    pub state: [S; N],
}

impl<const N: usize, S: Scalar> Instant<N, S> {
    /// What a motion with this state shows, and the total energy at the start \[J].
    pub fn new<E: Effects>(motion: Kinematics<S>, state: [S; N], effects: &E, total_at_start: f64, cost: Cost) -> Self {
        let layout = E::layout::<N>();
        let ledger = Ledger::new(&motion, &state[layout.own()], effects, layout.read_work(&state), total_at_start);
        Self { reading: Reading { motion, ledger, cost }, state }
    }

    /// The states of the effects.
    fn own<E: Effects>(&self) -> &[S] {
        &self.state[E::layout::<N>().own()]
    }

    /// The rates of all of it under these effects.
    pub fn rates<E: Effects>(&self, effects: &E) -> [S; N] {
        rotor::whole_rates(effects, &self.reading.motion, &self.state)
    }
}

impl<const N: usize> Instant<N> {
    /// The same with the derivatives of a state that moves in the direction `seeds` and of time that moves by `time` \[s],
    /// under these effects.
    pub fn moving<S: Scalar, E: Effects>(&self, seeds: &[f64; N], time: f64, effects: &E) -> Instant<N, S> {
        let state: [S; N] = std::array::from_fn(|n| S::moving(self.state[n], seeds[n]));
        let Kinematics { body, t, turns, tilt, .. } = self.reading.motion;
        let (at, t) = (E::layout::<N>().read(&state, body::ROTOR), S::moving(t, time));
        let motion = rotor::imposed(effects, Kinematics::new(body, tilt.chart(), at).when(t, turns));
        Instant::new(motion, state, effects, self.reading.ledger.total_at_start, self.reading.cost)
    }
}

/// Rates as outputs see them, those of an effect's own states being the first of `count` from number `from`.
fn seen<E: Effects, S: Scalar, const N: usize>(rates: &[S; N], from: usize, count: usize) -> Rates<'_, S> {
    let layout = E::layout::<N>();
    let own = &rates[layout.own()][from..][..count];
    Rates { coordinates: layout.read(rates, body::ROTOR), work: layout.read_work(rates), own }
}

/// The variables that are always there are read from a [`Reading`].
pub enum Always {}

impl Shown for Always {
    type Of<'m, S: Scalar> = Reading<S>;
}

type AlwaysRow = Row<Setup, Always>;

fn constant<S: Scalar>(value: f64) -> S {
    S::constant(value)
}

const ANY: Bound = Bound::Finite;

/// The blocks that are always there, in the order of their value references.
pub static BLOCKS: [&[AlwaysRow]; 6] = [ROTOR, START, solver::ROWS, MOTION, ENERGY, STATE];

/// Which of them is that of the solver.
const SOLVER: u32 = 2;

const ROTOR: &[AlwaysRow] = &[
    parameter!(rotor.m, &KILOGRAM, None, Bound::Positive, "mass of the balanced rotor"),
    parameter!(
        rotor.Ja,
        &KILOGRAM_METRE_SQUARED,
        None,
        Bound::Positive,
        "axial moment of inertia of the balanced rotor"
    ),
    parameter!(
        rotor.Jt,
        &KILOGRAM_METRE_SQUARED,
        None,
        Bound::Positive,
        "transverse moment of inertia of the balanced rotor about c"
    ),
    parameter!(rotor.l, &METRE, None, ANY, "distance from the support point a to the mass centre c"),
];

const START: &[AlwaysRow] = &[
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
    Row {
        meta: Meta {
            kind: Kind::Boolean,
            ..Meta::parameter(
                "start.at_rest",
                &ONE,
                Some(0.0),
                ANY,
                "start in equilibrium at spin start.omega.x, sought from start.r_c and start.gamma",
            )
        },
        access: Access::Parameter {
            get: |setup| f64::from(setup.start.at_rest),
            set: |setup, value| setup.start.at_rest = value != 0.0,
        },
    },
];

const MOTION: &[AlwaysRow] = &[
    output!("r_c.x", &METRE, "position of the mass centre, x", |_, r| r.r_c().x),
    output!("r_c.y", &METRE, "position of the mass centre, y", |_, r| r.r_c().y),
    output!("r_c.z", &METRE, "position of the mass centre, z", |_, r| r.r_c().z),
    output!("v_c.x", &METRE_PER_SECOND, "velocity of the mass centre, x", |_, r| r.v_c().x),
    output!("v_c.y", &METRE_PER_SECOND, "velocity of the mass centre, y", |_, r| r.v_c().y),
    output!("v_c.z", &METRE_PER_SECOND, "velocity of the mass centre, z", |_, r| r.v_c().z),
    output!("phi", &RADIAN, "axial angle, 2 pi turns + angle", |_, r| r.motion.phi()),
    output!("turns", &ONE, "whole turns of the axial angle", |_, r| r.motion.phi().jumping(r.motion.angle().turns)),
    output!("angle", &RADIAN, "axial angle less its whole turns, in [0, 2 pi)", |_, r| r
        .motion
        .phi()
        .with_value(r.motion.angle().remainder)),
    output!("gamma.y", &RADIAN, "transverse Euler vector, y", |_, r| r.gamma().x),
    output!("gamma.z", &RADIAN, "transverse Euler vector, z", |_, r| r.gamma().y),
    output!("omega.x", &RADIAN_PER_SECOND, "angular velocity, x", |_, r| r.omega().x),
    output!("omega.y", &RADIAN_PER_SECOND, "angular velocity, y", |_, r| r.omega().y),
    output!("omega.z", &RADIAN_PER_SECOND, "angular velocity, z", |_, r| r.omega().z),
    output!("omega_phi", &RADIAN_PER_SECOND, "axial rate, the rate of phi", |_, r| r.motion.axial_rate()),
    output!("K_c.x", &ANGULAR_MOMENTUM, "angular momentum about the mass centre, x", |_, r| r.k_c().x),
    output!("K_c.y", &ANGULAR_MOMENTUM, "angular momentum about the mass centre, y", |_, r| r.k_c().y),
    output!("K_c.z", &ANGULAR_MOMENTUM, "angular momentum about the mass centre, z", |_, r| r.k_c().z),
    output!("axis.x", &ONE, "rotor axis t, x", |_, r| r.axis().x),
    output!("axis.y", &ONE, "rotor axis t, y", |_, r| r.axis().y),
    output!("axis.z", &ONE, "rotor axis t, z", |_, r| r.axis().z),
];

const ENERGY: &[AlwaysRow] = &[
    output!("energy.kinetic", &JOULE, "kinetic energy", |_, r| r.ledger.kinetic),
    output!("energy.potential", &JOULE, "potential energy of all effects", |_, r| r.ledger.potential),
    output!("energy.total", &JOULE, "kinetic and potential energy", |_, r| r.ledger.total()),
    output!("energy.supplied", &JOULE, "work supplied since the start", |_, r| r.ledger.supplied),
    output!("energy.dissipated", &JOULE, "work lost since the start", |_, r| r.ledger.dissipated),
    output!(
        "energy.residual",
        &JOULE,
        "total - total(start) - supplied + dissipated: zero for an exact solution",
        |_, r| r.ledger.residual()
    ),
];

/// A continuous state and its rate, by their number in the state.
macro_rules! states {
    ($($n:expr, $name:literal, $unit:ident, $rate:ident, $what:literal;)*) => {
        &[
            $(output!(State, concat!("state.", $name), &$unit, $what, |_, r| r.state($n)),)*
            $(output!(
                State,
                concat!("der(state.", $name, ")"),
                &$rate,
                concat!("rate of the ", $what),
                |_, _, rates| rates.rigid($n)
            ),)*
            Row {
                meta: Meta {
                    name: "state.chart",
                    description: "chart of the state: gamma and phi measured from e (1) or from -e (2)",
                    unit: &ONE,
                    kind: Kind::Integer,
                    role: Role::Mode,
                },
                access: Access::Output(Output::new(
                    |_, r| chart_number(r.motion.tilt.chart()),
                    |_, r| constant(chart_number(r.motion.tilt.chart())),
                    |_, r| constant(chart_number(r.motion.tilt.chart())),
                )),
            },
        ]
    };
}

/// The state of model exchange, then its rates in the same order, then its chart. In co-simulation `state.phi` is what is
/// left of φ less its whole turns.
#[rustfmt::skip]
const STATE: &[AlwaysRow] = states! {
    0, "r.x", METRE, METRE_PER_SECOND, "position of the mass centre of the whole, x";
    1, "r.y", METRE, METRE_PER_SECOND, "position of the mass centre of the whole, y";
    2, "r.z", METRE, METRE_PER_SECOND, "position of the mass centre of the whole, z";
    3, "v.x", METRE_PER_SECOND, METRE_PER_SECOND_SQUARED, "velocity of the mass centre of the whole, x";
    4, "v.y", METRE_PER_SECOND, METRE_PER_SECOND_SQUARED, "velocity of the mass centre of the whole, y";
    5, "v.z", METRE_PER_SECOND, METRE_PER_SECOND_SQUARED, "velocity of the mass centre of the whole, z";
    6, "K.x", ANGULAR_MOMENTUM, NEWTON_METRE, "angular momentum about the mass centre of the whole, x";
    7, "K.y", ANGULAR_MOMENTUM, NEWTON_METRE, "angular momentum about the mass centre of the whole, y";
    8, "K.z", ANGULAR_MOMENTUM, NEWTON_METRE, "angular momentum about the mass centre of the whole, z";
    9, "gamma.y", RADIAN, RADIAN_PER_SECOND, "transverse Euler vector in the active chart, y";
    10, "gamma.z", RADIAN, RADIAN_PER_SECOND, "transverse Euler vector in the active chart, z";
    11, "phi", RADIAN, RADIAN_PER_SECOND, "axial angle in the active chart";
    12, "supplied", JOULE, WATT, "work supplied since the start";
    13, "dissipated", JOULE, WATT, "work lost since the start";
};

/// The number of a chart in `state.chart`.
fn chart_number(chart: Chart) -> f64 {
    f64::from(chart as u8)
}

const _: () = {
    assert!(BLOCKS.len() <= Place::FIRST_EFFECT as usize, "blocks run into those of the effects");
    let mut i = 0;
    while i < BLOCKS.len() {
        assert!(BLOCKS[i].len() <= 256, "a block has at most 256 variables");
        i += 1;
    }
};

/// The row at this place, if it is one of those that are always there; those of the work integrals only where an effect
/// `could_work`.
#[inline(always)]
fn always(place: Place, could_work: bool) -> Option<&'static AlwaysRow> {
    if !could_work && is_of_work(place) {
        return None;
    }
    BLOCKS.get(place.block as usize)?.get(place.row)
}

/// Reads an output.
type Read = for<'m> fn(&Setup, &Reading) -> f64;

/// The Real outputs that are always there, by value reference: a second way to what [`BLOCKS`] holds, without detours.
static QUICK: [Option<Read>; (STATES << 8) as usize] = {
    let mut quick = [None; (STATES << 8) as usize];
    let mut block = 0;
    while block < STATES {
        let rows = BLOCKS[block as usize];
        let mut row = 0;
        while row < rows.len() {
            if let Access::Output(output) = &rows[row].access {
                quick[Place { block, row }.value_reference() as usize] = Some(output.value);
            }
            row += 1;
        }
        block += 1;
    }
    quick
};

/// The block of the states.
const STATES: u32 = BLOCKS.len() as u32 - 1;

/// Whether the place is that of a work integral or its rate among the states.
fn is_of_work(place: Place) -> bool {
    place.block == STATES && place.row < 2 * WITH_WORK && place.row % WITH_WORK >= COORDINATES
}

/// The place of a coordinate or a work integral, by its number.
pub fn state_place(n: usize) -> Place {
    Place { block: STATES, row: n }
}

/// The number of the coordinate or the work integral at this place, if it is one of them.
pub fn state_number(place: Place) -> Option<usize> {
    (place.block == STATES && place.row < WITH_WORK).then_some(place.row)
}

/// So many whole turns are counted without a gap: 2⁵³ of them \[rad].
pub(crate) const LARGEST_PHI: f64 = TAU * (1_u64 << 53) as f64;

impl Setup {
    /// This rotor, at rest at the origin, and all else as in a scene that does not name it.
    pub fn of(rotor: Body) -> Self {
        let mut setup = Self::default();
        for row in BLOCKS.into_iter().flatten() {
            if let (Some(default), Access::Parameter { set, .. }) = (row.meta.default(), &row.access) {
                set(&mut setup, default);
            }
        }
        Self { rotor, ..setup }
    }

    /// The first of its parameters whose value is not possible.
    fn check(&self) -> Result<(), Invalid> {
        for row in BLOCKS.into_iter().flatten() {
            if let Access::Parameter { get, .. } = row.access {
                row.meta.check(|| row.meta.name.into(), get(self))?;
            }
        }
        first(self.broken_rules())
    }

    /// What no single bound says.
    fn broken_rules(&self) -> [Option<Invalid>; 3] {
        let Start { phi, gamma, v_c, omega, at_rest, .. } = &self.start;
        let (theta, moves) = (gamma.norm(), *v_c != Vector3::zeros() || omega.yz() != Vector2::zeros());
        let at_rest_and_moves = || {
            let reason = "= true and a motion exclude each other: start.v_c, start.omega.y and start.omega.z must be 0";
            Invalid { variable: "start.at_rest".into(), reason: reason.into() }
        };
        let beyond_counting = || {
            let bound = format!("from -{LARGEST_PHI:?} to {LARGEST_PHI:?}, or its whole turns could not be counted");
            Invalid::new("start.phi", *phi, bound)
        };
        [
            (theta > PI).then(|| Invalid::new("|start.gamma|", theta, format!("at most pi = {PI:?}"))),
            (*at_rest && moves).then(at_rest_and_moves),
            (phi.abs() > LARGEST_PHI).then(beyond_counting),
        ]
    }
}

/// The first that is broken.
fn first<const RULES: usize>(broken: [Option<Invalid>; RULES]) -> Result<(), Invalid> {
    broken.into_iter().flatten().next().map_or(Ok(()), Err)
}

/// The parameters of a scene: those that are always there and those of its effects.
#[derive(Clone, Debug, Default)]
pub struct Parameters<E> {
    /// Those that are always there.
    pub setup: Setup,
    /// Those of the effects.
    pub effects: E,
}

impl<E: Effects> FromIterator<(Place, f64)> for Parameters<E> {
    /// Parameters and inputs with these values at the start.
    fn from_iter<I: IntoIterator<Item = (Place, f64)>>(starts: I) -> Self {
        let mut parameters = Self::default();
        for (place, value) in starts {
            parameters.begin_with(place, value);
        }
        parameters
    }
}

impl<E: Effects> Parameters<E> {
    /// The place of the variable that has this full name, as in modelDescription.xml; None where there is none.
    pub fn place(name: &str) -> Option<Place> {
        let blocks = (0..Place::FIRST_EFFECT).chain((0..E::FACTS.count).filter_map(|n| Some(E::kind(n)?.block)));
        let mut places = blocks.flat_map(|block| (0..=Place::SWITCH).map(move |row| Place { block, row }));
        places.find(|place| Self::name(*place).is_some_and(|found| found == name))
    }

    /// The full name of the variable at this place; None where there is none.
    pub fn name(place: Place) -> Option<String> {
        always(place, E::FACTS.could_work).map_or_else(|| E::name(place), |row| Some(row.meta.name.to_owned()))
    }

    /// What is said of the variable at this place; None where there is none.
    #[inline(always)]
    pub fn meta(place: Place) -> Option<&'static Meta> {
        always(place, E::FACTS.could_work).map_or_else(|| E::meta(place), |row| Some(&row.meta))
    }

    /// The value of a variable, an input's at time `t` \[s]; None where there is none at this place, or where it is
    /// calculated and there is no reading.
    #[inline(always)]
    pub fn value<const N: usize>(&self, place: Place, t: f64, instant: Option<&Instant<N>>) -> Option<f64> {
        let Some(row) = always(place, E::FACTS.could_work) else {
            let (block, from) = self.effects.at(place)?;
            let count = block.kind().facts.own;
            let motion = instant.map(|now| Motion::new(&now.reading.motion, &now.own::<E>()[from..][..count]));
            let rates = instant.filter(|_| block.asks_rates(place.row)).map(|now| now.rates(&self.effects));
            let rates = rates.as_ref().map(|rates| seen::<E, _, _>(rates, from, count));
            return block.value(place.row, t, motion.as_ref(), rates.as_ref());
        };
        let asks = matches!(row.access, Access::Rate(_));
        let rates = instant.filter(|_| asks).map(|now| now.rates(&self.effects));
        let rates = rates.as_ref().map(|rates| seen::<E, _, _>(rates, 0, 0));
        row.access.value(&self.setup, t, instant.map(|now| &now.reading), rates.as_ref())
    }

    /// The values of Real variables by their value references, as many as both slices hold; false, and the values are void,
    /// where one is missing, of another type, or not finite. This is what hosts ask for all the time: outputs that are
    /// always there go the shortest way.
    #[inline(never)]
    pub fn reals<const N: usize>(&self, references: &[u32], values: &mut [f64], instant: &Instant<N>) -> bool {
        for (reference, value) in references.iter().zip(values.iter_mut()) {
            *value = match QUICK.get(*reference as usize) {
                Some(Some(read)) => read(&self.setup, &instant.reading),
                _ => self.real(Place::of(*reference), instant),
            };
        }
        // A sum of zeros, or of a NaN where a value is not finite.
        values.iter().map(|value| 0.0 * value).sum::<f64>() == 0.0
    }

    /// The value of a Real variable; NaN where there is none.
    #[inline(never)]
    fn real<const N: usize>(&self, place: Place, instant: &Instant<N>) -> f64 {
        let is_real = Self::meta(place).is_some_and(|meta| meta.kind == Kind::Real);
        is_real.then(|| self.value(place, instant.reading.motion.t, Some(instant))).flatten().unwrap_or(f64::NAN)
    }

    /// Sets a parameter; false where there is none at this place.
    pub fn set(&mut self, place: Place, value: f64) -> bool {
        match always(place, E::FACTS.could_work) {
            None => self.effects.set_parameter(place, value),
            Some(Row { access: Access::Parameter { set, .. }, .. }) => {
                set(&mut self.setup, value);
                true
            }
            Some(_) => false,
        }
    }

    /// Gives a parameter or an input its start value; false where there is none at this place.
    pub fn begin_with(&mut self, place: Place, value: f64) -> bool {
        self.set(place, value) || self.effects.signal_mut(place).map(|signal| signal.set(0.0, value)).is_some()
    }

    /// A calculated variable with its derivative; None where there is none at this place.
    pub fn tangent<const N: usize>(&self, place: Place, instant: &Instant<N, Tangent>) -> Option<Tangent> {
        let Some(row) = always(place, E::FACTS.could_work) else {
            let (block, from) = self.effects.at(place)?;
            let count = block.kind().facts.own;
            let rates = block.asks_rates(place.row).then(|| instant.rates(&self.effects));
            let rates = rates.as_ref().map(|rates| seen::<E, _, _>(rates, from, count));
            let motion = Motion::new(&instant.reading.motion, &instant.own::<E>()[from..][..count]);
            return block.tangent(place.row, &motion, rates.as_ref());
        };
        let rates = matches!(row.access, Access::Rate(_)).then(|| instant.rates(&self.effects));
        let rates = rates.as_ref().map(|rates| seen::<E, _, _>(rates, 0, 0));
        row.access.tangent(&self.setup, &instant.reading, rates.as_ref())
    }

    /// What a calculated variable depends on, where these are the rates; None where there is none at this place.
    #[cfg(feature = "scenes")]
    pub fn traced<const N: usize>(
        &self,
        place: Place,
        instant: &Instant<N, Traced>,
        rates: &[Traced; N],
    ) -> Option<Traced> {
        let Some(row) = always(place, E::FACTS.could_work) else {
            let (block, from) = self.effects.at(place)?;
            let count = block.kind().facts.own;
            let motion = Motion::new(&instant.reading.motion, &instant.own::<E>()[from..][..count]);
            return block.traced(place.row, &motion, &seen::<E, _, _>(rates, from, count));
        };
        row.access.traced(&self.setup, &instant.reading, &seen::<E, _, _>(rates, 0, 0))
    }

    /// The number of the state at this place in a state of N numbers, if it is one.
    pub fn number_in_state<const N: usize>(&self, place: Place) -> Option<usize> {
        if let Some(n) = state_number(place) {
            return Some(E::layout::<N>().own().end + n);
        }
        let (block, from) = self.effects.at(place)?;
        block.own_state(place.row).map(|n| from + n)
    }

    /// The first parameter whose value is not possible.
    pub fn check(&self) -> Result<(), Invalid> {
        self.setup.check()?;
        self.effects.check()?;
        first(self.broken_rules_of_all())
    }

    /// What does not go together, whatever else may be wrong with a single value or within an effect.
    #[cfg(feature = "scenes")]
    pub(crate) fn broken_rules(&self) -> impl Iterator<Item = Invalid> {
        let of_start = self.setup.broken_rules().into_iter();
        of_start.chain(self.broken_rules_of_all()).flatten()
    }

    /// Of the rules that join effects, those that are broken.
    fn broken_rules_of_all(&self) -> [Option<Invalid>; 3] {
        let solver = &self.setup.solver;
        let is_symplectic = solver.method_in_force() == numbers::SYMPLECTIC;
        let imposes = E::FACTS.imposes && self.effects.imposed::<f64>(0.0).is_some();
        let method = (is_symplectic && imposes).then(|| {
            let bound = "another method: drifts and kicks do not keep an imposed speed";
            Invalid::out_of_bound(solver.method_variable(), "symplectic", bound)
        });
        [method, self.effects.excludes_redo(), self.shape().check().err()]
    }

    /// The parameters and inputs to blame for an energy at the start that overflows: with moderate values in their place it is
    /// `sound`. That with the most extreme value, if it is one alone.
    #[cold]
    pub fn blamed(&self, sound: impl Fn(&Self) -> bool) -> Invalid {
        let metas = |block| {
            (0..Place::SWITCH).filter_map(move |row| Some((Place { block, row }, Self::meta(Place { block, row })?)))
        };
        let is_given = |(_, meta): &(Place, &Meta)| meta.kind == Kind::Real && meta.has_start();
        let given = (0..1 << 8).flat_map(metas).filter(is_given);
        let mut given: Vec<_> =
            given.filter_map(|(place, _)| Some((place, self.value::<WITH_WORK>(place, 0.0, None)?))).collect();
        let extremity = |value: f64| if value == 0.0 { 1.0 } else { value.abs().max(1.0 / value.abs()) };
        given.sort_by(|(_, one), (_, other)| extremity(*other).total_cmp(&extremity(*one)));
        let moderated = |places: &[(Place, f64)]| {
            let mut parameters = self.clone();
            places.iter().for_each(|(place, value)| _ = parameters.begin_with(*place, value.signum()));
            sound(&parameters)
        };
        let alone = given.iter().position(|one| moderated(std::slice::from_ref(one)));
        let together = (1..=given.len()).find(|count| moderated(&given[..*count]));
        let blamed = match (alone, together) {
            (Some(n), _) => &given[n..=n],
            (None, count) => &given[..count.unwrap_or(given.len())],
        };
        let words =
            blamed.iter().map(|(place, value)| format!("{} = {value:?}", Self::name(*place).unwrap_or_default()));
        let words: Vec<_> = words.collect();
        Invalid {
            variable: words.join(" and "),
            reason: "cannot be simulated: the energy at the start overflows".into(),
        }
    }

    /// The body with what effects make of it.
    pub fn shape(&self) -> Shape {
        let mut shape = Shape::of(self.setup.rotor);
        self.effects.shape(&mut shape);
        shape
    }
}

impl<E: Effects> Stored for Parameters<E> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        for row in BLOCKS.into_iter().flatten() {
            if let Access::Parameter { get, set } = row.access {
                let mut value = get(&self.setup);
                value.walk(walk)?;
                set(&mut self.setup, value);
            }
        }
        self.effects.walk(walk)
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

/// The list: all variables of a scene that calls for `effects`, each with its index from 1 among its kind; those of the solver last.
pub fn of_scene(effects: &[(&'static Info, u32)]) -> Vec<Variable> {
    let could_work = effects.iter().any(|(info, _)| info.facts.could_work);
    let mut list = Vec::new();
    let mut block = |block: u32, name: &dyn Fn(&str) -> String, metas: Vec<(usize, Meta)>| {
        let placed = metas.into_iter().map(|(row, meta)| (Place { block, row }, meta));
        list.extend(placed.filter(|(place, _)| could_work || !is_of_work(*place)).map(|(place, meta)| Variable {
            name: name(meta.name),
            place,
            meta,
        }));
    };
    let metas = |rows: &[AlwaysRow]| (0..).zip(rows).map(|(number, row)| (number, row.meta)).collect();
    for (number, rows) in (0..).zip(BLOCKS).filter(|(number, _)| *number != SOLVER) {
        block(number, &str::to_owned, metas(rows));
    }
    for (info, index) in effects {
        let name = |name: &str| full_name(&info.block_name(*index), name);
        block(Place::effect_block(info.number, *index), &name, (info.metas)());
    }
    // Whoever looks through a list of variables looks for the machine first.
    block(SOLVER, &str::to_owned, metas(BLOCKS[SOLVER as usize]));
    list
}

/// The list of a general scene, in which each effect has a switch: the switches stand together, before the effects.
pub fn of_general(effects: &[(&'static Info, u32)]) -> Vec<Variable> {
    let switch = |(info, index): &(&'static Info, u32)| Variable {
        name: info.switch_name(*index),
        place: Place::switch(Place::effect_block(info.number, *index)),
        meta: info.switch,
    };
    let mut list = of_scene(effects);
    let first = list.iter().position(|variable| variable.place.block >= Place::FIRST_EFFECT).unwrap_or(list.len());
    list.splice(first..first, effects.iter().map(switch));
    list
}
