//! Groups of points, bodies, joints, masses and loads that are written once, and their copies.
//!
//! `groups: { "limb": (points: …, bodies: …, joints: …) }` says what is copied,
//! `copies: { "limb": Turned(axis: (0.0, 0.0, 1.0), count: 3) }` where the copies stand. The tree of a file
//! becomes one without groups: every copy's values stand where those of the group are written, so that
//! messages point there, and names are numbered, `A` becoming `A1`, `A2`, `A3`.

mod copy;
mod joint;
pub(crate) mod mounts;
mod placement;
mod renamed;

use std::collections::HashMap;

use copy::{Copy, Naming};

use crate::error::LoadError;
use crate::file::through::check_name;
use crate::terms::mechanism::{COPIED, GROUP};
use crate::text::fields::Fields;
use crate::text::fragment::{Entry, Fragment, first_at};
use crate::text::names;
use crate::text::paths;
use crate::text::scope::{Open, Scope};
use crate::text::tree::{Named, Node, Steps};

/// The fields of a group, which are fields of a mechanism too.
pub(super) const PARTS: [&str; 5] = ["points", "bodies", "joints", "loads", "masses"];

/// A mechanism's tree without groups.
#[derive(Debug)]
pub(crate) struct Written {
    pub(crate) root: Node,
    pub(crate) copies: Copies,
}

/// The paths to what is copied, which all copies share that have nothing of their own there.
#[derive(Debug, Clone, Default)]
pub(crate) struct Copies {
    /// By the joint's name.
    joints: HashMap<String, Shared>,
    /// By the mass's number.
    masses: HashMap<usize, Shared>,
}

/// A part of a group in one copy.
#[derive(Debug, Clone)]
struct Shared {
    /// Its path, in the group.
    group: String,
    part: String,
    /// The path to what the copy has of its own, and the paths in the group to these values.
    overrides: String,
    own: Vec<String>,
}

impl Shared {
    /// The path to one of its values, which all copies share, or this copy's own; `None` where it is a part of
    /// a value that is the copy's own.
    fn value(&self, name: &str) -> Option<String> {
        let value = format!("{}.{name}", self.part);
        match self.own.iter().find(|own| starts_with(own, &value)) {
            None => Some(format!("{}.{value}", self.group)),
            Some(own) => (*own == value).then(|| format!("{}.{value}", self.overrides)),
        }
    }
}

impl Copies {
    /// Adds those of a mechanism that is mounted under this name; its masses stand behind so many others.
    fn mount(&mut self, other: &Self, name: &str, first: usize, masses: Option<&Node>) {
        let own = |path: &str| match path.split_once('.') {
            Some((section, rest)) => format!("{section}.{name}.{rest}"),
            None => format!("{path}.{name}"),
        };
        let mounted = |shared: &Shared| Shared {
            group: own(&shared.group),
            overrides: own(&shared.overrides),
            ..shared.clone()
        };
        for (joint, shared) in &other.joints {
            self.joints
                .insert(format!("{name}.{joint}"), mounted(shared));
        }
        for k in 0..masses.map_or(0, |masses| masses.items().len()) {
            let alone = Shared {
                group: format!("masses.{name}"),
                part: k.to_string(),
                overrides: String::new(),
                own: Vec::new(),
            };
            let shared = other.masses.get(&k).map_or(alone, mounted);
            self.masses.insert(first + k, shared);
        }
    }

    /// The path to the stiffness of a joint along a direction of this name.
    pub(crate) fn stiffness(&self, joint: &str, direction: &str) -> Option<String> {
        let value = format!("stiffness.{direction}");
        match self.joints.get(joint) {
            Some(own) => own.value(&value),
            None => Some(format!("joints.{joint}.{value}")),
        }
    }

    /// The path to a mass.
    pub(crate) fn mass(&self, number: usize) -> Option<String> {
        match self.masses.get(&number) {
            Some(own) => own.value("mass"),
            None => Some(format!("masses.{number}.mass")),
        }
    }
}

