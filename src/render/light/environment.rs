//! Light from infinity: one colour, or a picture wrapped around the world.

use super::distribution::GridDistribution;
use super::sun::Sun;
use crate::math::{Rgb, Vec2, Vec3, float, warp};
use crate::render::texture::Image;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// What surrounds the scene.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The radiance from each direction, in W·m⁻²·sr⁻¹.
    pub radiance: EnvironmentRadiance,
    /// A factor of it.
    pub scale: f32,
    /// In radians about +y, counter-clockwise seen from above.
    pub rotation: f32,
}

/// The radiance from each direction.
#[derive(Clone, Debug)]
pub enum EnvironmentRadiance {
    /// The same from everywhere.
    Constant(Rgb),
    /// Equirectangular: the top row is +y, the centre −z, and the right of the centre +x.
    Image(Arc<Image>),
    /// A picture of the sky, as above, and the sun that is not in it.
    Daylight {
        /// The sky without the sun.
        sky: Arc<Image>,
        /// The sun, if it shines.
        sun: Option<Sun>,
    },
}

impl EnvironmentRadiance {
    fn image(&self) -> Option<&Image> {
        match self {
            Self::Constant(_) => None,
            Self::Image(image) | Self::Daylight { sky: image, .. } => Some(image),
        }
    }
}

/// An environment made ready to be drawn from.
pub struct Sky {
    environment: Environment,
    /// Over the texels of a picture that is not black.
    grid: Option<GridDistribution>,
    /// The sun, and the share of directions that are drawn to it.
    sun: Option<(Sun, f32)>,
    mean: Rgb,
}

impl Sky {
    /// Makes an environment ready.
    pub fn new(environment: Environment) -> Self {
        let (grid, mean) = match (&environment.radiance, environment.radiance.image()) {
            (EnvironmentRadiance::Constant(color), _) => (None, *color),
            (_, Some(image)) => {
                let weights = texel_weights(image);
                (GridDistribution::new(image.width() as usize, &weights), mean_radiance(image))
            }
            (_, None) => (None, Rgb::BLACK),
        };
        let (sun, from_sun) = match &environment.radiance {
            EnvironmentRadiance::Daylight { sun: Some(sun), .. } => {
                let from_sun = sun.radiance * (sun.solid_angle() / (4.0 * PI)) as f32;
                (Some((*sun, sun_share(from_sun.luminance(), mean.luminance()))), from_sun)
            }
            _ => (None, Rgb::BLACK),
        };
        let mean = (mean + from_sun) * environment.scale;
        Self { environment, grid, sun, mean }
    }

    /// The radiance from the unit direction `dir`; between texel centres of a picture it goes in straight lines.
    pub fn radiance(&self, dir: Vec3) -> Rgb {
        let radiance = match &self.environment.radiance {
            EnvironmentRadiance::Constant(color) => *color,
            EnvironmentRadiance::Image(image) | EnvironmentRadiance::Daylight { sky: image, .. } => {
                interpolate(image, self.image_point(dir))
            }
        };
        let sun = self.sun.filter(|(sun, _)| sun.meets(dir));
        (radiance + sun.map_or(Rgb::BLACK, |(sun, _)| sun.radiance)) * self.environment.scale
    }

    /// The mean radiance over all directions.
    pub fn mean(&self) -> Rgb {
        self.mean
    }

    /// Draws a direction, and its density per steradian.
    pub fn sample(&self, u: Vec2) -> (Vec3, f32) {
        let Some((sun, share)) = &self.sun else { return self.sample_dome(u) };
        let dir = if u.x < *share {
            sun.sample(Vec2::new(u.x / share, u.y))
        } else {
            self.sample_dome(Vec2::new(((u.x - share) / (1.0 - share)).min(BELOW_ONE), u.y)).0
        };
        (dir, self.pdf(dir))
    }

    /// The density per steradian with which [`Self::sample`] draws `dir`.
    pub fn pdf(&self, dir: Vec3) -> f32 {
        let Some((sun, share)) = &self.sun else { return self.pdf_dome(dir) };
        let to_sun = if sun.meets(dir) { (1.0 / sun.solid_angle()) as f32 } else { 0.0 };
        share * to_sun + (1.0 - share) * self.pdf_dome(dir)
    }

