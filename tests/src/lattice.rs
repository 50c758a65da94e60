//! Lattices of beams of any size: one frame body, or many bodies joined by bushings and hinges.

use hyperstat_assembly::{JointStiffness, Member, Model};
use hyperstat_joints::{Fixed, Revolute, frame_from_axis};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

use crate::build::{circle, connection, member, node, steel, weld_to_ground};

/// Distance of neighbouring nodes (m).
pub const PITCH: f64 = 0.1;
/// Diameter of the struts (m).
const DIAMETER: f64 = 0.01;

/// Nodes of a grid along x, y and z.
#[derive(Debug, Clone, Copy)]
struct Grid {
    counts: [usize; 3],
}

impl Grid {
    fn new(nx: usize, ny: usize, nz: usize) -> Self {
        assert!(nx > 0 && ny > 0 && nz > 1, "a lattice has two layers");
        Self {
            counts: [nx, ny, nz],
        }
    }

    /// Nodes, x fastest.
    fn nodes(self) -> impl Iterator<Item = [usize; 3]> {
        let [nx, ny, nz] = self.counts;
        let layer = move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z]));
        (0..nz).flat_map(layer)
    }

    fn index(self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// Struts: first node and the axis along which the second follows. None lies in the
    /// grounded layer z = 0.
    fn struts(self) -> impl Iterator<Item = ([usize; 3], usize)> {
        self.nodes().flat_map(move |at| {
            let along = (0..3).filter(move |&k| at[k] + 1 < self.counts[k]);
            let along = along.filter(move |&k| k == 2 || at[2] > 0);
            along.map(move |k| (at, k))
        })
    }

    /// The last node: the corner farthest from the origin.
    fn corner(self) -> [usize; 3] {
        self.counts.map(|count| count - 1)
    }
}

fn next(mut at: [usize; 3], axis: usize) -> [usize; 3] {
    at[axis] += 1;
    at
}

fn name([x, y, z]: [usize; 3]) -> String {
    format!("{x}_{y}_{z}")
}

fn place(at: [usize; 3]) -> Point3<f64> {
    Point3::from(at.map(|k| k as f64 * PITCH))
}

/// A cubic lattice of nx × ny × nz nodes as one frame body `lattice`: steel struts along x, y and
/// z, the layer z = 0 welded to the ground, a force on the farthest corner, which is the output.
/// It has `6 nx ny (nz − 1)` unknowns.
///
/// # Panics
/// With fewer than two layers.
pub fn lattice(nx: usize, ny: usize, nz: usize) -> Model {
    let grid = Grid::new(nx, ny, nz);
    let mut model = Model::new("lattice");
    let names: Vec<String> = grid.nodes().map(name).collect();
    let places = grid.nodes().map(place);
    let points: Vec<_> = names.iter().map(String::as_str).zip(places).collect();
    let (steel, section) = (steel(), circle(DIAMETER));
    let strut = |(at, axis)| {
        let ends = [grid.index(at), grid.index(next(at, axis))];
        member(ends, &steel, &section)
    };
    let members: Vec<Member> = grid.struts().map(strut).collect();
    model
        .add_elastic("lattice", &points, &members)
        .expect("a frame");
    for at in grid.nodes().take_while(|at| at[2] == 0) {
        weld_to_ground(&mut model, "lattice", &name(at));
    }
    finish(model, "lattice", grid)
}

/// The same lattice of many bodies: a rigid hub at every node and a beam for every strut, which a
/// hinge joins to the hub before it and an elastic bushing to the hub after it. The hinges' axes
/// lie across the struts and change from axis to axis; the hubs of the layer z = 0 are welded to
/// the ground. Bodies are named `hub_…` and `strut_…`.
///
/// # Panics
/// With fewer than two layers.
pub fn jointed_lattice(nx: usize, ny: usize, nz: usize) -> Model {
    let grid = Grid::new(nx, ny, nz);
    let mut model = Model::new("jointed lattice");
    let (steel, section) = (steel(), circle(DIAMETER));
    let hub = |at| format!("hub_{}", name(at));
    for at in grid.nodes() {
        let point = name(at);
        model
            .add_rigid(&hub(at), &[(&point, place(at))])
            .expect("a hub");
    }
    let bushing = [1e8, 1e8, 1e8, 1e5, 1e5, 1e5].map(Some);
    for (at, axis) in grid.struts() {
        let to = next(at, axis);
        let strut = format!("strut_{}_{}", name(at), ["x", "y", "z"][axis]);
        let (from_name, to_name) = (name(at), name(to));
        let points = [(from_name.as_str(), place(at)), (&to_name, place(to))];
        model
            .add_beam(&strut, &points, &steel, &section, None, 1)
            .expect("a strut");
        let between = |model: &Model, at, point: &str| {
            [
                Some(node(model, &hub(at), point)),
                Some(node(model, &strut, point)),
            ]
        };
        let across = Vector3::ith((axis + 1) % 3, 1.0);
        let frame = frame_from_axis(Some(&across), None).expect("an axis");
        let ends = between(&model, at, &from_name);
        let hinge = connection(&format!("{strut}_hinge"), ends, Revolute);
        model.add_joint(hinge, frame).expect("a joint");
        let ends = between(&model, to, &to_name);
        let mut weld = connection(&format!("{strut}_bushing"), ends, Fixed);
        weld.stiffness = JointStiffness::Directions(bushing);
        model
            .add_joint(weld, Rotation3::identity())
            .expect("a joint");
    }
    for at in grid.nodes().take_while(|at| at[2] == 0) {
        weld_to_ground(&mut model, &hub(at), &name(at));
    }
    let corner = hub(grid.corner());
    finish(model, &corner, grid)
}

/// Loads the farthest corner and makes it the output.
fn finish(mut model: Model, body: &str, grid: Grid) -> Model {
    let corner = node(&model, body, &name(grid.corner()));
    let wrench = Vector6::new(10.0, -20.0, 5.0, 0.3, 0.2, -0.1);
    model.add_load(corner, wrench).expect("a load");
    model.set_output(corner);
    model
}
