//! What is counted and timed: the rotor of the compiled-in scene some way along its motion, each method there, and the FMU.

#![allow(dead_code, reason = "each bench uses a part")]

#[path = "../../tests/harness/mod.rs"]
mod harness;

use harness::Instance;
use split_rotor::abi::Status;
use split_rotor::scene::{self, Effects, Simulation};
use split_rotor_model::integrate::explicit::Explicit;
use split_rotor_model::integrate::sizes::MOST_GROUPS;
use split_rotor_model::integrate::tableau::Tableau;
use split_rotor_model::integrate::taylor::{Scratch, Taylor};
use split_rotor_model::integrate::{Refusal, System, Tolerance};
use split_rotor_model::rotor::Rotor;
use split_rotor_model::simulation::Integrator;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::Parameters;

/// Hands `name tableau,` of each method to a macro: the one list of them.
macro_rules! methods {
    ($take:ident) => {
        $take! {
            dopri5 &split_rotor_model::integrate::tableau::DOPRI5,
            dop853 &split_rotor_model::integrate::tableau::DOP853,
        }
    };
}

/// The rotor has moved this far before anything is measured \[s].
const MOVED: f64 = 0.5;

/// A communication step that makes the solver work \[s].
pub const LONG: f64 = 0.1;

/// What rests counts with, squared.
const LEAST: f64 = 1e-12;

/// The tolerance of the steps \[1].
const TOLERANCE: f64 = 1e-10;

/// A system of N equations at a time \[s] and a state, to be stepped within a tolerance.
#[derive(Clone)]
pub struct At<S, const N: usize> {
    pub system: S,
    pub t: f64,
    pub y: [f64; N],
    tolerance: Tolerance,
}

/// The rotor under way: with 12 equations without the work integrals, with 14 with them.
pub fn rotor<const N: usize>() -> At<Rotor<'static, Effects>, N> {
    let values = scene::values();
    let parameters: Parameters<Effects> =
        values.starts().map(|(reference, value)| (Place::of(reference), value)).collect();
    let mut simulation = Simulation::with(Integrator::Method, parameters.clone());
    simulation.start(0.0, None).expect("a possible scene");
    simulation.advance(MOVED).expect("a possible motion");
    let state = simulation.state().expect("possible parameters");
    let chart = simulation.read().expect("possible parameters").motion.tilt.chart();
    At {
        // The rotor borrows its effects for as long as the bench runs.
        system: Rotor::new(parameters.shape().inertia(), Box::leak(Box::new(parameters.effects)), chart, 0.0),
        t: MOVED,
        y: std::array::from_fn(|n| state[n]),
        tolerance: Tolerance { relative: TOLERANCE, nominal: [LEAST; MOST_GROUPS], ..Tolerance::default() },
    }
}

impl<S: System<N>, const N: usize> At<S, N> {
    /// f(t, y), as the methods call it.
    pub fn rates(&self) -> [f64; N] {
        self.system.rates_of_all(self.t, &self.y)
    }

    /// A method before a step that is accepted at once.
    pub fn before_a_step(self, tableau: &'static Tableau) -> Stepping<S, N> {
        let mut method = Explicit::start(tableau, self.tolerance, &self.system, self.t, self.y);
        loop {
            let before = method;
            method.step(&self.system, f64::INFINITY, f64::INFINITY).expect("a possible motion");
            // The first steps find their size.
            if before.cost().steps > 10.0 && method.cost().rejected == before.cost().rejected {
                return Stepping { method: before, system: self.system };
            }
        }
    }
}

/// A method at work.
pub struct Stepping<S, const N: usize> {
    method: Explicit<N>,
    system: S,
}

impl<S: System<N>, const N: usize> Stepping<S, N> {
    /// One step of the method's own choice.
    pub fn step(&mut self) {
        self.method.step(&self.system, f64::INFINITY, f64::INFINITY).expect("a possible motion");
    }

    /// What the last step's dense output needs.
    pub fn prepare_dense(&mut self) {
        self.method.prepare_dense(&self.system);
    }

    /// One step of this size \[s]: no error is estimated.
    pub fn fixed_step(&mut self, h: f64) {
        self.method.fixed_step(&self.system, h);
    }
}

/// The rotor under way, by power series.
pub struct Expanding {
    method: Taylor<12>,
    scratch: Scratch,
    system: Rotor<'static, Effects>,
}

impl Expanding {
    /// At this relative tolerance, once the size of the steps is found.
    pub fn at(relative: f64) -> Self {
        let At { system, t, y, tolerance } = rotor::<12>();
        let method = Taylor::start(Tolerance { relative, ..tolerance }, &system, t, y);
        let mut expanding = Self { method, scratch: Scratch::default(), system };
        (0..10).for_each(|_| expanding.step());
        expanding
    }

    /// One step of the method's own choice.
    pub fn step(&mut self) {
        let stepped = self.method.step(&self.system, &mut self.scratch, f64::INFINITY, f64::INFINITY);
        assert_eq!(stepped, Ok(true), "a motion with a series");
    }
}

/// dy/dt = y: rates that cost no more than to be handed over, so that what is left of a step is the method's own.
pub struct Copied;

impl<const N: usize> System<N> for Copied {
    #[inline(always)]
    fn rates<const ALL: bool, const USUAL: bool>(&self, _t: f64, y: &[f64; N]) -> [f64; N] {
        *y
    }

    fn admits(&self, _t: f64, _y: &[f64; N]) -> Result<(), Refusal> {
        Ok(())
    }
}

/// The same with a system that is free of cost.
pub fn copied() -> At<Copied, 12> {
    let At { t, y, tolerance, .. } = rotor::<12>();
    At { system: Copied, t, y, tolerance }
}

/// An instance of the FMU, and the communication step to come \[s].
pub struct Hosted {
    instance: Instance,
    t: f64,
    h: f64,
}

impl Hosted {
    /// Near the start of one of the solver's own steps, of which the communication step is a small part.
    pub fn within_a_step() -> Self {
        let mut instance = Instance::quiet().started(&[]);
        assert_eq!(instance.do_step(0.0, MOVED), Status::Ok);
        let (h, steps) = (instance.get("solver.next_step") / 64.0, instance.get("solver.steps"));
        let mut t = MOVED;
        while instance.get("solver.steps") == steps {
            assert_eq!(instance.do_step(t, h), Status::Ok);
            t += h;
        }
        Self { instance, t, h }
    }

    /// Before a communication step over many of the solver's.
    pub fn before_many_steps() -> Self {
        Self { h: LONG, ..Self::within_a_step() }
    }

    /// fmi2DoStep.
    pub fn do_step(&mut self) -> Status {
        let status = self.instance.do_step(self.t, self.h);
        self.t += self.h;
        status
    }
}