    fn sample_dome(&self, u: Vec2) -> (Vec3, f32) {
        let (Some(grid), Some(image)) = (&self.grid, self.environment.radiance.image()) else {
            return (warp::square_to_uniform_sphere(u), UNIFORM_PDF);
        };
        let cell = grid.sample(f64::from(u.x), f64::from(u.y));
        let (top, bottom) = (row_edge(image, cell.row), row_edge(image, cell.row + 1));
        let cos_theta = top + (bottom - top) * cell.y;
        let s = (cell.column as f64 + cell.x) / f64::from(image.width());
        let phi = (s - 0.5) * TAU - f64::from(self.environment.rotation);
        let (sin_phi, cos_phi) = float::sin_cos64(phi);
        let sin_theta = (1.0 - cos_theta * cos_theta).max(0.0).sqrt();
        let dir = Vec3::new((sin_theta * sin_phi) as f32, cos_theta as f32, (-sin_theta * cos_phi) as f32);
        (dir.normalize(), (cell.pmf / texel_angle(image, cell.row)) as f32)
    }

    fn pdf_dome(&self, dir: Vec3) -> f32 {
        let (Some(grid), Some(image)) = (&self.grid, self.environment.radiance.image()) else {
            return UNIFORM_PDF;
        };
        let [s, t] = self.image_point(dir);
        let column = ((s * f64::from(image.width())) as usize).min(image.width() as usize - 1);
        let row = ((t * f64::from(image.height())) as usize).min(image.height() as usize - 1);
        (grid.pmf(column, row) / texel_angle(image, row)) as f32
    }

    /// Where a direction lies in the picture, in units of its sides from the top left: [0, 1)².
    fn image_point(&self, dir: Vec3) -> [f64; 2] {
        let dir = dir.as_dvec3();
        let theta = float::atan2_64((dir.x * dir.x + dir.z * dir.z).sqrt(), dir.y);
        let phi = float::atan2_64(dir.x, -dir.z) + f64::from(self.environment.rotation);
        [(phi / TAU + 0.5).rem_euclid(1.0), theta / PI]
    }
}

/// The largest number below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// The share of directions drawn to the sun, by the light from it and from the sky: neither is forgotten.
fn sun_share(sun: f32, sky: f32) -> f32 {
    let share = if sun + sky > 0.0 { sun / (sun + sky) } else { 0.5 };
    share.clamp(0.2, 0.8)
}

const UNIFORM_PDF: f32 = std::f32::consts::FRAC_1_PI / 4.0;

/// The cosine from +y of the upper edge of a row.
fn row_edge(image: &Image, row: usize) -> f64 {
    float::sin_cos64(PI * row as f64 / f64::from(image.height())).1
}

/// The solid angle of a texel, in steradians: each row is drawn uniformly by it, so density is constant in a texel.
fn texel_angle(image: &Image, row: usize) -> f64 {
    (row_edge(image, row) - row_edge(image, row + 1)) * TAU / f64::from(image.width())
}

/// The picture at a point, linear between the four nearest texel centres; left and right edges meet.
fn interpolate(image: &Image, [s, t]: [f64; 2]) -> Rgb {
    let (x, y) = (s * f64::from(image.width()) - 0.5, t * f64::from(image.height()) - 0.5);
    let (column, row) = (x.floor() as i64, y.floor() as i64);
    let (fx, fy) = ((x - x.floor()) as f32, (y - y.floor()) as f32);
    let line = |row| texel(image, column, row).lerp(texel(image, column + 1, row), fx);
    line(row).lerp(line(row + 1), fy)
}

/// The texel at any column, and at the nearest row there is.
fn texel(image: &Image, column: i64, row: i64) -> Rgb {
    let column = column.rem_euclid(i64::from(image.width()));
    image.texel(column as u32, row.clamp(0, i64::from(image.height()) - 1) as u32)
}

/// The luminous part of each texel, `height × width`: mean luminance within it times its solid angle.
///
/// The mean counts the neighbours as interpolation does, so that no direction with radiance has density 0.
fn texel_weights(image: &Image) -> Vec<f64> {
    let (width, height) = (i64::from(image.width()), i64::from(image.height()));
    let luminance = |column, row| f64::from(texel(image, column, row).luminance().max(0.0));
    let across = |x, y| (luminance(x - 1, y) + 6.0 * luminance(x, y) + luminance(x + 1, y)) / 8.0;
    let mut weights = Vec::with_capacity((width * height) as usize);
    for y in 0..height {
        let angle = texel_angle(image, y as usize);
        weights.extend(
            (0..width).map(|x| angle * (across(x, y - 1) + 6.0 * across(x, y) + across(x, y + 1)) / 8.0),
        );
    }
    weights
}

/// The mean of the texels, weighted by solid angle.
fn mean_radiance(image: &Image) -> Rgb {
    let mut sum = [0.0_f64; 3];
    for row in 0..image.height() {
        let share = texel_angle(image, row as usize) / (4.0 * PI);
        for column in 0..image.width() {
            let texel = image.texel(column, row).to_array();
            sum = [0, 1, 2].map(|channel| sum[channel] + share * f64::from(texel[channel]));
        }
    }
    Rgb::from(sum.map(|channel| channel as f32))
}
