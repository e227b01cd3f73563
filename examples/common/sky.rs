//! The dusk sky that `stadium.jpg` and `sky.jpg` share, so that one continues the other without a seam.

use glam::{Vec2, Vec3};

use super::noise::{fractal, ramp};
use super::paint::srgb;
use super::smoothstep;

/// The eye before the window, in metres: its distance (x) and its height above the ground (y).
pub const EYE: Vec2 = Vec2::new(21.0, 4.4);

/// The colour of the sky at a point of the window: x metres right of its middle, y metres above the ground.
///
/// Above a gradient from apricot to deep blue lie two layers of cloud, drawn as flat sheets seen from below: a point is
/// carried to the sheet in perspective, where noise says how thick the cloud is.
pub fn dusk(window: Vec2) -> Vec3 {
    let rise = ((window.y - EYE.y) / EYE.x).max(0.02);
    let side = window.x / EYE.x;
    let stops = [
        (0.1, srgb(0xf7b26a)),
        (0.2, srgb(0xee9a6e)),
        (0.29, srgb(0xc97d86)),
        (0.38, srgb(0x7f6f9e)),
        (0.5, srgb(0x3f568f)),
        (0.85, srgb(0x1a2c58)),
    ];
    let glow = 1.0 + 0.25 * (-(side * side) * 4.0).exp() * smoothstep(0.45, 0.2, rise);
    let mut color = ramp(&stops, rise) * glow;

    // High, thin streaks, drawn out along x.
    let sheet = Vec2::new(side, 1.0) / rise;
    let streaks = fractal(sheet * Vec2::new(0.55, 2.3) + Vec2::new(3.1, 0.0), 6, 21);
    color = color.lerp(
        srgb(0xf6c6a4) * (0.55 + 0.6 * smoothstep(0.5, 0.2, rise)),
        0.5 * smoothstep(0.02, 0.5, streaks),
    );

    // Lower banks: burning where they thin out towards the set sun, slate where they are thick.
    let thickness = |offset: Vec2| {
        let at = sheet * Vec2::new(0.9, 1.7) + offset;
        let warp = Vec2::new(fractal(at * 0.8, 3, 31), fractal(at * 0.8, 3, 37));
        fractal(at + warp * 0.55, 7, 41) + 0.02
    };
    let here = thickness(Vec2::ZERO);
    let edge_on_sun = (here - thickness(Vec2::new(0.0, 0.13))) * 2.2;
    let burning = srgb(0xff9a62).lerp(srgb(0xd98a98), smoothstep(0.22, 0.42, rise));
    let slate = srgb(0x5a4a66).lerp(srgb(0x2c3a62), smoothstep(0.2, 0.5, rise));
    let cloud = slate.lerp(burning, (0.35 + edge_on_sun).clamp(0.0, 1.0));
    color.lerp(cloud, 0.9 * smoothstep(-0.02, 0.3, here))
}
