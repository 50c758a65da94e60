//! A batch: jobs, each a mechanism in one or many poses.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use hyperstat_model::{Geometry, ModalOptions, Model};

use super::columns::{self, Column};
use super::commanded::Commanded;
use super::design::{Design, Designs};
use super::figures::{Figure, Known};
use super::poses::Poses;
use super::subject::{Recipe, Subject};
use super::vary::{Variation, Varied};
use crate::error::{LoadError, Location};
use crate::file::mechanism::Mechanism;
use crate::file::registry::Registry;
use crate::job::{figures, modes, value_names};
use crate::prebuilt::PoseError;
use crate::terms::job::{BATCH, JOB};
use crate::text::dependence::{self, Dependence};
use crate::text::fields::Fields;
use crate::text::fragment::{Fragment, first_at};
use crate::text::scope::PARAMETERS;
use crate::text::source::Place;
use crate::text::tree::Node;
use crate::text::value::Value;

/// The jobs of a batch file, in its order, all of them checked.
#[derive(Debug)]
#[non_exhaustive]
pub struct Batch {
    /// The jobs, at least one; their names are unique.
    pub jobs: Vec<Job>,
}

/// One job: a mechanism, or many designs of one, its poses and the figures to draw.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Job {
    /// Name, the stem of its output files: ASCII letters, digits, `_`, `-` and `.`, not starting
    /// with `.`.
    pub name: String,
    /// Figures to draw, of the first design, in the order of the file.
    pub figures: Vec<Figure>,
    /// Natural frequencies to find at every pose.
    pub modes: Option<ModalOptions>,
    /// Columns of its table that it asks for, in their order.
    pub(super) columns: Vec<Column>,
    /// Where each of them stands.
    pub(super) column_places: Vec<Place>,
    /// Where its `modes` stand.
    pub(super) modes_place: Option<Place>,
    /// Where each figure stands.
    pub(super) figure_places: Vec<figures::Places>,
    /// What is written of it, by field.
    pub(super) written: Vec<(&'static str, Node)>,
    pub(super) recipe: Recipe,
    pub(super) poses: Arc<Poses>,
    /// Where `vary` is given.
    pub(super) designs: Option<Arc<Designs>>,
    /// Names of the cases.
    cases: Vec<String>,
    /// The first design that can be, and its number.
    first: Arc<Subject>,
    first_design: usize,
    pub(super) place: Place,
}

impl Batch {
    /// Reads the value of a batch file.
    pub(crate) fn read(fragment: Fragment<'_>, registry: &Registry) -> Result<Self, LoadError> {
        let fields = Fields::read(fragment, "the batch", &BATCH.names())?;
        let shared = fields.get(PARAMETERS).map(Node::of_map);
        let list = fields.required("jobs")?;
        let mut seen = HashMap::new();
        let mut jobs = Vec::new();
        for fragment in list.list("a list of jobs, `[(name: …, mechanism: …)]`")? {
            let fields = Fields::read(fragment, "a job", &JOB.names())?;
            let at = fields.required("name")?;
            let name = job_name(at)?;
            if let Some((first, other)) = seen.insert(name.to_lowercase(), (at, name.clone())) {
                return Err(same_name(at, &name, first, &other));
            }
            let recipe = Recipe::find(&fields, shared.as_ref(), registry)?;
            jobs.push(Job::read(name, &fields, at.place(), recipe, None)?);
        }
        if jobs.is_empty() {
            return Err(list
                .error("the batch has no jobs")
                .with_help("give at least one, `[(name: \"…\", mechanism: File(\"file.ron\"))]`"));
        }
        Ok(Self { jobs })
    }

    /// All files that were read for it: its own and those that its jobs name.
    pub fn files(&self) -> Vec<PathBuf> {
        let first = self.jobs.first();
        first.map_or_else(Vec::new, |job| job.place.source.files())
    }
}

/// The error of the name `at`, which makes the same files as the one `first`.
fn same_name(at: Fragment<'_>, name: &str, first: Fragment<'_>, other: &str) -> LoadError {
    if name == other {
        return at
            .error(format!("two jobs have the name `{name}`"))
            .with_help(first_at(first));
    }
    at.error(format!(
        "the names `{other}` and `{name}` differ only in case"
    ))
    .with_help("give one of them another name: some file systems take them for the same file")
}

/// Reads a name that can be the stem of a file's name.
pub(super) fn job_name(fragment: Fragment<'_>) -> Result<String, LoadError> {
    let name = fragment.string()?;
    let allowed = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    if name.is_empty() || name.starts_with('.') || !name.chars().all(allowed) {
        return Err(fragment
            .error(format!("`{name}` cannot be the name of a job"))
            .with_help(
                "a name is of the letters a to z and A to Z, digits, `_`, `-` and `.`, not starting \
                 with `.`",
            ));
    }
    Ok(name)
}

