//! What was read is posed, planned and solved: small models only.

use std::path::Path;

use hyperstat_assembly::measures::Measures;
use hyperstat_assembly::{
    BodyId, Budget, LANES, ModalOptions, ModalPlan, Model, Prepared, SegmentId, Solution, analyse,
    describe_motions, modes, redundant_constraints,
};
use hyperstat_closure::{Drive, LoopClosure, Target};
use hyperstat_mechanisms::{Design, Disk, Input, Job, Registry, load_str};
use nalgebra::Vector6;

/// Most nodes, joints, sets of loads and elements of a model that is solved.
const SMALL: usize = 60;
/// Most elements of a model that the dense solver is given, and whose modes are found.
const SMALLER: usize = 24;
/// Jobs of a batch, and designs of a job, that are followed.
const FOLLOWED: usize = 2;

/// Reads a text that stands at `path` and goes on with what was read. Whatever comes out must be
/// finite numbers or an error.
pub fn solve(text: &str, path: &Path) -> bool {
    let input = load_str(text, path, &Disk, &Registry::builtin());
    if let Ok(input) = &input {
        follow(input);
    }
    input.is_ok()
}

/// Goes on with what was read.
pub(super) fn follow(input: &Input) {
    match input {
        Input::Mechanism(mechanism) => {
            moved(&mechanism.model);
            solved(&mechanism.model);
        }
        Input::Batch(batch) => batch.jobs.iter().take(FOLLOWED).for_each(posed),
    }
}

fn is_below(most: usize, model: &Model) -> bool {
    let elements = model.segments().iter().map(|segment| segment.elements);
    let elements = elements.fold(0, usize::saturating_add);
    let counts = [
        model.nodes().len(),
        model.joints().len(),
        model.loads().len() + model.cases().len(),
        elements,
    ];
    counts.into_iter().all(|count| count <= most)
}

/// A job in some of its designs and poses, as a sweep takes them.
fn posed(job: &Job) {
    let mut first = None;
    for number in [0, job.designs() - 1].into_iter().take(FOLLOWED) {
        let Ok(design) = job.design(number) else {
            continue;
        };
        let Ok(mut model) = design.model() else {
            continue;
        };
        if !is_below(SMALL, &model) {
            return;
        }
        let prepared = match &first {
            None => Ok(Prepared::new(model.clone())),
            Some(first) => Prepared::for_design(first, model.clone()),
        };
        let Ok(prepared) = prepared else { continue };
        if prepared.unknowns().is_err() {
            continue;
        }
        swept(&design, &prepared, &mut model, job.modes.as_ref());
        solved(&model);
        first.get_or_insert(prepared);
        if job.designs() == 1 {
            return;
        }
    }
}

