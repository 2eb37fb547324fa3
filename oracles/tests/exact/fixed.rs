//! Numbers of 320 places against digits in print and unrounded rationals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use oracles::fixed::Fixed;

/// The series keep some 90 digits; the digits in print are 60 [1].
const PRINTED: &str = "0.000000000000000000000000000000000000000000000000000000000001";

#[test]
fn exact_series_agree_with_digits_in_print() {
    // cos 1, sin 1 (OEIS A049470, A049469) and tan(1/2) (A161019).
    let one = Fixed::whole(1);
    let cosine = Fixed::decimal("0.540302305868139717400936607442976603732310420617922227670097");
    let sine = Fixed::decimal("0.841470984807896506652502321630298999622563060798371065672751");
    let ulp = Fixed::decimal(PRINTED);
    assert!((&one.cosine() - &cosine).abs() <= ulp, "cos 1");
    assert!((&one.sinc() - &sine).abs() <= ulp, "sin 1");
    assert!((&one.bessel() - &(&sine - &cosine)).abs() <= &ulp + &ulp, "sin 1 - cos 1");
    assert!((&one.versine() - &(&one - &cosine)).abs() <= ulp, "1 - cos 1");
    // κ(1) = 1 − cot 1, τ(1) = (1 − cos 1)/sin 1
    assert!((&one.kappa() - &(&one - &(&cosine / &sine))).abs() <= &(&ulp + &ulp) + &(&ulp + &ulp), "kappa");
    assert!((&one.tau() - &(&(&one - &cosine) / &sine)).abs() <= &(&ulp + &ulp) + &(&ulp + &ulp), "tau");
}

#[test]
fn exact_two_pi_is_the_period_of_the_series() {
    // sin π/π = 0 and cos 2π = 1: to the 100 places of 2π, the cosine to twice as many.
    let tau = Fixed::tau_circle();
    let pi = &tau / &Fixed::whole(2);
    let limit = &Fixed::of(1e-45) * &Fixed::of(1e-45);
    assert!((&pi * &pi).sinc().abs() < limit);
    assert!((&(&tau * &tau).cosine() - &Fixed::whole(1)).abs() < limit);
}

/// The sum of the series in rationals without rounding, and a bound of what is left out.
fn unrounded_cosine(x: f64) -> (BigRational, BigRational) {
    let x = BigRational::from_float(x).expect("finite");
    let (mut sum, mut term) = (BigRational::zero(), BigRational::from_integer(BigInt::from(1)));
    for k in 1..=40 {
        sum += &term;
        term = -(&term * &x) / BigInt::from(2 * k * (2 * k - 1));
    }
    (sum, term.abs())
}

#[test]
fn exact_series_agree_with_unrounded_rationals() {
    for x in [0.0, f64::from_bits(1), 1e-300, 1e-16, 0.1, 1.0, 2.4] {
        let (sum, rest) = unrounded_cosine(x);
        let difference = (&Fixed::rational(&sum) - &Fixed::of(x).cosine()).abs();
        assert!(difference < &Fixed::of(1e-45) * &Fixed::of(1e-45), "x = {x:e}");
        assert!(rest < BigRational::from_float(1e-90).unwrap(), "x = {x:e}");
    }
}

#[test]
fn exact_fixed_numbers_keep_doubles() {
    for x in [1.0, -0.1, 1e-40, -3.3e9, 2.5e-60] {
        assert_eq!(Fixed::of(x).to_f64(), x);
        assert_eq!(Fixed::ratio(x, 1.0), Fixed::of(x));
    }
    assert_eq!(Fixed::ratio(3e-310, 1.5e-310).to_f64(), 3e-310 / 1.5e-310);
}
