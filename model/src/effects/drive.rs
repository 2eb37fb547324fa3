//! `drive`: a torque from outside, and the angle that goes with it.

use super::partner::{LOADS, Loads, Shown, Slopes, lag};
use super::{Act, Acting, Effect, Exchange, Facts, Law, Motion, Row, Terminal, Wrench};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::variable::units::{
    JOULE, NEWTON_METRE, NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN, ONE, RADIAN, RADIAN_PER_SECOND,
    RADIAN_PER_SECOND_SQUARED,
};
use crate::variable::{Bound, input, output, parameter};

/// A constant-velocity joint between the rotor and a drive along e.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Torque τ of the drive on the rotor [N·m].
    pub tau: Signal,
    /// Stiffness of the partner, where it is known [N·m/rad].
    pub k: f64,
    /// Its damping [N·m·s/rad].
    pub d: f64,
    /// By what part of the last communication step the angle is shown ahead \[1].
    pub ahead: f64,
    /// How many communication steps the torque is late \[1]; negative where that is not known.
    pub lag: f64,
    /// The law that the partner follows between communication points.
    law: Law,
}

impl Default for Drive {
    fn default() -> Self {
        Self { tau: Signal::default(), k: 0.0, d: 0.0, ahead: 0.0, lag: -1.0, law: Law::default() }
    }
}

impl Drive {
    /// A drive with this torque, whose partner is not known.
    pub fn with(tau: Signal) -> Self {
        Self { tau, ..Self::default() }
    }

    /// Torque [N·m].
    #[inline(always)]
    fn torque<S: Scalar>(&self, motion: &Motion<S>) -> S {
        let tau = motion.input(&self.tau);
        if S::SERIES || !self.law.is_on {
            return tau;
        }
        let Law { slopes, shown, rest: [value, rate, bend], since, at, .. } = &self.law;
        let (speed, span) = (motion.omega_phi(), motion.t() - S::constant(*since));
        // Within a step the speed changes steadily, so that nothing hangs on φ: φ_n + ½ (ω_n + ω_φ)(t − t_n)
        let turned = (S::constant(at[LOADS]) + speed) * span * S::constant(0.5) + S::constant(at[0] - shown[0]);
        let rest = S::constant(value[0]) + (S::constant(rate[0]) + S::constant(bend[0]) * span) * span;
        // eq. 124: τ = τ_s − k (φ − φ_s) − d (ω_φ − ω_s) + g(s)
        tau + turned * S::constant(slopes[(0, 0)])
            + (speed - S::constant(shown[LOADS])) * S::constant(slopes[(0, LOADS)])
            + rest
    }

    /// The angle that is shown \[rad].
    fn angle<S: Scalar>(&self, motion: &Motion<S>) -> S {
        if self.law.ahead == 0.0 {
            return motion.phi();
        }
        // φ + ω_φ s
        motion.phi() + motion.omega_phi() * S::constant(self.law.ahead)
    }
}

impl Effect for Drive {
    const LAW: &'static str =
        "M = τ n, n = (e + t)/(1 + e·t): a torque that a constant-velocity joint passes on, of power τ ω_φ";

    const ROWS: &'static [Row<Self>] = &[
        input!(tau, &NEWTON_METRE, 0.0, "torque of the drive on the rotor, passed on by a constant-velocity joint"),
        output!("phi", &RADIAN, "angle of the drive, the axial angle of the rotor", |d, m| d.angle(m)),
        output!("w", &RADIAN_PER_SECOND, "speed of the drive, the rate of its angle", |_, m| m.omega_phi()),
        output!("a", &RADIAN_PER_SECOND_SQUARED, "acceleration of the drive", |_, m, rates| {
            m.axial_acceleration(rates)
        }),
        parameter!(
            k,
            &NEWTON_METRE_PER_RADIAN,
            Some(0.0),
            Bound::NotNegative,
            "stiffness of the partner, where it is known: between communication points the torque follows the angle by it"
        ),
        parameter!(
            d,
            &NEWTON_METRE_SECOND_PER_RADIAN,
            Some(0.0),
            Bound::NotNegative,
            "damping of the partner, where it is known: between communication points the torque follows the speed by it"
        ),
        parameter!(
            ahead,
            &ONE,
            Some(0.0),
            Bound::Within(-1.0, 2.0),
            "phi is shown ahead by this part of the last communication step, for a partner that holds it"
        ),
        output!(
            "energy_error",
            &JOULE,
            "energy that the exchange brought in so far: work of the torque beyond that of the partner's answers, which lines or a law join",
            |d, _| Scalar::constant(d.law.error)
        ),
        lag!(),
    ];

    const EXCLUDES: &'static [&'static str] = &["imposed_speed"];

    // The members have the names of Modelica's adaptors between flanges and signals.
    const TERMINAL: Option<Terminal> =
        Some(Terminal { kind: "Modelica.Mechanics.Rotational.Interfaces.Flange_a", flows: &["tau"] });

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let tau = self.torque(motion);
        // eq. 32: M = τ n, P = τ ω_φ
        let supply = motion.power_along(1.0, tau, motion.omega_phi());
        Act { load: Wrench::along_joint(motion, tau), supply, ..Act::none() }
    }

    const FACTS: Facts = Facts { partners: 1, ..Facts::USUAL };

    fn is_analytic(&self) -> bool {
        !self.knows_partner()
    }

    fn follows_speed(&self) -> bool {
        self.knows_partner()
    }

    fn knows_partner(&self) -> bool {
        self.k != 0.0 || self.d != 0.0
    }

    fn is_answered(&self, t: f64) -> bool {
        self.tau.set_at(t).is_some() && !self.tau.was_sent_derivatives_at(t)
    }

    fn exchange(&self, motion: &Motion<f64>) -> Option<Exchange> {
        let (mut at, mut loads, mut slopes) = (Shown::zeros(), Loads::zeros(), Slopes::zeros());
        (at[0], at[LOADS], loads[0]) = (motion.phi(), motion.omega_phi(), self.tau.at(motion.t()));
        (slopes[(0, 0)], slopes[(0, LOADS)]) = (-self.k, -self.d);
        let [yielding, gyration] = motion.yielding(0.0);
        let given = self.knows_partner().then_some(slopes);
        Some(Exchange { at, loads, given, turns_along: true, learns: false, ahead: self.ahead, yielding, gyration })
    }

    fn acting(&self, t: f64) -> Acting {
        [0, 1, 2, 3].map(|power| {
            let mut loads = Loads::zeros();
            loads[0] = self.tau.coefficient(t, power);
            loads
        })
    }

    fn lag(&self) -> Option<f64> {
        (self.lag >= 0.0).then_some(self.lag)
    }

    fn law_mut(&mut self) -> Option<&mut Law> {
        Some(&mut self.law)
    }

    fn no_limit(&self) -> Option<&'static str> {
        (!self.tau.is_zero() || self.knows_partner()).then_some(no_limit!("drive.tau, which a joint passes on,"))
    }
}
