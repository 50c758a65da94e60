//! What a vibrating beam does along it, for how its energies change with its sections.
//!
//! A mode of the beam itself makes its Rayleigh quotient stationary among all motions, so that only
//! the energies of the motion as it is change with a parameter p:
//! ∂ω² = ∫ Wᵀ (c ∂ ln r/∂p) W dx − ω² ∫ uᵀ ∂m/∂p u dx for unit modal mass.

use nalgebra::{Matrix6, Vector6};

use crate::frame::transport;
use crate::inner::InnerShapes;
use crate::mass::{Along, LineMass, MassShape, RotaryInertia};
use crate::straight::StraightBeam;

/// A motion of a beam at the places that integrals along it are taken at.
#[derive(Debug, Clone)]
pub struct Vibration {
    places: Vec<Place>,
}

#[derive(Debug, Clone)]
struct Place {
    xi: f64,
    /// Its share in the integral over the length (m).
    share: f64,
    wrench: Vector6<f64>,
    moved: Vector6<f64>,
    /// The section's compliances, and its area and moments (A, A, A, Iy, Iz) as they have mass.
    give: Vector6<f64>,
    area: f64,
    turning: [f64; 3],
}

impl Vibration {
    /// Of the displacements `ends` of both nodes and these `amounts` of its inner shapes, element frame.
    pub fn new(
        line: &LineMass,
        beam: &(impl StraightBeam + ?Sized),
        rotary: RotaryInertia,
        inner: &InnerShapes,
        ends: &[Vector6<f64>; 2],
        amounts: &[f64],
    ) -> Self {
        let [first, second] = ends;
        let whole: Matrix6<f64> = transport(&beam.span());
        let end = beam.cantilever_stiffness() * (second - whole * first);
        let mut places = Vec::new();
        line.each_place(beam, MassShape::Exact, rotary, |xi, share, n| {
            let moved = n.fixed_view::<6, 6>(0, 0) * first + n.fixed_view::<6, 6>(0, 6) * second;
            let arm = transport(&(beam.span() * (1.0 - xi))).transpose();
            let section = line.section_at(xi);
            let bent = match rotary {
                RotaryInertia::Included => 1.0,
                RotaryInertia::Left => 0.0,
            };
            places.push(Place {
                xi,
                share,
                wrench: arm * end + inner.section_wrench(beam, xi, amounts),
                moved: moved + inner.displacement(beam, xi, amounts),
                give: beam.section_compliance_at(xi),
                area: section.area(),
                turning: [section.iy(), section.iz(), bent],
            });
        });
        Self { places }
    }

    /// ∫ Wᵀ (c ∂ ln r/∂p) W dx with another motion of the same beam, whose rigidities change by
    /// `rigidities`.
    pub fn elastic_work(&self, other: &Self, rigidities: Along<'_>) -> f64 {
        let both = self.places.iter().zip(&other.places);
        both.map(|(own, other)| {
            let strain = own.give.component_mul(&rigidities(own.xi));
            own.share * own.wrench.dot(&strain.component_mul(&other.wrench))
        })
        .sum()
    }

    /// ∫ uᵀ ∂m/∂p u dx with another motion of the same beam at density 1, whose sections change by
    /// `sections`; with all ones the mass itself.
    pub fn mass_work(&self, other: &Self, sections: Along<'_>) -> f64 {
        let both = self.places.iter().zip(&other.places);
        both.map(|(own, other)| {
            let change = sections(own.xi);
            let area = own.area * change[0];
            let [iy, iz, bent] = own.turning;
            let (iy, iz) = (iy * change[4], iz * change[5]);
            let mass = Vector6::new(area, area, area, iy + iz, bent * iy, bent * iz);
            own.share * own.moved.dot(&mass.component_mul(&other.moved))
        })
        .sum()
    }
}
