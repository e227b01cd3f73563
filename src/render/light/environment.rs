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
    /// Over the texels brighter than the mean, by how much they are.
    peaks: Option<GridDistribution>,
    /// The mean over all directions of the luminance above the mean.
    peak_mean: f32,
}

impl Sky {
    /// Makes an environment ready.
    pub fn new(environment: Environment) -> Self {
        let (sun, from_sun) = match &environment.radiance {
            EnvironmentRadiance::Daylight { sun: Some(sun), .. } => {
                (Some(*sun), sun.radiance * (sun.solid_angle() / (4.0 * PI)) as f32)
            }
            _ => (None, Rgb::BLACK),
        };
        let share = |mean: Rgb| sun.map(|sun| (sun, sun_share(from_sun.luminance(), mean.luminance())));
        let Some(image) = environment.radiance.image() else {
            let mean = match &environment.radiance {
                EnvironmentRadiance::Constant(color) => *color * environment.scale,
                _ => unreachable!("it is no picture"),
            };
            return Self { environment, grid: None, sun: None, mean, peaks: None, peak_mean: 0.0 };
        };
        let weights = texel_weights(image);
        let over = weights_over_mean(image, &weights);
        let width = image.width() as usize;
        let (grid, peaks) = (GridDistribution::new(width, &weights), GridDistribution::new(width, &over));
        let peak_mean = (over.iter().sum::<f64>() / (4.0 * PI)) as f32 + from_sun.luminance();
        let (peak_mean, dome) = (peak_mean * environment.scale, mean_radiance(image));
        let (sun, mean) = (share(dome), (dome + from_sun) * environment.scale);
        Self { environment, grid, sun, mean, peaks, peak_mean }
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
        draw(grid, image, self.environment.rotation, u)
    }

    /// Draws a direction for paths that find the sky by their bsdf as well; `None` where that alone does best, under a sky
    /// of one colour.
    ///
    /// Density is in proportion to the luminance above the mean: what is left to chance needs no drawing (Karlík, Šik,
    /// Vévoda, Skřivan, Křivánek 2019, section 4).
    pub fn sample_direct(&self, u: Vec2) -> Option<(Vec3, f32)> {
        let peak = |u| {
            let (peaks, image) = (self.peaks.as_ref()?, self.environment.radiance.image()?);
            Some(draw(peaks, image, self.environment.rotation, u))
        };
        let Some((sun, share)) = self.direct_sun() else { return peak(u) };
        let dir = if u.x < share {
            sun.sample(Vec2::new(u.x / share, u.y))
        } else {
            peak(Vec2::new(((u.x - share) / (1.0 - share)).min(BELOW_ONE), u.y))?.0
        };
        Some((dir, self.pdf_direct(dir)))
    }

    /// The density per steradian with which [`Self::sample_direct`] draws `dir`.
    pub fn pdf_direct(&self, dir: Vec3) -> f32 {
        let peak = self.peaks.as_ref().map_or(0.0, |peaks| self.density(peaks, dir));
        let Some((sun, share)) = self.direct_sun() else { return peak };
        let to_sun = if sun.meets(dir) { (1.0 / sun.solid_angle()) as f32 } else { 0.0 };
        share * to_sun + (1.0 - share) * peak
    }

    /// The sun, and the share of what is drawn directly that goes to it: all, where the sky has no peaks.
    fn direct_sun(&self) -> Option<(Sun, f32)> {
        self.sun.map(|(sun, share)| (sun, if self.peaks.is_some() { share } else { 1.0 }))
    }

    /// The irradiance on any surface from a sky as bright everywhere as [`Self::sample_direct`] finds it on average, as
    /// luminance.
    pub fn direct_irradiance(&self) -> f32 {
        let is_drawn = self.peaks.is_some() || self.sun.is_some();
        if is_drawn { self.peak_mean * std::f32::consts::PI } else { 0.0 }
    }

    fn pdf_dome(&self, dir: Vec3) -> f32 {
        self.grid.as_ref().map_or(UNIFORM_PDF, |grid| self.density(grid, dir))
    }

    /// The density per steradian with which a direction is drawn from a grid over the picture's texels.
    fn density(&self, grid: &GridDistribution, dir: Vec3) -> f32 {
        let Some(image) = self.environment.radiance.image() else { return UNIFORM_PDF };
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

/// A direction from a grid over the texels of a picture, and its density per steradian.
fn draw(grid: &GridDistribution, image: &Image, rotation: f32, u: Vec2) -> (Vec3, f32) {
    let cell = grid.sample(f64::from(u.x), f64::from(u.y));
    let (top, bottom) = (row_edge(image, cell.row), row_edge(image, cell.row + 1));
    let cos_theta = top + (bottom - top) * cell.y;
    let s = (cell.column as f64 + cell.x) / f64::from(image.width());
    let phi = (s - 0.5) * TAU - f64::from(rotation);
    let (sin_phi, cos_phi) = float::sin_cos64(phi);
    let sin_theta = (1.0 - cos_theta * cos_theta).max(0.0).sqrt();
    let dir = Vec3::new((sin_theta * sin_phi) as f32, cos_theta as f32, (-sin_theta * cos_phi) as f32);
    (dir.normalize(), (cell.pmf / texel_angle(image, cell.row)) as f32)
}

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

/// What is left of the weights of texels once each has lost the mean.
fn weights_over_mean(image: &Image, weights: &[f64]) -> Vec<f64> {
    let mean = weights.iter().sum::<f64>() / (4.0 * PI);
    let rows = (0..).zip(weights.chunks(image.width() as usize));
    rows.flat_map(|(y, row)| {
        let angle = texel_angle(image, y);
        // A sky of one colour is above its mean by rounding alone.
        row.iter()
            .map(move |weight| weight - mean * angle)
            .map(move |w| if w > 1e-9 * mean * angle { w } else { 0.0 })
    })
    .collect()
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
