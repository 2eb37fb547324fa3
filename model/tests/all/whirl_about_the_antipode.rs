//! A rotor whose axis whirls about −e itself, as closely as one likes: φ gains two turns a whirl, and no more.

use nalgebra::Vector3;
use split_rotor_model::simulation::Simulation;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::Parameters;
use std::f64::consts::{PI, TAU};

/// Whirl rate [rad/s].
const WHIRL: f64 = 10.0;

/// φ against spin and swept angle after 20 s [rad], times the cone's half-angle [rad], at a tolerance of 1e-8: an error of
/// the axis counts as much more as the cone is narrow. Measured 1.6e-5 (dopri5). A turn would be 6.3.
const PHI: f64 = 5e-5;

#[test]
fn exact_phi_of_a_close_whirl_about_the_antipode() {
    let (ja, jt) = (0.05, 0.078125);
    for method in [2.0, 3.0] {
        for cone in [3e-8, 1e-7, 1e-6, 1e-4, 1e-2, 0.5] {
            // K lies along −e, the axis on a cone of this half-angle about it.
            let axis = Vector3::new(-libm::cos(cone), libm::sin(cone), 0.0);
            let k = Vector3::new(-WHIRL * jt, 0.0, 0.0);
            let omega = k / jt + axis * ((1.0 / ja - 1.0 / jt) * k.dot(&axis));
            let values = [
                (0, 0, 5.0),
                (0, 1, ja),
                (0, 2, jt),
                (0, 3, 0.75),
                (1, 8, PI - cone),
                (1, 9, omega.x),
                (1, 10, omega.y),
                (2, 0, method),
                (2, 1, 1e-8),
                (2, 9, 6.0),
                (2, 10, 1e7),
            ];
            let places = values.map(|(block, row, value)| (Place { block, row }, value));
            let mut rotor = Simulation::<()>::from(Parameters::from_iter(places));
            rotor.start(0.0, None).unwrap();
            let start = *rotor.read().unwrap();
            let spin = start.motion.omega.dot(start.motion.axis());
            rotor.advance(20.0).unwrap();
            // eq. 19: φ = (ω·t) t + (1 − cos θ) ψ, and ψ turns at K_x/Jt
            let exact = spin * 20.0 + (1.0 - start.motion.axis().x) * (k.x / jt) * 20.0;
            let error = (rotor.read().unwrap().motion.phi() - exact).abs();
            println!("method {method}, cone {cone:e}: {error:.2e} rad, {:.1e} times the cone", error * cone);
            assert!(error * cone.min(1.0) <= PHI && error < 0.5 * TAU);
        }
    }
}
