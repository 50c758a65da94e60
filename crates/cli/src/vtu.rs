//! A solution as a VTU file: an unstructured grid of VTK, for ParaView and its like.

use std::fmt::Write as _;

use hyperstat_assembly::{
    BodyKind, Model, Modes, SegmentId, Solution, SolveError, section_wrench, segment_displacement,
};
use hyperstat_elements::stress::section_stress;
use nalgebra::{Point3, Vector6};

/// Pieces in which the curve of a segment is written, at least.
const PIECES: usize = 12;

/// VTK's numbers of the kinds of cells.
const VERTEX: u8 = 1;
const LINE: u8 = 3;

/// What a cell is a part of.
#[derive(Debug, Clone, Copy)]
enum Part {
    Beam = 0,
    Rigid = 1,
    Joint = 2,
}

/// A grid of points and cells with what is known at them.
#[derive(Debug, Default)]
struct Grid {
    points: Vec<[f64; 3]>,
    /// Of every point: translation and rotation.
    displacement: Vec<[f64; 6]>,
    /// Of every mode and point: translation.
    modes: Vec<Vec<[f64; 3]>>,
    cells: Vec<Cell>,
}

#[derive(Debug)]
struct Cell {
    /// One point, or two.
    points: Vec<usize>,
    part: Part,
    /// Number of the body, or of the joint.
    number: usize,
    /// N Vy Vz T My Mz in the middle; zero where it is no beam.
    forces: [f64; 6],
    /// Largest von Mises stress of the section in the middle; none where it is not known.
    von_mises: Option<f64>,
}

/// The solution of a model, with its modes where there are some, as the text of a VTU file.
///
/// Lengths are not magnified: what is shown displaced is for the reader of the file to choose.
///
/// # Errors
/// A segment that cannot be formed, which no segment of a solved model is.
pub(crate) fn vtu(
    model: &Model,
    solution: &Solution,
    modes: Option<&Modes>,
) -> Result<String, SolveError> {
    let mut grid = Grid {
        modes: vec![Vec::new(); modes.map_or(0, |modes| modes.modes.len())],
        ..Grid::default()
    };
    for segment in 0..model.segments().len() {
        grid.add_segment(model, solution, modes, SegmentId(segment))?;
    }
    grid.add_bodies(model, solution, modes);
    grid.add_joints(model, solution, modes);
    Ok(grid.text())
}

impl Grid {
    fn add_point(
        &mut self,
        at: Point3<f64>,
        moved: &Vector6<f64>,
        modes: &[Vector6<f64>],
    ) -> usize {
        self.points.push(at.into());
        self.displacement.push((*moved).into());
        for (column, mode) in self.modes.iter_mut().zip(modes) {
            column.push([mode[0], mode[1], mode[2]]);
        }
        self.points.len() - 1
    }

    /// Adds a node of the model.
    fn add_node(
        &mut self,
        model: &Model,
        solution: &Solution,
        modes: Option<&Modes>,
        node: usize,
    ) -> usize {
        let of_modes = modes.iter().flat_map(|modes| &modes.modes);
        let of_modes: Vec<_> = of_modes.map(|mode| mode.displacements[node]).collect();
        let at = model.geometry().positions[node];
        self.add_point(at, &solution.displacements[node], &of_modes)
    }

    /// Adds a segment as its elastic curve, with the forces on the section in the middle of each
    /// of its pieces.
    fn add_segment(
        &mut self,
        model: &Model,
        solution: &Solution,
        modes: Option<&Modes>,
        id: SegmentId,
    ) -> Result<(), SolveError> {
        let geometry = model.geometry();
        let segment = &model.segments()[id.0];
        let [start, end] = segment.ends.map(|node| geometry.positions[node.0]);
        let forces = &solution.segments[id.0];
        // As many in each element, so that the nodes between them are points.
        let pieces = segment.elements * PIECES.div_ceil(segment.elements);
        let mut last = None;
        for k in 0..=pieces {
            let xi = k as f64 / pieces as f64;
            let curve = |displacements: &[Vector6<f64>], load| {
                segment_displacement(model, geometry, displacements, id, load, xi)
            };
            let moved = curve(&solution.displacements, Some(&forces.load))?;
            let mut of_modes = Vec::new();
            for mode in modes.iter().flat_map(|modes| &modes.modes) {
                of_modes.push(if segment.elements == 1 {
                    curve(&mode.displacements, None)?
                } else {
                    let ends = segment.ends.map(|node| mode.displacements[node.0]);
                    between(&ends, &mode.inner[id.0], xi)
                });
            }
            let point = self.add_point(start.lerp(&end, xi), &moved, &of_modes);
            if let Some(last) = last.replace(point) {
                let middle = xi - 0.5 / pieces as f64;
                let wrench = section_wrench(model, id, forces, middle);
                let section = match segment.change_of_section() {
                    Ok(Some(taper)) => Some(taper.at(middle)),
                    _ => Some(segment.section.clone()),
                };
                let stress = section
                    .zip(wrench.as_ref())
                    .and_then(|(section, wrench)| section_stress(&section, wrench));
                self.cells.push(Cell {
                    points: vec![last, point],
                    part: Part::Beam,
                    number: segment.body.0,
                    forces: wrench.unwrap_or_default().into(),
                    von_mises: stress.map(|stress| stress.von_mises),
                });
            }
        }
        Ok(())
    }

