//! The independent displacement coordinates (IDCs) of a joint and the mapping N.

use nalgebra::{Dyn, Matrix3, Matrix6, OMatrix, Rotation3, U6, Vector6};

use crate::dof::{Dof, DofSet};
use crate::error::JointError;
use crate::motions::Motions;

/// How far a row of N at an IDC may be from the identity's in [`Mapping::new`].
const IDENTITY: f64 = 1e-9;

/// Which components of `u_i` are independent, and `u_i` as a function of them and of `u_j`:
///
/// `u_i = N [u_i at the IDCs; u_j]`, `N = [n_i | n_j]`, 6×(f + 6)
///
/// for a joint between body i and body j along which they may move in f ways. All components
/// are along the global axes: `Δx Δy Δz` \[m\], `φx φy φz` \[rad\]. The columns of `n_i` are in the
/// ascending order of the IDCs. The row of N at an IDC gives back the IDC itself, exactly.
///
/// Where body j is the ground, `u_j = 0` and `n_i` alone is the mapping (paper §2.2.2).
///
/// ```
/// use hyperstat_joints::{Dof, DofSet, Joint, Revolute, frame_from_axis};
/// use nalgebra::{Vector3, Vector6};
///
/// let frame = frame_from_axis(Some(&Vector3::new(0.0, 1.0, 2.0)), None)?;
/// let hinge = Revolute.mapping(&frame, Revolute.free())?;
/// assert_eq!(hinge.idcs(), DofSet::new(&[Dof::W]));     // φz: the axis is nearest to z
/// assert_eq!(hinge.column(0), &Vector6::new(0.0, 0.0, 0.0, 0.0, 0.5, 1.0));
/// # Ok::<(), hyperstat_joints::JointError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Mapping {
    idcs: DofSet,
    n_i: [Vector6<f64>; 6],
    n_j: Matrix6<f64>,
}

impl Mapping {
    /// A mapping from its parts: the IDCs among the components of `u_i`, one column of `n_i`
    /// for each in ascending order, and the block of `u_j`.
    ///
    /// # Errors
    /// [`JointError::ColumnCount`] where there are not as many columns as IDCs,
    /// [`JointError::NotFinite`] where an entry is not finite, [`JointError::NotIdentity`]
    /// where the row at an IDC is farther than 1e-9 from the identity's (1 in its own column,
    /// 0 elsewhere). A row that is near enough is set to the identity's exactly.
    pub fn new(idcs: DofSet, n_i: &[Vector6<f64>], n_j: Matrix6<f64>) -> Result<Self, JointError> {
        if n_i.len() != idcs.len() {
            return Err(JointError::ColumnCount {
                idcs: idcs.len(),
                columns: n_i.len(),
            });
        }
        let finite = |entry: &f64| entry.is_finite();
        if !n_i.iter().flatten().all(finite) || !n_j.iter().all(finite) {
            return Err(JointError::NotFinite { what: "mapping N" });
        }
        let mut mapping = Self {
            idcs,
            n_i: [Vector6::zeros(); 6],
            n_j,
        };
        mapping.n_i[..n_i.len()].copy_from_slice(n_i);
        for (k, idc) in idcs.iter().enumerate() {
            mapping.set_identity_row(k, idc)?;
        }
        Ok(mapping)
    }

    fn set_identity_row(&mut self, k: usize, idc: Dof) -> Result<(), JointError> {
        let row = idc.index();
        let mut error = self.n_j.row(row).amax();
        self.n_j.row_mut(row).fill(0.0);
        for (l, column) in self.n_i[..self.idcs.len()].iter_mut().enumerate() {
            let exact = if k == l { 1.0 } else { 0.0 };
            error = error.max((column[row] - exact).abs());
            column[row] = exact;
        }
        if error > IDENTITY {
            return Err(JointError::NotIdentity { idc });
        }
        Ok(())
    }

