//! Targets side by side: loop closure's fast way through.
//!
//! What a topology and the kind of target ask for is worked out once ([`program`], [`pattern`]): which
//! coordinate moves what, which unknowns every condition has, an order of elimination. Eight poses then
//! go from home together ([`follow`]), on the same straight ways and by the same rules as one does in
//! `path.rs`. A pose that the lanes do not vouch for goes that way by itself; so does every pose of a
//! mechanism that they do not take. No pose's result depends on its neighbours.

mod follow;
mod lane;
mod pass;
mod pattern;
mod program;
mod solve;

use hyperstat_model::{Geometry, LANES};
use nalgebra::{IsometryMatrix3, Translation3};

use crate::closure::LoopClosure;
use crate::equations::Goal;
use crate::error::ClosureError;
use crate::lanes::follow::Follower;
use crate::lanes::program::Asked;
use crate::place::Room;
use crate::target::Target;

/// What a thread keeps from call to call of [`LoopClosure::place_lanes`]: what was worked out, and room
/// for numbers. It holds nothing of the poses.
#[derive(Debug)]
pub struct Lanes {
    run: fn(Work<'_>),
    /// The mechanism that it is for.
    linkage: Option<u64>,
    /// A follower for every kind of target so far; `None` is one that is followed one by one.
    kinds: Vec<(Asked, Option<Box<Follower>>)>,
    bodies: Vec<IsometryMatrix3<f64>>,
    values: Vec<f64>,
    room: Room,
    /// Values of the drives at the targets of the last call, where they are kept.
    drives: Option<[Vec<f64>; LANES]>,
    one_by_one: u64,
}

/// The arithmetic of eight poses. [`Work::run`] and all that it calls is inlined into its caller: called
/// in a function that is compiled for a wider instruction set than the rest of the program, it uses that.
/// The numbers are the same in any.
#[derive(Debug)]
pub struct Work<'w> {
    follower: &'w mut Follower,
    goals: &'w [Option<&'w Goal>; LANES],
    vouched: &'w mut [bool; LANES],
}

impl Work<'_> {
    /// Does it.
    #[inline(always)]
    pub fn run(self) {
        *self.vouched = self.follower.follow(self.goals);
    }
}

impl Default for Lanes {
    fn default() -> Self {
        Self::new(|work| work.run())
    }
}