/// The first poses and the last of a design, side by side; leaves the model in the last of them that
/// was reached.
fn swept(design: &Design, prepared: &Prepared, model: &mut Model, options: Option<&ModalOptions>) {
    let mut lanes = prepared.lanes().expect("a plan");
    let mut filled = [false; LANES];
    let mut reached = None;
    for (lane, filled) in filled.iter_mut().enumerate() {
        let pose = if lane + 1 == LANES {
            design.len() - 1
        } else {
            lane
        };
        if pose < design.len() {
            match design.place(pose, lanes.geometry_mut(lane)) {
                Ok(pose) => {
                    assert!(pose.iter().all(|v| v.is_finite()), "a pose of {pose:?}");
                    reached = Some(lane);
                    *filled = true;
                }
                Err(error) => assert!(!error.to_string().is_empty()),
            }
        }
    }
    for found in prepared
        .sweep_lanes(&mut lanes, filled)
        .into_iter()
        .flatten()
    {
        match found {
            Ok(found) => {
                let numbers = found.stiffness.iter().flat_map(|k| k.iter());
                let moved = found.displacement.iter().chain(&found.cases).flatten();
                assert!(numbers.chain(moved).all(|v| v.is_finite()), "{found:?}");
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    if let Some(lane) = reached {
        model
            .set_geometry(lanes.geometry_mut(lane).clone())
            .expect("its own");
    }
    if let Some(options) = options.filter(|options| options.count <= SMALLER)
        && is_below(SMALLER, model)
        && let Ok(plan) = ModalPlan::new(model, options)
        && let Ok(found) = plan.frequencies(model.geometry())
    {
        assert!(found.iter().all(|f| f.is_finite()), "{found:?}");
    }
}

/// A mechanism of a file moved a little: its output, and each of its drives.
fn moved(model: &Model) {
    if !is_below(SMALL, model) {
        return;
    }
    let Ok(closure) = LoopClosure::new(model) else {
        return;
    };
    let home = closure.home();
    let Some(output) = model.output() else {
        return;
    };
    let at = model.geometry().positions[output.0];
    let asked = [at.x + 1e-3, at.y, at.z, 0.0, 0.0, 0.0].map(Some);
    let drives: Vec<_> = closure.drives().take(FOLLOWED).collect();
    let drives = drives.into_iter().map(|(joint, direction)| Drive {
        joint,
        direction,
        value: 1e-2,
    });
    let drives: Vec<_> = drives.collect();
    for target in [Target::Output(asked), Target::Drives(&drives)] {
        let mut geometry = model.geometry().clone();
        let Ok(reached) = closure.reach(&home, &target) else {
            continue;
        };
        if closure.write(&reached, &mut geometry).is_ok() {
            let mut numbers = geometry.positions.iter().flat_map(|p| p.iter());
            assert!(numbers.all(|v| v.is_finite()), "{target:?}");
        }
    }
}

/// All that `solve --why --modes --verify` finds.
fn solved(model: &Model) {
    if !is_below(SMALL, model) {
        return;
    }
    if let Ok(kinematics) = analyse(model) {
        describe_motions(&kinematics.motions, model);
    }
    for redundancy in redundant_constraints(model) {
        redundancy.names(model);
    }
    let solution = match hyperstat_assembly::solve(model) {
        Ok(solution) => solution,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    let cases = model.cases().iter().take(FOLLOWED);
    let loaded = cases.filter_map(|case| solution.of_case(&case.name));
    for solution in loaded.chain([solution.clone()]) {
        check(model, &solution);
        explained(model, &solution);
    }
    if is_below(SMALLER, model) {
        if let Ok(theirs) = hyperstat_reference::solve(model) {
            let numbers = theirs.stiffness.iter().chain(&theirs.compliance);
            assert!(numbers.flat_map(|k| k.iter()).all(|v| v.is_finite()));
        }
        vibrating(model);
    }
}

/// Every number of a solution is finite.
fn check(model: &Model, solution: &Solution) {
    let output = &solution.output;
    let matrices = output.stiffness.iter().chain(&output.compliance);
    let wrenches = solution.joint_wrenches.iter().flatten();
    let forces = solution.segments.iter().flat_map(|s| &s.ends);
    let vectors = (output.rigid_directions.iter())
        .chain(&output.free_motions)
        .chain(&solution.displacements)
        .chain(wrenches)
        .chain(forces)
        .chain([&output.displacement]);
    let numbers = matrices.flat_map(|k| k.iter());
    let mut numbers = numbers.chain(vectors.flat_map(|v| v.iter()));
    assert!(numbers.all(|v| v.is_finite()), "{solution:?}");
    for warning in &solution.warnings {
        assert!(!warning.to_string().is_empty());
    }
    describe_motions(&solution.idle, model);
    for body in 0..model.bodies().len() {
        solution.worst_point(model, BodyId(body));
    }
    for (k, segment) in model.segments().iter().enumerate() {
        if let Ok(inner) = solution.inner_displacements(model, SegmentId(k)) {
            assert_eq!(inner.len(), segment.elements - 1);
        }
    }
}

/// Why the output gives.
fn explained(model: &Model, solution: &Solution) {
    let output = &solution.output;
    let Some(compliance) = &output.compliance else {
        return;
    };
    let along = Budget::direction_of(&output.displacement).unwrap_or(Vector6::ith(2, 1.0));
    let node = model.output().expect("it was solved");
    if let Some(stiffness) = &output.stiffness {
        let at = model.geometry().positions[node.0];
        Measures::new(stiffness, compliance, &at, None);
    }
    let prepared = Prepared::new(model.clone());
    let Ok(influence) = prepared.here().influence() else {
        return;
    };
    influence.budget(solution, &along).by_source();
    influence
        .compliance_budget(compliance, &along)
        .by_deformation();
    influence.misfit_effects(&along);
    if let Ok(found) = influence.sensitivities(solution) {
        for sensitivity in &found {
            sensitivity.relative(&output.displacement, &along);
        }
    }
}

/// Natural frequencies and what changes them.
fn vibrating(model: &Model) {
    let options = ModalOptions::lowest(3);
    if let Ok(found) = modes(model, &options) {
        for mode in &found.modes {
            let numbers = mode.displacements.iter().flat_map(|v| v.iter());
            let mut numbers = numbers.chain([&mode.frequency]);
            assert!(numbers.all(|v| v.is_finite()), "{mode:?}");
        }
        if let Ok(plan) = ModalPlan::new(model, &options) {
            let _ = plan.sensitivities(model.geometry());
        }
    }
}
