//! Where the frequencies of two whirls add up to twice the spin. A body that is not symmetric swaps energy between them there: its bands of
//! instability begin at such speeds, and may be narrower than the distance of the speeds that a user asks for.

use split_rotor_model::linear::{Branch, Campbell, Machine, Obstacle, Point};
use split_rotor_model::scene::Scene;

/// So many speeds at least are looked at for the sums: that takes no revolutions.
const STEPS: usize = 400;

/// Speeds that differ by less than this part are one \[1].
const EQUAL: f64 = 1e-6;

/// The speeds between these [rad/s] of at least the size `lowest`, by the modes of the body with the mean of both inertias.
///
/// # Errors
/// Where the modes of that body are not found.
pub fn speeds(scene: &Scene, [first, last]: [f64; 2], lowest: f64) -> Result<Vec<f64>, Obstacle> {
    // Both sides of 0 on their own: the frequencies bend there.
    let sides = [(first, last.min(-lowest)), (first.max(lowest), last)];
    let sides = sides.into_iter().filter(|(first, last)| first < last);
    let found = sides.map(|(first, last)| on_one_side(scene, first, last)).collect::<Result<Vec<_>, _>>()?;
    Ok(found.concat().into_iter().filter(|speed| speed.abs() >= lowest).collect())
}

/// The same between speeds of one sign, which ascend.
fn on_one_side(scene: &Scene, first: f64, last: f64) -> Result<Vec<f64>, Obstacle> {
    let machine = Machine::with_mean_inertia(&scene.parameters())?;
    let even: Vec<_> = (0..=STEPS).map(|n| first + (last - first) * n as f64 / STEPS as f64).collect();
    let campbell = Campbell::of(&machine, &even)?;
    let branches = &campbell.branches;
    let pairs = (0..branches.len()).flat_map(|a| (a..branches.len()).map(move |b| (a, b)));
    let mut found: Vec<_> = pairs.flat_map(|(a, b)| crossings(&branches[a], &branches[b])).collect();
    found.sort_by(f64::total_cmp);
    found.dedup_by(|a, b| (*a - *b).abs() <= EQUAL * a.abs());
    Ok(found)
}

/// Where the sum of both frequencies is twice the spin [rad/s], by straight lines between the speeds that both branches have.
fn crossings(a: &Branch, b: &Branch) -> Vec<f64> {
    let above = |one: &Point| {
        let other = b.at(one.speed)?;
        let [one_swings, other_swings] = [one, other].map(|point| point.mode.eigenvalue.im);
        let both = one_swings > 0.0 && other_swings > 0.0;
        both.then(|| (one.speed, one_swings + other_swings - 2.0 * one.speed.abs()))
    };
    let seen: Vec<_> = a.points.iter().filter_map(above).collect();
    let changes = seen.windows(2).filter(|pair| (pair[0].1 > 0.0) != (pair[1].1 > 0.0));
    changes.map(|pair| pair[0].0 - pair[0].1 * (pair[1].0 - pair[0].0) / (pair[1].1 - pair[0].1)).collect()
}
