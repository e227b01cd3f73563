//! How far photons blur the picture, told by the passes alone.
//!
//! Photon maps spread light over discs whose squared radius falls from pass to pass (Knaus & Zwicker 2011), and where the
//! light varies smoothly the error that this makes is in proportion to it. So the passes of a render lie on a line over
//! their squared radius, up to noise: its slope times the mean squared radius is the blur of the mean picture. Where the
//! light breaks off, at edges and contacts, blur falls more slowly than that, and more of it is left than the slope tells.
//!
//! The slope of a pixel is noisier than the pixel, by far. Its square is estimated by products of slopes from passes that
//! share no random number: their mean is right, be it that noise makes it negative, and their spread tells how far it may be
//! off. What is stated are bounds.

use super::{Film, STREAMS};

/// Groups of passes that each have a slope. They are unions of streams, and as few as make some pairs.
const GROUPS: usize = 4;

/// Pairs of groups.
const PAIRS: usize = GROUPS * (GROUPS - 1) / 2;

/// Passes of a group below which it has no slope.
const LEAST_PASSES: f64 = 2.0;

/// t that Student's t stays below with 95 %, for 5 degrees of freedom: those of the pairs.
const STUDENT_95: f64 = 2.015;

/// How many times the slope tells the blur may be, at the most. Of a straight edge of light it is 2.5 times after 16 passes
/// and 3.7 times after 4096; measured in scenes: up to 3.3 times.
const REACH: f64 = 4.0;

/// How much of the doubt counts for that: both at their worst seldom meet. Measured: 90 % of renders are below, and more.
const DOUBT: f64 = 0.5;

/// How much of a picture's brightness the discs of photons smear, as a share like the error of noise, which does not hold it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BlurBounds {
    /// It is more than this, for sure: 0 where noise may be all that was seen.
    pub least: f64,
    /// What it probably is.
    pub likely: f64,
    /// It is less than this, for sure; infinite where too few passes tell of it.
    pub most: f64,
}

impl BlurBounds {
    /// Below eight passes.
    pub(super) const UNKNOWN: Self = Self { least: 0.0, likely: 0.0, most: f64::INFINITY };

    /// Whether anything is known.
    pub fn is_known(&self) -> bool {
        self.most.is_finite()
    }
}

/// Sums over passes beside their squared radii. The plain sums are those of the film's streams.
#[derive(Default)]
pub(super) struct Blur {
    groups: [Group; GROUPS],
}

#[derive(Default)]
struct Group {
    passes: f64,
    /// Σ b and Σ b² over passes, b the squared radius over that of the first pass.
    sum: f64,
    sum2: f64,
    /// Σ b x for each pixel.
    tilted: Vec<[f64; 3]>,
}

impl Blur {
    /// Begins a pass whose squared radius is `b` times that of the first.
    pub(super) fn begin_pass(&mut self, pass: u32, b: f64, pixels: usize) {
        let group = self.group_of(pass);
        group.tilted.resize(pixels, [0.0; 3]);
        group.passes += 1.0;
        group.sum += b;
        group.sum2 += b * b;
    }

    /// Adds a sample of the pass.
    pub(super) fn add(&mut self, pass: u32, b: f64, index: usize, sample: [f64; 3]) {
        let tilted = &mut self.group_of(pass).tilted[index];
        *tilted = [0, 1, 2].map(|c| tilted[c] + b * sample[c]);
    }

    fn group_of(&mut self, pass: u32) -> &mut Group {
        &mut self.groups[pass as usize % GROUPS]
    }

    /// Whether every group has a slope.
    fn is_known(&self) -> bool {
        self.groups.iter().all(|group| group.passes >= LEAST_PASSES && group.spread() > 0.0)
    }

    /// The mean of b over all passes.
    fn mean(&self) -> f64 {
        let sum = |of: fn(&Group) -> f64| self.groups.iter().map(of).sum::<f64>();
        sum(|group| group.sum) / sum(|group| group.passes)
    }