    /// The mapping of a joint whose relative motions, in its own frame, are the columns
    /// `moving` of `basis` (see [`Joint::basis`](crate::Joint::basis)).
    ///
    /// With S the columns in global axes, `u_i = u_j + S q`. The IDCs are the f components of
    /// `u_i` whose rows S_f have the largest minor, and `N = [S S_f⁻¹ | E − S S_f⁻¹ P_f]`,
    /// where P_f takes the IDCs' components out of `u_j`. This contains Eqs. 17–19, 23, 28,
    /// 30 and 33–36 of the paper.
    ///
    /// Rotations and translations have different units, so their rows are chosen apart: as
    /// many rotations as S has independent ones, and a translation for each motion that is a
    /// pure translation or can be made one by combining columns. Minors that tie to 1e-9 take
    /// the first in the order x, y, z (pairs: xy, xz, yz). So, in every orientation, the
    /// entries of N between rotations and those between translations are at most 1, and those
    /// from rotations to translations are bounded by the travel per angle of the motions.
    ///
    /// The same arguments give the same result to the last bit; nothing is allocated.
    ///
    /// # Errors
    /// [`JointError::DependentMotions`] where the columns depend on each other,
    /// [`JointError::NotFinite`] where the basis or the frame is not finite.
    pub fn of(
        basis: &Matrix6<f64>,
        frame: &Rotation3<f64>,
        moving: DofSet,
    ) -> Result<Self, JointError> {
        if !basis.iter().all(|entry| entry.is_finite()) {
            return Err(JointError::NotFinite {
                what: "joint basis",
            });
        }
        if !frame.matrix().iter().all(|entry| entry.is_finite()) {
            return Err(JointError::NotFinite {
                what: "joint frame",
            });
        }
        let motions = Motions::of(basis, moving)?.turned(frame);
        let translations = motions.translations.axis_choice();
        let rotations = motions.rotations.axis_choice();
        // S S_f⁻¹ P_f: a relative displacement from its components at the IDCs.
        let dependent = Matrix3::identity() - translations.projection;
        let mut relative = Matrix6::zeros();
        relative
            .fixed_view_mut::<3, 3>(0, 0)
            .copy_from(&translations.projection);
        relative
            .fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&(dependent * motions.coupling * rotations.projection));
        relative
            .fixed_view_mut::<3, 3>(3, 3)
            .copy_from(&rotations.projection);

        let [x, y, z] = translations.independent;
        let [u, v, w] = rotations.independent;
        let is_idc = [x, y, z, u, v, w];
        let idcs: DofSet = Dof::ALL.into_iter().filter(|d| is_idc[d.index()]).collect();
        let mut n_i = [Vector6::zeros(); 6];
        for (column, idc) in n_i.iter_mut().zip(idcs.iter()) {
            *column = relative.column(idc.index()).into_owned();
        }
        Self::new(idcs, &n_i[..idcs.len()], Matrix6::identity() - relative)
    }

    /// The components of `u_i` that are IDCs; ascending, they are the order of the columns.
    pub fn idcs(&self) -> DofSet {
        self.idcs
    }

    /// Number f of IDCs among the components of `u_i`, 0 to 6.
    pub fn len(&self) -> usize {
        self.idcs.len()
    }

    /// Whether `u_i` follows from `u_j` alone.
    pub fn is_empty(&self) -> bool {
        self.idcs.is_empty()
    }

    /// The columns of the IDCs of `u_i`, in their ascending order.
    pub fn n_i(&self) -> &[Vector6<f64>] {
        &self.n_i[..self.len()]
    }

    /// The column of the k-th IDC of `u_i`.
    ///
    /// # Panics
    /// Where `k` is not less than [`Mapping::len`].
    pub fn column(&self, k: usize) -> &Vector6<f64> {
        &self.n_i()[k]
    }

    /// The block of `u_j`, 6×6.
    pub fn n_j(&self) -> &Matrix6<f64> {
        &self.n_j
    }

    /// Body to body: `N = [n_i | n_j]`, 6×(f + 6). Allocates.
    pub fn matrix(&self) -> OMatrix<f64, U6, Dyn> {
        let f = self.len();
        OMatrix::<f64, U6, Dyn>::from_fn(f + 6, |row, k| {
            if k < f {
                self.n_i[k][row]
            } else {
                self.n_j[(row, k - f)]
            }
        })
    }

    /// Body to ground: `N = n_i`, 6×f. Allocates.
    pub fn ground_matrix(&self) -> OMatrix<f64, U6, Dyn> {
        OMatrix::<f64, U6, Dyn>::from_fn(self.len(), |row, k| self.n_i[k][row])
    }
}
