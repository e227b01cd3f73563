//! Both ways at a clear surface: what is mirrored there, and what is seen through it.
//!
//! A path that takes one of the two by chance meets a lamp through a long chain of reflections within glass once in a
//! hundred thousand times, and shines then for all the others: a speck. While all that lies between the camera and a path
//! is clear, both ways are followed, each with the share of light that goes it; chance decides only about ways whose share
//! has become small (splitting and roulette, Arvo & Kirk 1990). So the ways of a camera ray are few, however long.

/// A way is followed for certain when it has at least this share of what its camera ray sees. A smaller one is followed in
/// proportion to it, and has this share then.
const LEAST_SHARE: f32 = 0.1;

/// A way is lit for certain when it has at least this share, and a smaller one in proportion: light that surfaces spread is
/// dear to find and varies little, while lamps are seen for nothing.
const LEAST_LIT_SHARE: f32 = 0.25;

/// Ways that wait to be followed, at the most: what is met after that takes one way by chance.
pub const MOST_WAITING: usize = 16;

/// A way to follow.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Way {
    /// Which: the number by which a bsdf chooses it.
    pub u_lobe: f32,
    /// What the path's share changes by, and its throughput beside what the bsdf says of the way.
    pub factor: f32,
}

/// The largest number below 1.
const ONE_MINUS: f32 = 1.0 - f32::EPSILON / 2.0;

/// The ways to follow, mirrored and through, where a `mirrored` part of the light goes one way and the rest the other, for
/// a path of the given share; `u` in [0, 1) is chance. There is at least one.
///
/// Each way is followed with a probability that its share and factor make up for. At a share of [`LEAST_SHARE`] and below
/// exactly one is, as if there were no forks.
pub fn ways(mirrored: f32, share: f32, u: f32) -> [Option<Way>; 2] {
    let excess = (share / LEAST_SHARE).max(1.0);
    let (chance_mirrored, chance_through) = (mirrored * excess, (1.0 - mirrored) * excess);
    let goes_mirrored = u < chance_mirrored;
    let goes_through = u >= mirrored || excess > 1.0 && u >= 1.0 - chance_through;
    let way = |u_lobe, part: f32| Way { u_lobe, factor: part.max(1.0 / excess) };
    [goes_mirrored.then(|| way(0.0, mirrored)), goes_through.then(|| way(ONE_MINUS, 1.0 - mirrored))]
}

/// The chance with which a path of the given share is lit where it meets a surface that spreads light.
pub fn lit_chance(share: f32) -> f32 {
    (share / LEAST_LIT_SHARE).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_way_gets_its_part_on_average() {
        const DRAWS: u32 = 1 << 16;
        for mirrored in [0.0, 1e-4, 0.04, 0.5, 0.97, 1.0] {
            for share in [1.0, 0.3, 0.11, 0.1, 1e-5] {
                let (mut sums, mut followed) = ([0.0_f64; 2], 0);
                for i in 0..DRAWS {
                    let ways = ways(mirrored, share, (i as f32 + 0.5) / DRAWS as f32);
                    assert!(ways[0].is_some() || ways[1].is_some());
                    for (sum, way) in sums.iter_mut().zip(ways) {
                        *sum += way.map_or(0.0, |way| f64::from(way.factor) / f64::from(DRAWS));
                        followed += u32::from(way.is_some());
                        let least = share.min(LEAST_SHARE) * 0.999;
                        assert!(way.is_none_or(|way| share * way.factor >= least), "{way:?} of {share}");
                    }
                }
                let found = format!("{mirrored} {share}: {sums:?}");
                assert!((sums[0] - f64::from(mirrored)).abs() < 2e-5, "{found}");
                assert!((sums[1] - f64::from(1.0 - mirrored)).abs() < 2e-5, "{found}");
                assert!(share > LEAST_SHARE || followed == DRAWS, "{found}");
            }
        }
    }
}
