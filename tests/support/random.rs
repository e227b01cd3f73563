//! Numbers that look random, the same on every run.

use snell::math::{Vec2, Vec3, warp};

/// A generator of 64-bit numbers (Steele, Lea, Flood 2014: SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    pub fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1_u64 << 24) as f32
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// A point of the cube [−1, 1]³.
    pub fn point(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    pub fn direction(&mut self) -> Vec3 {
        warp::square_to_uniform_sphere(Vec2::new(self.unit(), self.unit()))
    }

    pub fn axis(&mut self) -> Vec3 {
        let axis = Vec3::AXES[self.below(3)];
        if self.below(2) == 0 { axis } else { -axis }
    }
}
