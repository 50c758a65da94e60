//! Straight prismatic beams: Euler–Bernoulli, or Timoshenko where the section has shear areas.

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::error::{ElementError, check, positive};
use crate::frame::{Matrix12, transport};
use crate::material::Material;
use crate::section::Section;
use crate::straight::StraightBeam;

/// A straight prismatic beam between two nodes, with no load between them.
///
/// Everything is in the element frame (see [`element_frame`](crate::element_frame)): x from
/// node 1 to node 2, y and z the section's principal axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    length: f64,
    axial: f64,
    torsional: f64,
    bending_y: f64,
    bending_z: f64,
    shear_compliance_y: f64,
    shear_compliance_z: f64,
}

/// Strains of a beam's section (Eq. 46).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionStrain {
    /// Axial strain of the centroid dΔx/dx, positive in tension.
    pub axial: f64,
    /// Shear strain dΔy/dx − φz; zero for an Euler–Bernoulli beam.
    pub shear_y: f64,
    /// Shear strain dΔz/dx + φy; zero for an Euler–Bernoulli beam.
    pub shear_z: f64,
    /// Rate of twist dφx/dx \[rad/m\].
    pub twist: f64,
    /// Curvature dφy/dx \[rad/m\].
    pub curvature_y: f64,
    /// Curvature dφz/dx \[rad/m\].
    pub curvature_z: f64,
}

impl From<Vector6<f64>> for SectionStrain {
    /// From the components (εx γy γz κx κy κz).
    fn from(s: Vector6<f64>) -> Self {
        Self {
            axial: s[0],
            shear_y: s[1],
            shear_z: s[2],
            twist: s[3],
            curvature_y: s[4],
            curvature_z: s[5],
        }
    }
}

impl From<SectionStrain> for [f64; 6] {
    /// The components (εx γy γz κx κy κz).
    fn from(s: SectionStrain) -> Self {
        [
            s.axial,
            s.shear_y,
            s.shear_z,
            s.twist,
            s.curvature_y,
            s.curvature_z,
        ]
    }
}

impl SectionStrain {
    /// Normal strain at the point (y, z) \[m\] of the section.
    pub fn normal(&self, y: f64, z: f64) -> f64 {
        self.axial + self.curvature_y * z - self.curvature_z * y
    }
}

/// Bending in one plane: deflection v and slope θ = dv/dx less shear, both positive along the
/// deflection. Rows and columns of the pairs below are (v, θ) at node 2.
struct Plane {
    length: f64,
    rigidity: f64,
    /// Shear flexibility ratio Φ = 12 EI / (G A_s L²).
    shear: f64,
}

impl Plane {
    /// (v per force, v per moment = θ per force, θ per moment), node 1 held.
    fn compliance(&self) -> [f64; 3] {
        let l = self.length;
        let c = l / self.rigidity;
        [c * l * l * (4.0 + self.shear) / 12.0, c * l / 2.0, c]
    }

    /// (force per v, force per θ = moment per v, moment per θ), node 1 held; and moment at
    /// node 1 per θ at node 2.
    fn stiffness(&self) -> [f64; 4] {
        let l = self.length;
        let k = self.rigidity / (l * (1.0 + self.shear));
        [
            12.0 * k / (l * l),
            -6.0 * k / l,
            (4.0 + self.shear) * k,
            (2.0 - self.shear) * k,
        ]
    }

    /// (v, θ) at `xi` for (v, θ) at node 2, node 1 held.
    fn shape(&self, xi: f64, v: f64, theta: f64) -> (f64, f64) {
        let (l, s) = (self.length, self.shear);
        let d = 1.0 + s;
        let v_of_v = xi * (s + xi * (3.0 - 2.0 * xi)) / d;
        let v_of_theta = l * xi * (xi - 1.0) * (xi + s / 2.0) / d;
        let theta_of_v = 6.0 * xi * (1.0 - xi) / (l * d);
        let theta_of_theta = xi * (3.0 * xi - 2.0 + s) / d;
        (
            v_of_v * v + v_of_theta * theta,
            theta_of_v * v + theta_of_theta * theta,
        )
    }
}

impl Beam {
    /// A beam of this material, section and length \[m\].
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for a length that is not finite and positive, or so short or
    /// long that a stiffness leaves the range of a double.
    pub fn new(material: &Material, section: &Section, length: f64) -> Result<Self, ElementError> {
        positive("length", length)?;
        let shear_compliance =
            |area: Option<f64>| area.map_or(0.0, |a| 1.0 / (material.shear() * a));
        let beam = Self {
            length,
            axial: material.young() * section.area(),
            torsional: material.shear() * section.torsion(),
            bending_y: material.young() * section.iy(),
            bending_z: material.young() * section.iz(),
            shear_compliance_y: shear_compliance(section.shear_y()),
            shear_compliance_z: shear_compliance(section.shear_z()),
        };
        beam.checked()
    }

