//! A motion as laws see it: where the rotor is and how it moves, never the coordinates in which it is integrated.

use super::series::Series;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Kinematics, Rates};
use nalgebra::{Vector2, Vector3};

/// An instant of a motion, for the law of one effect. The stator stands still, its line is the x axis.
#[derive(Clone, Copy)]
pub struct Motion<'m, S: Scalar> {
    kinematics: &'m Kinematics<S>,
    own: &'m [S],
    series: Option<&'m Series>,
}

impl<'m, S: Scalar> Motion<'m, S> {
    /// The motion that an effect with these `own` states sees.
    #[inline(always)]
    pub fn new(kinematics: &'m Kinematics<S>, own: &'m [S]) -> Self {
        Self { kinematics, own, series: None }
    }

    /// One power of the series of a motion: of the kinematics count place and velocity of c and the axis.
    #[inline(always)]
    pub(crate) fn of_series(kinematics: &'m Kinematics<S>, own: &'m [S], series: &'m Series) -> Self {
        Self { kinematics, own, series: Some(series) }
    }

    /// The same that effect sees, of all, which has these of the own states.
    #[inline(always)]
    pub(super) fn seen_with(&self, own: &'m [S]) -> Self {
        Self { own, ..*self }
    }

    /// The own states.
    #[inline(always)]
    pub(super) fn all_own(&self) -> &'m [S] {
        self.own
    }

    /// Where the motion is a series; for all other scalars the compiler knows that it is none.
    #[inline(always)]
    pub(super) fn series(&self) -> Option<&'m Series> {
        if S::SERIES { self.series } else { None }
    }

    /// a b: laws multiply what varies by this.
    #[inline(always)]
    pub fn times(&self, a: S, b: S) -> S {
        match (self.series(), a.in_power(), b.in_power()) {
            (Some(series), Some(a), Some(b)) => S::of_power(series.product(a, b)),
            _ => a * b,
        }
    }

    /// k a·b \[W], a power of which only the ledger hears.
    #[inline(always)]
    pub fn power(&self, k: f64, a: &Vector3<S>, b: &Vector3<S>) -> S {
        let Some(series) = self.series() else { return a.dot(b) * S::constant(k) };
        if !series.works() || k == 0.0 {
            return S::zero();
        }
        let coefficients = |v: &Vector3<S>| [v.x.in_power(), v.y.in_power(), v.z.in_power()];
        let dot = match (coefficients(a), coefficients(b)) {
            ([Some(ax), Some(ay), Some(az)], [Some(bx), Some(by), Some(bz)]) => {
                S::of_power(series.dot([ax, ay, az], [bx, by, bz]))
            }
            _ => self.times(a.x, b.x) + self.times(a.y, b.y) + self.times(a.z, b.z),
        };
        dot * S::constant(k)
    }

    /// M·ω \[W], the power of a moment \[N·m].
    #[inline(always)]
    pub fn power_of_moment(&self, moment: &Vector3<S>) -> S {
        let Some(series) = self.series() else { return moment.dot(&self.omega()) };
        if !series.works() {
            return S::zero();
        }
        let (axis, turn) = (self.axis(), series.now.turn.map(S::of_power));
        let times = |a, b| self.times(a, b);
        let along = times(moment.x, axis.x) + times(moment.y, axis.y) + times(moment.z, axis.z);
        // M·ω = M·(t×dt/dt) + (M·t) ω_a
        times(moment.x, turn.x) + times(moment.y, turn.y) + times(moment.z, turn.z) + times(along, self.spin())
    }

    /// k a b \[W], a power of which only the ledger hears.
    #[inline(always)]
    pub fn power_along(&self, k: f64, a: S, b: S) -> S {
        if self.series().is_some_and(|series| !series.works() || k == 0.0) {
            return S::zero();
        }
        self.times(a, b) * S::constant(k)
    }

    /// |a|, of what does not pass zero where the motion is a series.
    #[inline(always)]
    pub fn size(&self, a: S) -> S {
        match (self.series(), a.in_power()) {
            (Some(series), Some(a)) => S::of_power(series.size(a)),
            _ => a.abs(),
        }
    }

    /// An input now.
    #[inline(always)]
    pub fn input(&self, signal: &Signal) -> S {
        let Some(series) = self.series() else { return signal.at(self.t()) };
        let now = series.now;
        if signal.is_held() { S::constant(signal.at(now.t)) } else { S::of_power(signal.coefficient(now.t, now.power)) }
    }

    /// For what imposes a speed, and so must know all of the motion.
    #[cfg(imposed_speed)]
    #[inline(always)]
    pub(super) fn whole(&self) -> &'m Kinematics<S> {
        self.kinematics
    }

    /// A state of the effect's own, by its number.
    #[inline(always)]
    pub fn own(&self, n: usize) -> S {
        self.own[n]
    }

    /// Time \[s].
    #[inline(always)]
    pub fn t(&self) -> S {
        self.kinematics.t
    }

    /// Mass of the whole \[kg].
    #[inline(always)]
    pub fn mass(&self) -> f64 {
        self.kinematics.body.m
    }

    /// By how much a force at the station at `p` \[m] accelerates it at most [1/kg], and the radius of gyration √(Jt/m) \[m].
    pub fn yielding(&self, p: f64) -> [f64; 2] {
        let body = &self.kinematics.body;
        // eq. 60: 1/m + p²/Jt
        [body.per_m + p * p * body.per_jt, body.radius()]
    }

    /// Distance from the support point a to c, along t \[m].
    #[inline(always)]
    pub fn l(&self) -> f64 {
        self.kinematics.body.l
    }

    /// The axis t \[1].
    #[inline(always)]
    pub fn axis(&self) -> &'m Vector3<S> {
        self.kinematics.axis()
    }

    /// 1 − e·t \[1], to its last digits where the axis leans little.
    #[inline(always)]
    pub fn foreshortening(&self) -> S {
        let Some(series) = self.series() else { return self.kinematics.tilt.foreshortening() };
        let axis = self.axis();
        if series.now.power > 0 {
            return -axis.x;
        }
        let [x, y, z] = [axis.x, axis.y, axis.z].map(|t| t.in_power().unwrap_or(f64::NAN));
        // 1 − e·t = |e×t|²/(1 + e·t)
        S::of_power(if x > 0.0 { (y * y + z * z) / (1.0 + x) } else { 1.0 - x })
    }

    /// dt/dt [1/s].
    #[inline(always)]
    pub fn axis_rate(&self) -> Vector3<S> {
        self.series().map_or_else(|| self.kinematics.axis_rate(), |series| series.now.axis_rate.map(S::of_power))
    }

    /// How fast the axis turns, t×dt/dt [rad/s].
    #[inline(always)]
    pub fn turn(&self) -> Vector3<S> {
        self.axis().cross(&self.axis_rate())
    }

    /// How far the axis leans: the Euler vector that turns e to t the shortest way, f e×t with f = θ/sinθ, y and z \[rad].
    #[inline(always)]
    pub fn lean(&self) -> Vector2<S> {
        self.kinematics.tilt.gamma()
    }

    /// n = (e + t)/(1 + e·t), along which a constant-velocity joint passes a torque on \[1].
    #[inline(always)]
    pub fn joint_axis(&self) -> Vector3<S> {
        self.kinematics.tilt.joint_axis()
    }

    /// ω [rad/s].
    #[inline(always)]
    pub fn omega(&self) -> Vector3<S> {
        let Some(series) = self.series() else { return self.kinematics.omega };
        // ω = t×dt/dt + ω_a t
        series.now.turn.map(S::of_power) + self.axis().map(|t| self.times(self.spin(), t))
    }

    /// e·ω, how fast the rotor turns about the stator line [rad/s].
    #[inline(always)]
    pub fn omega_along(&self) -> S {
        let Some(series) = self.series() else { return self.kinematics.omega.x };
        S::of_power(series.now.turn.x) + self.times(self.spin(), self.axis().x)
    }

    /// ω_a = ω·t, the spin about the axis [rad/s].
    #[inline(always)]
    pub fn spin(&self) -> S {
        let spin = |series: &Series| S::of_power(series.now.spin);
        self.series().map_or_else(|| self.kinematics.omega.dot(self.kinematics.axis()), spin)
    }

    /// ω_φ, the rate of φ [rad/s].
    #[inline(always)]
    pub fn omega_phi(&self) -> S {
        // ω_φ = ω_a + e·(t×dt/dt)/(1 + e·t)
        let rate = |series: &Series| S::of_power(series.now.spin + series.quotient(series.now.turn.x));
        self.series().map_or_else(|| self.kinematics.axial_rate(), rate)
    }

    /// φ \[rad]; a law that asks for it declares that it [follows φ](super::Facts::follows_phi).
    pub fn phi(&self) -> S {
        self.kinematics.phi()
    }

    /// dω_φ/dt [rad/s²] where the coordinates change at these rates.
    pub fn axial_acceleration(&self, rates: &Rates<S>) -> S {
        self.kinematics.axial_acceleration(&rates.coordinates)
    }

    /// From c to the mass centre of the whole \[m]; None where both are one.
    #[inline(always)]
    pub fn to_centre(&self) -> Option<Vector3<S>> {
        self.kinematics.to_centre
    }

    /// Position of the mass centre of the whole \[m].
    #[inline(always)]
    pub fn centre(&self) -> &'m Vector3<S> {
        &self.kinematics.at.r
    }

    /// Position of c \[m].
    #[inline(always)]
    pub fn r_c(&self) -> Vector3<S> {
        if S::SERIES { self.kinematics.at.r } else { self.kinematics.r_c() }
    }

    /// From c to the station at `p` \[m] along t \[m].
    #[inline(always)]
    pub fn lever(&self, p: f64) -> Vector3<S> {
        self.kinematics.lever(p)
    }

    /// Position of the station at `p` \[m] along t from c, relative to the stator \[m].
    #[inline(always)]
    pub fn station(&self, p: f64) -> Vector3<S> {
        if S::SERIES { self.r_c() + self.lever(p) } else { self.kinematics.station(p) }
    }

    /// Velocity of the station at `p` \[m] along t from c, relative to the stator [m/s].
    #[inline(always)]
    pub fn station_velocity(&self, p: f64) -> Vector3<S> {
        if S::SERIES {
            return self.kinematics.at.v + self.axis_rate() * S::constant(p);
        }
        self.kinematics.station_velocity(p)
    }
}
