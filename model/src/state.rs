//! The state of the motion and its kinematics.

mod layout;

pub use layout::{BODY, Layout};

use crate::body::{AngularVelocity, Inertia, ROTOR};
use crate::dual::Dual;
use crate::rotation::{Angle, Chart, Tilt};
use crate::scalar::Scalar;
use nalgebra::{Vector2, Vector3};

/// The coordinates of the motion, or their rates (units per second). Vectors in the inertial frame O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S: Scalar> {
    /// Position of the mass centre G of the whole \[m]: of c, where nothing is unbalanced.
    pub r: Vector3<S>,
    /// Velocity of G [m/s].
    pub v: Vector3<S>,
    /// Angular momentum about G [kg·m²/s].
    pub k: Vector3<S>,
    /// γ_y and γ_z \[rad] in the chart in force.
    pub gamma: Vector2<S>,
    /// φ \[rad] in the chart in force, less the whole turns that are counted apart.
    pub phi: S,
}

/// A state of the rotor alone, and its work: the order of the variables `state`.
const ALONE: Layout = Layout::new(0, true);

/// How many coordinates a motion has.
pub const COORDINATES: usize = ALONE.angles().end;

/// The coordinates and the work.
pub const WITH_WORK: usize = ALONE.count();

/// The number of the work supplied \[J] among them.
pub const SUPPLIED: usize = ALONE.work().start;

/// The number of the work lost \[J] among them.
pub const DISSIPATED: usize = SUPPLIED + 1;

/// The coordinates and the work, or their rates.
pub type Whole<S> = [S; WITH_WORK];

/// The numbers of γ among them.
pub const GAMMA: std::ops::Range<usize> = ALONE.gamma(ROTOR);

/// The number of φ among them.
pub const PHI: usize = ALONE.phi(ROTOR);

impl<S: Scalar> Coordinates<S> {
    /// Into the first [`COORDINATES`] numbers of `y`, in the order of the fields.
    #[inline(always)]
    pub fn write(&self, y: &mut [S]) {
        ALONE.write(y, ROTOR, self);
    }
}

/// How fast everything changes, for outputs that ask for it.
#[derive(Clone, Copy)]
pub struct Rates<'m, S: Scalar> {
    /// Of the coordinates.
    pub coordinates: Coordinates<S>,
    /// Of the work supplied and lost \[W].
    pub work: [S; 2],
    /// Of the effect's own states.
    pub own: &'m [S],
}

impl<S: Scalar> Rates<'_, S> {
    /// Those of the coordinates and of the work, by their number.
    pub fn rigid(&self, n: usize) -> S {
        let mut whole = [S::zero(); WITH_WORK];
        self.coordinates.write(&mut whole);
        [whole[SUPPLIED], whole[DISSIPATED]] = self.work;
        whole[n]
    }
}

/// Everything kinematic that follows from the coordinates of a body.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<S: Scalar> {
    /// The body that moves.
    pub body: Inertia,
    /// Time \[s].
    pub t: S,
    /// Whole turns of φ, counted apart.
    pub turns: f64,
    /// Its coordinates.
    pub at: Coordinates<S>,
    /// Its tilt: γ and the axis t.
    pub tilt: Tilt<S>,
    /// The part of ω that moves the axis [rad/s]: ω = swing + spin t.
    pub swing: Vector3<S>,
    /// The rest of ω, about t [rad/s].
    pub spin: S,
    /// Angular velocity ω [rad/s].
    pub omega: Vector3<S>,
    /// From c to the mass centre G of the whole \[m]; None of a body of which both are one.
    pub to_centre: Option<Vector3<S>>,
    /// λ [N·m·s], where ω_φ is imposed: the angular momentum about G is K + λ n.
    pub impulse: Option<S>,
}

impl<S: Scalar> Kinematics<S> {
    /// The kinematics of `body` at these coordinates of a chart, at time 0 and with no turns counted apart.
    #[inline(always)]
    pub fn new(body: Inertia, chart: Chart, at: Coordinates<S>) -> Self {
        Self::tilted(body, Tilt::new(chart, at.gamma), at)
    }

