//! Mass of beams: consistent and lumped mass matrices.
//!
//! A consistent mass matrix is M = ∫ Nᵀ m N dx (Archer 1963; Przemieniecki, *Theory of Matrix
//! Structural Analysis*, 1968, §11), with N(ξ) the displacement per displacement of the nodes and
//! m the mass per length diag(ρA, ρA, ρA, ρ(Iy + Iz), ρIy, ρIz). The integral is taken by Gauss's
//! rule, exact for prismatic beams and to some 1e-13 of its diagonal for tapered ones.
//!
//! Derivatives by a parameter p of the sections take ∂ ln (A, A_y, A_z, J, I_y, I_z)/∂p along the
//! beam, as [`Section::logarithmic_derivative`] has it. Mass and weight are proportional to the
//! density: their derivatives by it are those of a beam of density 1.

use nalgebra::{Matrix6, SMatrix, Vector3, Vector6};

use crate::beam::cubic_shape;
use crate::error::{ElementError, check};
use crate::frame::{Matrix12, transport};
use crate::load::BeamLoad;
use crate::quadrature::gauss;
use crate::section::Section;
use crate::straight::StraightBeam;
use crate::taper::{Taper, controls};

/// A change of a beam's sections or rigidities along it, by ξ from 0 at node 1 to 1 at node 2.
pub type Along<'a> = &'a dyn Fn(f64) -> Vector6<f64>;

/// The displacements between the nodes that a consistent mass matrix is made with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MassShape {
    /// Cubic in bending, linear in tension and torsion, without shear deformation and whatever the
    /// change of section: as frame3dd and OpenSees have it. Where there are shear areas, a section
    /// does not turn with the slope of that curve: [rotary inertia](RotaryInertia) then goes with
    /// how the beam's own sections turn, as in [`Exact`](Self::Exact).
    Cubic,
    /// Those of the beam itself under loads at its nodes, with shear deformation and the change of
    /// section. For a prismatic beam without shear areas the same as [`Cubic`](Self::Cubic).
    Exact,
}

/// Whether turning sections have inertia of their own in bending. Torsion always has ρ(Iy + Iz).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotaryInertia {
    /// Rayleigh's ρIy and ρIz count.
    Included,
    /// Bending moves only the mass of the centre line.
    Left,
}

/// The mass of a straight beam along its length: its density and the sections along it.
#[derive(Debug, Clone, PartialEq)]
pub struct LineMass {
    density: f64,
    taper: Taper,
}

impl LineMass {
    /// The mass of a beam of this density \[kg/m³\] and change of section;
    /// [`Taper::constant`] for a prismatic one.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for a density that is negative or not finite.
    pub fn new(density: f64, taper: Taper) -> Result<Self, ElementError> {
        let right = density.is_finite() && density >= 0.0;
        check(right, "density", density, "a finite number, zero or more")?;
        Ok(Self { density, taper })
    }

    /// Mass of a beam of this length \[m\], in kg; exact for every change of section.
    pub fn total(&self, length: f64) -> f64 {
        self.total_of(length, self.taper.area_controls())
    }

    fn total_of(&self, length: f64, [first, middle, last]: [f64; 3]) -> f64 {
        self.density * length * (first + middle + last) / 3.0
    }

    /// Mass per length \[kg/m\], which is quadratic along the beam, by its Bernstein coefficients as
    /// [`BeamLoad::quadratic`] takes them.
    pub fn distribution(&self) -> [f64; 3] {
        self.taper.area_controls().map(|area| self.density * area)
    }

    /// The part from `first` to `last` (0 to 1).
    pub fn part(&self, first: f64, last: f64) -> Self {
        Self {
            density: self.density,
            taper: self.taper.part(first, last),
        }
    }

    /// The weight of the beam as a load on it, density × area × `acceleration` (of gravity,
    /// element frame, m/s²); it follows the area exactly, however the section changes.
    pub fn weight(&self, acceleration: &Vector3<f64>) -> BeamLoad {
        self.weight_of(acceleration, self.taper.area_controls())
    }