    /// Adds the bodies that are no beams: lines from the middle of their nodes to each.
    fn add_bodies(&mut self, model: &Model, solution: &Solution, modes: Option<&Modes>) {
        for (number, body) in model.bodies().iter().enumerate() {
            if body.kind == BodyKind::Elastic {
                continue;
            }
            let nodes: Vec<usize> = body.nodes.iter().map(|node| node.0).collect();
            let ends: Vec<usize> = (nodes.iter())
                .map(|node| self.add_node(model, solution, modes, *node))
                .collect();
            let mut add = |points| {
                self.cells.push(Cell {
                    points,
                    part: Part::Rigid,
                    number,
                    forces: [0.0; 6],
                    von_mises: None,
                });
            };
            match *ends {
                [] => {}
                [alone] => add(vec![alone]),
                [first, second] => add(vec![first, second]),
                _ => {
                    // The mean of a rigid body's points moves with it.
                    let share = 1.0 / nodes.len() as f64;
                    let mean = |of: &[Vector6<f64>]| -> Vector6<f64> {
                        nodes.iter().map(|node| share * of[*node]).sum()
                    };
                    let positions = &model.geometry().positions;
                    let at: nalgebra::Vector3<f64> = nodes
                        .iter()
                        .map(|node| share * positions[*node].coords)
                        .sum();
                    let of_modes = modes.iter().flat_map(|modes| &modes.modes);
                    let of_modes: Vec<_> = of_modes.map(|mode| mean(&mode.displacements)).collect();
                    let moved = mean(&solution.displacements);
                    let middle = self.add_point(at.into(), &moved, &of_modes);
                    for end in &ends {
                        self.cells.push(Cell {
                            points: vec![middle, *end],
                            part: Part::Rigid,
                            number,
                            forces: [0.0; 6],
                            von_mises: None,
                        });
                    }
                }
            }
        }
    }

    /// Adds the joints, each a point that moves with the last of its bodies.
    fn add_joints(&mut self, model: &Model, solution: &Solution, modes: Option<&Modes>) {
        for (number, joint) in model.joints().iter().enumerate() {
            let Some(node) = joint.between.iter().rev().flatten().next() else {
                continue;
            };
            let point = self.add_node(model, solution, modes, node.0);
            self.cells.push(Cell {
                points: vec![point],
                part: Part::Joint,
                number,
                forces: [0.0; 6],
                von_mises: None,
            });
        }
    }

    fn text(&self) -> String {
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
             <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
            self.points.len(),
            self.cells.len()
        );
        text += "<Points>\n";
        floats(&mut text, "points", 3, self.points.iter().flatten());
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
        let moved = self.displacement.iter();
        floats(
            &mut text,
            "displacement",
            3,
            moved.clone().flat_map(|u| &u[..3]),
        );
        floats(&mut text, "rotation", 3, moved.flat_map(|u| &u[3..]));
        for (k, mode) in self.modes.iter().enumerate() {
            let name = format!("mode{}", k + 1);
            floats(&mut text, &name, 3, mode.iter().flatten());
        }
        text += "</PointData>\n<CellData>\n";
        for (k, name) in ["N", "Vy", "Vz", "T", "My", "Mz"].iter().enumerate() {
            let column = self.cells.iter().map(|cell| &cell.forces[k]);
            floats(&mut text, name, 1, column);
        }
        let stresses: Vec<f64> = (self.cells.iter())
            .map(|cell| cell.von_mises.unwrap_or(0.0))
            .collect();
        floats(&mut text, "von_mises", 1, stresses.iter());
        let known = self
            .cells
            .iter()
            .map(|cell| usize::from(cell.von_mises.is_some()));
        integers(&mut text, "has_stress", known);
        integers(
            &mut text,
            "part",
            self.cells.iter().map(|cell| cell.part as usize),
        );
        integers(
            &mut text,
            "number",
            self.cells.iter().map(|cell| cell.number),
        );
        text += "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
        text
    }
}

/// Linear between the nodes of a segment's elements.
fn between(ends: &[Vector6<f64>; 2], inner: &[Vector6<f64>], xi: f64) -> Vector6<f64> {
    let nodes: Vec<&Vector6<f64>> = std::iter::once(&ends[0])
        .chain(inner)
        .chain([&ends[1]])
        .collect();
    let along = xi * (nodes.len() - 1) as f64;
    let before = (along.floor() as usize).min(nodes.len() - 2);
    let part = along - before as f64;
    nodes[before] * (1.0 - part) + nodes[before + 1] * part
}

fn floats<'a>(
    text: &mut String,
    name: &str,
    components: usize,
    numbers: impl Iterator<Item = &'a f64>,
) {
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"ascii\">"
    );
    let mut buffer = zmij::Buffer::new();
    for (k, number) in numbers.enumerate() {
        text.push(if k % components == 0 { '\n' } else { ' ' });
        text.push_str(buffer.format(*number));
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
