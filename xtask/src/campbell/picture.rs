//! The picture: frequencies above, damping ratios below, over the spin.

use super::Diagram;
use anyhow::{Result, anyhow};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use split_rotor_model::linear::{Branch, Direction, Point};

/// Its size \[px].
const SIZE: (u32, u32) = (820, 760);

/// Ink that is read on white and on black.
const INK: RGBColor = RGBColor(128, 128, 128);

/// Modes further than this above the highest line are left out, and so is what is damped more than this \[1].
const ABOVE: f64 = 1.6;
const MOST_DAMPED: f64 = 0.5;

type Axes<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

fn colour(direction: Direction) -> RGBColor {
    match direction {
        Direction::Forward => RGBColor(31, 119, 210),
        Direction::Backward => RGBColor(220, 90, 30),
        Direction::Plane => RGBColor(150, 110, 200),
        Direction::Axial => RGBColor(40, 160, 90),
        Direction::Creep => INK,
    }
}

const SHOWN: [Direction; 4] = [Direction::Forward, Direction::Backward, Direction::Plane, Direction::Axial];

/// As SVG.
pub fn svg(diagram: &Diagram) -> Result<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        let (above, below) = root.split_vertically(SIZE.1 * 62 / 100);
        frequencies(diagram, &above).map_err(|error| anyhow!("{error}"))?;
        damping(diagram, &below).map_err(|error| anyhow!("{error}"))?;
        root.present()?;
    }
    Ok(text)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Drawn = std::result::Result<(), Box<dyn std::error::Error>>;

fn speeds(diagram: &Diagram) -> std::ops::Range<f64> {
    let steady = &diagram.campbell.steady;
    steady[0].speed..steady[steady.len() - 1].speed
}

fn points<'a>(diagram: &'a Diagram<'_>) -> impl Iterator<Item = &'a Point> {
    diagram.campbell.branches.iter().flat_map(|branch| &branch.points)
}

fn axes<'a>(
    area: &Area<'a>,
    diagram: &Diagram,
    caption: &str,
    y: std::ops::Range<f64>,
    name: &str,
) -> std::result::Result<Axes<'a>, Box<dyn std::error::Error>> {
    let text = ("sans-serif", 15).into_font().color(&INK);
    let mut axes = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 17).into_font().color(&INK))
        .margin(10)
        .margin_right(30)
        .x_label_area_size(45)
        .y_label_area_size(70)
        .build_cartesian_2d(speeds(diagram), y)?;
    axes.configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(INK.mix(0.25))
        .axis_style(INK)
        .label_style(text.clone())
        .axis_desc_style(text)
        .x_desc("spin [rad/s]")
        .y_desc(name)
        .draw()?;
    Ok(axes)
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
    let mut axes = axes(area, diagram, &diagram.scene.title, 0.0..top, "whirl frequency [rad/s]")?;
    for (order, _) in &diagram.critical {
        // The line leaves at the top or on the right.
        let end = |speed: f64| if order * speed.abs() > top { speed.signum() * top / order } else { speed };
        let line = [range.start, range.start.max(0.0).min(range.end), range.end]
            .map(|speed| (end(speed), order * end(speed).abs()));
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
    let mut axes = axes(area, diagram, "", 1.1 * least..1.1 * most, "damping ratio [1]")?;
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
    let text = ("sans-serif", 15).into_font().color(&INK);
    axes.configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .label_font(text)
        .border_style(TRANSPARENT)
        .draw()?;
    Ok(())
}
