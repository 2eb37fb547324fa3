//! A scene run over the list of all effects, which gives the bits of the scene's FMU.

use crate::course::{Course, Driven};
use crate::scenes;
use anyhow::{Context, Error, Result, bail, ensure};
use split_rotor_model::effects::{Doubt, Effects};
use split_rotor_model::integrate::Fault;
use split_rotor_model::scene::{Experiment, Scene};
use split_rotor_model::simulation::{Deflection, General, Growth, Largest, Unheld, Unjudged};
use split_rotor_model::variable::{Place, Role};
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

/// The stations whose largest deflections count, by name, with their positions along t from c \[m]: c, and the probes that are on.
fn stations(scene: &Scene) -> Vec<(String, f64)> {
    let value = scenes::values(scene);
    let probes = (1..).map_while(|n| {
        let name = format!("probe[{n}]");
        value(&format!("{name}.position")).map(|position| (name, position))
    });
    // In a general scene an effect may be off.
    let is_on = |(name, _): &(String, f64)| value(&format!("effects.{name}")) != Some(0.0);
    [("r_c".to_owned(), 0.0)].into_iter().chain(probes.filter(is_on)).collect()
}

/// A run.
pub struct Run<'s> {
    /// What moves.
    pub simulation: General,
    /// The names of the stations, and what was seen of them.
    stations: Vec<String>,
    largest: Option<Largest>,
    outputs: Vec<&'s Variable>,
    references: Vec<u32>,
    values: Vec<f64>,
    course: Course<'s>,
    scene: &'s Scene,
    grown: Vec<Growth>,
    unheld: Option<Unheld>,
    /// Up to which ω_φ doubts were told [rad/s], and they.
    doubted: Option<[f64; 2]>,
    doubts: Vec<(String, Doubt)>,
    unjudged: Option<Unjudged>,
}

impl<'s> Run<'s> {
    /// Of a scene with its own inputs, of which these outputs are read.
    pub fn of(scene: &'s Scene, outputs: Vec<&'s Variable>) -> Self {
        let references = outputs.iter().map(|output| output.place.value_reference()).collect();
        let (simulation, values) = (General::from(scene.parameters()), vec![0.0; outputs.len()]);
        let (stations, largest) = (Vec::new(), Some(Largest::default()));
        let (course, grown) = (Course::of(scene), Vec::new());
        let (unheld, unjudged, doubted, doubts) = (None, None, None, Vec::new());
        Self {
            simulation,
            stations,
            largest,
            outputs,
            references,
            values,
            course,
            scene,
            grown,
            unheld,
            unjudged,
            doubted,
            doubts,
        }
    }

    /// The same, which also searches for the largest deflections of c and of the probes: that takes some time.
    pub fn with_deflections(self) -> Self {
        let (stations, positions): (Vec<_>, Vec<_>) = stations(self.scene).into_iter().unzip();
        Self { stations, largest: Some(Largest::at(positions)), ..self }
    }

    /// The largest deflections of c (`r_c`) and of the probes from the x axis, static deflections included: between the communication
    /// points too, since the solver's dense output is searched. None unless the run is one [`Run::with_deflections`].
    pub fn largest(&self) -> impl Iterator<Item = (&str, Deflection)> {
        let found = self.largest.iter().flat_map(Largest::found);
        self.stations.iter().map(String::as_str).zip(found)
    }

    /// In which directions nothing holds the rotor, once the run has begun.
    pub fn unheld(&self) -> Option<&Unheld> {
        self.unheld.as_ref()
    }

    /// What began to grow on the way.
    pub fn grown(&self) -> &[Growth] {
        &self.grown
    }

    /// What is doubtful of the laws at the speeds that were met, each with the name of its effect, as it was when it was seen first.
    pub fn doubts(&self) -> &[(String, Doubt)] {
        &self.doubts
    }

    fn look_for_doubts(&mut self) {
        let Some(speeds) = self.simulation.speeds_met() else { return };
        let before = self.doubted.replace(speeds);
        let new = &mut self.doubts;
        let effects = &self.simulation.parameters().effects;
        effects.doubts(speeds, before, &mut |block, doubt| new.push((block.to_owned(), doubt)));
    }

    /// Where it first was not found whether anything grows.
    pub fn unjudged(&self) -> Option<Unjudged> {
        self.unjudged
    }

    /// The outputs that are read.
    pub fn outputs(&self) -> &[&'s Variable] {
        &self.outputs
    }

    /// Runs; at each communication point \[s] it is `seen`, that where the motion ends early too. A motion that diverges is an error.
    pub fn follow(&mut self, experiment: &Experiment, seen: impl FnMut(&mut Self, f64) -> Result<()>) -> Result<()> {
        let outcome = self.follow_to_end(experiment, seen);
        if let Some(largest) = &mut self.largest {
            self.simulation.look(largest);
        }
        outcome
    }

    /// Starts, and goes nowhere. A start that is refused is an error.
    pub fn begin(&mut self, experiment: &Experiment) -> Result<()> {
        let Experiment { start, stop, tolerance, .. } = *experiment;
        let Self { course, simulation, largest, .. } = self;
        course.begin(&mut Motion { simulation, largest }, start).map_err(stuck)?;
        let started = self.simulation.start_until(start, Some(tolerance), Some(stop));
        started.map_err(|invalid| self.scene.refused(&invalid))?;
        self.grown.extend(self.simulation.growth());
        self.unheld = self.simulation.unheld();
        self.look_for_doubts();
        self.unjudged = self.simulation.unjudged();
        Ok(())
    }

    fn follow_to_end(
        &mut self,
        experiment: &Experiment,
        mut seen: impl FnMut(&mut Self, f64) -> Result<()>,
    ) -> Result<()> {
        self.begin(experiment)?;
        let Experiment { start, stop, step, .. } = *experiment;
        seen(self, start)?;
        let mut from = start;
        for point in 1..=points(experiment) {
            // As a host reckons, which tells the length of a step.
            let next = (start + point as f64 * step).min(stop);
            let Self { course, simulation, largest, .. } = self;
            let outcome = course.go(&mut Motion { simulation, largest }, from, from + (next - from));
            let reached = if outcome.is_ok() { next } else { self.simulation.time().unwrap_or(from) };
            if reached > from {
                self.grown.extend(self.simulation.growth().filter(|growth| self.grown.last() != Some(growth)));
                self.look_for_doubts();
                self.unjudged = self.unjudged.or_else(|| self.simulation.unjudged());
                seen(self, reached)?;
            }
            if let Some(divergence) = self.simulation.divergence() {
                bail!("{divergence}; the run ends there");
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

/// A rotor that inputs drive, and its largest deflections.
struct Motion<'r> {
    simulation: &'r mut General,
    largest: &'r mut Option<Largest>,
}

impl Driven for Motion<'_> {
    type Error = Fault;

    fn go(&mut self, _: f64, to: f64) -> Result<(), Fault> {
        self.simulation.advance_looking(to, self.largest)
    }

    fn steer(&mut self, input: Place, [value, rate]: [f64; 2]) -> Result<(), Fault> {
        if let Some(largest) = self.largest {
            self.simulation.look(largest);
        }
        self.simulation.set_input(input, value);
        self.simulation.set_input_derivative(input, 1, rate);
        Ok(())
    }
}

fn stuck(fault: Fault) -> Error {
    Error::msg(fault.to_string())
}

#[cfg(test)]
mod tests;
