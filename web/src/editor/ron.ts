// Colours of RON and JSON in the editor.

import { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { tags } from '@lezer/highlight';

/** RON, and JSON with it. */
export const ron = StreamLanguage.define<{ comment: boolean }>({
  name: 'ron',
  startState: () => ({ comment: false }),
  token(stream, state) {
    if (state.comment) {
      state.comment = !stream.match(/^.*?\*\//);
      if (state.comment) {
        stream.skipToEnd();
      }
      return 'comment';
    }
    if (stream.eatSpace()) {
      return null;
    }
    if (stream.match('//')) {
      stream.skipToEnd();
      return 'comment';
    }
    if (stream.match('/*')) {
      state.comment = true;
      return 'comment';
    }
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) {
      const text = stream.current();
      if (/^"\s*=/.test(text)) {
        return 'string.special';
      }
      return stream.match(/^\s*:/, false) ? 'propertyName' : 'string';
    }
    if (stream.match(/^[-+]?(?:\d[\d_]*\.?[\d_]*|\.\d+)(?:[eE][-+]?\d+)?/)) {
      return 'number';
    }
    if (stream.match(/^[A-Za-z_]\w*/)) {
      const word = stream.current();
      if (word === 'true' || word === 'false' || word === 'null') {
        return 'bool';
      }
      return stream.match(/^\s*:/, false) ? 'propertyName' : 'typeName';
    }
    stream.next();
    return 'punctuation';
  },
  languageData: {
    commentTokens: { line: '//', block: { open: '/*', close: '*/' } },
    closeBrackets: { brackets: ['(', '[', '{', '"'] },
    indentOnInput: /^\s*[\])}]$/,
  },
});

const style = HighlightStyle.define([
  { tag: tags.comment, color: 'var(--code-comment)', fontStyle: 'italic' },
  { tag: tags.propertyName, color: 'var(--code-key)' },
  { tag: tags.typeName, color: 'var(--code-kind)' },
  { tag: tags.string, color: 'var(--code-text)' },
  { tag: tags.special(tags.string), color: 'var(--code-expression)' },
  { tag: tags.number, color: 'var(--code-number)' },
  { tag: tags.bool, color: 'var(--code-number)' },
  { tag: tags.punctuation, color: 'var(--code-sign)' },
]);

export const ronColours = syntaxHighlighting(style);
