//! Room for one pose's numbers.

use hyperstat_elements::subassembly::JointFactor;
use hyperstat_joints::Dof;
use nalgebra::{Vector3, Vector6};

use super::coordinates::TreeBlocks;
use super::sparse::Factor;
use hyperstat_model::NodeId;

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
    /// From the first node of one cluster to the others.
    pub(crate) arms: Vec<Vector3<f64>>,
    /// Absorbed joints of one cluster.
    pub(crate) factors: Vec<JointFactor>,
    /// For absorbing the joints of one cluster.
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
