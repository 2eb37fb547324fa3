//! Random value references, and what the model description says of them.

use super::source::Source;
use crate::harness::{NO_VARIABLE, scene};
use split_rotor::abi::ValueReference;
use split_rotor_model::variable::{Kind, Role};
use split_rotor_model::variables::Variable;
use std::collections::HashMap;
use std::sync::OnceLock;

/// The variable behind a value reference.
pub fn variable(reference: ValueReference) -> Option<&'static Variable> {
    static ALL: OnceLock<HashMap<ValueReference, &'static Variable>> = OnceLock::new();
    let placed = |variable: &'static Variable| (variable.place.value_reference(), variable);
    ALL.get_or_init(|| scene().variables.iter().map(placed).collect()).get(&reference).copied()
}

/// The value reference of some variable that `wanted` likes, if there is one; or now and then of anything or nothing.
pub fn reference(source: &mut Source, wanted: fn(&Variable) -> bool) -> ValueReference {
    if source.chance(12) {
        return source.of(&[NO_VARIABLE, u32::MAX, 0x0600, 0x0fff, 77]);
    }
    let all = &scene().variables;
    let first = usize::from(source.byte()) * 7 % all.len();
    let strict = !source.chance(12);
    let round = all.iter().cycle().skip(first).take(all.len());
    let found = round.into_iter().find(|variable| !strict || wanted(variable));
    found.map_or(NO_VARIABLE, |variable| variable.place.value_reference())
}

/// Up to three of them.
pub fn references(source: &mut Source, wanted: fn(&Variable) -> bool) -> Vec<ValueReference> {
    (0..source.below(4)).map(|_| reference(source, wanted)).collect()
}

pub fn is_real(variable: &Variable) -> bool {
    variable.meta.kind == Kind::Real
}

pub fn is_integer(variable: &Variable) -> bool {
    !is_real(variable) && !is_boolean(variable)
}

pub fn is_boolean(variable: &Variable) -> bool {
    variable.meta.kind == Kind::Boolean
}

pub fn is_parameter(variable: &Variable) -> bool {
    matches!(variable.meta.role, Role::Parameter { .. })
}

pub fn is_input(variable: &Variable) -> bool {
    matches!(variable.meta.role, Role::Input { .. })
}

pub fn is_output(variable: &Variable) -> bool {
    is_real(variable) && matches!(variable.meta.role, Role::Output)
}

/// Whether it is calculated: whether it may be undefined.
pub fn is_calculated(variable: &Variable) -> bool {
    !is_parameter(variable) && !is_input(variable)
}

/// An unknown of fmi2GetDirectionalDerivative: outputs, states and their derivatives.
pub fn is_unknown(variable: &Variable) -> bool {
    is_real(variable) && matches!(variable.meta.role, Role::Output | Role::State)
}

/// A known of fmi2GetDirectionalDerivative: inputs and states.
pub fn is_known(variable: &Variable) -> bool {
    is_input(variable) || matches!(variable.meta.role, Role::State) && !variable.name.starts_with("der(")
}

/// Whether all are there and `right`.
pub fn all_are(references: &[ValueReference], right: fn(&Variable) -> bool) -> bool {
    references.iter().all(|reference| variable(*reference).is_some_and(right))
}

/// A pointer to these, now and then null, and whether it is wrong so; an empty list may be null.
pub fn pointer<T>(source: &mut Source, list: &[T]) -> (*const T, bool) {
    if source.chance(6) { (std::ptr::null(), !list.is_empty()) } else { (list.as_ptr(), false) }
}

/// The same for what is written to.
pub fn place<T>(source: &mut Source, list: &mut [T]) -> (*mut T, bool) {
    if source.chance(6) { (std::ptr::null_mut(), !list.is_empty()) } else { (list.as_mut_ptr(), false) }
}