    fn weight_of(&self, acceleration: &Vector3<f64>, areas: [f64; 3]) -> BeamLoad {
        let [x, y, z] = (acceleration * self.density).into();
        let per_area = Vector6::new(x, y, z, 0.0, 0.0, 0.0);
        BeamLoad::quadratic(areas.map(|area| per_area * area))
    }

    /// Derivative of the [`weight`](Self::weight) by p where the sections change by `sections`;
    /// as exact as that: the area's derivative is quadratic along the beam too.
    pub fn weight_derivative(&self, acceleration: &Vector3<f64>, sections: Along<'_>) -> BeamLoad {
        self.weight_of(acceleration, self.area_derivative(sections))
    }

    /// ∂A/∂p along the beam, as [`Taper::area_controls`].
    fn area_derivative(&self, sections: Along<'_>) -> [f64; 3] {
        controls([0.0, 0.5, 1.0].map(|xi| self.taper.at(xi).area() * sections(xi)[0]))
    }

    /// Half of the mass of a beam of this length \[m\] at each of its nodes, in translation only:
    /// the diagonal of its lumped 12×12 mass matrix. Turning a node then has no inertia.
    pub fn lumped(&self, length: f64) -> Matrix12 {
        halves(self.total(length))
    }

    /// Derivative of [`lumped`](Self::lumped) by p where the sections change by `sections`.
    pub fn lumped_derivative(&self, length: f64, sections: Along<'_>) -> Matrix12 {
        halves(self.total_of(length, self.area_derivative(sections)))
    }

    /// Consistent mass matrix of `beam`, whose sections these are, over its nodes 1 and 2, element
    /// frame \[kg, kg·m, kg·m²\]; symmetric to the last bit, positive semidefinite.
    ///
    /// Whatever the options, motions of the whole beam have its exact mass and centre of mass. For
    /// tapered beams the integrals are right to about 1e-13 of √(M_ii M_jj).
    pub fn consistent(
        &self,
        beam: &(impl StraightBeam + ?Sized),
        shape: MassShape,
        rotary: RotaryInertia,
    ) -> Matrix12 {
        let mut sum = Matrix12::zeros();
        self.each_place(beam, shape, rotary, |xi, weight, n| {
            let mass = self.per_length(&self.taper.at(xi), rotary) * weight;
            sum += n.transpose() * Matrix6::from_diagonal(&mass) * n;
        });
        (sum + sum.transpose()) * 0.5
    }

    /// Derivative of [`consistent`](Self::consistent) by p where the sections change by `sections`,
    /// and the rigidities of the beam, ∂ ln (EA, GA_y, GA_z, GJ, EI_y, EI_z)/∂p, by `rigidities`:
    /// the beam's own shapes change with these. As right as the mass itself.
    pub fn consistent_derivative(
        &self,
        beam: &(impl StraightBeam + ?Sized),
        shape: MassShape,
        rotary: RotaryInertia,
        sections: Along<'_>,
        rigidities: Along<'_>,
    ) -> Matrix12 {
        let whole = transport(&beam.span());
        let end = beam.give_derivative(1.0, rigidities);
        let stiffness = beam.cantilever_stiffness();
        let mut sum = Matrix12::zeros();
        self.each_place(beam, shape, rotary, |xi, weight, n| {
            let section = self.taper.at(xi);
            let change = self.change_per_length(&section, rotary, &sections(xi)) * weight;
            sum += n.transpose() * Matrix6::from_diagonal(&change) * n;
            let own = own_rows(beam, shape, rotary, xi);
            if own.contains(&true) {
                // The shape is S(ξ) S(1)⁻¹, with S the displacement per wrench on node 2.
                let part = beam.give_derivative(xi, rigidities);
                let mut second = (part - beam.shape(xi) * end) * stiffness;
                for (row, _) in own.iter().enumerate().filter(|(_, own)| !**own) {
                    second.row_mut(row).fill(0.0);
                }
                let mass = self.per_length(&section, rotary) * weight;
                let moved = Matrix6::from_diagonal(&mass) * n;
                let product = over_nodes(&(-second * whole), &second).transpose() * moved;
                sum += product + product.transpose();
            }
        });
        (sum + sum.transpose()) * 0.5
    }

