//! Textures: each lowered once for what it is wanted as; pictures are decoded once a file and reading.

use super::{GRAY, Materials};
use crate::asset::picture::PictureError;
use crate::asset::{Picture, Pixels, picture};
use crate::ir::material::{Channel, CheckerCells, ColorSpace, Input, Join, Pattern, Projection, TextureKind};
use crate::ir::{self, Handle, ImageUse};
use crate::load::{LoadError, PictureFile};
use crate::math::{Rgb, Vec2, float, rgb};
use crate::render::bsdf;
use crate::render::texture::{self, CheckerKind, Image, ImageFilter, ImageTexture, Texture, TextureId, Wrap};
use std::sync::Arc;

/// What a texture is wanted as.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Slot {
    /// A colour.
    Color,
    /// Numbers: a roughness, a share, a normal.
    Data,
}

/// How the numbers of a picture are read.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Reading {
    /// Whether those of eight bits are plain, not display values.
    pub(super) linear: bool,
    pub(super) channel: Channel,
}

impl Reading {
    /// A picture as it is to be seen.
    pub(super) const DISPLAY: Self = Self { linear: false, channel: Channel::Rgb };
}

impl Materials<'_> {
    /// An input that is a colour.
    pub(super) fn color(&mut self, input: &Input) -> bsdf::Input {
        self.input(input, Slot::Color)
    }

    /// An input that is a number.
    pub(super) fn data(&mut self, input: &Input) -> bsdf::Input {
        self.input(input, Slot::Data)
    }

    fn input(&mut self, input: &Input, slot: Slot) -> bsdf::Input {
        match input {
            Input::Constant(color) => bsdf::Input::Constant(color.value),
            Input::Texture(texture) => self.texture(texture.value, slot),
        }
    }

    pub(super) fn texture(&mut self, handle: Handle<ir::Texture>, slot: Slot) -> bsdf::Input {
        let key = (handle.index(), slot);
        if let Some(&known) = self.texture_by_handle.get(&key) {
            return bsdf::Input::Texture(known);
        }
        // Parts come before the whole.
        let lowered = match &self.loaded.scene.textures[handle].kind {
            TextureKind::Image(image) => match self.image_texture(handle, image, slot) {
                Ok(texture) => texture,
                Err(left_out) => return bsdf::Input::Constant(left_out),
            },
            TextureKind::Checker(checker) => {
                let kind = match checker.cells {
                    CheckerCells::Uv(cells) => CheckerKind::Cells(cells.as_vec2()),
                    CheckerCells::Solid(edge) => CheckerKind::Solid(edge as f32),
                };
                let (a, b) = (self.input(&checker.a, slot), self.input(&checker.b, slot));
                Texture::Checker { a, b, kind }
            }
            TextureKind::Pattern { a, b, pattern } => {
                let (a, b) = (self.input(a, slot), self.input(b, slot));
                Texture::Pattern { a, b, pattern: lower_pattern(pattern) }
            }
            TextureKind::Blend { a, b, amount } => {
                let (a, b) = (self.input(a, slot), self.input(b, slot));
                Texture::Blend { a, b, amount: self.data(amount) }
            }
            TextureKind::Join { op, a, b } => {
                let op = match op {
                    Join::Add => texture::Join::Add,
                    Join::Subtract => texture::Join::Subtract,
                    Join::Multiply => texture::Join::Multiply,
                };
                let (a, b) = (self.input(a, slot), self.input(b, slot));
                Texture::Join { op, a, b }
            }
        };
        let id = self.add_texture(lowered);
        self.texture_by_handle.insert(key, id);
        bsdf::Input::Texture(id)
    }

    pub(super) fn add_texture(&mut self, texture: Texture) -> TextureId {
        self.textures.push(texture);
        TextureId(self.textures.len() as u32 - 1)
    }

    /// The picture laid out; the one colour that stands for it if it was left out.
    fn image_texture(
        &mut self,
        handle: Handle<ir::Texture>,
        image: &ImageUse,
        slot: Slot,
    ) -> Result<Texture, Rgb> {
        let wrap = match image.wrap {
            ir::Wrap::Repeat => Wrap::Repeat,
            ir::Wrap::Clamp => Wrap::Clamp,
            ir::Wrap::Mirror => Wrap::Mirror,
            ir::Wrap::Border(color) => Wrap::Border(color),
        };
        let linear = match image.space {
            ColorSpace::Auto => slot == Slot::Data,
            ColorSpace::Srgb => false,
            ColorSpace::Linear => true,
        };
        let reading = Reading { linear, channel: image.channel };
        let Some(pixels) = self.loaded.picture(handle).and_then(|file| self.image(file, reading)) else {
            // Left out with a warning: all of it is border.
            return Err(if let Wrap::Border(color) = wrap { color } else { GRAY });
        };
        let (sin, cos) = float::sin_cos(image.uv_rotation as f32);
        let coarser = if slot == Slot::Color { self.coarser(&pixels) } else { Arc::new([]) };
        Ok(Texture::Image(ImageTexture {
            image: pixels,
            coarser,
            wrap,
            filter: if image.linear_filter { ImageFilter::Linear } else { ImageFilter::Nearest },
            uv_scale: image.uv_scale.as_vec2(),
            uv_turn: if image.uv_rotation == 0.0 { Vec2::X } else { Vec2::new(cos, sin) },
            uv_offset: image.uv_offset.as_vec2(),
            projection: lower_projection(&image.projection),
        }))
    }

    /// A picture ever coarser, made once; nothing where pictures are not filtered. Only of colours: a mean of normals or of
    /// roughness is not that of what a surface with these sends on.
    pub(super) fn coarser(&mut self, image: &Arc<Image>) -> Arc<[Image]> {
        if !self.filters {
            return Arc::new([]);
        }
        let make = || image.coarser().into();
        Arc::clone(self.coarser.entry(Arc::as_ptr(image)).or_insert_with(make))
    }

    /// The pixels of a picture file.
    pub(super) fn image(&mut self, file: &PictureFile, reading: Reading) -> Option<Arc<Image>> {
        let key = (file.path.clone(), reading);
        if let Some(known) = self.images.get(&key) {
            return known.clone();
        }
        let bytes = file.read(self.files).map_err(|error| error.to_string());
        let image = match bytes.and_then(|bytes| read(&bytes, reading)) {
            Ok(image) => Some(Arc::new(image)),
            Err(reason) => {
                self.failed.push(LoadError::BadPicture { name: file.name.clone(), reason, used: file.span });
                None
            }
        };
        self.images.insert(key, image.clone());
        image
    }
}

