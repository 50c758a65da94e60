//! Lines along a variable: drawn where their numbers say, with gaps, and data that cannot be
//! drawn.

use hyperstat_figures::{Diagram, FigureError, LineFigure, Quantity, Series};
use resvg::usvg::roxmltree::Document;

use crate::drawn::points;

/// A parabola of 400 µm and its negative over 0 to 0.2 m, and a straight stiffness.
fn figure() -> LineFigure {
    let at: Vec<f64> = (0..=20).map(|k| 0.01 * f64::from(k)).collect();
    let series = |name: &str, of: &dyn Fn(f64) -> f64| Series {
        name: name.into(),
        at: at.clone(),
        values: at.iter().map(|x| Some(of(*x))).collect(),
    };
    LineFigure {
        title: "path".into(),
        subtitle: "dz and more.".into(),
        over: Quantity::new("x", "m"),
        categories: Vec::new(),
        diagrams: vec![
            Diagram {
                name: "dz, dx".into(),
                legend: String::new(),
                unit: "m".into(),
                series: vec![
                    series("dz", &|x| 1e-2 * x * x),
                    series("dx", &|x| -1e-2 * x * x),
                ],
            },
            Diagram {
                name: "k33".into(),
                legend: String::new(),
                unit: "N/m".into(),
                series: vec![series("k33", &|x| 1e6 * (1.0 + x))],
            },
        ],
    }
}

/// The lines of a colour, in tenths of a pixel.
fn lines(svg: &str, color: &str) -> Vec<Vec<[f64; 2]>> {
    let document = Document::parse(svg).unwrap();
    let of_color = document
        .descendants()
        .filter(|n| n.has_tag_name("polyline") && n.attribute("stroke") == Some(color));
    of_color.map(points).collect()
}

#[test]
fn a_line_is_drawn_where_its_numbers_say() {
    let svg = figure().svg().unwrap();
    let parabola = &lines(&svg, "#0072B2")[0];
    assert_eq!(parabola.len(), 21);
    let ([x0, y0], [x1, y1]) = (parabola[0], parabola[20]);
    for (k, [x, y]) in parabola.iter().enumerate() {
        let part = k as f64 / 20.0;
        assert!((x - x0 - part * (x1 - x0)).abs() <= 1.0);
        assert!((y - y0 - part * part * (y1 - y0)).abs() <= 1.0);
    }
    for text in ["dz, dx (µm)", "k33 (MN/m)", "x (m)", "0.20", "−400"] {
        assert!(
            svg.contains(&format!(">\n{text}\n<")),
            "no `{text}` in {svg}"
        );
    }
    assert_eq!(
        figure().caption(),
        "dz from 0 m to 400 µm; dx from −400 µm to 0 m; k33 from 1 MN/m to 1.2 MN/m."
    );
}

#[test]
fn a_line_has_gaps_where_values_are_missing() {
    let mut gapped = figure();
    gapped.diagrams[0].series[0].values[7] = None;
    gapped.diagrams[0].series[0].values[9] = None;
    let svg = gapped.svg().unwrap();
    let lengths: Vec<_> = lines(&svg, "#0072B2").iter().map(Vec::len).collect();
    // Seven points, one alone as a dot, eleven; then the legend and the other diagram.
    assert_eq!(lengths[..2], [7, 11]);
    assert_eq!(svg, gapped.svg().unwrap());
}

#[test]
fn what_cannot_be_drawn_is_an_error() {
    let mut short = figure();
    short.diagrams[1].series[0].values.pop();
    let error = short.svg().unwrap_err();
    assert_eq!(
        error.to_string(),
        "k33: 20 values for 21 points, one each is needed"
    );

    let mut endless = figure();
    endless.diagrams[1].series[0].values[4] = Some(f64::NAN);
    let error = endless.svg().unwrap_err();
    assert!(
        matches!(error, FigureError::InvalidNumber { index: 4, .. }),
        "{error}"
    );

    let mut many = figure();
    let series = many.diagrams[1].series[0].clone();
    many.diagrams[1].series = vec![series; 7];
    assert!(matches!(
        many.svg(),
        Err(FigureError::TooManyLines { lines: 7, .. })
    ));

    let mut empty = figure();
    empty.diagrams.clear();
    assert!(matches!(empty.svg(), Err(FigureError::NoPoints { .. })));
}
