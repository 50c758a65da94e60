//! What the poses of a job give: coordinates of the output, or values of drives.

use super::poses::Poses;
use super::subject::Subject;
use super::targets::Targets;
use crate::text::csv;
use crate::text::values::Values;

/// A coordinate that the poses of a job give.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Commanded {
    /// `x` to `rz`, or a drive such as `A1.v`: a column of the job's table.
    pub name: String,
    /// Its values over the poses, in any order, each once or more often \[m, rad\].
    pub values: Vec<f64>,
}

impl Poses {
    /// The coordinates that poses of this mechanism give.
    pub(crate) fn commanded(&self, subject: &Subject) -> Vec<Commanded> {
        let named = |k: usize, values: Vec<f64>| Commanded {
            name: csv::COLUMNS[k].into(),
            values,
        };
        let axis = |axis: &Values| (0..axis.len()).map(|k| axis.get(k)).collect();
        let taken = subject.coordinates();
        match self {
            Self::Own => Vec::new(),
            Self::List(poses) => (taken.iter())
                .map(|c| c.index())
                .map(|k| named(k, poses.iter().map(|pose| pose[k]).collect()))
                .collect(),
            Self::Grid(axes) => (taken.iter())
                .map(|c| c.index())
                .map(|k| named(k, axis(&axes[k])))
                .collect(),
            Self::Asked(Targets::List(poses)) => (0..6)
                .map(|k| named(k, poses.iter().filter_map(|pose| pose[k]).collect()))
                .filter(|commanded| !commanded.values.is_empty())
                .collect(),
            Self::Asked(Targets::Grid(axes)) => (axes.iter().enumerate())
                .filter_map(|(k, values)| Some(named(k, axis(values.as_ref()?))))
                .collect(),
            Self::Asked(Targets::Drives { names, rows, .. }) => (names.iter().enumerate())
                .map(|(place, name)| Commanded {
                    name: name.clone(),
                    values: rows.iter().map(|row| row[place]).collect(),
                })
                .collect(),
        }
    }
}

impl Poses {
    /// What a pose (from 0) of this mechanism gives: coordinates or drives, each with its value.
    pub(crate) fn given(&self, subject: &Subject, number: usize) -> Vec<(String, f64)> {
        let named = |(k, value): (usize, f64)| (csv::COLUMNS[k].into(), value);
        match self {
            Self::Own => Vec::new(),
            Self::Asked(Targets::Drives { names, rows, .. }) => {
                let values = rows[number].iter().copied();
                names.iter().cloned().zip(values).collect()
            }
            Self::Asked(_) => {
                let target = subject.target(self, number).into_iter().enumerate();
                target
                    .filter_map(|(k, value)| Some(named((k, value?))))
                    .collect()
            }
            Self::List(_) | Self::Grid(_) => {
                let pose = self.get(number);
                let taken = subject.coordinates();
                let taken = taken.iter().map(|c| (c.index(), pose[c.index()]));
                taken.map(named).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::{Disk, Registry, batch_from_str};

    fn commanded(mechanism: &str, poses: &str) -> Vec<(String, usize)> {
        let batch = format!(r#"(jobs: [(name: "a", mechanism: {mechanism}, poses: {poses})])"#);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/a.ron");
        let batch = batch_from_str(&batch, &path, &Disk, &Registry::builtin()).unwrap();
        let all = batch.jobs[0].commanded().into_iter();
        all.map(|c| (c.name, c.values.len())).collect()
    }

    #[test]
    fn what_follows_is_not_commanded() {
        let mechanism = r#"ThreePrs(
            rails: (radius: 0.4, tilt: 0.0, travel: 0.8, carriage: Near), platform_radius: 0.25,
            rod_length: 0.5,
            rod: (section: Circle(diameter: 0.04), material: (young: 2.1e11, poisson: 0.3)),
        )"#;
        let grid = "Grid(z: (0.7, 0.7, 1), rx: (-0.2, 0.2, 5), ry: (0.0, 0.2, 3))";
        let expected = [("z", 1), ("rx", 5), ("ry", 3)].map(|(name, n)| (name.into(), n));
        assert_eq!(commanded(mechanism, grid), expected);
        let list = "List([(0.0, 0.0, 0.7, 0.1, 0.0, 0.0)])";
        let expected = ["z", "rx", "ry"].map(|name| (name.into(), 1));
        assert_eq!(commanded(mechanism, list), expected);
        // Of a file: what is written, no more.
        let file = r#"File("five_bar.ron")"#;
        let expected = [("x", 4), ("y", 2)].map(|(name, n)| (name.into(), n));
        let grid = "Grid(x: (-0.1, 0.1, 4), y: (0.3, 0.4, 2))";
        assert_eq!(commanded(file, grid), expected);
        let drives = r#"Drives(Csv("five_bar_drives.csv"))"#;
        let found = commanded(file, drives);
        assert_eq!((&*found[0].0, &*found[1].0), ("A1.v", "A2.v"));
    }
}
