//! Whether the exchange with partners drives the rotor: the map of one communication step, and the longest steps that would do.

use super::growth::{LINEAR, Linear, Watch, linear};
use super::partners::{Answers, LAGS};
use crate::effects::{Block, Effects, Law};
use crate::log::shown;
use crate::rotor::{Frame, Rotor};
use crate::stored::stored;
use nalgebra::SMatrix;
use std::fmt::{self, Display, Formatter};

/// A coupling that is wrong, as it was when that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coupling {
    /// When \[s].
    pub t: f64,
    /// The communication step \[s].
    pub step: f64,
    /// The part by which the loads at the ports did too much or too little work, of what went through \[1].
    pub wrong: f64,
    /// By what part small motions grow in a communication step \[1]; 0 where the partners are not known well enough.
    pub growth: f64,
    /// The largest stiffness of a partner, as its answers look [N/m].
    pub stiffness: f64,
    /// How many communication steps answers are late.
    pub lag: u32,
    /// The longest communication steps with which they would not grow, where inputs are extrapolated by the orders 0, 1 and 2 \[s].
    pub longest: [f64; ORDERS],
}

stored!(Coupling { t, step, wrong, growth, stiffness, lag, longest });

impl Display for Coupling {
    /// What to warn of.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { t, step, wrong, growth, stiffness, lag, longest } = self;
        let [t, step] = [*t, *step].map(shown);
        write!(
            f,
            "the exchange with the models at the ports is wrong at communication steps of {step:?} s: until t = {t:?} s the work of the loads \
             was off by {:.1} % of the work exchanged",
            100.0 * wrong
        )?;
        if *growth > 0.0 {
            let (steps, [held, line, parabola]) = (if *lag == 1 { "step" } else { "steps" }, longest.map(shown));
            write!(
                f,
                ", and small motions grow by {:.2} % a step. The models answer like springs of {:.2e} N/m, {lag} {steps} late. The longest \
                 steps at which nothing grows by more than 0.01 % a step: {held:?} s; with effects.extrapolation, its lag = {lag} and its order = 1: {line:?} s, order = 2: \
                 {parabola:?} s",
                100.0 * growth,
                stiffness
            )?;
        }
        write!(
            f,
            ". Shorten the step, or give the ports the coefficients of these models; then compare with half the step"
        )
    }
}

impl Coupling {
    /// Of a rotor at time `t` \[s] and state `y`, by the answers of its partners, of each by its number, which are given after every `step`
    /// \[s]; its growth is 0 where they do not make it grow, or are not known. Where it is known that they feed the motion, the least growth
    /// counts. What is wrong is left open.
    pub(super) fn of<E: Effects, const N: usize>(
        rotor: &Rotor<'_, E>,
        t: f64,
        y: &[f64; N],
        answers: impl Fn(usize, &dyn Block) -> Option<Answers>,
        step: f64,
        is_fed: bool,
    ) -> Self {
        // The balanced rotor: what an unbalance adds turns with it.
        let Frame { body, chart, turns } = rotor.frame;
        let equations = |effects: &E| linear(&Rotor::new(body.symmetric(), effects, chart, turns), t, y);
        let held = equations(rotor.effects);
        let of_all = rotor.effects.lag().unwrap_or_default();
        let mut found = Self { t, step, ..Self::default() };
        let mut lags = [of_all; LAGS];
        let answered: [Linear; LAGS] = std::array::from_fn(|lag| {
            let mut effects = rotor.effects.clone();
            effects.for_each_partner(|number, block| {
                let Some(Answers { slopes, shown, .. }) = answers(number, block).filter(|one| one.lag == lag) else {
                    return;
                };
                let stiffest = (0..FORCES).map(|n| -slopes[(n, n)]).fold(0.0, f64::max);
                (found.lag, found.stiffness) = (lag as u32, found.stiffness.max(stiffest));
                lags[lag] = block.lag().unwrap_or(of_all);
                if let Some(law) = block.law_mut() {
                    *law = Law { is_on: true, turns: true, slopes, shown, ..Law::default() };
                }
            });
            equations(&effects) - held
        });
        let all = held + answered.iter().sum::<Linear>();
        let [_, held, fresh, late] = Watch::scaled([all, held, answered[0], answered[1]], &body);
        let coupled = Coupled { held, answered: [fresh, late] };
        if coupled.is_finite() {
            found.growth = coupled.growth(step, rotor.effects.order(), lags, if is_fed { LEAST_GROWTH } else { GROWS });
        }
        if found.growth > 0.0 {
            found.longest = coupled.longest(step, [f64::from(found.lag); LAGS]);
        }
        found
    }
}

/// Loads that are forces come first.
const FORCES: usize = 3;

/// Degrees of polynomials by which inputs may go on, counted from 0.
pub const ORDERS: usize = 3;

/// The last communication points, each with a linear motion: answers are late by one at most, and a parabola goes through three.
const POINTS: usize = LAGS - 1 + ORDERS;
const NUMBERS: usize = POINTS * LINEAR;

type Map = SMatrix<f64, NUMBERS, NUMBERS>;

/// The linear motion of a rotor and what its partners add, scaled to numbers of one size.
#[derive(Clone, Copy, Debug)]
pub struct Coupled {
    /// Its equations, with inputs that are held [1/s].
    pub held: Linear,
    /// What partners add, by how many steps their answers are late [1/s].
    pub answered: [Linear; LAGS],
}

/// What grows by less than this in a step is not warned of, unless the exchange feeds it \[1].
const GROWS: f64 = 2e-3;

