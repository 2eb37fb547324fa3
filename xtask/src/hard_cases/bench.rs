//! The FMUs of the gallery, and rotors in them: set by name, stepped, read.

use super::case::Setting;
use super::method::Method;
use crate::fmu::{Fmu, Instance, Reference};
use crate::unpacked::unpack;
use crate::{paths, scenes};
use anyhow::{Context, Result, ensure};
use split_rotor_model::variable::Kind;
use split_rotor_tools::accuracy::motion::Point;
use split_rotor_tools::accuracy::run::{OUTPUTS, point};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The loaded FMU of a scene.
pub struct Stage {
    fmu: Fmu,
    /// Value reference and type of each variable.
    variables: BTreeMap<String, (Reference, Kind)>,
    outputs: [Reference; OUTPUTS.len()],
}

/// The stages, by their scenes.
pub struct Stages(BTreeMap<&'static str, Stage>);

impl Stages {
    /// The FMUs of these scenes, in this folder.
    pub fn load(names: &[&'static str], folder: &Path) -> Result<Self> {
        let stages = names.iter().map(|name| Ok((*name, Stage::load(name, &paths::fmu_in(folder, name))?)));
        Ok(Self(stages.collect::<Result<_>>()?))
    }

    /// That of a scene.
    pub fn of(&self, scene: &str) -> Result<&Stage> {
        self.0.get(scene).with_context(|| format!("no FMU of {scene} was loaded"))
    }
}

impl Stage {
    fn load(name: &str, fmu: &Path) -> Result<Self> {
        let scene = scenes::find(name)?;
        let unpacked = unpack(fmu).with_context(|| format!("cannot open {}", fmu.display()))?;
        // One over the library of every effect has more states than its scene, and a GUID of its own.
        let sheet = fs::read_to_string(&unpacked.sheet)?;
        let guid = sheet.lines().find_map(|line| line.strip_prefix("attribute fmiModelDescription.guid "));
        let fmu = Fmu::load(&unpacked.library, guid.context("the XML has no GUID")?)?;
        let variables: BTreeMap<_, _> =
            (scene.variables.iter()).map(|v| (v.name.clone(), (v.place.value_reference(), v.meta.kind))).collect();
        let outputs = OUTPUTS.map(|name| variables[name].0);
        Ok(Self { fmu, variables, outputs })
    }
}

/// Where a task gets its rotors: an FMU, a method, and what a mutant changes.
pub struct Bench<'s> {
    stage: &'s Stage,
    method: &'s Method,
    mutant: Option<&'s Setting>,
    evaluations: Cell<f64>,
    changed: Cell<bool>,
}

impl<'s> Bench<'s> {
    /// A bench; the mutant multiplies what is set under its name.
    pub fn new(stage: &'s Stage, method: &'s Method, mutant: Option<&'s Setting>) -> Self {
        Self { stage, method, mutant, evaluations: Cell::new(0.0), changed: Cell::new(false) }
    }

    /// A new instance with these parameters, and with the method.
    pub fn rotor(&self, settings: &[Setting]) -> Result<Rotor<'_>> {
        let mut rotor = Rotor { bench: self, instance: self.stage.fmu.instantiate()?, t: 0.0, spent: Cell::new(0.0) };
        rotor.instance.set_integer(self.reference("solver.method")?, self.method.number()?)?;
        for (name, value) in self.method.settings.iter().chain(settings) {
            rotor.set(name, *value)?;
        }
        Ok(rotor)
    }

    /// Evaluations of the right-hand side so far.
    pub fn spent(&self) -> f64 {
        self.evaluations.get()
    }

    /// A number of this name, as the mutant has it.
    pub fn number(&self, name: &str, value: f64) -> f64 {
        let wrong = self.mutant.filter(|mutant| mutant.0 == name).map_or(value, |(_, factor)| value * factor);
        self.changed.set(self.changed.get() || wrong != value);
        wrong
    }

    /// Whether the mutant changed anything.
    pub fn is_changed(&self) -> bool {
        self.changed.get()
    }

    fn reference(&self, name: &str) -> Result<Reference> {
        Ok(self.stage.variables.get(name).with_context(|| format!("the scene has no variable {name}"))?.0)
    }
}

/// An instance on its bench.
pub struct Rotor<'b> {
    bench: &'b Bench<'b>,
    instance: Instance<'b>,
    /// The communication point \[s].
    t: f64,
    /// Evaluations that the bench has heard of.
    spent: Cell<f64>,
}

impl Rotor<'_> {
    /// Sets a parameter or an input.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        let value = self.bench.number(name, value);
        let Some((reference, kind)) = self.bench.stage.variables.get(name) else {
            ensure!(value == 0.0, "the scene has no variable {name}");
            return Ok(());
        };
        match kind {
            Kind::Real => self.instance.set_real(*reference, value),
            Kind::Boolean => self.instance.set_boolean(*reference, value != 0.0),
            _ => self.instance.set_integer(*reference, value as i32),
        }
    }

    /// Starts a run between these times \[s].
    pub fn start(&mut self, t: f64, stop: f64) -> Result<()> {
        self.t = t;
        self.instance.initialize(t, stop)
    }

    /// A communication step of `h` \[s].
    pub fn step(&mut self, h: f64) -> Result<()> {
        self.instance.do_step(self.t, h)?;
        self.t += h;
        Ok(())
    }

    /// A communication step to time `t` \[s].
    pub fn advance(&mut self, t: f64) -> Result<()> {
        self.instance.do_step(self.t, t - self.t)?;
        self.t = t;
        Ok(())
    }

    /// What the communication point shows.
    pub fn shown(&self) -> Result<Point> {
        let (shown, evaluations) = (self.instance.get_real(&self.bench.stage.outputs)?, self.evaluations()?);
        self.bench.evaluations.set(self.bench.evaluations.get() + evaluations - self.spent.replace(evaluations));
        Ok(point(shown))
    }

    /// Reads variables by name.
    pub fn read<const N: usize>(&self, names: &[String; N]) -> Result<[f64; N]> {
        let mut references = [0; N];
        for (reference, name) in references.iter_mut().zip(names) {
            *reference = self.bench.reference(name)?;
        }
        self.instance.get_real(&references)
    }

    /// Evaluations of the right-hand side so far.
    pub fn evaluations(&self) -> Result<f64> {
        Ok(self.read(&["solver.evaluations".to_owned()])?[0])
    }

    /// What was logged and not told yet.
    pub fn journal(&self) -> String {
        self.instance.journal()
    }

    /// The communication point \[s].
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The communication point \[s] as the FMU has it.
    pub fn last_successful_time(&self) -> Result<f64> {
        self.instance.last_successful_time()
    }
}
