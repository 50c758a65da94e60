//! Errors as they are printed: file, line and column, the line itself, what is wrong, and what
//! would be right.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use hyperstat_mechanisms::Location;

use crate::error::CliError;
use crate::terminal::{is_coloured, plain};

/// The error in full, with colours where standard error is a terminal that takes them.
pub(crate) fn render(error: &CliError) -> String {
    let renderer = if is_coloured() {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let message = error.to_string();
    let message = plain(&message);
    let help = error.help();
    let help = help.as_deref().map(plain);
    let place = error.location().map(|location| {
        let path = location.path.display().to_string();
        let (text, span) = marked(location);
        (plain(&path).into_owned(), location.line, text, span)
    });
    let title = Level::ERROR.primary_title(&*message);
    let mut group = match &place {
        Some((path, line, text, span)) => title.element(
            Snippet::source(text.as_str())
                .line_start(*line)
                .path(path.as_str())
                .annotation(AnnotationKind::Primary.span(span.clone())),
        ),
        None => annotate_snippets::Group::with_title(title),
    };
    if let Some(help) = &help {
        group = group.element(Level::HELP.message(&**help));
    }
    renderer.render(&[group]) + "\n"
}

/// The line of a location as it is shown, and the bytes in it of the characters that are meant.
fn marked(location: &Location) -> (String, Range<usize>) {
    let text = location.text.as_str();
    let Range { start, end } = span(location);
    let parts = [&text[..start], &text[start..end], &text[end..]].map(plain);
    let start = parts[0].len();
    let end = start + parts[1].len();
    (parts.concat(), start..end)
}

/// The bytes of the characters that the location means.
fn span(location: &Location) -> Range<usize> {
    let text = location.text.as_str();
    let byte = |character: usize| {
        let place = text.char_indices().nth(character);
        place.map_or(text.len(), |(at, _)| at)
    };
    let first = location.column.saturating_sub(1);
    byte(first)..byte(first + location.width.max(1))
}

#[cfg(test)]
mod tests {
    use hyperstat_mechanisms::Location;

    use super::{marked, span};

    fn location(column: usize, width: usize, text: &str) -> Location {
        Location {
            path: "a.ron".into(),
            line: 3,
            column,
            width,
            text: text.into(),
        }
    }

    #[test]
    fn columns_count_characters_not_bytes() {
        assert_eq!(span(&location(4, 2, "\"é: xy\"")), 4..6);
        assert_eq!(&"\"é: xy\""[4..6], " x");
    }

    #[test]
    fn what_would_steer_a_terminal_is_shown_by_its_number() {
        let shown = marked(&location(3, 3, "\u{1b}a\u{7}bc"));
        assert_eq!(shown, ("\\u{1b}a\\u{7}bc".into(), 7..14));
        assert_eq!(&shown.0[shown.1], "\\u{7}bc");
    }

    #[test]
    fn a_place_behind_the_line_is_its_end() {
        assert_eq!(span(&location(9, 3, "abc")), 3..3);
        assert_eq!(span(&location(3, 9, "abc")), 2..3);
    }
}
