//! Is the difference between two pictures noise, or is one of them wrong? (Jung, Hanika, Dachsbacher 2020)
//!
//! For every tile and channel Welch's test asks how likely such a difference is between two unbiased renders. If both
//! are right, the p-values lie evenly in [0, 1]; a crowd near 0 is a bug.
//!
//! How far a tile's mean may be off is told by whole independent streams, for its pixels may share photons or parts of
//! their paths.

use super::statistics::{crowded_p, student_two_sided, uniform_p};
use crate::math::Rgb;
use crate::output::Picture;
use crate::render::film::{ERROR_TILE, STREAMS};

/// The side of a tile in pixels.
pub const TILE: usize = ERROR_TILE as usize;
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

/// Tests two pictures of the same size; `None` unless both know the standard errors of their tiles and of the whole.
pub fn test(a: &Picture, b: &Picture) -> Option<Welch> {
    let sides = [Side::of(a)?, Side::of(b)?];
    let (width, height) = (a.width as usize, a.height as usize);
    let tiles_per_row = width.div_ceil(TILE);
    let mut tiles = Vec::new();
    let mut by_channel = [Vec::new(), Vec::new(), Vec::new()];
    for y in (0..height).step_by(TILE) {
        for x in (0..width).step_by(TILE) {
            let p = [0, 1, 2].map(|channel| {
                let [a, b] = [&sides[0], &sides[1]].map(|side| side.tile([x, y], channel));
                a.p(&b)
            });
            p.iter().zip(&mut by_channel).for_each(|(p, channel)| channel.extend(p));
            tiles.push(p.iter().flatten().copied().fold(1.0, f64::min));
        }
    }

    let wholes = [0, 1, 2].map(|channel| [&sides[0], &sides[1]].map(|side| side.whole(channel)));
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
        whole_p: least(wholes.map(|[a, b]| a.p(&b).unwrap_or(1.0))),
        ratio: wholes.map(|[a, b]| a.mean / b.mean),
        tiles,
        tiles_per_row,
    })
}

/// The probability that the least of three would be as small.
fn least(p: [f64; 3]) -> f64 {
    1.0 - (1.0 - p.into_iter().fold(1.0, f64::min)).powi(3)
}

/// One of the pictures, with what it knows of its noise.
struct Side<'a> {
    picture: &'a Picture,
    tile_error: &'a [Rgb],
    whole_error: [f64; 3],
    dof: f64,
}

impl<'a> Side<'a> {
    fn of(picture: &'a Picture) -> Option<Self> {
        let tile_error = picture.tile_error.as_deref()?;
        let numbers = picture.fact("whole_error")?.split_whitespace().map(|word| word.parse().ok());
        let whole_error = numbers.collect::<Option<Vec<f64>>>()?.try_into().ok()?;
        Some(Self { picture, tile_error, whole_error, dof: streams_less_one(picture) })
    }

    /// The tile whose upper left pixel is at column `x` and row `y`.
    fn tile(&self, [x, y]: [usize; 2], channel: usize) -> Mean {
        let (width, height) = (self.picture.width as usize, self.picture.height as usize);
        let (right, bottom) = ((x + TILE).min(width), (y + TILE).min(height));
        let pixels = (y..bottom).flat_map(|y| (x..right).map(move |x| y * width + x));
        let error = f64::from(self.tile_error[y * width + x][channel]);
        self.mean(pixels, error, channel)
    }

    fn whole(&self, channel: usize) -> Mean {
        self.mean(0..self.picture.radiance.len(), self.whole_error[channel], channel)
    }

    fn mean(&self, pixels: impl Iterator<Item = usize>, error: f64, channel: usize) -> Mean {
        let mut count = 0.0;
        let sum: f64 =
            pixels.inspect(|_| count += 1.0).map(|i| f64::from(self.picture.radiance[i][channel])).sum();
        Mean { mean: sum / count, variance: error * error, dof: self.dof }
    }
}

