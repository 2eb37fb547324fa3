//! The effects of one scene as a type: `(Called<Gravity, 1>, (Called<Support, 1>, ()))`.
//!
//! What every evaluation asks, the list sums up itself, so that it is compiled for just these effects. All else goes from
//! [`Block`] to [`Block`].

#[macro_use]
mod block;
mod member;

pub use block::{Block, Kind};
pub use member::{Called, Switched};

use super::{Act, Change, Doubt, Effect, Facts, InputSet, Law, MOST_DOUBTS, MOST_OWN, Motion, Pose, Wrench};
use crate::body::Shape;
use crate::dual::Tangent;
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Kinematics, Layout};
use crate::stored::{Damaged, Stored, Walk};
use crate::variable::{Meta, Place};
use member::Member;

/// Whether what extrapolates inputs has room for all of the list's.
pub const fn follows_all_inputs<E: Effects>() -> bool {
    E::FACTS.extrapolated <= E::FACTS.most_extrapolated
}

/// The effects of a scene together: sums of what each does, and the way to each.
pub trait Effects: Clone + Default + Send + Stored + 'static {
    /// What is known of them while they are compiled.
    const FACTS: Facts;

    /// Where everything stands in a state of N numbers.
    #[inline(always)]
    fn layout<const N: usize>() -> Layout {
        Self::FACTS.layout(N)
    }

    /// What they do together, but for the energy that they store, in a motion with all of their states, in their order.
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S>;

    /// Their potential energy \[J].
    fn stored<S: Scalar>(&self, motion: &Motion<S>) -> S;

    /// The rates of their own states, which those that are switched off leave as they are.
    fn own_rates<S: Scalar>(&self, motion: &Motion<S>, rates: &mut [S]);

    /// Their indicators, in their order, which those that are switched off leave as they are.
    fn indicators(&self, motion: &Kinematics<f64>, own: &[f64], all: &mut [f64]);

    /// By how much their loads change with a small change of the motion, squared, or with `SIZES` how large they are after an excursion;
    /// those of effects that are switched off are left as they are.
    fn loads<const SIZES: bool>(&self, at: &Pose, change: &Change, squares: &mut [f64]);

    /// Whether any of them shows the velocity of a station.
    fn shows_velocity(&self) -> bool;

    /// Whether the law of any of them may be doubtful at some speeds.
    fn is_doubtful(&self) -> bool;

    /// Called at the start `t` \[s] of a communication step.
    fn step_from(&mut self, t: f64);

    /// The ω_φ that one of them imposes at time `t` \[s] [rad/s], and the rate of that [rad/s²].
    fn imposed<S: Scalar>(&self, t: S) -> Option<[S; 2]>;

    /// The effect of this number, counted from 0.
    fn nth(&self, n: usize) -> Option<&dyn Block>;

    /// The effect of this number, to change it.
    fn nth_mut(&mut self, n: usize) -> Option<&mut dyn Block>;

    /// What the effect of this number is.
    fn kind(n: usize) -> Option<&'static Kind>;

    /// The number of the effect that has this block, and that of the first of its own states.
    fn number_of(block: u32) -> Option<[usize; 2]>;

    /// All of them.
    fn blocks(&self) -> impl Iterator<Item = &dyn Block> {
        (0..Self::FACTS.count).filter_map(|n| self.nth(n))
    }

    /// Those that act.
    fn active(&self) -> impl Iterator<Item = &dyn Block> {
        self.blocks().filter(|block| block.is_active())
    }

    /// Shows each of them, to be changed.
    fn for_each(&mut self, mut show: impl FnMut(&mut dyn Block)) {
        for n in 0..Self::FACTS.count {
            self.nth_mut(n).into_iter().for_each(&mut show);
        }
    }

    /// What they make of the body.
    fn shape(&self, body: &mut Shape) {
        self.active().for_each(|block| block.shape(body));
    }

    /// Whether any of them follows φ.
    fn follows_phi(&self) -> bool {
        self.active().any(|block| block.kind().facts.follows_phi)
    }

    /// Whether the law of any of them has no limit where |γ| = π.
    fn needs_gamma(&self) -> bool {
        self.no_limit().is_some()
    }

    /// What that is, of the first.
    fn no_limit(&self) -> Option<&'static str> {
        self.active().find_map(|block| block.no_limit())
    }

    /// Whether any of them can act on the rotor other than by its weight.
    fn push(&self) -> bool {
        self.active().any(|block| block.kind().facts.pushes)
    }

    /// Whether any of them can lose energy or be supplied with it.
    fn works(&self) -> bool {
        self.active().any(|block| block.works())
    }

    /// Whether what any of them applies depends on how fast the rotor moves, or on states of its own.
    fn follows_speed(&self) -> bool {
        self.active().any(|block| block.follows_speed() || block.kind().facts.own > 0)
    }

    /// Whether the laws of all of them are analytic as they are now.
    fn are_analytic(&self) -> bool {
        self.active().all(|block| block.is_analytic())
    }

    /// Reports what is doubtful of those that act, each by its name, at ω_φ from the first to the second of these [rad/s], and was not
    /// between those before.
    fn doubts(&self, speeds: [f64; 2], before: Option<[f64; 2]>, tell: &mut dyn FnMut(&str, Doubt)) {
        for block in self.active() {
            let known = before.map_or([None; MOST_DOUBTS], |before| block.doubts(before));
            let is_new = |doubt: &Doubt| !known.iter().flatten().any(|known| known.is_like(doubt));
            for doubt in block.doubts(speeds).iter().flatten().filter(|doubt| is_new(doubt)) {
                tell(&block.kind().block_name(), *doubt);
            }
        }
    }

    /// Whether any of those that act has inputs.
    fn have_inputs(&self) -> bool {
        self.active().any(|block| block.kind().facts.extrapolated > 0 || block.kind().facts.tells_rates)
    }

    /// Whether any of them extrapolates inputs.
    #[inline(always)]
    fn extrapolates(&self) -> bool {
        Self::FACTS.extrapolates && self.active().any(|block| block.kind().facts.extrapolates)
    }

    /// The first parameter whose value is not possible.
    fn check(&self) -> Result<(), Invalid> {
        self.active().try_for_each(|block| {
            block.check()?;
            let excluded = |name: &&&str| self.active().any(|other| other.kind().name == **name);
            match block.kind().excludes.iter().find(excluded) {
                Some(other) => Err(Invalid::excluded(block.kind().switch_name(), &format!("effects.{other}"))),
                None => Ok(()),
            }
        })
    }

    /// Hear where the motion begins, and write down their own states there and what these count with.
    fn begin(&mut self, start: &Kinematics<f64>, own: &mut [f64], nominal: &mut [f64]) {
        let mut from = 0;
        self.for_each(|block| {
            let count = block.kind().facts.own;
            let motion = Motion::new(start, &[0.0; MOST_OWN][..count]);
            if let Some(law) = block.law_mut() {
                *law = Law::default();
            }
            block.begin(&motion);
            if block.is_active() {
                own[from..][..count].copy_from_slice(&block.own_at_start(&motion)[..count]);
            }
            nominal[from..][..count].copy_from_slice(&block.own_nominal()[..count]);
            from += count;
        });
    }

    /// Go on where their indicators have these signs.
    fn switch(&mut self, positive: &[bool], motion: &Kinematics<f64>, own: &[f64]) {
        let (mut from, mut first) = (0, 0);
        self.for_each(|block| {
            let facts = &block.kind().facts;
            block.switch(&positive[first..][..facts.indicators], &Motion::new(motion, &own[from..][..facts.own]));
            (from, first) = (from + facts.own, first + facts.indicators);
        });
    }

    /// Hear where a communication step ended.
    fn step_to(&mut self, end: &Kinematics<f64>, own: &[f64]) {
        let mut from = 0;
        self.for_each(|block| {
            let to = from + block.kind().facts.own;
            if block.is_active() {
                block.step_to(&Motion::new(end, &own[from..to]));
            }
            from = to;
        });
    }

    /// Extrapolate the input of this number over the step that begins.
    fn extrapolate(&mut self, number: usize, lag: Option<f64>, signal: &mut Signal) {
        self.for_each(|block| {
            if block.is_active() {
                block.extrapolate(number, lag, signal);
            }
        });
    }

    /// Interpolate the input with this index up to time `to` \[s]: until then all are known.
    fn interpolate(&mut self, number: usize, lag: Option<f64>, to: f64, signal: &mut Signal) {
        self.for_each(|block| {
            if block.is_active() {
                block.interpolate(number, lag, to, signal);
            }
        });
    }

    /// The time \[s] up to which all inputs are known, where the motion is to be done again up to there.
    fn known_until(&self) -> Option<f64> {
        let of_all = self.lag().unwrap_or_default();
        let have_inputs = self.active().filter(|block| block.kind().facts.extrapolated > 0);
        let latest = have_inputs.map(|block| block.lag().unwrap_or(of_all)).fold(0.0, f64::max);
        self.active().find_map(|block| block.known_until(latest))
    }

    /// Steps that are to be done again, beside an effect whose part in them is not known any more.
    fn excludes_redo(&self) -> Option<Invalid> {
        let minds = |block: &&dyn Block| block.knows_partner() || block.kind().facts.imposes;
        let block = self.active().find(minds).filter(|_| self.known_until().is_some())?;
        let whose = if block.knows_partner() { "the coefficients of the partner of " } else { "" };
        Some(Invalid::excluded("extrapolation.redo", &format!("{whose}{}", block.kind().switch_name())))
    }

    /// How many communication steps values of all inputs are late, where that is given \[1].
    fn lag(&self) -> Option<f64> {
        self.active().filter(|block| block.kind().facts.extrapolates).find_map(|block| block.lag())
    }

    /// The degree of the polynomials as which inputs go on; 0 where they are held.
    fn order(&self) -> usize {
        self.active().map(|block| block.order()).max().unwrap_or_default()
    }

    /// Goes through those that may have partners, each with its number among them.
    fn for_each_partner(&mut self, mut act: impl FnMut(usize, &mut dyn Block)) {
        let mut number = 0;
        self.for_each(|block| {
            if block.kind().facts.partners > 0 {
                act(number, block);
                number += 1;
            }
        });
    }

    /// Sets the law of each, by its number.
    fn set_laws<'l>(&mut self, law: impl Fn(usize) -> &'l Law) {
        self.for_each_partner(|number, block| {
            if let Some(own) = block.law_mut() {
                *own = *law(number);
            }
        });
    }

    /// Calls `act` with each input that may be extrapolated, and by how many steps it is late, where its effect says so \[1].
    fn for_each_extrapolated(&mut self, act: &mut dyn FnMut(Option<f64>, &mut Signal)) {
        self.for_each(|block| {
            if !block.kind().facts.tells_rates {
                let lag = block.lag();
                block.for_each_signal(&mut |signal| act(lag, signal));
            }
        });
    }

    /// Takes the inputs that may be extrapolated from effects of the same list.
    fn take_extrapolated(&mut self, other: &Self) {
        for n in 0..Self::FACTS.count {
            let (Some(block), Some(other)) = (self.nth_mut(n), other.nth(n)) else { continue };
            // A port that goes on by the law of its partner holds what was set.
            let (tells_rates, mut row) =
                (block.kind().facts.tells_rates || block.law_mut().is_some_and(|law| law.is_on), 0);
            while !tells_rates && (block.kind().meta)(row).is_some() {
                if let (Some(signal), Some(extrapolated)) = (block.signal_mut(row), other.signal(row)) {
                    *signal = *extrapolated;
                }
                row += 1;
            }
        }
    }

    /// Each input.
    fn for_each_signal(&mut self, act: &mut dyn FnMut(&mut Signal)) {
        self.for_each(|block| block.for_each_signal(act));
    }

    /// What is said of the variable at this place; None where there is none.
    #[inline(always)]
    fn meta(place: Place) -> Option<&'static Meta> {
        let [n, _] = Self::number_of(place.block)?;
        let kind = Self::kind(n)?;
        if kind.facts.switched && place.row == Place::SWITCH { Some(&kind.switch) } else { (kind.meta)(place.row) }
    }

    /// The full name of the variable at this place; None where there is none.
    fn name(place: Place) -> Option<String> {
        let meta = Self::meta(place)?;
        let [n, _] = Self::number_of(place.block)?;
        let kind = Self::kind(n)?;
        Some(if place.row == Place::SWITCH { kind.switch_name() } else { kind.full_name(meta.name) })
    }

    /// The effect at this place, and the number of the first of its own states.
    #[inline(always)]
    fn at(&self, place: Place) -> Option<(&dyn Block, usize)> {
        let [n, own] = Self::number_of(place.block)?;
        Some((self.nth(n)?, own))
    }

    /// The effect at this place, to change it.
    fn at_mut(&mut self, place: Place) -> Option<&mut dyn Block> {
        self.nth_mut(Self::number_of(place.block)?[0])
    }

    /// Sets a parameter; false where there is none at this place.
    fn set_parameter(&mut self, place: Place, value: f64) -> bool {
        self.at_mut(place).is_some_and(|block| block.set_parameter(place.row, value))
    }

    /// An input; None where there is none at this place.
    fn signal(&self, place: Place) -> Option<&Signal> {
        self.at(place)?.0.signal(place.row)
    }

    /// An input to set; None where there is none at this place.
    fn signal_mut(&mut self, place: Place) -> Option<&mut Signal> {
        self.at_mut(place)?.signal_mut(place.row)
    }

    /// Switches the effect at this place on, where it has a switch.
    fn switch_on(&mut self, block: u32) {
        if let Some(block) = self.at_mut(Place::switch(block)) {
            block.switch_to(true);
        }
    }
}

