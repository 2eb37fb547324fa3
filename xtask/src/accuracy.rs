//! `accuracy`: error against time for every method, for any scene.

mod advice;
mod auto;
mod files;
mod interleaved;
mod machine;
pub mod motion;
mod peers;
mod ratio;
mod reference;
mod repeats;
mod row;
pub mod run;
mod span;
mod sweep;
mod table;
mod tolerances;

use crate::progress::Progress;
use crate::unpacked::unpack;
use crate::{package, scenes};
use anyhow::{Context, Result, ensure};
use reference::Reference;
use row::{OURS, Row, Scale};
use run::{Setting, Subject};
use split_rotor_model::scene::{Experiment, Scene};
use table::short;
pub use tolerances::tolerances;

/// What was measured of a scene.
struct Accuracy {
    reference: Reference,
    rows: Vec<Row>,
    scale: Scale,
    /// Start and stop of the runs.
    experiment: Experiment,
    /// Which method to take for which error.
    sentences: Vec<String>,
    /// Why there are no rows of a peer.
    left_out: Vec<String>,
}

/// Communication steps between two that are read, where the cost of short ones is measured.
const SUBSTEPS: usize = 100;

/// Packages the scene, measures it, and writes target/accuracy/SCENE/; which peers were left out, and why.
pub fn accuracy(scene: &str, with_peers: bool) -> Result<Vec<String>> {
    let found = scenes::find(scene)?;
    ensure!(
        found.inputs.is_empty(),
        "{}: has [[input]], which `run` and `demo` follow: accuracy is measured with inputs that stay as they start",
        found.file.display()
    );
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let (scene, unpacked) = (found, unpack(&fmu)?);
    let mut subject = Subject::load(&scene, &unpacked.library)?;
    span::shorten(&mut subject);
    let result = measure(&scene, &subject, with_peers)?;
    files::write(&scene, &result)?;
    Ok(result.left_out)
}

fn measure(scene: &Scene, subject: &Subject, with_peers: bool) -> Result<Accuracy> {
    let reference = Reference::of(subject)?;
    let experiment = subject.experiment;
    let scale = Scale {
        simulated: experiment.stop - experiment.start,
        scene: scene.experiment.stop - scene.experiment.start,
        energy: reference.energy_scale(),
        floor: reference.floor.worst(),
    };
    let curves = sweep::curves(subject);
    let progress = Progress::of(curves.iter().map(Vec::len).sum());
    let mut rows = Vec::new();
    for curve in &curves {
        if rows.last().is_none_or(|last: &Row| last.method != curve[0].method) {
            progress.tell(&format!("measuring {}", curve[0].method));
        }
        rows.extend(sweep::measure(subject, curve, &reference, || progress.inc(1)));
    }
    drop(progress);
    let mut left_out = Vec::new();
    if with_peers {
        left_out = peers::measure(subject, &reference, &mut rows);
    }
    let mut sentences: Vec<_> = span::told(&experiment, &scene.experiment).into_iter().collect();
    sentences.extend(advice::sentences(&rows, scale.floor, scale.simulated));
    sentences.extend(advice::meaning(&rows, scale.floor));
    sentences.extend(auto::sentence(&rows, scale.floor));
    sentences.extend(substeps(subject, &curves, &rows, scale)?);
    Ok(Accuracy { reference, rows, scale, experiment, sentences, left_out })
}

/// What short communication steps cost, at the tightest goal that was reached.
fn substeps(subject: &Subject, curves: &[Vec<Setting>], rows: &[Row], scale: Scale) -> Result<Option<String>> {
    let ours = || rows.iter().filter(|row| row.tool == OURS);
    let reached = advice::GOALS.iter().rev().find_map(|goal| advice::cheapest(ours(), *goal));
    let Some((row, _)) = reached else { return Ok(None) };
    let is_it = |s: &&Setting| s.method == row.method && s.order == row.order && s.value == row.value;
    let setting = curves.iter().flatten().find(is_it).context("a row of ours has its setting")?;
    let ratio = sweep::cost_of_substeps(subject, setting, SUBSTEPS)?;
    let step = scale.simulated / span::POINTS as f64;
    Ok(Some(format!(
        "With communication steps of {} s instead of {} s on average, outputs read as often, {} at {} costs {ratio:.2} times as \
         much.",
        short(step / SUBSTEPS as f64),
        short(step),
        setting.method,
        table::setting(row),
    )))
}
