//! CPU times of a method of ours and of a peer's, the runs of both in turn: what else the machine does meets both alike.

use crate::run::Conversation;
use anyhow::{Context, Result};
use split_rotor_tools::accuracy::row::{Measured, Row};
use split_rotor_tools::accuracy::run::Subject;
use split_rotor_tools::accuracy::{PAIR, sweep};

/// The least of so many runs of each setting counts.
const RUNS: usize = 30;

/// Settings that take longer [s of CPU time] keep the times that they have: thirty more runs would take minutes.
const SHORT: f64 = 0.02;

/// Times our rows of the method anew, and those of the peer, which runs a setting once where it is told its number.
pub fn time<'r>(
    subject: &Subject,
    ours: impl Iterator<Item = &'r mut Row>,
    theirs: &mut [Row],
    peer: &mut Conversation,
) -> Result<()> {
    let run = |value| Ok(subject.run(&sweep::with_tolerance(PAIR.1, value), 1, f64::INFINITY)?.cpu_time);
    let ask = |number: usize| peer.ask(&number.to_string())?.parse().context("a peer answers with a number of seconds");
    in_turn(ours, theirs.iter_mut(), run, ask)
}

/// Times rows of ours by their settings' values, and a peer's by their numbers: a setting of ours, one of the peer's, and so on
/// through both, then all of that again.
fn in_turn<'o, 't>(
    ours: impl Iterator<Item = &'o mut Row>,
    theirs: impl Iterator<Item = &'t mut Row>,
    mut run: impl FnMut(f64) -> Result<f64>,
    mut ask: impl FnMut(usize) -> Result<f64>,
) -> Result<()> {
    let (mut ours, mut theirs) = (begun(ours), begun(theirs));
    for _ in 0..RUNS {
        for turn in 0..ours.len().max(theirs.len()) {
            if let Some((_, value, measured)) = ours.get_mut(turn) {
                note(measured, || run(*value))?;
            }
            if let Some((number, _, measured)) = theirs.get_mut(turn) {
                note(measured, || ask(*number))?;
            }
        }
    }
    Ok(())
}

/// The short ones of these rows, with their numbers and their settings' values; their times begin anew.
fn begun<'r>(rows: impl Iterator<Item = &'r mut Row>) -> Vec<(usize, f64, &'r mut Measured)> {
    let measured = rows.enumerate().filter_map(|(n, row)| Some((n, row.value, row.outcome.as_mut().ok()?)));
    let mut short: Vec<_> = measured.filter(|(_, _, measured)| measured.cpu_time <= SHORT).collect();
    for (_, _, measured) in &mut short {
        (measured.cpu_time, measured.repeats, measured.is_interleaved) = (f64::INFINITY, 0, true);
    }
    short
}

/// One more run. One before it, whose time does not count, brings back into the caches what other settings drove out.
fn note(measured: &mut Measured, mut run: impl FnMut() -> Result<f64>) -> Result<()> {
    run()?;
    measured.cpu_time = measured.cpu_time.min(run()?);
    measured.repeats += 1;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use split_rotor_tools::accuracy::row::OURS;
    use split_rotor_tools::accuracy::row::sample::row;
    use std::cell::{Cell, RefCell};

    #[test]
    fn runs_are_made_in_turn_and_the_least_counts() {
        let mut ours = [1e-3, 1e-6].map(|value| row(OURS, PAIR.1, value, value, 1e-3));
        let mut theirs = [1e-3, 1e-4, 1e-5, 1e-6].map(|value| row(PAIR.0, "any", value, value, 1e-3));
        theirs[0].outcome = Err("no".into());
        theirs[2].outcome.as_mut().unwrap().cpu_time = 2.0 * SHORT;
        let (order, runs) = (RefCell::new(Vec::new()), Cell::new(0.0));
        // Every second run counts, and of those the first: later ones take longer.
        let took = |who: String| {
            order.borrow_mut().push(who);
            runs.set(runs.get() + 1.0);
            Ok(1e-3 + 1e-6 * runs.get())
        };
        in_turn(ours.iter_mut(), theirs.iter_mut(), |value| took(value.to_string()), |n| took(n.to_string())).unwrap();
        let order = order.into_inner();
        assert_eq!(order[..8], ["0.001", "0.001", "1", "1", "0.000001", "0.000001", "3", "3"]);
        assert_eq!((order.len(), &order[8..16]), (8 * RUNS, &order[..8]));
        let told = |row: &Row| row.outcome.as_ref().map(|m| (m.cpu_time, m.repeats, m.is_interleaved)).ok();
        assert_eq!(ours.each_ref().map(told), [2.0, 6.0].map(|run| Some((1e-3 + 1e-6 * run, RUNS, true))));
        assert_eq!(told(&theirs[1]), Some((1e-3 + 1e-6 * 4.0, RUNS, true)));
        assert_eq!((told(&theirs[0]), told(&theirs[2])), (None, Some((2.0 * SHORT, 5, false))));
    }
}
