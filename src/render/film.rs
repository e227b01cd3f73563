//! The film: what all passes saw, and how far the mean may be from the truth.
//!
//! Passes take turns among up to [`STREAMS`] streams whose random numbers are independent of each other. Sums are kept
//! for each stream, so that the spread between streams tells the error: the points within one stream are spread evenly
//! on purpose, and their own spread would overstate it.

mod blur;
mod error;
mod margin;
mod tile;

use crate::math::Rgb;
use blur::Blur;
pub use blur::BlurBounds;
pub use error::ErrorEstimate;
pub use tile::ERROR_TILE;

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

    /// The squares of `side` pixels that hold a part of the region, from a grid that starts `shift` (each below `side`)
    /// to the left of the picture and above it; cut off at those edges.
    pub fn squares(self, side: u32, shift: [u32; 2]) -> impl Iterator<Item = Self> {
        let cuts = move |start: u32, end: u32, shift: u32| {
            ((start + shift) / side..(end + shift).div_ceil(side)).map(move |i| {
                let from = (i * side).saturating_sub(shift);
                (from, (i + 1) * side - shift - from)
            })
        };
        let columns = move || cuts(self.x, self.x + self.width, shift[0]);
        cuts(self.y, self.y + self.height, shift[1])
            .flat_map(move |(y, height)| columns().map(move |(x, width)| Self { x, y, width, height }))
    }

    /// The parts of the region that lie in such squares.
    pub fn tiles(self, side: u32, shift: [u32; 2]) -> impl Iterator<Item = Self> {
        self.squares(side, shift).map(move |square| square.clipped(&self))
    }

    /// Where a pixel of the picture stands among those of the region; `None` outside.
    pub fn index_of(&self, [x, y]: [u32; 2]) -> Option<usize> {
        let (column, row) = (x.checked_sub(self.x)?, y.checked_sub(self.y)?);
        (column < self.width && row < self.height)
            .then(|| row as usize * self.width as usize + column as usize)
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
    /// For photons: what their passes say about blur.
    blur: Option<Blur>,
    bad_count: u64,
    bad_samples: Vec<BadSample>,
}

impl Film {
    /// A film that has seen nothing yet.
    pub fn new(region: Region) -> Self {
        Self { region, streams: Vec::new(), passes: 0, blur: None, bad_count: 0, bad_samples: Vec::new() }
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
        self.add_blurred_pass(tiles, 0.0);
    }

    /// Adds a pass of photons, gathered from discs whose squared radius is `blur` times that of the first pass. 0: of no
    /// photons. A film whose first pass had none has none.
    pub fn add_blurred_pass(&mut self, tiles: &[Tile], blur: f64) {
        let (pass, pixels) = (self.passes, self.region.area());
        if pass == 0 && blur > 0.0 {
            self.blur = Some(Blur::default());
        }
        if let Some(sums) = &mut self.blur {
            sums.begin_pass(pass, blur, pixels);
        }
        let stream = (self.passes % STREAMS) as usize;
        if self.streams.len() == stream {
            self.streams.push(vec![[0.0; 3]; self.region.area()]);
        }
        for tile in tiles {
            for (pixel, &sample) in tile.region.pixels().zip(&tile.samples) {
                if sample.is_finite() {
                    let Some(index) = self.region.index_of(pixel) else { continue };
                    let sum = &mut self.streams[stream][index];
                    let sample = sample.to_array().map(f64::from);
                    *sum = [0, 1, 2].map(|channel| sum[channel] + sample[channel]);
                    if let Some(sums) = &mut self.blur {
                        sums.add(pass, blur, index, sample);
                    }
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

    fn note_bad(&mut self, pixel: [u32; 2]) {
        self.bad_count += 1;
        if self.bad_samples.len() < KEPT_BAD_SAMPLES {
            self.bad_samples.push(BadSample { pixel, pass: self.passes });
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::math::float;
    use crate::render::sampler::{Dim, Sampler};

    const REGION: Region = Region { x: 3, y: 5, width: 50, height: 40 };

    /// A film of independent samples whose probability falls exponentially, as that of light does: mean and variance 1.
    fn noisy_film(passes: u32) -> Film {
        noisy(1, passes, false)
    }

    /// The same; if `shared`, each square of 5 × 5 pixels has one sample for all, as photons are.
    pub fn noisy(seed: u64, passes: u32, shared: bool) -> Film {
        let mut film = Film::new(REGION);
        for pass in 0..passes {
            let sample = |[x, y]: [u32; 2]| {
                let [x, y] = if shared { [x / 5, y / 5] } else { [x, y] };
                let item = u64::from(x) << 32 | u64::from(y);
                Rgb::gray(-float::ln(1.0 - Sampler::new(seed, pass, item, 0).get_1d(Dim::Filter)))
            };
            let tiles = REGION.tiles(16, [0, 0]);
            let tiles: Vec<Tile> =
                tiles.map(|region| Tile { region, samples: region.pixels().map(sample).collect() }).collect();
            film.add_pass(&tiles);
        }
        film
    }

    #[test]
    fn squares_hold_each_pixel_once_wherever_their_grid_lies() {
        for side in [1, 4, 16] {
            for shift in [[0, 0], [side / 2, side / 4], [side - 1, side - 1]] {
                let mut indices: Vec<_> = REGION
                    .tiles(side, shift)
                    .flat_map(Region::pixels)
                    .filter_map(|pixel| REGION.index_of(pixel))
                    .collect();
                indices.sort_unstable();
                assert!(indices.into_iter().eq(0..REGION.area()), "{side} {shift:?}");
            }
        }
    }

    #[test]
    fn the_estimated_variance_is_that_of_the_mean() {
        for passes in [2, 5, 8, 20, 64] {
            let variance = noisy_film(passes).variance().expect("two passes or more");
            let mean = variance.iter().map(|v| f64::from(v.r)).sum::<f64>() / variance.len() as f64;
            let expected = 1.0 / f64::from(passes);
            assert!((mean / expected - 1.0).abs() < 0.1, "{passes} passes: {mean} for {expected}");
        }
    }

    /// √relMSE of a film of `noisy_film`, whose truth is 1 everywhere.
    fn true_error(film: &Film) -> f64 {
        let mean = film.mean();
        let terms = mean.iter().map(|x| f64::from((x.r - 1.0) * (x.r - 1.0)) / 1.01);
        (terms.sum::<f64>() / mean.len() as f64).sqrt()
    }

    #[test]
    fn the_interval_of_the_error_holds_the_truth() {
        // Of 60 intervals of 95 %, 51 or more hold the truth with probability 0.999; caution may make it all.
        for (passes, shared) in [(64, false), (12, false), (8, true)] {
            let holds = (0..60).filter(|&seed| {
                let film = noisy(seed, passes, shared);
                let (low, high) = film.error().and_then(|e| e.interval).expect("four passes or more");
                (low..high).contains(&true_error(&film))
            });
            let count = holds.count();
            assert!(count >= 51, "{passes} passes, noise shared: {shared}: {count} of 60");
        }
    }

    #[test]
    fn of_even_noise_the_worst_pixels_hold_little() {
        let estimate = noisy_film(64).error().expect("64 passes");
        assert!((0.0005..0.02).contains(&estimate.firefly_share()), "{}", estimate.firefly_share());
        assert!(noisy_film(1).error().is_none());
        assert!(noisy_film(3).error().is_some_and(|estimate| estimate.interval.is_none()));
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
