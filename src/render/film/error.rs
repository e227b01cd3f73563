//! How far the mean of all passes may be from the truth, told by the streams alone.

use super::{BlurBounds, Film, STREAMS};
use crate::math::float;
use rayon::prelude::*;

/// The estimated error of the mean picture, as √relMSE; 0.01 is one percent.
///
/// relMSE is the mean over pixels and channels of variance / (r² + 0.01 m²), with r the pixel and m the mean luminance.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ErrorEstimate {
    /// √relMSE.
    pub error: f64,
    /// The interval that holds the error of this very picture in 95 % of all renders; `None` below four passes.
    pub interval: Option<(f64, f64)>,
    /// √relMSE without the worst 0.1 % of pixels.
    pub trimmed: f64,
    /// The share of the interval's squared width, on the scale of factors, that more passes do not remove: with few pixels, or
    /// few that noise is in, one picture's error differs from another's. The rest is that of rare bright paths. In [0, 1].
    pub steady: f64,
    /// For photons: how much of the picture's brightness their discs smear, which `error` does not hold. `None` of paths.
    pub blur: Option<BlurBounds>,
}

impl ErrorEstimate {
    /// The share of the squared error that the worst 0.1 % of pixels hold: near 0.001 where noise is even, near 1 where
    /// fireflies make the error.
    pub fn firefly_share(&self) -> f64 {
        if self.error > 0.0 { 1.0 - (self.trimmed / self.error).powi(2) } else { 0.0 }
    }

    /// The upper end of the interval, twice the error where that is unknown, with the most that blur may be;
    /// infinite as long as nothing is known of blur.
    pub fn high(&self) -> f64 {
        self.noise_high().hypot(self.blur.map_or(0.0, |blur| blur.most))
    }

    fn noise_high(&self) -> f64 {
        self.interval.map_or(2.0 * self.error, |(_, high)| high)
    }

    /// The interval of noise and blur together; `None` below four passes, and of photons below eight.
    pub fn total_interval(&self) -> Option<(f64, f64)> {
        let (low, _) = self.interval.filter(|_| self.high().is_finite())?;
        Some((low.hypot(self.blur.map_or(0.0, |blur| blur.least)), self.high()))
    }

    /// Noise and blur together.
    pub fn total(&self) -> f64 {
        self.error.hypot(self.blur.map_or(0.0, |blur| blur.likely))
    }

    /// How many times the work so far it takes until the error is surely below `target`; below 1 if it is.
    ///
    /// After x times the work the variance is what it is now times s / x + (1 − s) / x^1.15, with s the steady share, and the
    /// interval's squared width, on the scale of factors, what it is now times s + (1 − s) / x. Blur falls as x^(−1/3) (Knaus
    /// & Zwicker 2011), and what noise leaves in doubt of it no slower.
    ///
    /// Measured after a tenth of the way: within 0.7 and 1.5 times what it takes in four of five renders.
    pub fn effort_to(&self, target: f64) -> f64 {
        let now = (self.high() / target).powi(2);
        if now <= 1.0 || now.is_nan() {
            return now;
        }
        let factor = self.noise_high() / self.error.max(f64::MIN_POSITIVE);
        let blur = self.blur.map_or(0.0, |blur| blur.most);
        let is_enough = |x: f64| {
            let reach = (self.steady + (1.0 - self.steady) / x).sqrt();
            let fall = self.steady / x + (1.0 - self.steady) * float::pow64(x, -RARE_FALL);
            let noise = self.error * fall.sqrt() * float::pow64(factor, reach);
            noise.hypot(blur * float::pow64(x, -1.0 / 3.0)) <= target
        };
        let (mut low, mut high) = (1.0_f64, float::pow64(now, 1.5));
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            if is_enough(middle) { high = middle } else { low = middle }
        }
        high
    }
}

