//! At which frequencies one looks.

use anyhow::{Result, ensure};
use split_rotor_model::linear::{Mode, Steady};

/// So far beyond the lowest and the highest frequency of the modes one looks \[1].
const BEYOND: f64 = 10.0;

/// No machine swings faster, or more slowly [rad/s].
const FASTEST: f64 = 1e12;
const SLOWEST: f64 = 1e-12;

/// About a mode the curve in the complex plane is nearly a circle, of which so many points are shown.
const OF_A_CIRCLE: u32 = 72;

/// So many frequencies [rad/s] from the first of these to the second, in equal ratios, and some about each mode between; where none are
/// given, to beyond those of the modes.
pub fn frequencies(steady: &Steady, ends: Option<[f64; 2]>, steps: u32) -> Result<Vec<f64>> {
    ensure!(steps >= 2, "--steps {steps}: at least 2 frequencies are needed");
    let modes = steady.modes()?;
    let [from, to] = ends.unwrap_or_else(|| about(&modes, steady.speed));
    ensure!(
        from >= SLOWEST && to <= FASTEST && from < to,
        "--frequencies {from} {to}: the second must be more than the first, both within {SLOWEST:e} and {FASTEST:e} rad/s"
    );
    let part = |n: u32| f64::from(n) / f64::from(steps - 1);
    let mut all: Vec<_> = (0..steps - 1).map(|n| from * libm::pow(to / from, part(n))).chain([to]).collect();
    all.extend(modes.iter().flat_map(circle).filter(|frequency| (from..to).contains(frequency)));
    all.sort_by(f64::total_cmp);
    all.dedup();
    Ok(all)
}

/// From below the lowest to above the highest frequency of the modes; else of what creeps, or of the spin.
fn about(modes: &[Mode], speed: f64) -> [f64; 2] {
    let swinging: Vec<_> = modes.iter().map(|mode| mode.eigenvalue.im).filter(|whirl| *whirl > 0.0).collect();
    let creeping = modes.iter().map(|mode| mode.eigenvalue.re.abs()).filter(|rate| *rate > 0.0);
    let rates = if swinging.is_empty() { creeping.collect() } else { swinging };
    let (least, most) =
        rates.iter().fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), rate| (least.min(*rate), most.max(*rate)));
    match most {
        0.0 if speed == 0.0 => [1.0 / BEYOND, BEYOND],
        0.0 => [speed.abs() / BEYOND, BEYOND * speed.abs()],
        _ => [least / BEYOND, BEYOND * most],
    }
}

/// Frequencies that are evenly spread over the circle of a mode.
fn circle(mode: &Mode) -> impl Iterator<Item = f64> {
    let (decay, swing) = (mode.eigenvalue.re.abs(), mode.eigenvalue.im);
    // 1/(iΩ − λ) runs round a circle by twice the angle α whose tangent is (Ω − Im λ)/|Re λ|.
    let angle = |n: u32| std::f64::consts::PI * (f64::from(n) / f64::from(OF_A_CIRCLE) - 0.5);
    (1..OF_A_CIRCLE).map(move |n| swing + decay * libm::tan(angle(n))).filter(|frequency| *frequency > 0.0)
}
