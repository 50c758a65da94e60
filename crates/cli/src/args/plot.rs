//! The options of `hyperstat plot`.

use std::fmt;
use std::path::PathBuf;

use clap::{ArgGroup, Args};
use hyperstat_figures::Extreme;
use hyperstat_mechanisms::{Along, Noted, View};

use super::input::along;

/// `hyperstat plot`
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("second").multiple(true))]
pub(crate) struct Plot {
    /// What to draw: a table of `run` (CSV, Parquet), a mechanism or batch file (RON or JSON), or the JSON
    /// of `solve --why`
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) kind: PlotKind,
    /// Map: the plane, such as z=0.5 (or of a drive, A1.v=0.2); several where poses differ in more.
    /// Without it, all planes
    #[arg(long, value_name = "AXIS=VALUE", value_parser = plane, requires = "map", conflicts_with_all = ["lines", "trajectory", "deformed", "mode", "budget"])]
    pub(crate) plane: Vec<(String, f64)>,
    /// Map: planes of different axes side by side, such as x=0,y=0,z=0.5, in one set of colours
    #[arg(long, value_name = "AXIS=VALUE,…", value_delimiter = ',', value_parser = plane, requires = "map", conflicts_with_all = ["axes", "lines", "trajectory", "deformed", "mode", "budget"])]
    pub(crate) planes: Vec<(String, f64)>,
    /// Map: the coordinates to the right and up, such as x,z (or drives, A1.v,A2.v) [default: two of
    /// those that the poses were asked for by]
    #[arg(long, value_name = "X,Y", value_parser = axes, requires = "map", conflicts_with_all = ["lines", "trajectory", "deformed", "mode", "budget"])]
    pub(crate) axes: Option<[String; 2]>,
    /// Map: where the colours begin and end, in the SI unit, such as 1e-5,1e-3 [default: the least
    /// and the largest value]
    #[arg(
        long,
        value_name = "LOW,HIGH",
        value_parser = limits,
        requires = "map",
        conflicts_with_all = ["lines", "trajectory", "deformed", "mode", "budget"],
        allow_hyphen_values = true
    )]
    pub(crate) limits: Option<[f64; 2]>,
    /// Map: what is marked where it stands, with its value: least, most or both
    #[arg(long, value_name = "WHAT,…", value_delimiter = ',', value_parser = mark, requires = "map", conflicts_with_all = ["lines", "trajectory", "deformed", "mode", "budget"])]
    pub(crate) mark: Vec<Extreme>,
    /// Map: another table, drawn beside the first in the same colours
    #[arg(long, value_name = "TABLE", group = "second", requires = "map", conflicts_with_all = ["lines", "trajectory", "deformed", "mode", "budget"])]
    pub(crate) beside: Option<PathBuf>,
    /// Map: the design of what is drawn beside the first, of the same table where there is no other
    #[arg(long, value_name = "N", group = "second", requires = "map", conflicts_with_all = ["lines", "trajectory", "deformed", "mode", "budget"], allow_negative_numbers = true)]
    pub(crate) with_design: Option<usize>,
    /// Map: in place of both the ratio of the one beside to the first
    #[arg(long, requires = "second", conflicts_with = "scale")]
    pub(crate) ratio: bool,
    /// Lines: the column along the lower axis [default: pose]
    #[arg(long, value_name = "COLUMN", requires = "lines", conflicts_with_all = ["map", "trajectory", "deformed", "mode", "budget"])]
    pub(crate) over: Option<String>,
    /// Deformed, budget: the case of the mechanism or the job [default: the loads of no case]
    #[arg(long, value_name = "NAME", conflicts_with_all = ["map", "lines", "trajectory", "mode"])]
    pub(crate) case: Option<String>,
    /// Deformed: mark the points of the independent solver too, and tell the largest difference
    #[arg(long, requires = "deformed", conflicts_with_all = ["case", "map", "lines", "trajectory", "mode", "budget"])]
    pub(crate) verify: bool,
    /// Budget: the direction, as of `solve --why` [default: displacement]
    #[arg(long, value_name = "DIRECTION", requires = "budget", conflicts_with_all = ["map", "lines", "trajectory", "deformed", "mode"], value_parser = along, allow_hyphen_values = true)]
    pub(crate) along: Option<Along>,
    /// Trajectory, deformed, mode: magnification [default: a round number that shows it]. Map:
    /// `log` or `linear` colours [default: log where most values would share a colour]
    #[arg(long, value_name = "SCALE", value_parser = scale, allow_negative_numbers = true, conflicts_with_all = ["lines", "budget"])]
    pub(crate) scale: Option<Scale>,
    /// Job of a batch file; may be left out where there is only one
    #[arg(long, value_name = "NAME")]
    pub(crate) job: Option<String>,
    /// Design of a job that varies [default: 0; all where lines are over what varies]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) design: Option<usize>,
    /// Pose, by its number or its coordinates, such as x=0.1,y=0,z=0.5 [default: all of a table; 0 of a batch
    /// file, or where lines are over what varies]
    #[arg(long, value_name = "N|AXIS=VALUE,…", value_parser = pose, allow_negative_numbers = true)]
    pub(crate) pose: Option<Pose>,
    /// Deformed, mode: a picture that moves (SVG, GIF): the mode swings; a job's poses run, or with `--pose`
    /// the load comes and goes
    #[arg(long, conflicts_with_all = ["map", "lines", "trajectory", "budget", "verify"])]
    pub(crate) animate: bool,
    /// Trajectory, deformed, mode: where it is seen from: front, right, top, iso, or azimuth and elevation of
    /// the eye in degrees, such as -62,22
    #[arg(long, value_name = "VIEW", conflicts_with_all = ["map", "lines", "budget"], allow_hyphen_values = true)]
    pub(crate) view: Option<View>,
    /// Deformed, mode: what stands beside the mechanism, some of names,loads,masses,frames; pose is its
    /// coordinates in the caption
    #[arg(long, value_name = "WHAT,…", value_delimiter = ',', conflicts_with_all = ["map", "lines", "budget", "trajectory"])]
    pub(crate) show: Vec<Noted>,
    /// Title of the figure [default: the name of the job or of the mechanism]
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,
    /// What a quantity or a coordinate is called in the figure, such as k33=\"along the spindle\"; more than
    /// once for several
    #[arg(long, value_name = "NAME=TEXT", value_parser = label, conflicts_with = "budget")]
    pub(crate) label: Vec<(String, String)>,
    /// Write a PDF, too
    #[arg(long)]
    pub(crate) pdf: bool,
    /// Write NAME.svg and NAME.png [default: beside the file, <job>-<figure>]
    #[arg(long, value_name = "NAME")]
    pub(crate) out: Option<PathBuf>,
}

