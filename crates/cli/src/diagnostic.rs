//! Errors as they are printed: file, line and column, the line itself, what is wrong, and what
//! would be right.

use std::io::IsTerminal;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use hyperstat_mechanisms::Location;

use crate::error::CliError;

/// The error in full, with colours where standard error is a terminal that takes them.
pub(crate) fn render(error: &CliError) -> String {
    let styled = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let renderer = if styled {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let message = error.to_string();
    let help = error.help();
    let path = error
        .location()
        .map(|location| location.path.display().to_string());
    let title = Level::ERROR.primary_title(message.as_str());
    let mut group = match (error.location(), path.as_deref()) {
        (Some(location), Some(path)) => title.element(
            Snippet::source(location.text.as_str())
                .line_start(location.line)
                .path(path)
                .annotation(AnnotationKind::Primary.span(span(location))),
        ),
        _ => annotate_snippets::Group::with_title(title),
    };
    if let Some(help) = &help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    renderer.render(&[group]) + "\n"
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

    use super::span;

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
    fn a_place_behind_the_line_is_its_end() {
        assert_eq!(span(&location(9, 3, "abc")), 3..3);
        assert_eq!(span(&location(3, 9, "abc")), 2..3);
    }
}
