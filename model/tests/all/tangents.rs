//! Derivatives of what an instant shows, against extrapolated differences: by states and inputs in both charts, and along
//! the motion; and dual numbers over dual numbers.

use crate::harness::asymmetric::Case;
use crate::harness::named::{Named, gentle};
use crate::harness::{Random, largest, within};
use nalgebra::Vector3;
use oracles::numerics::derivative;
use split_rotor_model::dual::{Dual, Tangent};
use split_rotor_model::scalar::Scalar;
use split_rotor_model::simulation::Integrator;
use split_rotor_model::state::{WITH_WORK, Whole};
use split_rotor_model::variable::{Kind, Place, Role};
use split_rotor_model::variables::state_place;
use std::collections::BTreeMap;

/// The Real outputs, states and rates: name and place.
fn calculated(named: &Named) -> Vec<(String, Place)> {
    let is_one = |role| matches!(role, Role::Output | Role::State);
    let found = named.scene.variables.iter().filter(|v| v.meta.kind == Kind::Real && is_one(v.meta.role));
    found.map(|v| (v.name.clone(), v.place)).collect()
}

/// What jumps: whole turns, and what is left of them, which otherwise goes as φ.
fn jumps(name: &str) -> bool {
    ["turns", "angle"].contains(&name)
}

/// A state without symmetry, away from γ = 0, where the chart from −e is singular for what is reported.
fn state(random: &mut Random) -> Whole<f64> {
    let mut state: Whole<f64> = std::array::from_fn(|_| random.within(-2.0, 2.0));
    let (theta, psi) = (random.within(0.5, 2.2), random.within(-3.0, 3.0));
    (state[9], state[10]) = (theta * libm::cos(psi), theta * libm::sin(psi));
    state
}

/// A scene for a host, with inputs and a state that have no symmetry, in the chart 1 or 2.
fn somewhere(name: &str, chart: u8, random: &mut Random) -> (Named, Whole<f64>) {
    let mut named = Named::new(name, Integrator::Host);
    named.set("start.gamma.y", if chart == 1 { 0.5 } else { 2.5 });
    named.start();
    assert_eq!(named.get("state.chart"), f64::from(chart));
    for input in inputs(&named) {
        named.simulation.set_input(input, random.within(-3.0, 3.0));
    }
    (named, state(random))
}

fn inputs(named: &Named) -> Vec<Place> {
    named.inputs().map(|input| input.place).collect()
}

fn move_to(named: &mut Named, state: &Whole<f64>) {
    named.host().set_state(state);
}

/// Exact derivatives by one state or input of all that is calculated.
fn exact(named: &mut Named, by: Place, wanted: &[(String, Place)]) -> Vec<f64> {
    let tangents = named.simulation.tangents([(by, 1.0)].into_iter()).expect("possible parameters");
    wanted.iter().map(|(_, place)| tangents.of(*place).expect("it is calculated")).collect()
}

/// How many derivatives of all variables together are compared.
const MOST: usize = 192;

/// The derivative of all that is calculated, where `move_by` moves something.
fn differences(wanted: usize, mut move_by: impl FnMut(f64) -> Vec<f64>, h: f64) -> Vec<f64> {
    let values = std::cell::RefCell::new(&mut move_by);
    let by = |x: f64| -> [f64; MOST] {
        let mut all = [0.0; MOST];
        all[..wanted].copy_from_slice(&(values.borrow_mut())(x));
        all
    };
    derivative(by, 0.0, h)[..wanted].to_vec()
}

fn values(named: &mut Named, wanted: &[(String, Place)]) -> Vec<f64> {
    wanted.iter().map(|(_, place)| named.at(*place)).collect()
}

/// Derivatives against differences, relative to the largest derivative of the variable, and 1 [1]: measured 2.9e-12.
const DIRECTION: f64 = 1e-11;
/// So many motions in each chart of each scene.
const SAMPLES: u32 = 12;

#[test]
fn exact_derivatives_by_states_and_inputs() {
    let mut worst: BTreeMap<String, f64> = BTreeMap::new();
    for name in gentle() {
        for chart in [1, 2] {
            let mut random = Random(u64::from(chart));
            for _ in 0..SAMPLES {
                let (mut named, state) = somewhere(&name, chart, &mut random);
                let wanted = calculated(&named);
                let by: Vec<Place> = (0..WITH_WORK).map(state_place).chain(inputs(&named)).collect();
                move_to(&mut named, &state);
                let columns: Vec<_> = by.iter().map(|place| exact(&mut named, *place, &wanted)).collect();
                for (n, place) in by.iter().enumerate() {
                    let found = differences(wanted.len(), |x| moved(&mut named, *place, &state, n, x, &wanted), 0.02);
                    for (i, (name, _)) in wanted.iter().enumerate().filter(|(_, (name, _))| !jumps(name)) {
                        let size = columns.iter().map(|column| column[i].abs()).fold(1.0, f64::max);
                        let error = (columns[n][i] - found[i]).abs() / size;
                        let worst = worst.entry(name.clone()).or_default();
                        *worst = largest([*worst, error]);
                    }
                    let of = |name: &str| columns[n][wanted.iter().position(|one| one.0 == name).expect("there")];
                    assert_eq!((of("angle"), of("turns")), (of("phi"), 0.0), "what jumps goes as φ between");
                }
            }
        }
    }
    for (name, worst) in worst {
        within(&name, worst, DIRECTION);
    }
}

