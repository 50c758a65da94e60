//! What a load along an element and a change of its temperature do, by virtual work.
//!
//! The load is shared between the nodes as by a lever. What then acts in the sections is what acts
//! in a beam on two supports, and the deformations that it makes stand on the right side of the
//! rows, `A u − C λ = d`. `hyperstat-elements` has cantilevers and polynomials in their place.

use hyperstat_elements::Section;
use hyperstat_model::Segment;
use nalgebra::{Vector3, Vector6};

use crate::beam::{Element, join};
use crate::taper::{along_change, points, section};

/// What acts along one element.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Along {
    /// The load's shares at the two nodes, global axes.
    pub shares: [Vector6<f64>; 2],
    /// Deformations with no force in the element's rows, a number a row.
    pub deformations: [f64; 6],
}

impl Along {
    /// A load along an element of `segment`. `intensity` is the wrench per length [N/m, N·m/m],
    /// global axes, at a place along the segment (0 to 1) with the section that it has there; of
    /// second degree at most.
    pub fn load(
        element: &Element,
        segment: &Segment,
        intensity: impl Fn(&Section, f64) -> Vector6<f64>,
    ) -> Self {
        let l = element.length;
        let [first, last] = element.part;
        let load = |xi: f64| {
            let place = first + (last - first) * xi;
            intensity(&section_at(segment, place), place)
        };
        let share = |side: usize| -> Vector6<f64> {
            let of_side = |xi: f64| if side == 0 { 1.0 - xi } else { xi };
            let terms = gauss(0.0, 1.0).map(|(xi, weight)| load(xi) * (of_side(xi) * weight * l));
            terms.into_iter().sum()
        };
        let shares = [share(0), share(1)];
        let x = element.frame.column(0).into_owned();
        // The wrench that the part beyond a section exerts on the part before it.
        let wrench = |xi: f64| {
            let before = gauss(0.0, xi).map(|(at, weight)| {
                let beyond = x * ((xi - at) * l);
                carried(&(load(at) * (weight * l)), &beyond)
            });
            carried(&shares[0], &(x * (xi * l))) - before.into_iter().sum::<Vector6<f64>>()
        };
        let strain = |section: &Section, xi: f64| {
            let [force, moment] = local(element, &wrench(xi));
            let (young, shear) = (segment.material.young(), segment.material.shear());
            let sheared = |force: f64, area: Option<f64>| area.map_or(0.0, |a| force / (shear * a));
            Vector6::new(
                force.x / (young * section.area()),
                sheared(force.y, section.shear_y()),
                sheared(force.z, section.shear_z()),
                moment.x / (shear * section.torsion()),
                moment.y / (young * section.iy()),
                moment.z / (young * section.iz()),
            )
        };
        Self {
            shares,
            deformations: deformations(element, segment, strain),
        }
    }

    /// A uniform strain along the element that needs no force, such as α ΔT.
    pub fn stretch(element: &Element, segment: &Segment, strain: f64) -> Self {
        let strain = Vector6::ith(0, strain);
        Self {
            shares: [Vector6::zeros(); 2],
            deformations: deformations(element, segment, |_, _| strain),
        }
    }
}

/// The deformations of an element's rows by a strain in its own axes, at a place along it (0 to
/// 1) with the section there: the work of the wrenches that go with a unit force in each row.
fn deformations(
    element: &Element,
    segment: &Segment,
    strain: impl Fn(&Section, f64) -> Vector6<f64>,
) -> [f64; 6] {
    let x = element.frame.column(0).into_owned();
    // Along the whole change of section, where there is one.
    let part = element.part.map(|place| match &segment.taper {
        Some(change) => along_change(change, place),
        None => place,
    });
    let [first, last] = part;
    let places = match &segment.taper {
        Some(change) => points(&segment.section, &change.to, part),
        None => gauss(first, last).to_vec(),
    };
    let section_there = |place: f64| match &segment.taper {
        Some(change) => section(&segment.section, &change.to, place),
        None => segment.section.clone(),
    };
    let rows = element.deformations();
    let mut sums = [0.0; 6];
    for (place, weight) in places {
        let xi = (place - first) / (last - first);
        let strain = strain(&section_there(place), xi);
        let length = weight * element.length / (last - first);
        for (row, sum) in rows.iter().zip(&mut sums) {
            let (_, on_first) = &row.terms[0];
            let unit = -carried(on_first, &(x * (xi * element.length)));
            let [force, moment] = local(element, &unit);
            *sum += join(&force, &moment).dot(&strain) * length;
        }
    }
    sums
}

fn section_at(segment: &Segment, place: f64) -> Section {
    match &segment.taper {
        Some(change) => section(&segment.section, &change.to, along_change(change, place)),
        None => segment.section.clone(),
    }
}

/// A wrench about the point that lies `beyond` its own.
fn carried(wrench: &Vector6<f64>, beyond: &Vector3<f64>) -> Vector6<f64> {
    let force: Vector3<f64> = wrench.fixed_rows::<3>(0).into();
    let moment: Vector3<f64> = wrench.fixed_rows::<3>(3).into();
    join(&force, &(moment - beyond.cross(&force)))
}

/// Force and moment in the element's axes.
fn local(element: &Element, wrench: &Vector6<f64>) -> [Vector3<f64>; 2] {
    [0, 3].map(|k| element.frame.tr_mul(&wrench.fixed_rows::<3>(k)))
}

/// Places and weights of five between two ends: right to degree 9.
fn gauss(first: f64, last: f64) -> [(f64, f64); 5] {
    let (middle, half) = ((first + last) / 2.0, (last - first) / 2.0);
    let root = 2.0 * (10.0_f64 / 7.0).sqrt();
    let (near, far) = ((5.0 - root).sqrt() / 3.0, (5.0 + root).sqrt() / 3.0);
    let part = 13.0 * 70.0_f64.sqrt();
    let (heavy, light) = ((322.0 + part) / 900.0, (322.0 - part) / 900.0);
    [
        (-far, light),
        (-near, heavy),
        (0.0, 128.0 / 225.0),
        (near, heavy),
        (far, light),
    ]
    .map(|(at, weight)| (middle + half * at, half * weight))
}
