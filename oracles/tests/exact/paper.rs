//! The reference motion of the paper's example: what it must keep, and the oracles that integrate such a rotor beside it.

use nalgebra::Vector3;
use oracles::bounds::{largest, within};
use oracles::machine::{Machine, Pace, Run, Start, Support};
use oracles::rigid_body::RigidBody;
use oracles::{paper, rotation};

/// The paper's rotor on its springs, under gravity.
fn rotor() -> RigidBody {
    RigidBody {
        g: Vector3::z() * -9.81,
        c: [2000.0, 500.0],
        ..RigidBody::free(5.0, [0.15625, 0.078125, 0.078125], 0.75)
    }
}

/// The reference's energy [J] and K_c·t [kg·m²/s] at double precision, relative: measured 4.4e-16 (ω_φ).
const REFERENCE: f64 = 2e-15;

#[test]
fn literature_reference_keeps_what_is_constant() {
    let body = rotor();
    for instant in paper::instants() {
        let t = rotation::axis(&instant.gamma);
        let omega = instant.k_c / 0.078125 + t * ((1.0 / 0.15625 - 1.0 / 0.078125) * instant.k_c.dot(&t));
        let energy = body.energy(&body.start(instant.r_c, instant.v_c, instant.phi, instant.gamma, omega));
        let omega_phi = omega.dot(&(Vector3::x() + t)) / (1.0 + t.x);
        within("energy", (energy / 195.3125 - 1.0).abs(), REFERENCE);
        within("energy column", (instant.energy / 195.3125 - 1.0).abs(), REFERENCE);
        within("K·t", (instant.k_c.dot(&t) / 7.8125 - 1.0).abs(), REFERENCE);
        within("omega_phi", (omega_phi / instant.omega_phi - 1.0).abs(), REFERENCE);
    }
}

/// Holds r_c [m], axis [1] and φ [rad] of a motion against those of the reference, 0.1 … 10 s.
fn beside_the_reference(bounds: [f64; 3], mut motion: impl FnMut(f64) -> (Vector3<f64>, Vector3<f64>, f64)) {
    let errors = |instant: &paper::Instant| {
        let (r_c, axis, phi) = motion(instant.t);
        [(r_c - instant.r_c).norm(), (axis - rotation::axis(&instant.gamma)).norm(), (phi - instant.phi).abs()]
    };
    let errors: Vec<_> = paper::instants()[1..].iter().map(errors).collect();
    for (n, what) in ["r_c", "axis", "phi"].into_iter().enumerate() {
        within(what, largest(errors.iter().map(|error| error[n])), bounds[n]);
    }
}

/// r_c [m], axis [1] and φ [rad], 0 … 10 s: measured 6.3e-15, 1.8e-14.
const RIGID_BODY: [f64; 3] = [2e-14, 5e-14, 2e-12];

#[test]
fn literature_the_rigid_body_is_the_papers_rotor() {
    let (body, first) = (rotor(), &paper::instants()[0]);
    let mut moving = body.start(first.r_c, first.v_c, first.phi, first.gamma, Vector3::x() * 50.0);
    let mut t = 0.0;
    beside_the_reference(RIGID_BODY, |end| {
        (moving, t) = (body.run(t, &moving, end, 20), end);
        (moving.r, moving.axis(), moving.phi)
    });
}

/// What its steps may err, over how far the motion goes [1].
const STEP: f64 = 1e-13;

/// The steps that it takes to these times [s] by its own choice, halved.
fn halved(machine: &Machine, times: &[f64]) -> Run {
    let mut run = Run::new(machine, Pace::Adaptive(STEP));
    for t in times {
        assert!(run.advance(*t), "a motion");
    }
    Run::new(machine, Pace::Like(run.taken(), 2))
}

/// r_c [m], axis [1] and φ [rad], 0 … 10 s: measured 1.3e-14, 4.9e-14, 6.8e-13.
const MACHINE: [f64; 3] = [5e-14, 2e-13, 2e-12];

#[test]
fn literature_the_machine_is_the_papers_rotor() {
    let machine = Machine {
        m: 5.0,
        Ja: 0.15625,
        Jt: 0.078125,
        l: 0.75,
        start: Start { r_c: Vector3::x() * 0.75, omega: Vector3::x() * 50.0, ..Start::default() },
        gravity: Some(Vector3::z() * -9.81),
        support: Some(Support { c: [2000.0, 500.0], d: [0.0; 2] }),
        ..Machine::default()
    };
    let times: Vec<_> = paper::instants()[1..].iter().map(|instant| instant.t).collect();
    let mut run = halved(&machine, &times);
    beside_the_reference(MACHINE, |t| {
        assert!(run.advance(t), "a motion");
        let shown = run.show();
        (shown.r_c, shown.axis, shown.phi)
    });
}