impl Job {
    /// Reads the fields of a job of this mechanism; its `poses` too, unless they are known.
    pub(super) fn read(
        name: String,
        fields: &Fields<'_>,
        place: Place,
        recipe: Recipe,
        poses: Option<Arc<Poses>>,
    ) -> Result<Self, LoadError> {
        let nodes = fields.written(&JOB.names());
        recipe.check_parameters(&nodes)?;
        let values = recipe.valued(&nodes)?;
        let given = values.as_ref().unwrap_or(&nodes).iter();
        let given = given.map(|(name, node)| (*name, Fragment::of_node(node)));
        let fields = &Fields::of(fields.whole(), fields.owner(), given.collect());
        let written = recipe.read(recipe.root())?;
        let poses = match poses {
            Some(poses) => poses,
            None => Arc::new(written.poses(fields)?),
        };
        let mut first = recipe.load(written, &poses, None)?;
        let cases = recipe.cases(&first)?;
        let figures = match fields.get("figures") {
            Some(list) => figures::read(
                list,
                &Known {
                    poses: poses.len(),
                    cases: &cases,
                },
            )?,
            None => Vec::new(),
        };
        let (figures, figure_places) = figures.into_iter().unzip();
        let modes_place = fields.get("modes").map(|modes| modes.place());
        let modes = fields.get("modes").map(modes::read).transpose()?;
        let has_modes = modes.is_some();
        let mut first_design = 0;
        let designs = match Variation::read(fields, &recipe, &nodes, poses.len())? {
            Some(variation) => {
                let designs = Designs::new(variation);
                (first_design, first) = designs.first(&recipe, &poses, &first)?;
                Some(Arc::new(designs))
            }
            None => None,
        };
        let columns = match fields.get("columns") {
            Some(list) => {
                let model = first.model().ok();
                let model = model.as_ref();
                columns::read(list, &columns::Known { model, has_modes })?
            }
            None => Vec::new(),
        };
        let (columns, column_places) = columns.into_iter().unzip();
        Ok(Self {
            name,
            columns,
            column_places,
            figures,
            figure_places,
            modes,
            modes_place,
            written: nodes,
            recipe,
            poses,
            designs,
            cases,
            first: Arc::new(first),
            first_design,
            place,
        })
    }

