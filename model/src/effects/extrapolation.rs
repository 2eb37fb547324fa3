//! `extrapolation`: what inputs will be over the next step, from what they were.

use super::partner::LATEST;
use super::{Effect, Facts, Row};
use crate::signal::{NODES, Signal, goes_on};
use crate::variable::units::ONE;
use crate::variable::{Access, Bound, Kind, Meta, Role, parameter};

/// Every input as a polynomial through its last values, for masters that send no derivatives, or send values late.
#[derive(Clone, Debug)]
pub struct Extrapolation {
    /// Degree of the polynomials: 0, 1 or 2.
    pub order: i32,
    /// How many communication steps the values are late \[1].
    pub lag: f64,
    /// Whether the last step is done again with what inputs were in it, once that is known.
    pub redo: bool,
    /// How many communication points are known; those points, the latest first; the values of each input there.
    memory: [f64; 1 + POINTS + MOST * NODES],
}

/// So many communication points are remembered.
const POINTS: usize = LATEST + NODES;

/// So many inputs are followed: those of four ports, a drive and a motor, and some to come. A list with more does not compile.
const MOST: usize = 32;

impl Default for Extrapolation {
    fn default() -> Self {
        Self { order: 0, lag: 0.0, redo: false, memory: [0.0; _] }
    }
}

impl Extrapolation {
    /// Polynomials of this degree, 0, 1 or 2, through values that are so many communication steps late \[1].
    pub fn new(order: i32, lag: f64) -> Self {
        Self { order, lag, ..Self::default() }
    }

    fn known(&self) -> usize {
        self.memory[0] as usize
    }

    fn points(&self) -> &[f64] {
        &self.memory[1..=POINTS]
    }

    /// The communication point so many steps back \[s], interpolated between two; the first one from there on.
    fn point(&self, back: f64) -> f64 {
        let back = back.min(self.known().saturating_sub(1) as f64);
        let n = back as usize;
        let (later, part) = (self.points()[n], back - n as f64);
        // No point is read that is not known.
        if part == 0.0 { later } else { later + part * (self.points()[n + 1] - later) }
    }

    fn values(&mut self, number: usize) -> &mut [f64; NODES] {
        let values = self.memory[1 + POINTS + number * NODES..].first_chunk_mut();
        values.expect("of each input so many are remembered")
    }

    /// The polynomial through the last values of an input that are `lag` steps late, from the one with this index on: coefficients of the
    /// powers of the time from `t` \[s] on.
    fn through(&mut self, number: usize, lag: f64, first: usize, degree: usize, t: f64) -> [f64; NODES] {
        let node = |n: usize| (first + n).min(NODES - 1);
        let times = std::array::from_fn(|n| self.point(lag + node(n) as f64));
        let values = *self.values(number);
        let values = std::array::from_fn(|n| values[node(n)]);
        let [change, slope, bend, third] = goes_on(t, times, values, degree);
        [values[0] + change, slope, bend, third]
    }
}

/// A row of a whole number.
macro_rules! whole {
    ($field:ident, $bound:expr, $description:expr) => {
        Row {
            meta: Meta {
                name: stringify!($field),
                description: $description,
                unit: &ONE,
                kind: Kind::Integer,
                role: Role::Parameter { default: Some(0.0), bound: $bound },
            },
            access: Access::Parameter { get: |e| f64::from(e.$field), set: |e, value| e.$field = value as i32 },
        }
    };
}

impl Effect for Extrapolation {
    const LAW: &'static str = "inputs go on through a step as the polynomial through their last values";

