//! `run`: a scene simulated in this process, without a package, with its report.

use crate::numbers::{micrometres, rounded};
use crate::progress::{Progress, program};
use crate::{python, report, scenes, sheets};
use anyhow::{Context, Result, ensure};
use cpu_time::ThreadTime;
use serde_json::{Value, json};
use split_rotor_model::effects::Effects;
use split_rotor_model::error::Invalid;
use split_rotor_model::scene::{Experiment, Scene};
use split_rotor_model::simulation::{Deflection, Growth};
use split_rotor_model::xml;
use split_rotor_tools::run::{self, Run};
use std::f64::consts::PI;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::Duration;

/// A report looks at a run so often, at least: it must see what goes on within a turn.
const SEEN: f64 = 1e4;

/// Runs a scene from start to stop of its experiment; leaves in the folder `out`, or target/run/SCENE, result.csv, with every output at each
/// communication point, the modelDescription.xml that says what these are, and the largest deflections in deflections.json. Where a step
/// cannot be done, what was reached is left all the same.
pub fn simulate(scene: &str, with_report: bool, out: Option<&Path>) -> Result<()> {
    let name = scene;
    let scene = scenes::find_warned(name)?;
    check_size(&scene)?;
    let folder = sheets::folder(out, &format!("run/{}", scene.name))?;
    std::fs::write(folder.join("modelDescription.xml"), xml::model_description(&scene))?;
    let table = folder.join(RESULT);
    let outputs: Vec<_> = run::outputs(&scene).collect();
    let run = Run::of(&scene, outputs.clone()).with_deflections();
    let mut recorded = Recorded { tells: true, ..Recorded::of(run) };
    let outcome = recorded.record(&scene.experiment, &table);
    std::fs::write(folder.join(DEFLECTIONS), format!("{:#}\n", recorded.deflections()))?;
    if recorded.print(&scene.title)? {
        println!("  table      {}", table.display());
    }
    outcome.with_context(|| scene.file.display().to_string())?;
    if with_report {
        let Experiment { start, stop, step, .. } = scene.experiment;
        let parts = (SEEN * step / (stop - start) * (1.0 - 1e-9)).ceil().max(1.0);
        let table = if parts > 1.0 {
            let often = Experiment { step: step / parts, ..scene.experiment };
            Recorded::of(Run::of(&scene, outputs)).record(&often, &folder.join(SAMPLES))?;
            SAMPLES
        } else {
            RESULT
        };
        let view = report::linear_view(name);
        let unheld = report::unheld(&recorded.run);
        let mut report = python::python()?;
        let solver = recorded.solving.as_secs_f64().to_string();
        report
            .arg("xtask/python/run.py")
            .arg(&folder)
            .args(["--table", table, "--solver", &solver])
            .args(view)
            .args(unheld);
        program("making the report", &mut report)?;
    }
    Ok(())
}

/// Nobody means a table of more points than this: some gigabytes.
const MOST_POINTS: usize = 10_000_000;

fn check_size(scene: &Scene) -> Result<()> {
    let (Experiment { start, stop, step, .. }, points) = (scene.experiment, run::points(&scene.experiment));
    let bound = || {
        format!(
            "at least {:.1e} s, for a table of {points:.1e} lines is too long to write",
            (stop - start) / MOST_POINTS as f64
        )
    };
    ensure!(points <= MOST_POINTS, scene.refused(&Invalid::new("experiment.step", step, bound())));
    Ok(())
}

/// The run as its experiment has it, and seen more often, which the report is made from where that is too seldom.
const RESULT: &str = "result.csv";
const SAMPLES: &str = "samples.csv";

/// The largest deflections, of which the terminal and the report speak.
const DEFLECTIONS: &str = "deflections.json";

/// A run and what was seen of it.
struct Recorded<'s> {
    run: Run<'s>,
    /// The column of `energy.residual`, and its largest size at a communication point \[J].
    residual: Option<usize>,
    largest_residual: f64,
    /// CPU time of the run without writing it, with the search for the largest deflections.
    solving: Duration,
    /// Whether it warns of what grows.
    tells: bool,
}

