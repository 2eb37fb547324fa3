//! Steps that are done again once it is known what inputs were in them: polynomials of one degree more are followed exactly, springs and
//! bearings at ports are followed one order better, and the energy that is left over is reported.

use crate::harness::named::{Named, ROTOR, refusal};
use crate::harness::within;
use crate::partners::{Pair, SPAN, apart, way_of_turbo};
use split_rotor_model::stored::{from_bytes, to_bytes};
use std::f64::consts::PI;

/// Communication points of any distance from one another [s].
const POINTS: [f64; 10] = [0.0, 0.1, 0.25, 0.3, 0.5, 0.7, 0.75, 1.0, 1.1, 1.3];

/// Lines of a scene whose inputs go on by this order, are so many steps late, and are redone or not.
fn extrapolation(order: u32, lag: f64, redo: bool) -> String {
    format!("[effects.extrapolation]\norder = {order}\nlag = {lag:?}\nredo = {redo}\n")
}

/// A torque of this degree [N·m], and its integral from 0.
fn torque(degree: usize, t: f64) -> [f64; 2] {
    let powers = [1.0, t, t * t, t * t * t, t * t * t * t];
    let terms = || [2.0, -3.0, 5.0, -4.0].into_iter().zip(1..).take(degree + 1);
    let value = terms().map(|(coefficient, n)| coefficient * powers[n - 1]).sum();
    [value, terms().map(|(coefficient, n)| coefficient * powers[n] / n as f64).sum()]
}

/// The integral from `from` to `to` of the polynomial of this degree through the first of these points and values, by Lagrange's formula.
fn through(points: &[[f64; 2]], degree: usize, [from, to]: [f64; 2]) -> f64 {
    let at = |t: f64| {
        let one = |n: usize| {
            let others = (0..=degree).filter(|m| *m != n);
            points[n][1] * others.map(|m| (t - points[m][0]) / (points[n][0] - points[m][0])).product::<f64>()
        };
        (0..=degree).map(one).sum::<f64>()
    };
    // Simpson's rule is exact for a cubic.
    (to - from) / 6.0 * (at(from) + 4.0 * at(0.5 * (from + to)) + at(to))
}

/// Speeds against those of the torque, [N·m·s]: measured 3.8e-15.
const SPEED: f64 = 2e-14;

/// Up to where the torque is known its polynomial is followed, from there on the one that extrapolation makes of it.
#[test]
fn exact_a_polynomial_of_one_degree_more_is_followed_as_far_as_it_is_known() {
    for (order, lag) in (0..=2).flat_map(|order| [0, 1, 2, 3].map(|lag| (order, lag))) {
        for method in ["dop853", "stiff", "taylor", "auto"] {
            let lines = extrapolation(order, f64::from(lag), true);
            let solver = format!("[solver]\nmethod = \"{method}\"\nrelative_tolerance = 1e-13\n");
            let mut named = Named::started(&format!("{ROTOR}[effects.drive]\n{lines}{solver}"));
            let (tau, order, lag) = (named.place("drive.tau"), order as usize, lag as usize);
            let torque = |t: f64| torque(order + 1, t);
            let mut known = 0.0;
            for k in 0..POINTS.len() - 1 {
                let latest = k.saturating_sub(lag);
                let points: Vec<_> = (0..=latest).rev().map(|n| [POINTS[n], torque(POINTS[n])[0]]).collect();
                named.simulation.set_input(tau, points[0][1]);
                named.simulation.advance(POINTS[k + 1]).expect("a possible motion");
                if latest > 0 && k >= lag {
                    known += through(&points, (order + 1).min(latest), [POINTS[latest - 1], POINTS[latest]]);
                }
                // As soon as there are values enough.
                if latest >= order {
                    let ahead = through(&points, order, [POINTS[latest], POINTS[k + 1]]);
                    let off = named.get("omega_phi") * 0.15625 - known - ahead;
                    within(&format!("{method}, order {order}, lag {lag}, step {k}"), off.abs(), SPEED);
                }
            }
        }
    }
}

