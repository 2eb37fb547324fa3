//! What is said of directions in which nothing holds a rotor.

use crate::harness::named::{Named, names};
use split_rotor_model::simulation::Integrator;

/// A rotor that spins, with these effects.
fn rotor(effects: &str) -> String {
    format!("[rotor]\nm = 12.0\nJa = 0.04\nJt = 0.12\nl = 0.3\n[start]\nomega.x = 100.0\n{effects}")
}

/// Two bearings with these coefficients, at these places.
fn bearings(places: &[f64], coefficients: &str) -> String {
    places.iter().map(|place| format!("[[effects.bearing]]\nposition = {place:?}\n{coefficients}")).collect()
}

const GRAVITY: &str = "[effects.gravity]\n";
const BOTH: [f64; 2] = [-0.12, 0.12];
const ROUND: &str = "kyy = 1e6\nkzz = 1e6\n";

/// What is said of it, by a run of ours and by a host's.
fn said(effects: &str) -> Option<(String, bool)> {
    let said = [Integrator::Method, Integrator::Host].map(|integrator| {
        let mut named = Named::written_for(&rotor(effects), integrator);
        named.start();
        named.simulation.unheld().map(|unheld| (unheld.to_string(), unheld.is_mere_axial()))
    });
    assert_eq!(said[0], said[1]);
    said[0].clone()
}

/// Names of another program: along z nothing holds the rotor, and against tilt about y.
#[test]
fn regress_exact_a_rotor_that_nothing_holds_in_a_direction_is_told() {
    let named_otherwise = bearings(&BOTH, "kxx = 1e6\nkyy = 0.8e6\ncxx = 1e3\n");
    // 12 kg · 9.81 m/s² = 118 N fall.
    let falls = "nothing holds the rotor along z (a load of 117.720 N acts there) and against tilt about y (any push there moves it away): \
                 give it kyy and kzz of a bearing along y and z, kzz of two bearings apart, or kt of one, against tilt";
    assert_eq!(said(&format!("{GRAVITY}{named_otherwise}")), Some((falls.into(), false)));
    let (drifts, _) = said(&named_otherwise).expect("nothing holds it along z");
    assert!(drifts.starts_with("nothing holds the rotor along z (any push there moves it away"), "{drifts}");
}

#[test]
fn exact_what_holds_a_rotor() {
    // What the effects are, and the beginning of what is said of them.
    let one = |place: f64, coefficients: &str| bearings(&[place], coefficients);
    let cases: &[(String, Option<&str>)] = &[
        // Held in all directions.
        ("[effects.support]\nc1 = 1e5\nc2 = 1e3\n".into(), None),
        (format!("{GRAVITY}{}", bearings(&BOTH, &format!("{ROUND}kxx = 1e5\n"))), None),
        (one(0.0, &format!("{ROUND}kxx = 1e5\nkt = 1e3\n")), None),
        // Cross coupling holds too, though it drives a whirl.
        (bearings(&BOTH, "kyz = 1e5\nkzy = -1e5\nkxx = 1e5\n"), None),
        // Free, or nothing that holds.
        (String::new(), None),
        (GRAVITY.into(), None),
        ("[effects.drag]\nlinear = 1e-3\n".into(), None),
        (format!("{GRAVITY}[effects.support]\nc2 = 1e-300\n"), None),
        // What is there to hold it only damps.
        (
            format!("{GRAVITY}{}", bearings(&BOTH, "cyy = 1e3\nczz = 1e3\n")),
            Some("nothing holds the rotor along x, y and z (a load of 117.720 N"),
        ),
        (
            format!("{GRAVITY}{}", bearings(&BOTH, "kyy = 1e6\nczz = 1e3\nkxx = 1e5\n")),
            Some("nothing holds the rotor along z (a load of 117.720 N"),
        ),
        // Others may hold it.
        (format!("{GRAVITY}[[effects.port]]\nposition = 0.1\n{}", one(0.1, ROUND)), None),
        // Along its axis alone.
        (
            format!("{GRAVITY}{}", bearings(&BOTH, ROUND)),
            Some("nothing holds the rotor along x, its axis, and no load"),
        ),
        (one(0.1, &format!("{ROUND}kt = 1e3\n")), Some("nothing holds the rotor along x, its axis, and no load")),
        (
            format!("[effects.gravity]\ng = {{ x = -9.81 }}\n{}", bearings(&BOTH, ROUND)),
            Some("nothing holds the rotor along x (a load of 117.720 N"),
        ),
        // One bearing, at c and off it: it turns about that. At 0.1 m the weight has a moment of 11.8 N·m about y.
        (
            one(0.0, &format!("{ROUND}kxx = 1e5\n")),
            Some("nothing holds the rotor against tilt about y and z (any push"),
        ),
        (
            format!("{GRAVITY}{}", one(0.1, &format!("{ROUND}kxx = 1e5\n"))),
            Some("nothing holds the rotor against tilt about y (a load of 11.772 N.m"),
        ),
        ("[effects.support]\nc1 = 1e5\n".into(), Some("nothing holds the rotor against tilt about y and z (any push")),
        // Springs in one oblique direction of the plane.
        (
            bearings(&BOTH, "kyy = 1e6\nkyz = 1e6\nkzy = 1e6\nkzz = 1e6\nkxx = 1e5\n"),
            Some("nothing holds the rotor along (0.00, -0.71, 0.71) (any push"),
        ),
        // Only against tilt, and only along the axis.
        (one(0.0, "kt = 1e3\n"), Some("nothing holds the rotor along x, y and z (any push")),
        (one(0.0, "kxx = 1e3\n"), Some("nothing holds the rotor along y and z (any push")),
        // A shaft within a ring falls onto that.
        (
            format!(
                "{GRAVITY}{}[effects.support]\nc2 = 1e3\n",
                "[[effects.rub]]\nposition = 0.0\nradius = 0.05\ngap = 1e-3\nstiffness = 1e6\nv0 = 0.01\n"
            ),
            Some("nothing holds the rotor along x, its axis, and no load"),
        ),
    ];
    for (effects, expected) in cases {
        let found = said(effects);
        match (expected, &found) {
            (None, None) => {}
            (Some(expected), Some((found, _))) if found.starts_with(expected) => {}
            _ => panic!("{effects}\nexpected {expected:?}\nfound {found:?}"),
        }
    }
}

