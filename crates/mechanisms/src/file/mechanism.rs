//! One mechanism, as a file describes it.

use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::Arc;

use hyperstat_closure::{LoopClosure, Reached, Target};
use hyperstat_joints::Dof;
use hyperstat_model::{BodyId, JointId, Model, NodeId};
use nalgebra::{Point3, Rotation3};

use super::end::End;
use super::groups::{self, Copies};
use super::home::Home;
use super::loads::Acting;
use super::registry::Registry;
use super::through::{Tables, check_name};
use super::value_names::Given;
use crate::error::{LoadError, Location};
use crate::file::{bodies, joints, loads, materials, nodes, value_names};
use crate::prebuilt::PoseError;
use crate::terms::mechanism::MECHANISM;
use crate::text::dependence::{self, Dependence};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::paths;
use crate::text::replace::{Changed, Replacement};
use crate::text::source::{Place, Source};
use crate::text::table::Table;
use crate::text::tree::{Node, Steps};
use crate::text::value::Value;

/// A mechanism read from a file: its model, and the place of every part of it.
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// The model, with its loads and output.
    pub model: Model,
    bodies: Vec<Place>,
    joints: Vec<Place>,
    loads: Vec<Place>,
    output: Place,
    /// What its poses are of.
    end: End,
    /// The file's value.
    root: Arc<Node>,
    /// What the segments are given by.
    given: Vec<Given>,
    /// Paths of what groups have, by the names and numbers of their copies.
    copies: Copies,
    /// What a job says of what acts, and with it whether the masses are the file's own.
    acting: Option<Acting>,
    registry: Registry,
    unused_points: Vec<String>,
}

impl Mechanism {
    /// Reads the value of a mechanism file.
    pub(crate) fn read(root: Node, registry: &Registry) -> Result<Self, LoadError> {
        let settled = root.clone();
        Self::read_settled(root, &settled, registry)
    }

    /// The same, where values of expressions are known: `settled` is the file's value with them in their
    /// places.
    pub(crate) fn read_settled(
        root: Node,
        settled: &Node,
        registry: &Registry,
    ) -> Result<Self, LoadError> {
        let written = groups::write_out(settled)?;
        let root = Arc::new(root);
        let fragment = Fragment::of_node(&written.root);
        let fields = Fields::read(fragment, "the mechanism", &MECHANISM.names())?;
        let mut model = Model::new(fields.required("name")?.string()?);
        let tables = Tables {
            materials: Table::read(fields.get("materials"), "material", |entry, owner| {
                materials::material(entry.value, owner)
            })?,
            sections: Table::read(fields.get("sections"), "section", |entry, owner| {
                materials::profile(entry.value, owner)
            })?,
            points: Table::read(Some(fields.required("points")?), "point", |entry, _| {
                check_name(entry, "point")?;
                place(entry.value)
            })?,
        };
        let mut bodies = Vec::new();
        let mut joints = Vec::new();
        let mut given = Vec::new();
        for entry in fields.required("bodies")?.map()? {
            bodies::read(&entry, &tables, &mut model, &mut given)?;
            // Of a frame there may be several, and joints between them.
            bodies.resize(model.bodies().len(), entry.key.place());
            joints.resize(model.joints().len(), entry.key.place());
        }
        let point = |at: Fragment<'_>| tables.points.find(at).and_then(|_| at.string());
        for entry in fields.required("joints")?.map()? {
            joints::read(&entry, point, registry, &mut model)?;
            joints.push(entry.key.place());
        }
        let output = fields.required("output")?;
        let own = nodes::on(&model, output, "the output")?;
        model.set_output(own);
        let field = |k: usize| fields.get(loads::FIELDS[k]);
        let loads = loads::read(field, &mut model, &Home::Here)?.unwrap_or_default();
        let unused_points = unused(tables.points.names(), &model, &root);
        Ok(Self {
            model,
            bodies,
            joints,
            loads,
            output: output.place(),
            end: End::at(own),
            root: Arc::clone(&root),
            given,
            copies: written.copies,
            acting: None,
            registry: registry.clone(),
            unused_points,
        })
    }

    /// Puts what a job says of loads, cases, gravity, masses, misfits, preloads and the output in place of
    /// the mechanism's own.
    pub(crate) fn replace(&mut self, acting: &Acting) -> Result<(), LoadError> {
        self.replace_settled(acting, acting)
    }

