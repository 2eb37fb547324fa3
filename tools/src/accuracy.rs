//! Error against time for every method, for any scene.

mod advice;
pub mod auto;
pub mod motion;
mod ratio;
pub mod reference;
pub mod repeats;
pub mod row;
pub mod run;
pub mod span;
pub mod sweep;
mod table;

use crate::rows;
pub use advice::at_least;
use anyhow::{Context, Result};
pub use ratio::PAIR;
use ratio::Ratios;
use reference::Reference;
use row::{OURS, Row, Scale};
use run::{Setting, Subject};
use serde_json::{Value, json};
use split_rotor_model::scene::{Experiment, Scene};
use table::short;
pub use table::{power, range};

/// What was measured of a scene.
pub struct Accuracy<'s> {
    scene: &'s Scene,
    /// What counts as exact.
    reference: Reference,
    /// What was measured.
    pub rows: Vec<Row>,
    /// What its numbers compare with.
    pub scale: Scale,
    /// Start and stop of the runs.
    experiment: Experiment,
    /// Which method to take for which error.
    sentences: Vec<String>,
    /// Why there are no rows of a peer.
    pub left_out: Vec<String>,
}

/// Communication steps between two that are read, where the cost of short ones is measured.
const SUBSTEPS: usize = 100;

/// Measures the runs of a scene along these curves; it is told which method `begins`, which may end it, and each run
/// that is `done`. `peers` add their rows
/// to ours, and say why there are none of some.
pub fn measure<'s>(
    scene: &'s Scene,
    subject: &Subject,
    curves: &[Vec<Setting>],
    begins: impl Fn(&str) -> Result<()>,
    done: impl Fn(),
    peers: impl FnOnce(&Reference, &mut Vec<Row>) -> Vec<String>,
) -> Result<Accuracy<'s>> {
    let reference = Reference::of(subject)?;
    let experiment = subject.experiment;
    let scale = Scale {
        simulated: experiment.stop - experiment.start,
        scene: scene.experiment.stop - scene.experiment.start,
        energy: reference.energy_scale(),
        floor: reference.floor.worst(),
    };
    let mut rows = Vec::new();
    for curve in curves {
        if rows.last().is_none_or(|last: &Row| last.method != curve[0].method) {
            begins(curve[0].method)?;
        }
        rows.extend(sweep::measure(subject, curve, &reference, &done));
    }
    let left_out = peers(&reference, &mut rows);
    let mut sentences: Vec<_> = span::told(&experiment, &scene.experiment).into_iter().collect();
    sentences.extend(advice::sentences(&rows, scale.floor, scale.simulated));
    sentences.extend(advice::meaning(&rows, scale.floor));
    sentences.extend(auto::sentence(&rows, scale.floor));
    sentences.extend(substeps(subject, curves, &rows, scale)?);
    Ok(Accuracy { scene, reference, rows, scale, experiment, sentences, left_out })
}

impl Accuracy<'_> {
    /// For people, in Markdown.
    pub fn table(&self) -> String {
        table::report(self)
    }

    /// All of it but for what it was measured on.
    pub fn json(&self) -> Value {
        let Self { scene, reference, rows, scale, sentences, left_out, .. } = self;
        let experiment = self.experiment;
        let setting = |setting: &Setting| json!({ "method": setting.method, setting.parameter: setting.value });
        let [end, worst] = reference
            .agreement
            .map(|errors| json!({ "axis_rad": errors.axis, "r_c_m": errors.r_c, "phi_rad": errors.phi }));
        let (sizes, floor, whole) = (&reference.sizes, reference.floor, scene.experiment);
        json!({
            "scene": scene.name,
            "title": scene.title,
            "experiment": {
                "start_s": experiment.start,
                "stop_s": experiment.stop,
                "scene_stop_s": whole.stop,
                "points": span::POINTS,
            },
            "sizes": { "place_m": sizes.place, "axis_rad": sizes.axis, "phi_rad": sizes.phi },
            "reference": {
                "by": setting(&reference.setting),
                "checked_by": setting(&reference.check),
                "agreement_at_end": end,
                "agreement_at_worst": worst,
                "agreement": {
                    "error": floor.worst(),
                    "place_error": floor.place,
                    "axis_error": floor.axis,
                    "phi_error": floor.phi,
                },
            },
            "sentences": sentences,
            "left_out": left_out,
            "ratios": Ratios::of(rows, reference).map(|ratios| ratios.json()),
            "rows": rows::objects(rows.iter().map(|row| row.columns(*scale))),
        })
    }
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
