//! Titles of figures.

/// Title of a figure of one configuration: the mechanism's name, or the job's with its design and
/// pose; and the case.
pub(crate) fn title(
    name: &str,
    design: Option<usize>,
    pose: Option<usize>,
    case: Option<&str>,
) -> String {
    let numbers = [("design", design), ("pose", pose)];
    let numbers = numbers
        .into_iter()
        .filter_map(|(what, number)| Some(format!("{what} {}", number?)));
    let case = case.map(|case| format!("case {case}"));
    let parts: Vec<_> = std::iter::once(name.to_string())
        .chain(numbers)
        .chain(case)
        .collect();
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::title;

    #[test]
    fn titles_name_what_is_drawn() {
        assert_eq!(title("portal", None, None, None), "portal");
        let all = title("delta", Some(2), Some(12), Some("push"));
        assert_eq!(all, "delta, design 2, pose 12, case push");
    }
}
