//! Lagrange's top on an elastic pivot: steady, asleep, waking, and as its pivot becomes rigid.

use super::case::{Case, Exact, Found, Setting, body, follow, of_whirl, start, support, times};
use super::method::{at, usual};
use anyhow::Result;
use nalgebra::{Complex, ComplexField, Vector2, Vector3};
use oracles::motion::Whirl;
use oracles::numerics::log_slope;
use oracles::rotation;
use oracles::top::{Lagrange, Upright};

/// The paper's rotor on its rod, upright on a pivot of 10⁴ N/m.
const UPRIGHT: Upright = Upright { m: 5.0, Ja: 0.15625, Jt: 0.078125, l: 0.75, c1: 1e4, g: 9.81, spin: 0.0 };

/// The family.
pub fn cases() -> Vec<Case> {
    vec![steady(), nearly_upright(), waking(0.999), waking(0.5), rigid()]
}

fn steady() -> Case {
    let Upright { c1, g, .. } = UPRIGHT;
    let whirl = Whirl { c1, c2: 0.0, g, ..Whirl::paper(0.6, 6.0) };
    Case {
        name: "Lagrange's top, steady at 0.6 rad".into(),
        hard: "gravity, spin and an elastic pivot balance",
        oracle: "steady whirl in closed form",
        scene: "paper",
        methods: usual([2e-12, 3e-12, 3e-10], []),
        mutant: ("gravity.g.x", 1.0 + 1e-6),
        task: follow(of_whirl(&whirl), times(2.0, 50), move |t| Exact::of_whirl(&whirl, t)),
    }
}

/// A top that spins a thousandth faster than it must: tilted by 10⁻⁶ rad, it stays so.
fn nearly_upright() -> Case {
    let top = Upright { spin: 1.001 * UPRIGHT.sleeps_from(), ..UPRIGHT };
    let slowest = top.rates().into_iter().min_by(|a, b| a.modulus().total_cmp(&b.modulus())).expect("four");
    let theta = 1e-6;
    Case {
        name: "top asleep, spin 1.001 of the threshold".into(),
        hard: "two whirl rates about to meet, tilt 10⁻⁶ rad (error in units of it)",
        oracle: "roots of the upright top's frequency equation",
        scene: "paper",
        methods: vec![(at("dop853", 1e-13), 4e-10), (at("stiff", 1e-11), 6e-10)],
        mutant: ("gravity.g.x", 1.0 + 1e-3),
        task: small_motion(top, slowest, theta, 5.0),
    }
}

/// A top that spins at this part of what it must: the tilt of 10⁻⁹ rad grows as e^(σt), until 10⁻⁵ rad.
fn waking(part: f64) -> Case {
    let top = Upright { spin: part * UPRIGHT.sleeps_from(), ..UPRIGHT };
    let rate = top.fastest_growing();
    let end = (libm::log(1e4) / -rate.im).min(20.0);
    Case {
        name: format!("top waking, spin {part} of the threshold"),
        hard: "growth from 10⁻⁹ rad (error in units of the tilt)",
        oracle: "roots of the upright top's frequency equation",
        scene: "paper",
        methods: vec![(at("dop853", 1e-13), 1e-10), (at("stiff", 1e-11), 4e-10)],
        mutant: ("rotor.Ja", 1.0 - 1e-3),
        task: small_motion(top, rate, 1e-9, end),
    }
}

/// The motion e^(iΩt) of an upright top from a tilt θ \[rad], up to `end` \[s]; the error in units of the present tilt.
fn small_motion(top: Upright, rate: Complex<f64>, theta: f64, end: f64) -> super::case::Task {
    let Upright { m, Ja, Jt, l, c1, g, spin } = top;
    let at_time = move |t: f64| (rate * Complex::i() * t).exp() * theta;
    let out = top.shape(rate);
    // A complex number is a vector across e: real part y, imaginary part z.
    let across = |x: f64, number: Complex<f64>| Vector3::new(x, number.re, number.im);
    let (tilt, turning) = (at_time(0.0), rate * Complex::i() * theta);
    let gamma = Vector2::new(-tilt.im, tilt.re);
    let axis = rotation::axis(&gamma);
    let omega = axis * spin + axis.cross(&across(0.0, turning));
    let mut settings = body(m, Ja, Jt, l);
    settings.extend(support(c1, 0.0, -Vector3::x() * g));
    settings.extend(start(&across(l - m * g / c1, out * tilt), &across(0.0, out * turning), 0.0, &gamma, &omega));
    settings.push(("solver.absolute_tolerance", 1e-17));
    Box::new(move |bench| {
        let mut rotor = bench.rotor(&settings)?;
        rotor.start(0.0, end)?;
        let mut found = Found::nothing();
        for t in times(end, 50) {
            rotor.advance(t)?;
            let (shown, tilt) = (rotor.shown()?, at_time(t));
            let off = across(0.0, Complex::new(shown.axis.y, shown.axis.z) - tilt).norm();
            found = found.or(off / tilt.modulus(), "tilt, relative");
        }
        Ok(found)
    })
}

/// Let go at 0.6 rad with the axis at rest, on ever stiffer pivots: what differs from Lagrange's motion falls as 1/c1.
fn rigid() -> Case {
    Case {
        name: "top nutating, pivot of 10⁵ to 10⁸ N/m".into(),
        hard: "a rigid pivot as the limit of springs",
        oracle: "Lagrange's elliptic functions; the difference falls as 1/c1",
        scene: "paper",
        methods: vec![(at("dop853", 1e-12), 5e-3), (at("stiff", 1e-10), 5e-3)],
        mutant: ("rotor.Jt", 1.001),
        task: Box::new(|bench| {
            let mut differences = Vec::new();
            for c1 in [1e5, 1e6, 1e7, 1e8] {
                differences.push((c1, from_lagrange(bench, c1)?));
            }
            Ok(Found { error: (log_slope(&differences) + 1.0).abs(), of: "power of c1, from −1".into() })
        }),
    }
}

/// The largest difference of cos θ from a rigid pivot's, over 1 s \[1].
fn from_lagrange(bench: &super::bench::Bench, c1: f64) -> Result<f64> {
    let Upright { m, Ja, Jt, l, g, .. } = UPRIGHT;
    let (theta, spin) = (0.6, 150.0);
    let lagrange = Lagrange::new(Jt + m * l * l, Ja * spin, m * g * l, theta);
    let gamma = Vector2::new(0.0, theta);
    let axis = rotation::axis(&gamma);
    let mut settings: Vec<Setting> = body(m, Ja, Jt, l);
    settings.extend(support(c1, 0.0, -Vector3::x() * g));
    let r_c = axis * l - Vector3::x() * (m * g / c1);
    settings.extend(start(&r_c, &Vector3::zeros(), 0.0, &gamma, &(axis * spin)));
    let mut rotor = bench.rotor(&settings)?;
    rotor.start(0.0, 1.0)?;
    let mut worst = 0.0_f64;
    for t in times(1.0, 200) {
        rotor.advance(t)?;
        worst = worst.max((rotor.shown()?.axis.x - lagrange.cosine(t)).abs());
    }
    Ok(worst)
}
