//! Straight beams whose section changes along them: exact flexibility by integration.
//!
//! With no load between its nodes a beam's section wrenches are known from the wrench at node 2
//! alone, so its flexibility is an integral of the sections' compliances along it, exact for any
//! change of section. Each plane of bending is kept by its *elastic centre*, where a force across
//! the beam and a moment do not act on each other's displacement: that way neither the
//! flexibility nor its inverse cancels.

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::beam::{SectionStrain, node_matrix};
use crate::error::{ElementError, check, positive};
use crate::frame::transport;
use crate::material::Material;
use crate::quadrature::gauss;
use crate::straight::StraightBeam;
use crate::taper::Taper;

/// A straight beam whose section changes along it, with no load between its nodes.
///
/// Everything is in the element frame, as for a [`Beam`](crate::Beam): x from node 1 to node 2 through the
/// centroids of the sections, y and z their principal axes.
#[derive(Debug, Clone, PartialEq)]
pub struct TaperedBeam {
    material: Material,
    taper: Taper,
    length: f64,
    whole: Flexibility,
}

/// Flexibility of the part of a beam from node 1 to some place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Flexibility {
    /// ∫ dx/EA \[m/N\].
    axial: f64,
    /// ∫ dx/GJ \[rad/(N·m)\].
    torsional: f64,
    /// Bending with deflection along y and along z.
    planes: [PlaneFlexibility; 2],
}

/// Flexibility of a beam in one plane of bending, about its elastic centre, where a force across
/// the beam and a moment do not act on each other's displacement.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaneFlexibility {
    /// ∫ dx/EI \[rad/(N·m)\]; proportional to the beam's length.
    pub turn: f64,
    /// Distance c of the elastic centre from node 1, ∫ x dx/EI over ∫ dx/EI \[m\]; proportional
    /// to the length.
    pub centre: f64,
    /// ∫ (x − c)² dx/EI \[m/N\]: deflection by bending per force at the elastic centre;
    /// proportional to the cube of the length.
    pub bending: f64,
    /// ∫ dx/GA_s \[m/N\]: deflection by shear; proportional to the length.
    pub shear: f64,
}

impl PlaneFlexibility {
    /// Deflection per force at the elastic centre \[m/N\].
    fn deflection(&self) -> f64 {
        self.bending + self.shear
    }

    /// Both together, for parts of one beam that follow each other.
    fn joined(self, next: Self) -> Self {
        let turn = self.turn + next.turn;
        if turn == 0.0 {
            return self;
        }
        let share = next.turn / turn;
        let apart = next.centre - self.centre;
        Self {
            turn,
            centre: self.centre + share * apart,
            bending: self.bending + next.bending + self.turn * share * apart * apart,
            shear: self.shear + next.shear,
        }
    }

    /// Entries (v, v), (v, θ) and (θ, θ) of the compliance at a place `arm` beyond the centre.
    fn compliance(&self, arm: f64) -> [f64; 3] {
        let turned = self.turn * arm;
        [self.deflection() + turned * arm, turned, self.turn]
    }

    /// Entries (v, v), (v, θ) and (θ, θ) of the inverse of [`PlaneFlexibility::compliance`].
    fn stiffness(&self, arm: f64) -> [f64; 3] {
        let force = 1.0 / self.deflection();
        [force, -force * arm, 1.0 / self.turn + force * arm * arm]
    }
}

impl TaperedBeam {
    /// A beam of this material, change of section and length \[m\].
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for a length that is not finite and positive, or so short or
    /// long that a stiffness leaves the range of a double.
    pub fn new(material: &Material, taper: &Taper, length: f64) -> Result<Self, ElementError> {
        positive("length", length)?;
        let mut beam = Self {
            material: material.clone(),
            taper: taper.clone(),
            length,
            whole: Flexibility::default(),
        };
        beam.whole = beam.flexibility(1.0);
        let representable = |m: &Matrix6<f64>| {
            m.iter().all(|v| v.is_finite()) && m.diagonal().iter().all(|v| v.is_normal())
        };
        let right = representable(&beam.cantilever_compliance())
            && representable(&beam.cantilever_stiffness());
        let wanted = "a length [m] for which the stiffness stays within double precision";
        check(right, "length", length, wanted)?;
        Ok(beam)
    }

