//! Every variable is in the unit that it declares: the same rotor in other units shows the same in these.

use crate::dependencies_of_draws::somewhere;
use crate::harness::Random;
use crate::harness::named::{Named, names};
use split_rotor_model::simulation::Integrator;
use split_rotor_model::variable::Kind;
use split_rotor_model::variable::units::Unit;
use split_rotor_model::variables::Variable;
use std::collections::BTreeSet;

/// So many rotors and motions are drawn of each scene.
const SAMPLES: usize = 8;

/// A kilogram, a metre and a second are so many of the other units, as powers of two: nothing is rounded otherwise.
const OTHERS: [i32; 3] = [13, 1, 5];

/// The other units in one of this kind.
fn factor(unit: &Unit) -> f64 {
    let power: i32 = OTHERS.iter().zip(unit.exponents).map(|(power, exponent)| power * i32::from(exponent)).sum();
    libm::ldexp(1.0, power)
}

#[test]
fn exact_every_variable_is_in_the_unit_that_it_declares() {
    let (mut random, mut shown, mut never) = (Random(29), BTreeSet::new(), BTreeSet::new());
    for name in names() {
        for _ in 0..SAMPLES {
            let (mut one, mut other) = (somewhere(&name, &mut random), Named::new(&name, Integrator::Host));
            let variables = one.scene.variables.clone();
            let of =
                |variable: &Variable| if variable.meta.kind == Kind::Real { factor(variable.meta.unit) } else { 1.0 };
            for variable in variables.iter().filter(|variable| variable.meta.has_start()) {
                other.set(&variable.name, one.at(variable.place) * of(variable));
            }
            for variable in variables.iter().filter(|variable| !variable.meta.has_start()) {
                let [value, again] = [one.at(variable.place) * of(variable), other.at(variable.place)];
                assert!(
                    value == again,
                    "{name}: {} [{}]: {value:e}, {again:e}",
                    variable.name,
                    variable.meta.unit.name
                );
                if value == 0.0 { &mut never } else { &mut shown }.insert(variable.name.clone());
            }
        }
    }
    let never: Vec<_> = never.difference(&shown).collect();
    println!("{} variables, and these are 0 at the start: {never:?}", shown.len());
    assert!(shown.len() > 100);
}
