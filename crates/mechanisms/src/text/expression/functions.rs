//! The functions and constants of expressions.

use std::f64::consts::PI;

use super::dual::Dual;

/// How a function is worked out.
#[derive(Debug)]
pub(super) struct Rule {
    pub(super) name: &'static str,
    pub(super) by: By,
}

#[derive(Debug)]
pub(super) enum By {
    /// Of one number.
    One(fn(Dual) -> Dual),
    /// Of two numbers.
    Two(fn(Dual, Dual) -> Dual),
    /// Of one number or more, two at a time.
    Fold(fn(Dual, Dual) -> Dual),
    /// The distance of two points.
    Distance,
    /// The point halfway between two.
    Midpoint,
}

/// Constants by name.
pub(crate) const CONSTANTS: [(&str, f64); 1] = [("pi", PI)];

/// All functions.
static FUNCTIONS: [Rule; 25] = [
    one("sin", |x| x.through(x.value.sin(), x.value.cos())),
    one("cos", |x| x.through(x.value.cos(), -x.value.sin())),
    one("tan", |x| {
        let tangent = x.value.tan();
        x.through(tangent, 1.0 + tangent * tangent)
    }),
    one("asin", |x| x.through(x.value.asin(), 1.0 / complement(x))),
    one("acos", |x| x.through(x.value.acos(), -1.0 / complement(x))),
    one("atan", |x| {
        x.through(x.value.atan(), 1.0 / (1.0 + x.value * x.value))
    }),
    one("sinh", |x| x.through(x.value.sinh(), x.value.cosh())),
    one("cosh", |x| x.through(x.value.cosh(), x.value.sinh())),
    one("tanh", |x| {
        let tangent = x.value.tanh();
        x.through(tangent, 1.0 - tangent * tangent)
    }),
    one("sqrt", |x| {
        let root = x.value.sqrt();
        x.through(root, 0.5 / root)
    }),
    one("cbrt", |x| {
        let root = x.value.cbrt();
        x.through(root, 1.0 / (3.0 * root * root))
    }),
    one("exp", |x| x.through(x.value.exp(), x.value.exp())),
    one("ln", |x| x.through(x.value.ln(), 1.0 / x.value)),
    one("log10", |x| {
        let ten = std::f64::consts::LN_10;
        x.through(x.value.log10(), 1.0 / (x.value * ten))
    }),
    one("abs", |x| x.through(x.value.abs(), x.value.signum())),
    one("floor", |x| x.through(x.value.floor(), 0.0)),
    one("ceil", |x| x.through(x.value.ceil(), 0.0)),
    one("round", |x| x.through(x.value.round(), 0.0)),
    two("atan2", Dual::atan2),
    two("hypot", Dual::hypot),
    two("pow", Dual::power),
    fold("min", |a, b| if b.value < a.value { b } else { a }),
    fold("max", |a, b| if b.value > a.value { b } else { a }),
    Rule {
        name: "distance",
        by: By::Distance,
    },
    Rule {
        name: "midpoint",
        by: By::Midpoint,
    },
];

const fn one(name: &'static str, rule: fn(Dual) -> Dual) -> Rule {
    let by = By::One(rule);
    Rule { name, by }
}

const fn two(name: &'static str, rule: fn(Dual, Dual) -> Dual) -> Rule {
    let by = By::Two(rule);
    Rule { name, by }
}

const fn fold(name: &'static str, rule: fn(Dual, Dual) -> Dual) -> Rule {
    let by = By::Fold(rule);
    Rule { name, by }
}

/// √(1 − x²)
fn complement(x: Dual) -> f64 {
    ((1.0 - x.value) * (1.0 + x.value)).sqrt()
}

/// Names of all functions.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().map(|rule| rule.name)
}

/// The function of a name.
pub(super) fn find(name: &str) -> Option<&'static Rule> {
    FUNCTIONS.iter().find(|rule| rule.name == name)
}

impl Rule {
    /// Whether it takes so many arguments.
    pub(super) fn takes(&self, count: usize) -> bool {
        match self.by {
            By::One(_) => count == 1,
            By::Two(_) | By::Distance | By::Midpoint => count == 2,
            By::Fold(_) => count >= 1,
        }
    }

    /// Its arguments, in words.
    pub(super) fn arguments(&self) -> &'static str {
        match self.by {
            By::One(_) => "one number",
            By::Two(_) => "two numbers",
            By::Fold(_) => "one number or more",
            By::Distance | By::Midpoint => "two points",
        }
    }
}
