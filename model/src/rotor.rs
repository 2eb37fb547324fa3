//! The equations of motion of a body under its effects.

mod expansion;
pub mod groups;
mod loads;

use crate::body::Inertia;
use crate::dual::{Dual, Tangent};
use crate::effects::{Act, Effects, Motion, Wrench};
use crate::integrate::sizes::Squares;
use crate::integrate::stiff::Differentiable;
use crate::integrate::{Refusal, System};
use crate::rotation::Chart;
use crate::scalar::Scalar;
use crate::state::{COORDINATES, Coordinates, DISSIPATED, Kinematics, PHI, SUPPLIED, WITH_WORK, own, rigid};
use crate::stored::{Damaged, Stored, Walk, whole};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::PI;

/// A rotor with what acts on it. Its state of N numbers is written as [`crate::state`] has it.
#[derive(Clone, Copy)]
pub struct Rotor<'e, E> {
    /// Where it is written.
    pub frame: Frame,
    /// What acts on it.
    pub effects: &'e E,
}

/// A body, and how its state is written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// The body.
    pub body: Inertia,
    /// The chart in which its state is written.
    pub chart: Chart,
    /// Whole turns of φ, counted apart.
    pub turns: f64,
    /// Whether one of its effects works, which indicators are those of effects that have events (a bit each), whether one follows φ,
    /// and how many own states those have that are switched off: asked once, not in each evaluation.
    works: bool,
    events: u32,
    follows_phi: bool,
    idle: u32,
}

impl Frame {
    /// Of a body under effects that stay switched as they are, φ beyond these `turns`.
    pub fn new<E: Effects>(body: Inertia, effects: &E, chart: Chart, turns: f64) -> Self {
        let active: usize = effects.active().map(|block| block.kind().facts.own).sum();
        let (mut events, mut first) = (0, 0);
        for block in effects.blocks() {
            let count = block.kind().facts.indicators;
            if block.is_active() && block.has_events() {
                events |= ((1 << count) - 1) << first;
            }
            first += count;
        }
        let (works, follows_phi) = (effects.works(), effects.follows_phi());
        Self { body, chart, turns, works, events, follows_phi, idle: (E::FACTS.own - active) as u32 }
    }

    /// The rotor under these effects.
    #[inline(always)]
    pub fn under<E>(self, effects: &E) -> Rotor<'_, E> {
        Rotor { frame: self, effects }
    }

    /// How far a motion at this γ \[rad] of the chart is from where a law that follows γ has no limit nearby \[rad²].
    pub(crate) fn before_limit(&self, gamma: Vector2<f64>) -> f64 {
        before_limit(self.chart, gamma)
    }

    /// Whether one of its effects can lose energy or be supplied with it.
    pub fn works(&self) -> bool {
        self.works
    }

    /// Whether one of its effects has events.
    pub fn has_events(&self) -> bool {
        self.events != 0
    }

    /// Whether the indicator of this number is that of an effect that has events.
    pub(crate) fn watches(&self, number: usize) -> bool {
        self.events >> number & 1 == 1
    }

    /// Whether it can be that of a body under these effects: what was saved may have been altered.
    pub fn is_of<E: Effects>(&self, body: &Inertia, effects: &E) -> bool {
        *self == Self::new(*body, effects, self.chart, self.turns)
    }
}

impl Stored for Frame {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { body, chart, turns, works, events, follows_phi, idle } = self;
        body.walk(walk)?;
        chart.walk(walk)?;
        whole(turns, walk)?;
        works.walk(walk)?;
        events.walk(walk)?;
        follows_phi.walk(walk)?;
        idle.walk(walk)
    }
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
    if E::FACTS.imposes
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

/// How far a γ \[rad] of a chart is from where a law that follows γ has no limit nearby \[rad²]; not positive beyond it.
fn before_limit(chart: Chart, gamma: Vector2<f64>) -> f64 {
    match chart {
        Chart::FromE => LIMIT * LIMIT - gamma.norm_squared(),
        Chart::FromMinusE => gamma.norm_squared() - FORBIDDEN * FORBIDDEN,
    }
}

