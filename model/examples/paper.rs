//! The rotor of Sorokin and Zhang (2018), section 4, as a typed scene: `cargo run -p split-rotor-model --example paper`.

use nalgebra::Vector3;
use split_rotor_model::body::Body;
use split_rotor_model::effects;
use split_rotor_model::effects::{Called, gravity::Gravity, support::Support};
use split_rotor_model::simulation::Simulation;
use split_rotor_model::variables::{Parameters, Setup};

type Effects = (Called<Gravity>, (Called<Support>, ()));

/// Gravity bends the springs, and the spin makes the rotor precess.
fn paper() -> Simulation<Effects> {
    let mut setup = Setup::of(Body { m: 5.0, Ja: 0.15625, Jt: 0.078125, l: 0.75 });
    setup.start.r_c.x = 0.75;
    setup.start.omega.x = 50.0;
    setup.solver.relative_tolerance = 1e-10;
    let gravity = Gravity { g: Vector3::new(0.0, 0.0, -9.81) };
    let support = Support { c1: 2000.0, c2: 500.0, ..Support::default() };
    Parameters { setup, effects: effects![gravity, support] }.into()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut rotor = paper();
    rotor.start(0.0, None)?;
    println!("  t [s]    z_c [m]    phi [rad]   residual [J]");
    for second in 0..=10 {
        rotor.advance(f64::from(second))?;
        let shown = rotor.read()?;
        println!(
            "{second:7} {:10.6} {:12.6} {:14.1e}",
            shown.motion.r_c().z,
            shown.motion.phi(),
            shown.ledger.residual()
        );
    }
    Ok(())
}

#[test]
fn keeps_its_energy() {
    let mut rotor = paper();
    rotor.start(0.0, None).unwrap();
    rotor.advance(10.0).unwrap();
    let shown = rotor.read().unwrap();
    // 12 J of spring energy come and go.
    assert!(shown.ledger.residual().abs() < 1e-10, "{:e} J", shown.ledger.residual());
    assert!((shown.motion.phi() - 500.0).abs() < 0.1, "{} rad", shown.motion.phi());
}
