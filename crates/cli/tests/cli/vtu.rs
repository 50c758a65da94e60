//! `solve --vtu`, read back as XML: points, cells and arrays hold the numbers of closed forms and those
//! that `solve` itself prints. `tests/read-back` reads such files with VTK's own reader.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fs;
use std::ops::Index;
use std::path::Path;

use roxmltree::{Document, Node};
use serde_json::Value;

use crate::support::{Bench, CANTILEVER, assert_near, delta_batch, numbers};

/// VTK's numbers of the kinds of cells.
const VERTEX: usize = 1;
const LINE: usize = 3;

/// What stands in a file.
struct Grid {
    points: Vec<Vec<f64>>,
    /// The kind of each and its points.
    cells: Vec<(usize, Vec<usize>)>,
    /// By name, in rows of its components.
    arrays: BTreeMap<String, Vec<Vec<f64>>>,
}

/// The element `name` in another.
fn child<'a, 'd>(node: Node<'a, 'd>, name: &str) -> Node<'a, 'd> {
    let mut found = node.children().filter(|child| child.has_tag_name(name));
    let only = found.next().unwrap_or_else(|| panic!("no `{name}`"));
    assert!(found.next().is_none(), "more than one `{name}`");
    only
}

/// Name and rows of an array of text.
fn array(node: Node<'_, '_>) -> (String, Vec<Vec<f64>>) {
    let attribute = |name: &str| node.attribute(name);
    assert_eq!(attribute("format"), Some("ascii"));
    let components = attribute("NumberOfComponents").map_or(1, |n| n.parse().unwrap());
    let words = node.text().unwrap().split_ascii_whitespace();
    let numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
    assert_eq!(numbers.len() % components, 0);
    let rows = numbers.chunks(components).map(<[f64]>::to_vec).collect();
    (attribute("Name").unwrap().into(), rows)
}

/// All arrays in an element, by name.
fn arrays(node: Node<'_, '_>) -> BTreeMap<String, Vec<Vec<f64>>> {
    let arrays = node.children().filter(|child| child.is_element());
    let mut found = BTreeMap::new();
    for (name, rows) in arrays.map(array) {
        assert!(found.insert(name.clone(), rows).is_none(), "two `{name}`");
    }
    found
}

/// An array of whole numbers.
fn whole(rows: &[Vec<f64>]) -> Vec<usize> {
    let numbers = rows.iter().flatten();
    numbers
        .map(|number| {
            assert!(*number >= 0.0 && number.fract() == 0.0, "{number}");
            *number as usize
        })
        .collect()
}

impl Grid {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let document = Document::parse(&text).unwrap();
        let root = document.root_element();
        assert_eq!(root.tag_name().name(), "VTKFile");
        assert_eq!(root.attribute("type"), Some("UnstructuredGrid"));
        let piece = child(child(root, "UnstructuredGrid"), "Piece");
        let count = |name: &str| piece.attribute(name).unwrap().parse::<usize>().unwrap();
        let (_, points) = array(child(child(piece, "Points"), "DataArray"));
        let of_cells = arrays(child(piece, "Cells"));
        let of_cells = |name: &str| whole(&of_cells[name]);
        let (connectivity, ends) = (of_cells("connectivity"), of_cells("offsets"));
        let mut start = 0;
        let cells = ends.iter().zip(of_cells("types")).map(|(end, kind)| {
            let points = connectivity[start..*end].to_vec();
            start = *end;
            (kind, points)
        });
        let cells: Vec<(usize, Vec<usize>)> = cells.collect();
        assert_eq!(points.len(), count("NumberOfPoints"));
        assert_eq!(cells.len(), count("NumberOfCells"));
        assert_eq!(ends.last(), Some(&connectivity.len()));
        let mut all = BTreeMap::new();
        for (kind, count) in [("PointData", points.len()), ("CellData", cells.len())] {
            for (name, rows) in arrays(child(piece, kind)) {
                assert_eq!(rows.len(), count, "{name}");
                assert!(all.insert(name, rows).is_none());
            }
        }
        let grid = Self {
            points,
            cells,
            arrays: all,
        };
        grid.assert_whole();
        grid
    }

    /// Every cell is of points that there are, as many as its kind has.
    fn assert_whole(&self) {
        for (kind, points) in &self.cells {
            let count = match *kind {
                VERTEX => 1,
                LINE => 2,
                other => panic!("a cell of kind {other}"),
            };
            assert_eq!(points.len(), count);
            assert!(points.iter().all(|point| *point < self.points.len()));
        }
    }

    /// The lines of segment `k` in the order of the report, each segment of twelve.
    fn lines(&self, k: usize) -> std::ops::Range<usize> {
        let lines = 12 * k..12 * (k + 1);
        for cell in lines.clone() {
            assert_eq!(self["part"][cell], [0.0]);
        }
        lines
    }

    /// The first and the last point of segment `k`.
    fn ends(&self, k: usize) -> [usize; 2] {
        let lines = self.lines(k);
        [self.cells[lines.start].1[0], self.cells[lines.end - 1].1[1]]
    }
}

