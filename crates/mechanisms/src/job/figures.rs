//! The figures that a job asks for.

use super::look::{self, Look, Mark, Words};
use crate::error::LoadError;
use crate::job::modes;
use crate::terms::figures::FIGURE;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::source::Place;
use crate::text::{csv, names, quantities};

/// A figure that a job asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Figure {
    /// The deflected trajectory over the commanded one (Fig. 8).
    Trajectory {
        /// Magnification of the deflection.
        scale: Scale,
        /// Title and names.
        words: Words,
    },
    /// The deformed mechanism over the undeformed one (Fig. 9).
    Deformed {
        /// The pose to draw.
        pose: FigurePose,
        /// The case under whose loads; the loads of the base state where there is none.
        case: Option<String>,
        /// Magnification of the deflection.
        scale: Scale,
        /// How it looks.
        look: Look,
        /// Title and names.
        words: Words,
    },
    /// A natural mode over the mechanism at rest.
    Mode {
        /// Which mode, from 1, lowest first.
        number: usize,
        /// The pose to draw.
        pose: FigurePose,
        /// Magnification of the shape of unit modal mass.
        scale: Scale,
        /// How it looks.
        look: Look,
        /// Title and names.
        words: Words,
    },
    /// The shares of bodies, joints and deformations in the displacement of the output, as bars.
    Budget {
        /// The displacement along which.
        along: Along,
        /// The pose.
        pose: FigurePose,
        /// The case under whose loads; the loads of the base state where there is none.
        case: Option<String>,
        /// Its title.
        title: Option<String>,
    },
    /// A quantity over a plane of the poses, or over all of their planes.
    Map {
        /// Name of the quantity: a column of the job's table, or what is found from columns.
        value: String,
        /// Coordinates that are held on all planes, each with its value: of `x y z rx ry rz`, or drives such as
        /// `A1.v`.
        plane: Vec<(String, f64)>,
        /// Planes side by side, on each of which one of these is held besides, along axes of its own.
        planes: Vec<(String, f64)>,
        /// The coordinates to the right and up; `None`: two of those that the poses give.
        axes: Option<[String; 2]>,
        /// The values, in the SI unit, at which the colours begin and end, ascending; `None`: the
        /// least and the largest.
        limits: Option<[f64; 2]>,
        /// What the limits measure, where they are given with a unit.
        measured: Option<Dimension>,
        /// How the colours go from one to the other.
        scale: ColorScale,
        /// What is marked where it stands.
        marks: Vec<Mark>,
        /// Another design of the job, drawn beside the first in the same colours.
        beside: Option<usize>,
        /// Whether in place of both the ratio of that design to the first is drawn.
        ratio: bool,
        /// Title and names.
        words: Words,
    },
}

/// Which pose of the job a figure is of.
#[derive(Debug, Clone, PartialEq)]
pub enum FigurePose {
    /// By its number, from 0.
    Number(usize),
    /// By coordinates that the poses give, of `x y z rx ry rz`, or drives such as `A1.v`, each with its value.
    At(Vec<(String, f64)>),
}

impl From<usize> for FigurePose {
    fn from(number: usize) -> Self {
        Self::Number(number)
    }
}

/// How the colours of a map go with its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColorScale {
    /// Chosen so that most values can be told apart.
    #[default]
    Auto,
    /// Evenly with the values.
    Linear,
    /// Evenly with their logarithms.
    Log,
}

/// A direction that the output gives along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Along {
    /// Of its displacement under the loads.
    Displacement,
    /// Of this unit wrench on it: force, moment, global axes.
    Wrench([f64; 6]),
}

