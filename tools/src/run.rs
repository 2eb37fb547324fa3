//! A scene run over the list of all effects, which gives the bits of the scene's FMU.

use crate::course::Course;
use anyhow::{Context, Error, Result, bail, ensure};
use split_rotor_model::integrate::Fault;
use split_rotor_model::scene::{Experiment, Scene};
use split_rotor_model::simulation::{General, Growth, Unjudged};
use split_rotor_model::variable::Role;
use split_rotor_model::variables::{METHODS, Variable};

/// So many radii of gyration off the x axis a rotor turns in no machine: what made it go there is of no interest \[1].
const LOST: f64 = 30.0;

/// The ω_φ of the largest size [rad/s] that a run of the scene comes to, looked at a thousand times; until it is lost.
pub fn fastest(scene: &Scene) -> f64 {
    let rotor = scene.parameters().setup.rotor;
    let far = LOST * (rotor.Jt / rotor.m).sqrt();
    let named = ["omega_phi", "r_c.y", "r_c.z"].map(|name| outputs(scene).find(|output| output.name == name));
    let (mut run, mut fastest) = (Run::of(scene, named.into_iter().flatten().collect()), 0.0_f64);
    let Experiment { start, stop, .. } = scene.experiment;
    let seldom = Experiment { step: (stop - start) / 1e3, ..scene.experiment };
    let look = |run: &mut Run, _| {
        let &[speed, y, z] = run.values()? else { bail!("every scene has these outputs") };
        ensure!(y.hypot(z) < far, "lost");
        if speed.abs() > fastest.abs() {
            fastest = speed;
        }
        Ok(())
    };
    // What a run that ends early comes to counts all the same.
    let _ = run.follow(&seldom, look);
    fastest
}

/// The outputs of a scene.
pub fn outputs(scene: &Scene) -> impl Iterator<Item = &Variable> {
    scene.variables.iter().filter(|variable| matches!(variable.meta.role, Role::Output))
}

/// How many communication points follow the first.
pub fn points(Experiment { start, stop, step, .. }: &Experiment) -> usize {
    ((stop - start) / step - 1e-9).ceil() as usize
}

/// A run.
pub struct Run<'s> {
    /// What moves.
    pub simulation: General,
    outputs: Vec<&'s Variable>,
    references: Vec<u32>,
    values: Vec<f64>,
    course: Course<'s>,
    scene: &'s Scene,
    grown: Vec<Growth>,
    unjudged: Option<Unjudged>,
}

impl<'s> Run<'s> {
    /// Of a scene with its own inputs, of which these outputs are read.
    pub fn of(scene: &'s Scene, outputs: Vec<&'s Variable>) -> Self {
        let references = outputs.iter().map(|output| output.place.value_reference()).collect();
        let (simulation, values) = (General::from(scene.parameters()), vec![0.0; outputs.len()]);
        Self {
            simulation,
            outputs,
            references,
            values,
            course: Course::of(scene),
            scene,
            grown: Vec::new(),
            unjudged: None,
        }
    }

    /// What began to grow on the way.
    pub fn grown(&self) -> &[Growth] {
        &self.grown
    }

    /// Where it first was not found whether anything grows.
    pub fn unjudged(&self) -> Option<Unjudged> {
        self.unjudged
    }

    /// The outputs that are read.
    pub fn outputs(&self) -> &[&'s Variable] {
        &self.outputs
    }

    /// Runs; at each communication point \[s] it is `seen`, that where the motion ends early too.
    pub fn follow(
        &mut self,
        experiment: &Experiment,
        mut seen: impl FnMut(&mut Self, f64) -> Result<()>,
    ) -> Result<()> {
        let Experiment { start, stop, step, tolerance } = *experiment;
        self.course.begin(&mut self.simulation, start).map_err(stuck)?;
        let started = self.simulation.start_until(start, Some(tolerance), Some(stop));
        started.map_err(|invalid| self.scene.refused(&invalid))?;
        self.grown.extend(self.simulation.growth());
        self.unjudged = self.simulation.unjudged();
        seen(self, start)?;
        let mut from = start;
        for point in 1..=points(experiment) {
            // As a host reckons, which tells the length of a step.
            let next = (start + point as f64 * step).min(stop);
            let outcome = self.course.go(&mut self.simulation, from, from + (next - from));
            let reached = if outcome.is_ok() { next } else { self.simulation.time().unwrap_or(from) };
            if reached > from {
                self.grown.extend(self.simulation.growth().filter(|growth| self.grown.last() != Some(growth)));
                self.unjudged = self.unjudged.or_else(|| self.simulation.unjudged());
                seen(self, reached)?;
            }
            outcome.map_err(|fault| match self.grown.last() {
                Some(growth) => Error::msg(format!("{fault}; {growth}")),
                None => stuck(fault),
            })?;
            from = next;
        }
        Ok(())
    }

    /// What the outputs are now.
    pub fn values(&mut self) -> Result<&[f64]> {
        self.simulation.read()?;
        if !self.simulation.reals_at_hand(&self.references, &mut self.values) {
            for (output, value) in self.outputs.iter().zip(&mut self.values) {
                *value = self.simulation.value(output.place).context("a scene has its own variables")?;
                if !value.is_finite() {
                    let t = self.simulation.time().unwrap_or_default();
                    bail!("{} is infinite or undefined at t = {t:?} s", output.name);
                }
            }
        }
        Ok(&self.values)
    }

    /// The name of its method.
    pub fn method(&self) -> &'static str {
        let number = self.simulation.parameters().setup.solver.method_in_force();
        METHODS.items.iter().find(|item| item.0 == number).map_or("", |item| item.1)
    }
}

fn stuck(fault: Fault) -> Error {
    Error::msg(fault.to_string())
}
