//! What the runs of one variant say together: error against time, its slope, its blur.

use super::clock::Seconds;
use super::experiment::{Point, Reference, Run};
use super::record::Record;
use super::statistics::{bootstrap, line_through, median, quantile};
use super::{Relative, metrics};
use crate::output::Picture;

/// Which time counts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TimeOf {
    /// What a clock on the wall shows.
    Wall,
    /// What all threads together spent.
    Cpu,
}

impl TimeOf {
    /// The time that counts.
    pub fn pick(self, seconds: Seconds) -> f64 {
        match self {
            Self::Wall => seconds.wall,
            Self::Cpu => seconds.cpu,
        }
    }
}

/// A value over all runs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The middle run.
    pub median: f64,
    /// Below it lies a tenth of the runs.
    pub low: f64,
    /// Above it lies a tenth.
    pub high: f64,
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_unstable_by(f64::total_cmp);
        Self {
            mean: metrics::mean(&values),
            median: quantile(&values, 0.5),
            low: quantile(&values, 0.1),
            high: quantile(&values, 0.9),
        }
    }
}

/// All runs of a variant after the same number of passes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Step {
    /// Passes.
    pub passes: u32,
    /// Seconds of the middle run.
    pub seconds: f64,
    /// relMSE without the noise of the reference.
    pub rel_mse: Spread,
    /// relMSE without the worst 0.1 % of pixels, and without the noise of the reference.
    pub trimmed: Spread,
    /// RMSE as measured.
    pub rmse: Spread,
    /// FLIP as measured.
    pub flip: Spread,
    /// SSIM as measured.
    pub ssim: Spread,
    /// The part of relMSE that no run is free of, the square of the blur; noise may make it negative.
    pub bias: f64,
    /// Whether that part is there beyond doubt: at least a twentieth of the noise, three times what chance makes of so many
    /// runs that differ as these do, and more than the noise of the reference, which all runs share.
    pub is_biased: bool,
}

impl Step {
    /// The error as a share: √relMSE of the middle run.
    pub fn error(&self) -> f64 {
        self.rel_mse.median.max(0.0).sqrt()
    }
}

/// The curve of a variant.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// What was varied, such as `pt` or `ppm k=60`.
    pub name: String,
    /// Whether it gathers photons, whose discs blur.
    pub has_photons: bool,
    /// Runs.
    pub run_count: usize,
    /// After 1, 2, 4, … passes.
    pub steps: Vec<Step>,
    /// How relMSE falls with time: the slope in log–log with its 95 % interval; −1 for unbiased noise.
    pub slope: Option<Slope>,
    /// How the printed errors fare against the true ones.
    pub honesty: Option<Honesty>,
}

/// A slope with its interval.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Slope {
    /// d log relMSE / d log seconds.
    pub value: f64,
    /// The 95 % interval, by drawing runs anew.
    pub interval: (f64, f64),
}

impl Slope {
    /// How many times the time an error `factor` times smaller costs. `None` where the error does not fall.
    pub fn price_of(&self, factor: f64) -> Option<f64> {
        (self.value < -0.05).then(|| factor.powf(-2.0 / self.value))
    }
}

/// How the errors that renders print of themselves fare against the reference.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Honesty {
    /// The middle of printed over true error.
    pub ratio: f64,
    /// The share of 95 % intervals that hold the true error.
    pub coverage: f64,
    /// How many were looked at.
    pub count: usize,
}

/// The shortest time that is told from none, in seconds: logarithms need one.
const SHORTEST: f64 = 1e-4;

/// How many times as far as was measured a curve is drawn out; beyond, it says nothing.
const FARTHEST: f64 = 1e4;

/// Steps with fewer passes say little about how the error falls.
const FIRST_PASSES_OF_SLOPE: u32 = 4;

