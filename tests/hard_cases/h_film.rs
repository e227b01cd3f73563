//! Section H: the film.

use snell::math::Rgb;
use snell::render::film::{Film, Region, Tile};

const PIXEL: Region = Region { x: 0, y: 0, width: 1, height: 1 };

fn film(samples: impl Iterator<Item = f32>) -> Film {
    let mut film = Film::new(PIXEL);
    for value in samples {
        film.add_pass(&[Tile { region: PIXEL, samples: vec![Rgb::gray(value)] }]);
    }
    film
}

/// Case 62: the mean of four million samples is right to the last bit of a pixel. A sum in single precision is too low.
#[test]
fn hard_case_62_sums_of_millions_of_samples() {
    let samples = || (0..4_000_000_u32).map(|i| if i % 10 == 0 { 0.3 } else { 0.1_f32 });
    let exact = samples().map(f64::from).sum::<f64>() / 4e6;
    let mean = f64::from(film(samples()).mean()[0].r);
    assert!((mean / exact - 1.0).abs() <= 1e-7, "{mean}, {exact}");
    let naive = f64::from(samples().fold(0.0_f32, |sum, x| sum + x)) / 4e6;
    assert!((naive / exact - 1.0).abs() > 1e-4, "single precision gives {naive}");
}

/// Case 67: one sample in a thousand is NaN or infinite: it counts as 0, is counted, and the first are kept with their
/// pass. In a plain sum the pixel would be NaN for ever.
#[test]
fn hard_case_67_samples_that_are_not_numbers() {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let samples = || (0..30_000).map(|i| if i % 1_000 == 7 { bad[i / 1_000 % 3] } else { 0.5 });
    let film = film(samples());
    assert_eq!(film.bad_count(), 30);
    let mean = film.mean()[0].r;
    assert!((mean - 0.5 * (1.0 - 1e-3)).abs() < 1e-6, "{mean}");
    let passes: Vec<u32> = film.bad_samples().iter().map(|sample| sample.pass).collect();
    assert_eq!(passes, (0..16).map(|i| i * 1_000 + 7).collect::<Vec<_>>());
    assert!(samples().sum::<f32>().is_nan());
}
