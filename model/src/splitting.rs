//! The rotor's motion as the sum of two: the drift of a free rotor, followed exactly, and the kicks of its effects, which
//! change its speeds where it is.

mod tumbling;

pub use tumbling::{Beside, Tumbling};

use crate::body::ROTOR;
use crate::effects::{Effects, Motion};
use crate::integrate::composition::{Composition, Split, Splitting};
use crate::integrate::sizes::{MOST_GROUPS, Squares};
use crate::integrate::stiff::Differentiable;
use crate::integrate::stiff::spectrum::spectral_radius;
use crate::integrate::tableau::{DOP853, DOPRI5, Tableau};
use crate::integrate::{Refusal, System};
use crate::rotation::arc::{Reduced, atan2};
use crate::rotation::{Angle, Chart, Tilt, Turn, Winding};
use crate::rotor::{Rotor, acting, groups};
use crate::state::{BODY, Coordinates, Kinematics};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// A motion of N equations on its way through a step.
#[derive(Clone)]
pub struct Flow<'r, E, const N: usize> {
    rotor: &'r Rotor<'r, E>,
    /// Of a symmetric body γ and φ are those of the start: meanwhile the axis tells the tilt.
    at: Coordinates<f64>,
    /// The axis t \[1].
    axis: Vector3<f64>,
    /// How far it has spun about it \[rad], summed up by itself, so that it is not rounded as φ would be.
    spun: f64,
    /// What φ of a symmetric body has gained in the chart and in the other one.
    windings: [Winding; 2],
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
        let at = self.at(y);
        Flow {
            rotor: self,
            at,
            axis: Tilt::new(self.frame.chart, at.gamma).axis,
            spun: 0.0,
            windings: [Winding::none(); 2],
            turns: 0.0,
            work: E::layout::<N>().read_work(y),
            y: *y,
            works: self.active.works,
            inner: self.effects.follows_speed().then_some(if composition.order <= 4 { &DOPRI5 } else { &DOP853 }),
            spreads: self.spreads(&at, h),
            guarded: self.effects.needs_gamma(),
            evaluations: 0.0,
            refusal: None,
        }
    }

    #[inline(always)]
    fn kicks_by_place(&self, y: &[f64; N], h: f64) -> bool {
        // A kick that is spread turns the axis as well, and work follows the speeds.
        !self.effects.follows_speed() && !self.active.works && !self.spreads(&self.at(y), h)
    }

    /// From the linear equations of place and speed: what turns K about the axis is followed exactly, as is what dampens. But where the
    /// nutation is not resolved, the axis turns about K between a kick that dampens and one backwards, which do not make up for one
    /// another then.
    fn fastest(&self, t: f64, y: &[f64; N], h: f64) -> [f64; 2] {
        const SPEEDS: std::ops::Range<usize> = 3..9;
        let spreads = self.spreads(&self.at(y), h);
        let (jacobian, first) = (self.jacobian(t, y), E::layout::<N>().body(ROTOR).start);
        let radius = |numbers: usize, is_asked: fn(bool, bool) -> bool| {
            let mut part = jacobian;
            for (i, row) in part.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    let [i, j] = [i, j].map(|place| place.wrapping_sub(first));
                    if i >= numbers || j >= numbers || !is_asked(SPEEDS.contains(&i), SPEEDS.contains(&j)) {
                        *entry = 0.0;
                    }
                }
            }
            spectral_radius(&part, first + numbers)
        };
        // eq. 112: the block A B of the square of these equations
        let swings = radius(if spreads { 6 } else { BODY }, |of, by| of != by);
        let dies = if spreads && self.effects.follows_speed() { radius(BODY, |of, by| of && by) } else { 0.0 };
        [swings, dies]
    }

    fn is_steady(&self) -> bool {
        !self.active.has_events()
    }

    fn roundings_of_parts(&self, y: &[f64; N], h: f64) -> Squares {
        let mut squares = self.roundings(y, h);
        // A drift turns the rotor anew, and directions and angles are known to so many radians: an asymmetric body goes about K by an
        // azimuth of up to half a turn, and back.
        let angle = if self.inertia().asymmetric.is_some() { PI * PI } else { 1.0 };
        squares[E::FACTS.own + groups::GAMMA] = angle;
        squares[E::FACTS.own + groups::PHI] += angle;
        let mut of_turns = [0.0; MOST_GROUPS];
        self.round_loads::<N>(&self.at(y), [0.0, 0.0, angle.sqrt(), 0.0], &mut of_turns);
        (0..MOST_GROUPS).for_each(|group| squares[group] += of_turns[group]);
        squares
    }

    /// Across K, where the nutation is not resolved, a change is a turn of K, which the axis follows: it counts beside γ.
    fn parts_of_ends(&self, t: f64, y: &[f64; N], apart: &[f64; N], h: f64) -> Squares {
        let (mut parts, at) = (self.parts_of_motion(y, apart), self.at(y));
        let mut by = self.at(apart);
        if self.spreads(&at, h) {
            let [across, gamma] = [groups::ACROSS, groups::GAMMA].map(|group| E::FACTS.own + group);
            parts[gamma] += parts[across] / at.k.norm_squared();
            parts[across] = 0.0;
            // The loads of dampers do not see the nutation either.
            by.k.fill(0.0);
        }
        self.part_loads(t, y, &by, &mut parts);
        parts
    }

    fn apart(&self, a: &[f64; N], b: &[f64; N]) -> [f64; N] {
        let (mut apart, phi): ([f64; N], _) = (std::array::from_fn(|n| a[n] - b[n]), E::layout::<N>().phi(ROTOR));
        // From −e, φ jumps by whole turns where γ is on the other side of where its azimuth begins.
        apart[phi] -= TAU * (apart[phi] / TAU).round();
        apart
    }
}

