//! Free rotors with three moments of inertia.

use super::case::{Case, Exact, Phi, Setting, body, follow, start, times};
use super::method::{Method, at, symplectic};
use nalgebra::{Vector2, Vector3};
use oracles::asymmetric::Asymmetric;
use oracles::rotation;
use std::f64::consts::TAU;

/// Who knows the answer.
const JACOBI: &str = "Jacobi's elliptic functions, the turn about K by quadrature";

/// About its largest moment, and about its smallest.
const MOMENTS: [(&str, [f64; 3], [f64; 6], f64); 2] = [
    ("about its largest moment", [0.15, 0.08, 0.11], [3e-9, 2e-10, 4e-7, 4e-7, 1e-9, 1e-11], 3e-10),
    ("about its smallest moment", [0.08, 0.11, 0.15], [1e-8, 4e-11, 4e-7, 1e-7, 3e-9, 1e-11], 9e-10),
];

/// The family; long cases in full, or shortened.
pub fn cases(whole: bool) -> Vec<Case> {
    let all =
        MOMENTS.into_iter().map(|(name, j, bounds, _)| turns(name, j, methods().into_iter().zip(bounds).collect()));
    let of_axis = MOMENTS.into_iter().map(|(name, j, _, bound)| turns_of_the_axis(name, j, bound));
    all.chain(of_axis).chain([dzhanibekov(whole)]).collect()
}

/// The motion of such a rotor from φ = 0, γ = 0.
fn motion(j: [f64; 3], omega: Vector3<f64>) -> (Vec<Setting>, impl Fn(f64) -> Exact + Clone, Asymmetric) {
    let still = Vector3::zeros();
    let mut settings = body(5.0, j[0], j[1], 0.75);
    settings.push(("asymmetry.Jt2", j[2]));
    settings.extend(start(&still, &still, 0.0, &Vector2::zeros(), &omega));
    let rotor = Asymmetric::new(j, 0.0, &Vector2::zeros(), &omega);
    let known = rotor.clone();
    let exact = move |t: f64| {
        let attitude = known.attitude(t);
        Exact { r_c: None, axis: attitude.column(0).into_owned(), phi: Phi::Part(rotation::phi(&attitude)) }
    };
    (settings, exact, rotor)
}

/// A thousand turns, nutating about an axis of inertia.
fn turns(name: &str, j: [f64; 3], methods: Vec<(Method, f64)>) -> Case {
    let (settings, exact, _) = motion(j, Vector3::new(50.0, 12.0, 5.0));
    Case {
        name: format!("free asymmetric rotor {name}, 1000 turns"),
        hard: "φ feeds back into the motion; phase error grows",
        oracle: JACOBI,
        scene: "dzhanibekov",
        methods,
        mutant: ("asymmetry.Jt2", 1.0 + 1e-6),
        task: follow(settings, times(1000.0 * TAU / 50.0, 100), exact),
    }
}

/// The same, of which φ is not asked.
fn turns_of_the_axis(name: &str, j: [f64; 3], bound: f64) -> Case {
    let (settings, exact, _) = motion(j, Vector3::new(50.0, 12.0, 5.0));
    Case {
        name: format!("free asymmetric rotor {name}, 1000 turns, its axis"),
        task: follow(settings, times(1000.0 * TAU / 50.0, 100), move |t| Exact { phi: Phi::Unasked, ..exact(t) }),
        ..turns(name, j, vec![(at("dop853", 1e-12), bound)])
    }
}

/// The methods for these; the last is the exact flow, in one step.
fn methods() -> [Method; 6] {
    [
        at("dop853", 1e-12),
        at("dop853", 1e-14),
        at("dopri5", 1e-12),
        at("stiff", 1e-12),
        symplectic(8, 0.01),
        symplectic(2, 1000.0),
    ]
}

/// It spins about its middle axis, which is t, and turns over every half period.
fn dzhanibekov(whole: bool) -> Case {
    let (settings, exact, rotor) = motion([0.11, 0.15, 0.08], Vector3::new(10.0, 0.1, 0.0));
    let periods = if whole { 1000 } else { 20 };
    let end = f64::from(periods) * rotor.period();
    let methods =
        [at("dop853", 1e-12), at("dop853", 1e-14), at("dopri5", 1e-12), symplectic(8, 0.02), symplectic(2, 1e5)];
    let bounds = if whole { [8e-4, 8e-5, 5e-2, 1.4e-4, 5e-9] } else { [3e-7, 4e-8, 9e-6, 3e-8, 2e-10] };
    Case {
        name: format!("Dzhanibekov's flip, {periods} periods"),
        hard: "lingers at an unstable axis, then turns over to −e",
        oracle: JACOBI,
        scene: "dzhanibekov",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("start.omega.y", 1.0 + 1e-3),
        // An odd number of times: neither flips nor lingers only.
        task: follow(settings, times(end, 97), exact),
    }
}
