//! Names that a file refers to, and the one that was probably meant.

/// Names listed in a message before it says "and more".
const LISTED: usize = 12;

/// A name more like another than this (1 is the same) is probably a slip.
const MEANT: f64 = 0.8;

/// What would be right instead of the unknown `name`: the nearest of `known`, or all of them.
/// `what` is the plural of what they name.
pub(crate) fn help<'n>(name: &str, what: &str, known: impl IntoIterator<Item = &'n str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    if known.is_empty() {
        return format!("there are no {what}");
    }
    if let Some(meant) = nearest(name, &known) {
        return format!("did you mean `{meant}`?");
    }
    let more = if known.len() > LISTED {
        ", and more"
    } else {
        ""
    };
    format!(
        "the {what} are {}{more}",
        list(&known[..known.len().min(LISTED)])
    )
}

/// Names in backquotes with commas between them.
pub(crate) fn list(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

/// The one of `known` that was probably meant by `name`; `None` where none is like it.
pub fn nearest<'n>(name: &str, known: &[&'n str]) -> Option<&'n str> {
    let name = name.to_lowercase();
    let likeness = |other: &str| strsim::jaro_winkler(&name, &other.to_lowercase());
    known
        .iter()
        .map(|&other| (likeness(other), other))
        .filter(|&(likeness, _)| likeness > MEANT)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, other)| other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_is_recognised() {
        let known = ["steel", "aluminium", "Revolute"];
        assert_eq!(help("stel", "materials", known), "did you mean `steel`?");
        assert_eq!(
            help("aluminum", "materials", known),
            "did you mean `aluminium`?"
        );
        assert_eq!(help("revolute", "kinds", known), "did you mean `Revolute`?");
        assert_eq!(help("Revoltue", "kinds", known), "did you mean `Revolute`?");
        assert_eq!(
            help("lock", "fields", ["kind", "locked"]),
            "did you mean `locked`?"
        );
    }

    #[test]
    fn another_name_gets_the_list() {
        let known = ["steel", "brass"];
        assert_eq!(
            help("wood", "materials", known),
            "the materials are `steel`, `brass`"
        );
        assert_eq!(help("C2", "points", ["C1"]), "the points are `C1`");
        assert_eq!(help("wood", "materials", []), "there are no materials");
    }
}
