//! What a user would pick instead, measured in the same run: libraries from PyPI, each in an environment of its own, and
//! two Rust crates. What cannot be installed is named and left out.

use super::{TRIED, interleaved};
use crate::progress::Progress;
use crate::run::{Conversation, cargo, run};
use crate::{paths, python};
use anyhow::{Context, Result};
use nalgebra::Vector3;
use serde_json::{Map, Value, json};
use split_rotor_model::scene::Scene;
use split_rotor_tools::accuracy::motion::{Errors, Point};
use split_rotor_tools::accuracy::reference::Reference;
use split_rotor_tools::accuracy::row::{Measured, OURS, Row};
use split_rotor_tools::accuracy::run::Subject;
use split_rotor_tools::accuracy::span::{self, POINTS};
use split_rotor_tools::accuracy::{PAIR, repeats, sweep};
use std::process::Command;

/// The effects whose laws stand in the peers' equations.
const EFFECTS: [&str; 3] = ["gravity", "support", "drive"];

/// A method of a peer begins no further setting once it took so long [s of CPU time]; and where peers are only tried.
const BUDGET: f64 = 8.0;
const BUDGET_TRIED: f64 = 0.5;

/// Between two points of the reference the axis may lean further than at both.
const TILT_MARGIN: f64 = 1.2;

/// A peer's name, and what runs it.
pub const PEERS: [(&str, Program); 7] = [
    ("heyoka", Program::Python("heyoka")),
    ("SciPy", Program::Python("scipy")),
    ("scikit-sundae", Program::Python("sundae")),
    ("Exudyn", Program::Python("exudyn")),
    ("MuJoCo", Program::Python("mujoco")),
    ("ode_solvers", Program::Rust("ode_solvers")),
    ("differential-equations", Program::Rust("differential-equations")),
];

