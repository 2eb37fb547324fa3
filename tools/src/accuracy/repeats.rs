//! How often a run is repeated for its time: of all repeats the least counts, for the rest is what else the machine did.

use anyhow::Result;
use serde_json::{Value, json};

/// At least so many repeats.
const LEAST: usize = 3;
/// No more than so many, however short they are.
const MOST: usize = 200;
/// Enough, once they took so long together [s of CPU time].
const ENOUGH: f64 = 0.1;
/// Enough, whatever their number [s of CPU time]: a run of a second is not made five times.
const PATIENCE: f64 = 0.15;

/// Whether so many repeats are enough that took so long together \[s].
fn are_enough(repeats: usize, spent: f64) -> bool {
    spent >= PATIENCE || repeats >= MOST || (repeats >= LEAST && spent >= ENOUGH)
}

/// The rule for peers, who repeat their runs themselves.
pub fn rule() -> Value {
    json!({ "least": LEAST, "most": MOST, "enough": ENOUGH, "patience": PATIENCE })
}

/// Repeats a run that tells its CPU time \[s] and took `first` \[s] once; the least of them, and how many there were.
pub fn least_time(first: f64, mut run: impl FnMut() -> Result<f64>) -> Result<(f64, usize)> {
    let (mut least, mut spent, mut repeats) = (first, first, 1);
    while !are_enough(repeats, spent) {
        let time = run()?;
        least = least.min(time);
        spent += time;
        repeats += 1;
    }
    Ok((least, repeats))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_time_counts() {
        let mut times = [3.0, 1.0, 2.0].into_iter().map(|time| 0.016 * time).cycle();
        let (least, repeats) = least_time(0.04, || Ok(times.next().unwrap())).unwrap();
        assert_eq!((least, repeats), (0.016, LEAST));
    }

    #[test]
    fn short_runs_are_repeated_more_often_than_long_ones() {
        let repeats = |time| least_time(time, || Ok(time)).unwrap().1;
        assert_eq!(repeats(1e-6), MOST);
        assert_eq!(repeats(ENOUGH / 10.5), 11);
        assert_eq!(repeats(60.0), 1);
    }
}
