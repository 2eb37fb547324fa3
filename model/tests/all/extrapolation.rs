//! Extrapolated inputs: a polynomial of their degree is followed exactly, late or not; what a master says wins; and what is
//! remembered goes with the state.

use crate::harness::named::{Named, ROTOR};
use crate::harness::within;
use split_rotor_model::stored::{from_bytes, to_bytes};
use std::ops::Range;

/// An upright rotor with a shaft, whose speed is the integral of the torque over Ja, and these effects.
fn driven(effects: &str) -> Named {
    Named::started(&format!("{ROTOR}[effects.drive]\n{effects}"))
}

fn rotor(order: u32, lag: f64) -> Named {
    let solver = "[solver]\nmethod = \"dop853\"\nrelative_tolerance = 1e-13\n";
    driven(&format!("[effects.extrapolation]\norder = {order}\nlag = {lag:?}\n{solver}"))
}

/// τ(t) [N·m] and its integral, of a degree.
fn torque(degree: u32, t: f64) -> [f64; 2] {
    let powers = [1.0, t, t * t, t * t * t];
    let coefficients = [2.0, -3.0, 5.0];
    let sum = |from: usize| {
        (0..=degree as usize)
            .map(|n| coefficients[n] * powers[n + from] / if from == 1 { (n + 1) as f64 } else { 1.0 })
            .sum()
    };
    [sum(0), sum(1)]
}

/// Communication points of any distance from one another [s].
const POINTS: [f64; 9] = [0.0, 0.1, 0.25, 0.3, 0.5, 0.7, 0.75, 1.0, 1.1];

/// Gains of speed over steps, relative to the torque's over the step [1]: measured 2.5e-13.
const GAIN: f64 = 1e-12;

/// What is told at a point is the value of so many steps before, between points by interpolation.
#[test]
fn exact_a_polynomial_of_its_degree_is_followed_however_late() {
    for (order, lag) in (0..=2).flat_map(|order| [0.0, 0.25, 1.0, 1.5, 2.0, 3.0].map(|lag| (order, lag))) {
        let mut named = rotor(order, lag);
        let tau = named.place("drive.tau");
        let (whole, part) = (f64::floor(lag) as usize, f64::fract(lag));
        let late = |k: usize| {
            let [to, from] = [whole, whole + 1].map(|n| POINTS[k.saturating_sub(n)]);
            to + part * (from - to)
        };
        for k in 0..POINTS.len() - 1 {
            named.simulation.set_input(tau, torque(order, late(k))[0]);
            let before = named.get("omega_phi");
            named.simulation.advance(POINTS[k + 1]).expect("a possible motion");
            let gained = (named.get("omega_phi") - before) * 0.15625;
            let [from, to] = [k, k + 1].map(|k| torque(order, POINTS[k])[1]);
            // As soon as there are values enough.
            if k as f64 >= f64::from(order) + lag.ceil() {
                within(&format!("order {order}, lag {lag}, step {k}"), (gained - (to - from)).abs(), GAIN);
            }
        }
    }
}

/// A drive in time, a port that is late as all inputs are, and one that is later: each input goes on as the line on which its values lie.
#[test]
fn exact_each_input_is_as_late_as_its_effect_says() {
    let mut named = Named::started(&format!(
        "{ROTOR}[effects.drive]\nlag = 0.0\n[[effects.port]]\nposition = 0.0\n[[effects.port]]\nposition = 0.0\nlag = 2.5\n\
         [effects.extrapolation]\norder = 1\nlag = 1.0\n[solver]\nmethod = \"dop853\"\nrelative_tolerance = 1e-13\n"
    ));
    let inputs: [(_, f64, _, f64); 3] = [
        ("drive.tau", 0.0, "omega_phi", 0.15625),
        ("port[1].f.x", 1.0, "v_c.x", 5.0),
        ("port[2].f.y", 2.5, "v_c.y", 5.0),
    ];
    for k in 0..POINTS.len() - 1 {
        let before = inputs.map(|(name, lag, shown, inertia)| {
            let back = lag.min(k as f64);
            let [to, from] = [back.floor(), back.ceil()].map(|n| POINTS[k - n as usize]);
            let place = named.place(name);
            named.simulation.set_input(place, torque(1, to + back.fract() * (from - to))[0]);
            named.get(shown) * inertia
        });
        named.simulation.advance(POINTS[k + 1]).expect("a possible motion");
        for ((name, lag, shown, inertia), before) in inputs.into_iter().zip(before) {
            let [from, to] = [k, k + 1].map(|k| torque(1, POINTS[k])[1]);
            // As soon as there are values enough.
            if k as f64 >= 1.0 + lag.ceil() {
                within(&format!("{name}, step {k}"), (named.get(shown) * inertia - before - (to - from)).abs(), GAIN);
            }
        }
    }
}

