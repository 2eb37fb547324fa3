//! `bearing`: linear springs and dampers at a station, with cross coupling.

use super::{Act, Effect, Motion, Row, Wrench};
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::variable::units::{
    METRE, NEWTON, NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN, NEWTON_PER_METRE, NEWTON_SECOND_PER_METRE,
};
use crate::variable::{Bound, output, parameter};
use nalgebra::Vector3;

/// A bearing on the stator line, the x axis.
#[derive(Clone, Debug, Default)]
pub struct Bearing {
    /// Where it is, along t from c \[m].
    pub position: f64,
    /// Stiffness K [N/m]; a seal or a magnet may have a negative one.
    pub kyy: f64,
    /// Force along −y by a displacement along z [N/m].
    pub kyz: f64,
    /// Force along −z by a displacement along y [N/m].
    pub kzy: f64,
    /// As `kyy` [N/m].
    pub kzz: f64,
    /// Damping C [N·s/m].
    pub cyy: f64,
    /// As `kyz` [N·s/m].
    pub cyz: f64,
    /// As `kzy` [N·s/m].
    pub czy: f64,
    /// As `cyy` [N·s/m].
    pub czz: f64,
    /// Axial stiffness [N/m].
    pub kxx: f64,
    /// Axial damping [N·s/m].
    pub cxx: f64,
    /// Stiffness against tilt [N·m/rad].
    pub kt: f64,
    /// Damping of the tilt [N·m·s/rad].
    pub ct: f64,
    /// x of its station at the start, from where the axial spring is measured \[m].
    x_at_start: f64,
}

/// A symmetric damping that is within this of its bound \[1] is rounded.
const ROUNDING: f64 = 1e-12;

/// Rows of a matrix that acts on (y, z).
type Matrix = [[f64; 2]; 2];

impl Bearing {
    fn stiffness(&self) -> Matrix {
        [[self.kyy, self.kyz], [self.kzy, self.kzz]]
    }

    fn damping(&self) -> Matrix {
        [[self.cyy, self.cyz], [self.czy, self.czz]]
    }

    /// What couples y and z in a circle, half of kyz − kzy [N/m].
    fn circulation(&self) -> f64 {
        0.5 * (self.kyz - self.kzy)
    }

    /// (x, q) of its station, x from its place at the start \[m].
    #[inline(always)]
    fn displacement<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        motion.station(self.position) - Vector3::x() * S::constant(self.x_at_start)
    }

    #[inline(always)]
    fn velocity<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        motion.station_velocity(self.position)
    }

    /// Force of the springs on the rotor \[N].
    #[inline(always)]
    fn spring<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        // eq. 61: F = −(kxx x, K q)
        -times(self.kxx, self.stiffness(), self.displacement(motion))
    }

    /// Force of the dampers on the rotor \[N].
    #[inline(always)]
    fn damper<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        // eq. 61: F = −(cxx dx/dt, C dq/dt)
        -times(self.cxx, self.damping(), self.velocity(motion))
    }

    /// Force on the rotor at the station \[N].
    fn force<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        self.spring(motion) + self.damper(motion)
    }
}

/// (axial x, A q).
#[inline(always)]
fn times<S: Scalar>(axial: f64, across: Matrix, v: Vector3<S>) -> Vector3<S> {
    let [y, z] = across.map(|[a, b]| v.y * S::constant(a) + v.z * S::constant(b));
    Vector3::new(v.x * S::constant(axial), y, z)
}

