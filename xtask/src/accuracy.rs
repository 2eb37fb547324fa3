//! `accuracy`: error against time for every method, for any scene.

mod advice;
mod auto;
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
use model::scene::{Experiment, Scene};
use reference::Reference;
use row::{Row, Scale};
use run::{Setting, Subject};

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

/// Packages the scene, measures it, and writes target/accuracy/<scene>/; which peers were left out, and why.
pub fn accuracy(scene: &str, with_peers: bool) -> Result<Vec<String>> {
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let scene = scenes::find(scene)?;
    let unpacked = unpack(&fmu)?;
    let mut subject = Subject::load(&scene, &unpacked.library)?;
    let part = shortened(&mut subject)?;
    let mut result = measure(&scene, &subject, with_peers)?;
    result.sentences.splice(0..0, part);
    files::write(&scene, &result)?;
    Ok(result.left_out)
}

fn measure(scene: &Scene, subject: &Subject, with_peers: bool) -> Result<Accuracy> {
    let reference = Reference::of(subject)?;
    let experiment = subject.experiment;
    let scale = Scale {
        simulated: experiment.stop - experiment.start,
        energy: reference.energy_scale(),
        floor: reference.floor().axis,
    };
    let curves = sweep::curves(subject)?;
    let progress = bar(curves.iter().map(Vec::len).sum());
    let mut rows = Vec::new();
    for curve in &curves {
        if rows.last().is_none_or(|last: &Row| last.method != curve[0].method) {
            tell(&progress, curve[0].method);
        }
        rows.extend(sweep::measure(subject, curve, &reference, || progress.inc(1)));
    }
    progress.finish_and_clear();
    let mut sentences = advice::sentences(&rows, scale.floor, scale.simulated, experiment.stop);
    let l = scene.parameters().setup.rotor.l.abs();
    sentences.extend(advice::meaning(&rows, if l > 0.0 { l } else { 1.0 }, reference.floor()));
    sentences.extend(auto::sentence(scene, experiment, &rows, &reference));
    sentences.extend(substeps(subject, &curves, &rows, scale)?);
    let mut left_out = Vec::new();
    if with_peers {
        let progress = bar(peers::PEERS.len());
        let theirs = peers::measure(scene, &experiment, &reference, &progress)?;
        progress.finish_and_clear();
        rows.extend(theirs.rows);
        left_out = theirs.left_out;
    }
    Ok(Accuracy { reference, rows, scale, experiment, sentences, left_out })
}

/// Runs whose loosest setting takes longer are shortened by tens [s of CPU time].
const AFFORDABLE: f64 = 1.5;

/// Shortens the runs of a scene that are too long to be repeated many times, and says so.
fn shortened(subject: &mut Subject) -> Result<Option<String>> {
    let Experiment { start, stop, .. } = subject.experiment;
    let part = |tens: i32| (stop - start) / 10_f64.powi(tens);
    let setting = sweep::with_tolerance("dop853", 1e-6);
    // Tried on a thousandth, so that the trial is affordable too.
    subject.experiment.stop = start + part(3);
    let trial = 1e3 * subject.run(&setting, 1, f64::INFINITY).map_or(0.0, |run| run.cpu_time);
    let tens = (0..).find(|tens| trial * 0.1_f64.powi(*tens) <= AFFORDABLE).expect("some part is short");
    subject.experiment.stop = if tens == 0 { stop } else { start + part(tens) };
    Ok((tens > 0).then(|| {
        let (all, some) = (stop - start, part(tens));
        format!("Of the {all} s of the scene {some} s are run: all of them, at so many settings, would take hours.")
    }))
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
fn substeps(subject: &Subject, curves: &[Vec<Setting>], rows: &[Row], scale: Scale) -> Result<Option<String>> {
    let reached = advice::GOALS.iter().rev().find_map(|goal| advice::cheapest(rows, *goal));
    let Some((row, _)) = reached else { return Ok(None) };
    let is_it = |s: &&Setting| s.method == row.method && s.order == row.order && s.value == row.value;
    let setting = curves.iter().flatten().find(is_it).context("a row of ours has its setting")?;
    let ratio = sweep::cost_of_substeps(subject, setting, SUBSTEPS)?;
    let step = scale.simulated / run::POINTS as f64;
    Ok(Some(format!(
        "With communication steps of {} s instead of {} s, outputs read every {} s in both, {} at {} costs {ratio:.2} \
         times as much.",
        step / SUBSTEPS as f64,
        step,
        step,
        setting.method,
        table::setting(row),
    )))
}
