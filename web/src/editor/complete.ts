// Completion from the JSON Schema of mechanism and batch files, and from the names of the file itself.

import type { Completion, CompletionContext, CompletionResult } from '@codemirror/autocomplete';
import { type Level, names, placeAt } from './outline';

/** As much of JSON Schema as the files' schema uses. */
export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  anyOf?: Schema[];
  oneOf?: Schema[];
  allOf?: Schema[];
  properties?: Record<string, Schema>;
  additionalProperties?: Schema | boolean;
  items?: Schema | boolean;
  prefixItems?: Schema[];
  enum?: unknown[];
  const?: unknown;
  description?: string;
  required?: string[];
  maxProperties?: number;
  type?: string | string[];
}

/** Fields whose text is the name of something in the file, and the map that has it. */
const REFERENCES: Record<string, string[]> = {
  section: ['sections'],
  material: ['materials'],
  through: ['points'],
  points: ['points'],
  members: ['points'],
  at: ['points'],
  between: ['bodies'],
  on: ['bodies', 'points'],
  output: ['bodies', 'points'],
  body: ['bodies'],
  point: ['points'],
  group: ['groups'],
};

/** What completes files of a schema. */
export function completer(root: Schema): (context: CompletionContext) => CompletionResult | null {
  return (context) => {
    const text = context.state.doc.toString();
    const place = placeAt(text, context.pos);
    if (!context.explicit && place.word === '' && !place.quoted) {
      return null;
    }
    const here = place.levels.at(-1);
    if (!here) {
      return null;
    }
    const options = place.quoted
      ? references(text, place.levels)
      : here.key === null
        ? keys(at(root, place.levels.slice(0, -1), here.variant), here, root)
        : values(at(root, place.levels, null), root);
    return options.length > 0 ? { from: place.from, options, validFor: /^[\w$]*$/ } : null;
  };
}

/** The schemas that may hold at a level, references and alternatives taken apart. */
function open(schemas: readonly Schema[], root: Schema): Schema[] {
  return schemas.flatMap((schema): Schema[] => {
    const named = schema.$ref ? root.$defs?.[schema.$ref.replace('#/$defs/', '')] : undefined;
    const parts = [...(named ? [named] : []), ...(schema.anyOf ?? []), ...(schema.oneOf ?? []), ...(schema.allOf ?? [])];
    return parts.length > 0 ? [schema, ...open(parts, root)] : [schema];
  });
}

function at(root: Schema, levels: readonly Level[], variant: string | null): Schema[] {
  let here = open([root], root);
  for (const level of levels) {
    here = open(within(here, level, root), root);
  }
  return variant ? open(ofVariant(here, variant), root) : here;
}

function ofVariant(schemas: readonly Schema[], variant: string): Schema[] {
  return schemas.flatMap((schema) => schema.properties?.[variant] ?? []);
}

function within(schemas: readonly Schema[], level: Level, root: Schema): Schema[] {
  const around = level.variant ? open(ofVariant(schemas, level.variant), root) : schemas;
  return around.flatMap((schema): Schema[] => {
    if (level.key !== null) {
      const own = schema.properties?.[level.key];
      const other = typeof schema.additionalProperties === 'object' ? [schema.additionalProperties] : [];
      return own ? [own] : other;
    }
    const item = schema.prefixItems?.[level.index] ?? schema.items;
    return typeof item === 'object' ? [item] : [];
  });
}

function keys(schemas: readonly Schema[], level: Level, root: Schema): Completion[] {
  const found = new Map<string, Completion>();
  for (const schema of schemas) {
    for (const [label, property] of Object.entries(schema.properties ?? {})) {
      // A map of one entry is how JSON writes `Circle(…)`: a kind, no field.
      const kind = schema.maxProperties === 1;
      if (kind || level.keys.includes(label) || label === '$schema') {
        continue;
      }
      const quoted = level.bracket === '{' ? `"${label}": ` : `${label}: `;
      const needed = schema.required?.includes(label) === true;
      found.set(label, {
        label,
        apply: quoted,
        type: 'property',
        detail: needed ? 'needed' : '',
        info: described(property, root),
        boost: needed ? 2 : 0,
      });
    }
  }
  // Within lists and tuples values stand where keys do elsewhere.
  return level.bracket === '[' || found.size === 0 ? values(itemsOf(schemas, level, root), root) : [...found.values()];
}

function itemsOf(schemas: readonly Schema[], level: Level, root: Schema): Schema[] {
  return open(within(schemas, { ...level, variant: null }, root), root);
}

function values(schemas: readonly Schema[], root: Schema): Completion[] {
  const found = new Map<string, Completion>();
  for (const schema of schemas) {
    for (const value of schema.enum ?? []) {
      found.set(String(value), { label: String(value), type: 'enum', info: schema.description ?? '' });
    }
    if (schema.maxProperties === 1) {
      for (const [label, property] of Object.entries(schema.properties ?? {})) {
        found.set(label, { label, apply: `${label}(`, type: 'class', info: described(property, root) });
      }
    }
    if (schema.type === 'boolean') {
      found.set('true', { label: 'true', type: 'keyword' }).set('false', { label: 'false', type: 'keyword' });
    }
  }
  return [...found.values()];
}

function described(schema: Schema, root: Schema): string {
  return schema.description ?? open([schema], root).find((each) => each.description)?.description ?? '';
}

function references(text: string, levels: readonly Level[]): Completion[] {
  const field = levels.findLast((level) => level.key !== null && level.key in REFERENCES)?.key;
  if (!field) {
    return [];
  }
  const all = names(text);
  const options = (REFERENCES[field] ?? []).flatMap((map) =>
    (all.get(map) ?? []).map((label): Completion => ({ label, type: 'variable', detail: map })),
  );
  return field === 'between' ? [{ label: 'ground', type: 'variable', detail: 'the fixed body' }, ...options] : options;
}
