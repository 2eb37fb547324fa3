//! The picture of a body that is not symmetric: frequencies above, growth below, over the spin.

use crate::chart;
use anyhow::Result;
use nalgebra::Complex;
use plotters::prelude::*;
use split_rotor_tools::campbell::{Turning, exponents};

/// More exponents than this beyond the fastest one that grows are not drawn \[1].
const DAMPED: f64 = 3.0;

/// As SVG.
pub fn svg(turning: &Turning) -> Result<String> {
    let [slow, fast] = [&turning.orbits[0], &turning.orbits[turning.orbits.len() - 1]].map(|orbit| orbit.speed);
    let points = || turning.orbits.iter().flat_map(|orbit| exponents(orbit).into_iter().map(|one| (orbit.speed, one)));
    let most = points().map(|(_, one)| one.re).fold(1e-3, f64::max);
    let least = points().map(|(_, one)| one.re).fold(0.0, f64::min).max(-DAMPED * most);
    let colour = |one: &Complex<f64>| if one.re > 1e-6 * most { chart::ORANGE } else { chart::BLUE };
    let top = points().map(|(_, one)| one.im).fold(1e-3, f64::max);
    chart::two(
        |above| {
            let name = "frequency but for multiples of the spin [rad/s]";
            let mut axes = chart::axes(above, &turning.scene.title, slow..fast, 0.0..1.05 * top, name)?;
            axes.draw_series(points().map(|(speed, one)| Circle::new((speed, one.im), 2, colour(&one).filled())))?;
            Ok(())
        },
        |below| {
            let mut axes = chart::axes(below, "", slow..fast, 1.1 * least..1.1 * most, "growth [1/s]")?;
            let seen = points().filter(|(_, one)| one.re >= 1.1 * least);
            axes.draw_series(seen.map(|(speed, one)| Circle::new((speed, one.re), 2, colour(&one).filled())))?;
            Ok(())
        },
    )
}
