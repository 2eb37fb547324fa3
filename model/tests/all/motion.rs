//! Small whirl and the swept solid angle; the gallery (`cargo xtask hard-cases`) has whole runs against motions in closed form, steady
//! whirl at any tilt among them, and `stiff.rs` a damped decay.

use crate::harness::{SUPPORTED, Scene, largest, times, within};
use nalgebra::{SMatrix, Vector2, Vector3};
use oracles::motion::{Whirl, small_whirl};
use oracles::numerics::root;
use oracles::rotation;
use split_rotor_model::dual::Dual;
use split_rotor_model::state::COORDINATES;
use split_rotor_model::variables::Reading;

// ------------------------------------------------------------------------------------------------- small whirl

/// Frequencies of small motions about a state at which only the axis spins [rad/s], in order.
fn frequencies(scene: &Scene, y: &[f64; COORDINATES]) -> Vec<f64> {
    let duals: [Dual<COORDINATES>; COORDINATES] = std::array::from_fn(|n| Dual::variable(y[n], n));
    let rates = scene.rates(&duals);
    let jacobian = SMatrix::<f64, COORDINATES, COORDINATES>::from_fn(|row, column| rates[row].eps[column]);
    let eigenvalues = jacobian.complex_eigenvalues();
    // Zero comes several times, and so with half the digits only.
    let whirls: Vec<_> = eigenvalues.iter().filter(|value| value.im > 1.0).collect();
    within("damping", largest(whirls.iter().map(|value| value.re.abs())), DAMPING);
    let mut frequencies: Vec<_> = whirls.iter().map(|value| value.im).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies
}

/// Real part of the eigenvalues of an undamped rotor [rad/s]: measured 7.5e-14.
const DAMPING: f64 = 3e-13;
/// Frequencies of the Jacobian against the frequency equation, relative [1]: measured 1.7e-14.
const FREQUENCY: f64 = 6e-14;

#[test]
fn exact_small_whirl_frequencies() {
    for spin in [0.0, 50.0, 300.0] {
        let scene = Scene { omega: Vector3::x() * spin, g: Vector3::zeros(), ..Scene::paper() };
        let mut exact: Vec<_> = small_whirl(&Whirl::paper(0.0, 100.0), spin).into_iter().map(f64::abs).collect();
        // Along e the rotor swings on its spring, and nothing tilts.
        exact.push((scene.c1 / scene.body.m).sqrt());
        exact.sort_by(f64::total_cmp);
        let computed = frequencies(&scene, &scene.state());
        assert_eq!(computed.len(), exact.len(), "{computed:?}");
        for (computed, exact) in computed.iter().zip(&exact) {
            within("frequency", (computed / exact - 1.0).abs(), FREQUENCY);
        }
    }
}

/// The modes about the sag to five or six digits, by an independent program [rad/s].
const SAGGED: [f64; 5] = [10.363, 11.684, 20.0, 104.519, 203.198];

#[test]
fn literature_modes_about_the_sag() {
    let scene = Scene::paper();
    let (weight, l) = (scene.body.m * 9.81, scene.body.l);
    // c2 θ = m g l cos θ, the spring at a carries the weight; the axis sags towards −z: γ about +y.
    let theta = root(|theta| scene.c2 * theta - weight * l * libm::cos(theta), 0.0, 1.0);
    within("sag", (theta - 0.0734).abs(), 0.00005);
    let gamma = Vector2::new(theta, 0.0);
    let axis = rotation::axis(&gamma);
    let r_c = axis * l - Vector3::z() * (weight / scene.c1);
    let sagged = Scene { gamma, r_c, omega: axis * 50.0, ..scene };
    let y = sagged.state();
    // At rest but for φ.
    within("rates at rest", largest(sagged.rates(&y)[..COORDINATES - 1].iter().map(|rate| rate.abs())), AT_REST);
    for (computed, printed) in frequencies(&sagged, &y).into_iter().zip(SAGGED) {
        within("mode", (computed - printed).abs(), 0.0005);
    }
}

/// Rates of the sagged rotor [SI units], of forces of 50 N: measured 4.4e-14.
const AT_REST: f64 = 1.4e-13;

// ------------------------------------------------------------------------------------------------- swept solid angle

/// φ against spin plus swept solid angle [rad], by Simpson's rule over 0.2 ms: measured 5.6e-11.
const SOLID_ANGLE: f64 = 1.7e-10;

#[test]
fn exact_phi_is_spin_plus_solid_angle() {
    // eq. 19 on the supported rotor, which has no closed form: the sweep of the axis as the run shows it.
    let scene = Scene {
        gamma: Vector2::new(0.3, -0.4),
        omega: Vector3::new(40.0, 6.0, -3.0),
        tolerance: 1e-12,
        ..Scene::paper()
    };
    let (end, parts) = (2.0, 20_000_u32);
    let readings = scene.run(SUPPORTED, times(end, parts));
    // (1 − cos θ)dψ/dt = e·(t×dt/dt)/(1 + cos θ)
    let sweep = |reading: &Reading| {
        let axis = reading.motion.axis();
        axis.cross(&reading.motion.omega.cross(axis)).x / (1.0 + axis.x)
    };
    let spin = readings[0].motion.omega.dot(readings[0].motion.axis());
    let mut angle = 0.0;
    for (n, three) in readings.windows(3).enumerate().step_by(2) {
        angle += (sweep(&three[0]) + 4.0 * sweep(&three[1]) + sweep(&three[2])) * end / f64::from(parts) / 3.0;
        let t = end * (n + 2) as f64 / f64::from(parts);
        within("phi", (three[2].motion.phi() - spin * t - angle).abs(), SOLID_ANGLE);
    }
    assert!(angle.abs() > 1.0, "the solid angle counts: {angle}");
}
