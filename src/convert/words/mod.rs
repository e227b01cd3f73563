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
pub use material::{MATERIAL, MATERIALS, SOLID};
pub use setting::{SETTINGS, TEXTURES};
pub use shape::{CURVE, GROUP, SHAPE, TRANSFORM};

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
        self.rows.iter().find(|row| row.keys.split(' ').any(|known| known == key))
    }

    /// The row of a key that differs from a listed one in capitals, underscores and hyphens only, and that key.
    pub fn find_loosely(&self, key: &str) -> Option<(&'static Row, &'static str)> {
        let wanted = normalised(key);
        let listed = |row: &'static Row| row.keys.split(' ').map(move |known| (row, known));
        self.rows.iter().flat_map(listed).find(|(_, known)| normalised(known) == wanted)
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
        self.rows.iter().flat_map(|row| row.keys.split(' '))
    }
}

/// Letters and digits in lower case: `refractive_index` and `RefractiveIndex` are one.
pub fn normalised(word: &str) -> String {
    word.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
