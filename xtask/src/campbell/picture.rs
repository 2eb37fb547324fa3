//! The picture: frequencies above, damping ratios below, over the spin.

use crate::chart::{self, Area, Axes, Drawn, INK};
use anyhow::Result;
use plotters::prelude::*;
use split_rotor_model::linear::{Branch, Direction, Point};
use split_rotor_tools::campbell::Diagram;

/// Modes further than this above the highest line are left out, and so is what is damped more than this \[1].
const ABOVE: f64 = 1.6;
const MOST_DAMPED: f64 = 0.5;

fn colour(direction: Direction) -> RGBColor {
    match direction {
        Direction::Forward => chart::BLUE,
        Direction::Backward => chart::ORANGE,
        Direction::Plane => RGBColor(150, 110, 200),
        Direction::Axial => RGBColor(40, 160, 90),
        Direction::Creep => INK,
    }
}

const SHOWN: [Direction; 4] = [Direction::Forward, Direction::Backward, Direction::Plane, Direction::Axial];

/// As SVG.
pub fn svg(diagram: &Diagram) -> Result<String> {
    chart::two(|above| frequencies(diagram, above), |below| damping(diagram, below))
}

fn speeds(diagram: &Diagram) -> std::ops::Range<f64> {
    let steady = &diagram.campbell.steady;
    steady[0].speed..steady[steady.len() - 1].speed
}

fn points<'a>(diagram: &'a Diagram<'_>) -> impl Iterator<Item = &'a Point> {
    diagram.campbell.branches.iter().flat_map(|branch| &branch.points)
}

fn frequencies(diagram: &Diagram, area: &Area) -> Drawn {
    let range = speeds(diagram);
    let fastest = range.start.abs().max(range.end.abs());
    let highest = diagram.critical.iter().map(|(order, _)| order * fastest).fold(0.0, f64::max);
    let seen = points(diagram).map(|point| point.mode.eigenvalue.im).filter(|whirl| *whirl <= ABOVE * highest);
    let lowest = points(diagram)
        .map(|point| point.mode.eigenvalue.im)
        .filter(|whirl| *whirl > 0.0)
        .fold(f64::INFINITY, f64::min);
    let top = 1.05 * seen.fold(if lowest.is_finite() { lowest } else { 1.0 }, f64::max);
    let mut axes = chart::axes(area, &diagram.scene.title, speeds(diagram), 0.0..top, "whirl frequency [rad/s]")?;
    for (order, _) in &diagram.critical {
        // The line leaves at the top or at the side; it may be above the top all along.
        let slowest = range.start.max(0.0).min(range.end);
        if order * slowest.abs() > top {
            continue;
        }
        let end = |speed: f64| if order * speed.abs() > top { speed.signum() * top / order } else { speed };
        let line = [range.start, slowest, range.end].map(|speed| (end(speed), order * end(speed).abs()));
        axes.draw_series(DashedLineSeries::new(line, 6, 4, INK.stroke_width(1)))?;
        let (x, y) = line[2];
        let name = Text::new(format!("{order}X"), (x, y), ("sans-serif", 14).into_font().color(&INK));
        axes.draw_series([name])?;
    }
    lines(&mut axes, &diagram.campbell.branches, |point| Some(point.mode.eigenvalue.im).filter(|whirl| *whirl <= top))?;
    let marks = diagram.critical.iter().flat_map(|(_, crossings)| crossings);
    let marks = marks.filter(|crossing| crossing.mode.eigenvalue.im <= top);
    axes.draw_series(
        marks.map(|at| Circle::new((at.speed, at.mode.eigenvalue.im), 5, colour(at.mode.direction).stroke_width(2))),
    )?;
    legend(&mut axes, diagram)
}

fn damping(diagram: &Diagram, area: &Area) -> Drawn {
    let is_shown = |ratio: &f64| ratio.abs() <= MOST_DAMPED;
    let shown = || points(diagram).filter(|point| point.mode.direction != Direction::Creep);
    let ratios = || shown().map(|point| point.mode.damping_ratio()).filter(is_shown);
    let (least, most) =
        ratios().fold((0.0, 0.01), |(least, most): (f64, f64), ratio| (least.min(ratio), most.max(ratio)));
    let mut axes = chart::axes(area, "", speeds(diagram), 1.1 * least..1.1 * most, "damping ratio [1]")?;
    let range = speeds(diagram);
    axes.draw_series(LineSeries::new([(range.start, 0.0), (range.end, 0.0)], INK.stroke_width(2)))?;
    lines(&mut axes, &diagram.campbell.branches, |point| Some(point.mode.damping_ratio()).filter(is_shown))?;
    let grown = diagram.thresholds.iter();
    axes.draw_series(grown.map(|at| Circle::new((at.speed, 0.0), 5, colour(at.mode.direction).stroke_width(2))))?;
    Ok(())
}

/// The branches, each part in the colour of its direction.
fn lines(axes: &mut Axes, branches: &[Branch], value: impl Fn(&Point) -> Option<f64>) -> Drawn {
    for branch in branches {
        for pair in branch.points.windows(2) {
            let direction = pair[1].mode.direction;
            if let (Some(from), Some(to)) = (value(&pair[0]), value(&pair[1]))
                && direction != Direction::Creep
            {
                let ends = [(pair[0].speed, from), (pair[1].speed, to)];
                axes.draw_series(LineSeries::new(ends, colour(direction).stroke_width(2)))?;
            }
        }
    }
    Ok(())
}

/// The directions that there are.
fn legend(axes: &mut Axes, diagram: &Diagram) -> Drawn {
    for direction in SHOWN {
        if points(diagram).any(|point| point.mode.direction == direction) {
            let line = move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour(direction).stroke_width(3));
            axes.draw_series(LineSeries::new([(0.0, 0.0); 0], colour(direction)))?.label(direction.name()).legend(line);
        }
    }
    chart::legend(axes)
}

#[cfg(test)]
mod tests {
    use super::svg;
    use crate::scenes;
    use split_rotor_model::linear::Machine;
    use split_rotor_tools::campbell::{ORDERS, View};

    /// The lines of the speed's multiples ended a thousand million widths beside a narrow range, and an addition overflowed.
    #[test]
    fn regress_a_narrow_range_is_drawn() {
        let scene = scenes::find("turbo").expect("a scene");
        let machine = Machine::of(&scene.parameters());
        for speed in [300.0, 5000.0, -300.0, -5000.0_f64] {
            for part in [1e-2, 1e-6, 2e-9, 1e-12] {
                let mut ends = [speed, speed * (1.0 + part)];
                ends.sort_by(f64::total_cmp);
                let view = View::of(&scene, &machine, Some(ends), 2, &ORDERS).expect("a view");
                let View::Diagram(diagram) = &view else { panic!("it is symmetric") };
                let picture = svg(diagram).expect("a picture");
                // Nothing is drawn beside the chart.
                let is_far = |word: &str| word.parse::<f64>().is_ok_and(|number| number.abs() > 1e4);
                assert!(!picture.split(['"', ',', ' ']).any(is_far), "{ends:?}");
            }
        }
    }
}