/// A pose that is chosen.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Pose {
    Number(usize),
    /// Coordinates of the output or drives, each with its value.
    At(Vec<(String, f64)>),
}

/// Reads `12`, or `x=0.1,z=0.5`.
fn pose(text: &str) -> Result<Pose, String> {
    if let Ok(number) = text.parse() {
        return Ok(Pose::Number(number));
    }
    let at = text.split(',').map(plane).collect::<Result<_, _>>();
    at.map(Pose::At).map_err(|_| {
        "expected the number of a pose, from 0, or its coordinates, such as x=0.1,z=0.5".into()
    })
}

/// What is to be drawn.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub(crate) struct PlotKind {
    /// A map of a quantity over a plane of the workspace, or over several
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) map: Option<String>,
    /// Quantities as lines along the poses, or over a column
    #[arg(long, value_name = "QUANTITY,…", value_delimiter = ',')]
    pub(crate) lines: Option<Vec<String>>,
    /// The commanded trajectory and the deflected one, in space
    #[arg(long)]
    pub(crate) trajectory: bool,
    /// The mechanism undeformed and deformed, in space
    #[arg(long)]
    pub(crate) deformed: bool,
    /// Natural mode N (from 1, lowest first) and the mechanism at rest, in space
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) mode: Option<u16>,
    /// What the deflection comes from: shares of bodies, joints and deformations as bars
    #[arg(long)]
    pub(crate) budget: bool,
}

/// A magnification, or how colours go with values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scale {
    /// Above zero.
    Factor(f64),
    Linear,
    Log,
}

impl fmt::Display for Scale {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Factor(factor) => write!(f, "{factor}"),
            Self::Linear => f.write_str("linear"),
            Self::Log => f.write_str("log"),
        }
    }
}

/// Reads a scale.
fn scale(text: &str) -> Result<Scale, String> {
    match (text, text.parse::<f64>()) {
        ("linear", _) => Ok(Scale::Linear),
        ("log", _) => Ok(Scale::Log),
        (_, Ok(factor)) if factor.is_finite() && factor > 0.0 => Ok(Scale::Factor(factor)),
        _ => Err("expected a factor above zero, such as 200, or of a map `log` or `linear`".into()),
    }
}

/// Reads `1e-5,1e-3`.
fn limits(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|n| n.is_finite());
    let both = text.split_once(',');
    match both.and_then(|(low, high)| Some([number(low)?, number(high)?])) {
        Some([low, high]) if low < high => Ok([low, high]),
        _ => Err("expected two numbers, the lower one first, such as 1e-5,1e-3".into()),
    }
}

/// Reads `z=0.5`.
fn plane(text: &str) -> Result<(String, f64), String> {
    let wrong = || format!("expected a coordinate and its value, such as z=0.5, found `{text}`");
    let (axis, value) = text.split_once('=').ok_or_else(wrong)?;
    match value.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((axis.trim().into(), value)),
        _ => Err(wrong()),
    }
}

/// Reads `least` or `most`.
fn mark(text: &str) -> Result<Extreme, String> {
    match text {
        "least" => Ok(Extreme::Least),
        "most" => Ok(Extreme::Most),
        _ => Err("expected `least`, `most`, or both, `least,most`".into()),
    }
}

/// Reads `k33=along the spindle`.
fn label(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, label)) if !name.trim().is_empty() && !label.trim().is_empty() => {
            Ok((name.trim().into(), label.trim().into()))
        }
        _ => Err("expected a name and what it is to be called, such as k33=\"along z\"".into()),
    }
}

/// Reads `x,z`.
fn axes(text: &str) -> Result<[String; 2], String> {
    match text.split_once(',') {
        Some((right, up)) if right.trim() != up.trim() => {
            Ok([right.trim().into(), up.trim().into()])
        }
        _ => Err("expected two coordinates, such as x,z".into()),
    }
}
