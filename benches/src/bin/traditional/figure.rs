//! The figure: errors above, times below, a column for each case study. Errors of zero are drawn at
//! the lower edge.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::measure::{Case, Row};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

const SIZE: (u32, u32) = (1000, 800);
const FONT: &str = "Liberation Sans, Arimo, Arial, Helvetica, sans-serif";
const STIFFNESS: Range<f64> = 1e3..1e18;

/// Colours of Okabe and Ito, which readers with any kind of colour vision tell apart.
const BLUE: RGBColor = RGBColor(0, 114, 178);
const SKY: RGBColor = RGBColor(86, 180, 233);
const VERMILLION: RGBColor = RGBColor(213, 94, 0);
const ORANGE: RGBColor = RGBColor(230, 159, 0);
const BLACK: RGBColor = RGBColor(25, 25, 25);
const LIGHT: RGBColor = RGBColor(225, 225, 225);

/// A part of the figure: its title, what is drawn against the joint stiffness, and the curves.
struct Panel {
    title: String,
    quantity: &'static str,
    /// Exponents of its least and largest value.
    exponents: Range<i32>,
    curves: Vec<Curve>,
    /// How a value, a power of ten, is written.
    label: fn(&f64) -> String,
}

/// A curve: a name, a colour, and the value for a joint stiffness.
struct Curve {
    name: &'static str,
    color: RGBColor,
    value: fn(&Row) -> Option<f64>,
}

/// The figure as an SVG document.
pub fn svg(cases: &[Case; 2]) -> Result<String, Box<dyn Error>> {
    let mut document = String::new();
    {
        let page = SVGBackend::with_string(&mut document, SIZE).into_drawing_area();
        page.fill(&WHITE)?;
        let (upper, lower) = page.split_vertically(SIZE.1 * 11 / 20);
        for (row, panel) in [(upper, errors as fn(&Case) -> Panel), (lower, times)] {
            for (area, case) in row.split_evenly((1, 2)).iter().zip(cases) {
                panel(case).draw(area, &case.rows)?;
            }
        }
        page.present()?;
    }
    Ok(document)
}

fn errors(case: &Case) -> Panel {
    Panel {
        title: case.name.into(),
        quantity: "relative error of the output's stiffness",
        label: exponential,
        exponents: -17..9,
        curves: vec![
            Curve {
                name: "springs in the matrix, for rigid joints",
                color: BLACK,
                value: |row| Some(row.traditional?.rigid_joints),
            },
            Curve {
                name: "multipliers, free rotations 1e-7 N·m/rad",
                color: SKY,
                value: |row| Some(row.lagrange?.same_springs),
            },
            Curve {
                name: "springs in the matrix, free rotations 1e-7 N·m/rad",
                color: ORANGE,
                value: |row| Some(row.traditional_not_free?.same_springs),
            },
            Curve {
                name: "springs in the matrix, free rotations 0",
                color: VERMILLION,
                value: |row| Some(row.traditional?.same_springs),
            },
            Curve {
                name: "this method",
                color: BLUE,
                value: |row| Some(row.ours),
            },
        ],
    }
}

fn times(case: &Case) -> Panel {
    Panel {
        title: format!(
            "Equations: springs in the matrix {}, multipliers {}, this method {}",
            case.equations, case.lagrange_equations, case.unknowns
        ),
        quantity: "time (ms)",
        label: plain,
        exponents: -3..4,
        curves: vec![
            Curve {
                name: "this method, solve: with plan, diagnosis, all wrenches",
                color: SKY,
                value: |row| Some(row.solve_time.as_secs_f64() * 1e3),
            },
            Curve {
                name: "multipliers",
                color: ORANGE,
                value: |row| Some(row.lagrange_time.as_secs_f64() * 1e3),
            },
            Curve {
                name: "springs in the matrix",
                color: VERMILLION,
                value: |row| Some(row.traditional_time.as_secs_f64() * 1e3),
            },
            Curve {
                name: "this method, a pose one by one",
                color: BLUE,
                value: |row| Some(row.pose_time.as_secs_f64() * 1e3),
            },
        ],
    }
}

/// A power of ten as 1e-7: fonts in use lack superscripts.
fn exponential(value: &f64) -> String {
    format!("1e{}", value.log10().round())
}

/// A power of ten as 0.01.
fn plain(value: &f64) -> String {
    let decimals = (-value.log10().round()).max(0.0) as usize;
    format!("{value:.decimals$}")
}

impl Panel {
    fn draw(&self, area: &Area<'_>, rows: &[Row]) -> Result<(), Box<dyn Error>> {
        let least = 10f64.powi(self.exponents.start);
        let values = least..10f64.powi(self.exponents.end);
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, (FONT, 18))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(66)
            .build_cartesian_2d(STIFFNESS.log_scale(), values.log_scale())?;
        chart
            .configure_mesh()
            .x_desc("joint stiffness (N/m, N·m/rad)")
            .y_desc(self.quantity)
            .x_labels(6)
            .y_labels(8)
            .x_label_formatter(&exponential)
            .y_label_formatter(&self.label)
            .bold_line_style(LIGHT)
            .light_line_style(TRANSPARENT)
            .axis_style(BLACK)
            .label_style((FONT, 14))
            .axis_desc_style((FONT, 15))
            .draw()?;
        for curve in &self.curves {
            let color = curve.color;
            let points = rows.iter().filter_map(|row| {
                let value = (curve.value)(row)?;
                Some((10f64.powi(row.exponent), value.max(least)))
            });
            let points: Vec<_> = points.collect();
            chart.draw_series(points.iter().map(|at| Circle::new(*at, 3, color.filled())))?;
            chart
                .draw_series([PathElement::new(points, color.stroke_width(2))])?
                .label(curve.name)
                .legend(move |(x, y)| {
                    PathElement::new([(x, y), (x + 22, y)], color.stroke_width(2))
                });
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .label_font((FONT, 14))
            .background_style(WHITE.mix(0.85))
            .draw()?;
        Ok(())
    }
}
