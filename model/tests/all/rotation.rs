//! The split rotation: its matrices against quaternions and Rodrigues' formula by libm, its closed forms against the
//! paper's equations, and the angle that keeps whole turns apart against 2π to 100 places.

use crate::harness::{Random, largest, properties, within};
use nalgebra::{Matrix3, Vector2, Vector3};
use oracles::fixed::Fixed;
use oracles::numerics::derivative;
use oracles::rotation as exact;
use proptest::prelude::*;
use split_rotor_model::rotation::euler_vector::{inverse_rate, rate, rotation};
use split_rotor_model::rotation::{Angle, Chart, Tilt, Turn, Winding};
use std::f64::consts::{PI, TAU};

/// Cases of each property.
const CASES: u32 = 500;

/// Euler vectors of every direction, |ϑ| from 1e-12 to π [rad].
fn euler_vectors() -> impl Iterator<Item = Vector3<f64>> {
    (0..400).map(|i| {
        let part = (f64::from(i) + 0.5) / 400.0;
        let angle = if i % 4 == 0 { PI * libm::pow(10.0, -12.0 * part) } else { PI * part };
        // Spread over the sphere by the golden angle.
        let (height, azimuth) = (1.0 - 2.0 * (f64::from(i) * 0.618_033_988_749_894_9 % 1.0), 2.399_963 * f64::from(i));
        let radius = (1.0 - height * height).sqrt();
        Vector3::new(height, radius * libm::cos(azimuth), radius * libm::sin(azimuth)) * angle
    })
}

/// LᵀL − I, and its columns right-handed [1]: measured 2.1e-15.
const ORTHOGONAL: f64 = 5e-15;
/// L against Rodrigues by libm and against quaternions [1]: measured 1.3e-15.
const RODRIGUES: f64 = 4e-15;

/// γ of the tilt, from e, as an Euler vector [rad].
fn euler_vector(tilt: &Tilt<f64>) -> Vector3<f64> {
    let gamma = tilt.gamma();
    Vector3::new(0.0, gamma.x, gamma.y)
}

#[test]
fn exact_rotation_is_that_of_rodrigues() {
    let (mut orthogonal, mut rodrigues) = (0.0_f64, 0.0_f64);
    for a in euler_vectors().chain([Vector3::zeros(), Vector3::new(0.0, f64::from_bits(1), 0.0)]) {
        let l = rotation(&a);
        orthogonal = largest([
            orthogonal,
            (l.transpose() * l - Matrix3::identity()).amax(),
            (l.column(0).cross(&l.column(1)) - l.column(2)).amax(),
        ]);
        let (one, other) = (l - exact::rodrigues(&a), l - exact::matrix(exact::quaternion(&a)));
        rodrigues = largest([rodrigues, one.amax(), other.amax()]);
    }
    within("orthogonal", orthogonal, ORTHOGONAL);
    within("Rodrigues", rodrigues, RODRIGUES);
}

/// L(a)·L(b) against Hamilton's product [1]: measured 1.8e-15.
const COMPOSITION: f64 = 5e-15;

#[test]
fn exact_rotations_compose_as_quaternions_do() {
    let all: Vec<_> = euler_vectors().collect();
    let mut worst = 0.0;
    for (a, b) in all.iter().zip(all.iter().rev()) {
        let product = exact::matrix(exact::product(exact::quaternion(a), exact::quaternion(b)));
        worst = largest([worst, (rotation(a) * rotation(b) - product).amax()]);
    }
    within("composition", worst, COMPOSITION);
}

/// B against the derivative of Rodrigues' matrix [1]: measured 5.2e-14, the rounding of the extrapolation.
const RATE: f64 = 1.5e-13;
/// B·B⁻¹ − I [1], |ϑ| ≤ π: measured 8.1e-16.
const INVERSE: f64 = 3e-15;

#[test]
fn exact_rate_matrix_is_the_derivative_of_the_rotation() {
    let (mut against_derivative, mut inverse) = (0.0, 0.0);
    for (a, direction) in euler_vectors().zip(euler_vectors().skip(7).map(|v| v.normalize())) {
        // L̇ Lᵀ = ω×, with ϑ̇ along `direction`.
        let rotated = |s: f64| <[f64; 9]>::try_from(exact::rodrigues(&(a + direction * s)).as_slice()).unwrap();
        let l_rate = Matrix3::from_column_slice(&derivative(rotated, 0.0, 0.3));
        let spin = l_rate * exact::rodrigues(&a).transpose();
        let omega = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        against_derivative = largest([against_derivative, (rate(&a) * direction - omega).amax()]);
        inverse = largest([
            inverse,
            (rate(&a) * inverse_rate(&a) - Matrix3::identity()).amax(),
            (inverse_rate(&a) * rate(&a) - Matrix3::identity()).amax(),
        ]);
    }
    within("B", against_derivative, RATE);
    within("B times its inverse", inverse, INVERSE);
}

