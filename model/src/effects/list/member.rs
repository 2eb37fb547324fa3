//! An entry of a list of effects, with or without a switch, and its place among the variables.

use super::super::{Effect, Entry, Row, block_name, switch_name};
use crate::stored::{Damaged, Stored, Walk};
use crate::variable::{Access, Place};

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
    /// Whether it has a switch.
    const SWITCHED: bool;
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

    fn switch(&mut self, _on: bool) {}
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

    fn switch(&mut self, on: bool) {
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
    effect.memory().iter_mut().try_for_each(|number| number.walk(walk))?;
    if effect.remembers_rightly() { Ok(()) } else { Err(Damaged) }
}

pub(super) fn full_name<M: Member>(name: &str) -> String {
    format!("{}.{name}", block_name(M::Effect::NAME, M::Effect::SEVERAL, M::INDEX))
}

/// The full name of its switch.
pub(super) fn switch_of<M: Member>() -> String {
    switch_name(M::Effect::NAME, M::Effect::SEVERAL, M::INDEX)
}

/// Whether the place is that of its switch.
#[inline(always)]
pub(super) fn is_switch<M: Member>(place: Place) -> bool {
    M::SWITCHED && place == Place::switch(block_of::<M>())
}

/// The block of value references of a member.
pub(super) const fn block_of<M: Member>() -> u32 {
    Place::effect_block(M::Effect::NUMBER, M::INDEX)
}

/// The row at a place: None where the place is another member's, Some(None) where it is this one's, but holds nothing.
#[allow(clippy::option_option, reason = "two different absences")]
#[inline(always)]
pub(super) fn row<M: Member>(place: Place) -> Option<Option<&'static Row<M::Effect>>> {
    (place.block == block_of::<M>()).then(|| M::Effect::ROWS.get(place.row))
}