/// What is calculated where the state of this number, or the input after them, is moved by x.
fn moved(
    named: &mut Named,
    place: Place,
    state: &Whole<f64>,
    n: usize,
    x: f64,
    wanted: &[(String, Place)],
) -> Vec<f64> {
    let mut there = *state;
    let old = named.at(place);
    match there.get_mut(n) {
        Some(number) => {
            *number += x;
            move_to(named, &there);
        }
        None => assert!(named.simulation.set_input(place, old + x)),
    }
    let values = values(named, wanted);
    match n < WITH_WORK {
        true => move_to(named, state),
        false => assert!(named.simulation.set_input(place, old)),
    }
    values
}

/// A direction against the sum of its parts, relative to the sum of their sizes [1]: measured 4.3e-16.
const LINEAR: f64 = 2e-15;

#[test]
fn exact_a_direction_is_the_sum_of_its_parts() {
    let mut random = Random(7);
    for (name, chart) in gentle().iter().zip([1, 2, 1, 2]) {
        let (mut named, state) = somewhere(name, chart, &mut random);
        move_to(&mut named, &state);
        let wanted = calculated(&named);
        let seeds: Vec<(Place, f64)> = (0..WITH_WORK)
            .map(state_place)
            .chain(inputs(&named))
            .map(|place| (place, random.within(-3.0, 3.0)))
            .collect();
        let together = named.simulation.tangents(seeds.iter().copied()).expect("possible");
        let parts: Vec<_> = seeds.iter().map(|(place, seed)| (exact(&mut named, *place, &wanted), seed)).collect();
        for (i, (name, place)) in wanted.iter().enumerate() {
            let [sum, size] =
                [|x: f64| x, f64::abs].map(|of| parts.iter().map(|(part, seed)| of(part[i] * *seed)).sum::<f64>());
            within(name, (together.of(*place).expect("there") - sum).abs() / f64::max(size, 1.0), LINEAR);
        }
        // Twice the same place counts twice, and a place that is neither state nor input not at all.
        let twice = [(seeds[3].0, 1.0), (seeds[3].0, 1.0), (named.place("rotor.m"), 5.0)];
        let twice = named.simulation.tangents(twice.into_iter()).expect("possible");
        for (i, (_, place)) in wanted.iter().enumerate() {
            assert_eq!(twice.of(*place), Some(2.0 * parts[3].0[i]));
        }
        assert_eq!(twice.of(named.place("rotor.m")), None, "a parameter is not calculated");
    }
}

/// Rates of change along the motion against differences of it, relative to the rate, the value and 1; of energies,
/// which take up the error of the integration, to the kinetic one too [1]: measured 1.1e-9.
const ALONG: f64 = 4e-9;

/// Follows a motion about 0.05 s and notes how far exact rates of change are from differences, for each variable.
fn along(named: &mut Named, worst: &mut BTreeMap<String, f64>) {
    const H: f64 = 0.002;
    let wanted = calculated(named);
    let now = 0.05;
    let mut offsets: Vec<f64> =
        (0..6).flat_map(|level| [1.0, -1.0].map(|sign| sign * H / f64::from(1 << level))).collect();
    offsets.push(0.0);
    offsets.sort_by(f64::total_cmp);
    let (mut shown, mut rates) = (Vec::new(), Vec::new());
    for offset in &offsets {
        named.simulation.advance(now + offset).expect("a possible motion");
        shown.push(values(named, &wanted));
        if *offset == 0.0 {
            let along = named.simulation.time_derivatives().expect("possible parameters");
            rates = wanted.iter().map(|(_, place)| along.of(*place).expect("it is calculated")).collect();
        }
    }
    let at = |x: f64| shown[offsets.iter().position(|offset| *offset == x).expect("a time that was read")].clone();
    let found = differences(wanted.len(), at, H);
    let here = at(0.0);
    let kinetic = here[wanted.iter().position(|one| one.0 == "energy.kinetic").expect("there")];
    for (i, (name, _)) in wanted.iter().enumerate() {
        // In co-simulation state.phi is what is left of φ less its whole turns. A mean over a step has no rate.
        if jumps(name) || name == "state.phi" || name.starts_with("solver.") || name.ends_with("tau_mean") {
            continue;
        }
        let energy = if name.starts_with("energy.") { kinetic } else { 0.0 };
        let size = largest([1.0, here[i].abs(), rates[i].abs(), energy]);
        let worst = worst.entry(name.clone()).or_default();
        *worst = largest([*worst, (rates[i] - found[i]).abs() / size]);
    }
}

