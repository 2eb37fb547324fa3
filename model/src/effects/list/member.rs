//! An entry of a list of effects, with or without a switch, and its place among the variables.

use super::super::{
    Acting, Doubt, Effect, Entry, Exchange, Facts, InputSet, Law, MOST_DOUBTS, MOST_OWN, Motion, Row, rows,
};
use super::block::Hooks;
use super::{Block, Kind, Tangent};
use crate::body::Shape;
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::Rates;
use crate::stored::{Damaged, Stored, Walk};
#[cfg(feature = "scenes")]
use crate::traced::Traced;
use crate::variable::{Access, Place, Role};

/// An effect that a scene calls for; `INDEX` counts from 1 where there are several of its kind.
#[derive(Clone, Default)]
pub struct Called<E, const INDEX: u32 = 1>(E);

impl<E, const INDEX: u32> From<E> for Called<E, INDEX> {
    fn from(effect: E) -> Self {
        Self(effect)
    }
}

/// The effects of a scene as a list: `effects![gravity, left => 1, right => 2]`, the number telling which of its kind an effect is.
#[macro_export]
macro_rules! effects {
    () => { () };
    ($effect:expr $(=> $index:literal)? $(, $($rest:tt)*)?) => {
        ($crate::effects::Called::<_, { 1 $(* $index)? }>::from($effect), $crate::effects!($($($rest)*)?))
    };
}

/// An effect behind a switch; off at first.
#[derive(Clone, Default)]
pub struct Switched<E, const INDEX: u32> {
    on: bool,
    effect: E,
}

/// An entry of a list of effects.
pub trait Member: Block + Clone + Default + Send + Stored + 'static {
    /// Its law.
    type Effect: Entry;
    /// Counts from 1 where there are several of its kind.
    const INDEX: u32;
    /// Whether it has a switch.
    const SWITCHED: bool;
    /// Its law, unless it is switched off.
    fn active(&self) -> Option<&Self::Effect>;
    /// Its law and parameters.
    fn effect(&self) -> &Self::Effect;
    /// Its law and parameters.
    fn effect_mut(&mut self) -> &mut Self::Effect;
    /// Switches it, where it has a switch.
    fn set_on(&mut self, on: bool);
    /// What it is.
    const KIND: Kind = Kind {
        name: Self::Effect::NAME,
        several: Self::Effect::SEVERAL,
        index: Self::INDEX,
        block: Place::effect_block(Self::Effect::NUMBER, Self::INDEX),
        switch: Self::Effect::SWITCH,
        facts: {
            let facts = Self::Effect::FACTS;
            let extrapolated = if facts.tells_rates { 0 } else { inputs::<Self::Effect>() };
            let follows_phi = facts.follows_phi || facts.shapes;
            Facts { switched: Self::SWITCHED, extrapolated, follows_phi, ..facts }
        },
        excludes: Self::Effect::EXCLUDES,
        meta: |number| row::<Self::Effect>(number).map(|row| &row.meta),
    };
}

impl<E: Entry, const INDEX: u32> Member for Called<E, INDEX> {
    type Effect = E;
    const INDEX: u32 = INDEX;
    const SWITCHED: bool = false;

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

    fn set_on(&mut self, _on: bool) {}
}

impl<E: Entry, const INDEX: u32> Member for Switched<E, INDEX> {
    type Effect = E;
    const INDEX: u32 = INDEX;
    const SWITCHED: bool = true;

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

    fn set_on(&mut self, on: bool) {
        self.on = on;
    }
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
    for (_, row) in rows::<E>() {
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
    effect.memory().iter_mut().try_for_each(|number| number.walk(walk))?;
    if effect.restored() { Ok(()) } else { Err(Damaged) }
}

/// How many inputs an effect has, beside those of a housing.
const fn inputs<E: Effect>() -> usize {
    let (mut row, mut inputs) = (0, 0);
    while row < E::ROWS.len() {
        inputs += matches!(E::ROWS[row].access, Access::Input { .. }) as usize;
        row += 1;
    }
    inputs
}

/// The variable in this row.
fn row<E: Effect>(number: usize) -> Option<&'static Row<E>> {
    let of_housing = || E::HOUSING.get(number.checked_sub(Place::HOUSING)?);
    E::ROWS.get(number).or_else(of_housing)
}

fn access<E: Effect>(number: usize) -> Option<&'static Access<E, super::super::Seen>> {
    row::<E>(number).map(|row| &row.access)
}

/// An effect of which an input was changed, and whether that changes how anything goes on.
fn changed<E: Effect>(before: &E, set: InputSet, change: &dyn Fn(&mut Signal)) -> Option<(E, bool)> {
    let Access::Input { get, get_mut } = access::<E>(set.row)? else { return None };
    let mut effect = before.clone();
    change(get_mut(&mut effect));
    let was = *get(before);
    let changes = effect.input_set(before, InputSet { goes_on: get(&effect).goes_on_like(&was), ..set });
    if !changes {
        *get_mut(&mut effect) = get(&effect).going_on(was);
    }
    Some((effect, changes))
}

