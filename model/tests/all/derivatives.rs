//! Dual numbers: the rules of differentiation, and the Jacobian of the equations of motion against extrapolated
//! differences.

use crate::harness::{Scene, largest, properties, within};
use nalgebra::{Vector2, Vector3};
use oracles::numerics::derivative;
use proptest::prelude::*;
use split_rotor_model::body::Body;
use split_rotor_model::dual::Dual;
use split_rotor_model::effects::Effects;
use split_rotor_model::integrate::System;
use split_rotor_model::scalar::Scalar;
use split_rotor_model::state::{COORDINATES, WITH_WORK};
use std::f64::consts::TAU;

/// ∂(rates)/∂(coordinates) by dual numbers; column j of row i is [i][j].
fn jacobian(scene: &Scene, y: &[f64; COORDINATES]) -> [[f64; COORDINATES]; COORDINATES] {
    let duals: [Dual<COORDINATES>; COORDINATES] = std::array::from_fn(|n| Dual::variable(y[n], n));
    scene.rates(&duals).map(|rate| rate.eps)
}

fn rates(scene: &Scene, y: &[f64; COORDINATES]) -> [f64; COORDINATES] {
    let rotor = scene.rotor();
    if !rotor.effects.works() {
        return System::<COORDINATES>::rates_of_all(&rotor, 0.0, y);
    }
    let mut whole = [0.0; WITH_WORK];
    whole[..COORDINATES].copy_from_slice(y);
    let rates = System::<WITH_WORK>::rates_of_all(&rotor, 0.0, &whole);
    std::array::from_fn(|n| rates[n])
}

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
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

/// Entries of the Jacobian against differences, relative to the largest of their row [1]: measured 2.4e-12, the
/// rounding of the differences.
const JACOBIAN: f64 = 1e-11;

/// Values and derivatives of single operations, relative to the size of their operands [1]: measured 1.6e-16.
const RULES: f64 = 5e-16;

proptest! {
    #![proptest_config(properties(100))]

    #[test]
    fn exact_jacobian_is_the_derivative_of_the_rates(scene in scenes()) {
        let y = scene.state();
        let exact = jacobian(&scene, &y);
        for column in 0..COORDINATES {
            // The scale on which the rates bend: metres, m/s, and the tilt's own.
            let step = if column < 9 { 0.1 } else { 0.05 };
            let difference = derivative(|x| {
                let mut moved = y;
                moved[column] = x;
                rates(&scene, &moved)
            }, y[column], step);
            for row in 0..COORDINATES {
                let size = largest(exact[row].map(f64::abs));
                let error = (exact[row][column] - difference[row]).abs();
                if size == 0.0 { prop_assert_eq!(error, 0.0); } else { within("Jacobian", error / size, JACOBIAN); }
            }
        }
    }

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

/// Entries against those by hand, relative [1]: measured 2.1e-16.
const BY_HAND: f64 = 1e-15;

#[test]
fn exact_jacobian_of_the_upright_rotor() {
    // By hand, at γ = 0, v = 0, spin ω about e, springs unloaded: the linear rotor on its support.
    let scene = Scene { d1: 7.0, d2: 0.3, ..Scene::paper() };
    let (body, j) = (scene.body, jacobian(&scene, &scene.state()));
    // r, v, K, γ at 0, 3, 6, 9. t_y = γ_z, so F_y = −c1(r_y − l γ_z) − d1(v_y − l γ̇_z).
    let close = |what: &str, entry: f64, expected: f64| {
        within(what, (entry - expected).abs() / (1.0 + expected.abs()), BY_HAND);
    };
    close("dF_y/dr_y", j[4][1] * body.m, -scene.c1);
    close("dF_y/dv_y", j[4][4] * body.m, -scene.d1);
    close("dr_y/dv_y", j[1][4], 1.0);
    // ω_z = K_z/Jt + (1/Ja − 1/Jt) K_x t_z, ṫ_y = ω_z t_x − ω_x t_z, t_z = −γ_y.
    close("dv_y/dK_z", j[4][8] * body.m, scene.d1 * body.l / body.Jt);
    close("dF_y/dgamma_z", j[4][10] * body.m, scene.c1 * body.l);
    close("dgamma_y/dK_y", j[9][7], 1.0 / body.Jt);
    close("dphi/dK_x", j[11][6], 1.0 / body.Ja);
    // γ̇_y = ω_y − ω_x γ_z and ω_y = (K_y + …)/Jt with t_y = γ_z: (Ja/Ja − Ja/Jt)ω − ω = −Ja ω/Jt.
    close("dgamma_y/dgamma_z", j[9][10], -body.Ja * 50.0 / body.Jt);
    // The dampers act on dt/dt, which at a given K depends on the tilt across (γ_z) only.
    close("dK_y/dgamma_y, springs", j[7][9] + (scene.c2 + body.l * body.l * scene.c1), 0.0);
}
