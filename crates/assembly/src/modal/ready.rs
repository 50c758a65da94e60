//! A topology with the members of its segments, made ready for natural frequencies.

use hyperstat_elements::rotate_vector6;
use hyperstat_model::{Geometry, ModalOptions, Model, NodeId, SegmentId};
use nalgebra::{Rotation3, Vector3, Vector6};

use crate::error::SolveError;
use crate::kinematics::diagnosis::Diagnosis;
use crate::modal::lanczos::lowest;
use crate::modal::mass::{MassPlan, Masses};
use crate::modal::member::Members;
use crate::modal::mode::Counted;
use crate::modal::quick::Quick;
use crate::modal::shape::{Curve, Part};
use crate::modal::system::{EQUAL, Mode, System, equal};
use crate::plan::Plan;
use crate::plan::fault::Fault;
use crate::plan::workspace::Workspace;
use crate::pose::form;
use crate::pose::restraint::Restraint;
use crate::posture::Posture;
use crate::room;
use crate::room::MOST_NUMBERS;

/// Members are right up to this factor of the highest ω² that was wanted where they were made.
const MARGIN: f64 = 2.0;
/// The factor where even fewer modes were found than are wanted: waves of half the length.
const FINER: f64 = 16.0;

/// Share of the mass below which modes take no part in a motion of the ground.
const SHARE: f64 = 1e-12;

/// Where the coordinates are, and where the masses.
#[derive(Debug)]
pub(super) struct Ready {
    /// The model with the parts of its segments.
    pub divided: Model,
    pub members: Members,
    pub plan: Plan,
    pub masses: MassPlan,
    /// Modes of the configuration that it was made for: near those of others.
    start: Vec<Vec<f64>>,
    /// The quick way to frequencies alone, where there is one.
    quick: Option<Quick>,
}

/// What was found in a configuration, and from what.
pub(super) struct Outcome<'a> {
    pub ready: &'a Ready,
    pub workspace: Workspace,
    /// Of the divided model.
    pub geometry: Geometry,
    pub masses: Masses,
    pub modes: Vec<Mode>,
    pub idle: usize,
    pub complete: bool,
    /// How many eigenvalues are below which ω².
    pub counted: Option<Counted>,
}

impl Ready {
    /// Of a model in a configuration; for exact masses right up to `limit`, or without one up to where
    /// no segment is divided.
    pub fn new(
        model: &Model,
        geometry: &Geometry,
        options: &ModalOptions,
        limit: Option<f64>,
    ) -> Result<Self, SolveError> {
        let members = Members::new(model, geometry, options, limit)?;
        let divided = model.divided(&members.parts)?;
        let geometry = model.divided_geometry(geometry, &members.parts)?;
        let at = Posture::new(&divided, &geometry);
        let plan = Plan::absorbing(&at, false, &Diagnosis::default())?;
        let masses = MassPlan::new(&plan, &divided)?;
        let inner = members.all.iter().map(|m| m.inner.squares().len());
        let size = plan.unknowns + inner.sum::<usize>();
        let numbers = room::matrix(options.count.min(size), size);
        room::check("its natural modes", numbers, MOST_NUMBERS)?;
        Ok(Self {
            divided,
            members,
            plan,
            masses,
            start: Vec::new(),
            quick: None,
        })
    }

    /// Begins with the modes of a configuration, which it was made for, wherever frequencies alone are
    /// looked for.
    pub fn begin_with(&mut self, model: &Model, geometry: &Geometry, count: usize) {
        let found = self.find(model, geometry, count, false).ok();
        let modes = found.map(|found| found.modes).unwrap_or_default();
        let wanted: Vec<f64> = modes.iter().map(|mode| mode.eigenvalue).collect();
        if wanted.len() == count {
            self.quick = Quick::new(&self.plan, &self.divided, &self.members, &wanted);
        }
        self.start = modes.into_iter().map(|mode| mode.vector).collect();
    }

    /// The lowest ω² of a configuration of `model` by the quick way; `None` where [`Ready::find`] has to
    /// find them.
    pub fn squares(&self, model: &Model, geometry: &Geometry) -> Option<Vec<f64>> {
        let quick = self.quick.as_ref()?;
        model.check_geometry(geometry, self.plan.one_point).ok()?;
        if !self.members.fit(model, geometry) {
            return None;
        }
        let parts = &self.members.parts;
        if parts.iter().all(|count| *count == 1) {
            return quick.squares(&self.plan, &self.divided, geometry);
        }
        let geometry = model.divided_geometry(geometry, parts).ok()?;
        quick.squares(&self.plan, &self.divided, &geometry)
    }

    /// Up to which ω² it is right.
    pub fn limit(&self) -> f64 {
        self.members.limit
    }

