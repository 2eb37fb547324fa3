//! The longest communication step at which the exchange makes nothing grow, by the map of one step of the linear equations.

use super::exchange::Scheme;
use super::pair::{Pair, switch_off};
use super::partner::Shown;
use nalgebra::{ComplexField, SMatrix, SVector, Vector2, Vector3};
use split_rotor_model::effects::All;
use split_rotor_model::linear::{Machine, Obstacle, STATES, StateSpace};
use split_rotor_model::simulation::{Coupled, LAGS, LEAST_GROWTH, LINEAR};
use split_rotor_model::variable::Place;
use split_rotor_model::variables::Parameters;

/// Steps are tried from this part of the quickest period to so many of the slowest \[1], each so many times the one before.
const SHORTEST: f64 = 1e-4;
const LONGEST: f64 = 4.0;
const RATIO: f64 = 1.15;

/// Modes whose frequency is less than this part of the highest do not swing \[1].
const STILL: f64 = 1e-7;

/// Number of bisections between the last step at which nothing grows and the first at which something does.
const BISECTIONS: u32 = 12;

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
    /// The period that the largest eigenvalue would have if it swung \[s].
    quickest: f64,
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
        // What is damped so much that it does not swing limits the step too.
        let quickest = modes.iter().map(|mode| mode.eigenvalue.modulus()).fold(0.0, f64::max);
        let most = swings(0.0).fold(0.0, f64::max);
        let fastest = if most > 0.0 { most } else { quickest };
        let slowest = swings(STILL * most).fold(fastest, f64::min);
        let period = |rate: f64| std::f64::consts::TAU / rate;
        let [quickest, fastest, slowest] = [quickest, fastest, slowest].map(period);
        Ok(Self { open: whole - answered, answered, quickest, fastest, slowest })
    }

    /// The longest step \[s] with which nothing grows at this order; None where nothing does up to some periods of the slowest mode.
    pub fn longest(&self, scheme: Scheme, order: usize) -> Option<f64> {
        let grows = |step: f64| self.grows(step, scheme.lag() as usize, order);
        let (mut short, last) = (SHORTEST * self.quickest, LONGEST * self.slowest);
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
        let padded = |matrix: Square| matrix.fixed_resize::<LINEAR, LINEAR>(0.0);
        let mut answered = [SMatrix::zeros(); LAGS];
        answered[lag] = padded(self.answered);
        Coupled { held: padded(self.open), answered }.growth(step, order, [lag as f64; _], LEAST_GROWTH) > 0.0
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
