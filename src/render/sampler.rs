//! Numbers in [0, 1) for every decision of a path: Owen-scrambled Sobol points.
//!
//! Each decision has a name, a [`Dim`], and takes its own pair of Sobol dimensions, scrambled and shuffled by a hash of
//! seed, pixel and name (Laine & Karras 2011; Burley 2020). No counter runs: what one effect draws cannot shift another,
//! and every number follows from seed, pixel, sample index and name alone.

use crate::math::{Vec2, Vec3};

/// A decision of a path; those made at every vertex carry the depth.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Dim {
    /// Where in the pixel.
    Filter,
    /// Where on the lens.
    Lens,
    /// At which moment while the shutter is open.
    Time,
    /// Which lobe of the bsdf, and reflection or refraction.
    Lobe(u32),
    /// Which direction.
    Bsdf(u32),
    /// Which light.
    LightChoice(u32),
    /// Which point on it.
    Light(u32),
    /// Whether the path goes on.
    Roulette(u32),
    /// Which light a photon leaves.
    PhotonLight,
    /// From where on it.
    PhotonPosition,
    /// Along which direction.
    PhotonDirection,
    /// At which wavelength light goes through glass that spreads colours.
    Wavelength,
    /// Towards which of the targets.
    PhotonTarget,
    /// Whether a direction counts as sharply or as widely scattered.
    Share(u32),
    /// Whether a branch of a camera path that counts for little is lit.
    Lit(u32),
}

impl Dim {
    /// A different number for each decision.
    fn code(self) -> u32 {
        let at = |kind: u32, depth: u32| kind | depth << 4;
        match self {
            Self::Filter => 0,
            Self::Lens => 1,
            Self::PhotonLight => 2,
            Self::PhotonPosition => 3,
            Self::PhotonDirection => 4,
            Self::PhotonTarget => 12,
            Self::Wavelength => 10,
            Self::Time => at(10, 1), // as the wavelength, one for each path
            Self::Lobe(depth) => at(5, depth),
            Self::Bsdf(depth) => at(6, depth),
            Self::LightChoice(depth) => at(7, depth),
            Self::Light(depth) => at(8, depth),
            Self::Roulette(depth) => at(9, depth),
            Self::Share(depth) => at(11, depth),
            Self::Lit(depth) => at(13, depth),
        }
    }
}

/// How the samples of a pixel, and the photons of a pass, are spread.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum Sampling {
    /// Evenly: as Owen-scrambled Sobol points.
    #[default]
    Sobol,
    /// Each apart from all others, as in plain Monte Carlo: beside it shows what evenness is worth.
    Independent,
}

/// The numbers of one path: sample `index` of a sequence.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sampler {
    key: u64,
    index: u32,
}

impl Sampler {
    /// Sample `index` of the sequence that belongs to a seed, a stream (independent of all others) and an item
    /// (a pixel; 0 for photons, whose index is their own).
    pub fn new(seed: u64, stream: u32, item: u64, index: u32) -> Self {
        let key = mix(mix(mix(seed).wrapping_add(u64::from(stream))).wrapping_add(item));
        Self { key, index }
    }

    /// The numbers of a branch that leaves a path at its vertex number `depth`: independent of those of the path and of all
    /// its other branches.
    pub fn branch(&self, depth: u32) -> Self {
        const BRANCH: u64 = 1 << 32; // apart from every name
        Self { key: mix(self.key ^ (BRANCH | u64::from(depth))), ..*self }
    }

    /// The numbers of part `i` of `count` into which a path is divided. All parts of all samples make one sequence, so
    /// that they are spread evenly together.
    pub fn part(&self, i: u32, count: u32) -> Self {
        const PART: u64 = 2 << 32;
        Self { key: mix(self.key ^ PART), index: self.index.wrapping_mul(count).wrapping_add(i) }
    }

    /// A number in [0, 1).
    #[inline]
    pub fn get_1d(&self, dim: Dim) -> f32 {
        self.get_2d(dim).x
    }

