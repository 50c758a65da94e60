//! Test support: the mechanism files of the workspace's `tests/reference`, which write the
//! prebuilt mechanisms out, compared with their models. They are read here by a reader of their
//! own, so that a mistake of the loader cannot hide one of a prebuilt.

use std::fmt;
use std::marker::PhantomData;
use std::path::Path;

use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{DofSet, frame_from_axis};
use hyperstat_model::{BodyKind, JointStiffness, Model, NodeId};
use nalgebra::{Point3, Vector3};
use ron::extensions::Extensions;
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

/// Largest difference of a position, relative to its distance from the origin, and of an axis:
/// the files' numbers are correct to a few units of the last digit.
const LAST_DIGITS: f64 = 1e-15;

type Numbers = (f64, f64, f64);
/// A body and a point.
type Place = (String, String);

/// A mechanism file as far as the prebuilt mechanisms go.
#[derive(Debug, Deserialize)]
pub(super) struct WrittenOut {
    name: String,
    materials: Entries<MaterialEntry>,
    sections: Entries<SectionEntry>,
    points: Entries<Numbers>,
    bodies: Entries<BodyEntry>,
    joints: Entries<JointEntry>,
    output: Place,
}

#[derive(Debug, Deserialize)]
struct MaterialEntry {
    young: f64,
    poisson: f64,
    density: f64,
}

#[derive(Debug, Deserialize)]
enum SectionEntry {
    Circle { diameter: f64 },
}

#[derive(Debug, Deserialize)]
enum BodyEntry {
    Beam {
        through: Vec<String>,
        section: String,
        material: String,
        y_axis: Option<Numbers>,
        elements: Option<usize>,
    },
    Rigid {
        points: Vec<String>,
    },
}

#[derive(Debug, Deserialize)]
struct JointEntry {
    at: String,
    between: (String, String),
    kind: KindEntry,
    x_axis: Option<Numbers>,
    #[serde(default)]
    locked: bool,
    #[serde(default)]
    stiffness: StiffnessEntry,
}

#[derive(Debug, Deserialize)]
enum KindEntry {
    Revolute { axis: Numbers },
    Spherical,
    Fixed { axis: Option<Numbers> },
}

#[derive(Debug, Default, Deserialize)]
struct StiffnessEntry {
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
    u: Option<f64>,
    v: Option<f64>,
    w: Option<f64>,
}

/// A map in the order of the file.
#[derive(Debug)]
struct Entries<T>(Vec<(String, T)>);

impl<T> Entries<T> {
    fn get(&self, name: &str) -> &T {
        let found = self.0.iter().find(|(key, _)| key == name);
        &found
            .unwrap_or_else(|| panic!("`{name}` is not in the file"))
            .1
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Entries<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for InOrder<T> {
            type Value = Entries<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a map")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Entries<T>, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Entries(entries))
            }
        }
        deserializer.deserialize_map(InOrder(PhantomData))
    }
}

