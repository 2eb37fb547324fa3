//! Rotors in springs of either sign, damped and not: every mode that grows is found, by the linear view and by the watch of a run.

use crate::harness::named::Named;
use crate::harness::{largest, within};
use crate::random_scenes::dice::Dice;
use nalgebra::{Complex, ComplexField, SMatrix};
use oracles::whirl::{Bearing, Whirl};
use split_rotor_model::decompositions::eigenvalues;
use split_rotor_model::linear::{Campbell, Crossing, Machine, Mode, Obstacle, Steady};

/// So many rotors are drawn.
const ROTORS: u64 = 300;

/// Growth by less than this part of a mode's size need not be found \[1].
const GROWS: f64 = 1e-5;

/// Eigenvalues below this part of the largest are those of directions in which nothing holds the rotor \[1].
const UNHELD: f64 = 1e-6;

/// A mode against an eigenvalue of the textbook's equations, of its size \[1]: measured 2.3e-11.
const MODES: f64 = 1e-10;

/// How nearly each mode solves the textbook's equations \[1]: measured 1.0e-14.
const RESIDUAL: f64 = 5e-14;

/// The growth that a run reports, of its size \[1]: measured 6.2e-13.
const WATCHED: f64 = 5e-12;

/// A rotor in one to three bearings, half of them undamped, at some spin or none.
fn drawn(number: u64) -> (Whirl, String) {
    let mut dice = Dice::new(0x2_9e5 + number);
    let (m, radius) = (dice.decades(0.1, 100.0), dice.decades(0.02, 0.5));
    let across = m * radius * radius;
    let axial = across * dice.within(0.1, 1.9);
    let rate = dice.decades(10.0, 2000.0);
    let is_damped = number % 2 == 1;
    let speed = if dice.chance(0.2) { 0.0 } else { dice.sign() * rate * dice.decades(0.01, 10.0) };
    let mut bearing = || {
        let mut spring = || dice.sign() * m * rate * rate * dice.decades(0.05, 2.0);
        let [kyy, kzz] = [spring(), spring()];
        let kzz = if dice.chance(0.3) { kyy } else { kzz };
        let mut damper = || if is_damped { m * rate * dice.decades(1e-4, 0.1) } else { 0.0 };
        let [cyy, czz] = [damper(), damper()];
        Bearing { position: radius * dice.within(-3.0, 3.0), k: [[kyy, 0.0], [0.0, kzz]], c: [[cyy, 0.0], [0.0, czz]] }
    };
    let count = 1 + number as usize % 3;
    let bearings: Vec<_> = (0..count).map(|_| bearing()).collect();
    let mut text =
        format!("[rotor]\nm = {m:?}\nJa = {axial:?}\nJt = {across:?}\n[start]\nomega = {{ x = {speed:?} }}\n");
    for Bearing { position, k, c } in &bearings {
        text += &format!(
            "[[effects.bearing]]\nposition = {position:?}\nkyy = {:?}\nkzz = {:?}\ncyy = {:?}\nczz = {:?}\n",
            k[0][0], k[1][1], c[0][0], c[1][1]
        );
    }
    (Whirl { m, Ja: axial, Jt: across, speed, bearings }, text)
}

fn grows(value: &Complex<f64>) -> bool {
    value.re > GROWS * value.modulus()
}

/// How far the nearest of these is, over the size of the value \[1].
fn apart(value: &Complex<f64>, from: impl Iterator<Item = Complex<f64>>) -> f64 {
    from.map(|other| (other - value).modulus()).fold(f64::INFINITY, f64::min) / value.modulus()
}

