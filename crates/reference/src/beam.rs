//! A beam element by its six natural deformations, and its closed-form 12×12 stiffness.
//!
//! Formed here anew, not taken from `hyperstat-elements`, so that an error there shows.

use hyperstat_model::Segment;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3, Vector6};

use crate::row::Row;
use crate::taper::TaperFlexibility;

/// Stiffness of an element over both its nodes.
pub(crate) type ElementStiffness = SMatrix<f64, 12, 12>;

/// Where |x·z| reaches this, a default section stands along global x instead of global z.
const UPRIGHT_LIMIT: f64 = 0.9;
/// Below this sine a direction counts as running along the segment.
const ALONG: f64 = 1e-9;

/// A straight beam element between two nodes.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    /// First and second node; local x runs from the first to the second.
    pub nodes: [usize; 2],
    /// Columns are local x, y, z in global axes.
    pub frame: Matrix3<f64>,
    /// Length [m].
    pub length: f64,
    /// Places of its ends along the segment (0 to 1).
    pub part: [f64; 2],
    /// E A [N].
    axial: f64,
    /// G J [N·m²].
    torsion: f64,
    /// E I of deflection along local y and along local z [N·m²].
    bending: [f64; 2],
    /// 12 E I / (κ G A L²) of deflection along local y and along local z; 0 for Euler–Bernoulli.
    shear: [f64; 2],
    /// In place of the four above, where the section changes along the element.
    taper: Option<TaperFlexibility>,
}

impl Element {
    /// An element of a segment: the `part` of it between two places (0 to 1) along its `length`,
    /// with the segment's `frame`.
    pub fn new(
        nodes: [usize; 2],
        segment: &Segment,
        frame: Matrix3<f64>,
        length: f64,
        part: [f64; 2],
    ) -> Self {
        let taper = segment.taper.as_ref();
        let taper = taper.map(|change| TaperFlexibility::new(segment, change, part, length));
        let length = length * (part[1] - part[0]);
        let (material, section) = (&segment.material, &segment.section);
        let bending = [section.iz(), section.iy()].map(|i| material.young() * i);
        let shear_area = [section.shear_y(), section.shear_z()];
        let shear = [0, 1].map(|plane| {
            shear_area[plane].map_or(0.0, |area| {
                12.0 * bending[plane] / (material.shear() * area * length * length)
            })
        });
        Self {
            nodes,
            frame,
            length,
            part,
            axial: material.young() * section.area(),
            torsion: material.shear() * section.torsion(),
            bending,
            shear,
            taper,
        }
    }

    /// The six deformations, each with its flexibility. They are independent of each other, so
    /// that the strain energy is `½ Σ (aᵀu)² / c`: stretch, twist, and in each plane a symmetric
    /// bending (constant moment) and an antisymmetric one (constant shear).
    pub fn deformations(&self) -> [Row; 6] {
        let [x, y, z] = [0, 1, 2].map(|axis| self.frame.column(axis).into_owned());
        let l = self.length;
        let zero = Vector3::zeros();
        let opposite = |linear: Vector3<f64>, angular: Vector3<f64>, stiffness: f64| {
            self.row([-linear, linear], [-angular, angular], stiffness)
        };
        let antisymmetric = |chord: Vector3<f64>, axis: Vector3<f64>, stiffness: f64| {
            self.row([chord, -chord], [axis, axis], stiffness)
        };
        if let Some(taper) = &self.taper {
            let [in_y, in_z] = taper.bending;
            // Deflection of the ends against each other, carried to the elastic centre as by
            // rigid arms.
            let across = |chord: Vector3<f64>, axis: Vector3<f64>, centre: f64, c: f64| {
                self.row(
                    [-chord, chord],
                    [-axis * centre, -axis * (l - centre)],
                    1.0 / c,
                )
            };
            return [
                opposite(x, zero, 1.0 / taper.axial),
                opposite(zero, x, 1.0 / taper.torsion),
                opposite(zero, z, 1.0 / in_y.turn),
                opposite(zero, y, 1.0 / in_z.turn),
                across(y, z, in_y.centre, in_y.deflection),
                across(z, -y, in_z.centre, in_z.deflection),
            ];
        }
        let along = |plane: usize| 3.0 * self.bending[plane] / (l * (1.0 + self.shear[plane]));
        [
            opposite(x, zero, self.axial / l),
            opposite(zero, x, self.torsion / l),
            opposite(zero, z, self.bending[0] / l),
            opposite(zero, y, self.bending[1] / l),
            antisymmetric(y * (2.0 / l), z, along(0)),
            antisymmetric(z * (-2.0 / l), y, along(1)),
        ]
    }

    fn row(&self, linear: [Vector3<f64>; 2], angular: [Vector3<f64>; 2], stiffness: f64) -> Row {
        let term = |end: usize| (self.nodes[end], join(&linear[end], &angular[end]));
        Row {
            terms: vec![term(0), term(1)],
            flexibility: 1.0 / stiffness,
        }
    }

    /// The stiffness in global axes, as the sum over the deformations.
    fn summed_stiffness(&self) -> ElementStiffness {
        let mut sum = ElementStiffness::zeros();
        for row in self.deformations() {
            let [(_, first), (_, second)] = [&row.terms[0], &row.terms[1]];
            let a = SVector::<f64, 12>::from_iterator(first.iter().chain(second).copied());
            sum += a * a.transpose() / row.flexibility;
        }
        sum
    }

