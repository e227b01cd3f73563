//! Scenes of the `arsenal.txt` family (Tsinghua PA1, MIT 6.837) → Snell text, with a report of what became of each word.
//!
//! The family shares one syntax and has a dozen dialects, in which the same field means different things. A file goes
//! through four steps: `parse` knows words and braces only, `dialect` tells which dialect it is, `read` gives the
//! blocks their meaning, and `write` says that in Snell. What cannot be said exactly is said in a comment where it
//! stands, and in the report.

mod asset;
mod dialect;
mod fields;
mod gravity;
mod log;
mod mesh;
mod mistake;
mod model;
mod notebook;
mod parse;
mod read;
pub mod report;
mod step;
mod values;
mod words;
mod write;

#[cfg(test)]
mod tests;

pub use asset::{AssetFinder, DiskFinder, Search};
pub use dialect::{Detection, Dialect};
pub use mesh::{MeshConversion, Places, convert_mesh, is_mesh};
pub use mistake::Mistake;
pub use notebook::ConvertError;
pub use report::{Fate, Outcome};

use notebook::Notebook;

/// How to convert.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The dialect, instead of the one that the file seems to be in.
    pub dialect: Option<Dialect>,
    /// Whether everything that is wrong or not understood is an error, rather than left out with a warning.
    pub strict: bool,
    /// How the camera's basis is made where `up` leans, instead of what is usual in the dialect.
    pub basis: Option<Basis>,
    /// What `angle` means in a picture that is not square, instead of what is usual in the dialect.
    pub angle: Option<Angle>,
    /// Whether point and directional lights are kept.
    pub lights: Lights,
    /// How point lights fall off with distance.
    pub falloff: Falloff,
    /// Whether planes are seen from behind.
    pub planes: Planes,
    /// On which side of the origin the `offset` of a plane is.
    pub plane_sign: PlaneSign,
    /// Whether light is to behave as it does, or as in the original program.
    pub rendition: Rendition,
}

/// What a converted scene is to look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Rendition {
    /// Like the things it shows: light is simulated.
    #[default]
    Physical,
    /// Like the pictures of the original program, where that adds up Phong's terms instead of simulating light.
    Original,
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

/// What the angle of a camera spans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angle {
    /// The height of the picture.
    Vertical,
    /// Its width.
    Horizontal,
    /// Both, with pixels that are not square.
    Both,
}

/// The law by which a point light of colour c lights at distance d.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Falloff {
    /// As is usual in the dialect.
    #[default]
    Auto,
    /// `c` (the course).
    Constant,
    /// `c / (1 + k d^2)` with `falloff k` (MIT, 2010 to 2015).
    OnePlus,
    /// `c / (k d^2)` with `falloff k` (MIT, 2016 and later).
    InverseSquare,
    /// `c / (a + b d + e d^2)` with `attenuation a b e` (MIT, 2004).
    Polynomial,
}

/// Whether planes are seen from behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Planes {
    /// As is usual in the dialect.
    #[default]
    Auto,
    /// Only from the side of their normal: those that a camera is behind are left out.
    OneSided,
    /// From both sides.
    TwoSided,
}

/// The sign of a plane's `offset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum PlaneSign {
    /// `normal . p = offset`, with a word of doubt where a program of the dialect has the other sign.
    #[default]
    Auto,
    /// `normal . p = offset`.
    Same,
    /// `normal . p + offset = 0`.
    Opposite,
}

/// What a conversion yields.
#[derive(Clone, Debug)]
pub struct Conversion {
    /// The scenes of the file, nearly always one; none if there are errors.
    pub scenes: Vec<Converted>,
    /// What became of each word and number, in the order of the file.
    pub report: Vec<Fate>,
    /// Errors and warnings, in the order of the file. Places are byte offsets into the text.
    pub problems: Vec<ConvertError>,
}

/// A converted scene.
#[derive(Clone, Debug)]
pub struct Converted {
    /// The scene in Snell.
    pub snell: String,
    /// The dialect it was read as.
    pub detection: Detection,
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
    let (tree, comments) = parse::parse(text, &mut notes);
    if tree.body.is_empty() && !notes.has_errors() {
        notes.note(Mistake::Empty);
    }
    let reading = read::read(tree, &comments, options, files, notes);
    let mut scenes = Vec::new();
    if !reading.notes.has_errors() {
        let written = |scene: &model::Scene| Converted {
            snell: write::write(scene, name),
            detection: scene.detection.clone(),
        };
        scenes.extend(reading.scenes.iter().map(written));
    }
    Conversion { scenes, report: reading.fates, problems: reading.notes.into_sorted() }
}
