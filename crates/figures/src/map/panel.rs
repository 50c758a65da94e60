//! One plane of a map.

use super::colors::Colors;
use super::extremes::Marked;
use super::layout::Cell;
use super::{Extreme, MapPanel, Samples};
use crate::canvas::{Canvas, text_width};
use crate::contours::Field;
use crate::geometry::PagePoint;
use crate::page::{self, fitted};
use crate::paths;
use crate::plane_axes::PlaneAxes;
use crate::refine::Refined;
use crate::style;

/// Shortest contour that has room for a label \[pixels\].
const LABELLED: f64 = 110.0;

/// A cell of the grid is divided until its parts are no larger than this \[pixels\], ...
const FINE: f64 = 5.0;

/// ... but into no more parts along an axis than this.
const MOST_PARTS: f64 = 24.0;

/// Least distance of the marks of points without a value \[pixels\].
const MARKS_APART: f64 = 8.0;

/// Draws a panel in its place.
pub(super) fn draw(
    canvas: &mut Canvas,
    panel: &MapPanel,
    place: &Cell,
    (colors, marks): (&Colors, &[Marked]),
) {
    let axes = &place.axes;
    let factors = place.scaled.each_ref().map(|scaled| scaled.factor);
    let marks = marks.iter().map(|mark| {
        let [x, y] = mark.at;
        let at = axes.at([x * factors[0], y * factors[1]]);
        (mark, at)
    });
    let marks: Vec<_> = marks.collect();
    let mut labels: Vec<(PagePoint, String)> = Vec::new();
    for (mark, at) in &marks {
        labels.push((beside(*at, &mark.label, axes, &labels), mark.label.clone()));
    }
    match &panel.samples {
        Samples::Grid { x, y, values } => {
            let [x, y] = [(x, factors[0]), (y, factors[1])].map(|(ticks, factor)| {
                let scaled = ticks.iter().map(|tick| tick * factor);
                scaled.collect::<Vec<_>>()
            });
            let (x, y) = (&x, &y);
            draw_grid(canvas, axes, &Field { x, y, values }, (colors, labels));
        }
        Samples::Points { at, values } => {
            axes.draw_grid(canvas);
            let radius = (120.0 / (at.len() as f64).sqrt()).clamp(2.5, 7.0);
            for ([x, y], value) in at.iter().zip(values) {
                let at = axes.at([x * factors[0], y * factors[1]]);
                match value {
                    Some(value) => canvas.disc(at, radius, colors.of(*value)),
                    None => cross(canvas, at),
                }
            }
            draw_labels(canvas, &labels);
        }
    }
    for (mark, at) in marks {
        page::extreme_mark(canvas, at, mark.of == Extreme::Most);
    }
    let names = [0, 1].map(|axis| {
        let label = &*place.scaled[axis].label;
        place.labels[axis].then_some(label)
    });
    axes.draw(canvas, names);
    if panel.name.is_empty() {
        return;
    }
    let area = axes.area;
    let middle = [0.5 * (area.left + area.right), area.top - 14.0];
    let room = area.right - area.left - 90.0;
    fitted(canvas, &panel.name, middle, room, style::PANEL);
}

/// Draws a field, with labels of its contours where they are clear of those that are there.
fn draw_grid(
    canvas: &mut Canvas,
    axes: &PlaneAxes,
    field: &Field<'_>,
    (colors, mut labels): (&Colors, Vec<(PagePoint, String)>),
) {
    let on_page = |line: Vec<PagePoint>| -> Vec<PagePoint> {
        line.into_iter().map(|point| axes.at(point)).collect()
    };
    let toned: Vec<_> = (field.values.iter())
        .map(|value| value.map(|value| colors.tone(value)))
        .collect();
    let toned = Field {
        values: &toned,
        ..*field
    };
    let area = axes.area;
    let parts = [
        (field.x, area.right - area.left),
        (field.y, area.bottom - area.top),
    ]
    .map(|(ticks, pixels)| {
        let cell = pixels / (ticks.len() - 1) as f64;
        (cell / FINE).ceil().clamp(1.0, MOST_PARTS) as usize
    });
    let fine = Refined::new(&toned, parts);
    let fine = fine.field();
    for (level, color) in colors.shades() {
        let region: Vec<_> = fine.region(level).into_iter().map(on_page).collect();
        if region.is_empty() {
            break;
        }
        canvas.shade(&region, color);
    }
    for (tone, label, stroke) in colors.contours() {
        let lines: Vec<_> = fine.lines(tone).into_iter().map(on_page).collect();
        for line in &lines {
            canvas.line(line, stroke);
        }
        let longest = lines
            .iter()
            .max_by(|a, b| paths::length(a).total_cmp(&paths::length(b)));
        if let Some(at) = longest.and_then(|line| label_place(line, &label, axes, &labels)) {
            labels.push((at, label));
        }
    }
    draw_labels(canvas, &labels);
    draw_lone(canvas, axes, field, colors);
}

