// Reads RON and JSON as far as an editor needs: where a place of the text stands in the file, also while it is
// half written. What is right or wrong is the core's to say.

/** One open bracket around a place. */
export interface Level {
  /** `(`, `{` or `[`. */
  bracket: string;
  /** The word before the bracket: `Circle` of `Circle(`. */
  variant: string | null;
  /** The key of the entry that the place is in. */
  key: string | null;
  /** The number of the entry, from 0. */
  index: number;
  /** Keys that were read so far. */
  keys: string[];
}

/** A number of the file, with the path that `vary` and `with_values` take. */
export interface Leaf {
  path: string;
  from: number;
  to: number;
  value: number;
}

/** What stands at a place of the text. */
export interface Place {
  levels: Level[];
  /** Where the word at the place begins. */
  from: number;
  /** Letters of the word before the place. */
  word: string;
  /** The place is within a text in quotes. */
  quoted: boolean;
}

interface Token {
  kind: 'open' | 'close' | 'comma' | 'colon' | 'word' | 'number' | 'text';
  text: string;
  from: number;
  to: number;
}

const NEXT =
  /(?<skip>\s+|\/\/[^\n]*|\/\*[\s\S]*?(?:\*\/|$)|#!\[[^\]]*\])|(?<text>"(?:[^"\\]|\\[\s\S])*(?:"|$))|(?<number>[-+]?(?:\d[\d_]*\.?[\d_]*|\.\d+)(?:[eE][-+]?\d+)?)|(?<word>[A-Za-z_][A-Za-z0-9_]*)|(?<sign>[\s\S])/gy;

function* tokens(text: string): Generator<Token> {
  NEXT.lastIndex = 0;
  for (let found = NEXT.exec(text); found; found = NEXT.exec(text)) {
    const at = { from: found.index, to: NEXT.lastIndex, text: found[0] };
    const group = found.groups ?? {};
    if (group.text !== undefined) {
      yield { kind: 'text', ...at };
    } else if (group.number !== undefined) {
      yield { kind: 'number', ...at };
    } else if (group.word !== undefined) {
      yield { kind: 'word', ...at };
    } else if (group.sign !== undefined) {
      const sign = group.sign;
      const kind = '([{'.includes(sign)
        ? 'open'
        : ')]}'.includes(sign)
          ? 'close'
          : sign === ','
            ? 'comma'
            : sign === ':'
              ? 'colon'
              : null;
      if (kind) {
        yield { kind, ...at };
      }
    }
  }
}

function level(bracket: string, variant: string | null): Level {
  return { bracket, variant, key: null, index: 0, keys: [] };
}

/** Walks over the text; `seen` is told each token with the levels around it, before it counts. */
function walk(text: string, seen: (token: Token, levels: Level[]) => boolean | void): Level[] {
  const levels: Level[] = [];
  let last: Token | null = null;
  for (const token of tokens(text)) {
    if (seen(token, levels) === false) {
      return levels;
    }
    const inner = levels.at(-1);
    if (token.kind === 'open') {
      levels.push(level(token.text, last?.kind === 'word' && token.text === '(' ? last.text : null));
    } else if (token.kind === 'close') {
      levels.pop();
    } else if (token.kind === 'comma' && inner) {
      inner.index += 1;
      inner.key = null;
    } else if (token.kind === 'colon' && inner && last && (last.kind === 'word' || last.kind === 'text')) {
      inner.key = last.kind === 'text' ? unquoted(last.text) : last.text;
      inner.keys.push(inner.key);
    }
    last = token;
  }
  return levels;
}

function unquoted(text: string): string {
  return text.replace(/^"|"$/g, '');
}

/** Where an offset of the text stands. */
export function placeAt(text: string, offset: number): Place {
  let [from, word, quoted] = [offset, '', false];
  const levels = walk(text, (token) => {
    if (token.from >= offset) {
      return false;
    }
    const inside = token.to > offset || (token.to === offset && token.kind === 'word');
    const openText = token.kind === 'text' && token.to >= offset && !(token.to === offset && closed(token.text));
    if (openText || (inside && token.kind === 'word')) {
      quoted = openText;
      from = openText ? token.from + 1 : token.from;
      word = text.slice(from, offset);
      return false;
    }
    return undefined;
  });
  return { levels, from, word, quoted };
}

function closed(text: string): boolean {
  return text.length > 1 && text.endsWith('"');
}

/** The path of a place, as `vary` names it; kinds such as `Circle` are no part of it. */
export function pathOf(levels: readonly Level[]): string {
  return levels
    .filter((each) => each.key !== null || each.bracket === '[' || each.bracket === '(')
    .map((each) => each.key ?? String(each.index))
    .join('.');
}

/** All numbers of the text that have a path. Those of a batch have their whole path, from `jobs` on. */
export function numbers(text: string): Leaf[] {
  const found: Leaf[] = [];
  walk(text, (token, levels) => {
    if (token.kind === 'number' && levels.length > 0) {
      const value = Number(token.text.replaceAll('_', ''));
      if (Number.isFinite(value)) {
        found.push({ path: pathOf(levels), from: token.from, to: token.to, value });
      }
    }
  });
  return found;
}

/** Names that the file gives to things: keys right below `points`, `bodies`, … */
export function names(text: string): Map<string, string[]> {
  const found = new Map<string, string[]>();
  let before: Token | null = null;
  walk(text, (token, levels) => {
    const parent = levels.at(-2)?.key;
    if (token.kind === 'colon' && before && parent && levels.at(-1)?.bracket === '{') {
      const list = found.get(parent) ?? [];
      list.push(unquoted(before.text));
      found.set(parent, list);
    }
    before = token;
  });
  return found;
}
