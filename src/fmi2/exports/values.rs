//! Reading and setting variables, and directional derivatives (FMI 2.0.4, sections 2.1.7 and 2.1.9).

use crate::arguments::{room, values};
use crate::fmi2::abi::*;
use crate::instance::Type;

export! {
    /// Reads variables of type Real.
    fmi2GetReal(instance, vr: *const ValueReference, n: Size, value: *mut Real) {
        instance.get_real(values(vr, n, "vr")?, room(value, n, "value")?)
    }

    /// Reads variables of type Integer.
    fmi2GetInteger(instance, vr: *const ValueReference, n: Size, value: *mut Integer) {
        instance.get(values(vr, n, "vr")?, room(value, n, "value")?, Type::Integer, |value| value as Integer)
    }

    /// Reads variables of type Boolean, the switches.
    fmi2GetBoolean(instance, vr: *const ValueReference, n: Size, value: *mut Boolean) {
        instance.get(values(vr, n, "vr")?, room(value, n, "value")?, Type::Boolean, |value| (value != 0.0).into())
    }

    /// Reads variables of type String, of which there are none.
    fmi2GetString(instance, vr: *const ValueReference, n: Size, _value: *mut Text) {
        instance.no_strings(values(vr, n, "vr")?)
    }

    /// Sets parameters and inputs of type Real.
    fmi2SetReal(instance, vr: *const ValueReference, n: Size, value: *const Real) {
        instance.set(values(vr, n, "vr")?, values(value, n, "value")?, Type::Real, |value| *value)
    }

    /// Sets parameters of type Integer.
    fmi2SetInteger(instance, vr: *const ValueReference, n: Size, value: *const Integer) {
        instance.set(values(vr, n, "vr")?, values(value, n, "value")?, Type::Integer, |value| f64::from(*value))
    }

    /// Sets parameters of type Boolean, the switches.
    fmi2SetBoolean(instance, vr: *const ValueReference, n: Size, value: *const Boolean) {
        instance.set(values(vr, n, "vr")?, values(value, n, "value")?, Type::Boolean, |value| f64::from(*value != FALSE))
    }

    /// Sets parameters of type String, of which there are none.
    fmi2SetString(instance, vr: *const ValueReference, n: Size, _value: *const Text) {
        instance.no_strings(values(vr, n, "vr")?)
    }

    /// How unknown variables change as known ones change by their seeds.
    fmi2GetDirectionalDerivative(
        instance, unknown: *const ValueReference, n_unknown: Size, known: *const ValueReference, n_known: Size,
        seed: *const Real, sensitivity: *mut Real
    ) {
        instance.directional_derivative(
            values(unknown, n_unknown, "vUnknown_ref")?,
            values(known, n_known, "vKnown_ref")?,
            values(seed, n_known, "dvKnown")?,
            room(sensitivity, n_unknown, "dvUnknown")?,
        )
    }
}
