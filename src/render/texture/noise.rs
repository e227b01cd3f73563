//! Gradient noise in three dimensions (Perlin 2002), by hashing: no table, no period that anyone will see.

use crate::math::Vec3;

/// Noise with features about 1 apart, in [−1, 1]; 0 at whole numbers.
pub(super) fn perlin(p: Vec3) -> f32 {
    let cell = p.floor();
    let t = p - cell;
    let [x, y, z] = cell.to_array().map(|x| x as i32);
    let at = |dx: i32, dy: i32, dz: i32| {
        let corner = Vec3::new(dx as f32, dy as f32, dz as f32);
        gradient(x.wrapping_add(dx), y.wrapping_add(dy), z.wrapping_add(dz)).dot(t - corner)
    };
    let s = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let lerp = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let along_x = |dy, dz| lerp(at(0, dy, dz), at(1, dy, dz), s.x);
    let along_y = |dz| lerp(along_x(0, dz), along_x(1, dz), s.y);
    lerp(along_y(0), along_y(1), s.z)
}

/// Octaves of noise, each twice as fine and half as strong, over the sum of their strengths: about [−1, 1].
pub(super) fn fractal(p: Vec3, octaves: u32) -> f32 {
    sum(p, octaves, |value| value)
}

/// The same with the magnitude of each octave: folds and veins, in [0, 1] (Perlin 1985).
pub(super) fn turbulence(p: Vec3, octaves: u32) -> f32 {
    sum(p, octaves, f32::abs)
}

fn sum(mut p: Vec3, octaves: u32, of: impl Fn(f32) -> f32) -> f32 {
    let (mut total, mut strength, mut all) = (0.0, 1.0, 0.0);
    for _ in 0..octaves {
        total += strength * of(perlin(p));
        all += strength;
        strength *= 0.5;
        // Shifted too, so that the zeros at whole numbers do not fall together.
        p = p * 2.0 + Vec3::new(0.37, 0.71, 0.13);
    }
    if all > 0.0 { total / all } else { 0.0 }
}

/// One of the twelve directions to the middles of a cube's edges.
fn gradient(x: i32, y: i32, z: i32) -> Vec3 {
    let h = hash(x as u32, y as u32, z as u32);
    let sign = |bit: u32| if h & bit == 0 { 1.0 } else { -1.0 };
    let (a, b) = (sign(1), sign(2));
    match (h >> 2) % 3 {
        0 => Vec3::new(a, b, 0.0),
        1 => Vec3::new(a, 0.0, b),
        _ => Vec3::new(0.0, a, b),
    }
}

/// A number that differs for every cell and shows no trace of it.
fn hash(x: u32, y: u32, z: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ z.wrapping_mul(0xc2b2_ae3d);
    h ^= h >> 15;
    h = h.wrapping_mul(0x2c1b_3c6d);
    h ^= h >> 12;
    h = h.wrapping_mul(0x297a_2d39);
    h ^ h >> 15
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points() -> impl Iterator<Item = Vec3> {
        (0..20_000).map(|i| {
            let i = i as f32;
            Vec3::new((i * 0.754_877_7).fract(), (i * 0.569_840_3).fract(), (i * 0.362_841).fract()) * 200.0
                - 100.0
        })
    }

    #[test]
    fn noise_stays_in_its_range_averages_nothing_and_has_no_steps() {
        let (mut sum, mut most) = (0.0, 0.0_f32);
        for p in points() {
            let value = perlin(p);
            assert!((-1.0..=1.0).contains(&value), "{p}: {value}");
            assert!((perlin(p + Vec3::splat(1e-3)) - value).abs() < 0.02, "{p}");
            assert!((0.0..=1.0).contains(&turbulence(p, 5)) && (-1.0..=1.0).contains(&fractal(p, 5)));
            sum += f64::from(value);
            most = most.max(value);
        }
        assert!((sum / 20_000.0).abs() < 0.01 && most > 0.6, "mean {}, most {most}", sum / 20_000.0);
    }

    #[test]
    fn whole_numbers_are_zeros() {
        assert_eq!(perlin(Vec3::new(3.0, -7.0, 12.0)), 0.0);
    }
}
