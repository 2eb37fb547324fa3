//! Scenes with several effects of a kind: their names, their values, and what is said of those that cannot be.

use crate::harness::named::{Named, ROTOR};
use crate::harness::within;
use split_rotor_model::scene::Scene;
use std::path::Path;

/// What is said of a scene that has this below the rotor.
fn error(rest: &str) -> String {
    Scene::parse(Path::new("bad.toml"), &format!("{ROTOR}{rest}")).expect_err("a scene that cannot be").to_string()
}

#[test]
fn several_of_a_kind_are_numbered_as_the_file_has_them() {
    let bearing = |position: f64, kyy: f64| format!("[[effects.bearing]]\nposition = {position:?}\nkyy = {kyy:?}\n");
    let mut scene =
        Named::written(&[ROTOR.to_owned(), bearing(0.5, 1e3), bearing(-0.25, 2e3), bearing(0.0, 3e3)].concat());
    for (index, position, kyy) in [(1, 0.5, 1e3), (2, -0.25, 2e3), (3, 0.0, 3e3)] {
        assert_eq!(scene.get(&format!("bearing[{index}].position")), position);
        assert_eq!(scene.get(&format!("bearing[{index}].kyy")), kyy);
        // Its own block of value references.
        assert_eq!(scene.place(&format!("bearing[{index}].position")).block, 16 + 4 * 5 + index - 1);
    }
    assert!(!scene.scene.variables.iter().any(|variable| variable.name.starts_with("bearing[4]")));
}

#[test]
fn exact_each_of_a_kind_acts_with_its_own_values() {
    // Two bearings at the ends of the rotor, off centre by 1 mm along y.
    let mut scene = Named::written(&format!(
        "{ROTOR}[start]\nr_c = {{ y = 0.001 }}\n[[effects.bearing]]\nposition = 0.5\nkyy = 1e3\n\
         [[effects.bearing]]\nposition = -0.25\nkyy = 2e3\nkzy = 4e3\n"
    ));
    for (name, force) in [
        ("bearing[1].F.y", -1.0),
        ("bearing[1].F.z", 0.0),
        ("bearing[2].F.y", -2.0),
        ("bearing[2].F.z", -4.0),
        ("der(state.v.y)", -3.0 / 5.0),
        ("der(state.v.z)", -4.0 / 5.0),
        ("der(state.K.y)", -0.25 * 4.0),
        ("der(state.K.z)", -0.5 + 0.5),
    ] {
        assert!((scene.get(name) - force).abs() < 1e-12, "{name} = {}", scene.get(name));
    }
}

#[test]
fn messages_of_several_effects_that_cannot_be() {
    let bearings = "[[effects.bearing]]\nposition = 0.0\n";
    for (rest, message) in [
        (
            "[effects.bearing]\nposition = 0.0\n".to_owned(),
            "bad.toml, line 6: there may be several of bearing: write [[effects.bearing]], once for each, up to 4",
        ),
        (bearings.repeat(5), "bad.toml, line 6: [[effects.bearing]] stands 5 times: there may be up to 4"),
        (
            format!("[effects.bearing]\nposition = 0.0\n{bearings}"),
            "bad.toml, line 8: is not TOML: duplicate key `bearing`",
        ),
        (format!("{ROTOR}m = 1.0\n"), "bad.toml, line 6: is not TOML: duplicate key `rotor`"),
        ("[start]\nphi = 1.0\n\"phi\" = 2.0\n".into(), "bad.toml, line 8: is not TOML: duplicate key `\"phi\"`"),
        ("[start]\nr_c = { x = 1.0, x = 2.0 }\n".into(), "bad.toml, line 7: is not TOML: duplicate key `x`"),
        (
            "[[effects.support]]\nc1 = 1.0\n".into(),
            "bad.toml, line 6: there is only one support: write [effects.support]",
        ),
        (
            format!("{bearings}[[effects.bearing]]\nkyy = 1.0\n"),
            "bad.toml: `bearing[2].position` is missing: give the place along t from c in m as `position = ...` under \
             [[effects.bearing]]",
        ),
        (
            format!("{bearings}k_yy = 1.0\n"),
            "bad.toml, line 8: unknown key `effects.bearing[1].k_yy`: [[effects.bearing]] knows position, kyy, kyz, kzy, \
             kzz, cyy, cyz, czy, czz, kxx, cxx, kt, ct, speed",
        ),
        (
            format!("{bearings}{bearings}cyy = -1.0\n"),
            "bad.toml, line 10: effects.bearing[2].cyy = -1.0 is not possible: it must be a finite number >= 0",
        ),
        (
            format!("{bearings}cyy = 1.0\nczz = 4.0\ncyz = 2.0\nczy = 2.5\n"),
            "bad.toml, line 10: bearing[1].cyz = 2.0 is not possible: it must be such that (cyz + czy)/2 is at most \
             sqrt(cyy czz) = 2.0 in size, or the bearing would drive what it damps",
        ),
        (
            "[effects]\nbearing = 5\n".into(),
            "bad.toml, line 7: there may be several of bearing: write [[effects.bearing]], once for each, up to 4",
        ),
        (
            "[effects]\nbearing = [5]\n".into(),
            "bad.toml, line 7: effects.bearing[1] = 5 is not possible: it must be a table",
        ),
    ] {
        assert_eq!(error(&rest), message);
    }
}