/// What grows by less than this in a step may be rounding or a drift \[1].
pub const LEAST_GROWTH: f64 = 1e-4;

/// What grows in one model by more than this part of it is no fault of the exchange \[1].
const OWN: f64 = 0.5;

/// Number of squarings after which the growth of a map is known.
const SQUARINGS: u32 = 20;

/// Steps are sought over this range about that of now \[1], in so many bisections.
const RANGE: f64 = 1024.0;
const BISECTIONS: u32 = 12;

/// Terms of an exponential, and the size from which on its argument is halved.
const TERMS: u32 = 12;
const SMALL: f64 = 0.5;

impl Coupled {
    fn is_finite(&self) -> bool {
        self.held.iter().chain(self.answered.iter().flatten()).all(|entry| entry.is_finite())
    }

    /// By what part small motions grow in a step \[s] of the exchange, and not in one model, where inputs go on by `order` and are taken
    /// for late by `lags`, of each of those that are [answered](Self::answered) \[1]; 0 where that is less than `least`.
    pub fn growth(&self, step: f64, order: usize, lags: [f64; LAGS], least: f64) -> f64 {
        let coupled = per_application(self.map(step, order, lags));
        let own = per_application(exponential((self.held + self.answered.iter().sum::<Linear>()) * step));
        if coupled > least && own < OWN * coupled { libm::expm1(coupled) } else { 0.0 }
    }

    /// The longest steps near this one \[s] with which nothing grows, by each order.
    fn longest(&self, step: f64, lags: [f64; LAGS]) -> [f64; ORDERS] {
        std::array::from_fn(|order| {
            let (mut short, mut long) = (libm::log(step / RANGE), libm::log(step * RANGE));
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (short + long);
                let grows = self.growth(libm::exp(middle), order, lags, LEAST_GROWTH) > 0.0;
                (short, long) = if grows { (short, middle) } else { (middle, long) };
            }
            libm::exp(short)
        })
    }

    /// The last points after a communication step, from those before.
    fn map(&self, step: f64, order: usize, lags: [f64; LAGS]) -> Map {
        const { assert!(POINTS == 1 + ORDERS, "a motion and its inputs have the room of as many points") };
        // eq. 127: dx/dt = A x + u₀, du₀/dt = u₁, du₁/dt = u₂ over the step, t in steps
        let mut rates = Map::zeros();
        let block = |row: usize, column: usize| (row * LINEAR, column * LINEAR);
        rates.fixed_view_mut::<LINEAR, LINEAR>(0, 0).copy_from(&(self.held * step));
        let mut put = |row: usize, column: usize, by: f64| {
            let (row, column) = block(row, column);
            rates.fixed_view_mut::<LINEAR, LINEAR>(row, column).copy_from(&(Linear::identity() * by));
        };
        put(0, 1, step);
        put(1, 2, 1.0);
        put(2, 3, 1.0);
        // u of the last values that were set, each the answer to a point: eq. 67 about its end
        let mut inputs = Map::zeros();
        inputs.fixed_view_mut::<LINEAR, LINEAR>(0, 0).copy_from(&Linear::identity());
        for (late, answered) in self.answered.iter().enumerate() {
            for (power, parts) in taken(order, lags[late]).into_iter().enumerate() {
                for (back, part) in parts.into_iter().enumerate() {
                    let (row, column) = block(1 + power, late + back);
                    let mut entry = inputs.fixed_view_mut::<LINEAR, LINEAR>(row, column);
                    entry += answered * part;
                }
            }
        }
        let mut map = exponential(rates) * inputs;
        for point in 1..POINTS {
            let (row, column) = block(point, point - 1);
            map.fixed_rows_mut::<LINEAR>(row).fill(0.0);
            map.fixed_view_mut::<LINEAR, LINEAR>(row, column).copy_from(&Linear::identity());
        }
        map
    }
}

/// Value, rate and second derivative of an input at the point where a step begins, in steps, by parts of the last three values; those
/// count as late by `lag` \[1].
fn taken(order: usize, lag: f64) -> [[f64; ORDERS]; ORDERS] {
    // eq. 67 at equal steps: u₀ + σ (u₀ − u₁) + ½ σ (σ + 1)(u₀ − 2 u₁ + u₂), σ = s + lag
    let mut parts = [[1.0, 0.0, 0.0], [0.0; ORDERS], [0.0; ORDERS]];
    let mut add = |by: [f64; ORDERS], differences: [f64; ORDERS]| {
        for (power, by) in by.into_iter().enumerate() {
            for (back, difference) in differences.into_iter().enumerate() {
                parts[power][back] += by * difference;
            }
        }
    };
    if order > 0 {
        add([lag, 1.0, 0.0], [1.0, -1.0, 0.0]);
    }
    if order > 1 {
        add([0.5 * lag * (lag + 1.0), lag + 0.5, 1.0], [1.0, -2.0, 1.0]);
    }
    parts
}

/// e to this matrix.
fn exponential<const D: usize>(matrix: SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
    let mut halvings = 0;
    let mut small = matrix;
    while small.norm() > SMALL {
        small *= 0.5;
        halvings += 1;
    }
    let mut sum = SMatrix::identity();
    let mut term = sum;
    for n in 1..=TERMS {
        term = term * small / f64::from(n);
        sum += term;
    }
    for _ in 0..halvings {
        sum = sum * sum;
    }
    sum
}

/// How fast a map makes what it is applied to grow, the logarithm a time.
fn per_application<const D: usize>(mut map: SMatrix<f64, D, D>) -> f64 {
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
        map = map * map;
    }
    grown
}