/// What runs a peer.
#[derive(Clone, Copy)]
pub enum Program {
    /// A module of xtask/python/peers, and its requirements there.
    Python(&'static str),
    /// An argument of the program of benches/peers.
    Rust(&'static str),
}

impl Program {
    /// Its command; what it needs is installed or built first.
    fn command(self) -> Result<Command> {
        match self {
            Program::Python(module) => python::peer(module),
            Program::Rust(argument) => {
                let target = paths::target().join("peers");
                let manifest = paths::root().join("benches/peers/Cargo.toml");
                run(cargo()
                    .args(["build", "--quiet", "--release", "--locked"])
                    .arg("--manifest-path")
                    .arg(manifest)
                    .arg("--target-dir")
                    .arg(&target))?;
                let mut command = Command::new(target.join("release/split-rotor-peers"));
                command.arg(argument);
                Ok(command)
            }
        }
    }
}

/// Why no peer can run this scene, if so.
fn refusal(scene: &Scene) -> Option<String> {
    if !scene.inputs.is_empty() {
        return Some("Peers are left out: their inputs stay as they start, and the scene has [[input]].".into());
    }
    let unknown: Vec<_> =
        scene.effects.iter().map(|(info, _)| info.name).filter(|name| !EFFECTS.contains(name)).collect();
    let (known, unknown_names) = (EFFECTS.join(", "), unknown.join(", "));
    (!unknown.is_empty()).then(|| format!("Peers are left out: they know {known}, not {unknown_names}."))
}

/// Runs them all, or only tries them, and adds their rows to ours; why there are none of some.
pub fn measure(subject: &Subject, reference: &Reference, rows: &mut Vec<Row>, tried: bool) -> Vec<String> {
    if let Some(why) = refusal(subject.scene) {
        return vec![why];
    }
    let task = task(subject, reference, tried).to_string();
    let progress = Progress::of(PEERS.len());
    let mut left_out = Vec::new();
    for (name, program) in PEERS {
        progress.tell(&format!("measuring {name}"));
        match answers(name, program, &task, subject, reference, rows) {
            Ok(theirs) => {
                if theirs.iter().all(|row| row.outcome.is_err()) {
                    let first = theirs.first().and_then(|row| row.outcome.as_ref().err());
                    let why = first.map_or("it printed nothing", |why| why);
                    left_out.push(format!("{name} ran with no setting: {why}."));
                }
                rows.extend(theirs);
            }
            Err(error) => left_out.push(format!("{name} is left out: {error:#}.")),
        }
        progress.inc(1);
    }
    left_out
}

/// The rows of a peer. The one that solves as a method of ours does is then timed in turn with that, whose rows are among `ours`.
fn answers(
    name: &str,
    program: Program,
    task: &str,
    subject: &Subject,
    reference: &Reference,
    ours: &mut [Row],
) -> Result<Vec<Row>> {
    let mut peer = Conversation::with(&mut program.command()?)?;
    peer.say(task);
    let read = |line: &String| row(name, line, reference).with_context(|| format!("it printed `{line}`"));
    let mut theirs = peer.paragraph()?.iter().map(read).collect::<Result<Vec<_>>>()?;
    if name == PAIR.0 {
        let of_method = ours.iter_mut().filter(|row| row.tool == OURS && row.method == PAIR.1);
        interleaved::time(subject, of_method, &mut theirs, &mut peer)?;
    }
    peer.end()?;
    Ok(theirs)
}

/// What every peer reads.
fn task(subject: &Subject, reference: &Reference, tried: bool) -> Value {
    let Subject { scene, experiment, .. } = subject;
    let named = scene.variables.iter().filter_map(|variable| {
        let start = scene.starts.get(&variable.place.value_reference())?;
        Some((variable.name.clone(), json!(start)))
    });
    let times: Vec<_> = (0..=POINTS).map(|n| span::time(experiment, n)).collect();
    let parts: Vec<_> = (0..=POINTS).map(span::part).collect();
    let mut tolerances = sweep::swept_tolerances();
    if tried {
        tolerances.truncate(TRIED);
    }
    json!({
        "values": named.collect::<Map<_, _>>(),
        "times": times,
        "parts": parts,
        "largest_tilt": TILT_MARGIN * reference.largest_tilt(),
        "tolerances": tolerances,
        "repeats": repeats::rule(),
        "budget": if tried { BUDGET_TRIED } else { BUDGET },
    })
}

/// A row from the line that a peer printed.
fn row(tool: &str, line: &str, reference: &Reference) -> Result<Row> {
    let line: Value = serde_json::from_str(line)?;
    let text = |key: &str| line[key].as_str().map(str::to_owned).with_context(|| format!("it lacks {key}"));
    let outcome = match line["failure"].as_str() {
        Some(why) => Err(why.to_owned()),
        None => Ok(measured(&line, reference)?),
    };
    let value = line["value"].as_f64().context("it lacks value")?;
    let [version, method, parameter] = [text("version")?, text("method")?, text("parameter")?];
    let vector_widths = ["vector_width", "vector_width_of_processor"].map(|key| line[key].as_u64());
    Ok(Row { tool: tool.into(), version, vector_widths, method, order: None, parameter, value, outcome })
}

fn measured(line: &Value, reference: &Reference) -> Result<Measured> {
    let points = reference.points.iter().enumerate().map(|(n, exact)| {
        // What is null is not known.
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let vector = |key: &str| Vector3::from_fn(|i, _| number(&line[key][n][i]));
        let energy = number(&line["energy"][n]);
        Point {
            r_c: vector("r_c"),
            axis: vector("axis"),
            turns: 0.0,
            angle: number(&line["phi"][n]),
            // No peer keeps a ledger: the reference tells what the energy should be.
            residual: energy - exact.energy,
            energy,
            kinetic: f64::NAN,
        }
    });
    let points: Vec<_> = points.collect();
    let [end, worst] = Errors::of(&points, &reference.points);
    Ok(Measured {
        relative: reference.relative(&points),
        told: points.iter().filter(|point| point.axis[0].is_finite()).count(),
        end,
        worst,
        cpu_time: line["cpu_time"].as_f64().context("it lacks cpu_time")?,
        repeats: line["repeats"].as_u64().context("it lacks repeats")? as usize,
        is_interleaved: false,
        steps: line["steps"].as_f64(),
        evaluations: line["evaluations"].as_f64(),
        taken: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes;
    use split_rotor_tools::accuracy::reference::sample::reference;

    #[test]
    fn a_line_of_a_peer_becomes_a_row() {
        let phi = std::f64::consts::TAU + 0.5 + 1e-6;
        let line = json!({
            "version": "1.0", "method": "RK", "parameter": "step", "value": 0.01, "cpu_time": 0.2, "repeats": 4,
            "vector_width": 1, "steps": 7, "evaluations": null,
            "r_c": [[null, null, null], [1.0, 1e-3, 0.0]], "axis": [[null, null, null], [1.0, 0.0, 1e-5]],
            "phi": [phi, phi], "energy": [3.0, 3.5],
        });
        let row = row("peer", &line.to_string(), &reference(0.0)).unwrap();
        assert_eq!((row.tool.as_str(), row.method.as_str(), row.value), ("peer", "RK", 0.01));
        assert_eq!(row.vector_widths, [Some(1), None]);
        let m = row.outcome.unwrap();
        assert_eq!((m.end.r_c, m.end.energy, m.cpu_time, m.repeats), (1e-3, 0.5, 0.2, 4));
        assert!((m.end.axis - 1e-5).abs() < 1e-14 && (m.end.phi - 1e-6).abs() < 1e-14, "{m:?}");
        assert!(m.worst.r_c.is_nan());
        // It tells one point only: by that it is judged.
        assert_eq!((m.told, m.relative.place), (1, 2e-3));
        assert_eq!((m.steps, m.evaluations), (Some(7.0), None));
    }

    #[test]
    fn a_failure_of_a_peer_is_a_row_that_says_why() {
        let line = r#"{"version": "1.0", "method": "RK", "parameter": "step", "value": 1.0, "failure": "it fell"}"#;
        assert_eq!(row("peer", line, &reference(0.0)).unwrap().outcome.unwrap_err(), "it fell");
        assert!(row("peer", "{}", &reference(0.0)).is_err());
    }

    #[test]
    fn peers_know_the_effects_of_the_scenes() {
        for name in ["paper", "tumbling", "driven"] {
            assert_eq!(refusal(&scenes::find(name).unwrap()), None);
        }
    }
}
