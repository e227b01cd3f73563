//! Picture files, back: what any renderer wrote, as linear radiance.

use super::Format;
use crate::math::Rgb;
use exr::prelude::{self as openexr, ReadChannels, ReadLayers};
use image::{ImageReader, Limits};
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The largest width and height that is read.
const MAX_SIDE: u32 = 32_768;
/// The most memory that decoding may take, in bytes.
const MAX_BYTES: u64 = 2 << 30;

/// A picture as a file holds it, top row first.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear radiance, `width · height`.
    pub radiance: Vec<Rgb>,
    /// The standard error of each pixel's channels, where the file has one.
    pub standard_error: Option<Vec<Rgb>>,
    /// For each pixel, the standard error of the mean over its tile of 8 × 8 pixels, where the file has one.
    pub tile_error: Option<Vec<Rgb>>,
    /// Whether the file held display values in [0, 1], decoded as sRGB, and not radiance.
    pub is_display: bool,
    /// What the file says of itself in text: names and values.
    pub facts: Vec<(String, String)>,
}

impl Picture {
    /// Radiances alone, with nothing known of them.
    pub fn new(width: u32, height: u32, radiance: Vec<Rgb>) -> Self {
        let (standard_error, tile_error, facts) = (None, None, Vec::new());
        Self { width, height, radiance, standard_error, tile_error, is_display: false, facts }
    }
}

impl Picture {
    /// A fact by its name.
    pub fn fact(&self, name: &str) -> Option<&str> {
        self.facts.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    /// The mean CIE luminance of all pixels, in the unit of the radiance.
    pub fn mean_luminance(&self) -> f64 {
        let sum: f64 = self.radiance.iter().map(|&pixel| luminance(pixel)).sum();
        sum / self.radiance.len().max(1) as f64
    }
}

/// The luminance of a linear colour in double precision (ITU-R BT.709, table 3).
fn luminance(color: Rgb) -> f64 {
    0.2126 * f64::from(color.r) + 0.7152 * f64::from(color.g) + 0.0722 * f64::from(color.b)
}

/// Why a picture cannot be read, with what to do about it.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The system refuses.
    #[error("`{}` cannot be read: {reason}", path.display())]
    Unreadable {
        /// Which file.
        path: PathBuf,
        /// In the system's words.
        reason: String,
    },
    /// No format that is known.
    #[error("`{}` is no picture that is read: use .exr, .hdr, .png or .ppm", .0.display())]
    UnknownFormat(PathBuf),
    /// The file is damaged or of a kind that the decoder does not know.
    #[error("`{}` cannot be decoded: {reason}; write the picture again", path.display())]
    Broken {
        /// Which file.
        path: PathBuf,
        /// In the decoder's words.
        reason: String,
    },
    /// An EXR without colour.
    #[error("`{}` has no channels R, G and B; it has {found}", path.display())]
    NoColor {
        /// Which file.
        path: PathBuf,
        /// The channels there are.
        found: String,
    },
    /// Infinite or undefined values.
    #[error(
        "`{}` holds {count} pixels that are not finite numbers, the first at column {}, row {}: \
         no error can be measured there; mend the picture, or render it again",
        path.display(), place[0], place[1]
    )]
    NotFinite {
        /// Which file.
        path: PathBuf,
        /// How many pixels.
        count: usize,
        /// Column and row of the first.
        place: [usize; 2],
    },
}

/// Reads a picture: its kind by what it holds, not by its name.
///
/// # Errors
/// [`ReadError`] when it cannot be read, is damaged or larger than 32,768 pixels a side, or holds what is no number.
pub fn read(path: &Path) -> Result<Picture, ReadError> {
    let unreadable = |reason: String| ReadError::Unreadable { path: path.to_owned(), reason };
    if path.is_dir() {
        return Err(unreadable("it is a folder".to_owned()));
    }
    decode(path, &std::fs::read(path).map_err(|error| unreadable(error.to_string()))?)
}

/// The picture that `bytes` are; `path` is named in errors.
///
/// # Errors
/// Those of [`read`], but for what the system says.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Picture, ReadError> {
    let picture = match image::guess_format(bytes) {
        Ok(image::ImageFormat::OpenExr) => read_exr(path, bytes)?,
        Ok(_) => read_other(path, bytes)?,
        Err(_) => return Err(ReadError::UnknownFormat(path.to_owned())),
    };
    match picture.radiance.iter().position(|pixel| !is_finite(pixel)) {
        None => Ok(picture),
        Some(first) => Err(ReadError::NotFinite {
            path: path.to_owned(),
            count: picture.radiance.iter().filter(|pixel| !is_finite(pixel)).count(),
            place: [first % picture.width as usize, first / picture.width as usize],
        }),
    }
}

/// Whether a file name asks for a format that holds radiance, not display values.
pub fn is_linear(path: &Path) -> bool {
    matches!(Format::of(path), Some(Format::Exr | Format::Hdr))
}

fn is_finite(pixel: &Rgb) -> bool {
    pixel.to_array().iter().all(|x| x.is_finite())
}

/// PNG, PPM, JPEG and HDR.
fn read_other(path: &Path, bytes: &[u8]) -> Result<Picture, ReadError> {
    let broken = |error: &dyn ToString| broken(path, error);
    let mut reader =
        ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| broken(&error))?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let is_display = reader.format() != Some(image::ImageFormat::Hdr);
    let image = reader.decode().map_err(|error| broken(&error))?.into_rgb32f();
    let (width, height) = image.dimensions();
    let linear = |p: &image::Rgb<f32>| match is_display {
        true => Rgb::from_srgb(p.0[0], p.0[1], p.0[2]),
        false => Rgb::from(p.0),
    };
    let radiance = image.pixels().map(linear).collect();
    Ok(Picture {
        width,
        height,
        radiance,
        standard_error: None,
        tile_error: None,
        is_display,
        facts: Vec::new(),
    })
}