/// Decodes a picture as it is wanted.
fn read(bytes: &[u8], reading: Reading) -> Result<Image, String> {
    let told = |error: PictureError| error.to_string();
    if reading.channel == Channel::Alpha {
        let picture = picture::alpha(bytes).map_err(told)?;
        return Ok(linear(&picture.ok_or("it has no alpha channel")?, reading));
    }
    Ok(linear(&picture::decode(bytes).map_err(told)?, reading))
}

fn linear(picture: &Picture, reading: Reading) -> Image {
    let picked = |[r, g, b]: [f32; 3]| match reading.channel {
        Channel::Rgb => Rgb::new(r, g, b),
        Channel::Red | Channel::Alpha => Rgb::gray(r),
        Channel::Green => Rgb::gray(g),
        Channel::Blue => Rgb::gray(b),
    };
    let texels = match &picture.pixels {
        Pixels::Display(pixels) => {
            let value = |x: f32| if reading.linear { x } else { rgb::srgb_to_linear(x) };
            let table: Vec<f32> = (0..=255u8).map(|x| value(f32::from(x) / 255.0)).collect();
            pixels.iter().map(|p| picked(p.map(|x| table[usize::from(x)]))).collect()
        }
        Pixels::Linear(pixels) => pixels.iter().map(|&p| picked(p)).collect(),
    };
    Image::new(picture.width, picture.height, texels)
}

fn lower_pattern(pattern: &Pattern) -> texture::Pattern {
    match *pattern {
        Pattern::Gradient(None) => texture::Pattern::Rise,
        Pattern::Gradient(Some([start, end])) => {
            texture::Pattern::Ramp { start: start.as_vec3(), way: (end - start).as_vec3() }
        }
        Pattern::Noise { size, octaves } => texture::Pattern::Noise { size: size as f32, octaves },
        Pattern::Marble { size, turbulence } => {
            texture::Pattern::Marble { size: size as f32, turbulence: turbulence as f32 }
        }
        Pattern::Wood { size, turbulence } => {
            texture::Pattern::Wood { size: size as f32, turbulence: turbulence as f32 }
        }
        Pattern::Brick { cells, mortar, aspect } => {
            texture::Pattern::Brick { cells: cells.as_vec2(), mortar: mortar as f32, aspect: aspect as f32 }
        }
    }
}

fn lower_projection(projection: &Projection) -> texture::Projection {
    match *projection {
        Projection::Uv => texture::Projection::Uv,
        Projection::Planar { origin, u, v } => {
            texture::Projection::Planar { origin: origin.as_vec3(), u: u.as_vec3(), v: v.as_vec3() }
        }
        Projection::Spherical { center } => texture::Projection::Spherical { center: center.as_vec3() },
        Projection::Cubic { center, size } => {
            texture::Projection::Cubic { center: center.as_vec3(), size: size.as_vec3() }
        }
    }
}