impl<E: Effects> Rotor<'_, E> {
    /// Whether kicks are spread in a step of size `h` \[s] from there.
    #[inline(always)]
    fn spreads(&self, at: &Coordinates<f64>, h: f64) -> bool {
        self.inertia().asymmetric.is_none() && at.k.norm() * h.abs() * self.frame.body.per_jt > RESOLVED
    }
}

impl<E: Effects, const N: usize> Flow<'_, E, N> {
    /// The tilt of the axis.
    #[inline(always)]
    fn tilt(&self) -> Tilt<f64> {
        let chart = self.rotor.frame.chart;
        // The attitude of an asymmetric body matters, and the axis tells γ the worse the nearer it is to where the chart is singular.
        if self.rotor.inertia().asymmetric.is_some() {
            return Tilt::new(chart, self.at.gamma);
        }
        Tilt::<f64>::along(chart, self.axis)
    }

    /// Turns the axis by the Euler vector ρ \[rad].
    #[inline(always)]
    fn turn(&mut self, rho: Vector3<f64>) {
        let turn = Turn::about(rho);
        match self.rotor.frame.chart {
            Chart::FromE => self.windings[0].turn(&turn, &self.axis),
            Chart::FromMinusE => {
                self.windings[0].turn(&turn, &-self.axis);
                self.windings[1].turn(&turn, &self.axis);
            }
        }
        self.axis = turn.carried(&self.axis);
    }

    /// Whether the axis may come near −e within a drift of `h` \[s], where a law has no limit.
    #[inline(always)]
    fn may_pass_the_limit(&self, h: f64) -> bool {
        let (body, k) = (self.rotor.inertia(), self.at.k);
        // An axis on the side of e is too far from −e for a turn by 1 rad.
        let rho = k.norm_squared() * (h * body.per_jt) * (h * body.per_jt);
        let is_far = body.asymmetric.is_none() && rho <= 1.0 && self.axis.x >= 0.0;
        !is_far && self.clone().comes_near_the_limit(h)
    }

    /// [`Flow::may_pass_the_limit`] where it must be looked at closely.
    #[inline(never)]
    fn comes_near_the_limit(self, h: f64) -> bool {
        let (body, k, theta) = (self.rotor.inertia(), self.at.k, self.tilt().gamma_in_chart().norm());
        let to_antipode = if self.rotor.frame.chart == Chart::FromE { PI - theta } else { theta };
        let way = match &body.asymmetric {
            // About K it goes round on a cone.
            None => {
                let (across, along) = (k.cross(&self.axis).norm(), k.dot(&self.axis).abs());
                (across * body.per_jt * h.abs()).min(2.0 * atan2(across, along))
            }
            Some(asymmetric) => k.norm() * body.quickest(asymmetric) * h.abs(),
        };
        // What overflows is told by what comes of it.
        way.is_finite() && way > to_antipode - Chart::FORBIDDEN
    }

    /// The motion at time `t` \[s], with these speeds where it is.
    #[inline(always)]
    fn motion(&self, t: f64, v: Vector3<f64>, k: Vector3<f64>) -> Kinematics<f64> {
        let tilt = self.tilt();
        let at = Coordinates { v, k, gamma: tilt.gamma_in_chart(), ..self.at };
        Kinematics::tilted(self.rotor.inertia(), tilt, at).when(t, self.rotor.frame.turns)
    }

    /// Follows the speeds for a time `h` \[s], the place and the time `t` \[s] standing still.
    #[inline(always)]
    fn push(&mut self, t: f64, h: f64) {
        let effects = self.rotor.effects;
        if self.refusal.is_some() {
            return;
        }
        if self.guarded
            && let Err(refusal) = self.rotor.reaches(self.tilt().gamma_in_chart(), Chart::LIMIT)
        {
            self.refusal = Some(refusal);
            return;
        }
        // eq. 40: m dv/dt = ΣF, dK/dt = ΣM, place and time frozen
        if let Some(tableau) = self.inner {
            *self = self.clone().pushed_followed(tableau, t, h);
            return;
        }
        let motion = self.motion(t, self.at.v, self.at.k);
        let load = acting(effects, &Motion::new(&motion, &self.y[E::layout::<N>().own()])).load;
        let (v, k) = (load.force * (h * self.rotor.frame.body.per_m), load.about_centre(&motion) * h);
        if self.works {
            // No load follows the speeds, so power does so linearly, and the middle of the way tells the work.
            let middle = self.motion(t, self.at.v + v * 0.5, self.at.k + k * 0.5);
            let act = acting(effects, &Motion::new(&middle, &self.y[E::layout::<N>().own()]));
            self.work = [self.work[0] + act.supply * h, self.work[1] + act.loss * h];
            self.evaluations += 1.0;
        }
        self.at.v += v;
        self.at.k += k;
        self.evaluations += 1.0;
    }

    /// [`Flow::push`] where loads follow the speeds, called: beside it, the other would wait for registers. A copy goes there and comes
    /// back, or all of the motion would be kept where it can be called with.
    #[inline(never)]
    fn pushed_followed(mut self, tableau: &Tableau, t: f64, h: f64) -> Self {
        let effects = self.rotor.effects;
        let mut speeds = self.y;
        let layout = E::layout::<N>();
        layout.write(&mut speeds, ROTOR, &self.at);
        layout.write_work(&mut speeds, self.work);
        let rates = |speeds: &[f64; N]| {
            let at = layout.read(speeds, ROTOR);
            let motion = self.motion(t, at.v, at.k);
            let act = acting(effects, &Motion::new(&motion, &speeds[layout.own()]));
            let load = act.load + act.damping;
            let mut rates = [0.0; N];
            effects.own_rates(&Motion::new(&motion, &speeds[layout.own()]), &mut rates[layout.own()]);
            let still = Vector3::zeros();
            let (v, k) = (load.force * self.rotor.frame.body.per_m, load.about_centre(&motion));
            layout.write(&mut rates, ROTOR, &Coordinates { r: still, v, k, gamma: still.yz(), phi: 0.0 });
            layout.write_work(&mut rates, [act.supply, act.loss]);
            rates
        };
        let speeds = tableau.advanced(rates, speeds, h);
        let at = layout.read(&speeds, ROTOR);
        (self.at.v, self.at.k, self.work) = (at.v, at.k, layout.read_work(&speeds));
        self.y[layout.own()].copy_from_slice(&speeds[layout.own()]);
        self.evaluations += tableau.stages.len() as f64;
        self
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
            *self = self.clone().tumbled(&body, asymmetric, h);
            return;
        }
        self.spun += self.at.k.dot(&self.axis) * (h * body.spin);
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
        let (mut y, gamma) = (self.y, self.tilt().gamma_in_chart());
        let (mut phi, mut turns) = (self.at.phi, self.turns);
        if self.rotor.inertia().asymmetric.is_none() {
            let [own, other] = &self.windings;
            let gained = own.advances(other, self.rotor.frame.chart, [self.at.gamma, gamma]);
            (phi, turns) = (phi + gained.0 + self.spun, turns + gained.1);
        }
        // φ has all the turns that φ from e has gained.
        let phi = Angle { turns, remainder: phi }.radians();
        let layout = E::layout::<N>();
        layout.write(&mut y, ROTOR, &Coordinates { phi, gamma, ..self.at });
        layout.write_work(&mut y, self.work);
        (self.refusal.map_or(Ok(y), Err), self.evaluations)
    }
}
