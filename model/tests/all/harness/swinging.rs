//! What observed orders are measured on: a rotor without small angles, and one that is damped and driven besides.

use super::{Method, Scene, largest, tolerance, within};
use nalgebra::{Vector2, Vector3};
use oracles::numerics::log_slope;
use split_rotor_model::effects::drive::Drive;
use split_rotor_model::effects::gravity::Gravity;
use split_rotor_model::effects::support::Support;
use split_rotor_model::effects::{Called, Effects};
use split_rotor_model::integrate::System;
use split_rotor_model::integrate::explicit::Explicit;
use split_rotor_model::rotation::Chart;
use split_rotor_model::rotor::Rotor;
use split_rotor_model::state::WITH_WORK;

type Driven = (Called<Gravity, 1>, (Called<Support, 1>, (Called<Drive, 1>, ())));

/// The paper's rotor, heavily tilted and swinging: no small angle, no steady state.
pub fn swinging() -> Scene {
    Scene {
        gamma: Vector2::new(0.9, 1.1),
        omega: Vector3::new(5.0, 4.0, -7.0),
        r_c: Vector3::new(0.3, 0.4, -0.5),
        v_c: Vector3::new(1.0, -2.0, 0.5),
        c1: 200.0,
        c2: 20.0,
        ..Scene::paper()
    }
}

/// The same with dampers d1 [N·s/m] and d2 [N·m·s/rad] and a torque that changes with time, and its state.
pub fn driven(d1: f64, d2: f64) -> (Rotor<'static, Driven>, [f64; WITH_WORK]) {
    let scene = Scene { d1, d2, ..swinging() };
    let mut effects: Driven = scene.effects();
    effects.for_each_signal(&mut |tau| {
        tau.set(0.0, 2.0);
        tau.set_derivative(0.0, 1, -3.0);
        tau.set_derivative(0.0, 2, 5.0);
    });
    let mut y = [0.0; WITH_WORK];
    y[..12].copy_from_slice(&scene.state());
    (Rotor::new(scene.body.into(), super::kept(effects), Chart::FromE, 0.0), y)
}

/// Error of the whole state, each component by its nominal size [1].
pub fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let nominal = [0.75, 0.75, 0.75, 1.0, 1.0, 1.0, 0.15625, 0.15625, 0.15625, 1.0, 1.0, 1.0, 1.0, 1.0];
    (0..N).map(|n| ((a[n] - b[n]) / nominal[n]) * ((a[n] - b[n]) / nominal[n])).sum::<f64>().sqrt()
}

/// Holds the power of the step size with which errors fall to a nominal one; pairs of step size and error.
pub fn within_order(what: &str, errors: impl IntoIterator<Item = (f64, f64)>, order: f64, allowed: f64) {
    let slope = log_slope(&errors.into_iter().collect::<Vec<_>>());
    within(&format!("{what}: order {slope:.3}"), (slope - order).abs(), allowed);
}

/// The order of a dense output, by its error within one step of each of these sizes [s] from an exact state, which falls as
/// h^(order + 1): at its worst in the step, and the geometric mean of the times and states that are given. `step` takes the
/// step, and answers at parts of it.
pub fn dense_errors<const N: usize, A: FnMut(f64) -> [f64; N]>(
    system: &impl System<N>,
    places: &[(f64, [f64; N])],
    sizes: &[f64],
    step: impl Fn(f64, [f64; N], f64) -> A,
) -> Vec<(f64, f64)> {
    let worst = |(t, y): &(f64, [f64; N]), h: f64| {
        let mut answer = step(*t, *y, h);
        largest([0.15, 0.3, 0.5, 0.7, 0.85].map(|sigma| {
            let mut exact = Explicit::start(Method::Dop853.tableau(), tolerance(1.0), system, *t, *y);
            (0..4).for_each(|_| exact.fixed_step(system, sigma * h / 4.0));
            distance(&answer(t + sigma * h), exact.state())
        }))
    };
    let mean = |h: f64| {
        libm::exp(places.iter().map(|place| libm::log(worst(place, h))).sum::<f64>() / places.len() as f64) / h
    };
    sizes.iter().map(|&h| (h, mean(h))).collect()
}

/// dop853 in so many steps: exact to rounding.
pub fn reference<const N: usize>(system: &impl System<N>, y: [f64; N], end: f64, steps: u32) -> [f64; N] {
    // Fixed steps ask for no tolerance.
    let mut method = Explicit::start(Method::Dop853.tableau(), tolerance(1.0), system, 0.0, y);
    for _ in 0..steps {
        method.fixed_step(system, end / f64::from(steps));
    }
    *method.state()
}
