//! Pictures that move: where each of them is at its time, one at a time, the same bytes again; and PDFs.

use hyperstat_figures::{
    AnimatedFigure, Curve, DeformedFigure, FigureError, Notes, Scale, Shown, Viewpoint, pdf,
};
use resvg::usvg::roxmltree::{Document, Node};

use crate::drawn::{points, texts};

/// A cantilever along z that is bent along x, of this length.
fn cantilever(length: f64, shown: Shown) -> DeformedFigure {
    let part = |k: u32| f64::from(k) / 10.0;
    DeformedFigure {
        title: "cantilever".into(),
        shown,
        curves: vec![Curve {
            points: (0..=10).map(|k| [0.0, 0.0, length * part(k)]).collect(),
            displacement: (0..=10)
                .map(|k| [1e-3 * length * part(k).powi(2), 0.0, 0.0])
                .collect(),
        }],
        rigid: Vec::new(),
        axes: Vec::new(),
        ground: vec![[0.0; 3]],
        second: None,
        scale: Scale::Factor(100.0),
        notes: Notes::default(),
        view: Viewpoint::default(),
        axis_names: Some(["x", "y", "height"].map(String::from)),
        pose: Some(format!("Pose: length = {length} m.")),
    }
}

const MODE: Shown = Shown::Mode {
    number: 2,
    frequency: 25.0,
};

/// The pictures, each with whether it is seen at every time.
fn frames<'d>(document: &'d Document<'_>) -> Vec<(Node<'d, 'd>, Vec<bool>)> {
    let groups = document.descendants().filter(|n| n.has_tag_name("g"));
    let groups = groups.filter(|n| n.attribute("visibility").is_some());
    let frame = |group: Node<'d, 'd>| {
        let animate = group.children().find(|n| n.has_tag_name("animate"));
        let words = animate.unwrap().attribute("values").unwrap().split(';');
        let seen: Vec<bool> = words.map(|word| word == "visible").collect();
        assert_eq!(group.attribute("visibility") == Some("visible"), seen[0]);
        (group, seen)
    };
    groups.map(frame).collect()
}

/// The ends of a line of this colour.
fn end(node: Node<'_, '_>, color: &str) -> [f64; 2] {
    let mut lines = node.descendants().filter(|n| n.has_tag_name("polyline"));
    let line = lines.find(|n| n.attribute("stroke") == Some(color) && points(*n).len() > 4);
    *points(line.unwrap()).last().unwrap()
}

#[test]
fn a_mode_swings_as_a_cosine_of_time() {
    let moving = AnimatedFigure::swing(cantilever(1.0, MODE));
    let svg = moving.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let rest = end(document.root_element(), "#BABABA");
    let frames = frames(&document);
    assert_eq!(frames.len(), 11);
    let first = end(frames[0].0, "#0072B2");
    assert!((first[0] - rest[0]).hypot(first[1] - rest[1]) > 300.0);
    for time in 0..20 {
        let at_once: Vec<_> = frames.iter().filter(|(_, seen)| seen[time]).collect();
        assert_eq!(at_once.len(), 1, "{time}");
        let found = end(at_once[0].0, "#0072B2");
        let turn = (std::f64::consts::TAU * time as f64 / 20.0).cos();
        for k in 0..2 {
            let expected = rest[k] + turn * (first[k] - rest[k]);
            assert!(
                (found[k] - expected).abs() <= 1.5,
                "{time}: {found:?} {expected}"
            );
        }
    }
    // The caption is that of the still picture, and so is what it shows where nothing moves.
    let still = cantilever(1.0, MODE);
    assert_eq!(moving.caption().unwrap(), still.caption().unwrap());
    assert_eq!(moving.svg().unwrap(), svg);
    assert!(
        texts(&document)
            .iter()
            .any(|(text, _)| text == "height (m)")
    );
    assert_eq!(moving.png().unwrap(), moving.png().unwrap());
}

#[test]
fn loads_come_and_go() {
    let moving = AnimatedFigure::swing(cantilever(1.0, Shown::Deflection));
    let svg = moving.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let rest = end(document.root_element(), "#BABABA");
    let frames = frames(&document);
    let [first, last] = [&frames[0], &frames[10]].map(|(group, _)| end(*group, "#0072B2"));
    assert!((first[0] - rest[0]).abs() > 300.0);
    assert!(
        (0..2).all(|k| (last[k] - rest[k]).abs() <= 1.0),
        "{last:?} {rest:?}"
    );
}

#[test]
fn poses_run_in_one_box_to_one_scale() {
    let lengths = [0.5, 1.0, 0.8];
    let figures = lengths.map(|length| cantilever(length, Shown::Deflection));
    let moving = AnimatedFigure::run(figures.to_vec()).unwrap();
    let svg = moving.svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let frames = frames(&document);
    assert_eq!(frames.len(), 3);
    let tips = frames.iter().map(|(group, _)| end(*group, "#BABABA"));
    let tips: Vec<_> = tips.collect();
    // Upright: heights over the ground are as the lengths.
    let ground = |length: f64, tip: [f64; 2]| tip[1] + (tips[0][1] - tips[1][1]) * length / 0.5;
    assert!((ground(0.5, tips[0]) - ground(1.0, tips[1])).abs() <= 2.0);
    assert!((ground(0.5, tips[0]) - ground(0.8, tips[2])).abs() <= 2.0);
    for (k, (group, seen)) in frames.iter().enumerate() {
        let own: Vec<bool> = (0..3).map(|time| time == k).collect();
        assert_eq!(*seen, own);
        let told = format!("Pose: length = {} m.", lengths[k]);
        assert!(
            group
                .descendants()
                .any(|n| n.text().is_some_and(|t| t.trim() == told))
        );
    }
    assert!(
        moving
            .caption()
            .unwrap()
            .contains("deflection × 100, 3 poses. Largest deflection: 1 mm.")
    );
    let none = AnimatedFigure::run(Vec::new()).unwrap_err();
    assert!(matches!(none, FigureError::NoFrames));
}

#[test]
fn a_gif_has_a_frame_for_every_time() {
    let moving = AnimatedFigure::swing(cantilever(1.0, MODE));
    let bytes = moving.gif().unwrap();
    assert_eq!(bytes, moving.gif().unwrap());
    let mut decoder = gif::Decoder::new(&*bytes).unwrap();
    assert_eq!([decoder.width(), decoder.height()], [900, 640]);
    let mut count = 0;
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        // A tenth of a second.
        assert_eq!(frame.delay, 10);
        count += 1;
    }
    assert_eq!(count, 20);
}

#[test]
fn a_pdf_is_a_page_of_the_picture_whose_text_is_text() {
    let svg = cantilever(1.0, MODE).svg().unwrap();
    let bytes = pdf(&svg).unwrap();
    assert_eq!(bytes, pdf(&svg).unwrap());
    assert!(bytes.starts_with(b"%PDF-"));
    let text = String::from_utf8_lossy(&bytes);
    // 900 by 640 pixels of 1/96 inch, in points.
    assert!(
        text.contains("/MediaBox [0 0 675 480]"),
        "{}",
        &text[..2000.min(text.len())]
    );
    assert!(text.contains("LiberationSans") && !text.contains("Date"));
    assert!(matches!(pdf("no picture"), Err(FigureError::Pdf(_))));
}
