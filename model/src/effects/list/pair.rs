//! An effect and the rest of the list: sums over both.

use super::super::{Effect, Entry, InputSet, Row, SWITCH, Wrench};
use super::member::{Member, block_of, full_name, is_switch, row, switch_of};
use super::{Action, Effects};
use crate::body::Shape;
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Kinematics, Whole};
use crate::variable::{Access, Meta, Place, Readable};

#[inline(always)]
fn acted<E: Effect, S: Scalar>(effect: &E, motion: &Kinematics<S>) -> Action<S> {
    Action {
        load: effect.load(motion),
        damping: effect.damping(motion),
        supply: effect.supply(motion),
        loss: effect.loss(motion),
    }
}

#[inline(never)]
fn called_action<E: Effect, S: Scalar>(effect: &E, motion: &Kinematics<S>) -> Action<S> {
    acted(effect, motion)
}

#[inline(never)]
fn called_load<E: Effect, S: Scalar>(effect: &E, motion: &Kinematics<S>) -> Wrench<S> {
    effect.load(motion)
}

impl<H: Member, T: Effects> Effects for (H, T) {
    const SWITCHED: bool = H::SWITCHED || T::SWITCHED;
    const COULD_WORK: bool = H::Effect::COULD_WORK || T::COULD_WORK;
    const SHAPES: bool = H::Effect::SHAPES || T::SHAPES;
    const FOLLOWS_PHI: bool = H::Effect::FOLLOWS_PHI || T::FOLLOWS_PHI;
    const IMPOSES: bool = H::Effect::IMPOSES || T::IMPOSES;
    const EXTRAPOLATED: usize = inputs_extrapolated::<H::Effect>() + T::EXTRAPOLATED;
    const MOST_EXTRAPOLATED: usize = if H::Effect::MOST_EXTRAPOLATED < T::MOST_EXTRAPOLATED {
        H::Effect::MOST_EXTRAPOLATED
    } else {
        T::MOST_EXTRAPOLATED
    };

    #[inline(always)]
    fn imposed<S: Scalar>(&self, t: S) -> Option<[S; 2]> {
        self.0.active().and_then(|effect| effect.imposed(t)).or_else(|| self.1.imposed(t))
    }

    fn shape(&self, body: &mut Shape) {
        if let Some(effect) = self.0.active() {
            effect.shape(body);
        }
        self.1.shape(body);
    }

    #[inline(always)]
    fn load_of<S: Scalar, const PLACE: bool>(&self, motion: &Kinematics<S>) -> Wrench<S> {
        let rest = self.1.load_of::<S, PLACE>(motion);
        match self.0.active() {
            _ if H::Effect::FOLLOWS_PLACE && !PLACE => rest,
            Some(effect) if S::LONG => called_load(effect, motion) + rest,
            Some(effect) => effect.load(motion) + rest,
            None => rest,
        }
    }