/// As which power of the passes the part of the variance falls that is not steady. What is rare and bright is mostly the edge of
/// a lamp, or of its shadow, which evenly spread points meet ever more evenly. Measured, over scenes without fireflies.
const RARE_FALL: f64 = 1.15;

/// Streams below which their spread says nothing about itself: of two, both are equally far from their mean.
const LEAST_STREAMS: usize = 4;

/// t that Student's |t| stays below with 95 %, for 3 to 7 degrees of freedom.
const STUDENT_95: [f64; STREAMS as usize - LEAST_STREAMS + 1] = [3.182, 2.776, 2.571, 2.447, 2.365];

/// Pixels that one thread sums at a time. The blocks are the same for any number of threads, and so are the sums.
const BLOCK: usize = 4096;

/// How far the neighbours lie that tell the brightness of a pixel.
const REACH: u32 = 2;

/// How far the interval reaches below and above the estimate, in Student's factors. Rare bright paths that no stream has met
/// make an estimate too low, and nothing makes it too high as often. Measured, so that 92 to 97.5 % of intervals hold.
const SKEW: (f64, f64) = (2.0 / 3.0, 1.5);

/// The same below the estimate for photons: those that pixels share are fewer than the pixels, and their noise is often much
/// smaller than it mostly is.
const SKEW_OF_PHOTONS: f64 = 0.85;

/// A pixel's channels.
type Channels = [f64; 3];

/// A number for each stream.
type PerStream = [f64; STREAMS as usize];

impl Film {
    /// The error of the mean picture; `None` below two passes and for a film without pixels.
    ///
    /// The interval compares streams as wholes: how much the squared deviation of one stream's picture varies from
    /// stream to stream tells how much that of their mean may, whether the noise of its pixels is independent (paths)
    /// or shared (photons).
    pub fn error(&self) -> Option<ErrorEstimate> {
        let n = self.region.area();
        let streams = self.streams.len();
        if streams < 2 || n == 0 {
            return None;
        }
        let means: Vec<Channels> = (0..n).into_par_iter().map(|i| self.mean_of(i)).collect();
        let variances: Vec<Channels> = (0..n).into_par_iter().map(|i| self.variance_of(i)).collect();
        let luminance = |[r, g, b]: Channels| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let mean = sum_over(n, |i| [luminance(means[i])])[0] / n as f64;
        let pixels = Pixels { means: &means, variances: &variances, floor: 0.01 * mean * mean };
        let deviations: Vec<PerStream> =
            (0..n).into_par_iter().map(|i| self.deviations_of(i, &self.look_at(i, &pixels))).collect();

        let weights = self.weights();
        let term = |of: &PerStream| of.iter().zip(&weights).map(|(d, w)| d * w).sum::<f64>();
        let mut terms: Vec<f64> = deviations.par_iter().map(term).collect();
        let by_stream: PerStream = sum_over(n, |i| deviations[i]);
        let rel_mse = terms.iter().sum::<f64>() / n as f64;
        let least_spread = normal_spread(&terms, streams);

        // The worst pixels are put last; the others make the trimmed mean.
        let kept = n - n / 1000;
        if kept < n {
            terms.select_nth_unstable_by(kept, f64::total_cmp);
        }
        let trimmed = terms[..kept].iter().sum::<f64>() / kept as f64;

        let interval = relative_spread(&by_stream[..streams]).map(|spread| {
            // The error of the mean varies like that of a stream, but no less than a normal deviation of each pixel: streams
            // may all be off by the same, to one side or the other. The estimate adds its own uncertainty. On the scale of
            // factors, where errors below zero do not exist.
            let t = STUDENT_95[streams - LEAST_STREAMS];
            let of_estimate = spread * spread / streams as f64;
            let reach = 0.5 * t * (spread.max(least_spread).powi(2) + of_estimate).sqrt();
            let factor = |side: f64| float::exp64(side * reach);
            let below = if self.has_photons() { SKEW_OF_PHOTONS } else { SKEW.0 };
            (rel_mse.sqrt() / factor(below), rel_mse.sqrt() * factor(SKEW.1))
        });
        let blur = self.has_photons().then(|| {
            let Some(slopes) = self.slopes() else { return BlurBounds::UNKNOWN };
            let squares = |i: usize| {
                let scale = self.look_at(i, &pixels).scale(means[i]);
                slopes.products(i).map(|square| relative(square, scale))
            };
            slopes.bounds(sum_over(n, squares).map(|sum| sum / n as f64))
        });
        let steady = steady_share(&deviations, streams);
        Some(ErrorEstimate { error: rel_mse.sqrt(), interval, trimmed: trimmed.sqrt(), steady, blur })
    }