/// A transverse Euler vector of tilt up to 3.1 rad, denser near both ends.
fn attitudes() -> impl Strategy<Value = Vector2<f64>> {
    let theta = prop_oneof![0.0..3.1_f64, (-12.0..0.0_f64).prop_map(|p| libm::pow(10.0, p)), 3.0..3.1_f64];
    (theta, 0.0..TAU).prop_map(|(theta, psi)| Vector2::new(libm::cos(psi), libm::sin(psi)) * theta)
}

fn omegas() -> impl Strategy<Value = Vector3<f64>> {
    [-100.0..100.0_f64, -100.0..100.0_f64, -100.0..100.0_f64].prop_map(Vector3::from)
}

/// The axis against L(γ)e, and its length against 1 [1]: measured 2.2e-15.
const AXIS: f64 = 6e-15;
/// ω_φ and dγ/dt against the paper's equations, relative to |ω|/cos(θ/2), the singular point's own loss [1]:
/// measured 4.0e-15.
const CLOSED_FORMS: f64 = 1.2e-14;
/// ω_φ against ω·n, relative to |ω|/cos²(θ/2), and ω of both rates, relative to |ω|/cos(θ/2) [1]: measured 1.1e-15.
const SPLIT_RATES: f64 = 4e-15;

proptest! {
    #![proptest_config(properties(CASES))]

    #[test]
    fn exact_axis_is_the_rotated_e(gamma in attitudes()) {
        let tilt = Tilt::new(Chart::FromE, gamma);
        let error = largest([
            (tilt.axis - rotation(&euler_vector(&tilt)) * Vector3::x()).amax(),
            (tilt.axis - exact::axis(&gamma)).amax(),
            (tilt.axis.norm() - 1.0).abs(),
            (tilt.axis - exact::attitude(1.234, &gamma).column(0)).amax(),
        ]);
        within("axis", error, AXIS);
        prop_assert_eq!(tilt.gamma(), gamma);
    }

    #[test]
    fn literature_closed_forms_are_the_papers_equations(gamma in attitudes(), omega in omegas()) {
        let tilt = Tilt::new(Chart::FromE, gamma);
        // The paper's (8) and (6), with its matrices: eq. 5 and eq. 7.
        let inverse = inverse_rate(&euler_vector(&tilt));
        let omega_phi = (inverse * omega).x / (inverse * rotation(&euler_vector(&tilt)) * Vector3::x()).x;
        let gamma_rate = inverse * (omega - rotation(&euler_vector(&tilt)) * Vector3::x() * omega_phi);
        let scale = omega.norm() / libm::cos(0.5 * gamma.norm());
        within("omega_phi", (tilt.axial_rate(&omega) - omega_phi).abs() / scale, CLOSED_FORMS);
        within("dgamma/dt", (tilt.gamma_rate(&omega) - gamma_rate.yz()).amax() / scale, CLOSED_FORMS);
        within("dgamma/dt along e", gamma_rate.x.abs() / scale, CLOSED_FORMS);
    }

    #[test]
    fn exact_rates_turn_the_attitude_at_omega(gamma in attitudes(), omega in omegas()) {
        // By libm alone: ω of the rates is ω_φ t + B dγ/dt; and ω_φ is ω·(e + t)/(1 + e·t).
        let (tilt, t) = (Tilt::new(Chart::FromE, gamma), exact::axis(&gamma));
        let scale = omega.norm() / libm::cos(0.5 * gamma.norm());
        let bisector = omega.dot(&(Vector3::x() + t)) / (1.0 + t.x);
        let loss = scale / libm::cos(0.5 * gamma.norm());
        within("omega·n", (tilt.axial_rate(&omega) - bisector).abs() / loss, SPLIT_RATES);
        let gamma_rate = tilt.gamma_rate(&omega);
        let spin = rate(&euler_vector(&tilt)) * Vector3::new(0.0, gamma_rate.x, gamma_rate.y) + t * tilt.axial_rate(&omega);
        within("omega", (spin - omega).amax() / scale, SPLIT_RATES);
    }
}

/// Error of the wrapped angle [rad], up to 10⁶ turns: measured 6.9e-16, less than an ulp of 2π.
const WRAPPED: f64 = 2e-15;

/// |2π turns + remainder of `wrapped` − the same of `angle`| [rad], exactly.
fn wrap_error(angle: Angle, wrapped: Angle) -> f64 {
    let turns = Fixed::whole((wrapped.turns - angle.turns) as i64);
    let moved = &(&turns * &Fixed::tau_circle()) + &Fixed::of(wrapped.remainder);
    (&moved - &Fixed::of(angle.remainder)).abs().to_f64()
}

fn assert_wrapped(angle: Angle) -> f64 {
    let wrapped = angle.wrapped();
    assert!((0.0..TAU).contains(&wrapped.remainder), "{angle:?} gives {wrapped:?}");
    assert_eq!(wrapped.turns, wrapped.turns.floor(), "{angle:?}");
    assert_eq!(wrapped.wrapped(), wrapped, "wrapping {angle:?} twice");
    wrap_error(angle, wrapped)
}