    #[inline(always)]
    fn action_of<S: Scalar, const PLACE: bool>(&self, motion: &Kinematics<S>) -> Action<S> {
        let rest = self.1.action_of::<S, PLACE>(motion);
        match self.0.active() {
            _ if H::Effect::FOLLOWS_PLACE && !PLACE => rest,
            Some(effect) if S::LONG => called_action(effect, motion) + rest,
            Some(effect) => acted(effect, motion) + rest,
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

    fn follows_phi(&self) -> bool {
        (H::Effect::FOLLOWS_PHI && self.0.active().is_some()) || self.1.follows_phi()
    }

    fn follows_place(&self) -> bool {
        (H::Effect::FOLLOWS_PLACE && self.0.active().is_some()) || self.1.follows_place()
    }

    fn needs_gamma(&self) -> bool {
        self.0.active().is_some_and(Effect::needs_gamma) || self.1.needs_gamma()
    }

    fn push(&self) -> bool {
        (H::Effect::PUSHES && self.0.active().is_some()) || self.1.push()
    }

    fn works(&self) -> bool {
        self.0.active().is_some_and(Effect::works) || self.1.works()
    }

    fn acts(&self, name: &str) -> bool {
        (H::Effect::NAME == name && self.0.active().is_some()) || self.1.acts(name)
    }

    fn check(&self) -> Result<(), Invalid> {
        if let Some(effect) = self.0.active() {
            for row in H::Effect::ROWS {
                if let Access::Parameter { get, .. } = row.access {
                    row.meta.check(|| full_name::<H>(row.meta.name), get(effect))?;
                }
            }
            let within = |invalid: Invalid| Invalid { variable: full_name::<H>(&invalid.variable), ..invalid };
            effect.check().map_err(within)?;
            if let Some(other) = H::Effect::EXCLUDES.iter().find(|name| self.1.acts(name)) {
                return Err(Invalid::excluded(switch_of::<H>(), &format!("effects.{other}")));
            }
        }
        self.1.check()
    }

    fn begin(&mut self, start: &Kinematics<f64>) {
        self.0.effect_mut().begin(start);
        self.1.begin(start);
    }

    #[inline(always)]
    fn meta(place: Place) -> Option<&'static Meta> {
        if is_switch::<H>(place) {
            return Some(&SWITCH);
        }
        row::<H>(place).map_or_else(|| T::meta(place), |row| row.map(|row| &row.meta))
    }

    fn name(place: Place) -> Option<String> {
        if is_switch::<H>(place) {
            return Some(switch_of::<H>());
        }
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
        if is_switch::<H>(place) {
            return Some(f64::from(self.0.active().is_some()));
        }
        let access = &row?.access;
        match (self.0.active(), access) {
            (None, Access::Output(_) | Access::Rate(_)) => Some(0.0),
            _ => access.value(self.0.effect(), t, motion, rates),
        }
    }

    fn set_parameter(&mut self, place: Place, value: f64) -> bool {
        if is_switch::<H>(place) {
            self.0.switch(value != 0.0);
            return true;
        }
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

    fn change_input(&mut self, place: Place, order: u32, t: f64, change: impl FnOnce(&mut Signal)) -> Option<bool> {
        let Some(row) = row::<H>(place) else { return self.1.change_input(place, order, t, change) };
        let Access::Input { get, get_mut } = row?.access else { return None };
        let effect = self.0.effect_mut();
        let before = effect.clone();
        change(get_mut(effect));
        let was = *get(&before);
        let goes_on = get(effect).goes_on_like(&was);
        let changes = effect.input_set(&before, InputSet { row: place.row, order, t, goes_on });
        if !changes {
            *get_mut(effect) = get(effect).going_on(was);
        }
        Some(changes)
    }

    fn step_to(&mut self, end: &Kinematics<f64>) {
        if self.0.active().is_some() {
            self.0.effect_mut().step_to(end);
        }
        self.1.step_to(end);
    }

    fn extrapolates(&self) -> bool {
        (H::Effect::EXTRAPOLATES && self.0.active().is_some()) || self.1.extrapolates()
    }

    fn step_from(&mut self, t: f64) {
        if self.0.active().is_some() {
            self.0.effect_mut().step_from(t);
        }
        self.1.step_from(t);
    }

    fn extrapolate(&mut self, number: usize, signal: &mut Signal) {
        if self.0.active().is_some() {
            self.0.effect_mut().extrapolate(number, signal);
        }
        self.1.extrapolate(number, signal);
    }

    fn for_each_extrapolated(&mut self, act: &mut impl FnMut(&mut Signal)) {
        if !H::Effect::TELLS_RATES {
            each_signal(self.0.effect_mut(), act);
        }
        self.1.for_each_extrapolated(act);
    }

    fn for_each_signal(&mut self, act: &mut impl FnMut(&mut Signal)) {
        each_signal(self.0.effect_mut(), act);
        self.1.for_each_signal(act);
    }

    fn hear(&mut self, other: &Self) {
        for row in H::Effect::ROWS {
            if let Access::Input { get, get_mut } = row.access {
                *get_mut(self.0.effect_mut()) = *get(other.0.effect());
            }
        }
        self.0.effect_mut().take_over(other.0.effect());
        self.1.hear(&other.1);
    }

    fn switch_on(&mut self, block: u32) {
        if block == block_of::<H>() {
            self.0.switch(true);
        }
        self.1.switch_on(block);
    }
}

/// How many inputs of an effect may be extrapolated.
const fn inputs_extrapolated<E: Effect>() -> usize {
    let (mut row, mut inputs) = (0, 0);
    while row < E::ROWS.len() && !E::TELLS_RATES {
        inputs += matches!(E::ROWS[row].access, Access::Input { .. }) as usize;
        row += 1;
    }
    inputs
}

fn each_signal<E: Effect>(effect: &mut E, act: &mut impl FnMut(&mut Signal)) {
    for row in E::ROWS {
        if let Access::Input { get_mut, .. } = row.access {
            act(get_mut(effect));
        }
    }
}
