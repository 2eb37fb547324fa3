//! A, B, C and D about a steady state: against closed forms, the modes, and differences of the nonlinear simulation.

use crate::harness::named::{Named, ROTOR};
use crate::harness::{largest, within};
use nalgebra::{Complex, ComplexField, Matrix2, Vector3};
use oracles::numerics::derivative;
use split_rotor_model::linear::{Machine, Quantity, StateSpace};
use split_rotor_model::simulation::{Any, Integrator};
use std::cell::RefCell;

/// The linear equations of a scene at a speed [rad/s].
fn space(text: &str, speed: f64) -> StateSpace {
    let machine = Machine::of(Named::written(text).simulation.parameters()).unwrap_or_else(|told| panic!("{told}"));
    machine.state_space(speed, None).unwrap_or_else(|told| panic!("{told}"))
}

fn input(space: &StateSpace, name: &str) -> usize {
    space.inputs.iter().position(|input| input.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn output(space: &StateSpace, name: &str) -> usize {
    space.outputs.iter().position(|output| output.name == name).unwrap_or_else(|| panic!("no {name}"))
}

/// How the output of this name answers the input of that one.
fn response(space: &StateSpace, from: &str, to: &str, frequency: f64) -> Complex<f64> {
    space.response(input(space, from), output(space, to), frequency).expect("eigenvalues").expect("it has a bound")
}

/// Two unlike bearings with the axis leaning in them, a torque about it, and loads at two ports: nothing is symmetric.
const LEANING: &str = "[rotor]\nm = 5.0\nJa = 0.05\nJt = 0.08\n[effects.gravity]\ng = { x = -3.0, z = -9.81 }\n\
    [[effects.bearing]]\nposition = -0.2\nkyy = 2e3\nkzz = 1e3\nkyz = 1e2\nkzy = 3e2\ncyy = 40.0\nczz = 30.0\ncyz = 5.0\nczy = 2.0\n\
    kxx = 1e3\ncxx = 30.0\nkt = 20.0\nct = 0.1\n\
    [[effects.bearing]]\nposition = 0.3\nkyy = 1e3\nkzz = 2e3\ncyy = 30.0\nczz = 40.0\n\
    [effects.rotating_damping]\nd = 3.0\nposition = 0.1\n[effects.drag]\nlinear = 1e-3\nquadratic = 1e-5\n\
    [[effects.port]]\nposition = 0.25\nf = { y = 8.0 }\nm = { x = 0.4, z = 25.0 }\n[[effects.port]]\nposition = -0.1\n\
    [[effects.probe]]\nposition = 0.15\n[[effects.rub]]\nposition = 0.1\ngap = 1.0\nradius = 0.01\nv0 = 0.01\n\
    [[effects.unbalance]]\nmass = 0.1\nradius = 0.02\nposition = 0.2\n";

/// Eigenvalues of A against the modes, over their size [1]: measured 4.9e-15.
const EIGENVALUES: f64 = 2e-14;

#[test]
fn exact_eigenvalues_are_the_modes() {
    let support = format!(
        "{ROTOR}[start]\nr_c = {{ x = 0.75 }}\n[effects.gravity]\ng = {{ z = -9.81 }}\n[effects.support]\nc1 = 2000.0\nc2 = 500.0\n"
    );
    for (text, speed) in [(LEANING, 60.0), (LEANING, -200.0), (&*support, 50.0)] {
        let space = space(text, speed);
        let mut balanced = space.a;
        nalgebra::linalg::balancing::balance_parlett_reinsch(&mut balanced);
        let values = balanced.complex_eigenvalues();
        let modes = space.steady.modes().expect("eigenvalues");
        for mode in &modes {
            let nearest = values.iter().map(|value| (value - mode.eigenvalue).modulus()).fold(f64::INFINITY, f64::min);
            within("eigenvalue", nearest / mode.eigenvalue.modulus(), EIGENVALUES);
        }
        let pairs = modes.iter().filter(|mode| mode.eigenvalue.im > 0.0).count();
        assert_eq!(modes.len() + pairs, 10, "each of them is one of the modes");
    }
}

/// A transfer function against its closed form, over its size at that frequency [1]: measured 7.4e-16.
const TRANSFER: f64 = 3e-15;

#[test]
fn exact_transfer_of_jeffcotts_rotor_in_a_bearing() {
    let (m, [kyy, kyz, kzy, kzz], [cyy, cyz, czy, czz]) = (5.0, [2e5, 3e4, -2e4, 1e5], [200.0, 10.0, -20.0, 300.0]);
    let text = format!(
        "[rotor]\nm = {m}\nJa = 0.05\nJt = 0.08\n[[effects.bearing]]\nposition = 0.0\nkyy = {kyy}\nkyz = {kyz}\nkzy = {kzy}\nkzz = {kzz}\n\
         cyy = {cyy}\ncyz = {cyz}\nczy = {czy}\nczz = {czz}\n[[effects.port]]\nposition = 0.0\n[[effects.probe]]\nposition = 0.0\n"
    );
    let space = space(&text, 300.0);
    for frequency in [1e-3, 10.0, 140.0, 170.0, 200.0, 1e3, 1e5] {
        let through = |k: f64, c: f64| Complex::new(k, c * frequency);
        let inertia = -m * frequency * frequency;
        // (K − mΩ² + iΩC) q = F
        let springs = Matrix2::new(through(kyy, cyy), through(kyz, cyz), through(kzy, czy), through(kzz, czz));
        let compliance =
            (springs + Matrix2::from_diagonal_element(Complex::from(inertia))).try_inverse().expect("damped");
        let passed = -springs * compliance;
        for (column, from) in ["port[1].f.y", "port[1].f.z"].iter().enumerate() {
            for (row, axis) in ["y", "z"].iter().enumerate() {
                let (exact, size) = (compliance[(row, column)], compliance.norm());
                let swing = Complex::new(0.0, frequency);
                let shown = |name: &str| response(&space, from, &format!("{name}.{axis}"), frequency);
                within("place", (shown("probe[1].r") - exact).modulus() / size, TRANSFER);
                within("velocity", (shown("port[1].v") - exact * swing).modulus() / (size * frequency), TRANSFER);
                let force = (shown("bearing[1].F") - passed[(row, column)]).modulus();
                within("force", force / passed.norm(), TRANSFER);
            }
        }
    }
}

#[test]
fn exact_transfer_of_a_rotor_that_tilts() {
    let (ja, jt, c2, d2) = (0.15625, 0.078125, 500.0, 2.0);
    let text = format!(
        "[rotor]\nm = 5.0\nJa = {ja}\nJt = {jt}\nl = 0.0\n[effects.support]\nc1 = 2000.0\nd1 = 30.0\nc2 = {c2}\nd2 = {d2}\n\
         [[effects.port]]\nposition = 0.3\n"
    );
    for speed in [-50.0, 0.0, 400.0] {
        let space = space(&text, speed);
        for frequency in [1e-2, 3.0, 60.0, 200.0, 800.0, 5e3] {
            let swing = Complex::new(0.0, frequency);
            // Jt d²γ/dt² − i Ja ω dγ/dt + d2 dγ/dt + c2 γ = M, with γ = γ_y + iγ_z and M = M_y + iM_z
            let [forward, backward] = [1.0, -1.0].map(|sign| {
                let turning = Complex::new(0.0, -sign * ja * speed) * swing;
                Complex::from(1.0) / (swing * swing * jt + turning + swing * d2 + c2)
            });
            // Of a real M_y: γ_y + iγ_z is its answer at Ω and at −Ω together.
            let (along, across) = ((forward + backward) * 0.5, (forward - backward) * Complex::new(0.0, -0.5));
            let size = along.modulus() + across.modulus();
            for (from, [y, z]) in [("port[1].m.y", [along, across]), ("port[1].m.z", [-across, along])] {
                within("γ_y", (response(&space, from, "gamma.y", frequency) - y).modulus() / size, TRANSFER);
                within("γ_z", (response(&space, from, "gamma.z", frequency) - z).modulus() / size, TRANSFER);
            }
        }
    }
}

/// The same at the frequency of a mode that nothing damps and that is not seen [1]: measured 3.0e-10.
const BESIDE_A_POLE: f64 = 1e-9;

#[test]
fn exact_transfer_of_what_nothing_holds() {
    // Its nutation, at Ja ω/Jt, moves no mass centre.
    let free = space("[rotor]\nm = 5.0\nJa = 0.2\nJt = 0.1\n[[effects.port]]\nposition = 0.2\n", 50.0);
    assert_eq!(free.a.determinant(), 0.0);
    let [push, place, tilt] = [input(&free, "port[1].f.y"), output(&free, "r_c.y"), output(&free, "gamma.z")];
    assert_eq!(free.response(push, place, 0.0), Ok(None));
    assert_eq!(free.response(push, tilt, 100.0), Ok(None));
    for frequency in [1e-3, 1.0, 100.0, 1e3] {
        let got = response(&free, "port[1].f.y", "r_c.y", frequency);
        let bound = if frequency == 100.0 { BESIDE_A_POLE } else { TRANSFER };
        within("a free mass", (got * (-5.0 * frequency * frequency) - 1.0).modulus(), bound);
    }
    // Held across, but not along the axis.
    let across = space(
        "[rotor]\nm = 5.0\nJa = 0.2\nJt = 0.1\n[[effects.bearing]]\nposition = 0.0\nkyy = 2e5\nkzz = 1e5\nkyz = 3e4\nkzy = 1e4\nkt = 10.0\n\
         cyy = 10.0\nczz = 20.0\nct = 0.01\n[[effects.port]]\nposition = 0.0\n",
        50.0,
    );
    let compliance = Matrix2::new(2e5, 3e4, 1e4, 1e5).try_inverse().expect("it is held");
    for (row, to) in ["r_c.y", "r_c.z"].iter().enumerate() {
        let got = response(&across, "port[1].f.y", to, 0.0);
        within("static", (got - compliance[(row, 0)]).modulus() / compliance.norm(), BESIDE_A_POLE);
    }
    assert_eq!(across.response(input(&across, "port[1].f.x"), output(&across, "r_c.x"), 0.0), Ok(None));
}

/// So many outputs and rates are compared.
const MOST: usize = 128;

/// The nonlinear equations and outputs at a place beside the steady state.
struct Beside<'s> {
    space: &'s StateSpace,
    named: RefCell<Named>,
    /// The state in the host's order.
    steady: [f64; Any::STATES],
}

impl<'s> Beside<'s> {
    fn of(text: &str, space: &'s StateSpace, about_axis: f64) -> Self {
        // Balanced, as the linear equations are.
        let mut named = Named::written_for(&text.replace("radius = 0.02", "radius = 0.0"), Integrator::Host);
        named.set("start.omega.x", space.steady.speed);
        named.start();
        let mut steady = named.simulation.state().expect("possible parameters");
        let momentum = space.steady.axis * (about_axis * space.steady.speed);
        let vectors = [space.steady.r, Vector3::zeros(), momentum];
        for (part, vector) in steady.chunks_exact_mut(3).zip(vectors) {
            part.copy_from_slice(vector.as_slice());
        }
        steady[9..11].copy_from_slice(space.steady.gamma.as_slice());
        Self { space, named: RefCell::new(named), steady }
    }

    /// Rates of the states with the spin held, then the outputs, where the state or the input of this number is moved by x.
    fn shown(&self, column: usize, x: f64) -> [f64; MOST] {
        let (space, mut named) = (self.space, self.named.borrow_mut());
        let mut state = self.steady;
        let u = [0, 1].map(|n| space.directions.column(n).into_owned());
        match column {
            0..6 => state[column] += x,
            6..8 => state[column + 3] += x,
            8..10 => (0..3).for_each(|n| state[6 + n] += u[column - 8][n] * x),
            _ => {
                let input = &space.inputs[column - 10];
                named.set(&input.name, input.steady + x);
            }
        }
        named.go_to(0.0, &state);
        let rates = named.simulation.rates().expect("possible parameters");
        let (moment, axis) = (Vector3::from_column_slice(&rates[6..9]), named.vector("axis"));
        // What holds the spin takes the part along the axis.
        let held = moment - axis * moment.dot(&axis);
        let mut all = [0.0; MOST];
        all[..6].copy_from_slice(&rates[..6]);
        all[6..8].copy_from_slice(&rates[9..11]);
        all[8..10].copy_from_slice(&u.map(|u| u.dot(&held)));
        for (shown, output) in all[10..].iter_mut().zip(&space.outputs) {
            *shown = named.get(&output.name);
        }
        if let Some(input) = column.checked_sub(10).map(|n| &space.inputs[n]) {
            named.set(&input.name, input.steady);
        }
        all
    }
}

/// Derivatives against differences, over the largest of their row and 1 [1]: measured 1.9e-11.
const DIFFERENCES: f64 = 1e-10;

#[test]
fn exact_matrices_are_derivatives_of_the_simulation() {
    let speed = 60.0;
    let space = space(LEANING, speed);
    let lean = space.steady.gamma.norm();
    assert!(lean > 0.1 && space.steady.torque.abs() > 0.1, "{lean} rad, {} N·m", space.steady.torque);
    let beside = Beside::of(LEANING, &space, 0.05);
    let (states, inputs, outputs) = (10, space.inputs.len(), space.outputs.len());
    assert!(10 + outputs <= MOST);
    let at_rest = beside.shown(0, 0.0);
    within("rates of the steady state", largest(at_rest[..10].iter().map(|rate| rate.abs())), 1e-13);
    for (output, shown) in space.outputs.iter().zip(&at_rest[10..]) {
        within(&output.name, (output.steady - shown).abs() / (1.0 + shown.abs()), 1e-14);
    }
    let columns: Vec<_> = (0..states + inputs)
        .map(|column| derivative(|x| beside.shown(column, x), 0.0, if column < states { 1e-2 } else { 1.0 }))
        .collect();
    for row in 0..10 + outputs {
        let exact = |column: usize| match (row.checked_sub(10), column.checked_sub(states)) {
            (None, None) => space.a[(row, column)],
            (None, Some(input)) => space.b[(row, input)],
            (Some(output), None) => space.c[(output, column)],
            (Some(output), Some(input)) => space.d[(output, input)],
        };
        let size = (0..columns.len()).map(|column| exact(column).abs()).fold(1.0, f64::max);
        let error = (0..columns.len()).map(|column| (exact(column) - columns[column][row]).abs());
        let name = row.checked_sub(10).map_or("rate of a state", |output| &space.outputs[output].name);
        within(&format!("derivatives of {name}"), largest(error) / size, DIFFERENCES);
    }
}

/// What a constant force shifts against the response at frequency 0, over that and 1 [1]: measured 7.7e-13.
const SHIFT: f64 = 4e-12;

#[test]
fn exact_static_response_is_the_shift_of_the_steady_state() {
    let at = space(LEANING, 60.0);
    for name in ["port[2].f.z", "port[2].m.y"] {
        let shifted = |x: f64| -> [f64; MOST] {
            let named = RefCell::new(Named::written(LEANING));
            named.borrow_mut().set(name, x);
            let machine = Machine::of(named.borrow().simulation.parameters()).expect("a machine");
            let space = machine.state_space(60.0, Some(&at.steady)).expect("it is held");
            std::array::from_fn(|n| space.outputs.get(n).map_or(0.0, |output| output.steady))
        };
        let found = derivative(shifted, 0.0, 1.0);
        for (n, output) in at.outputs.iter().enumerate() {
            let told = at.response(input(&at, name), n, 0.0).expect("eigenvalues").expect("it is held");
            assert_eq!(told.im, 0.0, "{}", output.name);
            within(&format!("shift of {}", output.name), (told.re - found[n]).abs() / (1.0 + told.re.abs()), SHIFT);
        }
    }
}

#[test]
fn drives_and_what_has_no_steady_value_are_left_out() {
    let text = format!("{LEANING}[effects.imposed_speed]\nw = 60.0\n");
    let with_motor = format!("{LEANING}[effects.motor]\nsynchronous_speed = 60.0\nstall_torque = 3.0\n");
    let all = [LEANING, &*text, &*with_motor].map(|text| space(text, 60.0));
    let names = |of: &[Quantity]| of.iter().map(|one| one.name.clone()).collect::<Vec<_>>();
    let inputs: Vec<_> = ["port[1]", "port[2]"]
        .iter()
        .flat_map(|port| ["f.x", "f.y", "f.z", "m.x", "m.y", "m.z"].map(|input| format!("{port}.{input}")))
        .collect();
    for space in &all {
        assert_eq!(names(&space.inputs), inputs);
        assert_eq!(space.inputs[1].steady, 8.0);
        assert_eq!(names(&space.outputs), names(&all[0].outputs));
        assert_eq!(space.a, all[0].a);
    }
    let space = &all[0];
    let states = ["r.x", "r.y", "r.z", "v.x", "v.y", "v.z", "gamma.y", "gamma.z", "K.u1", "K.u2"];
    assert_eq!(names(&space.states), states.map(|name| format!("state.{name}")));
    assert_eq!(space.states[8].unit.name, "kg.m2/s");
    let outputs = names(&space.outputs);
    for there in ["r_c.x", "omega_phi", "axis.z", "K_c.y", "port[2].omega.x", "probe[1].v.z", "drag.tau", "rub[1].F.y"]
    {
        assert!(outputs.iter().any(|name| name == there), "{there}");
    }
    for absent in ["phi", "turns", "angle", "port[1].theta.x", "energy.total", "solver.steps"] {
        assert!(outputs.iter().all(|name| name != absent), "{absent}");
    }
    assert_eq!(outputs[..3], ["r_c.x", "r_c.y", "r_c.z"]);
}