    /// Finds the `count` lowest modes of a configuration of `model`, whose topology this is; `shapes` finds
    /// vectors to rounding, and looks for motions without energy even where the plan's own configuration
    /// has none. Without, only eigenvalues are right to rounding.
    pub fn find(
        &self,
        model: &Model,
        geometry: &Geometry,
        count: usize,
        shapes: bool,
    ) -> Result<Outcome<'_>, Fault> {
        let (plan, members) = (&self.plan, &self.members);
        model
            .check_geometry(geometry, plan.one_point)
            .map_err(SolveError::from)?;
        if !members.fit(model, geometry) {
            return Err(Fault::Changed);
        }
        let geometry = model.divided_geometry(geometry, &members.parts)?;
        let at = Posture::new(&self.divided, &geometry);
        let mut workspace = plan.workspace();
        form(plan, &at, &mut workspace)?;
        let masses = self.masses.elements(plan, &at, &workspace, members)?;
        if masses.total <= 0.0 {
            return Err(SolveError::NoMass.into());
        }
        let system = |restraint: Option<&Restraint>| {
            let restraint = restraint.map(|r| (r, &at));
            System::new(plan, &workspace, &self.masses, &masses, restraint)
        };
        let held = (!shapes && !plan.has_idle).then(|| system(None));
        let mut system = match held {
            Some(Ok(system)) => system,
            _ => system(Some(&Restraint::of(&at, plan.output)?))?,
        };
        let mut modes: Vec<Mode> = system.moving().take(count).map(Mode::at_rest).collect();
        let (mut complete, mut counted) = (true, None);
        if modes.len() < count {
            let wanted = count - modes.len();
            // Exact masses have no such ends that only elements divide, and most often no need of refinement.
            let exact = members.limit < f64::INFINITY;
            let quick = match shapes || !exact {
                true => None,
                false => lowest(&mut system, wanted, false, &self.start).ok(),
            };
            let quick = quick.filter(|found| found.complete && system.settled(&found.modes));
            let elastic = match quick {
                Some(found) => found,
                None => lowest(&mut system, wanted, true, &[])?,
            };
            complete = elastic.complete;
            let at_rest = modes.len();
            counted = elastic.counted.map(|counted| Counted {
                modes: counted.modes + at_rest,
                found: counted.found + at_rest,
                ..counted
            });
            modes.extend(elastic.modes);
        }
        let idle = system.idle;
        Ok(Outcome {
            ready: self,
            workspace,
            geometry,
            masses,
            modes,
            idle,
            complete,
            counted,
        })
    }
}

impl Outcome<'_> {
    /// The highest ω² that was looked at.
    fn top(&self) -> f64 {
        let last = self.modes.last().map_or(0.0, |mode| mode.eigenvalue);
        self.counted.map_or(last, |counted| counted.below.max(last))
    }

    /// Whether the members are fine enough for what was found, where `count` modes are wanted.
    pub fn is_resolved(&self, count: usize) -> bool {
        let limit = self.ready.limit();
        limit == f64::INFINITY || (self.modes.len() >= count && self.top() <= limit)
    }

    /// Up to which ω² members should be right for `count` modes.
    pub fn wanted(&self, count: usize) -> f64 {
        let (limit, top) = (self.ready.limit(), self.top());
        match self.modes.len() < count {
            _ if limit == f64::INFINITY => limit,
            true => FINER * limit.max(top),
            false if top > 0.0 => MARGIN * top,
            false => limit,
        }
    }

    /// Turns modes of equal frequency, of which any combination is as good, to what the ground shakes:
    /// of those that take part in a motion along x one takes all of it, of the others one takes all along
    /// y, and so on. So they are the same wherever they are found.
    pub fn align(&mut self, bodies: usize) {
        let least = SHARE * self.masses.total;
        for group in equal(&self.modes, EQUAL) {
            let (mut next, end) = (group.start, group.end);
            for axis in 0..if group.len() > 1 { 3 } else { 0 } {
                let taken = self.modes[next..end].iter();
                let mut taken: Vec<f64> = taken.map(|m| self.shares(bodies, m).0[axis]).collect();
                if taken.iter().map(|share| share * share).sum::<f64>() <= least {
                    continue;
                }
                for other in 1..taken.len() {
                    let length = taken[0].hypot(taken[other]);
                    if length == 0.0 {
                        continue;
                    }
                    let (c, s) = (taken[0] / length, taken[other] / length);
                    let (head, tail) = self.modes.split_at_mut(next + other);
                    let (own, other_mode) = (&mut head[next].vector, &mut tail[0].vector);
                    for (a, b) in own.iter_mut().zip(other_mode) {
                        (*a, *b) = (c * *a + s * *b, c * *b - s * *a);
                    }
                    taken[0] = length;
                }
                next += 1;
            }
        }
    }

    /// Displacement of a node.
    pub fn displacement(&self, node: NodeId, found: &Mode) -> Vector6<f64> {
        let (plan, workspace) = (&self.ready.plan, &self.workspace);
        let masses = &self.ready.masses;
        masses.displacement(plan, workspace, &self.geometry, node, &found.vector)
    }

    /// What every segment of the model does along it.
    pub fn curves(&self, found: &Mode) -> Vec<Curve> {
        let (divided, members) = (&self.ready.divided, &self.ready.members);
        let at = Posture::new(divided, &self.geometry);
        let mut parts = members.all.iter().enumerate().map(|(k, member)| {
            let frame = at.segment_frame(SegmentId(k)).unwrap_or_default().inverse();
            let ends = divided.segments()[k].ends;
            Part {
                member: member.clone(),
                ends: ends.map(|node| rotate_vector6(&self.displacement(node, found), &frame)),
                amounts: self.masses.amounts(k, &found.vector).to_vec(),
            }
        });
        let counts = members.parts.iter();
        counts
            .map(|count| Curve(parts.by_ref().take(*count).collect()))
            .collect()
    }

    /// The frames of the model's segments.
    pub fn frames<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = Rotation3<f64>> + 'a {
        let at = Posture::new(&self.ready.divided, &self.geometry);
        let parts = self.ready.members.parts.iter().zip(model.segments());
        let mut first = 0;
        parts.map(move |(count, _)| {
            let id = SegmentId(first);
            first += count;
            at.segment_frame(id).unwrap_or_default()
        })
    }

    /// Participation in translations, and the kinetic energy of every body.
    pub fn shares(&self, bodies: usize, found: &Mode) -> (Vector3<f64>, Vec<f64>) {
        let masses = &self.ready.masses;
        masses.shares(&self.masses, bodies, &found.vector)
    }
}
