//! Displacements inside absorbed joints, from both sides.
//!
//! Behind an absorbed joint a node is where its joint leaves it: `C w` off the outer node. Where the
//! joint is soft in one direction across others, as a screw of great pitch on a soft drive is, `w`
//! along it is a small difference of large parts and has few digits. But the segment between the
//! nodes says, too, where they are: by its elastic curve. What is left between the two, r, is taken
//! out by `Δw = k r`, k being the stiffness of segment and joints together, and `C Δw` at each joint.

use hyperstat_elements::rotate_vector6;
use hyperstat_model::{SegmentBeam, SegmentId};
use nalgebra::{Matrix6, Vector6};

use super::subassembly::{absorbed_joint, subassembly_frame};
use crate::answer::solution::SegmentForces;
use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::shift;
use crate::plan::elements::Source;
use crate::plan::workspace::Workspace;
use crate::posture::Posture;

/// Last bits of what is taken off each other, below which nothing is left.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Corrections: each leaves the share of the last that the rounding of k is.
const CORRECTIONS: usize = 2;

/// Moves nodes inside the absorbed joints of single segments to where joint and segment agree;
/// returns the largest wrench (forces, moments over the mechanism's `size`) that they were off by.
pub(crate) fn join(
    plan: &Plan,
    at: &Posture<'_>,
    workspace: &Workspace,
    segments: &[Option<SegmentForces>],
    displacements: &mut [Vector6<f64>],
    size: f64,
) -> Result<f64, SolveError> {
    let Posture { geometry, .. } = *at;
    let mut off = 0.0_f64;
    for element in &plan.elements {
        let Source::Subassembly(subassembly) = element.source else {
            continue;
        };
        let subassembly = &plan.topology.subassemblies[subassembly];
        let ([first, second], [(id, reversed)]) =
            (&subassembly.nodes[..], &subassembly.segments[..])
        else {
            continue;
        };
        let Some(forces) = &segments[id.0] else {
            continue;
        };
        if subassembly.joints.iter().all(Option::is_none) {
            continue;
        }
        let frame = subassembly_frame(subassembly, geometry)?;
        let k = &workspace.stiffnesses[element.stiffness_start..][..36];
        let k = Matrix6::from_column_slice(k);
        let carry = shift(geometry, *first, *second);
        for correction in 0..CORRECTIONS {
            let Some(mut left) = gap(at, *id, forces, displacements)? else {
                break;
            };
            if *reversed {
                // Seen from the second node, which is the subassembly's first.
                left = -(carry * left);
            }
            let local = rotate_vector6(&left, &frame.inverse());
            let wrench = rotate_vector6(&(k * local), &frame);
            if correction == 0 {
                let [force, moment] = [0, 3].map(|part| wrench.fixed_rows::<3>(part).amax());
                off = off.max(force).max(moment / size);
            }
            let at_first = -(carry.transpose() * wrench);
            let ends = [(*first, at_first), (*second, wrench)];
            for ((node, wrench), joint) in ends.iter().zip(&subassembly.joints) {
                if let Some(joint) = joint {
                    let elastic = absorbed_joint(plan, at, *joint);
                    displacements[node.0] -= elastic.turned_compliance() * wrench;
                }
            }
        }
    }
    Ok(off)
}

/// How far the second end of a segment is from where its elastic curve ends, from the first end
/// on; `None` where that is rounding.
fn gap(
    at: &Posture<'_>,
    id: SegmentId,
    forces: &SegmentForces,
    displacements: &[Vector6<f64>],
) -> Result<Option<Vector6<f64>>, SolveError> {
    let Posture {
        model, geometry, ..
    } = *at;
    let [first, second] = model.segments()[id.0].ends;
    let placed = at.beam(id)?;
    let (beam, own) = (&placed.beam, &placed.frame);
    let compliance = match beam {
        SegmentBeam::Prismatic(beam) => beam.cantilever_compliance(),
        SegmentBeam::Tapered(beam) => beam.cantilever_compliance(),
    };
    let bent = compliance * forces.ends[1] + beam.straight().free_end(&forces.load);
    let bent = rotate_vector6(&bent, own);
    let carry = shift(geometry, first, second);
    let gap = displacements[second.0] - carry * displacements[first.0] - bent;
    let size = displacements[second.0].abs() + carry.abs() * displacements[first.0].abs();
    let rounding = ROUNDING * (size + bent.abs());
    let least = [0, 3].map(|part| rounding.fixed_rows::<3>(part).amax());
    let seen = (0..6).any(|k| gap[k].abs() > least[k / 3]);
    Ok(seen.then_some(gap))
}
