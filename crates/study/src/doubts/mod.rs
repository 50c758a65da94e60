//! What is hardly as it was meant: numbers that nothing has which exists, mostly for their units.
//!
//! Each is told once, with the unit that was probably meant. What is told changes no result.

mod input;
mod result;
#[cfg(test)]
mod tests;
mod watch;

use hyperstat_assembly::Model;

pub use input::of_model;
pub use result::of_solution;
#[cfg(feature = "parts")]
pub(crate) use watch::Seen;
pub use watch::Watch;

/// Diagonal of the box around a mechanism's points \[m\].
fn size(model: &Model) -> f64 {
    let positions = &model.geometry().positions;
    positions.first().map_or(0.0, |first| {
        let bounds = positions.iter().fold((*first, *first), |(least, most), p| {
            (least.inf(p), most.sup(p))
        });
        (bounds.1 - bounds.0).norm()
    })
}

/// A number in a message: four digits.
fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.3e}");
    }
    // Four digits, without zeros at the end.
    let decimals = (3 - size.max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}
