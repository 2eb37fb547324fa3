//! `imposed_speed`: a shaft that turns as it is told, whatever torque that takes.
//!
//! Both inputs tell one signal, a speed that is continuous: a new rate bends it from where it is, a new speed sets it. Where a
//! host sends derivatives of w, they tell the rate themselves.

use super::{Effect, Facts, InputSet, Motion, Row, Terminal};
use crate::scalar::{Scalar, ulp};
use crate::signal::Signal;
use crate::state::{Kinematics, Rates};
use crate::variable::units::{KILOGRAM_METRE_SQUARED, NEWTON_METRE, RADIAN_PER_SECOND, RADIAN_PER_SECOND_SQUARED};
use crate::variable::{Bound, input, output, parameter};
use nalgebra::Vector3;

/// The speed of a shaft that turns the rotor through a constant-velocity joint.
#[derive(Clone, Debug, Default)]
pub struct ImposedSpeed {
    /// ω_φ where it was last set [rad/s].
    pub w: Signal,
    /// Its rate, where w has no derivatives of its own [rad/s²].
    pub a: Signal,
    /// Inertia of a partner that sends w alone [kg·m²]; 0 where it is not known.
    pub partner_inertia: f64,
    memory: [f64; MEMORY],
}

/// What is remembered, by its place.
mod at {
    /// What the speed gained over w where an input was last set [rad/s], and whether that was a.
    pub const GAINED: usize = 0;
    pub const BENT: usize = 1;
    /// The last value of w that counted [rad/s], and how many of the last two that were set differed from the one before, up to the last
    /// that did not.
    pub const TOLD: usize = 2;
    pub const DIFFERED: usize = 3;
    /// The last two communication points, the later first \[s].
    pub const T: usize = 4;
    /// λ at the last one, before w jumps there [N·m·s], and ω_φ [rad/s].
    pub const IMPULSE: usize = 6;
    pub const SPEED: usize = 7;
    /// ω_φ as the last step began, after w jumped [rad/s].
    pub const BEGAN: usize = 8;
    /// What is sent to a partner, and what was sent at the point before [N·m].
    pub const SENT: usize = 9;
    /// Whether there was a step.
    pub const MOVED: usize = 11;
}

const MEMORY: usize = 12;

/// Two values of w are one where they differ by no more: hosts interpolate, and 100 comes back as 100.00000000000001 [ulp].
const SAME: f64 = 4.0;

/// A speed is sampled where so many values that were set, one after the other, differed from the one before each \[1].
const SAMPLED: f64 = 2.0;

/// The row of w.
const W: usize = 0;

impl ImposedSpeed {
    /// A shaft that turns at ω_φ [rad/s] until it is told otherwise.
    pub fn new(w: f64) -> Self {
        Self { w: Signal::held(w), ..Self::default() }
    }

    /// The torque of the shaft on the rotor, where the state has these rates [N·m].
    fn torque<S: Scalar>(&self, motion: &Motion<S>, rates: &Rates<S>) -> S {
        let motion = motion.whole();
        // eq. 76: M = dK/dt + λ dn/dt
        let moment = rates.coordinates.k + motion.carried().unwrap_or_else(Vector3::zeros);
        motion.torque(self.told(motion.t)[1], &moment)
    }

    /// ω_φ [rad/s] and its rate [rad/s²] at time `t` \[s].
    #[inline(always)]
    fn told<S: Scalar>(&self, t: S) -> [S; 2] {
        // A host that integrates goes back in time, so that what was set last is not what was set latest.
        let since = if self.memory[at::BENT] == 0.0 { self.w.since() } else { self.a.since() };
        let start = self.w.at(S::constant(since)) + S::constant(self.memory[at::GAINED]);
        // eq. 75: ω_φ = w + ∫a dt
        if self.w.is_held() {
            [start + self.a.sum(since, t), self.a.at(t)]
        } else {
            [start + self.w.gain(since, t), self.w.rate_at(t)]
        }
    }

    /// The mean torque over the step of `h` \[s] that ended here [N·m].
    fn mean(&self, end: &Kinematics<f64>, impulse: f64, h: f64) -> f64 {
        let memory = &self.memory;
        // eq. 77: τ = (∫τ dt + Σ impulses)/H, since dλ/dt = τ, and λ jumps by an impulse
        let mean = (impulse - memory[at::IMPULSE]) / h;
        let partner = self.partner_inertia;
        if partner == 0.0 {
            return mean;
        }
        let rotor = end.inertia_along_joint();
        let load = mean - rotor * (end.axial_rate() - memory[at::SPEED]) / h;
        let outside = if memory[at::MOVED] == 0.0 {
            0.0
        } else {
            let [gained, past] = [self.told(memory[at::T])[0] - memory[at::BEGAN], memory[at::T] - memory[at::T + 1]];
            // eq. 78: a master may step both at once, or one after the other.
            partner * gained / past + (2.0 * memory[at::SENT] + memory[at::SENT + 1]) / 3.0
        };
        // eq. 78: τ = (J_r (J_p Δw/H + τ_s) + J_p τ_l)/(J_r + J_p)
        (rotor * outside + partner * load) / (rotor + partner)
    }
}

