//! What the same error costs with a method of ours and with the peer whose runs are timed in turn with its.

use super::reference::Reference;
use super::row::{Measured, OURS, Row};
use super::table::{power, short};
use serde_json::{Value, json};

/// A peer, and the method of ours that solves as it does, by power series: their runs are timed in turn.
pub const PAIR: (&str, &str) = ("heyoka", "taylor");

/// The errors at which times are compared.
const GOALS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// A kind of error: its column of the CSV, its words, its value, and below what it cannot be told.
struct Kind {
    column: &'static str,
    words: &'static str,
    of: fn(&Measured) -> f64,
    floor: fn(&Reference) -> f64,
}

const KINDS: [Kind; 2] = [
    Kind {
        column: "worst_axis_error_rad",
        words: "of the axis at worst [rad]",
        of: |m| m.worst.axis,
        floor: |reference| reference.agreement[1].axis,
    },
    Kind {
        column: "error",
        words: "of place, axis and φ over the motion's own size",
        of: Measured::error,
        floor: |reference| reference.floor.worst(),
    },
];

/// Times for the same errors.
pub struct Ratios<'r> {
    /// What was measured with ours and with the peer.
    curves: [Vec<&'r Measured>; 2],
    reference: &'r Reference,
}

impl<'r> Ratios<'r> {
    /// Of these rows, where both were timed in turn.
    pub fn of(rows: &'r [Row], reference: &'r Reference) -> Option<Self> {
        let timed = |(tool, method): (&str, Option<&str>)| -> Vec<&Measured> {
            let own = rows.iter().filter(|row| row.tool == tool && method.is_none_or(|method| row.method == method));
            own.filter_map(|row| row.outcome.as_ref().ok()).filter(|m| m.is_interleaved).collect()
        };
        let curves = [(OURS, Some(PAIR.1)), (PAIR.0, None)].map(timed);
        curves.iter().all(|curve| !curve.is_empty()).then_some(Self { curves, reference })
    }

    /// Our time and the peer's \[s] for an error, where it can be told and both reach it.
    fn times(&self, kind: &Kind, goal: f64) -> Option<[f64; 2]> {
        if goal <= (kind.floor)(self.reference) {
            return None;
        }
        let [ours, theirs] =
            self.curves.each_ref().map(|curve| time_for(curve.iter().map(|m| (m.cpu_time, (kind.of)(m))), goal));
        Some([ours?, theirs?])
    }

    /// A row a kind of error.
    pub fn table(&self) -> String {
        let (peer, method) = PAIR;
        let mut text = format!("| CPU time of {method} over that of {peer}, for an error");
        text += &GOALS.map(|goal| format!(" | {}", power(goal))).concat();
        text += " |\n|---|--:|--:|--:|--:|\n";
        for kind in &KINDS {
            let cell = |goal| match self.times(kind, goal) {
                Some([ours, theirs]) => {
                    format!(" | {:.2} ({} : {} ms)", ours / theirs, short(1e3 * ours), short(1e3 * theirs))
                }
                None => " | -".into(),
            };
            text += &format!("| {}{} |\n", kind.words, GOALS.map(cell).concat());
        }
        text
    }

    /// An object a kind of error and an error.
    pub fn json(&self) -> Value {
        let (peer, method) = PAIR;
        let object = |kind: &Kind, goal: f64| {
            let times = self.times(kind, goal);
            json!({
                "of": kind.column,
                "at": goal,
                "method": method,
                "peer": peer,
                "cpu_time_s": times.map(|[ours, _]| ours),
                "peer_cpu_time_s": times.map(|[_, theirs]| theirs),
                "ratio": times.map(|[ours, theirs]| ours / theirs),
            })
        };
        KINDS.iter().flat_map(|kind| GOALS.map(|goal| object(kind, goal))).collect()
    }
}

/// The time \[s] of a curve of times and errors for this error, on the straight line between the settings to both sides of it, time
/// and error both as logarithms. Settings that take longer than another and err no less do not count. Where the cheapest errs less
/// already, its time; none where none errs so little.
fn time_for(curve: impl Iterator<Item = (f64, f64)>, goal: f64) -> Option<f64> {
    let mut points: Vec<_> = curve.filter(|(_, error)| error.is_finite()).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut last: Option<(f64, f64)> = None;
    for (time, error) in points {
        match last {
            None if error <= goal => return Some(time),
            Some((before, larger)) if error <= goal => {
                let part = (larger / goal).ln() / (larger / error).ln();
                return Some(before * (time / before).powf(part));
            }
            Some((_, least)) if error >= least => (),
            _ => last = Some((time, error)),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::reference::sample::reference;
    use super::super::row::sample::row;
    use super::*;

    #[test]
    fn a_time_lies_between_those_of_its_neighbours() {
        let curve = [(1.0, 1e-2), (4.0, 1e-6), (3.0, 1e-1), (16.0, 1e-8), (2.0, f64::NAN)];
        let at = |goal| time_for(curve.into_iter(), goal);
        // Half of the way from 1e-2 to 1e-6 is half of the way from 1 to 4, in logarithms of both.
        assert!((at(1e-4).unwrap() - 2.0).abs() < 1e-12);
        assert!((at(1e-7).unwrap() - 8.0).abs() < 1e-12);
        assert_eq!((at(0.5), at(1e-2), at(1e-6), at(1e-9)), (Some(1.0), Some(1.0), Some(4.0), None));
    }

    #[test]
    fn only_what_was_timed_in_turn_is_compared() {
        let timed = |tool, method, error, time| {
            let mut row = row(tool, method, 1e-3, error, time);
            let measured = row.outcome.as_mut().unwrap();
            (measured.worst.axis, measured.is_interleaved) = (0.01 * error, true);
            row
        };
        let ours = [(1e-2, 1e-3), (1e-8, 3e-3)].map(|(error, time)| timed(OURS, PAIR.1, error, time));
        let theirs = [(1e-2, 2e-3), (1e-8, 6e-3)].map(|(error, time)| timed(PAIR.0, "any", error, time));
        let rows = [ours, theirs].concat();
        let reference = reference(1e-7);
        assert!(Ratios::of(&rows[..2], &reference).is_none());
        let ratios = Ratios::of(&rows, &reference).unwrap();
        let table = ratios.table();
        assert!(
            table.contains("| of the axis at worst [rad] | 0.50 (1.0 : 2.0 ms) | 0.50 (1.4 : 2.9 ms) | - | - |"),
            "{table}"
        );
        assert!(table.ends_with("| 0.50 (1.2 : 2.4 ms) | 0.50 (2.1 : 4.2 ms) | - | - |\n"), "{table}");
        let json = ratios.json();
        assert_eq!((json.as_array().unwrap().len(), json[0]["of"].as_str()), (8, Some("worst_axis_error_rad")));
        assert!((json[0]["ratio"].as_f64().unwrap() - 0.5).abs() < 1e-12 && json[7]["ratio"].is_null(), "{json}");
        let apart = [(OURS, PAIR.1), (PAIR.0, "any")].map(|(tool, method)| row(tool, method, 1e-3, 1e-3, 1.0));
        assert!(Ratios::of(&apart, &reference).is_none());
    }
}
