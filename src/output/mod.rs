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
#[derive(Clone, PartialEq, Debug)]
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
    /// Facts about the render for formats that can hold them: names and values.
    pub facts: Vec<(String, String)>,
}