/// The mechanism with the values of its expressions in their places, and its groups written out: those of
/// `copies`. In a group, expressions know its points as it is written; elsewhere those of all copies.
pub(crate) fn write_out(root: &Node) -> Result<Written, LoadError> {
    let mut written = unvalued(root)?;
    written.root = Scope::tree(&written.root)?;
    Ok(written)
}

/// The mechanism with its groups written out, and expressions elsewhere as they are: what these know.
pub(crate) fn with_copies(root: &Node) -> Result<Node, LoadError> {
    unvalued(root).map(|written| written.root)
}

fn unvalued(root: &Node) -> Result<Written, LoadError> {
    let mut written = Written {
        root: root.clone(),
        copies: Copies::default(),
    };
    mounts::write_out(&mut written)?;
    let root = &written.root.clone();
    if root.get("groups").is_some() || root.get("copies").is_some() {
        let value = |root: &Node, node: &Node| Ok(Scope::lazy(root)?.valued(node));
        of_copies(&valued(root, value)?, &mut written)?;
    }
    Ok(written)
}

/// The mechanism with the values of those expressions that lean on nothing open in their places, groups
/// still groups; `None` where one has no value for another reason, which is told where it is read.
pub(crate) fn settled(root: &Node, open: &Open) -> Option<Node> {
    let settle = |root: &Node, node: &Node| Scope::settling(root, open).ok()?.settled(node);
    let inside = valued(root, |root, node| settle(root, node).ok_or(())).ok()?;
    settle(&inside, &inside)
}

/// The mechanism with the values of the expressions of its groups, and of what is said of their copies, in
/// their places, which `value` finds under the names of a mechanism.
fn valued<E>(root: &Node, value: impl Fn(&Node, &Node) -> Result<Node, E>) -> Result<Node, E> {
    let mut tree = root.clone();
    if let Some(copies) = root.get("copies") {
        let copies = value(root, copies)?;
        tree = tree.with_field("copies", copies);
    }
    if let Some(groups) = root.get("groups") {
        let mut made = Vec::new();
        for own in groups.entries() {
            let mut points = own
                .value()
                .get("points")
                .map_or(&[][..], Node::entries)
                .to_vec();
            points.extend_from_slice(root.get("points").map_or(&[][..], Node::entries));
            let place = own.value().get("points").unwrap_or(groups);
            let root = root.with_field("points", place.map_in_place(points));
            made.push(own.with(own.name(), value(&root, own.value())?));
        }
        // What is no map is told where it is read.
        if !made.is_empty() {
            tree = tree.with_field("groups", groups.map_in_place(made));
        }
    }
    Ok(tree)
}

/// Writes out the copies, whose numbers are known.
fn of_copies(root: &Node, written: &mut Written) -> Result<(), LoadError> {
    let groups = root.get("groups");
    let Some(copies) = root.get("copies") else {
        written.root = root.without_field("groups");
        return Ok(());
    };
    let groups: Vec<Entry<'_>> = match groups {
        Some(groups) => Fragment::of_node(groups).map()?,
        None => Vec::new(),
    };
    let mut parts = PARTS.map(|part| Parts::of(root.get(part)));
    for entry in Fragment::of_node(copies).map()? {
        let Some(group) = groups.iter().find(|group| group.name == entry.name) else {
            let known = groups.iter().map(|group| group.name.as_str());
            return Err(entry
                .key
                .error(format!("unknown group `{}`", entry.name))
                .unreadable()
                .with_help(names::help(&entry.name, "groups", known)));
        };
        let node = root
            .get("groups")
            .and_then(|groups| groups.get(&entry.name));
        let Some(node) = node else { continue };
        of_group((&entry, copies), (group, node), root, &mut parts, written)?;
    }
    let mut tree = root.without_field("groups").without_field("copies");
    for (name, part) in PARTS.into_iter().zip(parts) {
        if !part.is_empty() {
            let place = root.get(name).unwrap_or(copies);
            tree = tree.with_field(name, part.into_node(place));
        }
    }
    written.root = tree;
    Ok(())
}

