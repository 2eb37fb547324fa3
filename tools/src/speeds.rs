//! The speeds at which a machine is looked at.

use crate::numbers::rounded;
use crate::{run, scenes};
use anyhow::{Result, ensure};
use split_rotor_model::effects::Info;
use split_rotor_model::linear::{Machine, Obstacle};
use split_rotor_model::scene::Scene;

/// So much higher than the scene goes one looks \[1].
const HIGHER: f64 = 1.5;

/// A speed below this part of the lowest whirl's frequency at rest says nothing of where the rotor will run \[1].
const SMALL: f64 = 0.1;

/// Modes whose frequency is less than this part of the highest do not swing \[1].
const STILL: f64 = 1e-6;

/// Effects whose torque brings a rotor to speeds that no parameter tells.
const DRIVES: [&str; 2] = ["drive", "motor"];

/// No rotor turns faster [rad/s].
pub const HIGHEST: f64 = 1e9;

/// So many speeds [rad/s] from the first of these to the second, and 0 and the nodes of tables where they lie between; where none are given, from 0 to beyond what the scene reaches.
pub fn range(scene: &Scene, machine: Option<&Machine>, ends: Option<[f64; 2]>, steps: u32) -> Result<Vec<f64>> {
    grid(scene, ends, steps, || highest(scene, machine).map(f64::abs))
}

/// The same, on that side of 0 on which the scene runs: loads that depend on the spin's sign are not alike on both.
pub fn on_its_side(scene: &Scene, machine: Option<&Machine>, ends: Option<[f64; 2]>, steps: u32) -> Result<Vec<f64>> {
    grid(scene, ends, steps, || highest(scene, machine))
}

/// Which speeds were looked at, in words: a line of a table.
pub fn told(speeds: &[f64]) -> String {
    let [first, last] = [speeds[0], speeds[speeds.len() - 1]].map(rounded);
    format!(
        "Looked at {} speeds from {first} to {last} rad/s (--speeds FROM TO and --steps set others).\n\n",
        speeds.len()
    )
}

/// So many speeds [rad/s] between these, or between 0 and beyond the one that is reached.
fn grid(
    scene: &Scene,
    ends: Option<[f64; 2]>,
    steps: u32,
    reached: impl FnOnce() -> Result<f64, Obstacle>,
) -> Result<Vec<f64>> {
    ensure!(steps >= 2, "steps {steps}: at least 2 speeds are needed");
    let [from, to] = match ends {
        Some(ends) => ends,
        None => {
            let beyond = HIGHER * reached()?;
            [beyond.min(0.0), beyond.max(0.0)]
        }
    };
    ensure!(
        from.abs() <= HIGHEST && to.abs() <= HIGHEST && from < to,
        "speeds {from} {to}: the second must be more than the first, both within ±{HIGHEST:e} rad/s"
    );
    let even = (0..steps - 1).map(|n| from + (to - from) * f64::from(n) / f64::from(steps - 1));
    // Modes at ω and −ω are alike, the lines of the speed's multiples bend at 0, and coefficients bend at the nodes of their tables.
    let bends = nodes(scene).flat_map(|node| [node, -node]).chain([0.0]);
    // The last one to its last bit: no speed beyond 0 belongs to a rotor that runs the other way round.
    let mut speeds: Vec<_> = even.chain([to]).chain(bends.filter(|bend| (from..to).contains(bend))).collect();
    speeds.sort_by(f64::total_cmp);
    // 0 and −0 are one speed.
    speeds.dedup_by(|a, b| a == b);
    Ok(speeds)
}

