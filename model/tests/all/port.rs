//! Ports and probes: beside an independent rigid body; what a probe sees.

use crate::harness::named::Named;
use crate::harness::within;
use nalgebra::{Vector2, Vector3};
use oracles::rigid_body::RigidBody;
use split_rotor_model::effects::Wrench;

const ROTOR: &str = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.75\n\
                     [start]\nr_c = { x = 0.75 }\nv_c = { y = 0.2 }\ngamma = { y = 0.3, z = -0.5 }\nomega = { x = 50.0, z = 4.0 }\n";
const SUPPORT: &str = "[effects.support]\nc1 = 2000.0\nc2 = 500.0\nd1 = 4.0\n";
const SOLVER: &str = "[solver]\nmethod = \"dop853\"\nrelative_tolerance = 1e-13\n";

/// r_c [m], axis [1] and φ [rad] after 0.5 s beside an independent rigid body: measured 7.8e-14. Work [J] and
/// residual [J]: measured 7.1e-14 and 2.4e-12.
const BESIDE: f64 = 3e-13;
const LEDGER: f64 = 1e-11;

#[test]
fn exact_force_and_moment_beside_a_rigid_body() {
    // A force F at p is one at the end a and the moment (p + l) t×F; here held so that F at a is a spring's of the oracle.
    let port = "[[effects.port]]\nposition = -0.75\nm = { x = 2.0, y = -3.0, z = 1.5 }\nf = { x = 5.0, y = 20.0, z = -30.0 }\n";
    let mut named = Named::started(&[ROTOR, SUPPORT, port, SOLVER].concat());
    named.simulation.advance(0.5).expect("a possible motion");
    let body = RigidBody {
        c: [2000.0, 500.0],
        d: [4.0, 0.0],
        pushed: [Vector3::new(5.0, 20.0, -30.0), Vector3::new(2.0, -3.0, 1.5)],
        ..RigidBody::free(5.0, [0.15625, 0.078125, 0.078125], 0.75)
    };
    let start = body.start(
        Vector3::new(0.75, 0.0, 0.0),
        Vector3::new(0.0, 0.2, 0.0),
        0.0,
        Vector2::new(0.3, -0.5),
        Vector3::new(50.0, 0.0, 4.0),
    );
    let end = body.run(0.0, &start, 0.5, 500);
    within("r_c", (end.r - named.vector("r_c")).norm(), BESIDE);
    within("axis", (end.axis() - named.vector("axis")).norm(), BESIDE);
    within("phi", (end.phi - named.get("port[1].theta.x")).abs(), BESIDE);
    within("supplied", (end.work[0] - named.get("energy.supplied")).abs(), LEDGER);
    within("residual", named.get("energy.residual").abs(), LEDGER);
}

#[test]
fn exact_a_port_and_a_probe_show_their_station() {
    let stations =
        "[[effects.port]]\nposition = 0.4\n[[effects.probe]]\nposition = -0.2\n[[effects.probe]]\nposition = 0.4\n";
    let mut named = Named::started(&[ROTOR, SUPPORT, stations, SOLVER].concat());
    named.simulation.advance(0.7).expect("a possible motion");
    let [r, v, t, omega] = ["r_c", "v_c", "axis", "omega"].map(|of| named.vector(of));
    let at = |p: f64| (r + t * p, v + omega.cross(&t) * p);
    within("place", (named.vector("port[1].r") - at(0.4).0).norm(), 1e-14);
    within("velocity", (named.vector("port[1].v") - at(0.4).1).norm(), 1e-13);
    within("omega", (named.vector("port[1].omega") - omega).norm(), 0.0);
    assert_eq!(named.get("port[1].theta.y"), named.get("gamma.y"));
    assert_eq!(named.get("port[1].theta.z"), named.get("gamma.z"));
    for (probe, p) in [(1, -0.2), (2, 0.4)] {
        for (axis, n) in [("y", 1), ("z", 2)] {
            within("probe", (named.get(&format!("probe[{probe}].r.{axis}")) - at(p).0[n]).abs(), 1e-14);
            within("its speed", (named.get(&format!("probe[{probe}].v.{axis}")) - at(p).1[n]).abs(), 1e-13);
        }
    }
}

#[test]
fn no_load_leaves_the_sign_of_a_zero() {
    // +0 + −0 = +0 would not.
    let load = Wrench { moment: Vector3::new(1.0, 0.0, -0.0), ..Wrench::zero() };
    let sum = Wrench::zero() + load;
    let signs = |v: Vector3<f64>| [v.x, v.y, v.z].map(f64::is_sign_negative);
    assert_eq!(signs(sum.force), [true; 3]);
    assert_eq!(signs(sum.moment), [false, false, true]);
}
