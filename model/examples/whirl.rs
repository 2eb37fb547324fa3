//! The linear view of a scene: its critical speeds, and how its unbalance makes it whirl:
//! `cargo run -p split-rotor-model --features general --example whirl`.

use split_rotor_model::linear::{Campbell, Machine, Obstacle};
use split_rotor_model::scene::Scene;
use std::path::Path;

/// A turbo rotor of 12 kg on two bearings, with 40 g mm out of balance.
const TURBO: &str = "[rotor]\nm = 12.0\nJa = 0.05\nJt = 0.4\n\
    [[effects.bearing]]\nposition = -0.2\nkyy = 2e6\nkzz = 1e6\ncyy = 800.0\nczz = 600.0\nkxx = 1e7\ncxx = 1e3\n\
    [[effects.bearing]]\nposition = 0.25\nkyy = 2e6\nkzz = 1e6\ncyy = 800.0\nczz = 600.0\n\
    [[effects.unbalance]]\nmass = 4e-3\nradius = 0.01\nposition = 0.05\n";

fn turbo() -> Machine {
    let scene = Scene::parse(Path::new("turbo.toml"), TURBO).expect("a scene without a slip");
    Machine::of(&scene.parameters()).expect("a symmetric body")
}

fn main() -> Result<(), Obstacle> {
    let machine = turbo();
    let speeds: Vec<_> = (0..=100).map(|n| 10.0 * f64::from(n)).collect();
    let campbell = Campbell::of(&machine, &speeds)?;
    println!("critical speed [rad/s]   half axes at c [µm]   which whirls");
    for at in campbell.critical_speeds(1.0)? {
        let orbit = machine.response(at.speed, None)?.orbit(0.0);
        let [major, minor] = [orbit.major(), orbit.minor()].map(|length| 1e6 * length);
        println!("{:22.2}   {major:8.2}, {minor:8.2}   {}", at.speed, at.mode.direction.name());
    }
    Ok(())
}

#[test]
fn far_above_its_critical_speeds_it_turns_about_its_mass_centre() {
    let orbit = turbo().response(1e5, None).expect("it is held").orbit(0.0);
    // 40 g mm over 12.004 kg; the tilt that the couple makes moves c by less.
    assert!((orbit.major() / (4e-5 / 12.004) - 1.0).abs() < 1e-3, "{:e} m", orbit.major());
}
