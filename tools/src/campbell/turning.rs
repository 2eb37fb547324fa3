//! A body that is not symmetric about its axis: its equations change as it turns, so it has no modes of constant frequency. What small
//! motions are multiplied by in a revolution (Floquet) tells how they grow, and their frequencies but for whole multiples of the spin.

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

/// A range in which motions grow is narrowed down so often: its ends are found to 1e-6 of a step.
const NARROWED: u32 = 20;

/// What was found, by speed.
pub struct Turning<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// A motion that repeats with each revolution, at each speed.
    pub orbits: Vec<Orbit>,
    /// At so many speeds none was found.
    missed: u32,
    /// Where motions begin or cease to grow [rad/s].
    thresholds: Vec<f64>,
}

impl<'s> Turning<'s> {
    /// Of a scene, between these speeds [rad/s], at so many of them.
    pub(super) fn of(scene: &'s Scene, ends: Option<&[f64]>, steps: u32) -> Result<Self> {
        let file = || scene.file.display().to_string();
        let all = speeds::on_its_side(scene, None, ends, steps).with_context(file)?;
        let fastest = all.iter().map(|speed| speed.abs()).fold(0.0, f64::max);
        let rotating = Rotating::of(&balanced(&scene.parameters())).with_context(file)?;
        let (mut orbits, mut missed): (Vec<Orbit>, u32) = (Vec::new(), 0);
        for speed in all.into_iter().filter(|speed| speed.abs() >= LOWEST * fastest) {
            match rotating.orbit(speed, orbits.last()) {
                Ok(orbit) => orbits.push(orbit),
                Err(_) => missed += 1,
            }
        }
        if orbits.is_empty() {
            bail!("{}: at none of these speeds a motion was found that repeats with each revolution", file());
        }
        let changes = orbits.windows(2).filter(|pair| pair[0].loss().is_some() != pair[1].loss().is_some());
        let thresholds = changes.map(|pair| threshold(&rotating, pair)).collect::<Result<_, _>>().with_context(file)?;
        Ok(Self { scene, orbits, missed, thresholds })
    }

    /// All of it.
    pub(super) fn json(&self) -> Value {
        json!({
            "scene": self.scene.name,
            "title": self.scene.title,
            "floquet": true,
            "thresholds": self.thresholds,
            "tables": doubts::tables(self.scene),
            "growing": self.orbits.iter().filter(|orbit| orbit.loss().is_some()).map(|orbit| orbit.speed).collect::<Vec<_>>(),
            "modes": rows::objects(self.rows()),
        })
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

    /// For people, in Markdown.
    pub(super) fn table(&self) -> String {
        let mut text = format!("{}: {}\n\n", self.scene.name, self.scene.title);
        text += "The body is not symmetric about its axis, so its equations change as it turns (Floquet): growth of small motions beside those that \
                 repeat with each revolution, balanced, drives off, the spin imposed. Frequencies count but for whole multiples of the spin.\n\n";
        for threshold in &self.thresholds {
            let before = self.orbits.iter().rfind(|orbit| orbit.speed < *threshold);
            let ceases = before.is_some_and(|orbit| orbit.loss().is_some());
            let (verb, at) = (if ceases { "cease" } else { "begin" }, rounded(*threshold));
            text += &format!("Small motions {verb} to grow at {at} rad/s ({} rpm).\n", rounded(rpm(*threshold)));
        }
        if self.missed > 0 {
            text += &format!(
                "At {} of the speeds no motion was found that repeats with each revolution; they are left out.\n",
                self.missed
            );
        }
        let [first, last] = [0, self.orbits.len() - 1].map(|n| self.orbits[n].speed);
        match self.orbits.iter().filter(|orbit| orbit.loss().is_some()).count() {
            0 => text += &format!("None grows from {} to {} rad/s.\n", rounded(first), rounded(last)),
            count if count == self.orbits.len() => text += "They grow at all these speeds.\n",
            _ => {}
        }
        text += "\n| speed [rad/s] | fastest growth [1/s] | its frequency [rad/s] | multiplier |\n|--:|--:|--:|--:|\n";
        for orbit in spread(self.orbits.len(), 2 * SHOWN).map(|n| &self.orbits[n]) {
            let [growth, frequency] = exponents(orbit).first().map_or([0.0; 2], |first| [first.re, first.im]);
            let largest = rounded(orbit.largest_multiplier());
            text +=
                &format!("| {} | {} | {} | {largest} |\n", rounded(orbit.speed), rounded(growth), rounded(frequency));
        }
        let speeds: Vec<_> = self.orbits.iter().map(|orbit| orbit.speed).collect();
        let below = doubts::words(self.scene, &speeds);
        if below.is_empty() { text } else { text + "\n" + &below }
    }
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
}
