//! The scene `heavy_top`: steady precession, exact on springs, and the top about a fixed point as the springs get stiff.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use crate::oracles::heavy_top::HeavyTop;
use crate::oracles::motion::Whirl;
use crate::oracles::numerics::log_slope;
use crate::oracles::rotation;
use nalgebra::Vector3;
use split_rotor_model::simulation::Integrator;

const GRAVITY: f64 = 9.81;

fn top() -> Named {
    Named::new("heavy_top", Integrator::Method)
}

fn set(named: &mut Named, name: &str, v: &Vector3<f64>) {
    for (component, axis) in ["x", "y", "z"].into_iter().enumerate() {
        named.set(&format!("start.{name}.{axis}"), v[component]);
    }
}

/// r_c [m], axis [1] and φ [rad] over 3 s of steady precession: measured 4.6e-13.
const PRECESSION: f64 = 2e-12;

#[test]
fn exact_steady_precession_on_springs() {
    let mut named = top();
    let [m, ja, jt, l, c1] = ["rotor.m", "rotor.Ja", "rotor.Jt", "rotor.l", "support.c1"].map(|name| named.get(name));
    let whirl = Whirl { m, Ja: ja, Jt: jt, l, c1, c2: 0.0, g: GRAVITY, theta: 0.5, rate: 3.0 };
    set(&mut named, "r_c", &whirl.r_c(0.0));
    set(&mut named, "v_c", &whirl.v_c(0.0));
    set(&mut named, "omega", &whirl.omega(0.0));
    named.set("start.gamma.y", whirl.gamma(0.0).x);
    named.set("start.gamma.z", whirl.gamma(0.0).y);
    named.set("solver.relative_tolerance", 1e-12);
    named.start();
    for i in 1..=30 {
        let t = 0.1 * f64::from(i);
        named.simulation.advance(t).expect("a possible motion");
        let mut vector = |of: &str| Vector3::from(["x", "y", "z"].map(|axis| named.get(&format!("{of}.{axis}"))));
        let place = (vector("r_c") - whirl.r_c(t)).norm();
        let axis = (vector("axis") - rotation::axis(&whirl.gamma(t))).norm();
        let phi = (named.get("phi") - whirl.phi(t)).abs();
        within("precession", largest([place, axis, phi]), PRECESSION);
    }
}

/// The slope of the difference over c1, −1 within this [1]: measured 0.02.
const SLOPE: f64 = 0.05;

#[test]
fn exact_difference_from_a_fixed_point_falls_as_the_springs_get_stiff() {
    let difference = |c1: f64| {
        let mut named = top();
        let [m, ja, jt, l] = ["rotor.m", "rotor.Ja", "rotor.Jt", "rotor.l"].map(|name| named.get(name));
        let axis = Vector3::new(libm::cos(0.5), libm::sin(0.5), 0.0);
        named.set("support.c1", c1);
        set(&mut named, "r_c", &(axis * l - Vector3::x() * (m * GRAVITY / c1)));
        named.start();
        let top = HeavyTop { A: jt + m * l * l, Ja: ja, weight: m * GRAVITY * l, spin: 300.0 };
        let worst = (1..=20).map(|i| {
            let t = 0.1 * f64::from(i);
            named.simulation.advance(t).expect("a possible motion");
            (libm::acos(named.get("axis.x")) - top.let_go(0.5, t)).abs()
        });
        (c1, largest(worst))
    };
    let found = [2e5, 4e5, 8e5, 1.6e6].map(difference);
    let slope = log_slope(&found);
    within(&format!("{found:?}, slope {slope:.3}"), (slope + 1.0).abs(), SLOPE);
}
