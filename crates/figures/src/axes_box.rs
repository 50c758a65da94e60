//! The box of axes behind a drawing: three walls with a grid, three axes with ticks and names.

use crate::canvas::{Canvas, text_width};
use crate::geometry::{Bounds, PagePoint, Point, View};
use crate::numbers;
use crate::round;
use crate::style;

/// Least distance of ticks along an axis \[pixels\].
const TICK_DISTANCE: f64 = 45.0;

/// Length of a tick \[pixels\].
const TICK_LENGTH: f64 = 5.0;

/// Free space around letters \[pixels\].
const GAP: f64 = 6.0;

/// Free space at the left edge of the page, which long names keep \[pixels\].
const MARGIN: f64 = 8.0;

/// How far the ends of an axis that is upright on the page are apart across it \[pixels\].
const UPRIGHT: f64 = 1.0;

/// Names of the axes.
pub(crate) const NAMES: [&str; 3] = ["x", "y", "z"];

/// Draws the box of axes, which have these names.
pub(crate) fn draw(canvas: &mut Canvas, view: &View, bounds: &Bounds, names: [&str; 3]) {
    let steps = std::array::from_fn(|axis| step(view, bounds, axis));
    // The walls behind everything: those that the eye looks at from inside.
    for normal in (0..3).filter(|normal| !view.is_edge_on(*normal)) {
        draw_wall(
            canvas,
            view,
            bounds,
            steps,
            normal,
            !view.is_from_max(normal),
        );
    }
    for (axis, step) in steps.into_iter().enumerate() {
        if !view.is_end_on(axis) {
            draw_axis(canvas, view, bounds, step, (axis, names[axis]));
        }
    }
}

/// The corner, as in [`Bounds::corner`], where the edge of the box starts that an axis is written along:
/// an edge that is outside on the page.
fn start(view: &View, bounds: &Bounds, axis: usize) -> [bool; 3] {
    let is_below = !view.is_from_max(2) && !view.is_edge_on(2);
    match axis {
        0 => [false, view.is_from_max(1), is_below],
        1 => [view.is_from_max(0), false, is_below],
        // The upright edge farthest to the left.
        _ => {
            let corners = [[false, false], [false, true], [true, false], [true, true]];
            let left = |[x, y]: [bool; 2]| view.project(bounds.corner([x, y, false]))[0];
            let least = corners
                .into_iter()
                .min_by(|a, b| left(*a).total_cmp(&left(*b)));
            let [x, y] = least.unwrap_or_default();
            [x, y, false]
        }
    }
}

/// The edge of the box that an axis is written along, on the page.
fn edge(view: &View, bounds: &Bounds, axis: usize) -> [PagePoint; 2] {
    let mut corner = start(view, bounds, axis);
    [false, true].map(|at_max| {
        corner[axis] = at_max;
        view.project(bounds.corner(corner))
    })
}

/// The round distance of the ticks on an axis \[m\]: the least that leaves room for labels.
fn step(view: &View, bounds: &Bounds, axis: usize) -> f64 {
    let [from, to] = edge(view, bounds, axis);
    let edge = [to[0] - from[0], to[1] - from[1]];
    let edge_length = edge[0].hypot(edge[1]);
    if view.is_end_on(axis) {
        return bounds.sides()[axis];
    }
    let side = bounds.sides()[axis];
    let round_step = |distance: f64| round::up(distance / edge_length * side).unwrap_or(side);
    let fine = round_step(TICK_DISTANCE);
    // Coarser ticks have shorter labels.
    let width = [bounds.min[axis], bounds.max[axis]]
        .map(|end| text_width(&numbers::tick(end, fine), style::TICK.size))
        .into_iter()
        .fold(0.0, f64::max);
    // Labels are apart where they are so in either direction of the page.
    let apart_across = (width + GAP) * edge_length / edge[0].abs();
    let apart_upright = 1.4 * style::TICK.size * edge_length / edge[1].abs();
    round_step(TICK_DISTANCE.max(apart_across.min(apart_upright)))
}

/// Coordinates of the ticks along an axis.
fn ticks(bounds: &Bounds, axis: usize, step: f64) -> impl Iterator<Item = f64> {
    let first = (bounds.min[axis] / step).ceil() as i64;
    let last = (bounds.max[axis] / step).floor() as i64;
    (first..=last).map(move |k| k as f64 * step)
}

fn draw_wall(
    canvas: &mut Canvas,
    view: &View,
    bounds: &Bounds,
    steps: [f64; 3],
    normal: usize,
    at_max: bool,
) {
    let across = [(normal + 1) % 3, (normal + 2) % 3];
    let corner = |largest: [bool; 2]| {
        let mut of_box = [false; 3];
        of_box[normal] = at_max;
        of_box[across[0]] = largest[0];
        of_box[across[1]] = largest[1];
        bounds.corner(of_box)
    };
    for (axis, other) in [(across[0], across[1]), (across[1], across[0])] {
        for value in ticks(bounds, axis, steps[axis]) {
            let ends = [bounds.min[other], bounds.max[other]].map(|end| {
                let mut point = corner([false; 2]);
                point[axis] = value;
                point[other] = end;
                view.project(point)
            });
            canvas.line(&ends, style::GRID);
        }
    }
    let outline = [
        [false, false],
        [true, false],
        [true, true],
        [false, true],
        [false, false],
    ];
    canvas.line(
        &outline.map(|largest| view.project(corner(largest))),
        style::EDGE,
    );
}