impl Along {
    /// The words that name a direction.
    pub const WORDS: [&'static str; 7] = ["displacement", "x", "y", "z", "rx", "ry", "rz"];

    /// The direction that one of [`Along::WORDS`] names.
    pub fn named(word: &str) -> Option<Self> {
        match Self::WORDS.iter().position(|known| *known == word)? {
            0 => Some(Self::Displacement),
            k => {
                let mut wrench = [0.0; 6];
                wrench[k - 1] = 1.0;
                Some(Self::Wrench(wrench))
            }
        }
    }

    /// A direction in space, of any length but zero; `None` where it has none.
    pub fn direction(components: [f64; 3]) -> Option<Self> {
        let [a, b, c] = components;
        let length = a.hypot(b).hypot(c);
        if !(length.is_finite() && length > 0.0) {
            return None;
        }
        Some(Self::Wrench([
            a / length,
            b / length,
            c / length,
            0.0,
            0.0,
            0.0,
        ]))
    }
}

/// Magnification of deflections in a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Chosen so that the deflections can be seen.
    Auto,
    /// This factor, above zero.
    Factor(f64),
}

/// What a job has that its figures may name.
pub(crate) struct Known<'a> {
    /// Number of poses.
    pub(crate) poses: usize,
    /// Names of the cases.
    pub(crate) cases: &'a [String],
}

/// Reads the figures of a job, each with its place: that of the quantity, of a map.
pub(crate) fn read(
    list: Fragment<'_>,
    known: &Known<'_>,
) -> Result<Vec<(Figure, Places)>, LoadError> {
    let list = list.list("a list of figures, such as `[Deformed(pose: 0, scale: Auto)]`")?;
    list.into_iter().map(|item| figure(item, known)).collect()
}

fn figure(whole: Fragment<'_>, known: &Known<'_>) -> Result<(Figure, Places), LoadError> {
    let (word, arguments) = whole.variant("a figure, such as `Trajectory(scale: Auto)`")?;
    let kind = word.text();
    let names = FIGURE.fields(kind).ok_or_else(|| {
        word.error(format!("unknown figure `{kind}`"))
            .with_help(names::help(kind, "figures", FIGURE.names()))
    })?;
    let owner = format!("`{kind}`");
    let fields = match arguments {
        Some(given) => Fields::read(given, owner, &names)?,
        None => Fields::none(whole, owner),
    };
    let pose = || {
        let given = fields.get("pose");
        given.map_or(Ok(FigurePose::Number(0)), |at| pose(at, known.poses))
    };
    let case = || fields.get("case").map(|at| case(at, known)).transpose();
    let scale = || fields.get("scale").map_or(Ok(Scale::Auto), scale);
    let look = || -> Result<Look, LoadError> {
        Ok(Look {
            view: fields.get("view").map(look::view).transpose()?,
            shown: fields.get("show").map_or(Ok(Vec::new()), look::shown)?,
        })
    };
    let title = || fields.get("title").map(Fragment::string).transpose();
    let words = || -> Result<Words, LoadError> {
        Ok(Words {
            title: title()?,
            labels: fields.get("labels").map_or(Ok(Vec::new()), look::labels)?,
        })
    };
    let given = names
        .iter()
        .filter_map(|&name| Some((name, fields.get(name)?.place())));
    let places = Places {
        whole: whole.place(),
        fields: given.collect(),
    };
    let figure = match kind {
        "Map" => {
            let scale = fields
                .get("scale")
                .map_or(Ok(ColorScale::Auto), color_scale)?;
            let limits = |at| limits(at, scale);
            let limits = fields.get("limits").map(limits).transpose()?;
            Figure::Map {
                value: fields.required("value")?.string()?,
                plane: fields.get("plane").map_or(Ok(Vec::new()), planes)?,
                planes: own_planes(&fields)?,
                axes: fields.get("axes").map(axes).transpose()?,
                limits: limits.map(|(limits, _)| limits),
                measured: limits.and_then(|(_, measured)| measured),
                scale,
                marks: fields.get("mark").map_or(Ok(Vec::new()), look::marks)?,
                beside: beside(&fields)?,
                ratio: ratio(&fields)?,
                words: words()?,
            }
        }
        "Deformed" => Figure::Deformed {
            pose: pose()?,
            case: case()?,
            scale: scale()?,
            look: look()?,
            words: words()?,
        },
        "Mode" => Figure::Mode {
            number: fields.get("number").map_or(Ok(1), number)?,
            pose: pose()?,
            scale: scale()?,
            look: look()?,
            words: words()?,
        },
        "Budget" => Figure::Budget {
            along: fields.get("along").map_or(Ok(Along::Displacement), along)?,
            pose: pose()?,
            case: case()?,
            title: title()?,
        },
        _ if known.poses < 2 => {
            return Err(whole
                .error("a trajectory needs two poses or more, this job has one")
                .with_help("use `Deformed` to see a single pose"));
        }
        _ => Figure::Trajectory {
            scale: scale()?,
            words: words()?,
        },
    };
    Ok((figure, places))
}

