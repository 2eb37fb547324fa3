//! The pictures: magnitude and phase over the frequency (Bode), and the answer in the complex plane (Nyquist).

use super::axis::{decades, degrees};
use super::{Found, Point};
use crate::chart::{self, Area, Drawn, INK};
use crate::numbers::rounded;
use anyhow::Result;
use nalgebra::ComplexField;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const LINE: RGBColor = chart::BLUE;
const MARK: RGBColor = chart::ORANGE;

/// What is smaller than this part of the largest is left out \[1].
const LEAST: f64 = 1e-8;

/// Beyond this many times the median a curve in the complex plane is cut off \[1]: it comes near a pole that nothing damps.
const MOST: f64 = 1e3;

/// Two marks nearer to one another than this part of a side have one name \[1].
const NEAR: f64 = 0.04;

/// Half a turn, but for rounding \[°].
const ROUNDED: f64 = 1e-6;

const FREQUENCY: &str = "frequency [rad/s]";

/// Bode's picture as SVG.
pub fn bode(found: &Found) -> Result<String> {
    chart::two(|above| magnitudes(found, above), |below| phases(found, below))
}

fn frequencies(found: &Found) -> std::ops::Range<f64> {
    found.points[0].frequency..found.points[found.points.len() - 1].frequency
}

/// The peaks too, which the frequencies may pass over.
fn all(found: &Found) -> Vec<Point> {
    let mut all: Vec<_> = found.points.iter().chain(&found.peaks).copied().collect();
    all.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    all
}

fn magnitudes(found: &Found, area: &Area) -> Drawn {
    let line: Vec<_> = all(found).iter().map(|point| (point.frequency, point.size())).collect();
    let sizes = || line.iter().map(|(_, size)| *size).filter(|size| size.is_finite());
    let most = sizes().fold(0.0, f64::max);
    let least = sizes().filter(|size| *size > 0.0).fold(most, f64::min).max(LEAST * most);
    // Whole decades, or there would be none with a number.
    let [from, to] =
        [libm::floor(libm::log10(least)), libm::ceil(libm::log10(1.01 * most))].map(|power| libm::pow(10.0, power));
    let x = (decades(frequencies(found)), FREQUENCY);
    let y = (decades(from..to), &*format!("magnitude [{}]", found.unit()));
    let mut axes = chart::axes_of(area, &found.between(), x, y)?;
    for part in line.split(|(_, size)| !(from..=to).contains(size)) {
        axes.draw_series(LineSeries::new(part.iter().copied(), LINE.stroke_width(2)))?;
    }
    let peaks = found.peaks.iter().filter(|peak| peak.size().is_finite());
    axes.draw_series(peaks.map(|peak| Circle::new((peak.frequency, peak.size()), 4, MARK.stroke_width(2))))?;
    Ok(())
}

fn phases(found: &Found, area: &Area) -> Drawn {
    let line = unwrapped(&found.points);
    let y = (degrees(line.iter().map(|(_, phase)| *phase)), "phase [°]");
    let mut axes = chart::axes_of(area, "", (decades(frequencies(found)), FREQUENCY), y)?;
    axes.draw_series(LineSeries::new(line, LINE.stroke_width(2)))?;
    Ok(())
}

/// Frequencies and phases \[°] without the jumps of a whole turn. Half a turn at once is a lag at first and past a resonance that nothing
/// damps, and else a lead, past where nothing moves.
fn unwrapped(points: &[Point]) -> Vec<(f64, f64)> {
    let (mut line, mut is_past_resonance): (Vec<(f64, f64)>, bool) = (Vec::new(), true);
    for Point { frequency, answer } in points {
        let Some(answer) = answer else {
            is_past_resonance = true;
            continue;
        };
        let phase = answer.argument().to_degrees();
        let gained = phase - line.last().map_or(0.0, |(_, phase)| *phase);
        let turns = if std::mem::take(&mut is_past_resonance) {
            libm::floor((gained + 180.0 + ROUNDED) / 360.0)
        } else {
            libm::ceil((gained - 180.0 - ROUNDED) / 360.0)
        };
        line.push((*frequency, phase - 360.0 * turns));
    }
    line
}

