//! The effects of one scene as a type: `(Called<Gravity, 1>, (Called<Support, 1>, ()))`.

use super::{Effect, Entry, Row, Wrench};
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Kinematics, Whole};
use crate::stored::{Damaged, Stored, Walk};
use crate::variable::{Access, Meta, Place, Readable};

/// An effect that a scene calls for; `INDEX` counts from 1 where there are several of its kind.
#[derive(Clone, Default)]
pub struct Called<E, const INDEX: u32>(E);

/// An effect behind a switch; off at first.
#[derive(Clone, Default)]
pub struct Switched<E, const INDEX: u32> {
    on: bool,
    effect: E,
}

/// An entry of a list of effects.
pub trait Member: Clone + Default + Send + Stored + 'static {
    /// Its law.
    type Effect: Entry;
    /// Counts from 1 where there are several of its kind.
    const INDEX: u32;
    /// Its law, unless it is switched off.
    fn active(&self) -> Option<&Self::Effect>;
    /// Its law and parameters.
    fn effect(&self) -> &Self::Effect;
    /// Its law and parameters.
    fn effect_mut(&mut self) -> &mut Self::Effect;
    /// Switches it, where it has a switch.
    fn switch(&mut self, on: bool);
}

impl<E: Entry, const INDEX: u32> Member for Called<E, INDEX> {
    type Effect = E;
    const INDEX: u32 = INDEX;

    #[inline(always)]
    fn active(&self) -> Option<&E> {
        Some(&self.0)
    }

    fn effect(&self) -> &E {
        &self.0
    }

    fn effect_mut(&mut self) -> &mut E {
        &mut self.0
    }

    fn switch(&mut self, _on: bool) {}
}

impl<E: Entry, const INDEX: u32> Member for Switched<E, INDEX> {
    type Effect = E;
    const INDEX: u32 = INDEX;

    #[inline(always)]
    fn active(&self) -> Option<&E> {
        self.on.then_some(&self.effect)
    }

    fn effect(&self) -> &E {
        &self.effect
    }

    fn effect_mut(&mut self) -> &mut E {
        &mut self.effect
    }

    fn switch(&mut self, on: bool) {
        self.on = on;
    }
}

/// The effects of a scene together: sums of what each does, and access to their variables.
pub trait Effects: Clone + Default + Send + Stored + 'static {
    /// Whether any of them can lose energy or be supplied with it, with any parameters.
    const COULD_WORK: bool;
    /// Force on the rotor and moment about c [N, N·m], without what damps.
    fn load<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S>;
    /// Of what damps [N, N·m]: zero where nothing works.
    fn damping<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S>;
    /// Potential energy [J].
    fn potential<S: Scalar>(&self, motion: &Kinematics<S>) -> S;
    /// Power that leaves the mechanics [W].
    fn loss<S: Scalar>(&self, motion: &Kinematics<S>) -> S;
    /// Power that comes from outside [W].
    fn supply<S: Scalar>(&self, motion: &Kinematics<S>) -> S;
    /// Whether the law of any of them has no limit where |γ| = π.
    fn needs_gamma(&self) -> bool;
    /// Whether any of them can lose energy or be supplied with it.
    fn works(&self) -> bool;
    /// The first parameter whose value is not possible.
    fn check(&self) -> Result<(), Invalid>;
    /// What is said of the variable at this place; None where there is none.
    fn meta(place: Place) -> Option<&'static Meta>;
    /// The full name of the variable at this place; None where there is none.
    fn name(place: Place) -> Option<String>;
    /// The value of a variable, an input's at time `t` [s], a calculated one's of a switched-off effect zero; None where
    /// there is none at this place, or nothing is shown. `rates` is asked only where it counts.
    fn value(
        &self,
        place: Place,
        t: f64,
        motion: Option<&Kinematics<f64>>,
        rates: impl FnOnce() -> Option<Whole<f64>>,
    ) -> Option<f64>;
    /// Sets a parameter; false where there is none at this place.
    fn set_parameter(&mut self, place: Place, value: f64) -> bool;
    /// The value of a calculated variable, zero where its effect is switched off; None where there is none at this
    /// place. `rates` is asked only where it counts.
    fn calculated<S: Readable>(
        &self,
        place: Place,
        motion: &Kinematics<S>,
        rates: impl FnOnce() -> Whole<S>,
    ) -> Option<S>;
    /// An input; None where there is none at this place.
    fn signal(&self, place: Place) -> Option<&Signal>;
    /// An input to set; None where there is none at this place.
    fn signal_mut(&mut self, place: Place) -> Option<&mut Signal>;
    /// Each input.
    fn for_each_signal(&mut self, act: &mut impl FnMut(&mut Signal));
    /// Takes the inputs of other effects of the same list.
    fn hear(&mut self, other: &Self);
    /// Switches the effect at this place on, where it has a switch.
    fn switch_on(&mut self, block: u32);
}

