//! A body that is not symmetric about its axis: its equations change as it turns, so it has no modes of constant frequency. What small
//! motions are multiplied by in a revolution (Floquet) tells how they grow, and their frequencies but for whole multiples of the spin.

use super::sums;
use crate::numbers::{SHOWN, rounded, rpm, spread};
use crate::{doubts, rows, speeds};
use anyhow::{Context, Result, bail};
use nalgebra::{Complex, ComplexField};
use serde_json::{Value, json};
use split_rotor_model::linear::balanced;
use split_rotor_model::periodic::{Obstacle, Orbit, Rotating};
use split_rotor_model::scene::Scene;

/// Below this part of the highest speed no revolution is looked at: it lasts long \[1].
const LOWEST: f64 = 0.05;

/// About a speed at which two whirl frequencies add up to twice the spin, growth is looked at at so many speeds on each side, at most so far
/// away, over the part of the speed by which the moments of inertia differ \[1]; then so often at half the distance.
const BESIDE: u32 = 4;
const WIDE: f64 = 0.5;

/// A range in which motions grow is narrowed down so often: its ends are found to 1e-6 of a step.
const NARROWED: u32 = 20;

/// What was found, by speed.
pub struct Turning<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// A motion that repeats with each revolution, at each speed.
    pub orbits: Vec<Orbit>,
    /// Why none was found, at the other speeds.
    missed: Vec<Obstacle>,
    /// Speeds that were looked at besides, about those at which two whirl frequencies add up to twice the spin [rad/s].
    sums: Vec<f64>,
    /// Why those were not found.
    no_sums: Option<String>,
    /// The largest distance of speeds that were asked for [rad/s].
    apart: f64,
    /// Where motions begin or cease to grow [rad/s].
    thresholds: Vec<f64>,
}

impl<'s> Turning<'s> {
    /// Of a scene, between these speeds [rad/s], at so many of them.
    pub(super) fn of(scene: &'s Scene, ends: Option<[f64; 2]>, steps: u32) -> Result<Self> {
        let file = || scene.file.display().to_string();
        let all = speeds::on_its_side(scene, None, ends, steps).with_context(file)?;
        let fastest = all.iter().map(|speed| speed.abs()).fold(0.0, f64::max);
        let rotating = Rotating::of(&balanced(&scene.parameters())).with_context(file)?;
        let (mut orbits, mut missed): (Vec<Orbit>, Vec<Obstacle>) = (Vec::new(), Vec::new());
        let all: Vec<_> = all.into_iter().filter(|speed| speed.abs() >= LOWEST * fastest).collect();
        for speed in &all {
            match rotating.orbit(*speed, orbits.last()) {
                Ok(orbit) => orbits.push(orbit),
                Err(obstacle) => missed.push(obstacle),
            }
        }
        if orbits.is_empty() {
            missed.sort_by_key(|obstacle| !is_growth(obstacle));
            let why = missed.first().map_or_else(String::new, |obstacle| format!(": {obstacle}"));
            bail!("{}: at none of these speeds a motion was found that repeats with each revolution{why}", file());
        }
        let apart = all.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let (sums, no_sums) = match sums::speeds(scene, [all[0], all[all.len() - 1]], LOWEST * fastest) {
            Ok(sums) => (sums, None),
            Err(obstacle) => (Vec::new(), Some(obstacle.to_string())),
        };
        for sum in &sums {
            let far = (WIDE * part_apart(scene) * sum.abs()).min(0.5 * apart);
            match beside_a_sum(&rotating, &orbits, *sum, far) {
                Ok(found) => orbits.extend(found),
                Err(obstacle) => missed.push(obstacle),
            }
        }
        orbits.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        orbits.dedup_by(|a, b| a.speed == b.speed);
        let changes = orbits.windows(2).filter(|pair| pair[0].loss().is_some() != pair[1].loss().is_some());
        let thresholds: Vec<_> =
            changes.map(|pair| threshold(&rotating, pair)).collect::<Result<_, _>>().with_context(file)?;
        // In the middle of a band motions grow fastest.
        for ends in thresholds.windows(2) {
            let within = before(&orbits, ends[1]).filter(|orbit| orbit.loss().is_some());
            match within.map(|near| rotating.orbit(0.5 * (ends[0] + ends[1]), Some(near))) {
                Some(Ok(orbit)) => orbits.push(orbit),
                Some(Err(obstacle)) => missed.push(obstacle),
                None => {}
            }
        }
        orbits.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(Self { scene, orbits, missed, sums, no_sums, apart, thresholds })
    }

