//! What a scene with mistakes was to be: what its text shows although no value could be made of it.

use super::Resolver;
use super::scope::State;
use super::value::Value;
use crate::diag::{is_slip_of, nearest};
use crate::syntax::ast::FileIndex;

/// The words without which no scene has light of its own; a mesh may bring some.
const LIGHT: [&str; 4] = ["light", "environment", "emissive", "ambient"];

impl<'a> Resolver<'a> {
    /// Notes it, once everything has been evaluated.
    pub(super) fn note_intent(&mut self) {
        if !self.problems.has_errors() {
            return;
        }
        self.scene.intent.light = self.program.lacks_files || self.words().any(is_of_light);
        let root = self.root(FileIndex(0));
        for name in &self.proposed {
            if let Some(definition) = root.own(name)
                && let State::Done(Value::Material(material)) = &*definition.state.borrow()
            {
                self.scene.intent.materials.push(*material);
            }
        }
        self.scene.intent.materials.sort_by_key(|material| material.index());
    }

    /// How often a word stands in the texts.
    pub(super) fn count_of(&self, wanted: &str) -> usize {
        self.words().filter(|word| *word == wanted).count()
    }

    /// Whether a line with a mistake of syntax may name this.
    pub(super) fn may_be_in_doubtful_line(&self, name: &str) -> bool {
        self.doubtful.keys().any(|word| is_slip_of(name, word) || !nearest(word, [name]).is_empty())
    }

    /// The words of all texts, without what follows `//` on a line.
    fn words(&self) -> impl Iterator<Item = &'a str> {
        let sources = self.sources;
        let texts = self.program.files.iter().map(|file| &*sources.file(file.source).text);
        let lines = texts.flat_map(|text| text.lines()).filter_map(|line| line.split("//").next());
        lines.flat_map(|line| line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')))
    }
}

fn is_of_light(word: &str) -> bool {
    !word.is_empty() && !nearest(word, LIGHT).is_empty()
}
