//! A rotor as a control engineer sees it: matrices about its steady state, and how a probe answers a force at a port:
//! `cargo run -p split-rotor-model --features general --example transfer`.

use nalgebra::ComplexField;
use split_rotor_model::linear::{Machine, Obstacle, Quantity, StateSpace};
use split_rotor_model::scene::Scene;
use std::path::Path;

/// A spindle of 12 kg on two bearings, pushed at its middle and looked at beside it, at 500 rad/s.
const SPINDLE: &str = "[rotor]\nm = 12.0\nJa = 0.05\nJt = 0.4\n\
    [[effects.bearing]]\nposition = -0.2\nkyy = 2e6\nkzz = 1e6\ncyy = 800.0\nczz = 600.0\nkxx = 1e7\ncxx = 1e3\n\
    [[effects.bearing]]\nposition = 0.25\nkyy = 2e6\nkzz = 1e6\ncyy = 800.0\nczz = 600.0\n\
    [[effects.port]]\nposition = 0.0\n[[effects.probe]]\nposition = 0.1\n";

fn spindle() -> Result<StateSpace, Obstacle> {
    let scene = Scene::parse(Path::new("spindle.toml"), SPINDLE).expect("a scene without a slip");
    Machine::of(&scene.parameters())?.state_space(500.0, None)
}

fn number(of: &[Quantity], name: &str) -> usize {
    of.iter().position(|one| one.name == name).expect("it is there")
}

fn main() -> Result<(), Obstacle> {
    let space = spindle()?;
    let [from, to] = [number(&space.inputs, "port[1].f.y"), number(&space.outputs, "probe[1].r.y")];
    println!("A is {} by {}, B {} by {}", space.a.nrows(), space.a.ncols(), space.b.nrows(), space.b.ncols());
    println!("frequency [rad/s]   answer [µm/N]   phase [°]");
    for frequency in [0.0, 100.0, 300.0, 500.0, 700.0, 1000.0] {
        let Some(answer) = space.response(from, to, frequency)? else { continue };
        println!("{frequency:17}   {:13.4}   {:9.1}", 1e6 * answer.modulus(), answer.argument().to_degrees());
    }
    Ok(())
}

#[test]
fn far_above_its_resonances_it_is_a_mass() {
    let space = spindle().expect("it is held");
    let [from, to] = [number(&space.inputs, "port[1].f.y"), number(&space.outputs, "r_c.y")];
    let answer = space.response(from, to, 1e5).expect("eigenvalues").expect("it is damped");
    // −1/(m Ω²)
    assert!((answer.re * -12.0 * 1e10 - 1.0).abs() < 1e-3, "{answer:e} m/N");
}
