//! `motor`: a torque that falls with the speed, so that its power is limited (Sommerfeld 1902).

use super::{Act, Effect, Facts, MOST_OWN, Motion, Row, Wrench};
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::variable::units::{NEWTON_METRE, NEWTON_METRE_PER_SECOND, ONE, RADIAN_PER_SECOND, SECOND};
use crate::variable::{Bound, input, output, own, parameter};

/// A motor on a straight characteristic, with the time constant of its windings; a constant-velocity joint passes its torque on.
#[derive(Clone, Debug)]
pub struct Motor {
    /// Torque at rest [N·m].
    pub stall_torque: f64,
    /// Speed at which it gives no torque [rad/s].
    pub synchronous_speed: f64,
    /// Of the torque, which follows its characteristic \[s]; 0: at once.
    pub time_constant: f64,
    /// Part of the stall torque \[1].
    pub command: Signal,
}

impl Default for Motor {
    fn default() -> Self {
        Self { stall_torque: 0.0, synchronous_speed: 1.0, time_constant: 0.0, command: Signal::held(1.0) }
    }
}

impl Motor {
    /// Whether it can give a torque: a host may have set one that dies out.
    fn can_act(&self) -> bool {
        self.stall_torque != 0.0 || self.time_constant != 0.0
    }

    /// The torque on the characteristic [N·m].
    #[inline(always)]
    fn steady<S: Scalar>(&self, motion: &Motion<S>) -> S {
        let part = motion.input(&self.command) - motion.omega_phi() * S::constant(1.0 / self.synchronous_speed);
        // eq. 96: τ∞ = τ_s (u − ω_φ/Ω_s)
        part * S::constant(self.stall_torque)
    }

    /// The torque on the rotor [N·m].
    #[inline(always)]
    fn torque<S: Scalar>(&self, motion: &Motion<S>) -> S {
        S::zero().where_less(S::constant(self.time_constant), motion.own(0), self.steady(motion))
    }

    /// The rate of its state [N·m/s].
    #[inline(always)]
    fn rate<S: Scalar>(&self, motion: &Motion<S>) -> S {
        let time = S::constant(self.time_constant);
        // eq. 96: T dτ/dt = τ∞ − τ
        S::zero().where_less(time, (self.steady(motion) - motion.own(0)) / time, S::zero())
    }
}

impl Effect for Motor {
    const LAW: &'static str = "M = τ n, time_constant dτ/dt = stall_torque (command − ω_φ/synchronous_speed) − τ";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(stall_torque, &NEWTON_METRE, Some(0.0), Bound::NotNegative, "torque at rest, at full command"),
        parameter!(
            synchronous_speed,
            &RADIAN_PER_SECOND,
            None,
            Bound::Positive,
            "axial rate at which it gives no torque at full command"
        ),
        parameter!(
            time_constant,
            &SECOND,
            Some(0.0),
            Bound::NotNegative,
            "time in which the torque follows its characteristic; 0: at once"
        ),
        input!(command, &ONE, 1.0, "part of the stall torque that is asked for"),
        output!(
            "tau",
            &NEWTON_METRE,
            "torque of the motor on the rotor, passed on by a constant-velocity joint",
            |m, s| { m.torque(s) }
        ),
        own!(state 0, "state.tau", &NEWTON_METRE, "torque that follows the characteristic"),
        own!(rate 0, "der(state.tau)", &NEWTON_METRE_PER_SECOND, "rate of the torque that follows the characteristic"),
    ];

    const FACTS: Facts = Facts { own: 1, ..Facts::USUAL };

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let tau = self.torque(motion);
        let mut own = [S::zero(); MOST_OWN];
        own[0] = self.rate(motion);
        // eq. 96: M = τ n, P = τ ω_φ
        let supply = motion.power_along(1.0, tau, motion.omega_phi());
        Act { load: Wrench::along_joint(motion, tau), supply, own, ..Act::none() }
    }

    fn check(&self) -> Result<(), Invalid> {
        if self.own_decay().is_finite() {
            return Ok(());
        }
        Err(Invalid::new("time_constant", self.time_constant, "0, or a number large enough to divide by"))
    }

    fn own_at_start(&self, start: &Motion<f64>) -> [f64; MOST_OWN] {
        let mut own = [0.0; MOST_OWN];
        own[0] = self.steady(start);
        own
    }

    fn own_decay(&self) -> f64 {
        if self.time_constant > 0.0 { 1.0 / self.time_constant } else { 0.0 }
    }

    fn own_nominal(&self) -> [f64; MOST_OWN] {
        // Errors are told in squares of it.
        let torque = self.stall_torque;
        [if (torque * torque).is_normal() { torque } else { 1.0 }; MOST_OWN]
    }

    fn no_limit(&self) -> Option<&'static str> {
        self.can_act().then_some(no_limit!("motor.tau, which a joint passes on,"))
    }

    fn works(&self) -> bool {
        self.can_act()
    }
}
