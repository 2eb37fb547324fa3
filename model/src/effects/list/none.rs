//! The end of a list: no effect.

use super::super::Wrench;
use super::{Action, Effects};
use crate::body::Shape;
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::state::{Kinematics, Whole};
use crate::stored::{Damaged, Stored, Walk};
use crate::variable::{Meta, Place, Readable};

impl Stored for () {
    fn walk(&mut self, _walk: &mut impl Walk) -> Result<(), Damaged> {
        Ok(())
    }
}

impl Effects for () {
    const SWITCHED: bool = false;
    const COULD_WORK: bool = false;
    const SHAPES: bool = false;
    const FOLLOWS_PHI: bool = false;
    const IMPOSES: bool = false;
    const EXTRAPOLATED: usize = 0;
    const MOST_EXTRAPOLATED: usize = usize::MAX;

    #[inline(always)]
    fn imposed<S: Scalar>(&self, _t: S) -> Option<[S; 2]> {
        None
    }

    fn shape(&self, _body: &mut Shape) {}

    #[inline(always)]
    fn load_of<S: Scalar, const PLACE: bool>(&self, _motion: &Kinematics<S>) -> Wrench<S> {
        Wrench::zero()
    }

    #[inline(always)]
    fn action_of<S: Scalar, const PLACE: bool>(&self, _motion: &Kinematics<S>) -> Action<S> {
        Action { load: Wrench::zero(), damping: Wrench::zero(), supply: S::zero(), loss: S::zero() }
    }

    #[inline(always)]
    fn potential<S: Scalar>(&self, _motion: &Kinematics<S>) -> S {
        S::zero()
    }

    fn follows_phi(&self) -> bool {
        false
    }

    fn follows_place(&self) -> bool {
        false
    }

    fn needs_gamma(&self) -> bool {
        false
    }

    fn push(&self) -> bool {
        false
    }

    fn works(&self) -> bool {
        false
    }

    fn acts(&self, _name: &str) -> bool {
        false
    }

    fn check(&self) -> Result<(), Invalid> {
        Ok(())
    }

    fn begin(&mut self, _start: &Kinematics<f64>) {}

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

    fn change_input(&mut self, _place: Place, _order: u32, _t: f64, _change: impl FnOnce(&mut Signal)) -> Option<bool> {
        None
    }

    fn step_to(&mut self, _end: &Kinematics<f64>) {}

    fn extrapolates(&self) -> bool {
        false
    }

    fn step_from(&mut self, _t: f64) {}

    fn extrapolate(&mut self, _number: usize, _signal: &mut Signal) {}

    fn for_each_extrapolated(&mut self, _act: &mut impl FnMut(&mut Signal)) {}

    fn for_each_signal(&mut self, _act: &mut impl FnMut(&mut Signal)) {}

    fn hear(&mut self, _other: &Self) {}

    fn switch_on(&mut self, _block: u32) {}
}
