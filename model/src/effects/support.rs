//! `support`: the paper's spring block at the rod's end a, with damping of our own.

use super::{Act, Change, Effect, Facts, MOST_LOADS, Motion, Pose, Row, Wrench};
use crate::scalar::Scalar;
use crate::variable::units::{
    NEWTON, NEWTON_METRE, NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN, NEWTON_PER_METRE,
    NEWTON_SECOND_PER_METRE,
};
use crate::variable::{Bound, output, parameter};
use nalgebra::Vector3;

/// Springs and dampers between the support point a and the point O, the reference axis e.
#[derive(Clone, Debug, Default)]
pub struct Support {
    /// Stiffness against displacement of a, the paper's C1 [N/m].
    pub c1: f64,
    /// Stiffness against tilt, the paper's C2 [N·m/rad].
    pub c2: f64,
    /// Damping of the displacement of a [N·s/m].
    pub d1: f64,
    /// Damping of the tilt [N·m·s/rad].
    pub d2: f64,
}

impl Support {
    /// Force of the springs at a \[N].
    #[inline(always)]
    fn spring<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        let to_origin = motion.lever(motion.l()) - motion.r_c();
        // eq. 14: F = −c1 r_a
        to_origin * S::constant(self.c1)
    }

    /// Force of the dampers at a \[N].
    #[inline(always)]
    fn damper<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        // eq. 14: F = −d1 v_a
        motion.station_velocity(-motion.l()) * S::constant(-self.d1)
    }

    /// Force on the rotor at a \[N].
    fn force<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        self.spring(motion) + self.damper(motion)
    }

    /// Moment against tilt [N·m].
    fn moment<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        Wrench::against_lean(motion, self.c2).moment + Wrench::against_turn(motion, self.d2).moment
    }
}

impl Effect for Support {
    const LAW: &'static str = "at a = c − l t: F = −c1 r_a − d1 v_a, M = −c2 γ − d2 t×dt/dt";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(c1, &NEWTON_PER_METRE, Some(0.0), Bound::NotNegative, "stiffness against displacement of a"),
        parameter!(c2, &NEWTON_METRE_PER_RADIAN, Some(0.0), Bound::NotNegative, "stiffness against tilt"),
        parameter!(d1, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::NotNegative, "damping of the displacement of a"),
        parameter!(d2, &NEWTON_METRE_SECOND_PER_RADIAN, Some(0.0), Bound::NotNegative, "damping of the tilt"),
        output!("F.x", &NEWTON, "force of the support on the rotor at a, along x", |s, m| s.force(m).x),
        output!("F.y", &NEWTON, "force of the support on the rotor at a, along y", |s, m| s.force(m).y),
        output!("F.z", &NEWTON, "force of the support on the rotor at a, along z", |s, m| s.force(m).z),
        output!("M.x", &NEWTON_METRE, "moment against tilt on the rotor about x", |s, m| s.moment(m).x),
        output!("M.y", &NEWTON_METRE, "moment against tilt on the rotor about y", |s, m| s.moment(m).y),
        output!("M.z", &NEWTON_METRE, "moment against tilt on the rotor about z", |s, m| s.moment(m).z),
    ];

    const FACTS: Facts = Facts { loads: 2, ..Facts::USUAL };

    #[inline(always)]
    fn load_changes(&self, at: &Pose, change: &Change) -> [f64; MOST_LOADS] {
        let (mut force, mut moment) = (change.station(-at.l) * self.c1, change.axis * self.c2);
        if self.works() {
            force += change.station_velocity(-at.l) * self.d1;
            moment += change.axis_rate * self.d2;
        }
        [force.norm_squared(), moment.norm_squared()]
    }

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let (r_a, lean) = (motion.station(-motion.l()), motion.lean());
        let (v_a, t_rate) = (motion.station_velocity(-motion.l()), motion.axis_rate());
        let at_a = |force| Wrench::at_station(motion, -motion.l(), force);
        Act {
            // eq. 14: M = −c2 γ, M = −d2 t×(dt/dt)
            load: at_a(self.spring(motion)) + Wrench::against_lean(motion, self.c2),
            damping: if self.works() {
                at_a(self.damper(motion)) + Wrench::against_turn(motion, self.d2)
            } else {
                Wrench::zero()
            },
            // eq. 15: V = ½ c1 |r_a|² + ½ c2 |γ|²
            stored: r_a.dot(&r_a) * S::constant(0.5 * self.c1) + lean.dot(&lean) * S::constant(0.5 * self.c2),
            // eq. 16: P = d1 |v_a|² + d2 |dt/dt|²
            loss: motion.power(self.d1, &v_a, &v_a) + motion.power(self.d2, &t_rate, &t_rate),
            ..Act::none()
        }
    }

    fn no_limit(&self) -> Option<&'static str> {
        (self.c2 != 0.0).then_some(no_limit!("the spring support.c2, which follows gamma,"))
    }

    fn works(&self) -> bool {
        self.d1 > 0.0 || self.d2 > 0.0
    }
}