/// The speed of the largest size [rad/s] that a scene tells: of its start, its drive or its tables, or to which a torque or its inputs bring it;
/// its fastest mode's at rest, where it tells none, or only one that is small beside its lowest mode.
fn highest(scene: &Scene, machine: Option<&Machine>) -> Result<f64, Obstacle> {
    let told = scenes::values(scene);
    let value = |name: &str| told(name).unwrap_or_default();
    let imposed = value("imposed_speed.w");
    let last = imposed + value("imposed_speed.a") * scene.experiment.stop;
    let is_driven = |(info, _): &(&Info, u32)| DRIVES.contains(&info.name);
    let is_run = !scene.inputs.is_empty() || scene.effects.iter().any(is_driven);
    let reached = if is_run { run::fastest(scene) } else { 0.0 };
    let told = [imposed, last, reached, value("start.omega.x"), value("motor.synchronous_speed")];
    let reached = told.into_iter().fold(0.0_f64, |most, speed| if speed.abs() > most.abs() { speed } else { most });
    // Tables are of the size of the speed.
    let highest = nodes(scene).fold(reached.abs(), f64::max);
    let at_rest = |machine: &Machine| {
        let (_, modes) = machine.modes(0.0, None)?;
        let swings = || modes.iter().map(|mode| mode.eigenvalue.im);
        let fastest = swings().fold(0.0, f64::max);
        Ok([swings().filter(|swing| *swing > STILL * fastest).fold(f64::INFINITY, f64::min), fastest])
    };
    let swings = match machine {
        Some(machine) => at_rest(machine),
        None => Machine::with_mean_inertia(&scene.parameters()).and_then(|mean| at_rest(&mean)),
    };
    match swings {
        // Where it does not stand still there are no modes to compare with.
        Err(_) if highest > 0.0 => Ok(highest.copysign(reached)),
        Err(obstacle) => Err(obstacle),
        Ok([_, 0.0]) if highest > 0.0 => Ok(highest.copysign(reached)),
        Ok([_, 0.0]) => Ok(1.0),
        Ok([lowest, fastest]) if highest < SMALL * lowest => Ok(fastest),
        Ok(_) => Ok(highest.copysign(reached)),
    }
}

/// The speeds [rad/s] of the nodes of its tables.
fn nodes(scene: &Scene) -> impl Iterator<Item = f64> {
    let nodes = scene.variables.iter().filter(|variable| variable.name.contains(".speed["));
    let value = scenes::values(scene);
    nodes.filter_map(move |node| value(&node.name))
}

#[cfg(test)]
mod tests {
    use super::{grid, on_its_side};
    use crate::scenes::find;
    use split_rotor_model::linear::Machine;
    use split_rotor_model::scene::Scene;
    use std::path::Path;

    #[test]
    fn exact_a_range_ends_where_it_is_asked_to() {
        let scene = find("paper");
        for speed in [-942.477_796_076_937_9, -942.5, -235.619_449_019_234_5] {
            let speeds = grid(&scene, None, 201, || Ok(speed)).expect("speeds");
            assert_eq!([speeds[0], speeds[speeds.len() - 1]], [1.5 * speed, 0.0]);
            assert_eq!(speeds.len(), 201);
        }
    }

    /// √(2k/m) across is the fastest swing at rest: m = 2 kg on 2 · 1e6 N/m, and √(Σ k p²/Jt) of the tilt.
    #[test]
    fn regress_a_speed_that_is_small_beside_the_modes_sets_no_range() {
        let bearing = |x: &str| format!("[[effects.bearing]]\nposition = {x}\nkyy = 1e6\nkzz = 1e6\n");
        let machine = |start: &str| {
            let text = format!("[rotor]\nm = 2.0\nJa = 1e-3\nJt = 0.04\n{start}{}{}", bearing("0.1"), bearing("-0.1"));
            Scene::parse(Path::new("host.toml"), &text).expect("a scene")
        };
        let fastest = 1e3_f64;
        for (start, expected) in [
            ("", [0.0, 1.5 * fastest]),
            ("[start]\nomega.x = -0.04\n", [0.0, 1.5 * fastest]),
            ("[start]\nomega.x = 60.0\n", [0.0, 1.5 * fastest]),
            ("[start]\nomega.x = 200.0\n", [0.0, 300.0]),
            ("[start]\nomega.x = -200.0\n", [-300.0, 0.0]),
        ] {
            let scene = machine(start);
            let of = Machine::of(&scene.parameters()).expect("a machine");
            let speeds = on_its_side(&scene, Some(&of), None, 11).expect("speeds");
            for (found, exact) in [speeds[0], speeds[speeds.len() - 1]].iter().zip(expected) {
                assert!((found - exact).abs() < 1e-9 * fastest, "{start}: {found} {exact}");
            }
        }
    }
}