#[test]
fn exact_every_mode_that_grows_is_found_in_springs_of_either_sign() {
    let (mut unstable, mut worst, mut residual, mut watched) = (0, 0.0_f64, 0.0_f64, 0.0_f64);
    for number in 0..ROTORS {
        let (whirl, text) = drawn(number);
        let exact = whirl.eigenvalues();
        let named = Named::started(&text);
        let machine = Machine::of(named.simulation.parameters()).expect("a machine");
        let (_, modes) = machine.modes(whirl.speed, None).unwrap_or_else(|obstacle| panic!("{obstacle}\n{text}"));
        // Of a pair the linear view shows one.
        let counted = |values: &mut dyn Iterator<Item = &Complex<f64>>| values.filter(|value| grows(value)).count();
        // What nothing holds stays where it is: its eigenvalues are 0 but for the root of rounding.
        let fastest = exact.iter().map(|value| value.modulus()).fold(0.0, f64::max);
        let exact: Vec<_> = exact.into_iter().filter(|value| value.modulus() > UNHELD * fastest).collect();
        let upper: Vec<_> = exact.iter().copied().filter(|value| value.im >= -1e-7 * value.modulus()).collect();
        let expected = counted(&mut upper.iter());
        assert_eq!(counted(&mut modes.iter().map(|mode| &mode.eigenvalue)), expected, "{modes:?}\n{exact:?}\n{text}");
        assert_eq!(modes.iter().filter(|mode| mode.grows()).count(), expected, "{text}");
        let of_modes = |mode: &Mode| mode.eigenvalue;
        worst = worst.max(largest(upper.iter().map(|value| apart(value, modes.iter().map(of_modes)))));
        residual = residual.max(largest(modes.iter().map(|mode| whirl.residual(mode.eigenvalue))));
        let fastest = exact.iter().filter(|value| grows(value)).map(|value| value.re).fold(0.0, f64::max);
        assert_eq!(named.simulation.unjudged(), None);
        match named.simulation.growth() {
            Some(growth) => {
                assert!(fastest > 0.0, "{growth:?}\n{exact:?}\n{text}");
                watched = watched.max((growth.rate / fastest - 1.0).abs());
            }
            None => assert!(fastest == 0.0, "nothing is reported of {fastest} 1/s\n{exact:?}\n{text}"),
        }
        unstable += u32::from(fastest > 0.0);
    }
    println!("{unstable} of {ROTORS} are unstable");
    assert!((100..ROTORS as u32).contains(&unstable));
    within("modes", worst, MODES);
    within("residual", residual, RESIDUAL);
    within("watched", watched, WATCHED);
}

/// Speeds at which each rotor is looked at.
const STEPS: u32 = 20;

/// A threshold against the textbook's, of its speed \[1]: measured 3.0e-11.
const THRESHOLDS: f64 = 2e-10;

/// How far a critical speed is from a frequency of the textbook's equations, of itself \[1]: measured 2.8e-12.
const CRITICAL: f64 = 2e-11;

