//! The picture: the larger half axes of the orbits above, how far y lags behind the rotor's mark below, over the spin.

use crate::chart::{self, Area, Axes, Drawn};
use anyhow::Result;
use plotters::prelude::*;
use split_rotor_model::periodic::Orbit;
use split_rotor_tools::response::{Found, Linear, Point, lag, nonlinear};
use std::ops::Range;

const COLOURS: [RGBColor; 6] = [
    chart::BLUE,
    chart::ORANGE,
    RGBColor(40, 160, 90),
    RGBColor(150, 110, 200),
    RGBColor(190, 150, 20),
    RGBColor(200, 60, 120),
];

/// The lowest line lies so much below the highest peak at most \[1].
const DECADES: f64 = 1e-4;

/// As SVG.
pub fn svg(found: &Found) -> Result<String> {
    chart::two(|above| sizes(found, above), |below| phases(found, below))
}

fn speeds(found: &Found) -> Range<f64> {
    found.speeds[0]..found.speeds[found.speeds.len() - 1]
}

/// A station's values of the motions by the laws as they stand, in parts that all last or all do not.
fn nonlinear<'f>(
    found: &'f Found,
    value: impl Fn(&Orbit) -> (f64, f64) + 'f,
) -> impl Iterator<Item = (bool, Vec<(f64, f64)>)> + 'f {
    let parts = nonlinear::of(found).flat_map(nonlinear::alike);
    parts.map(move |part| (part[0].loss().is_none(), part.iter().map(&value).collect()))
}

fn colour(number: usize) -> RGBColor {
    COLOURS[number % COLOURS.len()]
}

fn sizes(found: &Found, area: &Area) -> Drawn {
    // The peaks too, which the speeds may pass over.
    let line = |number: usize| {
        let of = |linear: &Linear| {
            let Linear { points, peaks } = linear;
            let mut all: Vec<_> = points.iter().chain(peaks[number].iter().map(|peak| &peak.point)).collect();
            all.sort_by(|a: &&Point, b| a.speed.total_cmp(&b.speed));
            let size = |point: &Point| (point.speed, 1e6 * point.size(&found.stations[number]));
            all.into_iter().map(size).collect::<Vec<_>>()
        };
        found.linear.as_ref().map_or_else(|_| Vec::new(), of)
    };
    let exact = |number: usize| {
        let station = &found.stations[number];
        nonlinear(found, |orbit| (orbit.speed, 1e6 * orbit.path(station.position).once.major()))
    };
    let numbers = || 0..found.stations.len();
    let all = || numbers().flat_map(|number| line(number).into_iter().chain(exact(number).flat_map(|(_, part)| part)));
    let sizes = || all().map(|(_, size)| size).filter(|size| size.is_finite());
    let most = sizes().fold(0.0, f64::max);
    let least = sizes().filter(|size| *size > 0.0).fold(most, f64::min).max(DECADES * most);
    // Whole decades, or there would be none with a number.
    let [from, to] =
        [libm::floor(libm::log10(least)), libm::ceil(libm::log10(1.01 * most))].map(|power| libm::pow(10.0, power));
    let mut axes = chart::axes(area, &found.scene.title, speeds(found), (from..to).log_scale(), "half axis [µm]")?;
    for (number, station) in found.stations.iter().enumerate() {
        // A line ends at what has no bound.
        for part in line(number).split(|(_, size)| !(from..=to).contains(size)) {
            axes.draw_series(LineSeries::new(part.iter().copied(), colour(number).stroke_width(1)))?;
        }
        for (lasts, part) in exact(number) {
            draw(&mut axes, part, lasts, number)?;
        }
        axes.draw_series(LineSeries::new([(0.0, from); 0], colour(number)))?
            .label(station.title())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour(number).stroke_width(3)));
    }
    if found.nonlinear.is_some() {
        for (name, width, gap) in [("linear", 1, 0), ("by the laws as they stand", 3, 0), ("does not last", 3, 6)] {
            let dash = move |from, to| PathElement::new([(from, 0), (to, 0)], chart::INK.stroke_width(width));
            axes.draw_series(LineSeries::new([(0.0, from); 0], chart::INK))?
                .label(name)
                .legend(move |at| EmptyElement::at(at) + dash(0, 11 - gap / 2) + dash(11 + gap / 2, 22));
        }
    }
    chart::legend(&mut axes)
}

/// A part of a line of the nonlinear response: broken where the motions do not last.
fn draw<Y: Ranged<ValueType = f64>>(axes: &mut Axes<Y>, part: Vec<(f64, f64)>, lasts: bool, number: usize) -> Drawn {
    if lasts {
        axes.draw_series(LineSeries::new(part, colour(number).stroke_width(3)))?;
    } else {
        axes.draw_series(DashedLineSeries::new(part, 6, 4, colour(number).stroke_width(3)))?;
    }
    Ok(())
}

fn phases(found: &Found, area: &Area) -> Drawn {
    let mut axes = chart::axes(area, "", speeds(found), -180.0..180.0, "y behind the mark [°]")?;
    for (number, station) in found.stations.iter().enumerate() {
        let behind = |point: &Point| Some((point.speed, lag(point.speed, &point.orbit(station)?)));
        let points = found.linear.iter().flat_map(|linear| &linear.points);
        let points: Vec<_> = points.filter(|point| point.speed != 0.0).filter_map(behind).collect();
        for part in unwrapped(&points) {
            axes.draw_series(LineSeries::new(part.iter().copied(), colour(number).stroke_width(1)))?;
        }
        let behind = |orbit: &Orbit| (orbit.speed, lag(orbit.speed, &orbit.path(station.position).once));
        for (lasts, points) in nonlinear(found, behind) {
            for part in unwrapped(&points) {
                draw(&mut axes, part.to_vec(), lasts, number)?;
            }
        }
    }
    Ok(())
}

/// A line does not go across where the angle begins anew.
fn unwrapped(points: &[(f64, f64)]) -> impl Iterator<Item = &[(f64, f64)]> {
    points.chunk_by(|a, b| (a.1 - b.1).abs() < 180.0)
}
