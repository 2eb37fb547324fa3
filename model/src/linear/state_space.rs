//! The machine about its steady state as control engineers write it: dx/dt = A x + B u, y = C x + D u, in the units of the variables.
//!
//! All four are derivatives of the simulation's own equations and outputs, by dual numbers.

use super::machine::{DRIVES, Machine, N, Obstacle, STATES, Steady, across};
use super::modes::Shape;
use crate::body::ROTOR;
use crate::dual::Tangent;
use crate::effects::{All, Effects};
use crate::integrate::Cost;
use crate::rotor::Rotor;
use crate::state::GAMMA;
use crate::variable::units::{ANGULAR_MOMENTUM, Unit};
use crate::variable::{Kind, Meta, Place, Role};
use crate::variables::{Instant, Parameters, state_place};
use nalgebra::{Complex, ComplexField, DMatrix, Matrix3x2, SMatrix, SVector};

/// A state, an input or an output.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// The name of the variable; `state.K.u1` and `state.K.u2` are the angular momentum along [`StateSpace::directions`].
    pub name: String,
    /// Its unit.
    pub unit: &'static Unit,
    /// Its value in the steady state, from which it is counted, in its unit.
    pub steady: f64,
}

/// The linear equations of a machine with its drives off and its spin held, about a steady state.
#[derive(Clone, Debug)]
pub struct StateSpace {
    /// About which they hold.
    pub steady: Steady,
    /// x: place (3) and velocity (3) of the mass centre, γ (2), and the part of K across the axis (2).
    pub states: Vec<Quantity>,
    /// u: the inputs of all effects but the drives.
    pub inputs: Vec<Quantity>,
    /// y: the Real outputs but those that follow φ, count or sum up, or are of the drives.
    pub outputs: Vec<Quantity>,
    /// u₁ and u₂ across the axis, along which the states have K \[1]: y and z where the axis is e.
    pub directions: Matrix3x2<f64>,
    /// Rates of the states by the states.
    pub a: SMatrix<f64, STATES, STATES>,
    /// Rates of the states by the inputs.
    pub b: DMatrix<f64>,
    /// Outputs by the states.
    pub c: DMatrix<f64>,
    /// Outputs by the inputs.
    pub d: DMatrix<f64>,
    /// What the states are divided by where equations are solved.
    sizes: SVector<f64, STATES>,
}

/// Outputs that count or sum up over a run begin with these, or are this.
const OF_A_RUN: [&str; 4] = ["solver.", "energy.", "turns", "energy_error"];

/// Beside a pole one looks so far \[1]: an answer that goes smoothly past is known to the square of it.
const BESIDE: f64 = 1e-5;

/// An answer goes smoothly past a pole where it changes by no more than this part in such a step \[1]; else it doubles.
const SMOOTH: f64 = 1e-3;

impl StateSpace {
    /// How an output answers an input that swings at `frequency` [rad/s], by their numbers, in the output's unit over the input's. None
    /// where the answer has no bound: a mode that both take part in swings so without damping, or nothing holds the rotor at 0 rad/s.
    ///
    /// # Errors
    /// Where that depends on eigenvalues that are not found.
    ///
    /// # Panics
    /// Where there is no input or no output of this number.
    pub fn response(&self, input: usize, output: usize, frequency: f64) -> Result<Option<Complex<f64>>, Obstacle> {
        let answer = |frequency| self.answer(input, output, frequency);
        let at_it = answer(frequency)?;
        if at_it.is_some() {
            return Ok(at_it);
        }
        let modes = self.steady.modes()?;
        let slowest = modes.iter().map(|mode| mode.eigenvalue.modulus()).fold(f64::INFINITY, f64::min);
        let step = BESIDE * if frequency == 0.0 { slowest.min(self.steady.rate) } else { frequency };
        let beside = [answer(frequency - step)?, answer(frequency + step)?, answer(frequency + 2.0 * step)?];
        let [Some(below), Some(near), Some(far)] = beside else { return Ok(None) };
        Ok(((near - far).modulus() <= SMOOTH * far.modulus()).then(|| (below + near).scale(0.5)))
    }