/// Nyquist's picture as SVG.
pub fn polar(found: &Found) -> Result<String> {
    let points = all(found);
    let mut sizes: Vec<_> = points.iter().filter_map(|point| point.answer).map(ComplexField::modulus).collect();
    sizes.sort_by(f64::total_cmp);
    let most = sizes[sizes.len() - 1].min(MOST * sizes[sizes.len() / 2]);
    // Numbers that are easily read, and their unit.
    let power = 3.0 * libm::floor(libm::log10(most) / 3.0);
    let unit = if power == 0.0 { found.unit() } else { format!("1e{power} {}", found.unit()) };
    let seen = |point: &Point| {
        let answer = point.answer.filter(|answer| answer.modulus() <= most)?.unscale(libm::pow(10.0, power));
        Some((answer.re, answer.im))
    };
    let parts = points.split(|point| seen(point).is_none());
    let lines: Vec<Vec<_>> = parts.map(|part| part.iter().filter_map(seen).collect()).collect();
    let [x, y] = square(lines.iter().flatten());
    let ends = frequencies(found);
    let [from, to] = [ends.start, ends.end].map(rounded);
    let x_name = format!("real part [{unit}], from {from} to {to} rad/s; dashed at negative frequencies");
    let y_name = format!("imaginary part [{unit}]");
    let (near, middle) = (NEAR * (x.end - x.start), 0.5 * (x.start + x.end));
    chart::square(&found.between(), |area| {
        let mut axes = chart::axes_of(area, "", (x, &*x_name), (y, &*y_name))?;
        for line in &lines {
            let mirrored = line.iter().map(|(re, im)| (*re, -im));
            axes.draw_series(DashedLineSeries::new(mirrored, 4, 4, INK.stroke_width(1)))?;
        }
        for line in lines {
            axes.draw_series(LineSeries::new(line, LINE.stroke_width(2)))?;
        }
        let mut marked: Vec<(f64, f64)> = Vec::new();
        for peak in &found.peaks {
            let Some(place) = seen(peak) else { continue };
            axes.draw_series([Circle::new(place, 4, MARK.stroke_width(2))])?;
            let is_near = |other: &(f64, f64)| libm::hypot(place.0 - other.0, place.1 - other.1) < near;
            if !marked.iter().any(is_near) {
                // Towards the middle, where there is room.
                let (side, towards) = if place.0 > middle { (HPos::Right, -near) } else { (HPos::Left, near) };
                let font = ("sans-serif", 14).into_font().color(&INK).pos(Pos::new(side, VPos::Center));
                let text = format!("{} rad/s", rounded(peak.frequency));
                axes.draw_series([Text::new(text, (place.0 + 0.3 * towards, place.1), font)])?;
                marked.push(place);
            }
        }
        Ok(())
    })
}

/// The sides of a square that holds these points, what they mirror below the real axis, and 0.
fn square<'p>(points: impl Iterator<Item = &'p (f64, f64)>) -> [std::ops::Range<f64>; 2] {
    let (mut left, mut right, mut high) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (re, im) in points {
        (left, right, high) = (left.min(*re), right.max(*re), high.max(im.abs()));
    }
    let (middle, half) = (0.5 * (left + right), 1.1 * high.max(0.5 * (right - left)));
    [middle - half..middle + half, -half..half]
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    #[test]
    fn phases_go_on_past_half_a_turn() {
        let at = |degrees: f64| {
            let (sine, cosine) = libm::sincos(degrees.to_radians());
            Some(Complex::new(cosine, sine))
        };
        let phases = |answers: &[Option<Complex<f64>>]| {
            let point = |answer: &Option<Complex<f64>>| Point { frequency: 1.0, answer: *answer };
            let line = unwrapped(&answers.iter().map(point).collect::<Vec<_>>());
            line.into_iter().map(|(_, phase)| libm::round(phase)).collect::<Vec<_>>()
        };
        assert_eq!(phases(&[at(-170.0), at(170.0), at(60.0), at(-60.0)]), [-170.0, -190.0, -300.0, -420.0]);
        assert_eq!(phases(&[Some(Complex::from(-1.0))]), [-180.0]);
        // Resonance, then a place where nothing moves, then a resonance.
        let real = |re: f64| Some(Complex::from(re));
        assert_eq!(phases(&[real(1.0), None, real(-1.0), real(2.0), None, real(-2.0)]), [0.0, -180.0, 0.0, -180.0]);
    }
}
