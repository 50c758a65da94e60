//! The value of an expression.

use std::ops::Range;

use super::dual::Dual;
use super::functions::{By, Rule};
use super::{Expression, Mistake, What};

/// What an expression gives, and what stands between its operations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Operand {
    Number(Dual),
    /// A point, or a vector.
    Point([Dual; 3]),
}

/// Why an expression has no value.
#[derive(Debug)]
pub(crate) enum Failure<E> {
    /// Something in its text.
    Here(Mistake),
    /// What a name in it stands for.
    Elsewhere(E),
}

impl<E> From<Mistake> for Failure<E> {
    fn from(mistake: Mistake) -> Self {
        Self::Here(mistake)
    }
}

/// What a name in an expression stands for, or one coordinate of it, by its place in the text.
type Names<'n, E> =
    dyn FnMut(&str, Option<usize>, &Range<usize>) -> Result<Operand, Failure<E>> + 'n;

impl Expression {
    /// Its value, which is finite; `named` says what names stand for.
    pub(crate) fn value<E>(&self, named: &mut Names<'_, E>) -> Result<Operand, Failure<E>> {
        let operations = self.0.as_ref().map_err(Clone::clone)?;
        let mut stack: Vec<Operand> = Vec::with_capacity(8);
        for operation in operations {
            let at = &operation.at;
            let found = match &operation.what {
                What::Number(number) => Operand::Number(Dual::constant(*number)),
                What::Name(name) => named(name, None, at)?,
                What::CoordinateOf(name, k) => named(name, Some(*k), at)?,
                What::Call(rule, count) => {
                    let first = stack.len().saturating_sub(*count);
                    let found = call(rule, &stack[first..], at)?;
                    stack.truncate(first);
                    found
                }
                What::Coordinate(k) => coordinate(pop(&mut stack), *k, at)?,
                What::Negate => negated(pop(&mut stack)),
                what => {
                    let right = pop(&mut stack);
                    let left = pop(&mut stack);
                    both(what, left, right, at)?
                }
            };
            stack.push(finite(found, at)?);
        }
        Ok(pop(&mut stack))
    }
}

/// The last operand; reading an expression makes sure that there is one.
fn pop(stack: &mut Vec<Operand>) -> Operand {
    stack.pop().unwrap_or(Operand::Number(Dual::constant(0.0)))
}

fn mistake(at: &Range<usize>, message: String, help: &str) -> Mistake {
    Mistake {
        of_values: false,
        at: at.clone(),
        message,
        help: help.into(),
    }
}

/// One coordinate of an operand.
pub(super) fn coordinate(of: Operand, k: usize, at: &Range<usize>) -> Result<Operand, Mistake> {
    match of {
        Operand::Point(point) => Ok(Operand::Number(point[k])),
        Operand::Number(_) => {
            let message = "a number has no coordinates".to_string();
            Err(mistake(
                at,
                message,
                "`.x`, `.y` and `.z` are those of a point",
            ))
        }
    }
}

fn negated(operand: Operand) -> Operand {
    match operand {
        Operand::Number(number) => Operand::Number(-number),
        Operand::Point(point) => Operand::Point(point.map(|c| -c)),
    }
}

/// An operation of two operands.
fn both(what: &What, left: Operand, right: Operand, at: &Range<usize>) -> Result<Operand, Mistake> {
    use Operand::{Number, Point};
    let each = |a: [Dual; 3], b: [Dual; 3], of: fn(Dual, Dual) -> Dual| {
        Point(std::array::from_fn(|k| of(a[k], b[k])))
    };
    if let (What::Divide, Number(Dual { value: 0.0, .. })) = (what, right) {
        let help = "look at the values of what stands behind `/`";
        return Err(Mistake {
            of_values: true,
            ..mistake(at, "division by zero".into(), help)
        });
    }
    Ok(match (what, left, right) {
        (What::Add, Number(a), Number(b)) => Number(a + b),
        (What::Subtract, Number(a), Number(b)) => Number(a - b),
        (What::Multiply, Number(a), Number(b)) => Number(a * b),
        (What::Divide, Number(a), Number(b)) => Number(a / b),
        (What::Power, Number(a), Number(b)) => Number(a.power(b)),
        (What::Add, Point(a), Point(b)) => each(a, b, |a, b| a + b),
        (What::Subtract, Point(a), Point(b)) => each(a, b, |a, b| a - b),
        (What::Multiply, Number(a), Point(b)) | (What::Multiply, Point(b), Number(a)) => {
            Point(b.map(|c| a * c))
        }
        (What::Divide, Point(a), Number(b)) => Point(a.map(|c| c / b)),
        _ => {
            let message = "a point and a number do not go together here".into();
            let help = "give a coordinate of the point, `.x`, `.y` or `.z`; points are added, \
                        subtracted, and multiplied by numbers";
            return Err(mistake(at, message, help));
        }
    })
}

fn call(rule: &Rule, arguments: &[Operand], at: &Range<usize>) -> Result<Operand, Mistake> {
    use Operand::Number;
    Ok(match (&rule.by, arguments) {
        (By::One(of), [Number(x)]) => Number(of(*x)),
        (By::Two(of), [Number(x), Number(y)]) => Number(of(*x, *y)),
        (By::Fold(of), [Number(first), rest @ ..]) => {
            let mut found = *first;
            for next in rest {
                match next {
                    Number(next) => found = of(found, *next),
                    Operand::Point(_) => return Err(arguments_of(rule, at)),
                }
            }
            Number(found)
        }
        (By::Distance, [Operand::Point(a), Operand::Point(b)]) => {
            let [x, y, z] = std::array::from_fn(|k| b[k] - a[k]);
            Number(x.hypot(y).hypot(z))
        }
        (By::Midpoint, [Operand::Point(a), Operand::Point(b)]) => {
            let half = Dual::constant(0.5);
            Operand::Point(std::array::from_fn(|k| half * (a[k] + b[k])))
        }
        _ => return Err(arguments_of(rule, at)),
    })
}

/// The error of arguments of another kind than a function takes.
fn arguments_of(rule: &Rule, at: &Range<usize>) -> Mistake {
    let message = format!("`{}` takes {}", rule.name, rule.arguments());
    let help = "a point is given by its name, a number of it by `.x`, `.y` or `.z`";
    mistake(at, message, help)
}

/// Refuses what is not finite.
fn finite(operand: Operand, at: &Range<usize>) -> Result<Operand, Mistake> {
    let all = match &operand {
        Operand::Number(number) => std::slice::from_ref(number),
        Operand::Point(point) => point,
    };
    match all.iter().find(|number| !number.value.is_finite()) {
        None => Ok(operand),
        Some(number) => {
            let what = if number.value.is_nan() {
                "is not defined"
            } else {
                "is infinite"
            };
            let message = format!("the value of this {what}");
            let help = "look at the values of what stands in it";
            Err(Mistake {
                of_values: true,
                ..mistake(at, message, help)
            })
        }
    }
}