    /// The same beam with another length \[m\].
    ///
    /// # Errors
    /// As [`Beam::new`].
    pub fn with_length(&self, length: f64) -> Result<Self, ElementError> {
        positive("length", length)?;
        Self { length, ..*self }.checked()
    }

    fn checked(self) -> Result<Self, ElementError> {
        let representable = |m: &Matrix6<f64>| {
            m.iter().all(|v| v.is_finite()) && m.diagonal().iter().all(|v| v.is_normal())
        };
        let right = representable(&self.cantilever_compliance())
            && representable(&self.cantilever_stiffness());
        let wanted = "a length [m] for which the stiffness stays within double precision";
        check(right, "length", self.length, wanted)?;
        Ok(self)
    }

    /// Length L \[m\].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The vector from node 1 to node 2 in the element frame \[m\].
    pub fn span(&self) -> Vector3<f64> {
        Vector3::new(self.length, 0.0, 0.0)
    }

    /// Axial rigidity EA \[N\].
    pub fn axial_rigidity(&self) -> f64 {
        self.axial
    }

    /// Torsional rigidity GJ \[N·m²\].
    pub fn torsional_rigidity(&self) -> f64 {
        self.torsional
    }

    /// Bending rigidity E·Iy \[N·m²\], of deflection along z.
    pub fn bending_rigidity_y(&self) -> f64 {
        self.bending_y
    }

    /// Bending rigidity E·Iz \[N·m²\], of deflection along y.
    pub fn bending_rigidity_z(&self) -> f64 {
        self.bending_z
    }

    /// Strain of a section per unit of section wrench, the inverse of D in Eq. 47: the diagonal
    /// (1/EA, 1/GA_y, 1/GA_z, 1/GJ, 1/EI_y, 1/EI_z), with zero for a shear area that is not given.
    pub fn section_compliance(&self) -> Vector6<f64> {
        Vector6::new(
            1.0 / self.axial,
            self.shear_compliance_y,
            self.shear_compliance_z,
            1.0 / self.torsional,
            1.0 / self.bending_y,
            1.0 / self.bending_z,
        )
    }

    /// Bending with deflection along y (rotation φz) and along z (rotation −φy).
    fn planes(&self) -> (Plane, Plane) {
        let plane = |rigidity: f64, shear_compliance: f64| Plane {
            length: self.length,
            rigidity,
            shear: 12.0 * rigidity * shear_compliance / (self.length * self.length),
        };
        (
            plane(self.bending_z, self.shear_compliance_y),
            plane(self.bending_y, self.shear_compliance_z),
        )
    }

    /// Compliance C_b at node 2 of the beam held at node 1, element frame: displacement of node 2
    /// per wrench on it. \[m/N\], \[rad/N\] = \[m/(N·m)\], \[rad/(N·m)\].
    pub fn cantilever_compliance(&self) -> Matrix6<f64> {
        let (in_y, in_z) = self.planes();
        node_matrix(
            self.length / self.axial,
            self.length / self.torsional,
            in_y.compliance(),
            in_z.compliance(),
        )
    }

    /// Stiffness at node 2 of the beam held at node 1, element frame: the inverse of
    /// [`cantilever_compliance`](Self::cantilever_compliance) in closed form.
    pub fn cantilever_stiffness(&self) -> Matrix6<f64> {
        let (in_y, in_z) = self.planes();
        let [yv, yc, yt, _] = in_y.stiffness();
        let [zv, zc, zt, _] = in_z.stiffness();
        node_matrix(
            self.axial / self.length,
            self.torsional / self.length,
            [yv, yc, yt],
            [zv, zc, zt],
        )
    }

    /// Stiffness of both nodes, element frame (Eq. 1 without joints): \[W1; W2\] = K \[u1; u2\].
    /// Positive semidefinite of rank 6; symmetric to the last bit.
    pub fn stiffness(&self) -> Matrix12 {
        let (in_y, in_z) = self.planes();
        let mut k = Matrix12::zeros();
        for (row, value) in [
            (0, self.axial / self.length),
            (3, self.torsional / self.length),
        ] {
            k[(row, row)] = value;
            k[(row + 6, row + 6)] = value;
            k[(row, row + 6)] = -value;
            k[(row + 6, row)] = -value;
        }
        // (deflection, rotation, sign of the rotation against the slope)
        for (plane, v, t, sign) in [(in_y, 1, 5, 1.0), (in_z, 2, 4, -1.0)] {
            let [force, coupling, near, far] = plane.stiffness();
            let coupling = coupling * sign;
            let entries = [
                (v, v, force),
                (v + 6, v + 6, force),
                (v, v + 6, -force),
                (v, t, -coupling),
                (v, t + 6, -coupling),
                (v + 6, t, coupling),
                (v + 6, t + 6, coupling),
                (t, t, near),
                (t + 6, t + 6, near),
                (t, t + 6, far),
            ];
            for (row, column, value) in entries {
                k[(row, column)] = value;
                k[(column, row)] = value;
            }
        }
        k
    }

