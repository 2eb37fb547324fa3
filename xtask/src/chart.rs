//! Pictures of a machine against its speed: two charts, one above the other, in ink that is read on white and on black.

use anyhow::{Result, anyhow};
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;

/// The size of both \[px].
const SIZE: (u32, u32) = (820, 760);

/// Ink that is read on white and on black.
pub const INK: RGBColor = RGBColor(128, 128, 128);

pub type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
pub type Axes<'a, Y = RangedCoordf64> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, Y>>;
pub type Drawn<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Both as SVG, the upper one the larger.
pub fn two(upper: impl FnOnce(&Area) -> Drawn, lower: impl FnOnce(&Area) -> Drawn) -> Result<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        let (above, below) = root.split_vertically(SIZE.1 * 62 / 100);
        upper(&above).and_then(|()| lower(&below)).map_err(|error| anyhow!("{error}"))?;
        root.present()?;
    }
    Ok(text)
}

/// The axes of a chart, `y` with this name.
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
    let text = ("sans-serif", 15).into_font().color(&INK);
    let mut axes = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 17).into_font().color(&INK))
        .margin(10)
        .margin_right(30)
        .x_label_area_size(45)
        .y_label_area_size(70)
        .build_cartesian_2d(speeds, y)?;
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

/// The legend, of the series that have a label.
pub fn legend<Y: Ranged<ValueType = f64>>(axes: &mut Axes<Y>) -> Drawn {
    axes.configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .label_font(("sans-serif", 15).into_font().color(&INK))
        .border_style(TRANSPARENT)
        .draw()?;
    Ok(())
}
