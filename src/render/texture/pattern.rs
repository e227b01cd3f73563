//! Patterns by formula: each is a number in [0, 1], which blends one colour into another.

use super::Detail;
use super::noise::{fractal, turbulence};
use crate::math::{Vec2, Vec3, float};
use crate::render::geometry::SurfacePoint;
use std::f32::consts::TAU;

/// Octaves of the disturbance in veins and rings.
const OCTAVES: u32 = 5;

/// The strength of clouds: so that the brightest and darkest hundredth reach the ends.
const CONTRAST: f32 = 1.25;

/// What a pattern looks like. Those with a `size` are cut from a block: they take the point in object space.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Pattern {
    /// From 0 at v = 0 to 1 at v = 1.
    Rise,
    /// From 0 at a point of object space to 1 at another, in planes between.
    Ramp {
        /// Where it is 0, in metres.
        start: Vec3,
        /// From there to where it is 1.
        way: Vec3,
    },
    /// Clouds.
    Noise {
        /// The distance of the largest features, in metres.
        size: f32,
        /// How many scales of features, each half as large as the one before.
        octaves: u32,
    },
    /// Veins across x, folded by turbulence.
    Marble {
        /// The distance of veins, in metres.
        size: f32,
        /// How far they are folded, in veins.
        turbulence: f32,
    },
    /// Rings around the y axis.
    Wood {
        /// The width of a ring, in metres.
        size: f32,
        /// How far they are bent, in rings.
        turbulence: f32,
    },
    /// Bricks in texture space, rows of them shifted by half; 1 is mortar.
    Brick {
        /// How many along u and v.
        cells: Vec2,
        /// The width of the joint, as a share of a brick's height.
        mortar: f32,
        /// The width of a brick over its height, as it is seen: the joint is as wide across as along.
        aspect: f32,
    },
}

impl Pattern {
    /// The number in [0, 1] at a point of a surface.
    pub(super) fn eval(&self, surface: &SurfacePoint) -> f32 {
        let p = surface.p_object;
        match *self {
            Self::Rise => surface.uv.y.clamp(0.0, 1.0),
            Self::Ramp { start, way } => ((p - start).dot(way) / way.length_squared()).clamp(0.0, 1.0),
            Self::Noise { size, octaves } => (0.5 + CONTRAST * fractal(p / size, octaves)).clamp(0.0, 1.0),
            Self::Marble { size, turbulence: fold } => {
                let folded = p.x / size + fold * turbulence(p / (2.0 * size), OCTAVES);
                0.5 + 0.5 * float::sin_cos(TAU * folded.fract()).0
            }
            Self::Wood { size, turbulence: bend } => {
                let radius = Vec2::new(p.x, p.z).length() / size;
                let grain = Vec3::new(p.x, p.y * 0.1, p.z) / (4.0 * size);
                let ring = (radius + bend * fractal(grain, 3)).rem_euclid(1.0);
                // Summer wood darkens slowly towards the end of a ring, which ends at once.
                ring * ring * (1.0 - smooth_step(0.9, 1.0, ring))
            }
            Self::Brick { cells, mortar, aspect } => brick(surface.uv * cells, mortar, aspect),
        }
    }

    /// The size of what is finest in it.
    pub(super) fn detail(&self) -> Detail {
        match *self {
            Self::Rise => Detail { uv: 0.01, ..Detail::NONE },
            Self::Ramp { way, .. } => Detail::of_space(0.01 * way.length()),
            Self::Noise { size, octaves } => Detail::of_space(0.1 * size / (1_u32 << octaves.min(10)) as f32),
            Self::Marble { size, .. } | Self::Wood { size, .. } => Detail::of_space(0.02 * size),
            Self::Brick { cells, mortar, .. } => Detail::of_uv(Vec2::splat(0.5 * mortar.max(0.02)) / cells),
        }
    }
}

/// 1 in the joints between bricks, 0 within; edges fall off over a third of the joint, so that they can be bumped.
fn brick(p: Vec2, mortar: f32, aspect: f32) -> f32 {
    let row = p.y.floor();
    let shift = if row.rem_euclid(2.0) < 1.0 { 0.0 } else { 0.5 };
    let x = (p.x + shift).rem_euclid(1.0);
    let y = p.y - row;
    // The distance to the nearest edge, in heights of a brick.
    let edge = (x.min(1.0 - x) * aspect).min(y.min(1.0 - y));
    1.0 - smooth_step(mortar / 3.0, mortar * 0.5, edge)
}

/// 0 up to `a`, 1 from `b` on, and smooth between.
fn smooth_step(a: f32, b: f32, x: f32) -> f32 {
    let t = if b > a { ((x - a) / (b - a)).clamp(0.0, 1.0) } else { f32::from(u8::from(x >= a)) };
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_run_between_bricks_and_rows_are_shifted_by_half() {
        assert_eq!(brick(Vec2::new(0.5, 0.5), 0.1, 2.0), 0.0);
        assert_eq!(brick(Vec2::new(0.0, 0.5), 0.1, 2.0), 1.0);
        assert_eq!(brick(Vec2::new(0.3, 1.0), 0.1, 2.0), 1.0);
        assert_eq!(brick(Vec2::new(0.5, 1.5), 0.1, 2.0), 1.0);
        assert_eq!(brick(Vec2::new(0.0, 1.5), 0.1, 2.0), 0.0);
        assert_eq!(brick(Vec2::new(0.0, 0.5), 0.0, 2.0), 1.0 - smooth_step(0.0, 0.0, 0.0));
    }
}
