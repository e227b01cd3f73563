//! Reconstruction filters: how samples spread about pixel centres.

use crate::math::{Vec2, float, warp};
use std::f32::consts::TAU;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The reconstruction filter. Samples are drawn in proportion to it, so that all weigh the same; where it is negative, in
/// proportion to its size, and they weigh by its sign.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Filter {
    /// Constant over a square.
    Box {
        /// Half its side, in pixels.
        radius: f32,
    },
    /// A pyramid.
    Tent {
        /// Half the side of its base, in pixels.
        radius: f32,
    },
    /// A bell whose standard deviation is a third of where it is cut off.
    Gaussian {
        /// The radius of the disk where it is cut off, in pixels.
        radius: f32,
    },
    /// The cubic of Mitchell & Netravali 1988 with B = C = 1/3 along each axis; sharpens, for it is negative at its rim.
    Mitchell {
        /// Where it ends along each axis, in pixels; 2 in the paper.
        radius: f32,
    },
    /// The window of Blackman and Harris (Harris 1978, four terms) along each axis.
    BlackmanHarris {
        /// Where it ends along each axis, in pixels.
        radius: f32,
    },
    /// None: every sample lies at the pixel's lower left corner, as in the first programs of many a course.
    Corner,
}

/// Where a sample lies, and what it weighs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FilterSample {
    /// From the pixel's centre, in pixels.
    pub offset: Vec2,
    /// The mean over all draws is 1.
    pub weight: f32,
}

impl Filter {
    /// A sample for `u` in [0, 1)².
    pub fn sample(self, u: Vec2) -> FilterSample {
        let offset = match self {
            Self::Box { radius } => (u * 2.0 - 1.0) * radius,
            Self::Tent { radius } => Vec2::new(warp::sample_tent(u.x), warp::sample_tent(u.y)) * radius,
            Self::Gaussian { radius } => {
                // Box & Muller 1958, with the radius cut off by scaling u.
                let sigma = radius / 3.0;
                let inside = -float::exp_m1(-0.5 * (radius / sigma) * (radius / sigma));
                let r = sigma * (-2.0 * float::ln_1p(-u.x * inside)).sqrt();
                let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
                Vec2::new(r * cos_phi, r * sin_phi)
            }
            Self::Mitchell { radius } => return MITCHELL.sample(u, radius),
            Self::BlackmanHarris { radius } => return BLACKMAN_HARRIS.sample(u, radius),
            Self::Corner => Vec2::new(-0.5, 0.5),
        };
        FilterSample { offset, weight: 1.0 }
    }
}

/// Steps of a tabulated filter from its middle to its end.
const STEPS: usize = 256;

/// A function on [0, 1], mirrored to [−1, 1], drawn from in proportion to its size.
struct Table {
    /// The share of its size up to the end of each step.
    cumulative: [f64; STEPS],
    /// The function over the density with which each step is drawn; its mean over all draws is 1.
    weights: [f32; STEPS],
}

static MITCHELL: LazyLock<Table> = LazyLock::new(|| Table::new(mitchell));
static BLACKMAN_HARRIS: LazyLock<Table> = LazyLock::new(|| Table::new(blackman_harris));

impl Table {
    fn new(f: impl Fn(f64) -> f64) -> Self {
        let values: [f64; STEPS] = std::array::from_fn(|i| f((i as f64 + 0.5) / STEPS as f64));
        let (sum, size) = (values.iter().sum::<f64>(), values.iter().map(|v| v.abs()).sum::<f64>());
        let mut so_far = 0.0;
        let cumulative = values.map(|value| {
            so_far += value.abs() / size;
            so_far
        });
        Self { cumulative, weights: values.map(|value| (value.signum() * size / sum) as f32) }
    }

    fn sample(&self, u: Vec2, radius: f32) -> FilterSample {
        let ((x, a), (y, b)) = (self.sample_1d(u.x), self.sample_1d(u.y));
        FilterSample { offset: Vec2::new(x, y) * radius, weight: a * b }
    }

