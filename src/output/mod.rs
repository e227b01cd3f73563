//! Film → files, and files back: tone, formats, and files that are whole or not there.

mod exr;
mod file;
mod read;
pub mod tone;

pub use file::{Format, OutputError, Target, encode, encode_display, replace};
pub use read::{Picture, ReadError, decode, is_linear, read};
pub use tone::{Display, Exposure, Tone};

use crate::math::Rgb;

/// A finished picture with what is known about it, top row first.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Frame {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear radiance, `width · height`.
    pub radiance: Vec<Rgb>,
    /// The standard error of each pixel's channels; empty when it is not known.
    pub standard_error: Vec<Rgb>,
    /// How many samples each pixel has; empty when it is not known.
    pub sample_counts: Vec<u32>,
    /// What else is known of each pixel, for formats that can hold it.
    pub planes: Vec<Plane>,
    /// Facts about the render for formats that can hold them: names and values.
    pub facts: Vec<(String, String)>,
}

/// A number for each pixel, with a name such as `depth.Z`: the layer, then the channel.
#[derive(Clone, PartialEq, Debug)]
pub struct Plane {
    /// Letters and digits; no two planes of a picture share it.
    pub name: String,
    /// `width · height` of them.
    pub samples: Vec<f32>,
}
