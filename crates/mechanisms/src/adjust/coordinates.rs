//! The coordinates of points and the parts of axes that a file writes as numbers, and what they may have
//! been rounded to.

use std::sync::Arc;

use crate::text::digits;
use crate::text::source::Place;
use crate::text::tree::{Node, Steps};

/// Numbers with more digits are not rounded.
const DIGITS: i32 = 11;
/// A number with so many digits less than others of its kind has the zeros that are left out, but for one
/// number in a thousand.
const FEWER: i32 = 3;

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
    /// What the file may have been rounded to, the likeliest first: to decimals, numbers that look exact
    /// being so; the same without this; to digits that count.
    pub fn guesses(root: &Node) -> impl Iterator<Item = Self> {
        let all = numbers(root);
        let most = |of: &dyn Fn(&Coordinate) -> i32| all.iter().map(of).max().unwrap_or(0);
        let decimals = [false, true].map(|axes| {
            most(&|own| if own.is_axis == axes { own.digits.decimals } else { i32::MIN })
        });
        let significant = most(&|own| own.digits.significant);
        let decimals_of = move |own: &Coordinate| decimals[usize::from(own.is_axis)];
        let by_decimals = |own: &Coordinate| Some(10f64.powi(-decimals_of(own)));
        let rounded = Digits::Decimals(decimals.into_iter().max().map_or(0, |d| d.max(0) as usize));
        let likely = |own: &Coordinate| {
            let full = own.digits.decimals > decimals_of(own) - FEWER;
            full.then(|| by_decimals(own)).flatten()
        };
        let by_digits = |own: &Coordinate| {
            let first = own.value.abs().log10().floor();
            (own.value != 0.0).then(|| 10f64.powi(first as i32 + 1 - significant))
        };
        let guess = |rounding: &dyn Fn(&Coordinate) -> Option<f64>, rounded| Self {
            all: with(&all, rounding),
            rounded,
        };
        let guesses = [
            guess(&likely, rounded),
            guess(&by_decimals, rounded),
            guess(&by_digits, Digits::Significant(significant.max(0) as usize)),
        ];
        guesses.into_iter().filter(|guess| !guess.all.is_empty())
    }
}

/// Those numbers that have a rounding.
fn with(all: &[Coordinate], rounding: &dyn Fn(&Coordinate) -> Option<f64>) -> Vec<Coordinate> {
    let own = all.iter().filter_map(|own| {
        let rounding = rounding(own)?;
        Some(Coordinate { rounding, ..own.clone() })
    });
    own.collect()
}

/// All numbers of points and axes that are written in the file itself with few digits.
fn numbers(root: &Node) -> Vec<Coordinate> {
    let numbers = root.numbers().into_iter();
    let coordinates = numbers.filter_map(|number| {
        let is_axis = is_axis(&number.path)?;
        let node = root.find(&number.steps)?;
        let digits = digits::Digits::of(node)?;
        let few = digits.significant <= DIGITS && digits.decimals <= DIGITS;
        (few && Arc::ptr_eq(node.source(), root.source())).then(|| Coordinate {
            value: number.value.unwrap_or_default(),
            place: node.place(),
            path: number.path,
            steps: number.steps,
            digits,
            rounding: 0.0,
            is_axis,
        })
    });
    coordinates.collect()
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