fn draw_labels(canvas: &mut Canvas, labels: &[(PagePoint, String)]) {
    for (at, label) in labels {
        let [x, y] = half_size(label);
        let halo = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[dx, dy]| [at[0] + dx, at[1] + dy]);
        canvas.polygon(&halo, style::CONTOUR_HALO);
        canvas.text(label, *at, style::CONTOUR_LABEL);
    }
}

/// A place beside a mark for its label: inside the panel and clear of others, where there is one.
fn beside(
    at: PagePoint,
    label: &str,
    axes: &PlaneAxes,
    others: &[(PagePoint, String)],
) -> PagePoint {
    const APART: f64 = 9.0;
    let [width, height] = half_size(label);
    let sides = [[1.0, 0.0], [-1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];
    let away = [width + APART, height + APART];
    let places = sides.map(|side: PagePoint| [0, 1].map(|k| at[k] + side[k] * away[k]));
    // On top and below it is kept between the panel's sides.
    let area = axes.area;
    let kept = |[x, y]: PagePoint| {
        let [left, right] = [area.left + width + 3.0, area.right - width - 3.0];
        let [top, bottom] = [area.top + height + 3.0, area.bottom - height - 3.0];
        [
            x.max(left.min(right)).min(right.max(left)),
            y.max(top.min(bottom)).min(bottom.max(top)),
        ]
    };
    // How far it must be moved to be inside, and whether it then covers the mark or another label.
    let cost = |place: &PagePoint| {
        let [x, y] = kept(*place);
        let moved = (x - place[0]).abs() + (y - place[1]).abs();
        let over = |[a, b]: PagePoint, [w, h]: PagePoint| {
            (x - a).abs() < width + w && (y - b).abs() < height + h
        };
        let covers = over(at, [6.0, 6.0])
            || (others.iter()).any(|(other, text)| over(*other, half_size(text)));
        moved + if covers { 1e3 } else { 0.0 }
    };
    let best = (places.into_iter()).min_by(|a, b| cost(a).total_cmp(&cost(b)));
    kept(best.unwrap_or(at))
}

/// Draws the points without a value, and those with one that are at no cell.
fn draw_lone(canvas: &mut Canvas, axes: &PlaneAxes, field: &Field<'_>, colors: &Colors) {
    let (columns, rows) = (field.x.len(), field.y.len());
    let stride = |ticks: &[f64], pixels: f64| {
        let apart = pixels / (ticks.len() - 1) as f64;
        (MARKS_APART / apart).ceil().max(1.0) as usize
    };
    let area = axes.area;
    let strides = [
        stride(field.x, area.right - area.left),
        stride(field.y, area.bottom - area.top),
    ];
    let in_cell = |i: usize, j: usize| {
        let below = [i.checked_sub(1), Some(i)].into_iter().flatten();
        below.into_iter().any(|i| {
            let beside = [j.checked_sub(1), Some(j)].into_iter().flatten();
            beside.into_iter().any(|j| field.cell(i, j).is_some())
        })
    };
    for j in 0..rows {
        for i in 0..columns {
            let at = axes.at([field.x[i], field.y[j]]);
            match field.values[i + j * columns] {
                None if i % strides[0] == 0 && j % strides[1] == 0 => cross(canvas, at),
                Some(value) if !in_cell(i, j) => canvas.disc(at, 3.5, colors.of(value)),
                _ => {}
            }
        }
    }
}

/// The mark of a point without a value.
fn cross(canvas: &mut Canvas, [x, y]: PagePoint) {
    const HALF: f64 = 2.6;
    for side in [-HALF, HALF] {
        let line = [[x - HALF, y - side], [x + HALF, y + side]];
        canvas.line(&line, style::MISSING);
    }
}

/// A place on a contour for its label that is inside the panel and clear of other labels.
fn label_place(
    line: &[PagePoint],
    label: &str,
    axes: &PlaneAxes,
    others: &[(PagePoint, String)],
) -> Option<PagePoint> {
    let whole = paths::length(line);
    if whole < LABELLED {
        return None;
    }
    let [width, height] = half_size(label);
    let area = axes.area;
    let is_free = |at: &PagePoint| {
        let inside = at[0] - width > area.left + 3.0
            && at[0] + width < area.right - 3.0
            && at[1] - height > area.top + 3.0
            && at[1] + height < area.bottom - 3.0;
        let clear = |(other, text): &(PagePoint, String)| {
            let [w, h] = half_size(text);
            (at[0] - other[0]).abs() > width + w + 4.0
                || (at[1] - other[1]).abs() > height + h + 4.0
        };
        inside && others.iter().all(clear)
    };
    let parts = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8];
    parts
        .iter()
        .map(|part| paths::along(line, part * whole))
        .find(is_free)
}

fn half_size(label: &str) -> [f64; 2] {
    let size = style::CONTOUR_LABEL.size;
    [0.5 * text_width(label, size) + 1.0, 0.55 * size]
}
