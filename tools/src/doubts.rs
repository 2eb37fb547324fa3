//! Where a result stands on coefficients that nobody gave: a table is left, or constants do not turn round with the rotor.

use crate::numbers::rounded;
use serde_json::{Value, json};
use split_rotor_model::effects::{Doubt, Effects};
use split_rotor_model::scene::Scene;

/// What is doubtful of the laws of a scene at ω_φ from the first to the second of these [rad/s], each with the name of its effect.
pub fn of(scene: &Scene, speeds: [f64; 2]) -> Vec<(String, Doubt)> {
    let mut all = Vec::new();
    scene.parameters().effects.doubts(speeds, None, &mut |block, doubt| all.push((block.to_owned(), doubt)));
    all
}

/// The effects whose coefficients are held at a speed from the first to the second of these [rad/s], beyond or below their tables.
pub fn held(scene: &Scene, speeds: [f64; 2]) -> Vec<String> {
    let all = of(scene, speeds);
    let is_held = |doubt: &Doubt| !matches!(doubt, Doubt::Backward { .. });
    all.into_iter().filter(|(_, doubt)| is_held(doubt)).map(|(block, _)| block).collect()
}

/// What is doubtful of the laws of a scene at these speeds [rad/s], a sentence each, without its full stop.
pub fn words(scene: &Scene, speeds: [f64; 2]) -> impl Iterator<Item = String> {
    of(scene, speeds).into_iter().map(|(block, doubt)| doubt.words(&block))
}

/// A speed [rad/s] as tables show it, marked where coefficients are held.
pub fn marked(scene: &Scene, speed: f64) -> String {
    rounded(speed) + mark_within(scene, [speed; 2])
}

/// What marks what is said of all speeds from the first to the second of these [rad/s], where coefficients are held at any of them.
pub fn mark_within(scene: &Scene, speeds: [f64; 2]) -> &'static str {
    if held(scene, speeds).is_empty() { "" } else { " *" }
}

/// A table of these speeds [rad/s], in Markdown, with what is doubtful of it below; as it is where every law is known.
pub fn below(table: String, scene: &Scene, speeds: &[f64]) -> String {
    let ends = speeds.first().zip(speeds.last()).map(|(first, last)| [*first, *last]);
    let lines: String =
        ends.into_iter().flat_map(|ends| words(scene, ends)).map(|line| format!("- {line}.\n")).collect();
    if lines.is_empty() {
        return table;
    }
    let table = table.trim_end();
    format!("{table}\n\n\\* What is found there stands on coefficients that the scene does not have:\n\n{lines}\n")
}

/// The tables of a scene that may be left: the effect and the speeds between which it is known [rad/s].
pub fn tables(scene: &Scene) -> Value {
    let known = of(scene, [-f64::MAX, f64::MAX]).into_iter().filter_map(|(block, doubt)| match doubt {
        Doubt::Beyond { known: [from, to], .. } => Some(json!({ "effect": block, "from_rad_s": from, "to_rad_s": to })),
        _ => None,
    });
    Value::Array(known.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn speeds_beyond_a_table_are_marked() {
        let table = "[rotor]\nm = 5.0\nJa = 0.1\nJt = 0.12\n[[effects.bearing]]\nposition = 0.0\nspeed = [10, 90]\nkyy = [1e6, 2e6]\n\
                     [[effects.bearing]]\nposition = 0.0\nspeed = [0, 50]\nkyy = [1e6, 2e6]\n";
        let scene = Scene::parse(Path::new("table.toml"), table).expect("a scene");
        let held = [5.0, 10.0, 50.0, 60.0, -60.0, 100.0].map(|speed| held(&scene, [speed; 2]));
        let expected: [&[&str]; 6] =
            [&["bearing[1]"], &[], &[], &["bearing[2]"], &["bearing[2]"], &["bearing[1]", "bearing[2]"]];
        assert_eq!(held, expected);
        assert_eq!([marked(&scene, 20.0), marked(&scene, 60.0)], ["20.0000", "60.0000 *"]);
        assert_eq!([mark_within(&scene, [20.0, 40.0]), mark_within(&scene, [20.0, 60.0])], ["", " *"]);
        let of = |speeds: &[f64]| below("| 1 |\n".into(), &scene, speeds);
        assert_eq!(of(&[10.0, 20.0, 50.0]), "| 1 |\n");
        let doubtful = of(&[0.0, 95.0]);
        assert!(doubtful.starts_with("| 1 |\n\n\\* "), "{doubtful}");
        assert_eq!(doubtful.matches("\n- bearing[").count(), 3);
        let tables = tables(&scene);
        assert_eq!((&tables[0]["from_rad_s"], &tables[1]["to_rad_s"]), (&json!(10.0), &json!(50.0)));
    }
}
