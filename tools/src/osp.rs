//! OspModelDescription.xml: the terminals of a scene as groups of variables, each of which a tool of the Open Simulation Platform connects
//! by its name (OSP-IS 1.0.1).

use crate::{templates, terminals};
use anyhow::Result;
use minijinja::{Value, context};
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::Role;
use split_rotor_model::variables::Variable;

/// By the name of its unit, what a quantity is called there, in the order in which groups stand.
const KINDS: [(&str, &str); 8] = [
    ("N", "Force"),
    ("N.m", "Torque"),
    ("m/s", "LinearVelocity"),
    ("rad/s", "AngularVelocity"),
    ("m", "LinearDisplacement"),
    ("rad", "AngularDisplacement"),
    ("m/s2", "LinearAcceleration"),
    ("rad/s2", "AngularAcceleration"),
];

/// What holds a load, and the velocity that goes with it.
const PORTS: [(&str, &str, [&str; 2]); 2] = [
    ("LinearMechanicalPort", "linear", ["Force", "LinearVelocity"]),
    ("AngularMechanicalPort", "angular", ["Torque", "AngularVelocity"]),
];

/// Variables of one quantity.
#[derive(Clone)]
struct Group<'v> {
    kind: &'static str,
    name: String,
    variables: Vec<&'v Variable>,
}

/// The scene's OspModelDescription.xml. Each terminal is a group of all its quantities, and a mechanical port of each load and its velocity.
pub fn osp_model_description(scene: &Scene) -> Result<String> {
    let terminals: Vec<_> = terminals::of_scene(scene).map(|of| (of.name, groups(of.variables.into_iter()))).collect();
    let whole = terminals.iter().map(|(name, groups)| nest("Generic", name, groups));
    let ports = PORTS.iter().flat_map(|&(kind, name, members)| {
        terminals.iter().filter_map(move |(terminal, groups)| {
            let name = format!("{terminal}.{name}");
            let member = |kind| groups.iter().find(|group| group.kind == kind);
            let [load, velocity] = members.map(member);
            let mut members = [load?.clone(), velocity?.clone()];
            members.iter_mut().for_each(|of| of.name = of.name.replacen(terminal, &name, 1));
            Some(nest(kind, &name, &members))
        })
    });
    templates::render("osp/OspModelDescription.xml", context! { nests => whole.chain(ports).collect::<Value>() })
}

/// These variables by their quantities, but parameters and what has no group there.
fn groups<'v>(variables: impl Iterator<Item = &'v Variable>) -> Vec<Group<'v>> {
    let mut groups = Vec::<Group>::new();
    for variable in variables.filter(|variable| !matches!(variable.meta.role, Role::Parameter { .. })) {
        let Some((_, kind)) = KINDS.iter().find(|(unit, _)| *unit == variable.meta.unit.name) else { continue };
        let name = axis(&variable.name).map_or(variable.name.as_str(), |(vector, _)| vector);
        match groups.iter_mut().find(|group| group.name == name) {
            Some(group) => group.variables.push(variable),
            None => groups.push(Group { kind, name: name.into(), variables: vec![variable] }),
        }
    }
    groups.sort_by_key(|group| KINDS.iter().position(|(_, kind)| *kind == group.kind));
    groups
}

/// The name of a vector, and of the axis along which this is one of its three numbers.
fn axis(name: &str) -> Option<(&str, &str)> {
    name.rsplit_once('.').filter(|(_, axis)| ["x", "y", "z"].contains(axis))
}

fn nest(kind: &str, name: &str, groups: &[Group]) -> Value {
    let variable = |variable: &&Variable| {
        let axis = axis(&variable.name).map(|(_, axis)| axis);
        context! { name => &variable.name, unit => variable.meta.unit.name, axis }
    };
    let group = |of: &Group| {
        context! { kind => of.kind, name => &of.name, variables => of.variables.iter().map(variable).collect::<Value>() }
    };
    context! { kind, name, groups => groups.iter().map(group).collect::<Value>() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes;
    use std::collections::BTreeSet;

    /// The values of an attribute, in order.
    fn all<'x>(xml: &'x str, attribute: &str) -> Vec<&'x str> {
        xml.split(&format!(" {attribute}=\"")).skip(1).map(|rest| rest.split_once('"').unwrap().0).collect()
    }

    #[test]
    fn a_port_is_a_group_of_all_its_vectors_and_two_mechanical_ports() {
        let xml = osp_model_description(&scenes::find("coupled")).unwrap();
        let expected =
            ["port[1]", "port[1].f", "port[1].m", "port[1].v", "port[1].omega", "port[1].r", "port[1].theta"];
        assert_eq!(all(&xml, "name")[..expected.len()], expected, "{xml}");
        let linear = "    <LinearMechanicalPort name=\"port[1].linear\">\n      <Force name=\"port[1].linear.f\">\n        \
                      <Variable ref=\"port[1].f.x\" unit=\"N\" axis=\"x\"/>\n        <Variable ref=\"port[1].f.y\" unit=\"N\" axis=\"y\"/>\n";
        assert!(xml.contains(linear), "{xml}");
    }

    #[test]
    fn a_drive_is_a_torque_with_a_velocity_and_no_linear_port() {
        let xml = osp_model_description(&scenes::find("driven")).unwrap();
        let expected = ["drive", "drive.tau", "drive.w", "drive.phi", "drive.a", "drive.angular"];
        assert_eq!(all(&xml, "name")[..expected.len()], expected, "{xml}");
        assert!(xml.contains("<Variable ref=\"drive.w\" unit=\"rad&#x2f;s\"/>") && !xml.contains("Linear"), "{xml}");
    }

    #[test]
    fn no_two_groups_have_one_name_and_all_variables_are_there() {
        for name in ["rotor", "paper", "reaction_wheel"] {
            let scene = scenes::find(name);
            let xml = osp_model_description(&scene).unwrap();
            let names = all(&xml, "name");
            assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{xml}");
            let known: BTreeSet<_> = scene.variables.iter().map(|variable| variable.name.as_str()).collect();
            assert!(all(&xml, "ref").into_iter().all(|variable| known.contains(variable)), "{xml}");
            assert_eq!(names.is_empty(), name == "paper", "{xml}");
        }
    }
}