    /// What the squared deviation of each stream, as variance of a sample, counts in the variance of the mean of all:
    /// together they make Σ nₛ (xₛ − x)² / ((S − 1) N).
    fn weights(&self) -> PerStream {
        let (streams, passes) = (self.streams.len(), f64::from(self.passes));
        let mut weights = [0.0; STREAMS as usize];
        for (stream, weight) in (0..).zip(&mut weights[..streams]) {
            *weight = (1.0 - f64::from(self.passes_of(stream)) / passes) / ((streams - 1) as f64 * passes);
        }
        weights
    }

    /// For each stream the squared deviation of its mean from that of all, in proportion to brightness and scaled to
    /// the variance of one sample.
    ///
    /// A stream that has met a rare bright path deviates, and makes the pixel bright: held against the mean of all, each
    /// such path would count too little, and held against that of the others, which may have met none, too much. So the
    /// brightness that a stream is held against has half of what the stream adds to it.
    fn deviations_of(&self, index: usize, pixel: &Look) -> PerStream {
        let mut out = [0.0; STREAMS as usize];
        let passes = f64::from(self.passes);
        for (stream, (sums, out)) in (0..).zip(self.streams.iter().zip(&mut out)) {
            let count = f64::from(self.passes_of(stream));
            let others = [0, 1, 2].map(|c| (passes * pixel.mean[c] - sums[index][c]) / (passes - count));
            let brightness = [0, 1, 2].map(|c| 0.5 * (pixel.mean[c] + others[c]));
            let of_sample = count / (1.0 - count / passes);
            let squares = [0, 1, 2].map(|c| (sums[index][c] / count - pixel.mean[c]).powi(2));
            *out = of_sample * relative(squares, pixel.scale(brightness));
        }
        out
    }

    /// What the surroundings of a pixel say about it.
    fn look_at(&self, index: usize, pixels: &Pixels<'_>) -> Look {
        let (x, y) = (index as u32 % self.region.width, index as u32 / self.region.width);
        let around = Surroundings::of(self, x, y, pixels.means, pixels.variances);
        let deviation = pixels.variances[index].map(f64::sqrt);
        Look { mean: pixels.means[index], deviation, prior: around.prior(), floor: pixels.floor }
    }
}

/// What is known of all pixels.
struct Pixels<'a> {
    means: &'a [Channels],
    variances: &'a [Channels],
    /// What is added to the square of a brightness.
    floor: f64,
}

/// What is known of a pixel, and of its surroundings.
struct Look {
    mean: Channels,
    deviation: Channels,
    /// For each channel the mean of the neighbours, and how much the pixel's own value counts beside it.
    prior: Option<[(f64, f64); 3]>,
    floor: f64,
}

impl Look {
    /// What squared deviations are held against: r² + floor, with r the brightness of the pixel as its surroundings let
    /// expect it where it seems to be `own`.
    ///
    /// The pixel's own value would not do: where it is too high by chance its variance is too, and the quotient of both
    /// is far too small on average. Its neighbours are drawn apart from it. How much their picture really varies, and
    /// not by noise, says how much the pixel's own value counts beside their mean (Lee 1980).
    fn scale(&self, own: Channels) -> Channels {
        [0, 1, 2].map(|c| {
            let expected = self.prior.map_or(own[c], |prior| prior[c].0 + prior[c].1 * (own[c] - prior[c].0));
            // A pixel may be brighter than all around it: a lamp, or a gleam. Two deviations below what was seen it
            // is so beyond doubt, and fireflies are not.
            let r = expected.max(own[c] - 2.0 * self.deviation[c]);
            r * r + self.floor
        })
    }
}