/// Where a figure is written.
#[derive(Debug, Clone)]
pub(crate) struct Places {
    whole: Place,
    /// Its fields that are given.
    fields: Vec<(&'static str, Place)>,
}

impl Places {
    /// Where the first of these fields that is given is written, else its quantity, else the whole.
    pub(super) fn of(&self, fields: &[&str]) -> &Place {
        let find = |field: &&str| self.fields.iter().find(|(name, _)| name == field);
        let found = fields.iter().chain([&"value"]).find_map(find);
        found.map_or(&self.whole, |(_, place)| place)
    }
}

/// Reads the number of the design that is drawn beside the first.
fn beside(fields: &Fields<'_>) -> Result<Option<usize>, LoadError> {
    let given = fields.get("beside");
    given
        .map(|at| at.count("the number of a design, from 0"))
        .transpose()
}

/// Reads whether a ratio is drawn.
fn ratio(fields: &Fields<'_>) -> Result<bool, LoadError> {
    let Some(at) = fields.get("ratio") else {
        return Ok(false);
    };
    let ratio = at.parse("`true` or `false`")?;
    if ratio && fields.get("beside").is_none() {
        return Err(at
            .error("a ratio is of two designs")
            .with_help("name the other one, such as `beside: 1`"));
    }
    if let Some(scale) = fields.get("scale").filter(|_| ratio) {
        return Err(scale
            .error("the colours of a ratio part at 1")
            .with_help("leave `scale` out, or `ratio`"));
    }
    Ok(ratio)
}

/// Reads the name of a case.
fn case(fragment: Fragment<'_>, known: &Known<'_>) -> Result<String, LoadError> {
    let name = fragment.string()?;
    if known.cases.contains(&name) {
        return Ok(name);
    }
    let cases = known.cases.iter().map(String::as_str);
    Err(fragment
        .error(format!("there is no case `{name}`"))
        .with_help(names::help(&name, "cases", cases)))
}

/// Reads the number of a mode.
fn number(fragment: Fragment<'_>) -> Result<usize, LoadError> {
    let expected = format!("the number of a mode, 1 to {}", modes::MOST);
    match fragment.count::<usize>(&expected)? {
        number if (1..=modes::MOST).contains(&number) => Ok(number),
        _ => Err(fragment.expected(&expected)),
    }
}

/// Reads a direction such as `z` or `(0.0, 1.0, -1.0)`.
fn along(fragment: Fragment<'_>) -> Result<Along, LoadError> {
    if fragment.is_tuple() {
        let numbers = fragment.array("a direction of three numbers, such as `(0.0, 1.0, -1.0)`")?;
        let [a, b, c] = numbers;
        let part = |part: Fragment<'_>| part.quantity("a part of a direction", Dimension::NUMBER);
        let components = [part(a)?, part(b)?, part(c)?];
        return Along::direction(components).ok_or_else(|| {
            fragment
                .error("the direction has no length")
                .with_help("give three numbers that are not all zero, such as `(0.0, 1.0, -1.0)`")
        });
    }
    let word = fragment.word();
    Along::named(word).ok_or_else(|| {
        fragment
            .error(format!("`{word}` is no direction"))
            .with_help(format!(
                "give one of `{}`, or three numbers such as `(0.0, 1.0, -1.0)`",
                Along::WORDS.join("`, `")
            ))
    })
}

/// Reads planes side by side, which have axes of their own.
fn own_planes(fields: &Fields<'_>) -> Result<Vec<(String, f64)>, LoadError> {
    let Some(given) = fields.get("planes") else {
        return Ok(Vec::new());
    };
    if let Some(axes) = fields.get("axes") {
        let error = axes.error("`axes` and `planes` are given, which have axes of their own");
        return Err(error.with_help("leave one of them out"));
    }
    let read = given.list(PLANES)?.into_iter().map(plane);
    let read = read.collect::<Result<Vec<_>, _>>()?;
    match read.is_empty() {
        true => Err(given.error("there is no plane in it").with_help(
            "give planes such as `[x(0.0), y(0.0), z(0.5)]`, or leave `planes` out for all that there are",
        )),
        false => Ok(read),
    }
}

/// Reads a plane such as `z(0.5)`, or a list of them.
fn planes(fragment: Fragment<'_>) -> Result<Vec<(String, f64)>, LoadError> {
    // A drive of JSON is a list, too.
    let drive = fragment.is_json()
        && (fragment.list(PLANE).ok()).is_some_and(|items| {
            let first = items.first();
            first.is_some_and(|first| first.string().is_ok())
        });
    match fragment.is_list() && !drive {
        true => (fragment.list(PLANE)?.into_iter()).map(plane).collect(),
        false => plane(fragment).map(|plane| vec![plane]),
    }
}

const PLANES: &str = "planes, such as `[x(0.0), y(0.0), z(0.5)]`";

const PLANE: &str = "a plane, such as `z(0.5)`, or of a drive `(\"A1.v\", 0.5)`";

/// Reads `z(0.5)` or `("A1.v", 0.5)`.
fn plane(fragment: Fragment<'_>) -> Result<(String, f64), LoadError> {
    if fragment.is_tuple() {
        let [drive, value] = fragment.array(PLANE)?;
        return Ok((drive.string()?, value.number()?));
    }
    let (kind, Some(arguments)) = fragment.variant(PLANE)? else {
        return Err(fragment.expected(PLANE));
    };
    let coordinate = coordinate(kind)?;
    let [value] = arguments.array(PLANE)?;
    let place = csv::COLUMNS.iter().position(|name| *name == coordinate);
    let dimension = quantities::displacement()[place.unwrap_or(0)];
    let value = value.quantity(&format!("`{coordinate}`"), dimension)?;
    Ok((coordinate, value))
}

/// Reads `(rx, ry)`, or of drives `("A1.v", "A2.v")`.
fn axes(fragment: Fragment<'_>) -> Result<[String; 2], LoadError> {
    let expected = "two coordinates, such as `(x, z)`, or drives, `(\"A1.v\", \"A2.v\")`";
    let read = |axis: Fragment<'_>| match axis.variant("") {
        Ok((word, None)) if csv::COLUMNS.contains(&word.text()) => coordinate(word),
        _ if axis.text().starts_with('"') => axis.string(),
        _ => coordinate(axis),
    };
    let [right, up] = fragment.array(expected)?;
    let axes = [read(right)?, read(up)?];
    if axes[0] == axes[1] {
        return Err(fragment
            .error(format!("`{}` is along both axes", axes[0]))
            .with_help("give two coordinates, such as `(x, z)`"));
    }
    Ok(axes)
}

