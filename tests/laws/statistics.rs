//! Tests of significance.

use std::f64::consts::{PI, SQRT_2};

use snell::math::{Vec2, Vec3};
use snell::render::sampler::{Dim, Sampler};

/// The chance that a right program fails one of `tests` equal tests is one percent (Šidák 1967).
pub fn significance(tests: usize) -> f64 {
    1.0 - 0.99_f64.powf(1.0 / tests as f64)
}

/// `n` points of the unit square that are spread evenly, the same in every run.
pub fn points(n: u32) -> impl Iterator<Item = (Vec2, f32)> {
    let sampler = |i| Sampler::new(0xc0ffee, 0, 0, i);
    (0..n).map(move |i| (sampler(i).get_2d(Dim::Bsdf(0)), sampler(i).get_1d(Dim::Lobe(0))))
}

/// `n` independent points of the unit square, as the chi-square test asks for.
pub fn independent_points(n: u32) -> impl Iterator<Item = (Vec2, f32)> {
    let sampler = |i| Sampler::new(0xdecaf, 0, i, 0);
    (0..u64::from(n)).map(move |i| (sampler(i).get_2d(Dim::Bsdf(0)), sampler(i).get_1d(Dim::Lobe(0))))
}

/// Bins over the upper hemisphere, equal steps in polar angle and azimuth.
pub const ROWS: usize = 20;
pub const COLUMNS: usize = 40;

/// The bin that a direction falls into; `None` below the horizon.
pub fn bin(w: Vec3) -> Option<usize> {
    let theta = f64::from(w.z).clamp(-1.0, 1.0).acos();
    let phi = f64::from(w.y).atan2(f64::from(w.x)).rem_euclid(2.0 * PI);
    let row = (theta / (0.5 * PI) * ROWS as f64) as usize;
    let column = ((phi / (2.0 * PI) * COLUMNS as f64) as usize).min(COLUMNS - 1);
    (w.z >= 0.0).then(|| row.min(ROWS - 1) * COLUMNS + column)
}

/// The integral of a density over each bin, by the midpoint rule with `side × side` points a bin.
pub fn integrate_bins(side: usize, pdf: impl Fn(Vec3) -> f32) -> Vec<f64> {
    let (d_theta, d_phi) = (0.5 * PI / (ROWS * side) as f64, 2.0 * PI / (COLUMNS * side) as f64);
    let mut bins = vec![0.0; ROWS * COLUMNS];
    for i in 0..ROWS * side {
        let (sin_theta, cos_theta) = ((i as f64 + 0.5) * d_theta).sin_cos();
        for j in 0..COLUMNS * side {
            let (sin_phi, cos_phi) = ((j as f64 + 0.5) * d_phi).sin_cos();
            let w = Vec3::new((sin_theta * cos_phi) as f32, (sin_theta * sin_phi) as f32, cos_theta as f32);
            bins[i / side * COLUMNS + j / side] += f64::from(pdf(w)) * sin_theta * d_theta * d_phi;
        }
    }
    bins
}

/// The probability of counts at least as far from `expected` as these, were that their distribution.
///
/// Bins that expect fewer than 5 are pooled (Pearson 1900; Cochran 1954).
pub fn chi_square(counts: &[f64], expected: &[f64]) -> f64 {
    let (mut pooled_count, mut pooled_expected) = (0.0, 0.0);
    let (mut chi2, mut bins) = (0.0, 0_i32);
    let mut add = |count: f64, expected: f64| {
        chi2 += (count - expected) * (count - expected) / expected;
        bins += 1;
    };
    for (&count, &expected) in counts.iter().zip(expected) {
        if expected >= 5.0 {
            add(count, expected);
        } else {
            pooled_count += count;
            pooled_expected += expected;
        }
    }
    if pooled_expected >= 5.0 {
        add(pooled_count, pooled_expected);
    }
    upper_tail(chi2, f64::from(bins - 1))
}

/// The upper tail of the chi-square distribution (Wilson & Hilferty 1931).
fn upper_tail(chi2: f64, freedom: f64) -> f64 {
    let v = 2.0 / (9.0 * freedom);
    let z = ((chi2 / freedom).cbrt() - (1.0 - v)) / v.sqrt();
    0.5 * libm::erfc(z / SQRT_2)
}
