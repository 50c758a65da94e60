//! Jobs that a program makes, of what would stand in a batch file.

use std::sync::Arc;

use super::batch::{Job, job_name};
use super::poses::Poses;
use super::subject::{Checked, Recipe};
use crate::error::LoadError;
use crate::file::mechanism::Mechanism;
use crate::file::registry::Registry;
use crate::terms::job::JOB;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::scope::Scope;
use crate::text::source::{Place, Source};
use crate::text::tree::Node;
use crate::text::value::Value;
use crate::text::{csv, json, names};

/// The mechanism of a job that a program makes.
#[derive(Debug, Clone)]
pub enum JobMechanism {
    /// A prebuilt one by the name of its kind and its parameters, each a number or as it is written in a
    /// file: `(section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3))`.
    Prebuilt {
        /// Name of its kind, such as `Delta`.
        kind: String,
        /// Names and values of its parameters.
        parameters: Vec<(String, Value)>,
    },
    /// A prebuilt one as it is written in a file, RON or JSON: `Delta(…)`, `{"Delta": {…}}`.
    Written(String),
    /// One that was read, as it was read: what has been changed in its model since is not taken over.
    Loaded(Box<Mechanism>),
}

impl JobMechanism {
    /// A prebuilt mechanism.
    pub fn prebuilt<P: Into<String>, V: Into<Value>>(
        kind: &str,
        parameters: impl IntoIterator<Item = (P, V)>,
    ) -> Self {
        let parameter = |(name, value): (P, V)| (name.into(), value.into());
        Self::Prebuilt {
            kind: kind.into(),
            parameters: parameters.into_iter().map(parameter).collect(),
        }
    }
}

impl From<Mechanism> for JobMechanism {
    fn from(mechanism: Mechanism) -> Self {
        Self::Loaded(Box::new(mechanism))
    }
}

/// The poses of a job that a program makes.
#[derive(Debug, Clone, PartialEq)]
pub enum JobPoses {
    /// The mechanism's own configuration.
    Own,
    /// Not yet any, of a mechanism that is given some later ([`Job::set_poses`]): its own configuration, of a
    /// prebuilt one that has none all coordinates zero, whether it reaches that or not.
    Later,
    /// A row of numbers a pose: coordinates x y z \[m\] rx ry rz \[rad\] of the output, the first three or
    /// all six for a prebuilt mechanism, any for one of a file; or values \[m, rad\] of drives of one of a
    /// file, `joint.direction`.
    Table {
        /// Names of the columns.
        columns: Vec<String>,
        /// Row after row.
        rows: Vec<f64>,
    },
    /// As it is written in a batch file: `Grid(x: (-0.2, 0.2, 41), …)`.
    Written(String),
}

impl JobPoses {
    /// Poses of the first `N` of x, y, z \[m\], rx, ry, rz \[rad\]: three or six.
    pub fn list<const N: usize>(poses: &[[f64; N]]) -> Self {
        let name = |k: usize| {
            csv::COLUMNS
                .get(k)
                .map_or(k.to_string(), |name| (*name).into())
        };
        Self::Table {
            columns: (0..N).map(name).collect(),
            rows: poses.as_flattened().to_vec(),
        }
    }
}

/// A load on a point of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct JobLoad {
    /// Body and point, such as `("platform", "P")`.
    pub on: (String, String),
    /// Force \[N\] in global axes.
    pub force: [f64; 3],
    /// Moment \[N·m\] in global axes.
    pub moment: [f64; 3],
}

impl JobLoad {
    fn written(&self) -> String {
        let (body, point) = &self.on;
        let vector = |[x, y, z]: [f64; 3]| format!("({x:?}, {y:?}, {z:?})");
        let (force, moment) = (vector(self.force), vector(self.moment));
        format!("(on: ({body:?}, {point:?}), force: {force}, moment: {moment})")
    }

    fn list(loads: &[Self]) -> String {
        let loads: Vec<String> = loads.iter().map(Self::written).collect();
        format!("[{}]", loads.join(", "))
    }
}