impl WrittenOut {
    /// Reads `tests/reference/<name>.ron` of the workspace.
    pub(super) fn read(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference");
        let path = folder.join(name).with_extension("ron");
        let text = std::fs::read_to_string(&path).expect("the reference files stand in `tests`");
        // serde knows no variant that may stand with and without fields.
        let text = text.replace("kind: Fixed)", "kind: Fixed())");
        ron::Options::default()
            .with_default_extension(Extensions::IMPLICIT_SOME)
            .from_str(&text)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// Position of a point, as a pose.
    pub(super) fn pose(&self, point: &str) -> [f64; 3] {
        (*self.points.get(point)).into()
    }

    /// Asserts that `model` is this mechanism: names and order exactly, numbers to the last
    /// digits.
    pub(super) fn assert_same(&self, model: &Model) {
        assert_eq!(model.name, self.name);
        assert_eq!(model.bodies().len(), self.bodies.0.len());
        for (k, (name, body)) in self.bodies.0.iter().enumerate() {
            self.assert_same_body(model, k, name, body);
        }
        assert_eq!(model.joints().len(), self.joints.0.len());
        for (k, (name, joint)) in self.joints.0.iter().enumerate() {
            assert_same_joint(model, k, name, joint);
        }
        assert_eq!(place_of(model, model.output()), self.output);
    }

    fn assert_same_body(&self, model: &Model, k: usize, name: &str, entry: &BodyEntry) {
        let body = &model.bodies()[k];
        assert_eq!(body.name, name);
        let (kind, points) = match entry {
            BodyEntry::Beam { through, .. } => (BodyKind::Elastic, through),
            BodyEntry::Rigid { points } => (BodyKind::Rigid, points),
        };
        assert_eq!(body.kind, kind, "{name}");
        assert_eq!(body.nodes.len(), points.len(), "{name}");
        for (node, point) in body.nodes.iter().zip(points) {
            assert_eq!(&model.nodes()[node.0].point, point, "{name}");
            let at = model.geometry().positions[node.0];
            let expected = Point3::from(self.pose(point));
            let off = (at - expected).norm();
            assert!(
                off <= LAST_DIGITS * expected.coords.norm(),
                "{name}.{point}: {at} is {off:e} off {expected}"
            );
        }
        let BodyEntry::Beam {
            section,
            material,
            y_axis,
            elements,
            ..
        } = entry
        else {
            return;
        };
        for id in &body.segments {
            let segment = &model.segments()[id.0];
            assert_eq!(segment.elements, elements.unwrap_or(1), "{name}");
            assert_eq!(segment.section, self.section(section), "{name}");
            assert_eq!(segment.material, self.material(material), "{name}");
            match (model.geometry().y_axes[id.0], y_axis.map(vector)) {
                (None, None) => {}
                (Some(y), Some(expected)) => assert_same_axis(name, &y, &expected),
                (found, expected) => panic!("{name}: y axis {found:?}, not {expected:?}"),
            }
        }
    }

    fn section(&self, name: &str) -> Section {
        let SectionEntry::Circle { diameter } = *self.sections.get(name);
        Section::new(SectionShape::Circle { diameter }, None, None).expect("a valid section")
    }

    fn material(&self, name: &str) -> Material {
        let entry = self.materials.get(name);
        let elasticity = Elasticity::Poisson(entry.poisson);
        Material::new(entry.young, elasticity, Some(entry.density)).expect("a valid material")
    }
}

fn assert_same_joint(model: &Model, k: usize, name: &str, entry: &JointEntry) {
    let joint = &model.joints()[k];
    assert_eq!(joint.name, name);
    let (first, second) = &entry.between;
    for (node, body) in joint.between.into_iter().zip([first, second]) {
        let expected = match body.as_str() {
            "ground" => place_of(model, None),
            _ => (body.clone(), entry.at.clone()),
        };
        assert_eq!(place_of(model, node), expected, "{name}");
    }
    let (kind, axis) = match entry.kind {
        KindEntry::Revolute { axis } => ("Revolute", Some(axis)),
        KindEntry::Spherical => ("Spherical", None),
        KindEntry::Fixed { axis } => ("Fixed", axis),
    };
    assert_eq!(joint.joint.kind(), kind, "{name}");
    let held = if entry.locked {
        joint.joint.free()
    } else {
        DofSet::EMPTY
    };
    assert_eq!(joint.locked, held, "{name}");
    let k_file = &entry.stiffness;
    let stiffness = [k_file.x, k_file.y, k_file.z, k_file.u, k_file.v, k_file.w];
    assert_eq!(
        joint.stiffness,
        JointStiffness::Directions(stiffness),
        "{name}"
    );

    let (axis, x_axis) = (axis.map(vector), entry.x_axis.map(vector));
    let expected = frame_from_axis(axis.as_ref(), x_axis.as_ref()).expect("a valid frame");
    let frame = model.geometry().frames[k];
    for column in 0..3 {
        let axis = |matrix: &nalgebra::Matrix3<f64>| matrix.column(column).into_owned();
        assert_same_axis(name, &axis(frame.matrix()), &axis(expected.matrix()));
    }
}

/// Body and point of a node; of the ground empty names.
fn place_of(model: &Model, node: Option<NodeId>) -> Place {
    let Some(node) = node else {
        return Place::default();
    };
    let node = &model.nodes()[node.0];
    (model.bodies()[node.body.0].name.clone(), node.point.clone())
}

fn assert_same_axis(name: &str, found: &Vector3<f64>, expected: &Vector3<f64>) {
    let off = (found - expected).norm();
    assert!(
        off <= LAST_DIGITS,
        "{name}: {found:?} is {off:e} off {expected:?}"
    );
}

fn vector((x, y, z): Numbers) -> Vector3<f64> {
    Vector3::new(x, y, z)
}
