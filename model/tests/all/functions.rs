//! Elementary functions of a scalar: values against 50 digits, derivatives and second derivatives against closed forms,
//! and the same bits everywhere.

use split_rotor_model::dual::{Dual, Tangent};
use split_rotor_model::scalar::{Scalar, ulp};

/// x, sin x, cos x, e^x, tanh x, by mpmath with 50 digits, rounded once.
const VALUES: [[f64; 5]; 9] = [
    [-30.5, 0.7931272394572851, 0.6090559761063562, 5.675685232632723e-14, -1.0],
    [-3.0, -0.1411200080598672, -0.9899924966004454, 0.049787068367863944, -0.9950547536867305],
    [-0.7, -0.644217687237691, 0.7648421872844885, 0.4965853037914095, -0.6043677771171635],
    [-1e-9, -1e-9, 1.0, 0.999999999, -1e-9],
    [0.25, 0.24740395925452294, 0.9689124217106447, 1.2840254166877414, 0.24491866240370913],
    [1.0, 0.8414709848078965, 0.5403023058681398, std::f64::consts::E, 0.7615941559557649],
    [2.75, 0.38166099205233167, -0.9243023786324636, 15.642631884188171, 0.9918597245682077],
    [10.0, -0.5440211108893698, -0.8390715290764524, 22026.465794806718, 0.9999999958776927],
    [300.0, -0.9997558399011495, -0.022096619278683942, 1.9424263952412558e130, 1.0],
];

/// x, |x|^1.5, |x|^(10/9), by the same.
const POWERS: [[f64; 3]; 9] = [
    [-30.5, 168.44175551210571, 44.588415935585274],
    [-3.0, 5.196152422706632, 3.3894928917292595],
    [-0.7, 0.5856620185738528, 0.6728011283256631],
    [-1e-9, 3.1622776601683796e-14, 9.99999999999999e-11],
    [0.25, 0.125, 0.2143109957132682],
    [1.0, 1.0, 1.0],
    [2.75, 4.560359086738675, 3.0771412887332654],
    [10.0, 31.622776601683793, 12.91549665014884],
    [300.0, 5196.152422706632, 565.401491352936],
];

/// y, x, and the azimuth of (x, y), by the same.
const AZIMUTHS: [[f64; 3]; 5] = [
    [1.0, 3.0, 0.3217505543966422],
    [-2.5, 0.125, -1.5208379310729538],
    [0.001, -7.0, 3.141449796447908],
    [-4.0, -4.5, -2.4149503129080676],
    [0.3, -0.0, std::f64::consts::FRAC_PI_2],
];

/// Values [ulp]: measured 1, allow 2.
const VALUE: f64 = 2.0;

/// Derivatives, relative to the larger of their size and 1 [1]: measured 3.3e-16, allow 1e-15.
const DERIVATIVE: f64 = 1e-15;

#[track_caller]
fn close(found: f64, expected: f64, what: &str) {
    let error = (found - expected).abs() / expected.abs().max(1.0);
    println!("{what}: {error:e}");
    assert!(error <= DERIVATIVE, "{what}: {found:?}, not {expected:?}");
}

#[test]
fn exact_values() {
    let check = |found: f64, expected: f64, what: &str| {
        let error = (found - expected).abs() / ulp(expected);
        println!("{what}: {error} ulp");
        assert!(error <= VALUE, "{what}: {found:?}, not {expected:?}");
    };
    for [x, sine, cosine, power, tangent] in VALUES {
        check(Scalar::sin(x), sine, "sin");
        check(Scalar::cos(x), cosine, "cos");
        check(Scalar::exp(x), power, "exp");
        check(Scalar::tanh(x), tangent, "tanh");
    }
    for [x, contact, line] in POWERS {
        check(Scalar::powf(x.abs(), 1.5), contact, "powf 3/2");
        check(Scalar::powf(x.abs(), 10.0 / 9.0), line, "powf 10/9");
    }
    for [y, x, angle] in AZIMUTHS {
        check(Scalar::atan2(y, x), angle, "atan2");
    }
    let cube: [f64; 4] = [-2, 0, 1, 3].map(|power| Scalar::powi(-1.5, power));
    assert_eq!(cube, [1.0 / 2.25, 1.0, -1.5, -3.375]);
}

/// A value with its first and second derivative.
type Second = Dual<1, Tangent>;

/// f, f′ and f″ at x.
fn derivatives(f: impl Fn(Second) -> Second, x: f64) -> [f64; 3] {
    let result = f(Dual::along(Tangent::along(x, 1.0), Tangent::constant(1.0)));
    assert_eq!(result.re.eps[0].to_bits(), result.eps[0].re.to_bits(), "one first derivative");
    [result.re.re, result.re.eps[0], result.eps[0].eps[0]]
}

