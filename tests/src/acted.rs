//! A mechanism under each kind of what acts.

use hyperstat_assembly::{
    Axes, BodyId, JointId, JointStiffness, LineLoad, Load, LoadCase, LoadSet, Model, NodeId,
    SegmentId,
};
use nalgebra::{Vector3, Vector6};

/// The model as it is, and with each kind of what acts beside its own loads, by its name; kinds that
/// its joints have no place for are left out. Its materials have densities and expansions.
///
/// # Panics
/// Where they have none.
pub fn acted_on(model: &Model) -> Vec<(&'static str, Model)> {
    let mut all = vec![("a force", model.clone())];
    let mut add = |name, change: &dyn Fn(&mut Model) -> bool| {
        let mut own = model.clone();
        if change(&mut own) {
            all.push((name, own));
        }
    };
    add("weight", &weigh);
    add("temperatures", &heat);
    add("a load along a beam", &|model| {
        let ends = [Vector6::new(0.0, 30.0, -50.0, 0.0, 0.0, 0.0); 2];
        load_along(model, ends, Axes::Global);
        true
    });
    add("axes that turn", &|model| {
        let segment = SegmentId(model.segments().len() / 2);
        let body = model.segments()[segment.0].body;
        let Some(home) = model.body_frame(body) else {
            return false;
        };
        let mut set = model.load_set().clone();
        set.nodes.push(Load {
            node: model.segments()[segment.0].ends[0],
            wrench: Vector6::new(5.0, -20.0, 40.0, 0.0, 0.0, 0.0),
            axes: Axes::Body { body, home },
        });
        model.set_loads(set).expect("a load");
        true
    });
    add("misfits", &misfit);
    add("preloads", &preload);
    add("one load case", &|model| add_cases(model, 1));
    add("ten load cases", &|model| add_cases(model, 10));
    add("weight, temperatures and three cases", &|model| {
        weigh(model) && heat(model) && add_cases(model, 3)
    });
    all
}

fn weigh(model: &mut Model) -> bool {
    let down = Vector3::new(0.3, -0.2, -9.81);
    model.set_gravity(down).expect("densities");
    true
}

fn heat(model: &mut Model) -> bool {
    for body in 0..model.bodies().len() {
        // Rigid and flexible bodies have no temperature.
        let change = 10.0 + body as f64;
        let _ = model.set_temperature(BodyId(body), change);
    }
    true
}

fn load_along(model: &mut Model, ends: [Vector6<f64>; 2], axes: Axes) {
    let segment = SegmentId(model.segments().len() / 2);
    let mut set = model.load_set().clone();
    set.lines.push(LineLoad {
        segment,
        ends,
        axes,
    });
    model.set_loads(set).expect("a load");
}

/// Every third joint stands off along its first direction that is not free.
fn misfit(model: &mut Model) -> bool {
    for joint in (0..model.joints().len()).step_by(3) {
        for k in 0..6 {
            let mut misfit = Vector6::zeros();
            misfit[k] = 1e-4 * (1.0 + joint as f64);
            // Free directions have none.
            if model.set_misfit(JointId(joint), &misfit).is_ok() {
                break;
            }
        }
    }
    true
}

/// Every second joint is pressed together along its first elastic direction.
fn preload(model: &mut Model) -> bool {
    let mut any = false;
    for joint in (0..model.joints().len()).step_by(2) {
        let JointStiffness::Directions(stiffness) = &model.joints()[joint].stiffness else {
            continue;
        };
        if let Some(k) = stiffness.iter().position(Option::is_some) {
            let mut preload = Vector6::zeros();
            preload[k] = 50.0 + joint as f64;
            let set = model.set_preload(JointId(joint), &preload);
            set.expect("a preload");
            any = true;
        }
    }
    any
}

/// Cases on the output.
fn add_cases(model: &mut Model, count: usize) -> bool {
    let output: NodeId = model.output().expect("an output");
    for case in 0..count {
        let size = 10.0 + case as f64;
        let wrench = Vector6::new(size, -2.0 * size, 50.0, 1.0, -size, 2.0);
        let case = LoadCase {
            name: format!("case {case}"),
            loads: LoadSet::on(output, wrench),
        };
        model.add_case(case).expect("a new name");
    }
    true
}
