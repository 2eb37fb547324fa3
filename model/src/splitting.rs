//! The rotor's motion as the sum of two: the drift of a free rotor, followed exactly, and the kicks of its effects, which
//! change its speeds where it is.

mod tumbling;

pub use tumbling::{Beside, Tumbling};

use crate::effects::{Effects, Motion};
use crate::integrate::composition::{Composition, Split, Splitting};
use crate::integrate::sizes::Squares;
use crate::integrate::tableau::{DOP853, DOPRI5, Tableau};
use crate::integrate::{Refusal, System};
use crate::rotation::arc::{Reduced, atan2};
use crate::rotation::{Angle, Chart, Tilt, Turn, Turned};
use crate::rotor::{FORBIDDEN, LIMIT, Rotor, groups};
use crate::state::{Coordinates, Kinematics, PHI, own, put_work, rigid, rigid_mut, work};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// A motion of N equations on its way through a step.
pub struct Flow<'r, E, const N: usize> {
    rotor: &'r Rotor<'r, E>,
    at: Coordinates<f64>,
    tilt: Tilt<f64>,
    /// Whole turns of φ from e since the step began, besides φ in the chart.
    turns: f64,
    /// Work supplied and lost \[J], and whether it is solved.
    work: [f64; 2],
    works: bool,
    /// The state where the step began; its own states are those that the motion has reached.
    y: [f64; N],
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

/// A step in which the axis goes further about K than this \[rad] spreads its kicks: the nutation is not resolved. Measured
/// from 0.03 to 32 times around, worst of 20 step sizes: below this angle both ways are as good, beyond it kicks that
/// are not spread are up to 10⁴ times worse.
const RESOLVED: f64 = PI;

impl<E: Effects, const N: usize> Splitting<N> for Rotor<'_, E> {
    type Flow<'r>
        = Flow<'r, E, N>
    where
        Self: 'r;

    #[inline(always)]
    fn flow<'r>(&'r self, y: &[f64; N], composition: &Composition, h: f64) -> Flow<'r, E, N> {
        let at = Coordinates::from_slice(rigid(y));
        Flow {
            rotor: self,
            at,
            tilt: Tilt::new(self.frame.chart, at.gamma),
            turns: 0.0,
            work: work(y),
            y: *y,
            works: self.frame.works(),
            inner: self.effects.follows_speed().then_some(if composition.order <= 4 { &DOPRI5 } else { &DOP853 }),
            spreads: self.inertia().asymmetric.is_none() && at.k.norm() * h * self.frame.body.per_jt > RESOLVED,
            guarded: self.effects.needs_gamma(),
            evaluations: 0.0,
            refusal: None,
        }
    }

    fn roundings_of_parts(&self, y: &[f64; N], h: f64) -> Squares<N> {
        let mut squares = self.roundings(y, h);
        // A drift turns the rotor anew, and directions and angles are known to so many radians.
        squares[own(N) + groups::GAMMA] = 1.0;
        squares[own(N) + groups::PHI] += 1.0;
        squares
    }

    fn apart(&self, a: &[f64; N], b: &[f64; N]) -> [f64; N] {
        let mut apart = std::array::from_fn(|n| a[n] - b[n]);
        // From −e, φ jumps by whole turns where γ is on the other side of where its azimuth begins.
        apart[own(N) + PHI] -= TAU * (apart[own(N) + PHI] / TAU).round();
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
        self.tilt = Tilt::new(self.rotor.frame.chart, turned.gamma);
    }

    /// Whether the axis may come near −e within a drift of `h` \[s], where a law has no limit.
    fn may_pass_the_limit(&self, h: f64) -> bool {
        let (body, k, theta) = (self.rotor.inertia(), self.at.k, self.tilt.gamma_in_chart().norm());
        let to_antipode = if self.rotor.frame.chart == Chart::FromE { PI - theta } else { theta };
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
        Kinematics::tilted(self.rotor.inertia(), self.tilt, at).when(t, self.rotor.frame.turns)
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
        if let Some(tableau) = self.inner {
            return self.push_followed(tableau, t, h);
        }
        let motion = self.motion(t, self.at.v, self.at.k);
        let load = effects.act(&Motion::new(&motion, &self.y[..own(N)])).load;
        let (v, k) = (load.force * (h * self.rotor.frame.body.per_m), load.about_centre(&motion) * h);
        if self.works {
            // No load follows the speeds, so power does so linearly, and the middle of the way tells the work.
            let middle = self.motion(t, self.at.v + v * 0.5, self.at.k + k * 0.5);
            let act = effects.act(&Motion::new(&middle, &self.y[..own(N)]));
            self.work = [self.work[0] + act.supply * h, self.work[1] + act.loss * h];
            self.evaluations += 1.0;
        }
        self.at.v += v;
        self.at.k += k;
        self.evaluations += 1.0;
    }

    /// [`Flow::push`] where loads follow the speeds, called: beside it, the other would wait for registers.
    #[inline(never)]
    fn push_followed(&mut self, tableau: &Tableau, t: f64, h: f64) {
        let effects = &self.rotor.effects;
        let mut speeds = self.y;
        Coordinates { v: self.at.v, k: self.at.k, ..self.at }.write(rigid_mut(&mut speeds));
        put_work(&mut speeds, self.work);
        let rates = |speeds: &[f64; N]| {
            let at = Coordinates::from_slice(rigid(speeds));
            let motion = self.motion(t, at.v, at.k);
            let act = effects.act(&Motion::new(&motion, &speeds[..own(N)]));
            let load = act.load + act.damping;
            let mut rates = [0.0; N];
            effects.own_rates(&Motion::new(&motion, &speeds[..own(N)]), &mut rates[..own(N)]);
            let still = Vector3::zeros();
            let (v, k) = (load.force * self.rotor.frame.body.per_m, load.about_centre(&motion));
            Coordinates { r: still, v, k, gamma: still.yz(), phi: 0.0 }.write(rigid_mut(&mut rates));
            put_work(&mut rates, [act.supply, act.loss]);
            rates
        };
        let speeds = tableau.advanced(rates, speeds, h);
        let at = Coordinates::from_slice(rigid(&speeds));
        (self.at.v, self.at.k, self.work) = (at.v, at.k, work(&speeds));
        self.y[..own(N)].copy_from_slice(&speeds[..own(N)]);
        self.evaluations += tableau.stages.len() as f64;
    }
}

impl<E: Effects, const N: usize> Split<N> for Flow<'_, E, N> {
    #[inline(always)]
    fn drift(&mut self, h: f64) {
        if self.guarded && self.may_pass_the_limit(h) {
            self.refusal = self.rotor.effects.no_limit().map(Refusal);
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
        let half = 0.5 * square.sqrt() * (h * self.rotor.frame.body.per_jt).abs();
        if half > 0.0 {
            // eq. 41: ρ = (1 − sin a/a) K×ΔK/|K|², a = |K| h/(2Jt)
            let lag = 1.0 - Reduced::new(half).sine() / half;
            self.turn(k.cross(&gain) * (lag / square));
        }
        self.push(t, 0.5 * h);
    }

    #[inline(always)]
    fn end(self) -> (Result<[f64; N], Refusal>, f64) {
        let mut y = self.y;
        // φ has all the turns that φ from e has gained.
        let phi = Angle { turns: self.turns, remainder: self.at.phi }.radians();
        Coordinates { phi, ..self.at }.write(rigid_mut(&mut y));
        put_work(&mut y, self.work);
        (self.refusal.map_or(Ok(y), Err), self.evaluations)
    }
}
