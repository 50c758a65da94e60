//! Any text where a number may stand: as an expression, and as a number with its unit.

use std::path::Path;

use hyperstat_mechanisms::{LoadError, Mechanism, MemoryFiles, Registry, mechanism_from_str};

use super::check_error;

/// A mechanism with a load of this size.
fn loaded(force: &str) -> (String, Result<Mechanism, LoadError>) {
    let text = format!(
        r#"(
    name: "beam",
    parameters: {{ "a": 0.3, "b": "2 mm", "turn": "30 deg", "c": "= a + b" }},
    materials: {{ "steel": (young: 2.1e11, poisson: 0.3) }},
    sections: {{ "rod": Circle(diameter: 0.02) }},
    points: {{ "A": (0.0, 0.0, 0.0), "B": ("= 2 * c", 0.0, 0.5), "x-1": "= midpoint(A, B)" }},
    bodies: {{ "beam": Beam(through: ["A", "B"], section: "rod", material: "steel") }},
    joints: {{ "wall": (at: "A", between: ("ground", "beam"), kind: Fixed) }},
    loads: [(on: ("beam", "B"), force: ({force}, 0.0, 0.0))],
    output: ("beam", "B"),
)"#
    );
    let path = Path::new("f.ron");
    let read = mechanism_from_str(&text, path, &MemoryFiles::new(), &Registry::builtin());
    (text, read)
}

/// The load that a text gives; it is finite, written as a number it is the same, and whatever depends on a
/// parameter can be varied.
fn number(force: &str) -> bool {
    let (text, read) = loaded(force);
    let mechanism = match read {
        Ok(mechanism) => mechanism,
        Err(error) => {
            check_error(&error, &text, Path::new("f.ron"));
            return false;
        }
    };
    let force = |mechanism: &Mechanism| mechanism.model.loads().first().map(|load| load.wrench[0]);
    let Some(value) = force(&mechanism) else {
        return false;
    };
    assert!(value.is_finite());
    let (_, plain) = loaded(&format!("{value:?}"));
    assert_eq!(force(&plain.expect("a number")), Some(value));
    for dependence in mechanism.dependences() {
        let _ = mechanism.with_values(&[(&dependence.path, 1.25 * dependence.value)]);
    }
    true
}

/// A text as an expression.
pub fn expression(text: &str) -> bool {
    number(&format!("\"= {text}\""))
}

/// A text as a number with its unit.
pub fn quantity(text: &str) -> bool {
    number(&format!("\"{text}\""))
}

/// Texts to begin with.
pub fn expressions() -> Vec<String> {
    lines(include_str!("expressions.txt"))
}

/// Texts to begin with.
pub fn quantities() -> Vec<String> {
    lines(include_str!("quantities.txt"))
}

fn lines(text: &str) -> Vec<String> {
    text.lines().map(Into::into).collect()
}
