//! The picture: the larger half axes of the orbits above, how far y lags behind the rotor's mark below, over the spin.

use super::{Found, Point, table};
use crate::chart::{self, Area, Drawn};
use anyhow::Result;
use plotters::prelude::*;
use std::ops::Range;

const COLOURS: [RGBColor; 6] = [
    RGBColor(31, 119, 210),
    RGBColor(220, 90, 30),
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
    found.points[0].speed..found.points[found.points.len() - 1].speed
}

fn colour(number: usize) -> RGBColor {
    COLOURS[number % COLOURS.len()]
}

fn sizes(found: &Found, area: &Area) -> Drawn {
    // The peaks too, which the speeds may pass over.
    let line = |number: usize| {
        let mut all: Vec<_> = found.points.iter().chain(&found.peaks[number]).collect();
        all.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let size = |point: &Point| (point.speed, 1e6 * point.size(&found.stations[number]));
        all.into_iter().map(size).collect::<Vec<_>>()
    };
    let all = || (0..found.stations.len()).flat_map(line).map(|(_, size)| size).filter(|size| size.is_finite());
    let most = all().fold(0.0, f64::max);
    let least = all().filter(|size| *size > 0.0).fold(most, f64::min).max(DECADES * most);
    // Whole decades, or there would be none with a number.
    let [from, to] =
        [libm::floor(libm::log10(least)), libm::ceil(libm::log10(1.01 * most))].map(|power| libm::pow(10.0, power));
    let mut axes = chart::axes(area, &found.scene.title, speeds(found), (from..to).log_scale(), "half axis [µm]")?;
    for (number, station) in found.stations.iter().enumerate() {
        // A line ends at what has no bound.
        for part in line(number).split(|(_, size)| !(from..=to).contains(size)) {
            axes.draw_series(LineSeries::new(part.iter().copied(), colour(number).stroke_width(2)))?;
        }
        axes.draw_series(LineSeries::new([(0.0, from); 0], colour(number)))?
            .label(table::name(station))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour(number).stroke_width(3)));
    }
    chart::legend(&mut axes)
}

fn phases(found: &Found, area: &Area) -> Drawn {
    let mut axes = chart::axes(area, "", speeds(found), -180.0..180.0, "y behind the mark [°]")?;
    for (number, station) in found.stations.iter().enumerate() {
        let lag = |point: &Point| Some((point.speed, point.lag(&point.orbit(station)?)));
        let points: Vec<_> = found.points.iter().filter(|point| point.speed != 0.0).filter_map(lag).collect();
        // A line does not go across where the angle begins anew.
        for part in points.chunk_by(|a, b| (a.1 - b.1).abs() < 180.0) {
            axes.draw_series(LineSeries::new(part.iter().copied(), colour(number).stroke_width(2)))?;
        }
    }
    Ok(())
}