    /// [`Kinematics::new`] where the tilt of γ is known.
    #[inline(always)]
    pub fn tilted(body: Inertia, tilt: Tilt<S>, at: Coordinates<S>) -> Self {
        let (velocity, to_centre) = match &body.asymmetric {
            None => (body.angular_velocity(&at.k, &tilt.axis), None),
            Some(asymmetric) => {
                let attitude = tilt.attitude(at.phi);
                let to_centre = attitude * asymmetric.centre.map(S::constant);
                (body.asymmetric_angular_velocity(asymmetric, &at.k, &attitude), Some(to_centre))
            }
        };
        let (omega, AngularVelocity { swing, spin }) = (velocity.omega(&tilt.axis), velocity);
        Self { body, t: S::zero(), turns: 0.0, at, tilt, swing, spin, omega, to_centre, impulse: None }
    }

    /// The same at time `t` \[s], with whole turns counted apart.
    #[inline(always)]
    pub fn when(self, t: S, turns: f64) -> Self {
        Self { t, turns, ..self }
    }

    /// The same where ω_φ is imposed [rad/s]: the angular momentum gives way along n.
    #[inline(always)]
    pub fn imposed(self, speed: S) -> Self {
        let n = self.tilt.joint_axis();
        let answer = self.angular_velocity(&n);
        // eq. 75: λ = (w − n·I⁻¹K)/(n·I⁻¹n), ω = I⁻¹(K + λ n)
        let impulse = (speed - n.dot(&self.omega)) / n.dot(&answer);
        let gain = answer * impulse;
        Self { swing: self.swing + gain, omega: self.omega + gain, impulse: Some(impulse), ..self }
    }

    /// I⁻¹K [rad/s] of any angular momentum K [kg·m²/s] about G.
    #[inline(always)]
    fn angular_velocity(&self, momentum: &Vector3<S>) -> Vector3<S> {
        let velocity = match &self.body.asymmetric {
            None => self.body.angular_velocity(momentum, self.axis()),
            Some(asymmetric) => {
                self.body.asymmetric_angular_velocity(asymmetric, momentum, &self.tilt.attitude(self.at.phi))
            }
        };
        velocity.omega(self.axis())
    }

    /// The inertia against a torque along n, 1/(n·I⁻¹n) [kg·m²].
    pub fn inertia_along_joint(&self) -> S {
        let n = self.tilt.joint_axis();
        S::one() / n.dot(&self.angular_velocity(&n))
    }

    /// Angular momentum about G [kg·m²/s].
    #[inline(always)]
    pub fn momentum(&self) -> Vector3<S> {
        // eq. 75: K + λ n
        self.impulse.map_or(self.at.k, |impulse| self.at.k + self.tilt.joint_axis() * impulse)
    }

    /// By how much the rate of K falls short of the moment about G, where ω_φ is imposed [N·m].
    #[inline(always)]
    pub fn carried(&self) -> Option<Vector3<S>> {
        // eq. 76: λ dn/dt
        self.impulse.map(|impulse| self.joint_rate() * impulse)
    }

    /// dn/dt [1/s].
    #[inline(always)]
    fn joint_rate(&self) -> Vector3<S> {
        let (t, t_rate) = (self.axis(), self.axis_rate());
        let (sum, per_sum) = (Vector3::x() + t, S::one() / (S::one() + t.x));
        // eq. 76: dn/dt = (dt/dt)/(1 + e·t) − (e + t)(e·dt/dt)/(1 + e·t)²
        t_rate * per_sum - sum * (t_rate.x * per_sum * per_sum)
    }

