//! Values of a file, written in lines.

use super::parts::{Comment, Group, Item};
use crate::text::json;

/// Characters of a line at the most, as far as it can be broken.
const WIDTH: usize = 100;

/// Blanks that what stands in brackets is moved in by.
const INDENT: usize = 4;

/// Writes lines.
pub(super) struct Printer {
    pub(super) json: bool,
    pub(super) text: String,
}

impl Printer {
    /// A whole file: its value with the comments around it.
    pub(super) fn file(&mut self, file: &Group<'_>) {
        for item in &file.items {
            self.above(item, 0, false);
            self.item(item, 0, 0, true);
            self.behind(&item.behind);
            self.text += "\n";
        }
        self.comments(&file.tail, 0, true);
    }

    /// Comments, each in lines of its own; an empty line may stand before the first one where it is
    /// `below` something.
    fn comments(&mut self, comments: &[Comment<'_>], indent: usize, below: bool) {
        for (k, comment) in comments.iter().enumerate() {
            if comment.blank && (below || k > 0) {
                self.text += "\n";
            }
            self.text += &format!("{:indent$}{}\n", "", comment.text);
        }
    }

    /// The comments above an item.
    fn above(&mut self, item: &Item<'_>, indent: usize, below: bool) {
        if item.before.is_empty() && item.blank && below {
            self.text += "\n";
        }
        self.comments(&item.before, indent, below);
        if item.apart {
            self.text += "\n";
        }
    }

    fn behind(&mut self, comments: &[&str]) {
        for comment in comments {
            self.text += " ";
            self.text += comment;
        }
    }

    fn column(&self) -> usize {
        let start = self.text.rfind('\n').map_or(0, |k| k + 1);
        self.text[start..].chars().count()
    }

    /// Name and value; `room` is what follows it on its line. The outermost brackets of a file are
    /// `open`ed over lines.
    fn item(&mut self, item: &Item<'_>, indent: usize, room: usize, open: bool) {
        let inline = self.inline(item).filter(|_| !open);
        let fits = |text: &String| self.column() + text.chars().count() + room <= WIDTH;
        if let Some(text) = inline.filter(fits) {
            self.text += &text;
            return;
        }
        self.text += &start(item);
        let Some(group) = &item.group else {
            return;
        };
        self.text += group.open;
        let hugged = match &group.items[..] {
            [one] if !group.has_comments() && !one.line && !open => Some(one),
            _ => None,
        };
        let hugs = |one: &&Item<'_>| {
            let mut kinds = one.key.iter().filter_map(|key| json::inner(key));
            let kind = self.json && json::is_kind(&mut kinds);
            one.group.is_some() && (kind || one.key.is_empty())
        };
        if let Some(one) = hugged.filter(hugs) {
            let blank = if group.open == "{" { " " } else { "" };
            self.text += blank;
            self.item(one, indent, room + blank.len() + group.close.len(), false);
            self.text += blank;
        } else {
            self.behind(&group.head);
            self.text += "\n";
            self.items(group, indent + INDENT, open);
            self.comments(&group.tail, indent + INDENT, !group.items.is_empty());
            self.text += &format!("{:indent$}", "");
        }
        self.text += group.close;
    }

    /// The items of brackets that are open over lines, those of one line again on one where they fit;
    /// ends the last line.
    fn items(&mut self, group: &Group<'_>, indent: usize, outermost: bool) {
        // What stood on one line is laid out anew.
        let anew = group.items.iter().all(|item| !item.line);
        let each = outermost || anew && group.open != "(" && !group.is_flat();
        let mut ended = true;
        for (k, item) in group.items.iter().enumerate() {
            let comma = !self.json || k + 1 < group.items.len();
            let inline = self.inline(item);
            let wanted = inline
                .as_ref()
                .map(|text| text.chars().count() + usize::from(comma));
            let stays = !(ended || each || item.line) && item.before.is_empty();
            let column = self.column();
            if wanted.is_some_and(|wanted| stays && column + 1 + wanted <= WIDTH) {
                self.text += " ";
            } else {
                if k > 0 && !self.text.ends_with('\n') {
                    self.text += "\n";
                }
                self.above(item, indent, k > 0);
                self.text += &format!("{:indent$}", "");
            }
            let line = self.text.len();
            self.item(item, indent, usize::from(comma), false);
            if comma {
                self.text += ",";
            }
            ended = self.text[line..].contains('\n') || !item.behind.is_empty();
            self.behind(&item.behind);
        }
        if !group.items.is_empty() {
            self.text += "\n";
        }
    }

    /// Name and value on one line; `None` where it takes several.
    fn inline(&self, item: &Item<'_>) -> Option<String> {
        let mut text = start(item);
        let Some(group) = &item.group else {
            return (!text.contains('\n')).then_some(text);
        };
        let opened = group.items.first().is_some_and(|first| first.line) && !group.is_flat();
        if opened || group.has_comments() {
            return None;
        }
        let items: Option<Vec<String>> = group.items.iter().map(|item| self.inline(item)).collect();
        let items = items?.join(", ");
        let blank = if group.open == "{" && !items.is_empty() {
            " "
        } else {
            ""
        };
        text += &format!("{}{blank}{items}{blank}{}", group.open, group.close);
        Some(text)
    }
}

/// The name, and the words of a value.
fn start(item: &Item<'_>) -> String {
    let words = item.words.join(" ");
    match &item.key[..] {
        [] => words,
        key => format!("{}: {words}", key.join(" ")),
    }
}