    /// The same beam from node 2 to node 1, in the element frame turned by π about z: the change
    /// of section runs the other way.
    pub fn reversed(&self) -> Self {
        let mut whole = self.whole;
        for plane in &mut whole.planes {
            plane.centre = self.length - plane.centre;
        }
        Self {
            material: self.material.clone(),
            taper: self.taper.reversed(),
            length: self.length,
            whole,
        }
    }

    /// Length L \[m\].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The change of section.
    pub fn taper(&self) -> &Taper {
        &self.taper
    }

    /// Extension per axial force, ∫ dx/EA \[m/N\], and twist per torque, ∫ dx/GJ \[rad/(N·m)\].
    pub fn axial_and_torsional_flexibility(&self) -> [f64; 2] {
        [self.whole.axial, self.whole.torsional]
    }

    /// Flexibility in bending with deflection along y and along z.
    pub fn plane_flexibilities(&self) -> [PlaneFlexibility; 2] {
        self.whole.planes
    }

    /// The vector from node 1 to node 2 in the element frame \[m\].
    pub fn span(&self) -> Vector3<f64> {
        Vector3::new(self.length, 0.0, 0.0)
    }

    /// Compliance C_b at node 2 of the beam held at node 1, element frame: displacement of node 2
    /// per wrench on it. \[m/N\], \[rad/N\] = \[m/(N·m)\], \[rad/(N·m)\].
    pub fn cantilever_compliance(&self) -> Matrix6<f64> {
        let [in_y, in_z] = self.whole.planes;
        let entries = |plane: PlaneFlexibility| plane.compliance(self.length - plane.centre);
        node_matrix(
            self.whole.axial,
            self.whole.torsional,
            entries(in_y),
            entries(in_z),
        )
    }

    /// Stiffness at node 2 of the beam held at node 1, element frame: the inverse of
    /// [`cantilever_compliance`](Self::cantilever_compliance).
    pub fn cantilever_stiffness(&self) -> Matrix6<f64> {
        let [in_y, in_z] = self.whole.planes;
        let entries = |plane: PlaneFlexibility| plane.stiffness(self.length - plane.centre);
        node_matrix(
            1.0 / self.whole.axial,
            1.0 / self.whole.torsional,
            entries(in_y),
            entries(in_z),
        )
    }

    /// Displacement of node 2 relative to node 1's rigid motion, element frame: u2 − M u1.
    pub fn deformation(&self, u1: &Vector6<f64>, u2: &Vector6<f64>) -> Vector6<f64> {
        u2 - transport(&self.span()) * u1
    }

    /// Displacement at `xi` (0 at node 1, 1 at node 2) along the beam for these displacements of
    /// its nodes, element frame: the exact elastic curve, shear deformation included.
    pub fn displacement(&self, xi: f64, u1: &Vector6<f64>, u2: &Vector6<f64>) -> Vector6<f64> {
        let bent = self.bent(&self.flexibility(xi), xi, &self.deformation(u1, u2));
        transport(&(self.span() * xi)) * u1 + bent
    }

    /// Displacement at `xi` for the displacement `d` of node 2, node 1 held; `part` is the
    /// flexibility up to `xi`.
    fn bent(&self, part: &Flexibility, xi: f64, d: &Vector6<f64>) -> Vector6<f64> {
        let bend = |plane: usize, v: f64, theta: f64| {
            let (whole, part) = (self.whole.planes[plane], part.planes[plane]);
            let force = (v - (self.length - whole.centre) * theta) / whole.deflection();
            // Bending moment at the part's elastic centre.
            let moment = theta / whole.turn + force * (whole.centre - part.centre);
            let turned = part.turn * moment;
            let arm = xi * self.length - part.centre;
            (arm * turned + part.deflection() * force, turned)
        };
        let (y, phi_z) = bend(0, d[1], d[5]);
        let (z, minus_phi_y) = bend(1, d[2], -d[4]);
        let axial = d[0] * part.axial / self.whole.axial;
        let twist = d[3] * part.torsional / self.whole.torsional;
        Vector6::new(axial, y, z, twist, -minus_phi_y, phi_z)
    }

