//! Bars of shares: as long as the shares say, read back from the document; what the words tell;
//! and data that cannot be drawn.

use hyperstat_figures::{Bar, BarFigure, BarGroup, FigureError, Quantity};
use resvg::usvg::roxmltree::{Document, Node};

use crate::drawn::{points, texts};

/// 200 µm, of which one part takes 10 % away.
fn figure() -> BarFigure {
    let group = |name: &str, bars: &[(&str, f64)]| BarGroup {
        name: name.into(),
        bars: bars
            .iter()
            .map(|(name, value)| Bar {
                name: (*name).into(),
                value: *value,
            })
            .collect(),
    };
    BarFigure {
        title: "delta <1>".into(),
        subtitle: "Shares in the deflection of platform.P along z.".into(),
        quantity: Quantity::new("deflection", "m"),
        total: 2e-4,
        groups: vec![
            group("By deformation", &[("bending", 1.5e-4), ("torsion", 5e-5)]),
            group(
                "By body and joint",
                &[("arm3", 1.2e-4), ("joint A1", 1e-4), ("wrist1", -2e-5)],
            ),
        ],
    }
}

/// Left and right end and middle height of every bar of a colour, in tenths of a pixel.
fn bars(document: &Document<'_>, color: &str) -> Vec<[f64; 3]> {
    let is_bar = |n: &Node<'_, '_>| n.has_tag_name("polygon") && n.attribute("fill") == Some(color);
    let corners = document.descendants().filter(is_bar).map(points);
    corners
        .map(|corners| {
            let ends = |axis: usize| {
                let along = || corners.iter().map(move |corner| corner[axis]);
                let least = along().fold(f64::INFINITY, f64::min);
                [least, along().fold(f64::NEG_INFINITY, f64::max)]
            };
            let [[left, right], [above, below]] = [ends(0), ends(1)];
            [left, right, 0.5 * (above + below)]
        })
        .collect()
}

/// Where a text is.
fn place(texts: &[(String, [f64; 2])], text: &str) -> [f64; 2] {
    let found = texts.iter().find(|(known, _)| known == text);
    found
        .unwrap_or_else(|| panic!("no `{text}` in {texts:?}"))
        .1
}

const BLUE: &str = "#0072B2";
const VERMILLION: &str = "#D55E00";

#[test]
fn bars_are_as_long_as_their_shares() {
    let svg = figure().svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    // Ticks are centred on their share: two of them give the scale.
    let [zero, sixty] = ["0", "60"].map(|tick| place(&texts, tick)[0]);
    let percent = (sixty - zero) / 60.0;
    let (with, against) = (bars(&document, BLUE), bars(&document, VERMILLION));
    let expected = [75.0, 25.0, 60.0, 50.0, -10.0];
    let names = ["bending", "torsion", "arm3", "joint A1", "wrist1"];
    assert_eq!((with.len(), against.len()), (4, 1));
    let all = with.iter().chain(&against);
    for ((bar, share), name) in all.zip(expected).zip(names) {
        let ends = [zero, zero + share * percent];
        let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        // The document counts whole tenths of a pixel: half of one off at an end, half at each
        // tick, the farther of which is 75/60 of itself away.
        for (found, end) in bar[..2].iter().zip(ends) {
            assert!((found - end).abs() < 2.0, "{name}: {bar:?} {ends:?}");
        }
        // Its name is beside it, and its label.
        let label = format!("{share:.1} %").replace('-', "−");
        for text in [name, &label] {
            let [_, y] = place(&texts, text);
            assert!(
                (y - bar[2]).abs() < 80.0,
                "{text} at {y}, bar at {}",
                bar[2]
            );
        }
    }
}

#[test]
fn words_tell_the_whole_and_what_is_negative() {
    let svg = figure().svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    for text in [
        "delta <1>",
        "By deformation",
        "By body and joint",
        "share (%)",
        "100 % is a deflection of 200 µm.",
        "Negative shares, to the left, are of parts that move it the other way.",
        "µm",
        "150.0",
        "−20.0",
        "−10.0 %",
    ] {
        place(&texts, text);
    }
    // Nothing is off the page, and no label over a value.
    for (text, [x, y]) in &texts {
        assert!((0.0..9000.0).contains(x) && *y > 0.0, "{text} at {x}, {y}");
    }
    let mut alone = figure();
    alone.groups.remove(1);
    assert_eq!(alone.caption(), "100 % is a deflection of 200 µm.");
    assert_eq!(figure().svg().unwrap(), svg);
    assert_eq!(&figure().png().unwrap()[..4], b"\x89PNG");
}

#[test]
fn shares_that_dwarf_the_whole_are_drawn() {
    // Parts that cancel: 1 nm is left of 1 mm.
    let mut figure = figure();
    figure.total = 1e-9;
    figure.groups[1].bars[0].value = 1e-3;
    figure.groups[1].bars[1].value = -1e-3;
    let svg = figure.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let all = [bars(&document, BLUE), bars(&document, VERMILLION)].concat();
    assert!(
        all.iter()
            .all(|[left, right, _]| *left > 0.0 && *right < 9000.0)
    );
    let [long, back] = [&all[2], &all[3]].map(|[left, right, _]| right - left);
    assert!((long - back).abs() < 2.0);
}

#[test]
fn what_is_no_share_is_refused() {
    let refused = |change: &dyn Fn(&mut BarFigure)| {
        let mut figure = figure();
        change(&mut figure);
        figure.svg().unwrap_err()
    };
    assert!(matches!(
        refused(&|figure| figure.total = 0.0),
        FigureError::NoWhole { .. }
    ));
    for total in [f64::NAN, f64::INFINITY, 1e300] {
        let error = refused(&|figure| figure.total = total);
        assert!(
            matches!(error, FigureError::InvalidNumber { .. }),
            "{error}"
        );
    }
    assert!(matches!(
        refused(&|figure| figure.groups[0].bars[1].value = f64::NAN),
        FigureError::InvalidNumber { index: 1, .. }
    ));
    // Shares beyond what a double holds.
    assert!(matches!(
        refused(&|figure| figure.total = 1e-300),
        FigureError::InvalidNumber { .. }
    ));
    for change in [
        (|figure: &mut BarFigure| figure.groups.clear()) as fn(&mut BarFigure),
        |figure| figure.groups[1].bars.clear(),
    ] {
        assert!(matches!(refused(&change), FigureError::NoPoints { .. }));
    }
}