    /// The same, where values of expressions are known: `settled` has them in their places.
    pub(crate) fn replace_settled(
        &mut self,
        acting: &Acting,
        settled: &Acting,
    ) -> Result<(), LoadError> {
        let values = settled.in_scope(&self.root)?;
        let output = (self.end).read(&values, &mut self.model, &Rotation3::identity())?;
        if let Some(loads) = values.read(&mut self.model, &Home::Here)? {
            self.loads = loads;
        }
        if let Some(named) = values.output().or(values.tool()) {
            self.model.set_output(output);
            self.output = named.place();
        }
        self.acting = Some(acting.clone());
        Ok(())
    }

    /// Whether a job has put its own loads, cases, masses or misfits in place of the file's.
    pub(crate) fn is_of_job(&self) -> bool {
        self.acting
            .as_ref()
            .is_some_and(|acting| !acting.is_empty())
    }

    /// All files that were read for it.
    pub fn files(&self) -> Vec<PathBuf> {
        self.output.source.files()
    }

    /// Names values of `model`, which is this mechanism's in any configuration, by their paths in
    /// the file, as `vary` takes them ([`Model::name_value`]): every value of a section and a
    /// material, masses, and stiffnesses of joints that no other joint has alike.
    pub fn name_values(&self, model: &mut Model) {
        self.name_others(&[], model);
    }

    /// The same where some values are varied.
    pub(crate) fn name_others(&self, varied: &[Steps], model: &mut Model) {
        let masses = !self.acting.as_ref().is_some_and(Acting::has_masses);
        let given = (&*self.given, &self.copies);
        value_names::of_file(&self.root, varied, given, masses, model);
    }

    /// The path by which `vary` and [`Mechanism::with_values`] take the stiffnesses of these joints in one
    /// direction as one, such as `joints.{A1|A2|A3}.stiffness.u`; `None` where one of them has no path.
    ///
    /// # Panics
    /// If a joint is not one of this mechanism's model.
    pub fn stiffness_path(&self, joints: &[JointId], direction: Dof) -> Option<String> {
        let letter = value_names::letter(direction);
        let name = |joint: &JointId| &self.model.joints()[joint.0].name;
        let path = |joint: &JointId| self.copies.stiffness(name(joint), letter);
        let path = value_names::together(joints.iter().map(path), direction)?;
        let name = Source::argument("path", format!("{path:?}"), None);
        let found = paths::find_all(&self.root, Fragment::at(&Place::whole(&name)));
        found.is_ok().then_some(path)
    }

    /// The parameters of the mechanism, and what depends on each.
    pub fn dependences(&self) -> Vec<Dependence> {
        let beside: Vec<_> = self.acting.iter().flat_map(Acting::given).collect();
        dependence::dependences(&self.root, &beside)
    }

    /// The numbers that say where its parts stand and how long they are, such as `points.A.0`, by their paths as
    /// `vary` names them, SI; without those that expressions give.
    pub fn placing(&self) -> Vec<(String, f64)> {
        dependence::placing(&self.root)
    }

    /// The same mechanism with other values in some places, named by their paths as `vary` names them,
    /// such as `sections.rod.diameter`, in the file's units. Its text is not read again.
    ///
    /// ```
    /// # use hyperstat_mechanisms::{Disk, LoadError, Registry, load_mechanism};
    /// # let path = "../../examples/portal.ron".as_ref();
    /// let portal = load_mechanism(path, &Disk, &Registry::builtin())?;
    /// let thicker = portal.with_values(&[("sections.rod.diameter", 0.02)])?;
    /// # assert!(thicker.model.segments()[0].section.area() > portal.model.segments()[0].section.area());
    /// let error = portal.with_values(&[("sections.rod.diameter", -0.02)]).unwrap_err();
    /// assert_eq!(error.location().unwrap().to_string(), "sections.rod.diameter");
    /// # Ok::<(), LoadError>(())
    /// ```
    ///
    /// # Errors
    /// A path that leads nowhere, two of which one is a part of the other, and what is wrong with the
    /// mechanism that the values make, at the value that is to blame; its place is named by its path.
    pub fn with_values<P: AsRef<str>, V: Clone + Into<Value>>(
        &self,
        values: &[(P, V)],
    ) -> Result<Self, LoadError> {
        let mut found: Vec<(&str, Vec<Steps>, Node)> = Vec::with_capacity(values.len());
        for (path, value) in values {
            let path = path.as_ref();
            let name = Source::argument(path, format!("{path:?}"), None);
            let key = Place::whole(&name);
            let places = paths::find_all(&self.root, Fragment::at(&key))?;
            let overlaps =
                |other: &&(&str, Vec<Steps>, Node)| paths::any_overlap(&other.1, &places);
            if let Some((other, ..)) = found.iter().find(overlaps) {
                return Err(paths::overlapping(other, Fragment::at(&key)));
            }
            let old = places.first().and_then(|steps| self.root.find(steps));
            let value = value.clone().into().written(old);
            let value = Source::argument(path, value, Some(self.root.source()));
            found.push((path, places, Node::of(Fragment::of_file(&value)?)));
        }
        let together = Source::argument("values", String::new(), None);
        let changed = Changed {
            root: &self.root,
            values: (found.iter())
                .map(|(path, places, value)| Replacement {
                    path,
                    places,
                    value: value.clone(),
                })
                .collect(),
            whole: Place::whole(&together),
        };
        let read = |tree: Node| {
            let mut mechanism = Self::read(tree, &self.registry)?;
            if let Some(acting) = &self.acting {
                mechanism.replace(acting)?;
            }
            Ok(mechanism)
        };
        read(changed.tree()).map_err(|error| {
            changed.refused(
                error,
                "",
                |location| found.iter().any(|(path, ..)| *location.path == **path),
                |tree| read(tree.clone()).is_ok(),
            )
        })
    }

