//! What varies over a surface: colours looked up at a point.

mod checker;
mod detail;
mod image;
mod noise;
mod pattern;

pub use checker::CheckerKind;
pub use detail::Detail;
pub use image::{Image, ImageFilter, ImageTexture, Projection, Wrap};
pub use pattern::Pattern;

use super::geometry::SurfacePoint;
use crate::math::Rgb;

/// Index of a texture in the world.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct TextureId(pub u32);

/// A colour that is the same everywhere, or looked up at each point. Scalars take the mean of the channels.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Input {
    /// The same everywhere.
    Constant(Rgb),
    /// Looked up.
    Texture(TextureId),
}

/// A colour for every point of a surface. Those that a texture is made of come before it.
#[derive(Clone, Debug)]
pub enum Texture {
    /// A picture laid over the surface.
    Image(ImageTexture),
    /// Two colours in alternating cells.
    Checker {
        /// The colour of the cell at the origin.
        a: Input,
        /// The other colour.
        b: Input,
        /// What the cells are.
        kind: CheckerKind,
    },
    /// One colour blended into another by a pattern.
    Pattern {
        /// The colour where the pattern is 0.
        a: Input,
        /// The colour where it is 1.
        b: Input,
        /// What it looks like.
        pattern: Pattern,
    },
    /// One colour blended into another by a third.
    Blend {
        /// The colour at amount 0.
        a: Input,
        /// The colour at amount 1.
        b: Input,
        /// The share of `b`, channel by channel, held to [0, 1].
        amount: Input,
    },
    /// Arithmetic, channel by channel.
    Join {
        /// What is done.
        op: Join,
        /// The left side.
        a: Input,
        /// The right side.
        b: Input,
    },
}

/// Arithmetic of two colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Join {
    /// The sum.
    Add,
    /// The difference; nothing is less than 0.
    Subtract,
    /// The product.
    Multiply,
}

impl Join {
    fn of(self, a: Rgb, b: Rgb) -> Rgb {
        match self {
            Self::Add => a + b,
            Self::Subtract => (a - b).map(|x| x.max(0.0)),
            Self::Multiply => a * b,
        }
    }
}

/// All textures of a world.
#[derive(Clone, Debug, Default)]
pub struct Textures(Vec<Texture>);

impl Textures {
    /// Textures that refer to each other by index.
    ///
    /// # Panics
    /// When one is made of another that does not come before it.
    pub fn new(textures: Vec<Texture>) -> Self {
        for (index, texture) in (0..).zip(&textures) {
            let earlier = |part: &Input| !matches!(part, Input::Texture(id) if id.0 >= index);
            assert!(texture.parts().iter().all(earlier), "what a texture is made of comes before it");
        }
        Self(textures)
    }

    /// The texture of an index.
    pub fn get(&self, id: TextureId) -> &Texture {
        &self.0[id.0 as usize]
    }

    /// The linear colour of an input at a point of a surface.
    #[inline]
    pub fn color(&self, input: Input, surface: &SurfacePoint) -> Rgb {
        match input {
            Input::Constant(color) => color,
            Input::Texture(id) => self.eval(id, surface),
        }
    }

    /// The linear colour of a texture at a point of a surface.
    pub fn eval(&self, id: TextureId, surface: &SurfacePoint) -> Rgb {
        let at = |input: Input| self.color(input, surface);
        match self.get(id) {
            Texture::Image(texture) => texture.eval(surface),
            Texture::Checker { a, b, kind } => at(if kind.is_even(surface) { *a } else { *b }),
            Texture::Pattern { a, b, pattern } => at(*a).lerp(at(*b), pattern.eval(surface)),
            Texture::Blend { a, b, amount } => {
                let amount = at(*amount).map(|x| x.clamp(0.0, 1.0));
                at(*a) * (Rgb::WHITE - amount) + at(*b) * amount
            }
            Texture::Join { op, a, b } => op.of(at(*a), at(*b)),
        }
    }

    /// About the mean colour of an input: what stands in where only one colour can be had.
    pub fn mean(&self, input: Input) -> Rgb {
        let Input::Texture(id) = input else {
            let Input::Constant(color) = input else { return Rgb::BLACK };
            return color;
        };
        match self.get(id) {
            Texture::Image(texture) => texture.image.mean(),
            Texture::Checker { a, b, .. } | Texture::Pattern { a, b, .. } => {
                (self.mean(*a) + self.mean(*b)) * 0.5
            }
            Texture::Blend { a, b, amount } => {
                let amount = self.mean(*amount).map(|x| x.clamp(0.0, 1.0));
                self.mean(*a) * (Rgb::WHITE - amount) + self.mean(*b) * amount
            }
            Texture::Join { op, a, b } => op.of(self.mean(*a), self.mean(*b)),
        }
    }

    /// Whether it matters to a texture how much of it is seen at once.
    pub fn is_filtered(&self, id: TextureId) -> bool {
        let texture = self.get(id);
        let has_levels = matches!(texture, Texture::Image(image) if !image.coarser.is_empty());
        let part = |part: Input| matches!(part, Input::Texture(id) if self.is_filtered(id));
        has_levels || texture.parts().into_iter().any(part)
    }

    /// The size of what is finest in a texture.
    pub fn detail(&self, id: TextureId) -> Detail {
        let texture = self.get(id);
        let own = match texture {
            Texture::Image(image) => image.detail(),
            Texture::Checker { kind, .. } => kind.detail(),
            Texture::Pattern { pattern, .. } => pattern.detail(),
            Texture::Blend { .. } | Texture::Join { .. } => Detail::NONE,
        };
        let parts = texture.parts().into_iter().filter_map(|part| match part {
            Input::Texture(id) => Some(self.detail(id)),
            Input::Constant(_) => None,
        });
        parts.fold(own, Detail::and)
    }
}

impl Texture {
    /// What it is made of.
    fn parts(&self) -> Vec<Input> {
        match self {
            Self::Image(_) => Vec::new(),
            Self::Checker { a, b, .. } | Self::Pattern { a, b, .. } | Self::Join { a, b, .. } => vec![*a, *b],
            Self::Blend { a, b, amount } => vec![*a, *b, *amount],
        }
    }
}