impl Lanes {
    /// Empty room, for arithmetic that `run` runs.
    pub fn new(run: fn(Work<'_>)) -> Self {
        Self {
            run,
            linkage: None,
            kinds: Vec::new(),
            bodies: Vec::new(),
            values: Vec::new(),
            room: Room::default(),
            drives: None,
            one_by_one: 0,
        }
    }

    /// Keeps the values of the drives from now on.
    pub fn keep_drives(&mut self) {
        self.drives.get_or_insert_default();
    }

    /// Values of the drives relative to home (m, rad), in the order of [`LoopClosure::drives`], at a target
    /// of the last call by its place; none where they are not kept, or the target was not reached.
    pub fn drives(&self, place: usize) -> &[f64] {
        let kept = self.drives.as_ref().and_then(|kept| kept.get(place));
        kept.map_or(&[], |values| values)
    }

    /// Poses so far that went one by one.
    pub fn one_by_one(&self) -> u64 {
        self.one_by_one
    }
}

impl LoopClosure {
    /// Brings geometries of the model each to a target of its own, at most [`LANES`] together, and
    /// returns the output's poses: what [`LoopClosure::place_at`] finds, to rounding where the loops of
    /// the file close exactly, and faster. What is found at a target does not depend on the others, and
    /// a target that fails leaves its geometry as it was.
    ///
    /// # Panics
    /// If there are more targets than geometries or [`LANES`].
    pub fn place_lanes(
        &self,
        targets: &[Target<'_>],
        geometries: &mut [Geometry],
        lanes: &mut Lanes,
    ) -> [Option<Result<[f64; 6], ClosureError>>; LANES] {
        if lanes.linkage != Some(self.system.linkage.id) {
            lanes.linkage = Some(self.system.linkage.id);
            lanes.kinds.clear();
        }
        for kept in lanes.drives.iter_mut().flatten() {
            kept.clear();
        }
        let mut results = [const { None }; LANES];
        let mut goals = [const { None }; LANES];
        for (lane, target) in targets.iter().enumerate() {
            match self.goal(target) {
                Ok(goal) => goals[lane] = Some(goal),
                Err(error) => results[lane] = Some(Err(error)),
            }
        }
        while let Some(first) = goals.iter().flatten().next() {
            let kind = lanes.kind(self, first);
            let own = goals.each_ref().map(|goal: &Option<Goal>| {
                goal.as_ref()
                    .filter(|goal| lanes.kinds[kind].0.is_asked_by(goal))
            });
            let mut vouched = [false; LANES];
            if let Some(follower) = &mut lanes.kinds[kind].1 {
                (lanes.run)(Work {
                    follower,
                    goals: &own,
                    vouched: &mut vouched,
                });
            }
            let taken = own.map(|goal| goal.is_some());
            for lane in (0..LANES).filter(|lane| taken[*lane]) {
                let (target, geometry) = (&targets[lane], &mut geometries[lane]);
                results[lane] = Some(if vouched[lane] {
                    self.take(kind, lane, target, geometry, lanes)
                } else {
                    lanes.one_by_one += 1;
                    let kept = lanes.drives.as_mut().map(|kept| &mut kept[lane]);
                    self.place_one(target, geometry, kept)
                });
                goals[lane] = None;
            }
        }
        results
    }

    /// The same for one target: to the bit what [`LoopClosure::place_lanes`] finds.
    ///
    /// # Errors
    /// As [`LoopClosure::place_at`]; a geometry of another model.
    pub fn place(
        &self,
        target: &Target<'_>,
        geometry: &mut Geometry,
        lanes: &mut Lanes,
    ) -> Result<[f64; 6], ClosureError> {
        let alone = std::slice::from_mut(geometry);
        let [placed, ..] = self.place_lanes(&[*target], alone, lanes);
        placed.unwrap_or_else(|| self.place_one(target, geometry, None))
    }

    /// Writes what the lanes vouch for.
    fn take(
        &self,
        kind: usize,
        lane: usize,
        target: &Target<'_>,
        geometry: &mut Geometry,
        lanes: &mut Lanes,
    ) -> Result<[f64; 6], ClosureError> {
        let Lanes {
            kinds,
            bodies,
            values,
            room,
            drives,
            ..
        } = lanes;
        let Some(follower) = &kinds[kind].1 else {
            return self.place_one(
                target,
                geometry,
                drives.as_mut().map(|kept| &mut kept[lane]),
            );
        };
        let (size, numbers, program) = (self.system.size, follower.numbers(), &follower.program);
        let mut pose = numbers.output(program, lane);
        for (k, coordinate) in pose.iter_mut().enumerate().take(3) {
            *coordinate = *coordinate * size + self.system.shift(k);
        }
        if let Target::Output(asked) = target {
            self.compare(&pose, asked)?;
        }
        bodies.clear();
        bodies.extend(program.bodies.iter().map(|frame| {
            let frame = &numbers.frames[*frame];
            let travel = Translation3::from(frame.translation(lane) * size);
            IsometryMatrix3::from_parts(travel, frame.rotation(lane))
        }));
        values.clear();
        values.extend((0..program.columns).map(|column| follower.value(column, lane)));
        let linkage = &self.system.linkage;
        self.parts.write(linkage, bodies, values, room, geometry)?;
        if let Some(kept) = drives {
            self.keep(&mut kept[lane], |column| values[column]);
        }
        Ok(pose)
    }

    /// Writes the values of the drives, of those of all columns.
    fn keep(&self, kept: &mut Vec<f64>, value: impl Fn(usize) -> f64) {
        let linkage = &self.system.linkage;
        let columns = (self.drives()).filter_map(|(joint, dof)| linkage.column(joint.0, dof));
        kept.clear();
        kept.extend(columns.map(value));
    }

    /// A target by itself; `kept` is for the values of the drives.
    fn place_one(
        &self,
        target: &Target<'_>,
        geometry: &mut Geometry,
        kept: Option<&mut Vec<f64>>,
    ) -> Result<[f64; 6], ClosureError> {
        let reached = self.reach(&self.home(), target)?;
        self.write(&reached, geometry)?;
        if let Some(kept) = kept {
            self.keep(kept, |column| reached.values[column]);
        }
        self.pose(&reached)
    }
}

impl Lanes {
    /// The kind of a goal, worked out where it is the first of it.
    fn kind(&mut self, closure: &LoopClosure, goal: &Goal) -> usize {
        let known = self
            .kinds
            .iter()
            .position(|(asked, _)| asked.is_asked_by(goal));
        known.unwrap_or_else(|| {
            let asked = Asked::by(goal);
            let follower = Follower::new(&closure.system, &asked).map(Box::new);
            self.kinds.push((asked, follower));
            self.kinds.len() - 1
        })
    }
}
