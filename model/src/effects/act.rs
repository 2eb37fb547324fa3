//! What an effect does at an instant.

use super::{MOST_OWN, Wrench};
use crate::scalar::Scalar;
use std::ops::Add;

/// What an effect does to the rotor, and what goes with it.
#[derive(Clone, Copy)]
pub struct Act<S: Scalar> {
    /// Force and moment about c [N, N·m], without what damps.
    pub load: Wrench<S>,
    /// Of what damps [N, N·m]: asked for only where some effect [works](super::Effect::works), so that undamped motions do not pay
    /// for it.
    pub damping: Wrench<S>,
    /// Potential energy \[J].
    pub stored: S,
    /// Power that comes from outside \[W].
    pub supply: S,
    /// Power that leaves the mechanics \[W], ≥ 0.
    pub loss: S,
    /// Rates of its own states; those beyond [`super::Facts::own`] do not count.
    pub own: [S; MOST_OWN],
}

impl<S: Scalar> Act<S> {
    /// Nothing: zeros that leave every sum as it is, as in [`Wrench::zero`].
    #[inline(always)]
    pub fn none() -> Self {
        let none = S::constant(-0.0);
        let wrench = Wrench::zero();
        Self { load: wrench, damping: wrench, stored: none, supply: none, loss: none, own: [S::zero(); MOST_OWN] }
    }
}

/// What several effects do together; the rates of their own states are theirs alone.
impl<S: Scalar> Add for Act<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            load: self.load + other.load,
            damping: self.damping + other.damping,
            stored: self.stored + other.stored,
            supply: self.supply + other.supply,
            loss: self.loss + other.loss,
            own: self.own,
        }
    }
}
