//! One plane of a map.

use super::colors::Colors;
use super::layout::{Cell, Layout};
use super::{MapPanel, Samples};
use crate::canvas::{Canvas, text_width};
use crate::contours::Field;
use crate::geometry::PagePoint;
use crate::page::fitted;
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
    layout: &Layout,
    colors: &Colors,
) {
    let axes = &place.axes;
    let factors = layout.scaled.each_ref().map(|scaled| scaled.factor);
    match &panel.samples {
        Samples::Grid { x, y, values } => {
            let [x, y] = [(x, factors[0]), (y, factors[1])].map(|(ticks, factor)| {
                let scaled = ticks.iter().map(|tick| tick * factor);
                scaled.collect::<Vec<_>>()
            });
            let (x, y) = (&x, &y);
            draw_grid(canvas, axes, &Field { x, y, values }, colors);
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
        }
    }
    let names = [0, 1].map(|axis| {
        let label = &*layout.scaled[axis].label;
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

fn draw_grid(canvas: &mut Canvas, axes: &PlaneAxes, field: &Field<'_>, colors: &Colors) {
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
    let mut labels: Vec<(PagePoint, String)> = Vec::new();
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
    for (at, label) in &labels {
        let [x, y] = half_size(label);
        let halo = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[dx, dy]| [at[0] + dx, at[1] + dy]);
        canvas.polygon(&halo, style::CONTOUR_HALO);
        canvas.text(label, *at, style::CONTOUR_LABEL);
    }
    draw_lone(canvas, axes, field, colors);
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
