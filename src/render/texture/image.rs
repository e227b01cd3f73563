//! Pictures as textures: where a surface point lies in the picture, and what is there.

use crate::math::{Rgb, Vec2, Vec3};
use crate::render::geometry::SurfacePoint;
use std::sync::Arc;

/// A linear picture in memory.
#[derive(Clone, PartialEq, Debug)]
pub struct Image {
    width: u32,
    height: u32,
    /// `height × width` texels, top row first.
    texels: Vec<Rgb>,
}

impl Image {
    /// A picture from its texels, `height × width`, top row first, linear Rec. 709.
    ///
    /// # Panics
    /// When the number of texels is not `width · height`, or is 0.
    pub fn new(width: u32, height: u32, texels: Vec<Rgb>) -> Self {
        assert_eq!(texels.len(), width as usize * height as usize, "an image holds one texel a cell");
        assert!(!texels.is_empty(), "an image holds at least one texel");
        Self { width, height, texels }
    }

    /// The number of columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The texel in column `x` of row `y`, counted from the top left.
    pub fn texel(&self, x: u32, y: u32) -> Rgb {
        self.texels[y as usize * self.width as usize + x as usize]
    }

    /// The mean of all texels.
    pub fn mean(&self) -> Rgb {
        let sum = self.texels.iter().fold([0.0_f64; 3], |[r, g, b], texel| {
            [r + f64::from(texel.r), g + f64::from(texel.g), b + f64::from(texel.b)]
        });
        Rgb::from(sum.map(|channel| (channel / self.texels.len() as f64) as f32))
    }
}

/// What lies beyond the edges of a picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Wrap {
    /// The picture again.
    Repeat,
    /// Its edge, drawn out.
    Clamp,
    /// The picture again, every other copy turned over.
    Mirror,
    /// One colour.
    Border(Rgb),
}

/// How texels become a colour between their centres.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ImageFilter {
    /// The four nearest, weighted by distance.
    Linear,
    /// The nearest alone.
    Nearest,
}

/// How a surface point finds its place in the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Projection {
    /// By the surface's own texture point.
    Uv,
    /// Along the normal of a parallelogram in object space, which the picture spans.
    Planar {
        /// Where the bottom left of the picture lies, in metres.
        origin: Vec3,
        /// The picture's lower edge, left to right.
        u: Vec3,
        /// The picture's left edge, upwards.
        v: Vec3,
    },
}

/// A picture laid over a surface. Texture point (0, 0) is its bottom left, (1, 1) its top right.
#[derive(Clone, Debug)]
pub struct ImageTexture {
    /// The picture, shared by all that show it.
    pub image: Arc<Image>,
    /// What lies beyond its edges.
    pub wrap: Wrap,
    /// How it looks between texels.
    pub filter: ImageFilter,
    /// Texture points are multiplied by this …
    pub uv_scale: Vec2,
    /// … and then moved by this.
    pub uv_offset: Vec2,
    /// Where texture points come from.
    pub projection: Projection,
}

impl ImageTexture {
    /// The linear colour at a point of a surface.
    pub(super) fn eval(&self, surface: &SurfacePoint) -> Rgb {
        let uv = match self.projection {
            Projection::Uv => surface.uv,
            Projection::Planar { origin, u, v } => {
                let p = surface.p_object - origin;
                Vec2::new(p.dot(u) / u.length_squared(), p.dot(v) / v.length_squared())
            }
        };
        self.lookup(uv * self.uv_scale + self.uv_offset)
    }

    /// The colour at a point of the picture, in units of its sides from the bottom left.
    fn lookup(&self, uv: Vec2) -> Rgb {
        let x = uv.x * self.image.width as f32;
        let y = (1.0 - uv.y) * self.image.height as f32;
        match self.filter {
            ImageFilter::Nearest => self.texel(x.floor() as i64, y.floor() as i64),
            ImageFilter::Linear => {
                let (x, y) = (x - 0.5, y - 0.5);
                let (column, row) = (x.floor() as i64, y.floor() as i64);
                let top = self.texel(column, row).lerp(self.texel(column + 1, row), x - x.floor());
                let bottom = self.texel(column, row + 1).lerp(self.texel(column + 1, row + 1), x - x.floor());
                top.lerp(bottom, y - y.floor())
            }
        }
    }

    /// The texel at any column and row, by the wrapping rule.
    fn texel(&self, column: i64, row: i64) -> Rgb {
        let (x, y) = (wrap(column, self.image.width, self.wrap), wrap(row, self.image.height, self.wrap));
        match (x, y, self.wrap) {
            (Some(x), Some(y), _) => self.image.texel(x, y),
            (_, _, Wrap::Border(color)) => color,
            _ => Rgb::BLACK, // only a border leaves cells without a texel
        }
    }
}

/// The texel that an index along a side of `size` texels leads to; `None` for the border.
fn wrap(index: i64, size: u32, rule: Wrap) -> Option<u32> {
    let n = i64::from(size);
    let inside = match rule {
        Wrap::Repeat => index.rem_euclid(n),
        Wrap::Clamp => index.clamp(0, n - 1),
        Wrap::Mirror => {
            let k = index.rem_euclid(2 * n);
            k.min(2 * n - 1 - k)
        }
        Wrap::Border(_) => index,
    };
    u32::try_from(inside).ok().filter(|&inside| inside < size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four texels: 1 2 above 3 4.
    fn texture(filter: ImageFilter, wrap: Wrap) -> ImageTexture {
        let image = Arc::new(Image::new(2, 2, [1.0, 2.0, 3.0, 4.0].map(Rgb::gray).to_vec()));
        let (uv_scale, uv_offset, projection) = (Vec2::ONE, Vec2::ZERO, Projection::Uv);
        ImageTexture { image, wrap, filter, uv_scale, uv_offset, projection }
    }

    #[test]
    fn the_origin_is_the_bottom_left() {
        let texture = texture(ImageFilter::Nearest, Wrap::Repeat);
        assert_eq!(texture.lookup(Vec2::new(0.1, 0.1)).r, 3.0);
        assert_eq!(texture.lookup(Vec2::new(0.9, 0.9)).r, 2.0);
    }

    #[test]
    fn linear_filtering_meets_the_texels_at_their_centres_and_halves_between() {
        let texture = texture(ImageFilter::Linear, Wrap::Clamp);
        assert_eq!(texture.lookup(Vec2::new(0.25, 0.75)).r, 1.0);
        assert_eq!(texture.lookup(Vec2::new(0.5, 0.5)).r, 2.5);
    }

    #[test]
    fn wrapping_rules() {
        let along = |rule| [-3, -2, -1, 0, 1, 2, 3].map(|i| wrap(i, 2, rule));
        assert_eq!(along(Wrap::Repeat), [1, 0, 1, 0, 1, 0, 1].map(Some));
        assert_eq!(along(Wrap::Clamp), [0, 0, 0, 0, 1, 1, 1].map(Some));
        assert_eq!(along(Wrap::Mirror), [1, 1, 0, 0, 1, 1, 0].map(Some));
        let border = texture(ImageFilter::Nearest, Wrap::Border(Rgb::gray(9.0)));
        assert_eq!(border.lookup(Vec2::new(-0.1, 0.5)).r, 9.0);
        assert_eq!(border.lookup(Vec2::new(0.1, 0.9)).r, 1.0);
    }
}
