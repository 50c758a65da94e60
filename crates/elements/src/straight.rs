//! What prismatic and tapered beams have in common, and what loads between the nodes do to them.
//!
//! With node 1 held and node 2 free the section wrenches of a load follow from statics alone, and
//! its strains C W + ε₀ integrate to exact displacements. Every other state of the beam is that
//! one and an unloaded beam together:
//!
//! * displacement: u(ξ) = unloaded curve through u₁ and u₂ − δ, plus the cantilever's;
//! * wrench on the beam at node 2: k (u₂ − M u₁ − δ), at node 1 by equilibrium;
//!
//! with δ the [free end's displacement](StraightBeam::free_end).

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::beam::SectionStrain;
use crate::frame::transport;
use crate::load::BeamLoad;
use crate::quadrature::gauss;

/// A straight beam, prismatic or tapered. Everything is in the element frame: x from node 1 to
/// node 2, y and z the sections' principal axes.
pub trait StraightBeam {
    /// Length L \[m\].
    fn length(&self) -> f64;

    /// Stiffness at node 2, node 1 held.
    fn cantilever_stiffness(&self) -> Matrix6<f64>;

    /// Displacement at `xi` (0 at node 1, 1 at node 2) per displacement of node 2, node 1 held.
    fn shape(&self, xi: f64) -> Matrix6<f64>;

    /// Strain of the section at `xi` per unit of section wrench: the diagonal
    /// (1/EA, 1/GA_y, 1/GA_z, 1/GJ, 1/EI_y, 1/EI_z), with zero for a shear area that is not given.
    fn section_compliance_at(&self, xi: f64) -> Vector6<f64>;

    /// Calls `visit` with intervals (first, last) that together make up 0 to `end` (at most 1);
    /// on each of them the section changes so little that a 16-point Gauss rule is exact to
    /// rounding.
    fn intervals(&self, end: f64, visit: &mut dyn FnMut(f64, f64));

    /// The vector from node 1 to node 2 \[m\].
    fn span(&self) -> Vector3<f64> {
        Vector3::new(self.length(), 0.0, 0.0)
    }

    /// Displacement of node 2 under the load, node 1 held and node 2 free: δ.
    ///
    /// It is linear in the load: for a load that only turns from pose to pose, such as the weight,
    /// three of them (of one load along each axis) serve all poses.
    fn free_end(&self, load: &BeamLoad) -> Vector6<f64> {
        self.free_displacement(1.0, load)
    }

    /// Displacement at `xi` under the load, node 1 held and node 2 free; exact, shear deformation
    /// included.
    fn free_displacement(&self, xi: f64, load: &BeamLoad) -> Vector6<f64> {
        let length = self.length();
        let wrenches = load.section_wrenches(length, &Vector6::zeros());
        let mut sum = Vector6::zeros();
        self.intervals(xi, &mut |first, last| {
            gauss(first, last, |place, weight| {
                let elastic = self
                    .section_compliance_at(place)
                    .component_mul(&wrenches.at(place));
                let arm = Vector3::new(length * (xi - place), 0.0, 0.0);
                sum += transport(&arm) * (elastic + load.strain()) * (length * weight);
            });
        });
        sum
    }

    /// Wrenches on the beam at nodes 1 and 2 where both are held under the load: the reactions,
    /// which together with the load are in equilibrium.
    fn fixed_end_wrenches(&self, load: &BeamLoad) -> [Vector6<f64>; 2] {
        self.loaded_end_wrenches(&Vector6::zeros(), &Vector6::zeros(), load)
    }

    /// Wrenches on the beam at nodes 1 and 2 for these displacements of its nodes under the load.
    fn loaded_end_wrenches(
        &self,
        u1: &Vector6<f64>,
        u2: &Vector6<f64>,
        load: &BeamLoad,
    ) -> [Vector6<f64>; 2] {
        let carry = transport(&self.span());
        let second = self.cantilever_stiffness() * (u2 - carry * u1 - self.free_end(load));
        let first = -(carry.transpose() * second) - load.resultant(self.length());
        [first, second]
    }

    /// Section wrench at `xi` under the load and `end_wrench`, the wrench on the beam at node 2:
    /// what the part towards node 2 exerts on the part towards node 1, about the centroid of the
    /// section (N Vy Vz T My Mz; N positive in tension).
    fn loaded_section_wrench(
        &self,
        xi: f64,
        end_wrench: &Vector6<f64>,
        load: &BeamLoad,
    ) -> Vector6<f64> {
        load.section_wrenches(self.length(), end_wrench).at(xi)
    }

