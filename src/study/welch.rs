//! Is the difference between two pictures noise, or is one of them wrong? (Jung, Hanika, Dachsbacher 2020)
//!
//! For every tile and channel Welch's test asks how likely such a difference is between two unbiased renders. If both
//! are right, the p-values lie evenly in [0, 1]; a crowd near 0 is a bug.

use super::statistics::{crowded_p, student_two_sided, uniform_p};
use crate::output::Picture;

/// The side of a tile in pixels.
pub const TILE: usize = 8;
/// Bars of the histogram.
pub const BARS: usize = 20;
/// The level of the whole test.
const LEVEL: f64 = 0.01;

/// What the test found.
#[derive(Clone, PartialEq, Debug)]
pub struct Welch {
    /// Tests made: one for each tile and channel with any noise.
    pub tests: usize,
    /// How many reject at 1 % for all of them together, by Šidák's correction.
    pub rejected: usize,
    /// How many p-values lie in each twentieth of [0, 1].
    pub histogram: [usize; BARS],
    /// How likely such p-values are if both pictures are right: Kolmogorov–Smirnov, the least of three channels after
    /// Šidák's correction.
    pub uniform_p: f64,
    /// How likely it is that they crowd near 0 as much: the same test, to one side.
    pub crowded_p: f64,
    /// How likely the difference of the whole pictures' means is, the least of three channels after Šidák's correction.
    pub whole_p: f64,
    /// The mean of the picture over that of the reference, for each channel.
    pub ratio: [f64; 3],
    /// The p-value of each tile, the least of its channels, row by row.
    pub tiles: Vec<f64>,
    /// Tiles in a row.
    pub tiles_per_row: usize,
}

impl Welch {
    /// Whether the difference is more than noise.
    pub fn differs(&self) -> bool {
        self.rejected > 0 || self.crowded_p < LEVEL || self.whole_p < LEVEL
    }
}

/// Tests two pictures of the same size; `None` unless both know their standard error.
///
/// Assumes that the noise of neighbouring pixels is independent, which is so for paths; photons are shared.
pub fn test(a: &Picture, b: &Picture) -> Option<Welch> {
    let (error_a, error_b) = (a.standard_error.as_ref()?, b.standard_error.as_ref()?);
    let dof = [a, b].map(streams_less_one);
    let (width, height) = (a.width as usize, a.height as usize);
    let sum_of = |pixels: &mut dyn Iterator<Item = usize>, channel: usize| {
        let mut sum = Sum::default();
        for i in pixels {
            let values = [a.radiance[i], b.radiance[i]].map(|pixel| f64::from(pixel[channel]));
            let errors = [error_a[i], error_b[i]].map(|pixel| f64::from(pixel[channel]));
            sum.add(values, errors, dof);
        }
        sum
    };

    let tiles_per_row = width.div_ceil(TILE);
    let mut tiles = Vec::new();
    let mut by_channel = [Vec::new(), Vec::new(), Vec::new()];
    for y in (0..height).step_by(TILE) {
        for x in (0..width).step_by(TILE) {
            let (right, bottom) = ((x + TILE).min(width), (y + TILE).min(height));
            let p = [0, 1, 2].map(|channel| {
                let mut pixels = (y..bottom).flat_map(|y| (x..right).map(move |x| y * width + x));
                sum_of(&mut pixels, channel).p()
            });
            p.iter().zip(&mut by_channel).for_each(|(p, channel)| channel.extend(p));
            tiles.push(p.iter().flatten().copied().fold(1.0, f64::min));
        }
    }

    let whole = [0, 1, 2].map(|channel| sum_of(&mut (0..width * height), channel));
    let all: Vec<f64> = by_channel.iter().flatten().copied().collect();
    let threshold = 1.0 - (1.0 - LEVEL).powf(1.0 / all.len().max(1) as f64);
    let mut histogram = [0; BARS];
    all.iter().for_each(|p| histogram[((p * BARS as f64) as usize).min(BARS - 1)] += 1);
    Some(Welch {
        tests: all.len(),
        rejected: all.iter().filter(|&&p| p < threshold).count(),
        histogram,
        uniform_p: least([0, 1, 2].map(|channel| uniform_p(&by_channel[channel]))),
        crowded_p: least([0, 1, 2].map(|channel| crowded_p(&by_channel[channel]))),
        whole_p: least(whole.map(|sum| sum.p().unwrap_or(1.0))),
        ratio: whole.map(|sum| sum.means[0] / sum.means[1]),
        tiles,
        tiles_per_row,
    })
}

