//! Forces of poses that went through the lanes: what joints and segments carry in every state, and under the
//! wrench on the output that says where its displacement comes from.

use hyperstat_elements::BeamLoad;
use hyperstat_model::{Geometry, LANES, Model, SegmentId, characteristic_length};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector6};
use pulp::Arch;

use super::carry::room::{ENDS, OF_SEGMENT, Room};
use super::carry::{Carry, Place};
use super::pass::displacement as place_of_displacement;
use super::program::recovery::Recovery;
use super::{Beside, Engine};
use crate::answer::forces::Forces;
use crate::answer::measures::{direction_of, principal};
use crate::answer::pose_result::PoseResult;
use crate::answer::solution::SegmentForces;
use crate::pose::restraint::{SUSPICIOUS_PIVOT, inverse};
use crate::posture::Posture;
use crate::state::acting::Acting;
use crate::state::floor::Floor;

/// What is found of a pose beside the output.
#[derive(Debug, Default)]
pub(crate) struct Beyond {
    /// What joints and segments carry, by states.
    pub forces: Vec<Forces>,
    /// Under the wrenches that are asked for.
    pub virtuals: Vec<Virtual>,
}

/// What joints and segments carry under a wrench on the output alone.
#[derive(Debug)]
pub(crate) struct Virtual {
    pub wrench: Vector6<f64>,
    /// Displacement of the output.
    pub displacement: Vector6<f64>,
    pub forces: Forces,
}

/// The wrenches on the output that are asked for at a pose, given its number among those that go together,
/// its result, and what its states carry.
pub(crate) type Ask<'a> = dyn FnMut(usize, &PoseResult, &[Forces]) -> Vec<Vector6<f64>> + 'a;

/// Poses that went through the pass together.
pub(super) struct Swept<'a> {
    pub model: &'a Model,
    pub geometries: &'a [&'a Geometry],
    /// Those that something is wanted of, all of which the lanes vouch for.
    pub wanted: [bool; LANES],
    /// Number of the first.
    pub first: usize,
    /// The states whose forces are wanted; all where it is `None`.
    pub state: Option<usize>,
    pub arch: Arch,
}

impl Engine {
    /// What joints and segments carry in every state, and under the wrenches that are asked for, of poses in
    /// their geometries; `None` of one whose numbers are not to be trusted, and of all where the mechanism's
    /// forces are not found here.
    pub(super) fn carried(
        &mut self,
        swept: &Swept<'_>,
        ask: Option<&mut Ask<'_>>,
    ) -> [Option<Beyond>; LANES] {
        let mut found = [const { None }; LANES];
        let (Some(recovery), Some(room)) = (&self.program.recovery, &mut self.room) else {
            return found;
        };
        if !swept.wanted.contains(&true) {
            return found;
        }
        for (lane, geometry) in swept.geometries.iter().enumerate() {
            room.size[lane] = characteristic_length(geometry);
        }
        let buffers = &self.buffers;
        swept.arch.dispatch(Place {
            recovery,
            buffers,
            room,
        });
        for (found, wanted) in found.iter_mut().zip(swept.wanted) {
            *found = wanted.then(Beyond::default);
        }
        if self.beside >= Beside::Forces {
            self.add_states(swept, &mut found);
        }
        match (ask, self.beside) {
            (Some(ask), _) => self.add_virtuals(swept, ask, &mut found),
            (None, Beside::Budgets) => self.add_virtuals(swept, &mut directions, &mut found),
            _ => {}
        }
        found
    }

    /// Adds what is carried in every state.
    fn add_states(&mut self, swept: &Swept<'_>, found: &mut [Option<Beyond>; LANES]) {
        let (Some(recovery), Some(room)) = (&self.program.recovery, &mut self.room) else {
            return;
        };
        let (program, buffers, width) = (&self.program, &self.buffers, room.width);
        let states = match swept.state {
            Some(state) => state..state + 1,
            None => 0..recovery.floors.len(),
        };
        // What acts along segments is in their forces.
        let mut loads: [Option<Vec<Acting>>; LANES] = [const { None }; LANES];
        if recovery.along {
            for lane in 0..width {
                if found[lane].is_some() {
                    let at = Posture::new(swept.model, swept.geometries[lane]);
                    loads[lane] = Acting::of_states(&at, states.clone()).ok();
                    if loads[lane].is_none() {
                        found[lane] = None;
                    }
                }
            }
        }
        for state in states.clone() {
            let floor = &recovery.floors[state];
            let first = place_of_displacement(state) * width;
            room.asked[..6 * width].copy_from_slice(&buffers.results[first..first + 6 * width]);
            room.asked[6 * width..].fill(0.0);
            swept.arch.dispatch(Carry {
                program,
                recovery,
                buffers,
                room: &mut *room,
                columns: &program.states[state],
            });
            for lane in 0..width {
                let Some(own) = &mut found[lane] else {
                    continue;
                };
                let acting = loads[lane].as_ref().map(|all| &all[state - states.start]);
                match forces(recovery, room, lane, (acting, floor), true) {
                    Some(forces) => own.forces.push(forces),
                    None => found[lane] = None,
                }
            }
        }
    }

