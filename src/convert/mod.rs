//! Scenes of the `arsenal.txt` family (Tsinghua PA1, MIT 6.837) → Snell text, with a report of what became of each word.
//!
//! The family shares one syntax and has a dozen dialects, in which the same field means different things. A file goes
//! through four steps: `parse` knows words and braces only, `dialect` tells which dialect it is, `read` gives the
//! blocks their meaning, and `write` says that in Snell. What cannot be said exactly is said in a comment where it
//! stands, and in the report.

mod asset;
mod dialect;
mod error;
mod fields;
mod model;
mod parse;
mod read;
pub mod report;
mod vocabulary;
mod write;

#[cfg(test)]
mod tests;

pub use asset::{AssetFinder, DiskFinder, Search};
pub use dialect::{Detection, Dialect};
pub use error::{ConvertError, Mistake};
pub use report::{Fate, Outcome};

use error::Notebook;

/// How to convert.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The dialect, instead of the one that the file seems to be in.
    pub dialect: Option<Dialect>,
    /// Whether everything the converter does not understand is an error, rather than left out with a warning.
    pub strict: bool,
    /// How the camera's basis is made where `up` leans, instead of what is usual in the dialect.
    pub basis: Option<Basis>,
    /// Whether point and directional lights are kept.
    pub lights: Lights,
}

/// How a camera's right vector is made from `direction` and `up`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// As it comes out of the cross product, so that a leaning `up` magnifies the picture (the framework of 2020).
    Raw,
    /// Normalised (the framework from 2021 on).
    Orthonormal,
}

/// What to do with a `Lights` block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Lights {
    /// Keep it where programs of the dialect use it.
    #[default]
    Auto,
    /// Keep it in any case.
    Keep,
    /// Leave it out in any case.
    Drop,
}

/// What a conversion yields.
#[derive(Clone, Debug)]
pub struct Conversion {
    /// The scene in Snell; missing if there are errors.
    pub snell: Option<String>,
    /// The dialect it was read as.
    pub detection: Detection,
    /// What became of each word and number, in the order of the file.
    pub report: Vec<Fate>,
    /// Errors and warnings, in the order of the file. Places are byte offsets into the text.
    pub problems: Vec<ConvertError>,
}

impl Conversion {
    /// Whether anything kept the scene from being written.
    pub fn has_errors(&self) -> bool {
        self.problems.iter().any(ConvertError::is_error)
    }
}

/// Converts the text of a scene that is called `name`.
///
/// `files` tells which of the files it names are there and how large pictures are; without it nothing is known of
/// them, and nothing is said to be missing.
pub fn convert(text: &str, name: &str, options: &Options, files: Option<&dyn AssetFinder>) -> Conversion {
    let mut notes = Notebook::new(options.strict);
    let tree = parse::parse(text, &mut notes);
    if tree.body.is_empty() && !notes.has_errors() {
        notes.note(Mistake::Empty);
    }
    let detection = match options.dialect {
        Some(dialect) => Detection { dialect, reason: "the options say so".into() },
        None => dialect::of_file(&tree),
    };
    let reading = read::read(tree, &detection, options, files, notes);
    let snell = (!reading.notes.has_errors())
        .then(|| write::write(&reading.scene, name, &detection, &reading.asset_roots));
    Conversion { snell, detection, report: reading.fates, problems: reading.notes.into_sorted() }
}
