//! What a host does with a scene, to the reference and to ours alike.

use super::trial::{Partner, Trial};
use crate::harness::named::Named;
use nalgebra::Vector3;
use oracles::machine::{Input, Run, Shown};
use oracles::rigid_body::joint;
use split_rotor_model::simulation::Integrator;
use split_rotor_model::variable::Place;

/// What can be driven from one communication point to the next.
pub trait Rig {
    /// Sets an input: its value and two derivatives.
    fn set(&mut self, input: Input, terms: [f64; 3]);
    /// Moves the communication point to time `t` [s]; why it cannot.
    fn advance(&mut self, t: f64) -> Result<(), String>;
    /// Place [m] and velocity [m/s] of a port.
    fn port(&mut self, port: usize) -> [Vector3<f64>; 2];
    /// The motion that the communication point shows.
    fn show(&mut self) -> Shown;
    /// All else that it shows, in the order of [`Machine::outputs`](oracles::machine::Machine::outputs).
    fn outputs(&mut self, trial: &Trial) -> Vec<Vector3<f64>>;
}

/// What a communication point shows.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The motion.
    pub motion: Shown,
    /// The outputs of [`Rig::outputs`], forces of rings without the friction that follows from the motion: where a shaft sticks to its ring
    /// friction magnifies what a velocity is off, however little that is.
    pub outputs: Vec<Vector3<f64>>,
}

impl Seen {
    fn of(trial: &Trial, rig: &mut impl Rig) -> Self {
        let (motion, mut outputs) = (rig.show(), rig.outputs(trial));
        let machine = &trial.machine;
        let first = machine.outputs(&trial.probes).iter().position(|(name, _)| name.starts_with("rub"));
        let speed = motion.omega.dot(&joint(&motion.axis));
        for (rub, force) in machine.rubs.iter().zip(outputs.iter_mut().skip(first.unwrap_or_default())) {
            let arm = motion.axis * rub.position;
            *force -= rub.friction_force(&[motion.r_c + arm, motion.v_c + motion.omega.cross(&arm)], speed);
        }
        Self { motion, outputs }
    }
}

/// What it shows at the start and at each point; where it stopped, and why.
pub fn play(trial: &Trial, rig: &mut impl Rig) -> Result<Vec<Seen>, String> {
    let (grid, mut shown, mut next) = (trial.grid(), Vec::new(), 0);
    for (n, point) in grid.iter().enumerate() {
        if n > 0 {
            rig.advance(point.t).map_err(|reason| format!("at {:.6e} s: {reason}", grid[n - 1].t))?;
        }
        if point.shown {
            shown.push(Seen::of(trial, rig));
        }
        while let Some(change) = trial.changes.get(next).filter(|change| change.t <= point.t) {
            rig.set(change.input, change.terms);
            next += 1;
        }
        if let (true, Some(Partner { springs, .. })) = (point.exchanged, &trial.partner) {
            for (port, [k, c]) in springs.iter().enumerate() {
                let [r, v] = rig.port(port);
                let force = -(r * *k + v * *c);
                rig.set(Input::Force(port, 1), [force.y, 0.0, 0.0]);
                rig.set(Input::Force(port, 2), [force.z, 0.0, 0.0]);
            }
        }
    }
    Ok(shown)
}

impl Rig for Run {
    fn set(&mut self, input: Input, terms: [f64; 3]) {
        Run::set(self, input, terms);
    }

    fn advance(&mut self, t: f64) -> Result<(), String> {
        if Run::advance(self, t) { Ok(()) } else { Err("the reference does not get on".into()) }
    }

    fn port(&mut self, port: usize) -> [Vector3<f64>; 2] {
        Run::port(self, port)
    }

    fn show(&mut self) -> Shown {
        Run::show(self)
    }

    fn outputs(&mut self, trial: &Trial) -> Vec<Vector3<f64>> {
        Run::outputs(self, &trial.machine, &trial.probes)
    }
}

/// A method of ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The default.
    Auto = 1,
    /// Explicit, order 5.
    Dopri5 = 2,
    /// Explicit, order 8.
    Dop853 = 3,
    /// A composition.
    Symplectic = 4,
    /// Implicit.
    Stiff = 5,
    /// By power series.
    Taylor = 6,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Auto, Self::Dopri5, Self::Dop853, Self::Symplectic, Self::Stiff, Self::Taylor];

    /// Its name.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

/// Ours, over the list of all effects.
pub struct Ours {
    named: Named,
    /// Where inputs and ports stand, as they were first asked for.
    inputs: Vec<(Input, Place)>,
    ports: Vec<[[Place; 3]; 2]>,
    evaluations: Place,
    /// Where outputs stand, as they were first asked for.
    outputs: Vec<[Option<Place>; 3]>,
}

/// Evaluations that a run may take: what needs more is as good as refused.
const MOST: f64 = 2e7;

