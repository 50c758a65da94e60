//! The coordinates of points and the parts of axes that a file writes as numbers, and what they may have
//! been rounded to.

use std::sync::Arc;

use crate::text::digits;
use crate::text::source::Place;
use crate::text::tree::{Node, Steps};

/// Numbers with more digits are not rounded.
const DIGITS: i32 = 11;
/// A number that needs fewer decimals than others of its kind by more than this looks exact: of rounded
/// ones one in a thousand does.
const FEWER: i32 = 2;

/// What coordinates are rounded to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Digits {
    /// So many digits behind the point.
    Decimals(usize),
    /// So many digits that count.
    Significant(usize),
}

/// A number of the file.
#[derive(Debug, Clone)]
pub(super) struct Coordinate {
    pub path: String,
    pub steps: Steps,
    pub place: Place,
    pub digits: digits::Digits,
    /// SI.
    pub value: f64,
    /// What its last digit is worth.
    pub rounding: f64,
    is_axis: bool,
}

/// Numbers that may move, with a guess at their rounding.
#[derive(Debug)]
pub(super) struct Coordinates {
    pub all: Vec<Coordinate>,
    pub rounded: Digits,
}

impl Coordinates {
    /// What the file may have been rounded to, the likeliest first: to decimals, points and axes alike, or
    /// each kind by itself, numbers that look exact being so; the same without this; to digits that count.
    pub fn guesses(numbers: Numbers<'_>) -> impl Iterator<Item = Self> {
        let all = numbers.read();
        let most = |axes: bool| {
            let own = all.iter().filter(|own| own.is_axis == axes);
            own.map(|own| own.digits.decimals).max()
        };
        let each = [most(false), most(true)];
        let alike = each.into_iter().flatten().max().unwrap_or(0);
        let significant = all
            .iter()
            .map(|own| own.digits.significant)
            .max()
            .unwrap_or(0);
        let by_decimals = |decimals: [i32; 2], fewest: i32| {
            let rounding = |own: &Coordinate| {
                let decimals = decimals[usize::from(own.is_axis)];
                (own.digits.needed >= decimals - fewest).then(|| 10f64.powi(-decimals))
            };
            Self {
                all: with(&all, rounding),
                rounded: Digits::Decimals(alike.max(0) as usize),
            }
        };
        let by_digits = |own: &Coordinate| {
            let first = own.value.abs().log10().floor();
            (own.value != 0.0).then(|| 10f64.powi(first as i32 + 1 - significant))
        };
        let each = each.map(|decimals| decimals.unwrap_or(alike));
        let mut guesses = vec![by_decimals([alike; 2], FEWER), by_decimals(each, FEWER)];
        guesses.push(by_decimals(each, i32::MAX / 2));
        guesses.push(Self {
            all: with(&all, by_digits),
            rounded: Digits::Significant(significant.max(0) as usize),
        });
        if each[0] == each[1] {
            guesses.remove(0);
        }
        guesses.into_iter().filter(|guess| !guess.all.is_empty())
    }
}

/// Those numbers that have a rounding.
fn with(all: &[Coordinate], rounding: impl Fn(&Coordinate) -> Option<f64>) -> Vec<Coordinate> {
    let own = all.iter().filter_map(|own| {
        let rounding = rounding(own)?;
        Some(Coordinate {
            rounding,
            ..own.clone()
        })
    });
    own.collect()
}

/// Which numbers of points and axes may have been rounded.
#[derive(Debug, Clone, Copy)]
pub(super) enum Numbers<'t> {
    /// Those that are written with few digits in the file itself.
    Written(&'t Node),
    /// Those that have few digits, wherever they stand, in a tree of values.
    Anywhere(&'t Node),
    /// The same, and all parts of axes: they may have been made unit vectors.
    WithAxes(&'t Node),
}

impl<'t> Numbers<'t> {
    pub(super) fn root(self) -> &'t Node {
        let (Self::Written(root) | Self::Anywhere(root) | Self::WithAxes(root)) = self;
        root
    }

    fn read(self) -> Vec<Coordinate> {
        let root = self.root();
        let numbers = root.numbers().into_iter();
        let coordinates = numbers.filter_map(|number| {
            let is_axis = is_axis(&number.path)?;
            let node = root.find(&number.steps)?;
            let value = number.value.unwrap_or_default();
            let own = Arc::ptr_eq(node.source(), root.source());
            let digits = match self {
                Self::Written(_) => digits::Digits::of(node).filter(|_| own)?,
                _ => digits::Digits::of(node).or_else(|| digits::Digits::of_value(value))?,
            };
            Some(Coordinate {
                value,
                place: node.place(),
                path: number.path,
                steps: number.steps,
                digits,
                rounding: 0.0,
                is_axis,
            })
        });
        let few =
            |own: &Coordinate| own.digits.significant <= DIGITS && own.digits.decimals <= DIGITS;
        let mut all: Vec<Coordinate> = coordinates.collect();
        if let Self::WithAxes(_) = self {
            let points = all.iter().filter(|own| !own.is_axis && few(own));
            let decimals = points.map(|own| own.digits.decimals).max().unwrap_or(0);
            let long = all.iter_mut().filter(|own| own.is_axis && !few(own));
            long.for_each(|own| own.digits.round(decimals));
        }
        all.retain(few);
        all
    }
}

/// Paths of coordinates that are expressions, or stand in another file.
pub(super) fn held(root: &Node) -> Vec<String> {
    let numbers = root.numbers().into_iter();
    let held = numbers.filter(|number| {
        let node = root.find(&number.steps);
        let own = node.is_some_and(|node| Arc::ptr_eq(node.source(), root.source()));
        is_axis(&number.path).is_some() && (number.value.is_none() || !own)
    });
    held.map(|number| number.path).collect()
}

/// Whether a path leads to a part of an axis, or to a coordinate of a point; `None` of anything else.
fn is_axis(path: &str) -> Option<bool> {
    let mut steps: Vec<&str> = path.split('.').collect();
    if steps.first() == Some(&"groups") {
        steps.drain(..2.min(steps.len()));
    }
    match steps[..] {
        ["points", _] | ["points", _, _] => Some(false),
        ["joints", _, "kind", "axis" | "normal" | "axes"]
        | ["joints", _, "kind", "axis" | "normal" | "axes", _]
        | ["joints", _, "kind", "axes", _, _] => Some(true),
        _ => None,
    }
}