impl Curve {
    /// The curve of what was recorded against a reference.
    pub fn new(
        name: String,
        has_photons: bool,
        record: &Record,
        reference: &Reference,
        time: TimeOf,
    ) -> Self {
        let (reference, noise) = (&reference.picture, reference.noise.unwrap_or(0.0));
        let runs = &record.runs;
        let count = runs.iter().map(|run| run.points.len()).min().unwrap_or(0);
        let mut steps: Vec<Step> =
            (0..count).map(|i| step(runs, i, &record.means[i], reference, noise, time)).collect();
        // What is not further from the reference than the truth is cannot be judged.
        let judged = steps.iter().take_while(|step| step.rel_mse.median > noise).count();
        steps.truncate(judged.max(1));
        let slope = slope(runs, &steps, noise);
        let honesty = honesty(runs, noise);
        Self { name, has_photons, run_count: runs.len(), steps, slope, honesty }
    }

    /// The last step.
    pub fn last(&self) -> Option<&Step> {
        self.steps.last()
    }

    /// relMSE after `seconds`, between steps in proportion to logarithms; `None` outside what was measured.
    pub fn rel_mse_at(&self, seconds: f64) -> Option<f64> {
        let pair = self.steps.windows(2).find(|w| w[0].seconds <= seconds && seconds <= w[1].seconds)?;
        let [a, b] =
            [0, 1].map(|i| (pair[i].seconds.ln(), pair[i].rel_mse.median.max(f64::MIN_POSITIVE).ln()));
        let t = if b.0 > a.0 { (seconds.ln() - a.0) / (b.0 - a.0) } else { 1.0 };
        Some((a.1 + t * (b.1 - a.1)).exp())
    }

    /// The seconds until relMSE is below `target`: measured, or extrapolated along the slope.
    pub fn seconds_to(&self, target: f64) -> Reach {
        let Some(last) = self.last() else { return Reach::Never };
        if let Some(i) = self.steps.iter().position(|step| step.rel_mse.median <= target) {
            let step = &self.steps[i];
            let Some(before) = i.checked_sub(1).map(|i| &self.steps[i]) else {
                return Reach::AtMost(step.seconds);
            };
            let [high, low] = [before, step].map(|s| s.rel_mse.median.max(f64::MIN_POSITIVE).ln());
            let t = if high > low { (high - target.ln()) / (high - low) } else { 1.0 };
            let seconds = before.seconds.ln() + t * (step.seconds.ln() - before.seconds.ln());
            return Reach::Measured(seconds.exp());
        }
        let floor = if last.is_biased { last.bias } else { 0.0 };
        match self.slope {
            Some(slope) if slope.value < -0.05 && floor < target => {
                match (target / last.rel_mse.median).powf(1.0 / slope.value) {
                    times if times <= FARTHEST => Reach::Extrapolated(times * last.seconds),
                    _ => Reach::Never,
                }
            }
            _ => Reach::Never,
        }
    }

    /// 1 / (relMSE · seconds), of the last step: how much a second is worth.
    pub fn efficiency(&self) -> Option<f64> {
        self.last().map(|step| 1.0 / (step.rel_mse.median * step.seconds)).filter(|e| e.is_finite())
    }
}

/// When a curve reaches an error.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Reach {
    /// Already at the first step.
    AtMost(f64),
    /// Between two steps.
    Measured(f64),
    /// Beyond the last, if the error goes on falling as it did.
    Extrapolated(f64),
    /// Out of reach: it hardly falls any more, or the blur is larger.
    Never,
}

impl Reach {
    /// The seconds, where there are any.
    pub fn seconds(self) -> Option<f64> {
        match self {
            Self::AtMost(s) | Self::Measured(s) | Self::Extrapolated(s) => Some(s),
            Self::Never => None,
        }
    }
}

/// E[(x − r)²] is the error of x plus the variance of r.
fn without_noise(rel_mse: f64, noise: f64) -> f64 {
    rel_mse - noise
}

