//! Instructions of the right-hand side, of the methods' steps and of fmi2DoStep, counted by gungraun
//! (`benches/instructions.rs`).

use super::operations::{Operations, of_recurrences, own_multiply_adds};
use super::{cargo_bench, head, target};
use crate::run::{cargo, installed, output};
use crate::{c, paths};
use anyhow::{Context, Result, bail, ensure};
use serde_json::Value;
use std::path::PathBuf;

/// What must not cost more.
struct Limit {
    scene: &'static str,
    what: &'static str,
    at_most: f64,
}

impl Limit {
    fn is_of(&self, scene: &str, count: &Count) -> bool {
        self.scene == scene && self.what == count.what()
    }
}

/// Instructions of one call.
const INSTRUCTIONS: [Limit; 1] = [Limit { scene: "paper", what: "right hand side, equations 12", at_most: 190.0 }];

/// Multiply-adds of a step over those of its method's tableau \[1]: so many with this method, which is met.
const ARITHMETIC: (&str, f64) = ("dop853", 1.5);

/// A step that is the method's own arithmetic and nothing else.
const ARITHMETIC_ALONE: &str = "fixed_step_without_rates";

/// What gungraun tells of one function.
struct Count {
    /// The function, and with what.
    function: String,
    with: String,
    instructions: f64,
    /// The program that was run, and callgrind's account of it.
    program: PathBuf,
    account: PathBuf,
}

impl Count {
    /// Reads one line of gungraun's JSON.
    fn parse(line: &str) -> Result<Self> {
        let summary: Value = serde_json::from_str(line)?;
        let text = |key: &str| summary[key].as_str().with_context(|| format!("there is no {key}"));
        let (function, with) = (text("function_name")?.to_owned(), text("id")?.to_owned());
        let metrics = &summary["profiles"][0]["data"]["total"]["metrics"];
        let account = format!("{}/callgrind.{function}.{with}.out", text("output_dir")?);
        Ok(Self {
            instructions: metrics["Ir"]["values"]["new"].as_f64().context("there is no count")?,
            program: paths::root().join(text("benchmark_exe")?),
            account: paths::root().join(account),
            function,
            with,
        })
    }

    fn what(&self) -> String {
        format!("{}, {}", self.function, self.with).replace('_', " ")
    }
}

/// Whether a scene has limits that must hold; those of arithmetic are the same with every scene.
pub fn is_limited(scene: &str) -> bool {
    INSTRUCTIONS.iter().any(|limit| limit.scene == scene)
}

/// Prints the tables of these scenes; which limits that must hold do not.
pub fn print(scenes: &[String]) -> Result<Vec<String>> {
    let runner = runner()?;
    let mut broken = Vec::new();
    let mut counts = Vec::new();
    for scene in scenes {
        counts = count(scene, &runner)?;
        println!("{}", head(&[scene, "instructions", "at most"]));
        for count in &counts {
            let limit = INSTRUCTIONS.iter().find(|limit| limit.is_of(scene, count));
            let at_most = limit.map(|limit| limit.at_most);
            println!("| {} | {} | {} |", count.what(), count.instructions, target(at_most, count.instructions));
            if limit.is_some_and(|limit| count.instructions > limit.at_most) {
                broken.push(format!("{scene}, {}: {} instructions", count.what(), count.instructions));
            }
        }
        series(scene, &counts)?;
    }
    arithmetic(&counts, &mut broken)?;
    Ok(broken)
}

/// A step by power series, and the scene in which it has no sums but those of the axis and of θ/sin θ.
const BY_SERIES: (&str, &str) = ("step_by_series", "paper");

/// Prints the arithmetic of steps by power series beside that of the axis's recurrences.
fn series(scene: &str, counts: &[Count]) -> Result<()> {
    let mut steps = counts.iter().filter(|count| count.function == BY_SERIES.0 && scene == BY_SERIES.1).peekable();
    if steps.peek().is_some() {
        let columns = ["executed", "of the recurrences of the axis", "ratio", "instructions", "instructions each"];
        println!("{}", head(&[&["multiply-adds of a step by series"], columns.as_slice()].concat()));
    }
    for Count { with, instructions, program, account, .. } in steps {
        let order = with.trim_start_matches("order_").parse().with_context(|| format!("{with} is no order"))?;
        let (executed, own) = (Operations::read(program, account)?.multiply_adds(), of_recurrences(order));
        let (ratio, each) = (executed / own, instructions / executed);
        println!("| order {order} | {executed} | {own} | {ratio:.2} | {instructions} | {each:.2} |");
    }
    Ok(())
}

/// Prints the methods' own arithmetic beside that of their tableaux.
fn arithmetic(counts: &[Count], broken: &mut Vec<String>) -> Result<()> {
    let columns = ["executed", "of the tableau", "ratio", "at most", "instructions each"];
    println!("{}", head(&[&["multiply-adds of a step"], columns.as_slice()].concat()));
    let of_methods: Vec<_> = counts.iter().filter(|count| count.function == ARITHMETIC_ALONE).collect();
    ensure!(
        of_methods.iter().any(|count| count.with == ARITHMETIC.0),
        "{} has a limit and was not counted",
        ARITHMETIC.0
    );
    for Count { with: method, instructions, program, account, .. } in of_methods {
        let (executed, own) = (Operations::read(program, account)?.multiply_adds(), own_multiply_adds(method)?);
        let (ratio, each) = (executed / own, instructions / own);
        let at_most = (*method == ARITHMETIC.0).then_some(ARITHMETIC.1);
        println!("| {method} | {executed} | {own} | {ratio:.2} | {} | {each:.2} |", target(at_most, ratio));
        if at_most.is_some_and(|at_most| ratio > at_most) {
            broken.push(format!("{method}: {ratio:.2} times the multiply-adds of its tableau"));
        }
    }
    Ok(())
}

/// What gungraun counts with a scene.
fn count(scene: &str, runner: &PathBuf) -> Result<Vec<Count>> {
    let lines = output(cargo_bench("instructions", scene).args(["--", "--output-format=json"]).env(RUNNER, runner))?;
    let counts = lines.lines().map(|line| Count::parse(line).with_context(|| format!("gungraun printed `{line}`")));
    let counts = counts.collect::<Result<Vec<_>>>()?;
    for limit in INSTRUCTIONS.iter().filter(|limit| limit.scene == scene) {
        let is_there = counts.iter().any(|count| limit.is_of(scene, count) && count.instructions > 0.0);
        ensure!(is_there, "{scene}: `{}` has a limit and was not counted", limit.what);
    }
    Ok(counts)
}

/// How gungraun is told where its runner is.
const RUNNER: &str = "GUNGRAUN_RUNNER";

/// gungraun's runner, of the version that Cargo.lock has of gungraun.
fn runner() -> Result<PathBuf> {
    c::tool("valgrind", "valgrind")?;
    let id = output(cargo().args(["pkgid", "gungraun"]))?;
    let Some((_, version)) = id.trim().rsplit_once('@') else { bail!("cargo pkgid printed `{id}`") };
    installed("gungraun-runner", version)
}