/// A spring of 1 mN/m on one of two bearings: by 14 N·m over 5.8e-5 N·m/rad the rotor would tilt by some 1e5 rad. It fell by 81 mm in 0.2 s.
#[test]
fn regress_what_hardly_holds_a_rotor_is_told() {
    let bearing = |place, kzz| bearings(&[place], &format!("kyy = 1e6\nkzz = {kzz:?}\nkxx = 1e6\n"));
    let held_by = |kzz| format!("{GRAVITY}{}{}", bearing(-0.12, 1e6), bearing(0.12, kzz));
    for kzz in [1e-3, 1e-2, 0.1, 1.0] {
        let (falls, is_mere_axial) = said(&held_by(kzz)).expect("it falls");
        assert!(falls.starts_with("hardly anything holds the rotor against tilt about y (a load of 14.1"), "{falls}");
        assert!(!is_mere_axial);
    }
    // Soft, and held: by 0.1 m and 0.4 rad, and without a load.
    assert_eq!(said(&held_by(600.0)), None);
    assert_eq!(said(&held_by(1e-3).replace(GRAVITY, "")), None);
    // Both: by 59 km and by 590 m.
    for kzz in [1e-3, 0.1] {
        let soft = bearings(&BOTH, &format!("kyy = 1e6\nkzz = {kzz:?}\nkxx = 1e6\n"));
        let (falls, _) = said(&format!("{GRAVITY}{soft}")).expect("it falls");
        assert!(
            falls.starts_with("hardly anything holds the rotor along z (a load of 117.720 N acts there)"),
            "{falls}"
        );
    }
}

/// A top tilts over and precesses by its own weight: that holds it or drives it, and the watch of growth reports which.
#[test]
fn exact_a_weight_on_a_point_is_no_free_direction() {
    for g in [-9.81, 9.81] {
        for tilt in [1e-4, 0.5, 2.0] {
            let text = format!("[effects.gravity]\ng = {{ x = {g:?} }}\n[effects.support]\nc1 = 1e5\n");
            let text = rotor(&text).replace("omega.x", &format!("gamma.z = {tilt:?}\nomega.x"));
            assert_eq!(Named::started(&text).simulation.unheld(), None, "{g} m/s², {tilt} rad");
        }
    }
}

#[test]
fn what_is_said_of_the_scenes() {
    let said = names().into_iter().filter_map(|name| {
        let mut named = Named::new(&name, Integrator::Method);
        named.start();
        let unheld = named.simulation.unheld().filter(|unheld| !unheld.is_mere_axial())?;
        Some(format!("{name}: {unheld}"))
    });
    // A disk that moves in its plane alone.
    let jeffcott = "jeffcott: nothing holds the rotor against tilt about y and z (any push there moves it away): \
                    give it kyy and kzz of two bearings apart, or kt of one, against tilt";
    assert_eq!(said.collect::<Vec<_>>(), [jeffcott]);
}