#[test]
fn exact_ranges_of_speeds_at_which_rotors_in_springs_of_either_sign_grow_and_their_critical_speeds() {
    let (mut counted, mut furthest, mut criticals, mut off_line) = (0, 0.0_f64, 0, 0.0_f64);
    for number in 0..ROTORS {
        let (whirl, text) = drawn(number);
        let machine = Machine::of(Named::written(&text).simulation.parameters()).expect("a machine");
        let exact = |speed: f64| {
            let all = Whirl { speed, ..whirl.clone() }.eigenvalues();
            let fastest = largest(all.iter().map(|value| value.modulus()));
            all.into_iter().filter(move |value| value.modulus() > UNHELD * fastest)
        };
        let highest = 1.5 * exact(0.0).map(|value| value.modulus()).fold(whirl.speed.abs(), f64::max);
        let speeds: Vec<_> = (0..=STEPS).map(|n| highest * f64::from(n) / f64::from(STEPS)).collect();
        let campbell = Campbell::of(&machine, &speeds).unwrap_or_else(|obstacle| panic!("{obstacle}\n{text}"));
        let thresholds = campbell.thresholds().unwrap_or_else(|obstacle| panic!("{obstacle}\n{text}"));
        let critical = campbell.critical_speeds(1.0).unwrap_or_else(|obstacle| panic!("{obstacle}\n{text}"));
        // Of a pair each counts: where it becomes two that do not swing, as many grow as before.
        let growing = |speed: f64| exact(speed).filter(|value| value.re > 1e-7 * value.modulus()).count();
        let above = |speed: f64| exact(speed).filter(|value| value.im > speed * (1.0 + 1e-9)).count();
        for pair in speeds.windows(2) {
            let within = |all: &[Crossing]| {
                let here = all.iter().map(|one| one.speed).filter(|speed| (pair[0]..=pair[1]).contains(speed));
                here.collect::<Vec<_>>()
            };
            let [before, after] = [pair[0], pair[1]].map(growing);
            match &within(&thresholds)[..] {
                [] => assert_eq!(before, after, "{pair:?}\n{text}"),
                [threshold] => {
                    assert_ne!(before, after, "{threshold} in {pair:?}\n{text}");
                    let [mut from, mut to] = [pair[0], pair[1]];
                    while to - from > 1e-12 * to {
                        let speed = 0.5 * (from + to);
                        *(if growing(speed) == before { &mut from } else { &mut to }) = speed;
                    }
                    furthest = furthest.max((threshold / to - 1.0).abs());
                    counted += 1;
                }
                several => assert!(before.abs_diff(after) <= 2 * several.len(), "{several:?} in {pair:?}\n{text}"),
            }
            // At standstill every line begins at 0, where what nothing holds is.
            if pair[0] > 0.0 {
                let (found, change) = (within(&critical).len(), above(pair[0]).abs_diff(above(pair[1])));
                let is_explained = found >= change && (found - change).is_multiple_of(2);
                assert!(is_explained, "{found} for {change} in {pair:?}\n{text}");
            }
        }
        for one in &critical {
            let apart = exact(one.speed).map(|value| (value.im / one.speed - 1.0).abs());
            off_line = off_line.max(apart.fold(f64::INFINITY, f64::min));
            criticals += 1;
        }
    }
    println!("{counted} thresholds, {criticals} critical speeds");
    within("thresholds", furthest, THRESHOLDS);
    within("critical speeds", off_line, CRITICAL);
}

#[test]
fn regress_an_unstable_rotor_is_not_called_stable() {
    let text = "[rotor]\nm = 6.0\nJa = 0.01\nJt = 0.06\n[start]\nomega.x = 100.0\nr_c.y = 20e-6\n\
        [[effects.bearing]]\nposition = 0.15\nkyy = -2e5\nkzz = -2e5\n";
    let k = [[-2e5, 0.0], [0.0, -2e5]];
    let bearings = vec![Bearing { position: 0.15, k, c: [[0.0; 2]; 2] }];
    let whirl = Whirl { m: 6.0, Ja: 0.01, Jt: 0.06, speed: 100.0, bearings };
    let exact = whirl.eigenvalues().iter().map(|value| value.re).fold(0.0, f64::max);
    within("closed form", (exact / 329.1 - 1.0).abs(), 1e-3);
    let named = Named::started(text);
    let growth = named.simulation.growth().expect("a motion that grows");
    within("watched", (growth.rate / exact - 1.0).abs(), 1e-6);
    let machine = Machine::of(named.simulation.parameters()).expect("a machine");
    let (_, modes) = machine.modes(100.0, None).expect("modes");
    let found = modes.iter().map(|mode| mode.eigenvalue.re).fold(0.0, f64::max);
    within("mode", (found / exact - 1.0).abs(), 1e-8);
}

#[test]
fn a_search_that_fails_names_itself() {
    assert_eq!(eigenvalues(&SMatrix::<f64, 4, 4>::from_element(f64::NAN)), None);
    let text = "[rotor]\nm = 5.0\nJa = 0.1\nJt = 0.1\n[[effects.bearing]]\nposition = 0.1\nkyy = 1e5\nkzz = 1e5\n";
    let machine = Machine::of(Named::written(text).simulation.parameters()).expect("a machine");
    let steady = machine.steady(10.0, None).expect("it is held");
    let broken = Steady { matrix: steady.matrix * f64::NAN, ..steady };
    let obstacle = broken.modes().expect_err("no modes");
    assert_eq!(obstacle, Obstacle::NoEigenvalues { speed: 10.0 });
    assert!(obstacle.to_string().contains("search for the eigenvalues"), "{obstacle}");
}
