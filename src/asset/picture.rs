//! Picture files: their size without their pixels, and their pixels.

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// The largest width and height that is read.
pub const MAX_SIDE: u32 = 32_768;
/// The most memory that decoding may take, in bytes.
const MAX_BYTES: u64 = 2 << 30;

/// A decoded picture, top row first.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` pixels.
    pub pixels: Pixels,
}

/// Pixels as the file means them.
#[derive(Clone, PartialEq, Debug)]
pub enum Pixels {
    /// Display values (sRGB), 8 bits a channel.
    Display(Vec<[u8; 3]>),
    /// Linear radiance.
    Linear(Vec<[f32; 3]>),
}

/// Why a picture cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// Not a format that is read.
    #[error("this is not a PNG, JPEG, BMP, TGA, PPM, HDR or EXR file")]
    UnknownFormat,
    /// Beyond the limits.
    #[error("it is too large: at most {MAX_SIDE} pixels a side and 2 GiB are read")]
    TooLarge,
    /// Nothing in it.
    #[error("it has no pixels")]
    Empty,
    /// Infinite or undefined values.
    #[error("{0} of its pixels are not finite numbers")]
    NotFinite(usize),
    /// Anything else, in the decoder's words.
    #[error("it cannot be decoded: {0}")]
    Broken(String),
}

impl From<ImageError> for PictureError {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::Limits(_) => Self::TooLarge,
            ImageError::Unsupported(_) => Self::UnknownFormat,
            other => Self::Broken(other.to_string()),
        }
    }
}

/// What the header of a picture says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Header {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Whether it says how much there is of each pixel.
    pub has_alpha: bool,
}

/// What a picture is, from its header alone.
///
/// # Errors
/// [`PictureError`] when the header cannot be read or is beyond the limits.
pub fn header(bytes: &[u8]) -> Result<Header, PictureError> {
    let (width, height) = size(bytes)?;
    let has_alpha = reader(bytes)?.into_decoder()?.color_type().has_alpha();
    Ok(Header { width, height, has_alpha })
}

/// Width and height of a picture, from its header alone.
///
/// # Errors
/// As [`header`].
pub fn size(bytes: &[u8]) -> Result<(u32, u32), PictureError> {
    let (width, height) = reader(bytes)?.into_dimensions()?;
    match (width, height) {
        (0, _) | (_, 0) => Err(PictureError::Empty),
        _ if width > MAX_SIDE || height > MAX_SIDE => Err(PictureError::TooLarge),
        _ => Ok((width, height)),
    }
}

/// All of a picture.
///
/// # Errors
/// [`PictureError`] when it is malformed, too large, empty, or holds numbers that are not finite.
pub fn decode(bytes: &[u8]) -> Result<Picture, PictureError> {
    size(bytes)?;
    let image = reader(bytes)?.decode()?;
    let (width, height) = (image.width(), image.height());
    let pixels = match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let linear: Vec<[f32; 3]> = image.to_rgb32f().pixels().map(|p| p.0).collect();
            let bad = linear.iter().filter(|p| !p.iter().all(|x| x.is_finite())).count();
            if bad > 0 {
                return Err(PictureError::NotFinite(bad));
            }
            Pixels::Linear(linear)
        }
        display => Pixels::Display(display.to_rgb8().pixels().map(|p| p.0).collect()),
    };
    Ok(Picture { width, height, pixels })
}

/// The brightness of each pixel as it is stored, without a curve, cut to [0, 1]: 16 bits of a channel are kept.
///
/// # Errors
/// As [`decode`].
pub fn brightness(bytes: &[u8]) -> Result<Vec<f32>, PictureError> {
    size(bytes)?;
    let image = reader(bytes)?.decode()?.to_luma32f();
    let bad = image.pixels().filter(|p| !p.0[0].is_finite()).count();
    match bad {
        0 => Ok(image.pixels().map(|p| p.0[0].clamp(0.0, 1.0)).collect()),
        bad => Err(PictureError::NotFinite(bad)),
    }
}