    /// From −1 to 1, in the order of `u`, so that strata stay together.
    fn sample_1d(&self, u: f32) -> (f32, f32) {
        let signed = 2.0 * f64::from(u) - 1.0;
        let v = signed.abs();
        let step = self.cumulative.partition_point(|&share| share <= v).min(STEPS - 1);
        let start = if step == 0 { 0.0 } else { self.cumulative[step - 1] };
        let within = ((v - start) / (self.cumulative[step] - start)).clamp(0.0, 1.0);
        let x = (step as f64 + within) / STEPS as f64;
        (x.copysign(signed) as f32, self.weights[step])
    }
}

/// Mitchell & Netravali 1988, equation 8, with B = C = 1/3 and its end at 1.
fn mitchell(x: f64) -> f64 {
    let x = 2.0 * x;
    if x < 1.0 {
        (7.0 * x * x * x - 12.0 * x * x + 16.0 / 3.0) / 6.0
    } else {
        (-7.0 / 3.0 * x * x * x + 12.0 * x * x - 20.0 * x + 32.0 / 3.0) / 6.0
    }
}

/// Harris 1978, table 1, the minimal four-term window with its end at 1.
fn blackman_harris(x: f64) -> f64 {
    let cos = |k: f64| float::sin_cos64(k * PI * (1.0 + x)).1;
    0.358_75 - 0.488_29 * cos(1.0) + 0.141_28 * cos(2.0) - 0.011_68 * cos(3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILTERS: [Filter; 5] = [
        Filter::Box { radius: 0.5 },
        Filter::Tent { radius: 1.0 },
        Filter::Gaussian { radius: 1.5 },
        Filter::Mitchell { radius: 2.0 },
        Filter::BlackmanHarris { radius: 2.0 },
    ];

    fn grid(n: u32) -> impl Iterator<Item = Vec2> {
        (0..n * n).map(move |i| Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32)
    }

    #[test]
    fn filters_stay_within_their_radius_and_centre_on_the_pixel() {
        for filter in FILTERS {
            let (mut sum, mut weight) = (Vec2::ZERO, 0.0);
            for u in grid(64) {
                let sample = filter.sample(u);
                assert!(sample.offset.abs().max_element() <= 2.0);
                sum += sample.offset * sample.weight;
                weight += sample.weight;
            }
            assert!((sum / 4096.0).length() < 1e-3, "{filter:?}: {sum}");
            assert!((weight / 4096.0 - 1.0).abs() < 2e-2, "{filter:?}: {weight}");
        }
    }

    #[test]
    fn means_of_samples_are_integrals_of_the_filter() {
        // Of x² along one axis, by a Riemann sum of the formula.
        for (filter, f) in [
            (Filter::Mitchell { radius: 2.0 }, mitchell as fn(f64) -> f64),
            (Filter::BlackmanHarris { radius: 2.0 }, blackman_harris),
        ] {
            let n = 10_000;
            let at = |i: i32| (f64::from(i) + 0.5) / f64::from(n);
            let total: f64 = (0..n).map(|i| f(at(i))).sum();
            let second: f64 = (0..n).map(|i| f(at(i)) * 4.0 * at(i) * at(i)).sum();
            let drawn: f64 = grid(256)
                .map(|u| filter.sample(u))
                .map(|sample| f64::from(sample.weight * sample.offset.x * sample.offset.x))
                .sum();
            let (found, expected) = (drawn / 65_536.0, second / total);
            assert!((found - expected).abs() < 5e-3, "{filter:?}: {found} for {expected}");
        }
    }

    #[test]
    fn only_mitchell_is_negative_anywhere() {
        let negative = |filter: Filter| grid(64).any(|u| filter.sample(u).weight < 0.0);
        assert_eq!(FILTERS.map(negative), [false, false, false, true, false]);
    }
}
