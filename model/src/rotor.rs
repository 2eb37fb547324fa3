//! The equations of motion of a body under its effects.

pub mod groups;

use crate::body::Inertia;
use crate::dual::Dual;
use crate::effects::{Action, Effects, Wrench};
use crate::integrate::sizes::Squares;
use crate::integrate::stiff::Differentiable;
use crate::integrate::{Refusal, System};
use crate::rotation::{Chart, Tilt};
use crate::scalar::Scalar;
use crate::state::{COORDINATES, Coordinates, DISSIPATED, Kinematics, PHI, SUPPLIED, WITH_WORK, Whole};
use crate::stored::{Damaged, Stored, Walk, whole};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::PI;

/// A rotor with what acts on it.
#[derive(Clone, Default)]
pub struct Rotor<E> {
    /// The body.
    pub body: Inertia,
    /// What acts on it.
    pub effects: E,
    /// The chart in which its state is written.
    pub chart: Chart,
    /// Whole turns of φ, counted apart.
    pub turns: f64,
    /// Whether none of its effects follows where it is: asked once, not in each evaluation.
    placeless: bool,
}

/// |γ| \[rad] beyond which laws that follow the direction of γ are refused: at π they have no limit.
pub const LIMIT: f64 = 3.1;

/// In the chart from −e: |γ′| \[rad] within which they are refused.
pub const FORBIDDEN: f64 = PI - LIMIT;

const BEYOND_REACH: Refusal = Refusal("the axis turns too far for one chart, however short the step");

const BEYOND_CHART: Refusal = Refusal(
    "|gamma| of the continuous states exceeds 3.1 rad, too far for their chart: complete a step earlier, so that an event \
     can change it",
);

/// Why an axis may not come near −e.
pub const BEYOND_LIMIT: Refusal =
    Refusal("the tilt |gamma| reaches 3.1 rad, and a spring or torque that follows gamma (c2, tau) has no limit at pi");

/// The rate of K under this load [N·m].
#[inline(always)]
fn moment<S: Scalar>(motion: &Kinematics<S>, load: Wrench<S>) -> Vector3<S> {
    let moment = load.about_centre(motion);
    // eq. 76: dK/dt = M − λ dn/dt
    motion.carried().map_or(moment, |carried| moment - carried)
}

/// A motion with the speed that effects impose on it.
#[inline(always)]
pub fn imposed<S: Scalar, E: Effects>(effects: &E, motion: Kinematics<S>) -> Kinematics<S> {
    if E::IMPOSES
        && let Some([speed, _]) = effects.imposed::<S>(motion.t)
    {
        motion.imposed(speed)
    } else {
        motion
    }
}

/// The power of what imposes a speed, under the load of all else \[W].
#[inline(always)]
fn imposing<S: Scalar, E: Effects>(effects: &E, motion: &Kinematics<S>, load: Wrench<S>) -> Option<S> {
    motion.impulse?;
    let [speed, acceleration] = effects.imposed::<S>(motion.t)?;
    // eq. 76: P = τ ω_φ
    Some(motion.torque(acceleration, &load.about_centre(motion)) * speed)
}

/// The rates of the coordinates under this load.
#[inline(always)]
fn rates<S: Scalar>(motion: &Kinematics<S>, load: Wrench<S>) -> Coordinates<S> {
    // eq. 12: dr/dt = v, m dv/dt = ΣF, dK/dt = ΣM, all of the mass centre of the whole
    Coordinates {
        r: motion.at.v,
        v: load.force * S::constant(motion.body.per_m),
        k: moment(motion, load),
        gamma: motion.gamma_rate(),
        phi: motion.phi_rate(),
    }
}

/// The rates of the coordinates and of the work integrals.
#[inline(always)]
fn working_rates<S: Scalar, E: Effects, const PLACE: bool>(effects: &E, motion: &Kinematics<S>) -> Whole<S> {
    let mut whole = [S::zero(); WITH_WORK];
    let Action { load, damping, supply, loss } = effects.action_of::<S, PLACE>(motion);
    let load = load + damping;
    rates(motion, load).write(&mut whole);
    whole[SUPPLIED] = imposing(effects, motion, load).map_or(supply, |power| supply + power);
    whole[DISSIPATED] = loss;
    whole
}

/// Whether a law that follows γ has no limit near this tilt; as [`Rotor::reaches`] has it, to the last bit.
fn is_beyond_limit<S: Scalar>(tilt: &Tilt<S>) -> bool {
    let theta_squared = tilt.gamma_in_chart().map(S::re).norm_squared();
    match tilt.chart() {
        Chart::FromE => theta_squared > LIMIT * LIMIT,
        Chart::FromMinusE => theta_squared < FORBIDDEN * FORBIDDEN,
    }
}