/// A master that sends derivatives of a cubic: it is followed as it says, whatever the order.
#[test]
fn exact_derivatives_that_are_sent_win() {
    for (order, lag) in (0..3).flat_map(|order| [0.0, 1.0].map(|lag| (order, lag))) {
        let solver = "[solver]\nmethod = \"dop853\"\nrelative_tolerance = 1e-13\n";
        let mut named = Named::started(&format!("{ROTOR}[effects.drive]\n{}{solver}", extrapolation(order, lag, true)));
        let tau = named.place("drive.tau");
        for k in 0..POINTS.len() - 1 {
            let (t, to) = (POINTS[k], POINTS[k + 1]);
            named.simulation.set_input(tau, torque(3, t)[0]);
            for (n, value) in (1..).zip([-3.0 + 10.0 * t - 12.0 * t * t, 10.0 - 24.0 * t, -24.0]) {
                named.simulation.set_input_derivative(tau, n, value);
            }
            named.simulation.advance(to).expect("a possible motion");
            let off = named.get("omega_phi") * 0.15625 - torque(3, to)[1];
            within(&format!("order {order}, lag {lag}, step {k}"), off.abs(), SPEED);
        }
    }
}

/// The torque is in time, or less late than a port: up to where both are known, its parabola is followed at order 1.
#[test]
fn exact_inputs_may_be_late_by_different_numbers_of_steps() {
    for [lag, later] in [[0, 1], [0, 2], [1, 3], [0, 3]] {
        let port = format!("[[effects.port]]\nposition = 0.0\nlag = {later}.0\n[effects.drive]\nlag = {lag}.0\n");
        let solver = "[solver]\nmethod = \"dop853\"\nrelative_tolerance = 1e-13\n";
        let mut named = Named::started(&format!("{ROTOR}{port}{}{solver}", extrapolation(1, 0.0, true)));
        let tau = named.place("drive.tau");
        let mut before: Option<f64> = None;
        for k in later..POINTS.len() - 1 {
            for point in if k == later { 0..k + 1 } else { k..k + 1 } {
                named.simulation.set_input(tau, torque(2, POINTS[point.saturating_sub(lag)])[0]);
                named.simulation.advance(POINTS[point + 1]).expect("a possible motion");
            }
            let points: Vec<_> = (0..=k - lag).rev().map(|n| [POINTS[n], torque(2, POINTS[n])[0]]).collect();
            let known = named.get("omega_phi") * 0.15625 - through(&points, 1, [POINTS[k - later], POINTS[k + 1]]);
            if let (Some(before), true) = (before, k > later + 2) {
                let [from, to] = [k - later - 1, k - later].map(|n| torque(2, POINTS[n])[1]);
                within(&format!("lags {lag} and {later}, step {k}"), (known - before - (to - from)).abs(), SPEED);
            }
            before = Some(known);
        }
    }
}

/// 10 kg on a spring of 1e7 N/m, undamped, with so many steps in a period: place over the first one and velocity over the largest, after so
/// many periods, and what the port reports of energy, over that of the spring.
fn undamped(lines: &str, steps: usize, late: bool, periods: usize) -> [f64; 3] {
    let rotor =
        "[rotor]\nm = 10.0\nJa = 0.04\nJt = 0.12\n[start]\nr_c = { y = 1e-5 }\n[solver]\nrelative_tolerance = 1e-11\n";
    let mut named = Named::started(&format!("{rotor}[[effects.port]]\nposition = 0.0\nlearn = false\n{lines}"));
    let (force, h) = (named.place("port[1].f.y"), 2e-3 * PI / steps as f64);
    let mut before = 1e-5;
    for step in 1..=steps * periods {
        let now = named.get("port[1].r.y");
        let answered = if late { before } else { now };
        before = now;
        named.simulation.set_input(force, -1e7 * answered);
        named.simulation.advance(step as f64 * h).expect("a possible motion");
    }
    let error = named.get("port[1].energy_error") / (0.5e7 * 1e-10);
    [named.get("port[1].r.y") / 1e-5, named.get("port[1].v.y") / 1e-2, error]
}

