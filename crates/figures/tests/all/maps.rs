//! Maps: contours and colours where the field says, marks of what is missing, the same bytes
//! again, and data that cannot be drawn.

use hyperstat_figures::{ColorScale, Extreme, FigureError, MapFigure, MapPanel, Quantity, Samples};
use resvg::usvg::roxmltree::{self, Document};

use crate::drawn::{points, texts};

/// A grid of n×n points over a square of half side 0.2.
fn ticks(n: u32) -> Vec<f64> {
    let part = |k| f64::from(k) / f64::from(n - 1);
    (0..n).map(|k| -0.2 + 0.4 * part(k)).collect()
}

pub fn panel(n: u32, field: impl Fn(f64, f64) -> Option<f64>) -> MapPanel {
    let ticks = ticks(n);
    let field = &field;
    let rows = ticks
        .iter()
        .map(|y| ticks.iter().map(move |x| field(*x, *y)));
    MapPanel {
        name: String::new(),
        axes: None,
        samples: Samples::Grid {
            values: rows.flatten().collect(),
            x: ticks.clone(),
            y: ticks.clone(),
        },
    }
}

pub fn figure(panels: Vec<MapPanel>) -> MapFigure {
    MapFigure {
        title: "map <1>".into(),
        subtitle: "k33: a stiffness; z = 0.5 m.".into(),
        axes: ["x", "y"].map(|name| Quantity::new(name, "m")),
        quantity: Quantity::new("k33", "N/m"),
        limits: None,
        scale: ColorScale::Auto,
        panels,
        columns: None,
        marks: Vec::new(),
    }
}

/// A cone of 2 MN/m at the origin, less 5 MN/m per m away from it.
pub fn cone(x: f64, y: f64) -> Option<f64> {
    Some(2e6 - 5e6 * x.hypot(y))
}

/// The frame of the first panel: the closed line of five points that is drawn first.
pub fn frame(document: &Document<'_>) -> [[f64; 2]; 2] {
    let lines = document
        .descendants()
        .filter(|n| n.has_tag_name("polyline"));
    let mut lines = lines.map(points);
    let frame = lines
        .find(|line| line.len() == 5 && line[0] == line[4])
        .unwrap();
    [frame[3], frame[1]]
}

/// The frames of all panels: closed lines around rectangles.
fn frames(document: &Document<'_>) -> Vec<[[f64; 2]; 2]> {
    let lines = document
        .descendants()
        .filter(|n| n.has_tag_name("polyline"));
    let closed = lines
        .map(points)
        .filter(|line| line.len() == 5 && line[0] == line[4]);
    let straight = |a: [f64; 2], b: [f64; 2]| a[0] == b[0] || a[1] == b[1];
    closed
        .filter(|line| line.windows(2).all(|pair| straight(pair[0], pair[1])))
        .map(|line| [line[3], line[1]])
        .collect()
}

