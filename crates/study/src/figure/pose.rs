//! Poses by their coordinates: which one is meant, and which one it is in words.

use std::collections::HashSet;

use hyperstat_mechanisms::Job;

use super::coordinates::unknown;
use super::plane::Levels;
use super::rows::chosen;
use crate::digits::digits;
use crate::plot_error::PlotError;
use crate::schema::{COORDINATES, unit};
use crate::table::{Column, TableReader};

/// A pose of a job by the coordinates that it was asked for by, as a sentence; `None` where it gives
/// none.
pub(super) fn in_words(job: &Job, pose: usize) -> Option<String> {
    let given = job.given(pose);
    let told = given.iter().map(|(name, value)| {
        let number = digits(*value, &[*value]).replace('-', "−");
        format!("{name} = {number} {}", unit(name))
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| format!("Pose {pose}: {}.", told.join(", ")))
}

/// The number of the pose of a job that has these coordinates, of those that its poses give.
///
/// # Errors
/// A coordinate that the poses do not give, none of them that has it, or several.
pub fn of_job(job: &Job, at: &[(String, f64)]) -> Result<usize, PlotError> {
    let mut columns: Vec<(String, Column)> = Vec::new();
    for pose in 0..job.len() {
        for (name, value) in job.given(pose) {
            let place = columns.iter().position(|(known, _)| *known == name);
            let place = place.unwrap_or_else(|| {
                columns.push((name, vec![None; job.len()]));
                columns.len() - 1
            });
            columns[place].1[pose] = Some(value);
        }
    }
    found(&columns, at)
}

/// The number of the pose of a table that has these coordinates, of the output or of drives.
///
/// # Errors
/// As [`of_job`]; the table cannot be read.
pub fn of_table(table: &TableReader, at: &[(String, f64)]) -> Result<usize, PlotError> {
    let poses = table
        .read(&[table.find(crate::schema::POSE).unwrap_or(0)])?
        .remove(0);
    // Every design has the same poses, and a table may have lost or moved rows: one of each number.
    let mut seen = HashSet::new();
    let is_new = |row: &usize| poses[*row].is_some_and(|pose| seen.insert(pose.to_bits()));
    let rows: Vec<usize> = (0..poses.len()).filter(is_new).collect();
    let drives = table.drives();
    let mut columns = Vec::new();
    for name in COORDINATES.map(String::from).into_iter().chain(drives) {
        if let Some(place) = table.find(&name) {
            columns.push((name, chosen(&table.read(&[place])?.remove(0), &rows)));
        }
    }
    let row = rows[found(&columns, at)?];
    Ok(poses[row].unwrap_or(0.0) as usize)
}

/// The place at which all columns have what is asked of them.
fn found(columns: &[(String, Column)], at: &[(String, f64)]) -> Result<usize, PlotError> {
    let count = columns.first().map_or(0, |(_, column)| column.len());
    let mut left: Vec<usize> = (0..count).collect();
    for (name, value) in at {
        let names = columns.iter().map(|(name, _)| &**name);
        let own = columns.iter().find(|(known, _)| known == name);
        let (_, column) = own.ok_or_else(|| unknown(name, names))?;
        let size = column
            .iter()
            .flatten()
            .fold(0.0_f64, |size, v| size.max(v.abs()));
        let levels = Levels::new(column, size);
        let level = levels
            .asked(name, *value)
            .map_err(|_| PlotError::NoPoseAt {
                axis: name.clone(),
                value: *value,
                known: levels.values.clone(),
            })?;
        left.retain(|pose| levels.of_row[*pose] == Some(level));
    }
    match *left {
        [only] => Ok(only),
        [] => Err(PlotError::NoSuchPoseAt { at: told(at) }),
        [first, ref others @ ..] => {
            let differs = |(name, column): &&(String, Column)| {
                let own = |(known, _): &(String, f64)| known == name;
                !at.iter().any(own) && others.iter().any(|pose| column[*pose] != column[first])
            };
            let differ = columns.iter().filter(differs);
            Err(PlotError::SeveralPosesAt {
                at: told(at),
                count: left.len(),
                differ: differ.map(|(name, _)| name.clone()).collect(),
            })
        }
    }
}

fn told(at: &[(String, f64)]) -> String {
    let told = at.iter().map(|(name, value)| format!("{name} = {value}"));
    told.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::found;

    #[test]
    fn a_pose_is_found_by_its_coordinates() {
        let column = |name: &str, values: [f64; 4]| (name.to_string(), values.map(Some).to_vec());
        let columns = [
            column("x", [-0.1, 0.1, -0.1, 0.1]),
            column("z", [0.4, 0.4, 0.5, 0.5]),
            column("rx", [0.0; 4]),
        ];
        let find = |at: &[(&str, f64)]| {
            let at: Vec<_> = at
                .iter()
                .map(|(name, v)| ((*name).to_string(), *v))
                .collect();
            let found = found(&columns, &at);
            found.map_err(|error| (error.to_string(), error.help().unwrap_or_default()))
        };
        assert_eq!(find(&[("x", 0.1), ("z", 0.4)]), Ok(1));
        // About where it is, and rounding aside.
        assert_eq!(find(&[("x", -0.11), ("z", 0.5000001)]), Ok(2));
        let refused = |message: &str, help: &str| Err((message.to_string(), help.to_string()));
        assert_eq!(
            find(&[("x", 0.0), ("z", 0.4)]),
            refused("no pose has x = 0", "poses have x = -0.1, 0.1")
        );
        assert_eq!(
            find(&[("z", 0.4)]),
            refused("2 poses have z = 0.4", "say x, too")
        );
        assert_eq!(
            find(&[("u", 0.4)]),
            refused("`u` is no coordinate of these poses", "those are x, z, rx")
        );
    }
}