    /// All of it.
    pub(super) fn json(&self) -> Value {
        json!({
            "scene": self.scene.name,
            "title": self.scene.title,
            "floquet": true,
            "not_found": self.missed.iter().map(Obstacle::to_string).collect::<Vec<_>>(),
            "looked_closer_at": self.sums,
            "thresholds": self.thresholds,
            "tables": doubts::tables(self.scene),
            "growing": self.growing(),
            "modes": rows::objects(self.rows()),
        })
    }

    /// The speeds at which motions grow [rad/s], those included at which no revolution can be followed.
    fn growing(&self) -> Vec<f64> {
        let found = self.orbits.iter().filter(|orbit| orbit.loss().is_some()).map(|orbit| orbit.speed);
        let missed = self.missed.iter().filter_map(|obstacle| match obstacle {
            Obstacle::Grows { speed, .. } => Some(*speed),
            _ => None,
        });
        let mut all: Vec<_> = found.chain(missed).collect();
        all.sort_by(f64::total_cmp);
        all
    }

    /// A row for each exponent at each speed, with the columns of a symmetric body.
    pub(super) fn rows(&self) -> Vec<rows::Row> {
        let all = self.orbits.iter().flat_map(|orbit| {
            exponents(orbit).into_iter().enumerate().map(move |(number, exponent)| (orbit.speed, number, exponent))
        });
        let row = |(speed, number, exponent): (f64, usize, Complex<f64>)| {
            vec![
                ("speed_rad_s", json!(speed)),
                ("mode", json!(number + 1)),
                ("frequency_rad_s", json!(exponent.im)),
                ("damping_ratio", json!(-exponent.re / exponent.modulus())),
                ("direction", json!("floquet")),
                ("growth_rate_1_s", json!(exponent.re)),
            ]
        };
        all.map(row).collect()
    }

    /// Which speeds were looked at, in words.
    fn looked_at(&self) -> String {
        let [first, last] = [0, self.orbits.len() - 1].map(|n| rounded(self.orbits[n].speed));
        let mut text = format!(
            "Looked at: {} speeds from {first} to {last} rad/s, at most {} rad/s apart",
            self.orbits.len(),
            rounded(self.apart)
        );
        match (&self.no_sums, &self.sums[..]) {
            (Some(obstacle), _) => {
                text += &format!("; where two whirl frequencies add up to twice the spin is not known: {obstacle}")
            }
            (None, []) => text += "; no two whirl frequencies add up to twice the spin there",
            (None, sums) => {
                let sums: Vec<_> = sums.iter().map(|speed| rounded(*speed)).collect();
                text += &format!(
                    ", and closer where two whirl frequencies add up to twice the spin: {} rad/s",
                    sums.join(", ")
                );
            }
        }
        text + ". Elsewhere a band narrower than the distance of the speeds would not be seen (--steps).\n"
    }

    /// Some of the motions from the first to the last, and of each band in which they grow the one beside which they grow fastest.
    fn shown(&self) -> impl Iterator<Item = &Orbit> {
        let bands = self.orbits.chunk_by(|a, b| a.loss().is_some() == b.loss().is_some());
        let growing = bands.filter(|band| band[0].loss().is_some());
        let fastest = growing.filter_map(|band| band.iter().max_by(|a, b| fastest(a)[0].total_cmp(&fastest(b)[0])));
        let mut all: Vec<_> = spread(self.orbits.len(), 2 * SHOWN).map(|n| &self.orbits[n]).chain(fastest).collect();
        all.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        all.dedup_by(|a, b| a.speed == b.speed);
        all.into_iter()
    }

