//! Pictures painted point by point in linear colours.

use std::fs::File;
use std::io::{self, BufWriter};

use glam::{Vec2, Vec3};
use image::codecs::jpeg::JpegEncoder;
use rayon::prelude::*;

/// A colour given as on the screen, `0xrrggbb`, in linear light.
pub fn srgb(hex: u32) -> Vec3 {
    let channel = |shift: u32| {
        let c = ((hex >> shift) & 255) as f32 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    Vec3::new(channel(16), channel(8), channel(0))
}

/// Paints a picture and writes it as a JPEG among the assets.
///
/// `color` gives the linear colour at a point, in pixels from the top left corner; each pixel is the mean of
/// `grid × grid` points in it. Colours above 1 saturate.
pub fn save(
    name: &str,
    (width, height): (u32, u32),
    grid: u32,
    color: impl Fn(Vec2) -> Vec3 + Sync,
) -> io::Result<()> {
    let row = |y: u32| {
        let pixel = move |x: u32| (x, y);
        (0..width).map(pixel).flat_map(|(x, y)| display(mean(x, y, grid, &color))).collect::<Vec<u8>>()
    };
    let bytes: Vec<u8> = (0..height).into_par_iter().flat_map_iter(row).collect();
    let path = super::asset(name);
    let mut file = BufWriter::new(File::create(&path)?);
    JpegEncoder::new_with_quality(&mut file, 90)
        .encode(&bytes, width, height, image::ExtendedColorType::Rgb8)
        .map_err(io::Error::other)?;
    println!("{}: {width} x {height}", path.display());
    Ok(())
}

/// The mean colour of a pixel over a regular grid of points.
fn mean(x: u32, y: u32, grid: u32, color: &impl Fn(Vec2) -> Vec3) -> Vec3 {
    let point = |i: u32| {
        let offset = Vec2::new((i % grid) as f32 + 0.5, (i / grid) as f32 + 0.5) / grid as f32;
        Vec2::new(x as f32, y as f32) + offset
    };
    (0..grid * grid).map(|i| color(point(i)).min(Vec3::ONE)).sum::<Vec3>() / (grid * grid) as f32
}

/// Linear light to the three bytes of a display.
fn display(linear: Vec3) -> [u8; 3] {
    let curve = |c: f32| if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    linear.clamp(Vec3::ZERO, Vec3::ONE).to_array().map(|c| (curve(c) * 255.0 + 0.5) as u8)
}
