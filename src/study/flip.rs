//! FLIP: the difference that a person would see when flipping between two pictures (Andersson, Nilsson,
//! Akenine-Möller, Oskarsson, Åström, Fairchild 2020), for display values.
//!
//! A colour part, blurred as the eye blurs at the viewing distance, and a feature part, edges and points, which makes
//! the colour part count more.

use super::plane::{Plane, gaussian, tabulated};
use crate::math::{Rgb, rgb};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// Pixels per degree on a 0.7 m wide display of 3,840 pixels seen from 0.7 m: the paper's default.
pub const PIXELS_PER_DEGREE: f64 = 67.0;

/// The contrast sensitivity of the three opponent channels: two Gaussians each, as (a, b) in
/// a · √(π / b) · exp(−π² d² / b), d in degrees (table 1).
const SENSITIVITY: [[(f64, f64); 2]; 3] =
    [[(1.0, 0.0047), (0.0, 1e-5)], [(1.0, 0.0053), (0.0, 1e-5)], [(34.1, 0.04), (13.5, 0.025)]];
/// The widest b of them, which sets the filters' reach.
const WIDEST: f64 = 0.04;

/// The exponent that compresses colour differences (section 4.1.3).
const COLOR_EXPONENT: f64 = 0.7;
/// Colour differences below this share of the largest fill the range up to the next constant.
const SMALL_COLOR: f64 = 0.4;
const SMALL_COLOR_ERROR: f64 = 0.95;
/// The width of edges and points, in degrees (section 4.2).
const FEATURE_WIDTH: f64 = 0.082;
/// The exponent of feature differences.
const FEATURE_EXPONENT: f64 = 0.5;

/// The error of each pixel in [0, 1] between two pictures of display values in [0, 1] (sRGB), `height × width`.
pub fn map(reference: &[Rgb], test: &[Rgb], width: usize, pixels_per_degree: f64) -> Vec<f32> {
    let space = Space::new();
    let [reference, test] = [reference, test].map(|picture| Opponent::new(picture, width, &space));
    let [seen, seen_test] = [&reference, &test].map(|picture| picture.seen(&space, pixels_per_degree));
    let [features, test_features] = [&reference, &test].map(|picture| picture.features(pixels_per_degree));
    let largest = hyab(space.hunt(DVec3::Y), space.hunt(DVec3::Z)).powf(COLOR_EXPONENT);
    let error = |i: usize| {
        let color = compressed(hyab(seen[i], seen_test[i]).powf(COLOR_EXPONENT), largest);
        let feature = features.difference(&test_features, i);
        color.powf(1.0 - feature) as f32
    };
    (0..seen.len()).map(error).collect()
}

/// The range of colour differences: 0.95 of it for the smaller 40 %.
fn compressed(difference: f64, largest: f64) -> f64 {
    let knee = SMALL_COLOR * largest;
    if difference < knee {
        SMALL_COLOR_ERROR / knee * difference
    } else {
        SMALL_COLOR_ERROR + (difference - knee) / (largest - knee) * (1.0 - SMALL_COLOR_ERROR)
    }
}

/// The distance of colours that may be far apart (Abasi, Tehran, Fairchild 2020).
fn hyab(a: DVec3, b: DVec3) -> f64 {
    let d = a - b;
    d.x.abs() + d.y.hypot(d.z)
}

/// Between linear Rec. 709, XYZ relative to the white point, YyCxCz and CIELAB.
struct Space {
    /// XYZ over that of white, from linear Rec. 709.
    relative_from_rgb: DMat3,
    rgb_from_relative: DMat3,
}

impl Space {
    fn new() -> Self {
        // Rec. 709 with white D65, as exact fractions (Pascale 2003).
        let xyz_from_rgb = DMat3::from_cols(
            DVec3::new(10_135_552.0 / 24_577_794.0, 2_613_072.0 / 12_288_897.0, 1_425_312.0 / 73_733_382.0),
            DVec3::new(8_788_810.0 / 24_577_794.0, 8_788_810.0 / 12_288_897.0, 8_788_810.0 / 73_733_382.0),
            DVec3::new(4_435_075.0 / 24_577_794.0, 887_015.0 / 12_288_897.0, 70_074_185.0 / 73_733_382.0),
        );
        let white = xyz_from_rgb * DVec3::ONE;
        let relative_from_rgb = DMat3::from_diagonal(white.recip()) * xyz_from_rgb;
        Self { relative_from_rgb, rgb_from_relative: relative_from_rgb.inverse() }
    }

    /// The opponent space in which the eye blurs: CIELAB without its cube root.
    fn ycxcz(&self, linear: DVec3) -> DVec3 {
        let r = self.relative_from_rgb * linear;
        DVec3::new(116.0 * r.y - 16.0, 500.0 * (r.x - r.y), 200.0 * (r.y - r.z))
    }

    fn linear(&self, ycxcz: DVec3) -> DVec3 {
        let y = (ycxcz.x + 16.0) / 116.0;
        self.rgb_from_relative * DVec3::new(y + ycxcz.y / 500.0, y, y - ycxcz.z / 200.0)
    }

    /// CIELAB, its colour less where it is dark (Hunt 1952).
    fn hunt(&self, linear: DVec3) -> DVec3 {
        let f = |t: f64| {
            const DELTA: f64 = 6.0 / 29.0;
            if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
        };
        let r = self.relative_from_rgb * linear;
        let (x, y, z) = (f(r.x), f(r.y), f(r.z));
        let lightness = 116.0 * y - 16.0;
        DVec3::new(lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z))
    }
}