    /// Puts the mechanism at a target of its output or its drives, by loop closure that begins in the
    /// file's configuration. Whoever asks for many targets makes one [`LoopClosure`] of the model.
    ///
    /// # Errors
    /// A target that is out of reach, singular or reached in another assembly mode only; a mechanism that
    /// cannot be moved.
    pub fn place_at(&self, target: &Target<'_>) -> Result<Reached, PoseError> {
        Ok(self.loops()?.place_at(target)?)
    }

    /// Its loop closure, whose poses are those of its own output.
    pub(crate) fn loops(&self) -> Result<LoopClosure, PoseError> {
        Ok(LoopClosure::of_node(&self.model, self.end.own)?)
    }

    /// Its own output, whatever a job names.
    pub(crate) fn own_output(&self) -> NodeId {
        self.end.own
    }

    /// The file's value.
    pub(crate) fn root(&self) -> &Node {
        &self.root
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        self.root.source().written()
    }

    /// The kinds that it is read with.
    pub(crate) fn registry(&self) -> &Registry {
        &self.registry
    }

    /// The points of the file that no body runs through and no expression names, in its order.
    pub fn unused_points(&self) -> &[String] {
        &self.unused_points
    }

    /// Place of a body's name.
    ///
    /// # Panics
    /// If the body is not one of this mechanism's model.
    pub fn locate_body(&self, body: BodyId) -> Location {
        self.bodies[body.0].location()
    }

    /// Place of a joint's name.
    ///
    /// # Panics
    /// If the joint is not one of this mechanism's model.
    pub fn locate_joint(&self, joint: JointId) -> Location {
        self.joints[joint.0].location()
    }

    /// Place of the value of `output`.
    pub fn locate_output(&self) -> Location {
        self.output.location()
    }

    /// Place of a load, by its index in [`Model::loads`]; in the batch file where a job's loads
    /// replaced the mechanism's own.
    ///
    /// # Panics
    /// If the model has fewer loads.
    pub fn locate_load(&self, load: usize) -> Location {
        self.loads[load].location()
    }
}

/// The points that no body runs through and no expression names.
fn unused<'n>(points: impl Iterator<Item = &'n str>, model: &Model, root: &Node) -> Vec<String> {
    let used: HashSet<_> = model.nodes().iter().map(|node| &*node.point).collect();
    let mut unused: Vec<&str> = points.filter(|name| !used.contains(name)).collect();
    if !unused.is_empty() {
        let mut named = HashSet::new();
        root.expressions(&mut |expression| named.extend(expression.names()));
        unused.retain(|name| !named.contains(name));
    }
    unused.into_iter().map(Into::into).collect()
}

/// Largest coordinate of a point (m): with those beyond it, sums of squares and the stiffness of
/// what they span would overflow.
const FARTHEST: f64 = 1e50;

/// Reads the place of a point.
fn place(fragment: Fragment<'_>) -> Result<Point3<f64>, LoadError> {
    let place = fragment.vector("a coordinate", Dimension::LENGTH)?;
    if place.amax() > FARTHEST {
        return Err(fragment
            .error(format!("no point can be farther than {FARTHEST:?} m"))
            .with_help("give the coordinates in metres"));
    }
    Ok(place.into())
}