    const ROWS: &'static [Row<Self>] = &[
        whole!(
            order,
            Bound::OneOf(&[0.0, 1.0, 2.0]),
            "degree of the polynomials through the last values of each input"
        ),
        parameter!(
            lag,
            &ONE,
            Some(0.0),
            Bound::Within(0.0, LATEST as f64),
            "how many communication steps the values of inputs are late"
        ),
        Row {
            meta: Meta::boolean(
                "redo",
                false,
                "whether each step is done again with what inputs were in it, once that is known",
            ),
            access: Access::Parameter { get: |e| f64::from(e.redo), set: |e, value| e.redo = value != 0.0 },
        },
    ];

    const FACTS: Facts =
        Facts { pushes: false, could_work: false, extrapolates: true, most_extrapolated: MOST, ..Facts::USUAL };

    fn begin(&mut self, _start: &super::Motion<f64>) {
        self.memory[0] = 0.0;
    }

    fn step_from(&mut self, t: f64) {
        // A step that is done again begins where it began.
        if self.known() > 0 && self.points()[0] == t {
            return;
        }
        self.memory[1..=POINTS].rotate_right(1);
        self.memory[1] = t;
        for number in 0..MOST {
            let values = self.values(number);
            values.rotate_right(1);
            // Who says nothing holds.
            values[0] = values[1];
        }
        self.memory[0] = (self.known() + 1).min(POINTS) as f64;
    }

    fn extrapolate(&mut self, number: usize, lag: Option<f64>, signal: &mut Signal) {
        let t = self.points()[0];
        if let Some(value) = signal.set_at(t) {
            self.values(number)[0] = value;
        }
        // What the master says of the derivatives wins.
        if signal.was_sent_derivatives_at(t) {
            return;
        }
        let degree = (self.order as usize).min(self.known() - 1);
        // What is late belongs to the point so many steps back.
        let goes_on = self.through(number, lag.unwrap_or(self.lag), 0, degree, t);
        signal.extrapolate(t, goes_on);
    }

    fn interpolate(&mut self, number: usize, lag: Option<f64>, to: f64, signal: &mut Signal) {
        // What the master says of the derivatives wins, backwards too.
        if signal.was_sent_derivatives_at(self.points()[0]) {
            return;
        }
        let (lag, degree) = (lag.unwrap_or(self.lag), self.order as usize + 1);
        let at = |n: usize| self.point(lag + n as f64);
        // The latest value is of that time, or before others.
        let first = (0..NODES - degree).rev().find(|n| at(*n) >= to).unwrap_or_default();
        let is_apart = |n: &usize| at(first + n) > at(first + n + 1);
        let degree = (0..degree).take_while(is_apart).count();
        // eq. 129: of one degree more than eq. 67, between points that are known
        let goes_on = self.through(number, lag, first, degree, to);
        signal.extrapolate(to, goes_on);
    }

    fn known_until(&self, lag: f64) -> Option<f64> {
        self.redo.then(|| self.point(lag))
    }

    fn order(&self) -> usize {
        self.order as usize
    }

    fn lag(&self) -> Option<f64> {
        (self.lag > 0.0).then_some(self.lag)
    }

    fn memory(&mut self) -> &mut [f64] {
        &mut self.memory
    }

    fn restored(&mut self) -> bool {
        let is_count = (0..=POINTS).any(|count| self.memory[0] == count as f64);
        // Slopes are divided by the time between two points.
        is_count && self.points()[..self.known()].is_sorted_by(|later, earlier| later > earlier)
    }
}

#[cfg(test)]
mod tests {
    use super::super::drive::Drive;
    use super::super::list::Called;
    use super::super::list::follows_all_inputs;
    use super::super::port::Port;
    use super::*;
    use crate::effects::Effects;
    use crate::stored::{Damaged, from_bytes, to_bytes};

    type List = (Called<Drive, 1>, (Called<Extrapolation, 1>, ()));

    #[test]
    fn regress_no_input_is_silently_not_followed() {
        // A drive has one input, a port six; nobody extrapolates what an imposed speed tells of itself.
        assert_eq!(<List as Effects>::FACTS.extrapolated, 1);
        assert_eq!(<crate::effects::All as Effects>::FACTS.extrapolated, 26);
        assert!(follows_all_inputs::<crate::effects::All>());
        type Ports = (Called<Port, 1>, (Called<Port, 2>, (Called<Port, 3>, (Called<Port, 4>, ()))));
        type Many = (Called<Drive, 1>, (Called<Port, 1>, (Called<Port, 2>, Ports)));
        assert!(follows_all_inputs::<Many>(), "37 inputs that nobody extrapolates");
        assert!(!follows_all_inputs::<(Called<Extrapolation, 1>, Many)>(), "the same, extrapolated");
    }

    #[test]
    fn regress_a_memory_that_cannot_be_is_refused() {
        let mut list = List::default();
        for t in [0.0, 0.5, 1.0] {
            list.step_from(t);
        }
        let bytes = to_bytes(&mut list);
        assert_eq!(from_bytes(&mut List::default(), &bytes), Ok(()));
        let memory = bytes.len() / 8 - Extrapolation::default().memory().len();
        let altered = |n: usize, value: f64| {
            let mut bytes = bytes.clone();
            bytes[8 * (memory + n)..][..8].copy_from_slice(&value.to_le_bytes());
            from_bytes(&mut List::default(), &bytes)
        };
        for count in [-1.0, 0.5, POINTS as f64 + 1.0, 1e300, f64::INFINITY, f64::NAN] {
            assert_eq!(altered(0, count), Err(Damaged), "{count} points");
        }
        // Known points descend; what stands behind them is not looked at.
        for t in [0.5, 0.0, f64::NAN, f64::NEG_INFINITY] {
            assert_eq!(altered(1, t), Err(Damaged), "{t} s");
        }
        assert_eq!(altered(4, 7.0), Ok(()));
        assert_eq!(altered(0, 2.0), Ok(()));
    }
}
