//! The numbers that say how far a picture is from a reference.

use super::{flip, ssim};
use crate::math::{Rgb, rgb};
use crate::output::Picture;

/// How far a picture is from a reference. All but `ssim` are 0 for the same picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Metrics {
    /// √mean((x − r)²) over pixels and channels, in the unit of the radiance.
    pub rmse: f64,
    /// The mean of [`Relative`] over all pixels.
    pub rel_mse: f64,
    /// The same without the worst 0.1 % of pixels: what is left without fireflies.
    pub rel_mse_trimmed: f64,
    /// Structural similarity of display values, in [−1, 1]; 1 for the same picture (Wang et al. 2004).
    pub ssim: f64,
    /// The mean of FLIP over all pixels, in [0, 1] (Andersson et al. 2020).
    pub flip: f64,
}

/// The error of a pixel in proportion to its brightness: mean over channels of (x − r)² / (r² + 0.01 m²), with m the
/// mean luminance of the reference.
///
/// The square root is a share: 0.01 is one percent of a pixel that is brighter than a tenth of the mean. A pixel that
/// differs from an entirely black reference counts as infinite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Relative {
    floor: f64,
}

impl Relative {
    /// The measure of errors against a reference of mean luminance `mean`.
    pub fn to(mean: f64) -> Self {
        Self { floor: 0.01 * mean * mean }
    }

    /// The squared error of a pixel.
    pub fn squared(&self, x: Rgb, r: Rgb) -> f64 {
        let term = |channel: usize| self.term(f64::from(x[channel]) - f64::from(r[channel]), r[channel]);
        (term(0) + term(1) + term(2)) / 3.0
    }

    /// The squared error that a standard error of the pixel amounts to.
    pub fn of_standard_error(&self, error: Rgb, r: Rgb) -> f64 {
        let term = |channel: usize| self.term(f64::from(error[channel]), r[channel]);
        (term(0) + term(1) + term(2)) / 3.0
    }

    fn term(&self, difference: f64, r: f32) -> f64 {
        let scale = f64::from(r) * f64::from(r) + self.floor;
        if difference == 0.0 { 0.0 } else { difference * difference / scale }
    }
}

/// Compares a picture with a reference of the same size. `factor` brings radiance to the display, for [`ssim`] and
/// [`flip`]; `pixels_per_degree` says how large pixels look, for `flip`.
pub fn measure(picture: &Picture, reference: &Picture, factor: f32, pixels_per_degree: f64) -> Metrics {
    let squares = relative_errors(picture, reference);
    let (shown, wanted) = (display(&picture.radiance, factor), display(&reference.radiance, factor));
    let width = reference.width as usize;
    let map = flip::map(&wanted, &shown, width, pixels_per_degree);
    Metrics {
        rmse: rmse(picture, reference),
        rel_mse: mean(&squares),
        rel_mse_trimmed: trimmed_mean(squares),
        ssim: ssim::mean(&shown, &wanted, width),
        flip: map.iter().map(|&x| f64::from(x)).sum::<f64>() / map.len().max(1) as f64,
    }
}

/// √mean((x − r)²) over pixels and channels.
pub fn rmse(picture: &Picture, reference: &Picture) -> f64 {
    let pairs = picture.radiance.iter().zip(&reference.radiance);
    let squares = pairs.flat_map(|(x, r)| [0, 1, 2].map(|c| f64::from(x[c]) - f64::from(r[c])));
    (squares.map(|d| d * d).sum::<f64>() / (3 * picture.radiance.len()).max(1) as f64).sqrt()
}

/// [`Relative::squared`] of each pixel.
pub fn relative_errors(picture: &Picture, reference: &Picture) -> Vec<f64> {
    let relative = Relative::to(reference.mean_luminance());
    let pairs = picture.radiance.iter().zip(&reference.radiance);
    pairs.map(|(&x, &r)| relative.squared(x, r)).collect()
}

