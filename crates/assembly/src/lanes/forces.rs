//! Forces of a pose that went through the lanes: what joints and segments carry, one pose at a time, from
//! what the pass kept.
//!
//! The fronts give the displacements of all coordinates from those of the output, a chain's works on
//! these the wrenches that it transmits, and with the loads on its way the wrench in every link; a joint's
//! is a sum of these ([`recovery`](super::program::recovery)). Whether the coordinates are in balance says
//! whether the numbers are to be trusted.

use hyperstat_elements::{BeamLoad, rotate_vector6};
use hyperstat_model::{Geometry, Model, SegmentId, rotation6};
use nalgebra::{Vector3, Vector6};

use super::Engine;
use super::pass::buffers::Buffers;
use super::pass::displacement as place_of_displacement;
use super::pass::factor::ROUNDING;
use super::program::Program;
use super::program::chain::{Chain, Item};
use super::program::element::{Kind, NodeMotion};
use super::program::fronts::Hang;
use super::program::recovery::{AXES, KeptChain, Recovery};
use super::wrench::Wrench;
use crate::answer::forces::Forces;
use crate::answer::solution::SegmentForces;
use crate::pose::restraint::{SUSPICIOUS_PIVOT, inverse};
use crate::posture::Posture;
use crate::state::acting::Acting;
use crate::state::floor::Floor;

/// What coordinates may be out of balance by, beside the forces on them.
const BALANCED: f64 = 1e-11;
/// What a force may have lost, and coordinates be out of balance by, beside the largest force.
const LOST: f64 = 1e-12;

/// A thread's room for the forces of a pose.
#[derive(Debug, Default)]
pub(crate) struct ForceRoom {
    /// The component of a wrench on the output that is 1, beside the columns of what acts.
    unit: Option<usize>,
    /// By rows of what acts: whether it is of the state.
    rows: Vec<bool>,
    /// Displacements by coordinates.
    moved: Vec<f64>,
    /// The same, of a component that hangs relative to its neighbour.
    relative: Vec<f64>,
    /// By coordinates: forces, and the sum of their terms' sizes.
    balance: Vec<[f64; 2]>,
    /// Wrenches in chains, about the chains' origins.
    cuts: Vec<Wrench>,
    /// Origins of the chains.
    origins: Vec<Vector3<f64>>,
}

/// A pose of the lanes.
#[derive(Clone, Copy)]
struct Seen<'a> {
    program: &'a Program,
    recovery: &'a Recovery,
    buffers: &'a Buffers,
    lane: usize,
}

impl Engine {
    /// What joints and segments carry at a pose that the lanes vouch for, in its geometry: in every state, and
    /// under a unit of each component of a wrench on the output, where these are asked for and found.
    pub(super) fn carried(
        &mut self,
        model: &Model,
        geometry: &Geometry,
        lane: usize,
    ) -> (Option<Vec<Forces>>, Option<[Forces; 6]>) {
        let forces = self.forces(model, geometry, lane);
        let units = match forces {
            Some(_) => self.units(model, geometry, lane),
            None => None,
        };
        (forces, units)
    }

    /// What joints and segments carry in every state at a pose that the lanes vouch for, in its geometry;
    /// `None` where the numbers are not to be trusted, or the mechanism's forces are not found here.
    fn forces(&mut self, model: &Model, geometry: &Geometry, lane: usize) -> Option<Vec<Forces>> {
        let Self {
            program,
            buffers,
            room,
        } = self;
        let seen = Seen {
            recovery: program.recovery.as_ref()?,
            program,
            buffers,
            lane,
        };
        let at = Posture::new(model, geometry);
        let acting = match seen.recovery.along {
            true => Some(Acting::of_model(&at).ok()?),
            false => None,
        };
        room.unit = None;
        let states = seen.recovery.floors.iter().enumerate();
        let states = states.map(|(state, floor)| {
            let first = place_of_displacement(state);
            let output = Vector6::from_fn(|k, _| buffers.result(first + k, lane));
            let acting = acting.as_ref().map(|acting| &acting[state]);
            seen.state(&at, &output, &program.states[state], (acting, floor), room)
        });
        states.collect()
    }

    /// The same under a unit of each component of a wrench on the output, where that is asked for.
    fn units(&mut self, model: &Model, geometry: &Geometry, lane: usize) -> Option<[Forces; 6]> {
        let compliance = inverse(&self.found(lane).stiffness?, SUSPICIOUS_PIVOT)?;
        let Self {
            program,
            buffers,
            room,
        } = self;
        let seen = Seen {
            recovery: program.recovery.as_ref()?,
            program,
            buffers,
            lane,
        };
        let at = Posture::new(model, geometry);
        let floors = seen.recovery.units.as_ref()?;
        let units = floors.iter().zip(compliance.column_iter()).enumerate();
        let units = units.map(|(k, (floor, moved))| {
            room.unit = Some(k);
            seen.state(&at, &moved.into_owned(), &[], (None, floor), room)
        });
        let units: Option<Vec<Forces>> = units.collect();
        units?.try_into().ok()
    }
}

