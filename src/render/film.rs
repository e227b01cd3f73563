//! The film: what all passes saw, and how far the mean may be from the truth.
//!
//! Passes take turns among up to [`STREAMS`] streams whose random numbers are independent of each other. Sums are kept
//! for each stream, so that the spread between streams tells the error: the points within one stream are spread evenly
//! on purpose, and their own spread would overstate it.

use crate::math::Rgb;

/// The number of independent streams.
pub const STREAMS: u32 = 8;

/// How many bad samples are kept with their place.
const KEPT_BAD_SAMPLES: usize = 16;

/// A rectangle of pixels, counted from the top left of the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Region {
    /// The first column.
    pub x: u32,
    /// The first row.
    pub y: u32,
    /// The number of columns.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
}

impl Region {
    /// The number of pixels.
    pub fn area(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Squares of `side` pixels that cover the region, smaller at its right and lower edges, row by row.
    pub fn tiles(&self, side: u32) -> Vec<Self> {
        let mut tiles = Vec::new();
        for y in (0..self.height).step_by(side as usize) {
            for x in (0..self.width).step_by(side as usize) {
                let (width, height) = (side.min(self.width - x), side.min(self.height - y));
                tiles.push(Self { x: self.x + x, y: self.y + y, width, height });
            }
        }
        tiles
    }

    /// The pixels, row by row.
    pub fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        (self.y..self.y + self.height).flat_map(move |y| (self.x..self.x + self.width).map(move |x| [x, y]))
    }

    /// The part that lies within another region.
    pub fn clipped(&self, to: &Self) -> Self {
        let (x, y) = (self.x.max(to.x), self.y.max(to.y));
        let width = (self.x + self.width).min(to.x + to.width).saturating_sub(x);
        let height = (self.y + self.height).min(to.y + to.height).saturating_sub(y);
        Self { x, y, width, height }
    }
}

/// A sample that was not a radiance: infinite, negative, or not a number. It counts as 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct BadSample {
    /// Column and row.
    pub pixel: [u32; 2],
    /// The pass that drew it.
    pub pass: u32,
}

/// One sample for every pixel of a tile.
pub struct Tile {
    /// Where it lies.
    pub region: Region,
    /// Radiances by their weights, row by row; what is not finite counts as bad.
    pub samples: Vec<Rgb>,
}

/// Sums of radiance for each pixel and stream.
pub struct Film {
    region: Region,
    /// `height × width` sums for each stream that has seen a pass, top row first.
    streams: Vec<Vec<[f64; 3]>>,
    passes: u32,
    bad_count: u64,
    bad_samples: Vec<BadSample>,
}

/// The estimated error of the mean picture, as √relMSE; 0.01 is one percent.
///
/// relMSE is the mean over pixels and channels of variance / (r² + 0.01 m²), with r the pixel and m the mean luminance.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ErrorEstimate {
    /// √relMSE.
    pub error: f64,
    /// The lower end of its 95 % interval.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// √relMSE without the worst 0.1 % of pixels.
    pub trimmed: f64,
}

impl Film {
    /// A film that has seen nothing yet.
    pub fn new(region: Region) -> Self {
        Self { region, streams: Vec::new(), passes: 0, bad_count: 0, bad_samples: Vec::new() }
    }

    /// The part of the picture that the film covers.
    pub fn region(&self) -> Region {
        self.region
    }

    /// The number of passes seen: one sample a pixel each.
    pub fn passes(&self) -> u32 {
        self.passes
    }

    /// How many samples were bad.
    pub fn bad_count(&self) -> u64 {
        self.bad_count
    }

    /// The first bad samples.
    pub fn bad_samples(&self) -> &[BadSample] {
        &self.bad_samples
    }

    /// Adds a whole pass, tile by tile in their order.
    pub fn add_pass(&mut self, tiles: &[Tile]) {
        let stream = (self.passes % STREAMS) as usize;
        if self.streams.len() == stream {
            self.streams.push(vec![[0.0; 3]; self.region.area()]);
        }
        for tile in tiles {
            for (pixel, &sample) in tile.region.pixels().zip(&tile.samples) {
                if sample.is_finite() {
                    let index = self.index(pixel);
                    let sum = &mut self.streams[stream][index];
                    *sum = [0, 1, 2].map(|channel| sum[channel] + f64::from(sample[channel]));
                } else {
                    self.note_bad(pixel);
                }
            }
        }
        self.passes += 1;
    }

    /// The mean radiance of each pixel, `height × width`, top row first.
    pub fn mean(&self) -> Vec<Rgb> {
        (0..self.region.area()).map(|i| Rgb::from(self.mean_of(i).map(|x| x as f32))).collect()
    }

    /// The variance of each pixel's mean, from the spread between streams; `None` below two passes.
    pub fn variance(&self) -> Option<Vec<Rgb>> {
        let pixels = 0..self.region.area();
        (self.streams.len() > 1)
            .then(|| pixels.map(|i| Rgb::from(self.variance_of(i).map(|x| x as f32))).collect())
    }

    /// The error of the mean picture; `None` below two passes and for a film without pixels.
    pub fn error(&self) -> Option<ErrorEstimate> {
        let n = self.region.area();
        if self.streams.len() < 2 || n == 0 {
            return None;
        }
        let luminance = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let mean = (0..n).map(|i| luminance(self.mean_of(i))).sum::<f64>() / n as f64;
        let mut terms: Vec<f64> = (0..n).map(|i| self.relative_error_of(i, mean)).collect();

        let sum: f64 = terms.iter().sum();
        let rel_mse = sum / n as f64;
        let spread = terms.iter().map(|term| (term - rel_mse) * (term - rel_mse)).sum::<f64>();
        let half_interval = 1.96 * spread.sqrt() / n as f64;

        // The worst pixels come last; the sum of the others, in the order of their values, is the trimmed one.
        terms.sort_unstable_by(f64::total_cmp);
        let kept = n - n / 1000;
        let trimmed = terms[..kept].iter().sum::<f64>() / kept as f64;
        Some(ErrorEstimate {
            error: rel_mse.sqrt(),
            low: (rel_mse - half_interval).max(0.0).sqrt(),
            high: (rel_mse + half_interval).sqrt(),
            trimmed: trimmed.sqrt(),
        })
    }