    /// Displacement of node 2 relative to node 1's rigid motion, element frame:
    /// u2 − M u1. What strains the beam.
    pub fn deformation(&self, u1: &Vector6<f64>, u2: &Vector6<f64>) -> Vector6<f64> {
        u2 - transport(&self.span()) * u1
    }

    /// Displacement at `xi` (0 at node 1, 1 at node 2) along the beam for these displacements of
    /// its nodes, element frame: the exact elastic curve, shear deformation included.
    pub fn displacement(&self, xi: f64, u1: &Vector6<f64>, u2: &Vector6<f64>) -> Vector6<f64> {
        let bent = bent(&self.planes(), xi, &self.deformation(u1, u2));
        transport(&(self.span() * xi)) * u1 + bent
    }

    /// Wrenches on the beam at nodes 1 and 2 for these displacements of its nodes, element frame
    /// (Eq. 1). Formed from the deformation, so a rigid motion gives no more than its rounding.
    pub fn end_wrenches(&self, u1: &Vector6<f64>, u2: &Vector6<f64>) -> [Vector6<f64>; 2] {
        let second = self.cantilever_stiffness() * self.deformation(u1, u2);
        let first = -(transport(&self.span()).transpose() * second);
        [first, second]
    }

    /// Section wrench at `xi` from the wrench on the beam at node 2, element frame, by
    /// equilibrium: what the part towards node 2 exerts on the part towards node 1, about the
    /// centroid of the section (N Vy Vz T My Mz; N positive in tension).
    pub fn section_wrench(&self, xi: f64, end_wrench: &Vector6<f64>) -> Vector6<f64> {
        transport(&(self.span() * (1.0 - xi))).transpose() * end_wrench
    }

    /// Strains of the section at `xi` for these displacements of the nodes, element frame
    /// (Eq. 46). With D of Eq. 47 they give the [section wrench](Self::section_wrench); the
    /// shear forces of an Euler–Bernoulli beam come from equilibrium alone.
    pub fn strain(&self, xi: f64, u1: &Vector6<f64>, u2: &Vector6<f64>) -> SectionStrain {
        let [_, end] = self.end_wrenches(u1, u2);
        let wrench = self.section_wrench(xi, &end);
        SectionStrain::from(self.section_compliance().component_mul(&wrench))
    }
}

impl StraightBeam for Beam {
    fn length(&self) -> f64 {
        self.length
    }

    fn cantilever_stiffness(&self) -> Matrix6<f64> {
        self.cantilever_stiffness()
    }

    fn shape(&self, xi: f64) -> Matrix6<f64> {
        shape(&self.planes(), xi)
    }

    fn section_compliance_at(&self, _xi: f64) -> Vector6<f64> {
        self.section_compliance()
    }

    fn intervals(&self, end: f64, visit: &mut dyn FnMut(f64, f64)) {
        visit(0.0, end);
    }
}

/// Displacement at `xi` for the displacement `d` of node 2, node 1 held.
fn bent((in_y, in_z): &(Plane, Plane), xi: f64, d: &Vector6<f64>) -> Vector6<f64> {
    let (y, phi_z) = in_y.shape(xi, d[1], d[5]);
    let (z, minus_phi_y) = in_z.shape(xi, d[2], -d[4]);
    Vector6::new(xi * d[0], y, z, xi * d[3], -minus_phi_y, phi_z)
}

fn shape(planes: &(Plane, Plane), xi: f64) -> Matrix6<f64> {
    let columns = Matrix6::identity();
    Matrix6::from_columns(&[0, 1, 2, 3, 4, 5].map(|k| bent(planes, xi, &columns.column(k).into())))
}

/// Displacement at `xi` per displacement of node 2, node 1 held, of a prismatic beam of this
/// length \[m\] without shear deformation: cubic in bending, linear in tension and torsion.
pub(crate) fn cubic_shape(length: f64, xi: f64) -> Matrix6<f64> {
    let plane = || Plane {
        length,
        rigidity: 1.0,
        shear: 0.0,
    };
    shape(&(plane(), plane()), xi)
}

/// The 6×6 matrix of one node from its axial and torsional entry and the (vv, vθ, θθ) entries of
/// bending along y (θ = φz) and along z (θ = −φy).
pub(crate) fn node_matrix(
    axial: f64,
    torsional: f64,
    in_y: [f64; 3],
    in_z: [f64; 3],
) -> Matrix6<f64> {
    let mut m = Matrix6::zeros();
    m[(0, 0)] = axial;
    m[(3, 3)] = torsional;
    for ([vv, vt, tt], v, t, sign) in [(in_y, 1, 5, 1.0), (in_z, 2, 4, -1.0)] {
        m[(v, v)] = vv;
        m[(v, t)] = sign * vt;
        m[(t, v)] = sign * vt;
        m[(t, t)] = tt;
    }
    m
}
