//! The equations of motion of a body under its effects.

mod active;
mod expansion;
pub mod groups;
mod loads;

pub use crate::body::frame::Frame;
pub use active::Active;

use crate::body::{BODIES, Inertia, ROTOR};
use crate::dual::{Dual, Tangent};
use crate::effects::{Act, Effects, Motion, Wrench};
use crate::integrate::sizes::Squares;
use crate::integrate::stiff::Differentiable;
use crate::integrate::{Refusal, System};
use crate::rotation::Chart;
use crate::scalar::Scalar;
use crate::state::{Coordinates, Kinematics};
use crate::stored::stored;
use nalgebra::{Vector2, Vector3};

/// A rotor with what acts on it. Its state of N numbers is written as its [`Layout`](crate::state::Layout) says.
#[derive(Clone, Copy)]
pub struct Rotor<'e, E> {
    /// Its body, and how that is written.
    pub frame: Frame,
    /// What the effects do that are switched on.
    pub active: Active,
    /// What acts on it.
    pub effects: &'e E,
}

/// What a run stores of a rotor beside its state: all but the effects themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bodies {
    /// Each body, and how it is written.
    pub frames: [Frame; BODIES],
    /// What the effects do that are switched on.
    pub active: Active,
}

stored!(Bodies { frames, active });

impl Bodies {
    /// The rotor under these effects.
    #[inline(always)]
    pub fn under<E>(self, effects: &E) -> Rotor<'_, E> {
        let Self { frames: [frame], active } = self;
        Rotor { frame, active, effects }
    }

    /// Whether it can be that of a body under these effects: what was saved may have been altered.
    pub fn is_of<E: Effects>(&self, body: &Inertia, effects: &E) -> bool {
        self.frames.iter().all(|frame| frame.body == *body) && self.active == Active::of(effects)
    }
}

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

/// The rates of a state of N numbers, of the work where it is asked for; not a number where a law that follows γ has no limit
/// nearby.
pub fn whole_rates<S: Scalar, E: Effects, const N: usize>(
    effects: &E,
    motion: &Kinematics<S>,
    state: &[S; N],
) -> [S; N] {
    let gamma = motion.tilt.gamma_in_chart().map(S::re);
    if effects.needs_gamma() && motion.tilt.chart().before_limit(gamma) < 0.0 {
        return [S::constant(f64::NAN); N];
    }
    let own = &state[E::layout::<N>().own()];
    if effects.works() {
        all_rates::<S, E, N, true, false>(effects, motion, own)
    } else {
        all_rates::<S, E, N, false, false>(effects, motion, own)
    }
}

/// γ \[rad] of a state.
#[inline(always)]
pub(crate) fn gamma<E: Effects, const N: usize>(y: &[f64; N]) -> Vector2<f64> {
    E::layout::<N>().read(y, ROTOR).gamma
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
    effects.own_rates(&seen, &mut all[E::layout::<N>().own()]);
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
    let layout = E::layout::<N>();
    layout.write(&mut all, ROTOR, &rates(motion, load));
    if ALL && layout.has_work() {
        let supply = imposing(effects, motion, load).map_or(act.supply, |power| act.supply + power);
        layout.write_work(&mut all, [supply, act.loss]);
    }
    all
}

impl<'e, E: Effects> Rotor<'e, E> {
    /// A body under effects that stay switched as they are, its state written in this chart, φ beyond these `turns`.
    pub fn new(body: Inertia, effects: &'e E, chart: Chart, turns: f64) -> Self {
        Rotor { frame: Frame { body, chart, turns }, active: Active::of(effects), effects }
    }

    /// The coordinates of a state.
    #[inline(always)]
    pub fn at<S: Scalar, const N: usize>(&self, y: &[S; N]) -> Coordinates<S> {
        E::layout::<N>().read(y, ROTOR)
    }

    /// The motion at time `t` \[s], from a state.
    #[inline(always)]
    pub fn motion<S: Scalar, const N: usize>(&self, t: f64, y: &[S; N]) -> Kinematics<S> {
        self.motion_in(self.frame.chart, t, y)
    }

    /// [`Rotor::motion`] from a state that is written in this chart.
    #[inline(always)]
    pub fn motion_in<S: Scalar, const N: usize>(&self, chart: Chart, t: f64, y: &[S; N]) -> Kinematics<S> {
        let motion = Kinematics::new(self.inertia(), chart, self.at(y));
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
        debug_assert!(ALL || !self.active.works, "what works is solved with its work");
        all_rates::<S, E, N, ALL, false>(self.effects, &motion, &y[E::layout::<N>().own()])
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
        let motion = Kinematics::new(body, self.frame.chart, self.at(y));
        all_rates::<f64, E, N, ALL, true>(self.effects, &motion.when(t, self.frame.turns), &y[E::layout::<N>().own()])
    }

    /// Whether a state may have this γ \[rad] in the chart, whose own reach is told, under these effects.
    pub fn reaches(&self, gamma: Vector2<f64>, reach: f64) -> Result<(), Refusal> {
        self.frame.reaches(gamma, reach)?;
        if self.frame.chart == Chart::FromMinusE && self.frame.chart.before_limit(gamma) < 0.0 {
            return self.effects.no_limit().map_or(Ok(()), |reason| Err(Refusal(reason)));
        }
        Ok(())
    }
}

/// How many numbers of a state others depend on, if a law follows φ or none does.
const fn depended_on<E: Effects, const N: usize>(follows_phi: bool) -> usize {
    let angles = E::FACTS.layout(N).angles();
    if follows_phi { angles.end } else { angles.start }
}

impl<E: Effects, const N: usize> System<N> for Rotor<'_, E> {
    /// The work integrals are quadratures: no law depends on them. φ is one too where no effect follows it.
    const DEPENDED_ON: usize = depended_on::<E, N>(E::FACTS.follows_phi);

    const USUALLY_DEPENDED_ON: usize = depended_on::<E, N>(E::FACTS.follows_phi && !E::FACTS.switched);

    const ALWAYS: usize = E::FACTS.layout(N).angles().end;

    const GROUPS: usize = E::FACTS.own + groups::RIGID + E::FACTS.loads;

    fn depended_on(&self) -> usize {
        depended_on::<E, N>(E::FACTS.follows_phi && self.active.follows_phi)
    }

    fn differentiated(&self) -> usize {
        System::<N>::depended_on(self).saturating_sub(self.active.idle as usize)
    }

    /// Where its state has room for the work.
    #[inline(always)]
    fn solves_all(&self) -> bool {
        E::layout::<N>().has_work() && E::FACTS.could_work && self.active.works
    }

    /// In the chart from e; where effects have switches, of a body that none shapes, or imposes a speed on, in any chart.
    #[inline(always)]
    fn is_usual(&self) -> bool {
        if E::FACTS.switched {
            // Whether one imposes a speed is the same at all times; what speed, is not asked.
            !self.active.follows_phi && self.effects.imposed(0.0).is_none()
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
        self.reaches(self.at(y).gamma, Chart::REACH)
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