fn step(
    runs: &[Run],
    i: usize,
    mean: &[crate::math::Rgb],
    reference: &Picture,
    noise: f64,
    time: TimeOf,
) -> Step {
    let of = |f: &dyn Fn(&Point) -> f64| Spread::of(runs.iter().map(|run| f(&run.points[i])).collect());
    let rel_mse = of(&|point| without_noise(point.metrics.rel_mse, noise));
    // The error of the mean of n runs is bias² + variance / n, and that of one run bias² + variance.
    let relative = Relative::to(reference.mean_luminance());
    let pairs = mean.iter().zip(&reference.radiance);
    let squares: Vec<f64> = pairs.map(|(&x, &r)| relative.squared(x, r)).collect();
    let of_mean = without_noise(metrics::mean(&squares), noise);
    let n = runs.len() as f64;
    let bias = if runs.len() > 1 { (n * of_mean - rel_mse.mean) / (n - 1.0) } else { 0.0 };
    // Errors of runs that differ by the share s are those of 2/s² independent pixels; the bias is a mean over n (n − 1) / 2
    // pairs of runs of a product that has their noise.
    let spread = runs.iter().map(|run| (run.points[i].metrics.rel_mse - noise - rel_mse.mean).powi(2));
    let chance = (spread.sum::<f64>() / (n * (n - 1.0).max(1.0).powi(2))).sqrt();
    Step {
        passes: runs[0].points[i].passes,
        seconds: median(&runs.iter().map(|run| time.pick(run.points[i].seconds)).collect::<Vec<_>>())
            .max(SHORTEST),
        rel_mse,
        trimmed: of(&|point| without_noise(point.metrics.rel_mse_trimmed, noise)),
        rmse: of(&|point| point.metrics.rmse),
        flip: of(&|point| point.metrics.flip),
        ssim: of(&|point| point.metrics.ssim),
        bias,
        is_biased: bias > (0.05 * (rel_mse.mean - bias)).max(3.0 * chance).max(noise).max(0.0),
    }
}

/// The slope of mean relMSE over the runs that are drawn.
fn slope(runs: &[Run], steps: &[Step], noise: f64) -> Option<Slope> {
    let late = |step: &&Step| step.passes >= FIRST_PASSES_OF_SLOPE;
    let first = if steps.iter().filter(late).count() >= 3 { FIRST_PASSES_OF_SLOPE } else { 1 };
    let used: Vec<usize> = (0..steps.len()).filter(|&i| steps[i].passes >= first).collect();
    let fit = |drawn: &[usize]| {
        let points = used.iter().filter_map(|&i| {
            let sum: f64 =
                drawn.iter().map(|&r| without_noise(runs[r].points[i].metrics.rel_mse, noise)).sum();
            let mean = sum / drawn.len() as f64;
            (mean > 0.0 && steps[i].seconds > 0.0).then(|| (steps[i].seconds.ln(), mean.ln()))
        });
        let points: Vec<(f64, f64)> = points.collect();
        (points.len() >= 3).then(|| line_through(&points)).flatten().map(|(slope, _)| slope)
    };
    let all: Vec<usize> = (0..runs.len()).collect();
    Some(Slope { value: fit(&all)?, interval: bootstrap(runs.len(), fit)? })
}