#[test]
fn exact_angle_survives_a_million_turns() {
    let mut worst = 0.0;
    for i in 0..4000 {
        // Up to ±10⁶ turns, and a whole number of them within an ulp or so.
        let turns = (f64::from(i) * 0.618_033_988_749_894_9 % 1.0 - 0.5) * 2e6;
        for remainder in [turns * TAU, turns.round() * TAU, (turns.round() * TAU).next_up()] {
            worst = largest([worst, assert_wrapped(Angle { turns: 3.0, remainder })]);
        }
    }
    within("wrapped angle", worst, WRAPPED);
}

/// Mean drift of one wrap [rad]: measured 8.6e-19. A 2π without its third part would drift by 2.4e-16 a turn.
const DRIFT: f64 = 3e-18;

#[test]
fn exact_angle_does_not_drift() {
    // Wraps of a bit less than a turn each, as a run makes them; what each addition rounds is known and left out.
    let (mut angle, mut exact_sum) = (Angle::default(), Fixed::whole(0));
    for i in 0..20_000 {
        let step = 5.0 + 1e-3 * f64::from(i % 1000);
        let sum = angle.remainder + step;
        exact_sum = &exact_sum + &(&Fixed::of(sum) - &Fixed::of(angle.remainder));
        angle = Angle { remainder: sum, ..angle }.wrapped();
    }
    let reached = &(&Fixed::whole(angle.turns as i64) * &Fixed::tau_circle()) + &Fixed::of(angle.remainder);
    within("drift a wrap", (&reached - &exact_sum).abs().to_f64() / 20_000.0, DRIFT);
}

#[test]
fn exact_angle_at_the_edges() {
    let neighbours = [TAU.next_down(), TAU, TAU.next_up(), 2.0 * TAU, (2.0 * TAU).next_up(), (2.0 * TAU).next_down()];
    let small = [0.0, f64::from_bits(4), 1e-300, 1e-16, 1e-15, 1.0];
    let mut worst = 0.0;
    for x in neighbours.into_iter().chain(small) {
        for remainder in [x, -x] {
            worst = largest([worst, assert_wrapped(Angle { turns: -2.0, remainder })]);
        }
    }
    within("wrapped at the edges", worst, WRAPPED);
    // Where rounding gives 2π: 0 and one turn more.
    let tiny = Angle { turns: 0.0, remainder: -1e-300 };
    assert_eq!(tiny.wrapped(), Angle { turns: 0.0, remainder: 0.0 });
    assert_eq!(Angle { turns: 4.0, remainder: TAU }.wrapped(), Angle { turns: 5.0, remainder: 0.0 });
    assert_eq!(Angle { turns: 4.0, remainder: TAU.next_down() }.wrapped().turns, 4.0);
    assert_eq!(Angle { turns: 0.0, remainder: -1.0 }.wrapped().turns, -1.0);
    assert_eq!(Angle { turns: 1.0, remainder: 0.25 }.radians(), TAU + 0.25);
}

/// γ and φ after 30 turns at once and one by one [rad]: measured 1.4e-13, where the axis passes near an end of its chart.
const WOUND: f64 = 1e-12;

/// Many turns of any length, one arc tangent for all: as one by one, in either chart, with every whole turn.
#[test]
fn exact_winding_of_many_turns() {
    let (mut random, mut worst) = (Random(5), [0.0_f64; 2]);
    for case in 0..300 {
        let chart = [Chart::FromE, Chart::FromMinusE][case % 2];
        let mut any = |most: f64| random.within(-most, most);
        let start = Tilt::new(chart, Vector2::new(any(1.0), any(1.0)));
        let (mut tilt, mut axis) = (start, start.axis);
        let (mut phi, mut turns, mut windings) = (0.0, 0.0, [Winding::none(); 2]);
        for _ in 0..30 {
            let most = if case % 3 == 0 { 12.0 } else { 1.0 };
            let rho = Vector3::new(any(most), any(most), any(most));
            let turn = Turn::about(rho);
            let turned = tilt.turned(&turn);
            (phi, turns) = (phi + turned.phi, turns + turned.turns);
            windings[0].turn(&turn, &(axis * chart.sign()));
            windings[1].turn(&turn, &axis);
            axis = turn.carried(&axis);
            tilt = Tilt::new(chart, turned.gamma);
        }
        let along = Tilt::<f64>::along(chart, axis);
        let ends = [start, along].map(|tilt| tilt.gamma_in_chart());
        let (wound, whole) = windings[0].advances(&windings[1], chart, ends);
        let near = 1.0 + chart.sign() * axis.x;
        worst[0] = worst[0].max((ends[1] - tilt.gamma_in_chart()).norm() * near);
        worst[1] = worst[1].max(((wound - phi) + TAU * (whole - turns)).abs() * near);
    }
    within("gamma", worst[0], WOUND);
    within("phi", worst[1], WOUND);
}
