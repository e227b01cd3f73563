//! Pictures as textures: where a surface point lies in the picture, and what is there.

use super::Detail;
use crate::math::{Rgb, Vec2, Vec3, float};
use crate::render::geometry::{Spread, SurfacePoint};
use std::f32::consts::{LN_2, PI, TAU};
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

    /// The same picture in half as many columns and rows, and again, down to a single texel (Williams 1983): each texel the
    /// mean of what it covers, with shares of those at its edges, so that the mean of all stays what it is.
    pub fn coarser(&self) -> Vec<Self> {
        let mut levels: Vec<Self> = Vec::new();
        loop {
            let last = levels.last().unwrap_or(self);
            if last.width == 1 && last.height == 1 {
                return levels;
            }
            levels.push(last.halved());
        }
    }

    fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let (columns, rows) = (shares(self.width, width), shares(self.height, height));
        let mut texels = Vec::with_capacity(width as usize * height as usize);
        for row in &rows {
            for column in &columns {
                let mut sum = [0.0_f64; 3];
                for &(y, share_y) in row {
                    for &(x, share_x) in column {
                        let texel = self.texel(x, y);
                        let share = share_x * share_y;
                        sum[0] += f64::from(texel.r) * share;
                        sum[1] += f64::from(texel.g) * share;
                        sum[2] += f64::from(texel.b) * share;
                    }
                }
                texels.push(Rgb::from(sum.map(|channel| channel as f32)));
            }
        }
        Self::new(width, height, texels)
    }

    /// The mean of all texels.
    pub fn mean(&self) -> Rgb {
        let sum = self.texels.iter().fold([0.0_f64; 3], |[r, g, b], texel| {
            [r + f64::from(texel.r), g + f64::from(texel.g), b + f64::from(texel.b)]
        });
        Rgb::from(sum.map(|channel| (channel / self.texels.len() as f64) as f32))
    }
}

/// For each of `new` cells, those of `old` that lie under it, with the share that each has in it.
fn shares(old: u32, new: u32) -> Vec<Vec<(u32, f64)>> {
    let size = f64::from(old) / f64::from(new);
    let cell = |i: u32| {
        let (start, end) = (f64::from(i) * size, f64::from(i + 1) * size);
        let last = (end.ceil() as u32).min(old);
        let share = |x: u32| (f64::from(x + 1).min(end) - f64::from(x).max(start)) / size;
        (start as u32..last).map(|x| (x, share(x))).filter(|(_, share)| *share > 0.0).collect()
    };
    (0..new).map(cell).collect()
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
    /// The same, ever coarser, for where more than a point of it is seen at once; empty: points are looked up everywhere.
    pub coarser: Arc<[Image]>,
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
        let uv = self.uv_turn.rotate(uv) + self.uv_offset;
        if self.coarser.is_empty() || surface.spread == Spread::NONE {
            return self.lookup(uv);
        }
        self.filtered(uv, self.width_in_texels(surface))
    }

    /// The width of what is seen of the picture at once, in texels: in the direction in which it is narrowest.
    fn width_in_texels(&self, surface: &SurfacePoint) -> f32 {
        let size = Vec2::new(self.image.width as f32, self.image.height as f32);
        let scale = self.uv_scale.abs().min_element();
        let space = surface.spread.space;
        match self.projection {
            Projection::Uv => {
                let [along, across] =
                    surface.spread.uv.map(|uv| self.uv_turn.rotate(uv * self.uv_scale) * size);
                narrowest(along, across)
            }
            Projection::Planar { u, v, .. } => scale * space * (size.x / u.length()).min(size.y / v.length()),
            Projection::Spherical { center } => {
                let angle = space / surface.p_object.distance(center);
                scale * angle * (size.x / TAU).min(size.y / PI)
            }
            Projection::Cubic { size: edges, .. } => scale * space * size.min_element() / edges.max_element(),
        }
    }

    /// The mean colour about a point of the picture, over about `width` texels.
    ///
    /// Between two of the coarser pictures, in each between the nearest texels, of which half the width is one: together
    /// four texels make the width, and what the pixel's own filter blurs is not blurred twice.
    fn filtered(&self, uv: Vec2, width: f32) -> Rgb {
        let level = float::ln(0.5 * width) / LN_2;
        if level <= 0.0 || level.is_nan() {
            return self.lookup(uv);
        }
        let last = self.coarser.len() - 1;
        let at = |level: usize| match level.checked_sub(1) {
            None => self.lookup(uv),
            Some(i) => self.blended(&self.coarser[i.min(last)], uv),
        };
        let whole = level.floor();
        let fine = whole as usize;
        if fine > last { at(fine) } else { at(fine).lerp(at(fine + 1), level - whole) }
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
        match self.filter {
            ImageFilter::Nearest => {
                let x = uv.x * self.image.width as f32;
                let y = (1.0 - uv.y) * self.image.height as f32;
                self.texel(&self.image, x.floor() as i64, y.floor() as i64)
            }
            ImageFilter::Linear => self.blended(&self.image, uv),
        }
    }

    /// The four texels of one of its pictures that are nearest to a point, weighted by distance.
    fn blended(&self, image: &Image, uv: Vec2) -> Rgb {
        let x = uv.x * image.width as f32 - 0.5;
        let y = (1.0 - uv.y) * image.height as f32 - 0.5;
        let (column, row) = (x.floor() as i64, y.floor() as i64);
        let texel = |column, row| self.texel(image, column, row);
        let top = texel(column, row).lerp(texel(column + 1, row), x - x.floor());
        let bottom = texel(column, row + 1).lerp(texel(column + 1, row + 1), x - x.floor());
        top.lerp(bottom, y - y.floor())
    }

    /// The texel at any column and row, by the wrapping rule.
    fn texel(&self, image: &Image, column: i64, row: i64) -> Rgb {
        let (x, y) = (wrap(column, image.width, self.wrap), wrap(row, image.height, self.wrap));
        match (x, y, self.wrap) {
            (Some(x), Some(y), _) => image.texel(x, y),
            (_, _, Wrap::Border(color)) => color,
            _ => Rgb::BLACK, // only a border leaves cells without a texel
        }
    }
}