/// The place of an argument that is written as it would stand in a file.
fn argument(name: &str, text: String, near: Option<&Arc<Source>>) -> Result<Place, LoadError> {
    let source = Source::argument(name, text, near);
    Fragment::of_file(&source).map(Fragment::place)
}

impl Job {
    /// A job of a mechanism in some poses, checked as that of a file. Mistakes name the argument they are
    /// about in place of a file: `poses.3.rx`, `mechanism.arm_length`.
    ///
    /// ```
    /// use hyperstat_mechanisms::{Job, JobLoad, JobMechanism, JobPoses, Registry, Value};
    ///
    /// let link = |diameter: f64| {
    ///     let material = "(young: 2.1e11, poisson: 0.3)";
    ///     Value::Text(format!("(section: Circle(diameter: {diameter:?}), material: {material})"))
    /// };
    /// let delta = JobMechanism::prebuilt("Delta", [
    ///     ("base_radius", 0.25.into()), ("platform_radius", 0.06.into()), ("arm_length", 0.30.into()),
    ///     ("rod_length", 0.60.into()), ("rod_spacing", 0.12.into()),
    ///     ("arm", link(0.030)), ("bar", link(0.020)), ("rod", link(0.014)),
    /// ]);
    /// let poses = JobPoses::list(&[[0.0, 0.0, 0.5], [0.1, -0.1, 0.55]]);
    /// let mut job = Job::new("sweep", delta, poses, &Registry::builtin())?;
    /// let on = ("platform".into(), "P".into());
    /// job.set_loads(&[JobLoad { on, force: [0.0, 0.0, -50.0], moment: [0.0; 3] }])?;
    /// job.set_vary(&[("rod.section.diameter", vec![0.012.into(), 0.014.into()])], false)?;
    /// assert_eq!((job.len(), job.designs()), (2, 2));
    /// let error = job.set_vary(&[("rod.diameter", vec![0.012.into()])], false).unwrap_err();
    /// assert_eq!(error.to_string(), "vary:1:8: `rod` has no `diameter`");
    /// # Ok::<(), hyperstat_mechanisms::LoadError>(())
    /// ```
    ///
    /// # Errors
    /// A name that could not be that of a job, an unknown kind of mechanism, and what is wrong with the
    /// mechanism or the poses.
    pub fn new(
        name: &str,
        mechanism: impl Into<JobMechanism>,
        poses: JobPoses,
        registry: &Registry,
    ) -> Result<Self, LoadError> {
        let place = argument("name", format!("{name:?}"), None)?;
        let name = job_name(Fragment::at(&place))?;
        let (root, recipe) = recipe(mechanism.into(), registry)?;
        let near = root.source.clone();
        let checked = recipe.read(recipe.root())?;
        let root_node = Node::whole(Fragment::at(&root));
        let mut written = vec![("mechanism", root_node)];
        let poses = asked(poses, &checked, &root, &near, &mut written)?;
        let fields = fields(&place, &written);
        Self::read(name, &fields, place.clone(), recipe, poses)
    }

    /// Sets a field of the job to what would stand there in a batch file: `loads`, `cases`, `gravity`,
    /// `masses`, `misfits`, `preloads`, `output`, `tool`, `modes`, `columns`, `figures`, `vary`, `zip` or `parameters`. What it had
    /// there is replaced; an empty text takes it away.
    ///
    /// # Errors
    /// An unknown field, what is wrong with its value. The job is then as it was.
    pub fn set(&mut self, field: &str, value: &str) -> Result<(), LoadError> {
        self.set_all(&[(field, value.into())], false)
    }

    /// The same by a value in JSON, in whatever form the mechanism is written.
    ///
    /// # Errors
    /// As [`Job::set`].
    pub fn set_json(&mut self, field: &str, value: &str) -> Result<(), LoadError> {
        self.set_all(&[(field, value.into())], true)
    }