    /// A point in [0, 1)²; of every 2ᵐ in a row, each elementary interval holds one.
    #[inline]
    pub fn get_2d(&self, dim: Dim) -> Vec2 {
        let seeds = mix(self.key ^ u64::from(dim.code()).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let (seed_x, seed_y) = (seeds as u32, (seeds >> 32) as u32);
        let seed_index = seed_x ^ seed_y.rotate_left(16) ^ 0x5bd1_e995;
        // The first Sobol coordinate is the reversed index, here of a point of the shuffled order.
        let x = scramble(self.index.reverse_bits(), seed_index);
        let y = second_coordinate(x);
        Vec2::new(to_unit(owen(x, seed_x)), to_unit(owen(y, seed_y)))
    }
}

/// Scrambles a coordinate as Owen 1995 does: each bit is flipped by a hash of the bits above it.
fn owen(x: u32, seed: u32) -> u32 {
    scramble(x.reverse_bits(), seed).reverse_bits()
}

/// A hash in which each bit is affected only by those below it (Laine & Karras 2011; constants of Vegdahl 2021).
fn scramble(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// The second Sobol coordinate from the first: its matrix is Pascal's triangle modulo 2, a product of five sparse ones.
fn second_coordinate(mut x: u32) -> u32 {
    x ^= x << 16;
    x ^= (x & 0x00ff_00ff) << 8;
    x ^= (x & 0x0f0f_0f0f) << 4;
    x ^= (x & 0x3333_3333) << 2;
    x ^ (x & 0x5555_5555) << 1
}

/// A bijection that spreads every input bit over all output bits (the finaliser of SplitMix64, Steele et al. 2014).
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A number in [0, 1) that follows from a ray and what it meets: for choices that belong to no vertex of a path.
///
/// Of the ray it asks for signs and digits, not for exponents, so that a scene in other units makes the same choices.
pub fn hash_unit(o: Vec3, d: Vec3, item: u32) -> f32 {
    const SIGN_AND_DIGITS: u32 = 0x807f_ffff;
    let words = [o.x, o.y, o.z, d.x, d.y, d.z].map(|x| x.to_bits() & SIGN_AND_DIGITS);
    let hash = words.into_iter().chain([item]).fold(0, |hash, word| mix(hash ^ u64::from(word)));
    to_unit((hash >> 32) as u32)
}

/// The upper 24 bits as a fraction: every result is exact and below 1.
fn to_unit(x: u32) -> f32 {
    (x >> 8) as f32 * (1.0 / 16_777_216.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    const DIMS: [Dim; 5] = [Dim::Filter, Dim::Lens, Dim::Bsdf(0), Dim::Light(7), Dim::Roulette(31)];

    #[test]
    fn every_elementary_interval_holds_one_of_the_first_points() {
        for dim in DIMS {
            for item in 0..8 {
                for m in 0..=10 {
                    let points = (0..1_u32 << m).map(|i| Sampler::new(1, 0, item, i).get_2d(dim));
                    let points: Vec<Vec2> = points.collect();
                    for columns in 0..=m {
                        let (nx, ny) = ((1_u32 << columns) as f32, (1_u32 << (m - columns)) as f32);
                        let cells: HashSet<_> =
                            points.iter().map(|p| ((p.x * nx) as u32, (p.y * ny) as u32)).collect();
                        assert_eq!(cells.len(), 1 << m, "{dim:?} {item} m = {m}, {nx} columns");
                    }
                }
            }
        }
    }

    #[test]
    fn no_two_pixels_or_names_share_a_sequence() {
        let sequence = |item, dim| {
            [0, 1, 2].map(|i| Sampler::new(9, 0, item, i).get_2d(dim).to_array().map(f32::to_bits))
        };
        let mut seen = HashSet::new();
        for item in 0..5_000 {
            for dim in DIMS {
                assert!(seen.insert(sequence(item, dim)), "{item} {dim:?}");
            }
        }
    }

    #[test]
    fn different_names_are_independent() {
        // The mean of a product over two names converges to the product of the means.
        let n = 4_096;
        let mut sum = 0.0;
        for i in 0..n {
            let sampler = Sampler::new(3, 0, 5, i);
            sum +=
                f64::from(sampler.get_1d(Dim::Bsdf(1)) - 0.5) * f64::from(sampler.get_1d(Dim::Bsdf(2)) - 0.5);
        }
        assert!((sum / f64::from(n)).abs() < 4.0 / 12.0 / f64::from(n).sqrt());
    }
}