impl<'s> Recorded<'s> {
    /// Runs, and writes each communication point as a line of `file`, that where the motion ends early too.
    fn record(&mut self, experiment: &Experiment, file: &Path) -> Result<()> {
        let mut table = BufWriter::new(File::create(file)?);
        let names: Vec<_> = self.run.outputs().iter().map(|output| output.name.as_str()).collect();
        writeln!(table, "time,{}", names.join(","))?;
        let progress = Progress::of(run::points(experiment));
        progress.set_message("simulating");
        let (tells, mut writing, mut told) = (self.tells, Duration::ZERO, 0);
        let (residual, largest) = (self.residual, &mut self.largest_residual);
        let mut told_of_unheld = false;
        let mut doubts_told = 0;
        let began = ThreadTime::now();
        let outcome = self.run.follow(experiment, |run, t| {
            let began = ThreadTime::now();
            let values = run.values()?;
            *largest = residual.map_or(*largest, |column| largest.max(values[column].abs()));
            write(values, t, &mut table)?;
            progress.inc(1);
            // At once: what grows or drifts without bound may take long.
            if let Some(unheld) = run.unheld().filter(|_| tells && !told_of_unheld) {
                let kind = if unheld.is_mere_axial() { "note" } else { "warning" };
                progress.suspend(|| eprintln!("{kind}: {unheld}"));
                told_of_unheld = true;
            }
            while let Some(growth) = run.grown().get(told).filter(|_| tells) {
                progress.suspend(|| eprintln!("warning: {growth}"));
                told += 1;
            }
            while let Some((block, doubt)) = run.doubts().get(doubts_told).filter(|_| tells) {
                progress.suspend(|| eprintln!("warning: {}", doubt.words(block)));
                doubts_told += 1;
            }
            writing += began.elapsed();
            Ok(())
        });
        self.solving = began.elapsed() - writing;
        table.flush()?;
        outcome
    }

    fn of(run: Run<'s>) -> Self {
        let residual = run.outputs().iter().position(|output| output.name == "energy.residual");
        Self { run, residual, largest_residual: 0.0, solving: Duration::ZERO, tells: false }
    }

    /// The largest deflections of the stations, static ones included.
    fn deflections(&self) -> Value {
        let told = |(name, Deflection { position, largest, at }): (&str, Deflection)| json!({ "station": name, "position_m": position, "largest_m": largest, "at_s": at });
        self.run.largest().map(told).collect()
    }

    /// Prints what came of it, if it began.
    fn print(&mut self, title: &str) -> Result<bool> {
        let Some(t) = self.run.simulation.time() else { return Ok(false) };
        println!("{title}");
        // Steps add up to a time with rounding in its last digits.
        let t: f64 = format!("{t:.11e}").parse()?;
        println!(
            "  time       up to {t} s, {:.3} s of CPU time with the search for the largest deflections",
            self.solving.as_secs_f64()
        );
        let method = self.run.method();
        let cost = self.run.simulation.read()?.cost;
        let (steps, rejected, evaluations) = (cost.steps, cost.rejected, cost.evaluations);
        println!("  solver     {method}: {steps} steps, {rejected} rejected, {evaluations} evaluations");
        if let Some(words) = self.run.simulation.auto() {
            println!("             {words}");
        }
        println!("  energy     energy.residual at most {:.2e} J at the communication points", self.largest_residual);
        // With the speeds of the whole run; they were told as the first of them was met.
        if let Some(speeds) = self.run.simulation.speeds_met() {
            self.run.simulation.parameters().effects.doubts(speeds, None, &mut |block, doubt| {
                println!("  doubtful   {}", doubt.words(block));
            });
        }
        for (name, Deflection { largest, at, .. }) in self.run.largest() {
            println!(
                "  deflection {name} at most {} µm off the x axis, static deflection included, at {} s",
                micrometres(largest),
                rounded(at)
            );
        }
        for Growth { rate, t, speed, at_ports } in self.run.grown() {
            let (rpm, time) = (rounded(speed * 30.0 / PI), rounded(1.0 / rate));
            let held = if *at_ports { "with the loads at its ports held, " } else { "" };
            println!(
                "  unstable   {held}seen at {} s, {rpm} rpm: small motions grow by a factor of e in {time} s",
                rounded(*t)
            );
        }
        if let Some(unjudged) = self.run.unjudged() {
            println!("  unknown    {unjudged}");
        }
        if let Some(rattle) = self.run.simulation.rattle() {
            println!("  chaotic    {rattle}");
        }
        Ok(true)
    }
}