/// The length of the shorter half-axis of the ellipse that two conjugate half-axes span: the least singular value.
fn narrowest(a: Vec2, b: Vec2) -> f32 {
    let (squares, area) = (a.length_squared() + b.length_squared(), a.perp_dot(b).abs());
    let longest2 = 0.5 * (squares + (squares * squares - 4.0 * area * area).max(0.0).sqrt());
    if longest2 > 0.0 { area / longest2.sqrt() } else { 0.0 }
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
        let coarser = image.coarser().into();
        ImageTexture {
            image,
            coarser,
            wrap,
            filter,
            uv_scale,
            uv_turn,
            uv_offset,
            projection: Projection::Uv,
        }
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
    fn coarser_pictures_keep_the_mean_and_end_in_it() {
        for (width, height) in [(1, 1), (2, 2), (7, 5), (1, 9), (16, 3), (31, 33)] {
            let texel = |i: u32| Rgb::new(i as f32, (i * 7 % 11) as f32, (i % 2) as f32);
            let image = Image::new(width, height, (0..width * height).map(texel).collect());
            let mean = image.mean();
            for level in image.coarser() {
                let error = (level.mean() - mean).map(f32::abs).max_component();
                assert!(error < 1e-5 * mean.max_component(), "{width} x {height}: {error}");
            }
            let last = image.coarser().pop().unwrap_or(image);
            assert_eq!((last.width, last.height), (1, 1));
        }
    }

    #[test]
    fn what_is_narrower_than_two_texels_is_looked_up_and_what_is_wide_is_the_mean() {
        let texture = texture(ImageFilter::Linear, Wrap::Repeat);
        let uv = Vec2::new(0.3, 0.9);
        assert_eq!(texture.filtered(uv, 0.0), texture.lookup(uv));
        assert_eq!(texture.filtered(uv, 2.0), texture.lookup(uv));
        assert_eq!(texture.filtered(uv, 4.0).r, 2.5);
        assert_eq!(texture.filtered(uv, 1e30).r, 2.5);
        assert_eq!(texture.filtered(uv, f32::NAN), texture.lookup(uv));
        let between = (texture.lookup(uv).r + 2.5) / 2.0;
        assert!((texture.filtered(uv, 2.0 * 2.0_f32.sqrt()).r - between).abs() < 1e-6);
    }

    #[test]
    fn the_narrowest_width_of_an_ellipse_is_its_shorter_axis() {
        let turned = Vec2::new(0.6, 0.8);
        let [a, b] = [Vec2::new(3.0, 0.0), Vec2::new(0.0, 0.5)].map(|axis| turned.rotate(axis));
        assert!((narrowest(a, b) - 0.5).abs() < 1e-5);
        assert_eq!(narrowest(a, a), 0.0);
        assert_eq!(narrowest(Vec2::ZERO, Vec2::ZERO), 0.0);
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
