//! A solution as a VTU file: an unstructured grid of VTK, for ParaView and its like.

use std::fmt::Write as _;

use hyperstat_assembly::{
    BodyKind, Mode, Model, Modes, SegmentForces, SegmentId, Solution, SolveError, section_strain,
    section_wrench, segment_displacement,
};
use hyperstat_elements::stress::stress_parts;
use nalgebra::{Vector3, Vector6};

use crate::answer::linear;

/// Pieces in which the curve of a segment is written, at least.
const PIECES: usize = 12;

/// VTK's numbers of the kinds of cells.
const VERTEX: u8 = 1;
const LINE: u8 = 3;

/// What a cell is a part of.
#[derive(Debug, Clone, Copy)]
enum CellKind {
    Beam = 0,
    Rigid = 1,
    Joint = 2,
}

/// What is written of a model: its states, of which the first is the base state, and its modes.
struct Written<'a> {
    model: &'a Model,
    states: Vec<Shown<'a>>,
    modes: &'a [Mode],
}

/// What loads that act together do.
struct Shown<'a> {
    /// Before the names of its arrays: nothing for the base state, `<case>.` for a case.
    prefix: String,
    displacements: &'a [Vector6<f64>],
    segments: &'a [SegmentForces],
}

/// A grid of points and cells with what is known at them.
#[derive(Debug, Default)]
struct Grid {
    points: Vec<Vertex>,
    cells: Vec<Cell>,
}

#[derive(Debug)]
struct Vertex {
    at: [f64; 3],
    /// In every state: translation and rotation.
    displacements: Vec<[f64; 6]>,
    /// In every mode: translation.
    modes: Vec<[f64; 3]>,
}

#[derive(Debug)]
struct Cell {
    /// One point, or two.
    points: Vec<usize>,
    part: CellKind,
    /// Number of the body, or of the joint.
    number: usize,
    /// In every state, the section in the middle; empty where it is no beam.
    sections: Vec<Section>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Section {
    /// N Vy Vz T My Mz.
    forces: [f64; 6],
    /// What is known of its worst point; none of a general section that does not state enough.
    worst: Option<Worst>,
}

/// The point of a section with the largest normal stress.
#[derive(Debug, Clone, Copy, Default)]
struct Worst {
    von_mises: f64,
    /// Strain along the beam there, positive in tension.
    normal_strain: f64,
    /// The largest shear strain of torsion in the section.
    shear_strain: f64,
}

/// The solution of a model, its cases too, with its modes where there are some, as the text of a
/// VTU file.
///
/// Lengths are not magnified: what is shown displaced is for the reader of the file to choose.
///
/// # Errors
/// A segment that cannot be formed, which no segment of a solved model is.
pub fn vtu(
    model: &Model,
    solution: &Solution,
    modes: Option<&Modes>,
) -> Result<String, SolveError> {
    let base = Shown {
        prefix: String::new(),
        displacements: &solution.displacements,
        segments: &solution.segments,
    };
    let cases = solution.cases.iter().map(|case| Shown {
        prefix: format!("{}.", case.name),
        displacements: &case.state.displacements,
        segments: &case.state.segments,
    });
    let found = Written {
        model,
        states: std::iter::once(base).chain(cases).collect(),
        modes: modes.map_or(&[], |modes| &modes.modes),
    };
    let mut grid = Grid::default();
    for segment in 0..model.segments().len() {
        grid.add_segment(&found, SegmentId(segment))?;
    }
    grid.add_bodies(&found);
    grid.add_joints(&found);
    Ok(grid.text(&found))
}

impl Written<'_> {
    /// A node of the model as a point.
    fn node(&self, node: usize) -> Vertex {
        self.mean(&[node])
    }

    /// The mean of nodes as a point: of a rigid body's nodes it moves with the body.
    fn mean(&self, nodes: &[usize]) -> Vertex {
        let share = 1.0 / nodes.len() as f64;
        let mean = |of: &[Vector6<f64>]| -> Vector6<f64> {
            nodes.iter().map(|node| share * of[*node]).sum()
        };
        let positions = &self.model.geometry().positions;
        let at: Vector3<f64> = (nodes.iter())
            .map(|node| share * positions[*node].coords)
            .sum();
        let states = self.states.iter();
        let modes = self.modes.iter();
        Vertex {
            at: at.into(),
            displacements: states
                .map(|state| mean(state.displacements).into())
                .collect(),
            modes: modes
                .map(|mode| linear(&mean(&mode.displacements)))
                .collect(),
        }
    }

