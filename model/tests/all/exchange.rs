//! Model exchange as a host sees it: states, rates and events, integrated by an independent method, against the motion by
//! a method of ours.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use oracles::extrapolation::step;
use split_rotor_model::simulation::{Any, Integrator};
use split_rotor_model::state::GAMMA;
use std::cell::RefCell;
use std::f64::consts::TAU;

/// What is compared, but for φ.
const SHOWN: [&str; 11] = [
    "r_c.x",
    "r_c.y",
    "r_c.z",
    "axis.x",
    "axis.y",
    "axis.z",
    "K_c.x",
    "K_c.z",
    "energy.total",
    "energy.supplied",
    "energy.dissipated",
];

/// A host that integrates by extrapolation in steps of this size, and settles charts as it is asked to.
struct Host {
    named: RefCell<Named>,
    t: f64,
    events: u32,
}

impl Host {
    fn start(name: &str, starts: &[(&str, f64)], inputs: &[f64]) -> Self {
        let mut named = begin(name, starts, inputs, Integrator::Host);
        named.host().settle();
        Self { named: RefCell::new(named), t: 0.0, events: 0 }
    }

    fn advance(&mut self, h: f64) {
        let rates = |t: f64, y: &[f64; Any::STATES]| {
            let mut named = self.named.borrow_mut();
            named.go_to(t, y);
            named.simulation.admits().expect("a possible state");
            named.simulation.rates().expect("possible parameters")
        };
        let state = self.named.borrow_mut().simulation.state().expect("possible parameters");
        let state = step(rates, self.t, &state, h);
        self.t += h;
        let named = self.named.get_mut();
        named.go_to(self.t, &state);
        let phi = named.get("phi");
        let mut exchange = named.host();
        let wants_event = exchange.complete_step();
        assert_eq!(named.get("phi"), phi, "to complete a step changes nothing that is shown");
        if wants_event {
            let mut exchange = named.host();
            assert!(exchange.settle().chart, "an event that was asked for changes the chart");
            assert!(!exchange.settle().any(), "once");
            self.events += 1;
        }
    }

    fn get(&mut self, name: &str) -> f64 {
        self.named.get_mut().get(name)
    }
}

fn begin(name: &str, starts: &[(&str, f64)], inputs: &[f64], integrator: Integrator) -> Named {
    let mut named = Named::new(name, integrator);
    for (name, value) in starts {
        named.set(name, *value);
    }
    named.set("solver.relative_tolerance", 1e-13);
    if let Some((value, derivatives)) = inputs.split_first() {
        let tau = named.place("drive.tau");
        named.simulation.set_input(tau, *value);
        for (order, derivative) in (1..).zip(derivatives) {
            named.simulation.set_input_derivative(tau, order, *derivative);
        }
    }
    named.start();
    named
}

/// A run: scene, start values, torque with its derivatives, end [s], steps, and how often the chart changes on the way.
type Run = (&'static str, &'static [(&'static str, f64)], &'static [f64], f64, u32, u32);

/// The axis of `tumbling` passes −e within 0.93 rad, or within 1e-2 on either side of it: tan(δ/2) = Ja ω_x/(Jt ω_z).
const RUNS: [Run; 6] = [
    ("paper", &[], &[], 2.0, 1000, 0),
    ("free_top", &[], &[], 2.0, 400, 0),
    ("driven", &[], &[2.0, -6.0, 9.0], 2.0, 1000, 0),
    ("tumbling", &[("start.omega.x", 2.5)], &[], 5.0, 500, 18),
    ("tumbling", &[("start.omega.x", 0.025)], &[], 5.0, 500, 16),
    ("tumbling", &[("start.omega.x", -0.025), ("start.phi", -200.0)], &[], 5.0, 500, 16),
];

/// The worst of [`SHOWN`] in its unit, and of φ [rad]: measured 1.4e-11 and 6.6e-12.
const MOTION: f64 = 4e-11;
const PHI: f64 = 2e-11;
/// φ from its turns and what is left [rad]: measured 2.9e-14.
const TURNS: f64 = 1e-13;

#[test]
fn exact_a_host_finds_the_same_motion() {
    for (scene, starts, inputs, end, steps, events) in RUNS {
        let mut host = Host::start(scene, starts, inputs);
        let mut own = begin(scene, starts, inputs, Integrator::Method);
        let h = end / f64::from(steps);
        let (mut worst, mut phi, mut turns) = (0.0, 0.0, 0.0);
        for i in 1..=steps {
            host.advance(h);
            own.simulation.advance(f64::from(i) * h).expect("a possible motion");
            worst = largest(SHOWN.map(|name| (host.get(name) - own.get(name)).abs()).into_iter().chain([worst]));
            phi = largest([phi, (host.get("phi") - own.get("phi")).abs()]);
            turns = largest([turns, (host.get("turns") * TAU + host.get("angle") - host.get("phi")).abs()]);
        }
        within("motion", worst, MOTION);
        within("phi", phi, PHI);
        within("turns", turns, TURNS);
        assert_eq!(host.events, events, "{scene} {starts:?}");
        assert_eq!(host.get("solver.steps"), 0.0, "the host's own are not counted");
    }
}

#[test]
fn regress_the_border_of_a_chart_is_beyond_it() {
    // A host finds the place where an indicator is 0, often to the last bit.
    for z in [2.0, -2.0] {
        let mut named = begin("tumbling", &[], &[], Integrator::Host);
        let mut state = named.simulation.state().expect("started");
        (state[GAMMA.start], state[GAMMA.start + 1]) = (0.0, z);
        named.go_to(0.1, &state);
        assert_eq!(named.simulation.indicators().expect("possible")[0], 0.0);
        assert!(named.host().complete_step(), "an event is asked for");
        assert!(named.host().settle().chart);
        assert!(named.simulation.indicators().expect("possible")[0] > 1.0);
    }
}

#[test]
fn regress_the_cut_of_the_azimuth_counts_no_turn() {
    // In the chart from −e the first γ′ has the azimuth π, or −π: two turns of φ lay between them, and each look counted them.
    for gamma in [[1.7, 0.0], [1.7, -0.0], [-1.7, 0.0], [-1.7, -0.0], [3.0, 0.0]] {
        let starts = [("start.gamma.y", gamma[0]), ("start.gamma.z", gamma[1]), ("start.phi", 0.3)];
        let mut named = begin("tumbling", &starts, &[], Integrator::Host);
        let state = named.simulation.state().expect("started");
        for t in [0.0, 0.0, 1e-9] {
            // Whoever adds 0 to −0 writes +0.
            named.go_to(t, &state.map(|x| x + 0.0));
            within("phi", (named.get("phi") - 0.3).abs(), PHI);
            named.host().complete_step();
            named.host().settle();
            named.go_to(t, &state);
            within("phi", (named.get("phi") - 0.3).abs(), PHI);
        }
    }
}