#[track_caller]
fn has_derivatives(f: impl Fn(Second) -> Second, x: f64, expected: [f64; 3], what: &str) {
    for (found, (expected, order)) in derivatives(f, x).into_iter().zip(expected.into_iter().zip(0..)) {
        close(found, expected, &format!("{what}, derivative {order} at {x}"));
    }
}

#[test]
fn exact_derivatives_of_functions() {
    for x in [-3.0, -0.7, -1e-9, 0.25, 1.0, 2.75] {
        let (s, c, e, t) = (libm::sin(x), libm::cos(x), libm::exp(x), libm::tanh(x));
        let bell = 1.0 / (libm::cosh(x) * libm::cosh(x));
        has_derivatives(Scalar::sin, x, [s, c, -s], "sin");
        has_derivatives(Scalar::cos, x, [c, -s, -c], "cos");
        has_derivatives(Scalar::exp, x, [e, e, e], "exp");
        has_derivatives(Scalar::tanh, x, [t, bell, -2.0 * t * bell], "tanh");
        has_derivatives(|x| x.powi(3), x, [x * x * x, 3.0 * x * x, 6.0 * x], "powi 3");
        has_derivatives(|x| x.abs(), x, [x.abs(), x.signum(), 0.0], "abs");
        // d atan2(y, x) = (x dy − y dx)/(x² + y²)
        let square = x * x + 4.0;
        let two = Second::constant(2.0);
        let along_y = [libm::atan2(x, 2.0), 2.0 / square, -4.0 * x / (square * square)];
        let along_x = [libm::atan2(2.0, x), -2.0 / square, 4.0 * x / (square * square)];
        has_derivatives(|y| y.atan2(two), x, along_y, "atan2 by y");
        has_derivatives(|x| two.atan2(x), x, along_x, "atan2 by x");
        let size = x.abs();
        let root = size.sqrt();
        has_derivatives(|x| x.powf(1.5), size, [size * root, 1.5 * root, 0.75 / root], "powf 3/2");
        has_derivatives(|x| x.powf(2.5), size, [size * size * root, 2.5 * size * root, 3.75 * root], "powf 5/2");
    }
    has_derivatives(|x| x.powi(-2), -2.0, [0.25, 0.25, 0.375], "powi -2");
}

#[test]
fn exact_derivatives_where_functions_bend() {
    let contact = |x: Second| x.positive_part().powf(1.5);
    let line = |x: Second| x.positive_part().powf(10.0 / 9.0);
    for x in [-2.0, -0.0, 0.0] {
        assert_eq!(derivatives(contact, x).map(f64::abs), [0.0; 3], "at {x}");
        assert_eq!(derivatives(line, x).map(f64::abs), [0.0; 3], "at {x}");
    }
    assert_eq!(derivatives(contact, 4.0), [8.0, 3.0, 0.375]);
    assert_eq!(derivatives(Scalar::abs, 0.0), [0.0, 1.0, 0.0]);
    assert_eq!(derivatives(Scalar::positive_part, 0.0), [0.0, 1.0, 0.0]);
    for power in [0, 1, 2] {
        let [value, slope, bend] = derivatives(|x| x.powf(f64::from(power)), 0.0);
        assert!([value, slope, bend].iter().all(|number| number.is_finite()), "power {power}");
    }
    let one = Second::constant(1.0);
    // A clamp: the value within, its derivative none beyond.
    let clamp = |x: Second| x.min(one).max(-one);
    for (x, expected) in
        [(-1.5, [-1.0, 0.0, 0.0]), (0.5, [0.5, 1.0, 0.0]), (1.0, [1.0, 1.0, 0.0]), (9.0, [1.0, 0.0, 0.0])]
    {
        assert_eq!(derivatives(clamp, x), expected, "at {x}");
    }
    let origin = Second::constant(0.0);
    assert_eq!(derivatives(|y| y.atan2(origin), 0.0), [0.0; 3]);
}

#[test]
fn exact_not_a_number_stays() {
    let nan = f64::NAN;
    assert!(Scalar::positive_part(nan).is_nan() && Scalar::abs(nan).is_nan());
    assert!(Scalar::max(nan, 1.0).is_nan() && Scalar::min(nan, 1.0).is_nan());
}

/// Of [`golden_bits_on_every_host`], in debug and release.
const BITS: u64 = 0x5396_d8dc_db49_1b01;

#[test]
fn golden_bits_on_every_host() {
    let (mut bits, mut x) = (0xcbf2_9ce4_8422_2325_u64, -40.0_f64);
    while x < 40.0 {
        let [sine, cosine] = Scalar::sin_cos(x);
        let powers = [0.5, 0.7, 1.5].map(|power| Scalar::powf(x.abs(), power));
        for value in [sine, cosine, Scalar::exp(x), Scalar::tanh(x), Scalar::atan2(x, 0.5)].into_iter().chain(powers) {
            // FNV-1a, of words.
            bits = (bits ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3);
        }
        x += 0.037;
    }
    assert_eq!(bits, BITS);
}
