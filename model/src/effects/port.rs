//! `port`: force and moment from outside at a station, and the motion that goes with them.

use super::partner::{LOADS, Loads, Shown, Slopes, lag};
use super::{Act, Acting, Effect, Exchange, Facts, Law, Motion, Row, Terminal, Wrench};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::variable::units::{
    JOULE, METRE, METRE_PER_SECOND, NEWTON, NEWTON_METRE, NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN,
    NEWTON_PER_METRE, NEWTON_SECOND_PER_METRE, ONE, RADIAN, RADIAN_PER_SECOND,
};
use crate::variable::{Access, Bound, Meta, input, output, parameter};
use nalgebra::Vector3;

/// A station to which another model is coupled.
#[derive(Clone, Debug)]
pub struct Port {
    /// Where it is, along t from c \[m].
    pub position: f64,
    /// Force on the rotor in O \[N].
    pub f: Vector3<Signal>,
    /// Moment on the rotor in O [N·m].
    pub m: Vector3<Signal>,
    /// Whether the law of a partner is learnt from what it answers.
    pub learn: bool,
    /// What is known of the partner: stiffness along x, across by rows of y and z [N/m], and against tilt [N·m/rad].
    pub k: [f64; 6],
    /// Its damping, alike [N·s/m], [N·m·s/rad].
    pub c: [f64; 6],
    /// By what part of the last communication step place and angles are shown ahead \[1].
    pub ahead: f64,
    /// How many communication steps the loads are late \[1]; negative where that is not known.
    pub lag: f64,
    /// The law that the partner follows between communication points.
    law: Law,
}

impl Default for Port {
    fn default() -> Self {
        Self {
            position: 0.0,
            f: Vector3::default(),
            m: Vector3::default(),
            learn: true,
            k: [0.0; 6],
            c: [0.0; 6],
            ahead: 0.0,
            lag: -1.0,
            law: Law::default(),
        }
    }
}

/// Where the coefficients of a partner stand among the slopes: load and place of xx, yy, yz, zy, zz and of the tilt.
const COEFFICIENTS: [(usize, usize); 5] = [(0, 0), (1, 1), (1, 2), (2, 1), (2, 2)];

impl Port {
    /// Force \[N] and moment [N·m].
    #[inline(always)]
    fn given<S: Scalar>(&self, motion: &Motion<S>) -> [Vector3<S>; 2] {
        let [force, moment] = [&self.f, &self.m].map(|loads| match S::SERIES {
            true => loads.map(|signal| motion.input(&signal)),
            false => at(loads, motion.t()),
        });
        if S::SERIES || !self.law.is_on {
            return [force, moment];
        }
        // eq. 124: f = f_s + J (x − x_s) + g(s)
        let change = self.law.change(motion.t(), self.shown(motion, self.law.turns));
        let about = Vector3::new(S::zero(), change[3], change[4]);
        [force + Vector3::new(change[0], change[1], change[2]), moment + about]
    }

    /// A place or an angle as it is shown, which changes at this rate.
    #[inline(always)]
    fn ahead<S: Scalar>(&self, now: S, rate: impl FnOnce() -> S) -> S {
        if self.law.ahead == 0.0 { now } else { now + rate() * S::constant(self.law.ahead) }
    }

    /// Position of the station as it is shown, along one axis \[m].
    #[inline(always)]
    fn position_ahead<S: Scalar>(&self, motion: &Motion<S>, axis: usize) -> S {
        self.ahead(motion.station(self.position)[axis], || motion.station_velocity(self.position)[axis])
    }

    /// Place and motion, without what is shown ahead; where it says nothing of moments and leans, these are left out.
    #[inline(always)]
    fn shown<S: Scalar>(&self, motion: &Motion<S>, turns: bool) -> Shown<S> {
        let (r, v) = (motion.station(self.position), motion.station_velocity(self.position));
        if !turns {
            return Shown::from([r.x, r.y, r.z, S::zero(), S::zero(), v.x, v.y, v.z, S::zero(), S::zero()]);
        }
        let (lean, turn) = (motion.lean(), motion.turn());
        Shown::from([r.x, r.y, r.z, lean.x, lean.y, v.x, v.y, v.z, turn.y, turn.z])
    }