/// A coordinate of a pose by its name.
fn coordinate(word: Fragment<'_>) -> Result<String, LoadError> {
    let name = word.text();
    if csv::COLUMNS.contains(&name) {
        return Ok(name.into());
    }
    Err(word
        .error(format!("`{name}` is no coordinate of a pose"))
        .with_help(names::help(name, "coordinates", csv::COLUMNS)))
}

/// Reads the values at which colours begin and end, and what they measure, if they say so.
fn limits(
    fragment: Fragment<'_>,
    scale: ColorScale,
) -> Result<([f64; 2], Option<Dimension>), LoadError> {
    let [low, high] = fragment.array("two values, such as `(1e-5, 1e-3)`")?;
    let [first, last] = [low.measured(None)?, high.measured(None)?];
    if let (Some(wanted), Some(other)) = (first.1, last.1)
        && wanted != other
    {
        return Err(high.of_dimension("the lower limit", wanted, other));
    }
    let (limits, measured) = ([first.0, last.0], first.1.or(last.1));
    if limits[0] >= limits[1] {
        return Err(fragment
            .error("the colours must begin below where they end")
            .with_help("give the lower value first, such as `(1e-5, 1e-3)`"));
    }
    if scale == ColorScale::Log && limits[0] <= 0.0 {
        return Err(low
            .error("a logarithmic scale begins above zero")
            .with_help("give a lower value above zero, or `scale: Linear`"));
    }
    Ok((limits, measured))
}