macro_rules! forwarded {
    (
        $(fn $asked:ident($($of:ident: $type:ty),*) $(-> $answer:ty)?;)*
        mut:
        $(fn $told:ident($($with:ident: $what:ty),*) $(-> $result:ty)?;)*
    ) => {
        impl<M: Member> Hooks for M {
            $(fn $asked(&self, $($of: $type),*) $(-> $answer)? {
                self.effect().$asked($($of),*)
            })*
            $(fn $told(&mut self, $($with: $what),*) $(-> $result)? {
                self.effect_mut().$told($($with),*)
            })*
        }
    };
}

hooks!(forwarded);

impl<M: Member> Block for M {
    fn kind(&self) -> &'static Kind {
        const { &M::KIND }
    }

    fn is_active(&self) -> bool {
        self.active().is_some()
    }

    fn switch_to(&mut self, on: bool) {
        self.set_on(on);
    }

    fn check(&self) -> Result<(), Invalid> {
        let effect = self.effect();
        for (_, row) in rows::<M::Effect>() {
            if let Access::Parameter { get, .. } = row.access {
                row.meta.check(|| M::KIND.full_name(row.meta.name), get(effect))?;
            }
        }
        let within = |invalid: Invalid| Invalid { variable: M::KIND.full_name(&invalid.variable), ..invalid };
        effect.check().map_err(within)
    }

    fn for_each_signal(&mut self, act: &mut dyn FnMut(&mut Signal)) {
        for (_, row) in rows::<M::Effect>() {
            if let Access::Input { get_mut, .. } = row.access {
                act(get_mut(self.effect_mut()));
            }
        }
    }

    fn asks_rates(&self, row: usize) -> bool {
        matches!(access::<M::Effect>(row), Some(Access::Rate(_)))
    }

    fn value(&self, row: usize, t: f64, motion: Option<&Motion<f64>>, rates: Option<&Rates<f64>>) -> Option<f64> {
        if M::SWITCHED && row == Place::SWITCH {
            return Some(f64::from(self.is_active()));
        }
        let access = access::<M::Effect>(row)?;
        if !self.is_active() && access.is_calculated() {
            return Some(0.0);
        }
        access.value(self.effect(), t, motion, rates)
    }

    fn tangent(&self, row: usize, motion: &Motion<Tangent>, rates: Option<&Rates<Tangent>>) -> Option<Tangent> {
        let access = access::<M::Effect>(row)?;
        match self.active() {
            Some(effect) => access.tangent(effect, motion, rates),
            None => access.is_calculated().then(|| Tangent::constant(0.0)),
        }
    }

    #[cfg(feature = "scenes")]
    fn traced(&self, row: usize, motion: &Motion<Traced>, rates: &Rates<Traced>) -> Option<Traced> {
        let access = access::<M::Effect>(row)?;
        match self.active() {
            Some(effect) => access.traced(effect, motion, rates),
            None => access.is_calculated().then(|| Traced::constant(0.0)),
        }
    }

    fn own_state(&self, row: usize) -> Option<usize> {
        let is_state = |row: &&Row<M::Effect>| matches!((row.meta.role, &row.access), (Role::State, Access::Output(_)));
        M::Effect::ROWS.get(row).filter(is_state).map(|_| M::Effect::ROWS[..row].iter().filter(is_state).count())
    }

    fn set_parameter(&mut self, row: usize, value: f64) -> bool {
        if M::SWITCHED && row == Place::SWITCH {
            self.set_on(value != 0.0);
            return true;
        }
        let Some(Access::Parameter { set, .. }) = access::<M::Effect>(row) else { return false };
        set(self.effect_mut(), value);
        true
    }

    fn signal(&self, row: usize) -> Option<&Signal> {
        let Access::Input { get, .. } = access::<M::Effect>(row)? else { return None };
        Some(get(self.effect()))
    }

    fn signal_mut(&mut self, row: usize) -> Option<&mut Signal> {
        let Access::Input { get_mut, .. } = access::<M::Effect>(row)? else { return None };
        Some(get_mut(self.effect_mut()))
    }

    fn change_input(&mut self, set: InputSet, change: &dyn Fn(&mut Signal)) -> Option<bool> {
        let (effect, changes) = changed(self.effect(), set, change)?;
        *self.effect_mut() = effect;
        Some(changes)
    }

    fn would_change(&self, set: InputSet, change: &dyn Fn(&mut Signal)) -> Option<bool> {
        changed(self.effect(), set, change).map(|(_, changes)| changes)
    }
}
