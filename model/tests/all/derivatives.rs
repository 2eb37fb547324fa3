//! Dual numbers: the rules of differentiation, and the bits of the values that they carry. Derivatives of the equations of motion
//! against extrapolated differences: `tangents.rs` and `stiff.rs`.

use crate::harness::{Scene, largest, properties, vector, within};
use nalgebra::Vector2;
use proptest::prelude::*;
use split_rotor_model::body::Body;
use split_rotor_model::dual::Dual;
use split_rotor_model::effects::Effects;
use split_rotor_model::integrate::System;
use split_rotor_model::scalar::Scalar;
use split_rotor_model::state::{COORDINATES, WITH_WORK};
use std::f64::consts::TAU;

fn rates(scene: &Scene, y: &[f64; COORDINATES]) -> [f64; COORDINATES] {
    let rotor = scene.rotor();
    if !rotor.effects.works() {
        return System::<COORDINATES>::rates_of_all(&rotor, 0.0, y);
    }
    // What is lost is a quadrature besides, on which no coordinate depends.
    let mut whole = [0.0; WITH_WORK];
    whole[..COORDINATES].copy_from_slice(y);
    let rates = System::<WITH_WORK>::rates_of_all(&rotor, 0.0, &whole);
    std::array::from_fn(|n| rates[n])
}

prop_compose! {
    /// A damped, supported rotor somewhere in its motion, tilted by up to 2.5 rad.
    fn scenes()(
        (r_c, v_c, omega, g) in (vector(1.0), vector(3.0), vector(60.0), vector(10.0)),
        (theta, psi) in (0.0..2.5_f64, 0.0..TAU),
        [c1, c2, d1, d2] in [100.0..3000.0_f64, 10.0..600.0_f64, 0.1..50.0_f64, 0.1..5.0_f64],
        [m, jt, shape, l] in [0.5..8.0_f64, 0.05..0.4_f64, 0.2..2.0_f64, -1.0..1.0_f64],
    ) -> Scene {
        Scene {
            body: Body { m, Ja: shape * jt, Jt: jt, l }, r_c, v_c, omega, g, c1, c2, d1, d2,
            gamma: Vector2::new(libm::cos(psi), libm::sin(psi)) * theta,
            ..Scene::paper()
        }
    }
}

/// Values and derivatives of single operations, relative to the size of their operands [1]: measured 1.6e-16.
const RULES: f64 = 5e-16;

proptest! {
    #![proptest_config(properties(100))]

    #[test]
    fn exact_duals_carry_the_values(scene in scenes()) {
        let y = scene.state();
        let duals: [Dual<COORDINATES>; COORDINATES] = std::array::from_fn(|n| Dual::variable(y[n], n));
        // The same lines in the same order: the same bits.
        prop_assert_eq!(scene.rates(&duals).map(Scalar::re), rates(&scene, &y));
    }

    #[test]
    fn exact_rules_of_differentiation(a in 0.1..50.0_f64, b in -50.0..-0.1_f64) {
        let (x, y) = (Dual::<2>::variable(a, 0), Dual::<2>::variable(b, 1));
        let relative = |dual: Dual<2>, value: f64, by_x: f64, by_y: f64| {
            let size = value.abs() + by_x.abs() + by_y.abs();
            largest([dual.re - value, dual.eps[0] - by_x, dual.eps[1] - by_y].map(f64::abs)) / size
        };
        let root = a.sqrt();
        within("sum", relative(x + y, a + b, 1.0, 1.0), RULES);
        within("difference", relative(x - y, a - b, 1.0, -1.0), RULES);
        within("product", relative(x * y, a * b, b, a), RULES);
        within("quotient", relative(x / y, a / b, 1.0 / b, -a / (b * b)), RULES);
        within("root", relative(Scalar::sqrt(x), root, 0.5 / root, 0.0), RULES);
        within("negative", relative(-y, -b, 0.0, -1.0), RULES);
        // sqrt(x²)/x = 1 with no derivative left; (x/y)·y = x.
        within("x over itself", relative(Scalar::sqrt(x * x) / x, 1.0, 0.0, 0.0), RULES);
        within("x/y·y", relative(x / y * y, a, 1.0, 0.0), RULES);
        let (mut sum, mut product) = (x, x);
        sum += y;
        sum -= x;
        product *= y;
        product /= x;
        within("assigned sum", (sum.re - b).abs() / (a - b), RULES);
        prop_assert_eq!(sum.eps, [0.0, 1.0]);
        within("assigned product", relative(product, b, 0.0, 1.0) / (1.0 + b.abs() / a), RULES);
    }
}
