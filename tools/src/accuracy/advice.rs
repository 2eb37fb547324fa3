//! Which setting to take: the cheapest that reached what is wanted.

use super::row::{Measured, OURS, Row};
use super::sweep::{AUTO, TOLERANCE};
use super::table::{about, methods, power, range, setting, short};

/// Errors that a user may want, over the motion's own size \[1].
pub const GOALS: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// Times that differ by less are the same \[1]: a busy machine shifts them by as much.
const SAME_TIME: f64 = 1.05;

/// The cheapest row that errs by no more than `goal` \[1] in place, axis and φ; of rows that take the same time, the most accurate.
pub fn cheapest<'r>(rows: impl IntoIterator<Item = &'r Row>, goal: f64) -> Option<(&'r Row, &'r Measured)> {
    let reached: Vec<_> = measured(rows).filter(|(_, m)| m.error() <= goal).collect();
    let least = reached.iter().map(|(_, m)| m.cpu_time).min_by(f64::total_cmp)?;
    let same = reached.into_iter().filter(|(_, m)| m.cpu_time <= SAME_TIME * least);
    same.min_by(|(_, a), (_, b)| a.error().total_cmp(&b.error()))
}

/// Between these tolerances a tolerance should mean the same \[1].
const MEANT: std::ops::RangeInclusive<f64> = 1e-12..=1e-4;

/// What a tolerance means with each method of ours: the error over it. `floor` \[1] is what cannot be told.
pub fn meaning(rows: &[Row], floor: f64) -> Option<String> {
    let mut parts: Vec<String> = Vec::new();
    for (tool, method) in methods(rows).into_iter().filter(|(tool, _)| *tool == OURS) {
        let own = rows.iter().filter(|row| row.tool == tool && row.method == method);
        let adaptive = own.filter(|row| row.parameter == TOLERANCE && MEANT.contains(&row.value));
        let told = measured(adaptive).filter(|(_, m)| m.error() > floor);
        let factors: Vec<f64> = told.map(|(row, m)| m.error() / row.value).collect();
        parts.extend(range(factors.into_iter()).map(|range| format!("{method} {range}")));
    }
    (!parts.is_empty()).then(|| format!("The error over the tolerance, from 1e-4 to 1e-12: {}.", parts.join(", ")))
}

/// The row that errs least.
pub fn most_accurate<'r>(rows: impl IntoIterator<Item = &'r Row>) -> Option<(&'r Row, &'r Measured)> {
    measured(rows).filter(|(_, m)| m.error().is_finite()).min_by(|(_, a), (_, b)| a.error().total_cmp(&b.error()))
}

fn measured<'r>(rows: impl IntoIterator<Item = &'r Row>) -> impl Iterator<Item = (&'r Row, &'r Measured)> {
    rows.into_iter().filter_map(|row| Some((row, row.outcome.as_ref().ok()?)))
}

/// One sentence a goal, of our own methods; `floor` \[1]: no smaller error can be told. `simulated` \[s].
pub fn sentences(rows: &[Row], floor: f64, simulated: f64) -> Vec<String> {
    // `auto` is one of the others.
    let ours = || rows.iter().filter(|row| row.tool == OURS && row.method != AUTO);
    let sentence = |goal: f64| {
        let wanted = format!("For an error of at most {}", power(goal));
        // What is not a number is no agreement either.
        if floor.is_nan() || floor >= goal {
            return format!("{wanted} nothing can be said: the two references agree to {} only.", short(floor));
        }
        let name = |row: &Row| format!("{} with {}", row.method, setting(row));
        if let Some((row, m)) = cheapest(ours(), goal) {
            let factor = about(simulated / m.cpu_time);
            let (error, time) = (at_least(m.error(), floor), short(1e3 * m.cpu_time));
            let took = format!("it errs by {error} and takes {time} ms of CPU time, {factor} times real time");
            return format!("{wanted} take {}: {took}.", name(row));
        }
        match most_accurate(ours()) {
            Some((row, m)) => {
                let best = format!("{} comes closest with {}", name(row), at_least(m.error(), floor));
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
    use super::super::row::sample::row;
    use super::*;

    #[test]
    fn the_cheapest_that_reached_it() {
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

    /// The axis of these rows is right; their place is not.
    #[test]
    fn no_setting_is_advised_that_errs_in_any_of_the_three() {
        let rows = [row(OURS, "wrong", 1e-3, 0.62, 1e-6), row(OURS, "right", 1e-6, 5e-4, 1.0)];
        assert_eq!(rows[0].outcome.as_ref().unwrap().end.axis, 0.0);
        let [loose, middle, tight] = sentences(&rows, 1e-12, 6.0).try_into().unwrap();
        assert!(loose.starts_with("For an error of at most 1e-3 take right with"), "{loose}");
        for none in [middle, tight] {
            assert!(
                none.contains("no method suffices; right with tolerance = 1e-6 comes closest with 5.0e-4"),
                "{none}"
            );
        }
        let unknown = [row(OURS, "a", 1e-3, f64::NAN, 1.0)];
        assert!(
            sentences(&unknown, 0.0, 6.0)
                .iter()
                .all(|said| said.ends_with("no method suffices: none can run this scene."))
        );
        assert!(sentences(&rows, f64::NAN, 6.0).iter().all(|said| said.contains("nothing can be said")));
    }

    #[test]
    fn a_tolerance_means_the_error_over_it() {
        let mut rows = [(1e-3, 1.0), (1e-4, 2e-4), (1e-8, 3e-7), (1e-12, 1e-13)]
            .map(|(tolerance, error)| row(OURS, "a", tolerance, error, 1.0));
        for row in &mut rows {
            row.parameter = TOLERANCE.into();
        }
        assert_eq!(meaning(&rows, 2e-13).unwrap(), "The error over the tolerance, from 1e-4 to 1e-12: a 2.0 to 30.");
        assert_eq!(meaning(&rows[..1], 0.0), None);
    }

    #[test]
    fn a_sentence_says_what_to_take_and_what_it_costs() {
        let rows = [row(OURS, "dop853", 2e-8, 4.56e-7, 0.0005), row("peer", "fast", 1e-8, 1e-12, 1e-6)];
        let [loose, middle, tight] = sentences(&rows, 1e-12, 10.0).try_into().unwrap();
        let took = "it errs by 4.6e-7 and takes 0.50 ms of CPU time, 20 000 times real time.";
        for (goal, sentence) in [("1e-3", loose), ("1e-6", middle)] {
            let wanted = format!("For an error of at most {goal}");
            assert_eq!(sentence, format!("{wanted} take dop853 with tolerance = 2e-8: {took}"));
        }
        let wanted = "For an error of at most 1e-9";
        let closest = "dop853 with tolerance = 2e-8 comes closest with 4.6e-7";
        assert_eq!(tight, format!("{wanted} no method suffices; {closest}."));
        let none = &sentences(&rows, 3e-9, 10.0)[2];
        assert_eq!(none, &format!("{wanted} nothing can be said: the two references agree to 3.0e-9 only."));
    }
}
