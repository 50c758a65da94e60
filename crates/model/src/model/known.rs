//! Bodies that a file knows as one.

use super::Model;
use crate::BodyId;

impl Model {
    /// Makes bodies known as parts of another one, whose points theirs then are, too: [`Model::node_of`] finds them.
    pub fn know_as(&mut self, body: BodyId, parts: Vec<BodyId>) {
        self.known_as.insert(body, parts);
    }

    /// The bodies that are known as parts of a body.
    pub fn parts_of(&self, body: BodyId) -> &[BodyId] {
        self.known_as.get(&body).map_or(&[], Vec::as_slice)
    }
}
