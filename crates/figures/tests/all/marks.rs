//! Maps: the marks of extremes, colours of ratios, panels in columns.

use hyperstat_figures::{ColorScale, Extreme, FigureError, MapFigure, MapPanel, Quantity};
use resvg::usvg::roxmltree::{self, Document};

use crate::drawn::{points, texts};
use crate::maps::{cone, figure, frame, lefts, panel};

#[test]
fn extremes_are_marked_where_they_stand() {
    // A bowl whose least pose is at x = 0.1 m, y = -0.05 m, and whose largest is in the upper left.
    let bowl = |x: f64, y: f64| Some(1e6 * (1.0 + (x - 0.1).powi(2) + (y + 0.05).powi(2)));
    let map = MapFigure {
        marks: vec![Extreme::Least, Extreme::Most],
        ..figure(vec![panel(9, bowl)])
    };
    let svg = map.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let [[left, bottom], [right, top]] = frame(&document);
    let triangles: Vec<_> = document
        .descendants()
        .filter(|n| n.has_tag_name("polygon"))
        .map(points)
        .filter(|corners| corners.len() == 3)
        .collect();
    assert_eq!(triangles.len(), 2);
    for (triangle, [x, y], down) in [
        (&triangles[0], [0.1, -0.05], true),
        (&triangles[1], [-0.2, 0.2], false),
    ] {
        let expected = [
            left + (right - left) * (x + 0.2) / 0.4,
            bottom - (bottom - top) * (y + 0.2) / 0.4,
        ];
        let [tip, other, third] = triangle[..] else {
            panic!()
        };
        assert_eq!(tip[1] > other[1], down);
        let middle = [0.5 * (other[0] + third[0]), 0.5 * (tip[1] + other[1])];
        for k in 0..2 {
            assert!((middle[k] - expected[k]).abs() <= 1.5, "{middle:?}");
        }
    }
    let caption = "k33 from 1 MN/m to 1.152 MN/m. Least, ▼: 1 MN/m at x = 0.1 m, y = −50 mm. \
                   Largest, ▲: 1.152 MN/m at x = −0.2 m, y = 0.2 m.";
    assert_eq!(map.caption(), caption);
    let texts = texts(&document);
    for (label, [x, y]) in [("1 MN/m", triangles[0][0]), ("1.152 MN/m", triangles[1][0])] {
        let (_, at) = texts.iter().find(|(text, _)| text == label).unwrap();
        assert!((at[0] - x).hypot(at[1] - y) < 700.0, "{label}: {at:?}");
        assert!(at[0] > left && at[0] < right && at[1] > top && at[1] < bottom);
    }
    // Each plane has its own; values that differ by rounding are one, the first of them.
    let flat = |x: f64, y: f64| Some(1e6 * (1.0 + 1e-15 * (x - y)));
    let map = MapFigure {
        marks: vec![Extreme::Least],
        panels: vec![
            MapPanel {
                name: "z = 0.4 m".into(),
                ..panel(5, flat)
            },
            MapPanel {
                name: "z = 0.5 m".into(),
                ..panel(5, bowl)
            },
        ],
        ..figure(Vec::new())
    };
    let caption = "Least, ▼: 1 MN/m at x = −0.2 m, y = −0.2 m, z = 0.4 m.";
    assert!(map.caption().ends_with(caption), "{}", map.caption());
    let svg = map.svg().unwrap();
    let triangle = |n: &roxmltree::Node<'_, '_>| n.has_tag_name("polygon") && points(*n).len() == 3;
    assert_eq!(
        Document::parse(&svg)
            .unwrap()
            .descendants()
            .filter(triangle)
            .count(),
        2
    );
}

#[test]
fn ratios_have_colours_that_part_at_one() {
    // From 1/2 to 3 along x, evenly in the logarithm.
    let field = |x: f64, _| Some(0.5 * 6_f64.powf((x + 0.2) / 0.4));
    let map = MapFigure {
        scale: ColorScale::Ratio,
        quantity: Quantity::new("B / A", ""),
        ..figure(vec![panel(9, field)])
    };
    let svg = map.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let fills: Vec<_> = document
        .descendants()
        .filter(|n| n.has_tag_name("path"))
        .map(|path| path.attribute("fill").unwrap().to_string())
        .take(64)
        .collect();
    let channels =
        |fill: &str| [1, 3, 5].map(|k| i32::from_str_radix(&fill[k..k + 2], 16).unwrap());
    // Nearly white about 1, purple below it, orange above it.
    for middle in &fills[31..33] {
        assert!(channels(middle).iter().all(|c| *c > 225), "{middle}");
    }
    let [low, high] = [&fills[0], &fills[63]].map(|fill| channels(fill));
    assert!(low[2] > low[0] && high[2] < high[0], "{low:?} {high:?}");
    // The colours reach from 1/3 to 3: half of 1/3 … 3 is 1, at ln 2/ln 6 of the width.
    let [[left, _], [right, _]] = frame(&document);
    let lefts = lefts(&document);
    let one = left + (right - left) * 2_f64.ln() / 6_f64.ln();
    assert!((lefts[32] - one).abs() <= 20.0, "{} {one}", lefts[32]);
    assert_eq!(
        map.caption(),
        "B / A from 0.5 to 3. Colours that part at 1."
    );
    let below = figure(vec![panel(5, |x, _| Some(x))]);
    let below = MapFigure {
        scale: ColorScale::Ratio,
        ..below
    };
    assert!(matches!(below.svg(), Err(FigureError::Logarithm { .. })));
}

#[test]
fn panels_stand_in_as_many_columns_as_are_asked_for() {
    let panels = (0..6).map(|k| MapPanel {
        name: format!("plane {k}"),
        ..panel(5, cone)
    });
    let map = MapFigure {
        columns: Some(2),
        ..figure(panels.collect())
    };
    let svg = map.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    let at = |k: usize| {
        let name = format!("plane {k}");
        texts.iter().find(|(text, _)| *text == name).unwrap().1
    };
    for k in [0, 2, 4] {
        assert!(at(k)[1] == at(k + 1)[1] && at(k)[0] < at(k + 1)[0]);
    }
    assert!(at(0)[1] < at(2)[1] && at(0)[0] == at(4)[0]);
}