/// The mean over channels of a square over its scale; 0 where nothing deviates, as in a black picture.
fn relative(squares: Channels, scale: Channels) -> f64 {
    let term = |c: usize| if squares[c] != 0.0 { squares[c] / scale[c] } else { 0.0 };
    (term(0) + term(1) + term(2)) / 3.0
}

/// Sums over the neighbours of a pixel, itself left out.
#[derive(Default)]
struct Surroundings {
    count: f64,
    sum: Channels,
    sum2: Channels,
    variance: Channels,
}

impl Surroundings {
    fn of(film: &Film, x: u32, y: u32, means: &[Channels], variances: &[Channels]) -> Self {
        let (width, height) = (film.region.width, film.region.height);
        let mut out = Self::default();
        for row in y.saturating_sub(REACH)..=(y + REACH).min(height - 1) {
            for column in x.saturating_sub(REACH)..=(x + REACH).min(width - 1) {
                let i = (row * width + column) as usize;
                if (column, row) != (x, y) {
                    out.count += 1.0;
                    for c in 0..3 {
                        out.sum[c] += means[i][c];
                        out.sum2[c] += means[i][c] * means[i][c];
                        out.variance[c] += variances[i][c];
                    }
                }
            }
        }
        out
    }

    /// For each channel the mean, and how much a pixel's own value counts beside it: as much as the neighbours differ by more
    /// than noise. `None` of too few neighbours.
    fn prior(&self) -> Option<[(f64, f64); 3]> {
        let of = |channel: usize| {
            let mean = self.sum[channel] / self.count;
            let seen = (self.sum2[channel] - self.sum[channel] * mean) / (self.count - 1.0);
            // Of 24 neighbours, noise alone seems this much larger only once in twenty times.
            let noise = 1.5 * self.variance[channel] / self.count;
            (mean, if seen > noise { (seen - noise) / seen } else { 0.0 })
        };
        (self.count >= 2.0).then(|| [0, 1, 2].map(of))
    }
}

/// The sum of `f` over all pixels, the same for any number of threads.
fn sum_over<const K: usize>(n: usize, f: impl Fn(usize) -> [f64; K] + Sync) -> [f64; K] {
    let add = |mut sum: [f64; K], x: [f64; K]| {
        sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
        sum
    };
    let block = |b: usize| (b * BLOCK..((b + 1) * BLOCK).min(n)).map(&f).fold([0.0; K], add);
    let blocks: Vec<[f64; K]> = (0..n.div_ceil(BLOCK)).into_par_iter().map(block).collect();
    blocks.into_iter().fold([0.0; K], add)
}

/// The standard deviation over the mean of a sum of squares of normal numbers with these variances, which are estimated from
/// so many streams each: √(2 Σ v²) / Σ v, where the squares of estimates with S − 1 degrees of freedom are (S + 1) / (S − 1)
/// times too large on average.
fn normal_spread(variances: &[f64], streams: usize) -> f64 {
    let s = streams as f64;
    let [sum, squares] = sum_over(variances.len(), |i| [variances[i], variances[i] * variances[i]]);
    if sum > 0.0 { (2.0 * (s - 1.0) / (s + 1.0) * squares).sqrt() / sum } else { 0.0 }
}