    /// Displacement at `xi` for these displacements of the nodes under the load: the exact elastic
    /// curve, shear deformation included.
    fn loaded_displacement(
        &self,
        xi: f64,
        u1: &Vector6<f64>,
        u2: &Vector6<f64>,
        load: &BeamLoad,
    ) -> Vector6<f64> {
        let deformation = u2 - transport(&self.span()) * u1 - self.free_end(load);
        transport(&(self.span() * xi)) * u1
            + self.shape(xi) * deformation
            + self.free_displacement(xi, load)
    }

    /// Strains of the section at `xi` under the load and `end_wrench`, the wrench on the beam at
    /// node 2; free strains, such as those of temperature, included.
    fn loaded_strain(&self, xi: f64, end_wrench: &Vector6<f64>, load: &BeamLoad) -> SectionStrain {
        let wrench = self.loaded_section_wrench(xi, end_wrench, load);
        SectionStrain::from(self.section_compliance_at(xi).component_mul(&wrench) + load.strain())
    }

    /// Work of a virtual section wrench on the strains of the beam under the load and
    /// `end_wrench`, ∫ W̄ᵀ (C W + ε₀) dx, apart for tension, shear along y and z, torsion, and
    /// bending about y and z \[J\]. `virtual_wrench` is the wrench on the beam at node 2 in a state
    /// without load between the nodes.
    ///
    /// Where that state is the one of a unit load, the sum over all bodies and joints is the
    /// displacement along that load (principle of virtual work), and these are the beam's shares.
    fn virtual_work(
        &self,
        end_wrench: &Vector6<f64>,
        load: &BeamLoad,
        virtual_wrench: &Vector6<f64>,
    ) -> Vector6<f64> {
        let elastic =
            self.elastic_work(end_wrench, load, virtual_wrench, &|_| Vector6::repeat(1.0));
        elastic + self.free_work(load, virtual_wrench)
    }

    /// The same work on the strains that no force makes alone, ∫ W̄ᵀ ε₀ dx by parts.
    fn free_work(&self, load: &BeamLoad, virtual_wrench: &Vector6<f64>) -> Vector6<f64> {
        if *load.strain() == Vector6::zeros() {
            return Vector6::zeros();
        }
        // A free strain is the same all along; the virtual section wrench is linear.
        let virtual_wrenches = BeamLoad::none().section_wrenches(self.length(), virtual_wrench);
        let mean = virtual_wrenches.at(0.5) * self.length();
        mean.component_mul(load.strain())
    }

    /// The same work on the elastic strains alone, each of its six parts with a weight along the
    /// beam: ∫ g(ξ) W̄ᵀ C W dx by parts.
    ///
    /// With g = −∂ ln r/∂p, r the rigidities (EA, GA_y, GA_z, GJ, EI_y, EI_z), their sum is the
    /// beam's part of the derivative by p of the displacement along the virtual load.
    fn elastic_work(
        &self,
        end_wrench: &Vector6<f64>,
        load: &BeamLoad,
        virtual_wrench: &Vector6<f64>,
        weight: &dyn Fn(f64) -> Vector6<f64>,
    ) -> Vector6<f64> {
        let length = self.length();
        let wrenches = load.section_wrenches(length, end_wrench);
        let virtual_wrenches = BeamLoad::none().section_wrenches(length, virtual_wrench);
        let mut sum = Vector6::zeros();
        self.intervals(1.0, &mut |first, last| {
            gauss(first, last, |xi, share| {
                let compliance = self.section_compliance_at(xi).component_mul(&weight(xi));
                let strain = compliance.component_mul(&wrenches.at(xi));
                sum += virtual_wrenches.at(xi).component_mul(&strain) * (length * share);
            });
        });
        sum
    }

    /// Derivative by p of the displacement at `xi` per wrench on node 2, node 1 held, where the
    /// rigidities change along the beam by ∂ ln (EA, GA_y, GA_z, GJ, EI_y, EI_z)/∂p: of
    /// [`shape`](Self::shape) times the cantilever's compliance.
    fn give_derivative(&self, xi: f64, rigidities: &dyn Fn(f64) -> Vector6<f64>) -> Matrix6<f64> {
        let length = self.length();
        let mut sum = Matrix6::zeros();
        self.intervals(xi, &mut |first, last| {
            gauss(first, last, |place, weight| {
                let arm = |to: f64| transport(&Vector3::new(length * (to - place), 0.0, 0.0));
                let compliance = self.section_compliance_at(place);
                let change = -compliance.component_mul(&rigidities(place)) * (length * weight);
                sum += arm(xi) * Matrix6::from_diagonal(&change) * arm(1.0).transpose();
            });
        });
        sum
    }
}