#[test]
fn contours_lie_where_the_field_has_their_value() {
    let svg = figure(vec![panel(161, cone)]).svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let [[left, bottom], [right, top]] = frame(&document);
    // The same scale along both axes.
    assert!((right - left - (bottom - top)).abs() <= 1.0);
    let metres = |[x, y]: [f64; 2]| {
        [
            -0.2 + 0.4 * (x - left) / (right - left),
            -0.2 + 0.4 * (bottom - y) / (bottom - top),
        ]
    };
    let curves: Vec<Vec<[f64; 2]>> = document
        .descendants()
        .filter(|n| n.has_tag_name("polyline"))
        .map(points)
        .filter(|line| line.len() > 20)
        .collect();
    let mut radii = Vec::new();
    for curve in &curves {
        let distance = |point: &[f64; 2]| {
            let [x, y] = metres(*point);
            x.hypot(y)
        };
        let radius = distance(&curve[0]);
        // A tenth of a pixel, and the chord of a cell of 2.5 mm.
        let off = 0.4 / (right - left) + 0.0025_f64.powi(2) / 8.0 / radius;
        for point in curve {
            assert!((distance(point) - radius).abs() < 2.0 * off, "{radius}");
        }
        radii.push(radius);
    }
    // From 2 − 5·0.2√2 = 0.586 to 2 MN/m: contours at 0.6, 0.8 … 1.8, all circles about the
    // origin, those beyond 0.2 m in four arcs.
    for (value, arcs) in [
        (0.6, 4),
        (0.8, 4),
        (1.0, 1),
        (1.2, 1),
        (1.4, 1),
        (1.6, 1),
        (1.8, 1),
    ] {
        let radius = (2.0 - value) / 5.0;
        let found = radii.iter().filter(|r| (*r - radius).abs() < 5e-4).count();
        // 1.0 touches the middles of the sides; 0.6 is four corners of few points.
        match value {
            0.6 => {}
            1.0 => assert!(found >= 1, "{value}: {radii:?}"),
            _ => assert_eq!(found, arcs, "{value}: {radii:?}"),
        }
    }
}

#[test]
fn texts_state_quantity_unit_range_and_what_is_missing() {
    let hole = |x: f64, y: f64| (x.hypot(y) > 0.04).then(|| cone(x, y)).flatten();
    let svg = figure(vec![panel(9, hole)]).svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    for text in [
        "map <1>",
        "k33: a stiffness; z = 0.5 m.",
        "k33 (MN/m)",
        "x (m)",
        "y (m)",
        "k33 from 585.8 kN/m to 1.75 MN/m. 1 of 81 poses without a result, marked ×.",
        "−0.20",
        "1.2",
    ] {
        assert!(
            texts.iter().any(|(found, _)| found == text),
            "no `{text}` in {texts:?}"
        );
    }
    let description = document.descendants().find(|n| n.has_tag_name("desc"));
    let description = description.unwrap().text().unwrap();
    assert!(
        description.contains("z = 0.5 m. k33 from 585.8 kN/m"),
        "{description}"
    );
}

#[test]
fn colours_run_evenly_from_dark_to_light() {
    // A slope along x: the shades' regions end at equal distances, dark ones to the left.
    let svg = figure(vec![panel(5, |x, _| Some(1e6 * (x + 0.2)))])
        .svg()
        .unwrap();
    let document = Document::parse(&svg).unwrap();
    let paths: Vec<_> = document
        .descendants()
        .filter(|n| n.has_tag_name("path"))
        .take(64)
        .collect();
    // Matplotlib's table of viridis at the middles of these shades, to a rounding of its 256 rows.
    for (shade, published) in [(0, [69, 4, 87]), (32, [32, 147, 140]), (63, [251, 231, 35])] {
        let fill = paths[shade].attribute("fill").unwrap();
        for (k, channel) in published.into_iter().enumerate() {
            let found = i32::from_str_radix(&fill[2 * k + 1..2 * k + 3], 16).unwrap();
            assert!((found - channel).abs() <= 3, "{shade}: {fill}");
        }
    }
    let lefts: Vec<f64> = paths
        .iter()
        .map(|path| {
            let d = path.attribute("d").unwrap();
            let xs = d.split(['M', 'L', 'Z']).filter(|p| !p.is_empty());
            xs.map(|p| p.split(' ').next().unwrap().parse::<f64>().unwrap())
                .fold(f64::INFINITY, f64::min)
        })
        .collect();
    let [[left, _], [right, _]] = frame(&document);
    for (k, found) in lefts.iter().enumerate() {
        let expected = left + (right - left) * k as f64 / 64.0;
        assert!((found - expected).abs() <= 1.0, "{k}: {found} {expected}");
    }
}