/// How much there is of each pixel, in [0, 1], as a linear grey; `None` for a picture that does not say.
///
/// # Errors
/// As [`decode`].
pub fn alpha(bytes: &[u8]) -> Result<Option<Picture>, PictureError> {
    size(bytes)?;
    let image = reader(bytes)?.decode()?;
    if !image.color().has_alpha() {
        return Ok(None);
    }
    let grey: Vec<[f32; 3]> = image.to_rgba32f().pixels().map(|p| [p.0[3].clamp(0.0, 1.0); 3]).collect();
    let bad = grey.iter().filter(|p| !p[0].is_finite()).count();
    if bad > 0 {
        return Err(PictureError::NotFinite(bad));
    }
    Ok(Some(Picture { width: image.width(), height: image.height(), pixels: Pixels::Linear(grey) }))
}

fn reader(bytes: &[u8]) -> Result<ImageReader<Cursor<&[u8]>>, PictureError> {
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| PictureError::Broken(error.to_string()))?;
    if reader.format().is_none() {
        if !looks_like_tga(bytes) {
            return Err(PictureError::UnknownFormat);
        }
        reader.set_format(ImageFormat::Tga);
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    Ok(reader)
}

/// Whether bytes begin with a header of a TGA picture, which has no mark of its own (Truevision 1991, section C).
///
/// What the kinds of pictures and the depths of pixels can be, and what must be 0 in a picture without a palette, leave
/// little that is text or another format.
fn looks_like_tga(bytes: &[u8]) -> bool {
    let Some(
        &[_, has_palette, kind, p0, p1, p2, p3, depth_of_palette, _, _, _, _, w0, w1, h0, h1, depth, flags],
    ) = bytes.first_chunk()
    else {
        return false;
    };
    let palette_fits = match kind {
        1 | 9 => has_palette == 1 && [15, 16, 24, 32].contains(&depth_of_palette),
        2 | 3 | 10 | 11 => has_palette == 0 && [p0, p1, p2, p3, depth_of_palette] == [0; 5],
        _ => false,
    };
    let has_pixels = (w0, w1) != (0, 0) && (h0, h1) != (0, 0);
    palette_fits && has_pixels && [8, 15, 16, 24, 32].contains(&depth) && flags & 0b1100_0000 == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ppm_is_read_and_its_size_agrees() {
        let bytes = b"P6\n2 1\n255\n\x00\x80\xff\x01\x02\x03";
        assert_eq!(size(bytes).unwrap(), (2, 1));
        let picture = decode(bytes).unwrap();
        assert_eq!(picture.pixels, Pixels::Display(vec![[0, 128, 255], [1, 2, 3]]));
    }

    /// Two pixels in a row, red and green, as the two formats of old Windows programs have them: blue first.
    const BMP: &[u8] = b"BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0\x01\0\0\0\x01\0\x18\0\0\0\0\0\
        \x08\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xff\0\xff\0\0\0";
    const TGA: &[u8] = b"\0\0\x02\0\0\0\0\0\0\0\0\0\x02\0\x01\0\x18\x20\0\0\xff\0\xff\0";

    #[test]
    fn bmp_and_tga_are_read() {
        for bytes in [BMP, TGA] {
            assert_eq!(size(bytes).unwrap(), (2, 1));
            let picture = decode(bytes).unwrap();
            assert_eq!(picture.pixels, Pixels::Display(vec![[255, 0, 0], [0, 255, 0]]));
        }
    }

    /// Every byte of both, and every two of a header, set to what makes sizes and depths extreme: an answer or an error,
    /// and never more memory than there is.
    #[test]
    fn broken_headers_of_bmp_and_tga_are_refused_or_read() {
        for bytes in [BMP, TGA] {
            for (first, second) in (0..bytes.len()).flat_map(|i| [(i, i), (i, i + 1)]) {
                for value in [0, 1, 9, 0x7f, 0x80, 0xff] {
                    let mut broken = bytes.to_vec();
                    for at in [first, second.min(bytes.len() - 1)] {
                        broken[at] = value;
                    }
                    let _ = decode(&broken);
                }
            }
            for length in 0..bytes.len() {
                assert!(decode(&bytes[..length]).is_err() || length + 4 > bytes.len());
            }
        }
    }

    #[test]
    fn what_is_no_picture_says_so() {
        assert!(matches!(size(b"snell 1\n"), Err(PictureError::UnknownFormat)));
        assert!(matches!(size(b"P6\n9000000 9000000\n255\n"), Err(PictureError::TooLarge)));
        assert!(matches!(decode(b"P6\n2 2\n255\n\x00"), Err(PictureError::Broken(_))));
    }
}
