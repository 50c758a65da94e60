//! `solve --vtu`, read back by an XML reader of other authorship: the grid is well formed, and its
//! numbers are those of closed forms.

use resvg::usvg::roxmltree::{Document, Node};

use crate::support::{Bench, CANTILEVER, assert_near, delta_batch, numbers};

/// The numbers of an array, in rows of its components.
fn array(document: &Document<'_>, name: &str) -> Vec<Vec<f64>> {
    let is_it = |n: &Node<'_, '_>| n.has_tag_name("DataArray") && n.attribute("Name") == Some(name);
    let node = document.descendants().find(is_it);
    let node = node.unwrap_or_else(|| panic!("no array `{name}`"));
    assert_eq!(node.attribute("format"), Some("ascii"));
    let components = node
        .attribute("NumberOfComponents")
        .map_or(1, |n| n.parse().unwrap());
    let text = node.text().unwrap_or_default();
    let numbers: Vec<f64> = text
        .split_whitespace()
        .map(|n| n.parse().unwrap())
        .collect();
    numbers.chunks(components).map(<[f64]>::to_vec).collect()
}

/// Checks the grid: as many of everything as it says, and every cell of points that there are.
fn assert_whole(document: &Document<'_>) {
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "VTKFile");
    assert_eq!(root.attribute("type"), Some("UnstructuredGrid"));
    let piece = document
        .descendants()
        .find(|n| n.has_tag_name("Piece"))
        .unwrap();
    let count = |name: &str| piece.attribute(name).unwrap().parse::<usize>().unwrap();
    let (points, cells) = (count("NumberOfPoints"), count("NumberOfCells"));
    let of = |tag: &str| -> Vec<(String, usize)> {
        let parent = document
            .descendants()
            .find(|n| n.has_tag_name(tag))
            .unwrap();
        let arrays = parent.children().filter(|n| n.has_tag_name("DataArray"));
        let named = arrays.map(|n| n.attribute("Name").unwrap().to_string());
        named
            .map(|name| {
                let rows = array(document, &name).len();
                (name, rows)
            })
            .collect()
    };
    for (tag, expected) in [
        ("Points", points),
        ("PointData", points),
        ("CellData", cells),
    ] {
        for (name, rows) in of(tag) {
            assert_eq!(rows, expected, "{name}");
        }
    }
    let offsets: Vec<usize> = array(document, "offsets")
        .iter()
        .map(|o| o[0] as usize)
        .collect();
    let types = array(document, "types");
    assert_eq!((offsets.len(), types.len()), (cells, cells));
    let connectivity = array(document, "connectivity");
    assert_eq!(connectivity.len(), *offsets.last().unwrap());
    assert!(
        connectivity
            .iter()
            .all(|point| point[0] >= 0.0 && point[0] < points as f64)
    );
    let mut start = 0;
    for (end, kind) in offsets.into_iter().zip(types) {
        // Vertices (1) have one point, lines (3) two.
        assert_eq!(end - start, if kind[0] == 1.0 { 1 } else { 2 });
        assert!([1.0, 3.0].contains(&kind[0]));
        start = end;
    }
}

