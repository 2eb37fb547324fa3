//! What is asked, how it is timed, and what is answered: as `xtask/python/peers/task.py` has it.

use crate::equations::{Rotor, State};
use anyhow::{Context, Result};
use cpu_time::ThreadTime;
use serde_json::{Value, json};

/// The scene, when it is looked at, and which settings are wanted.
pub struct Task {
    pub rotor: Rotor,
    pub start: State,
    /// The start, then the points at which the motion is read \[s]: irregular.
    pub times: Vec<f64>,
    tolerances: Vec<f64>,
    repeats: Value,
    /// The solver's.
    version: &'static str,
    /// Enough, once a method took so long [s of CPU time].
    budget: f64,
}

/// What a run showed.
pub enum Shown {
    /// The state at each communication point.
    All(Vec<State>),
    /// The state at the end only.
    End(State),
}

/// What a run showed and cost.
pub struct Motion {
    pub shown: Shown,
    pub steps: f64,
    pub evaluations: f64,
}

impl Task {
    /// The task, a line on the standard input, for the solver in this package.
    pub fn read(package: &str) -> Result<Self> {
        let locked = include_str!("../Cargo.lock");
        let after = locked.split_once(&format!("name = \"{package}\"\nversion = \"")).map(|(_, after)| after);
        let version = after.and_then(|after| after.split('"').next());
        let asked: Value = serde_json::from_str(&std::io::stdin().lines().next().context("there is no task")??)?;
        let value = |name: &str| asked["values"][name].as_f64().unwrap_or(0.0);
        let vector = |name: &str| ["x", "y", "z"].map(|c| value(&format!("{name}.{c}")));
        let list = |name: &str| -> Result<Vec<f64>> {
            let list = asked[name].as_array().with_context(|| format!("the task has no {name}"))?;
            Ok(list.iter().filter_map(Value::as_f64).collect())
        };
        let rotor = Rotor {
            m: value("rotor.m"),
            ja: value("rotor.Ja"),
            jt: value("rotor.Jt"),
            l: value("rotor.l"),
            g: vector("gravity.g"),
            c1: value("support.c1"),
            c2: value("support.c2"),
            d1: value("support.d1"),
            d2: value("support.d2"),
            tau: value("drive.tau"),
        };
        let [y, z] = ["start.gamma.y", "start.gamma.z"].map(value);
        let theta = y.hypot(z);
        let s = if theta > 0.0 { theta.sin() / theta } else { 1.0 };
        // eq. 2: t = e cosθ + (sinθ/θ) γ×e
        let axis = [theta.cos(), s * z, -s * y];
        let start = [vector("start.r_c"), vector("start.v_c"), vector("start.omega"), axis];
        Ok(Self {
            rotor,
            start: rotor.start(start, value("start.phi")),
            times: list("times")?,
            tolerances: list("tolerances")?,
            version: version.with_context(|| format!("there is no package `{package}`"))?,
            repeats: asked["repeats"].clone(),
            budget: asked["budget"].as_f64().context("the task has no budget")?,
        })
    }

    /// Runs each tolerance, from loose to tight, and prints what came of it.
    pub fn answer(&self, method: &str, run: impl Fn(f64) -> Result<Motion, String>) {
        let began = ThreadTime::now();
        for &tolerance in &self.tolerances {
            if began.elapsed().as_secs_f64() > self.budget {
                break;
            }
            let mut line =
                json!({ "version": self.version, "method": method, "parameter": "tolerance", "value": tolerance });
            let columns = match run(tolerance) {
                Ok(motion) => self.measured(&motion, || run(tolerance)),
                Err(failure) => json!({ "failure": failure }),
            };
            line.as_object_mut().expect("an object").extend(columns.as_object().expect("an object").clone());
            println!("{line}");
        }
    }

    fn measured<R>(&self, motion: &Motion, run: impl Fn() -> R) -> Value {
        let points = self.times.len() - 1;
        // What is not a number stands as null in JSON.
        let states = match &motion.shown {
            Shown::All(states) => states.clone(),
            Shown::End(end) => [vec![[f64::NAN; 13]; points - 1], vec![*end]].concat(),
        };
        if states.len() != points || !states[points - 1].iter().all(|x| x.is_finite()) {
            return json!({ "failure": "the run did not reach its end" });
        }
        let (least, repeats) = self.least_time(run);
        json!({
            "r_c": states.iter().map(|y| &y[..3]).collect::<Vec<_>>(),
            "axis": states.iter().map(|y| &y[9..12]).collect::<Vec<_>>(),
            "phi": states.iter().map(|y| y[12]).collect::<Vec<_>>(),
            "energy": states.iter().map(|y| self.rotor.energy(y)).collect::<Vec<_>>(),
            "cpu_time": least,
            "repeats": repeats,
            "steps": motion.steps,
            "evaluations": motion.evaluations,
        })
    }

    /// As `xtask/src/accuracy/repeats.rs` has it.
    fn least_time<R>(&self, run: impl Fn() -> R) -> (f64, u64) {
        let rule = |name: &str| self.repeats[name].as_f64().expect("the rule of repeats is whole");
        let (mut least, mut spent, mut repeats) = (f64::INFINITY, 0.0, 0);
        let enough = |repeats: u64, spent: f64| {
            let repeats = repeats as f64;
            spent >= rule("patience")
                || repeats >= rule("most")
                || (repeats >= rule("least") && spent >= rule("enough"))
        };
        while !enough(repeats, spent) {
            let began = ThreadTime::now();
            std::hint::black_box(run());
            let time = began.elapsed().as_secs_f64();
            (least, spent, repeats) = (least.min(time), spent + time, repeats + 1);
        }
        (least, repeats)
    }
}
