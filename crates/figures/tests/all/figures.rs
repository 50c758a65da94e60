//! Both figures from data: what the documents hold, the same bytes again, data at the edge of
//! what can be drawn, and data that cannot be.

use hyperstat_figures::{
    Axis, Curve, DeformedFigure, FigureError, Notes, RigidBody, Scale, SecondMethod, SecondPoints,
    Shown, TrajectoryFigure, Viewpoint,
};
use resvg::usvg::roxmltree::{Document, Node};

type Vector = [f64; 3];

/// A number of a figure.
type Place = fn(&mut DeformedFigure) -> &mut f64;

/// A way along x, up by 0.5 m, with a deflection that grows to 1 mm.
fn trajectory() -> TrajectoryFigure {
    let part = |k: u32| f64::from(k) / 20.0;
    let displacement: Vec<Vector> = (0..=20).map(|k| [0.0, 0.0, -1e-3 * part(k)]).collect();
    TrajectoryFigure {
        title: "line <1> & \"2\"".into(),
        commanded: (0..=20).map(|k| [part(k), 0.0, 0.5 * part(k)]).collect(),
        second: Some(SecondMethod {
            name: "other method".into(),
            at: (0..=20).collect(),
            displacement: displacement.clone(),
            difference: 0.0105,
        }),
        displacement,
        scale: Scale::Auto,
        view: Viewpoint::default(),
        axis_names: None,
    }
}

/// A bent cantilever with a rigid triangle at its tip.
fn deformed() -> DeformedFigure {
    let part = |k: u32| f64::from(k) / 10.0;
    DeformedFigure {
        shown: Shown::Deflection,
        title: "cantilever".into(),
        curves: vec![Curve {
            points: (0..=10).map(|k| [0.0, 0.0, part(k)]).collect(),
            displacement: (0..=10)
                .map(|k| [2e-4 * part(k).powi(2), 0.0, 0.0])
                .collect(),
        }],
        rigid: vec![RigidBody {
            points: vec![[0.0, 0.0, 1.0], [0.2, 0.0, 1.1], [0.0, 0.2, 1.1]],
            displacement: vec![[2e-4, 0.0, 0.0]; 3],
        }],
        axes: vec![Axis {
            at: [0.0, 0.0, 1.0],
            direction: [0.0, 3.0, 0.0],
        }],
        ground: vec![[0.0; 3]],
        second: Some(SecondPoints {
            name: "other method".into(),
            points: vec![[0.0, 0.0, 1.0]],
            displacement: vec![[2e-4, 0.0, 0.0]],
            difference: 3e-12,
        }),
        scale: Scale::Auto,
        notes: Notes::default(),
        view: Viewpoint::default(),
        axis_names: None,
        pose: None,
    }
}

/// All text of a document, line by line.
fn texts(document: &Document<'_>) -> Vec<String> {
    let texts = document
        .descendants()
        .filter(|node| node.has_tag_name("text"));
    texts
        .filter_map(|node| node.text())
        .map(|text| text.trim().to_string())
        .collect()
}

/// The elements of a kind with this colour, in the order of the document.
fn coloured<'a>(document: &'a Document<'a>, tag: &str, color: &str) -> Vec<Node<'a, 'a>> {
    document
        .descendants()
        .filter(|node| node.has_tag_name(tag) && node.attribute("stroke") == Some(color))
        .collect()
}

/// All coordinates of an element.
fn numbers(node: Node<'_, '_>) -> Vec<f64> {
    ["points", "x", "y", "cx", "cy", "r"]
        .into_iter()
        .filter_map(|name| node.attribute(name))
        .flat_map(|list| list.split([' ', ',']).filter(|number| !number.is_empty()))
        .map(|number| number.parse().unwrap())
        .collect()
}

