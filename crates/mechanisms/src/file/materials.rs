//! Materials and sections, as tables of a mechanism file or in place in a prebuilt one.

use hyperstat_elements::{Elasticity, ElementError, Material, Section, SectionShape, Taper};
use hyperstat_model::Tapering;

use crate::error::LoadError;
use crate::terms::parts::{MATERIAL, PROFILE, SECTION};
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::names;

/// What the table of sections holds.
#[derive(Debug, Clone)]
pub(crate) enum Profile {
    /// One section all along.
    Uniform(Section),
    /// A section that changes along what it is used for.
    Tapered(Taper),
}

impl Profile {
    /// The section and its change over this part (0 to 1) of what it is used for.
    pub(crate) fn part(&self, part: [f64; 2]) -> (Section, Option<Tapering>) {
        match self {
            Self::Uniform(section) => (section.clone(), None),
            Self::Tapered(taper) => {
                let to = taper.to().clone();
                (taper.from().clone(), Some(Tapering { to, part }))
            }
        }
    }
}

/// Reads `(young: …, poisson: …, density: …)`; `owner` is what errors call it.
pub(crate) fn material(fragment: Fragment<'_>, owner: &str) -> Result<Material, LoadError> {
    let fields = Fields::read(fragment, owner, &MATERIAL.names())?;
    let young = fields.number("young")?;
    let poisson = fields.optional_number("poisson")?;
    let shear = fields.optional_number("shear")?;
    let elasticity = match (poisson, shear) {
        (Some(poisson), None) => Elasticity::Poisson(poisson),
        (None, Some(shear)) => Elasticity::Shear(shear),
        (Some(_), Some(_)) => {
            return Err(fields
                .error("shear", format!("{owner} has both `poisson` and `shear`"))
                .with_help("each follows from the other: remove one of the two"));
        }
        (None, None) => {
            return Err(fragment
                .error(format!("{owner} has neither `poisson` nor `shear`"))
                .with_help("add one of them, such as `poisson: 0.3`"));
        }
    };
    let density = fields.optional_number("density")?;
    let expansion = fields.optional_number("expansion")?;
    let yield_strength = fields.optional_number("yield")?;
    let read = || -> Result<Material, ElementError> {
        let mut material = Material::new(young, elasticity, density)?;
        if let Some(expansion) = expansion {
            material = material.with_expansion(expansion)?;
        }
        if let Some(yield_strength) = yield_strength {
            material = material.with_yield_strength(yield_strength)?;
        }
        Ok(material)
    };
    read().map_err(|error| fields.element_error(&error))
}

/// Reads a section, or `Tapered(from: …, to: …)` with two sections.
pub(crate) fn profile(fragment: Fragment<'_>, owner: &str) -> Result<Profile, LoadError> {
    let arguments = match fragment.variant("") {
        Ok((kind, arguments)) if kind.text() == "Tapered" => arguments,
        _ => return section(fragment, owner).map(Profile::Uniform),
    };
    let fields = match arguments {
        Some(given) => {
            let known = PROFILE.fields("Tapered").unwrap_or_default();
            Fields::read(given, owner, &known)?.within(fragment)
        }
        None => Fields::none(fragment, owner),
    };
    let end = |name: &str| section(fields.required(name)?, &format!("`{name}` of {owner}"));
    let taper = Taper::new(end("from")?, end("to")?).map_err(|error| match error {
        ElementError::DifferentKinds { from, to } => fields
            .error(
                "to",
                format!("{owner} cannot change from a {from} to a {to}"),
            )
            .with_help(
                "give both ends sections of one kind; a circle is a `Tube` with `inner: 0.0`",
            ),
        ElementError::OneEnd { field } => fields
            .error("to", format!("{owner} has `{field}` at one end only"))
            .with_help(format!("give `{field}` at both ends, or at none")),
        other => fields.element_error(&other),
    })?;
    Ok(Profile::Tapered(taper))
}

/// Reads `Circle(…)`, `Tube(…)`, `Rectangle(…)` or `General(…)`.
pub(crate) fn section(fragment: Fragment<'_>, owner: &str) -> Result<Section, LoadError> {
    let (kind, arguments) = fragment.variant("a section, such as `Circle(diameter: 0.02)`")?;
    let known = match (SECTION.fields(kind.text()), kind.text()) {
        (Some(known), _) => known,
        (None, "Tapered") => {
            return Err(kind.error(format!("{owner} cannot taper")).with_help(
                "give one section; a section of the table `sections` can be \
                     `Tapered(from: …, to: …)`, between two that do not taper",
            ));
        }
        (None, other) => {
            return Err(kind
                .error(format!("unknown kind of section `{other}`"))
                .unreadable()
                .with_help(names::help(other, "kinds of section", PROFILE.names())));
        }
    };
    let fields = match arguments {
        Some(given) => Fields::read(given, owner, &known)?.within(fragment),
        None => Fields::none(fragment, owner),
    };
    let shape = match kind.text() {
        "Circle" => SectionShape::Circle {
            diameter: fields.number("diameter")?,
        },
        "Tube" => SectionShape::Tube {
            outer: fields.number("outer")?,
            inner: fields.number("inner")?,
        },
        "Rectangle" => SectionShape::Rectangle {
            width: fields.number("width")?,
            height: fields.number("height")?,
        },
        _ => SectionShape::General {
            area: fields.number("area")?,
            iy: fields.number("iy")?,
            iz: fields.number("iz")?,
            torsion: fields.number("torsion")?,
            y_max: fields.optional_number("y_max")?,
            z_max: fields.optional_number("z_max")?,
            torsion_modulus: fields.optional_number("torsion_modulus")?,
        },
    };
    let [shear_y, shear_z] = ["shear_y", "shear_z"].map(|name| fields.optional_number(name));
    Section::new(shape, shear_y?, shear_z?).map_err(|error| fields.element_error(&error))
}