/// Writes what the outputs are at time `t` \[s].
fn write(values: &[f64], t: f64, table: &mut impl Write) -> Result<()> {
    let values: Vec<_> = values.iter().map(|value| format!("{value:?}")).collect();
    Ok(writeln!(table, "{t:?},{}", values.join(","))?)
}

#[cfg(test)]
mod tests {
    use super::Recorded;
    use crate::paths;
    use split_rotor_model::scene::Scene;
    use split_rotor_tools::run::{self, Run};
    use std::path::Path;

    fn record(scene: &Scene, file: &Path) -> anyhow::Result<()> {
        Recorded::of(Run::of(scene, run::outputs(scene).collect())).record(&scene.experiment, file)
    }

    /// The lines that are left of the paper's rotor with this in its file, and what the run said.
    fn recorded(name: &str, other: &[(&str, &str)]) -> (Vec<Vec<f64>>, Result<(), String>) {
        let text = std::fs::read_to_string(paths::scenes().join("paper.toml")).unwrap();
        let text = other.iter().fold(text, |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        });
        let scene = Scene::parse(Path::new("other.toml"), &text).unwrap();
        let folder = paths::target().join("tests/run");
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join(name);
        let outcome = record(&scene, &file).map_err(|error| error.to_string());
        let table = std::fs::read_to_string(file).unwrap();
        let number = |field: &str| field.parse().unwrap();
        (table.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect(), outcome)
    }

    #[test]
    fn exact_the_last_step_is_cut_at_the_stop() {
        let (lines, outcome) = recorded("cut.csv", &[("stop = 10.0", "stop = 0.025")]);
        assert_eq!(outcome, Ok(()));
        assert_eq!(lines.iter().map(|line| line[0]).collect::<Vec<_>>(), [0.0, 0.01, 0.02, 0.025]);
    }

    #[test]
    fn exact_inputs_bend_and_jump_between_communication_points() {
        let text = "[rotor]\nm = 1.0\nJa = 0.5\nJt = 0.4\n[effects.drive]\n[[input]]\nname = \"drive.tau\"\n\
            time = [0.55, 1.45, 1.45, 2.0]\nvalue = [0.0, 0.9, -2.0, -2.0]\n\
            [experiment]\nstart = 0.2\nstop = 2.4\nstep = 0.2\n[solver]\nrelative_tolerance = 1e-12\n";
        let scene = Scene::parse(Path::new("torque.toml"), text).unwrap();
        let folder = paths::target().join("tests/run");
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join("torque.csv");
        record(&scene, &file).unwrap();
        let table = std::fs::read_to_string(file).unwrap();
        let column = table.lines().next().unwrap().split(',').position(|name| name == "omega_phi").unwrap();
        for line in table.lines().skip(1) {
            let values: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
            let (t, ramp) = (values[0], (values[0].min(1.45) - 0.55).max(0.0));
            // Ja ω = ∫ τ dt
            let exact = (0.5 * ramp * ramp - 2.0 * (t - 1.45).max(0.0)) / 0.5;
            assert!((values[column] - exact).abs() < 1e-13, "at {t} s {} for {exact}", values[column]);
        }
    }

    #[test]
    fn a_motion_that_ends_early_is_told_and_left_up_to_there() {
        // It tumbles, held by next to no spring, whose law ends at 3.1 rad.
        let tumbles = [
            ("omega = { x = 50.0", "omega = { y = 4.9"),
            ("z = -9.81", "z = 0.0"),
            ("c1 = 2000.0", "c1 = 0.0"),
            ("c2 = 500.0", "c2 = 1e-300"),
        ];
        let (lines, outcome) = recorded("early.csv", &tumbles);
        assert!(outcome.unwrap_err().contains("the tilt |gamma| reaches 3.1 rad"));
        let (last, end) = (lines.last().unwrap()[0], 3.1 / 4.9);
        assert!((last - end).abs() < 1e-9, "{last}");
        assert_eq!(lines.len(), 64 + 1, "each hundredth of a second, and where it ended");
    }
}