impl<E: Entry, const INDEX: u32> Stored for Called<E, INDEX> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        walk_rows(&mut self.0, walk)
    }
}

impl<E: Entry, const INDEX: u32> Stored for Switched<E, INDEX> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        self.on.walk(walk)?;
        walk_rows(&mut self.effect, walk)
    }
}

fn walk_rows<E: Effect>(effect: &mut E, walk: &mut impl Walk) -> Result<(), Damaged> {
    for row in E::ROWS {
        match row.access {
            Access::Parameter { get, set } => {
                let mut value = get(effect);
                value.walk(walk)?;
                set(effect, value);
            }
            Access::Input { get_mut, .. } => get_mut(effect).walk(walk)?,
            Access::Output(_) | Access::Rate(_) => {}
        }
    }
    Ok(())
}

impl Stored for () {
    fn walk(&mut self, _walk: &mut impl Walk) -> Result<(), Damaged> {
        Ok(())
    }
}

impl Effects for () {
    const COULD_WORK: bool = false;

    #[inline(always)]
    fn load<S: Scalar>(&self, _motion: &Kinematics<S>) -> Wrench<S> {
        Wrench::zero()
    }

    #[inline(always)]
    fn damping<S: Scalar>(&self, _motion: &Kinematics<S>) -> Wrench<S> {
        Wrench::zero()
    }

    #[inline(always)]
    fn potential<S: Scalar>(&self, _motion: &Kinematics<S>) -> S {
        S::zero()
    }

    #[inline(always)]
    fn loss<S: Scalar>(&self, _motion: &Kinematics<S>) -> S {
        S::zero()
    }

    #[inline(always)]
    fn supply<S: Scalar>(&self, _motion: &Kinematics<S>) -> S {
        S::zero()
    }

    fn needs_gamma(&self) -> bool {
        false
    }

    fn works(&self) -> bool {
        false
    }

    fn check(&self) -> Result<(), Invalid> {
        Ok(())
    }

    fn meta(_place: Place) -> Option<&'static Meta> {
        None
    }

    fn name(_place: Place) -> Option<String> {
        None
    }

    fn value(
        &self,
        _place: Place,
        _t: f64,
        _motion: Option<&Kinematics<f64>>,
        _rates: impl FnOnce() -> Option<Whole<f64>>,
    ) -> Option<f64> {
        None
    }

    fn set_parameter(&mut self, _place: Place, _value: f64) -> bool {
        false
    }

    fn calculated<S: Readable>(
        &self,
        _place: Place,
        _motion: &Kinematics<S>,
        _rates: impl FnOnce() -> Whole<S>,
    ) -> Option<S> {
        None
    }

    fn signal(&self, _place: Place) -> Option<&Signal> {
        None
    }

    fn signal_mut(&mut self, _place: Place) -> Option<&mut Signal> {
        None
    }

    fn for_each_signal(&mut self, _act: &mut impl FnMut(&mut Signal)) {}

    fn hear(&mut self, _other: &Self) {}

    fn switch_on(&mut self, _block: u32) {}
}

impl<H: Member, T: Effects> Effects for (H, T) {
    const COULD_WORK: bool = H::Effect::COULD_WORK || T::COULD_WORK;