    /// [`StateSpace::response`] where no mode swings so without damping.
    fn answer(&self, input: usize, output: usize, frequency: f64) -> Result<Option<Complex<f64>>, Obstacle> {
        let sizes = self.sizes;
        let pushed = Shape::from_fn(|n, _| Complex::from(self.b[(n, input)] / (sizes[n] * self.steady.rate)));
        let Some(moved) = self.steady.swung(&pushed, frequency)? else { return Ok(None) };
        let through: Complex<f64> = (0..STATES).map(|n| moved[n] * (sizes[n] * self.c[(output, n)])).sum();
        // eq. 118: H = C (iΩ I − A)⁻¹ B + D
        Ok(Some(through + self.d[(output, input)]))
    }
}

/// A machine in a steady state, to be moved a little.
struct Standing<'m> {
    parameters: &'m Parameters<All>,
    instant: Instant<N>,
}

impl Standing<'_> {
    /// With a state that moves along this direction.
    fn moved(&self, direction: &[f64; N]) -> Instant<N, Tangent> {
        self.instant.moving(direction, 0.0, &self.parameters.effects)
    }

    /// By how much variables change there, which are calculated under `parameters`.
    fn changes(parameters: &Parameters<All>, moved: &Instant<N, Tangent>, of: &[Listed]) -> Vec<f64> {
        let change = |one: &Listed| parameters.tangent(one.place, moved).expect("it is calculated").eps[0];
        of.iter().map(change).collect()
    }

    /// With its value in the steady state.
    fn quantity(&self, listed: &Listed) -> Quantity {
        let steady = self.parameters.value(listed.place, 0.0, Some(&self.instant)).expect("it is shown");
        let name = Parameters::<All>::name(listed.place).expect("it is there");
        Quantity { name, unit: listed.meta.unit, steady }
    }
}

/// A variable of the scene.
struct Listed {
    place: Place,
    meta: &'static Meta,
}

/// The Real variables that are always there and those of what acts but drives nothing, in the order of the list; of housings where they move.
fn listed(parameters: &Parameters<All>, is_wanted: fn(Role) -> bool) -> Vec<Listed> {
    let acting = parameters.effects.active().map(|block| block.kind());
    let blocks = acting.filter(|kind| !DRIVES.contains(&kind.name)).map(|kind| kind.block);
    let moves = |block| {
        let moves = parameters.value(Place { block, row: Place::HOUSING }, 0.0, None::<&Instant<N>>);
        moves == Some(1.0)
    };
    let rows = |block| {
        let most = if moves(block) { Place::SWITCH } else { Place::HOUSING };
        let listed = move |row| {
            let place = Place { block, row };
            Some(Listed { place, meta: Parameters::<All>::meta(place)? })
        };
        (0..most).filter_map(listed)
    };
    let all = (0..Place::FIRST_EFFECT).chain(blocks).flat_map(rows);
    all.filter(|one| one.meta.kind == Kind::Real && is_wanted(one.meta.role)).collect()
}

/// Where the states are to be found in a state of the nonlinear equations: a direction for each.
fn directions(across: &Matrix3x2<f64>) -> [[f64; N]; STATES] {
    std::array::from_fn(|n| {
        let mut direction = [0.0; N];
        let at = &mut direction[All::layout::<N>().body(ROTOR)];
        match n {
            0..6 => at[n] = 1.0,
            6..8 => at[GAMMA.start + n - 6] = 1.0,
            // eq. 116: δK = κ₁ u₁ + κ₂ u₂
            _ => at[6..9].copy_from_slice(across.column(n - 8).as_slice()),
        }
        direction
    })
}

/// Names and units of the states, and their values where a machine stands like this.
fn states(state: &[f64; N]) -> Vec<Quantity> {
    let first = All::layout::<N>().body(ROTOR).start;
    let of_list = (0..6).chain(GAMMA).map(|n| {
        let (name, meta) = (Parameters::<All>::name(state_place(n)), Parameters::<All>::meta(state_place(n)));
        let unit = meta.expect("a state of every rotor").unit;
        Quantity { name: name.expect("a state of every rotor"), unit, steady: state[first + n] }
    });
    let momentum = ["state.K.u1", "state.K.u2"];
    of_list.chain(momentum.map(|name| Quantity { name: name.into(), unit: &ANGULAR_MOMENTUM, steady: 0.0 })).collect()
}

