//! One timed run of a scene's FMU, from its start to the stop of its experiment.

use super::motion::Point;
use super::span::{PARTS, POINTS, end_of_part, time};
use super::sweep::{AUTO, STEP, TOLERANCE};
use crate::course::{Course, Driven};
use crate::fmu::{Fmu, Instance, Reference};
use anyhow::{Context, Result, bail};
use cpu_time::ThreadTime;
use nalgebra::Vector3;
use split_rotor_model::scene::{Experiment, Scene};
use split_rotor_model::variable::Place;
use split_rotor_model::variables::METHODS;
use split_rotor_model::xml;
use std::path::Path;

/// What is read at each point.
pub const OUTPUTS: [&str; 11] = [
    "r_c.x",
    "r_c.y",
    "r_c.z",
    "axis.x",
    "axis.y",
    "axis.z",
    "turns",
    "angle",
    "energy.residual",
    "energy.total",
    "energy.kinetic",
];

/// The loosest relative tolerance \[1].
const LOOSE: f64 = 0.1;

/// What is read at the end.
const COSTS: [&str; 3] = ["solver.steps", "solver.rejected", "solver.evaluations"];

/// How often a run is asked whether it takes too long: the CPU clock takes as long to answer as a short step.
const ASKED: usize = 10;

/// A method and the one number by which its accuracy is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The method's name.
    pub method: &'static str,
    /// Its order, where that can be chosen.
    pub order: Option<i32>,
    /// The parameter's name.
    pub parameter: &'static str,
    /// The parameter's value.
    pub value: f64,
}

/// A scene's FMU, ready to run.
pub struct Subject<'s> {
    fmu: Fmu,
    /// The scene.
    pub scene: &'s Scene,
    /// Start and stop of its runs: those of the scene, or a part of it.
    pub experiment: Experiment,
    outputs: [Reference; OUTPUTS.len()],
    costs: [Reference; COSTS.len()],
    course: Course<'s>,
}

/// What a run showed and cost.
pub struct Run {
    /// The start.
    pub start: Point,
    /// What was read later.
    pub points: Vec<Point>,
    /// From after initialization to the last output read [s of CPU time].
    pub cpu_time: f64,
    /// Accepted steps, rejected steps, evaluations.
    pub costs: [f64; COSTS.len()],
    /// What `auto` said that it took.
    pub said: Vec<String>,
}

impl<'s> Subject<'s> {
    /// The FMU of this scene, whose library lies here.
    pub fn load(scene: &'s Scene, library: &Path) -> Result<Self> {
        let fmu = Fmu::load(library, &xml::guid(scene))?;
        let (outputs, costs) = (references(scene, OUTPUTS)?, references(scene, COSTS)?);
        Ok(Self { fmu, scene, experiment: scene.experiment, outputs, costs, course: Course::of(scene) })
    }

    /// A run with this setting; between two points that are read, `substeps` communication steps. An error where it takes
    /// longer than `patience` [s of CPU time] at the end of one of its tenths.
    pub fn run(&self, setting: &Setting, substeps: usize, patience: f64) -> Result<Run> {
        let between = |n: usize| {
            let [from, to] = [n - 1, n].map(|n| time(&self.experiment, n));
            (1..=substeps).map(move |k| {
                let is_last = k == substeps;
                (if is_last { to } else { from + (to - from) * k as f64 / substeps as f64 }, is_last)
            })
        };
        self.run_through(setting, &(1..=POINTS).flat_map(between).collect::<Vec<_>>(), patience)
    }

    /// A run that is read at the end of every part of the span, however long it takes.
    pub fn run_in_parts(&self, setting: &Setting) -> Result<Run> {
        let ends: Vec<_> = (1..=PARTS).map(|k| (end_of_part(&self.experiment, k), true)).collect();
        self.run_through(setting, &ends, f64::INFINITY)
    }