/// The rates of a state of N numbers, of the work where it is asked for; not a number where a law that follows γ has no limit
/// nearby.
pub fn whole_rates<S: Scalar, E: Effects, const N: usize>(
    effects: &E,
    motion: &Kinematics<S>,
    state: &[S; N],
) -> [S; N] {
    let gamma = motion.tilt.gamma_in_chart().map(S::re);
    if effects.needs_gamma() && before_limit(motion.tilt.chart(), gamma) < 0.0 {
        return [S::constant(f64::NAN); N];
    }
    let own = &state[..own(N)];
    if effects.works() {
        all_rates::<S, E, N, true, false>(effects, motion, own)
    } else {
        all_rates::<S, E, N, false, false>(effects, motion, own)
    }
}

/// Whether what is long for these effects is compiled once and called: of those with switches, where they are compiled for commands and
/// tests, which shall not take long to build. An FMU has it wherever it is asked for, which runs faster, with the same bits.
const fn is_apart<E: Effects>() -> bool {
    cfg!(feature = "general") && E::FACTS.switched
}

/// [`Effects::act`].
#[inline(always)]
pub(crate) fn acting<S: Scalar, E: Effects>(effects: &E, motion: &Motion<S>) -> Act<S> {
    if const { is_apart::<E>() } { acting_called(effects, motion) } else { effects.act(motion) }
}

/// [`Effects::act`], called.
#[inline(never)]
fn acting_called<S: Scalar, E: Effects>(effects: &E, motion: &Motion<S>) -> Act<S> {
    effects.act(motion)
}

/// The rates of a state of N numbers, of the work where `ALL` is asked for; what acts is found here, or by [`acting`].
#[inline(always)]
fn all_rates<S: Scalar, E: Effects, const N: usize, const ALL: bool, const HERE: bool>(
    effects: &E,
    motion: &Kinematics<S>,
    states: &[S],
) -> [S; N] {
    let mut all = [S::zero(); N];
    let seen = Motion::new(motion, states);
    let act = if HERE { effects.act(&seen) } else { acting(effects, &seen) };
    effects.own_rates(&seen, &mut all[..own(N)]);
    written::<S, E, N, ALL>(effects, motion, &act, all)
}

/// What acts, as rates of the coordinates and of the work, behind those of the own states.
#[inline(always)]
fn written<S: Scalar, E: Effects, const N: usize, const ALL: bool>(
    effects: &E,
    motion: &Kinematics<S>,
    act: &Act<S>,
    mut all: [S; N],
) -> [S; N] {
    let load = if ALL { act.load + act.damping } else { act.load };
    let rigid = &mut all[own(N)..];
    rates(motion, load).write(rigid);
    if ALL && N >= WITH_WORK {
        rigid[SUPPLIED] = imposing(effects, motion, load).map_or(act.supply, |power| act.supply + power);
        rigid[DISSIPATED] = act.loss;
    }
    all
}

impl<'e, E: Effects> Rotor<'e, E> {
    /// A body under effects that stay switched as they are, its state written in this chart, φ beyond these `turns`.
    pub fn new(body: Inertia, effects: &'e E, chart: Chart, turns: f64) -> Self {
        Frame::new(body, effects, chart, turns).under(effects)
    }

    /// The motion at time `t` \[s], from a state.
    #[inline(always)]
    pub fn motion<S: Scalar>(&self, t: f64, y: &[S]) -> Kinematics<S> {
        self.motion_in(self.frame.chart, t, y)
    }

    /// [`Rotor::motion`] from a state that is written in this chart.
    #[inline(always)]
    pub fn motion_in<S: Scalar>(&self, chart: Chart, t: f64, y: &[S]) -> Kinematics<S> {
        let motion = Kinematics::new(self.inertia(), chart, Coordinates::from_slice(rigid(y)));
        imposed(self.effects, motion.when(S::constant(t), self.frame.turns))
    }