/// Left ends of the shades' regions, in tenths of a pixel.
pub fn lefts(document: &Document<'_>) -> Vec<f64> {
    let paths = document.descendants().filter(|n| n.has_tag_name("path"));
    let left = |path: roxmltree::Node<'_, '_>| {
        let d = path.attribute("d").unwrap();
        let xs = d.split(['M', 'L', 'Z']).filter(|p| !p.is_empty());
        xs.map(|p| p.split(' ').next().unwrap().parse::<f64>().unwrap())
            .fold(f64::INFINITY, f64::min)
    };
    paths.map(left).collect()
}

#[test]
fn logarithmic_colours_are_even_in_the_logarithm() {
    // Three decades along x: the shades' regions end at equal distances.
    let field = |x: f64, _| Some(1e-3 * 10_f64.powf(7.5 * (x + 0.2)));
    for scale in [ColorScale::Log, ColorScale::Auto] {
        let map = MapFigure {
            scale,
            quantity: Quantity::new("deflection", "m"),
            ..figure(vec![panel(9, field)])
        };
        let svg = map.svg().unwrap();
        let document = Document::parse(&svg).unwrap();
        let [[left, _], [right, _]] = frame(&document);
        for (k, found) in lefts(&document).iter().take(64).enumerate() {
            let expected = left + (right - left) * k as f64 / 64.0;
            assert!((found - expected).abs() <= 1.0, "{k}: {found} {expected}");
        }
        let texts = texts(&document);
        for text in ["0.001", "0.01", "0.1", "1", "0.5", "deflection (m)"] {
            assert!(
                texts.iter().any(|(found, _)| found == text),
                "{text}: {texts:?}"
            );
        }
        assert_eq!(
            map.caption(),
            "deflection from 1 mm to 1 m. Logarithmic colours."
        );
    }
}

#[test]
fn values_beyond_the_limits_have_the_last_colours() {
    let slope = |x: f64, _| Some(1e6 * (x + 0.2));
    let map = MapFigure {
        limits: Some([1e5, 3e5]),
        ..figure(vec![panel(5, slope)])
    };
    let svg = map.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let [[left, _], [right, _]] = frame(&document);
    // The first shade from the left edge on, the others from a quarter to three quarters.
    for (k, found) in lefts(&document).iter().take(64).enumerate() {
        let part = if k == 0 {
            0.0
        } else {
            0.25 + 0.5 * k as f64 / 64.0
        };
        let expected = left + (right - left) * part;
        assert!((found - expected).abs() <= 1.0, "{k}: {found} {expected}");
    }
    assert_eq!(
        map.caption(),
        "k33 from 0 N/m to 400 kN/m. Colours from 100 kN/m to 300 kN/m."
    );
    // The bar has a tip at either end: two triangles more than without limits.
    let paths = |svg: &str| svg.matches("<path ").count();
    let whole = figure(vec![panel(5, slope)]).svg().unwrap();
    assert_eq!(paths(&svg), paths(&whole) + 2);

    let refused = |limits, scale| {
        let map = MapFigure {
            limits,
            scale,
            ..figure(vec![panel(5, slope)])
        };
        map.svg().unwrap_err().to_string()
    };
    let ends = refused(Some([1.0, 1.0]), ColorScale::Auto);
    assert_eq!(
        ends,
        "the colours go from 1 to 1; they need two finite numbers, ascending"
    );
    let zero = refused(None, ColorScale::Log);
    assert_eq!(
        zero,
        "a logarithmic scale needs values above zero, and would begin at 0"
    );
}

