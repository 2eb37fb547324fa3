//! What goes into a value, against laws of which it is known.

use nalgebra::Vector3;
use num_traits::Zero;
use split_rotor_model::dual::Tangent;
use split_rotor_model::scalar::Scalar;
use split_rotor_model::traced::Traced;

/// A value that is the source of this number.
fn source(value: f64, number: u32) -> Traced {
    Traced::moving(value, f64::from(number))
}

fn numbers(value: Traced) -> Vec<usize> {
    value.sources().numbers().collect()
}

/// A contact with a gap: nothing while it is open.
fn contact<S: Scalar>(x: S, gap: f64, stiffness: f64) -> S {
    (x.abs() - S::constant(gap)).positive_part().powf(1.5) * S::constant(stiffness)
}

/// A table of speeds and values, flat beyond its ends.
fn table<S: Scalar>(speed: S, [from, to]: [f64; 2], [low, high]: [f64; 2]) -> S {
    let part = (speed - S::constant(from)) / S::constant(to - from);
    let part = part.max(S::zero()).min(S::one());
    S::constant(low) + part * S::constant(high - low)
}

#[test]
fn exact_a_law_that_is_zero_depends() {
    // An open gap, a coefficient of zero, the flat part of a table.
    assert_eq!(contact(Tangent::along(0.1, 1.0), 0.2, 1e6).eps, [0.0]);
    assert_eq!(numbers(contact(source(0.1, 3), 0.2, 1e6)), [3]);
    assert_eq!(numbers(contact(source(0.1, 3), 0.2, 0.0)), [3]);
    assert_eq!(table(Tangent::along(9.0, 1.0), [1.0, 2.0], [5.0, 6.0]).eps, [0.0]);
    assert_eq!(numbers(table(source(9.0, 4), [1.0, 2.0], [5.0, 6.0])), [4]);
    // What is not a number there.
    assert_eq!(numbers(source(0.0, 5) / source(0.0, 7)), [5, 7]);
    assert_eq!(numbers(source(-1.0, 5).sqrt()), [5]);
}

#[test]
fn exact_a_parameter_that_is_no_number_is_followed() {
    let nan = f64::NAN;
    for value in [
        contact(Traced::constant(0.1), nan, 1e6),
        contact(Traced::constant(0.1), 0.2, nan),
        table(Traced::constant(9.0), [nan, 2.0], [5.0, 6.0]),
        table(Traced::constant(9.0), [1.0, 2.0], [5.0, nan]),
        Traced::constant(2.0).powf(nan),
    ] {
        assert_eq!(numbers(value), [0]);
    }
    assert!(contact(Traced::constant(0.1), 0.2, 1e6).sources().is_empty());
}

#[test]
fn exact_every_branch_and_operand_counts() {
    let [a, b, c, d] = [1, 2, 3, 4].map(|number| source(0.5, number));
    assert_eq!(numbers(a.where_less(b, c, d)), [1, 2, 3, 4]);
    for value in [a + b, a - b, a * b, a / b, a.max(b), a.min(b), a.atan2(b)] {
        assert_eq!(numbers(value), [1, 2]);
    }
    for value in [-a, a.sin(), a.cos(), a.exp(), a.tanh(), a.powi(3), a.abs(), a.jumping(1.0), a.with_value(2.0)] {
        assert_eq!(numbers(value), [1]);
    }
}

#[test]
fn exact_what_is_not_there_hides_the_rest() {
    let a = source(0.5, 1);
    assert!((a * Traced::zero()).sources().is_empty());
    assert!((-Traced::zero() / a).sources().is_empty());
    assert_eq!(numbers(a + Traced::zero()), [1]);
    let along_x = Vector3::x() * a;
    assert_eq!([along_x.x, along_x.y, along_x.z].map(numbers), [vec![1], vec![], vec![]]);
}