#[test]
fn exact_time_derivatives_are_the_rates_of_change() {
    for name in gentle() {
        for tilt in [0.5, 2.5] {
            let mut worst: BTreeMap<String, f64> = BTreeMap::new();
            let mut named = Named::new(&name, Integrator::Method);
            named.set("start.gamma.y", tilt);
            named.set("start.omega.z", 3.0);
            named.set("solver.relative_tolerance", 1e-13);
            named.start();
            for input in inputs(&named) {
                named.simulation.set_input(input, 1.0);
                named.simulation.set_input_derivative(input, 1, -30.0);
                named.simulation.set_input_derivative(input, 2, 80.0);
            }
            along(&mut named, &mut worst);
            for (of, worst) in worst {
                within(&format!("{name} from {tilt} rad: {of}"), worst, ALONG);
            }
        }
    }
}

/// The same where a speed is imposed [1]: measured 1.5e-10, in differences over a shorter time.
const IMPOSED: f64 = 5e-10;

#[test]
fn exact_time_derivatives_follow_an_imposed_speed() {
    for sent in [&[][..], &[("a", 1, 30.0), ("a", 2, -80.0)], &[("w", 1, -10.0), ("w", 2, 60.0)]] {
        let mut worst: BTreeMap<String, f64> = BTreeMap::new();
        let case = Case { omega: Vector3::new(20.0, 0.5, -0.4), ..Case::held() };
        let solver = "method = \"dop853\"\nrelative_tolerance = 1e-13";
        let mut named = Named::started(&format!("{}[effects.imposed_speed]\nw = 20.0\na = -10.0\n", case.text(solver)));
        for (name, order, value) in sent {
            let place = named.place(&format!("imposed_speed.{name}"));
            named.simulation.set_input_derivative(place, *order, *value);
        }
        along(&mut named, &mut worst);
        if sent.is_empty() {
            let rates = named.simulation.time_derivatives().expect("possible parameters");
            let rate = rates.of(named.place("omega_phi")).expect("it is calculated");
            within("omega_phi", (rate + 10.0).abs(), 1e-12);
        }
        for (name, worst) in worst {
            within(&name, worst, IMPOSED);
        }
    }
}

#[test]
fn exact_second_derivatives_of_polynomials() {
    // p = x³y² + 2xy − 7 at (3, −2): every number on the way is whole.
    type Twice = Dual<2, Dual<2>>;
    let variable = |value: f64, n: usize| Twice::variable(Dual::variable(value, n), n);
    let (x, y) = (variable(3.0, 0), variable(-2.0, 1));
    let p = x * x * x * y * y + Twice::constant(2.0) * x * y - Twice::constant(7.0);
    assert_eq!(p.re(), 108.0 - 12.0 - 7.0);
    assert_eq!(p.re.eps, [108.0 - 4.0, -108.0 + 6.0]);
    // ∂²p/∂x², ∂²p/∂x∂y, ∂²p/∂y²
    assert_eq!(p.eps.map(|one| one.eps), [[72.0, -108.0 + 2.0], [-108.0 + 2.0, 54.0]]);
    assert_eq!(p.eps.map(|one| one.re), p.re.eps, "the first derivatives stand twice");
}

#[test]
fn exact_second_derivatives_of_quotients_and_roots() {
    type Twice = Dual<1, Tangent>;
    let four = Twice::variable(Tangent::variable(4.0, 0), 0);
    let quotient = Twice::constant(1.0) / four;
    assert_eq!((quotient.re.re, quotient.eps[0].re, quotient.eps[0].eps), (0.25, -0.0625, [0.03125]));
    let root = Scalar::sqrt(four);
    assert_eq!((root.re.re, root.eps[0].re, root.eps[0].eps), (2.0, 0.25, [-0.03125]));
    // A value that is known better keeps the derivatives.
    let other = (four * four).with_value(17.0);
    assert_eq!((other.re(), other.eps[0].re, other.eps[0].eps), (17.0, 8.0, [2.0]));
    // What moves at a rate moves in every direction.
    let moving = Twice::moving(3.0, 2.0);
    assert_eq!((moving.re.re, moving.re.eps, moving.eps[0].re, moving.eps[0].eps), (3.0, [2.0], 2.0, [0.0]));
}