    /// For people, in Markdown.
    pub(super) fn table(&self) -> String {
        let mut text = format!("{}: {}\n\n", self.scene.name, self.scene.title);
        text += &self.looked_at();
        text += "\nThe body is not symmetric about its axis, so its equations change as it turns (Floquet): growth of small motions beside those that \
                 repeat with each revolution, balanced, drives off, the spin imposed. Frequencies count but for whole multiples of the spin.\n\n";
        for threshold in &self.thresholds {
            let ceases = before(&self.orbits, *threshold).is_some_and(|orbit| orbit.loss().is_some());
            let (verb, at) = (if ceases { "cease" } else { "begin" }, doubts::marked(self.scene, *threshold));
            text += &format!("Small motions {verb} to grow at {at} rad/s ({} rpm).\n", rounded(rpm(*threshold)));
        }
        let (leave, missed): (Vec<_>, Vec<_>) = self.missed.iter().partition(|obstacle| is_growth(obstacle));
        if let Some(obstacle) = leave.first() {
            text += &format!(
                "At {} of the speeds they grow so fast that no revolution can be followed; these have no row below. The first: {obstacle}.\n",
                leave.len()
            );
        }
        if let Some(obstacle) = missed.first() {
            text += &format!(
                "At {} of the speeds nothing is known of small motions; they are left out. The first: {obstacle}.\n",
                missed.len()
            );
        }
        match self.orbits.iter().filter(|orbit| orbit.loss().is_some()).count() {
            0 if !leave.is_empty() => {}
            0 => text += "None grows at any speed that was looked at.\n",
            count if count == self.orbits.len() => text += "They grow at all speeds that were looked at.\n",
            _ => {}
        }
        text += "\n| speed [rad/s] | fastest growth [1/s] | its frequency [rad/s] | multiplier |\n|--:|--:|--:|--:|\n";
        for orbit in self.shown() {
            let [growth, frequency] = fastest(orbit);
            let largest = rounded(orbit.largest_multiplier());
            text += &format!(
                "| {} | {} | {} | {largest} |\n",
                doubts::marked(self.scene, orbit.speed),
                rounded(growth),
                rounded(frequency)
            );
        }
        let speeds: Vec<_> = self.orbits.iter().map(|orbit| orbit.speed).collect();
        doubts::below(text, self.scene, &speeds)
    }
}

/// The last motion below a speed [rad/s].
fn before(orbits: &[Orbit], speed: f64) -> Option<&Orbit> {
    orbits.iter().rfind(|orbit| orbit.speed < speed)
}

/// The fastest growth \[1/s] beside a motion, and its frequency [rad/s].
fn fastest(orbit: &Orbit) -> [f64; 2] {
    exponents(orbit).first().map_or([0.0; 2], |first| [first.re, first.im])
}

fn is_growth(obstacle: &Obstacle) -> bool {
    matches!(obstacle, Obstacle::Grows { .. })
}

/// By which part of their sum the transverse moments of inertia of the balanced body differ \[1].
fn part_apart(scene: &Scene) -> f64 {
    let body = balanced(&scene.parameters()).shape().inertia();
    let excess = body.asymmetric.map_or(0.0, |asymmetric| asymmetric.excess.abs());
    excess / (2.0 * body.per_jt)
}

