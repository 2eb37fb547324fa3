//! What the command leaves behind in target/accuracy/SCENE/: accuracy.md, .csv, .json and .svg.

use super::ratio::Ratios;
use super::row::csv;
use super::run::Setting;
use super::span::POINTS;
use super::{Accuracy, machine, table};
use crate::run::run;
use crate::{python, sheets};
use anyhow::Result;
use serde_json::{Value, json};
use split_rotor_model::scene::Scene;

/// Writes the files, and shows the tables.
pub fn write(scene: &Scene, result: &Accuracy) -> Result<()> {
    let report = table::report(result);
    let json = serde_json::to_string_pretty(&json(scene, result)?)? + "\n";
    let csv = csv(&result.rows, result.scale);
    let files = [("accuracy.md", &*report), ("accuracy.csv", &csv), ("accuracy.json", &json)];
    let folder = sheets::write(&format!("accuracy/{}", scene.name), files)?;
    run(python::python_with_all()?.arg("xtask/python/accuracy.py").arg(&folder))?;
    println!("\n{}: {}\n\n{report}", scene.name, scene.title);
    println!("{}", folder.join("accuracy.svg").display());
    Ok(())
}

fn json(scene: &Scene, result: &Accuracy) -> Result<Value> {
    let Accuracy { reference, rows, scale, sentences, left_out, .. } = result;
    let experiment = result.experiment;
    let setting = |setting: &Setting| json!({ "method": setting.method, setting.parameter: setting.value });
    let [end, worst] = reference
        .agreement
        .map(|errors| json!({ "axis_rad": errors.axis, "r_c_m": errors.r_c, "phi_rad": errors.phi }));
    let (sizes, floor, whole) = (&reference.sizes, reference.floor, scene.experiment);
    Ok(json!({
        "scene": scene.name,
        "title": scene.title,
        "machine": machine::described()?,
        "experiment": {
            "start_s": experiment.start,
            "stop_s": experiment.stop,
            "scene_stop_s": whole.stop,
            "points": POINTS,
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
        "rows": sheets::objects(rows.iter().map(|row| row.columns(*scale))),
    }))
}