impl Effect for ImposedSpeed {
    const LAW: &'static str = "ω_φ = w, which goes on with the rate a; tau is the torque that this takes";

    const ROWS: &'static [Row<Self>] = &[
        input!(w, &RADIAN_PER_SECOND, 0.0, "axial rate that the shaft imposes"),
        input!(
            a,
            &RADIAN_PER_SECOND_SQUARED,
            0.0,
            "rate of w, from where it is; does not count where derivatives of w are sent"
        ),
        output!("tau", &NEWTON_METRE, "torque of the shaft on the rotor at this moment", |s, m, rates| {
            s.torque(m, rates)
        }),
        parameter!(
            "partner_J",
            partner_inertia,
            &KILOGRAM_METRE_SQUARED,
            Some(0.0),
            Bound::NotNegative,
            "inertia of a partner that sends w alone and takes tau_mean; 0: not known"
        ),
        output!(
            "tau_mean",
            &NEWTON_METRE,
            "mean torque of the shaft on the rotor over the last communication step, jumps of w included",
            |s, _| Scalar::constant(s.memory[at::SENT])
        ),
    ];

    const FACTS: Facts = Facts { imposes: true, tells_rates: true, ..Facts::USUAL };

    const EXCLUDES: &'static [&'static str] = &["motor"];

    // A partner has one of the two torques.
    const TERMINAL: Option<Terminal> =
        Some(Terminal { kind: "Modelica.Mechanics.Rotational.Interfaces.Flange_a", flows: &["tau", "tau_mean"] });

    #[inline(always)]
    fn imposed<S: Scalar>(&self, t: S) -> Option<[S; 2]> {
        Some(self.told(t))
    }

    fn no_limit(&self) -> Option<&'static str> {
        Some(no_limit!("the speed that imposed_speed gives a joint"))
    }

    fn begin(&mut self, start: &Motion<f64>) {
        let start = start.whole();
        self.memory = [0.0; MEMORY];
        self.memory[at::TOLD] = self.w.at(start.t);
        self.memory[at::T] = start.t;
        self.memory[at::IMPULSE] = start.impulse.unwrap_or_default();
        self.memory[at::SPEED] = start.axial_rate();
    }

    fn input_set(&mut self, before: &Self, set: InputSet) -> bool {
        let InputSet { row, order, t, goes_on } = set;
        let mut counts = false;
        if row == W && order == 0 {
            let (value, last) = (self.w.at::<f64>(t), self.memory[at::TOLD]);
            let differs = (value - last).abs() > SAME * ulp(last);
            // A sampled speed is followed point by point, up to its plateau; one that is set and then only repeated leaves a ramp alone.
            counts = differs || self.memory[at::DIFFERED] >= SAMPLED;
            if counts {
                self.memory[at::TOLD] = value;
            }
            self.memory[at::DIFFERED] = if differs { (self.memory[at::DIFFERED] + 1.0).min(SAMPLED) } else { 0.0 };
        }
        if goes_on && !counts {
            return false;
        }
        let [speed, _] = before.told(t);
        self.memory[at::GAINED] = if counts { 0.0 } else { speed - self.w.at(t) };
        self.memory[at::BENT] = f64::from(row != W);
        true
    }

    fn step_to(&mut self, end: &Motion<f64>) {
        let end = end.whole();
        let h = end.t - self.memory[at::T];
        let Some(impulse) = end.impulse.filter(|_| h > 0.0) else { return };
        let sent = self.mean(end, impulse, h);
        let began = self.told(self.memory[at::T])[0];
        let memory = &mut self.memory;
        (memory[at::SENT + 1], memory[at::T + 1]) = (memory[at::SENT], memory[at::T]);
        (memory[at::SENT], memory[at::T], memory[at::MOVED]) = (sent, end.t, 1.0);
        (memory[at::IMPULSE], memory[at::SPEED], memory[at::BEGAN]) = (impulse, end.axial_rate(), began);
    }

    fn memory(&mut self) -> &mut [f64] {
        &mut self.memory
    }
}
