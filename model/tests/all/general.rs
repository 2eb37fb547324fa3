//! The general scene: every effect behind a switch. A set of effects that is switched on is the scene of these effects, and
//! what is off is not there. That any set closes the ledger: `random_scenes`.

use crate::harness::named::{Named, names};
use split_rotor_model::effects::CATALOGUE;
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::Integrator;
use split_rotor_model::variable::{Kind, Place, Role};

fn general() -> Named {
    Named::new("rotor", Integrator::Method)
}

/// The same scene with a switch for every effect: how many nodes a table has, its file says.
fn as_general(scene: &Scene) -> Named {
    let text = std::fs::read_to_string(&scene.file).expect("it was read");
    Named::written(&format!("general = true\n{text}"))
}

#[test]
fn every_effect_has_its_switch() {
    let mut rotor = general();
    for info in CATALOGUE {
        for index in 1..=if info.several { 2 } else { 1 } {
            let (block, name) = (Place::effect_block(info.number, index), info.switch_name(index));
            let switch = rotor.variable(&name).clone();
            assert_eq!(switch.place, Place { block, row: 255 }, "{name}");
            assert!(switch.meta.kind == Kind::Boolean && matches!(switch.meta.role, Role::Parameter { .. }));
            let is_on = ["gravity", "support"].contains(&info.name);
            assert_eq!(rotor.get(&name), f64::from(is_on), "{name}");
            let first = (info.metas)()[0].1.name;
            assert_eq!(rotor.place(&format!("{}.{first}", info.block_name(index))), Place { block, row: 0 });
        }
    }
    assert!(!rotor.scene.variables.iter().any(|variable| variable.name.starts_with("effects.bearing[3]")));
}

/// What both have, but for `solver.*`: names and bits.
fn shown(named: &mut Named, of: &Named) -> Vec<(String, u64)> {
    let names = of.scene.variables.iter().map(|variable| variable.name.clone());
    names
        .filter(|name| !name.starts_with("state.chart"))
        .map(|name| (name.clone(), named.get(&name).to_bits()))
        .collect()
}

#[test]
fn what_is_switched_on_is_a_scene() {
    for name in names().into_iter().filter(|name| name != "rotor") {
        let mut scene = Named::new(&name, Integrator::Method);
        let has_table = scene.scene.variables.iter().any(|variable| variable.meta.node().is_some());
        let mut rotor = if has_table { as_general(&scene.scene) } else { general() };
        for (info, index) in &scene.scene.effects {
            assert!(*index <= 2, "the general scene holds two of a kind");
            rotor.set(&info.switch_name(*index), 1.0);
        }
        for switch in ["effects.gravity", "effects.support"] {
            let is_called = scene.scene.effects.iter().any(|(info, index)| info.switch_name(*index) == switch);
            rotor.set(switch, f64::from(is_called));
        }
        for variable in scene.scene.variables.clone().iter().filter(|variable| variable.meta.has_start()) {
            let value = scene.get(&variable.name);
            rotor.set(&variable.name, value);
        }
        let span = 1.0_f64.min(scene.scene.experiment.stop);
        for named in [&mut scene, &mut rotor] {
            named.start();
            for i in 1..=10 {
                named.simulation.advance(0.1 * f64::from(i) * span).expect("a possible motion");
            }
        }
        let list = Named::new(&name, Integrator::Method);
        assert_eq!(shown(&mut scene, &list), shown(&mut rotor, &list), "{name}");
    }
}

#[test]
fn what_is_off_shows_zeros_and_is_not_checked() {
    let mut rotor = general();
    // A damping that would drive, at no place on the rotor.
    rotor.set("bearing[1].cyz", 5.0);
    rotor.set("bearing[1].cyy", -1.0);
    rotor.set("drive.tau", 100.0);
    rotor.set("unbalance[1].mass", 1.0);
    let untouched = {
        let mut rotor = general();
        rotor.start();
        rotor.simulation.advance(0.5).expect("a possible motion");
        rotor.get("axis.y").to_bits()
    };
    rotor.start();
    rotor.simulation.advance(0.5).expect("a possible motion");
    assert_eq!(rotor.get("axis.y").to_bits(), untouched);
    for name in ["bearing[1].F.x", "bearing[1].F.y", "drive.phi", "drive.w", "drive.a", "drag.tau", "port[2].r.x"] {
        assert_eq!(rotor.get(name), 0.0, "{name}");
    }
    let mut rotor = general();
    rotor.set("bearing[1].cyy", -1.0);
    rotor.set("effects.bearing[1]", 1.0);
    let refused = rotor.simulation.start(0.0, None).expect_err("checked where it is on");
    assert_eq!(refused.to_string(), "bearing[1].cyy = -1.0 is not possible: it must be a finite number >= 0");
}
