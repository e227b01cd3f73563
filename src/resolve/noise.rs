//! Numbers that look random, and are the same in every run.

/// A number in [0, 1) from a seed and an index: two rounds of the finaliser of SplitMix64 (Steele et al. 2014).
pub fn random(seed: f64, index: f64) -> f64 {
    let hash = mix(mix(seed.to_bits()).wrapping_add(index.to_bits()));
    (hash >> 11) as f64 * (-53.0_f64).exp2()
}

/// Value noise in [0, 1) at a point: random numbers on the integer lattice, joined by quintic steps
/// (Perlin 2002), so that first and second derivatives are continuous.
pub fn noise(p: [f64; 3]) -> f64 {
    let cell = p.map(f64::floor);
    let step = |i: usize| {
        let t = p[i] - cell[i];
        t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
    };
    let corner = |x: f64, y: f64, z: f64| {
        let hash =
            [cell[0] + x, cell[1] + y, cell[2] + z].iter().fold(0, |hash, c| mix(hash ^ (c + 0.0).to_bits()));
        (hash >> 11) as f64 * (-53.0_f64).exp2()
    };
    let lerp = |t: f64, a: f64, b: f64| a + t * (b - a);
    let along_x = |y, z| lerp(step(0), corner(0.0, y, z), corner(1.0, y, z));
    let along_y = |z| lerp(step(1), along_x(0.0, z), along_x(1.0, z));
    lerp(step(2), along_y(0.0), along_y(1.0))
}

const fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_numbers_fill_the_interval_evenly() {
        let n = 10_000;
        let mean = (0..n).map(|i| random(7.0, f64::from(i))).sum::<f64>() / f64::from(n);
        // The standard deviation of the mean is 0.29 / √n = 0.0029.
        assert!((mean - 0.5).abs() < 0.012, "{mean}");
        assert_ne!(random(1.0, 0.0), random(0.0, 1.0));
    }

    #[test]
    fn noise_is_continuous_across_cells() {
        for i in -3..3 {
            let x = f64::from(i);
            let (below, above) = (noise([x - 1e-9, 0.3, 0.7]), noise([x + 1e-9, 0.3, 0.7]));
            assert!((below - above).abs() < 1e-6, "at {x}");
        }
    }
}