    /// A point of a segment's elastic curve.
    fn along(&self, id: SegmentId, xi: f64) -> Result<Vertex, SolveError> {
        let (model, geometry) = (self.model, self.model.geometry());
        let ends = model.segments()[id.0].ends;
        let [start, end] = ends.map(|node| geometry.positions[node.0]);
        let moved = |state: &Shown<'_>| {
            let load = Some(&state.segments[id.0].load);
            segment_displacement(model, geometry, state.displacements, id, load, xi).map(Into::into)
        };
        let shape = |mode: &Mode| {
            let moved = mode.segment_displacement(model, id, xi);
            moved.map(|moved| linear(&moved))
        };
        Ok(Vertex {
            at: start.lerp(&end, xi).into(),
            displacements: self.states.iter().map(moved).collect::<Result<_, _>>()?,
            modes: self.modes.iter().map(shape).collect::<Result<_, _>>()?,
        })
    }

    /// What is known of the section of a segment at `xi`, in every state.
    fn sections(&self, id: SegmentId, xi: f64) -> Vec<Section> {
        let segment = &self.model.segments()[id.0];
        let section = match segment.change_of_section() {
            Ok(Some(taper)) => taper.at(xi),
            _ => segment.section.clone(),
        };
        let of_state = |state: &Shown<'_>| {
            let forces = &state.segments[id.0];
            let wrench = section_wrench(self.model, id, forces, xi);
            let worst = || {
                let stress = stress_parts(&section, wrench.as_ref()?)?;
                let strain = section_strain(self.model, id, forces, xi)?;
                let [y, z] = stress.point;
                Some(Worst {
                    von_mises: stress.von_mises,
                    normal_strain: strain.normal(y, z),
                    shear_strain: stress.torsional / segment.material.shear(),
                })
            };
            Section {
                worst: worst(),
                forces: wrench.unwrap_or_default().into(),
            }
        };
        self.states.iter().map(of_state).collect()
    }
}

impl Grid {
    fn add_point(&mut self, point: Vertex) -> usize {
        self.points.push(point);
        self.points.len() - 1
    }

    /// Adds a segment as its elastic curve, with the forces on the section in the middle of each
    /// of its pieces.
    fn add_segment(&mut self, found: &Written<'_>, id: SegmentId) -> Result<(), SolveError> {
        let segment = &found.model.segments()[id.0];
        // As many in each element, so that the nodes between them are points.
        let pieces = segment.elements * PIECES.div_ceil(segment.elements);
        let mut last = None;
        for k in 0..=pieces {
            let xi = k as f64 / pieces as f64;
            let point = self.add_point(found.along(id, xi)?);
            if let Some(last) = last.replace(point) {
                self.cells.push(Cell {
                    points: vec![last, point],
                    part: CellKind::Beam,
                    number: segment.body.0,
                    sections: found.sections(id, xi - 0.5 / pieces as f64),
                });
            }
        }
        Ok(())
    }

    /// Adds the bodies that are no beams: lines from the middle of their nodes to each.
    fn add_bodies(&mut self, found: &Written<'_>) {
        for (number, body) in found.model.bodies().iter().enumerate() {
            if body.kind == BodyKind::Elastic {
                continue;
            }
            let nodes: Vec<usize> = body.nodes.iter().map(|node| node.0).collect();
            let ends: Vec<usize> = (nodes.iter())
                .map(|node| self.add_point(found.node(*node)))
                .collect();
            let cells = match *ends {
                [] => Vec::new(),
                [alone] => vec![vec![alone]],
                [first, second] => vec![vec![first, second]],
                _ => {
                    let middle = self.add_point(found.mean(&nodes));
                    ends.iter().map(|end| vec![middle, *end]).collect()
                }
            };
            self.cells.extend(cells.into_iter().map(|points| Cell {
                points,
                part: CellKind::Rigid,
                number,
                sections: Vec::new(),
            }));
        }
    }