impl Machine {
    /// Its linear equations with inputs and outputs at `speed` [rad/s], about the steady state sought from `near`; inputs have there what
    /// the scene gives them. Where nothing holds the rotor, its states are there all the same, and A is singular.
    ///
    /// # Errors
    /// Where there is no steady state.
    pub fn state_space(&self, speed: f64, near: Option<&Steady>) -> Result<StateSpace, Obstacle> {
        let steady = self.steady(speed, near)?;
        let (parameters, start) = self.spinning(speed);
        let rotor: Rotor<'_, All> = start.bodies.under(&parameters.effects);
        let state = self.spins(&rotor, speed).state(steady.r, steady.gamma);
        let instant = Instant::new(rotor.motion(0.0, &state), state, &parameters.effects, 0.0, Cost::default());
        let standing = Standing { parameters: &parameters, instant };
        let across = across(&steady.axis);
        let inputs = listed(&parameters, |role| matches!(role, Role::Input { .. }));
        let outputs = steady_outputs(&standing);
        let mut c = DMatrix::zeros(outputs.len(), STATES);
        for (column, direction) in directions(&across).iter().enumerate() {
            let changes = Standing::changes(&parameters, &standing.moved(direction), &outputs);
            c.column_mut(column).copy_from_slice(&changes);
        }
        let (mut b, mut d) = (DMatrix::zeros(STATES, inputs.len()), DMatrix::zeros(outputs.len(), inputs.len()));
        for (column, input) in inputs.iter().enumerate() {
            let mut pushed = parameters.clone();
            pushed.effects.signal_mut(input.place).expect("it is an input").ask(1.0);
            let moved: Instant<N, Tangent> = standing.instant.moving(&[0.0; N], 0.0, &pushed.effects);
            let rates = All::layout::<N>().read(&moved.rates(&pushed.effects), ROTOR);
            let [force, moment] = [rates.v, rates.k].map(|vector| vector.map(|part| part.eps[0]));
            // eq. 118: B = (0, ∂F/∂u /m, 0, u_i·∂M/∂u), what holds the spin being along t
            b.fixed_view_mut::<3, 1>(3, column).copy_from(&force);
            b.fixed_view_mut::<2, 1>(8, column).copy_from(&(across.transpose() * moment));
            d.column_mut(column).copy_from_slice(&Standing::changes(&pushed, &moved, &outputs));
        }
        let sizes = self.sizes(steady.rate);
        let a = |row: usize, column: usize| steady.matrix[(row, column)] * (steady.rate * sizes[row] / sizes[column]);
        let quantities = |of: &[Listed]| of.iter().map(|one| standing.quantity(one)).collect();
        Ok(StateSpace {
            a: SMatrix::from_fn(a),
            states: states(&state),
            inputs: quantities(&inputs),
            outputs: quantities(&outputs),
            directions: across,
            steady,
            b,
            c,
            d,
            sizes,
        })
    }
}

/// The outputs that stay as they are in a steady state.
fn steady_outputs(standing: &Standing<'_>) -> Vec<Listed> {
    let outputs = listed(standing.parameters, |role| matches!(role, Role::Output));
    let mut turned = [0.0; N];
    turned[All::layout::<N>().phi(ROTOR)] = 1.0;
    let changes = Standing::changes(standing.parameters, &standing.moved(&turned), &outputs);
    let is_of_a_run = |one: &Listed| OF_A_RUN.iter().any(|begin| one.meta.name.starts_with(begin));
    // Of a balanced machine only φ follows φ, whatever it is called.
    let stays = |(one, by_phi): &(Listed, f64)| *by_phi != 1.0 && !is_of_a_run(one);
    outputs.into_iter().zip(changes).filter(stays).map(|(one, _)| one).collect()
}