    /// What the product of a pair's slopes counts: as much as each of them is worth.
    fn weights(&self) -> [f64; PAIRS] {
        let weights = pairs().map(|(g, h)| self.groups[g].spread() * self.groups[h].spread());
        let sum: f64 = weights.iter().sum();
        weights.map(|weight| weight / sum)
    }

    /// The bounds that follow from the squares that each pair of groups found for the whole picture.
    fn bounds(&self, squares: [f64; PAIRS]) -> BlurBounds {
        let weights = self.weights();
        let mean: f64 = squares.iter().zip(weights).map(|(square, weight)| weight * square).sum();
        let spread = squares.iter().zip(weights).map(|(square, weight)| (weight * (square - mean)).powi(2));
        let doubt = STUDENT_95 * (spread.sum::<f64>() * PAIRS as f64 / (PAIRS - 1) as f64).sqrt();
        let root = |square: f64| square.max(0.0).sqrt();
        BlurBounds {
            least: root(mean - doubt),
            likely: REACH.sqrt() * root(mean),
            most: REACH * root(mean.max(0.0) + DOUBT * doubt),
        }
    }
}

impl Group {
    /// Σ (b − mean)².
    fn spread(&self) -> f64 {
        self.sum2 - self.sum * self.sum / self.passes
    }
}

/// The pairs of groups, in a fixed order.
fn pairs() -> [(usize, usize); PAIRS] {
    let (mut pairs, mut count) = ([(0, 0); PAIRS], 0);
    for g in 0..GROUPS {
        for h in g + 1..GROUPS {
            pairs[count] = (g, h);
            count += 1;
        }
    }
    pairs
}

/// The slopes of each pixel, for a film whose passes are enough for them.
pub(super) struct Slopes<'a> {
    film: &'a Film,
    blur: &'a Blur,
    /// The mean of b: slopes times it are blurs.
    mean: f64,
}

impl Film {
    /// Whether its passes gathered photons.
    pub(super) fn has_photons(&self) -> bool {
        self.blur.is_some()
    }

    /// What tells the blur; `None` of a film without photons, and below eight passes.
    pub(super) fn slopes(&self) -> Option<Slopes<'_>> {
        let blur = self.blur.as_ref().filter(|blur| blur.is_known())?;
        Some(Slopes { film: self, blur, mean: blur.mean() })
    }
}

