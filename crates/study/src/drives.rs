//! Which joints could hold what moves freely.

use hyperstat_assembly::{BodyId, Configuration, JointId, Motion};
use hyperstat_joints::Dof;

/// Most joint directions that are named.
const SHOWN: usize = 8;

/// The drives that are missing where a body moves freely.
#[derive(Debug, Default)]
pub struct MissingDrives {
    /// Independent motions of the body: as many drives are missing.
    motions: usize,
    /// Joint directions, such as `A1.v`, that these motions move: each held one stops a motion.
    /// Those of joints to the ground, the likely drives, come first.
    directions: Vec<String>,
}

impl MissingDrives {
    /// Of a body that moves with all drives locked.
    pub fn of(here: &Configuration<'_>, body: BodyId) -> Self {
        let model = here.model();
        let motions = here.kinematics().map_or(&[][..], |k| &k.motions);
        let moves = |motion: &&Motion| motion.twists.iter().any(|(moved, _)| *moved == body);
        let motions: Vec<_> = motions.iter().filter(moves).collect();
        let directions = motions.iter().flat_map(|m| m.free_directions(model));
        let mut directions: Vec<(JointId, Dof)> = directions.collect();
        let to_ground = |joint: JointId| model.joints()[joint.0].between.contains(&None);
        directions.sort_by_key(|(joint, dof)| (!to_ground(*joint), *joint, *dof));
        directions.dedup();
        let name =
            |(joint, dof): &(JointId, Dof)| format!("`{}.{dof}`", model.joints()[joint.0].name);
        Self {
            motions: motions.len(),
            directions: directions.iter().map(name).collect(),
        }
    }

    /// What would hold the body, as a sentence.
    pub fn help(&self) -> String {
        if self.directions.is_empty() {
            return "add the joint that is missing, or give one `stiffness`".into();
        }
        let count = self.directions.len();
        let shown = self.directions[..count.min(SHOWN)].join(", ");
        let more = match count.saturating_sub(SHOWN) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let drives = match self.motions {
            1 => "the drive that is missing (`locked: true`, or `stiffness`): one".into(),
            count => {
                format!(
                    "the {count} drives that are missing (`locked: true`, or `stiffness`): {count}"
                )
            }
        };
        format!("hold {drives} of {shown}{more}; or add the joint that is missing")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn help(motions: usize, directions: usize) -> String {
        let directions = (0..directions).map(|k| format!("`j{k}.v`")).collect();
        MissingDrives {
            motions,
            directions,
        }
        .help()
    }

    #[test]
    fn the_help_names_the_first_directions_and_counts_the_others() {
        assert!(help(0, 0).starts_with("add the joint"));
        assert!(help(1, 2).contains("one of `j0.v`, `j1.v`; or"));
        assert!(help(2, 8).contains("2 of `j0.v`, "));
        assert!(help(2, 8).contains("`j7.v`; or"));
        assert!(help(2, 10).contains("`j7.v` and 2 more; or"));
    }
}