/// The mean; 0 of nothing.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The mean without the largest 0.1 % of values, of which there are none below 1,000.
pub fn trimmed_mean(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let kept = values.len() - values.len() / 1000;
    mean(&values[..kept])
}

/// Display values in [0, 1] (sRGB) of radiance times `factor`; what is above 1 is cut off.
pub fn display(radiance: &[Rgb], factor: f32) -> Vec<Rgb> {
    let show = |x: f32| rgb::linear_to_srgb((x * factor).clamp(0.0, 1.0));
    radiance.iter().map(|pixel| pixel.map(show)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, radiance: Vec<Rgb>) -> Picture {
        let height = radiance.len() as u32 / width;
        Picture::new(width, height, radiance)
    }

    /// A smooth picture with a pattern.
    fn pattern(scale: f32) -> Picture {
        let value =
            |i: usize| scale * (0.5 + 0.4 * ((i % 40) as f32 / 9.0).sin() * ((i / 40) as f32 / 7.0).cos());
        picture(40, (0..1600).map(|i| Rgb::new(value(i), value(i) * 0.5, value(i / 2))).collect())
    }

    #[test]
    fn a_picture_is_no_distance_from_itself() {
        let same = measure(&pattern(1.0), &pattern(1.0), 1.0, 67.0);
        let none = Metrics { rmse: 0.0, rel_mse: 0.0, rel_mse_trimmed: 0.0, ssim: 1.0, flip: 0.0 };
        assert_eq!(Metrics { ssim: (same.ssim * 1e6).round() / 1e6, ..same }, none);
    }

    #[test]
    fn an_even_offset_has_a_closed_form() {
        let gray = |level: f32| picture(20, vec![Rgb::gray(level); 400]);
        let metrics = measure(&gray(1.1), &gray(1.0), 1.0, 67.0);
        let d = f64::from(1.1_f32) - 1.0;
        assert!((metrics.rmse / d - 1.0).abs() < 1e-9);
        assert!((metrics.rel_mse / (d * d / 1.01) - 1.0).abs() < 1e-6);
        assert!((metrics.rel_mse_trimmed / metrics.rel_mse - 1.0).abs() < 1e-9);
    }

    #[test]
    fn relative_errors_do_not_depend_on_the_unit_of_light() {
        let [dim, bright] = [1.0, 1024.0].map(|scale| {
            let (mut a, b) = (pattern(scale), pattern(scale));
            a.radiance.iter_mut().step_by(3).for_each(|pixel| *pixel *= 1.25);
            mean(&relative_errors(&a, &b))
        });
        assert!(dim > 0.0 && (bright / dim - 1.0).abs() < 1e-9);
    }

    #[test]
    fn one_firefly_in_a_thousand_pixels_is_trimmed() {
        let mut broken = pattern(1.0);
        broken.radiance[77] = Rgb::gray(1e4);
        let metrics = measure(&broken, &pattern(1.0), 1.0, 67.0);
        assert!(metrics.rel_mse > 1e3 && metrics.rel_mse_trimmed == 0.0);
    }

    #[test]
    fn rmse_ssim_and_flip_see_little_in_a_small_change_and_much_in_a_large_one() {
        let reference = pattern(1.0);
        let changed = |step: f32| {
            let mut picture = pattern(1.0);
            picture.radiance.iter_mut().step_by(2).for_each(|pixel| *pixel *= 1.0 + step);
            measure(&picture, &reference, 1.0, 67.0)
        };
        let (small, large) = (changed(0.01), changed(0.3));
        assert!(small.rmse < large.rmse && small.flip < large.flip && small.ssim > large.ssim);
    }

    #[test]
    fn a_black_reference_has_no_relative_error_but_that_of_itself() {
        let black = picture(4, vec![Rgb::BLACK; 16]);
        assert_eq!(measure(&black, &black, 1.0, 67.0).rel_mse, 0.0);
        let gray = picture(4, vec![Rgb::gray(0.5); 16]);
        assert_eq!(measure(&gray, &black, 1.0, 67.0).rel_mse, f64::INFINITY);
    }
}
