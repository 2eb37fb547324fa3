//! What `auto` took, and how much dearer it is than the best.

use super::row::{Measured, OURS, Row};
use super::sweep::AUTO;
use super::table::{power, short};

/// Which methods `auto` took in a run, by what it said: `dop853`, or `dop853, stiff`.
pub fn taken(said: &[String]) -> Option<String> {
    let names = said.iter().filter_map(|message| {
        let after = message.strip_prefix("auto takes ").or_else(|| message.strip_prefix("auto goes on with "))?;
        after.split([':', ',', ' ']).next()
    });
    let mut names: Vec<_> = names.collect();
    names.dedup();
    match names[..] {
        [] => None,
        // First there, then back, and so on.
        [first, second, _, ..] => Some(format!("{first} and {second} by turns")),
        _ => Some(names.join(", then ")),
    }
}

/// What `auto` takes from its loosest to its tightest tolerance, and what it costs beside the cheapest setting that errs no
/// more; `floor` \[1]: no smaller error can be told.
pub fn sentence(rows: &[Row], floor: f64) -> Option<String> {
    let (row, ratio, best) = dearest(rows, floor)?;
    let mut taken: Vec<(&str, f64, f64)> = Vec::new();
    for row in rows.iter().filter(|row| row.method == AUTO) {
        let Some(name) = row.outcome.as_ref().ok().and_then(|m| m.taken.as_deref()) else { continue };
        match taken.last_mut() {
            Some((last, _, until)) if *last == name => *until = row.value,
            _ => taken.push((name, row.value, row.value)),
        }
    }
    let taken: Vec<_> = taken
        .into_iter()
        .map(|(name, from, until)| match from == until {
            true => format!("{name} at {}", power(from)),
            false => format!("{name} from {} to {}", power(from), power(until)),
        })
        .collect();
    Some(format!(
        "auto takes {}. At most, at {}, it is {} times as dear as the cheapest that errs no more: {best}.",
        taken.join("; "),
        power(row.value),
        short(ratio),
    ))
}

/// The row of `auto` that is dearest beside the cheapest that errs no more, how much dearer \[1], and that one's name.
fn dearest(rows: &[Row], floor: f64) -> Option<(&Row, f64, String)> {
    let ours = || rows.iter().filter(|row| row.tool == OURS).filter_map(|row| Some((row, row.outcome.as_ref().ok()?)));
    let error = |m: &Measured| m.error().max(floor);
    let beside = |(row, m): (_, &Measured)| {
        let good = ours().filter(|(other, o)| other.method != AUTO && error(o) <= error(m));
        let (best, b) = good.min_by(|(_, a), (_, b)| a.cpu_time.total_cmp(&b.cpu_time))?;
        Some((row, m.cpu_time / b.cpu_time, format!("{} with {}", best.method, super::table::setting(best))))
    };
    ours().filter(|(row, _)| row.method == AUTO).filter_map(beside).max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::super::row::sample::row;
    use super::*;

    #[test]
    fn the_best_errs_no_more_and_is_another() {
        let mut rows = [
            row(OURS, "a", 1e-3, 1e-2, 1.0),
            row(OURS, "b", 1e-4, 1e-5, 2.0),
            row("peer", "c", 1e-4, 1e-9, 0.1),
            row(OURS, AUTO, 1e-4, 1e-4, 3.0),
            row(OURS, AUTO, 1e-5, 1e-1, 1.25),
            // Nothing else is as good.
            row(OURS, AUTO, 1e-6, 1e-7, 9.0),
        ];
        let (found, ratio, best) = dearest(&rows, 1e-12).unwrap();
        assert_eq!((found.value, ratio, best.as_str()), (1e-4, 1.5, "b with tolerance = 1e-4"));
        for (n, name) in [(3, "a"), (4, "a"), (5, "b")] {
            rows[n].outcome.as_mut().unwrap().taken = Some(name.into());
        }
        let said = sentence(&rows, 1e-12).unwrap();
        assert!(
            said.starts_with("auto takes a from 1e-4 to 1e-5; b at 1e-6. At most, at 1e-4, it is 1.5 times"),
            "{said}"
        );
    }

    #[test]
    fn what_it_said_is_what_it_took() {
        let first =
            "auto takes dop853: why; and it takes stiff as long as stability alone would hold it to short steps";
        let second = "auto goes on with stiff from t = 0.5 s: what changes at 1e4 rad/s would hold dop853";
        let third = "auto goes on with dop853 from t = 0.7 s: why";
        let said = [first, "the relative tolerance in force is 1e-8", second, third].map(str::to_owned);
        let expected =
            [None, Some("dop853"), Some("dop853"), Some("dop853, then stiff"), Some("dop853 and stiff by turns")];
        for (n, taken_so_far) in expected.into_iter().enumerate() {
            assert_eq!(taken(&said[..n]).as_deref(), taken_so_far);
        }
        let exact = ["auto takes symplectic: nothing acts on the rotor".to_owned()];
        assert_eq!(taken(&exact).as_deref(), Some("symplectic"));
    }
}