/// Reads how colours go with values.
fn color_scale(fragment: Fragment<'_>) -> Result<ColorScale, LoadError> {
    match fragment.word() {
        "Auto" => Ok(ColorScale::Auto),
        "Linear" => Ok(ColorScale::Linear),
        "Log" => Ok(ColorScale::Log),
        _ => Err(fragment.expected("a scale of colours, `Auto`, `Linear` or `Log`")),
    }
}

fn scale(fragment: Fragment<'_>) -> Result<Scale, LoadError> {
    if fragment.word() == "Auto" {
        return Ok(Scale::Auto);
    }
    let expected = "`Auto` or a factor above zero, such as `50.0`";
    let factor = match fragment.text().starts_with('"') {
        true => {
            let no_number = |error: LoadError| match error.message().starts_with("expected") {
                true => fragment.expected(expected),
                false => error,
            };
            (fragment.quantity("a factor", Dimension::NUMBER)).map_err(no_number)?
        }
        false => fragment.parse::<f64>(expected)?,
    };
    match factor {
        factor if factor.is_finite() && factor > 0.0 => Ok(Scale::Factor(factor)),
        _ => Err(fragment.expected(expected)),
    }
}

/// Reads the number of a pose, or its coordinates, `(x: 0.1, z: 0.5)`, or drives, `{ "A1.v": 0.2 }`.
fn pose(fragment: Fragment<'_>, poses: usize) -> Result<FigurePose, LoadError> {
    let at = |name: &str, value: Fragment<'_>| {
        let place = csv::COLUMNS.iter().position(|own| *own == name);
        let value = match place {
            Some(place) => csv::quantity(place, value)?,
            None => value.number()?,
        };
        Ok::<_, LoadError>((name.to_owned(), value))
    };
    // In JSON both are objects.
    let given: Vec<_> = if fragment.text().starts_with('{') {
        let entries = fragment.map()?.into_iter();
        let given = entries.map(|entry| at(&entry.name, entry.value));
        given.collect::<Result<_, _>>()?
    } else if fragment.has_fields() {
        let fields = Fields::read(fragment, "the pose", &csv::COLUMNS)?;
        let given = csv::COLUMNS.iter();
        let given = given.filter_map(|name| Some(at(name, fields.get(name)?)));
        given.collect::<Result<_, _>>()?
    } else {
        let pose = fragment.count(POSE)?;
        if pose >= poses {
            return Err(fragment
                .error(format!("there is no pose {pose}"))
                .with_help(format!("the job's poses are 0 to {}", poses - 1)));
        }
        return Ok(FigurePose::Number(pose));
    };
    match given.is_empty() {
        true => Err(fragment.expected(POSE)),
        false => Ok(FigurePose::At(given)),
    }
}

/// What a pose is.
const POSE: &str =
    "the number of a pose, from 0, or coordinates of one, such as `(x: 0.1, z: 0.5)`";
