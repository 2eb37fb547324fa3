//! `rotating_damping`: a damper that turns with the rotor.

use super::{Act, Effect, Motion, Row, Wrench};
use crate::scalar::Scalar;
use crate::variable::units::{METRE, NEWTON_SECOND_PER_METRE};
use crate::variable::{Bound, parameter};
use nalgebra::Vector3;

/// What damps the motion of a station as seen from axes that turn with the shaft.
#[derive(Clone, Debug, Default)]
pub struct RotatingDamping {
    /// Damping d [N·s/m].
    pub d: f64,
    /// Where it is, along t from c \[m].
    pub position: f64,
}

impl RotatingDamping {
    /// dq/dt − Ω e×q, Ω = e·ω, the velocity of the station in the turning axes [m/s].
    #[inline(always)]
    fn slip<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        let (q, v, speed) =
            (motion.station(self.position), motion.station_velocity(self.position), motion.omega_along());
        Vector3::new(S::zero(), v.y + motion.times(speed, q.z), v.z - motion.times(speed, q.y))
    }
}

impl Effect for RotatingDamping {
    const LAW: &'static str =
        "at the station, q = (y, z): F = −d (dq/dt − Ω e×q), Ω = e·ω, and the couple −e·(q×F) along e";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(
            d,
            &NEWTON_SECOND_PER_METRE,
            Some(0.0),
            Bound::NotNegative,
            "damping in axes that turn with the rotor about e"
        ),
        parameter!(position, &METRE, Some(0.0), Bound::Finite, "axial position from the mass centre"),
    ];

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let (q, slip) = (motion.station(self.position), self.slip(motion));
        // eq. 64: F = −d (dq/dt − Ω e×q), and the couple −e·(q×F) along e
        let force = slip * S::constant(-self.d);
        let couple = -(motion.times(q.y, force.z) - motion.times(q.z, force.y));
        let couple = Wrench::couple(motion, Vector3::new(couple, S::zero(), S::zero()));
        Act {
            damping: Wrench::at_station(motion, self.position, force) + couple,
            // eq. 64: P = d |dq/dt − Ω e×q|²
            loss: motion.power(self.d, &slip, &slip),
            ..Act::none()
        }
    }

    fn works(&self) -> bool {
        self.d != 0.0
    }
}