    #[inline(always)]
    fn load<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        let rest = self.1.load(motion);
        match self.0.active() {
            Some(effect) => effect.load(motion) + rest,
            None => rest,
        }
    }

    #[inline(always)]
    fn damping<S: Scalar>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        let rest = self.1.damping(motion);
        match self.0.active() {
            Some(effect) => effect.damping(motion) + rest,
            None => rest,
        }
    }

    #[inline(always)]
    fn potential<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        let rest = self.1.potential(motion);
        match self.0.active() {
            Some(effect) => effect.potential(motion) + rest,
            None => rest,
        }
    }

    #[inline(always)]
    fn loss<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        let rest = self.1.loss(motion);
        match self.0.active() {
            Some(effect) => effect.loss(motion) + rest,
            None => rest,
        }
    }

    #[inline(always)]
    fn supply<S: Scalar>(&self, motion: &Kinematics<S>) -> S {
        let rest = self.1.supply(motion);
        match self.0.active() {
            Some(effect) => effect.supply(motion) + rest,
            None => rest,
        }
    }

    fn needs_gamma(&self) -> bool {
        self.0.active().is_some_and(Effect::needs_gamma) || self.1.needs_gamma()
    }

    fn works(&self) -> bool {
        self.0.active().is_some_and(Effect::works) || self.1.works()
    }

    fn check(&self) -> Result<(), Invalid> {
        for row in self.0.active().map_or(&[] as &[_], |_| H::Effect::ROWS) {
            if let Access::Parameter { get, .. } = row.access {
                row.meta.check(|| full_name::<H>(row.meta.name), get(self.0.effect()))?;
            }
        }
        self.1.check()
    }

    #[inline(always)]
    fn meta(place: Place) -> Option<&'static Meta> {
        row::<H>(place).map_or_else(|| T::meta(place), |row| row.map(|row| &row.meta))
    }

    fn name(place: Place) -> Option<String> {
        row::<H>(place).map_or_else(|| T::name(place), |row| row.map(|row| full_name::<H>(row.meta.name)))
    }

    #[inline(always)]
    fn value(
        &self,
        place: Place,
        t: f64,
        motion: Option<&Kinematics<f64>>,
        rates: impl FnOnce() -> Option<Whole<f64>>,
    ) -> Option<f64> {
        let Some(row) = row::<H>(place) else { return self.1.value(place, t, motion, rates) };
        let access = &row?.access;
        match (self.0.active(), access) {
            (None, Access::Output(_) | Access::Rate(_)) => Some(0.0),
            _ => access.value(self.0.effect(), t, motion, rates),
        }
    }

    fn set_parameter(&mut self, place: Place, value: f64) -> bool {
        match row::<H>(place) {
            None => self.1.set_parameter(place, value),
            Some(Some(Row { access: Access::Parameter { set, .. }, .. })) => {
                set(self.0.effect_mut(), value);
                true
            }
            Some(_) => false,
        }
    }

    #[inline(always)]
    fn calculated<S: Readable>(
        &self,
        place: Place,
        motion: &Kinematics<S>,
        rates: impl FnOnce() -> Whole<S>,
    ) -> Option<S> {
        let Some(row) = row::<H>(place) else { return self.1.calculated(place, motion, rates) };
        match self.0.active() {
            Some(effect) => row?.access.calculated(effect, motion, rates),
            None => matches!(row?.access, Access::Output(_) | Access::Rate(_)).then(S::zero),
        }
    }

    fn signal(&self, place: Place) -> Option<&Signal> {
        match row::<H>(place) {
            None => self.1.signal(place),
            Some(Some(Row { access: Access::Input { get, .. }, .. })) => Some(get(self.0.effect())),
            Some(_) => None,
        }
    }

    fn signal_mut(&mut self, place: Place) -> Option<&mut Signal> {
        match row::<H>(place) {
            None => self.1.signal_mut(place),
            Some(Some(Row { access: Access::Input { get_mut, .. }, .. })) => Some(get_mut(self.0.effect_mut())),
            Some(_) => None,
        }
    }

    fn for_each_signal(&mut self, act: &mut impl FnMut(&mut Signal)) {
        for row in H::Effect::ROWS {
            if let Access::Input { get_mut, .. } = row.access {
                act(get_mut(self.0.effect_mut()));
            }
        }
        self.1.for_each_signal(act);
    }

    fn hear(&mut self, other: &Self) {
        for row in H::Effect::ROWS {
            if let Access::Input { get, get_mut } = row.access {
                *get_mut(self.0.effect_mut()) = *get(other.0.effect());
            }
        }
        self.1.hear(&other.1);
    }

    fn switch_on(&mut self, block: u32) {
        if block == block_of::<H>() {
            self.0.switch(true);
        }
        self.1.switch_on(block);
    }
}

fn full_name<M: Member>(name: &str) -> String {
    format!("{}.{name}", M::Effect::NAME)
}

/// The block of value references of a member.
const fn block_of<M: Member>() -> u32 {
    Place::effect_block(M::Effect::NUMBER, M::INDEX)
}

/// The row at a place: None where the place is another member's, Some(None) where it is this one's, but holds nothing.
#[allow(clippy::option_option, reason = "two different absences")]
#[inline(always)]
fn row<M: Member>(place: Place) -> Option<Option<&'static Row<M::Effect>>> {
    (place.block == block_of::<M>()).then(|| M::Effect::ROWS.get(place.row))
}