    /// Adds the joints, each a point that moves with the last of its bodies.
    fn add_joints(&mut self, found: &Written<'_>) {
        for (number, joint) in found.model.joints().iter().enumerate() {
            let Some(node) = joint.between.iter().rev().flatten().next() else {
                continue;
            };
            let point = self.add_point(found.node(node.0));
            self.cells.push(Cell {
                points: vec![point],
                part: CellKind::Joint,
                number,
                sections: Vec::new(),
            });
        }
    }

    fn text(&self, found: &Written<'_>) -> String {
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
             <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
            self.points.len(),
            self.cells.len()
        );
        text += "<Points>\n";
        let places = self.points.iter().flat_map(|point| point.at);
        floats(&mut text, "points", 3, places);
        text += "</Points>\n<Cells>\n";
        let points = self.cells.iter().flat_map(|cell| &cell.points);
        integers(&mut text, "connectivity", points.copied());
        let ends = self.cells.iter().scan(0, |end, cell| {
            *end += cell.points.len();
            Some(*end)
        });
        integers(&mut text, "offsets", ends);
        let kinds = self.cells.iter().map(|cell| match cell.points.len() {
            1 => usize::from(VERTEX),
            _ => usize::from(LINE),
        });
        integers(&mut text, "types", kinds);
        text += "</Cells>\n<PointData Vectors=\"displacement\">\n";
        for (k, Shown { prefix, .. }) in found.states.iter().enumerate() {
            let parts = |from: usize| {
                let all = self.points.iter().map(move |point| &point.displacements[k]);
                all.flat_map(move |moved| moved[from..from + 3].iter().copied())
            };
            floats(&mut text, &format!("{prefix}displacement"), 3, parts(0));
            floats(&mut text, &format!("{prefix}rotation"), 3, parts(3));
        }
        for k in 0..found.modes.len() {
            let shape = self.points.iter().flat_map(|point| point.modes[k]);
            floats(&mut text, &format!("mode{}", k + 1), 3, shape);
        }
        text += "</PointData>\n<CellData>\n";
        for (k, Shown { prefix, .. }) in found.states.iter().enumerate() {
            let sections = || {
                let of_cell = |cell: &Cell| cell.sections.get(k).copied().unwrap_or_default();
                self.cells.iter().map(of_cell)
            };
            for (component, name) in ["N", "Vy", "Vz", "T", "My", "Mz"].iter().enumerate() {
                let column = sections().map(|section| section.forces[component]);
                floats(&mut text, &format!("{prefix}{name}"), 1, column);
            }
            let of_worst =
                |worst: Worst| [worst.von_mises, worst.normal_strain, worst.shear_strain];
            for (k, name) in ["von_mises", "normal_strain", "shear_strain"]
                .iter()
                .enumerate()
            {
                let column =
                    sections().map(|section| of_worst(section.worst.unwrap_or_default())[k]);
                floats(&mut text, &format!("{prefix}{name}"), 1, column);
            }
        }
        // Whether a section has stresses does not depend on the state.
        let known = self.cells.iter().map(|cell| {
            let base = cell.sections.first();
            usize::from(base.is_some_and(|section| section.worst.is_some()))
        });
        integers(&mut text, "has_stress", known);
        let parts = self.cells.iter().map(|cell| cell.part as usize);
        integers(&mut text, "part", parts);
        let numbers = self.cells.iter().map(|cell| cell.number);
        integers(&mut text, "number", numbers);
        text += "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
        text
    }
}

/// A name as the value of an attribute in XML: without what means something there, or nothing.
fn attribute(name: &str) -> String {
    let mut safe = String::with_capacity(name.len());
    for c in name.chars() {
        match c {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

fn floats(text: &mut String, name: &str, components: usize, numbers: impl Iterator<Item = f64>) {
    let name = attribute(name);
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"ascii\">"
    );
    let mut buffer = zmij::Buffer::new();
    for (k, number) in numbers.enumerate() {
        text.push(if k % components == 0 { '\n' } else { ' ' });
        text.push_str(buffer.format(number));
    }
    text.push_str("\n</DataArray>\n");
}

fn integers(text: &mut String, name: &str, numbers: impl Iterator<Item = usize>) {
    let kind = if name == "types" { "UInt8" } else { "Int64" };
    let _ = write!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">"
    );
    for number in numbers {
        let _ = write!(text, "\n{number}");
    }
    text.push_str("\n</DataArray>\n");
}
