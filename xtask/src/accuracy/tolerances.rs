//! `accuracy --tolerances`: the error over the tolerance of all scenes, as docs/accuracy/tolerances.csv and as a table in
//! docs/accuracy.md.

use crate::progress::Progress;
use crate::unpacked::unpack;
use crate::{package, paths, scenes, sheets};
use anyhow::{Context, Result};
use serde_json::{Value, json};
use split_rotor_model::scene::Scene;
use split_rotor_tools::accuracy::motion::Relative;
use split_rotor_tools::accuracy::reference::Reference;
use split_rotor_tools::accuracy::run::Subject;
use split_rotor_tools::accuracy::{at_least, power, range, span, sweep};
use std::fmt::Write;
use std::fs;

/// The tolerances at which they run.
const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

/// A run that takes longer is left out [s of CPU time].
const PATIENCE: f64 = 5.0;

/// The methods of the table; all of them stand in the CSV.
const SHOWN: [&str; 2] = ["dop853", sweep::AUTO];

/// Where the table stands in docs/accuracy.md.
const MARK: &str = "tolerances";

/// What a method at a tolerance came to.
struct Found {
    method: &'static str,
    tolerance: f64,
    /// Errors and evaluations, or why there are none.
    outcome: Result<(Relative, f64), String>,
}

/// What was measured of a scene.
struct Measured {
    scene: String,
    /// Simulated time, and that of the whole scene \[s].
    spans: [f64; 2],
    /// What cannot be told.
    floor: Relative,
    found: Vec<Found>,
}

/// Measures all scenes, packaged anew or as they were last.
pub fn tolerances(packaged: bool) -> Result<()> {
    let names = Scene::names(&paths::scenes());
    if !packaged {
        package::package(&names, None)?;
    }
    let progress = Progress::of(names.len());
    let mut all = Vec::new();
    for name in &names {
        progress.tell(&format!("measuring {name}"));
        all.push(measure(name).with_context(|| name.clone())?);
        progress.inc(1);
    }
    drop(progress);
    let rows: Vec<_> = all.iter().flat_map(Measured::rows).collect();
    let table = table(&all);
    let folder = paths::root().join("docs/accuracy");
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("tolerances.csv"), sheets::csv(&rows))?;
    let page = paths::root().join("docs/accuracy.md");
    fs::write(&page, put(&fs::read_to_string(&page)?, MARK, &table)?)?;
    println!("{table}");
    Ok(())
}

fn measure(name: &str) -> Result<Measured> {
    let scene = scenes::find(name)?;
    let unpacked = unpack(&paths::fmu_in(&paths::fmus(), name))?;
    let mut subject = Subject::load(&scene, &unpacked.library)?;
    span::shorten(&mut subject);
    let reference = Reference::of(&subject)?;
    let run = |method, tolerance| {
        let run = subject.run(&sweep::with_tolerance(method, tolerance), 1, PATIENCE);
        let relative = run.map(|run| (reference.relative(&run.points), run.costs[2]));
        Found { method, tolerance, outcome: relative.map_err(|error| format!("{error:#}")) }
    };
    let found =
        sweep::with_a_tolerance().flat_map(|method| TOLERANCES.map(|tolerance| run(method, tolerance))).collect();
    let spans = [subject.experiment, scene.experiment].map(|experiment| experiment.stop - experiment.start);
    Ok(Measured { scene: name.into(), spans, floor: reference.floor, found })
}