/// State errors after 5 periods of 80 steps by the orders 0, 1, 2, fresh and late [1]: measured 8.3e-3, 3.1e-4, 2.4e-5 and 1.3e-2, 3.2e-4,
/// 6.5e-5; without doing steps again 0.85, 4.0e-2, 2.9e-3 and 5.3, 0.19, 1.7e-2.
const AFTER_PERIODS: [[f64; 3]; 2] = [[1e-2, 5e-4, 4e-5], [2e-2, 5e-4, 1e-4]];

#[test]
fn exact_an_undamped_spring_is_followed() {
    for (late, allowed) in [false, true].into_iter().zip(AFTER_PERIODS) {
        for (order, allowed) in (0..3).zip(allowed) {
            let [redone, once] = [true, false].map(|redo| {
                let lines = extrapolation(order, f64::from(u8::from(late)), redo);
                let [r, v, _] = undamped(&lines, 80, late, 5);
                libm::hypot(r - 1.0, v)
            });
            within(&format!("order {order}, late {late}"), redone, allowed);
            assert!(redone < 0.02 * once, "{redone} against {once}");
        }
    }
}

/// What `energy_error` reports over what the motion gains in 10 periods of 40 steps by the orders 0, 1, 2, fresh and late [1]: measured 1.01,
/// 1.02, 1.10 and 1.01, 0.69, 1.05; where it is 0.69, it gains 0.7 %.
const REPORTED: [f64; 2] = [0.65, 1.2];

#[test]
fn exact_the_energy_error_is_what_an_undamped_spring_gains() {
    for late in [false, true] {
        for order in 0..3 {
            let [r, v, told] = undamped(&extrapolation(order, f64::from(u8::from(late)), true), 40, late, 10);
            let part = told / (r * r + v * v - 1.0);
            assert!((REPORTED[0]..REPORTED[1]).contains(&part), "order {order}, late {late}: {part}");
        }
    }
}

/// The README's rotor on its bearings as partners in 800 steps, over all of the run, by the orders 1 and 2, fresh and late [1]: measured
/// 3.1e-4, 2.5e-5 and 1.8e-3, 1.9e-4; without doing steps again 1.2e-2, 1.1e-3 and 5.6e-2, 6.4e-3.
const TURBO: [[f64; 2]; 2] = [[5e-4, 4e-5], [3e-3, 3e-4]];

/// From a cold start errors fall with the step as its power of one more than the order, and without doing steps again of the order. Runs that
/// are right to 1 % are not warned of, and those that grow are.
#[test]
fn ordinary_bearings_are_followed_from_a_cold_start() {
    for (late, allowed) in [false, true].into_iter().zip(TURBO) {
        let run = |order: u32, steps: u32, redo: bool| {
            let (h, lag) = (SPAN / f64::from(steps), f64::from(u8::from(late)));
            let (way, found) = Pair::linear().watched(["", &extrapolation(order, lag, redo)], h, late, SPAN);
            (apart(&way, &way_of_turbo(h))[0], found)
        };
        for (order, allowed) in (1..3).zip(allowed) {
            let [(coarse, _), (fine, found)] = [400, 800].map(|steps| run(order, steps, true));
            within(&format!("order {order}, late {late}"), fine, allowed);
            assert_eq!(found, None, "right to 1 %");
            let observed = libm::log2(coarse / fine);
            assert!(observed > f64::from(order) + 1.9, "order {order}, late {late}: observed {observed}");
            let (unstable, found) = run(order, 50, true);
            assert!(unstable > 1.0);
            assert!(found.expect("it grows").0 <= 20, "{found:?}");
        }
        let [(coarse, _), (fine, _)] = [800, 1600].map(|steps| run(2, steps, false));
        let observed = libm::log2(coarse / fine);
        assert!((2.9..3.1).contains(&observed), "order 2, late {late}: observed {observed}");
    }
}

