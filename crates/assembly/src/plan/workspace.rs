//! Room for one pose's numbers.

use hyperstat_elements::subassembly::{JointFactor, absorption_workspace};
use hyperstat_joints::Dof;
use hyperstat_model::{Geometry, Model, NodeId};
use nalgebra::{Matrix6, Vector3, Vector6};

use super::Plan;
use super::coordinates::TreeBlocks;
use super::elements::ElementPlan;
use super::sparse::Factor;
use crate::error::SolveError;
use crate::room;
use crate::room::MOST_NUMBERS;

/// Buffers of one thread; made by [`Prepared::workspace`](crate::Prepared::workspace).
#[derive(Debug)]
pub struct Workspace {
    /// The plan that it was made by.
    pub(crate) plan: u64,
    pub(crate) tree: TreeBlocks,
    pub(crate) reduced: Vec<f64>,
    /// Which component of which node every IDC is, in this pose.
    pub(crate) identities: Vec<(NodeId, Dof)>,
    /// Deformation operators D of all elements (rows × columns, column-major).
    pub(crate) operators: Vec<f64>,
    /// Stiffnesses of the deformations.
    pub(crate) stiffnesses: Vec<f64>,
    /// By sets of loads: deformations that the elements start from, made by loads inside absorbed
    /// joints and between nodes, and by misfits.
    pub(crate) initial: Vec<f64>,
    /// By carriers: what misfits of rigid directions displace them by with all IDCs zero; empty
    /// where no misfit acts.
    pub(crate) offsets: Vec<Vector6<f64>>,
    /// Stiffness of the inner IDCs: the pattern's lower triangle.
    pub(crate) values: Vec<f64>,
    pub(crate) factor: Factor,
    /// Loads on the IDCs and solutions: six columns for the output's unit motions or unit forces,
    /// then one a set of loads.
    pub(crate) loads: Vec<f64>,
    pub(crate) solutions: Vec<f64>,
    /// What every set's column of the solutions lacks, below its rounding.
    pub(crate) remainders: Vec<f64>,
    pub(crate) residuals: Vec<f64>,
    pub(crate) right_sides: Vec<f64>,
    /// A pivot of loop elimination between zero and not zero.
    pub(crate) doubtful: Option<f64>,
    /// Twice the strain energy of every column.
    pub(crate) energies: Vec<f64>,
    /// Deformations and forces of one element.
    pub(crate) scratch: Vec<f64>,
    pub(crate) forces: Vec<f64>,
    /// From the first node of one subassembly to the others.
    pub(crate) arms: Vec<Vector3<f64>>,
    /// Absorbed joints of one subassembly.
    pub(crate) factors: Vec<JointFactor>,
    /// For absorbing the joints of one subassembly.
    pub(crate) absorption: Vec<f64>,
}

impl Workspace {
    /// Columns of loads and solutions.
    pub(crate) fn columns(&self) -> usize {
        self.energies.len()
    }
}

/// Column of the first set of loads, after those of the output's motions or forces.
pub(crate) const LOADS: usize = 6;

impl Plan {
    /// Buffers for one thread.
    pub(crate) fn workspace(&self) -> Workspace {
        let last = self.elements.last();
        let triangle = |e: &ElementPlan| e.rows * e.rows;
        let subassemblies = self.topology.subassemblies.iter();
        let sizes = subassemblies.map(|subassembly| {
            let joints = subassembly.joints.iter().flatten().count();
            (subassembly.nodes.len() - 1, joints)
        });
        let absorption = sizes.clone().map(|(n, j)| absorption_workspace(n, j));
        let no_joint = JointFactor {
            node: 0,
            factor: Matrix6::zeros(),
        };
        let mut workspace = Workspace {
            plan: self.id,
            tree: TreeBlocks::new(&self.topology),
            reduced: vec![0.0; self.reduced_len],
            identities: vec![(NodeId(0), Dof::X); self.unknowns],
            operators: vec![0.0; last.map_or(0, |e| e.operator_start + e.rows * e.columns.len())],
            stiffnesses: vec![0.0; last.map_or(0, |e| e.stiffness_start + triangle(e))],
            initial: Vec::new(),
            offsets: Vec::new(),
            values: vec![0.0; self.pattern.len()],
            factor: self.pattern.factor_buffers(0),
            loads: Vec::new(),
            solutions: Vec::new(),
            remainders: Vec::new(),
            residuals: Vec::new(),
            right_sides: Vec::new(),
            doubtful: None,
            energies: Vec::new(),
            scratch: Vec::new(),
            forces: Vec::new(),
            arms: vec![Vector3::zeros(); sizes.clone().map(|s| s.0).max().unwrap_or(0)],
            factors: vec![no_joint; sizes.map(|s| s.1).max().unwrap_or(0)],
            absorption: vec![0.0; absorption.max().unwrap_or(0)],
        };
        self.make_room(&mut workspace, 1);
        workspace
    }

    /// Refuses what does not belong to this plan: buffers, and a geometry that is not one of its model.
    pub(crate) fn check(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &Workspace,
    ) -> Result<(), SolveError> {
        if workspace.plan != self.id {
            return Err(SolveError::ForeignWorkspace);
        }
        Ok(model.check_geometry(geometry, self.one_point)?)
    }

    /// Refuses more sets of loads than there is room for, in the buffers or in their results.
    pub(crate) fn check_sets(&self, model: &Model, sets: usize) -> Result<(), SolveError> {
        const SETS: &str = "its cases, each with displacements and forces of its own,";
        let results = 6 * (model.nodes().len() + model.joints().len() + 4 * model.segments().len());
        let size = results.max(self.unknowns).max(self.deformations);
        room::check(SETS, room::matrix(LOADS + sets, size), MOST_NUMBERS)
    }

    /// Makes room in the buffers for this many sets of loads.
    pub(crate) fn make_room(&self, workspace: &mut Workspace, sets: usize) {
        let columns = LOADS + sets;
        if workspace.columns() == columns {
            return;
        }
        let width = |e: &ElementPlan| e.rows * e.columns.len().max(columns);
        let widest = self.elements.iter().map(width).max().unwrap_or(0);
        self.pattern.make_room(&mut workspace.factor, columns);
        for (buffer, length) in [
            (&mut workspace.initial, sets * self.deformations),
            (&mut workspace.loads, columns * self.unknowns),
            (&mut workspace.solutions, columns * self.unknowns),
            (&mut workspace.remainders, sets * self.unknowns),
            (&mut workspace.residuals, columns * self.unknowns),
            (&mut workspace.right_sides, columns * self.inner),
            (&mut workspace.energies, columns),
            (&mut workspace.scratch, widest),
            (&mut workspace.forces, widest),
        ] {
            buffer.clear();
            buffer.resize(length, 0.0);
        }
    }

    /// Block of a carrier (6 × columns, column-major).
    pub(crate) fn block<'a>(&self, workspace: &'a Workspace, carrier: usize) -> &'a [f64] {
        let length = 6 * self.columns[carrier].len();
        match self.reduced_starts[carrier] {
            Some(start) => &workspace.reduced[start..start + length],
            None => {
                let start = workspace.tree.starts[carrier];
                &workspace.tree.values[start..start + length]
            }
        }
    }
}