/// That a document is well formed, and everything in it is on the page.
fn assert_drawn(svg: &str) {
    let document = Document::parse(svg).unwrap();
    let root = document.root_element();
    assert_eq!(
        (root.attribute("width"), root.attribute("height")),
        (Some("900"), Some("640"))
    );
    assert_eq!(root.attribute("viewBox"), Some("0 0 9000 6400"));
    for node in document.descendants().filter(Node::is_element) {
        for number in numbers(node) {
            assert!(
                (0.0..=9000.0).contains(&number),
                "{number} in {:?}",
                node.attributes()
            );
        }
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
}

const BLUE: &str = "#0072B2";
const VERMILLION: &str = "#D55E00";

#[test]
fn a_trajectory_states_factor_deflection_and_difference() {
    let svg = trajectory().svg().unwrap();
    assert_drawn(&svg);
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    for text in [
        "line <1> & \"2\"",
        "Commanded and deflected trajectory, deflection × 100",
        "deflected, × 100",
        "other method",
        "Largest deflection: 1 mm.",
        "Largest difference between the two methods: 1.05 % of the largest deflection.",
        "x (m)",
        "y (m)",
        "z (m)",
        "0.5",
    ] {
        assert!(
            texts.iter().any(|found| found == text),
            "no `{text}` in {texts:?}"
        );
    }
    // The second method's 21 points and the one in the legend.
    assert_eq!(coloured(&document, "circle", VERMILLION).len(), 22);
}

#[test]
fn a_mechanism_states_factor_deflection_and_difference() {
    let svg = deformed().svg().unwrap();
    assert_drawn(&svg);
    let texts = texts(&Document::parse(&svg).unwrap());
    for text in [
        "cantilever",
        "Undeformed and deformed mechanism, deflection × 500",
        "deformed, × 500",
        "rigid body",
        "joint axis",
        "ground",
        "other method",
        "Largest deflection: 200 µm.",
        "Largest difference between the two methods: 3.0e-12 of the largest deflection.",
    ] {
        assert!(
            texts.iter().any(|found| found == text),
            "no `{text}` in {texts:?}"
        );
    }
}

#[test]
fn the_legend_names_only_what_is_there() {
    let figure = DeformedFigure {
        rigid: Vec::new(),
        axes: Vec::new(),
        ground: Vec::new(),
        second: None,
        ..deformed()
    };
    let svg = figure.svg().unwrap();
    for text in [
        "rigid body",
        "joint axis",
        "ground",
        "other method",
        "two methods",
    ] {
        assert!(!svg.contains(text), "{text}");
    }
}

#[test]
fn a_second_method_may_be_known_at_some_points_only() {
    let mut figure = trajectory();
    let second = figure.second.as_mut().expect("a second method");
    second.at = vec![0, 10, 20];
    second.displacement.truncate(3);
    let svg = figure.svg().unwrap();
    let whole = trajectory().svg().unwrap();
    let rings = |svg: &str| svg.matches("<circle").count();
    assert_eq!(rings(&whole) - rings(&svg), 18);
    figure.second.as_mut().expect("a second method").at[2] = 21;
    let error = figure.svg().unwrap_err();
    assert_eq!(error.to_string(), "`other method` has a point 21 of 21");
}

#[test]
fn the_second_method_is_drawn_where_it_says() {
    // The same displacement at the tip by both methods: the circle is at the end of the curve.
    let svg = deformed().svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let curves = coloured(&document, "polyline", BLUE);
    let [.., x, y] = numbers(curves[0])[..] else {
        panic!("no curve")
    };
    let circle = numbers(coloured(&document, "circle", VERMILLION)[0]);
    assert_eq!(circle[..2], [x, y]);
}

#[test]
fn a_link_is_drawn_as_its_elastic_curve() {
    let svg = deformed().svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let points = numbers(coloured(&document, "polyline", BLUE)[0]);
    assert_eq!(points.len(), 22);
    let [x0, y0, xm, ym, x1, y1] = [0, 1, 10, 11, 20, 21].map(|k| points[k]);
    // The middle of a parabola is a quarter of the tip's deflection from its chord.
    let bulge = (xm - 0.5 * (x0 + x1)).hypot(ym - 0.5 * (y0 + y1));
    assert!(
        bulge > 50.0,
        "the curve bulges by {bulge} tenths of a pixel"
    );
}

#[test]
fn the_deflection_is_drawn_in_proportion_to_the_factor() {
    let offset = |factor| {
        let figure = TrajectoryFigure {
            second: None,
            scale: Scale::Factor(factor),
            ..trajectory()
        };
        let svg = figure.svg().unwrap();
        let document = Document::parse(&svg).unwrap();
        // Deflections are straight ways; those right of the drawing belong to the legend.
        let mut ways = coloured(&document, "polyline", BLUE)
            .into_iter()
            .map(numbers);
        let last = ways.rfind(|way| way.len() == 4 && way[0] < 6500.0);
        let [x0, y0, x1, y1] = last.unwrap()[..] else {
            panic!("no way")
        };
        assert!(svg.contains(&format!("deflection × {factor}")));
        (x1 - x0).hypot(y1 - y0)
    };
    let (once, twice) = (offset(20.0), offset(40.0));
    assert!(once > 50.0, "{once}");
    // Both drawings are fitted to about the same box.
    assert!((twice / once - 2.0).abs() < 0.05, "{once} {twice}");
}

#[test]
fn the_same_data_give_the_same_bytes() {
    assert_eq!(trajectory().svg().unwrap(), trajectory().svg().unwrap());
    assert_eq!(deformed().svg().unwrap(), deformed().svg().unwrap());
    assert_eq!(deformed().png().unwrap(), deformed().png().unwrap());
}

#[test]
fn a_png_is_drawn_with_letters() {
    let png = trajectory().png().unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    // Width and height follow the length and the name of the first chunk.
    assert_eq!(
        png[16..24],
        [0, 0, 8, 202, 0, 0, 6, 64],
        "2250 by 1600 pixels"
    );
    let untitled = TrajectoryFigure {
        title: String::new(),
        ..trajectory()
    };
    assert_ne!(png, untitled.png().unwrap(), "the title is not to be seen");
}

#[test]
fn points_in_one_place_on_a_line_or_in_a_plane_are_drawn() {
    let spread = |scale: Vector| -> Vec<Vector> {
        let unit = [[0.0; 3], [1.0, 0.2, 0.0], [0.3, 1.0, 0.1], [0.0, 0.4, 1.0]];
        unit.iter()
            .map(|p| std::array::from_fn(|axis| 7.0 + scale[axis] * p[axis]))
            .collect()
    };
    for points in [
        vec![[0.0; 3]],
        vec![[1e6, -1e6, 1e6]],
        spread([0.0; 3]),
        spread([1.0, 0.0, 0.0]),
        spread([0.0, 1.0, 0.0]),
        spread([0.0, 0.0, 1.0]),
        spread([1.0, 1.0, 0.0]),
        spread([1e-12, 0.0, 1e-12]),
        spread([1e90, 1e-3, 0.0]),
    ] {
        for displacement in [
            [0.0; 3],
            [0.0, 1e-5, 0.0],
            [1.0, -2.0, 1e3],
            [1e-300, 0.0, 0.0],
        ] {
            let displacement = vec![displacement; points.len()];
            let path = TrajectoryFigure {
                commanded: points.clone(),
                displacement: displacement.clone(),
                second: None,
                ..trajectory()
            };
            assert_drawn(&path.svg().unwrap());
            let mechanism = DeformedFigure {
                curves: vec![Curve {
                    points: points.clone(),
                    displacement: displacement.clone(),
                }],
                rigid: vec![RigidBody {
                    points: points.clone(),
                    displacement,
                }],
                axes: vec![Axis {
                    at: points[0],
                    direction: [1e-300, 0.0, 1e-300],
                }],
                ground: points.clone(),
                second: None,
                ..deformed()
            };
            assert_drawn(&mechanism.svg().unwrap());
        }
    }
}

#[test]
fn nothing_moves_and_the_factor_is_one() {
    let figure = TrajectoryFigure {
        displacement: vec![[0.0; 3]; 21],
        second: None,
        ..trajectory()
    };
    let svg = figure.svg().unwrap();
    assert!(svg.contains("deflection × 1\n") && svg.contains("Largest deflection: 0 m."));
}

#[test]
fn a_long_title_stays_on_the_page() {
    let title = "deflection ".repeat(100);
    let svg = TrajectoryFigure {
        title,
        ..trajectory()
    }
    .svg()
    .unwrap();
    let document = Document::parse(&svg).unwrap();
    let shown = &texts(&document)[0];
    assert!(
        shown.ends_with('…') && shown.chars().count() < 150,
        "{shown}"
    );
}

#[test]
fn missing_data_are_errors() {
    let nothing = TrajectoryFigure {
        commanded: Vec::new(),
        displacement: Vec::new(),
        second: None,
        ..trajectory()
    };
    let error = nothing.svg().unwrap_err();
    assert_eq!(error.to_string(), "trajectory: there is no point to draw");

    let empty = DeformedFigure {
        curves: Vec::new(),
        rigid: Vec::new(),
        ..deformed()
    };
    assert_eq!(
        empty.svg().unwrap_err().to_string(),
        "mechanism: there is no point to draw"
    );

    let mut short = deformed();
    short.rigid[0].displacement.pop();
    let error = short.svg().unwrap_err();
    assert!(
        matches!(&error, FigureError::LengthMismatch { what, points: 3, displacements: 2 }
            if what == "rigid body 0"),
        "{error}"
    );
}

#[test]
fn numbers_that_are_not_finite_are_errors() {
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let spoil: [(&str, Place); 6] = [
            ("curve 0: entry 3 is", |figure| {
                &mut figure.curves[0].points[3][2]
            }),
            ("curve 0, displacements: entry 1", |figure| {
                &mut figure.curves[0].displacement[1][0]
            }),
            ("joint axes: entry 0", |figure| &mut figure.axes[0].at[0]),
            ("joint axes, directions: entry 0", |figure| {
                &mut figure.axes[0].direction[1]
            }),
            ("ground: entry 0", |figure| &mut figure.ground[0][1]),
            ("other method: entry 0", |figure| {
                &mut figure.second.as_mut().expect("a second method").points[0][1]
            }),
        ];
        for (message, place) in spoil {
            let mut figure = deformed();
            *place(&mut figure) = number;
            let error = figure.svg().unwrap_err();
            assert!(
                matches!(error, FigureError::NotFinite { .. }),
                "{message}: {error}"
            );
            assert!(error.to_string().starts_with(message), "{message}: {error}");
        }
        let mut figure = trajectory();
        figure.displacement[7][2] = number;
        let error = figure.svg().unwrap_err();
        assert!(
            matches!(error, FigureError::NotFinite { index: 7, .. }),
            "{error}"
        );
    }
}

#[test]
fn what_cannot_be_drawn_is_an_error() {
    let far = TrajectoryFigure {
        scale: Scale::Factor(1e300),
        ..trajectory()
    };
    let error = far.svg().unwrap_err();
    assert!(
        matches!(error, FigureError::TooFar { index: 1, .. }),
        "{error}"
    );

    for factor in [0.0, -2.0, f64::NAN, f64::INFINITY] {
        let figure = DeformedFigure {
            scale: Scale::Factor(factor),
            ..deformed()
        };
        let error = figure.svg().unwrap_err();
        assert!(
            matches!(error, FigureError::InvalidFactor { .. }),
            "{factor}: {error}"
        );
    }

    let mut figure = deformed();
    figure.axes[0].direction = [0.0; 3];
    assert_eq!(
        figure.svg().unwrap_err().to_string(),
        "joint axis 0 has no direction"
    );

    for difference in [-1e-3, f64::NAN, f64::INFINITY] {
        let mut figure = trajectory();
        figure.second.as_mut().expect("a second method").difference = difference;
        let error = figure.png().unwrap_err();
        assert!(
            matches!(error, FigureError::InvalidDifference { .. }),
            "{difference}: {error}"
        );
    }
}
