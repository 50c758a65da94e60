//! Section wrenches of several states at the points that a beam is integrated over.

use nalgebra::Vector6;

use crate::load::BeamLoad;
use crate::quadrature::gauss;
use crate::straight::StraightBeam;

/// The states of a beam at the points of its integration: worked out once, for the work of each of
/// them on each other's strains ([`StraightBeam::elastic_work`]), with any weights along the beam.
#[derive(Debug, Clone, Default)]
pub struct SampledStates {
    points: Vec<Station>,
    /// Section wrenches, by states and points.
    wrenches: Vec<Vector6<f64>>,
    /// The compliances of the sections at the points, with the weights.
    weighted: Vec<Vector6<f64>>,
}

#[derive(Debug, Clone)]
struct Station {
    xi: f64,
    /// Its share in the integral over the length (m).
    share: f64,
    compliance: Vector6<f64>,
}

impl SampledStates {
    /// Samples the states of a beam, each by the wrench on the beam at its second node and the load
    /// between the nodes, in place of those before.
    pub fn sample<'s>(
        &mut self,
        beam: &dyn StraightBeam,
        states: impl Iterator<Item = (&'s Vector6<f64>, BeamLoad)>,
    ) {
        let (points, wrenches) = (&mut self.points, &mut self.wrenches);
        points.clear();
        wrenches.clear();
        let length = beam.length();
        beam.intervals(1.0, &mut |first, last| {
            gauss(first, last, |xi, weight| {
                points.push(Station {
                    xi,
                    share: length * weight,
                    compliance: beam.section_compliance_at(xi),
                });
            });
        });
        for (end, load) in states {
            let along = load.section_wrenches(length, end);
            wrenches.extend(points.iter().map(|point| along.at(point.xi)));
        }
    }

    /// Forgets the states, and keeps the room for others.
    pub fn forget(&mut self) {
        self.points.clear();
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Gives each part of the work a weight along the beam.
    pub fn weigh(&mut self, weight: impl Fn(f64) -> Vector6<f64>) {
        let weighted = |point: &Station| point.compliance.component_mul(&weight(point.xi));
        self.weighted.clear();
        self.weighted.extend(self.points.iter().map(weighted));
    }

    /// The work of a state's section wrenches on another's elastic strains, by the weights.
    ///
    /// # Panics
    /// If there is no state of one of these numbers.
    pub fn work(&self, of: usize, on: usize) -> Vector6<f64> {
        let count = self.points.len();
        let [own, other] = [of, on].map(|state| &self.wrenches[state * count..][..count]);
        let mut sum = Vector6::zeros();
        let strained = self.weighted.iter().zip(other);
        for ((point, own), (compliance, other)) in self.points.iter().zip(own).zip(strained) {
            let strain = compliance.component_mul(other);
            sum += own.component_mul(&strain) * point.share;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::Beam;
    use crate::material::{Elasticity, Material};
    use crate::section::{Section, SectionShape};

    /// A tip force bends a cantilever by F L³/3EI; work of a unit force is that.
    #[test]
    fn the_work_of_a_unit_force_is_the_deflection() {
        let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
        let rod = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).unwrap();
        let length = 0.7;
        let beam = Beam::new(&steel, &rod, length).unwrap();
        let (unit, loaded) = (Vector6::ith(1, 1.0), Vector6::ith(1, 250.0));
        let mut states = SampledStates::default();
        let none = BeamLoad::none;
        states.sample(&beam, [(&unit, none()), (&loaded, none())].into_iter());
        states.weigh(|_| Vector6::repeat(1.0));
        let inertia = std::f64::consts::PI * 0.02_f64.powi(4) / 64.0;
        let bent = 250.0 * length.powi(3) / (3.0 * 2.1e11 * inertia);
        let [there, back] = [states.work(0, 1), states.work(1, 0)].map(|work| work.sum());
        assert!((there / bent - 1.0).abs() < 1e-14, "{there}");
        assert!((there / back - 1.0).abs() < 1e-14, "{back}");
        // A weight that rises along the beam: ∫ ξ (1 − ξ)² = 1/12, of ∫ (1 − ξ)² = 1/3.
        states.weigh(Vector6::repeat);
        let weighed = states.work(0, 1).sum();
        assert!((weighed / (bent / 4.0) - 1.0).abs() < 1e-14, "{weighed}");
    }

    /// Sampled and one pair at a time, to the bit, under a load between the nodes.
    #[test]
    fn many_states_are_as_pairs() {
        let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
        let rod = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).unwrap();
        let beam = Beam::new(&steel, &rod, 0.7).unwrap();
        let ends = [
            Vector6::new(3.0, -2.0, 1.0, 0.3, -0.4, 0.5),
            Vector6::new(-1.0, 4.0, 2.0, 0.1, 0.2, -0.6),
        ];
        let load = BeamLoad::linear(Vector6::repeat(2.0), Vector6::repeat(-1.0));
        let weight = |xi: f64| Vector6::new(1.0, xi, 2.0, 1.0 - xi, 0.3, xi * xi);
        let mut states = SampledStates::default();
        let loads = [BeamLoad::none(), load];
        states.sample(&beam, ends.iter().zip(loads));
        states.weigh(weight);
        let pair = beam.elastic_work(&ends[1], &load, &ends[0], &weight);
        assert_eq!(states.work(0, 1), pair);
    }
}