    /// A run through communication points \[s], with whether it is read there.
    fn run_through(&self, setting: &Setting, stops: &[(f64, bool)], patience: f64) -> Result<Run> {
        let mut instance = self.started(setting)?;
        let start = point(instance.get_real(&self.outputs)?);
        let mut points = Vec::with_capacity(stops.len());
        let mut at = self.experiment.start;
        let began = ThreadTime::now();
        for tenth in stops.chunks(stops.len().div_ceil(ASKED)) {
            for &(to, is_read) in tenth {
                self.course.go(&mut instance, at, to)?;
                at = to;
                if is_read {
                    points.push(point(instance.get_real(&self.outputs)?));
                }
            }
            if began.elapsed().as_secs_f64() > patience {
                bail!("takes more than {patience} s: stopped at t = {at} s");
            }
        }
        let cpu_time = began.elapsed().as_secs_f64();
        if !points.iter().all(Point::is_finite) {
            bail!("shows what is not a number");
        }
        Ok(Run { start, points, cpu_time, costs: instance.get_real(&self.costs)?, said: instance.said() })
    }

    /// To which of these times \[s] such a run comes, from the first on, with this many evaluations or a few more.
    pub fn reach(&self, setting: &Setting, times: impl IntoIterator<Item = f64>, affordable: f64) -> Result<f64> {
        let mut instance = self.started(setting)?;
        let mut at = self.experiment.start;
        for to in times {
            self.course.go(&mut instance, at, to)?;
            at = to;
            let [_, _, evaluations] = instance.get_real(&self.costs)?;
            if evaluations > affordable {
                break;
            }
        }
        Ok(at)
    }

    /// The step that this setting begins with \[s].
    pub fn first_step(&self, setting: &Setting) -> Result<f64> {
        let [step] = self.started(setting)?.get_real(&references(self.scene, ["solver.next_step"])?)?;
        Ok(step)
    }

    fn started(&self, setting: &Setting) -> Result<Instance<'_>> {
        // `auto` says what it takes.
        let is_auto = setting.method == AUTO;
        let mut instance = if is_auto { self.fmu.instantiate_with_log()? } else { self.fmu.instantiate()? };
        self.set(&mut instance, setting)?;
        let start = self.experiment.start;
        // A start at rest asks for them.
        let set = |(input, value): (Place, f64)| instance.set_real(input.value_reference(), value);
        self.course.values(start).try_for_each(set)?;
        instance.initialize(start, self.experiment.stop)?;
        self.course.begin(&mut instance, start)?;
        Ok(instance)
    }

    fn set(&self, instance: &mut Instance, setting: &Setting) -> Result<()> {
        let [method, absolute, parameter] =
            references(self.scene, ["solver.method_number", "solver.absolute_tolerance", setting.parameter])?;
        let chosen = METHODS.items.iter().find(|item| item.1 == setting.method);
        instance.set_integer(method, chosen.context("a method of the list")?.0)?;
        if let Some(order) = setting.order {
            let [reference] = references(self.scene, ["solver.order"])?;
            instance.set_integer(reference, order)?;
        }
        // A positive one would stand in for the relative tolerance, and all runs would be alike.
        instance.set_real(absolute, 0.0)?;
        if setting.parameter == STEP {
            // Else the tolerance of the scene would shorten the steps that are to be measured.
            let [tolerance] = references(self.scene, [TOLERANCE])?;
            instance.set_real(tolerance, LOOSE)?;
        }
        instance.set_real(parameter, setting.value)
    }
}

impl Driven for Instance<'_> {
    type Error = anyhow::Error;

    fn go(&mut self, from: f64, to: f64) -> Result<()> {
        self.do_step(from, to - from)
    }

    fn steer(&mut self, input: Place, [value, rate]: [f64; 2]) -> Result<()> {
        self.set_real(input.value_reference(), value)?;
        self.set_rate(input.value_reference(), rate)
    }
}

/// The value references of the scene's variables with these names.
fn references<const N: usize>(scene: &Scene, names: [&str; N]) -> Result<[Reference; N]> {
    let mut references = [0; N];
    for (reference, name) in references.iter_mut().zip(names) {
        let found = scene.variables.iter().find(|variable| variable.name == name);
        *reference = found.with_context(|| format!("the scene has no variable {name}"))?.place.value_reference();
    }
    Ok(references)
}

/// What these outputs show.
pub fn point(outputs: [f64; OUTPUTS.len()]) -> Point {
    let [x, y, z, t_x, t_y, t_z, turns, angle, residual, energy, kinetic] = outputs;
    Point { r_c: Vector3::new(x, y, z), axis: Vector3::new(t_x, t_y, t_z), turns, angle, residual, energy, kinetic }
}
