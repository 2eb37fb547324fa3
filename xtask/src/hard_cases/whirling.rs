//! Resonance, and whirl that damping or cross coupling drives.

use super::case::{Case, Exact, Phi, Setting, follow_from, times};
use super::method::{Method, at, usual};
use nalgebra::{Complex, Normed, Vector3};
use oracles::forward_whirl::ForwardWhirl;
use oracles::jeffcott::Jeffcott;
use oracles::numerics::exp;

/// The family, with the bounds of [`unbalanced`] and of [`methods`].
pub fn cases() -> Vec<Case> {
    vec![
        unbalanced("at its critical speed", 20.0, 0.0, [2e-11, 2e-10, 2e-8]),
        unbalanced("through its critical speed", 10.0, 2.0, [8e-12, 8e-11, 7e-9]),
        internal(60.0, "grows", [2e-11, 2e-10, 1e-8, 2e-9]),
        internal(30.0, "dies out", [3e-12, 3e-11, 2e-9, 3e-10]),
        crossed(120.0, "grows", [2e-11, 2e-10, 1e-8, 2e-9]),
        crossed(60.0, "dies out", [5e-12, 5e-11, 4e-9, 5e-10]),
    ]
}

/// A place across the axis \[m].
fn across(z: Complex<f64>) -> Option<Vector3<f64>> {
    Some(Vector3::new(0.0, z.re, z.im))
}

/// Jeffcott's rotor from rest in its bearings, at this speed [rad/s] and its rate [rad/s²], 10 s; errors in units of ε.
fn unbalanced(name: &str, speed: f64, acceleration: f64, bounds: [f64; 3]) -> Case {
    let rotor = Jeffcott { natural: 20.0, damping: 0.05, eccentricity: 0.002, speed, acceleration };
    // It turns already, so that nothing strikes it at the start.
    let settings = vec![("start.omega.x", speed), ("imposed_speed.w", speed), ("imposed_speed.a", acceleration)];
    let exact = move |t: f64| Exact { r_c: across(rotor.place(t)), axis: Vector3::x(), phi: Phi::Whole(rotor.phi(t)) };
    Case {
        name: format!("Jeffcott's rotor {name}"),
        hard: "resonance: the phase decides how far the whirl grows",
        oracle: "Duhamel's integral",
        scene: "jeffcott",
        methods: usual(bounds, []),
        mutant: ("imposed_speed.w", 1.0 + 1e-5),
        task: follow_from(0.0, rotor.eccentricity, settings, times(10.0, 50), exact),
    }
}

/// The scene's rotor with nothing that drives its whirl.
const ROTOR: ForwardWhirl = ForwardWhirl { m: 5.0, k: 2000.0, c: 4.0, d: 0.0, s: 0.0 };

/// The forward whirl z = z₀ e^(λt) of that rotor for 10 s; errors in units of its largest size. So small that what it takes from the
/// spin does not count.
fn whirl(name: String, oracle: &'static str, rate: Complex<f64>, mut settings: Vec<Setting>, mutant: Setting) -> Case {
    let (start, end) = (1e-9, 10.0);
    let moving = rate * start;
    settings.extend([("start.r_c.y", start), ("start.v_c.y", moving.re), ("start.v_c.z", moving.im)]);
    // Else nobody asks for digits of what is smaller than the tolerance.
    settings.push(("solver.absolute_tolerance", 1e-20));
    let place = move |t: f64| exp(rate * t) * start;
    let exact = move |t: f64| Exact { r_c: across(place(t)), axis: Vector3::x(), phi: Phi::Unasked };
    Case {
        name,
        hard: "a rate of growth is a small difference of large forces",
        oracle,
        scene: "unstable_whirl",
        methods: Vec::new(),
        mutant,
        task: follow_from(0.0, place(end).norm().max(start), settings, times(end, 50), exact),
    }
}

/// The methods for whirl that is driven.
fn methods(bounds: [f64; 4]) -> Vec<(Method, f64)> {
    let methods = [at("dop853", 1e-12), at("dopri5", 1e-12), at("stiff", 1e-10), at("auto", 1e-10)];
    methods.into_iter().zip(bounds).collect()
}

/// Damping that turns with the rotor drives its whirl above 40 rad/s.
fn internal(spin: f64, what: &str, bounds: [f64; 4]) -> Case {
    let [rate, _] = ForwardWhirl { d: 4.0, ..ROTOR }.rates(spin);
    let name = format!("rotating damping at {spin} rad/s: forward whirl {what}");
    let settings = vec![("start.omega.x", spin), ("rotating_damping.d", 4.0)];
    let mutant = ("rotating_damping.d", 1.0 + 1e-4);
    Case { methods: methods(bounds), ..whirl(name, "eigenvalues (Kimball 1924)", rate, settings, mutant) }
}

/// Cross coupling of 80 N/m and more drives it without any spin.
fn crossed(s: f64, what: &str, bounds: [f64; 4]) -> Case {
    let [rate, _] = ForwardWhirl { s, ..ROTOR }.rates(0.0);
    let name = format!("cross coupling of {s} N/m: forward whirl {what}");
    let half = 0.5 * s;
    let settings = vec![
        ("start.omega.x", 0.0),
        ("rotating_damping.d", 0.0),
        ("bearing[1].kyz", half),
        ("bearing[2].kyz", half),
        ("bearing[1].kzy", -half),
        ("bearing[2].kzy", -half),
    ];
    let mutant = ("bearing[1].kyz", 1.0 + 1e-4);
    Case { methods: methods(bounds), ..whirl(name, "eigenvalues (Childs 1993)", rate, settings, mutant) }
}