/// The rates of the coordinates and of the work integrals; not a number where a law that follows γ has no limit nearby.
pub fn whole_rates<S: Scalar, E: Effects>(effects: &E, motion: &Kinematics<S>) -> Whole<S> {
    if effects.needs_gamma() && is_beyond_limit(&motion.tilt) {
        return [S::constant(f64::NAN); WITH_WORK];
    }
    if effects.works() {
        return working_rates::<S, E, true>(effects, motion);
    }
    let mut whole = [S::zero(); WITH_WORK];
    rates(motion, effects.load(motion)).write(&mut whole);
    whole
}

impl<E: Effects> Rotor<E> {
    /// A body under effects that stay switched as they are, its state written in this chart, φ beyond these `turns`.
    pub fn new(body: Inertia, effects: E, chart: Chart, turns: f64) -> Self {
        let placeless = !effects.follows_place();
        Self { body, effects, chart, turns, placeless }
    }

    /// The motion at time `t` \[s], from a state.
    #[inline(always)]
    pub fn motion<S: Scalar>(&self, t: f64, y: &[S]) -> Kinematics<S> {
        self.motion_in(self.chart, t, y)
    }

    /// [`Rotor::motion`] from a state that is written in this chart.
    #[inline(always)]
    pub fn motion_in<S: Scalar>(&self, chart: Chart, t: f64, y: &[S]) -> Kinematics<S> {
        self.known_motion::<S, false, false>(chart, t, y)
    }

    /// [`Rotor::motion_in`] without the speed that is imposed.
    #[inline(always)]
    pub fn free_motion_in<S: Scalar>(&self, chart: Chart, t: f64, y: &[S]) -> Kinematics<S> {
        self.known_motion::<S, false, true>(chart, t, y)
    }

    /// [`Rotor::motion_in`] of a body that is known to be `SYMMETRIC`, and `FREE` of an imposed speed: the compiler leaves out
    /// the rest.
    #[inline(always)]
    fn known_motion<S: Scalar, const SYMMETRIC: bool, const FREE: bool>(
        &self,
        chart: Chart,
        t: f64,
        y: &[S],
    ) -> Kinematics<S> {
        let inertia = if SYMMETRIC { self.body.symmetric() } else { self.inertia() };
        let motion = Kinematics::new(inertia, chart, Coordinates::from_slice(y)).when(S::constant(t), self.turns);
        if FREE { motion } else { imposed(&self.effects, motion) }
    }

    /// The body; where no effect can shape it, the compiler knows that it is symmetric.
    #[inline(always)]
    pub fn inertia(&self) -> Inertia {
        if E::SHAPES { self.body } else { self.body.symmetric() }
    }

    /// The rates of a state of N numbers; once for each chart, so that neither asks again which one it is.
    #[inline(always)]
    fn known_rates<const N: usize, const SYMMETRIC: bool, const FREE: bool, const PLACE: bool>(
        &self,
        t: f64,
        y: &[f64; N],
    ) -> [f64; N] {
        match self.chart {
            Chart::FromE => self.rates_in::<f64, N, SYMMETRIC, FREE, PLACE>(Chart::FromE, t, y),
            Chart::FromMinusE => self.rates_in::<f64, N, SYMMETRIC, FREE, PLACE>(Chart::FromMinusE, t, y),
        }
    }

    /// [`Rotor::known_rates`], called: laws of all effects are too long to stand in every stage.
    #[inline(never)]
    fn called_rates<const N: usize, const SYMMETRIC: bool, const FREE: bool, const PLACE: bool>(
        &self,
        t: f64,
        y: &[f64; N],
    ) -> [f64; N] {
        self.known_rates::<N, SYMMETRIC, FREE, PLACE>(t, y)
    }

    /// [`Rotor::called_rates`] of a body that is symmetric. Where no effect follows the place, the compiler is told that those which
    /// could are off.
    #[inline(never)]
    fn symmetric_rates<const N: usize, const FREE: bool>(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        if self.placeless {
            self.known_rates::<N, true, FREE, false>(t, y)
        } else {
            self.called_rates::<N, true, FREE, true>(t, y)
        }
    }

