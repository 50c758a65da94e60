//! Columns on request: what a job's `columns` are in its table, by their names.

use hyperstat_assembly::{Body, BodyKind, Deformation, JointId, Model};
use hyperstat_joints::Dof;
use hyperstat_mechanisms::{Column, Job};

use crate::measures::{self, MEASURES};
use crate::schema::frequencies;

/// Columns that belong together: those of one of a job's `columns`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Group {
    /// Values of drives, `joint.direction`.
    Drives(Vec<String>),
    /// Forces and moments of drives.
    DriveForces(Vec<String>),
    /// The wrench in a joint.
    Wrench(String),
    /// The largest of a stress or of the utilisation, and where.
    Worst(Worst),
    /// Mass of what moves.
    Mass,
    /// Every measure.
    Measures,
    /// So many natural frequencies.
    Frequencies(usize),
    /// Shares of bodies and joints, `body arm1` and `joint A1`, and of ways to deform.
    Budget(Vec<String>),
}

/// What is largest somewhere in the beams.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Worst {
    /// Von Mises stress.
    Stress,
    /// That over the material's yield strength.
    Utilisation,
}

impl Worst {
    /// Name of the column.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Stress => "stress",
            Self::Utilisation => "utilisation",
        }
    }
}

/// Ends of the columns with the place of what is largest: its segment, a text, and where along it.
pub(crate) const AT: [&str; 2] = ["_at", "_place"];

/// Components of a wrench: force \[N\], moment \[N·m\].
const WRENCH: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

/// What follows the name of a drive.
const POSITION: &str = "position";
const FORCE: &str = "force";

/// Mass of what moves.
const MASS: &str = "mass";

/// What shares in a deflection begin with.
const SHARE: &str = "budget";

/// Ways to deform, each in a word.
pub(crate) const DEFORMATIONS: [(Deformation, &str); 9] = [
    (Deformation::Bending, "bending"),
    (Deformation::Shear, "shear"),
    (Deformation::Torsion, "torsion"),
    (Deformation::Tension, "tension"),
    (Deformation::FreeStrain, "free strain"),
    (Deformation::Flexible, "flexible body"),
    (Deformation::Bearing, "bearings"),
    (Deformation::Drive, "drive"),
    (Deformation::Misfit, "misfit"),
];

impl Group {
    /// Those of a job, one for each of its `columns`.
    pub(crate) fn all(job: &Job) -> Vec<Self> {
        if job.columns().is_empty() {
            return Vec::new();
        }
        let model = job.model().ok();
        let drives = || model.as_ref().map_or_else(Vec::new, drives);
        let parts = || model.as_ref().map_or_else(Vec::new, parts);
        let group = |column: &Column| {
            match column {
                Column::Drives => Self::Drives(drives()),
                Column::DriveForces => Self::DriveForces(drives()),
                Column::Wrench(joint) => Self::Wrench(joint.clone()),
                Column::Stress => Self::Worst(Worst::Stress),
                Column::Utilisation => Self::Worst(Worst::Utilisation),
                Column::Mass => Self::Mass,
                Column::Measures => Self::Measures,
                Column::Budget => Self::Budget(parts()),
                Column::Frequencies(options) => match &job.modes {
                    None => Self::Frequencies(options.count),
                    // They stand where they always do.
                    Some(_) => Self::Frequencies(0),
                },
                _ => Self::Frequencies(0),
            }
        };
        job.columns().iter().map(group).collect()
    }

    /// Names of its columns in a table with these cases: those of the loads first, then those of every
    /// case with its name before them.
    pub(crate) fn names(&self, cases: &[String]) -> Vec<String> {
        let own = |end: &'static str| move |drive: &String| format!("{drive}.{end}");
        let of_loads: Vec<String> = match self {
            Self::Drives(drives) => return drives.iter().map(own(POSITION)).collect(),
            Self::Frequencies(count) => return frequencies(*count).collect(),
            Self::Mass => return vec![MASS.into()],
            Self::Measures => {
                let all = MEASURES.iter().map(|measure| measure.name.into());
                let of_cases = cases.iter().flat_map(|case| {
                    let loaded = MEASURES.iter().filter(|measure| measure.rule.is_of_loads());
                    loaded.map(move |measure| format!("{case}.{}", measure.name))
                });
                return all.chain(of_cases).collect();
            }
            Self::DriveForces(drives) => drives.iter().map(own(FORCE)).collect(),
            Self::Wrench(joint) => WRENCH.map(|part| format!("{joint}.{part}")).into(),
            Self::Worst(worst) => {
                let name = worst.name();
                let [at, place] = AT.map(|end| format!("{name}{end}"));
                vec![name.into(), at, place]
            }
            Self::Budget(parts) => {
                let parts = parts.iter().map(String::as_str);
                let all = parts.chain(DEFORMATIONS.iter().map(|(_, word)| *word));
                all.map(|part| format!("{SHARE}.{part}")).collect()
            }
        };
        let of_cases = cases.iter().flat_map(|case| {
            let named = |name: &String| format!("{case}.{name}");
            of_loads.iter().map(named).collect::<Vec<_>>()
        });
        let of_cases: Vec<String> = of_cases.collect();
        of_loads.into_iter().chain(of_cases).collect()
    }

    /// Whether it needs a full solution of every pose, or an analysis of it, which goes pose by pose.
    pub(crate) fn is_solved(&self) -> bool {
        match self {
            Self::DriveForces(_) | Self::Wrench(_) | Self::Worst(_) | Self::Budget(_) => true,
            Self::Drives(_) | Self::Mass | Self::Measures | Self::Frequencies(_) => false,
        }
    }
}