impl Stored for () {
    fn walk(&mut self, _walk: &mut impl Walk) -> Result<(), Damaged> {
        Ok(())
    }
}

/// The end of a list.
impl Effects for () {
    const FACTS: Facts = Facts::NONE;

    #[inline(always)]
    fn act<S: Scalar>(&self, _motion: &Motion<S>) -> Act<S> {
        Act { supply: S::zero(), loss: S::zero(), ..Act::none() }
    }

    #[inline(always)]
    fn stored<S: Scalar>(&self, _motion: &Motion<S>) -> S {
        S::zero()
    }

    #[inline(always)]
    fn own_rates<S: Scalar>(&self, _motion: &Motion<S>, _rates: &mut [S]) {}

    #[inline(always)]
    fn indicators(&self, _motion: &Kinematics<f64>, _own: &[f64], _all: &mut [f64]) {}

    #[inline(always)]
    fn loads<const SIZES: bool>(&self, _at: &Pose, _change: &Change, _squares: &mut [f64]) {}

    #[inline(always)]
    fn shows_velocity(&self) -> bool {
        false
    }

    #[inline(always)]
    fn is_doubtful(&self) -> bool {
        false
    }

    #[inline(always)]
    fn step_from(&mut self, _t: f64) {}

    #[inline(always)]
    fn imposed<S: Scalar>(&self, _t: S) -> Option<[S; 2]> {
        None
    }

