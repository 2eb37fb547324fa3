//! terminalsAndIcons.xml: what of the FMU can be connected at once, and where its icon stands.

use crate::{scenes, templates};
use anyhow::Result;
use minijinja::{Value, context};
use split_rotor_model::effects::{Terminal, housing};
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::Role;
use split_rotor_model::variables::Variable;

/// Where other models are connected to a scene.
pub struct Connector<'s> {
    /// Its name.
    pub name: String,
    /// What it is.
    pub terminal: Terminal,
    /// Its variables.
    pub variables: Vec<&'s Variable>,
    /// Booleans that make it act in a general scene.
    pub switches: Vec<String>,
}

/// The terminals of a scene: those of its effects, and of their housings.
pub fn of_scene(scene: &Scene) -> impl Iterator<Item = Connector<'_>> {
    scene.effects.iter().flat_map(|(info, index)| {
        let (name, switch) = (info.block_name(*index), info.switch_name(*index));
        let all = scenes::variables_of(scene, info, *index);
        let (of_housing, variables): (Vec<_>, Vec<_>) = all.partition(|variable| variable.place.is_of_housing());
        let housing = (!of_housing.is_empty()).then(|| Connector {
            name: format!("{name}.housing"),
            terminal: housing::TERMINAL,
            variables: of_housing,
            switches: vec![switch.clone(), format!("{name}.housing.moves")],
        });
        let own = info.terminal.map(|terminal| Connector { name, terminal, variables, switches: vec![switch] });
        own.into_iter().chain(housing)
    })
}

/// The scene's terminalsAndIcons.xml.
pub fn terminals_and_icons(scene: &Scene) -> Result<String> {
    render(of_scene(scene).map(|of| described(of.terminal, &of.name, &of.variables)).collect())
}

fn render(terminals: Vec<Value>) -> Result<String> {
    templates::render("terminalsAndIcons/terminalsAndIcons.xml", context! { terminals })
}

/// A terminal of this name, of these variables: all but parameters.
fn described(terminal: Terminal, name: &str, variables: &[&Variable]) -> Value {
    let members: Vec<_> = variables
        .iter()
        .filter(|variable| !matches!(variable.meta.role, Role::Parameter { .. }))
        .map(|variable| {
            let member = &variable.name[name.len() + 1..];
            let kind = if terminal.flows.contains(&member) { "inflow" } else { "signal" };
            context! { variable => &variable.name, name => member, kind }
        })
        .collect();
    context! { name, kind => terminal.kind, members }
}

#[cfg(test)]
mod tests {
    use super::*;
    use split_rotor_model::effects::CATALOGUE;

    #[test]
    fn a_terminal_has_all_of_its_effect_but_parameters() {
        let scene = scenes::find("paper");
        let (info, index) = scene.effects.iter().find(|(info, _)| info.name == "support").unwrap();
        let variables: Vec<_> = scenes::variables_of(&scene, info, *index).collect();
        let terminal = described(Terminal { kind: "a <kind>", flows: &["F.x"] }, "support", &variables);
        let xml = render(vec![terminal]).unwrap();
        assert!(xml.contains(r#"<Terminal name="support" matchingRule="bus" terminalKind="a &lt;kind&gt;">"#), "{xml}");
        let members: Vec<_> = xml.lines().filter(|line| line.contains("TerminalMemberVariable")).collect();
        assert_eq!(members.len(), 6, "{xml}");
        let first = r#"<TerminalMemberVariable variableName="support.F.x" memberName="F.x" variableKind="inflow"/>"#;
        let second = r#"<TerminalMemberVariable variableName="support.F.y" memberName="F.y" variableKind="signal"/>"#;
        assert_eq!([members[0].trim(), members[1].trim()], [first, second]);
    }

    #[test]
    fn flows_are_members() {
        for info in CATALOGUE {
            for flow in info.terminal.map_or(&[] as &[_], |terminal| terminal.flows) {
                let is_member = |role| !matches!(role, Role::Parameter { .. });
                let found = (info.metas)().iter().any(|(_, meta)| meta.name == *flow && is_member(meta.role));
                assert!(found, "{}.{flow}", info.name);
            }
        }
    }
}
