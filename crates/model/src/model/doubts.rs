//! What a model says that can hardly be meant. It is solved as it stands.

use std::fmt;

use hyperstat_elements::Section;
use nalgebra::Vector6;

use crate::loads::LoadSet;
use crate::model::Model;
use crate::parts::BodyKind;

/// A constant of a section, or a moment of inertia, that is above its bound by less than this part
/// of it is a rounded one: they are typed to two or three digits.
const TYPED: f64 = 1e-2;
/// Most names that are told.
const SHOWN: usize = 8;

/// Something that a model says, and that can hardly be meant.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// Gravity acts on bodies that are not made of beams and have no mass.
    Weightless {
        /// Names of the bodies.
        bodies: Vec<String>,
    },
    /// A moment of inertia that is larger than the two others together: no body has such.
    Inertia {
        /// `body.point` of the mass.
        node: String,
        /// Principal moments, ascending \[kg·m²\].
        moments: [f64; 3],
    },
    /// An effective shear area that is larger than the section.
    ShearArea {
        /// Names of the bodies with the section.
        bodies: Vec<String>,
        /// `shear_y` or `shear_z`.
        field: &'static str,
        /// The shear area \[m²\].
        shear: f64,
        /// The section's area \[m²\].
        area: f64,
    },
    /// A torsion constant above the polar second moment of area, which only a circle reaches.
    Torsion {
        /// Names of the bodies with the section.
        bodies: Vec<String>,
        /// The torsion constant \[m⁴\].
        torsion: f64,
        /// The sum of both second moments \[m⁴\].
        polar: f64,
    },
    /// A load without force and moment.
    NoLoad {
        /// `body.point`, or the body that it runs along.
        on: String,
        /// Its case, if it is one of a case.
        case: Option<String>,
    },
}

impl Model {
    /// What this model says that can hardly be meant, each once.
    pub fn doubts(&self) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        self.doubt_weight(&mut doubts);
        self.doubt_inertia(&mut doubts);
        self.doubt_sections(&mut doubts);
        self.doubt_loads(&self.loads, None, &mut doubts);
        for case in &self.cases {
            self.doubt_loads(&case.loads, Some(&case.name), &mut doubts);
        }
        doubts
    }

    fn doubt_weight(&self, doubts: &mut Vec<Doubt>) {
        if self.gravity.norm() == 0.0 {
            return;
        }
        // One of `mass: 0.0` is said to have none.
        let mut has_mass = vec![false; self.bodies.len()];
        for mass in &self.masses {
            if let Some(node) = self.nodes.get(mass.node.0) {
                has_mass[node.body.0] = true;
            }
        }
        let bodies = self.bodies.iter().zip(has_mass);
        let weightless = bodies.filter(|(body, has_mass)| {
            let of_beams = body.kind == BodyKind::Elastic;
            !of_beams && !has_mass
        });
        let bodies: Vec<_> = weightless.map(|(body, _)| body.name.clone()).collect();
        if !bodies.is_empty() {
            doubts.push(Doubt::Weightless { bodies });
        }
    }

    fn doubt_inertia(&self, doubts: &mut Vec<Doubt>) {
        for mass in &self.masses {
            let inertia = mass.mass.inertia();
            if inertia.iter().filter(|entry| **entry != 0.0).count() <= 1 {
                // A plane model gives one moment alone.
                continue;
            }
            let mut moments: [f64; 3] = inertia.symmetric_eigenvalues().into();
            moments.sort_by(f64::total_cmp);
            if moments[2] > (moments[0] + moments[1]) * (1.0 + TYPED) {
                let node = self.node_name(mass.node);
                doubts.push(Doubt::Inertia { node, moments });
            }
        }
    }

    fn doubt_sections(&self, doubts: &mut Vec<Doubt>) {
        for segment in &self.segments {
            let name = &self.bodies[segment.body.0].name;
            let second = segment.taper.as_ref().map(|taper| &taper.to);
            for section in std::iter::once(&segment.section).chain(second) {
                for doubt in doubts_of(section) {
                    let known = doubts.iter().position(|known| doubt.is_like(known));
                    let place = known.unwrap_or_else(|| {
                        doubts.push(doubt);
                        doubts.len() - 1
                    });
                    if let Doubt::ShearArea { bodies, .. } | Doubt::Torsion { bodies, .. } =
                        &mut doubts[place]
                        && bodies.last() != Some(name)
                    {
                        bodies.push(name.clone());
                    }
                }
            }
        }
    }

    fn doubt_loads(&self, loads: &LoadSet, case: Option<&str>, doubts: &mut Vec<Doubt>) {
        let none = |wrench: &Vector6<f64>| *wrench == Vector6::zeros();
        let nodes = loads.nodes.iter().filter(|load| none(&load.wrench));
        let lines = loads.lines.iter().filter(|load| load.ends.iter().all(none));
        let body = |segment: usize| &self.bodies[self.segments[segment].body.0];
        let on = nodes.map(|load| self.node_name(load.node));
        for on in on.chain(lines.map(|load| body(load.segment.0).name.clone())) {
            let case = case.map(Into::into);
            let doubt = Doubt::NoLoad { on, case };
            if !doubts.contains(&doubt) {
                doubts.push(doubt);
            }
        }
    }
}