    /// Slopes of the loads that the coefficients of the partner make.
    fn slopes(&self) -> Option<Slopes> {
        if !self.knows_partner() {
            return None;
        }
        let mut slopes = Slopes::zeros();
        for (coefficients, from) in [(&self.k, 0), (&self.c, LOADS)] {
            // eq. 61: F = −(kxx x, K q), M = −kt γ
            for (n, (load, place)) in COEFFICIENTS.into_iter().enumerate() {
                slopes[(load, from + place)] = -coefficients[n];
            }
            for load in 3..LOADS {
                slopes[(load, from + load)] = -coefficients[5];
            }
        }
        Some(slopes)
    }
}

/// A coefficient of the partner.
macro_rules! coefficient {
    ($name:ident, $field:ident[$n:literal], $unit:expr, $what:literal) => {
        Row {
            meta: Meta::parameter(
                stringify!($name),
                $unit,
                Some(0.0),
                Bound::Finite,
                concat!(
                    $what,
                    " of the partner, where it is known: between communication points the port goes on by it"
                ),
            ),
            access: Access::Parameter { get: |p: &Port| p.$field[$n], set: |p, value| p.$field[$n] = value },
        }
    };
}

/// Inputs at time `t` \[s]. Called: written out for each port, they would cost the others registers.
#[inline(never)]
fn at<S: Scalar>(inputs: &Vector3<Signal>, t: S) -> Vector3<S> {
    inputs.map(|signal| signal.at(t))
}

