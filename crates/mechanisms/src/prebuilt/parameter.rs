//! Checks of the parameters of prebuilt mechanisms.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};

use hyperstat_joints::Dof;

use crate::prebuilt::ParameterError;

/// A length (m) that must not vanish.
pub(super) fn positive_length(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value:?} m is not a length above zero"),
        help: Some("give a finite length in metres, such as 0.3".into()),
    })
}

/// A radius (m), which may vanish.
pub(super) fn radius(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value:?} m is not a radius of zero or more"),
        help: Some("give a finite radius in metres, such as 0.25".into()),
    })
}

/// A joint stiffness; `None` is rigid.
pub(super) fn stiffness(field: &'static str, value: Option<f64>) -> Result<(), ParameterError> {
    match value {
        Some(k) if !(k.is_finite() && k >= 0.0) => Err(ParameterError {
            field,
            message: format!("a stiffness of {k:?} is not a finite number, zero or more"),
            help: Some("leave the direction out for a rigid one".into()),
        }),
        _ => Ok(()),
    }
}

/// A number of elements a segment is divided into.
pub(super) fn elements(field: &'static str, value: usize) -> Result<(), ParameterError> {
    const MOST: usize = 1_000_000;
    if (1..=MOST).contains(&value) {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value} elements a segment are not between 1 and {MOST}"),
        help: Some("1 is exact for straight beams loaded at their ends".into()),
    })
}

/// An angle (rad) between two axes that meet: they are neither parallel nor opposite.
pub(super) fn angle(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if value > 0.0 && value < PI {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value:?} rad is not an angle between 0 and π"),
        help: Some("give it in radians; a right angle is 1.5707963267948966".into()),
    })
}

/// Stiffness of a mechanism's joints by directions, of which v is the revolute joints' axis.
pub(super) fn joint_stiffness(
    field: &'static str,
    stiffness: &[Option<f64>; 6],
) -> Result<(), ParameterError> {
    without_v(
        field,
        stiffness,
        "would make every revolute joint elastic about its axis",
    )
}

/// Stiffness by directions of the passive joints of a mechanism, each of which takes it where it
/// constrains; all of them are free about v.
pub(super) fn passive_stiffness(
    field: &'static str,
    stiffness: &[Option<f64>; 6],
) -> Result<(), ParameterError> {
    without_v(
        field,
        stiffness,
        "is for a direction in which all these joints are free",
    )
}

/// Stiffness by directions, without v; `why` says what is wrong with v.
fn without_v(
    field: &'static str,
    stiffness: &[Option<f64>; 6],
    why: &str,
) -> Result<(), ParameterError> {
    for value in stiffness {
        self::stiffness(field, *value)?;
    }
    match stiffness[Dof::V.index()] {
        None => Ok(()),
        Some(value) => Err(ParameterError {
            field,
            message: format!("v: {value:?} {why}"),
            help: Some("leave v out; `drive_stiffness` makes the drives elastic".into()),
        }),
    }
}

/// A coordinate of a place (m), of either sign.
pub(super) fn coordinate(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value:?} m is not a finite number"),
        help: Some("give a number in metres, such as 0.1 or -0.1".into()),
    })
}

/// Half the angle (rad) between the two joints of a pair, of which there are three in a circle.
pub(super) fn half_angle_of_pair(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if (0.0..=FRAC_PI_3).contains(&value) {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value:?} rad is not half the angle of a pair, between 0 and π/3"),
        help: Some("give it in radians; 10° are 0.17453292519943295".into()),
    })
}

/// By how much (rad) something leans from upright to level, to either side.
pub(super) fn tilt(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if (-FRAC_PI_2..=FRAC_PI_2).contains(&value) {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value:?} rad is not a tilt between -π/2 and π/2"),
        help: Some("give it in radians; 45° are 0.7853981633974483".into()),
    })
}