    /// Gives it other poses. Its figures, which name poses, go.
    ///
    /// # Errors
    /// What is wrong with the poses. The job is then as it was.
    pub fn set_poses(&mut self, poses: JobPoses) -> Result<(), LoadError> {
        let mut written = self.written.clone();
        written.retain(|(field, _)| !["poses", "figures"].contains(field));
        let checked = self.recipe.read(self.recipe.root())?;
        let root = self.recipe.root().place();
        let near = Arc::clone(self.recipe.root().source());
        let poses = asked(poses, &checked, &root, &near, &mut written)?;
        self.reread(&written, self.recipe.clone(), poses, |job, own| {
            job.modes = own.modes.take();
        })
    }

    /// The job of one design alone, with other values in some places, named by their paths as `vary` names
    /// them. What else the job varies stays as it is in the design.
    ///
    /// # Errors
    /// A path that leads nowhere, what is wrong with the mechanism that the values make.
    ///
    /// # Panics
    /// If `design` is not below [`Job::designs`].
    pub fn with_values<P: AsRef<str>, V: Clone + Into<Value>>(
        &self,
        design: usize,
        values: &[(P, V)],
    ) -> Result<Self, LoadError> {
        // A parameter may be named with and without its map.
        let alone = |path: &str| path.trim_start_matches("parameters.").to_owned();
        let given = |path: &str| {
            let path = alone(path);
            values.iter().any(|(own, _)| alone(own.as_ref()) == path)
        };
        let of_design = self.values(design);
        let kept = self.varied().iter().zip(&of_design);
        let kept = kept.filter(|(varied, _)| !given(&varied.path));
        let kept = kept.map(|(varied, value)| (varied.path.as_str(), vec![value.clone()]));
        let new = values.iter();
        let new = new.map(|(path, value)| (path.as_ref(), vec![value.clone().into()]));
        let all: Vec<_> = kept.chain(new).collect();
        let mut job = self.clone();
        job.set_vary(&all, false)?;
        Ok(job)
    }

    /// The number that stands at a path, as `vary` names it, in a design \[SI\]: what an expression there
    /// comes to; of several places that the path names as one, at the first.
    ///
    /// # Errors
    /// A path that leads nowhere, or to what is no number.
    ///
    /// # Panics
    /// If `design` is not below [`Job::designs`].
    pub fn number_at(&self, design: usize, path: &str) -> Result<f64, LoadError> {
        assert!(design < self.designs(), "there is no design {design}");
        let source = Source::argument("vary", format!("{path:?}"), None);
        let key = Place::whole(&source);
        let places = self.recipe.places(Fragment::at(&key))?;
        let whole = match &self.designs {
            Some(designs) => designs.whole(design),
            None => self.recipe.whole(),
        };
        let settled = self.recipe.settled(&whole, &[]);
        let value = places.first().and_then(|steps| settled.find(steps));
        let value = value.ok_or_else(|| key.error(format!("`{path}` is no number")))?;
        Ok(Fragment::of_node(value).measured(None)?.0)
    }

    /// Sets the loads.
    ///
    /// # Errors
    /// A body or a point that the mechanism does not have, a number that is not finite. The job is then
    /// as it was.
    pub fn set_loads(&mut self, loads: &[JobLoad]) -> Result<(), LoadError> {
        self.set("loads", &JobLoad::list(loads))
    }

    /// Sets the load cases, by name.
    ///
    /// # Errors
    /// As [`Job::set_loads`]; a name that is empty, holds a `.` or is given twice.
    pub fn set_cases(&mut self, cases: &[(&str, Vec<JobLoad>)]) -> Result<(), LoadError> {
        let case =
            |(name, loads): &(&str, Vec<JobLoad>)| format!("{name:?}: {}", JobLoad::list(loads));
        let cases: Vec<String> = cases.iter().map(case).collect();
        self.set("cases", &format!("{{{}}}", cases.join(", ")))
    }