impl Effect for Port {
    const LAW: &'static str = "the force f at a station and the moment m, from outside";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(position, &METRE, None, Bound::Finite, "axial position from the mass centre"),
        input!(f.x, &NEWTON, 0.0, "force on the rotor at the station, x"),
        input!(f.y, &NEWTON, 0.0, "force on the rotor at the station, y"),
        input!(f.z, &NEWTON, 0.0, "force on the rotor at the station, z"),
        input!(m.x, &NEWTON_METRE, 0.0, "moment on the rotor, x"),
        input!(m.y, &NEWTON_METRE, 0.0, "moment on the rotor, y"),
        input!(m.z, &NEWTON_METRE, 0.0, "moment on the rotor, z"),
        output!("r.x", &METRE, "position of the station, x", |p, m| p.position_ahead(m, 0)),
        output!("r.y", &METRE, "position of the station, y", |p, m| p.position_ahead(m, 1)),
        output!("r.z", &METRE, "position of the station, z", |p, m| p.position_ahead(m, 2)),
        output!("v.x", &METRE_PER_SECOND, "velocity of the station, x", |p, m| m.station_velocity(p.position).x),
        output!("v.y", &METRE_PER_SECOND, "velocity of the station, y", |p, m| m.station_velocity(p.position).y),
        output!("v.z", &METRE_PER_SECOND, "velocity of the station, z", |p, m| m.station_velocity(p.position).z),
        output!("theta.x", &RADIAN, "axial angle phi", |p, m| p.ahead(m.phi(), || m.omega_phi())),
        output!("theta.y", &RADIAN, "transverse Euler vector, y", |p, m| p.ahead(m.lean().x, || m.turn().y)),
        output!("theta.z", &RADIAN, "transverse Euler vector, z", |p, m| p.ahead(m.lean().y, || m.turn().z)),
        output!("omega.x", &RADIAN_PER_SECOND, "angular velocity, conjugate to the moment, x", |_, m| m.omega().x),
        output!("omega.y", &RADIAN_PER_SECOND, "angular velocity, conjugate to the moment, y", |_, m| m.omega().y),
        output!("omega.z", &RADIAN_PER_SECOND, "angular velocity, conjugate to the moment, z", |_, m| m.omega().z),
        Row {
            meta: Meta::boolean(
                "learn",
                true,
                "whether the port learns how its partner answers the motion, and goes on by that between communication points",
            ),
            access: Access::Parameter { get: |p| f64::from(p.learn), set: |p, value| p.learn = value != 0.0 },
        },
        coefficient!(kxx, k[0], &NEWTON_PER_METRE, "axial stiffness"),
        coefficient!(kyy, k[1], &NEWTON_PER_METRE, "stiffness, force along y by displacement along y,"),
        coefficient!(kyz, k[2], &NEWTON_PER_METRE, "stiffness, force along y by displacement along z,"),
        coefficient!(kzy, k[3], &NEWTON_PER_METRE, "stiffness, force along z by displacement along y,"),
        coefficient!(kzz, k[4], &NEWTON_PER_METRE, "stiffness, force along z by displacement along z,"),
        coefficient!(kt, k[5], &NEWTON_METRE_PER_RADIAN, "stiffness against tilt"),
        coefficient!(cxx, c[0], &NEWTON_SECOND_PER_METRE, "axial damping"),
        coefficient!(cyy, c[1], &NEWTON_SECOND_PER_METRE, "damping, force along y by speed along y,"),
        coefficient!(cyz, c[2], &NEWTON_SECOND_PER_METRE, "damping, force along y by speed along z,"),
        coefficient!(czy, c[3], &NEWTON_SECOND_PER_METRE, "damping, force along z by speed along y,"),
        coefficient!(czz, c[4], &NEWTON_SECOND_PER_METRE, "damping, force along z by speed along z,"),
        coefficient!(ct, c[5], &NEWTON_METRE_SECOND_PER_RADIAN, "damping of the tilt"),
        output!(
            "energy_error",
            &JOULE,
            "energy that the exchange brought in so far: work of the loads beyond that of the partner's answers, which lines or a law join",
            |p, _| Scalar::constant(p.law.error)
        ),
        parameter!(
            ahead,
            &ONE,
            Some(0.0),
            Bound::Within(-1.0, 2.0),
            "r and theta are shown ahead by this part of the last communication step, for a partner that holds them"
        ),
        lag!(),
    ];

    const TERMINAL: Option<Terminal> =
        Some(Terminal { kind: "split-rotor.Port", flows: &["f.x", "f.y", "f.z", "m.x", "m.y", "m.z"] });

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let [force, moment] = self.given(motion);
        Act {
            // eq. 66: M_c = p t×F + M
            load: Wrench::at_station(motion, self.position, force) + Wrench::couple(motion, moment),
            // eq. 66: P = F·v_s + M·ω
            supply: motion.power(1.0, &force, &motion.station_velocity(self.position))
                + motion.power_of_moment(&moment),
            ..Act::none()
        }
    }

    const FACTS: Facts = Facts { shows_velocity: true, partners: 1, ..Facts::USUAL };

    fn knows_partner(&self) -> bool {
        [self.k, self.c] != [[0.0; 6]; 2]
    }

    fn is_answered(&self, t: f64) -> bool {
        // A master that sends derivatives knows how its loads go on.
        let mut signals = self.f.iter().chain(&self.m);
        signals.clone().any(|signal| signal.set_at(t).is_some())
            && !signals.any(|signal| signal.was_sent_derivatives_at(t))
    }

    fn exchange(&self, motion: &Motion<f64>) -> Option<Exchange> {
        let [yielding, gyration] = motion.yielding(self.position);
        let [loads, ..] = self.acting(motion.t());
        Some(Exchange {
            at: self.shown(motion, true),
            loads,
            given: self.slopes(),
            turns_along: false,
            learns: self.learn,
            ahead: self.ahead,
            yielding,
            gyration,
        })
    }

    fn acting(&self, t: f64) -> Acting {
        let [force, moment] = [&self.f, &self.m];
        [0, 1, 2, 3].map(|power| {
            let of = |signal: &Signal| signal.coefficient(t, power);
            Loads::new(of(&force.x), of(&force.y), of(&force.z), of(&moment.y), of(&moment.z))
        })
    }

    fn lag(&self) -> Option<f64> {
        (self.lag >= 0.0).then_some(self.lag)
    }

    fn law_mut(&mut self) -> Option<&mut Law> {
        Some(&mut self.law)
    }

    fn is_analytic(&self) -> bool {
        // The law would be, but its part in each coefficient slows down series without it.
        !self.law.is_on
    }

    fn follows_speed(&self) -> bool {
        self.law.is_on
    }
}
