//! What a load of one direction does to the free end of a beam, by powers of its length.

use nalgebra::Vector6;

use crate::load::BeamLoad;
use crate::straight::StraightBeam;

/// What a load that keeps its direction along a beam does to it, held at node 1 and free at node 2:
/// of a force per length f and a moment per length m, both times a distribution over the length.
///
/// The values are those of a beam of unit length with the same sections at the same places; they
/// come back at length L with the powers of L named below. Directions are those of the element frame.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LoadFlexibility {
    /// The distribution's integral: the resultant is f and m times it, times L.
    pub total: f64,
    /// Its first moment about node 1: the force's moment about there is x × f times it, times L².
    pub first_moment: f64,
    /// Displacement along the beam per force along it, times L².
    pub axial: f64,
    /// Rotation about the beam per moment about it, times L².
    pub torsional: f64,
    /// Bending with deflection along y, then along z.
    pub planes: [PlaneLoadFlexibility; 2],
}

/// The same in one of the planes of bending, with the moment and the rotation that turn the
/// deflection's axis x towards its own direction counted positive.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PlaneLoadFlexibility {
    /// Deflection by bending per force, times L⁴.
    pub bending: f64,
    /// Deflection by shear per force, times L².
    pub shear: f64,
    /// Rotation per force, and deflection per moment the other way round, times L³ each.
    pub turn: f64,
    /// Deflection per moment, times L³.
    pub by_moment: f64,
    /// Rotation per moment, times L².
    pub turn_by_moment: f64,
}

impl LoadFlexibility {
    /// Of a beam of unit length, for a distribution with these Bernstein coefficients, as
    /// [`BeamLoad::quadratic`] takes them.
    pub fn of(beam: &dyn StraightBeam, distribution: [f64; 3]) -> Self {
        let give = |part: usize, direction: usize| {
            let mut unit = Vector6::zeros();
            unit[direction] = 1.0;
            let mut kept = Vector6::zeros();
            kept[part] = 1.0;
            let load = BeamLoad::quadratic(distribution.map(|share| unit * share));
            Part { beam, kept }.free_end(&load)
        };
        let [a, b, c] = distribution;
        let plane = |shear: usize, bending: usize, turning: usize, sign: f64| {
            let by_force = give(bending, shear);
            let by_moment = give(bending, turning);
            PlaneLoadFlexibility {
                bending: by_force[shear],
                shear: give(shear, shear)[shear],
                turn: sign * by_force[turning],
                by_moment: sign * by_moment[shear],
                turn_by_moment: by_moment[turning],
            }
        };
        Self {
            total: (a + b + c) / 3.0,
            first_moment: a / 12.0 + b / 6.0 + c / 4.0,
            axial: give(0, 0)[0],
            torsional: give(3, 3)[3],
            planes: [plane(1, 5, 5, 1.0), plane(2, 4, 4, -1.0)],
        }
    }
}

/// A beam of which only some strains give way.
struct Part<'a> {
    beam: &'a dyn StraightBeam,
    kept: Vector6<f64>,
}

impl StraightBeam for Part<'_> {
    fn length(&self) -> f64 {
        self.beam.length()
    }

    fn cantilever_stiffness(&self) -> nalgebra::Matrix6<f64> {
        self.beam.cantilever_stiffness()
    }

    fn shape(&self, xi: f64) -> nalgebra::Matrix6<f64> {
        self.beam.shape(xi)
    }

    fn section_compliance_at(&self, xi: f64) -> Vector6<f64> {
        self.beam
            .section_compliance_at(xi)
            .component_mul(&self.kept)
    }

    fn intervals(&self, end: f64, visit: &mut dyn FnMut(f64, f64)) {
        self.beam.intervals(end, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Beam, Elasticity, Material, Section, SectionShape, Taper, TaperedBeam};
    use nalgebra::Vector3;

    fn section(width: f64, height: f64) -> Section {
        let shape = SectionShape::Rectangle { width, height };
        let shear = Some(width * height * 5.0 / 6.0);
        Section::new(shape, shear, shear).expect("a section")
    }

    /// The free end's displacement under a force and a moment per length, put together.
    fn put_together(
        flex: &LoadFlexibility,
        l: f64,
        f: &Vector3<f64>,
        m: &Vector3<f64>,
    ) -> Vector6<f64> {
        let [y, z] = &flex.planes;
        let deflection = |p: &PlaneLoadFlexibility, f: f64, m: f64| {
            (p.bending * l.powi(4) + p.shear * l * l) * f + p.by_moment * l.powi(3) * m
        };
        let turn = |p: &PlaneLoadFlexibility, f: f64, m: f64| {
            p.turn * l.powi(3) * f + p.turn_by_moment * l * l * m
        };
        Vector6::new(
            flex.axial * l * l * f.x,
            deflection(y, f.y, m.z),
            deflection(z, f.z, -m.y),
            flex.torsional * l * l * m.x,
            -turn(z, f.z, -m.y),
            turn(y, f.y, m.z),
        )
    }

    #[test]
    fn it_is_the_free_end_of_a_beam_of_any_length() {
        let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel");
        let (from, to) = (section(0.01, 0.03), section(0.02, 0.015));
        let taper = Taper::new(from.clone(), to).expect("a taper");
        let (f, m) = (Vector3::new(3.0, -5.0, 7.0), Vector3::new(0.4, 0.6, -0.9));
        let six = Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z);
        for distribution in [[1.0, 1.0, 1.0], [1.0, 0.5, 0.0], [2.0, 7.0, 0.3]] {
            for length in [1e-3, 0.2, 1.0, 30.0] {
                let load = BeamLoad::quadratic(distribution.map(|share| six * share));
                let beam = |l| Beam::new(&steel, &from, l).expect("a beam");
                let tapered = |l| TaperedBeam::new(&steel, &taper, l).expect("a beam");
                let (unit, own) = (beam(1.0), beam(length));
                let (unit_tapered, own_tapered) = (tapered(1.0), tapered(length));
                let pairs: [(&dyn StraightBeam, &dyn StraightBeam); 2] =
                    [(&unit, &own), (&unit_tapered, &own_tapered)];
                for (unit, own) in pairs {
                    let flex = LoadFlexibility::of(unit, distribution);
                    let found = put_together(&flex, length, &f, &m);
                    let expected = own.free_end(&load);
                    for k in 0..6 {
                        let error = (found[k] - expected[k]).abs();
                        assert!(
                            error <= 1e-13 * expected[k].abs(),
                            "{k}: {found} {expected}"
                        );
                    }
                    let force = f * (flex.total * length);
                    let arm = Vector3::new(flex.first_moment * length * length, 0.0, 0.0);
                    let moment = m * (flex.total * length) + arm.cross(&f);
                    let resultant = load.resultant(length);
                    let found =
                        Vector6::from_fn(|k, _| if k < 3 { force[k] } else { moment[k - 3] });
                    assert!((found - resultant).amax() <= 1e-14 * resultant.amax());
                }
            }
        }
    }
}