/// The motion at a speed [rad/s] at which two whirl frequencies add up to twice the spin, and where that does not grow, the one that grows
/// fastest up to so far [rad/s] from it: the body's asymmetry shifts the band a little.
fn beside_a_sum(rotating: &Rotating, known: &[Orbit], sum: f64, far: f64) -> Result<Vec<Orbit>, Obstacle> {
    let near = known.iter().min_by(|a, b| (a.speed - sum).abs().total_cmp(&(b.speed - sum).abs()));
    let at = |speed: f64| rotating.orbit(speed, near);
    let mut found = vec![at(sum)?];
    if far <= 0.0 {
        return Ok(found);
    }
    let steps = (1..=BESIDE).flat_map(|n| [1.0, -1.0].map(|side| side * far * f64::from(n) / f64::from(BESIDE)));
    for step in steps {
        if found.iter().any(|orbit| orbit.loss().is_some()) {
            return Ok(found);
        }
        found.push(at(sum + step)?);
    }
    // Between them, beside that which comes nearest to growth.
    let growth = |orbit: &Orbit| fastest(orbit)[0];
    let mut step = far / f64::from(BESIDE);
    for _ in 0..BESIDE {
        step *= 0.5;
        let highest = found.iter().max_by(|a, b| growth(a).total_cmp(&growth(b))).map_or(sum, |orbit| orbit.speed);
        for speed in [highest - step, highest + step] {
            found.push(at(speed)?);
            if found[found.len() - 1].loss().is_some() {
                return Ok(found);
            }
        }
    }
    Ok(found)
}

/// Where motions begin or cease to grow between two speeds, by bisection.
fn threshold(rotating: &Rotating, pair: &[Orbit]) -> Result<f64, Obstacle> {
    let (mut from, mut to) = (pair[0].clone(), pair[1].clone());
    for _ in 0..NARROWED {
        let between = rotating.orbit(0.5 * (from.speed + to.speed), Some(&from))?;
        if between.loss().is_some() == from.loss().is_some() {
            from = between;
        } else {
            to = between;
        }
    }
    Ok(0.5 * (from.speed + to.speed))
}

/// The exponents that count once, the fastest growth first.
pub fn exponents(orbit: &Orbit) -> Vec<Complex<f64>> {
    let mut all: Vec<_> = orbit.exponents().into_iter().filter(|exponent| exponent.im >= 0.0).collect();
    all.sort_by(|a, b| b.re.total_cmp(&a.re));
    all
}

#[cfg(test)]
mod tests {
    use super::Turning;
    use split_rotor_model::scene::Scene;
    use std::path::Path;

    /// Two equal bearings at ±0.1 m: in the frame of the body the stiffness against tilt, 2·10⁵ N·m/rad, is less than (Jt2 − Ja) Ω²
    /// beyond the one speed, and less than (Jt − Ja) Ω² beyond the other; between them the axis leaves.
    #[test]
    fn exact_an_asymmetric_body_at_rest_is_looked_at_where_it_will_whirl() {
        let bearing = |x: &str| format!("[[effects.bearing]]\nposition = {x}\nkyy = 1e7\nkzz = 1e7\n");
        let rotor = "[rotor]\nm = 10.0\nJa = 0.05\nJt = 0.1\n[effects.asymmetry]\nJt2 = 0.13\n";
        let text = format!("{rotor}{}{}", bearing("0.1"), bearing("-0.1"));
        let scene = Scene::parse(Path::new("plate.toml"), &text).expect("a scene");
        let turning = Turning::of(&scene, None, 41).expect("motions that repeat");
        let exact = [(2e5_f64 / 0.08).sqrt(), (2e5_f64 / 0.05).sqrt()];
        assert_eq!(turning.thresholds.len(), 2, "{:?}", turning.thresholds);
        for (found, exact) in turning.thresholds.iter().zip(exact) {
            assert!((found - exact).abs() < 1e-5 * exact, "{found} {exact}");
        }
    }