/// Adds the copies of one group.
fn of_group(
    (entry, copies): (&Entry<'_>, &Node),
    (group, node): (&Entry<'_>, &Node),
    root: &Node,
    parts: &mut [Parts; 5],
    written: &mut Written,
) -> Result<(), LoadError> {
    let owner = format!("group `{}`", group.name);
    let fields = Fields::read(group.value, &owner, &GROUP.names())?;
    for map in ["points", "bodies", "joints"] {
        if let Some(map) = fields.get(map) {
            map.map()?;
        }
    }
    check_names(group, node, root)?;
    let (places, names, overrides) = read(entry)?;
    let overrides = match overrides {
        Some(map) => map.map()?,
        None => Vec::new(),
    };
    let of_copy = |name: &str| copies.get(&entry.name)?.get("overrides")?.get(name);
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    for own in &overrides {
        if !names.contains(&own.name) {
            return Err(own
                .key
                .error(format!("group `{}` has no copy `{}`", group.name, own.name))
                .with_help(names::help(&own.name, "copies", known.iter().copied())));
        }
    }
    for (placement, name) in places.iter().zip(&names) {
        let own = overrides.iter().find(|own| own.name == *name);
        let (node, changed) = changed((node, &owner), own.zip(of_copy(name)))?;
        let naming = Naming {
            before: "",
            after: name,
        };
        let copy = Copy::new(&node, root, placement, naming);
        let shared = |part: String| Shared {
            group: format!("groups.{}", group.name),
            part,
            overrides: format!("copies.{}.overrides.{name}", group.name),
            own: changed.clone(),
        };
        let joints = copy.joints(|joint, made| {
            let own = shared(format!("joints.{joint}"));
            written.copies.joints.insert(made.to_owned(), own);
        })?;
        let masses = node.get("masses").map_or(&[][..], Node::items).len();
        for k in 0..masses {
            let own = shared(format!("masses.{k}"));
            written.copies.masses.insert(parts[4].len() + k, own);
        }
        parts[0].add_entries(copy.points()?, "point")?;
        parts[1].add_entries(copy.bodies()?, "body")?;
        parts[2].add_entries(joints, "joint")?;
        parts[3].items.extend(copy.loads()?);
        parts[4].items.extend(copy.masses()?);
    }
    Ok(())
}

/// Whether a path leads to a value, or into it, or around it.
fn starts_with(one: &str, other: &str) -> bool {
    let inside = |long: &str, short: &str| {
        let rest = long.strip_prefix(short);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    inside(one, other) || inside(other, one)
}

/// What an entry of `copies` says: places, names, and other values of single copies.
type Asked<'a> = (Vec<placement::Placement>, Vec<String>, Option<Fragment<'a>>);

/// Reads an entry of `copies`: places, or `(places: …, names: […], overrides: { … })`.
fn read<'a>(entry: &Entry<'a>) -> Result<Asked<'a>, LoadError> {
    let given = entry.value;
    if !given.has_fields() {
        let places = placement::read(given)?;
        let names = (1..=places.len()).map(|k| k.to_string()).collect();
        return Ok((places, names, None));
    }
    let owner = format!("the copies of `{}`", entry.name);
    let fields = Fields::read(given, owner, &COPIED.names())?;
    let places = placement::read(fields.required("places")?)?;
    let names = match fields.get("names") {
        None => (1..=places.len()).map(|k| k.to_string()).collect(),
        Some(list) => endings(list, places.len())?,
    };
    Ok((places, names, fields.get("overrides")))
}

