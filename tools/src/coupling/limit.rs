//! The longest communication step at which the exchange makes nothing grow, by the map of one step of the linear equations.

use super::exchange::Scheme;
use super::pair::{Pair, switch_off};
use super::partner::Shown;
use nalgebra::{DMatrix, SMatrix, SVector, Vector2, Vector3};
use split_rotor_model::effects::All;
use split_rotor_model::linear::{Machine, Obstacle, STATES, StateSpace};
use split_rotor_model::variable::Place;
use split_rotor_model::variables::Parameters;

/// Orders of extrapolation, from 0.
pub const ORDERS: usize = 3;

/// What grows by less than this part in a step does not count as growth \[1], as in the FMU's own warning.
const GROWS: f64 = 1e-4;

/// What grows in one model by more than this part of it is no fault of the exchange \[1].
const OWN: f64 = 0.5;

/// Steps are tried from this part of the fastest period to so many of the slowest \[1], each so many times the one before.
const SHORTEST: f64 = 1e-4;
const LONGEST: f64 = 4.0;
const RATIO: f64 = 1.15;

/// Modes whose frequency is less than this part of the highest do not swing \[1].
const STILL: f64 = 1e-7;

/// Number of bisections between the last step at which nothing grows and the first at which something does.
const BISECTIONS: u32 = 12;

/// Number of squarings after which the growth of a map is known.
const SQUARINGS: u32 = 20;

/// Terms of an exponential, and the size from which on its argument is halved.
const TERMS: u32 = 14;
const SMALL: f64 = 0.5;

/// Loads and what is shown: force and moment; place, velocity, γ (y, z), ω.
const LOADS: usize = 6;
const SHOWN: usize = 11;

type Square = SMatrix<f64, STATES, STATES>;

/// The linear equations of a machine without its partners, and what these add, both scaled to numbers of one size.
pub struct Linear {
    /// [1/s].
    open: Square,
    /// [1/s].
    answered: Square,
    /// The period of the fastest mode \[s].
    pub fastest: f64,
    /// The period of the slowest mode that swings \[s].
    pub slowest: f64,
}

impl Linear {
    /// Of a pair; where it has no steady state, without gravity and rings.
    pub fn of(pair: &Pair) -> Result<Self, Obstacle> {
        let space = space(&pair.whole, pair.speed).or_else(|obstacle| {
            let mut light = pair.whole.clone();
            switch_off(&mut light, "gravity", 1);
            (1..=Place::OF_A_KIND).for_each(|number| switch_off(&mut light, "rub", number));
            space(&light, pair.speed).map_err(|_| obstacle)
        })?;
        let sizes = sizes(pair, space.steady.rate);
        let scaled = |matrix: Square| Square::from_fn(|row, column| matrix[(row, column)] * sizes[column] / sizes[row]);
        let answered = scaled(answers(pair, &space));
        let whole = scaled(space.a);
        let modes = space.steady.modes()?;
        let swings = |least: f64| modes.iter().map(|mode| mode.eigenvalue.im).filter(move |swing| *swing > least);
        let most = swings(0.0).fold(0.0, f64::max);
        let fastest = match most > 0.0 {
            true => most,
            false => modes.iter().map(|mode| mode.eigenvalue.re.abs()).fold(0.0, f64::max),
        };
        let slowest = swings(STILL * most).fold(fastest, f64::min);
        let period = |rate: f64| std::f64::consts::TAU / rate;
        Ok(Self { open: whole - answered, answered, fastest: period(fastest), slowest: period(slowest) })
    }

    /// The longest step \[s] with which nothing grows at this order; None where nothing does up to some periods of the slowest mode.
    pub fn longest(&self, scheme: Scheme, order: usize) -> Option<f64> {
        let grows = |step: f64| self.grows(step, scheme.lag() as usize, order);
        let (mut short, last) = (SHORTEST * self.fastest, LONGEST * self.slowest);
        if grows(short) {
            return Some(0.0);
        }
        let mut long = short * RATIO;
        while !grows(long) {
            (short, long) = (long, long * RATIO);
            if long > last {
                return None;
            }
        }
        for _ in 0..BISECTIONS {
            let middle = libm::sqrt(short * long);
            (short, long) = if grows(middle) { (short, middle) } else { (middle, long) };
        }
        Some(short)
    }

    fn grows(&self, step: f64, lag: usize, order: usize) -> bool {
        let coupled = growth(map(&self.open, &self.answered, step, lag, order));
        let whole = (self.open + self.answered) * step;
        let own = growth(exponential(DMatrix::from_fn(STATES, STATES, |row, column| whole[(row, column)])));
        coupled > GROWS && own < OWN * coupled
    }
}

/// The linear equations at a speed [rad/s]; where the body is not symmetric, with the mean of both transverse inertias.
fn space(parameters: &Parameters<All>, speed: f64) -> Result<StateSpace, Obstacle> {
    let machine = Machine::of(parameters).or_else(|obstacle| match obstacle {
        Obstacle::Asymmetric => Machine::with_mean_inertia(parameters),
        other => Err(other),
    })?;
    machine.state_space(speed, None)
}

/// What states are divided by: place, velocity, γ, K.
fn sizes(pair: &Pair, rate: f64) -> SVector<f64, STATES> {
    let length = pair.length();
    SVector::from_fn(|n, _| match n {
        0..3 => length,
        3..6 => length * rate,
        6..8 => 1.0,
        _ => pair.whole.setup.rotor.Jt * rate,
    })
}

