//! How far the mean of all passes may be from the truth, told by the streams alone.

use super::{Film, STREAMS};
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
    /// For photons: how much of the picture's brightness their discs smear, at least, as a share like `error`, which does
    /// not hold it. `None` of paths, and below six passes.
    pub blur: Option<f64>,
}

impl ErrorEstimate {
    /// The share of the squared error that the worst 0.1 % of pixels hold: near 0.001 where noise is even, near 1 where
    /// fireflies make the error.
    pub fn firefly_share(&self) -> f64 {
        if self.error > 0.0 { 1.0 - (self.trimmed / self.error).powi(2) } else { 0.0 }
    }

    /// The upper end of the interval, twice the error where that is unknown, with the blur, of which 1.6 times as much
    /// counts because it is a lower bound.
    pub fn high(&self) -> f64 {
        let noise = self.interval.map_or(2.0 * self.error, |(_, high)| high);
        noise.hypot(1.6 * self.blur.unwrap_or(0.0))
    }

    /// The interval of noise and blur together; `None` below four passes.
    pub fn total_interval(&self) -> Option<(f64, f64)> {
        self.interval.map(|(low, _)| (low.hypot(self.blur.unwrap_or(0.0)), self.high()))
    }

    /// Noise and blur together.
    pub fn total(&self) -> f64 {
        self.error.hypot(self.blur.unwrap_or(0.0))
    }

    /// How many times the work so far it takes until the error is surely below `target`; below 1 if it is.
    ///
    /// The error falls as 1/√passes, and so does, on the scale of factors, how far the upper end of the interval lies
    /// above it: of the effort x and the error e with its upper end h, x = (e (h/e)^(1/√x) / target)². Measured: with the
    /// end where it is now, what is foretold is twice as much, for small noisy pictures.
    pub fn effort_to(&self, target: f64) -> f64 {
        let now = (self.high() / target).powi(2);
        if now <= 1.0 || now.is_nan() {
            return now;
        }
        let (total, spread) = ((self.total() / target).powi(2), self.high() / self.total());
        let (mut low, mut high) = (1.0_f64, now);
        for _ in 0..40 {
            let middle = (low * high).sqrt();
            if total * float::pow64(spread, 2.0 / middle.sqrt()) > middle {
                low = middle
            } else {
                high = middle
            }
        }
        high
    }
}

/// Streams below which their spread says nothing about itself: of two, both are equally far from their mean.
const LEAST_STREAMS: usize = 4;

/// t that Student's |t| stays below with 95 %, for 3 to 7 degrees of freedom.
const STUDENT_95: [f64; STREAMS as usize - LEAST_STREAMS + 1] = [3.182, 2.776, 2.571, 2.447, 2.365];

/// Pixels that one thread sums at a time. The blocks are the same for any number of threads, and so are the sums.
const BLOCK: usize = 4096;

/// How far the neighbours lie that tell the brightness of a pixel.
const REACH: u32 = 2;

/// How far the interval reaches below and above the estimate, in Student's factors. Rare bright paths that no stream has met
/// make an estimate too low, and nothing makes it too high as often. Measured, so that the truth lies on both sides of the
/// interval about as often where noise is skewed.
const SKEW: (f64, f64) = (2.0 / 3.0, 1.5);

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

        // The worst pixels are put last; the others make the trimmed mean.
        let kept = n - n / 1000;
        if kept < n {
            terms.select_nth_unstable_by(kept, f64::total_cmp);
        }
        let trimmed = terms[..kept].iter().sum::<f64>() / kept as f64;

        let interval = relative_spread(&by_stream[..streams]).map(|spread| {
            // The error of the mean varies like that of a stream; the estimate adds its own uncertainty. On the scale
            // of factors, where errors below zero do not exist.
            let t = STUDENT_95[streams - LEAST_STREAMS];
            let reach = 0.5 * t * spread * (1.0 + 1.0 / streams as f64).sqrt();
            let factor = |side: f64| float::exp64(side * reach);
            (rel_mse.sqrt() / factor(SKEW.0), rel_mse.sqrt() * factor(SKEW.1))
        });
        let blur = self.blur_squared(0).map(|_| {
            let square = |i: usize| {
                self.blur_squared(i)
                    .map_or(0.0, |blur| relative(blur, self.look_at(i, &pixels).scale(means[i])))
            };
            (sum_over(n, |i| [square(i)])[0] / n as f64).max(0.0).sqrt()
        });
        Some(ErrorEstimate { error: rel_mse.sqrt(), interval, trimmed: trimmed.sqrt(), blur })
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

/// The standard deviation over the mean; `None` of too few streams.
fn relative_spread(values: &[f64]) -> Option<f64> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    (values.len() >= LEAST_STREAMS && mean > 0.0).then(|| variance.sqrt() / mean)
}
