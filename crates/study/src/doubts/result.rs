//! What a solution tells: displacements beyond a linear model, stresses beyond what a material bears.

use hyperstat_assembly::{BodyId, Model, NodeId, Solution, WorstPoint};
use nalgebra::Vector6;

use super::{number, size};

/// Displacements above this share of a mechanism's size are beyond a linear model.
const MOVED: f64 = 0.05;

/// Rotations above this \[rad\] are, too.
const TURNED: f64 = 0.1;

/// Utilisation above which nobody doubts the strength, but its unit.
const STRENGTH_IN_MPA: f64 = 1e4;

/// The largest value of a kind, and where it is.
#[derive(Debug, Clone)]
struct Largest {
    value: f64,
    /// What has it, in words.
    of: String,
    /// Where or when, in words, with a space before; or nothing.
    at: String,
}

/// The largest values of a mechanism's states.
#[derive(Debug)]
pub(super) struct Findings {
    /// Diagonal of the box around the mechanism's points \[m\].
    size: f64,
    moved: Option<Largest>,
    turned: Option<Largest>,
    used: Option<Largest>,
}

/// What is hardly as it was meant in a solution, a sentence each.
pub fn of_solution(model: &Model, solution: &Solution) -> Vec<String> {
    let mut findings = Findings::of(model);
    findings.add(model, solution, "");
    findings.in_words()
}

impl Findings {
    /// Of a model of which nothing is solved yet.
    pub(super) fn of(model: &Model) -> Self {
        Self {
            size: size(model),
            moved: None,
            turned: None,
            used: None,
        }
    }

    /// Adds all states of a solution; `at` says which it is, with a space before, or nothing.
    pub(super) fn add(&mut self, model: &Model, solution: &Solution, at: &str) {
        // Where an idle body is, the solution does not say.
        let mut idle = vec![false; model.bodies().len()];
        for (body, _) in solution.idle.iter().flat_map(|motion| &motion.twists) {
            idle[body.0] = true;
        }
        self.add_state(model, &idle, &solution.displacements, at, |body| {
            solution.worst_point(model, body)
        });
        for case in &solution.cases {
            let at = format!(" under the loads of case `{}`{at}", case.name);
            let state = &case.state;
            self.add_state(model, &idle, &state.displacements, &at, |body| {
                state.worst_point(model, body)
            });
        }
    }

    fn add_state(
        &mut self,
        model: &Model,
        idle: &[bool],
        displacements: &[Vector6<f64>],
        at: &str,
        worst: impl Fn(BodyId) -> Option<WorstPoint>,
    ) {
        for (node, displacement) in displacements.iter().enumerate() {
            if !idle[model.nodes()[node].body.0] {
                let name = || format!("`{}`", model.node_name(NodeId(node)));
                self.displaced(displacement, name, at);
            }
        }
        for (body, name) in model.bodies().iter().map(|body| &body.name).enumerate() {
            let utilisation = worst(BodyId(body)).and_then(|point| point.utilisation);
            if let Some(value) = utilisation {
                keep(&mut self.used, value, || format!("`{name}`"), at);
            }
        }
    }

    /// Adds a displacement of what `name` says.
    pub(super) fn displaced(
        &mut self,
        displacement: &Vector6<f64>,
        name: impl Fn() -> String,
        at: &str,
    ) {
        let norm = |first: usize| displacement.fixed_rows::<3>(first).norm();
        keep(&mut self.moved, norm(0), &name, at);
        keep(&mut self.turned, norm(3), &name, at);
    }

    /// What is too much, a sentence each.
    pub(super) fn in_words(&self) -> Vec<String> {
        const LOOK: &str = "this is beyond a linear model: are all forces in N, stiffnesses in N/m or \
                            N·m/rad, and is every drive locked?";
        let mut told = Vec::new();
        // A mechanism of one point has no size to compare with, and is taken as one of 1 m.
        let size = if self.size > 0.0 { self.size } else { 1.0 };
        let moved = self.moved.as_ref();
        if let Some(Largest { value, of, at }) = moved.filter(|m| m.value > MOVED * size) {
            let share = match self.size > 0.0 {
                true => format!(
                    "{} % of the mechanism's size of {} m",
                    number(100.0 * value / size),
                    number(size)
                ),
                false => "and all points of the mechanism are at one place".into(),
            };
            told.push(format!(
                "{of} moves by {} m{at}, {share}; {LOOK}",
                number(*value)
            ));
        }
        let turned = self.turned.as_ref().filter(|turned| turned.value > TURNED);
        if let Some(Largest { value, of, at }) = turned {
            let look = match told.is_empty() {
                true => format!("; {LOOK}"),
                false => ", beyond a linear model, too".into(),
            };
            told.push(format!("{of} turns by {} rad{at}{look}", number(*value)));
        }
        let used = self.used.as_ref().filter(|used| used.value > 1.0);
        if let Some(Largest { value, of, at }) = used {
            let unit = match *value > STRENGTH_IN_MPA {
                true => "is `yield` in N/m², not in MPa?",
                false => "are all forces in N?",
            };
            told.push(format!(
                "the utilisation of {of} is {}{at}: the stress is above the yield strength; {unit}",
                number(*value)
            ));
        }
        told
    }
}

/// Keeps the larger of two values.
fn keep(largest: &mut Option<Largest>, value: f64, name: impl Fn() -> String, at: &str) {
    if value.is_finite() && largest.as_ref().is_none_or(|known| value > known.value) {
        *largest = Some(Largest {
            value,
            of: name(),
            at: at.into(),
        });
    }
}