/// The bar of the help: 20 mm, 0.5 m along x, 100 N down and 10 N·m about x at its end.
#[test]
fn a_cantilever_has_the_curve_and_the_forces_of_the_textbook() {
    let bench = Bench::new("vtu-cantilever");
    bench.file("bar.ron", CANTILEVER);
    bench
        .hyperstat(&["solve", "bar.ron", "--vtu", "bar.vtu"])
        .ends_with(0);
    let text = bench.read("bar.vtu");
    let document = Document::parse(&text).unwrap();
    assert_whole(&document);
    let pi = std::f64::consts::PI;
    let inertia = pi * 0.02_f64.powi(4) / 64.0;
    let stiffness = young(CANTILEVER) * inertia;
    let points = array(&document, "points");
    let displacement = array(&document, "displacement");
    let tip = 100.0 * 0.5_f64.powi(3) / (3.0 * stiffness);
    let mut on_bar = 0;
    for (point, moved) in points.iter().zip(&displacement) {
        let x = point[0];
        let expected = -100.0 * x * x * (1.5 - x) / (6.0 * stiffness);
        assert_near(moved[2], expected, 1e-9, tip);
        on_bar += 1;
    }
    assert!(on_bar >= 13);
    let part = array(&document, "part");
    let (shear, bending) = (array(&document, "Vz"), array(&document, "My"));
    let (torsion, stress) = (array(&document, "T"), array(&document, "von_mises"));
    let known = array(&document, "has_stress");
    let beams: Vec<usize> = (0..part.len()).filter(|k| part[*k][0] == 0.0).collect();
    assert_eq!(beams.len(), 12);
    for (k, cell) in beams.into_iter().enumerate() {
        let middle = 0.5 * (k as f64 + 0.5) / 12.0;
        let moment = 100.0 * (0.5 - middle);
        assert_near(shear[cell][0].abs(), 100.0, 1e-9, 100.0);
        assert_near(bending[cell][0].abs(), moment, 1e-9, 50.0);
        assert_near(torsion[cell][0].abs(), 10.0, 1e-9, 10.0);
        let bent = 32.0 * moment / (pi * 0.02_f64.powi(3));
        let twisted = 16.0 * 10.0 / (pi * 0.02_f64.powi(3));
        let expected = (bent * bent + 3.0 * twisted * twisted).sqrt();
        assert_near(stress[cell][0], expected, 1e-9, expected);
        assert_eq!(known[cell], [1.0]);
    }
}

/// Young's modulus of the only material of a file.
fn young(file: &str) -> f64 {
    let rest = file.split("young: ").nth(1).unwrap();
    rest.split([',', ')'])
        .next()
        .unwrap()
        .trim()
        .parse()
        .unwrap()
}

#[test]
fn a_delta_has_its_platform_its_joints_and_its_modes() {
    let bench = Bench::new("vtu-delta");
    bench.file(
        "delta.ron",
        &delta_batch("delta", "List([(0.0, 0.0, 0.5)])", ""),
    );
    let solve = ["solve", "delta.ron", "--format", "json", "--modes", "2"];
    let outcome = bench
        .hyperstat(&[&solve[..], &["--vtu", "delta.vtu"]].concat())
        .ends_with(0);
    let json = outcome.json();
    let text = bench.read("delta.vtu");
    let document = Document::parse(&text).unwrap();
    assert_whole(&document);
    let (points, moved) = (array(&document, "points"), array(&document, "displacement"));
    let turned = array(&document, "rotation");
    let (first, second) = (array(&document, "mode1"), array(&document, "mode2"));
    let expected = numbers(&json["output"]["displacement"]);
    let shape = numbers(&json["modes"][1]["shape"]["platform.P"]);
    let at = |point: &Vec<f64>| point[0].hypot(point[1]).hypot(point[2] - 0.5) < 1e-9;
    let place = points.iter().rposition(at).expect("the platform's point P");
    for k in 0..3 {
        assert_near(moved[place][k], expected[k], 1e-12, 1e-4);
        assert_near(turned[place][k], expected[k + 3], 1e-12, 1e-3);
        assert_near(second[place][k], shape[k], 1e-9, 1.0);
    }
    assert_eq!(first.len(), points.len());
    let part = array(&document, "part");
    let joints = part.iter().filter(|part| part[0] == 2.0).count();
    assert_eq!(joints, json["joints"].as_object().unwrap().len());
    assert!(part.iter().any(|part| part[0] == 1.0));
    let stress = array(&document, "von_mises");
    assert!(stress.iter().all(|stress| stress[0].is_finite()));
}

#[test]
fn a_file_that_cannot_be_written_ends_with_3() {
    let bench = Bench::new("vtu-nowhere");
    bench.file("bar.ron", CANTILEVER);
    bench
        .hyperstat(&["solve", "bar.ron", "--vtu", "none/bar.vtu"])
        .ends_with(3)
        .says(&["cannot write none/bar.vtu"]);
}