/// The first layer with a colour, and its standard error where there is one.
fn read_exr(path: &Path, bytes: &[u8]) -> Result<Picture, ReadError> {
    let image = openexr::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| broken(path, &error))?;
    let names = |layer: &openexr::Layer<openexr::AnyChannels<openexr::FlatSamples>>| {
        layer.channel_data.list.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>()
    };
    let layer = image.layer_data.iter().find(|layer| channels(layer, "").is_some());
    let Some((layer, radiance)) = layer.and_then(|layer| Some((layer, channels(layer, "")?))) else {
        let found = image.layer_data.iter().flat_map(names).collect::<Vec<_>>().join(", ");
        return Err(ReadError::NoColor { path: path.to_owned(), found });
    };
    let facts = layer.attributes.other.iter().filter_map(|(name, value)| match value {
        openexr::AttributeValue::Text(text) => Some((name.to_string(), text.to_string())),
        _ => None,
    });
    Ok(Picture {
        width: layer.size.0 as u32,
        height: layer.size.1 as u32,
        radiance,
        standard_error: channels(layer, "error."),
        tile_error: channels(layer, "tile_error."),
        is_display: false,
        facts: facts.collect(),
    })
}

/// Three channels whose names begin with `prefix`, as colours.
fn channels(
    layer: &openexr::Layer<openexr::AnyChannels<openexr::FlatSamples>>,
    prefix: &str,
) -> Option<Vec<Rgb>> {
    let plane = |name: &str| {
        let name = format!("{prefix}{name}");
        let channel = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == name)?;
        Some(channel.sample_data.values_as_f32().collect::<Vec<f32>>())
    };
    let (r, g, b) = (plane("R")?, plane("G")?, plane("B")?);
    Some(r.into_iter().zip(g).zip(b).map(|((r, g), b)| Rgb::new(r, g, b)).collect())
}

fn broken(path: &Path, error: &dyn ToString) -> ReadError {
    ReadError::Broken { path: path.to_owned(), reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{Display, Exposure, Frame, Target, Tone};

    const DISPLAY: Display = Display { exposure: Exposure::Ev(0.0), tone: Tone::Srgb, floor: false };

    fn frame(radiance: Vec<Rgb>) -> Frame {
        let standard_error = vec![Rgb::gray(0.125); radiance.len()];
        let facts = vec![("passes".to_owned(), "7".to_owned())];
        let (height, sample_counts) = ((radiance.len() / 2) as u32, vec![7; radiance.len()]);
        Frame { width: 2, height, radiance, standard_error, sample_counts, facts, planes: Vec::new() }
    }

    fn written(name: &str, frame: &Frame) -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        let mut target = Target::open(&path).unwrap();
        target.write(frame, &DISPLAY).unwrap();
        target.finish().unwrap();
        (folder, path)
    }

    #[test]
    fn what_was_written_is_read() {
        let frame = frame(vec![Rgb::new(1.0, 0.5, 0.0), Rgb::gray(0.25), Rgb::BLACK, Rgb::gray(0.75)]);
        for (name, tolerance) in [("a.exr", 0.0), ("a.hdr", 4e-3), ("a.png", 5e-3), ("a.ppm", 5e-3)] {
            let (_folder, path) = written(name, &frame);
            let picture = read(&path).unwrap();
            assert_eq!((picture.width, picture.height), (2, 2), "{name}");
            assert_eq!(picture.is_display, !is_linear(&path), "{name}");
            for (read, wrote) in picture.radiance.iter().zip(&frame.radiance) {
                let apart = (*read - *wrote).map(f32::abs).max_component();
                assert!(apart <= tolerance, "{name}: {read:?} for {wrote:?}");
            }
            if name == "a.exr" {
                assert_eq!(picture.standard_error.as_deref(), Some(&frame.standard_error[..]));
                assert_eq!(picture.fact("passes"), Some("7"));
            }
        }
    }

    #[test]
    fn what_is_no_number_is_told_with_its_place() {
        let mut pixels = vec![Rgb::WHITE; 6];
        pixels[3] = Rgb::new(1.0, f32::NAN, 0.0);
        pixels[5] = Rgb::gray(f32::INFINITY);
        let (_folder, path) = written("a.exr", &frame(pixels));
        let error = read(&path).unwrap_err();
        assert!(matches!(error, ReadError::NotFinite { count: 2, place: [1, 1], .. }), "{error}");
    }

    #[test]
    fn what_is_no_picture_says_so() {
        let folder = tempfile::tempdir().unwrap();
        let put = |bytes: &[u8]| {
            let path = folder.path().join("x");
            std::fs::write(&path, bytes).unwrap();
            read(&path).unwrap_err()
        };
        assert!(matches!(put(b"snell 1\n"), ReadError::UnknownFormat(_)));
        assert!(matches!(put(b"P6\n2 2\n255\n\x00"), ReadError::Broken { .. }));
        assert!(matches!(put(b"\x76\x2f\x31\x01\x02\x00"), ReadError::Broken { .. }));
        assert!(matches!(put(b""), ReadError::UnknownFormat(_)));
        assert!(matches!(read(folder.path()).unwrap_err(), ReadError::Unreadable { .. }));
        assert!(matches!(read(&folder.path().join("no")).unwrap_err(), ReadError::Unreadable { .. }));
    }
}
