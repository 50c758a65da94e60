//! Values of a file with the comments around them, as they stand in it.

use super::tokens::{Kind, Token};

/// A comment, and whether an empty line stands before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Comment<'a> {
    pub(super) text: &'a str,
    pub(super) blank: bool,
}

/// A value, with its name where it has one.
#[derive(Debug, Default)]
pub(super) struct Item<'a> {
    /// Comments above it, those inside of it too.
    pub(super) before: Vec<Comment<'a>>,
    /// Whether it begins a line.
    pub(super) line: bool,
    /// Whether an empty line stands before it and the comments above it.
    pub(super) blank: bool,
    /// Whether one stands between the comments above and itself.
    pub(super) apart: bool,
    /// What stands before the colon, if there is one.
    pub(super) key: Vec<&'a str>,
    /// Numbers, texts, words; the word before the brackets of a kind.
    pub(super) words: Vec<&'a str>,
    pub(super) group: Option<Group<'a>>,
    /// Comments behind it on its line.
    pub(super) behind: Vec<&'a str>,
}

/// Brackets and what stands in them.
#[derive(Debug, Default)]
pub(super) struct Group<'a> {
    pub(super) open: &'a str,
    pub(super) close: &'a str,
    /// Comments behind the opening bracket.
    pub(super) head: Vec<&'a str>,
    pub(super) items: Vec<Item<'a>>,
    /// Comments below the last item.
    pub(super) tail: Vec<Comment<'a>>,
}

impl Group<'_> {
    /// Whether no item has parts.
    pub(super) fn is_flat(&self) -> bool {
        self.items
            .iter()
            .all(|item| item.group.is_none() && item.key.is_empty())
    }

    /// Whether comments stand in it outside of its items' parts.
    pub(super) fn has_comments(&self) -> bool {
        let of_item = |item: &Item<'_>| !(item.before.is_empty() && item.behind.is_empty());
        !(self.head.is_empty() && self.tail.is_empty()) || self.items.iter().any(of_item)
    }
}

/// The tokens that are still to come.
pub(super) struct Reader<'a, 't> {
    tokens: &'t [Token<'a>],
}

impl<'a, 't> Reader<'a, 't> {
    pub(super) fn new(tokens: &'t [Token<'a>]) -> Self {
        Self { tokens }
    }

    fn peek(&self) -> Option<Token<'a>> {
        self.tokens.first().copied()
    }

    fn next(&mut self) -> Option<Token<'a>> {
        let (first, rest) = self.tokens.split_first()?;
        self.tokens = rest;
        Some(*first)
    }

    /// What stands in brackets that are open, up to the closing one or the end.
    pub(super) fn group(&mut self, open: &'a str) -> Group<'a> {
        let mut group = Group {
            open,
            ..Group::default()
        };
        if !open.is_empty() {
            group.head = self.behind();
        }
        let mut above = Vec::new();
        while let Some(token) = self.peek() {
            match token.kind {
                Kind::Close => {
                    self.next();
                    group.close = token.text;
                    break;
                }
                // A comma alone: its item is complete.
                Kind::Comma => {
                    self.next();
                }
                Kind::Line | Kind::Block => {
                    self.next();
                    above.push((comment(&token), token.breaks));
                }
                _ => {
                    let item = self.item(std::mem::take(&mut above), token.breaks);
                    group.items.push(item);
                }
            }
        }
        group.tail = above.into_iter().map(|(comment, _)| comment).collect();
        group
    }

    /// Comments behind what was read last, on its line.
    fn behind(&mut self) -> Vec<&'a str> {
        let mut behind = Vec::new();
        while let Some(token) = self
            .peek()
            .filter(|token| token.is_comment() && token.breaks == 0)
        {
            let next = self.tokens.get(1);
            let ends_line = next.is_none_or(|next| next.breaks > 0 || next.is_comment());
            if token.kind == Kind::Block && !ends_line {
                break;
            }
            self.next();
            behind.push(token.text);
        }
        behind
    }

    /// An item with the comments that stand `above` it; `breaks` line breaks stand before itself.
    fn item(&mut self, above: Vec<(Comment<'a>, usize)>, breaks: usize) -> Item<'a> {
        let first = above.first().map_or(breaks, |(_, breaks)| *breaks);
        let mut item = Item {
            line: first > 0,
            blank: first > 1,
            apart: breaks > 1 && !above.is_empty(),
            before: above.into_iter().map(|(comment, _)| comment).collect(),
            ..Item::default()
        };
        while let Some(token) = self.peek() {
            match token.kind {
                Kind::Close => break,
                Kind::Comma => {
                    self.next();
                    item.behind.extend(self.behind());
                    break;
                }
                Kind::Line | Kind::Block if self.is_complete() => {
                    if token.breaks > 0 {
                        break;
                    }
                    self.next();
                    item.behind.push(token.text);
                }
                Kind::Line | Kind::Block => {
                    self.next();
                    item.before.push(comment(&token));
                }
                Kind::Colon => {
                    self.next();
                    item.key = std::mem::take(&mut item.words);
                }
                Kind::Atom => {
                    self.next();
                    item.words.push(token.text);
                }
                Kind::Open => {
                    self.next();
                    item.group = Some(self.group(token.text));
                }
            }
        }
        item
    }

    /// Whether nothing of an item comes behind the comments that come next.
    fn is_complete(&self) -> bool {
        let next = self.tokens.iter().find(|token| !token.is_comment());
        next.is_none_or(|next| matches!(next.kind, Kind::Close | Kind::Comma))
    }
}

fn comment<'a>(token: &Token<'a>) -> Comment<'a> {
    Comment {
        text: token.text,
        blank: token.breaks > 1,
    }
}
