//! `accuracy`: error against time for every method, for any scene.

mod advice;
mod files;
mod machine;
mod motion;
mod peers;
mod reference;
mod repeats;
mod row;
mod run;
mod sweep;
mod table;

use crate::unpacked::unpack;
use crate::{package, scenes};
use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use model::scene::Scene;
use reference::Reference;
use row::{Row, Scale};
use run::Subject;

/// What was measured of a scene.
struct Accuracy {
    reference: Reference,
    rows: Vec<Row>,
    scale: Scale,
    /// Which method to take for which error.
    sentences: Vec<String>,
    /// Why there are no rows of a peer.
    left_out: Vec<String>,
}

/// Communication steps between two that are read, where the cost of short ones is measured.
const SUBSTEPS: usize = 100;

/// Packages the scene, measures it, and writes target/accuracy/<scene>/; which peers were left out, and why.
pub fn accuracy(scene: &str, with_peers: bool) -> Result<Vec<String>> {
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let scene = scenes::find(scene)?;
    let library = unpack(&fmu)?.library;
    let subject = Subject::load(&scene, &library)?;
    let result = measure(&scene, &subject, with_peers)?;
    files::write(&scene, &result)?;
    Ok(result.left_out)
}

fn measure(scene: &Scene, subject: &Subject, with_peers: bool) -> Result<Accuracy> {
    let reference = Reference::of(subject)?;
    let experiment = &scene.experiment;
    let scale = Scale {
        simulated: experiment.stop - experiment.start,
        energy: reference.energy_scale(),
        floor: reference.floor().axis,
    };
    let settings = sweep::settings();
    let progress = bar(settings.len());
    let mut rows = Vec::new();
    for setting in &settings {
        if rows.last().is_none_or(|last: &Row| last.method != setting.method) {
            tell(&progress, setting.method);
        }
        rows.push(sweep::measure(subject, setting, &reference));
        progress.inc(1);
    }
    progress.finish_and_clear();
    let mut sentences = advice::sentences(&rows, scale.floor, scale.simulated, experiment.stop);
    let l = scene.parameters().setup.rotor.l.abs();
    sentences.extend(advice::meaning(&rows, if l > 0.0 { l } else { 1.0 }, reference.floor()));
    sentences.extend(substeps(subject, &rows, scale)?);
    let mut left_out = Vec::new();
    if with_peers {
        let progress = bar(peers::PEERS.len());
        let theirs = peers::measure(scene, &reference, &progress)?;
        progress.finish_and_clear();
        rows.extend(theirs.rows);
        left_out = theirs.left_out;
    }
    Ok(Accuracy { reference, rows, scale, sentences, left_out })
}

/// A bar where a person watches.
fn bar(length: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}").expect("a valid template");
    ProgressBar::new(length as u64).with_style(style)
}

/// Says what is measured now: on the bar, or as a line where there is none.
fn tell(progress: &ProgressBar, what: &'static str) {
    progress.set_message(what);
    if progress.is_hidden() {
        println!("measuring {what}");
    }
}

/// What short communication steps cost, at the tightest goal that was reached.
fn substeps(subject: &Subject, rows: &[Row], scale: Scale) -> Result<Option<String>> {
    let reached = advice::GOALS.iter().rev().find_map(|goal| advice::cheapest(rows, *goal));
    let Some((row, _)) = reached else { return Ok(None) };
    let setting = sweep::settings().into_iter().find(|s| s.method == row.method && s.value == row.value);
    let setting = setting.context("a row of ours has its setting")?;
    let ratio = sweep::cost_of_substeps(subject, &setting, SUBSTEPS)?;
    let step = scale.simulated / run::POINTS as f64;
    Ok(Some(format!(
        "With communication steps of {} s instead of {} s, outputs read every {} s in both, {} at {} costs {ratio:.2} \
         times as much.",
        step / SUBSTEPS as f64,
        step,
        step,
        setting.method,
        table::power(setting.value),
    )))
}
