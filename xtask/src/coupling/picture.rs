//! The pictures: error and energy error versus the communication step, a curve for each setting, the limits of stability as dashed lines.

use crate::chart::{self, Area, BLUE, Drawn, INK, ORANGE};
use crate::frequency::axis::decades;
use anyhow::Result;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use split_rotor_tools::coupling::exchange::{Outcome, Scheme};
use split_rotor_tools::coupling::{Found, SETTINGS, Tried};
use std::ops::Range;

/// The colours of the settings.
const COLOURS: [RGBColor; 6] =
    [ORANGE, RGBColor(170, 120, 0), RGBColor(150, 80, 190), RGBColor(200, 40, 110), BLUE, RGBColor(20, 140, 90)];

/// Errors beyond these ends are not shown \[1].
const ENDS: [f64; 2] = [1e-12, 1e4];

/// The part of the steps' range that the legend takes \[1].
const ROOM: f64 = 0.28;

/// As SVG.
pub fn svg(found: &Found, scheme: Scheme) -> Result<String> {
    let title = format!("{}: answers {}", found.scene.title, scheme.words());
    chart::two(
        |above| panel(found, scheme, above, &title, ("error [1]", |outcome| outcome.error), true),
        |below| panel(found, scheme, below, "", ("energy error [1]", |outcome| outcome.energy), false),
    )
}

type Read = fn(&Outcome) -> Option<f64>;

fn panel(found: &Found, scheme: Scheme, area: &Area, title: &str, (name, read): (&str, Read), is_first: bool) -> Drawn {
    let value = |one: &Tried| read(&one.outcome).map(|value| (1e3 * one.step, value.clamp(ENDS[0], ENDS[1])));
    let all: Vec<_> = found.tried.iter().filter(|one| one.scheme == scheme).filter_map(value).collect();
    let (least, most) =
        all.iter().fold((1.0, 1.0_f64), |(least, most), (_, value)| (value.min(least), value.max(most)));
    let [low, high] =
        [libm::floor(libm::log10(least)), libm::ceil(libm::log10(most))].map(|power| libm::pow(10.0, power));
    let (high, steps) = (high.max(10.0 * low), margin(found));
    let x = (decades(with_room(&steps)), "communication step [ms]");
    let mut axes = chart::axes_of(area, title, x, (decades(low..high), name))?;
    for (order, colour) in COLOURS.iter().enumerate().take(3) {
        let limit = found.longest[scheme as usize][order].map(|limit| 1e3 * limit);
        let Some(limit) = limit.filter(|limit| steps.contains(limit)) else { continue };
        axes.draw_series(DashedLineSeries::new([(limit, low), (limit, high)], 5, 4, colour.stroke_width(1)))?;
    }
    for (setting, colour) in SETTINGS.iter().zip(COLOURS) {
        let points: Vec<Option<_>> = found.series(scheme, setting).map(value).collect();
        for part in points.split(Option::is_none) {
            let part: Vec<_> = part.iter().flatten().copied().collect();
            axes.draw_series(part.iter().map(|point| Circle::new(*point, 3, colour.filled())))?;
            axes.draw_series(LineSeries::new(part, colour.stroke_width(2)))?;
        }
        let legend = LineSeries::new(std::iter::empty::<(f64, f64)>(), colour.stroke_width(2));
        let drawn = axes.draw_series(legend)?;
        if is_first {
            drawn
                .label(setting.name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
        }
    }
    if is_first {
        let limit = axes.draw_series(LineSeries::new(std::iter::empty::<(f64, f64)>(), INK.stroke_width(1)))?;
        let dashes = |(x, y): (i32, i32)| DashedPathElement::new([(x, y), (x + 18, y)], 5, 4, INK.stroke_width(1));
        limit.label("grows beyond").legend(dashes);
        axes.configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .label_font(("sans-serif", 14).into_font().color(&INK))
            .border_style(TRANSPARENT)
            .draw()?;
    }
    Ok(())
}

/// The same with room for the legend on the right.
fn with_room(steps: &Range<f64>) -> Range<f64> {
    steps.start..steps.end * libm::pow(steps.end / steps.start, ROOM)
}

/// The steps and a little on both sides \[ms].
fn margin(found: &Found) -> Range<f64> {
    let [first, last] = [found.steps[0], found.steps[found.steps.len() - 1]];
    1e3 * first / 1.15..1e3 * last * 1.15
}

#[cfg(test)]
mod tests {
    use super::*;
    use split_rotor_model::scene::Scene;
    use std::path::Path;

    const MASS: &str = "[rotor]\nm = 10.0\nJa = 0.1\nJt = 0.1\n[start]\nr_c.y = 1e-3\n[[effects.bearing]]\nposition = 0.0\nkxx = 1e7\n\
                        kyy = 1e7\nkzz = 1e7\n";

    #[test]
    fn every_setting_and_limit_is_drawn() {
        let scene = Scene::parse(Path::new("mass.toml"), MASS).expect("a scene");
        // The limit of held loads, 0.02 ms, lies between; runs at 1 ms fail.
        let found = Found::of(&scene, Some(0.0), Some(vec![1e-5, 5e-5, 1e-3]), |_, _| ()).expect("couplings");
        for scheme in Scheme::ALL {
            let svg = svg(&found, scheme).expect("a picture");
            for name in SETTINGS.map(|setting| setting.name).into_iter().chain(["energy error", "grows beyond"]) {
                assert!(svg.contains(name), "{name}");
            }
            assert!(svg.contains(scheme.words()) && !svg.contains("NaN"));
        }
    }
}