    /// The body; where no effect can shape it, the compiler knows that it is symmetric.
    #[inline(always)]
    pub fn inertia(&self) -> Inertia {
        if E::FACTS.shapes { self.frame.body } else { self.frame.body.symmetric() }
    }

    /// Whether its motion has a [series](crate::integrate::taylor): the body is symmetric, and all laws are analytic.
    pub fn has_series(&self) -> bool {
        self.inertia().asymmetric.is_none() && self.effects.imposed(0.0).is_none() && self.effects.are_analytic()
    }

    /// Why its motion has none.
    pub fn no_series(&self) -> Option<String> {
        if self.inertia().asymmetric.is_some() {
            return Some("the body is unbalanced or not symmetric".into());
        }
        if self.effects.imposed(0.0).is_some() {
            return Some("a speed is imposed".into());
        }
        let bent = self.effects.active().find(|block| !block.is_analytic())?;
        Some(format!("{} presses or follows a table", bent.kind().block_name()))
    }

    /// The rates of a state of N numbers in this chart.
    #[inline(always)]
    fn rates_in<S: Scalar, const N: usize, const ALL: bool>(&self, chart: Chart, t: f64, y: &[S; N]) -> [S; N] {
        let motion = self.motion_in(chart, t, y);
        debug_assert!(ALL || !self.frame.works, "what works is solved with its work");
        all_rates::<S, E, N, ALL, false>(self.effects, &motion, &y[..own(N)])
    }

    /// The same in any form, called: beside it in every stage, the usual one would wait for registers.
    #[inline(never)]
    fn rates_called<const N: usize>(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        // Once for each chart, so that neither asks again which one it is.
        match (self.frame.chart, System::<N>::solves_all(self)) {
            (Chart::FromE, true) => self.rates_in::<f64, N, true>(Chart::FromE, t, y),
            (Chart::FromE, false) => self.rates_in::<f64, N, false>(Chart::FromE, t, y),
            (Chart::FromMinusE, true) => self.rates_in::<f64, N, true>(Chart::FromMinusE, t, y),
            (Chart::FromMinusE, false) => self.rates_in::<f64, N, false>(Chart::FromMinusE, t, y),
        }
    }

    /// The usual rates where effects have switches, called: they are too long to stand in every stage of a method. Nothing that takes a
    /// whole motion may be called within, or all of it is stored for the call. (To ask the effects that act one after another, each
    /// through a call, was slower: 1.5 to 2.0 times a scene's own FMU instead of 1.0 to 1.4.)
    #[inline(never)]
    fn rates_of_switched<const N: usize, const ALL: bool>(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        let body = self.frame.body.symmetric();
        let motion = Kinematics::new(body, self.frame.chart, Coordinates::from_slice(rigid(y)));
        all_rates::<f64, E, N, ALL, true>(self.effects, &motion.when(t, self.frame.turns), &y[..own(N)])
    }

    /// Whether a state may have this γ \[rad] in the chart, whose own reach is told, under these effects.
    pub fn reaches(&self, gamma: Vector2<f64>, reach: f64) -> Result<(), Refusal> {
        let theta_squared = gamma.norm_squared();
        if theta_squared > reach * reach {
            return Err(if reach < LIMIT { BEYOND_REACH } else { BEYOND_CHART });
        }
        if self.frame.chart == Chart::FromMinusE && self.frame.before_limit(gamma) < 0.0 {
            return self.effects.no_limit().map_or(Ok(()), |reason| Err(Refusal(reason)));
        }
        Ok(())
    }
}

