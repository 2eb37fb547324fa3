//! φ over 10⁶ revolutions: its remainder is as good after the last as after the first, but for the integration itself.

use split_rotor_model::simulation::Simulation;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::Parameters;
use std::f64::consts::TAU;

/// Spin of a rotor that does nothing else, a power of two so that its turns are exact [rad/s].
const SPIN: f64 = 64.0;

/// Error of the remainder [rad] after 10⁶ turns, measured 2.4e-10: 4e-17 of the whole angle, less than the rounding of
/// the spin itself.
const REMAINDER: f64 = 5e-10;

#[test]
fn exact_remainder_after_a_million_turns() {
    let values = [
        (0, 0, 5.0),
        (0, 1, 0.15625),
        (0, 2, 0.078125),
        (0, 3, 0.75),
        (1, 9, SPIN),
        (2, 0, 3.0),
        (2, 1, 1e-8),
        (2, 9, 6.0),
        (2, 10, 1e7),
    ];
    let mut rotor =
        Simulation::<()>::from(Parameters::from_iter(values.map(|(block, row, value)| (Place { block, row }, value))));
    rotor.start(0.0, Some(1e-12)).unwrap();
    let mut worst = 0.0_f64;
    for i in 1..=1000 {
        // A time of few binary digits: 64 t is exact.
        let t = f64::from(i) * 98.0;
        rotor.advance(t).unwrap();
        let phi = rotor.read().unwrap().motion.angle();
        // 64 t less 2π·turns, with 2π in two parts.
        let turns = phi.turns;
        let high = f64::from_bits(TAU.to_bits() & (u64::MAX << 27));
        let exact = ((SPIN * t - turns * high) - turns * (TAU - high)) - turns * 2.449_293_598_294_706_4e-16;
        worst = worst.max((phi.remainder - exact).abs());
    }
    let reading = rotor.read().unwrap();
    println!("{} turns, {} steps, worst {worst:.2e} rad", reading.motion.angle().turns, reading.cost.steps);
    assert!(reading.motion.angle().turns > 998_000.0);
    assert!(worst <= REMAINDER);
}
