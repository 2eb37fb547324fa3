//! The rotor's motion as the sum of two: the drift of a free rotor, followed exactly, and the kicks of its effects, which
//! change its speeds where it is.

mod tumbling;

pub use tumbling::{Beside, Tumbling};

use crate::effects::{Action, Effects};
use crate::integrate::composition::{Composition, Split, Splitting};
use crate::integrate::sizes::Squares;
use crate::integrate::tableau::{DOP853, DOPRI5, Tableau};
use crate::integrate::{Refusal, System};
use crate::rotation::arc::{Reduced, atan2};
use crate::rotation::{Angle, Chart, Tilt, Turn, Turned};
use crate::rotor::{BEYOND_LIMIT, FORBIDDEN, LIMIT, Rotor, groups};
use crate::state::{Coordinates, DISSIPATED, Kinematics, PHI, SUPPLIED, WITH_WORK};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// A motion of N equations on its way through a step.
pub struct Flow<'r, E, const N: usize> {
    rotor: &'r Rotor<E>,
    at: Coordinates<f64>,
    tilt: Tilt<f64>,
    /// Whole turns of φ from e since the step began, besides φ in the chart.
    turns: f64,
    /// Work supplied and lost \[J].
    work: [f64; 2],
    /// Follows the speeds through a kick, where effects depend on them.
    inner: Option<&'static Tableau>,
    /// Whether kicks are spread over the drift.
    spreads: bool,
    /// Whether a law has no limit at −e, so that the axis must not fly past it.
    guarded: bool,
    evaluations: f64,
    /// What stood in the way.
    refusal: Option<Refusal>,
}

/// v_c, K_c and the work supplied and lost, or their rates.
type Speeds = [f64; 8];

/// A step in which the axis goes further about K than this \[rad] spreads its kicks: the nutation is not resolved. Measured
/// from 0.03 to 32 times around, worst of 20 step sizes: below this angle both ways are as good, beyond it kicks that
/// are not spread are up to 10⁴ times worse.
const RESOLVED: f64 = PI;

impl<E: Effects, const N: usize> Splitting<N> for Rotor<E> {
    type Flow<'r>
        = Flow<'r, E, N>
    where
        Self: 'r;

    #[inline(always)]
    fn flow<'r>(&'r self, y: &[f64; N], composition: &Composition, h: f64) -> Flow<'r, E, N> {
        let at = Coordinates::from_slice(y);
        Flow {
            rotor: self,
            at,
            tilt: Tilt::new(self.chart, at.gamma),
            turns: 0.0,
            work: if N == WITH_WORK { [y[SUPPLIED], y[DISSIPATED]] } else { [0.0; 2] },
            // Where no effect works, none depends on the speeds.
            inner: self.effects.works().then_some(if composition.order <= 4 { &DOPRI5 } else { &DOP853 }),
            spreads: self.inertia().asymmetric.is_none() && at.k.norm() * h * self.body.per_jt > RESOLVED,
            guarded: self.effects.needs_gamma(),
            evaluations: 0.0,
            refusal: None,
        }
    }

    fn roundings_of_parts(&self, y: &[f64; N], h: f64) -> Squares {
        let mut squares = self.roundings(y, h);
        // A drift turns the rotor anew, and directions and angles are known to so many radians.
        squares[groups::GAMMA] = 1.0;
        squares[groups::PHI] += 1.0;
        squares
    }

    fn apart(&self, a: &[f64; N], b: &[f64; N]) -> [f64; N] {
        let mut apart = std::array::from_fn(|n| a[n] - b[n]);
        // From −e, φ jumps by whole turns where γ is on the other side of where its azimuth begins.
        apart[PHI] -= TAU * (apart[PHI] / TAU).round();
        apart
    }
}