/// Names `joint.direction` of the drives of a model.
pub(crate) fn drives(model: &Model) -> Vec<String> {
    let name = |(joint, dof): (JointId, Dof)| format!("{}.{dof}", model.joints()[joint.0].name);
    model.drives().map(name).collect()
}

/// Names of what may share in a deflection: elastic bodies, then joints.
fn parts(model: &Model) -> Vec<String> {
    let elastic = |body: &&Body| body.kind != BodyKind::Rigid;
    let bodies = model.bodies().iter().filter(elastic);
    let bodies = bodies.map(|body| format!("body {}", body.name));
    let joints = model.joints().iter();
    bodies
        .chain(joints.map(|joint| format!("joint {}", joint.name)))
        .collect()
}

/// What follows a name and a dot at the end, `None` where that is not there.
fn ends<'n>(name: &'n str, end: &str) -> Option<&'n str> {
    name.strip_suffix(end)?.strip_suffix('.')
}

/// A name with that of a case before it, in words: the case after what it is of.
fn of_case(name: &str) -> (String, &str) {
    match name.rsplit_once('.') {
        Some((case, own)) => (format!(", case {case}"), own),
        None => (String::new(), name),
    }
}

/// A drive, `joint.direction`, with that of a case before it: whether it slides, the case in words, and
/// the drive.
fn of_drive(name: &str) -> Option<(bool, String, String)> {
    let (joint, direction) = name.rsplit_once('.')?;
    let slides = !direction.parse::<Dof>().ok()?.is_rotation();
    let (case, joint) = of_case(joint);
    Some((slides, case, format!("{joint}.{direction}")))
}

/// The share that a column is, and the case in words.
fn share(name: &str) -> Option<(String, &str)> {
    let begin = format!("{SHARE}.");
    if let Some(part) = name.strip_prefix(&*begin) {
        return Some((String::new(), part));
    }
    let (case, rest) = name.split_once('.')?;
    Some((format!(", case {case}"), rest.strip_prefix(&*begin)?))
}

/// What is known of a column on request, by its name.
struct Known {
    unit: &'static str,
    words: String,
}

fn known(name: &str) -> Option<Known> {
    let of = |unit, words: String| Some(Known { unit, words });
    if let Some((case, part)) = share(name) {
        return of("", format!("share of {part} in the deflection{case}"));
    }
    if let Some((slides, case, drive)) = ends(name, POSITION).and_then(of_drive) {
        let unit = if slides { "m" } else { "rad" };
        return of(unit, format!("position of drive {drive}{case}"));
    }
    if let Some((slides, case, drive)) = ends(name, FORCE).and_then(of_drive) {
        return match slides {
            true => of("N", format!("force of drive {drive}{case}")),
            false => of("N·m", format!("moment of drive {drive}{case}")),
        };
    }
    for (k, part) in WRENCH.iter().enumerate() {
        if let Some(joint) = ends(name, part) {
            let (case, joint) = of_case(joint);
            let axis = ["x", "y", "z"][k % 3];
            return match k < 3 {
                true => of("N", format!("force along {axis} in joint {joint}{case}")),
                false => of("N·m", format!("moment about {axis} in joint {joint}{case}")),
            };
        }
    }
    if name == MASS {
        return of("kg", "mass of what moves".into());
    }
    let (case, last) = of_case(name);
    if let Some(measure) = measures::named(last) {
        return of(measure.unit, format!("{}{case}", measure.words));
    }
    for (worst, unit, words) in [
        (Worst::Stress, "Pa", "largest von Mises stress"),
        (
            Worst::Utilisation,
            "",
            "largest von Mises stress over the yield strength",
        ),
    ] {
        match last.strip_prefix(worst.name()) {
            Some("") => return of(unit, format!("{words}{case}")),
            Some(end) if end == AT[0] => return of("", format!("where it is: {words}{case}")),
            Some(end) if end == AT[1] => {
                return of("", format!("place along the segment: {words}{case}"));
            }
            _ => {}
        }
    }
    None
}

/// The SI unit of a column on request; `None` of any other.
pub(super) fn unit(name: &str) -> Option<&'static str> {
    known(name).map(|known| known.unit)
}

/// What a column on request is, in words; `None` of any other.
pub(super) fn words(name: &str) -> Option<String> {
    known(name).map(|known| known.words)
}

/// The columns that a job has to ask for to have one of this name, where it is one of its own.
#[cfg(feature = "figures")]
pub(crate) fn asking_for(name: &str) -> Option<String> {
    let (_, last) = of_case(name);
    let of_worst = |worst: Worst| {
        last.strip_prefix(worst.name())
            .is_some_and(|end| end.is_empty() || AT.contains(&end))
    };
    Some(match () {
        () if share(name).is_some() => "Budget".into(),
        () if name == MASS => "Mass".into(),
        () if of_worst(Worst::Stress) => "Stress".into(),
        () if of_worst(Worst::Utilisation) => "Utilisation".into(),
        () if ends(name, POSITION).and_then(of_drive).is_some() => "Drives".into(),
        () if ends(name, FORCE).and_then(of_drive).is_some() => "DriveForces".into(),
        () => {
            let joint = WRENCH.iter().find_map(|part| ends(name, part));
            match joint {
                Some(joint) => format!("Wrench(\"{}\")", of_case(joint).1),
                None if measures::named(last).is_some() => "Measures".into(),
                None => return None,
            }
        }
    })
}
