//! `response --from --to`: how an output of a machine answers an input that swings, against the frequency, at one spin.

pub mod axis;
mod picture;
mod sweep;
mod table;

use crate::numbers::rounded;
use crate::{known, peaks, scenes, sheets, state_space};
use anyhow::{Context, Result, ensure};
use nalgebra::{Complex, ComplexField};
use serde_json::json;
use split_rotor_model::linear::{Obstacle, Quantity, StateSpace};
use split_rotor_model::scene::Scene;
use split_rotor_tools::doubts;
use std::path::Path;

/// Outputs that tell how fast the rotor spins.
const OF_SPIN: [&str; 3] = ["omega_phi", "omega.x", "K_c.x"];

/// Outputs that show how far it has turned.
const TURNED: [&str; 3] = ["phi", "turns", "angle"];

/// How the names of inputs end that act about the axis.
const ABOUT_THE_AXIS: &str = ".m.x";

const HELD: &str = "The linear view holds the spin";

/// What the command found.
struct Found {
    scene: Scene,
    space: StateSpace,
    /// The numbers of the input and of the output.
    from: usize,
    to: usize,
    /// By frequency.
    points: Vec<Point>,
    /// Where the answer is larger than beside it.
    peaks: Vec<Point>,
}

/// A frequency [rad/s], and the answer there in the output's unit over the input's; None without bound, where nothing damps a resonance.
#[derive(Clone, Copy)]
struct Point {
    frequency: f64,
    answer: Option<Complex<f64>>,
}

impl Point {
    fn size(&self) -> f64 {
        self.answer.map_or(f64::INFINITY, ComplexField::modulus)
    }
}

impl Found {
    fn at(&self, frequency: f64) -> Result<Point, Obstacle> {
        Ok(Point { frequency, answer: self.space.response(self.from, self.to, frequency)? })
    }

    /// That the spin is held, and what a free one would do.
    fn held_spin(&self) -> String {
        let from = &self.space.inputs[self.from].name;
        if !from.ends_with(ABOUT_THE_AXIS) {
            return HELD.into();
        }
        // Of all of it, what is out of balance included.
        let axial = rounded(self.scene.parameters().shape().tensor()[(0, 0)]);
        format!(
            "{HELD}: what keeps it constant takes up every torque about the axis. A spin that nothing else holds would answer {from} with \
             1/(i Omega J), J = {axial} kg.m2 of all that turns; run the scene with that input to see it"
        )
    }

    /// What is between both, in words.
    fn between(&self) -> String {
        let [from, to] = [&self.space.inputs[self.from].name, &self.space.outputs[self.to].name];
        format!("from {from} to {to} at {} rad/s", self.space.steady.speed)
    }

    /// The unit of the answer.
    fn unit(&self) -> String {
        let [to, from] = [&self.space.outputs[self.to], &self.space.inputs[self.from]].map(|one| one.unit.name);
        let over = if from.contains(['.', '/']) { format!("({from})") } else { from.into() };
        match (to, from) {
            (to, "") => to.into(),
            ("", _) => format!("1/{over}"),
            _ => format!("{to}/{over}"),
        }
    }
}

/// Finds the answer of an output of a scene to an input, both by their names, at a spin [rad/s] and so many frequencies between these
/// [rad/s], into the folder `out`, or target/response/SCENE.
pub fn frequency(
    scene: &str,
    speed: Option<f64>,
    [from, to]: [&str; 2],
    ends: Option<[f64; 2]>,
    steps: u32,
    out: Option<&Path>,
) -> Result<()> {
    let scene = scenes::find(scene)?;
    let space = state_space::of(&scene, speed)?;
    let file = || scene.file.display().to_string();
    let input = number("--from", from, &space.inputs, "input").with_context(file)?;
    let output = number("--to", to, &space.outputs, "output").with_context(file)?;
    let frequencies = sweep::frequencies(&space.steady, ends, steps)?;
    let mut found = Found { scene, space, from: input, to: output, points: Vec::new(), peaks: Vec::new() };
    found.points = frequencies.into_iter().map(|frequency| found.at(frequency)).collect::<Result<_, _>>()?;
    ensure!(
        found.points.iter().any(|point| point.answer.is_some_and(|answer| answer.modulus() > 0.0)),
        "{}: {from} does not move {to} in the linear view: the response is 0 at every frequency{}",
        found.scene.file.display(),
        match is_of_spin(to) {
            true if from.ends_with(ABOUT_THE_AXIS) => format!(". {}", found.held_spin()),
            true => format!(". {HELD}, and {from} does not act about the axis"),
            false => String::new(),
        }
    );
    let seen = |point: &Point| (point.frequency, point.size());
    found.peaks = peaks::of(&found.points, seen, |frequency, _| found.at(frequency))?;
    write(&found, out)
}