    /// Calls `visit` with the places along the beam that integrals are taken at, their weights
    /// \[m\], and the displacement there per displacement of the nodes.
    pub(crate) fn each_place(
        &self,
        beam: &(impl StraightBeam + ?Sized),
        shape: MassShape,
        rotary: RotaryInertia,
        mut visit: impl FnMut(f64, f64, &SMatrix<f64, 6, 12>),
    ) {
        let length = beam.length();
        let whole = transport(&beam.span());
        self.taper.intervals(1.0, |first, last| {
            gauss(first, last, |xi, weight| {
                let mut second = cubic_shape(length, xi);
                let own = own_rows(beam, shape, rotary, xi);
                if own.contains(&true) {
                    let of_beam = beam.shape(xi);
                    for (row, _) in own.iter().enumerate().filter(|(_, own)| **own) {
                        second.set_row(row, &of_beam.row(row));
                    }
                }
                let first = transport(&(beam.span() * xi)) - second * whole;
                visit(xi, weight * length, &over_nodes(&first, &second));
            });
        });
    }

    /// The section at `xi` along the beam.
    pub(crate) fn section_at(&self, xi: f64) -> Section {
        self.taper.at(xi)
    }

    /// Mass and moments of inertia per length at `xi` along the beam.
    pub(crate) fn per_length_at(&self, xi: f64, rotary: RotaryInertia) -> Vector6<f64> {
        self.per_length(&self.taper.at(xi), rotary)
    }

    /// Mass and moments of inertia per length of a section.
    fn per_length(&self, section: &Section, rotary: RotaryInertia) -> Vector6<f64> {
        self.change_per_length(section, rotary, &Vector6::repeat(1.0))
    }

    /// Their derivatives where the section's properties change by `change`.
    fn change_per_length(
        &self,
        section: &Section,
        rotary: RotaryInertia,
        change: &Vector6<f64>,
    ) -> Vector6<f64> {
        let area = section.area() * change[0];
        let (iy, iz) = (section.iy() * change[4], section.iz() * change[5]);
        let turning = match rotary {
            RotaryInertia::Included => 1.0,
            RotaryInertia::Left => 0.0,
        };
        Vector6::new(area, area, area, iy + iz, turning * iy, turning * iz) * self.density
    }
}

/// Which components (x y z φx φy φz) of the displacement between the nodes are the beam's own, of
/// those that have mass.
fn own_rows(
    beam: &(impl StraightBeam + ?Sized),
    shape: MassShape,
    rotary: RotaryInertia,
    xi: f64,
) -> [bool; 6] {
    match (shape, rotary) {
        (MassShape::Exact, _) => [true; 6],
        (MassShape::Cubic, RotaryInertia::Left) => [false; 6],
        (MassShape::Cubic, RotaryInertia::Included) => {
            // Sections turn about z where the beam deflects along y.
            let give = beam.section_compliance_at(xi);
            [false, false, false, false, give[2] > 0.0, give[1] > 0.0]
        }
    }
}

/// Half of a mass at each node, in translation only.
fn halves(mass: f64) -> Matrix12 {
    let part = |row: usize| if row % 6 < 3 { mass / 2.0 } else { 0.0 };
    Matrix12::from_diagonal(&SMatrix::<f64, 12, 1>::from_fn(|row, _| part(row)))
}

/// Displacement per displacement of both nodes.
fn over_nodes(first: &Matrix6<f64>, second: &Matrix6<f64>) -> SMatrix<f64, 6, 12> {
    let mut n = SMatrix::<f64, 6, 12>::zeros();
    n.fixed_view_mut::<6, 6>(0, 0).copy_from(first);
    n.fixed_view_mut::<6, 6>(0, 6).copy_from(second);
    n
}
