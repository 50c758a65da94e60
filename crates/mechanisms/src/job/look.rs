//! How a figure of a mechanism looks: where it is seen from, and what stands beside it.

use std::str::FromStr;

use crate::error::LoadError;
use crate::text::dimension::Dimension;
use crate::text::fragment::{Entry, Fragment};
use crate::text::names;

/// How a figure of a mechanism looks.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Look {
    /// Where it is seen from; `None`: from +x, −y and +z, x to the right.
    pub view: Option<View>,
    /// What stands beside the mechanism.
    pub shown: Vec<Noted>,
}

/// Where a figure in space is seen from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Angle about z from +x to the eye, in the plane x y \[degrees\].
    pub azimuth: f64,
    /// Angle from this plane up to the eye, −90 to 90 \[degrees\].
    pub elevation: f64,
}

/// The views that have names.
const VIEWS: [(&str, f64, f64); 4] = [
    ("front", -90.0, 0.0),
    ("right", 0.0, 0.0),
    ("top", -90.0, 90.0),
    // All axes equally foreshortened.
    ("iso", -45.0, 35.264_389_682_754_654),
];

/// What would be right in the place of what is no view.
const VIEW: &str = "`front`, `right`, `top`, `iso`, or azimuth and elevation of the eye in degrees, \
                    such as -62,22";

impl View {
    /// The names that there are.
    pub const NAMES: [&str; 4] = [VIEWS[0].0, VIEWS[1].0, VIEWS[2].0, VIEWS[3].0];

    /// The view from these angles \[degrees\]; `None` where the azimuth is not between −360 and 360 or the
    /// elevation not between −90 and 90.
    pub fn angles(azimuth: f64, elevation: f64) -> Option<Self> {
        let fits = azimuth.abs() <= 360.0 && elevation.abs() <= 90.0;
        fits.then_some(Self { azimuth, elevation })
    }

    /// The view of this name: `front` from −y, `right` from +x, `top` from +z, `iso` from a corner.
    pub fn named(name: &str) -> Option<Self> {
        let (_, azimuth, elevation) = VIEWS.into_iter().find(|(own, ..)| *own == name)?;
        Some(Self { azimuth, elevation })
    }
}

impl FromStr for View {
    type Err = String;

    /// Reads a name, or azimuth and elevation in degrees, `-62,22`.
    fn from_str(text: &str) -> Result<Self, String> {
        let angles = || {
            let (azimuth, elevation) = text.split_once(',')?;
            Self::angles(azimuth.trim().parse().ok()?, elevation.trim().parse().ok()?)
        };
        let found = Self::named(text).or_else(angles);
        found.ok_or_else(|| format!("give {VIEW}"))
    }
}

/// What can stand beside a mechanism in a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Noted {
    /// Names of joints and bodies.
    Names,
    /// Forces and moments on points.
    Loads,
    /// Masses.
    Masses,
    /// Frames of joints.
    Frames,
    /// Which pose it is, by its coordinates, in the caption.
    Pose,
}

impl Noted {
    /// Their names.
    pub const WORDS: [(&'static str, Self); 5] = [
        ("names", Self::Names),
        ("loads", Self::Loads),
        ("masses", Self::Masses),
        ("frames", Self::Frames),
        ("pose", Self::Pose),
    ];
}

/// What a figure and what is in it are called.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Words {
    /// The title; `None`: one that says what is drawn.
    pub title: Option<String>,
    /// Names of quantities and coordinates, each with what it is called in the figure.
    pub labels: Vec<(String, String)>,
}

/// Reads what names are called in a figure, `{"k33": "along the spindle"}`.
pub(super) fn labels(fragment: Fragment<'_>) -> Result<Vec<(String, String)>, LoadError> {
    let entries = fragment.map()?;
    let entry = |entry: Entry<'_>| Ok((entry.name, entry.value.string()?));
    entries.into_iter().map(entry).collect()
}

/// Reads what is marked in a map, `["least", "most"]`.
pub(super) fn marks(fragment: Fragment<'_>) -> Result<Vec<Mark>, LoadError> {
    let items = fragment.list("a list such as `[\"least\"]`")?;
    let item = |item: Fragment<'_>| {
        let word = item.string()?;
        word.parse().map_err(|help: String| {
            (item.error(format!("`{word}` cannot be marked in a map"))).with_help(help)
        })
    };
    items.into_iter().map(item).collect()
}

/// What a map marks where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// The least value.
    Least,
    /// The largest value.
    Most,
}

impl Mark {
    /// Their names.
    pub const WORDS: [(&'static str, Self); 2] = [("least", Self::Least), ("most", Self::Most)];
}

impl FromStr for Mark {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::WORDS.iter().find(|(word, _)| *word == text);
        found.map(|(_, mark)| *mark).ok_or_else(|| {
            let words = Self::WORDS.map(|(word, _)| word);
            names::help(text, "words", words)
        })
    }
}

impl FromStr for Noted {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::WORDS.iter().find(|(word, _)| *word == text);
        found.map(|(_, noted)| *noted).ok_or_else(|| {
            let words = Self::WORDS.map(|(word, _)| word);
            names::help(text, "words", words)
        })
    }
}

/// Reads a view: a name, or `(azimuth, elevation)` in degrees.
pub(super) fn view(fragment: Fragment<'_>) -> Result<View, LoadError> {
    let wrong = |error: LoadError| {
        error.with_help(format!("give {VIEW}").replace("-62,22", "`(-62.0, 22.0)`"))
    };
    if let Ok([azimuth, elevation]) = fragment.array("") {
        let found = View::angles(degrees(azimuth)?, degrees(elevation)?);
        let message = "an azimuth is between -360 and 360 degrees, an elevation between -90 and 90";
        return found.ok_or_else(|| wrong(fragment.error(message)));
    }
    let name = fragment.string().map_err(wrong)?;
    View::named(&name).ok_or_else(|| wrong(fragment.error(format!("unknown view `{name}`"))))
}

/// Reads an angle; a number without a unit is one in degrees.
fn degrees(fragment: Fragment<'_>) -> Result<f64, LoadError> {
    match fragment.measured(Some(Dimension::ANGLE))? {
        (angle, None) => Ok(angle),
        (angle, Some(Dimension::ANGLE)) => Ok(angle.to_degrees()),
        (_, Some(other)) => {
            Err(fragment.of_dimension("an angle of a view", Dimension::ANGLE, other))
        }
    }
}

/// Reads what is to stand beside the mechanism, `["names", "loads"]`.
pub(super) fn shown(fragment: Fragment<'_>) -> Result<Vec<Noted>, LoadError> {
    let items = fragment.list("a list such as `[\"names\", \"loads\"]`")?;
    let item = |item: Fragment<'_>| {
        let word = item.string()?;
        word.parse().map_err(|help: String| {
            (item.error(format!("`{word}` cannot be shown in a figure"))).with_help(help)
        })
    };
    items.into_iter().map(item).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_have_names_or_angles() {
        assert_eq!(
            "front".parse(),
            Ok(View {
                azimuth: -90.0,
                elevation: 0.0
            })
        );
        assert_eq!(
            "-62, 22".parse(),
            Ok(View {
                azimuth: -62.0,
                elevation: 22.0
            })
        );
        for wrong in ["left", "1", "1,91", "nan,0", "1,2,3", ""] {
            assert!(wrong.parse::<View>().is_err(), "{wrong}");
        }
        assert_eq!("loads".parse(), Ok(Noted::Loads));
        assert_eq!("load".parse::<Noted>(), Err("did you mean `loads`?".into()));
    }
}