#[test]
fn contours_of_a_coarse_grid_are_smooth() {
    // Nine by nine points of 2 MN/m less 20 MN/m per m² away from the origin: on circles.
    let bowl = |x: f64, y: f64| Some(2e6 - 2e7 * (x * x + y * y));
    let svg = figure(vec![panel(9, bowl)]).svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let [[left, bottom], [right, top]] = frame(&document);
    let radius = |[x, y]: &[f64; 2]| {
        let x = -0.2 + 0.4 * (x - left) / (right - left);
        let y = -0.2 + 0.4 * (bottom - y) / (bottom - top);
        x.hypot(y)
    };
    let lines = document
        .descendants()
        .filter(|n| n.has_tag_name("polyline"));
    let curves: Vec<_> = lines.map(points).filter(|line| line.len() > 50).collect();
    // 1.5 MN/m a circle, 1 MN/m an arc at each corner.
    assert_eq!(curves.len(), 5);
    for curve in &curves {
        let radii: Vec<f64> = curve.iter().map(radius).collect();
        let [least, most] = radii
            .iter()
            .fold([f64::INFINITY, 0.0_f64], |[least, most], r| {
                [least.min(*r), most.max(*r)]
            });
        // A tenth of a pixel, and the chord of a part of a cell of 5 pixels. Straight lines through
        // the cells of 0.05 m would be off by 0.05²/4/2r = 2e-3 m at r = 0.15 m.
        let off = 2.0 * (0.4 / (right - left) + 0.003_f64.powi(2) / 8.0 / least);
        assert!(most - least < 2.0 * off, "{least} {most}");
        let near = |square: f64| (square.sqrt() - most).abs() < 2.0 * off;
        assert!(near(0.025) || near(0.05), "{most}");
    }
}

#[test]
fn the_unit_of_the_bar_is_whole() {
    let many = (0..4).map(|k| panel(5, move |x, y| cone(x, y).map(|v| v + f64::from(k))));
    let map = MapFigure {
        quantity: Quantity::new("rotational_stiffness_min", "N·m/rad"),
        ..figure(many.collect())
    };
    let svg = map.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    let unit = texts
        .iter()
        .filter(|(text, _)| text.ends_with("(MN·m/rad)"));
    assert_eq!(unit.count(), 1, "{texts:?}");
    assert!(
        texts
            .iter()
            .any(|(text, _)| text == "rotational_stiffness_min")
    );
}

#[test]
fn panels_share_scale_and_colours() {
    let panels = (0..7).map(|k| MapPanel {
        name: format!("z = 0.{k} m"),
        ..panel(5, move |x, y| cone(x, y).map(|v| v + 1e5 * f64::from(k)))
    });
    let svg = figure(panels.collect()).svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    for k in 0..7 {
        let name = format!("z = 0.{k} m");
        assert!(texts.iter().any(|(text, _)| *text == name), "{name}");
    }
    assert_eq!(
        texts
            .iter()
            .filter(|(text, _)| text == "k33 (MN/m)")
            .count(),
        1
    );
    // Three rows: y is named at each, x under each column.
    assert_eq!(texts.iter().filter(|(text, _)| text == "y (m)").count(), 3);
    assert_eq!(texts.iter().filter(|(text, _)| text == "x (m)").count(), 3);
    for (text, [x, y]) in texts {
        let height: f64 = document
            .root_element()
            .attribute("height")
            .unwrap()
            .parse()
            .unwrap();
        assert!(
            (0.0..=9000.0).contains(&x) && (0.0..=10.0 * height).contains(&y),
            "{text}"
        );
    }
}

#[test]
fn the_same_data_give_the_same_bytes() {
    let figure = figure(vec![panel(21, cone)]);
    assert_eq!(figure.svg().unwrap(), figure.svg().unwrap());
    let png = figure.png().unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!(png, figure.png().unwrap());
}

#[test]
fn scattered_points_are_dots() {
    let at: Vec<_> = (0..10)
        .map(|k| [0.01 * f64::from(k * k), 0.02 * f64::from(k)])
        .collect();
    let values = (0..10)
        .map(|k| (k != 3).then(|| 1e5 * f64::from(k)))
        .collect();
    let samples = Samples::Points { at, values };
    let name = String::new();
    let svg = figure(vec![MapPanel {
        name,
        axes: None,
        samples,
    }])
    .svg()
    .unwrap();
    let document = Document::parse(&svg).unwrap();
    let dots = document.descendants().filter(|n| n.has_tag_name("circle"));
    assert_eq!(dots.count(), 9);
    assert!(svg.contains("1 of 10 poses without a result"));
}