    /// The rates of a state of N numbers in this chart.
    #[inline(always)]
    fn rates_in<S: Scalar, const N: usize, const SYMMETRIC: bool, const FREE: bool, const PLACE: bool>(
        &self,
        chart: Chart,
        t: f64,
        y: &[S; N],
    ) -> [S; N] {
        let motion = self.known_motion::<S, SYMMETRIC, FREE>(chart, t, y);
        let mut some = [S::zero(); N];
        debug_assert!(N == WITH_WORK || !self.effects.works(), "what works is solved with its work");
        if N == WITH_WORK {
            some.copy_from_slice(&working_rates::<S, E, PLACE>(&self.effects, &motion));
        } else {
            rates(&motion, self.effects.load_of::<S, PLACE>(&motion)).write(&mut some);
        }
        some
    }

    /// Whether a state may have this γ \[rad] in the chart, whose own reach is told, under these effects.
    pub fn reaches(&self, gamma: Vector2<f64>, reach: f64) -> Result<(), Refusal> {
        let theta_squared = gamma.norm_squared();
        if theta_squared > reach * reach {
            return Err(if reach < LIMIT { BEYOND_REACH } else { BEYOND_CHART });
        }
        if self.chart == Chart::FromMinusE && self.effects.needs_gamma() && theta_squared < FORBIDDEN * FORBIDDEN {
            return Err(BEYOND_LIMIT);
        }
        Ok(())
    }
}

impl<E: Effects> Stored for Rotor<E> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { body, effects, chart, turns, placeless } = self;
        body.walk(walk)?;
        effects.walk(walk)?;
        chart.walk(walk)?;
        whole(turns, walk)?;
        placeless.walk(walk)?;
        // A rotor that runs was checked, and what is asked once follows from its effects.
        if effects.check().is_ok() && *placeless != effects.follows_place() { Ok(()) } else { Err(Damaged) }
    }
}

impl<E: Effects, const N: usize> System<N> for Rotor<E> {
    /// The work integrals are quadratures: no law depends on them. φ is one too where no effect follows it.
    const DEPENDED_ON: usize = if E::FOLLOWS_PHI { COORDINATES } else { PHI };

    fn depended_on(&self) -> usize {
        if E::FOLLOWS_PHI && self.effects.follows_phi() { COORDINATES } else { PHI }
    }

    #[inline(always)]
    fn rates(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        if !E::SWITCHED {
            return self.known_rates::<N, false, false, true>(t, y);
        }
        // What could be switched on, and is not, is told here instead of asked for all along the laws.
        match (self.body.asymmetric.is_none(), self.effects.imposed::<f64>(t).is_none()) {
            (true, true) => self.symmetric_rates::<N, true>(t, y),
            (true, false) => self.symmetric_rates::<N, false>(t, y),
            (false, true) => self.called_rates::<N, false, true, true>(t, y),
            (false, false) => self.called_rates::<N, false, false, true>(t, y),
        }
    }

    fn admits(&self, _t: f64, y: &[f64; N]) -> Result<(), Refusal> {
        self.reaches(Coordinates::from_slice(y).gamma, Chart::REACH)
    }

    #[inline(always)]
    fn sizes(&self, y: &[f64; N], rate: &[f64; N], origin: &[f64; N]) -> Squares {
        self.sizes_of(y, rate, origin)
    }

    #[inline(always)]
    fn parts(&self, y: &[f64; N], change: &[f64; N]) -> Squares {
        self.parts_of(y, change)
    }

    #[inline(always)]
    fn roundings(&self, y: &[f64; N], h: f64) -> Squares {
        self.roundings_of(y, h)
    }
}

impl<E: Effects, const N: usize> Differentiable<N> for Rotor<E> {
    fn jacobian(&self, t: f64, y: &[f64; N]) -> [[f64; N]; N] {
        if System::<N>::depended_on(self) == COORDINATES {
            self.jacobian_along::<COORDINATES, N>(t, y)
        } else {
            self.jacobian_along::<PHI, N>(t, y)
        }
    }
}

impl<E: Effects> Rotor<E> {
    /// The derivatives along the first D numbers of the state: nothing depends on the others, the quadratures.
    fn jacobian_along<const D: usize, const N: usize>(&self, t: f64, y: &[f64; N]) -> [[f64; N]; N] {
        let moving = |n: usize| if n < D { Dual::variable(y[n], n) } else { Dual::constant(y[n]) };
        let rates: [Dual<D>; N] =
            self.rates_in::<_, N, false, false, true>(self.chart, t, &std::array::from_fn(moving));
        rates.map(|rate| std::array::from_fn(|n| if n < D { rate.eps[n] } else { 0.0 }))
    }
}
