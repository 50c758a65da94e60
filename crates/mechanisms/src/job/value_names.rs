//! Names of the values of a prebuilt mechanism: their paths in the job.

use hyperstat_model::Model;

use super::subject::{Recipe, Subject};
use crate::file::value_names::{Number, PART, Replaced, numbers};
use crate::text::fragment::Fragment;
use crate::text::overlay::{Known, Overlay};
use crate::text::source::{Place, Source};

/// Names values of the model of a prebuilt mechanism, which is the subject's, by their paths.
pub(crate) fn of_prebuilt(
    recipe: &Recipe,
    replaced: &Replaced,
    subject: &Subject,
    model: &mut Model,
) {
    let Ok(own) = subject.model() else { return };
    let values = own.values();
    for Number {
        path,
        written,
        value,
    } in numbers(recipe.root(), replaced)
    {
        let span = written.span();
        let larger = match value {
            0.0 => f64::MIN_POSITIVE,
            value => value * (1.0 + PART),
        };
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
            if before.0 == after.0 && before.1 == value && after.1 == larger {
                model.name_value(before.0, &path);
            }
        }
    }
}
