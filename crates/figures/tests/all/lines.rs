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

/// Two curves of three designs each.
fn designs() -> LineFigure {
    let series = |name: &str, most: f64| Series {
        name: name.into(),
        at: vec![0.0, 1.0, 2.0],
        values: [0.5, 0.75, 1.0].map(|part| Some(part * most)).to_vec(),
    };
    LineFigure {
        title: "designs".into(),
        subtitle: "k33 over arm.section.".into(),
        over: Quantity::new("arm.section", ""),
        categories: [
            "Circle(diameter: 0.025)",
            "Tube(outer: 0.030, inner: 0.024)",
            "IPE 80",
        ]
        .map(String::from)
        .to_vec(),
        diagrams: vec![Diagram {
            name: "k33".into(),
            unit: "N/m".into(),
            legend: "rod.section.diameter".into(),
            series: vec![series("10 mm", 1e6), series("12 mm", 2e6)],
        }],
    }
}

#[test]
fn categories_have_dots_above_their_names_and_no_lines() {
    let svg = designs().svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    assert!(lines(&svg, "#0072B2").is_empty());
    let dots = |color: &str| -> Vec<f64> {
        let circles = document.descendants().filter(|n| n.has_tag_name("circle"));
        let own = circles.filter(|n| n.attribute("fill") == Some(color));
        own.map(|n| n.attribute("cx").unwrap().parse().unwrap())
            .collect()
    };
    // Three dots and the one in the legend; those of the second curve beside those of the first.
    let (first, second) = (dots("#0072B2"), dots("#D55E00"));
    assert_eq!((first.len(), second.len()), (4, 4));
    assert!(first[..3].iter().zip(&second).all(|(a, b)| a < b));
    let texts = crate::drawn::texts(&document);
    for text in [
        "rod.section.diameter",
        "10 mm",
        "12 mm",
        "IPE 80",
        "arm.section",
        "k33 (MN/m)",
    ] {
        assert!(
            texts.iter().any(|(found, _)| found == text),
            "{text}: {texts:?}"
        );
    }
    assert_eq!(designs().caption(), "k33 from 500 kN/m to 2 MN/m.");

    let mut other = designs();
    other.diagrams[0].series[1].at[2] = 1.5;
    let error = other.svg().unwrap_err();
    assert_eq!(
        error.to_string(),
        "12 mm: entry 2 is 1.5, the number of none of 3 categories"
    );
}

#[test]
fn a_line_through_very_many_points_is_drawn_by_those_that_are_seen() {
    let count = 100_000;
    let series = |name: &str, turns: f64| Series {
        name: name.into(),
        at: (0..count).map(f64::from).collect(),
        values: (0..count)
            .map(|k| Some((turns * f64::from(k)).sin()))
            .collect(),
    };
    let mut figure = figure();
    figure.diagrams[0].series = vec![series("slow", 1e-4), series("fast", 1.7)];
    figure.diagrams.truncate(1);
    let svg = figure.svg().unwrap();
    assert!(svg.len() < 1_000_000, "{}", svg.len());
    // The fast one fills the whole height at every pixel.
    let fast = lines(&svg, "#D55E00");
    let heights: Vec<f64> = fast.iter().flatten().map(|[_, y]| *y).collect();
    let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let most = heights.iter().copied().fold(0.0, f64::max);
    let near = |end: f64| heights.iter().filter(|y| (**y - end).abs() < 200.0).count();
    assert!(near(least) > 1000 && near(most) > 1000);
    assert_eq!(svg, figure.svg().unwrap());
    figure.png().unwrap();
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