impl<E: Effects, const N: usize> System<N> for Rotor<'_, E> {
    /// The work integrals are quadratures: no law depends on them. φ is one too where no effect follows it.
    const DEPENDED_ON: usize = own(N) + if E::FACTS.follows_phi { COORDINATES } else { PHI };

    const USUALLY_DEPENDED_ON: usize = if E::FACTS.switched { own(N) + PHI } else { <Self as System<N>>::DEPENDED_ON };

    const ALWAYS: usize = own(N) + COORDINATES;

    const GROUPS: usize = own(N) + groups::RIGID + E::FACTS.loads;

    fn depended_on(&self) -> usize {
        own(N) + if E::FACTS.follows_phi && self.frame.follows_phi { COORDINATES } else { PHI }
    }

    fn differentiated(&self) -> usize {
        System::<N>::depended_on(self).saturating_sub(self.frame.idle as usize)
    }

    /// Where its state has room for the work.
    #[inline(always)]
    fn solves_all(&self) -> bool {
        N >= WITH_WORK && E::FACTS.could_work && self.frame.works
    }

    /// In the chart from e; where effects have switches, of a body that none shapes, or imposes a speed on, in any chart.
    #[inline(always)]
    fn is_usual(&self) -> bool {
        if E::FACTS.switched {
            // Whether one imposes a speed is the same at all times; what speed, is not asked.
            !self.frame.follows_phi && self.effects.imposed(0.0).is_none()
        } else {
            self.frame.chart == Chart::FromE
        }
    }

    #[inline(always)]
    fn rates<const ALL: bool, const USUAL: bool>(&self, t: f64, y: &[f64; N]) -> [f64; N] {
        match (USUAL, E::FACTS.switched) {
            (true, false) => self.rates_in::<f64, N, ALL>(Chart::FromE, t, y),
            (true, true) => self.rates_of_switched::<N, ALL>(t, y),
            (false, _) => self.rates_called::<N>(t, y),
        }
    }

    fn admits(&self, _t: f64, y: &[f64; N]) -> Result<(), Refusal> {
        self.reaches(Coordinates::from_slice(rigid(y)).gamma, Chart::REACH)
    }

    #[inline(always)]
    fn sizes(&self, y: &[f64; N], rate: &[f64; N], origin: &[f64; N]) -> Squares {
        self.sizes_of(y, rate, origin)
    }

    #[inline(always)]
    fn parts(&self, t: f64, y: &[f64; N], change: &[f64; N]) -> Squares {
        self.parts_of(t, y, change)
    }

    #[inline(always)]
    fn roundings(&self, y: &[f64; N], h: f64) -> Squares {
        self.roundings_of(y, h)
    }
}

/// A Jacobian is taken along so many numbers of the state at a time: along all of them at once it is the longest code of an FMU.
const AT_ONCE: usize = 4;

impl<E: Effects, const N: usize> Differentiable<N> for Rotor<'_, E> {
    fn jacobian(&self, t: f64, y: &[f64; N]) -> [[f64; N]; N] {
        let mut jacobian = [[0.0; N]; N];
        // Nothing depends on the quadratures.
        let size = System::<N>::depended_on(self);
        for first in (0..size).step_by(AT_ONCE) {
            let slopes = self.slopes_along(t, y, first);
            for (row, slopes) in jacobian.iter_mut().zip(&slopes) {
                row[first..size].iter_mut().zip(slopes).for_each(|(entry, slope)| *entry = *slope);
            }
        }
        jacobian
    }
}

impl<E: Effects> Rotor<'_, E> {
    /// The derivative of the rates along this change of the state.
    #[inline(never)]
    pub(crate) fn slope_along<const N: usize>(&self, t: f64, y: &[f64; N], change: &[f64; N]) -> [f64; N] {
        let state: [Tangent; N] = std::array::from_fn(|n| Tangent { re: y[n], eps: [change[n]] });
        self.rates_in::<_, N, true>(self.frame.chart, t, &state).map(|rate| rate.eps[0])
    }

    /// The derivatives of the rates along the numbers of the state from this one on.
    #[inline(never)]
    fn slopes_along<const N: usize>(&self, t: f64, y: &[f64; N], first: usize) -> [[f64; AT_ONCE]; N] {
        let state: [Dual<AT_ONCE>; N] = std::array::from_fn(|n| match n.checked_sub(first) {
            Some(direction) if direction < AT_ONCE => Dual::variable(y[n], direction),
            _ => Dual::constant(y[n]),
        });
        self.rates_in::<_, N, true>(self.frame.chart, t, &state).map(|rate| rate.eps)
    }
}
