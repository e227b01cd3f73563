//! How far photons blur the picture, told by the passes alone.
//!
//! Photon maps spread light over discs whose squared radius falls from pass to pass (Knaus & Zwicker 2011), and where the
//! light varies smoothly the error that this makes is in proportion to it. So the passes of a render lie on a line over
//! their squared radius, up to noise: its slope times the mean squared radius is the blur of the mean picture. Where the
//! light breaks off, at edges and contacts, blur falls more slowly than that, and where the number of photons bounds the
//! discs their radius does not follow the schedule: what is found is a lower bound.

use super::Film;

/// Sums over passes beside their squared radii, for two halves of the passes that share no random number.
#[derive(Default)]
pub(super) struct Blur {
    halves: [Half; 2],
}

#[derive(Default)]
struct Half {
    passes: f64,
    /// Σ b and Σ b² over passes, b the squared radius over that of the first pass.
    sum: f64,
    sum2: f64,
    /// Σ x and Σ b x for each pixel.
    plain: Vec<[f64; 3]>,
    tilted: Vec<[f64; 3]>,
}

impl Blur {
    /// Begins a pass whose squared radius is `b` times that of the first.
    pub(super) fn begin_pass(&mut self, pass: u32, b: f64, pixels: usize) {
        let half = &mut self.halves[(pass % 2) as usize];
        half.plain.resize(pixels, [0.0; 3]);
        half.tilted.resize(pixels, [0.0; 3]);
        half.passes += 1.0;
        half.sum += b;
        half.sum2 += b * b;
    }

    /// Adds a sample of the pass.
    pub(super) fn add(&mut self, pass: u32, b: f64, index: usize, sample: [f64; 3]) {
        let half = &mut self.halves[(pass % 2) as usize];
        let sums = half.plain[index].iter_mut().zip(&mut half.tilted[index]);
        for ((plain, tilted), x) in sums.zip(sample) {
            *plain += x;
            *tilted += b * x;
        }
    }

    /// The square of a pixel's blur, as the product of two independent estimates: its mean is right, though noise may make
    /// it negative. `None` below three passes a half.
    pub(super) fn squared(&self, index: usize) -> Option<[f64; 3]> {
        let [even, odd] = &self.halves;
        let mean = (even.sum + odd.sum) / (even.passes + odd.passes);
        let (a, b) = (even.slope(index)?, odd.slope(index)?);
        Some([0, 1, 2].map(|channel| a[channel] * mean * b[channel] * mean))
    }
}

impl Half {
    /// The slope of the line through the passes of a pixel.
    fn slope(&self, index: usize) -> Option<[f64; 3]> {
        let mean = self.sum / self.passes;
        let spread = self.sum2 - self.sum * mean;
        (self.passes >= 3.0 && spread > 0.0).then(|| {
            [0, 1, 2]
                .map(|channel| (self.tilted[index][channel] - mean * self.plain[index][channel]) / spread)
        })
    }
}

impl Film {
    /// The squares of each pixel's blur as [`Blur::squared`] has them; `None` of a film without photons.
    pub(super) fn blur_squared(&self, index: usize) -> Option<[f64; 3]> {
        self.blur.as_ref()?.squared(index)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Region, Tile};
    use super::*;
    use crate::math::Rgb;
    use crate::render::sampler::{Dim, Sampler};

    /// A film of noise around 1 + `blur` · b, with b as Knaus & Zwicker let it fall.
    fn film(blur: f64, passes: u32) -> (Film, f64) {
        let region = Region { x: 0, y: 0, width: 60, height: 50 };
        let mut film = Film::new(region);
        let (mut b, mut sum) = (1.0, 0.0);
        for pass in 0..passes {
            let sample = |[x, y]: [u32; 2]| {
                let noise = Sampler::new(1, pass, u64::from(y) << 32 | u64::from(x), 0).get_1d(Dim::Filter);
                Rgb::gray(0.5 + noise + (blur * b) as f32)
            };
            let samples = region.pixels().map(sample).collect();
            film.add_blurred_pass(&[Tile { region, samples }], b);
            sum += b;
            let i = f64::from(pass + 1);
            b *= (i + 2.0 / 3.0) / (i + 1.0);
        }
        (film, blur * sum / f64::from(passes))
    }

    #[test]
    fn blur_in_proportion_to_the_disc_is_found() {
        for passes in [24, 64] {
            let (blurred, blur) = film(0.5, passes);
            let found = blurred.error().and_then(|e| e.blur).expect("photons");
            let expected = blur / (1.0 + blur); // of the brightness that is seen
            assert!((found / expected - 1.0).abs() < 0.15, "{passes} passes: {found} for {expected}");
            let (sharp, _) = film(0.0, passes);
            let none = sharp.error().and_then(|e| e.blur).expect("photons");
            assert!(none < 0.3 * expected, "{passes} passes: {none} of nothing");
        }
    }

    #[test]
    fn a_film_without_photons_has_no_blur_and_the_same_bits() {
        let region = Region { x: 0, y: 0, width: 4, height: 4 };
        let tile = |i: u32| [Tile { region, samples: vec![Rgb::gray(0.1 * i as f32); 16] }];
        let (mut plain, mut blurred) = (Film::new(region), Film::new(region));
        for i in 0..8 {
            plain.add_pass(&tile(i));
            blurred.add_blurred_pass(&tile(i), 1.0 / f64::from(i + 1));
        }
        assert_eq!(plain.error().and_then(|e| e.blur), None);
        assert_eq!(plain.mean(), blurred.mean());
    }
}
