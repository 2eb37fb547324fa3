//! A motor of limited power: its closed form in the equations, and hanging and passing beside the whole equations of motion.

use oracles::bounds::within;
use oracles::extrapolation::steps;
use oracles::limited_power::{Disk, Motor, Turning};
use oracles::numerics::derivative;

/// Without lag, strongly and weakly damped, and in between.
const LAGS: [f64; 4] = [0.0, 0.3, 40.0, 2.5];

fn motor(lag: f64) -> Motor {
    // T_m = 10 s; at a lag of 2.5 s both roots are one.
    Motor { inertia: 0.2, stall: 2.0, synchronous: 100.0, lag }
}

/// J ω̇ = τ, φ̇ = ω and T τ̇ = τ∞ − τ, relative to the largest speed and torque [1]: measured 7.3e-12.
const EQUATIONS: f64 = 2e-11;

#[test]
fn exact_run_up_obeys_its_equations() {
    for lag in LAGS {
        let motor = motor(lag);
        let start = Turning { phi: 0.4, speed: 15.0, torque: -3.0 };
        for t in [0.1, 1.0, 7.0, 30.0] {
            let at = |t: f64| {
                let Turning { phi, speed, torque } = motor.run(0.8, &start, t);
                [phi, speed, torque]
            };
            let [[_, speed, torque], rates] = [at(t), derivative(at, t, 0.05)];
            within("speed", (rates[0] - speed).abs() / 100.0, EQUATIONS);
            within("torque", (motor.inertia * rates[1] - torque).abs() / motor.stall, EQUATIONS);
            let characteristic = motor.steady(0.8, speed) - torque - lag * rates[2];
            within("characteristic", characteristic.abs() / motor.stall, EQUATIONS);
        }
        let begun = motor.run(0.8, &start, 0.0);
        assert_eq!((begun.phi, begun.speed), (0.4, 15.0));
    }
}

const DISK: Disk = Disk { mass: 5.0, natural: 50.0, damping: 0.05, eccentricity: 1e-3 };

/// Speeds after a run-up through the whole equations, relative [1]: measured 3.0e-12.
const SETTLED: f64 = 1e-11;

#[test]
fn exact_run_up_hangs_and_passes_where_the_balance_says() {
    let [threshold, _] = DISK.threshold(100.0);
    for (share, hangs) in [(0.9, true), (0.98, true), (1.1, false)] {
        let motor = Motor { inertia: 0.15, stall: share * threshold, synchronous: 100.0, lag: 0.0 };
        let stiffness = DISK.mass * DISK.natural * DISK.natural;
        let damping = 2.0 * DISK.damping * DISK.natural * DISK.mass;
        // y, z, their rates, φ and its rate, about the mass centre at z + ε e^(iφ).
        let rates = |_: f64, [y, z, vy, vz, phi, speed]: &[f64; 6]| {
            let (c, s) = (libm::cos(*phi), libm::sin(*phi));
            let force = [-stiffness * y - damping * vy, -stiffness * z - damping * vz];
            let moment = -DISK.eccentricity * (c * force[1] - s * force[0]);
            let gained = (motor.steady(1.0, *speed) + moment) / motor.inertia;
            let pushed = |along: f64, across: f64| DISK.eccentricity * (speed * speed * along + gained * across);
            let acceleration = [force[0] / DISK.mass + pushed(c, s), force[1] / DISK.mass + pushed(s, -c)];
            [*vy, *vz, acceleration[0], acceleration[1], *speed, gained]
        };
        let end = steps(rates, 0.0, &[0.0, 0.0, 0.0, 0.0, 0.0, 40.0], 1500.0, 75_000);
        let expected = if hangs { DISK.hangs_at(&motor) } else { DISK.runs_at(&motor) };
        within(&format!("{share} of the threshold: {expected}"), (end[5] / expected - 1.0).abs(), SETTLED);
        assert_eq!(expected < DISK.natural * 1.1, hangs);
    }
}