/// A shaft on a spring at a port, which touches a ring, by several methods.
fn touching(method: &str) -> Named {
    Named::started(&format!(
        "{ROTOR}[[effects.port]]\nposition = 0.0\n[[effects.rub]]\nposition = 0.0\ngap = 1e-3\nstiffness = 1e5\n\
         damping = 10.0\nradius = 0.05\nv0 = 0.01\n[start]\nv_c = {{ y = 0.5 }}\n[solver]\nmethod = \"{method}\"\nrelative_tolerance = 1e-10\n{}",
        extrapolation(1, 1.0, true)
    ))
}

/// Goes on from point to point of 2 ms, with forces that answer the place before.
fn go_on(named: &mut Named, points: std::ops::Range<u32>) -> Vec<u64> {
    let force = named.place("port[1].f.y");
    let one = |n: u32| {
        let answered = named.get("port[1].r.y");
        named.simulation.set_input(force, -2e4 * answered);
        named.simulation.advance(f64::from(n + 1) * 2e-3).expect("a possible motion");
        named.get("port[1].r.y").to_bits()
    };
    points.map(one).collect()
}

/// Places of several methods apart, over the clearance [1]: measured 9.4e-11.
const METHODS: f64 = 1e-9;

#[test]
fn what_is_known_goes_with_the_state_through_contacts() {
    let exact = go_on(&mut touching("dop853"), 0..60);
    let touches = exact.iter().filter(|bits| f64::from_bits(**bits) > 1e-3).count();
    assert!((3..40).contains(&touches), "{touches} points in the ring");
    for method in ["dop853", "stiff", "auto"] {
        let mut named = touching(method);
        let all = go_on(&mut named, 0..60);
        let apart = all.iter().zip(&exact).map(|(one, other)| (f64::from_bits(*one) - f64::from_bits(*other)).abs());
        within(method, apart.fold(0.0, f64::max) / 1e-3, METHODS);
        for saved in [0, 1, 17] {
            let (mut first, mut other) = (touching(method), touching(method));
            assert_eq!(go_on(&mut first, 0..saved), all[..saved as usize]);
            let (bytes, clone) = (to_bytes(&mut *first.simulation), first.simulation.clone());
            // From another place, and once more.
            go_on(&mut other, 0..23);
            from_bytes(&mut *other.simulation, &bytes).expect("whole");
            assert_eq!(go_on(&mut other, saved..60), all[saved as usize..], "{method}, from bytes of point {saved}");
            go_on(&mut first, saved..60);
            first.simulation = clone;
            assert_eq!(go_on(&mut first, saved..60), all[saved as usize..], "{method}, from a copy of point {saved}");
        }
    }
}

#[test]
fn what_does_not_go_with_it_is_refused() {
    for (lines, named) in [
        ("[[effects.port]]\nposition = 0.0\nczz = 1.0\n", "port[1]"),
        ("[effects.drive]\nk = 1.0\n", "drive"),
        ("[effects.imposed_speed]\n", "imposed_speed"),
    ] {
        let text = |redo: bool| format!("{ROTOR}{lines}{}", extrapolation(1, 0.0, redo));
        Named::started(&text(false));
        let words = refusal(&text(true));
        assert!(words.contains("extrapolation.redo") && words.contains(named), "{words}");
    }
}

/// A step that fails leaves the communication point where it was.
#[test]
fn a_step_that_fails_leaves_the_motion_where_it_was() {
    for lag in [0.0, 1.0, 3.0] {
        let solver = "[solver]\nmax_evaluations = 2000.0\n";
        let mut named = Named::started(&format!(
            "{ROTOR}[[effects.port]]\nposition = 0.0\n{solver}{}",
            extrapolation(1, lag, true)
        ));
        go_on(&mut named, 0..10);
        let (t, r, place) = (named.simulation.time(), named.get("port[1].r.y"), named.place("port[1].f.y"));
        named.simulation.set_input(place, f64::MAX);
        named.simulation.advance(0.03).expect_err("no number is so large");
        assert_eq!((named.simulation.time(), named.get("port[1].r.y")), (t, r), "lag {lag}");
    }
}