/// A picture in YyCxCz.
struct Opponent {
    channels: [Plane; 3],
}

/// The strength of edges and of points at each pixel.
struct Features {
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Opponent {
    fn new(display: &[Rgb], width: usize, space: &Space) -> Self {
        let convert = |pixel: &Rgb| {
            let linear = pixel.map(rgb::srgb_to_linear);
            space.ycxcz(DVec3::new(linear.r.into(), linear.g.into(), linear.b.into()))
        };
        let all: Vec<DVec3> = display.iter().map(convert).collect();
        let channels = [0, 1, 2].map(|c| Plane::from_fn(width, all.len(), |i| all[i][c] as f32));
        Self { channels }
    }

    /// What reaches the mind: blurred by contrast sensitivity, within the display's gamut, as Hunt-adjusted CIELAB.
    fn seen(&self, space: &Space, pixels_per_degree: f64) -> Vec<DVec3> {
        let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as usize;
        let blurred: Vec<Plane> = self
            .channels
            .iter()
            .zip(SENSITIVITY)
            .map(|(channel, gaussians)| blurred(channel, gaussians, radius, pixels_per_degree))
            .collect();
        let at = |i: usize| DVec3::from_array([0, 1, 2].map(|c| f64::from(blurred[c].values[i])));
        let pixels = 0..blurred[0].values.len();
        pixels.map(|i| space.hunt(space.linear(at(i)).clamp(DVec3::ZERO, DVec3::ONE))).collect()
    }

    /// Edges and points of the lightness, by derivatives of a Gaussian whose positive and negative weights each sum to 1.
    fn features(&self, pixels_per_degree: f64) -> Features {
        let lightness = &self.channels[0];
        let lightness =
            Plane::from_fn(lightness.width, lightness.values.len(), |i| (lightness.values[i] + 16.0) / 116.0);
        let sigma = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let radius = (3.0 * sigma).ceil() as usize;
        let bell = |x: f64| (-x * x / (2.0 * sigma * sigma)).exp();
        let smooth = gaussian(sigma, radius);
        let first = balanced(tabulated(radius, |x| -x * bell(x)));
        let second = balanced(tabulated(radius, |x| (x * x / (sigma * sigma) - 1.0) * bell(x)));
        let strength = |weights: &[f64]| {
            let (x, y) = (lightness.filtered(weights, &smooth), lightness.filtered(&smooth, weights));
            x.values.iter().zip(&y.values).map(|(&x, &y)| f64::from(x).hypot(f64::from(y))).collect()
        };
        Features { edges: strength(&first), points: strength(&second) }
    }
}

impl Features {
    /// How much a pixel's features differ, in [0, 1].
    fn difference(&self, other: &Self, i: usize) -> f64 {
        let edges = (self.edges[i] - other.edges[i]).abs();
        let points = (self.points[i] - other.points[i]).abs();
        (edges.max(points) / 2.0_f64.sqrt()).powf(FEATURE_EXPONENT).min(1.0)
    }
}

/// A channel under its two Gaussians, whose weights sum to 1 together.
fn blurred(channel: &Plane, gaussians: [(f64, f64); 2], radius: usize, pixels_per_degree: f64) -> Plane {
    // Both are products of a row and a column filter; their shares follow from the sums over all pixels.
    let parts = gaussians.map(|(a, b)| {
        let row = tabulated(radius, |x| (-(PI * x / pixels_per_degree).powi(2) / b).exp());
        let sum: f64 = row.iter().sum();
        let row: Vec<f64> = row.into_iter().map(|weight| weight / sum).collect();
        (row, a * (PI / b).sqrt() * sum * sum)
    });
    let total = parts[0].1 + parts[1].1;
    let mut out = channel.filtered(&parts[0].0, &parts[0].0);
    if parts[1].1 > 0.0 {
        let other = channel.filtered(&parts[1].0, &parts[1].0);
        let share = (parts[0].1 / total) as f32;
        out.values.iter_mut().zip(other.values).for_each(|(x, y)| *x = *x * share + y * (1.0 - share));
    }
    out
}

/// The weights scaled so that the positive ones sum to 1 and the negative ones to −1.
fn balanced(weights: Vec<f64>) -> Vec<f64> {
    let positive: f64 = weights.iter().filter(|&&w| w > 0.0).sum();
    let negative: f64 = -weights.iter().filter(|&&w| w < 0.0).sum::<f64>();
    weights.into_iter().map(|w| if w > 0.0 { w / positive } else { w / negative }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_and_white_are_as_far_apart_as_can_be_but_for_their_hue() {
        let (black, white) = (vec![Rgb::BLACK; 100], vec![Rgb::WHITE; 100]);
        let map = map(&black, &white, 10, PIXELS_PER_DEGREE);
        // Even pictures have no features, so the colour part stands alone: HyAB of black and white is 100.
        let space = Space::new();
        let largest = hyab(space.hunt(DVec3::Y), space.hunt(DVec3::Z)).powf(0.7);
        let expected = compressed(100.0_f64.powf(0.7), largest);
        assert!(map.iter().all(|&x| (f64::from(x) - expected).abs() < 1e-5), "{} for {expected}", map[0]);
    }

    #[test]
    fn the_order_does_not_matter() {
        let a: Vec<Rgb> = (0..400).map(|i| Rgb::new(i as f32 / 400.0, 0.5, (i % 20) as f32 / 20.0)).collect();
        let b: Vec<Rgb> = a.iter().rev().copied().collect();
        assert_eq!(map(&a, &b, 20, 67.0), map(&b, &a, 20, 67.0));
    }
}
