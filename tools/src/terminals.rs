//! terminalsAndIcons.xml: what of the FMU can be connected at once, and where its icon stands.

use crate::{scenes, templates};
use anyhow::Result;
use minijinja::{Value, context};
use split_rotor_model::effects::Terminal;
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::Role;
use split_rotor_model::variables::Variable;

/// The scene's terminalsAndIcons.xml.
pub fn terminals_and_icons(scene: &Scene) -> Result<String> {
    let called = scene.effects.iter().filter_map(|(info, index)| {
        let variables: Vec<_> = scenes::variables_of(scene, info, *index).collect();
        info.terminal.map(|terminal| described(terminal, &info.block_name(*index), &variables))
    });
    render(called.collect())
}

fn render(terminals: Vec<Value>) -> Result<String> {
    templates::render("terminalsAndIcons/terminalsAndIcons.xml", context! { terminals })
}

/// A terminal of this name, of these variables of an effect: all but its parameters.
fn described(terminal: Terminal, name: &str, variables: &[&Variable]) -> Value {
    let members: Vec<_> = variables
        .iter()
        .filter(|variable| !matches!(variable.meta.role, Role::Parameter { .. }))
        .map(|variable| {
            let kind = if terminal.flows.contains(&variable.meta.name) { "inflow" } else { "signal" };
            context! { variable => &variable.name, name => variable.meta.name, kind }
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
