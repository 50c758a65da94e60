//! The JSON Schema of files, made from the table of what may stand in them.

use serde_json::{Map, Value, json};

use crate::file::registry::{Known, Registry};
use crate::terms::job::BATCH;
use crate::terms::mechanism::MECHANISM;
use crate::terms::{Arguments, Field, Kind, Kinds, Record, Type, joints};
use crate::text::fields::SCHEMA;

/// The JSON Schema (draft 2020-12) of mechanism and batch files in JSON, with the kinds of joints and of
/// prebuilt mechanisms in `registry`. Of kinds that a program has registered the names of their fields are
/// known, and no more. RON files have the same names.
pub fn schema(registry: &Registry) -> String {
    let mut definitions = Definitions {
        registry,
        found: Map::new(),
    };
    let [mechanism, batch] = [&MECHANISM, &BATCH].map(|record| {
        let reference = definitions.record(record);
        definitions.found[record.name]["properties"][SCHEMA] = json!({
            "type": "string",
            "description": "this schema, for editors",
        });
        reference
    });
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "hyperstat file",
        "description": "A mechanism or a batch of jobs for hyperstat; SI units (m, N, rad, kg, s)",
        "oneOf": [mechanism, batch],
        "$defs": definitions.found,
    });
    // A value always has a text.
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}

/// What the schema refers to by name.
struct Definitions<'r> {
    registry: &'r Registry,
    found: Map<String, Value>,
}

impl Definitions<'_> {
    /// A reference to the definition of this name, which `make` makes the first time.
    fn reference(&mut self, name: &str, make: impl FnOnce(&mut Self) -> Value) -> Value {
        if !self.found.contains_key(name) {
            // What refers to itself finds it.
            self.found.insert(name.into(), Value::Null);
            let made = make(self);
            self.found.insert(name.into(), made);
        }
        json!({ "$ref": format!("#/$defs/{name}") })
    }

    fn record(&mut self, record: &Record) -> Value {
        self.reference(record.name, |own| {
            let mut object = own.object(record.fields);
            object["description"] = record.about.into();
            if !record.one_of.is_empty() {
                let choices = record.one_of.iter();
                let choices = choices.map(|name| json!({ "required": [name] }));
                object["oneOf"] = choices.collect();
            }
            if !record.any_of.is_empty() {
                let choices = record.any_of.iter();
                let choices = choices.map(|name| json!({ "required": [name] }));
                object["anyOf"] = choices.collect();
            }
            object
        })
    }

    /// An object of these fields and no others.
    fn object(&mut self, fields: &[Field]) -> Value {
        let mut properties = Map::new();
        for field in fields {
            properties.insert(field.name.into(), self.field(field));
        }
        let required = fields.iter().filter(|field| field.required);
        let required: Vec<&str> = required.map(|field| field.name).collect();
        let mut object = json!({
            "type": "object",
            "properties": properties,
            "additionalProperties": false,
        });
        if !required.is_empty() {
            object["required"] = required.into();
        }
        object
    }

    fn field(&mut self, field: &Field) -> Value {
        let mut value = self.value(field.of);
        let about = match unit(field.of) {
            Some(unit) => format!("{} [{unit}]", field.about),
            None => field.about.into(),
        };
        value["description"] = about.into();
        value
    }

    fn value(&mut self, of: Type) -> Value {
        match of {
            // With a unit, or an expression.
            Type::Number(_) => json!({ "anyOf": [
                { "type": "number" },
                { "type": "string", "pattern": QUANTITY },
            ] }),
            Type::Count(least, most) => {
                let mut count = json!({ "type": "integer", "minimum": least });
                if most != crate::terms::NO_END {
                    count["maximum"] = most.into();
                }
                json!({ "anyOf": [count, expression()] })
            }
            Type::Truth => json!({ "type": "boolean" }),
            Type::Text => json!({ "type": "string" }),
            Type::Word(words) => json!({ "enum": words }),
            Type::Numbers(count, _) => {
                let numbers = json!({
                    "type": "array",
                    "items": self.value(Type::Number("")),
                    "minItems": count,
                    "maxItems": count,
                });
                match count {
                    // A point may be an expression, too.
                    3 => json!({ "anyOf": [numbers, expression()] }),
                    _ => numbers,
                }
            }
            Type::Tuple(items) => {
                let values: Vec<Value> = items.iter().map(|item| self.value(*item)).collect();
                json!({
                    "type": "array",
                    "prefixItems": values,
                    "items": false,
                    "minItems": items.len(),
                })
            }
            Type::List(item) => json!({ "type": "array", "items": self.value(*item) }),
            Type::Map(value) => {
                json!({ "type": "object", "additionalProperties": self.value(*value) })
            }
            Type::Record(record) => self.record(record),
            Type::Kinds(kinds) => self.kinds(kinds),
            Type::Any(choices) => {
                let choices = choices.iter().map(|choice| self.value(*choice));
                json!({ "anyOf": choices.collect::<Vec<_>>() })
            }
            Type::Joint => self.joints(),
            Type::Mechanism => self.mechanisms(),
            Type::Anything => json!({}),
        }
    }

    fn kinds(&mut self, kinds: &Kinds) -> Value {
        self.reference(kinds.name, |own| {
            let kinds = kinds.kinds.iter().map(|kind| own.kind(kind));
            one_of_kinds(kinds.collect())
        })
    }

    fn kind(&mut self, kind: &Kind) -> OneKind {
        let (mut arguments, alone) = match kind.arguments {
            Arguments::Fields(fields) => (self.object(fields), stands_alone(fields)),
            Arguments::Value(value) => (self.value(value), false),
        };
        arguments["description"] = kind.about.into();
        OneKind {
            name: kind.name.into(),
            arguments,
            alone,
        }
    }

    fn joints(&mut self) -> Value {
        self.reference("joint_kind", |own| {
            let kinds = own.registry.known_kinds();
            one_of_kinds(
                kinds
                    .map(|(name, known)| own.registered(name, known))
                    .collect(),
            )
        })
    }

    fn mechanisms(&mut self) -> Value {
        self.reference("job_mechanism", |own| {
            let file = OneKind {
                name: "File".into(),
                arguments: json!({ "type": "string", "description": "a mechanism file" }),
                alone: false,
            };
            let registry = own.registry;
            let prebuilts = registry.known_prebuilts();
            let prebuilts = prebuilts.map(|(name, known)| {
                let mut kind = own.registered(name, known);
                kind.arguments["description"] = "a prebuilt mechanism".into();
                kind
            });
            one_of_kinds(std::iter::once(file).chain(prebuilts).collect())
        })
    }

    /// A registered kind.
    fn registered(&mut self, name: &str, known: Known) -> OneKind {
        let (mut arguments, alone) = match known {
            Known::Fields(fields) => (self.object(fields), stands_alone(fields)),
            Known::Names(names) => {
                let properties = names.iter().map(|name| ((*name).into(), json!({})));
                let properties: Map<String, Value> = properties.collect();
                let object = json!({
                    "type": "object",
                    "properties": properties,
                    "additionalProperties": false,
                });
                (object, true)
            }
        };
        let mut builtin = joints::KINDS.iter();
        if let Some(kind) = builtin.find(|kind| kind.name == name) {
            arguments["description"] = kind.about.into();
        }
        OneKind {
            name: name.into(),
            arguments,
            alone,
        }
    }
}

