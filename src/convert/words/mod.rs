//! The words of the family: what belongs to each key, and what it means.
//!
//! The format does not mark where a field ends; only the count of its values tells. And a hundred programs spell the
//! same thing differently: `color`, `diffuseColor`, `albedo`. So every key has a *role*, and the reading functions ask
//! for roles. Keys that no table lists take the numbers and the value-like word that follow them, and get a role only
//! if a part of their name and the number of their values suggest one.

pub mod blocks;
mod camera;
mod light;
mod material;
mod setting;
mod shape;

pub use camera::CAMERA;
pub use light::{BACKGROUND, LIGHT, LIGHTS};
pub use material::{FRESNEL, MATERIAL, MATERIALS, SOLID};
pub use setting::{SETTINGS, TEXTURES};
pub use shape::{CURVE, GROUP, SHAPE, TRANSFORM};

use rustc_hash::FxHashMap;
use std::sync::OnceLock;

/// What follows a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Args {
    /// Nothing.
    Flag,
    /// So many numbers.
    Numbers(usize),
    /// Three numbers, or one for a grey.
    Color,
    /// A file name, or the number of a picture that is listed elsewhere; and numbers that some programs put after it.
    Path,
    /// Numbers, or a word and then numbers.
    Free,
    /// Nothing, a word for yes or no, or numbers.
    Maybe,
    /// Lists in brackets.
    Lists,
}

/// Keys of one role and one kind of values.
#[derive(Debug)]
pub struct Row {
    pub role: &'static str,
    pub args: Args,
    /// The keys, with spaces between them.
    keys: &'static str,
}

/// What an unlisted key with such values may mean.
#[derive(Debug)]
pub struct Stem {
    role: &'static str,
    values: Values,
    /// Parts of names, in lower case and without underscores, with spaces between them.
    parts: &'static str,
}

/// The values of an unlisted key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// No value at all: a flag.
    Nothing,
    Number,
    Vector,
    Word,
    Other,
}

/// The keys of one kind of block.
#[derive(Debug)]
pub struct Vocabulary {
    rows: &'static [Row],
    /// The first that fits counts.
    stems: &'static [Stem],
    index: Index,
}

/// The rows by their keys, as they are spelt and as they are in all other ways; made when it is first needed.
#[derive(Debug)]
struct Index {
    exact: OnceLock<FxHashMap<&'static str, &'static Row>>,
    loose: OnceLock<FxHashMap<String, (&'static Row, &'static str)>>,
}

impl Index {
    const fn new() -> Self {
        Self { exact: OnceLock::new(), loose: OnceLock::new() }
    }
}

const fn row(role: &'static str, args: Args, keys: &'static str) -> Row {
    Row { role, args, keys }
}

const fn stem(role: &'static str, values: Values, parts: &'static str) -> Stem {
    Stem { role, values, parts }
}

impl Vocabulary {
    /// The key's row, exactly as it is spelt.
    pub fn find(&self, key: &str) -> Option<&'static Row> {
        let index = self.index.exact.get_or_init(|| self.listed().map(|(row, key)| (key, row)).collect());
        index.get(key).copied()
    }

    /// The row of a key that differs from a listed one in capitals, underscores and hyphens only, and that key.
    pub fn find_loosely(&self, key: &str) -> Option<(&'static Row, &'static str)> {
        let index = self.index.loose.get_or_init(|| {
            let mut index = FxHashMap::default();
            for (row, key) in self.listed() {
                index.entry(normalised(key)).or_insert((row, key)); // the first of two counts
            }
            index
        });
        index.get(&normalised(key)).copied()
    }

    /// Whether a word is a key, however it is spelt.
    pub fn knows(&self, key: &str) -> bool {
        self.find(key).is_some() || self.find_loosely(key).is_some()
    }

    /// The role that the name and values of an unlisted key suggest.
    pub fn guess(&self, key: &str, values: Values) -> Option<&'static str> {
        let key = normalised(key);
        let fits =
            |stem: &&Stem| stem.values == values && stem.parts.split(' ').any(|part| key.contains(part));
        self.stems.iter().find(fits).map(|stem| stem.role)
    }

    /// All keys, for "did you mean".
    pub fn keys(&self) -> impl Iterator<Item = &'static str> {
        self.listed().map(|(_, key)| key)
    }

    fn listed(&self) -> impl Iterator<Item = (&'static Row, &'static str)> + use<> {
        self.rows.iter().flat_map(|row| row.keys.split_whitespace().map(move |key| (row, key)))
    }
}

/// Letters and digits in lower case: `refractive_index` and `RefractiveIndex` are one.
pub fn normalised(word: &str) -> String {
    word.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn no_key_is_listed_twice() {
        let all = [
            ("camera", &CAMERA),
            ("background", &BACKGROUND),
            ("lights", &LIGHTS),
            ("light", &LIGHT),
            ("materials", &MATERIALS),
            ("material", &MATERIAL),
            ("solid", &SOLID),
            ("group", &GROUP),
            ("shape", &SHAPE),
            ("transform", &TRANSFORM),
        ];
        for (name, vocabulary) in all {
            let mut seen = BTreeSet::new();
            for key in vocabulary.keys() {
                assert!(seen.insert(key), "{name}: {key}");
            }
        }
    }

    #[test]
    fn keys_are_found_as_they_are_spelt_and_otherwise() {
        assert_eq!(MATERIAL.find("refractiveIndex").map(|row| row.role), Some("index"));
        assert!(MATERIAL.find("RefractiveIndex").is_none());
        assert_eq!(MATERIAL.find_loosely("Refractive-Index").map(|(row, _)| row.role), Some("index"));
        assert_eq!(MATERIAL.guess("surface_albedo", Values::Vector), Some("color"));
        assert_eq!(MATERIAL.guess("sparkle", Values::Number), None);
    }
}