impl Seen<'_> {
    /// What joints and segments carry where columns of what acts move the output so far.
    fn state(
        &self,
        at: &Posture<'_>,
        output: &Vector6<f64>,
        columns: &[usize],
        (acting, floor): (Option<&Acting>, &Floor),
        room: &mut ForceRoom,
    ) -> Option<Forces> {
        self.displace(output, columns, room);
        let trusted = self.transmit(columns, at.size, room);
        trusted.then(|| self.gather(at, columns, (acting, floor), room))?
    }

    fn input(&self, place: usize) -> Vector3<f64> {
        let at = self.buffers.of(&self.buffers.inputs, self.lane);
        Vector3::from_fn(|k, _| at(3 * place + k))
    }

    fn arm(&self, points: Option<[usize; 2]>) -> Vector3<f64> {
        points.map_or_else(Vector3::zeros, |[from, to]| {
            self.input(to) - self.input(from)
        })
    }

    fn act(&self, act: usize) -> Wrench {
        let at = self.buffers.of(&self.buffers.acts, self.lane);
        Wrench::of(&Vector6::from_fn(|k, _| at(6 * act + k)))
    }

    fn screw(&self, screw: usize) -> [Vector3<f64>; 2] {
        let at = self.buffers.of(&self.buffers.screws, self.lane);
        [0, 3].map(|part| Vector3::from_fn(|k, _| at(6 * screw + part + k)))
    }

    /// Finds the displacements of all coordinates.
    fn displace(&self, moved: &Vector6<f64>, columns: &[usize], room: &mut ForceRoom) {
        let Program {
            fronts,
            coordinates,
            output,
            ..
        } = self.program;
        room.rows.clear();
        room.rows.resize(fronts.rows, false);
        let rows = columns.iter();
        for row in rows.filter_map(|column| self.program.rows[*column]) {
            room.rows[row] = true;
        }
        room.moved.clear();
        room.moved.resize(*coordinates, 0.0);
        for k in 0..6 {
            room.moved[output + k] = moved[k];
        }
        room.relative.clone_from(&room.moved);
        let panel = self.buffers.of(&self.buffers.kept, self.lane);
        let starts = self.recovery.panels.iter();
        for (front, start) in fronts.list.iter().zip(starts).rev() {
            let size = front.variables.len();
            let columns = size - front.rows;
            // The panel holds −l, and what acts over the pivots.
            for k in (0..front.pivots).rev() {
                let own = |i: usize| panel(start + k * size + i);
                let mut sum = 0.0;
                for i in k + 1..columns {
                    sum += own(i) * room.moved[front.variables[i]];
                }
                for i in columns..size {
                    if room.rows[front.variables[i] - coordinates] {
                        sum -= own(i);
                    }
                }
                room.moved[front.variables[k]] = sum;
            }
            for variable in &front.variables[..front.pivots] {
                room.relative[*variable] = room.moved[*variable];
            }
            for hang in front.hangs.iter().rev() {
                self.make_absolute(hang, &front.variables, &mut room.moved);
            }
        }
    }

    /// `u = v + T w` of a component that hangs on its neighbour.
    fn make_absolute(&self, hang: &Hang, variables: &[usize], moved: &mut [f64]) {
        let at = |place: usize| moved[variables[place]];
        let arm = self.arm(hang.arm);
        let mut angular = Vector3::from_fn(|k, _| at(hang.root[3 + k]));
        let mut linear = Vector3::from_fn(|k, _| at(hang.root[k]));
        for (screw, place) in &hang.screws {
            let [along, about] = self.screw(*screw);
            linear += along * at(*place);
            angular += about * at(*place);
        }
        linear += angular.cross(&arm);
        for k in 0..3 {
            moved[variables[hang.places[k]]] += linear[k];
            moved[variables[hang.places[3 + k]]] += angular[k];
        }
    }

    /// Finds the wrenches in all chains; whether they are to be trusted.
    fn transmit(&self, columns: &[usize], size: f64, room: &mut ForceRoom) -> bool {
        room.balance.clear();
        room.balance.resize(self.program.coordinates, [0.0; 2]);
        room.cuts.clear();
        room.cuts.resize(self.recovery.cuts, Wrench::default());
        room.origins.clear();
        let (mut largest, mut doubt) = (0.0_f64, 0.0_f64);
        for (k, chain) in self.recovery.chains.iter().enumerate() {
            let [force, lost] = self.add_chain(k, chain, columns, room);
            largest = largest.max(force);
            doubt = doubt.max(lost);
        }
        let mut add = |coordinate: usize, force: f64| {
            let [sum, terms] = &mut room.balance[coordinate];
            *sum += force;
            *terms += force.abs();
        };
        if let Some(k) = room.unit {
            add(self.program.output + k, -1.0);
        }
        for spring in &self.program.springs {
            let [a, b] = spring.coordinates;
            add(a, spring.stiffness * room.moved[b]);
            if a != b {
                add(b, spring.stiffness * room.moved[a]);
            }
        }
        let own = self.program.loads.iter();
        for load in own.filter(|load| columns.contains(&load.column)) {
            let wrench = self.act(load.act).carried(&self.arm(load.node.arm));
            self.work(&load.node, &wrench.turned_back(), &mut add);
        }
        let near = |([sum, terms], slides): (&[f64; 2], &bool)| {
            let arm = if *slides { 1.0 } else { size };
            sum.abs() <= BALANCED * terms + LOST * largest * arm
        };
        let balanced = room.balance.iter().zip(&self.recovery.slides).all(near);
        balanced && doubt <= LOST * largest
    }

    /// What a wrench at a node's reference point does on the node's coordinates.
    fn work(&self, node: &NodeMotion, wrench: &Wrench, mut add: impl FnMut(usize, f64)) {
        if let Some(root) = node.root {
            for k in 0..3 {
                add(root + k, wrench.force[k]);
                add(root + 3 + k, wrench.moment[k]);
            }
        }
        for own in &node.screws {
            add(own.coordinate, wrench.work(&self.screw(own.screw)));
        }
    }

    /// Finds the wrenches of one chain; returns the largest, and what it may have lost \[N\].
    fn add_chain(
        &self,
        element: usize,
        own: &KeptChain,
        columns: &[usize],
        room: &mut ForceRoom,
    ) -> [f64; 2] {
        let Kind::Chain(chain) = &self.program.elements[element].kind else {
            return [0.0; 2];
        };
        let layout = own.layout;
        let all = self.buffers.of(&self.buffers.kept, self.lane);
        let kept = |k: usize| all(own.start + k);
        let acting = self.program.elements[element].columns.iter().enumerate();
        let acting = acting.filter(|(_, column)| columns.contains(column));
        let acting = acting.map(|(number, _)| layout.column(number));
        let mut wrench = [0.0; 6];
        for column in acting.clone() {
            for (k, sum) in wrench.iter_mut().enumerate() {
                *sum += kept(column + k);
            }
        }
        let moved = match own.hang {
            Some(_) => &room.relative,
            None => &room.moved,
        };
        let count = layout.wrenches;
        let mut doubt = 0.0_f64;
        let mut transmitted = [0.0; 6];
        for a in 0..count {
            let (mut stretch, mut squares) = (0.0, 0.0);
            for (n, coordinate) in own.coordinates.iter().enumerate() {
                let term = kept(layout.works() + n * count + a) * moved[*coordinate];
                stretch += term;
                squares += term * term;
            }
            let stiffness = kept(layout.stiffness() + a);
            let mut force = stiffness * stretch;
            let by_trust = kept(layout.trust() + a) * force;
            let mut lost = stiffness * stiffness * squares + by_trust * by_trust;
            for column in acting.clone() {
                force -= kept(column + 6 + a);
                lost += kept(column + 6 + count + a);
            }
            transmitted[a] = force;
            doubt = doubt.max(lost.sqrt() * ROUNDING);
            for (k, sum) in wrench.iter_mut().enumerate() {
                *sum += force * kept(layout.directions() + 6 * a + k);
            }
        }
        let largest = wrench.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        for (n, coordinate) in own.coordinates.iter().enumerate() {
            let mut terms = [0.0; 2];
            let mut add = |force: f64| {
                terms[0] += force;
                terms[1] += force.abs();
            };
            for (a, force) in transmitted[..count].iter().enumerate() {
                add(kept(layout.works() + n * count + a) * force);
            }
            for column in acting.clone() {
                add(-kept(column + 6 + 2 * count + n));
            }
            room.balance[*coordinate][0] += terms[0];
            room.balance[*coordinate][1] += terms[1];
            if let Some(place) = own.hang {
                self.hand_on(place, *coordinate, terms[0], &mut room.balance);
            }
        }
        self.cut(chain, own, columns, (&wrench, kept), room);
        [largest, doubt]
    }

    /// What a force on the coordinate of a component that hangs asks of its neighbour's.
    fn hand_on(
        &self,
        [front, hang]: [usize; 2],
        coordinate: usize,
        force: f64,
        balance: &mut [[f64; 2]],
    ) {
        let front = &self.program.fronts.list[front];
        let hang = &front.hangs[hang];
        let own = hang
            .places
            .iter()
            .position(|p| front.variables[*p] == coordinate);
        let Some(own) = own else { return };
        let mut along = Vector6::zeros();
        along[own] = -force;
        let wrench = Wrench::of(&along).carried(&self.arm(hang.arm));
        let mut add = |place: usize, force: f64| {
            let entry = &mut balance[front.variables[place]];
            entry[0] += force;
            entry[1] += force.abs();
        };
        for k in 0..3 {
            add(hang.root[k], wrench.force[k]);
            add(hang.root[3 + k], wrench.moment[k]);
        }
        for (screw, place) in &hang.screws {
            add(*place, wrench.work(&self.screw(*screw)));
        }
    }

    /// Finds the wrench at every place of a chain, from its end 1 on.
    fn cut(
        &self,
        chain: &Chain,
        own: &KeptChain,
        columns: &[usize],
        (wrench, kept): (&[f64; 6], impl Fn(usize) -> f64),
        room: &mut ForceRoom,
    ) {
        let origin = Vector3::from_fn(|k, _| kept(k));
        let to_global = |v: Vector3<f64>| {
            Vector3::from_fn(|i, _| (0..3).map(|r| kept(AXES + 3 * r + i) * v[r]).sum())
        };
        let [a, b, c, y, z, x] = *wrench;
        let mut wrench = Wrench {
            force: to_global(Vector3::new(x, y, z)),
            moment: to_global(Vector3::new(a, b, c) * chain.size),
        };
        room.origins.push(origin);
        let cuts = &mut room.cuts[own.first_cut..][..chain.order.len()];
        for (item, cut) in chain.order.iter().zip(cuts).rev() {
            *cut = wrench;
            if let Item::Load(k) = item {
                let load = &chain.loads[*k];
                if columns.contains(&load.column) {
                    let arm = self.input(load.point) - origin;
                    wrench.add(self.act(load.act).carried(&arm));
                }
            }
        }
    }

    /// What all joints and segments carry.
    fn gather(
        &self,
        at: &Posture<'_>,
        columns: &[usize],
        (acting, floor): (Option<&Acting>, &Floor),
        room: &ForceRoom,
    ) -> Option<Forces> {
        let Posture {
            model, geometry, ..
        } = *at;
        let mut segments = Vec::with_capacity(self.recovery.segments.len());
        for (k, own) in self.recovery.segments.iter().enumerate() {
            let id = SegmentId(k);
            let points = model.segments()[k]
                .ends
                .map(|n| geometry.positions[n.0].coords);
            let frame = at.segment_frame(id).ok()?;
            let to_own = frame.inverse();
            let length = (points[1] - points[0]).norm();
            let cut = match own.flipped {
                true => room.cuts[own.cut].turned_back(),
                false => room.cuts[own.cut],
            };
            let origin = room.origins[own.element];
            let at_point = |point| rotate_vector6(&cut.carried(&(origin - point)).six(), &to_own);
            let mut ends = [-at_point(points[0]), at_point(points[1])];
            let load = acting.and_then(|acting| acting.on_segment(id).copied());
            if let Some(load) = &load {
                ends[0] -= load.resultant(length);
            }
            ends.iter_mut().for_each(|end| floor.clear_wrench(end));
            segments.push(SegmentForces {
                frame,
                length,
                ends,
                load: load.unwrap_or_else(BeamLoad::none),
            });
        }
        let mut joint_wrenches = Vec::with_capacity(self.recovery.joints.len());
        for (k, own) in self.recovery.joints.iter().enumerate() {
            let node = model.joints()[k].between.into_iter().flatten().next()?;
            let point = geometry.positions[node.0].coords;
            let mut sum = Wrench::default();
            for (element, cut, sign) in &own.cuts {
                let arm = room.origins[*element] - point;
                let cut = room.cuts[*cut].carried(&arm);
                sum.force += cut.force * *sign;
                sum.moment += cut.moment * *sign;
            }
            for (load, sign) in &own.loads {
                let load = &self.recovery.loads[*load];
                if columns.contains(&load.column) {
                    let arm = geometry.positions[load.node.0].coords - point;
                    let wrench = self.act(load.act).carried(&arm);
                    sum.force += wrench.force * *sign;
                    sum.moment += wrench.moment * *sign;
                }
            }
            joint_wrenches.push(rotation6(&geometry.frames[k]).transpose() * sum.six());
        }
        if room.unit.is_none() {
            for (joint, preload) in &self.recovery.preloads {
                joint_wrenches[joint.0] += preload;
            }
        }
        let found = segments.iter().flat_map(|s| &s.ends).chain(&joint_wrenches);
        if !found.flatten().all(|number| number.is_finite()) {
            return None;
        }
        joint_wrenches
            .iter_mut()
            .for_each(|w| floor.clear_wrench(w));
        Some(Forces {
            joint_wrenches: joint_wrenches.into_iter().map(Some).collect(),
            segments,
            floor: *floor,
        })
    }
}
