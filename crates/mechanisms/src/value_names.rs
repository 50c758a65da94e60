//! Which values of a prebuilt mechanism's model stand where in its text: found by changing one
//! number of the text at a time.

use std::ops::Range;

use hyperstat_assembly::Model;

use crate::fragment::Fragment;
use crate::overlay::{Known, Overlay};
use crate::paths;
use crate::source::{Place, Source};
use crate::subject::{Recipe, Subject};

/// Part by which a number is made larger: any that does not vanish does, since values are looked
/// for that are the number itself, before and after.
const PART: f64 = 1.0 / 1024.0;

/// Names values of `model`, which is the subject's, by their paths; `replaced` says what stands in
/// for parts of the text.
pub(crate) fn find(
    recipe: &Recipe,
    replaced: &[(Range<usize>, Place)],
    subject: &Subject,
    model: &mut Model,
) {
    if subject.mechanism().is_some() {
        return;
    }
    let Ok(own) = subject.model() else { return };
    let values = own.values();
    for (path, written) in paths::numbers(recipe.root()) {
        let span = written.span();
        let instead = replaced.iter().find(|(at, _)| *at == span);
        let overlaps = |at: &Range<usize>| at.start < span.end && span.start < at.end;
        if instead.is_none() && replaced.iter().any(|(at, _)| overlaps(at)) {
            continue; // a part of something that varies as a whole
        }
        let number = instead.map_or(written, |(_, place)| Fragment::at(place));
        let Ok(number) = number.number() else {
            continue;
        };
        let larger = number * (1.0 + PART);
        let source = Source::made(format!("{larger:?}"), written.place());
        let whole = 0..source.text().len();
        let place = Place {
            source,
            span: whole,
        };
        let others = replaced.iter().filter(|(at, _)| *at != span);
        let others = others.map(|(at, place)| (at.clone(), Fragment::at(place)));
        let known = Known::default();
        let changed = others.chain([(span.clone(), Fragment::at(&place))]);
        let overlay = Overlay::new(changed.collect(), &known);
        let Ok(checked) = recipe.read(recipe.root().under(&overlay)) else {
            continue; // a number of another kind, such as a count
        };
        let Some(changed) = subject.model_like(&checked) else {
            continue;
        };
        if changed.geometry() != own.geometry() {
            continue; // lengths and places have no derivatives
        }
        let changed = changed.values();
        let same_places = changed.len() == values.len();
        for (before, after) in values.iter().zip(&changed).filter(|_| same_places) {
            if before.0 == after.0 && before.1 == number && after.1 == larger {
                model.name_value(before.0, &path);
            }
        }
    }
}
