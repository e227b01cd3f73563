//! What a word may mean: it may be a block, a field, a function and a unit at once.

use crate::schema::{self, Block, Field, Form, Function, NamedType, Unit};

/// Something of the language that has a name.
#[derive(Clone, Debug)]
pub enum Entry {
    /// A kind of block.
    Block(&'static Block),
    /// A function.
    Function(&'static Function),
    /// A unit.
    Unit(&'static Unit),
    /// A type.
    Type(&'static NamedType),
    /// A word or sign.
    Form(&'static Form),
    /// A colour by its display value.
    Color(&'static str, u32),
    /// A field, with the blocks that have it.
    Field(Vec<(&'static Block, &'static Field)>),
}

/// All that a word means; nothing for an unknown one.
pub fn lookup(word: &str) -> Vec<Entry> {
    let mut found = Vec::new();
    // `sphere` is an object and the second word of a light.
    let is_second = |block: &&Block| block.kind != word && block.kind.split(' ').next_back() == Some(word);
    found.extend(schema::block(word).into_iter().chain(schema::blocks().filter(is_second)).map(Entry::Block));
    found.extend(schema::functions().filter(|function| function.name == word).map(Entry::Function));
    found.extend(schema::FORMS.iter().filter(|form| form.words.contains(&word)).map(Entry::Form));
    found.extend(schema::Type::NAMED.iter().filter(|ty| ty.name == word).map(Entry::Type));
    found.extend(schema::unit(word).map(Entry::Unit));
    let color = schema::COLORS.iter().find(|(name, _)| *name == word);
    found.extend(color.map(|&(name, code)| Entry::Color(name, code)));
    let fields: Vec<_> = schema::blocks().filter_map(|block| Some((block, block.field(word)?))).collect();
    if !fields.is_empty() {
        found.push(Entry::Field(fields));
    }
    found
}

/// Every word that [`lookup`] knows.
pub fn names() -> Vec<&'static str> {
    let fields = schema::blocks().flat_map(|block| block.fields().map(|field| field.name));
    let mut all: Vec<&str> = schema::blocks()
        .map(|block| block.kind)
        .chain(schema::functions().map(|function| function.name))
        .chain(schema::FORMS.iter().flat_map(|form| form.words.iter().copied()))
        .chain(schema::Type::NAMED.iter().map(|ty| ty.name))
        .chain(schema::UNITS.iter().map(|unit| unit.name))
        .chain(fields)
        .chain(schema::COLORS.iter().map(|(name, _)| *name))
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_means_something() {
        for name in names() {
            assert!(!lookup(name).is_empty(), "`{name}`");
        }
        assert!(lookup("spheer").is_empty());
    }

    #[test]
    fn a_word_may_mean_several_things() {
        let kinds: Vec<bool> = lookup("box").iter().map(|entry| matches!(entry, Entry::Block(_))).collect();
        assert_eq!(kinds, [true, false]);
        assert!(matches!(lookup("sphere")[..], [Entry::Block(_), Entry::Block(_)]));
    }
}