/// The degrees of freedom of a standard error: independent streams less one, eight where the file says nothing.
fn streams_less_one(picture: &Picture) -> f64 {
    let passes = picture.fact("passes").and_then(|passes| passes.parse::<u32>().ok());
    f64::from(passes.unwrap_or(STREAMS).clamp(2, STREAMS) - 1)
}

/// A mean over pixels.
#[derive(Clone, Copy)]
struct Mean {
    mean: f64,
    /// Of the mean, estimated with so many degrees of freedom.
    variance: f64,
    dof: f64,
}

impl Mean {
    /// The p-value of the difference (Welch 1947, degrees of freedom by Satterthwaite 1946); `None` where there is no noise
    /// and no difference.
    fn p(&self, other: &Self) -> Option<f64> {
        let difference = self.mean - other.mean;
        let variance = self.variance + other.variance;
        if variance == 0.0 {
            return (difference != 0.0).then_some(0.0);
        }
        let dof = variance * variance
            / (self.variance * self.variance / self.dof + other.variance * other.variance / other.dof);
        Some(student_two_sided(difference / variance.sqrt(), dof))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::film::{Film, Region, Tile};
    use crate::render::sampler::{Dim, Sampler};

    /// A film of independent samples, uniform in [0, 2), times `gain`.
    fn noisy(seed: u64, passes: u32, gain: f32) -> Picture {
        noisy_in_squares(seed, passes, gain, 1)
    }

    /// The same, with one sample for each square of `side` × `side` pixels.
    fn noisy_in_squares(seed: u64, passes: u32, gain: f32, side: u32) -> Picture {
        let region = Region { x: 0, y: 0, width: 96, height: 80 };
        let mut film = Film::new(region);
        for pass in 0..passes {
            let sample = |[x, y]: [u32; 2]| {
                let draw = |channel: u32| {
                    Sampler::new(seed, pass * 3 + channel, u64::from(y / side * 1000 + x / side), 0)
                };
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
            tile_error: film.tile_errors().map(|errors| errors.into_iter().map(Rgb::from).collect()),
            is_display: false,
            facts: vec![
                ("passes".to_owned(), passes.to_string()),
                (
                    "whole_error".to_owned(),
                    film.whole_error().unwrap().map(|error| error.to_string()).join(" "),
                ),
            ],
        }
    }

    #[test]
    fn two_seeds_of_the_same_differ_by_noise_alone() {
        for (passes, seed) in [(64, 5), (8, 2), (4, 3)] {
            let welch = test(&noisy(seed, passes, 1.0), &noisy(seed + 100, 2 * passes, 1.0)).unwrap();
            assert_eq!(welch.tests, 3 * 12 * 10);
            assert!(welch.uniform_p > 0.01, "{passes} passes: p-values are crowded, {}", welch.uniform_p);
            assert!(!welch.differs(), "{passes} passes: {welch:?}");
        }
    }

    #[test]
    fn noise_that_neighbours_share_is_noise() {
        for seed in 1..=3 {
            let [a, b] = [seed, seed + 100].map(|seed| noisy_in_squares(seed, 64, 1.0, 4));
            let welch = test(&a, &b).unwrap();
            assert!(welch.uniform_p > 0.01 && !welch.differs(), "{welch:?}");
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
            Picture {
                width: 10,
                height: 10,
                radiance: pixels,
                standard_error: Some(vec![Rgb::BLACK; 100]),
                tile_error: Some(vec![Rgb::BLACK; 100]),
                is_display: false,
                facts: vec![("whole_error".to_owned(), "0 0 0".to_owned())],
            }
        };
        let same = test(&exact(1.0), &exact(1.0)).unwrap();
        assert!(same.tests == 0 && !same.differs());
        assert!(test(&exact(1.0), &exact(1.5)).unwrap().differs());
    }
}