impl Ours {
    /// The scene with this method and these tolerances, relative and absolute, started; why it cannot.
    pub fn start(trial: &Trial, method: Method, [tolerance, absolute]: [f64; 2]) -> Result<Self, String> {
        let mut named = Named::written_for(&trial.text(), Integrator::Method);
        let of_bearings = trial.machine.settings().into_iter().filter(|(name, _)| name.starts_with("bearing"));
        // A file has no room for what a column has besides.
        of_bearings.for_each(|(name, value)| named.set(&name, value));
        named.set("solver.method", f64::from(method as i32));
        named.set("solver.relative_tolerance", tolerance);
        named.set("solver.absolute_tolerance", absolute);
        // What is right here is that loads are held.
        (1..=trial.machine.ports.len()).for_each(|port| named.set(&format!("port[{port}].learn"), 0.0));
        let stop = trial.knows_end.then(|| trial.end());
        named.simulation.start_until(0.0, None, stop).map_err(|invalid| invalid.to_string())?;
        let axes =
            |port: usize, of: &str| ["x", "y", "z"].map(|axis| named.place(&format!("port[{}].{of}.{axis}", port + 1)));
        let ports = (0..trial.machine.ports.len()).map(|port| [axes(port, "r"), axes(port, "v")]).collect();
        let evaluations = named.place("solver.evaluations");
        Ok(Self { named, inputs: Vec::new(), ports, evaluations, outputs: Vec::new() })
    }

    /// Evaluations so far.
    pub fn evaluations(&mut self) -> f64 {
        self.named.at(self.evaluations)
    }

    /// What the ledger of the energy leaves over, over the kinetic energy, the work that went through and 1 J, with which work counts in
    /// the tolerance [1].
    pub fn residual(&mut self) -> f64 {
        let mut energy = |of: &str| self.named.get(&format!("energy.{of}")).abs();
        energy("residual") / (1.0 + energy("kinetic") + energy("supplied") + energy("dissipated"))
    }

    /// What `auto` does by now.
    pub fn auto(&self) -> Option<String> {
        let said = self.named.simulation.auto()?;
        let named = |name: &&str| {
            said.starts_with(&format!("auto takes {name}")) || said.starts_with(&format!("auto goes on with {name}"))
        };
        let method = ["symplectic", "stiff", "dop853", "taylor"].into_iter().find(named)?;
        Some(format!("{method}, {} changes", self.named.simulation.changes_of_method()))
    }

    fn place(&mut self, input: Input) -> Place {
        let known = self.inputs.iter().find(|(known, _)| *known == input).map(|(_, place)| *place);
        known.unwrap_or_else(|| {
            let place = self.named.place(&input.name());
            self.inputs.push((input, place));
            place
        })
    }
}

impl Rig for Ours {
    fn set(&mut self, input: Input, [value, slope, curvature]: [f64; 3]) {
        let place = self.place(input);
        assert!(self.named.simulation.set_input(place, value), "an input");
        for (order, derivative) in [(1, slope), (2, curvature)] {
            if derivative != 0.0 {
                assert!(self.named.simulation.set_input_derivative(place, order, derivative), "an input");
            }
        }
    }

    fn advance(&mut self, t: f64) -> Result<(), String> {
        self.named.simulation.advance(t).map_err(|fault| fault.to_string())?;
        let spent = self.evaluations();
        if spent > MOST { Err(format!("{spent:e} evaluations")) } else { Ok(()) }
    }

    fn port(&mut self, port: usize) -> [Vector3<f64>; 2] {
        self.ports[port].map(|places| Vector3::from(places.map(|place| self.named.at(place))))
    }

    fn show(&mut self) -> Shown {
        let motion = &self.named.simulation.read().expect("possible parameters").motion;
        Shown { r_c: motion.r_c(), v_c: motion.v_c(), axis: *motion.axis(), omega: motion.omega, phi: motion.phi() }
    }

    fn outputs(&mut self, trial: &Trial) -> Vec<Vector3<f64>> {
        if self.outputs.is_empty() {
            let find = |name: &str| self.named.scene.variables.iter().find(|one| one.name == name).map(|one| one.place);
            let places = |name: &str| match find(name) {
                Some(place) => [Some(place), None, None],
                None => ["x", "y", "z"].map(|axis| {
                    let is_shown = (name, axis) != ("v_c", "x");
                    is_shown.then(|| find(&format!("{name}.{axis}"))).flatten()
                }),
            };
            self.outputs = trial.machine.outputs(&trial.probes).iter().map(|(name, _)| places(name)).collect();
        }
        let outputs = std::mem::take(&mut self.outputs);
        let mut read = |place: Option<Place>| place.map_or(0.0, |place| self.named.at(place));
        let shown = outputs.iter().map(|places| Vector3::from(places.map(&mut read))).collect();
        self.outputs = outputs;
        shown
    }
}
