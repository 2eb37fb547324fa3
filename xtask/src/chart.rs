//! Pictures of a machine: two charts, one above the other, or a square one, in ink that is read on white and on black.

use anyhow::{Result, anyhow};
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;

/// The size of two charts \[px].
const SIZE: (u32, u32) = (820, 760);

/// Around a chart: its margins, that on the right, and the widths of what stands below and on the left \[px].
const MARGIN: u32 = 10;
const RIGHT: u32 = 30;
const BELOW: u32 = 45;
const LEFT: u32 = 70;

/// A square chart \[px], and the height of the line above it.
const SQUARE: u32 = 600;
const LINE: u32 = 36;

/// Ink that is read on white and on black.
pub const INK: RGBColor = RGBColor(128, 128, 128);

/// The first two colours of lines.
pub const BLUE: RGBColor = RGBColor(31, 119, 210);
pub const ORANGE: RGBColor = RGBColor(220, 90, 30);

pub type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
pub type Axes<'a, Y = RangedCoordf64, X = RangedCoordf64> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>;
pub type Drawn<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Both as SVG, the upper one the larger.
pub fn two(upper: impl FnOnce(&Area) -> Drawn, lower: impl FnOnce(&Area) -> Drawn) -> Result<String> {
    svg(SIZE, |root| {
        let (above, below) = root.split_vertically(SIZE.1 * 62 / 100);
        upper(&above)?;
        lower(&below)
    })
}

/// A chart as SVG whose axes are of one length, below a line of text.
pub fn square(line: &str, draw: impl FnOnce(&Area) -> Drawn) -> Result<String> {
    let (width, height) = (SQUARE + MARGIN + RIGHT + LEFT, SQUARE + 2 * MARGIN + BELOW);
    svg((width, height + LINE), |root| {
        let (above, below) = root.split_vertically(LINE);
        above.margin(MARGIN, 0, 0, 0).titled(line, ("sans-serif", 17).into_font().color(&INK))?;
        draw(&below)
    })
}

fn svg(size: (u32, u32), draw: impl FnOnce(&Area) -> Drawn) -> Result<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        draw(&root).map_err(|error| anyhow!("{error}"))?;
        root.present()?;
    }
    Ok(text)
}

/// The axes of a chart over the spin, `y` with this name.
pub fn axes<'a, Y>(
    area: &Area<'a>,
    caption: &str,
    speeds: Range<f64>,
    y: Y,
    name: &str,
) -> Drawn<Axes<'a, Y::CoordDescType>>
where
    Y: AsRangedCoord<Value = f64>,
    Y::CoordDescType: ValueFormatter<f64>,
{
    axes_of(area, caption, (speeds, "spin [rad/s]"), (y, name))
}

/// The axes of a chart, both with their names.
pub fn axes_of<'a, X, Y>(
    area: &Area<'a>,
    caption: &str,
    (x, x_name): (X, &str),
    (y, y_name): (Y, &str),
) -> Drawn<Axes<'a, Y::CoordDescType, X::CoordDescType>>
where
    X: AsRangedCoord<Value = f64>,
    Y: AsRangedCoord<Value = f64>,
    X::CoordDescType: ValueFormatter<f64>,
    Y::CoordDescType: ValueFormatter<f64>,
{
    let text = ("sans-serif", 15).into_font().color(&INK);
    let mut chart = ChartBuilder::on(area);
    if !caption.is_empty() {
        chart.caption(caption, ("sans-serif", 17).into_font().color(&INK));
    }
    chart.margin(MARGIN).margin_right(RIGHT).x_label_area_size(BELOW).y_label_area_size(LEFT);
    let mut axes = chart.build_cartesian_2d(x, y)?;
    axes.configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(INK.mix(0.25))
        .axis_style(INK)
        .label_style(text.clone())
        .axis_desc_style(text)
        .x_desc(x_name)
        .y_desc(y_name)
        .draw()?;
    Ok(axes)
}

/// The legend, of the series that have a label.
pub fn legend<Y: Ranged<ValueType = f64>>(axes: &mut Axes<Y>) -> Drawn {
    axes.configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .label_font(("sans-serif", 15).into_font().color(&INK))
        .border_style(TRANSPARENT)
        .draw()?;
    Ok(())
}
