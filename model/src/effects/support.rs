//! `support`: the paper's spring block at the rod's end a, with damping of our own.

use super::{Effect, Wrench};
use crate::scalar::Scalar;
use crate::state::Kinematics;
use crate::variable::units::{
    NEWTON, NEWTON_METRE, NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN, NEWTON_PER_METRE,
    NEWTON_SECOND_PER_METRE,
};
use crate::variable::{Bound, Depends, Row, output, parameter};
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

/// What a component of F depends on at the start, that of r_c and v_c named by it.
macro_rules! force_depends {
    ($r_c:literal, $v_c:literal) => {
        Depends::On(&[
            "rotor.Ja",
            "rotor.Jt",
            "rotor.l",
            $r_c,
            $v_c,
            "start.gamma",
            "start.omega",
            "support.c1",
            "support.d1",
        ])
    };
}

const FORCE_X: Depends = force_depends!("start.r_c.x", "start.v_c.x");
const FORCE_Y: Depends = force_depends!("start.r_c.y", "start.v_c.y");
const FORCE_Z: Depends = force_depends!("start.r_c.z", "start.v_c.z");
const MOMENT_X: Depends = Depends::On(&["rotor.Ja", "rotor.Jt", "start.gamma", "start.omega", "support.d2"]);
const MOMENT: Depends =
    Depends::On(&["rotor.Ja", "rotor.Jt", "start.gamma", "start.omega", "support.c2", "support.d2"]);

impl Support {
    /// Force at a [N].
    #[inline(always)]
    fn force<S: Scalar>(&self, motion: &Kinematics<S>) -> Vector3<S> {
        let l = motion.body.l;
        // eq. 14: F = −c1 r_a − d1 v_a
        let spring = motion.station(-l) * S::constant(-self.c1);
        if self.d1 == 0.0 { spring } else { spring - motion.station_velocity(-l) * S::constant(self.d1) }
    }

    /// Moment of the springs and dampers against tilt [N·m].
    #[inline(always)]
    fn moment<S: Scalar>(&self, motion: &Kinematics<S>) -> Vector3<S> {
        // eq. 14: M = −c2 γ − d2 t×(dt/dt)
        let spring = motion.tilt.gamma() * S::constant(-self.c2);
        if self.d2 == 0.0 { spring } else { spring - motion.axis().cross(&motion.axis_rate()) * S::constant(self.d2) }
    }
}

impl Effect for Support {
    const ROWS: &'static [Row<Self, Kinematics<f64>>] = &[
        parameter!(c1, &NEWTON_PER_METRE, Some(0.0), Bound::NotNegative, "stiffness against displacement of a"),
        parameter!(c2, &NEWTON_METRE_PER_RADIAN, Some(0.0), Bound::NotNegative, "stiffness against tilt"),
        parameter!(d1, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::NotNegative, "damping of the displacement of a"),
        parameter!(d2, &NEWTON_METRE_SECOND_PER_RADIAN, Some(0.0), Bound::NotNegative, "damping of the tilt"),
        output!("F.x", &NEWTON, FORCE_X, "force of the support on the rotor at a, along x", |s, m| s.force(m).x),
        output!("F.y", &NEWTON, FORCE_Y, "force of the support on the rotor at a, along y", |s, m| s.force(m).y),
        output!("F.z", &NEWTON, FORCE_Z, "force of the support on the rotor at a, along z", |s, m| s.force(m).z),
        output!("M.x", &NEWTON_METRE, MOMENT_X, "moment against tilt on the rotor about x", |s, m| s.moment(m).x),
        output!("M.y", &NEWTON_METRE, MOMENT, "moment against tilt on the rotor about y", |s, m| s.moment(m).y),
        output!("M.z", &NEWTON_METRE, MOMENT, "moment against tilt on the rotor about z", |s, m| s.moment(m).z),
    ];

    const POTENTIAL_DEPENDS: &'static [&'static str] =
        &["rotor.l", "start.r_c", "start.gamma", "support.c1", "support.c2"];

    #[inline(always)]
    fn load<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        let force = self.force(motion);
        let arm = motion.axis() * S::constant(-motion.body.l);
        // eq. 14: M_c = −l t×F + M
        Wrench { force, moment: arm.cross(&force) + self.moment(motion) }
    }

    #[inline(always)]
    fn potential<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        let (r_a, gamma) = (motion.station(-motion.body.l), motion.tilt.gamma());
        // eq. 15: V = ½ c1 |r_a|² + ½ c2 |γ|²
        r_a.dot(&r_a) * S::constant(0.5 * self.c1) + gamma.dot(&gamma) * S::constant(0.5 * self.c2)
    }

    #[inline(always)]
    fn loss<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        let (v_a, t_rate) = (motion.station_velocity(-motion.body.l), motion.axis_rate());
        // eq. 16: P = d1 |v_a|² + d2 |dt/dt|²
        v_a.dot(&v_a) * S::constant(self.d1) + t_rate.dot(&t_rate) * S::constant(self.d2)
    }

    fn needs_gamma(&self) -> bool {
        self.c2 != 0.0
    }

    fn works(&self) -> bool {
        self.d1 > 0.0 || self.d2 > 0.0
    }
}
