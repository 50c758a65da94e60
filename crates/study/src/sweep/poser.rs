//! One pose at a time, for a program that moves a mechanism: a controller, a drag in a browser.

use hyperstat_assembly::{JointId, Prepared, Single};
use hyperstat_mechanisms::{Design, Drive, Placing, Target};

use super::Planned;
use super::record::{Failure, Record};
use super::wide::placing;
use crate::error::StudyError;
use crate::study::Study;

/// A mechanism that is brought to one pose after another, with all that is worked out once for it and the
/// buffers of its poses: each pays its arithmetic and allocates nothing, as long as a prebuilt mechanism is
/// moved that goes through the lanes, without natural frequencies, columns on request, load cases or loads in axes of bodies.
///
/// ```
/// use hyperstat_study::{Job, JobMechanism, JobPoses, Registry, Study, Target, Value};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let link = |diameter: f64| {
///     let material = "(young: 2.1e11, poisson: 0.3)";
///     Value::Text(format!("(section: Circle(diameter: {diameter:?}), material: {material})"))
/// };
/// let delta = JobMechanism::prebuilt("Delta", [
///     ("base_radius", 0.25.into()), ("platform_radius", 0.06.into()), ("arm_length", 0.30.into()),
///     ("rod_length", 0.60.into()), ("rod_spacing", 0.12.into()),
///     ("arm", link(0.030)), ("bar", link(0.020)), ("rod", link(0.014)),
/// ]);
/// let home = JobPoses::list(&[[0.0, 0.0, 0.5]]);
/// let job = Job::new("drag", delta, home, &Registry::builtin())?;
/// let mut poser = Study::of_job(job, 0, 0)?.poser()?;
/// for step in 0..10 {
///     let x = 0.01 * f64::from(step);
///     let found = poser.at(&Target::Output([Some(x), Some(0.0), Some(0.5), None, None, None]));
///     let found = found.result?;
///     println!("{x} {} {:?}", found.stiffness[(2, 2)], found.measure("softest_force"));
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Poser {
    design: Design,
    placing: Placing,
    planned: Planned,
    single: Single,
}

impl Study {
    /// The mechanism, under the loads that it has here, as one to be brought to other poses.
    ///
    /// # Errors
    /// It has no solution in any pose.
    pub fn poser(&self) -> Result<Poser, StudyError> {
        let design = self.as_design();
        // The model that a sweep starts from, so that the numbers are the sweep's.
        let model = design.model().unwrap_or_else(|_| self.model().clone());
        let failed = |prepared: &Prepared, error| self.source().unsolvable(&prepared.here(), error);
        let planned = Planned::of(Prepared::new(model), self.whole_job(), None);
        let planned = planned.map_err(|made| failed(&made.0, made.1))?;
        let single = planned.prepared.single_beside(planned.beside());
        let single = single.map_err(|error| failed(&planned.prepared, error))?;
        let mut placing = placing();
        planned.prepare(&mut placing);
        Ok(Poser {
            design,
            placing,
            planned,
            single,
        })
    }
}

impl Poser {
    /// A value \[m, rad\] for a direction of a joint of a file's mechanism, `joint.direction`, to be asked of
    /// it ([`Target::Drives`]); `None` of a name that is none of its joints' directions.
    pub fn drive(&self, name: &str, value: f64) -> Option<Drive> {
        let (joint, direction) = name.split_once('.')?;
        let joints = self.planned.prepared.model().joints();
        let place = joints.iter().position(|own| own.name == joint)?;
        Some(Drive {
            joint: JointId(place),
            direction: direction.parse().ok()?,
            value,
        })
    }

    /// What a row of a sweep has of this pose, to the last bit: the output's whole pose, its stiffness and
    /// its displacement, or why there is none. It depends on no pose that was asked before.
    ///
    /// A prebuilt mechanism is asked for all coordinates of its output that it takes; one of a file for any
    /// of them, or for values of its drives.
    pub fn at(&mut self, target: &Target<'_>) -> Record {
        let Self {
            design,
            placing,
            planned,
            single,
        } = self;
        match design.bring(target, single.geometry_mut(), placing) {
            Ok(pose) => {
                let solved = planned.prepared.sweep_single(single);
                let carried = planned.carried(single.lanes_mut(), 0, &solved);
                let drives = placing.drives(0);
                let found = planned.found(solved, single.geometry_mut(), drives, carried);
                Record::reached(pose, found)
            }
            Err(error) => Record {
                pose: match target {
                    Target::Output(asked) => asked.map(|own| own.filter(|own| own.is_finite())),
                    Target::Drives(_) => [None; 6],
                },
                result: Err(Failure::Pose(error)),
            },
        }
    }
}