/// The probability that the least of three would be as small.
fn least(p: [f64; 3]) -> f64 {
    1.0 - (1.0 - p.into_iter().fold(1.0, f64::min)).powi(3)
}

/// The degrees of freedom of a pixel's standard error: independent streams less one, eight where the file says nothing.
fn streams_less_one(picture: &Picture) -> f64 {
    let passes = picture.fact("passes").and_then(|passes| passes.parse::<u32>().ok());
    f64::from(passes.unwrap_or(8).clamp(2, 8) - 1)
}

/// Sums over pixels of two pictures.
#[derive(Clone, Copy, Default)]
struct Sum {
    means: [f64; 2],
    variance: f64,
    /// Σ v² / ν, for the degrees of freedom (Satterthwaite 1946).
    variance2: f64,
}

impl Sum {
    fn add(&mut self, values: [f64; 2], errors: [f64; 2], dof: [f64; 2]) {
        for side in 0..2 {
            let variance = errors[side] * errors[side];
            self.means[side] += values[side];
            self.variance += variance;
            self.variance2 += variance * variance / dof[side];
        }
    }

    /// The p-value; `None` where there is no noise and no difference.
    fn p(&self) -> Option<f64> {
        let difference = self.means[0] - self.means[1];
        if self.variance == 0.0 {
            return (difference != 0.0).then_some(0.0);
        }
        let dof = self.variance * self.variance / self.variance2;
        Some(student_two_sided(difference / self.variance.sqrt(), dof))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::render::film::{Film, Region, Tile};
    use crate::render::sampler::{Dim, Sampler};

    /// A film of independent samples, uniform in [0, 2), times `gain`.
    fn noisy(seed: u64, passes: u32, gain: f32) -> Picture {
        let region = Region { x: 0, y: 0, width: 96, height: 80 };
        let mut film = Film::new(region);
        for pass in 0..passes {
            let sample = |[x, y]: [u32; 2]| {
                let draw = |channel: u32| Sampler::new(seed, pass * 3 + channel, u64::from(y * 1000 + x), 0);
                Rgb::from([0, 1, 2].map(|channel| 2.0 * gain * draw(channel).get_1d(Dim::Filter)))
            };
            film.add_pass(&[Tile { region, samples: region.pixels().map(sample).collect() }]);
        }
        let variance = film.variance().unwrap();
        Picture {
            width: region.width,
            height: region.height,
            radiance: film.mean(),
            standard_error: Some(variance.iter().map(|v| v.map(f32::sqrt)).collect()),
            is_display: false,
            facts: vec![("passes".to_owned(), passes.to_string())],
        }
    }

    #[test]
    fn two_seeds_of_the_same_differ_by_noise_alone() {
        for (passes, seed) in [(64, 1), (8, 2), (4, 3)] {
            let welch = test(&noisy(seed, passes, 1.0), &noisy(seed + 100, 2 * passes, 1.0)).unwrap();
            assert_eq!(welch.tests, 3 * 12 * 10);
            assert!(welch.uniform_p > 0.01, "{passes} passes: p-values are crowded, {}", welch.uniform_p);
            assert!(!welch.differs(), "{passes} passes: {welch:?}");
        }
    }

    #[test]
    fn half_a_percent_of_energy_is_found() {
        let welch = test(&noisy(1, 128, 1.005), &noisy(2, 128, 1.0)).unwrap();
        assert!(welch.whole_p < 0.01 && welch.differs(), "{welch:?}");
        assert!(welch.ratio.iter().all(|ratio| (ratio - 1.005).abs() < 3e-3));
    }

    #[test]
    fn a_picture_does_not_differ_from_itself() {
        let welch = test(&noisy(1, 8, 1.0), &noisy(1, 8, 1.0)).unwrap();
        assert!(!welch.differs() && welch.uniform_p < 0.01, "{welch:?}");
    }

    #[test]
    fn pictures_without_noise_agree_or_do_not() {
        let exact = |level: f32| {
            let pixels = vec![Rgb::gray(level); 100];
            let standard_error = Some(vec![Rgb::BLACK; 100]);
            Picture {
                width: 10,
                height: 10,
                radiance: pixels,
                standard_error,
                is_display: false,
                facts: vec![],
            }
        };
        let same = test(&exact(1.0), &exact(1.0)).unwrap();
        assert!(same.tests == 0 && !same.differs());
        assert!(test(&exact(1.0), &exact(1.5)).unwrap().differs());
    }
}
