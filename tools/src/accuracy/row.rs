//! One row of the result: who ran with which setting, and what came of it. Its columns are those of the CSV and the keys
//! of the JSON.

use super::motion::{Errors, Relative};
use crate::rows;
use serde_json::{Value, json};

/// The tool's name in our own rows.
pub const OURS: &str = "split-rotor";

/// A tool, a method and a setting, with what it measured or why it could not.
#[derive(Clone, Debug)]
pub struct Row {
    /// Whose method: ours, or a peer's.
    pub tool: String,
    /// The tool's version.
    pub version: String,
    /// How many motions the tool integrates at once, in a vector, and for how many the processor has room, where it tells.
    pub vector_widths: [Option<u64>; 2],
    /// The method.
    pub method: String,
    /// Its order, where that was chosen.
    pub order: Option<i32>,
    /// What chooses the accuracy.
    pub parameter: String,
    /// Its value.
    pub value: f64,
    /// What was measured, or why nothing was.
    pub outcome: Result<Measured, String>,
}

/// What a row measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The worst errors over the motion's own size.
    pub relative: Relative,
    /// At how many points it tells its motion: fewer than all where a peer tells its end only.
    pub told: usize,
    /// Errors at the last point.
    pub end: Errors,
    /// The worst over all points.
    pub worst: Errors,
    /// The least of all repeats \[s].
    pub cpu_time: f64,
    /// How many repeats.
    pub repeats: usize,
    /// Whether they were made in turn with those of another tool.
    pub is_interleaved: bool,
    /// Accepted steps, where they are told.
    pub steps: Option<f64>,
    /// Evaluations of the right-hand side, where they are told.
    pub evaluations: Option<f64>,
    /// Which methods `auto` took.
    pub taken: Option<String>,
}

impl Measured {
    /// The error of the run: the worst of place across e, axis and φ, each over the motion's own size \[1].
    pub fn error(&self) -> f64 {
        self.relative.worst()
    }
}

/// What the numbers of a row compare with.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Simulated time \[s].
    pub simulated: f64,
    /// That of the whole scene \[s].
    pub scene: f64,
    /// For the relative energy drift \[J].
    pub energy: f64,
    /// No smaller error can be told \[1].
    pub floor: f64,
}

impl Row {
    /// Each column's name with its unit, and the value, null where there is none.
    pub fn columns(&self, scale: Scale) -> Vec<(&'static str, Value)> {
        let measured = self.outcome.as_ref().ok();
        let number = |get: &dyn Fn(&Measured) -> f64| json!(measured.map(get));
        let optional = |get: &dyn Fn(&Measured) -> Option<f64>| json!(measured.and_then(get));
        vec![
            ("tool", json!(self.tool)),
            ("version", json!(self.version)),
            ("vector_width", json!(self.vector_widths[0])),
            ("vector_width_of_processor", json!(self.vector_widths[1])),
            ("method", json!(self.method)),
            ("order", json!(self.order)),
            ("parameter", json!(self.parameter)),
            ("value", json!(self.value)),
            ("error", number(&|m| m.error())),
            ("error_told", json!(measured.map(|m| m.error() > scale.floor))),
            ("place_error", number(&|m| m.relative.place)),
            ("axis_error", number(&|m| m.relative.axis)),
            ("phi_error", number(&|m| m.relative.phi)),
            ("points_told", json!(measured.map(|m| m.told))),
            ("simulated_s", json!(scale.simulated)),
            ("scene_s", json!(scale.scene)),
            ("axis_error_rad", number(&|m| m.end.axis)),
            ("r_c_error_m", number(&|m| m.end.r_c)),
            ("phi_error_rad", number(&|m| m.end.phi)),
            ("energy_drift_J", number(&|m| m.end.energy)),
            ("energy_drift_relative", number(&|m| m.end.energy / scale.energy)),
            ("worst_axis_error_rad", number(&|m| m.worst.axis)),
            ("worst_r_c_error_m", number(&|m| m.worst.r_c)),
            ("worst_phi_error_rad", number(&|m| m.worst.phi)),
            ("worst_energy_drift_J", number(&|m| m.worst.energy)),
            ("cpu_time_s", number(&|m| m.cpu_time)),
            ("repeats", json!(measured.map(|m| m.repeats))),
            ("interleaved", json!(measured.map(|m| m.is_interleaved))),
            ("real_time_factor", number(&|m| scale.simulated / m.cpu_time)),
            ("evaluations", optional(&|m| m.evaluations)),
            ("steps", optional(&|m| m.steps)),
            ("taken", json!(measured.and_then(|m| m.taken.clone()))),
            ("failure", json!(self.outcome.as_ref().err())),
        ]
    }
}

/// The rows as comma-separated values, with a header.
pub fn csv(rows: &[Row], scale: Scale) -> String {
    rows::csv(&rows.iter().map(|row| row.columns(scale)).collect::<Vec<_>>())
}

/// A row for tests.
#[cfg(any(test, feature = "samples"))]
pub mod sample {
    use super::*;

    /// A row of ours, or of a peer, with this error \[1] and time \[s]: that of the place, while the axis is right.
    pub fn row(tool: &str, method: &str, value: f64, error: f64, cpu_time: f64) -> Row {
        let errors = Errors { r_c: 0.01 * error, axis: 0.0, phi: f64::NAN, energy: error };
        let measured = Measured {
            relative: Relative { place: error, axis: 0.0 * error, phi: f64::NAN },
            told: 100,
            end: errors,
            worst: errors,
            cpu_time,
            repeats: 5,
            is_interleaved: false,
            steps: Some(7.0),
            evaluations: None,
            taken: None,
        };
        let (tool, version, method, parameter) = (tool.into(), "1.0".into(), method.into(), "tolerance".into());
        Row { tool, version, vector_widths: [None; 2], method, order: None, parameter, value, outcome: Ok(measured) }
    }
}

#[cfg(test)]
mod tests {
    use super::sample::row;
    use super::*;

    #[test]
    fn what_is_not_known_stays_empty_and_text_is_quoted() {
        let failed = Row { outcome: Err("a \"word\", and more".into()), ..row("peer", "m", 1e-3, 1.0, 1.0) };
        let scale = Scale { simulated: 10.0, scene: 60.0, energy: 2.0, floor: 1e-9 };
        let text = csv(&[row("split-rotor", "m", 1e-3, 1e-6, 0.5), failed], scale);
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[0].starts_with("tool,version,vector_width,vector_width_of_processor,method,order,"));
        let ours: Vec<_> = lines[1].split(',').collect();
        assert_eq!(ours.len(), lines[0].split(',').count());
        assert_eq!(ours[..10], ["split-rotor", "1.0", "", "", "m", "", "tolerance", "0.001", "1e-6", "true"]);
        let column = |name| ours[lines[0].split(',').position(|column| column == name).unwrap()];
        assert_eq!(["place_error", "axis_error", "phi_error"].map(column), ["1e-6", "0.0", ""]);
        assert_eq!(["simulated_s", "scene_s"].map(column), ["10.0", "60.0"]);
        assert_eq!(column("phi_error_rad"), "");
        assert_eq!(column("energy_drift_relative"), "5e-7");
        assert_eq!(column("real_time_factor"), "20.0");
        assert!(lines[2].ends_with(",,,\"a \"\"word\"\", and more\""), "{}", lines[2]);
    }
}
