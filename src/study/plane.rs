//! One channel of a picture, and filters over it.

use rayon::prelude::*;

/// `height × width` values, top row first.
#[derive(Clone, PartialEq, Debug)]
pub struct Plane {
    /// Values in a row.
    pub width: usize,
    /// The values, row by row.
    pub values: Vec<f32>,
}

impl Plane {
    /// A plane of `f` at each index.
    pub fn from_fn(width: usize, count: usize, f: impl Fn(usize) -> f32) -> Self {
        Self { width, values: (0..count).map(f).collect() }
    }

    /// The number of rows.
    pub fn height(&self) -> usize {
        self.values.len() / self.width.max(1)
    }

    /// Filtered by `across` along rows, then by `down` along columns. Both have an odd length and are centred; beyond
    /// the border the value at the border goes on.
    ///
    /// Sums run in double precision, from the first weight to the last.
    pub fn filtered(&self, across: &[f64], down: &[f64]) -> Self {
        let (width, height) = (self.width, self.height());
        let mut rows = vec![0.0_f64; self.values.len()];
        rows.par_chunks_mut(width.max(1)).zip(self.values.par_chunks(width.max(1))).for_each(|(out, row)| {
            for (x, value) in out.iter_mut().enumerate() {
                *value = weighted(across, x, width, |x| f64::from(row[x]));
            }
        });
        let mut values = vec![0.0_f32; self.values.len()];
        values.par_chunks_mut(width.max(1)).enumerate().for_each(|(y, out)| {
            for (x, value) in out.iter_mut().enumerate() {
                *value = weighted(down, y, height, |y| rows[y * width + x]) as f32;
            }
        });
        Self { width, values }
    }
}

/// Σ weights · values around `at`, where places outside `0..count` mean the nearest inside.
fn weighted(weights: &[f64], at: usize, count: usize, value: impl Fn(usize) -> f64) -> f64 {
    let radius = weights.len() / 2;
    let places = (0..weights.len()).map(|i| (at + i).saturating_sub(radius).min(count - 1));
    places.zip(weights).map(|(place, weight)| weight * value(place)).sum()
}

/// The weights of a Gaussian of standard deviation `sigma`, from `−radius` to `radius`; their sum is 1.
pub fn gaussian(sigma: f64, radius: usize) -> Vec<f64> {
    let raw = tabulated(radius, |x| (-x * x / (2.0 * sigma * sigma)).exp());
    let sum: f64 = raw.iter().sum();
    raw.into_iter().map(|weight| weight / sum).collect()
}

/// `f` at the whole numbers from `−radius` to `radius`.
pub fn tabulated(radius: usize, f: impl Fn(f64) -> f64) -> Vec<f64> {
    let radius = radius as i64;
    (-radius..=radius).map(|x| f(x as f64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gaussian_keeps_an_even_plane_and_spreads_a_point() {
        let g = gaussian(1.5, 5);
        let even = Plane::from_fn(7, 21, |_| 0.375).filtered(&g, &g);
        assert!(even.values.iter().all(|x| (x - 0.375).abs() < 1e-7));
        let point = Plane::from_fn(31, 31 * 31, |i| if i == 15 * 31 + 15 { 1.0 } else { 0.0 });
        let spread = point.filtered(&g, &g);
        assert!((spread.values.iter().sum::<f32>() - 1.0).abs() < 1e-6);
        assert!((f64::from(spread.values[15 * 31 + 17]) - g[7] * g[5]).abs() < 1e-8);
    }
}
