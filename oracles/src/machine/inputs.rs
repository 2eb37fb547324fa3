//! What comes in from outside: polynomials in time about the point where each was last set, and their extrapolation.

use super::Machine;

/// An input, ports and axes counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// Torque of the drive [N·m].
    Torque,
    /// Part of the motor's stall torque \[1].
    Command,
    /// ω_φ that is imposed [rad/s].
    Speed,
    /// Its rate [rad/s²].
    Acceleration,
    /// Force at a port, along an axis \[N].
    Force(usize, usize),
    /// Moment at a port, about an axis [N·m].
    Moment(usize, usize),
}

/// u₀ + u₁ s + ½ u₂ s², s from its origin.
#[derive(Clone, Copy, Debug, Default)]
pub struct Polynomial {
    pub origin: f64,
    pub terms: [f64; 3],
}

impl Polynomial {
    /// Its value at a time \[s].
    #[inline(always)]
    pub fn at(&self, t: f64) -> f64 {
        let ([value, slope, curvature], s) = (self.terms, t - self.origin);
        value + s * (slope + s * (0.5 * curvature))
    }

    /// The same about another origin \[s].
    fn about(&self, t: f64) -> Self {
        let ([_, slope, curvature], s) = (self.terms, t - self.origin);
        Self { origin: t, terms: [self.at(t), slope + s * curvature, curvature] }
    }

    /// Its integral from its origin to a time \[s].
    fn sum(&self, t: f64) -> f64 {
        let ([value, slope, curvature], s) = (self.terms, t - self.origin);
        s * (value + s * (slope / 2.0 + s * (curvature / 6.0)))
    }
}

/// The imposed speed: w where it was last bent or set, and its rate from there on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Imposed {
    w: f64,
    rate: Polynomial,
    /// The value that was set last, and whether that set differed from the one before.
    told: f64,
    differed: bool,
}

impl Imposed {
    /// ω_φ [rad/s] and its rate [rad/s²] at a time \[s].
    pub fn at(&self, t: f64) -> [f64; 2] {
        [self.w + self.rate.sum(t), self.rate.at(t)]
    }
}

/// How many points and values are remembered.
const REMEMBERED: usize = 12;

/// All inputs as they are in force: the drive's torque, the motor's command, then force and moment of each port.
#[derive(Clone, Debug)]
pub struct Inputs {
    loads: Vec<Polynomial>,
    /// As they were told, where they are extrapolated.
    told: Vec<Polynomial>,
    imposed: Imposed,
    extrapolation: Option<[usize; 2]>,
    /// Communication points, the latest first, and the values that were told there.
    history: Vec<(f64, Vec<f64>)>,
    /// The communication point.
    now: f64,
}

fn place(input: Input) -> Option<usize> {
    match input {
        Input::Torque => Some(0),
        Input::Command => Some(1),
        Input::Force(port, axis) => Some(2 + 6 * port + axis),
        Input::Moment(port, axis) => Some(5 + 6 * port + axis),
        Input::Speed | Input::Acceleration => None,
    }
}

impl Inputs {
    /// As the machine has them at time 0.
    pub fn new(machine: &Machine) -> Self {
        let mut held = vec![Polynomial::default(); 2 + 6 * machine.ports.len()];
        held[1].terms[0] = 1.0;
        let mut inputs = Self {
            loads: held.clone(),
            told: held,
            imposed: Imposed::default(),
            extrapolation: machine.extrapolation,
            history: Vec::new(),
            now: 0.0,
        };
        for (input, value) in &machine.inputs {
            match (input, place(*input)) {
                (_, Some(n)) => inputs.told[n].terms[0] = *value,
                (Input::Speed, _) => (inputs.imposed.w, inputs.imposed.told) = (*value, *value),
                (_, None) => inputs.imposed.rate.terms[0] = *value,
            }
        }
        inputs.loads.clone_from(&inputs.told);
        inputs
    }

    /// Sets an input at the communication point `t` \[s]: its value and two derivatives. True where the imposed speed jumps.
    pub fn set(&mut self, t: f64, input: Input, terms: [f64; 3]) -> bool {
        if let Some(n) = place(input) {
            self.told[n] = Polynomial { origin: t, terms };
            self.loads[n] = self.told[n];
            return false;
        }
        let imposed = &mut self.imposed;
        let (w, rate) = (imposed.at(t)[0], imposed.rate.about(t));
        match input {
            Input::Speed => {
                let differs = terms[0] != imposed.told;
                let counts = differs || imposed.differed;
                (imposed.told, imposed.differed) = (terms[0], differs);
                if counts {
                    (imposed.w, imposed.rate) = (terms[0], rate);
                }
                counts
            }
            _ => {
                (imposed.w, imposed.rate) = (w, Polynomial { origin: t, terms });
                false
            }
        }
    }

    /// A communication step begins at `t` \[s]: polynomials through the last values, where inputs are extrapolated.
    pub fn step_from(&mut self, t: f64) {
        self.now = t;
        let Some([order, lag]) = self.extrapolation else { return };
        self.history.insert(0, (t, self.told.iter().map(|told| told.at(t)).collect()));
        self.history.truncate(REMEMBERED);
        for n in 0..self.loads.len() {
            let degree = order.min(self.history.len() - 1);
            // A value that is told at a point belongs to the point `lag` before it.
            let point = |i: usize| self.history[(i + lag).min(self.history.len() - 1)].0;
            let value = |i: usize| self.history[i].1[n];
            let slope = |i: usize| {
                let gained = value(i) - value(i + 1);
                if gained == 0.0 { 0.0 } else { gained / (point(i) - point(i + 1)) }
            };
            // Newton's form about the first node, then about the step's beginning.
            let first = if degree > 0 { slope(0) } else { 0.0 };
            let second = if degree > 1 && first != slope(1) { (first - slope(1)) / (point(0) - point(2)) } else { 0.0 };
            let to_second = if degree > 1 { point(0) - point(1) } else { 0.0 };
            let about = Polynomial { origin: point(0), terms: [value(0), first + second * to_second, 2.0 * second] };
            self.loads[n] = about.about(t);
        }
    }

    /// The drive's torque at a time \[s].
    pub fn torque(&self, t: f64) -> f64 {
        self.loads[0].at(t)
    }

    /// The motor's command at a time \[s].
    pub fn command(&self, t: f64) -> f64 {
        self.loads[1].at(t)
    }

    /// Force and moment of a port at a time \[s].
    pub fn port(&self, port: usize, t: f64) -> [nalgebra::Vector3<f64>; 2] {
        let at = |first: usize| nalgebra::Vector3::from_fn(|axis, _| self.loads[first + axis].at(t));
        [at(2 + 6 * port), at(5 + 6 * port)]
    }

    /// The imposed speed.
    pub fn imposed(&self) -> &Imposed {
        &self.imposed
    }
}
