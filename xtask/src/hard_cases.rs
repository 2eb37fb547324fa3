//! `hard-cases`: the gallery of hard cases, each against an exact or independent answer, with a mutant that must make it
//! fail. The cases stand in `hard_cases/`, one file a family; they drive packaged FMUs as a host does.

mod antipode;
mod asymmetric;
mod bench;
mod case;
mod files;
mod free;
mod inputs;
mod machine;
mod method;
mod refusals;
mod rotors;
mod row;
mod runaways;
mod spin;
mod stiffness;
mod table;
mod times;
mod top;
mod whirl;
mod whirling;

use crate::progress::Progress;
use crate::run::side_by_side;
use crate::{known, package, paths};
use anyhow::{Result, bail, ensure};
use bench::{Bench, Stages};
use case::Case;
use cpu_time::ThreadTime;
use row::{Outcome, Row};
use std::path::Path;
use std::sync::Mutex;

/// Which cases, how long the long ones are, and whether the mutants run too.
#[derive(Clone, Debug, Default)]
pub struct Extent {
    /// Only cases whose names hold this.
    pub part: Option<String>,
    /// Long cases in full.
    pub whole: bool,
    /// Only cases that are longer in full.
    pub longer: bool,
    /// Each row once more with its mutant, which must fail.
    pub mutants: bool,
}

/// Packages the scenes that the gallery needs and runs it.
pub fn hard_cases(extent: &Extent) -> Result<()> {
    chosen(extent)?;
    package::package(&scenes().map(str::to_owned), None)?;
    run(extent, &paths::fmus())
}

/// The scenes whose FMUs the cases run in: no effects, gravity and support, those with a drive, asymmetry, unbalance at an
/// imposed speed, bearings with rotating damping, all.
pub fn scenes() -> [&'static str; 7] {
    ["free_top", "paper", "driven", "dzhanibekov", "jeffcott", "unstable_whirl", "rotor"]
}

/// Runs the gallery with the FMUs in this folder; an error where a bound is broken.
pub fn run(extent: &Extent, fmus: &Path) -> Result<()> {
    let cases = chosen(extent)?;
    let stages = Stages::load(&scenes(), fmus)?;
    let rows = measure(&stages, &cases, extent.mutants)?;
    files::write(&rows, extent)?;
    let broken: Vec<_> = rows.iter().filter_map(Row::complaint).collect();
    if !broken.is_empty() {
        bail!("{} of {} rows:\n{}", broken.len(), rows.len(), broken.join("\n"));
    }
    Ok(())
}

/// The cases that are to run; an error where there are none.
fn chosen(extent: &Extent) -> Result<Vec<Member>> {
    let mut cases = gallery(extent.whole);
    let names: Vec<_> = cases.iter().map(|(_, case)| case.name.clone()).collect();
    cases.retain(|(_, case)| extent.part.as_ref().is_none_or(|part| case.name.contains(part)));
    if let (true, Some(part)) = (cases.is_empty(), &extent.part) {
        let meant = known::meant(part, names.iter().map(String::as_str));
        bail!("no case's name holds {part:?}{meant}: there are\n  {}", names.join("\n  "));
    }
    if extent.longer {
        let shortened: Vec<_> = gallery(false).into_iter().map(|(_, case)| case.name).collect();
        cases.retain(|(_, case)| !shortened.contains(&case.name));
    }
    ensure!(!cases.is_empty(), "no case is longer in full");
    Ok(cases)
}

/// A case and the name of its family.
type Member = (&'static str, Case);

/// All cases, family by family; the long ones in full, or shortened.
fn gallery(whole: bool) -> Vec<Member> {
    let families = [
        ("free rotors", free::cases(whole)),
        ("free asymmetric rotors", asymmetric::cases(whole)),
        ("passages of −e", antipode::cases()),
        ("steady whirl", whirl::cases(whole)),
        ("resonance and growth", whirling::cases()),
        ("high spin", spin::cases()),
        ("times and steps", times::cases()),
        ("soft and stiff supports", stiffness::cases()),
        ("tops", top::cases()),
        ("jumps of a torque", inputs::cases()),
        ("ordinary rotors", rotors::cases()),
        ("runaways", runaways::cases()),
        ("refusals", refusals::cases()),
    ];
    families.into_iter().flat_map(|(family, cases)| cases.into_iter().map(move |case| (family, case))).collect()
}

fn measure<'c>(stages: &Stages, cases: &'c [Member], mutants: bool) -> Result<Vec<Row<'c>>> {
    let progress = Progress::of(cases.len());
    let measured = Mutex::new(Vec::new());
    side_by_side(&cases.iter().enumerate().collect::<Vec<_>>(), |_, (number, (family, case))| {
        let stage = stages.of(case.scene)?;
        progress.tell(&format!("measuring {}", case.name));
        let mut rows = Vec::new();
        for (method, bound) in &case.methods {
            let (bench, began) = (Bench::new(stage, method, None), ThreadTime::now());
            let outcome = outcome(case, &bench);
            let seconds = began.elapsed().as_secs_f64();
            let wrong = Bench::new(stage, method, Some(&case.mutant));
            let mutated = mutants.then(|| self::outcome(case, &wrong));
            ensure!(!mutants || wrong.is_changed(), "{}: its mutant changes nothing", case.name);
            let (bound, evaluations) = (*bound, bench.spent());
            rows.push(Row { family, case, method, bound, outcome, mutated, evaluations, seconds });
        }
        measured.lock().expect("no worker panics").push((*number, rows));
        progress.inc(1);
        Ok(())
    })?;
    drop(progress);
    let mut measured = measured.into_inner().expect("no worker panics");
    measured.sort_by_key(|(number, _)| *number);
    Ok(measured.into_iter().flat_map(|(_, rows)| rows).collect())
}

fn outcome(case: &Case, bench: &Bench) -> Outcome {
    (case.task)(bench).map_err(|error| format!("{error:#}"))
}