/// The speed that late values of τ = sin 5t lead to in steps that alternate 1 : 10, against the exact one at the end of each
/// step, relative to its largest [1]: measured 7.8e-4.
const ALTERNATING: f64 = 2e-3;

#[test]
fn exact_late_values_belong_to_the_points_that_they_are_of() {
    let mut named = rotor(2, 1.0);
    let tau = named.place("drive.tau");
    let (mut t, mut before, mut worst) = (0.0, 0.0, 0.0_f64);
    for k in 0..200 {
        named.simulation.set_input(tau, libm::sin(5.0 * before));
        before = t;
        t += if k % 2 == 0 { 1e-3 } else { 1e-2 };
        named.simulation.advance(t).expect("a possible motion");
        let exact = (1.0 - libm::cos(5.0 * t)) / (5.0 * 0.15625);
        worst = worst.max((named.get("omega_phi") - exact).abs() * (2.5 * 0.15625));
    }
    within("alternating", worst, ALTERNATING);
}

/// Sets the torque at each of these points and goes on to the next; the bits of the speed there.
fn told(named: &mut Named, points: Range<usize>, torque: impl Fn(f64) -> f64) -> Vec<u64> {
    let tau = named.place("drive.tau");
    let one = |k: usize| {
        named.simulation.set_input(tau, torque(POINTS[k]));
        named.simulation.advance(POINTS[k + 1]).expect("a possible motion");
        named.get("omega_phi").to_bits()
    };
    points.map(one).collect()
}

#[test]
fn derivatives_that_are_sent_win() {
    let mut named = rotor(2, 0.0);
    told(&mut named, 0..5, |t| torque(2, t)[0]);
    let (before, tau) = (named.get("omega_phi"), named.place("drive.tau"));
    named.simulation.set_input(tau, 4.0);
    named.simulation.set_input_derivative(tau, 1, 0.0);
    named.simulation.advance(POINTS[6]).expect("a possible motion");
    let gained = (named.get("omega_phi") - before) * 0.15625;
    within("held", (gained - 4.0 * (POINTS[6] - POINTS[5])).abs(), GAIN);
}

#[test]
fn what_is_remembered_goes_with_the_state() {
    let wavy = |t: f64| torque(2, t)[0] + libm::sin(9.0 * t);
    let [mut one, mut other] = [(); 2].map(|()| rotor(2, 1.0));
    let all = told(&mut one, 0..8, wavy);
    told(&mut other, 0..4, wavy);
    let bytes = to_bytes(&mut *other.simulation);
    told(&mut other, 4..8, wavy);
    let mut restored = rotor(0, 0.0);
    from_bytes(&mut *restored.simulation, &bytes).expect("whole");
    assert_eq!(told(&mut restored, 4..8, wavy), all[4..]);
    // A step that is done again is the same.
    let saved = one.simulation.clone();
    one.simulation.advance(1.3).expect("a possible motion");
    let once = one.get("omega_phi").to_bits();
    one.simulation = saved;
    one.simulation.advance(1.3).expect("a possible motion");
    assert_eq!(one.get("omega_phi").to_bits(), once);
}

#[test]
fn order_zero_is_to_hold() {
    let run = |effects: &str| told(&mut driven(effects), 0..8, |t| torque(2, t)[0]);
    assert_eq!(run(""), run("[effects.extrapolation]\n"));
}
