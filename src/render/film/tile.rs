//! How far means over many pixels may be from the truth: those of tiles, and that of the whole picture.
//!
//! Neighbours may share photons or parts of their paths, so that their errors go together and do not average out as
//! independent ones would. Streams share nothing: the spread of their means over the same pixels has all of it.

use super::{Film, Region};

/// The side of the tiles whose standard error a picture can hold, in pixels.
pub const ERROR_TILE: u32 = 8;

impl Film {
    /// For each pixel and channel, the standard error of the mean over the tile of 8 × 8 pixels that it lies in, counted
    /// from the film's first pixel; `None` below two passes.
    pub fn tile_errors(&self) -> Option<Vec<[f32; 3]>> {
        let mut errors = vec![[0.0; 3]; self.region.area()];
        let to_first = |at: u32| (ERROR_TILE - at % ERROR_TILE) % ERROR_TILE;
        for tile in self.region.tiles(ERROR_TILE, [self.region.x, self.region.y].map(to_first)) {
            let error = self.error_of_mean(tile)?.map(|error| error as f32);
            tile.pixels().filter_map(|pixel| self.region.index_of(pixel)).for_each(|i| errors[i] = error);
        }
        Some(errors)
    }

    /// The standard error of the mean over all pixels, for each channel; `None` below two passes.
    pub fn whole_error(&self) -> Option<[f64; 3]> {
        self.error_of_mean(self.region)
    }

    /// √(Σ nₛ (xₛ − x)² / ((S − 1) N)), as for a pixel, with xₛ the mean of stream s over all pixels of `region`.
    fn error_of_mean(&self, region: Region) -> Option<[f64; 3]> {
        if self.streams.len() < 2 {
            return None;
        }
        let sums = self.streams.iter().map(|sums| {
            let indices = || region.pixels().filter_map(|pixel| self.region.index_of(pixel));
            let of = |c: usize| indices().map(|i| sums[i][c]).sum::<f64>();
            [0, 1, 2].map(of)
        });
        let sums: Vec<[f64; 3]> = sums.collect();
        let (passes, area) = (f64::from(self.passes), region.area() as f64);
        Some([0, 1, 2].map(|c| {
            let mean = sums.iter().map(|sum| sum[c]).sum::<f64>() / passes;
            let deviations = (0..).zip(&sums).map(|(stream, sum)| {
                let count = f64::from(self.passes_of(stream));
                count * (sum[c] / count - mean).powi(2)
            });
            let freedom = (sums.len() - 1) as f64;
            (deviations.sum::<f64>() / (freedom * passes)).sqrt() / area
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::noisy;

    /// The mean over seeds of the estimated variance of the whole picture's mean, times pixels and passes.
    fn scaled_variance(shared: bool) -> f64 {
        let variance = |seed| noisy(seed, 16, shared).whole_error().expect("16 passes")[0].powi(2);
        (0..40).map(variance).sum::<f64>() / 40.0 * 16.0 * 2000.0
    }

    #[test]
    fn shared_noise_does_not_average_out() {
        let (apart, shared) = (scaled_variance(false), scaled_variance(true));
        // Of 40 estimates with 7 degrees of freedom each: within 12 % at two deviations.
        assert!((apart - 1.0).abs() < 0.25, "{apart}");
        assert!((shared / 25.0 - 1.0).abs() < 0.25, "squares of 25 pixels are one sample: {shared}");
    }

    #[test]
    fn a_tile_has_the_error_of_its_mean() {
        let film = noisy(3, 64, false);
        let errors = film.tile_errors().expect("64 passes");
        assert_eq!(errors[0], errors[7 * 50 + 7]);
        assert_ne!(errors[0], errors[8]);
        let mean = errors.iter().map(|error| f64::from(error[0]).powi(2)).sum::<f64>() / errors.len() as f64;
        // Tiles at the right edge have 16 pixels, all others 64.
        let expected = (48.0 / 64.0 + 2.0 / 16.0) / 50.0 / 64.0;
        assert!((mean / expected - 1.0).abs() < 0.25, "{mean} for {expected}");
    }
}