/// What the partners add to the rates of the states [1/s].
fn answers(pair: &Pair, space: &StateSpace) -> Square {
    let number = |of: &[split_rotor_model::linear::Quantity], name: &str| of.iter().position(|one| one.name == name);
    let mut sum = Square::zeros();
    for (partner, port) in pair.partners.iter().zip(&pair.ports) {
        let named = |name: &str| format!("port[{port}].{name}");
        const LOAD_NAMES: [&str; LOADS] = ["f.x", "f.y", "f.z", "m.x", "m.y", "m.z"];
        const SHOWN_NAMES: [&str; SHOWN] =
            ["r.x", "r.y", "r.z", "v.x", "v.y", "v.z", "theta.y", "theta.z", "omega.x", "omega.y", "omega.z"];
        let inputs = LOAD_NAMES.map(|name| number(&space.inputs, &named(name)).expect("a port has this input"));
        let outputs = SHOWN_NAMES.map(|name| number(&space.outputs, &named(name)));
        let steady: [f64; SHOWN] = outputs.map(|output| output.map_or(0.0, |output| space.outputs[output].steady));
        let loads = |shown: &[f64; SHOWN]| {
            let vector = |n: usize| Vector3::new(shown[n], shown[n + 1], shown[n + 2]);
            let shown = Shown { r: vector(0), v: vector(3), theta: Vector2::new(shown[6], shown[7]), omega: vector(8) };
            let [force, moment] = partner.answer(&shown);
            SVector::<f64, LOADS>::from_iterator(force.iter().chain(moment.iter()).copied())
        };
        for (n, output) in outputs.into_iter().enumerate() {
            let Some(output) = output else { continue };
            let (length, rate) = (pair.length(), space.steady.rate);
            let change = 1e-5 * [length, length * rate, 1.0, rate][if n < 8 { n / 3 } else { 3 }];
            let [mut less, mut more] = [steady; 2];
            (less[n], more[n]) = (steady[n] - change, steady[n] + change);
            let slope = (loads(&more) - loads(&less)) / (more[n] - less[n]);
            for (load, input) in inputs.into_iter().enumerate() {
                let (column, row) = (space.b.column(input), space.c.row(output));
                sum += Square::from_fn(|state, by| column[state] * slope[load] * row[by]);
            }
        }
    }
    sum
}

/// The states at the last communication points, after a step from those before.
fn map(open: &Square, answered: &Square, step: f64, lag: usize, order: usize) -> DMatrix<f64> {
    let points = lag + ORDERS;
    let numbers = STATES * (1 + ORDERS).max(points);
    // dx/dt = A x + u₀ + u₁ σ + u₂ σ²/2, σ in steps
    let mut rates = DMatrix::zeros(numbers, numbers);
    let mut put = |row: usize, column: usize, block: &Square| {
        let mut view = rates.view_mut((row * STATES, column * STATES), (STATES, STATES));
        view.copy_from(block);
    };
    put(0, 0, &(open * step));
    put(0, 1, &(Square::identity() * step));
    put(1, 2, &Square::identity());
    put(2, 3, &Square::identity());
    let mut inputs = DMatrix::zeros(numbers, numbers);
    inputs.view_mut((0, 0), (STATES, STATES)).copy_from(&Square::identity());
    for (power, parts) in polynomial(order, lag as f64).into_iter().enumerate() {
        for (back, part) in parts.into_iter().enumerate().filter(|(_, part)| *part != 0.0) {
            let mut view = inputs.view_mut(((1 + power) * STATES, (lag + back) * STATES), (STATES, STATES));
            view.copy_from(&(answered * part));
        }
    }
    let mut map = exponential(rates) * inputs;
    for point in 1..numbers / STATES {
        map.rows_mut(point * STATES, STATES).fill(0.0);
        map.view_mut((point * STATES, (point - 1) * STATES), (STATES, STATES)).copy_from(&Square::identity());
    }
    map
}

/// Value, rate and second derivative, in steps, at the point where a step begins, of the polynomial through the last values, which are
/// `lag` steps late: by parts of these values.
fn polynomial(order: usize, lag: f64) -> [[f64; ORDERS]; ORDERS] {
    match order {
        0 => [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]],
        1 => [[1.0 + lag, -lag, 0.0], [1.0, -1.0, 0.0], [0.0; 3]],
        _ => {
            let (both, slope) = (0.5 * lag * (lag + 1.0), lag + 0.5);
            [[1.0 + lag + both, -lag - 2.0 * both, both], [1.0 + slope, -1.0 - 2.0 * slope, slope], [1.0, -2.0, 1.0]]
        }
    }
}

/// e to this matrix.
fn exponential(mut matrix: DMatrix<f64>) -> DMatrix<f64> {
    let mut halvings = 0;
    while matrix.norm() > SMALL {
        matrix *= 0.5;
        halvings += 1;
    }
    let mut sum = DMatrix::identity(matrix.nrows(), matrix.ncols());
    let mut term = sum.clone();
    for n in 1..=TERMS {
        term = &term * &matrix / f64::from(n);
        sum += &term;
    }
    (0..halvings).for_each(|_| sum = &sum * &sum);
    sum
}

/// By what part a map makes what it is applied to grow each time, the logarithm.
fn growth(mut map: DMatrix<f64>) -> f64 {
    let mut grown = 0.0;
    for squared in 0..=SQUARINGS {
        let size = map.norm();
        if size == 0.0 {
            return f64::NEG_INFINITY;
        }
        if !size.is_finite() {
            return f64::INFINITY;
        }
        grown += libm::log(size) / f64::from(1_u32 << squared);
        map /= size;
        map = &map * &map;
    }
    grown
}