#[test]
fn fields_at_the_edge_of_what_can_be_drawn() {
    type Field = fn(f64, f64) -> Option<f64>;
    let fields: [(&str, Field); 6] = [
        ("constant", |_, _| Some(1e6)),
        ("zero", |_, _| Some(0.0)),
        ("noise", |x, _| Some(1e6 * (1.0 + 1e-15 * x))),
        ("tiny", |x, y| Some(1e-200 * (x + y))),
        ("large", |x, y| Some(1e99 * (x + y))),
        ("one", |x, y| (x < -0.19 && y < -0.19).then_some(5.0)),
    ];
    for (name, field) in fields {
        for n in [2, 3, 12] {
            let svg = figure(vec![panel(n, field)]).svg().unwrap();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name} {n}");
            Document::parse(&svg).unwrap();
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_an_error() {
    let nothing = figure(vec![panel(3, |_, _| None)]);
    assert!(matches!(nothing.svg(), Err(FigureError::NoPoints { .. })));
    assert!(matches!(
        figure(Vec::new()).svg(),
        Err(FigureError::NoPoints { .. })
    ));
    for value in [f64::NAN, f64::INFINITY, 1e200] {
        let figure = figure(vec![panel(3, move |x, _| {
            Some(if x > 0.1 { value } else { 1.0 })
        })]);
        let error = figure.svg().unwrap_err();
        assert!(
            matches!(&error, FigureError::InvalidNumber { index: 2, what, .. }
                if what == "panel 0, values"),
            "{error}"
        );
    }
    let mut short = panel(3, cone);
    if let Samples::Grid { values, .. } = &mut short.samples {
        values.pop();
    }
    let error = figure(vec![short]).svg().unwrap_err();
    assert_eq!(
        error.to_string(),
        "panel 0: 8 values for 9 points, one each is needed"
    );
    let mut back = panel(3, cone);
    if let Samples::Grid { x, .. } = &mut back.samples {
        x.reverse();
    }
    let error = figure(vec![back]).svg().unwrap_err();
    assert!(matches!(error, FigureError::NoGrid { .. }), "{error}");
}

/// Planes of other axes have names and ranges of their own, each to scale.
#[test]
fn planes_of_other_axes_are_drawn_along_them() {
    let plane = |name: &str, axes: [&str; 2], up: f64| {
        let mut panel = panel(5, cone);
        if let Samples::Grid { y, .. } = &mut panel.samples {
            y.iter_mut().for_each(|y| *y *= up);
        }
        panel.name = name.into();
        panel.axes = Some(axes.map(|name| Quantity::new(name, "m")));
        panel
    };
    let mut map = figure(vec![
        plane("x = 0 m", ["y", "z"], 0.5),
        plane("y = 0 m", ["x", "z"], 0.5),
        plane("z = 0.5 m", ["x", "y"], 1.0),
    ]);
    map.marks = vec![Extreme::Most];
    assert!(
        map.caption()
            .contains("Largest, ▲: 2 MN/m at y = 0 m, z = 0 m, x = 0 m."),
        "{}",
        map.caption()
    );
    let svg = map.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    for (name, count) in [("x (m)", 2), ("y (m)", 2), ("z (m)", 2), ("k33 (MN/m)", 1)] {
        let found = texts.iter().filter(|(text, _)| text == name).count();
        assert_eq!(found, count, "{name}");
    }
    let sides: Vec<[f64; 2]> = frames(&document)
        .into_iter()
        .map(|[a, b]| [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()])
        .collect();
    // Two rows: one beside another, the third below.
    for (side, ratio) in sides.iter().zip([0.5, 0.5, 1.0]) {
        assert!((side[1] - ratio * side[0]).abs() < 0.05, "{sides:?}");
    }
}
