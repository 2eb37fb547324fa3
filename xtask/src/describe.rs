//! `describe`: what a scene holds, as a scene with every key that it knows; and the reference of all scenes,
//! docs/scene-reference.md.

use crate::scenes;
use anyhow::Result;
use split_rotor_model::scene::reference::{self, Key, Section};
use split_rotor_model::scene::{Input, Scene};
use split_rotor_model::xml;

/// Prints the keys of a scene, or its modelDescription.xml.
pub fn describe(scene: &str, as_xml: bool) -> Result<()> {
    let scene = scenes::find(scene)?;
    print!("{}", if as_xml { xml::model_description(&scene) } else { described(&scene) });
    Ok(())
}

/// A scene whose file gives every key, those at their default in a comment.
fn described(scene: &Scene) -> String {
    let general =
        if scene.general { format!("general = true\n# Off at first: {}\n", off(scene)) } else { String::new() };
    let title = scene.title.replace('\\', r"\\").replace('"', "\\\"");
    let mut text = format!("# A line that begins with `# ` is a key at its default.\ntitle = \"{title}\"\n{general}");
    for Section { heading, effect, keys } in reference::of(scene) {
        let law = effect.map_or_else(String::new, |info| format!("  # {}", info.law));
        text += &format!("\n{heading}{law}\n");
        let lines: Vec<_> = keys.iter().filter_map(|key| Some((line(key)?, key))).collect();
        let width = lines.iter().map(|(line, _)| line.chars().count()).max().unwrap_or(0);
        for (line, key) in lines {
            text += &format!("{line:width$}  # {}\n", remark(key));
        }
    }
    for Input { name, time, value } in &scene.inputs {
        text += &format!("\n[[input]]\nname = \"{name}\"\ntime = {time:?}\nvalue = {value:?}\n");
    }
    text
}

/// The effects of a general scene that do not act at first.
fn off(scene: &Scene) -> String {
    let value = scenes::values(scene);
    let switches = scene.effects.iter().map(|(info, index)| info.switch_name(*index));
    switches.filter(|name| value(name) == Some(0.0)).collect::<Vec<_>>().join(", ")
}

/// The line of a key; None where the file has none.
fn line(key: &Key) -> Option<String> {
    let Key { name, value, default, is_array, .. } = key;
    match value {
        Some(value) if Some(value) == default.as_ref() => Some(format!("# {name} = {value}")),
        Some(value) => Some(format!("{name} = {value}")),
        None => is_array.then(|| format!("# {name} = [...]")),
    }
}

/// Unit, meaning and bound of a key.
fn remark(Key { unit, meaning, bound, .. }: &Key) -> String {
    let unit = if unit.is_empty() { String::new() } else { format!("[{unit}] ") };
    let bound = if bound.is_empty() { String::new() } else { format!("; {bound}") };
    format!("{unit}{meaning}{bound}")
}

#[cfg(test)]
mod tests {
    use super::described;
    use crate::{paths, scenes};
    use minijinja::{Environment, UndefinedBehavior, Value, context};
    use split_rotor_model::effects::{CATALOGUE, Info};
    use split_rotor_model::scene::Scene;
    use split_rotor_model::scene::reference::{self, Key, Section};
    use std::path::Path;

    #[test]
    fn exact_what_is_described_is_the_scene_again() {
        let with_inputs = "[rotor]\nm = 1\nJa = 1\nJt = 1\n[effects.drive]\n[[input]]\nname = \"drive.tau\"\ntime = [0, 1]\n\
                           value = [\"1 N mm\", 2]\n";
        let with_inputs = Scene::parse(Path::new("driven.toml"), with_inputs).unwrap_or_else(|error| panic!("{error}"));
        let scenes = Scene::names(&paths::scenes()).into_iter().map(|name| scenes::find(&name).unwrap());
        for scene in scenes.chain([with_inputs]) {
            let text = described(&scene);
            let again = Scene::parse(Path::new("again.toml"), &text).unwrap_or_else(|error| panic!("{text}\n{error}"));
            assert_eq!((&again.starts, again.experiment), (&scene.starts, scene.experiment), "{text}");
            assert_eq!((again.title, again.general, again.inputs), (scene.title, scene.general, scene.inputs));
            // Every line of a default is one that may be given.
            let given = text.lines().map(|line| match line.strip_prefix("# ") {
                Some(key) if key.contains(" = ") && !key.contains("[...]") => key,
                _ => line,
            });
            let given: String = given.map(|line| format!("{line}\n")).collect();
            let full = Scene::parse(Path::new("full.toml"), &given).unwrap_or_else(|error| panic!("{given}\n{error}"));
            assert_eq!((full.starts, full.experiment), (scene.starts, scene.experiment), "{given}");
        }
    }

    fn row(key: &Key) -> Value {
        let Key { name, is_array, default, unit, bound, meaning, .. } = key;
        let [bound, meaning] = [bound, meaning].map(|words| words.replace('|', "\\|"));
        context! { name, is_array, default, unit => *unit, bound, meaning }
    }

    /// The effects that cannot act beside this one.
    fn others(info: &Info) -> Vec<&'static str> {
        let excludes = |one: &Info, other: &Info| one.excludes.contains(&other.name);
        let others = CATALOGUE.iter().filter(|other| excludes(info, other) || excludes(other, info));
        others.map(|other| other.name).collect()
    }

    #[test]
    fn golden_reference_of_scenes() {
        let section = |section: &Section| {
            let keys: Value = section.keys.iter().map(row).collect();
            let effect = section.effect.map(|info| {
                let where_empty: Value = info.where_empty.iter().map(|&(key, value)| context! { key, value }).collect();
                context! { law => info.law, several => info.several, excludes => others(info), where_empty }
            });
            context! { heading => section.heading.clone(), effect, keys }
        };
        let [prefixed, others] = reference::units();
        let sections: Value = reference::all().iter().map(section).collect();
        let mut environment = Environment::new();
        environment.set_undefined_behavior(UndefinedBehavior::Strict);
        let values = context! { sections, prefixed, others, prefixes => reference::prefixes() };
        let text = environment.render_str(include_str!("describe/reference.md"), values).unwrap() + "\n";
        let file = paths::root().join("docs/scene-reference.md");
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            std::fs::write(&file, &text).unwrap();
        }
        let remedy = "run `UPDATE_GOLDEN=1 cargo test -p xtask reference`";
        assert!(std::fs::read_to_string(&file).unwrap() == text, "docs/scene-reference.md is out of date: {remedy}");
    }

    #[test]
    fn each_effect_has_a_law() {
        let without: Vec<_> = CATALOGUE.iter().filter(|info| info.law.is_empty()).map(|info| info.name).collect();
        assert!(without.is_empty(), "{without:?}");
    }
}