    /// The mean over channels of variance / (r² + 0.01 m²); 0 in a black picture.
    fn relative_error_of(&self, index: usize, mean_luminance: f64) -> f64 {
        let (r, variance) = (self.mean_of(index), self.variance_of(index));
        let term = |channel: usize| {
            let scale = r[channel] * r[channel] + 0.01 * mean_luminance * mean_luminance;
            if variance[channel] > 0.0 { variance[channel] / scale } else { 0.0 }
        };
        (term(0) + term(1) + term(2)) / 3.0
    }

    fn mean_of(&self, index: usize) -> [f64; 3] {
        let count = f64::from(self.passes.max(1));
        [0, 1, 2].map(|channel| self.streams.iter().map(|sums| sums[index][channel]).sum::<f64>() / count)
    }

    /// Σ nₛ (xₛ − x)² / ((S − 1) N), with xₛ the mean of the nₛ samples of stream s and x that of all N.
    fn variance_of(&self, index: usize) -> [f64; 3] {
        let mean = self.mean_of(index);
        let scale = (self.streams.len() as f64 - 1.0) * f64::from(self.passes);
        [0, 1, 2].map(|channel| {
            let deviations = (0..).zip(&self.streams).map(|(stream, sums)| {
                let count = f64::from(self.passes_of(stream));
                let deviation = sums[index][channel] / count - mean[channel];
                count * deviation * deviation
            });
            deviations.sum::<f64>() / scale
        })
    }

    /// How many passes a stream has seen.
    fn passes_of(&self, stream: u32) -> u32 {
        (self.passes + STREAMS - 1 - stream) / STREAMS
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        (y - self.region.y) as usize * self.region.width as usize + (x - self.region.x) as usize
    }

    fn note_bad(&mut self, pixel: [u32; 2]) {
        self.bad_count += 1;
        if self.bad_samples.len() < KEPT_BAD_SAMPLES {
            self.bad_samples.push(BadSample { pixel, pass: self.passes });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::sampler::{Dim, Sampler};

    const REGION: Region = Region { x: 3, y: 5, width: 50, height: 40 };

    /// A film of independent samples, uniform in [0, 2): mean 1, variance 1/3.
    fn noisy_film(passes: u32) -> Film {
        let mut film = Film::new(REGION);
        for pass in 0..passes {
            let sample = |[x, y]: [u32; 2]| {
                let item = u64::from(x) << 32 | u64::from(y);
                Rgb::gray(2.0 * Sampler::new(1, pass, item, 0).get_1d(Dim::Filter))
            };
            let tiles = REGION.tiles(16).into_iter();
            let tiles: Vec<Tile> =
                tiles.map(|region| Tile { region, samples: region.pixels().map(sample).collect() }).collect();
            film.add_pass(&tiles);
        }
        film
    }

    #[test]
    fn tiles_cover_each_pixel_once() {
        let mut pixels: Vec<_> = REGION.tiles(16).into_iter().flat_map(Region::pixels).collect();
        pixels.sort_by_key(|&[x, y]| (y, x));
        assert!(pixels.into_iter().eq(REGION.pixels()));
    }

    #[test]
    fn the_estimated_variance_is_that_of_the_mean() {
        for passes in [2, 5, 8, 20, 64] {
            let variance = noisy_film(passes).variance().expect("two passes or more");
            let mean = variance.iter().map(|v| f64::from(v.r)).sum::<f64>() / variance.len() as f64;
            let expected = 1.0 / 3.0 / f64::from(passes);
            assert!((mean / expected - 1.0).abs() < 0.1, "{passes} passes: {mean} for {expected}");
        }
    }

    #[test]
    fn the_interval_of_the_error_holds_the_truth() {
        let film = noisy_film(64);
        let estimate = film.error().expect("64 passes");
        let mean = film.mean();
        let terms = mean.iter().map(|x| f64::from((x.r - 1.0) * (x.r - 1.0)) / 1.01);
        let truth = (terms.sum::<f64>() / mean.len() as f64).sqrt();
        assert!(estimate.low < truth && truth < estimate.high, "{estimate:?}, true {truth}");
        assert!(estimate.trimmed < estimate.error);
        assert!(noisy_film(1).error().is_none());
    }

    #[test]
    fn bad_samples_are_counted_and_do_not_spread() {
        let region = Region { x: 0, y: 0, width: 5, height: 8 };
        let mut film = Film::new(region);
        film.add_pass(&[Tile { region, samples: vec![Rgb::WHITE; 40] }]);
        let mut samples = vec![Rgb::new(1.0, f32::NAN, 1.0); 40];
        samples[7] = Rgb::gray(3.0);
        film.add_pass(&[Tile { region, samples }]);
        assert_eq!(film.bad_count(), 39);
        assert_eq!(film.bad_samples().len(), 16);
        assert_eq!(film.bad_samples()[7], BadSample { pixel: [3, 1], pass: 1 });
        assert_eq!(film.mean()[7], Rgb::gray(2.0));
        assert_eq!(film.mean()[8], Rgb::gray(0.5));
    }
}
