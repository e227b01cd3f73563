//! Picture files: the format by the extension, and a file that is whole or not there.

use super::{Display, Frame, exr};
use crate::math::Rgb;
use image::codecs::hdr::HdrEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, Rgb as ImageRgb};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The formats that are written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// 8 bits, developed.
    Png,
    /// 8 bits, developed, without compression.
    Ppm,
    /// Linear, 32 bits, with layers.
    Exr,
    /// Linear, with a shared exponent.
    Hdr,
}

impl Format {
    /// Each format with its extension.
    pub const ALL: [(&'static str, Self); 4] =
        [("png", Self::Png), ("exr", Self::Exr), ("hdr", Self::Hdr), ("ppm", Self::Ppm)];

    /// The format that a file name asks for.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        Self::ALL.iter().find(|(name, _)| *name == extension).map(|(_, format)| *format)
    }
}

/// Why a picture cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The extension says nothing.
    #[error("`{}` has no extension that is known: use .png, .exr, .hdr or .ppm", .0.display())]
    UnknownFormat(PathBuf),
    /// The system refuses.
    #[error("`{}` cannot be written: {reason}", path.display())]
    Unwritable {
        /// Which file.
        path: PathBuf,
        /// In the system's words.
        reason: String,
    },
}

/// A picture file that is being made. Until it is finished it has another name, and the file under its own name, if
/// there is one, stays as it is.
pub struct Target {
    path: PathBuf,
    /// Where it really lies: a link keeps pointing there.
    place: PathBuf,
    format: Format,
    file: NamedTempFile,
}

impl Target {
    /// Makes sure that the file can be written, before any work is done for it.
    ///
    /// # Errors
    /// [`OutputError`] when the extension is unknown or the folder cannot be written to.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let format = Format::of(path).ok_or_else(|| OutputError::UnknownFormat(path.to_owned()))?;
        if path.is_dir() {
            return Err(unwritable(path, "it is a folder"));
        }
        let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let file = temporary_beside(&place)?;
        Ok(Self { path: path.to_owned(), place, format, file })
    }

    /// The file's name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What it is written as.
    pub fn format(&self) -> Format {
        self.format
    }

    /// Writes the picture as it is so far, under the temporary name.
    ///
    /// # Errors
    /// [`OutputError::Unwritable`], for instance when the disk is full.
    pub fn write(&mut self, frame: &Frame, display: &Display) -> Result<(), OutputError> {
        let path = self.path.clone();
        self.try_write(frame, display).map_err(|error| unwritable(&path, error))
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// [`OutputError::Unwritable`]; a file that was there before is still whole then.
    pub fn finish(self) -> Result<PathBuf, OutputError> {
        keep(self.file, &self.place)?;
        Ok(self.path)
    }

    fn try_write(&mut self, frame: &Frame, display: &Display) -> io::Result<()> {
        let file = self.file.as_file_mut();
        file.rewind()?;
        file.set_len(0)?;
        let mut out = BufWriter::new(file);
        encode(&mut out, self.format, frame, display)?;
        out.flush()
    }
}

/// Writes a file of any kind whole: under another name first, so that an old one stays if this fails.
///
/// # Errors
/// [`OutputError::Unwritable`].
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let mut file = temporary_beside(path)?;
    file.write_all(bytes).map_err(|error| unwritable(path, error))?;
    keep(file, path)
}

/// A file that vanishes unless it is kept, in the folder of `path`.
fn temporary_beside(path: &Path) -> Result<NamedTempFile, OutputError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(unwritable(path, format!("there is no folder `{}`", folder.display())));
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".snell-").suffix(".tmp");
    // A temporary file is private by default; ours is as readable as any other file (the umask still applies).
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = if is_special(path) { builder.tempfile() } else { builder.tempfile_in(folder) };
    file.map_err(|error| unwritable(path, error))
}

/// Whether a path is a device, a pipe or the like: something to write into, never to put a file in the place of.
fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|what| !what.is_file() && !what.is_dir())
}

