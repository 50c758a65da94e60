//! What quantities and coordinates are called in a figure, where that is set.

use hyperstat_mechanisms::nearest;

use crate::plot_error::PlotError;

/// The axes of a figure in space.
const AXES: [&str; 3] = ["x", "y", "z"];

/// What is called otherwise in a figure: names, each with its label.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Labels(pub Vec<(String, String)>);

impl Labels {
    /// What is to stand for a name.
    pub(super) fn of<'a>(&'a self, name: &'a str) -> &'a str {
        let set = self.0.iter().find(|(own, _)| own == name);
        set.map_or(name, |(_, label)| label)
    }

    /// What the axes of a figure in space are called; `None` where nothing is set.
    ///
    /// # Errors
    /// A label for what is none of them.
    pub fn axes(&self) -> Result<Option<[String; 3]>, PlotError> {
        self.check(AXES.into_iter())?;
        let set = !self.0.is_empty();
        Ok(set.then(|| AXES.map(|axis| self.of(axis).to_owned())))
    }

    /// That all are of names that the figure has.
    pub(super) fn check<'n>(
        &self,
        known: impl Iterator<Item = &'n str> + Clone,
    ) -> Result<(), PlotError> {
        let mut names = self.0.iter().map(|(name, _)| name);
        let Some(name) = names.find(|name| !known.clone().any(|own| own == *name)) else {
            return Ok(());
        };
        let known: Vec<&str> = known.collect();
        Err(PlotError::NoLabel {
            name: name.clone(),
            help: match nearest(name, &known) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("labels are of {}", known.join(", ")),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Labels;

    #[test]
    fn labels_stand_for_names_that_there_are() {
        let labels = Labels(vec![("k33".into(), "along the spindle".into())]);
        assert_eq!(labels.of("k33"), "along the spindle");
        assert_eq!(labels.of("x"), "x");
        assert!(labels.check(["x", "k33"].into_iter()).is_ok());
        let error = labels.check(["x", "k3"].into_iter()).unwrap_err();
        assert_eq!(error.to_string(), "nothing in the figure is called `k33`");
        assert_eq!(error.help().unwrap(), "did you mean `k3`?");
        let error = labels.check(["x", "y"].into_iter()).unwrap_err();
        assert_eq!(error.help().unwrap(), "labels are of x, y");
    }
}