/// Reads what is put at the end of names, a text for each copy.
fn endings(list: Fragment<'_>, count: usize) -> Result<Vec<String>, LoadError> {
    let items = list.list("a list of endings, such as `[\"_left\", \"_right\"]`")?;
    let mut names = Vec::with_capacity(items.len());
    for item in items {
        let name = item.string()?;
        if names.contains(&name) || name.contains('.') {
            return Err(item
                .error(format!("`{name}` cannot be the ending of a copy's names"))
                .with_help("each copy has its own ending, without a `.`"));
        }
        names.push(name);
    }
    if names.len() != count {
        let message = format!("there are {count} copies, and {} endings", names.len());
        return Err(list
            .error(message)
            .with_help("give one ending for each copy"));
    }
    Ok(names)
}

/// A group with the values that a copy has for itself, and the paths of these.
fn changed(
    (group, whole): (&Node, &str),
    own: Option<(&Entry<'_>, &Node)>,
) -> Result<(Node, Vec<String>), LoadError> {
    let mut node = group.clone();
    let mut changed = Vec::new();
    let Some((own, values)) = own else {
        return Ok((node, changed));
    };
    let mut taken: Vec<Steps> = Vec::new();
    for (value, own) in own.value.map()?.into_iter().zip(values.entries()) {
        let steps = paths::find(group, value.key, whole)?;
        let overlaps = |other: &Steps| paths::overlap(other, &steps);
        if let Some(other) = taken.iter().position(overlaps) {
            return Err(paths::overlapping(&changed[other], value.key));
        }
        node.replace(&steps, own.value().clone());
        changed.push(value.name);
        taken.push(steps);
    }
    Ok((node, changed))
}

/// Refuses a point or a body of a group that has the name of one of the mechanism: which of the two is
/// meant could not be told.
fn check_names(group: &Entry<'_>, node: &Node, root: &Node) -> Result<(), LoadError> {
    for (part, what) in [("points", "point"), ("bodies", "body")] {
        let entries = node.get(part).map_or(&[][..], Node::entries);
        if let Some(own) = entries.iter().find(|own| {
            let other = root.get(part).and_then(|part| part.get(own.name()));
            other.is_some()
        }) {
            let name = own.name();
            let message = format!("the mechanism has a {what} `{name}`, too");
            let help = format!("give the one of group `{}` another name", group.name);
            return Err(own.place().error(message).with_help(help));
        }
    }
    Ok(())
}

/// Entries or items of one field of a mechanism, the file's own first.
#[derive(Debug, Default)]
struct Parts {
    entries: Vec<Named>,
    items: Vec<Node>,
    /// The number of the entry of each name.
    by_name: HashMap<String, usize>,
}

impl Parts {
    fn of(field: Option<&Node>) -> Self {
        let mut parts = Self::default();
        for own in field.map_or(&[][..], Node::entries) {
            parts.by_name.insert(own.name().into(), parts.entries.len());
            parts.entries.push(own.clone());
        }
        parts.items = field.map_or(&[][..], Node::items).to_vec();
        parts
    }

    fn is_empty(&self) -> bool {
        self.entries.is_empty() && self.items.is_empty()
    }

    fn len(&self) -> usize {
        self.items.len()
    }

    /// Adds entries of a copy; a name that is there is refused.
    fn add_entries(&mut self, entries: Vec<Named>, what: &str) -> Result<(), LoadError> {
        for own in entries {
            let next = self.entries.len();
            if let Some(first) = self.by_name.insert(own.name().into(), next) {
                let message = format!("a copy makes a second {what} `{}`", own.name());
                let first = self.entries[first].place();
                return Err(own
                    .place()
                    .error(message)
                    .with_help(first_at(Fragment::at(&first))));
            }
            check_name(&Entry::of(&own), what)?;
            self.entries.push(own);
        }
        Ok(())
    }

    /// Adds entries whose names are their own.
    fn put(&mut self, entries: impl IntoIterator<Item = Named>) {
        for own in entries {
            self.by_name.insert(own.name().into(), self.entries.len());
            self.entries.push(own);
        }
    }

    fn into_node(self, place: &Node) -> Node {
        match self.items.is_empty() {
            true => place.map_in_place(self.entries),
            false => place.list_in_place(self.items),
        }
    }
}
