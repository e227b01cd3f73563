//! Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004).

use super::plane::{Plane, gaussian};
use crate::math::Rgb;

/// The standard deviation of the window in pixels (section III.B).
const SIGMA: f64 = 1.5;
/// Its reach: 11 × 11 pixels.
const RADIUS: usize = 5;
/// What keeps the quotient finite where both pictures are dark or even: (0.01 · L)² and (0.03 · L)², L = 1.
const C1: f64 = 1e-4;
const C2: f64 = 9e-4;

/// The mean similarity of two pictures of display values in [0, 1], over channels and all pixels whose window lies
/// inside; over all pixels where a side has fewer than 11. 1 for the same picture, and the same in both orders.
pub fn mean(a: &[Rgb], b: &[Rgb], width: usize) -> f64 {
    (0..3).map(|channel| of_channel(a, b, width, channel)).sum::<f64>() / 3.0
}

fn of_channel(a: &[Rgb], b: &[Rgb], width: usize, channel: usize) -> f64 {
    let window = gaussian(SIGMA, RADIUS);
    let local = |f: &dyn Fn(f32, f32) -> f32| {
        Plane::from_fn(width, a.len(), |i| f(a[i][channel], b[i][channel])).filtered(&window, &window).values
    };
    let (mean_a, mean_b) = (local(&|a, _| a), local(&|_, b| b));
    let (square_a, square_b, product) = (local(&|a, _| a * a), local(&|_, b| b * b), local(&|a, b| a * b));
    let similarity = |i: usize| {
        let [ma, mb] = [mean_a[i], mean_b[i]].map(f64::from);
        let var_a = f64::from(square_a[i]) - ma * ma;
        let var_b = f64::from(square_b[i]) - mb * mb;
        let covariance = f64::from(product[i]) - ma * mb;
        (2.0 * ma * mb + C1) * (2.0 * covariance + C2) / ((ma * ma + mb * mb + C1) * (var_a + var_b + C2))
    };
    let inside = inside(width, a.len() / width.max(1));
    inside.iter().map(|&i| similarity(i)).sum::<f64>() / inside.len().max(1) as f64
}

/// The pixels whose window lies inside the picture, or all where there are none.
fn inside(width: usize, height: usize) -> Vec<usize> {
    if width <= 2 * RADIUS || height <= 2 * RADIUS {
        return (0..width * height).collect();
    }
    let columns = RADIUS..width - RADIUS;
    (RADIUS..height - RADIUS).flat_map(|y| columns.clone().map(move |x| y * width + x)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_even_pictures_have_a_closed_form() {
        let (a, b) = (vec![Rgb::gray(0.5); 400], vec![Rgb::gray(0.25); 400]);
        let expected = (2.0 * 0.125 + C1) / (0.25 + 0.0625 + C1);
        assert!((mean(&a, &b, 20) - expected).abs() < 1e-6);
        assert_eq!(mean(&a, &b, 20), mean(&b, &a, 20));
        assert!((mean(&a[..9], &a[..9], 3) - 1.0).abs() < 1e-6); // smaller than the window
    }
}
