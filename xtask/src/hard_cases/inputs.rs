//! Steps and spikes of the drive's torque.

use super::case::{Case, Exact, Found, Phi, Setting, start, support, times};
use super::method::{at, usual};
use anyhow::Result;
use nalgebra::{Vector2, Vector3};
use oracles::rigid_body::RigidBody;

/// A torque [N·m] that is held for a time \[s].
type Held = (f64, f64);

/// The family.
pub fn cases() -> Vec<Case> {
    vec![
        upright(
            "steps of ±10⁴ N·m, upright",
            "the torque jumps at each communication point",
            steps(),
            [8e-13, 3e-13, 3e-13],
        ),
        upright("spikes of 10⁹ N·m for 1 ns, upright", "all of the impulse in a nanosecond", spikes(1e-9), [3e-14; 3]),
        tilted(),
    ]
}

fn steps() -> Vec<Held> {
    (0..40).map(|n| (if n % 2 == 0 { 1e4 } else { -1e4 + 10.0 * f64::from(n) }, 0.01)).collect()
}

/// An impulse of 1 N·m·s within `width` \[s], ten times, a tenth of a second between them.
fn spikes(width: f64) -> Vec<Held> {
    (0..10).flat_map(|n| [(0.0, 0.1), (if n % 2 == 0 { 1.0 } else { -0.5 } / width, width)]).collect()
}

/// Without tilt the axial rate is ∫τdt/Ja: φ exactly.
fn upright(name: &'static str, hard: &'static str, torques: Vec<Held>, bounds: [f64; 3]) -> Case {
    let axial = 0.15625;
    let methods = [at("dop853", 1e-12), at("dopri5", 1e-12), at("stiff", 1e-10)];
    let mut settings = support(2000.0, 500.0, Vector3::zeros());
    let place = Vector3::new(0.75, 0.0, 0.0);
    settings.extend(start(&place, &Vector3::zeros(), 0.0, &Vector2::zeros(), &(Vector3::x() * 50.0)));
    Case {
        name: name.into(),
        hard,
        oracle: "φ̈ = τ/Ja, torque by torque",
        scene: "driven",
        methods: methods.into_iter().zip(bounds).collect(),
        mutant: ("drive.tau", 1.0 + 1e-6),
        task: Box::new(move |bench| {
            let (mut phi, mut rate) = (0.0, 50.0);
            driven(bench, &settings, &torques, |(tau, time)| {
                phi += (rate + 0.5 * tau / axial * time) * time;
                rate += tau / axial * time;
                Exact { r_c: Some(place), axis: Vector3::x(), phi: Phi::Whole(phi) }
            })
        }),
    }
}

/// A tilted rotor without springs: the torque acts along e + t, so the axis goes with it.
fn tilted() -> Case {
    let (gamma, omega) = (Vector2::new(0.5, -0.8), Vector3::new(40.0, 6.0, -3.0));
    let mut settings = support(0.0, 0.0, Vector3::zeros());
    settings.extend(start(&Vector3::zeros(), &Vector3::zeros(), 0.0, &gamma, &omega));
    let torques: Vec<Held> = times(1.0, 20).into_iter().map(|t| (20.0 * libm::sin(37.0 * t), 0.02)).collect();
    let spiky = torques.into_iter().flat_map(|held| [held, (1e4, 1e-5)]).collect::<Vec<_>>();
    Case {
        name: "steps of 20 N·m and spikes of 10⁴ N·m for 10 µs, tilted by 0.9 rad".into(),
        hard: "the joint passes the torque on across the tilt",
        oracle: "a rigid body by quaternions, extrapolated to order 16",
        scene: "driven",
        methods: usual([9e-13, 6e-11, 5e-9], []),
        mutant: ("drive.tau", 1.0 + 1e-6),
        task: Box::new(move |bench| {
            let mut body = RigidBody::free(5.0, [0.15625, 0.078125, 0.078125], 0.75);
            let mut moving = body.start(Vector3::zeros(), Vector3::zeros(), 0.0, gamma, omega);
            driven(bench, &settings, &spiky, |(tau, time)| {
                body.tau[0] = tau;
                moving = body.run(0.0, &moving, time, 8);
                Exact { r_c: Some(moving.r), axis: moving.axis(), phi: Phi::Whole(moving.phi) }
            })
        }),
    }
}

/// Holds one torque after the other; `exact` is asked after each.
fn driven(
    bench: &super::bench::Bench,
    settings: &[Setting],
    torques: &[Held],
    mut exact: impl FnMut(Held) -> Exact,
) -> Result<Found> {
    let mut rotor = bench.rotor(settings)?;
    for name in ["support.d1", "support.d2", "drive.tau"] {
        rotor.set(name, 0.0)?;
    }
    rotor.start(0.0, 100.0)?;
    let (mut found, mut t) = (Found::nothing(), 0.0);
    for held in torques {
        rotor.set("drive.tau", held.0)?;
        // The step that the rounded times really span.
        let end = t + held.1;
        rotor.advance(end)?;
        found = exact((held.0, end - t)).error(&rotor.shown()?, 1.0, found);
        t = end;
    }
    Ok(found)
}