    /// Adds what is carried under the wrenches that are asked for; a pose that has none of one has nothing,
    /// since the numeric pass has it all.
    fn add_virtuals(
        &mut self,
        swept: &Swept<'_>,
        ask: &mut Ask<'_>,
        found: &mut [Option<Beyond>; LANES],
    ) {
        let width = self.buffers.width;
        let mut asked: [Vec<[Vector6<f64>; 2]>; LANES] = [const { Vec::new() }; LANES];
        for lane in 0..width {
            let Some(own) = &found[lane] else { continue };
            let result = self.found(lane);
            let compliance = result.stiffness.as_ref();
            let Some(compliance) = compliance.and_then(|k| inverse(k, SUSPICIOUS_PIVOT)) else {
                found[lane] = None;
                continue;
            };
            let wrenches = ask(swept.first + lane, &result, &own.forces).into_iter();
            asked[lane] = wrenches.map(|own| [own, compliance * own]).collect();
        }
        let (Some(recovery), Some(room)) = (&self.program.recovery, &mut self.room) else {
            return;
        };
        let most = asked.iter().map(Vec::len).max().unwrap_or(0);
        for number in 0..most {
            room.asked.fill(0.0);
            for (lane, asked) in asked.iter().enumerate() {
                let Some([wrench, moved]) = asked.get(number) else {
                    continue;
                };
                for k in 0..6 {
                    room.asked[k * width + lane] = moved[k];
                    room.asked[(6 + k) * width + lane] = wrench[k];
                }
            }
            swept.arch.dispatch(Carry {
                program: &self.program,
                recovery,
                buffers: &self.buffers,
                room: &mut *room,
                columns: &[],
            });
            for lane in 0..width {
                let (Some(own), Some([wrench, moved])) =
                    (&mut found[lane], asked[lane].get(number))
                else {
                    continue;
                };
                let floor = recovery.at_rest.under_wrench(wrench);
                match forces(recovery, room, lane, (None, &floor), false) {
                    Some(forces) => own.virtuals.push(Virtual {
                        wrench: *wrench,
                        displacement: *moved,
                        forces,
                    }),
                    None => found[lane] = None,
                }
            }
        }
    }
}

/// The unit wrench that the budget of each state is along: the way that the output moves, where it does, else
/// the softest force.
fn directions(_: usize, result: &PoseResult, states: &[Forces]) -> Vec<Vector6<f64>> {
    let displacements = result.displacement.iter().chain(&result.cases);
    let direction = |(displacement, state): (&Vector6<f64>, &Forces)| {
        let along = direction_of(&state.floor.cleared(displacement));
        along.unwrap_or_else(|| softest(result.stiffness.as_ref()))
    };
    displacements.zip(states).map(direction).collect()
}

/// The unit force that moves the output most.
fn softest(stiffness: Option<&Matrix6<f64>>) -> Vector6<f64> {
    let compliance = stiffness.and_then(|k| inverse(k, SUSPICIOUS_PIVOT));
    let Some(compliance) = compliance else {
        return Vector6::zeros();
    };
    let forces = compliance.fixed_view::<3, 3>(0, 0).into_owned();
    let softest = principal(&forces).directions[2];
    Vector6::new(softest.x, softest.y, softest.z, 0.0, 0.0, 0.0)
}

/// What a pose has in the room, of a state in which this acts along segments; with the preloads where they
/// count. `None` where it is not to be trusted.
fn forces(
    recovery: &Recovery,
    room: &Room,
    lane: usize,
    (acting, floor): (Option<&Acting>, &Floor),
    preloaded: bool,
) -> Option<Forces> {
    let doubt = room.doubt[lane];
    if doubt.is_nan() || doubt > 0.0 {
        return None;
    }
    let of_segments = room.of(&room.segments, lane);
    let carried = room.of(&room.carried, lane);
    let six = |first: usize| Vector6::from_fn(|k, _| carried(first + k));
    let mut segments = Vec::with_capacity(recovery.segments.len());
    let mut finite = true;
    for k in 0..recovery.segments.len() {
        let own = |entry: usize| of_segments(OF_SEGMENT * k + entry);
        let length = own(9);
        let mut ends = [six(ENDS * k), six(ENDS * k + 6)];
        let load = acting.and_then(|acting| acting.on_segment(SegmentId(k)));
        if let Some(load) = load {
            ends[0] -= load.resultant(length);
        }
        for end in &mut ends {
            finite &= end.iter().all(|number| number.is_finite());
            floor.clear_wrench(end);
        }
        let axes = Matrix3::from_fn(|row, column| own(3 * column + row));
        segments.push(SegmentForces {
            frame: Rotation3::from_matrix_unchecked(axes),
            length,
            ends,
            load: load.copied().unwrap_or_else(BeamLoad::none),
        });
    }
    let first = ENDS * recovery.segments.len();
    let joints = 0..recovery.joints.len();
    let mut wrenches: Vec<_> = joints.map(|k| Some(six(first + 6 * k))).collect();
    if preloaded {
        for (joint, preload) in &recovery.preloads {
            if let Some(wrench) = &mut wrenches[joint.0] {
                *wrench += preload;
            }
        }
    }
    for wrench in wrenches.iter_mut().flatten() {
        finite &= wrench.iter().all(|number| number.is_finite());
        floor.clear_wrench(wrench);
    }
    finite.then_some(Forces {
        joint_wrenches: wrenches,
        segments,
        floor: *floor,
    })
}