impl Measured {
    fn rows(&self) -> impl Iterator<Item = Vec<(&'static str, Value)>> + '_ {
        self.found.iter().map(|Found { method, tolerance, outcome }| {
            let over =
                |of: fn(&Relative) -> f64| json!(outcome.as_ref().ok().map(|(errors, _)| of(errors) / tolerance));
            vec![
                ("scene", json!(self.scene)),
                ("simulated_s", json!(self.spans[0])),
                ("scene_s", json!(self.spans[1])),
                ("method", json!(method)),
                ("tolerance", json!(tolerance)),
                ("error_over_tolerance", over(Relative::worst)),
                ("place_error_over_tolerance", over(|errors| errors.place)),
                ("axis_error_over_tolerance", over(|errors| errors.axis)),
                ("phi_error_over_tolerance", over(|errors| errors.phi)),
                ("error_told", json!(outcome.as_ref().ok().map(|(errors, _)| errors.worst() > self.floor.worst()))),
                ("evaluations", json!(outcome.as_ref().ok().map(|(_, evaluations)| evaluations))),
                ("failure", json!(outcome.as_ref().err())),
            ]
        })
    }

    /// The least and the most error over the tolerance where it can be told, the loosest bound on it where it nowhere can, and at
    /// which tolerances the run did not end.
    fn cell(&self, of_method: &[&Found]) -> String {
        let floor = self.floor.worst();
        let ended =
            of_method.iter().filter_map(|found| Some((found.outcome.as_ref().ok()?.0.worst(), found.tolerance)));
        let told = ended.clone().filter(|(error, _)| *error > floor).map(|(error, tolerance)| error / tolerance);
        let errors = range(told).or_else(|| Some(at_least(0.0, floor / ended.clone().next()?.1)));
        let failed = of_method.iter().filter(|found| found.outcome.is_err());
        let none = failed.map(|found| format!("none at {}", power(found.tolerance)));
        errors.into_iter().chain(none).collect::<Vec<_>>().join(", ")
    }
}

/// A row a scene, a column a method.
fn table(all: &[Measured]) -> String {
    let tolerances = TOLERANCES.map(power).join(", ");
    let mut text = format!(
        "The error over the tolerance, least to most of {tolerances} (`<`: it cannot be told, so much at {}; `none`: the run did \
         not end, why is in the CSV):\n\n| scene |",
        power(TOLERANCES[0]),
    );
    text += &SHOWN.map(|method| format!(" {method} |")).concat();
    text += "\n|---|";
    text += &"---|".repeat(SHOWN.len());
    for measured in all {
        write!(text, "\n| `{}` |", measured.scene).expect("a String can be written to");
        for method in SHOWN {
            let of_method: Vec<_> = measured.found.iter().filter(|found| found.method == method).collect();
            write!(text, " {} |", measured.cell(&of_method)).expect("a String can be written to");
        }
    }
    text + "\n"
}

/// The page with `made` between `<!-- mark -->` and the next `<!-- end -->`.
fn put(page: &str, mark: &str, made: &str) -> Result<String> {
    let parts = page.split_once(&format!("<!-- {mark} -->\n"));
    let parts = parts.and_then(|(before, after)| Some((before, after.split_once("<!-- end -->")?.1)));
    let (before, after) = parts.with_context(|| format!("the page has no place for {mark}"))?;
    Ok(format!("{before}<!-- {mark} -->\n\n{}\n\n<!-- end -->{after}", made.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured() -> Measured {
        let errors = |place: f64| Relative { place, axis: 1e-9, phi: 0.0 };
        let found = sweep::with_a_tolerance().flat_map(|method| {
            TOLERANCES.map(|tolerance| {
                let refused = method == "dop853" && tolerance == 1e-4;
                let outcome = if refused { Err("no".into()) } else { Ok((errors(3.0 * tolerance), 7.0)) };
                Found { method, tolerance, outcome }
            })
        });
        let found = found.collect();
        Measured { scene: "some".into(), spans: [2.0, 6.0], floor: errors(1e-9), found }
    }

    #[test]
    fn a_row_has_the_worst_error_over_each_tolerance() {
        let rows: Vec<_> = measured().rows().collect();
        assert_eq!(rows.len(), 20);
        let csv = sheets::csv(&rows);
        let line = |n: usize| csv.lines().nth(n).unwrap();
        assert!(line(0).starts_with("scene,simulated_s,scene_s,method,tolerance,error_over_tolerance,"), "{csv}");
        assert!(line(5).ends_with(",no"), "{csv}");
        let number = |n: usize, name| rows[n].iter().find(|column| column.0 == name).unwrap().1.as_f64();
        // At 1e-8 the place is the worst, at 1e-10 the axis.
        assert!((number(2, "error_over_tolerance").unwrap() - 3.0).abs() < 1e-12);
        assert!((number(3, "error_over_tolerance").unwrap() - 10.0).abs() < 1e-12);
        assert_eq!(number(4, "error_over_tolerance"), None);
        let table = table(&[measured()]);
        assert!(table.contains("| scene | dop853 | auto |"), "{table}");
        let cells = "| `some` | 3.0, none at 1e-4 | 3.0 |";
        assert_eq!(table.lines().last(), Some(cells));
    }

    #[test]
    fn a_cell_has_what_can_be_told() {
        let found = |outcomes: [Option<f64>; 4]| {
            let errors = |place| (Relative { place, axis: 0.0, phi: 0.0 }, 7.0);
            let of = |(outcome, tolerance): (Option<f64>, f64)| Found {
                method: "some",
                tolerance,
                outcome: outcome.map(errors).ok_or("no".into()),
            };
            outcomes.into_iter().zip(TOLERANCES).map(of).collect::<Vec<_>>()
        };
        let cell = |outcomes| measured().cell(&found(outcomes).iter().collect::<Vec<_>>());
        assert_eq!(cell([Some(2e-4), Some(5e-6), Some(4e-8), Some(1e-10)]), "2.0 to 5.0");
        assert_eq!(cell([Some(2e-4), Some(0.0), None, None]), "2.0, none at 1e-8, none at 1e-10");
        assert_eq!(cell([Some(1e-9), Some(0.0), Some(0.0), Some(0.0)]), "< 1.0e-5");
    }

    #[test]
    fn a_table_is_put_between_its_marks() {
        let page = "a\n<!-- other -->\nb\n<!-- end -->\n<!-- tolerances -->\nold\n<!-- end -->\nc\n";
        let made = put(page, MARK, "new\n").unwrap();
        assert_eq!(made, page.replace("old\n", "\nnew\n\n"));
        assert_eq!(put(&made, MARK, "new\n").unwrap(), made);
        assert!(put("no marks", MARK, "new").is_err());
    }
}
