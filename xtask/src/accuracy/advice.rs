//! Which setting to take: the cheapest that reached what is wanted.

use super::motion::Errors;
use super::row::{Measured, OURS, Row};
use super::sweep::{AUTO, TOLERANCE};
use super::table::{about, methods, power, setting, short};

/// Axis errors at the end that a user may want [rad].
pub const GOALS: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// Times that differ by less are the same [1]: a busy machine shifts them by as much.
const SAME_TIME: f64 = 1.05;

/// The cheapest row that errs by no more than `goal` [rad], the axis at the end; of rows that take the same time, the most
/// accurate.
pub fn cheapest<'r>(rows: impl IntoIterator<Item = &'r Row>, goal: f64) -> Option<(&'r Row, &'r Measured)> {
    let reached: Vec<_> = measured(rows).filter(|(_, m)| m.end.axis <= goal).collect();
    let least = reached.iter().map(|(_, m)| m.cpu_time).min_by(f64::total_cmp)?;
    let same = reached.into_iter().filter(|(_, m)| m.cpu_time <= SAME_TIME * least);
    same.min_by(|(_, a), (_, b)| a.end.axis.total_cmp(&b.end.axis))
}

/// Between these tolerances a tolerance should mean the same [1].
const MEANT: std::ops::RangeInclusive<f64> = 1e-12..=1e-6;

/// What a tolerance means with each method of ours: the worst errors over it. `l` [m] is what r_c counts with, `floor` what
/// cannot be told.
pub fn meaning(rows: &[Row], l: f64, floor: Errors) -> Option<String> {
    let mut parts: Vec<String> = Vec::new();
    for (tool, method) in methods(rows).into_iter().filter(|(tool, method)| *tool == OURS && *method != AUTO) {
        let own = || {
            let adaptive = |row: &&Row| row.parameter == TOLERANCE && MEANT.contains(&row.value);
            measured(rows.iter().filter(|row| row.tool == tool && row.method == method).filter(adaptive))
        };
        let range = |of: fn(&Errors) -> f64, size: f64| {
            let told = own().filter(|(_, m)| of(&m.worst) > of(&floor));
            let factors: Vec<f64> = told.map(|(row, m)| of(&m.worst) / size / row.value).collect();
            let (least, most) = (factors.iter().copied().reduce(f64::min)?, factors.iter().copied().reduce(f64::max)?);
            Some(format!("{} to {}", short(least), short(most)))
        };
        let named = [("r_c in units of l", range(|e| e.r_c, l)), ("the axis in radians", range(|e| e.axis, 1.0))];
        let told = named.into_iter().filter_map(|(name, range)| Some(format!("{name} {}", range?)));
        let told: Vec<_> = told.collect();
        if !told.is_empty() {
            parts.push(format!("{method}: {}", told.join(", ")));
        }
    }
    let when = "The worst error of the run over the tolerance, from 1e-6 to 1e-12";
    (!parts.is_empty()).then(|| format!("{when}: {}.", parts.join("; ")))
}

/// The row that errs least.
pub fn most_accurate<'r>(rows: impl IntoIterator<Item = &'r Row>) -> Option<(&'r Row, &'r Measured)> {
    measured(rows).min_by(|(_, a), (_, b)| a.end.axis.total_cmp(&b.end.axis))
}

fn measured<'r>(rows: impl IntoIterator<Item = &'r Row>) -> impl Iterator<Item = (&'r Row, &'r Measured)> {
    rows.into_iter().filter_map(|row| Some((row, row.outcome.as_ref().ok()?)))
}

/// One sentence a goal, of our own methods; `floor` [rad]: no smaller error can be told. `stop` [s].
pub fn sentences(rows: &[Row], floor: f64, simulated: f64, stop: f64) -> Vec<String> {
    // `auto` is one of the others.
    let ours = || rows.iter().filter(|row| row.tool == OURS && row.method != AUTO);
    let sentence = |goal: f64| {
        let wanted = format!("For an axis error of at most {} rad at t = {stop} s", power(goal));
        if floor >= goal {
            return format!("{wanted} nothing can be said: the two references agree to {} rad only.", short(floor));
        }
        let name = |row: &Row| format!("{} with {}", row.method, setting(row));
        if let Some((row, m)) = cheapest(ours(), goal) {
            let factor = about(simulated / m.cpu_time);
            let (error, time) = (at_least(m.end.axis, floor), short(1e3 * m.cpu_time));
            let took = format!("it errs by {error} rad and takes {time} ms of CPU time, {factor} times real time");
            return format!("{wanted} take {}: {took}.", name(row));
        }
        match most_accurate(ours()) {
            Some((row, m)) => {
                let best = format!("{} comes closest with {} rad", name(row), at_least(m.end.axis, floor));
                format!("{wanted} no method suffices; {best}.")
            }
            None => format!("{wanted} no method suffices: none can run this scene."),
        }
    };
    GOALS.map(sentence).to_vec()
}

/// An error, or that it is too small to be told.
pub fn at_least(error: f64, floor: f64) -> String {
    if error <= floor && floor > 0.0 { format!("< {}", short(floor)) } else { short(error) }
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn exact_the_cheapest_that_reached_it() {
        let failed = Row { outcome: Err("no".into()), ..row(OURS, "d", 1e-9, 0.0, 0.0) };
        let rows = [
            row(OURS, "a", 1e-3, 1e-4, 1.0),
            row(OURS, "b", 1e-4, 1e-7, 3.0),
            row(OURS, "c", 1e-5, 1e-8, 2.0),
            // As cheap, for what a clock can tell, and less accurate.
            row(OURS, "f", 1e-5, 1e-7, 1.99),
            row(OURS, "e", 1e-6, f64::NAN, 0.5),
            failed,
        ];
        assert_eq!(cheapest(&rows, 1e-3).unwrap().0.method, "a");
        assert_eq!(cheapest(&rows, 1e-6).unwrap().0.method, "c");
        assert!(cheapest(&rows, 1e-9).is_none());
        assert_eq!(most_accurate(&rows).unwrap().0.method, "c");
    }

    #[test]
    fn exact_a_sentence_says_what_to_take_and_what_it_costs() {
        let rows = [row(OURS, "dop853", 2e-8, 4.56e-7, 0.0005), row("peer", "fast", 1e-8, 1e-12, 1e-6)];
        let [loose, middle, tight] = sentences(&rows, 1e-12, 10.0, 12.0).try_into().unwrap();
        let took = "it errs by 4.6e-7 rad and takes 0.50 ms of CPU time, 20 000 times real time.";
        for (goal, sentence) in [("1e-3", loose), ("1e-6", middle)] {
            let wanted = format!("For an axis error of at most {goal} rad at t = 12 s");
            assert_eq!(sentence, format!("{wanted} take dop853 with tolerance = 2e-8: {took}"));
        }
        let wanted = "For an axis error of at most 1e-9 rad at t = 12 s";
        let closest = "dop853 with tolerance = 2e-8 comes closest with 4.6e-7 rad";
        assert_eq!(tight, format!("{wanted} no method suffices; {closest}."));
        let none = &sentences(&rows, 3e-9, 10.0, 12.0)[2];
        assert_eq!(none, &format!("{wanted} nothing can be said: the two references agree to 3.0e-9 rad only."));
    }
}
