//! The figures that a job asks for.

use crate::error::LoadError;
use crate::fields::Fields;
use crate::fragment::Fragment;
use crate::names;

/// A figure that a job asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Figure {
    /// The deflected trajectory over the commanded one (Fig. 8).
    Trajectory {
        /// Magnification of the deflection.
        scale: Scale,
    },
    /// The deformed mechanism over the undeformed one (Fig. 9).
    Deformed {
        /// The pose to draw, from 0.
        pose: usize,
        /// Magnification of the deflection.
        scale: Scale,
    },
    /// A quantity over a plane of the poses, or over all of their planes.
    Map {
        /// Name of the quantity: a column of the job's table, or what is found from columns.
        value: String,
        /// The coordinate that the plane is normal to, of `x y z rx ry rz`, and its value.
        plane: Option<(&'static str, f64)>,
    },
}

/// Magnification of deflections in a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Chosen so that the deflections can be seen.
    Auto,
    /// This factor, above zero.
    Factor(f64),
}

/// Reads the figures of a job with so many poses.
pub(crate) fn read(list: Fragment<'_>, poses: usize) -> Result<Vec<Figure>, LoadError> {
    let list = list.list("a list of figures, such as `[Deformed(pose: 0, scale: Auto)]`")?;
    list.into_iter().map(|item| figure(item, poses)).collect()
}

fn figure(whole: Fragment<'_>, poses: usize) -> Result<Figure, LoadError> {
    let (kind, arguments) = whole.variant("a figure, such as `Trajectory(scale: Auto)`")?;
    let known: &[&str] =
        match kind.text() {
            "Trajectory" => &["scale"],
            "Deformed" => &["pose", "scale"],
            "Map" => &["value", "plane"],
            other => {
                return Err(kind.error(format!("unknown figure `{other}`")).with_help(
                    names::help(other, "figures", ["Trajectory", "Deformed", "Map"]),
                ));
            }
        };
    let owner = format!("`{}`", kind.text());
    let fields = match arguments {
        Some(given) => Fields::read(given, owner, known, &[])?,
        None => Fields::none(whole, owner),
    };
    if kind.text() == "Map" {
        return Ok(Figure::Map {
            value: fields.required("value")?.string()?,
            plane: fields.get("plane").map(plane).transpose()?,
        });
    }
    let scale = fields.get("scale").map_or(Ok(Scale::Auto), scale)?;
    if kind.text() == "Deformed" {
        let pose = fields.get("pose").map_or(Ok(0), |at| pose(at, poses))?;
        return Ok(Figure::Deformed { pose, scale });
    }
    if poses < 2 {
        return Err(whole
            .error("a trajectory needs two poses or more, this job has one")
            .with_help("use `Deformed` to see a single pose"));
    }
    Ok(Figure::Trajectory { scale })
}

/// Reads a plane such as `z(0.5)`.
fn plane(fragment: Fragment<'_>) -> Result<(&'static str, f64), LoadError> {
    const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
    let expected = "a plane, such as `z(0.5)`";
    let (kind, Some(arguments)) = fragment.variant(expected)? else {
        return Err(fragment.expected(expected));
    };
    let known = COORDINATES.into_iter().find(|name| *name == kind.text());
    let coordinate = known.ok_or_else(|| {
        kind.error(format!("`{}` is no coordinate of a pose", kind.text()))
            .with_help(names::help(kind.text(), "coordinates", COORDINATES))
    })?;
    let [value] = arguments.array(expected)?;
    Ok((coordinate, value.number()?))
}

fn scale(fragment: Fragment<'_>) -> Result<Scale, LoadError> {
    if fragment.text() == "Auto" {
        return Ok(Scale::Auto);
    }
    let expected = "`Auto` or a factor above zero, such as `50.0`";
    match fragment.parse::<f64>(expected)? {
        factor if factor.is_finite() && factor > 0.0 => Ok(Scale::Factor(factor)),
        _ => Err(fragment.expected(expected)),
    }
}

fn pose(fragment: Fragment<'_>, poses: usize) -> Result<usize, LoadError> {
    let pose = fragment.parse("the number of a pose, from 0")?;
    if pose >= poses {
        return Err(fragment
            .error(format!("there is no pose {pose}"))
            .with_help(format!("the job's poses are 0 to {}", poses - 1)));
    }
    Ok(pose)
}