    /// The torque τ along n [N·m] that gives ω_φ this rate [rad/s²] beside this moment about G [N·m]. Called, it would have all
    /// of the motion stored for it.
    #[inline(always)]
    pub fn torque(&self, acceleration: S, moment: &Vector3<S>) -> S {
        let n = self.tilt.joint_axis();
        let others = self.angular_velocity(&(moment - self.omega.cross(&self.momentum())));
        // eq. 76: τ = (a − dn/dt·ω − n·I⁻¹(M − ω×K))/(n·I⁻¹n)
        (acceleration - self.joint_rate().dot(&self.omega) - n.dot(&others)) / n.dot(&self.angular_velocity(&n))
    }

    /// φ from e, wrapped.
    pub fn angle(&self) -> Angle {
        let gamma = self.at.gamma.map(S::re);
        self.tilt.chart().axial_angle(self.turns, self.at.phi.re(), gamma)
    }

    /// φ from e \[rad].
    pub fn phi(&self) -> S {
        self.tilt.chart().phi_from_e(self.at.phi, self.at.gamma).with_value(self.angle().radians())
    }

    /// The axis t \[1].
    #[inline(always)]
    pub fn axis(&self) -> &Vector3<S> {
        &self.tilt.axis
    }

    /// dt/dt = ω×t = swing×t, the rate of the axis [1/s].
    #[inline(always)]
    pub fn axis_rate(&self) -> Vector3<S> {
        self.swing.cross(self.axis())
    }

    /// The rate of γ in the chart in force [rad/s].
    #[inline(always)]
    pub fn gamma_rate(&self) -> Vector2<S> {
        // eq. 8; it does not feel what turns about t
        self.tilt.gamma_rate(&self.swing)
    }

    /// The rate of φ in the chart in force [rad/s].
    #[inline(always)]
    pub fn phi_rate(&self) -> S {
        // eq. 6, eq. 29; n·t = 1
        self.tilt.phi_rate(&self.swing) + self.spin
    }

    /// ω_φ = dφ/dt [rad/s], φ from e.
    pub fn axial_rate(&self) -> S {
        self.tilt.axial_rate(&self.omega)
    }

    /// dω_φ/dt [rad/s²], φ from e, where the coordinates change at these rates.
    pub fn axial_acceleration(&self, rates: &Coordinates<S>) -> S {
        // dω_φ/dt = ∂ω_φ/∂y · dy/dt
        let along = |at: S, rate: S| Dual::along(at, rate);
        let moving = Coordinates {
            r: self.at.r.zip_map(&rates.r, along),
            v: self.at.v.zip_map(&rates.v, along),
            k: self.at.k.zip_map(&rates.k, along),
            gamma: self.at.gamma.zip_map(&rates.gamma, along),
            phi: along(self.at.phi, rates.phi),
        };
        let [rate] = Kinematics::new(self.body, self.tilt.chart(), moving).axial_rate().eps;
        rate
    }

    /// Position of c, the point on the axis that is the mass centre of the balanced rotor \[m].
    #[inline(always)]
    pub fn r_c(&self) -> Vector3<S> {
        // eq. 71: r_G = r_c + L b
        self.to_centre.map_or(self.at.r, |to_centre| self.at.r - to_centre)
    }

    /// Velocity of c [m/s].
    #[inline(always)]
    pub fn v_c(&self) -> Vector3<S> {
        // eq. 71: v_G = v_c + ω×L b
        self.to_centre.map_or(self.at.v, |to_centre| self.at.v - self.omega.cross(&to_centre))
    }

    /// From c to the station at `p` \[m] along t, in O \[m].
    #[inline(always)]
    pub fn lever(&self, p: f64) -> Vector3<S> {
        self.axis() * S::constant(p)
    }

    /// Position of the station at `p` \[m] along t from c, in O \[m].
    #[inline(always)]
    pub fn station(&self, p: f64) -> Vector3<S> {
        self.r_c() + self.lever(p)
    }

    /// Velocity of the station at `p` \[m] along t from c, in O [m/s].
    #[inline(always)]
    pub fn station_velocity(&self, p: f64) -> Vector3<S> {
        self.v_c() + self.axis_rate() * S::constant(p)
    }
}
