//! Pictures as textures: where a surface point lies in the picture, and what is there.

use super::Detail;
use crate::math::{Rgb, Vec2, Vec3, float};
use crate::render::geometry::SurfacePoint;
use std::f32::consts::{PI, TAU};
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
    /// From a point of object space outwards: u is the longitude around y, v the latitude.
    Spherical {
        /// Where it is thrown from, in metres.
        center: Vec3,
    },
    /// On each of the six sides of a box in object space, upright on the four around y.
    Cubic {
        /// The centre of the box, in metres.
        center: Vec3,
        /// Its edges, in metres.
        size: Vec3,
    },
}

impl Projection {
    /// The texture point.
    fn uv(&self, surface: &SurfacePoint) -> Vec2 {
        match *self {
            Self::Uv => surface.uv,
            Self::Planar { origin, u, v } => {
                let p = surface.p_object - origin;
                Vec2::new(p.dot(u) / u.length_squared(), p.dot(v) / v.length_squared())
            }
            Self::Spherical { center } => {
                let d = (surface.p_object - center).normalize_or(Vec3::Y);
                let around = float::atan2(d.x, d.z) / TAU + 0.5;
                Vec2::new(around, 1.0 - float::acos(d.y.clamp(-1.0, 1.0)) / PI)
            }
            Self::Cubic { center, size } => cubic((surface.p_object - center) / size),
        }
    }
}

/// The texture point on the side of the unit cube about the origin that lies farthest out from `p`; seen from outside,
/// no side is mirrored.
fn cubic(p: Vec3) -> Vec2 {
    let [x, y, z] = p.to_array();
    let away = p.abs();
    let (u, v) = if away.y >= away.x && away.y >= away.z {
        (x, if y < 0.0 { z } else { -z })
    } else if away.x >= away.z {
        (if x < 0.0 { z } else { -z }, y)
    } else {
        (if z < 0.0 { -x } else { x }, y)
    };
    Vec2::new(u, v) + 0.5
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
    /// … turned by an angle of this cosine and sine …
    pub uv_turn: Vec2,
    /// … and then moved by this.
    pub uv_offset: Vec2,
    /// Where texture points come from.
    pub projection: Projection,
}

impl ImageTexture {
    /// The linear colour at a point of a surface.
    pub(super) fn eval(&self, surface: &SurfacePoint) -> Rgb {
        let uv = self.projection.uv(surface) * self.uv_scale;
        self.lookup(self.uv_turn.rotate(uv) + self.uv_offset)
    }

    /// The size of what is finest in it, where the texture point is the surface's own: a texel.
    pub(super) fn detail(&self) -> Detail {
        let texel = Vec2::ONE / Vec2::new(self.image.width as f32, self.image.height as f32);
        match self.projection {
            Projection::Uv => Detail::of_uv(texel / self.uv_scale.abs().max_element()),
            Projection::Planar { u, v, .. } => Detail::of_space(
                (texel.x * u.length()).min(texel.y * v.length()) / self.uv_scale.abs().max_element(),
            ),
            Projection::Spherical { .. } => Detail::of_uv(texel),
            Projection::Cubic { size, .. } => {
                Detail::of_space(texel.min_element() * size.min_element() / self.uv_scale.abs().max_element())
            }
        }
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
        let (uv_scale, uv_turn, uv_offset) = (Vec2::ONE, Vec2::X, Vec2::ZERO);
        ImageTexture { image, wrap, filter, uv_scale, uv_turn, uv_offset, projection: Projection::Uv }
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

    #[test]
    fn the_sides_of_a_box_show_the_picture_upright_and_not_mirrored() {
        // Seen from outside along each axis, u grows to the right and v upwards; on top, v runs away from the viewer.
        let sides = [
            (Vec3::X, Vec3::NEG_Z, Vec3::Y),
            (Vec3::NEG_X, Vec3::Z, Vec3::Y),
            (Vec3::Z, Vec3::X, Vec3::Y),
            (Vec3::NEG_Z, Vec3::NEG_X, Vec3::Y),
            (Vec3::Y, Vec3::X, Vec3::NEG_Z),
            (Vec3::NEG_Y, Vec3::X, Vec3::Z),
        ];
        for (out, right, up) in sides {
            assert!((right.cross(up) - out).length() < 1e-6);
            let uv = cubic(out * 0.5 + right * 0.25 - up * 0.125);
            assert!((uv - Vec2::new(0.75, 0.375)).length() < 1e-6, "{out}: {uv}");
        }
    }
}