    /// Number of poses, at least 1; the same in every design.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.poses.len()
    }

    /// Number of designs, at least 1.
    pub fn designs(&self) -> usize {
        self.designs.as_ref().map_or(1, |designs| designs.len())
    }

    /// What varies from design to design, in the order of the file; nothing where `vary` is not
    /// given.
    pub fn varied(&self) -> &[Varied] {
        self.designs
            .as_ref()
            .map_or(&[], |designs| designs.varied())
    }

    /// Names of its cases, in their order; the same in every design.
    pub fn cases(&self) -> &[String] {
        &self.cases
    }

    /// Asks for no columns.
    pub fn leave_columns(&mut self) {
        self.columns.clear();
        self.column_places.clear();
    }

    /// Columns of its table that it asks for, in their order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Natural frequencies to find at every pose: those of its [`modes`](Self::modes), else those that
    /// its columns ask for.
    pub fn frequencies(&self) -> Option<&ModalOptions> {
        let asked = self.columns.iter().find_map(|column| match column {
            Column::Frequencies(options) => Some(options),
            _ => None,
        });
        self.modes.as_ref().or(asked)
    }

    /// Names `joint.direction` of the drives whose values its poses are, in the order of their table;
    /// none where its poses are those of the output.
    pub fn drives(&self) -> &[String] {
        self.poses.drives()
    }

    /// Values \[m, rad\] of these drives in a pose (from 0).
    ///
    /// # Panics
    /// If `pose` is not below [`Job::len`].
    pub fn drive_values(&self, pose: usize) -> &[f64] {
        self.poses.drive_values(pose)
    }

    /// Number of the first design that can be, of which figures are drawn: 0 unless its values make no
    /// mechanism. Some design always can be.
    pub fn first_design(&self) -> usize {
        self.first_design
    }

    /// The varied values of a design, which need not be one that can be; none where nothing varies.
    ///
    /// # Panics
    /// If `number` is not below [`Job::designs`].
    pub fn values(&self, number: usize) -> Vec<Value> {
        assert!(number < self.designs(), "there is no design {number}");
        let designs = self.designs.as_ref();
        designs.map_or_else(Vec::new, |designs| designs.values(number))
    }

    /// One of the designs, from 0.
    ///
    /// # Errors
    /// The mistake in a mechanism that the varied values make, at the value that is to blame.
    ///
    /// # Panics
    /// If `number` is not below [`Job::designs`].
    pub fn design(&self, number: usize) -> Result<Design, LoadError> {
        assert!(number < self.designs(), "there is no design {number}");
        let subject = match &self.designs {
            Some(designs) if number != self.first_design => {
                let subject = designs.load(number, &self.recipe, &self.poses, &self.first)?;
                Arc::new(subject)
            }
            _ => Arc::clone(&self.first),
        };
        Ok(Design {
            number,
            values: self.values(number),
            subject,
            poses: Arc::clone(&self.poses),
        })
    }

    /// Names the values of a design's model by their paths in the job's mechanism, as `vary` takes
    /// them ([`Model::name_value`]): of a file as [`Mechanism::name_values`], of a prebuilt one those
    /// that stand in the model as they are written.
    pub fn name_values(&self, design: &Design, model: &mut Model) {
        let (varied, tree) = match &self.designs {
            Some(designs) => (designs.steps(), &designs.tree(design.number, &self.recipe)),
            None => (Vec::new(), self.recipe.root()),
        };
        match design.mechanism() {
            Some(mechanism) => mechanism.name_others(&varied, model),
            None => value_names::of_prebuilt(tree, &varied, &design.subject, model),
        }
    }

    /// The parameters of the mechanism in a design, those of the job among them, and what depends on each.
    pub fn dependences(&self, design: &Design) -> Vec<Dependence> {
        match &self.designs {
            Some(designs) => self
                .recipe
                .dependences(&designs.tree(design.number, &self.recipe)),
            None => self.recipe.dependences(self.recipe.root()),
        }
    }

    /// The numbers that say where the parts of a design's mechanism stand and how long they are, such as
    /// `arm_length` and `points.A.0`, by their paths as `vary` names them, SI; without those that expressions give.
    pub fn placing(&self, design: &Design) -> Vec<(String, f64)> {
        match &self.designs {
            Some(designs) => dependence::placing(&designs.tree(design.number, &self.recipe)),
            None => dependence::placing(self.recipe.root()),
        }
    }

    /// Place of the job's name in the batch file.
    pub fn location(&self) -> Location {
        self.place.location()
    }

    /// Place of a field of a figure in the batch file, by the figure's number from 0: of the first of these that is
    /// given, else of `value`, of a figure without one its own, and the job's where there is no such figure.
    pub fn figure_location(&self, number: usize, fields: &[&str]) -> Location {
        let places = self.figure_places.get(number);
        let place = places.map_or(&self.place, |places| places.of(fields));
        place.location()
    }

    /// Place in the batch file of a column that it asks for, by its number among them, from 0; the job's
    /// where there is none.
    pub fn column_location(&self, number: usize) -> Location {
        let place = self.column_places.get(number);
        place.unwrap_or(&self.place).location()
    }

    /// Place in the batch file of what asks for masses: of its `modes`, else of the first column or figure that
    /// does; the job's where nothing does.
    pub fn masses_location(&self) -> Location {
        let needs = |column: &Column| matches!(column, Column::Mass | Column::Frequencies(_));
        let column = self.columns.iter().position(needs);
        let column = column.and_then(|number| self.column_places.get(number));
        if let Some(place) = self.modes_place.as_ref().or(column) {
            return place.location();
        }
        let is_mode = |figure: &Figure| matches!(figure, Figure::Mode { .. });
        match self.figures.iter().position(is_mode) {
            Some(number) => self.figure_location(number, &[]),
            None => self.location(),
        }
    }

    /// The coordinates that its poses give, each with a value for every pose, in any order: of the
    /// output's pose, in the order x y z rx ry rz, or of drives. What is not among them follows
    /// from the mechanism. None where the job has no poses.
    pub fn commanded(&self) -> Vec<Commanded> {
        self.poses.commanded(&self.first)
    }

    /// The coordinates that a pose (from 0) gives, each with its value: those of
    /// [`Job::commanded`], in its order.
    ///
    /// # Panics
    /// If `pose` is not below [`Job::len`].
    pub fn given(&self, pose: usize) -> Vec<(String, f64)> {
        self.poses.given(&self.first, pose)
    }

    /// [`Design::model`] of the first design that can be.
    ///
    /// # Errors
    /// As there.
    pub fn model(&self) -> Result<Model, PoseError> {
        self.first.model()
    }

    /// [`Design::place`] of the first design that can be.
    ///
    /// # Errors
    /// As there.
    pub fn place(&self, pose: usize, geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        self.first.place(&self.poses, pose, geometry)
    }

    /// What is known of a pose (from 0) of any design before it is reached, x y z \[m\] and rotation
    /// vector \[rad\]: the numbers given, and what is zero in every pose of the mechanism; `None` of the
    /// rest.
    ///
    /// # Panics
    /// If `pose` is not below [`Job::len`].
    pub fn target(&self, pose: usize) -> [Option<f64>; 6] {
        self.first.target(&self.poses, pose)
    }

    /// [`Design::mechanism`] of the first design that can be.
    pub fn mechanism(&self) -> Option<&Mechanism> {
        self.first.mechanism()
    }
}
