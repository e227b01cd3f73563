//! What varies over a surface: colours looked up at a point.

mod checker;
mod image;

pub use checker::CheckerKind;
pub use image::{Image, ImageFilter, ImageTexture, Projection, Wrap};

use super::geometry::SurfacePoint;
use crate::math::Rgb;

/// Index of a texture in the world.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct TextureId(pub u32);

/// A colour for every point of a surface.
#[derive(Clone, Debug)]
pub enum Texture {
    /// A picture laid over the surface.
    Image(ImageTexture),
    /// Two colours in alternating cells.
    Checker {
        /// The colour of the cell at the origin.
        a: Rgb,
        /// The other colour.
        b: Rgb,
        /// What the cells are.
        kind: CheckerKind,
    },
}

impl Texture {
    /// The linear colour at a point of a surface.
    pub fn eval(&self, surface: &SurfacePoint) -> Rgb {
        match self {
            Self::Image(texture) => texture.eval(surface),
            Self::Checker { a, b, kind } => {
                if kind.is_even(surface) {
                    *a
                } else {
                    *b
                }
            }
        }
    }

    /// The mean colour over the texture's own square: what stands in where only one colour can be had.
    pub fn mean(&self) -> Rgb {
        match self {
            Self::Image(texture) => texture.image.mean(),
            Self::Checker { a, b, .. } => (*a + *b) * 0.5,
        }
    }
}