/// Whether an output tells how fast the rotor spins.
fn is_of_spin(output: &str) -> bool {
    OF_SPIN.contains(&output)
}

/// The number of what has this name.
fn number(option: &str, name: &str, of: &[Quantity], kind: &str) -> Result<usize> {
    let known = || of.iter().map(|one| &*one.name).collect::<Vec<_>>().join(", ");
    of.iter().position(|one| one.name == name).with_context(|| match of.is_empty() {
        true => format!(
            "{option} {name}: the scene has no {kind} that acts while the spin is held: call for an [[effects.port]]"
        ),
        false => {
            let meant = known::meant(name, of.iter().map(|one| &*one.name));
            let held =
                if TURNED.contains(&name) { format!(". {HELD}, so {name} answers nothing") } else { String::new() };
            format!("{option} {name}: no such {kind}{meant}; it can be {}{held}", known())
        }
    })
}

fn write(found: &Found, out: Option<&Path>) -> Result<()> {
    let (table, rows) = (table::table(found)?, rows(&found.points));
    let json = json!({
        "scene": found.scene.name,
        "title": found.scene.title,
        "speed_rad_s": found.space.steady.speed,
        "from": found.space.inputs[found.from].name,
        "to": found.space.outputs[found.to].name,
        "unit": found.unit(),
        "held": doubts::held(&found.scene, [found.space.steady.speed; 2]),
        "peaks": sheets::objects(self::rows(&found.peaks)),
        "responses": sheets::objects(rows.clone()),
    });
    let pictures = [("frequency.svg", picture::bode(found)?), ("polar.svg", picture::polar(found)?)];
    let folder = sheets::folder(out, &format!("response/{}", found.scene.name))?;
    sheets::leave(folder, "frequency", &table, &rows, &json, &pictures)?.show();
    Ok(())
}

/// A row for each frequency at which the answer has a bound.
fn rows(points: &[Point]) -> Vec<sheets::Row> {
    let row = |point: &Point| {
        let answer = point.answer?;
        Some(vec![
            ("frequency_rad_s", json!(point.frequency)),
            ("real", json!(answer.re)),
            ("imaginary", json!(answer.im)),
            ("magnitude", json!(answer.modulus())),
            ("phase_rad", json!(answer.argument())),
        ])
    };
    points.iter().filter_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torque_that_does_not_move_the_spin_is_explained() {
        let folder = crate::paths::target().join("tests/frequency");
        std::fs::create_dir_all(&folder).expect("a folder");
        let file = folder.join("held.toml");
        let scene = "[rotor]\nm = 6.0\nJa = 0.01\nJt = 0.06\n[start]\nomega.x = 500.0\n[[effects.bearing]]\nposition = 0.1\nkyy = 1e6\nkzz = 1e6\n\
            [[effects.port]]\nposition = 0.1\n[[effects.unbalance]]\nmass = 1.0\nradius = 0.1\nposition = 0.0\n\
            [[effects.unbalance]]\nmass = 1.0\nradius = 0.1\nposition = 0.0\nangle = \"180 deg\"\n";
        std::fs::write(&file, scene).expect("a file");
        let file = file.display().to_string();
        let refused = |from: &str, to: &str| {
            let refused = frequency(&file, None, [from, to], None, 3, Some(&folder));
            format!("{:#}", refused.expect_err("the spin is held"))
        };
        let words = refused("port[1].m.x", "omega_phi");
        assert!(words.contains("port[1].m.x does not move omega_phi in the linear view"), "{words}");
        // Two masses of 1 kg on 0.1 m turn with it.
        assert!(
            words.contains("The linear view holds the spin: what keeps it") && words.contains("J = 0.0300000 kg.m2"),
            "{words}"
        );
        let across = refused("port[1].m.y", "omega_phi");
        assert!(
            across.ends_with("The linear view holds the spin, and port[1].m.y does not act about the axis"),
            "{across}"
        );
        let turned = refused("port[1].m.x", "phi");
        assert!(turned.ends_with("The linear view holds the spin, so phi answers nothing"), "{turned}");
    }
}
