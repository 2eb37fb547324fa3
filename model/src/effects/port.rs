//! `port`: force and moment from outside at a station, and the motion that goes with them.

use super::{Act, Effect, Motion, Row, Terminal, Wrench};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::variable::units::{METRE, METRE_PER_SECOND, NEWTON, NEWTON_METRE, RADIAN, RADIAN_PER_SECOND};
use crate::variable::{Bound, input, output, parameter};
use nalgebra::Vector3;

/// A station to which another model is coupled.
#[derive(Clone, Debug, Default)]
pub struct Port {
    /// Where it is, along t from c \[m].
    pub position: f64,
    /// Force on the rotor in O \[N].
    pub f: Vector3<Signal>,
    /// Moment on the rotor in O [N·m].
    pub m: Vector3<Signal>,
}

impl Port {
    /// Force \[N] and moment [N·m].
    #[inline(always)]
    fn given<S: Scalar>(&self, motion: &Motion<S>) -> [Vector3<S>; 2] {
        [self.f.map(|signal| motion.input(&signal)), self.m.map(|signal| motion.input(&signal))]
    }
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
        output!("r.x", &METRE, "position of the station, x", |p, m| m.station(p.position).x),
        output!("r.y", &METRE, "position of the station, y", |p, m| m.station(p.position).y),
        output!("r.z", &METRE, "position of the station, z", |p, m| m.station(p.position).z),
        output!("v.x", &METRE_PER_SECOND, "velocity of the station, x", |p, m| m.station_velocity(p.position).x),
        output!("v.y", &METRE_PER_SECOND, "velocity of the station, y", |p, m| m.station_velocity(p.position).y),
        output!("v.z", &METRE_PER_SECOND, "velocity of the station, z", |p, m| m.station_velocity(p.position).z),
        output!("theta.x", &RADIAN, "axial angle phi", |_, m| m.phi()),
        output!("theta.y", &RADIAN, "transverse Euler vector, y", |_, m| m.lean().x),
        output!("theta.z", &RADIAN, "transverse Euler vector, z", |_, m| m.lean().y),
        output!("omega.x", &RADIAN_PER_SECOND, "angular velocity, conjugate to the moment, x", |_, m| m.omega().x),
        output!("omega.y", &RADIAN_PER_SECOND, "angular velocity, conjugate to the moment, y", |_, m| m.omega().y),
        output!("omega.z", &RADIAN_PER_SECOND, "angular velocity, conjugate to the moment, z", |_, m| m.omega().z),
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

    fn follows_speed(&self) -> bool {
        false
    }
}
