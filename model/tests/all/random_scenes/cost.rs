//! What `auto` costs beside the best single method: CPU time at equal error.

use super::judge::{TOLERANCES, Verdict};
use super::play::Method;
use super::trial::Trial;
use super::truth::Truth;
use crate::harness::largest;

/// A run of `auto`, and the cheapest setting of a single method that errs no more.
pub struct Cost {
    /// The number of the scene, and what it is.
    pub number: u64,
    pub name: String,
    pub auto: Verdict,
    /// None where only `auto` comes to the end with so small an error.
    pub best: Option<Verdict>,
}

impl Cost {
    /// Of `auto` over the best [1].
    pub fn ratio(&self) -> f64 {
        self.best.as_ref().map_or(0.0, |best| self.auto.seconds / best.seconds)
    }

    /// As a line of the table.
    fn line(&self) -> String {
        let Self { number, name, auto, .. } = self;
        let best = self.best.as_ref().map_or("none".into(), |best| {
            format!("{} at {:.0e}, {:.3} ms", best.method, best.tolerance, 1e3 * best.seconds)
        });
        let Verdict { tolerance, method, seconds, .. } = auto;
        let (ms, error, ratio) = (1e3 * seconds, error(auto), self.ratio());
        format!("| {number} | {name} | {tolerance:e} | {method} | {error:.1e} | {ms:.3} | {best} | {ratio:.2} |")
    }
}

/// The least time of so many runs counts.
const REPEATS: usize = 3;

fn timed(trial: &Trial, truth: &Truth, method: Method, tolerance: f64) -> Verdict {
    let runs = (0..REPEATS).map(|_| Verdict::of(trial, truth, method, tolerance));
    runs.min_by(|a, b| a.seconds.total_cmp(&b.seconds)).expect("a run")
}

fn error(verdict: &Verdict) -> f64 {
    verdict.errors.as_ref().map_or(f64::INFINITY, |errors| largest(*errors))
}

/// What takes so many times as long as `auto` ever does will not be the best, nor will tighter settings \[1].
const HOPELESS: f64 = 2.0;

/// Of a scene at each tolerance.
pub fn of(number: u64, trial: &Trial, truth: &Truth) -> Vec<Cost> {
    let autos = TOLERANCES.map(|tolerance| timed(trial, truth, Method::Auto, tolerance));
    let longest = HOPELESS * largest(autos.iter().map(|auto| auto.seconds));
    let mut single = Vec::new();
    for method in &Method::ALL[1..] {
        for n in 4..=24 {
            single.push(timed(trial, truth, *method, libm::pow(10.0, -0.5 * f64::from(n))));
            if single.last().is_some_and(|last| last.seconds > longest) {
                break;
            }
        }
    }
    let cost = |auto: Verdict| {
        let as_good = single.iter().filter(|run| error(run) <= error(&auto));
        let best = as_good.min_by(|a, b| a.seconds.total_cmp(&b.seconds)).cloned();
        Cost { number, name: trial.name.clone(), auto, best }
    };
    autos.into_iter().map(cost).collect()
}

/// How many are told of.
const WORST: usize = 10;

/// A table in markdown of the dearest, and how many are how dear.
pub fn table(costs: &mut [Cost]) -> String {
    costs.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
    let part =
        |limit: f64| 100.0 * costs.iter().filter(|cost| cost.ratio() <= limit).count() as f64 / costs.len() as f64;
    let shares = [1.0, 1.25, 1.5, 2.0, 4.0].map(|limit| format!("{:.1} % up to {limit}", part(limit))).join(", ");
    let head = "| scene | what | tolerance | auto takes | its error | ms | best single method | auto over best |\n\
                |---|---|--:|---|--:|--:|---|--:|";
    let lines = costs.iter().take(WORST).map(Cost::line).collect::<Vec<_>>().join("\n");
    format!("Of {} pairs: {shares}.\n\n{head}\n{lines}", costs.len())
}
