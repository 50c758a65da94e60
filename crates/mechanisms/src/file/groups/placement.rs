//! How a copy lies against what it is a copy of.

use nalgebra::{Matrix3, Point3, Rotation3, Unit, Vector3};

use crate::error::LoadError;
use crate::terms::mechanism::{MOST_COPIES, PLACING};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::names;

/// Most copies of a group.
const MOST: usize = MOST_COPIES as usize;

/// A motion of a group, or its mirror image: p → `linear` p + `shift`, `linear` orthogonal.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Placement {
    linear: Matrix3<f64>,
    shift: Vector3<f64>,
}

impl Placement {
    /// Where the group was written.
    pub(super) const HERE: Self = Self {
        linear: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        shift: Vector3::new(0.0, 0.0, 0.0),
    };

    /// A rotation about the origin, then a motion by `shift`.
    pub(super) fn moved(rotation: Rotation3<f64>, shift: Vector3<f64>) -> Self {
        Self {
            linear: rotation.into_inner(),
            shift,
        }
    }

    /// A rotation or a reflection about a point.
    fn about(point: &Point3<f64>, linear: Matrix3<f64>) -> Self {
        Self {
            shift: point.coords - linear * point.coords,
            linear,
        }
    }

    /// This one, then another.
    fn then(&self, next: &Self) -> Self {
        Self {
            linear: next.linear * self.linear,
            shift: next.linear * self.shift + next.shift,
        }
    }

    /// Whether axes stay as they are.
    pub(super) fn keeps_axes(&self) -> bool {
        self.linear == Self::HERE.linear
    }

    /// Whether left becomes right.
    pub(super) fn is_mirrored(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    pub(super) fn point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.linear * point + self.shift
    }

    /// A direction or a force.
    pub(super) fn direction(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.linear * direction
    }

    /// A moment: in a mirror the axis of a turn is mirrored, and its sense is turned round.
    pub(super) fn moment(&self, moment: &Vector3<f64>) -> Vector3<f64> {
        let moment = self.linear * moment;
        if self.is_mirrored() { -moment } else { moment }
    }

    /// An inertia about the mass's centre.
    pub(super) fn inertia(&self, inertia: &Matrix3<f64>) -> Matrix3<f64> {
        self.linear * inertia * self.linear.transpose()
    }
}

/// Reads the places of copies: one kind of placing, or a list of them, of which each is done with all
/// copies that those before it made.
pub(super) fn read(fragment: Fragment<'_>) -> Result<Vec<Placement>, LoadError> {
    let expected =
        "places of copies, such as `Turned(axis: (0.0, 0.0, 1.0), count: 3)`, or a list of them";
    let steps = match fragment.is_list() {
        true => fragment.list(expected)?,
        false => vec![fragment],
    };
    let mut places = vec![Placement::HERE];
    for step in steps {
        let own = one(step)?;
        if places.len() * own.len() > MOST {
            return Err(step.error(format!("these are more than {MOST} copies")));
        }
        let with = |next: &Placement| {
            places
                .iter()
                .map(|place| place.then(next))
                .collect::<Vec<_>>()
        };
        places = own.iter().flat_map(with).collect();
    }
    Ok(places)
}

/// Reads one kind of placing.
fn one(fragment: Fragment<'_>) -> Result<Vec<Placement>, LoadError> {
    let expected = "`Turned(…)`, `Moved(…)` or `Mirrored(…)`";
    let (kind, arguments) = fragment.variant(expected)?;
    let owner = format!("`{}`", kind.text());
    let Some(known) = PLACING.fields(kind.text()) else {
        let other = kind.text();
        return Err(kind
            .error(format!("unknown way of placing copies `{other}`"))
            .unreadable()
            .with_help(names::help(
                other,
                "ways of placing copies",
                PLACING.names(),
            )));
    };
    let fields = match arguments {
        Some(given) => Fields::read(given, owner, &known)?.within(fragment),
        None => Fields::none(fragment, owner),
    };
    match kind.text() {
        "Turned" => turned(&fields),
        "Moved" => moved(&fields),
        _ => {
            let normal = fields.required("normal")?.direction()?.normalize();
            let reflection = Matrix3::identity() - 2.0 * normal * normal.transpose();
            let mirrored = Placement::about(&through(&fields)?, reflection);
            Ok(vec![Placement::HERE, mirrored])
        }
    }
}

/// Reads `Turned(axis: …, count: …)`: all round, or by `step` each; or `angles: […]`.
fn turned(fields: &Fields<'_>) -> Result<Vec<Placement>, LoadError> {
    let axis = Unit::new_normalize(fields.required("axis")?.direction()?);
    let point = through(fields)?;
    let angles = match fields.get("angles") {
        Some(list) => {
            if let Some(other) = fields.get("count").or(fields.get("step")) {
                return Err(other
                    .error("`angles` says already where the copies are")
                    .with_help("give `angles`, or `count` with or without `step`"));
            }
            let angles = list.list("a list of angles in rad")?;
            if angles.is_empty() {
                return Err(list.error("no angles make no copies"));
            }
            angles
                .into_iter()
                .map(|own| own.quantity("an angle", Dimension::ANGLE))
                .collect::<Result<Vec<_>, _>>()?
        }
        None => {
            let count = count(fields.required("count")?)?;
            let step = (fields.get("step"))
                .map(|step| step.quantity("`step`", Dimension::ANGLE))
                .transpose()?;
            let step = step.unwrap_or(std::f64::consts::TAU / count as f64);
            (0..count).map(|k| k as f64 * step).collect()
        }
    };
    let turned = |angle| match angle {
        0.0 => Placement::HERE,
        angle => Placement::about(
            &point,
            Rotation3::from_axis_angle(&axis, angle).into_inner(),
        ),
    };
    Ok(angles.into_iter().map(turned).collect())
}

/// Reads `Moved(by: (…), count: …)`, or `Moved(by: [(…), …])`.
fn moved(fields: &Fields<'_>) -> Result<Vec<Placement>, LoadError> {
    let by = fields.required("by")?;
    let moved = |shift: Vector3<f64>| Placement {
        shift,
        ..Placement::HERE
    };
    if let Some(number) = fields.get("count") {
        let (step, count) = (by.vector("`by`", Dimension::LENGTH)?, count(number)?);
        return Ok((0..count).map(|k| moved(k as f64 * step)).collect());
    }
    let expected = "a list of vectors, or one vector with a `count` of copies";
    if !by.is_list_of_tuples() {
        return Err(by.expected(expected));
    }
    let list = by.list(expected)?;
    if list.is_empty() {
        return Err(by.error("no vectors make no copies"));
    }
    list.into_iter()
        .map(|own| own.vector("`by`", Dimension::LENGTH).map(moved))
        .collect()
}

/// Reads a number of copies.
fn count(fragment: Fragment<'_>) -> Result<usize, LoadError> {
    let expected = format!("a whole number of copies from 1 to {MOST}");
    let count = fragment.count(&expected)?;
    if !(1..=MOST).contains(&count) {
        return Err(fragment.expected(&expected));
    }
    Ok(count)
}

/// The point that an axis or a plane goes through; the origin where none is given.
fn through(fields: &Fields<'_>) -> Result<Point3<f64>, LoadError> {
    let point = fields.get("through");
    let point = point
        .map(|point| point.vector("`through`", Dimension::LENGTH))
        .transpose()?;
    Ok(point.unwrap_or_default().into())
}
