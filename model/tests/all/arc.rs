//! Angles from sines and cosines, and back (`rotation/arc.rs`), against numbers of 320 binary places.

use crate::harness::{Random, largest, within};
use oracles::fixed::Fixed;
use split_rotor_model::rotation::arc::{Reduced, atan2};
use split_rotor_model::rotation::series;
use std::f64::consts::PI;

/// sin a and cos a of a double.
fn sine_and_cosine(a: f64) -> (Fixed, Fixed) {
    let a = Fixed::of(a);
    // The oracle's functions are of θ²: cos(θ/2) and sin(θ/2)/(θ/2) of θ²/4.
    let square = &a * &a;
    (&a * &square.sinc(), square.cosine())
}

/// arctan √x/√x [ulp of 1]: measured 1.32.
const ARCTANGENT: f64 = 2.0;
/// atan2 relative to its value [1]: measured 3.1e-16.
const ANGLE: f64 = 5e-16;
/// cos β and sin β of reduced angles below 10 and 10⁸ rad [1]: measured 3.8e-16.
const REDUCED: f64 = 5e-16;

/// The angle between (x, y) and its azimuth as computed, over the azimuth [1].
fn error(y: f64, x: f64) -> f64 {
    let angle = atan2(y, x);
    let (sine, cosine) = sine_and_cosine(angle);
    let (fx, fy) = (Fixed::of(x), Fixed::of(y));
    let across = &(&fy * &cosine) - &(&fx * &sine);
    let along = &(&fx * &cosine) + &(&fy * &sine);
    assert!(along.to_f64() > 0.0, "({x}, {y}) is not at {angle}");
    (across.to_f64() / along.to_f64() / angle).abs()
}

#[test]
fn exact_azimuth_keeps_full_precision() {
    let mut random = Random(3);
    let mut worst = 0.0_f64;
    for i in 0..2000 {
        let scale = libm::pow(10.0, random.within(-9.0, 0.0));
        let (a, b) = (random.within(-1.0, 1.0), random.within(-1.0, 1.0) * scale);
        let (y, x) = if i % 2 == 0 { (a, b) } else { (b, a) };
        worst = largest([worst, error(y, x)]);
    }
    within("azimuth", worst, ANGLE);
}

#[test]
fn exact_azimuth_on_the_axes() {
    assert_eq!(atan2(0.0, 1.0), 0.0);
    assert_eq!(atan2(1.0, 0.0), PI / 2.0);
    assert_eq!(atan2(-1.0, 0.0), -PI / 2.0);
    assert_eq!(atan2(0.0, -1.0), PI);
    assert_eq!(atan2(0.0, 0.0), 0.0);
}

#[test]
fn exact_arc_tangent_on_the_whole_interval() {
    let mut worst = 0.0_f64;
    for i in 0..=1000 {
        let root = f64::from(i) / 1000.0;
        // With x = tan²a the angle √x·f(x) is a; its error is that of f times √x.
        let f = series::arctangent(root * root);
        let (sine, cosine) = sine_and_cosine(root * f);
        let across = &(&Fixed::of(root) * &cosine) - &sine;
        let along = &cosine + &(&Fixed::of(root) * &sine);
        if root > 0.0 {
            worst = largest([worst, (across.to_f64() / along.to_f64() / root).abs() / f64::EPSILON]);
        }
    }
    within("arctan", worst, ARCTANGENT);
    assert_eq!(series::arctangent(0.0), 1.0);
}

#[test]
fn exact_reduction_of_large_angles() {
    let mut random = Random(5);
    let mut worst = 0.0_f64;
    let pi = &Fixed::tau_circle() / &Fixed::whole(2);
    for i in 0..1000 {
        let a = if i < 500 { random.within(0.0, 10.0) } else { random.within(0.0, 1e8) };
        let reduced = Reduced::new(a);
        let beta = &Fixed::of(a) - &(&pi * &Fixed::of(reduced.half_turns));
        assert!(beta.to_f64().abs() <= PI / 2.0 * (1.0 + 1e-8));
        let square = &beta * &beta;
        let (sine, cosine) = (&beta * &square.sinc(), square.cosine());
        let own = Fixed::of(reduced.beta * reduced.sinc);
        let sign = if reduced.half_turns % 2.0 == 0.0 { 1.0 } else { -1.0 };
        worst = largest([
            worst,
            (&Fixed::of(reduced.cosine) - &cosine).abs().to_f64(),
            (&own - &sine).abs().to_f64(),
            (reduced.sine() - sign * sine.to_f64()).abs(),
        ]);
    }
    within("reduced", worst, REDUCED);
}