impl<E: Effects, const N: usize> Flow<'_, E, N> {
    /// Turns the axis by the Euler vector ρ \[rad].
    #[inline(always)]
    fn turn(&mut self, rho: Vector3<f64>) {
        self.take(self.tilt.turned(&Turn::about(rho)));
    }

    /// Goes on from a tilt that has turned.
    #[inline(always)]
    fn take(&mut self, turned: Turned) {
        self.at.gamma = turned.gamma;
        self.at.phi += turned.phi;
        self.turns += turned.turns;
        self.tilt = Tilt::new(self.rotor.chart, turned.gamma);
    }

    /// Whether the axis may come near −e within a drift of `h` \[s], where a law has no limit.
    fn may_pass_the_limit(&self, h: f64) -> bool {
        let (body, k, theta) = (self.rotor.inertia(), self.at.k, self.tilt.gamma_in_chart().norm());
        let to_antipode = if self.rotor.chart == Chart::FromE { PI - theta } else { theta };
        let way = match &body.asymmetric {
            // About K it goes round on a cone.
            None => {
                let (across, along) = (k.cross(&self.tilt.axis).norm(), k.dot(&self.tilt.axis).abs());
                (across * body.per_jt * h.abs()).min(2.0 * atan2(across, along))
            }
            Some(asymmetric) => k.norm() * body.quickest(asymmetric) * h.abs(),
        };
        // What overflows is told by what comes of it.
        way.is_finite() && way > to_antipode - FORBIDDEN
    }

    /// The motion at time `t` \[s], with these speeds where it is.
    #[inline(always)]
    fn motion(&self, t: f64, v: Vector3<f64>, k: Vector3<f64>) -> Kinematics<f64> {
        let at = Coordinates { v, k, ..self.at };
        Kinematics::tilted(self.rotor.inertia(), self.tilt, at).when(t, self.rotor.turns)
    }

    /// Follows the speeds for a time `h` \[s], the place and the time `t` \[s] standing still.
    #[inline(always)]
    fn push(&mut self, t: f64, h: f64) {
        let effects = &self.rotor.effects;
        if self.refusal.is_some() {
            return;
        }
        if self.guarded
            && let Err(refusal) = self.rotor.reaches(self.at.gamma, LIMIT)
        {
            self.refusal = Some(refusal);
            return;
        }
        // eq. 40: m dv/dt = ΣF, dK/dt = ΣM, place and time frozen
        let Some(tableau) = self.inner else {
            let motion = self.motion(t, self.at.v, self.at.k);
            let load = effects.load(&motion);
            self.at.v += load.force * (h * self.rotor.body.per_m);
            self.at.k += load.about_centre(&motion) * h;
            self.evaluations += 1.0;
            return;
        };
        let (v, k) = (self.at.v, self.at.k);
        let speeds: Speeds = [v.x, v.y, v.z, k.x, k.y, k.z, self.work[0], self.work[1]];
        let rates = |speeds: &Speeds| {
            let [v, k] = vectors(speeds);
            let motion = self.motion(t, v, k);
            let Action { load, damping, supply, loss } = effects.action(&motion);
            let load = load + damping;
            let (a, m) = (load.force * self.rotor.body.per_m, load.about_centre(&motion));
            [a.x, a.y, a.z, m.x, m.y, m.z, supply, loss]
        };
        let speeds = tableau.advanced(rates, speeds, h);
        [self.at.v, self.at.k] = vectors(&speeds);
        self.work = [speeds[6], speeds[7]];
        self.evaluations += tableau.stages.len() as f64;
    }
}

fn vectors(speeds: &Speeds) -> [Vector3<f64>; 2] {
    [Vector3::new(speeds[0], speeds[1], speeds[2]), Vector3::new(speeds[3], speeds[4], speeds[5])]
}

impl<E: Effects, const N: usize> Split<N> for Flow<'_, E, N> {
    #[inline(always)]
    fn drift(&mut self, h: f64) {
        if self.guarded && self.may_pass_the_limit(h) {
            self.refusal = Some(BEYOND_LIMIT);
        }
        if self.refusal.is_some() {
            return;
        }
        let body = self.rotor.inertia();
        // eq. 39: r + h v; L(K h/Jt) on the left and K·t h (1/Ja − 1/Jt) about the axis
        self.at.r += self.at.v * h;
        if let Some(asymmetric) = &body.asymmetric {
            return self.tumble(&body, asymmetric, h);
        }
        self.at.phi += self.at.k.dot(&self.tilt.axis) * (h * body.spin);
        self.turn(self.at.k * (h * body.per_jt));
    }

    #[inline(always)]
    fn kick(&mut self, t: f64, h: f64) {
        if !self.spreads {
            return self.push(t, h);
        }
        let before = self.at.k;
        self.push(t, 0.5 * h);
        let k = self.at.k;
        let (square, gain) = (k.norm_squared(), (k - before) * 2.0);
        let half = 0.5 * square.sqrt() * (h * self.rotor.body.per_jt).abs();
        if half > 0.0 {
            // eq. 41: ρ = (1 − sin a/a) K×ΔK/|K|², a = |K| h/(2Jt)
            let lag = 1.0 - Reduced::new(half).sine() / half;
            self.turn(k.cross(&gain) * (lag / square));
        }
        self.push(t, 0.5 * h);
    }

    #[inline(always)]
    fn end(self) -> (Result<[f64; N], Refusal>, f64) {
        let mut y = [0.0; N];
        self.at.write(&mut y);
        // φ has all the turns that φ from e has gained.
        y[PHI] = Angle { turns: self.turns, remainder: self.at.phi }.radians();
        if N == WITH_WORK {
            (y[SUPPLIED], y[DISSIPATED]) = (self.work[0], self.work[1]);
        }
        (self.refusal.map_or(Ok(y), Err), self.evaluations)
    }
}