fn draw_axis(
    canvas: &mut Canvas,
    view: &View,
    bounds: &Bounds,
    step: f64,
    (axis, name): (usize, &str),
) {
    let (name, start) = (&*format!("{name} (m)"), start(view, bounds, axis));
    let along = |value: f64| -> Point {
        let mut point = bounds.corner(start);
        point[axis] = value;
        point
    };
    let ends = edge(view, bounds, axis);
    canvas.line(&ends, style::AXIS);
    let outward = outward(ends, view.project(bounds.center()));
    let mut depth: f64 = 0.0;
    for value in ticks(bounds, axis, step) {
        let at = view.project(along(value));
        canvas.line(&[at, away(at, outward, TICK_LENGTH)], style::AXIS);
        let label = numbers::tick(value, step);
        let reach = reach(&label, style::TICK.size, outward);
        let distance = TICK_LENGTH + GAP + reach;
        canvas.text(&label, away(at, outward, distance), style::TICK);
        depth = depth.max(distance + reach);
    }
    let reach = reach(name, style::AXIS_NAME.size, outward);
    let least = MARGIN + 0.5 * text_width(name, style::AXIS_NAME.size);
    let middle = [0, 1].map(|k| 0.5 * (ends[0][k] + ends[1][k]));
    let beside = away(middle, outward, depth + GAP + reach);
    let is_upright = (ends[1][0] - ends[0][0]).abs() < UPRIGHT;
    // The name of the upright axis is above its labels: beside them there is less room.
    let at = if axis == 2 || (is_upright && beside[0] < least) {
        let upper = if ends[0][1] < ends[1][1] {
            ends[0]
        } else {
            ends[1]
        };
        let [x, y] = away(upper, outward, GAP + reach);
        [x.max(least), y - 1.4 * style::AXIS_NAME.size]
    } else {
        beside
    };
    canvas.text(name, at, style::AXIS_NAME);
}

/// The direction on the page that is normal to an edge and away from the centre of the box.
fn outward(ends: [PagePoint; 2], center: PagePoint) -> PagePoint {
    let [from, to] = ends;
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    let normal = [along[1] / length, -along[0] / length];
    let inward = normal[0] * (center[0] - from[0]) + normal[1] * (center[1] - from[1]) > 0.0;
    if inward { normal.map(|c| -c) } else { normal }
}

fn away(from: PagePoint, direction: PagePoint, distance: f64) -> PagePoint {
    [
        from[0] + distance * direction[0],
        from[1] + distance * direction[1],
    ]
}

/// How far a centred text of one line extends along a direction \[pixels\].
fn reach(text: &str, size: f64, direction: PagePoint) -> f64 {
    0.5 * (text_width(text, size) * direction[0].abs() + size * direction[1].abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Area;
    use crate::viewpoint::Viewpoint;

    const AREA: Area = Area {
        left: 0.0,
        top: 0.0,
        right: 500.0,
        bottom: 400.0,
    };

    fn ticks_of(min: Point, sides: Point, axis: usize) -> Vec<String> {
        let max = std::array::from_fn(|k| min[k] + sides[k]);
        let bounds = Bounds { min, max }.roomy();
        let step = step(
            &View::fit(&bounds, AREA, Viewpoint::default()),
            &bounds,
            axis,
        );
        ticks(&bounds, axis, step)
            .map(|value| numbers::tick(value, step))
            .collect()
    }

    #[test]
    fn all_axes_have_a_few_ticks() {
        for sides in [
            [1.0, 1.0, 1.0],
            [1.0, 0.0, 0.1],
            [0.0, 1.0, 0.0],
            [0.3, 0.3, 2.0],
        ] {
            for size in [1e-9, 1e-3, 0.37, 0.61, 0.99, 1.7, 2.9, 7e6, 1e99] {
                for axis in 0..3 {
                    let ticks = ticks_of([-0.01 * size; 3], sides.map(|side| size * side), axis);
                    assert!(
                        (1..=10).contains(&ticks.len()),
                        "{sides:?} {size} {axis}: {ticks:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn ticks_are_at_round_coordinates() {
        let ticks = ticks_of([-0.25; 3], [0.5; 3], 2);
        assert_eq!(ticks, ["−0.2", "−0.1", "0.0", "0.1", "0.2"]);
    }

    #[test]
    fn long_labels_are_farther_apart() {
        let near = ticks_of([0.0; 3], [0.1; 3], 0);
        let far = ticks_of([1e5; 3], [0.1; 3], 0);
        assert!(far.len() < near.len(), "{near:?} {far:?}");
        assert!(!far.is_empty());
    }
}
