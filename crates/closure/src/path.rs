//! The way from one configuration to a target, in steps that keep the branch.

use nalgebra::{DMatrix, DVector};

use crate::equations::{Equations, Goal, System};
use crate::error::ClosureError;
use crate::linkage::Configuration;
use crate::newton::{CLOSED, Solved, least_step, orientation, rank};

/// Shortest part of the way that is tried alone, over the nearer of what is done and what is left:
/// configurations at both ends may be near singular ones, where parts have to be short.
const SHORTEST: f64 = 1.0 / 1024.0;
/// Shortest part of all.
const LEAST: f64 = 1.0 / 16_777_216.0;
/// Parts tried at most.
const PARTS: usize = 100_000;
/// A part that moves no coordinate by more (rad, or sizes of the mechanism) is a short one.
const SHORT: f64 = 0.01;
/// Short parts at most: a way that needs more runs along singular configurations.
const SHORT_PARTS: usize = 200;
/// Parts of one length, after one that was halved to it, before a longer one is tried.
const CAREFUL: usize = 4;
/// Most that a coordinate may move in one part (rad, or sizes of the mechanism).
pub(crate) const LONGEST: f64 = 0.5;
/// Most that the solution of a part may be off its prediction along the tangent, relative to it:
/// from its start, and from its end on the way back.
pub(crate) const OFF: f64 = 0.3;
/// Least change of orientation in a part: a branch ends where it is zero, and another begins.
pub(crate) const SAME_SIDE: f64 = 1e-3;
/// A misfit up to this is a solution, be it one that Newton's method nears slowly.
const FOUND: f64 = 1e-9;
/// Singular values below this are those of a singular configuration.
const SINGULAR: f64 = 1e-3;

/// Coordinates of the output and values of the drives, from where to where.
struct Way<'g> {
    goal: &'g Goal,
    output: [f64; 6],
    drives: Vec<f64>,
}

impl Way<'_> {
    /// The goal at a part of the way.
    fn at(&self, part: f64) -> Goal {
        if part >= 1.0 {
            return self.goal.clone();
        }
        let between = |from: f64, to: f64| from + (to - from) * part;
        let mut goal = self.goal.clone();
        for (wanted, from) in goal.output.iter_mut().zip(self.output) {
            *wanted = wanted.map(|to| between(from, to));
        }
        for ((_, wanted), from) in goal.drives.iter_mut().zip(&self.drives) {
            *wanted = between(*from, *wanted);
        }
        goal
    }
}

impl System {
    /// Follows the straight way to `goal`; every part is halved until the solution is near its
    /// prediction and on the same side of all singular configurations.
    pub fn follow(&self, from: &Configuration, goal: &Goal) -> Result<Configuration, ClosureError> {
        let way = Way {
            goal,
            output: self.coordinates(from),
            drives: (goal.drives.iter())
                .map(|(column, _)| from.values[*column])
                .collect(),
        };
        let mut here = from.clone();
        let (mut done, mut part) = (0.0_f64, 1.0_f64);
        let (mut careful, mut short) = (0, 0);
        for _ in 0..PARTS {
            let shortest = (SHORTEST * done.min(1.0 - done)).max(LEAST);
            let next = if done + part > 1.0 - 1e-9 {
                1.0
            } else {
                done + part
            };
            match self.advance(&here, &way.at(done), &way.at(next)) {
                Some((solved, length)) => {
                    here = solved;
                    done = next;
                    if done >= 1.0 {
                        return Ok(here);
                    }
                    short += usize::from(length < SHORT);
                    if short > SHORT_PARTS {
                        break;
                    }
                    if careful > 0 {
                        careful -= 1;
                    } else {
                        part *= 2.0;
                    }
                }
                None if part <= shortest => break,
                None => {
                    part = 0.5 * part.min(1.0 - done);
                    careful = CAREFUL;
                }
            }
        }
        Err(self.lost(from, &here, done, &way))
    }

    /// One part of the way, from a configuration that meets `start`, and how far that moves the
    /// coordinates; `None` where the solution may be one of another branch.
    fn advance(
        &self,
        from: &Configuration,
        start: &Goal,
        goal: &Goal,
    ) -> Option<(Configuration, f64)> {
        let solved = self.newton(from, goal)?;
        let Solved { first, moved, .. } = &solved;
        if moved.norm() > 10.0 * CLOSED {
            let is_near = |predicted: &DVector<f64>, moved: &DVector<f64>| {
                (moved - predicted).norm() <= OFF * predicted.norm()
            };
            let [_, jacobian] = solved.jacobians.clone();
            let misfit = self.misfit(&solved.configuration, start);
            let back = least_step(&Equations { misfit, jacobian })?;
            let short = moved.amax() <= LONGEST;
            let near = is_near(first, moved) && is_near(&back, &-moved);
            if !(short && near && orientation(&solved.jacobians) >= SAME_SIDE) {
                return None;
            }
        }
        let length = moved.norm();
        let mut next = solved.configuration;
        let [.., rx, ry, rz] = self.coordinates(&next);
        next.rotation = [rx, ry, rz].into();
        Some((next, length))
    }

    /// Why the way ends: where it ends, is there a solution at all, and is it singular?
    fn lost(
        &self,
        from: &Configuration,
        here: &Configuration,
        done: f64,
        way: &Way<'_>,
    ) -> ClosureError {
        let place = self.in_words(here, way.goal);
        let rank_at = |configuration: &Configuration, goal: &Goal| {
            let jacobian: DMatrix<f64> = self.equations(configuration, goal).jacobian;
            rank(&jacobian, SINGULAR)
        };
        let full = rank_at(from, way.goal);
        let found = [here, from].into_iter().find_map(|start| {
            let descent = self.descend(start, way.goal)?;
            (descent.misfit <= FOUND).then_some(descent.solved.configuration)
        });
        match found {
            Some(found) if rank_at(&found, way.goal) < full => ClosureError::Singular {
                what: "the mechanism is singular there, and its branches meet".into(),
            },
            Some(_) => ClosureError::Branch {
                what: format!(
                    "the way to the target ends at {place}, {} of it done; beyond are only \
                     configurations that the mechanism reaches through a singular one",
                    percent(done)
                ),
            },
            None => ClosureError::Unreachable {
                what: format!(
                    "the loops do not close beyond {place}, {} of the way",
                    percent(done)
                ),
            },
        }
    }

    /// The asked coordinates as they are in a configuration.
    fn in_words(&self, configuration: &Configuration, goal: &Goal) -> String {
        let coordinates = self.coordinates(configuration);
        let output = (0..6)
            .filter(|k| goal.output[*k].is_some())
            .map(|k| format!("{} = {}", NAMES[k], shown(coordinates[k] + self.shift(k))));
        let drives = goal.drives.iter().map(|(column, _)| {
            let at = self.linkage.columns[*column];
            let motion = &self.linkage.joints[at.joint];
            let dof = at
                .factor
                .map_or("", |factor| motion.factors[factor].0.name());
            format!(
                "{}.{dof} = {}",
                motion.name,
                shown(configuration.values[*column])
            )
        });
        output.chain(drives).collect::<Vec<_>>().join(", ")
    }
}

/// Names of the output's coordinates.
pub(crate) const NAMES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A coordinate in a message.
pub(crate) fn shown(value: f64) -> String {
    let text = format!("{value:.6}");
    if text == "-0.000000" {
        "0.000000".into()
    } else {
        text
    }
}

fn percent(part: f64) -> String {
    format!("{:.0} %", 100.0 * part)
}
