//! Exact derivatives: the natural frequencies of the paper's rotor against its speed, from the linear motion about its
//! equilibrium: `cargo run -p split-rotor-model --example derivative`.

use nalgebra::DMatrix;
use split_rotor_model::body::Body;
use split_rotor_model::effects;
use split_rotor_model::effects::{Called, support::Support};
use split_rotor_model::error::Invalid;
use split_rotor_model::simulation::Simulation;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::{Parameters, Setup};

type Supported = (Called<Support>, ());

/// The states that move about the equilibrium; φ turns steadily.
const STATES: [&str; 11] = ["r.x", "r.y", "r.z", "v.x", "v.y", "v.z", "K.x", "K.y", "K.z", "gamma.y", "gamma.z"];

/// The paper's rotor without gravity, upright in its springs, at a speed [rad/s].
fn upright(speed: f64) -> Simulation<Supported> {
    let mut setup = Setup::of(Body { m: 5.0, Ja: 0.15625, Jt: 0.078125, l: 0.75 });
    setup.start.r_c.x = 0.75;
    setup.start.omega.x = speed;
    let support = Support { c1: 2000.0, c2: 500.0, ..Support::default() };
    Parameters { setup, effects: effects![support] }.into()
}

fn place(name: &str) -> Place {
    Parameters::<Supported>::place(name).expect("a variable of every rotor")
}

/// The natural frequencies [rad/s], ascending: the imaginary parts of the eigenvalues of ∂(rates)/∂(states).
fn frequencies(speed: f64) -> Result<Vec<f64>, Invalid> {
    let mut rotor = upright(speed);
    rotor.start(0.0, None)?;
    let mut matrix = DMatrix::zeros(STATES.len(), STATES.len());
    for (column, state) in STATES.iter().enumerate() {
        let tangents = rotor.tangents([(place(&format!("state.{state}")), 1.0)].into_iter())?;
        for (row, of) in STATES.iter().enumerate() {
            matrix[(row, column)] = tangents.of(place(&format!("der(state.{of})"))).expect("a rate");
        }
    }
    let mut found: Vec<f64> = matrix.complex_eigenvalues().iter().map(|s| s.im).filter(|w| *w > 1e-3).collect();
    found.sort_by(f64::total_cmp);
    Ok(found)
}

fn main() -> Result<(), Invalid> {
    println!("speed [rad/s]   natural frequencies [rad/s]");
    for speed in [0.0, 50.0, 100.0, 200.0, 400.0] {
        let words: Vec<_> = frequencies(speed)?.iter().map(|w| format!("{w:8.3}")).collect();
        println!("{speed:13}   {}", words.join(" "));
    }
    Ok(())
}

/// Along e the springs hold the mass alone; at rest what is left comes in pairs, and spin parts them.
#[test]
fn frequencies_of_the_paper() {
    let along = (2000.0_f64 / 5.0).sqrt();
    let [rest, spinning] = [0.0, 50.0].map(|speed| frequencies(speed).unwrap());
    for found in [&rest, &spinning] {
        assert_eq!(found.len(), 5, "{found:?}");
        assert!(found.iter().any(|w| (w - along).abs() < 1e-9), "{found:?}");
    }
    // About each axis across: det(K − ω² M) = 0 of the displacement of a and the tilt, M = (m, m l; m l, Jt + m l²).
    let (m, ml, about_a) = (5.0, 5.0 * 0.75, 0.078125 + 5.0 * 0.75 * 0.75);
    for w in rest.iter().filter(|w| (**w - along).abs() > 1e-9) {
        let w2 = w * w;
        let determinant = (2000.0 - w2 * m) * (500.0 - w2 * about_a) - w2 * w2 * ml * ml;
        assert!(determinant.abs() < 1e-6 * 2000.0 * 500.0, "{w} rad/s: {determinant:e}");
    }
    assert!(spinning.windows(2).all(|pair| pair[1] - pair[0] > 0.1), "{spinning:?}");
}
