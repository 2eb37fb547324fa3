//! The picture: the larger half axes of the orbits above, how far y lags behind the rotor's mark below, over the spin.

use super::{Found, Station, table};
use crate::chart::{self, Area, Drawn};
use anyhow::Result;
use nalgebra::ComplexField;
use plotters::prelude::*;
use split_rotor_model::linear::Response;

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

fn speeds(found: &Found) -> std::ops::Range<f64> {
    found.responses[0].steady.speed..found.responses[found.responses.len() - 1].steady.speed
}

fn colour(number: usize) -> RGBColor {
    COLOURS[number % COLOURS.len()]
}

/// The half axis \[µm].
fn major(station: &Station, response: &Response) -> f64 {
    1e6 * response.orbit(station.position).major()
}

fn sizes(found: &Found, area: &Area) -> Drawn {
    // The peaks too, which the speeds may pass over.
    let line = |station: usize| {
        let mut all: Vec<_> = found.responses.iter().chain(&found.peaks[station]).collect();
        all.sort_by(|a, b| a.steady.speed.total_cmp(&b.steady.speed));
        all.into_iter().map(move |response| (response.steady.speed, major(&found.stations[station], response)))
    };
    let all = || (0..found.stations.len()).flat_map(line).map(|(_, size)| size).filter(|size| *size > 0.0);
    let most = all().fold(0.0, f64::max);
    let least = all().fold(most, f64::min).max(DECADES * most);
    let range = (0.8 * least..1.5 * most).log_scale();
    let mut axes = chart::axes(area, &found.scene.title, speeds(found), range, "half axis [µm]")?;
    for (number, station) in found.stations.iter().enumerate() {
        let points = line(number).filter(|(_, size)| *size >= least);
        axes.draw_series(LineSeries::new(points, colour(number).stroke_width(2)))?
            .label(table::name(station))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour(number).stroke_width(3)));
    }
    chart::legend(&mut axes)
}

fn phases(found: &Found, area: &Area) -> Drawn {
    let mut axes = chart::axes(area, "", speeds(found), -180.0..180.0, "y behind the mark [°]")?;
    for (number, station) in found.stations.iter().enumerate() {
        let point =
            |response: &Response| (response.steady.speed, -response.orbit(station.position).y.argument().to_degrees());
        let points: Vec<_> =
            found.responses.iter().filter(|response| response.steady.speed != 0.0).map(point).collect();
        // A line does not go across where the angle begins anew.
        for part in points.chunk_by(|a, b| (a.1 - b.1).abs() < 180.0) {
            axes.draw_series(LineSeries::new(part.iter().copied(), colour(number).stroke_width(2)))?;
        }
    }
    Ok(())
}