    #[inline(always)]
    fn nth(&self, _n: usize) -> Option<&dyn Block> {
        None
    }

    #[inline(always)]
    fn nth_mut(&mut self, _n: usize) -> Option<&mut dyn Block> {
        None
    }

    #[inline(always)]
    fn kind(_n: usize) -> Option<&'static Kind> {
        None
    }

    #[inline(always)]
    fn number_of(_block: u32) -> Option<[usize; 2]> {
        None
    }
}

/// What rates need of what an effect does, called: over a scalar with derivatives its law is too long to stand in every sum.
#[inline(never)]
fn called<E: Effect, S: Scalar>(effect: &E, motion: &Motion<S>) -> (Wrench<S>, Wrench<S>, S, S) {
    let Act { load, damping, supply, loss, .. } = effect.act(motion);
    (load, damping, supply, loss)
}

/// An effect and the rest of the list.
impl<H: Member, T: Effects> Effects for (H, T) {
    const FACTS: Facts = H::KIND.facts.and(T::FACTS);

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let (mine, others) = motion.all_own().split_at(H::Effect::FACTS.own);
        let mut all = self.1.act(&motion.seen_with(others));
        let Some(effect) = self.0.active() else { return all };
        let seen = motion.seen_with(mine);
        if S::LONG {
            // One by one, or those of an effect that is off would be copied too.
            let (load, damping, supply, loss) = called(effect, &seen);
            all.load = load + all.load;
            all.damping = damping + all.damping;
            all.supply = supply + all.supply;
            all.loss = loss + all.loss;
            return all;
        }
        effect.act(&seen) + all
    }

    #[inline(always)]
    fn stored<S: Scalar>(&self, motion: &Motion<S>) -> S {
        let (mine, others) = motion.all_own().split_at(H::Effect::FACTS.own);
        let rest = self.1.stored(&motion.seen_with(others));
        self.0.active().map_or(rest, |effect| effect.act(&motion.seen_with(mine)).stored + rest)
    }

    #[inline(always)]
    fn own_rates<S: Scalar>(&self, motion: &Motion<S>, rates: &mut [S]) {
        let (mine, others) = motion.all_own().split_at(H::Effect::FACTS.own);
        let (to, other_rates) = rates.split_at_mut(H::Effect::FACTS.own);
        if H::Effect::FACTS.own > 0
            && let Some(effect) = self.0.active()
        {
            to.copy_from_slice(&effect.act(&motion.seen_with(mine)).own[..H::Effect::FACTS.own]);
        }
        self.1.own_rates(&motion.seen_with(others), other_rates);
    }

    #[inline(always)]
    fn indicators(&self, motion: &Kinematics<f64>, own: &[f64], all: &mut [f64]) {
        let (mine, others) = own.split_at(H::Effect::FACTS.own);
        let (to, other_indicators) = all.split_at_mut(H::Effect::FACTS.indicators);
        if H::Effect::FACTS.indicators > 0
            && let Some(effect) = self.0.active()
        {
            let seen = Motion::new(motion, mine);
            (0..).zip(to).for_each(|(n, to)| *to = effect.indicator(n, &seen));
        }
        self.1.indicators(motion, others, other_indicators);
    }

    #[inline(always)]
    fn loads<const SIZES: bool>(&self, at: &Pose, change: &Change, squares: &mut [f64]) {
        let (to, others) = squares.split_at_mut(H::Effect::FACTS.loads);
        if H::Effect::FACTS.loads > 0
            && let Some(effect) = self.0.active()
        {
            let loads = if SIZES { effect.load_sizes(at, change) } else { effect.load_changes(at, change) };
            to.copy_from_slice(&loads[..H::Effect::FACTS.loads]);
        }
        self.1.loads::<SIZES>(at, change, others);
    }

    #[inline(always)]
    fn shows_velocity(&self) -> bool {
        (H::Effect::FACTS.shows_velocity && self.0.active().is_some()) || self.1.shows_velocity()
    }

    #[inline(always)]
    fn is_doubtful(&self) -> bool {
        self.0.active().is_some_and(|effect| effect.is_doubtful()) || self.1.is_doubtful()
    }

    #[inline(always)]
    fn step_from(&mut self, t: f64) {
        if self.0.active().is_some() {
            self.0.effect_mut().step_from(t);
        }
        self.1.step_from(t);
    }

    #[inline(always)]
    fn imposed<S: Scalar>(&self, t: S) -> Option<[S; 2]> {
        self.0.active().and_then(|effect| effect.imposed(t)).or_else(|| self.1.imposed(t))
    }

    #[inline(always)]
    fn nth(&self, n: usize) -> Option<&dyn Block> {
        if n == 0 { Some(&self.0) } else { self.1.nth(n - 1) }
    }

    #[inline(always)]
    fn nth_mut(&mut self, n: usize) -> Option<&mut dyn Block> {
        if n == 0 { Some(&mut self.0) } else { self.1.nth_mut(n - 1) }
    }

    #[inline(always)]
    fn kind(n: usize) -> Option<&'static Kind> {
        if n == 0 { Some(const { &H::KIND }) } else { T::kind(n - 1) }
    }

    #[inline(always)]
    fn number_of(block: u32) -> Option<[usize; 2]> {
        if block == H::KIND.block {
            return Some([0, 0]);
        }
        T::number_of(block).map(|[n, own]| [n + 1, own + H::Effect::FACTS.own])
    }
}
