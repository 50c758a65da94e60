//! The built-in joint kinds and their arguments.

use hyperstat_joints::{
    Cylindrical, Dof, Fixed, Joint, Planar, Prismatic, Revolute, Screw, Spherical, Universal,
    frame_from_axes,
};
use nalgebra::Rotation3;

use super::registry::{Argument, Arguments, Known, Orientation, ParsedJoint, Registry};
use crate::error::LoadError;
use crate::terms::joints;
use crate::text::dimension::Dimension;

/// The arguments of a built-in kind.
fn known(kind: &str) -> Known {
    Known::Fields(joints::of_kind(kind))
}

/// Adds all built-in kinds.
pub(crate) fn register(registry: &mut Registry) {
    registry.add("Fixed", known("Fixed"), |a| may_have_axis(a, Fixed));
    registry.add("Revolute", known("Revolute"), |a| {
        along(a, "axis", Revolute)
    });
    registry.add("Prismatic", known("Prismatic"), |a| {
        along(a, "axis", Prismatic)
    });
    registry.add("Cylindrical", known("Cylindrical"), |a| {
        along(a, "axis", Cylindrical)
    });
    registry.add("Screw", known("Screw"), screw);
    registry.add("Universal", known("Universal"), universal);
    registry.add("Spherical", known("Spherical"), |a| {
        may_have_axis(a, Spherical)
    });
    registry.add("Planar", known("Planar"), |a| along(a, "normal", Planar));

    for kind in ["Revolute", "Prismatic", "Cylindrical"] {
        registry.register_writer(kind, |_, frame| vec![axis("axis", frame)]);
    }
    for kind in ["Fixed", "Spherical"] {
        registry.register_writer(kind, |_, frame| match *frame == Rotation3::identity() {
            true => Vec::new(),
            false => vec![axis("axis", frame)],
        });
    }
    registry.register_writer("Planar", |_, frame| vec![axis("normal", frame)]);
    registry.register_writer("Screw", |joint, frame| {
        let pitch = joint.basis()[(Dof::Y.index(), Dof::V.index())];
        vec![axis("axis", frame), ("pitch", Argument::Number(pitch))]
    });
    registry.register_writer("Universal", |_, frame| {
        let [x, y] = [0, 1].map(|k| frame.matrix().column(k).into_owned());
        vec![("axes", Argument::TwoDirections([x, y]))]
    });
}

/// The argument `name` that is y of the frame.
fn axis(name: &'static str, frame: &Rotation3<f64>) -> (&'static str, Argument) {
    let y = frame.matrix().column(1).into_owned();
    (name, Argument::Direction(y))
}

/// A joint whose y is the direction `name`.
fn along(
    arguments: &Arguments<'_>,
    name: &str,
    joint: impl Joint + 'static,
) -> Result<ParsedJoint, LoadError> {
    Ok(ParsedJoint {
        orientation: Orientation::Axis(arguments.direction(name)?),
        joint: Box::new(joint),
    })
}

/// A joint whose y is its `axis`, or global without one.
fn may_have_axis(
    arguments: &Arguments<'_>,
    joint: impl Joint + 'static,
) -> Result<ParsedJoint, LoadError> {
    if arguments.has("axis") {
        return along(arguments, "axis", joint);
    }
    Ok(ParsedJoint {
        orientation: Orientation::Global,
        joint: Box::new(joint),
    })
}

fn screw(arguments: &Arguments<'_>) -> Result<ParsedJoint, LoadError> {
    let pitch = arguments.quantity("pitch", Dimension::PITCH)?;
    let screw = Screw::new(pitch).map_err(|e| arguments.error("pitch", e.to_string()))?;
    along(arguments, "axis", screw)
}

fn universal(arguments: &Arguments<'_>) -> Result<ParsedJoint, LoadError> {
    let [a, b] = arguments.two_directions("axes")?;
    frame_from_axes(&a, &b).map_err(|e| arguments.error("axes", e.to_string()))?;
    Ok(ParsedJoint {
        joint: Box::new(Universal),
        orientation: Orientation::Axes(a, b),
    })
}
