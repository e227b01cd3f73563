//! Noise that is the same on every machine: hashed lattices, and sums of octaves of them.

use glam::{Vec2, Vec3};

/// A number in `[0, 1)` that belongs to a lattice cell: an integer hash with good avalanche (after Wellons 2018).
pub fn hash(x: i32, y: i32, seed: u32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b1)
        ^ (y as u32).wrapping_mul(0x85eb_ca77)
        ^ seed.wrapping_mul(0xc2b2_ae3d);
    for _ in 0..2 {
        h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
        h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    }
    ((h ^ (h >> 16)) >> 8) as f32 / (1 << 24) as f32
}

/// Smooth noise in `[-1, 1]`, one feature for each unit of length: gradients on a lattice, joined by a quintic
/// (Perlin 2002).
pub fn perlin(p: Vec2, seed: u32) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |dx: i32, dy: i32| {
        let angle = std::f32::consts::TAU * hash(cell.x as i32 + dx, cell.y as i32 + dy, seed);
        Vec2::from_angle(angle).dot(f - Vec2::new(dx as f32, dy as f32))
    };
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * fade.x;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * fade.x;
    (low + (high - low) * fade.y) * std::f32::consts::SQRT_2
}

/// Fractal noise, about in `[-1, 1]`: octaves of [`perlin`], each with twice the detail and half the weight.
pub fn fractal(p: Vec2, octaves: u32, seed: u32) -> f32 {
    let turn = Vec2::from_angle(0.6); // the lattices of two octaves must not line up
    let mut at = p;
    let (mut sum, mut weight) = (0.0, 0.5);
    for octave in 0..octaves {
        sum += weight * perlin(at, seed.wrapping_add(octave));
        at = turn.rotate(at) * 2.03;
        weight *= 0.5;
    }
    sum
}

/// The colour at `t` in a list of (position, colour) stops in rising order.
pub fn ramp(stops: &[(f32, Vec3)], t: f32) -> Vec3 {
    let Some(above) = stops.iter().position(|stop| t < stop.0) else { return stops[stops.len() - 1].1 };
    if above == 0 {
        return stops[0].1;
    }
    let ((a, from), (b, to)) = (stops[above - 1], stops[above]);
    from.lerp(to, (t - a) / (b - a))
}