    /// The stiffness in global axes, written out in closed form where the section does not change.
    pub fn stiffness(&self) -> ElementStiffness {
        if self.taper.is_some() {
            return self.summed_stiffness();
        }
        let l = self.length;
        let mut k = ElementStiffness::zeros();
        let mut set = |r: usize, c: usize, value: f64| {
            k[(r, c)] = value;
            k[(c, r)] = value;
        };
        for (dof, stiffness) in [(0, self.axial / l), (3, self.torsion / l)] {
            set(dof, dof, stiffness);
            set(dof + 6, dof + 6, stiffness);
            set(dof, dof + 6, -stiffness);
        }
        // Deflection along y turns about +z; deflection along z turns about −y.
        for (plane, v, t, sign) in [(0, 1, 5, 1.0), (1, 2, 4, -1.0)] {
            let shear = self.shear[plane];
            let unit = self.bending[plane] / (l * l * l * (1.0 + shear));
            set(v, v, 12.0 * unit);
            set(v + 6, v + 6, 12.0 * unit);
            set(v, v + 6, -12.0 * unit);
            set(t, t, (4.0 + shear) * l * l * unit);
            set(t + 6, t + 6, (4.0 + shear) * l * l * unit);
            set(t, t + 6, (2.0 - shear) * l * l * unit);
            set(v, t, sign * 6.0 * l * unit);
            set(v, t + 6, sign * 6.0 * l * unit);
            set(v + 6, t, -sign * 6.0 * l * unit);
            set(v + 6, t + 6, -sign * 6.0 * l * unit);
        }
        let mut turn = ElementStiffness::zeros();
        for block in 0..4 {
            turn.fixed_view_mut::<3, 3>(3 * block, 3 * block)
                .copy_from(&self.frame);
        }
        turn * k * turn.transpose()
    }
}

/// Local axes of a segment (columns x, y, z): x along `span`, y as given made normal to x;
/// without it z stands upright. `None` where the span has no length or y runs along it.
pub(crate) fn segment_frame(
    span: &Vector3<f64>,
    y_axis: Option<&Vector3<f64>>,
) -> Option<Matrix3<f64>> {
    let x = span.try_normalize(0.0)?;
    let normal = |direction: &Vector3<f64>| {
        let direction = direction.try_normalize(0.0)?;
        (direction - x * x.dot(&direction)).try_normalize(ALONG)
    };
    let (y, z) = if let Some(y_axis) = y_axis {
        let y = normal(y_axis)?;
        (y, x.cross(&y))
    } else {
        let up = if x.z.abs() < UPRIGHT_LIMIT {
            Vector3::z()
        } else {
            Vector3::x()
        };
        let z = normal(&up)?;
        (z.cross(&x), z)
    };
    Some(Matrix3::from_columns(&[x, y, z]))
}

/// A 6-vector of its linear and its angular part.
pub(crate) fn join(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(
        linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
    )
}

#[cfg(test)]
mod tests {
    use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
    use hyperstat_model::Model;
    use nalgebra::{DVector, Point3};

    use super::*;

    fn element(shear: Option<f64>) -> Element {
        let shape = SectionShape::General {
            area: 6e-4,
            iy: 3e-8,
            iz: 8e-8,
            torsion: 5e-8,
            y_max: None,
            z_max: None,
            torsion_modulus: None,
        };
        let section = Section::new(shape, shear, shear.map(|area| 0.7 * area)).unwrap();
        let material = Material::new(2.1e11, Elasticity::Shear(8e10), None).unwrap();
        let mut model = Model::new("element");
        let points = [("A", Point3::origin()), ("B", Point3::new(0.1, 0.2, -0.2))];
        model
            .add_beam("beam", &points, &material, &section, None, 1)
            .unwrap();
        let span = Vector3::new(0.1, 0.2, -0.2);
        let frame = segment_frame(&span, Some(&Vector3::new(1.0, 1.0, 0.0))).unwrap();
        Element::new([0, 1], &model.segments()[0], frame, span.norm(), [0.0, 1.0])
    }

    #[test]
    fn deformations_and_closed_form_are_the_same_stiffness() {
        for shear in [None, Some(4e-4)] {
            let element = element(shear);
            let sum = element.summed_stiffness();
            let closed = element.stiffness();
            assert!((sum - closed).amax() < 1e-14 * closed.amax());
        }
    }

    #[test]
    fn rigid_motions_do_not_deform() {
        let element = element(None);
        let (linear, turn) = (Vector3::new(0.3, -0.2, 0.9), Vector3::new(1.0, 0.4, -0.6));
        let mut motion = DVector::zeros(12);
        let ends = [Vector3::zeros(), Vector3::new(0.1, 0.2, -0.2)];
        for (node, arm) in ends.iter().enumerate() {
            let twist = join(&(linear + turn.cross(arm)), &turn);
            motion.fixed_rows_mut::<6>(6 * node).copy_from(&twist);
        }
        for row in element.deformations() {
            assert!(row.apply(&motion.as_view()).abs() < 1e-14);
        }
    }

    /// The rule of the file format: without a `y_axis` local z stands upright.
    #[test]
    fn default_frames() {
        let level = segment_frame(&Vector3::new(0.0, 2.0, 0.0), None).unwrap();
        assert_eq!(level.column(2), Vector3::z());
        assert_eq!(level.column(1), -Vector3::x());
        let upright = segment_frame(&Vector3::new(0.0, 0.0, 2.0), None).unwrap();
        assert_eq!(upright.column(2), Vector3::x());
        assert_eq!(upright.column(1), -Vector3::y());
        let along = Vector3::new(0.0, -3.0, 0.0);
        assert_eq!(
            segment_frame(&Vector3::new(0.0, 2.0, 0.0), Some(&along)),
            None
        );
        assert_eq!(segment_frame(&Vector3::zeros(), None), None);
    }
}