fn honesty(runs: &[Run], noise: f64) -> Option<Honesty> {
    let (mut ratios, mut held) = (Vec::new(), 0);
    for point in runs.iter().flat_map(|run| &run.points) {
        let truth = without_noise(point.metrics.rel_mse, noise).max(0.0).sqrt();
        // Where the reference itself is hardly better, it cannot judge.
        let judged = noise <= 0.1 * truth * truth;
        if let Some((error, Some((low, high)))) = point.estimate.filter(|_| judged && truth > 0.0) {
            ratios.push(error / truth);
            held += usize::from((low..=high).contains(&truth));
        }
    }
    let count = ratios.len();
    (count > 0).then(|| Honesty { ratio: median(&ratios), coverage: held as f64 / count as f64, count })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::study::Metrics;

    fn white() -> Reference {
        let radiance = vec![Rgb::WHITE; 4];
        let picture = Picture::new(2, 2, radiance);
        Reference { picture, noise: None, factor: 1.0 }
    }

    /// Eight runs whose relMSE is `of(passes)` up to a little noise, `rate` seconds a pass.
    pub fn curve(name: &str, rate: f64, of: impl Fn(f64) -> f64) -> Curve {
        let run = |seed: u64| {
            let points = (0..9_u32).map(|i| {
                let passes = 1_u32 << i;
                let wobble = 1.0 + 0.02 * ((seed * 7 + u64::from(i)) % 5) as f64 - 0.04;
                let rel_mse = of(f64::from(passes)) * wobble;
                let metrics = Metrics { rmse: 0.0, rel_mse, rel_mse_trimmed: rel_mse, ssim: 1.0, flip: 0.0 };
                let seconds = f64::from(passes) * rate;
                let error = rel_mse.sqrt();
                let estimate = Some((error, Some((0.9 * error, 1.1 * error))));
                Point { passes, seconds: Seconds { wall: seconds, cpu: seconds }, metrics, estimate }
            });
            Run { seed, points: points.collect() }
        };
        let record = Record { runs: (1..=8).map(run).collect(), means: vec![vec![Rgb::WHITE; 4]; 9] };
        Curve::new(name.to_owned(), name == "ppm", &record, &white(), TimeOf::Wall)
    }

    #[test]
    fn noise_that_falls_as_one_over_passes_has_slope_minus_one() {
        let curve = curve("pt", 0.1, |n| 1.0 / n);
        let slope = curve.slope.unwrap();
        assert!((slope.value + 1.0).abs() < 0.02, "{slope:?}");
        assert!(slope.interval.0 <= slope.value && slope.value <= slope.interval.1);
        assert!((slope.price_of(2.0).unwrap() - 4.0).abs() < 0.3);
        assert!((slope.price_of(10.0).unwrap() - 100.0).abs() < 10.0);
    }

    #[test]
    fn times_to_a_target_are_measured_extrapolated_or_never() {
        let curve = curve("pt", 0.1, |n| 1.0 / n);
        let Reach::Measured(seconds) = curve.seconds_to(1.0 / 50.0) else { panic!("within the steps") };
        assert!((seconds / 5.0 - 1.0).abs() < 0.1, "{seconds}");
        let Reach::Extrapolated(seconds) = curve.seconds_to(1e-4) else { panic!("beyond the steps") };
        assert!((seconds / 1000.0 - 1.0).abs() < 0.2, "{seconds}");
        assert!(matches!(curve.seconds_to(2.0), Reach::AtMost(_)));
        assert!((curve.rel_mse_at(1.6).unwrap() * 16.0 - 1.0).abs() < 0.1);
        assert_eq!(curve.rel_mse_at(1e6), None);
    }

    #[test]
    fn what_all_runs_share_is_blur() {
        // Two runs, 1 ± 0.2 around 1.1: bias 0.1, deviation 0.2.
        let metrics = |x: f64| {
            let rel_mse = (x - 1.0) * (x - 1.0) / 1.01;
            Metrics { rmse: 0.0, rel_mse, rel_mse_trimmed: rel_mse, ssim: 1.0, flip: 0.0 }
        };
        let point = |x: f64| Point {
            passes: 1,
            seconds: Seconds { wall: 1.0, cpu: 1.0 },
            metrics: metrics(x),
            estimate: None,
        };
        let runs = [1.3, 0.9].map(|x| Run { seed: 1, points: vec![point(x)] }).to_vec();
        let record = Record { runs, means: vec![vec![Rgb::gray(1.1); 4]] };
        let curve = Curve::new("ppm".to_owned(), true, &record, &white(), TimeOf::Wall);
        // (2 · 0.1² − mean(0.3², 0.1²)) / 1: with two runs the estimate is rough, here even negative.
        let expected = (2.0 * 0.01 - 0.05) / 1.01;
        assert!((curve.steps[0].bias - expected).abs() < 1e-6);
        assert!(!curve.steps[0].is_biased);
    }

    #[test]
    fn intervals_that_hold_the_truth_are_counted() {
        let honesty = curve("pt", 1.0, |n| 1.0 / n).honesty.unwrap();
        assert_eq!((honesty.ratio, honesty.coverage, honesty.count), (1.0, 1.0, 72));
    }
}