    /// Wrenches on the beam at nodes 1 and 2 for these displacements of its nodes, element frame.
    pub fn end_wrenches(&self, u1: &Vector6<f64>, u2: &Vector6<f64>) -> [Vector6<f64>; 2] {
        let second = self.cantilever_stiffness() * self.deformation(u1, u2);
        let first = -(transport(&self.span()).transpose() * second);
        [first, second]
    }

    /// Section wrench at `xi` from the wrench on the beam at node 2, element frame, by
    /// equilibrium, as [`Beam::section_wrench`](crate::Beam::section_wrench).
    pub fn section_wrench(&self, xi: f64, end_wrench: &Vector6<f64>) -> Vector6<f64> {
        transport(&(self.span() * (1.0 - xi))).transpose() * end_wrench
    }

    /// Strains of the section at `xi` for these displacements of the nodes, element frame
    /// (Eq. 46).
    pub fn strain(&self, xi: f64, u1: &Vector6<f64>, u2: &Vector6<f64>) -> SectionStrain {
        let [_, end] = self.end_wrenches(u1, u2);
        let wrench = self.section_wrench(xi, &end);
        SectionStrain::from(self.section_compliance_at(xi).component_mul(&wrench))
    }

    /// Flexibility of the part from node 1 to `end` (0 to 1).
    fn flexibility(&self, end: f64) -> Flexibility {
        let mut sum = Flexibility::default();
        self.taper.intervals(end, |first, last| {
            let part = self.interval(first, last);
            sum.axial += part.axial;
            sum.torsional += part.torsional;
            for (sum, part) in sum.planes.iter_mut().zip(part.planes) {
                *sum = sum.joined(part);
            }
        });
        sum
    }

    /// Flexibility of one interval of the taper, by Gauss's rule.
    fn interval(&self, first: f64, last: f64) -> Flexibility {
        let (young, shear) = (self.material.young(), self.material.shear());
        let mut out = Flexibility::default();
        gauss(first, last, |xi, weight| {
            let section = self.taper.at(xi);
            let dx = weight * self.length;
            out.axial += dx / (young * section.area());
            out.torsional += dx / (shear * section.torsion());
            let planes = [
                (section.iz(), section.shear_y()),
                (section.iy(), section.shear_z()),
            ];
            for (plane, (inertia, shear_area)) in out.planes.iter_mut().zip(planes) {
                let slice = PlaneFlexibility {
                    turn: dx / (young * inertia),
                    centre: xi * self.length,
                    bending: 0.0,
                    shear: shear_area.map_or(0.0, |area| dx / (shear * area)),
                };
                *plane = plane.joined(slice);
            }
        });
        out
    }
}

impl StraightBeam for TaperedBeam {
    fn length(&self) -> f64 {
        self.length
    }

    fn cantilever_stiffness(&self) -> Matrix6<f64> {
        self.cantilever_stiffness()
    }

    fn shape(&self, xi: f64) -> Matrix6<f64> {
        let part = self.flexibility(xi);
        let units = Matrix6::identity();
        let column = |k: usize| self.bent(&part, xi, &units.column(k).into());
        Matrix6::from_columns(&[0, 1, 2, 3, 4, 5].map(column))
    }

    fn section_compliance_at(&self, xi: f64) -> Vector6<f64> {
        let section = self.taper.at(xi);
        let (young, shear) = (self.material.young(), self.material.shear());
        let sheared = |area: Option<f64>| area.map_or(0.0, |a| 1.0 / (shear * a));
        Vector6::new(
            1.0 / (young * section.area()),
            sheared(section.shear_y()),
            sheared(section.shear_z()),
            1.0 / (shear * section.torsion()),
            1.0 / (young * section.iy()),
            1.0 / (young * section.iz()),
        )
    }

    fn intervals(&self, end: f64, visit: &mut dyn FnMut(f64, f64)) {
        self.taper.intervals(end, visit);
    }
}