impl Effect for Bearing {
    const ROWS: &'static [Row<Self>] = &[
        parameter!(position, &METRE, None, Bound::Finite, "place along t from c"),
        parameter!(
            kyy,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along y by displacement along y"
        ),
        parameter!(
            kyz,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along y by displacement along z"
        ),
        parameter!(
            kzy,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along z by displacement along y"
        ),
        parameter!(
            kzz,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along z by displacement along z"
        ),
        parameter!(
            cyy,
            &NEWTON_SECOND_PER_METRE,
            Some(0.0),
            Bound::NotNegative,
            "damping, force along y by speed along y"
        ),
        parameter!(cyz, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::Finite, "damping, force along y by speed along z"),
        parameter!(czy, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::Finite, "damping, force along z by speed along y"),
        parameter!(
            czz,
            &NEWTON_SECOND_PER_METRE,
            Some(0.0),
            Bound::NotNegative,
            "damping, force along z by speed along z"
        ),
        parameter!(kxx, &NEWTON_PER_METRE, Some(0.0), Bound::Finite, "axial stiffness"),
        parameter!(cxx, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::NotNegative, "axial damping"),
        parameter!(kt, &NEWTON_METRE_PER_RADIAN, Some(0.0), Bound::Finite, "stiffness against tilt"),
        parameter!(ct, &NEWTON_METRE_SECOND_PER_RADIAN, Some(0.0), Bound::NotNegative, "damping of the tilt"),
        output!("F.x", &NEWTON, "force of the bearing on the rotor at its station, along x", |b, m| b.force(m).x),
        output!("F.y", &NEWTON, "force of the bearing on the rotor at its station, along y", |b, m| b.force(m).y),
        output!("F.z", &NEWTON, "force of the bearing on the rotor at its station, along z", |b, m| b.force(m).z),
    ];

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let (r, v) = (self.displacement(motion), self.velocity(motion));
        let (lean, t_rate) = (motion.lean(), motion.axis_rate());
        // eq. 61: M = −kt γ, M = −ct t×(dt/dt)
        let against_lean = Vector3::new(S::zero(), lean.x, lean.y) * S::constant(-self.kt);
        let against_rate = motion.axis().cross(&t_rate) * S::constant(-self.ct);
        let at_station = |force| Wrench::at_station(motion, self.position, force);
        let springs = r.dot(&times(self.kxx, self.stiffness(), r));
        Act {
            load: at_station(self.spring(motion)) + Wrench::couple(against_lean),
            damping: at_station(self.damper(motion)) + Wrench::couple(against_rate),
            // eq. 62: V = ½ (kxx x² + qᵀK q + kt |γ|²); of K only the symmetric part counts
            stored: (springs + lean.dot(&lean) * S::constant(self.kt)) * S::constant(0.5),
            // eq. 63: −dqᵀ/dt K_skew q = ½ (kyz − kzy) e·(q×dq/dt)
            supply: r.yz().perp(&v.yz()) * S::constant(self.circulation()),
            // eq. 62: P = cxx (dx/dt)² + dqᵀ/dt C dq/dt + ct |dt/dt|²; of C only the symmetric part counts
            loss: v.dot(&times(self.cxx, self.damping(), v)) + t_rate.dot(&t_rate) * S::constant(self.ct),
            ..Act::none()
        }
    }

    fn follows_speed(&self) -> bool {
        let Self { cyy, cyz, czy, czz, cxx, ct, .. } = *self;
        [cyy, cyz, czy, czz, cxx, ct].iter().any(|c| *c != 0.0)
    }

    fn needs_gamma(&self) -> bool {
        self.kt != 0.0
    }

    fn works(&self) -> bool {
        // What damps across gives no work, but is asked for only where something works.
        self.circulation() != 0.0 || self.follows_speed()
    }

    fn check(&self) -> Result<(), Invalid> {
        let mean = 0.5 * (self.cyz + self.czy);
        let most = (self.cyy * self.czz).sqrt();
        if mean.abs() <= most * (1.0 + ROUNDING) {
            return Ok(());
        }
        let bound = format!(
            "such that (cyz + czy)/2 is at most sqrt(cyy czz) = {most:?} in size, or the bearing would drive what it damps"
        );
        let (name, value) = if self.cyz == 0.0 { ("czy", self.czy) } else { ("cyz", self.cyz) };
        Err(Invalid::new(name, value, bound))
    }

    fn begin(&mut self, start: &Motion<f64>) {
        self.x_at_start = start.station(self.position).x;
    }

    fn memory(&mut self) -> &mut [f64] {
        std::slice::from_mut(&mut self.x_at_start)
    }
}
