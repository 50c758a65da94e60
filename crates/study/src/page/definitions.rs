//! What the words and numbers of a report mean.

use maud::{Markup, html};

/// Words and what they mean, without the measures, which tables define where they stand.
const WORDS: [(&str, &str); 12] = [
    (
        "frames and units",
        "SI units: m, N, N·m, rad, kg, s, Pa. Vectors are in the global frame of the file, with the linear part \
         first; wrenches in joints are in the joint's frame, forces along beams in the element frame, whose x \
         is along the beam.",
    ),
    (
        "output",
        "The node whose stiffness is meant, usually the tool point.",
    ),
    (
        "displacement",
        "Small displacement of the output under the loads with all drives locked: Δx Δy Δz along, φx φy φz about \
         the global axes.",
    ),
    (
        "stiffness",
        "The 6×6 matrix K of the wrench on the output that a displacement of it takes: w = K d, drives locked; \
         symmetric. A pure force is one with no moment: the output turns as it likes (rotations free). A pure \
         translation is one with no rotation (rotations held). The two have different stiffnesses.",
    ),
    (
        "mobility, over-constraint",
        "Instantaneous freedoms of the mechanism with rigid bodies and all drives released; and how many of its \
         constraints are redundant. Idle motions move something without energy and leave the output.",
    ),
    (
        "joint wrench",
        "Force and moment on the second body of the joint, at the joint. Where redundant rigid constraints leave \
         it to chance it is not told.",
    ),
    (
        "worst point",
        "Where the equivalent (von Mises) stress of a body is largest: at a part of the segment's length, of \
         normal stress (axial force, bending) and shear stress (torsion). Utilisation is the equivalent stress \
         over the material's yield stress, where it has one.",
    ),
    (
        "what is soft",
        "The share of every body, joint and kind of deformation in the displacement of the output along a \
         direction, or, without loads, in its compliance: by virtual work, the wrench of the loads on the \
         deformation of a unit wrench. The shares sum to the whole; a part that works against it has a \
         negative share.",
    ),
    (
        "what more of a parameter changes",
        "Relative change of the whole of the budget per relative change of the parameter: exact to first \
         order, or, where it says so, by differences of four designs beside this one.",
    ),
    (
        "natural frequencies",
        "Of small undamped vibration about the configuration, drives locked, masses of beams distributed.",
    ),
    (
        "rows and statuses",
        "A row is one pose of one design, counted from 0. `ok`; `design`: the varied values make no mechanism; \
         `unreachable`, `singular`, `branch`: the pose cannot be taken, or not without passing a singular one; \
         `unrestrained`: something moves freely; `rigid`: the output is held rigidly in some direction; \
         `failed`: the numbers could not be found.",
    ),
    (
        "percentiles",
        "Over the poses that have a result; 5 % of them are below the first, 95 % below the second.",
    ),
];

pub(super) fn section() -> Markup {
    html! {
        dl {
            @for (word, meaning) in WORDS {
                dt { (word) }
                dd { (meaning) }
            }
        }
        p {
            "Method: matrix structural analysis with subassembly elements and independent displacement coordinates, \
             after "
            em {
                "Systematic Elastostatic Stiffness Model of Over-Constrained Parallel Manipulators Without \
                 Additional Constraint Equations"
            }
            "."
        }
    }
}