    /// A spring that pushes away, by a factor of e in 3 ms: in a revolution by 1e9 at 100 rad/s, and by more the slower it turns. The search
    /// for motions that repeat followed the rotor to wherever it had gone, for more than 600 s.
    #[test]
    fn regress_a_body_that_leaves_within_a_revolution_grows() {
        let text = "[rotor]\nm = 6.0\nJa = 0.01\nJt = 0.06\n[start]\nomega.x = 100.0\nr_c.y = 20e-6\n[effects.asymmetry]\nJt2 = 0.0601\n\
            [[effects.bearing]]\nposition = 0.15\nkyy = -2e5\nkzz = -2e5\n";
        let scene = Scene::parse(Path::new("leaves.toml"), text).expect("a scene");
        for (ends, steps) in [([80.0, 120.0], 3), ([5.0, 500.0], 12)] {
            let turning = Turning::of(&scene, Some(ends), steps).expect("a view");
            let table = turning.table();
            assert!(!table.contains("None grows") && table.contains("They grow at all speeds"), "{table}");
            let found = turning.orbits.iter().find(|orbit| orbit.speed > 119.0).expect("it is found");
            assert!((super::exponents(found)[0].re / 329.0 - 1.0).abs() < 0.01, "{table}");
            let all = turning.orbits.len() + turning.missed.len();
            assert_eq!(turning.json()["growing"].as_array().map(Vec::len), Some(all), "{table}");
        }
        // Where all of them leave.
        let why = Turning::of(&scene, Some([5.0, 8.0]), 3).map(|_| ()).expect_err("no motion is found").to_string();
        assert!(why.contains("small motions grow"), "{why}");
    }

    /// It grows between these speeds [rad/s]: multipliers of the linear equations of place and tilt, written once more and integrated by another
    /// program (SciPy's DOP853 at 1e-11). The speeds that are asked for are 14 rad/s apart, and one of them lies near.
    const BAND: [f64; 2] = [377.908_473, 380.696_292];

    /// Of its ends [rad/s]: measured 2.3e-3. A multiplier counts from 1 + 1e-5 on.
    const BOUND: f64 = 5e-3;

    #[test]
    fn regress_a_band_between_two_speeds_is_found() {
        let text = "[rotor]\nm = 0.66179\nJa = 3.157e-4\nJt = 1.88504e-3\n[effects.asymmetry]\nJt2 = 2.01272e-3\n\
            [[effects.bearing]]\nposition = -0.04162\nkyy = 57202.0\nkzz = 52216.0\ncyy = 3.115\nczz = 2.843\nkxx = 51165.0\ncxx = 31.15\n\
            [[effects.bearing]]\nposition = 0.05674\nkyy = 54103.0\nkzz = 40284.0\ncyy = 3.753\nczz = 2.978\n";
        let scene = Scene::parse(Path::new("band.toml"), text).expect("a scene");
        let turning = Turning::of(&scene, Some([366.0, 394.0]), 3).expect("motions that repeat");
        let table = turning.table();
        assert!(!table.contains("None grows"), "{table}");
        assert_eq!(turning.thresholds.len(), 2, "{table}");
        for (found, exact) in turning.thresholds.iter().zip(BAND) {
            assert!((found - exact).abs() < BOUND, "{found} {exact}");
        }
        assert!(table.contains("closer where two whirl frequencies add up to twice the spin"), "{table}");
        // The growth inside it is shown, though it is narrower than the distance of the rows: fastest near its middle.
        let row = table.lines().find(|line| line.starts_with("| 379.")).expect("a row inside the band");
        let growth: f64 = row.split('|').nth(2).and_then(|number| number.trim().parse().ok()).expect("a number");
        assert!(growth > 0.0, "{table}");
        // Below the band there is a sum of frequencies too, or none; nothing is said of speeds at which nobody looked.
        let below = Turning::of(&scene, Some([300.0, 340.0]), 3).expect("motions that repeat").table();
        assert!(
            below.contains("None grows at any speed that was looked at")
                && below.contains("at most 20.0000 rad/s apart"),
            "{below}"
        );
    }
}
