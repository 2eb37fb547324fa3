//! The project's own scenes, as their files have them, over the list of all effects.

use nalgebra::Vector3;
use oracles::machine::Machine;
use split_rotor_model::effects::All;
use split_rotor_model::scene::{Scene, SceneError};
use split_rotor_model::simulation::{Any, General, Hosted, Integrator};
use split_rotor_model::variable::{Meta, Place, Role};
use split_rotor_model::variables::Variable;
use std::path::Path;

/// A scene of the folder `scenes`, and its simulation.
pub struct Named {
    /// What its file says.
    pub scene: Scene,
    /// Over the list of all effects.
    pub simulation: General,
}

/// The paper's rotor, as the first lines of a scene.
pub const ROTOR: &str = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.75\n";

/// What is said of a scene that has this text: of each problem its line, what is wrong and what would be right.
pub fn refusal(text: &str) -> String {
    let SceneError { problems, .. } = Scene::parse(Path::new("bad.toml"), text).expect_err("a scene that cannot be");
    let line = |at: usize| format!("line {}: ", text[..at].matches('\n').count() + 1);
    let told = problems.iter().map(|problem| {
        let line = problem.place.as_ref().map_or_else(String::new, |place| line(place.start));
        format!("{line}{}: {}", problem.wrong, problem.right)
    });
    told.collect::<Vec<_>>().join("\n")
}

/// The names of all scenes.
pub fn names() -> Vec<String> {
    Scene::names(&folder())
}

/// The names of the scenes that name an adaptive method. The others are too stiff, too fast or too long for differences, and for
/// most other methods.
pub fn gentle() -> Vec<String> {
    let is_gentle = |name: &String| ![1.0, 4.0].contains(&Named::new(name, Integrator::Method).get("solver.method"));
    names().into_iter().filter(is_gentle).collect()
}

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

/// Names of parameters and inputs and their values as a scene's TOML; the nodes of a table's column follow one another,
/// and what a bearing has besides stands in a comment, for a file has but one of both.
pub fn toml(settings: &[(String, f64)]) -> String {
    let (mut text, mut last) = (String::new(), "");
    for (name, value) in settings {
        let (of, name) = name.split_once('.').expect("a name of an effect or of the rotor");
        if of != last {
            last = of;
            text += &match of.split_once('[') {
                Some((kind, _)) => format!("[[effects.{kind}]]\n"),
                None if ["rotor", "start"].contains(&of) => format!("[{of}]\n"),
                None => format!("[effects.{of}]\n"),
            };
        }
        match name.split_once('[') {
            None => {
                let has_column = settings.iter().any(|(other, _)| *other == format!("{of}.{name}[1]"));
                text += &format!("{}{name} = {value:?}\n", if has_column { "# besides: " } else { "" });
            }
            Some((column, "1]")) => text += &format!("{column} = [{value:?}]\n"),
            Some(_) => {
                text.truncate(text.len() - "]\n".len());
                text += &format!(", {value:?}]\n");
            }
        }
    }
    text
}

/// What is added to a draw of a parameter, so that the speeds of a table ascend.
pub fn ascending(meta: &Meta) -> f64 {
    match meta.node() {
        Some(("speed", node)) => node as f64,
        _ => 0.0,
    }
}

impl Named {
    /// The scene `rotor`, which has all effects, as this machine, not yet started.
    pub fn general(machine: &Machine) -> Self {
        let mut named = Self::new("rotor", Integrator::Method);
        ["gravity", "support"].iter().for_each(|effect| named.set(&format!("effects.{effect}"), 0.0));
        for (name, value) in machine.settings() {
            let effect = name.split('.').next().unwrap_or_default();
            if !["rotor", "start"].contains(&effect) {
                named.set(&format!("effects.{effect}"), 1.0);
            }
            named.set(&name, value);
        }
        named
    }

    /// The scene of this name, not yet started.
    pub fn new(name: &str, integrator: Integrator) -> Self {
        Self::of(Scene::find(name, &folder()).unwrap_or_else(|error| panic!("{error}")), integrator)
    }

    /// The scene of this text, not yet started.
    pub fn written(text: &str) -> Self {
        Self::written_for(text, Integrator::Method)
    }

    /// The scene of this text, started at time 0.
    pub fn started(text: &str) -> Self {
        let mut named = Self::written(text);
        named.start();
        named
    }

    /// The scene of this text, for who integrates it.
    pub fn written_for(text: &str, integrator: Integrator) -> Self {
        let scene = Scene::parse(Path::new("test.toml"), text).unwrap_or_else(|error| panic!("{error}"));
        Self::of(scene, integrator)
    }

    fn of(scene: Scene, integrator: Integrator) -> Self {
        let simulation = General::with(integrator, scene.parameters());
        Self { scene, simulation }
    }

    /// The variable of this name.
    pub fn variable(&self, name: &str) -> &Variable {
        self.scene.variables.iter().find(|variable| variable.name == name).unwrap_or_else(|| panic!("no {name}"))
    }

    /// Its inputs.
    pub fn inputs(&self) -> impl Iterator<Item = &Variable> {
        self.scene.variables.iter().filter(|variable| matches!(variable.meta.role, Role::Input { .. }))
    }

    /// Where the variable of this name stands.
    pub fn place(&self, name: &str) -> Place {
        self.variable(name).place
    }

    /// Sets a parameter or an input.
    pub fn set(&mut self, name: &str, value: f64) {
        let place = self.place(name);
        assert!(
            self.simulation.set_parameter(place, value) || self.simulation.set_input(place, value),
            "{name} cannot be set"
        );
    }

    /// The value of a variable.
    pub fn get(&mut self, name: &str) -> f64 {
        let place = self.place(name);
        self.at(place)
    }

    /// The value of the variable at this place.
    pub fn at(&mut self, place: Place) -> f64 {
        self.simulation.get(place).expect("possible parameters").expect("a variable")
    }

    /// What all variables show, as bits.
    pub fn bits(&mut self) -> Vec<u64> {
        let places: Vec<_> = self.scene.variables.iter().map(|variable| variable.place).collect();
        places.into_iter().map(|place| self.at(place).to_bits()).collect()
    }

    /// The value of a vector that is shown.
    pub fn vector(&mut self, name: &str) -> Vector3<f64> {
        Vector3::from(["x", "y", "z"].map(|axis| self.get(&format!("{name}.{axis}"))))
    }

    /// What a host of model exchange may do.
    pub fn host(&mut self) -> Hosted<'_, All, { Any::STATES }> {
        self.simulation.exchange().expect("for a host")
    }

    /// As a host that integrates: goes to this time and state.
    pub fn go_to(&mut self, t: f64, state: &[f64; Any::STATES]) {
        let mut exchange = self.host();
        exchange.set_time(t);
        exchange.set_state(state);
    }

    /// The rates that a host is told at this time and state.
    pub fn rates_at(&mut self, t: f64, state: &[f64; Any::STATES]) -> [f64; Any::STATES] {
        self.go_to(t, state);
        self.simulation.rates().expect("possible parameters")
    }

    /// Starts at time 0.
    pub fn start(&mut self) {
        self.simulation.start(0.0, None).expect("a possible scene");
    }
}