/// How much of the variance of squared deviations, in units of their mean squared, is that of a normal distribution, 2, which
/// sums of many samples have; what is above it, the excess, falls as one over the samples.
///
/// Of S streams with normal deviations, E Σ d⁴ = 3 S and E (Σ d²)² = S² (S + 1) / (S − 1); an excess adds S times itself to
/// both. Pixels count by their variance squared, as they do for the error of a whole picture.
fn steady_share(deviations: &[PerStream], streams: usize) -> f64 {
    let [fourth, squared] = sum_over(deviations.len(), |i| {
        let squares = &deviations[i][..streams];
        [squares.iter().map(|d| d * d).sum(), squares.iter().sum::<f64>().powi(2)]
    });
    let s = streams as f64;
    let excess = (fourth * s * s * (s + 1.0) / (s - 1.0) - 3.0 * s * squared) / (s * (squared - fourth));
    if squared > fourth { 2.0 / (2.0 + excess.max(0.0)) } else { 0.0 }
}

/// The standard deviation over the mean; `None` of too few streams.
fn relative_spread(values: &[f64]) -> Option<f64> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    (values.len() >= LEAST_STREAMS && mean > 0.0).then(|| variance.sqrt() / mean)
}

#[cfg(test)]
mod tests {
    use super::super::{Region, Tile};
    use super::*;
    use crate::math::Rgb;
    use crate::render::sampler::{Dim, Sampler};

    /// A film of samples with mean 1, each 1 / `share` or 0, so that they are bright with probability `share`.
    fn film(seed: u64, side: u32, passes: u32, share: f32) -> Film {
        let region = Region { x: 0, y: 0, width: side, height: side };
        let mut film = Film::new(region);
        for pass in 0..passes {
            let sample = |[x, y]: [u32; 2]| {
                let u = Sampler::new(seed, pass, u64::from(y) << 32 | u64::from(x), 0).get_1d(Dim::Filter);
                Rgb::gray(if u < share { 1.0 / share } else { 0.0 })
            };
            film.add_pass(&[Tile { region, samples: region.pixels().map(sample).collect() }]);
        }
        film
    }

    #[test]
    fn few_pixels_of_which_all_samples_deviate_alike_are_held() {
        // Each stream is one sample, black or white, and as far from the middle as all others.
        let holds = (0..60).filter(|&seed| {
            let film = film(seed, 5, 8, 0.5);
            let squares = film.mean().into_iter().map(|x| f64::from(x.r - 1.0).powi(2) / 1.01);
            let truth = (squares.sum::<f64>() / 25.0).sqrt();
            let (low, high) = film.error().and_then(|e| e.interval).expect("8 passes");
            (low..=high).contains(&truth)
        });
        let count = holds.count();
        assert!(count >= 51, "{count} of 60");
    }

    #[test]
    fn what_more_passes_remove_is_that_of_rare_samples() {
        let steady = |passes: u32, share: f32| film(1, 40, passes, share).error().expect("passes").steady;
        assert!(steady(64, 0.5) > 0.8, "{}", steady(64, 0.5));
        let (rare, less_rare) = (steady(16, 0.01), steady(256, 0.01));
        assert!(rare < 0.2 && less_rare > 2.0 * rare, "{rare} {less_rare}");
    }

    #[test]
    fn effort_reaches_the_target_and_no_less_for_blur() {
        let interval = Some((0.018, 0.022));
        let paths = ErrorEstimate { error: 0.02, interval, trimmed: 0.02, steady: 1.0, blur: None };
        assert!((paths.effort_to(0.011) - 4.0).abs() < 1e-6, "{}", paths.effort_to(0.011));
        assert!(paths.effort_to(0.03) < 1.0);
        let rare = ErrorEstimate { steady: 0.0, ..paths };
        assert!(rare.effort_to(0.011) < 3.6);
        let blur = Some(BlurBounds { least: 0.0, likely: 0.01, most: 0.022 });
        let photons = ErrorEstimate { blur, ..paths };
        assert!(photons.effort_to(0.011) > 8.0, "blur falls as the cube root of passes");
        let unknown = ErrorEstimate { blur: Some(BlurBounds::UNKNOWN), ..paths };
        assert_eq!((unknown.total_interval(), unknown.effort_to(0.011)), (None, f64::INFINITY));
    }
}