fn keep(mut file: NamedTempFile, path: &Path) -> Result<(), OutputError> {
    if is_special(path) {
        let copied = file.rewind().and_then(|()| {
            let mut out = std::fs::OpenOptions::new().write(true).open(path)?;
            io::copy(&mut file, &mut out)?;
            out.flush()
        });
        return copied.map_err(|error| unwritable(path, error));
    }
    file.as_file().sync_all().map_err(|error| unwritable(path, error))?;
    file.persist(path).map(drop).map_err(|error| unwritable(path, error.error))
}

/// Encodes a picture.
///
/// # Errors
/// Whatever the writer says.
pub fn encode(
    out: &mut (impl Write + Seek),
    format: Format,
    frame: &Frame,
    display: &Display,
) -> io::Result<()> {
    let (width, height) = (frame.width, frame.height);
    match format {
        Format::Png | Format::Ppm => {
            write_display(out, format, (width, height), &display.develop(&frame.radiance))
        }
        Format::Exr => exr::encode(out, frame),
        Format::Hdr => {
            let pixels: Vec<_> =
                frame.radiance.iter().map(|pixel: &Rgb| ImageRgb(pixel.to_array())).collect();
            HdrEncoder::new(out).encode(&pixels, width as usize, height as usize).map_err(io::Error::other)
        }
    }
}

/// A file of display values, `width × height`: PNG, or PPM where the format says so.
///
/// # Errors
/// Whatever the writer says.
pub fn encode_display(
    format: Format,
    (width, height): (u32, u32),
    pixels: &[[u8; 3]],
) -> io::Result<Vec<u8>> {
    let mut out = Vec::new();
    write_display(&mut out, format, (width, height), pixels)?;
    Ok(out)
}

fn write_display(
    out: &mut impl Write,
    format: Format,
    (width, height): (u32, u32),
    pixels: &[[u8; 3]],
) -> io::Result<()> {
    if format == Format::Ppm {
        write!(out, "P6\n{width} {height}\n255\n")?;
        return out.write_all(pixels.as_flattened());
    }
    PngEncoder::new(out)
        .write_image(pixels.as_flattened(), width, height, ExtendedColorType::Rgb8)
        .map_err(io::Error::other)
}

fn unwritable(path: &Path, reason: impl ToString) -> OutputError {
    OutputError::Unwritable { path: path.to_owned(), reason: reason.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{Exposure, Tone};

    const DISPLAY: Display = Display { exposure: Exposure::Ev(0.0), tone: Tone::Srgb, floor: false };

    fn frame() -> Frame {
        let radiance = vec![Rgb::new(1.0, 0.5, 0.0), Rgb::gray(4.0), Rgb::BLACK, Rgb::gray(0.25)];
        Frame {
            width: 2,
            height: 2,
            standard_error: vec![Rgb::gray(0.1); 4],
            radiance,
            sample_counts: vec![1; 4],
            ..Frame::default()
        }
    }

    #[test]
    fn each_format_comes_back_as_it_went() {
        for (name, format) in Format::ALL {
            let mut bytes = io::Cursor::new(Vec::new());
            encode(&mut bytes, format, &frame(), &DISPLAY).unwrap();
            let back =
                image::load_from_memory(bytes.get_ref()).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!((back.width(), back.height()), (2, 2), "{name}");
            match format {
                Format::Png | Format::Ppm => {
                    assert_eq!(back.to_rgb8().get_pixel(0, 0).0, [255, 188, 0], "{name}")
                }
                Format::Exr | Format::Hdr => {
                    assert_eq!(back.to_rgb32f().get_pixel(1, 0).0, [4.0; 3], "{name}")
                }
            }
        }
    }

    #[test]
    fn an_unfinished_target_leaves_the_old_file_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        std::fs::write(&path, "old").unwrap();
        let mut target = Target::open(&path).unwrap();
        target.write(&frame(), &DISPLAY).unwrap();
        drop(target);
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        let mut target = Target::open(&path).unwrap();
        target.write(&frame(), &DISPLAY).unwrap();
        target.finish().unwrap();
        assert!(std::fs::read(&path).unwrap().starts_with(b"\x89PNG"));
    }

    #[test]
    fn what_cannot_be_written_is_said_before_any_work() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(Target::open(&folder.path().join("a.jpg")), Err(OutputError::UnknownFormat(_))));
        assert!(matches!(Target::open(&folder.path().join("no/a.png")), Err(OutputError::Unwritable { .. })));
    }
}