#[test]
fn the_support_point_need_not_be_told_where_there_is_no_support() {
    let without =
        ROTOR.lines().filter(|line| !line.starts_with("l ")).map(|line| format!("{line}\n")).collect::<String>();
    let parse = |rest: &str| Scene::parse(Path::new("bad.toml"), &format!("{without}{rest}"));
    let held = parse("[[effects.bearing]]\nposition = 0.0\n").expect("it has no support");
    assert_eq!(held.parameters().setup.rotor.l, 0.0);
    let refused = parse("[effects.support]\nc1 = 1.0\n").expect_err("where is a?").to_string();
    assert!(
        refused.starts_with("bad.toml: `rotor.l` is missing: give the distance from the support point a"),
        "{refused}"
    );
}

#[test]
fn what_no_xml_can_hold_is_refused() {
    let titled = |title: &str, file: &str| Scene::parse(Path::new(file), &format!("title = {title}\n{ROTOR}"));
    let says = "is not possible: it must be one line without control characters";
    for title in [r#""\u0001""#, r#""two\nlines""#, r#""\u007f""#, r#""\ufffe""#] {
        let refused = titled(title, "bad.toml").expect_err("no line of XML").to_string();
        assert_eq!(refused, format!("bad.toml, line 1: title = {title} {says}"));
    }
    let refused = titled(r#""A rotor""#, "a\u{1}.toml").expect_err("no name in XML").to_string();
    assert!(refused.ends_with("a file of a scene has no control characters in its name"), "{refused}");
    // Any other letter is welcome.
    assert_eq!(titled(r#""Läufer φ <&> 转子""#, "läufer.toml").expect("a scene").title, "Läufer φ <&> 转子");
}

#[test]
fn a_folder_is_no_scene() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let given = scenes.display().to_string();
    let refused = Scene::find(&given, &scenes).expect_err("a folder").to_string();
    assert_eq!(refused, format!("{given}: is a folder: a scene is a TOML file"));
}

/// A host reads a run at so many points at most, if it takes the scene's own step.
const POINTS: f64 = 1e4;

#[test]
fn regress_no_scene_asks_a_host_for_too_many_points() {
    for name in crate::harness::named::names() {
        let experiment = Named::new(&name, split_rotor_model::simulation::Integrator::Method).scene.experiment;
        let points = (experiment.stop - experiment.start) / experiment.step;
        assert!(points <= POINTS, "{name} asks for {points} points");
    }
}

/// What turns over by any method at the end of the scene [rad] and what is exact: measured 3e-7.
const TURNED_OVER: f64 = 1e-6;

#[test]
fn regress_what_turns_over_does_so_alike_by_every_method() {
    let turned = |method: f64| {
        let mut named = Named::new("dzhanibekov", split_rotor_model::simulation::Integrator::Method);
        named.set("solver.method", method);
        named.start();
        named.simulation.advance(named.scene.experiment.stop).expect("a possible motion");
        named.get("phi")
    };
    // Nothing acts on it, so auto takes one exact drift.
    let exact = turned(1.0);
    for method in [2.0, 3.0, 5.0, 6.0] {
        within(&format!("method {method}"), (turned(method) - exact).abs(), TURNED_OVER);
    }
}