impl Slopes<'_> {
    /// For each pair of groups the product of the blurs that they find at a pixel.
    pub(super) fn products(&self, index: usize) -> [[f64; 3]; PAIRS] {
        let blurs: [[f64; 3]; GROUPS] = std::array::from_fn(|group| self.blur_of(group, index));
        pairs().map(|(g, h)| [0, 1, 2].map(|c| blurs[g][c] * blurs[h][c]))
    }

    /// The bounds that follow from what the products amount to over the whole picture.
    pub(super) fn bounds(&self, squares: [f64; PAIRS]) -> BlurBounds {
        self.blur.bounds(squares)
    }

    /// The slope of the line through a group's passes at a pixel, times the mean of b.
    fn blur_of(&self, group: usize, index: usize) -> [f64; 3] {
        let streams = (group..STREAMS as usize).step_by(GROUPS).filter_map(|s| self.film.streams.get(s));
        let plain = streams.fold([0.0; 3], |sum, stream| [0, 1, 2].map(|c| sum[c] + stream[index][c]));
        let Group { passes, sum, tilted, .. } = &self.blur.groups[group];
        let spread = self.blur.groups[group].spread();
        [0, 1, 2].map(|c| self.mean * (tilted[index][c] - sum / passes * plain[c]) / spread)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Region, Tile};
    use super::*;
    use crate::math::Rgb;
    use crate::render::sampler::{Dim, Sampler};

    const REGION: Region = Region { x: 0, y: 0, width: 60, height: 50 };

    /// A film of noise around `of(x, b)` for column x, with b as Knaus & Zwicker let it fall; and the mean of what it is of.
    fn noisy(seed: u64, passes: u32, noise: f32, of: impl Fn(u32, f64) -> f64) -> (Film, Vec<f64>) {
        let mut film = Film::new(REGION);
        let (mut b, mut means) = (1.0, vec![0.0; REGION.width as usize]);
        for pass in 0..passes {
            let sample = |[x, y]: [u32; 2]| {
                let u = Sampler::new(seed, pass, u64::from(y) << 32 | u64::from(x), 0).get_1d(Dim::Filter);
                Rgb::gray((u - 0.5) * noise + of(x, b) as f32)
            };
            film.add_blurred_pass(
                &[Tile { region: REGION, samples: REGION.pixels().map(sample).collect() }],
                b,
            );
            (0..).zip(&mut means).for_each(|(x, mean)| *mean += of(x, b) / f64::from(passes));
            let i = f64::from(pass + 1);
            b *= (i + 2.0 / 3.0) / (i + 1.0);
        }
        (film, means)
    }

    /// A film of noise around 1 + `blur` · b, and its blur.
    fn film(seed: u64, blur: f64, passes: u32) -> (Film, f64) {
        let (film, means) = noisy(seed, passes, 1.0, |_, b| 1.0 + blur * b);
        (film, (means[0] - 1.0) / means[0]) // of the brightness that is seen
    }

    fn bounds(film: &Film) -> BlurBounds {
        film.error().and_then(|e| e.blur).expect("photons")
    }

    #[test]
    fn blur_in_proportion_to_the_disc_is_found() {
        for passes in [24, 64] {
            let (blurred, blur) = film(1, 0.5, passes);
            let found = bounds(&blurred);
            assert!(0.8 * blur < found.least && found.least < blur, "{passes} passes: {found:?} for {blur}");
            assert!((found.likely / blur / REACH.sqrt() - 1.0).abs() < 0.15, "{found:?} for {blur}");
            let none = bounds(&film(1, 0.0, passes).0);
            assert!(
                none.least < 0.1 * blur && none.most < found.most,
                "{passes} passes: {none:?} of nothing"
            );
        }
        assert_eq!(bounds(&film(1, 0.5, 7).0), BlurBounds::UNKNOWN);
        assert!(bounds(&film(1, 0.5, 8).0).is_known());
    }

    #[test]
    fn at_an_edge_the_blur_is_more_than_the_slope_tells_and_within_the_bounds() {
        for passes in [16, 64, 256] {
            // The share of a disc, of 10 pixels at first, that lies beyond a straight edge between columns 29 and 30.
            let edge = |x: u32, b: f64| {
                let t = ((f64::from(x) - 29.5) / (10.0 * b.sqrt())).clamp(-1.0, 1.0);
                1.0 + 1.0 - (t.acos() - t * (1.0 - t * t).sqrt()) / std::f64::consts::PI
            };
            let (film, means) = noisy(1, passes, 0.1, edge);
            let squares = (0..).zip(&means).map(|(x, mean)| {
                let truth = if x < 30 { 1.0 } else { 2.0 };
                ((mean - truth) / truth).powi(2)
            });
            let blur = (squares.sum::<f64>() / means.len() as f64).sqrt();
            let found = bounds(&film);
            assert!(found.least < blur && blur < found.most, "{passes} passes: {found:?} for {blur}");
            assert!(blur > 2.0 * found.likely / REACH.sqrt(), "{passes} passes: {found:?} for {blur}");
        }
    }

    #[test]
    fn noise_seldom_passes_for_blur() {
        // Bounds that hold in 95 % do so in 51 or more of 60 with probability 0.999.
        for blur in [0.0, 0.03, 0.1] {
            let holds = (0..60).filter(|&seed| {
                let (film, blur) = film(seed, blur, 16);
                let found = bounds(&film);
                found.least <= blur && blur <= found.most
            });
            let count = holds.count();
            assert!(count >= 51, "{blur}: {count} of 60");
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
