//! Lines on the page with fewer points that look the same.

use std::borrow::Cow;

use crate::geometry::PagePoint;

/// Lines of so many points are drawn as they are.
const FEW: usize = 2000;

/// Width of a column of the page in which only the ends and the extremes of a line are seen
/// \[pixels\].
const COLUMN: f64 = 0.25;

/// How far a point may be from a straight line to be left out of it \[pixels\].
const STRAIGHT: f64 = 0.04;

/// Most points that are left out in a row.
const LEFT_OUT: usize = 32;

/// Length of a line \[pixels\].
pub(crate) fn length(line: &[PagePoint]) -> f64 {
    line.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

fn distance(a: PagePoint, b: PagePoint) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The point so far along a line.
pub(crate) fn along(line: &[PagePoint], mut far: f64) -> PagePoint {
    for pair in line.windows(2) {
        let step = distance(pair[0], pair[1]);
        if far <= step && step > 0.0 {
            return [0, 1].map(|k| pair[0][k] + far / step * (pair[1][k] - pair[0][k]));
        }
        far -= step;
    }
    line[line.len() - 1]
}

/// A line of which neighbours in one narrow column of the page are drawn by the first, the highest,
/// the lowest and the last of them: what a line of any number of points looks like.
pub(crate) fn thinned(line: &[PagePoint]) -> Cow<'_, [PagePoint]> {
    if line.len() <= FEW {
        return Cow::Borrowed(line);
    }
    let column = |point: &PagePoint| (point[0] / COLUMN).floor();
    let mut thinned = Vec::new();
    let mut rest = line;
    while let Some(first) = rest.first() {
        let own = column(first);
        let count = rest.iter().take_while(|point| column(point) == own).count();
        let (here, after) = rest.split_at(count.max(1));
        let by_height = |a: &usize, b: &usize| here[*a][1].total_cmp(&here[*b][1]);
        let highest = (0..here.len()).min_by(by_height).unwrap_or(0);
        let lowest = (0..here.len()).max_by(by_height).unwrap_or(0);
        let mut kept = [0, highest, lowest, here.len() - 1];
        kept.sort_unstable();
        let mut last = None;
        for k in kept {
            if last != Some(k) {
                thinned.push(here[k]);
            }
            last = Some(k);
        }
        rest = after;
    }
    Cow::Owned(thinned)
}

/// A line without the points that lie on the straight way between their neighbours.
pub(crate) fn straightened(line: &[PagePoint]) -> Vec<PagePoint> {
    let mut kept: Vec<PagePoint> = Vec::with_capacity(line.len());
    let mut from = 0;
    kept.extend(line.first());
    while from + 1 < line.len() {
        let mut to = from + 1;
        while to + 1 < line.len()
            && to - from < LEFT_OUT
            && line[from + 1..=to]
                .iter()
                .all(|point| off(*point, line[from], line[to + 1]) <= STRAIGHT)
        {
            to += 1;
        }
        kept.push(line[to]);
        from = to;
    }
    kept
}

/// Distance of a point from the straight way from a to b.
fn off(point: PagePoint, a: PagePoint, b: PagePoint) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let to = [point[0] - a[0], point[1] - a[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    if square == 0.0 {
        return distance(point, a);
    }
    let part = ((to[0] * way[0] + to[1] * way[1]) / square).clamp(0.0, 1.0);
    (to[0] - part * way[0]).hypot(to[1] - part * way[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thinned_line_keeps_ends_and_extremes_of_every_column() {
        // 100 000 points over 600 pixels, up and down by 200 pixels.
        let height = |k: usize| 200.0 * (0.7 * k as f64).sin() + (k % 7) as f64;
        let line: Vec<_> = (0..100_000)
            .map(|k| [0.006 * k as f64, height(k)])
            .collect();
        let thin = thinned(&line);
        assert!(thin.len() <= 4 * 2401, "{}", thin.len());
        assert_eq!((thin[0], thin[thin.len() - 1]), (line[0], line[99_999]));
        let range = |line: &[PagePoint], column: f64| {
            let inside = line.iter().filter(|p| (p[0] / COLUMN).floor() == column);
            inside.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], p| {
                [least.min(p[1]), most.max(p[1])]
            })
        };
        for column in [0.0, 17.0, 1200.0, 2399.0] {
            assert_eq!(range(&thin, column), range(&line, column));
        }
        assert!(thin.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
        assert_eq!(&*thinned(&line[..50]), &line[..50]);
    }

    #[test]
    fn a_straightened_line_keeps_its_corners() {
        let square: Vec<_> = (0..=40)
            .map(|k| match f64::from(k) {
                t if t <= 10.0 => [t, 0.0],
                t if t <= 20.0 => [10.0, t - 10.0],
                t if t <= 30.0 => [30.0 - t, 10.0],
                t => [0.0, 40.0 - t],
            })
            .collect();
        let corners = [
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 10.0],
            [0.0, 10.0],
            [0.0, 0.0],
        ];
        assert_eq!(straightened(&square), corners);
        let on_circle = |k: i32| {
            let t = 0.01 * f64::from(k);
            [50.0 * t.cos(), 50.0 * t.sin()]
        };
        let circle: Vec<_> = (0..1000).map(on_circle).collect();
        let fewer = straightened(&circle);
        assert!(fewer.len() < 300, "{}", fewer.len());
        // Every point that was left out is near a side that is there.
        for point in &circle {
            let nearest = fewer.windows(2).map(|s| off(*point, s[0], s[1]));
            assert!(nearest.fold(f64::INFINITY, f64::min) <= STRAIGHT);
        }
    }
}
