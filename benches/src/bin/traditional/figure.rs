//! The figure: errors above, times below, a column for each case study. Errors of zero are drawn at
//! the lower edge.

use std::fmt::Write as _;
use std::ops::Range;

use crate::measure::{Case, Row};

const SIZE: [f64; 2] = [1000.0, 800.0];
const FONT: &str = "Liberation Sans, Arimo, Arial, Helvetica, sans-serif";

/// Exponents of the least and the largest joint stiffness.
const STIFFNESS: Range<i32> = 3..18;

/// Colours of Okabe and Ito, which readers with any kind of colour vision tell apart.
const BLUE: &str = "#0072B2";
const SKY: &str = "#56B4E9";
const VERMILLION: &str = "#D55E00";
const ORANGE: &str = "#E69F00";
const BLACK: &str = "#191919";
const LIGHT: &str = "#E1E1E1";

/// A part of the figure: its title, what is drawn against the joint stiffness, and the curves.
struct Panel {
    title: String,
    quantity: &'static str,
    /// Exponents of its least and largest value.
    exponents: Range<i32>,
    curves: Vec<Curve>,
    /// How a power of ten is written.
    label: fn(i32) -> String,
}

/// A curve: a name, a colour, and the value for a joint stiffness.
struct Curve {
    name: &'static str,
    color: &'static str,
    value: fn(&Row) -> Option<f64>,
}

/// The figure as an SVG document.
pub fn svg(cases: &[Case; 2]) -> String {
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}\" fill=\"{BLACK}\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n"
    );
    for (column, case) in cases.iter().enumerate() {
        let left = 0.5 * width * column as f64;
        errors(case).draw(&mut svg, &case.rows, [left, 0.0], 0.55 * height);
        times(case).draw(&mut svg, &case.rows, [left, 0.55 * height], 0.45 * height);
    }
    svg + "</svg>\n"
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
fn exponential(exponent: i32) -> String {
    format!("1e{exponent}")
}

/// A power of ten as 0.01.
fn plain(exponent: i32) -> String {
    let decimals = (-exponent).max(0) as usize;
    format!("{:.decimals$}", 10f64.powi(exponent))
}

/// A line of text, its place and anchor.
fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, size: u32, text: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\">{text}</text>"
    );
}

fn line(svg: &mut String, points: &[[f64; 2]], color: &str, width: u32) {
    let points: Vec<_> = points
        .iter()
        .map(|[x, y]| format!("{x:.1},{y:.1}"))
        .collect();
    let points = points.join(" ");
    let _ = writeln!(
        svg,
        "<polyline fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" points=\"{points}\"/>"
    );
}

impl Panel {
    /// Draws the panel from its upper left corner on, half the page wide.
    fn draw(&self, svg: &mut String, rows: &[Row], [left, top]: [f64; 2], height: f64) {
        let page_right = left + 0.5 * SIZE[0];
        let [x, y] = [
            [left + 78.0, page_right - 14.0],
            [top + 56.0, top + height - 56.0],
        ];
        let middle = 0.5 * (left + page_right);
        text(svg, [middle, top + 24.0], "middle", 15, &self.title);
        text(svg, [left + 14.0, y[0] - 10.0], "start", 13, self.quantity);
        let below = [0.5 * (x[0] + x[1]), y[1] + 42.0];
        text(svg, below, "middle", 13, "joint stiffness (N/m, N·m/rad)");
        let place = |at: [f64; 2]| -> [f64; 2] {
            let part = |value: f64, range: &Range<i32>| {
                let [start, end] = [range.start, range.end].map(f64::from);
                (value - start) / (end - start)
            };
            [
                x[0] + part(at[0], &STIFFNESS) * (x[1] - x[0]),
                y[1] - part(at[1], &self.exponents) * (y[1] - y[0]),
            ]
        };
        let every = (self.exponents.len() / 8 + 1) as i32;
        for exponent in (self.exponents.start..=self.exponents.end).filter(|k| k % every == 0) {
            let at = place([f64::from(STIFFNESS.start), f64::from(exponent)]);
            line(svg, &[at, [x[1], at[1]]], LIGHT, 1);
            text(
                svg,
                [at[0] - 8.0, at[1] + 4.0],
                "end",
                12,
                &(self.label)(exponent),
            );
        }
        for exponent in (STIFFNESS.start..=STIFFNESS.end).step_by(3) {
            let at = place([f64::from(exponent), f64::from(self.exponents.start)]);
            line(svg, &[at, [at[0], y[0]]], LIGHT, 1);
            text(
                svg,
                [at[0], at[1] + 18.0],
                "middle",
                12,
                &exponential(exponent),
            );
        }
        line(svg, &[[x[0], y[0]], [x[0], y[1]], [x[1], y[1]]], BLACK, 1);
        for (k, curve) in self.curves.iter().enumerate() {
            let points = rows.iter().filter_map(|row| {
                let least = 10f64.powi(self.exponents.start);
                let value = (curve.value)(row)?.max(least);
                Some(place([f64::from(row.exponent), value.log10()]))
            });
            let points: Vec<_> = points.collect();
            line(svg, &points, curve.color, 2);
            for [x, y] in &points {
                let color = curve.color;
                let _ = writeln!(
                    svg,
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{color}\"/>"
                );
            }
            let at = [x[1] - 8.0, y[0] + 12.0 + 16.0 * k as f64];
            line(svg, &[[at[0] - 22.0, at[1]], at], curve.color, 2);
            text(svg, [at[0] - 28.0, at[1] + 4.0], "end", 12, curve.name);
        }
    }
}