    /// Sets what varies from design to design: paths in the mechanism and the values of each, all
    /// combinations or, with `zip`, side by side. None at all: nothing varies.
    ///
    /// # Errors
    /// A path that leads nowhere, no values, and what `vary` in a file refuses. The job is then as it was.
    pub fn set_vary(&mut self, vary: &[(&str, Vec<Value>)], zip: bool) -> Result<(), LoadError> {
        let whole = self.recipe.whole();
        let axis = |(path, values): &(&str, Vec<Value>)| {
            let source = Source::argument("vary", format!("{path:?}"), None);
            let key = Place::whole(&source);
            let places = self.recipe.places(Fragment::at(&key)).unwrap_or_default();
            let old = places.first().and_then(|steps| whole.find(steps));
            let values: Vec<String> = values.iter().map(|value| value.written(old)).collect();
            for value in &values {
                // Each is one value, whatever stands in its text.
                Fragment::of_file(&Source::argument(path, value.clone(), None))?;
            }
            Ok(format!("{path:?}: [{}]", values.join(", ")))
        };
        let axes = vary
            .iter()
            .map(axis)
            .collect::<Result<Vec<String>, LoadError>>()?;
        let vary = match axes.is_empty() {
            true => String::new(),
            false => format!("{{ {} }}", axes.join(", ")),
        };
        let zip = if zip { "true" } else { "" };
        self.set_all(&[("vary", vary), ("zip", zip.into())], false)
    }

    /// Sets fields, or takes away those whose text is empty.
    fn set_all(&mut self, values: &[(&str, String)], json: bool) -> Result<(), LoadError> {
        let mut written = self.written.clone();
        let near = Arc::clone(self.recipe.root().source());
        for (field, text) in values {
            let mut known = JOB.names();
            known.retain(|known| !["name", "mechanism", "poses"].contains(known));
            let Some(&name) = known.iter().find(|known| *known == field) else {
                let whole = Place::whole(&Source::argument("field", String::new(), None));
                return Err(whole
                    .error(format!("unknown field `{field}` of a job"))
                    .with_help(names::help(field, "fields", known)));
            };
            written.retain(|(other, _)| *other != name);
            if !text.is_empty() {
                let source = match json {
                    true => Source::json_argument(name, text.clone(), Some(&near)),
                    false => Source::argument(name, text.clone(), Some(&near)),
                };
                let value = Fragment::of_file(&source)?.place();
                written.push((name, Scope::written(Fragment::at(&value))));
            }
        }
        let recipe = self.recipe.with_fields(&fields(&self.place, &written))?;
        let poses = Some(Arc::clone(&self.poses));
        // What a program has put there by itself stays.
        let set = |name: &str| values.iter().any(|(field, _)| *field == name);
        self.reread(&written, recipe, poses, |job, own| {
            if !set("modes") {
                job.modes = own.modes.take();
            }
            if !set("figures") {
                job.figures = std::mem::take(&mut own.figures);
                job.figure_places = std::mem::take(&mut own.figure_places);
            }
        })
    }

    /// Reads it again from these fields; `keep` takes over what does not follow from them.
    fn reread(
        &mut self,
        written: &[(&'static str, Node)],
        recipe: Recipe,
        poses: Option<Arc<Poses>>,
        keep: impl FnOnce(&mut Self, &mut Self),
    ) -> Result<(), LoadError> {
        let (name, place) = (self.name.clone(), self.place.clone());
        let mut job = Self::read(name, &fields(&place, written), place.clone(), recipe, poses)?;
        keep(&mut job, self);
        *self = job;
        Ok(())
    }
}

/// The poses that a program asks of a mechanism that stands at `root`; `None` where they are to be read from
/// the fields, to which they are then added.
fn asked(
    poses: JobPoses,
    checked: &Checked,
    root: &Place,
    near: &Arc<Source>,
    written: &mut Vec<(&'static str, Node)>,
) -> Result<Option<Arc<Poses>>, LoadError> {
    let poses = match poses {
        JobPoses::Own => checked.own_pose(root)?,
        JobPoses::Later => checked.no_pose(),
        JobPoses::Table { columns, rows } => {
            let at = |part: &str| {
                let name = match part {
                    "" => "poses".into(),
                    part => format!("poses.{part}"),
                };
                Place::whole(&Source::argument(&name, String::new(), None))
            };
            check_rows(&columns, &rows, at)?;
            checked.poses_of(&columns, &rows, &at(""), at)?
        }
        JobPoses::Written(text) => {
            let poses = argument("poses", text, Some(near))?;
            written.push(("poses", Scope::written(Fragment::at(&poses))));
            return Ok(None);
        }
    };
    Ok(Some(Arc::new(poses)))
}

/// Fields that stand at these places.
fn fields<'a>(whole: &'a Place, written: &'a [(&'static str, Node)]) -> Fields<'a> {
    let field = |(name, node): &'a (&'static str, Node)| (*name, Fragment::of_node(node));
    let written = written.iter().map(field).collect();
    Fields::of(Fragment::at(whole), "a job", written)
}