/// A kind in the schema.
struct OneKind {
    name: String,
    /// What its arguments are.
    arguments: Value,
    /// Whether its name may stand alone.
    alone: bool,
}

/// Whether a kind of these fields needs none of them.
fn stands_alone(fields: &[Field]) -> bool {
    fields.iter().all(|field| !field.required)
}

/// One of some kinds: an object of one name, or a name alone.
fn one_of_kinds(kinds: Vec<OneKind>) -> Value {
    let alone = kinds.iter().filter(|kind| kind.alone);
    let alone: Vec<Value> = alone.map(|kind| kind.name.as_str().into()).collect();
    let properties = kinds.into_iter().map(|kind| (kind.name, kind.arguments));
    let object = json!({
        "type": "object",
        "properties": properties.collect::<Map<_, _>>(),
        "additionalProperties": false,
        "minProperties": 1,
        "maxProperties": 1,
    });
    match alone.is_empty() {
        true => object,
        false => json!({ "anyOf": [{ "enum": alone }, object] }),
    }
}

/// The unit that is told of a field.
pub(crate) fn unit(of: Type) -> Option<&'static str> {
    match of {
        Type::Number(unit) | Type::Numbers(_, unit) => Some(unit).filter(|unit| *unit != "-"),
        Type::Map(value) | Type::List(value) => unit(*value),
        _ => None,
    }
}

/// An expression, or a number with a unit.
const QUANTITY: &str =
    r"^\s*(=|[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*[A-Za-z\u00b5\u00b0%\u03bc])";

/// A text that begins with `=`.
fn expression() -> Value {
    json!({ "type": "string", "pattern": "^\\s*=" })
}

#[cfg(test)]
mod tests;