impl Index<&str> for Grid {
    type Output = Vec<Vec<f64>>;

    fn index(&self, name: &str) -> &Self::Output {
        let known = || self.arrays.keys().collect::<Vec<_>>();
        self.arrays
            .get(name)
            .unwrap_or_else(|| panic!("no array `{name}` of {:?}", known()))
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
    let grid = Grid::read(&bench.path("bar.vtu"));
    let inertia = PI * 0.02_f64.powi(4) / 64.0;
    let stiffness = young(CANTILEVER) * inertia;
    let tip = 100.0 * 0.5_f64.powi(3) / (3.0 * stiffness);
    assert!(grid.points.len() >= 13);
    for (point, moved) in grid.points.iter().zip(&grid["displacement"]) {
        let x = point[0];
        let expected = -100.0 * x * x * (1.5 - x) / (6.0 * stiffness);
        assert_near(moved[2], expected, 1e-9, tip);
    }
    let beams = grid["part"].iter().filter(|part| part[0] == 0.0).count();
    assert_eq!(beams, 12);
    for (k, cell) in grid.lines(0).enumerate() {
        let middle = 0.5 * (k as f64 + 0.5) / 12.0;
        let moment = 100.0 * (0.5 - middle);
        assert_near(grid["Vz"][cell][0].abs(), 100.0, 1e-9, 100.0);
        assert_near(grid["My"][cell][0].abs(), moment, 1e-9, 50.0);
        assert_near(grid["T"][cell][0].abs(), 10.0, 1e-9, 10.0);
        let bent = 32.0 * moment / (PI * 0.02_f64.powi(3));
        let twisted = 16.0 * 10.0 / (PI * 0.02_f64.powi(3));
        let expected = (bent * bent + 3.0 * twisted * twisted).sqrt();
        assert_near(grid["von_mises"][cell][0], expected, 1e-9, expected);
        let young = young(CANTILEVER);
        let strains = [
            ("normal_strain", bent / young),
            ("shear_strain", twisted * 2.6 / young),
        ];
        for (name, strain) in strains {
            assert_near(grid[name][cell][0], strain, 1e-9, strain);
        }
        assert_eq!(grid["has_stress"][cell], [1.0]);
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

/// That a state's arrays hold at the segments what the report says of it: displacements of the
/// nodes at their ends, section forces, and stresses up to their largest.
fn assert_state(grid: &Grid, prefix: &str, state: &Value) {
    let array = |name: &str| &grid[&*format!("{prefix}{name}")];
    for (k, segment) in state["segments"].as_array().unwrap().iter().enumerate() {
        let body = segment["body"].as_str().unwrap();
        for (point, end) in segment["points"]
            .as_array()
            .unwrap()
            .iter()
            .zip(grid.ends(k))
        {
            let name = format!("{body}.{}", point.as_str().unwrap());
            let node = numbers(&state["displacements"][&name]);
            let found = [&*array("displacement")[end], &array("rotation")[end]].concat();
            for (found, node) in found.iter().zip(node) {
                // Numbers read back to the same double, but curves are formed in local axes.
                assert_near(*found, node, 1e-12, 1e-3);
            }
        }
        let at = |end: usize| numbers(&segment["section_forces"][end]["wrench"]);
        let [first, last] = [at(0), at(1)];
        let largest = segment["stress"]["von_mises"].as_f64().unwrap();
        for (line, cell) in grid.lines(k).enumerate() {
            let xi = (line as f64 + 0.5) / 12.0;
            for (axis, name) in ["N", "Vy", "Vz", "T", "My", "Mz"].iter().enumerate() {
                // Linear where nothing loads the beam between its ends.
                let expected = (1.0 - xi) * first[axis] + xi * last[axis];
                assert_near(array(name)[cell][0], expected, 1e-9, 100.0);
            }
            let stress = array("von_mises")[cell][0];
            assert!((0.0..=largest * (1.0 + 1e-9)).contains(&stress));
        }
    }
}

#[test]
fn a_delta_has_what_its_report_says() {
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
    let grid = Grid::read(&bench.path("delta.vtu"));
    assert_state(&grid, "", &json);
    // Modes at the ends of all segments, and at the platform's P.
    let segments = json["segments"].as_array().unwrap();
    for (mode, shape) in json["modes"].as_array().unwrap().iter().enumerate() {
        let shape = &shape["shape"];
        let found = &grid[&*format!("mode{}", mode + 1)];
        for (k, segment) in segments.iter().enumerate() {
            let body = segment["body"].as_str().unwrap();
            for (place, end) in grid.ends(k).into_iter().enumerate() {
                let point = segment["points"][place].as_str().unwrap();
                let node = numbers(&shape[&format!("{body}.{point}")]);
                for (found, node) in found[end].iter().zip(node) {
                    assert_near(*found, node, 1e-9, 1.0);
                }
            }
        }
    }
    // The platform's own P; the mean of its points lies in the same place.
    let at = |k: &usize| {
        let [x, y, z] = grid.points[*k][..] else {
            panic!("a point of three coordinates");
        };
        x.hypot(y).hypot(z - 0.5) < 1e-9
    };
    let expected = numbers(&json["displacements"]["platform.P"]);
    let found = (0..grid.points.len())
        .filter(at)
        .any(|k| grid["displacement"][k] == expected[..3] && grid["rotation"][k] == expected[3..]);
    assert!(found);
    let of_part = |wanted: f64| grid["part"].iter().filter(move |part| part[0] == wanted);
    let joints = json["joints"].as_object().unwrap().len();
    assert_eq!(of_part(2.0).count(), joints);
    assert_eq!(of_part(0.0).count(), 12 * segments.len());
    assert!(of_part(1.0).count() > 0);
}

#[test]
fn cases_have_arrays_of_their_own() {
    let bench = Bench::new("vtu-cases");
    // Names that mean something in XML.
    let cases = r#"cases: {
        "push & <pull>": [(on: ("bar", "B"), force: (0.0, 30.0, 0.0))],
        "twist": [(on: ("bar", "B"), moment: (5.0, 0.0, 0.0))],
    },
    output:"#;
    bench.file("bar.ron", &CANTILEVER.replacen("output:", cases, 1));
    let solve = ["solve", "bar.ron", "--format", "json", "--vtu", "bar.vtu"];
    let json = bench.hyperstat(&solve).ends_with(0).json();
    let grid = Grid::read(&bench.path("bar.vtu"));
    assert_state(&grid, "", &json);
    let names: Vec<_> = json["cases"].as_object().unwrap().keys().collect();
    assert_eq!(names.len(), 2);
    for name in names {
        assert_state(&grid, &format!("{name}."), &json["cases"][name]);
    }
    // T of `twist` in the middle of the bar.
    assert_near(grid["twist.T"][5][0].abs(), 5.0, 1e-12, 5.0);
    assert_eq!(grid["twist.Vz"][5][0], 0.0);
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