/// The recipe of a mechanism, and where it stands.
fn recipe(mechanism: JobMechanism, registry: &Registry) -> Result<(Place, Recipe), LoadError> {
    let none = Place::whole(&Source::argument("mechanism", String::new(), None));
    let none = fields(&none, &[]);
    match mechanism {
        JobMechanism::Loaded(mechanism) => {
            let root = mechanism.root();
            if mechanism.is_of_job() {
                let whole = Place::whole(&Source::argument("mechanism", String::new(), None));
                return Err(whole
                    .error("it is a job's, whose loads or masses are not those of its file")
                    .with_help("load the mechanism's file, and give the new job its loads"));
            }
            Ok((
                root.place(),
                Recipe::of(root.clone(), None, &none, registry),
            ))
        }
        JobMechanism::Written(text) => {
            let source = match json::is_json(&text) {
                true => Source::json_argument("mechanism", text, None),
                false => Source::argument("mechanism", text, None),
            };
            let whole = Fragment::of_file(&source)?;
            let (kind, _) = whole.variant("a prebuilt mechanism, such as `Delta(…)`")?;
            let Some(known) = registry.prebuilt(kind.text()) else {
                return Err(unknown_kind(&kind.place(), kind.text(), registry));
            };
            let recipe = Recipe::of(Node::of(whole), Some(known.clone()), &none, registry);
            Ok((whole.place(), recipe))
        }
        JobMechanism::Prebuilt { kind, parameters } => {
            let Some(known) = registry.prebuilt(&kind) else {
                let whole = Place::whole(&Source::argument("mechanism", kind.clone(), None));
                return Err(unknown_kind(&whole, &kind, registry));
            };
            let mut text = format!("{kind}(");
            let mut values = Vec::with_capacity(parameters.len());
            for (name, value) in &parameters {
                let argument = format!("mechanism.{name}");
                let value = Source::argument(&argument, value.written(None), None);
                values.push(Node::of(Fragment::of_file(&value)?));
                let value = value.text();
                text += &format!("\n    {name}: {value},");
            }
            let place = argument("mechanism", text + "\n)", None)?;
            let mut root = Node::at(&place);
            for (k, value) in values.into_iter().enumerate() {
                root.replace(&[k], value);
            }
            Ok((
                place,
                Recipe::of(root, Some(known.clone()), &none, registry),
            ))
        }
    }
}

/// The error of a kind of mechanism that is not registered.
fn unknown_kind(at: &Place, kind: &str, registry: &Registry) -> LoadError {
    at.error(format!("unknown mechanism `{kind}`"))
        .with_help(names::help(kind, "mechanisms", registry.prebuilts()))
}

/// Refuses rows of another length than that of the columns, and numbers that are not finite.
fn check_rows(
    columns: &[String],
    rows: &[f64],
    at: impl Fn(&str) -> Place,
) -> Result<(), LoadError> {
    if columns.is_empty() || !rows.len().is_multiple_of(columns.len()) {
        return Err(at("")
            .error(format!(
                "{} numbers are no rows of {} columns",
                rows.len(),
                columns.len()
            ))
            .with_help("give a number for every column of every pose"));
    }
    if rows.is_empty() {
        return Err(at("")
            .error("the list of poses is empty")
            .with_help("give at least one pose"));
    }
    match rows.iter().position(|number| !number.is_finite()) {
        None => Ok(()),
        Some(k) => {
            let (row, column) = (k / columns.len(), &columns[k % columns.len()]);
            Err(at(&format!("{row}.{column}"))
                .error(format!("`{}` is not a finite number", rows[k]))
                .with_help("give a number such as 0.25 or 2.1e11"))
        }
    }
}
