//! Machines among the scenes, against what is published of them.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use nalgebra::{Complex, Normed, Vector2};
use split_rotor_model::simulation::Integrator;

/// Of the widest motion, at the tolerance of the scene \[1]: measured 2.2e-8.
const PROGRAM: f64 = 1e-7;

/// Kaschke and Cartarius, Waschmaschine01.m: z̈ + η ż + ω₀² z = −b d²e^(iφ)/dt², φ = Ω t²/2T, with z along their two axes.
fn program(until: f64, steps: u32) -> Complex<f64> {
    let (mass, radius, laundry, stiffness, speed, time) = (10.0, 0.5, 1.0, 4.0 * 4000.0, 75.0, 15.0);
    let b = laundry * radius / (mass + laundry);
    let (eta, square) = (105.0 / (mass + laundry), stiffness / (mass + laundry));
    let rates = |t: f64, [z, v]: [Complex<f64>; 2]| {
        let (phi, rate) = (speed * t * t / 2.0 / time, speed * t / time);
        let turned = Complex::new(libm::cos(phi), libm::sin(phi));
        [v, -v * eta - z * square - turned * Complex::new(-rate * rate, speed / time) * b]
    };
    let along = |[z, v]: [Complex<f64>; 2], [dz, dv]: [Complex<f64>; 2], h: f64| [z + dz * h, v + dv * h];
    let h = until / f64::from(steps);
    // Runge and Kutta's method of order 4
    (0..steps).fold([Complex::default(); 2], |y, step| {
        let t = f64::from(step) * h;
        let k1 = rates(t, y);
        let k2 = rates(t + h / 2.0, along(y, k1, h / 2.0));
        let k3 = rates(t + h / 2.0, along(y, k2, h / 2.0));
        let k4 = rates(t + h, along(y, k3, h));
        [0, 1].map(|i| y[i] + (k1[i] + (k2[i] + k3[i]) * 2.0 + k4[i]) * (h / 6.0))
    })[0]
}

#[test]
fn literature_the_washing_machine_with_its_laundry_in_the_middle_is_the_published_program() {
    let mut named = Named::new("washing_machine", Integrator::Method);
    named.set("unbalance[1].position", 0.0);
    named.start();
    let speed = named.place("imposed_speed.w");
    named.simulation.set_input(speed, 0.0);
    named.simulation.set_input_derivative(speed, 1, 75.0 / 15.0);
    let mut errors = Vec::new();
    for tenth in 1..=150 {
        let t = f64::from(tenth) / 10.0;
        named.simulation.advance(t).expect("a possible motion");
        errors.push((Complex::new(named.get("r_c.y"), named.get("r_c.z")) - program(t, 160 * tenth)).norm());
    }
    // 0.187 m at its widest
    within("place over its size", largest(errors) / 0.187, PROGRAM);
}

/// Of e/2ζ, by the passage, which is not infinitely slow \[1]: measured 2.1e-3.
const PASSAGE: f64 = 5e-3;

#[test]
fn exact_the_reaction_wheel_whirls_by_e_over_twice_the_damping_ratio_as_it_passes() {
    let mut named = Named::new("reaction_wheel", Integrator::Method);
    named.start();
    let place = named.place("drive.tau");
    named.simulation.set_input(place, 0.2);
    let rest = Vector2::new(named.get("r_c.y"), named.get("r_c.z"));
    let whirl = (10_000..20_000).map(|n| {
        named.simulation.advance(f64::from(n) * 1e-3).expect("a possible motion");
        (Vector2::new(named.get("r_c.y"), named.get("r_c.z")) - rest).norm()
    });
    // Damping ratio: c/2√(k m), of both bearings.
    let ratio = 2.0 * 45.2 / (2.0 * (2.0_f64 * 8.53e5 * 12.0).sqrt());
    within("whirl", (largest(whirl) / (4.8e-6 / 12.0 / (2.0 * ratio)) - 1.0).abs(), PASSAGE);
}