/// What a section says that can hardly be meant, of no body yet.
fn doubts_of(section: &Section) -> impl Iterator<Item = Doubt> {
    let area = section.area();
    let shears = [
        ("shear_y", section.shear_y()),
        ("shear_z", section.shear_z()),
    ];
    let too_large = move |(field, shear): (&'static str, Option<f64>)| {
        let shear = shear.filter(|shear| *shear > area * (1.0 + TYPED))?;
        Some(Doubt::ShearArea {
            bodies: Vec::new(),
            field,
            shear,
            area,
        })
    };
    let (torsion, polar) = (section.torsion(), section.iy() + section.iz());
    let stiff = torsion > polar * (1.0 + TYPED);
    let stiff = stiff.then_some(Doubt::Torsion {
        bodies: Vec::new(),
        torsion,
        polar,
    });
    shears.into_iter().filter_map(too_large).chain(stiff)
}

impl Doubt {
    /// Whether both say the same, of whatever bodies.
    fn is_like(&self, other: &Self) -> bool {
        let numbers = |doubt: &Self| match doubt {
            Self::ShearArea {
                field, shear, area, ..
            } => Some((*field, *shear, *area)),
            Self::Torsion { torsion, polar, .. } => Some(("torsion", *torsion, *polar)),
            _ => None,
        };
        numbers(self).is_some() && numbers(self) == numbers(other)
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Weightless { bodies } => write!(
                f,
                "gravity acts, but {} no mass: give {} `masses`, or `mass: 0.0` where that is meant",
                have(bodies),
                if bodies.len() == 1 { "it" } else { "them" }
            ),
            Self::Inertia {
                node,
                moments: [first, second, third],
            } => write!(
                f,
                "no body has the inertia of the mass on `{node}`: of its principal moments {}, {} \
                 and {} kg·m² the largest is above the sum of the other two",
                short(*first),
                short(*second),
                short(*third)
            ),
            Self::ShearArea {
                bodies,
                field,
                shear,
                area,
            } => write!(
                f,
                "`{field}` of {}, {} m², is larger than the section's area, {} m²: an effective shear \
                 area κA is smaller",
                named(bodies),
                short(*shear),
                short(*area)
            ),
            Self::Torsion {
                bodies,
                torsion,
                polar,
            } => write!(
                f,
                "the torsion constant of {}, {} m⁴, is above iy + iz, {} m⁴, which only a circle \
                 reaches",
                named(bodies),
                short(*torsion),
                short(*polar)
            ),
            Self::NoLoad { on, case } => {
                write!(f, "the load on `{on}`")?;
                if let Some(case) = case {
                    write!(f, " in case `{case}`")?;
                }
                f.write_str(" has neither force nor moment")
            }
        }
    }
}

/// A number of at most six digits.
fn short(value: f64) -> String {
    let rounded = format!("{value:.5e}");
    let rounded = rounded.parse().unwrap_or(value);
    match rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        true => format!("{rounded}"),
        false => format!("{rounded:e}"),
    }
}

/// "body `a` has", "bodies `a`, `b` have".
fn have(bodies: &[String]) -> String {
    let verb = if bodies.len() == 1 { "has" } else { "have" };
    format!("{} {verb}", named(bodies))
}

/// "body `a`", "bodies `a`, `b` and 3 more".
fn named(bodies: &[String]) -> String {
    let shown = bodies.iter().take(SHOWN);
    let shown: Vec<_> = shown.map(|name| format!("`{name}`")).collect();
    let noun = if bodies.len() == 1 { "body" } else { "bodies" };
    let more = match bodies.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("{noun} {}{more}", shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_have_six_digits_at_most() {
        for (value, text) in [
            (0.1 + 0.2, "0.3"),
            (std::f64::consts::PI * 1e-9, "3.14159e-9"),
            (123_456.78, "123457"),
            (0.0, "0"),
            (5e-9, "5e-9"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
